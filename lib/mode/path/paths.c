/*
 * paths.c - rt_paths_trace: the paths of a pixel with their vertices, by the kernel paths.cl. How
 * many vertices a path has is known when it ends: one that has more than there is room for is
 * followed again, with more room.
 */
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "render/compile.h"
#include "render/prepare.h"
#include "render/renderer.h"
#include "setting/options.h"

enum {
    first_capacity = 32,       /* vertices of a path; most are shorter */
    vertices_at_once = 1 << 17 /* in a launch, 18 MiB */
};

struct rt_paths {
    rt_camera_path *paths;
    rt_path_vertex *vertices;
    size_t path_count, vertex_count, vertex_room;
};

/* One call. */
typedef struct trace {
    rt_device *device;
    cl_mem scene;
    const char *program;
    cl_kernel kernel;
    rt_params params;
    rt_record_params query;
    rt_paths *paths;
} trace;

const char *rt_path_event_name(rt_path_event event)
{
    static const rt_word words[] = {RT_PATH_EVENTS(RT_WORD) RT_WORD_END};
    for (const rt_word *word = words; word->name; word++)
        if (word->value == (int)event)
            return word->name;
    return "";
}

/* ---- What is asked for ----------------------------------------------------------------------- */

static rt_status check_settings(const rt_render_options *o, rt_error *error)
{
    rt_status status = rt_options_check(o, error);
    if (status != RT_OK)
        return status;
    if (o->mode != RT_MODE_PATH)
        return rt_fail_field(error, RT_ERROR_USAGE, "mode",
                             "the paths are those of mode path, not of mode %s",
                             rt_mode_name(o->mode));
    if (o->variance || o->target_error > 0)
        return rt_fail_field(error, RT_ERROR_USAGE, o->variance ? "variance" : "target_error",
                             "the paths are those of a render that does not estimate its error");
    return RT_OK;
}

/* The samples that a count stands for: 0: those of a render without a limit of time. */
static uint32_t samples_of(const rt_render_options *options, uint32_t first, uint32_t count)
{
    rt_render_options o = *options;
    if (count > 0)
        return count;
    o.time = 0;
    rt_options_complete(&o);
    const uint32_t left = o.spp > first ? o.spp - first : 0;
    return left < RT_PATHS_MAX ? left : RT_PATHS_MAX;
}

static rt_status check_samples(const rt_render_options *o, uint32_t x, uint32_t y, uint32_t first,
                               uint32_t count, rt_error *error)
{
    if (x >= o->width || y >= o->height)
        return rt_fail_field(error, RT_ERROR_USAGE, "pixel",
                             "there is no pixel %u,%u in a picture of %u x %u", x, y, o->width,
                             o->height);
    if (count > RT_PATHS_MAX)
        return rt_fail_field(error, RT_ERROR_USAGE, "count", "%u samples; %u can be traced", count,
                             RT_PATHS_MAX);
    if (count == 0 || first > UINT32_MAX - count)
        return rt_fail_field(error, RT_ERROR_USAGE, "first", "there is no sample %u", first);
    return RT_OK;
}

/* ---- The kernel ------------------------------------------------------------------------------ */

/* Compiles the kernel, as a stage. */
static rt_status prepare(trace *t, const rt_hooks *hooks, rt_error *error)
{
    const cl_mem none = NULL;
    const rt_arg args[] = {RT_ARG(t->params), RT_ARG(t->scene), RT_ARG(t->query), RT_ARG(none),
                           RT_ARG(none)};
    rt_program_list programs = {0};
    rt_stage_progress progress;
    rt_program_list_add(&programs, t->program);
    rt_status status = rt_stage_begin(&progress, hooks, RT_STAGE_COMPILE);
    if (status == RT_OK)
        status = rt_programs_compile(t->device, &programs, &progress);
    if (status == RT_OK)
        status = rt_kernel_prepare(t->device, &t->kernel, t->program, "paths", args, 5, &progress,
                                   error);
    return status == RT_OK ? rt_stage_end(&progress, NULL) : status;
}

/* ---- Following them -------------------------------------------------------------------------- */

/* Follows the paths from `first` on into the two buffers. */
static rt_status launch(trace *t, cl_mem paths, cl_mem vertices, uint32_t first, uint32_t count,
                        rt_error *error)
{
    t->params.first_sample = first;
    t->params.item_count = count;
    rt_arg args[] = {RT_ARG(t->params), RT_ARG(t->scene), RT_ARG(t->query), RT_ARG(paths),
                     RT_ARG(vertices)};
    rt_status status = rt_kernel_args(t->kernel, args, 5, error);
    return status == RT_OK ? rt_launch(t->device, t->kernel, count, error) : status;
}

/* Room for the vertices of `count` more paths. */
static rt_status reserve(rt_paths *paths, const rt_camera_path *more, uint32_t count,
                         rt_error *error)
{
    size_t needed = paths->vertex_count;
    for (uint32_t i = 0; i < count; i++)
        needed += more[i].vertex_count;
    if (needed <= paths->vertex_room)
        return RT_OK;
    const size_t room = needed + needed / 2;
    rt_path_vertex *larger = realloc(paths->vertices, room * sizeof *larger);
    if (!larger)
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory for %zu vertices of paths", room);
    paths->vertices = larger;
    paths->vertex_room = room;
    return RT_OK;
}

