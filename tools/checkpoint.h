/* checkpoint.h - --checkpoint, --every and --resume: a render that can be gone on with. */
#ifndef RTC_CHECKPOINT_H
#define RTC_CHECKPOINT_H

#include "options.h"
#include "progress.h"

/* Where checkpoints go, and what became of them. Must stay where it is: the options point to it. */
typedef struct checkpoint {
    const char *path; /* NULL: none */
    progress_display *progress;
    int is_quiet;
    rt_film_saver *saver;
    int is_writing; /* one that saved and failed do not tell of yet */
    uint64_t saved; /* how many were written */
    int failed;     /* the last one was not */
    file_lock lock; /* where --checkpoint names a file of its own; the caller releases it */
} checkpoint;

/* Seconds between checkpoints where --every says nothing. */
#define CHECKPOINT_SECONDS 60.0

/*
 * Whether --checkpoint may name a file with this extension: one that is not there, or `resumed`,
 * which is gone on with; NULL: none. go_on: how a hint says to do that, "--resume". Returns an exit
 * status.
 */
int checkpoint_check_file(const char *path, const char *extension, const char *resumed,
                          const char *go_on);

/*
 * Loads the film of --resume into *arguments, and gives the options that it was rendered with where
 * the command line gives no others; a film that is a checkpoint goes on being one. Returns an exit
 * status.
 */
int checkpoint_resume(command_line *arguments);

/*
 * Sets the options of a render by --checkpoint, --every and --resume. A file that is there is not
 * overwritten, unless it is the one to be continued. Returns an exit status.
 */
int checkpoint_plan(checkpoint *out, rt_render_options *options, const command_line *arguments);

/* After the render: waits until the last checkpoint is on the disk, and tells where it is not. */
void checkpoint_finish(checkpoint *c);

#endif
