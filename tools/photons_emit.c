/* photons_emit.c - `rtc photons SCENE`: emits the photons of a scene into a file. */
#include <stdlib.h>

#include "message.h"
#include "other_work.h"
#include "part.h"
#include "photons.h"
#include "photons_keep.h"
#include "rays.h"
#include "scene_file.h"
#include "session.h"
#include "light_shares.h"
#include "status.h"
#include "timing.h"
#include "untrusted.h"

/* Everything that one emission holds. */
typedef struct emit_job {
    session session;
    const char *scene_path, *map_path;
    rt_render_options render;
    rt_emit_options options;
    float *shares;
    size_t share_count;
    rt_scene *scene;
    rt_device *device;
    rt_renderer *renderer;
    rt_photon_map *map;
    map_checkpoint checkpoint;
    input_list inputs;
} emit_job;

static int read_part(emit_job *job)
{
    const option_value *value = session_value(&job->session, OPTION_PART);
    uint32_t part, parts;
    int status = value->given ? part_read(&part, &parts, value->text) : STATUS_DONE;
    if (value->given && status == STATUS_DONE) {
        job->options.part = part - 1;
        job->options.parts = parts;
    }
    return status;
}

/* With --untrusted, gives up the rights that the emission does not need. */
static int confine(const emit_job *job)
{
    static const option_id named[] = {OPTION_CHECKPOINT, OPTION_RESUME, OPTION_PROFILE};
    const char *outputs[4] = {job->map_path};
    size_t count = 1;
    for (size_t i = 0; i < sizeof named / sizeof *named; i++)
        if (session_value(&job->session, named[i])->given)
            outputs[count++] = session_value(&job->session, named[i])->text;
    const untrusted_needs needs = {.scene = job->scene_path,
                                   .also = session_value(&job->session, OPTION_RESUME)->text,
                                   .outputs = outputs,
                                   .output_count = count,
                                   .device = 1};
    if (!session_value(&job->session, OPTION_UNTRUSTED)->given)
        return STATUS_DONE;
    const int status = untrusted_confine(&needs);
    if (status == STATUS_DONE)
        session_catch(&job->session);
    return status;
}

static int read_options(emit_job *job, const command_line *arguments)
{
    int status = photons_output(&job->map_path, arguments, "the photon map", ".rtp");
    int part = read_part(job),
        shares = light_shares_read(&job->shares, &job->share_count, arguments);
    status = status == STATUS_DONE ? part : status;
    status = status == STATUS_DONE ? shares : status;
    job->checkpoint.progress = &job->session.progress;
    /* Before a map is read, which a stranger may have made. */
    if (status == STATUS_DONE)
        status = confine(job);
    return status == STATUS_DONE ? map_checkpoint_plan(&job->checkpoint, &job->options, arguments)
                                 : status;
}

static int load(emit_job *job)
{
    rt_error error;
    int status = scene_file_load(&job->scene, job->scene_path,
                                 job->session.quiet ? SCENE_QUIETLY : SCENE_TO_EMIT, NULL,
                                 &job->inputs, &job->session.progress, job->session.arguments);
    if (status == STATUS_DONE)
        status = inputs_check(&job->inputs, job->map_path);
    if (status == STATUS_DONE && session_value(&job->session, OPTION_PROFILE)->given)
        status = inputs_check(&job->inputs, session_value(&job->session, OPTION_PROFILE)->text);
    if (status != STATUS_DONE)
        return status;
    rt_scene_get_options(job->scene, &job->render);
    session_merge_options(&job->session, &job->render);
    job->render.light_shares = job->shares;
    job->render.light_share_count = job->share_count;
    job->options.render = &job->render;
    /* Options out of range are told before any work. */
    return rt_scene_set_options(job->scene, &job->render, &error) == RT_OK ? STATUS_DONE
                                                                           : session_fail(&error);
}