/* Reads the vertices of the paths that were followed last, and puts them behind the others. */
static rt_status take_vertices(trace *t, cl_mem vertices, uint32_t count, rt_error *error)
{
    rt_paths *paths = t->paths;
    rt_camera_path *more = paths->paths + paths->path_count;
    const size_t capacity = t->query.capacity, size = sizeof *paths->vertices;
    rt_status status = reserve(paths, more, count, error);
    if (status != RT_OK)
        return status;
    /* With the room that is left: a transfer for each path would take far longer. */
    rt_path_vertex *read = malloc(count * capacity * size);
    if (!read)
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory for %zu vertices of paths",
                       count * capacity);
    status = rt_buffer_read(t->device, vertices, 0, count * capacity * size, read, error);
    for (uint32_t i = 0; i < count && status == RT_OK; i++) {
        memcpy(paths->vertices + paths->vertex_count, read + i * capacity,
               more[i].vertex_count * size);
        more[i].first_vertex = (rt_u32)paths->vertex_count;
        paths->vertex_count += more[i].vertex_count;
    }
    free(read);
    if (status == RT_OK)
        paths->path_count += count;
    return status;
}

/* Follows some paths; where there is too little room, makes it larger and takes none of them. */
static rt_status trace_some(trace *t, uint32_t first, uint32_t count, rt_error *error)
{
    cl_mem paths = NULL, vertices = NULL;
    rt_camera_path *read = t->paths->paths + t->paths->path_count;
    uint32_t most = 0;
    rt_status status = rt_buffer_create(t->device, &paths, CL_MEM_WRITE_ONLY, count * sizeof *read,
                                        NULL, "the buffer of paths", error);
    if (status == RT_OK)
        status = rt_buffer_create(t->device, &vertices, CL_MEM_WRITE_ONLY,
                                  (size_t)count * t->query.capacity * sizeof(rt_path_vertex), NULL,
                                  "the buffer of vertices", error);
    if (status == RT_OK)
        status = launch(t, paths, vertices, first, count, error);
    if (status == RT_OK)
        status = rt_buffer_read(t->device, paths, 0, count * sizeof *read, read, error);
    for (uint32_t i = 0; i < count && status == RT_OK; i++)
        most = read[i].vertex_count > most ? read[i].vertex_count : most;
    if (status == RT_OK && most > t->query.capacity)
        t->query.capacity = most;
    else if (status == RT_OK)
        status = take_vertices(t, vertices, count, error);
    rt_buffer_release(t->device, paths);
    rt_buffer_release(t->device, vertices);
    return status;
}

static rt_status trace_all(trace *t, uint32_t first, uint32_t count, const rt_hooks *hooks,
                           rt_error *error)
{
    rt_stage_progress progress;
    rt_status status = rt_stage_begin(&progress, hooks, RT_STAGE_RENDER);
    while (t->paths->path_count < count && status == RT_OK) {
        const uint32_t done = (uint32_t)t->paths->path_count, left = count - done;
        const uint32_t room = vertices_at_once / t->query.capacity;
        status = trace_some(t, first + done, left < room ? left : room > 0 ? room : 1, error);
        if (status == RT_OK)
            status = rt_stage_update(&progress, (double)t->paths->path_count / count);
    }
    return status == RT_OK ? rt_stage_end(&progress, NULL) : status;
}

rt_status rt_paths_trace(rt_paths **out, rt_renderer *renderer, const rt_render_options *options,
                         uint32_t x, uint32_t y, uint32_t first, uint32_t count, rt_error *error)
{
    if (rt_is_missing(renderer, "renderer", error))
        return RT_ERROR_USAGE;
    rt_render_options o = options ? *options : renderer->options;
    trace t = {.device = renderer->device, .scene = renderer->scene};
    rt_status status = check_settings(&o, error);
    if (status != RT_OK)
        return status;
    count = samples_of(&o, first, count);
    rt_options_complete(&o);
    status = check_samples(&o, x, y, first, count, error);
    if (status == RT_OK && !renderer->has_camera)
        status = rt_fail(error, RT_ERROR_INPUT,
                         "the scene has no camera, such as camera { eye 0 0 5  look_at 0 0 0 }");
    if (status == RT_OK && renderer->has_media)
        status = rt_fail(error, RT_ERROR_USAGE,
                         "the scene has media that scatter, or interfaces, whose paths are not "
                         "recorded");
    if (status != RT_OK)
        return status;

    t.program = renderer->has_dispersion ? "paths_dispersive" : "paths";
    t.params = rt_params_make(&o);
    t.query = (rt_record_params){.x = x, .y = y, .capacity = first_capacity};
    t.paths = calloc(1, sizeof *t.paths);
    if (t.paths)
        t.paths->paths = malloc(count * sizeof *t.paths->paths);
    if (!t.paths || !t.paths->paths)
        status = rt_fail(error, RT_ERROR_MEMORY, "out of memory for %u paths", count);
    if (status == RT_OK)
        status = rt_renderer_aim(renderer, &o, error);
    if (status == RT_OK)
        status = prepare(&t, o.hooks, error);
    if (status == RT_OK)
        status = trace_all(&t, first, count, o.hooks, error);
    rt_kernel_release(t.kernel);
    if (status == RT_OK)
        *out = t.paths;
    else
        rt_paths_destroy(t.paths);
    return status;
}

void rt_paths_destroy(rt_paths *paths)
{
    if (!paths)
        return;
    free(paths->paths);
    free(paths->vertices);
    free(paths);
}

const rt_camera_path *rt_paths_list(const rt_paths *paths, size_t *count)
{
    *count = paths->path_count;
    return paths->paths;
}

const rt_path_vertex *rt_paths_vertices(const rt_paths *paths, size_t *count)
{
    *count = paths->vertex_count;
    return paths->vertices;
}
