/* render.c - rt_render: completes the options, aims the camera, runs the mode. */
#include <math.h>
#include <stddef.h>
#include <string.h>

#include "error.h"
#include "image/bytes.h"
#include "render/noise.h"
#include "render/renderer.h"
#include "scene/scene.h"
#include "scene/vec.h"

static const double pi = 3.14159265358979323846;

/* Replaces zeros by the defaults that the public header states. */
void rt_options_complete(rt_render_options *o)
{
    if (o->width == 0)
        o->width = 512;
    if (o->height == 0)
        o->height = 512;
    if (o->passes == 0)
        o->passes = 1;
    if (o->alpha == 0)
        o->alpha = 2 / 3.0f;
    if (o->spp == 0 && o->mode == RT_MODE_PHOTON && o->passes > 1)
        o->spp = 1;
    if (o->spp == 0)
        o->spp = o->time > 0 || o->target_error > 0 ? RT_SPP_MAX : o->mode == RT_MODE_PHOTON ? 16 : 64;
    if (o->max_depth == 0)
        o->max_depth = 16;
    if (o->photons == 0)
        o->photons = o->passes > 1 ? (uint64_t)o->width * o->height : 1000000;
    if (o->k == 0)
        o->k = 50;
    if (o->cone_k == 0)
        o->cone_k = 1.1f;
    if (o->caustic_k == 0)
        o->caustic_k = o->k;
    if (o->caustic_radius == 0)
        o->caustic_radius = o->radius;
}

static void scale(float out[3], const double v[3], double factor)
{
    for (int i = 0; i < 3; i++)
        out[i] = (float)(v[i] * factor);
}

/* Half the width of what is seen at the focal distance. */
static double half_width_of(const rt_camera *camera)
{
    if (camera->kind == RT_CAMERA_ORTHOGRAPHIC)
        return 0.5 * camera->width;
    return camera->focal_distance * tan(0.5 * camera->fov * pi / 180);
}

/* The camera's rays for a film of these proportions; pixels are square. */
static void aim(rt_camera_data *out, const rt_camera *camera, const rt_render_options *options)
{
    static const float origin[3];
    double axis[3], right[3], up[3], corner[3];
    double half_width = half_width_of(camera), half_height = half_width * options->height / options->width;
    double depth = camera->kind == RT_CAMERA_ORTHOGRAPHIC ? 0 : camera->focal_distance;

    rt_vec_sub(axis, camera->look_at, camera->eye);
    rt_vec_sub(up, camera->up, origin);
    double length = rt_vec_length(axis);
    for (int i = 0; i < 3; i++)
        axis[i] /= length;
    rt_vec_cross(right, axis, up);
    length = rt_vec_length(right);
    for (int i = 0; i < 3; i++)
        right[i] /= length;
    rt_vec_cross(up, right, axis);
    for (int i = 0; i < 3; i++)
        corner[i] = depth * axis[i] - half_width * right[i] + half_height * up[i];

    memset(out, 0, sizeof *out);
    memcpy(out->eye, camera->eye, sizeof out->eye);
    out->aperture = camera->aperture;
    out->kind = camera->kind;
    out->blades = camera->blades;
    out->blade_rotation = (float)(fmod(camera->blade_rotation, 360) * pi / 180);
    out->focal_distance = camera->focal_distance;
    out->filter = options->filter;
    scale(out->corner, corner, 1);
    scale(out->across, right, 2 * half_width);
    scale(out->down, up, -2 * half_height);
    scale(out->lens_u, right, 1);
    scale(out->lens_v, up, 1);
    scale(out->axis, axis, 1);
}

const char *rt_mode_name(rt_mode mode)
{
    static const char *const names[] = {"path", "photon", "direct", "normals", "albedo", "depth"};
    return (unsigned)mode < sizeof names / sizeof *names ? names[mode] : "unknown";
}

rt_params rt_params_make(const rt_render_options *options)
{
    rt_params p;
    memset(&p, 0, sizeof p);
    p.width = options->width;
    p.height = options->height;
    p.seed = options->seed;
    p.sampler = options->sampler;
    p.max_depth = options->max_depth;
    p.final_gather = options->final_gather;
    p.direct = options->direct;
    p.estimator = options->estimator;
    return p;
}

