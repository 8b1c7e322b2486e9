/* photons_keep.c - writes a photon map while it is emitted, and goes on from one. */
#include "photons_keep.h"

#include <unistd.h>

#include "checkpoint.h"
#include "message.h"
#include "photons.h"
#include "status.h"

static void save(void *user, const rt_photon_map *map)
{
    map_checkpoint *c = user;
    rt_error error;
    const int failed = rt_photon_map_save(map, c->path, &error) != RT_OK;
    if (failed && !c->failed) {
        progress_clear(c->progress);
        message_warning("no checkpoint, and the emission goes on: %s", error.message);
    }
    c->failed = failed;
    c->saved += !failed;
}

static int load(map_checkpoint *out, const char *path, const command_line *arguments)
{
    int status = photons_load(&out->resumed, path, arguments);
    if (status != STATUS_DONE && access(path, F_OK) != 0)
        message_hint("an emission writes it from its first checkpoint on");
    return status;
}

int map_checkpoint_plan(map_checkpoint *out, rt_emit_options *options,
                        const command_line *arguments)
{
    const option_value *given = arguments->options;
    const char *resumed = given[OPTION_RESUME].given ? given[OPTION_RESUME].text : NULL;
    out->path = given[OPTION_CHECKPOINT].given ? given[OPTION_CHECKPOINT].text : resumed;
    /* Before it is read, as a process that ends writes it once more. */
    const long holder = out->path ? file_lock_take(&out->lock, out->path) : 0;
    if (holder != 0) {
        int checked = checkpoint_check_file(out->path, ".rtp", resumed, "--resume");
        return checked == STATUS_DONE ? file_lock_fail(out->path, holder) : checked;
    }
    int status = resumed ? load(out, resumed, arguments) : STATUS_DONE;
    if (status != STATUS_DONE)
        return status;
    options->resume = out->resumed;
    if (!out->path) {
        if (given[OPTION_EVERY].given && !given[OPTION_QUIET].given)
            message_warning("--every has no effect without --checkpoint");
        return STATUS_DONE;
    }
    options->checkpoint = save;
    options->checkpoint_user = out;
    options->checkpoint_seconds =
        given[OPTION_EVERY].given ? given[OPTION_EVERY].real : CHECKPOINT_SECONDS;
    return checkpoint_check_file(out->path, ".rtp", resumed, "--resume");
}