static void say_interrupted(const emit_job *job)
{
    const map_checkpoint *c = &job->checkpoint;
    if (job->session.quiet)
        return;
    if (c->saved > 0)
        message_note("interrupted; the same command with --resume %s goes on", c->path);
    else
        message_note("interrupted; nothing was written");
}

static int emit(emit_job *job)
{
    rt_renderer_options options = {.hooks = &job->session.hooks};
    const option_value *accel = session_value(&job->session, OPTION_ACCEL);
    rt_error error;
    if (accel->given)
        options.accel = (rt_accel)accel->choice;
    rt_status result =
        rt_renderer_create(&job->renderer, job->scene, job->device, &options, &error);
    if (result == RT_OK) {
        int status = other_work_check_emission(job->map_path, job->renderer, &job->options,
                                               job->session.arguments);
        if (status != STATUS_DONE)
            return status;
    }
    if (result == RT_OK)
        result = rt_photon_map_emit(&job->map, job->renderer, &job->options, &error);
    progress_clear(&job->session.progress);
    if (session_was_interrupted(result)) {
        say_interrupted(job);
        return job->checkpoint.failed ? STATUS_OUTPUT : STATUS_INTERRUPTED;
    }
    return result == RT_OK ? STATUS_DONE : session_fail(&error);
}

static int save(const emit_job *job)
{
    rt_photon_map_info info;
    rt_error error;
    rt_profile *const profile = job->session.arguments->profile;
    rt_profile_begin(profile, "write map");
    const rt_status saved = rt_photon_map_save(job->map, job->map_path, &error);
    rt_profile_end(profile);
    if (saved != RT_OK)
        return session_fail(&error);
    rt_photon_map_get_info(job->map, &info);
    if (!job->session.quiet)
        message_note(
            "wrote %s: %llu photons of %llu paths", job->map_path,
            (unsigned long long)(info.photons[RT_PHOTONS_GLOBAL] +
                                 info.photons[RT_PHOTONS_CAUSTIC] +
                                 info.photons[RT_PHOTONS_VOLUME]),
            (unsigned long long)(info.paths[RT_PHOTONS_GLOBAL] + info.paths[RT_PHOTONS_CAUSTIC]));
    if (!session_value(&job->session, OPTION_STATS)->given)
        return STATUS_DONE;
    if (session_value(&job->session, OPTION_JSON)->given)
        return photons_print_info_json(job->map_path, job->map, job->session.arguments);
    int status = photons_print_info(job->map_path, job->map);
    if (status == STATUS_DONE) {
        rays_print(job->session.arguments, &job->renderer, 1);
        timing_print(job->session.arguments);
    }
    return status;
}

int photons_emit(const command_line *arguments)
{
    emit_job job = {0};
    job.scene_path = arguments->operands[0];
    session_begin(&job.session, arguments);
    if (arguments->options[OPTION_JSON].given && !arguments->options[OPTION_STATS].given &&
        !job.session.quiet)
        message_warning("--json has no effect without --stats");
    int status = read_options(&job, arguments);
    if (status == STATUS_DONE)
        status = load(&job);
    if (status == STATUS_DONE)
        status = session_open_device(&job.session, &job.device,
                                     session_value(&job.session, OPTION_DEVICE)->text);
    if (status == STATUS_DONE)
        status = emit(&job);
    if (status == STATUS_DONE)
        status = save(&job);
    if (status == STATUS_DONE)
        status = timing_write(arguments);
    if (status == STATUS_DONE && job.checkpoint.failed)
        status = STATUS_OUTPUT;
    file_lock_release(&job.checkpoint.lock);
    rt_photon_map_destroy(job.map);
    rt_photon_map_destroy(job.checkpoint.resumed);
    rt_renderer_destroy(job.renderer);
    rt_device_close(job.device);
    rt_scene_destroy(job.scene);
    free(job.shares);
    inputs_free(&job.inputs);
    return status;
}
