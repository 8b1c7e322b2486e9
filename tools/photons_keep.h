/* photons_keep.h - --checkpoint, --every and --resume of `rtc photons SCENE`. */
#ifndef RTC_PHOTONS_KEEP_H
#define RTC_PHOTONS_KEEP_H

#include "options.h"
#include "progress.h"

/* Where checkpoints of an emission go, and what became of them. */
typedef struct map_checkpoint {
    const char *path;       /* NULL: none */
    rt_photon_map *resumed; /* the map of --resume, or NULL */
    progress_display *progress;
    uint64_t saved; /* how many were written */
    int failed;     /* the last one was not */
    file_lock lock; /* of path */
} map_checkpoint;

/*
 * Sets the options of an emission, which point to *out from then on. A file that is there is not
 * overwritten, unless it is the one to be continued. Returns an exit status; in either case, free
 * out->resumed by rt_photon_map_destroy, and release out->lock.
 */
int map_checkpoint_plan(map_checkpoint *out, rt_emit_options *options,
                        const command_line *arguments);

#endif
