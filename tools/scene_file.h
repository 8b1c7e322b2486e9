/* scene_file.h - a scene from a file or from stdin, with all its errors reported. */
#ifndef RTC_SCENE_FILE_H
#define RTC_SCENE_FILE_H

#include "inputs.h"
#include "options.h"
#include "progress.h"
#include "rt.h"

/* How many errors and warnings were found. */
typedef struct scene_findings {
    unsigned errors, warnings;
} scene_findings;

/* A text that grows. */
typedef struct scene_text {
    char *text;
    size_t size, capacity;
    rt_memory *memory; /* that it counts in, or NULL */
    rt_error error;    /* why it is not whole; RT_OK: it is */
} scene_text;

/* What a scene is read for decides what is said of it beside its errors. */
typedef enum scene_purpose {
    SCENE_TO_CHECK,         /* everything */
    SCENE_TO_CHECK_QUIETLY, /* nothing, but everything is found */
    SCENE_TO_RENDER,        /* warnings, but for what the render itself will warn of */
    SCENE_TO_EMIT,          /* warnings of the text: photons need no camera */
    SCENE_QUIETLY           /* nothing */
} scene_purpose;

/* What a scene's path is called in what rtc says: "stdin" for "-". */
const char *scene_file_name(const char *path);

/*
 * Reads the scene at path, "-" for stdin, and prints every error and what else its purpose asks
 * for. Returns an exit status; the caller owns *out, written only on STATUS_DONE. findings may be
 * NULL; inputs receives the files that were read, and may be NULL. progress shows how far it has
 * come. The scene counts in the memory of the arguments; with --untrusted among them it may name
 * files in its own folder only.
 */
int scene_file_load(rt_scene **out, const char *path, scene_purpose purpose,
                    scene_findings *findings, input_list *inputs, progress_display *progress,
                    const command_line *arguments);

/*
 * Writes a scene of another program as one of the language to the file `to`, with what the
 * arguments ask of it, and tells what differs; *out, which the caller owns, is written on
 * STATUS_DONE alone. root: the folder that it may name files in, or NULL. Returns an exit status.
 */
int scene_file_import(rt_scene **out, const char *path, const char *to, const char *root,
                      const command_line *arguments);

/*
 * Writes the scene at path to stdout as it was understood, with constants, repeats and includes
 * resolved; it renders to the same picture. Returns an exit status.
 */
int scene_file_dump(const char *path, const command_line *arguments);

/*
 * Says what a file is that is called like no scene, or like none that is imported, and what is done
 * with it; 0: it may be one.
 */
int scene_file_fail_foreign(const char *path, int is_import);

#endif