/* A kernel being prepared on a thread of its own. What it logs is kept, for hooks are called by the caller's thread. */
typedef struct preparation {
    rt_device *device;
    const char *program, *kernel;
    const rt_arg *args;
    cl_uint count;
    cl_kernel made;
    rt_bytes log; /* lines, each with its closing zero */
    rt_error *error;
} preparation;

static void keep_line(void *user, const char *line)
{
    preparation *p = user;
    /* Without memory a line of the log is lost, nothing else. */
    rt_bytes_put(&p->log, p->log.size, line, strlen(line) + 1, NULL);
}

static rt_status prepare(void *data)
{
    preparation *p = data;
    rt_params none;
    rt_arg first = {sizeof none, &none};
    rt_hooks hooks = {.log = keep_line, .user = p};

    memset(&none, 0, sizeof none);
    rt_status status = rt_device_kernel(p->device, &p->made, p->program, p->kernel, &hooks, p->error);
    if (status == RT_OK)
        status = rt_kernel_args(p->made, p->args, p->count, p->error);
    if (status == RT_OK)
        status = rt_kernel_args(p->made, &first, 1, p->error);
    if (status == RT_OK)
        status = rt_launch(p->device, p->made, 1, p->error);
    return status == RT_OK ? rt_device_finish(p->device, p->error) : status;
}

rt_status rt_kernel_prepare(rt_device *device, cl_kernel *out, const char *program, const char *kernel,
                            const rt_arg *args, cl_uint count, rt_stage_progress *progress, rt_error *error)
{
    preparation p = {device, program, kernel, args, count, NULL, {0}, error};
    rt_status status = rt_stage_run(progress, prepare, &p);
    for (size_t at = 0; at < p.log.size; at += strlen((const char *)p.log.data + at) + 1)
        rt_log(progress->hooks, "%s", (const char *)p.log.data + at);
    rt_bytes_free(&p.log);
    if (status == RT_OK)
        *out = p.made;
    else
        rt_kernel_release(p.made);
    return status;
}

rt_status rt_render(rt_film **out, rt_renderer *renderer, const rt_render_options *options, rt_error *error)
{
    rt_render_options complete = options ? *options : renderer->options;
    rt_camera_data camera;
    rt_film *film = NULL;
    rt_status status = rt_options_check(&complete, error);

    if (status != RT_OK)
        return status;
    *out = NULL;
    if (!renderer->has_camera)
        return rt_fail(error, RT_ERROR_INPUT, "the scene has no camera");
    rt_options_complete(&complete);
    status = rt_noise_check(&complete, error);
    if (status != RT_OK)
        return status;
    aim(&camera, &renderer->camera, &complete);
    status = rt_buffer_write(renderer->device, renderer->scene, offsetof(rt_scene_header, camera), sizeof camera,
                             &camera, error);
    if (status == RT_OK)
        status = rt_film_create(&film, &complete, error);
    if (status == RT_OK && rt_noise_wanted(&complete))
        status = rt_noise_create(&film->noise, (size_t)complete.width * complete.height, error);
    if (status != RT_OK) {
        rt_film_destroy(film);
        return status;
    }

    film->stats.build_seconds = renderer->build_seconds;
    film->stats.light_power = renderer->image.light_power;
    status = complete.mode == RT_MODE_PHOTON ? rt_render_photon(renderer, &complete, film, error)
                                             : rt_render_samples(renderer, &complete, film, error);
    if (status == RT_OK || status == RT_CANCELLED) {
        rt_status resolved = rt_film_resolve(film, error);
        status = resolved == RT_OK ? status : resolved;
    }
    int keep = status == RT_OK || (status == RT_CANCELLED && film->stats.spp > 0);
    if (keep)
        *out = film;
    else
        rt_film_destroy(film);
    return status == RT_CANCELLED ? rt_fail(error, RT_CANCELLED, "cancelled") : status;
}
