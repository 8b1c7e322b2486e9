/* crew.c - opens devices, and renders on several at once: a thread each, and one list of work. */
#include "crew.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "interrupt.h"
#include "message.h"
#include "status.h"

/* ---- Devices -------------------------------------------------------------------- */

/* Whether a text is a list of numbers, as 0,1,2. */
static int is_list(const char *text)
{
    return text && strchr(text, ',') && strspn(text, "0123456789,") == strlen(text);
}

/* How many devices --device names. */
static int count_devices(size_t *out, const char *text)
{
    rt_device_info *devices = NULL;
    rt_error error;
    *out = 1;
    if (text && strcmp(text, "all") == 0) {
        if (rt_devices_list(&devices, out, &error) != RT_OK)
            return message_failure(&error);
        rt_devices_free(devices);
        return STATUS_DONE;
    }
    for (const char *c = text; is_list(text) && *c; c++)
        *out += *c == ',';
    return STATUS_DONE;
}

/* The name of device i of a list. */
static void name_device(char *out, size_t size, const char *text, size_t i)
{
    if (strcmp(text, "all") == 0) {
        snprintf(out, size, "%zu", i);
        return;
    }
    for (; i > 0; i--)
        text = strchr(text, ',') + 1;
    snprintf(out, size, "%.*s", (int)strcspn(text, ","), text);
}

/* Refuses lists with a gap, and devices that would wait for themselves. */
static int check_list(const char *text, size_t count)
{
    char a[32], b[32];
    for (size_t i = 0; i < count; i++) {
        name_device(a, sizeof a, text, i);
        if (!a[0]) {
            message_error("--device takes numbers with a comma between two, as in 0,1; not '%s'",
                          text);
            return STATUS_USAGE;
        }
        for (size_t j = 0; j < i; j++) {
            name_device(b, sizeof b, text, j);
            if (strtoul(a, NULL, 10) == strtoul(b, NULL, 10)) {
                message_error("--device %s names device %s twice", text, a);
                return STATUS_USAGE;
            }
        }
    }
    return STATUS_DONE;
}

static int reserve(crew *out, size_t count)
{
    out->devices = calloc(count, sizeof *out->devices);
    out->renderers = calloc(count, sizeof *out->renderers);
    if (out->devices && out->renderers)
        return STATUS_DONE;
    message_error("out of memory");
    return STATUS_DEVICE;
}

int crew_open(crew *out, const session *session)
{
    const char *text = session_value(session, OPTION_DEVICE)->text;
    const team *team = session->arguments->team;
    const int is_many = text && (is_list(text) || strcmp(text, "all") == 0);
    size_t count, first = 0;
    int status = count_devices(&count, text);
    if (status == STATUS_DONE && is_many)
        status = check_list(text, count);
    if (status == STATUS_DONE)
        status = reserve(out, count);
    if (team) {
        first = team->number % count;
        count = 1;
    }
    for (; out->count < count && status == STATUS_DONE; out->count++) {
        char name[32];
        if (is_many)
            name_device(name, sizeof name, text, first + out->count);
        status = session_open_device(session, out->devices + out->count, is_many ? name : text);
        if (status != STATUS_DONE)
            break;
    }
    return status;
}

rt_status crew_prepare(crew *crew, const rt_scene *scene, const rt_renderer_options *options,
                       rt_error *error)
{
    rt_status status = RT_OK;
    for (size_t i = 0; i < crew->count && status == RT_OK; i++)
        status = rt_renderer_create(crew->renderers + i, scene, crew->devices[i], options, error);
    return status;
}

void crew_forget(crew *crew)
{
    for (size_t i = 0; i < crew->count; i++) {
        rt_renderer_destroy(crew->renderers[i]);
        crew->renderers[i] = NULL;
    }
}

void crew_close(crew *crew)
{
    crew_forget(crew);
    for (size_t i = 0; i < crew->count; i++)
        rt_device_close(crew->devices[i]);
    free(crew->devices);
    free(crew->renderers);
    memset(crew, 0, sizeof *crew);
}

static rt_status fail_memory(rt_error *error)
{
    *error = (rt_error){.status = RT_ERROR_MEMORY, .message = "out of memory"};
    return RT_ERROR_MEMORY;
}

/* ---- A thread for each device ----------------------------------------------------- */

/* What a device does on its thread. */
typedef struct job {
    rt_share *share; /* NULL: emits a part of the map */
    rt_renderer *renderer;
    rt_render_options options; /* with hooks of its own */
    uint32_t part, parts;      /* of the map */
    rt_photon_map *map;
    rt_status status;
    rt_error error;
    pthread_t thread;
    int is_running;
} job;

