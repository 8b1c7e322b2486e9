/* direct.h - scenes of other programs, read where one of the language is expected. */
#ifndef RTC_IMPORT_DIRECT_H
#define RTC_IMPORT_DIRECT_H

#include "../inputs.h"
#include "../options.h"
#include "rehearsal.h"

/* Whether a file is called like a scene or a mesh that is imported. */
int direct_is_foreign(const char *path);

/*
 * Imports a file into a scene of the language, *text, which the caller frees, with its files in a
 * folder that import_rehearsal_end removes once the scene is loaded; `inputs` receives the files
 * that were read, and may be NULL. What differs is told unless is_quiet. Returns a status; text and
 * folder are there on STATUS_DONE alone.
 */
int direct_begin(import_rehearsal *out, char **text, const char *path, input_list *inputs,
                 int is_quiet, const command_line *arguments);

#endif
