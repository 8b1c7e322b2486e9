/* scene_file.h - a scene from a file or from stdin, with all that is wrong with it said. */
#ifndef RTC_SCENE_FILE_H
#define RTC_SCENE_FILE_H

#include "rt.h"

/* How many errors and warnings were found. */
typedef struct scene_findings {
    unsigned errors, warnings;
} scene_findings;

/*
 * Reads the scene at path, "-" for stdin, and prints every error, and every warning unless hushed.
 * Returns an exit status; the caller owns *out, written only on STATUS_DONE. findings may be NULL.
 */
int scene_file_load(rt_scene **out, const char *path, int hush_warnings, scene_findings *findings);

#endif