static void *work(void *data)
{
    job *j = data;
    const rt_emit_options emit = {.render = &j->options, .part = j->part, .parts = j->parts};
    j->status = j->share ? rt_share_render(j->share, j->renderer, j->options.hooks, &j->error)
                         : rt_photon_map_emit(&j->map, j->renderer, &emit, &j->error);
    return NULL;
}

/* Of the threads beside the first, nothing is shown. */
static int on_progress(void *user, const rt_progress *progress)
{
    (void)user;
    (void)progress;
    return interrupt_pending();
}

/* Does all jobs, the first one on this thread. Returns the first failure. */
static rt_status do_all(job *jobs, size_t count, rt_error *error)
{
    rt_status status = RT_OK;
    for (size_t i = 1; i < count; i++) {
        jobs[i].is_running = pthread_create(&jobs[i].thread, NULL, work, jobs + i) == 0;
        if (!jobs[i].is_running)
            work(jobs + i);
    }
    work(jobs);
    for (size_t i = 0; i < count; i++) {
        if (jobs[i].is_running)
            pthread_join(jobs[i].thread, NULL);
        if (jobs[i].status != RT_OK && (status == RT_OK || status == RT_CANCELLED)) {
            status = jobs[i].status;
            *error = jobs[i].error;
        }
    }
    return status;
}

int crew_emits(const rt_render_options *options)
{
    return options->mode == RT_MODE_PHOTON && options->passes < 2 && !options->photon_map;
}

/* Emits the map of a render without passes, a part on each device. */
static rt_status emit(rt_photon_map **out, job *jobs, size_t count, rt_error *error)
{
    const rt_photon_map **maps = calloc(count, sizeof *maps);
    if (!maps)
        return fail_memory(error);
    rt_status status = do_all(jobs, count, error);
    for (size_t i = 0; i < count; i++)
        maps[i] = jobs[i].map;
    if (status == RT_OK)
        status = rt_photon_map_merge(out, maps, count, error);
    for (size_t i = 0; i < count; i++)
        rt_photon_map_destroy(jobs[i].map);
    free(maps);
    return status;
}

/* Shares the picture among the devices. */
static rt_status render(rt_film **out, job *jobs, size_t count, const rt_render_options *options,
                        rt_error *error)
{
    rt_share *share = NULL;
    rt_error failure;
    rt_status status = rt_share_create(&share, jobs[0].renderer, options, error);
    if (status != RT_OK)
        return status;
    for (size_t i = 0; i < count; i++)
        jobs[i].share = share;
    rt_status rendered = do_all(jobs, count, &failure);
    status = rt_share_finish(out, share, options->hooks, error);
    if (rendered != RT_OK && rendered != RT_CANCELLED) {
        rt_film_destroy(*out);
        *out = NULL;
        *error = failure;
        status = rendered;
    }
    rt_share_destroy(share);
    return status;
}

/* A job for each device; hooks of the first one show what happens. */
static job *make_jobs(const crew *crew, const rt_render_options *options, const rt_hooks *first)
{
    static const rt_hooks silent = {.progress = on_progress};
    job *jobs = calloc(crew->count, sizeof *jobs);
    for (size_t i = 0; jobs && i < crew->count; i++) {
        jobs[i].renderer = crew->renderers[i];
        jobs[i].options = *options;
        jobs[i].options.hooks = i == 0 ? first : &silent;
        jobs[i].part = (uint32_t)i;
        jobs[i].parts = (uint32_t)crew->count;
    }
    return jobs;
}

static rt_status render_on_all(rt_film **out, const crew *crew, const rt_render_options *options,
                               rt_error *error)
{
    rt_render_options o = *options;
    rt_hooks first = options->hooks ? *options->hooks : (rt_hooks){0};
    rt_photon_map *map = NULL;
    rt_status status = RT_OK;
    job *jobs = make_jobs(crew, options, &first);
    if (!jobs)
        return fail_memory(error);
    if (crew_emits(options)) {
        first.warning = NULL; /* a part has fewer photons than the map */
        status = emit(&map, jobs, crew->count, error);
        first.warning = options->hooks ? options->hooks->warning : NULL;
        o.photon_map = map;
    }
    if (status == RT_OK)
        status = render(out, jobs, crew->count, &o, error);
    rt_photon_map_destroy(map);
    free(jobs);
    return status;
}

rt_status crew_render(rt_film **out, const crew *crew, const rt_render_options *options,
                      const team *team, rt_error *error)
{
    if (team)
        return team->render(team->user, out, crew->renderers[0], options, error);
    return crew->count == 1 ? rt_render(out, crew->renderers[0], options, error)
                            : render_on_all(out, crew, options, error);
}
