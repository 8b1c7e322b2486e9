/* renderer.c - builds the hierarchy and the tables of a scene, and uploads them. */
#include "render/renderer.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "bsdf/lobes.h"
#include "render/enclosing_media.h"
#include "scene/check.h"
#include "scene/parts.h"
#include "scene/view.h"

static int is_rough_diffuse(const rt_material *m)
{
    return rt_material_diffuse_lobe(m) != RT_LOBE_LAMBERT;
}

static int is_rough_specular(const rt_material *m)
{
    return rt_material_is_rough(m) && rt_material_is_specular(m);
}

/* Whether something holds of the material of a shape, or of a part of that. */
static int has_material(const rt_scene *scene, int (*holds)(const rt_material *leaf))
{
    for (size_t i = 0; i < scene->shape_count; i++)
        if (rt_material_any(scene, scene->materials + scene->shapes[i].material, RT_SIDE_BOTH,
                            holds))
            return 1;
    return 0;
}

/* Keeps what later calls need of the scene. */
static void note_scene(rt_renderer *renderer, const rt_scene *scene)
{
    renderer->camera = scene->camera;
    renderer->has_camera = scene->has_camera;
    renderer->has_light = rt_scene_has_light(scene);
    renderer->brightest = rt_scene_brightest(scene);
    renderer->is_dark = rt_scene_is_dark(scene);
    renderer->hidden_caustics = rt_scene_hidden_caustics(scene);
    renderer->has_rough_diffuse = has_material(scene, is_rough_diffuse);
    renderer->has_rough_specular = has_material(scene, is_rough_specular);
    renderer->has_media = rt_scene_has_media(scene);
    renderer->has_grids = rt_scene_has_grids(scene);
    renderer->has_dispersion = rt_scene_has_dispersion(scene);
    renderer->has_shading_normals = rt_scene_has_shading_normals(scene);
    renderer->options = scene->options;
}

/* In the order of RT_PROGRAMS. */
const char *rt_renderer_program(const rt_renderer *renderer,
                                const char *const programs[RT_PROGRAM_KINDS])
{
    enum { ANY, PLAIN, MEDIA, GRIDS, DISPERSIVE, GRIDS_DISPERSIVE };
    if (renderer->has_dispersion)
        return programs[renderer->has_media ? GRIDS_DISPERSIVE : DISPERSIVE];
    return programs[renderer->is_plain    ? PLAIN
                    : renderer->has_grids ? GRIDS
                    : renderer->has_media ? MEDIA
                                          : ANY];
}

static rt_status build(rt_renderer *renderer, const rt_scene *scene, rt_accel accel,
                       rt_stage_progress *progress, rt_error *error)
{
    rt_device *device = renderer->device;
    rt_profile_begin(device->profile, "build");
    rt_status status = rt_scene_pack(&renderer->image, scene, accel, device->width, device->threads,
                                     progress, error);
    renderer->is_plain =
        renderer->image.is_plain && !renderer->has_media && !renderer->has_dispersion;
    rt_profile_end(device->profile);
    return status;
}

/* Finds the media around the camera and the lights. */
static rt_status find_media(rt_renderer *renderer, const rt_scene *scene,
                            rt_stage_progress *progress, rt_error *error)
{
    rt_device *device = renderer->device;
    rt_profile_begin(device->profile, "media");
    rt_status status = rt_enclosing_media_find(device, renderer->scene, scene, progress, error);
    rt_profile_end(device->profile);
    return status;
}

/* Gives the device its copy of the scene; a CPU device works on the host's memory. */
static rt_status upload(rt_renderer *renderer, rt_error *error)
{
    rt_device *device = renderer->device;
    rt_profile_begin(device->profile, "upload");
    rt_status status = rt_mirror_create(device, &renderer->scene, renderer->image.bytes,
                                        renderer->image.data, "the scene", error);
    rt_profile_end(device->profile);
    if (status == RT_OK && !device->info.is_cpu)
        rt_scene_image_free(&renderer->image);
    return status;
}

rt_status rt_renderer_create(rt_renderer **out, const rt_scene *scene, rt_device *device,
                             const rt_renderer_options *options, rt_error *error)
{
    if (rt_is_missing(scene, "scene", error) || rt_is_missing(device, "device", error))
        return RT_ERROR_USAGE;
    static const rt_renderer_options defaults;
    rt_stage_progress progress;

    if (!options)
        options = &defaults;
    if ((unsigned)options->accel > RT_ACCEL_NONE)
        return rt_fail_field(error, RT_ERROR_USAGE, "accel",
                             "there is no acceleration structure %d", (int)options->accel);
    rt_renderer *renderer = calloc(1, sizeof *renderer);
    if (!renderer)
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory for a renderer");
    renderer->device = rt_device_hold(device);
    renderer->image.memory = device->memory;
    note_scene(renderer, scene);

    rt_status status = rt_stage_begin(&progress, options->hooks, RT_STAGE_BUILD);
    if (status == RT_OK)
        status = build(renderer, scene, options->accel, &progress, error);
    if (status == RT_OK)
        status = upload(renderer, error);
    if (status == RT_OK && renderer->image.may_start_in_solids)
        status = find_media(renderer, scene, &progress, error);
    if (status == RT_OK)
        status = rt_stage_end(&progress, &renderer->build_seconds);
    if (status == RT_OK)
        *out = renderer;
    else
        rt_renderer_destroy(renderer);
    return status == RT_CANCELLED ? rt_fail(error, RT_CANCELLED, "cancelled") : status;
}

void rt_renderer_destroy(rt_renderer *renderer)
{
    if (!renderer)
        return;
    rt_device_settle(renderer->device);
    rt_buffer_release(renderer->device, renderer->scene);
    rt_scene_image_free(&renderer->image);
    rt_device_close(renderer->device);
    free(renderer);
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
    p.gather_alpha = options->gather_roughness;
    p.split = 1;
    p.roulette_depth = options->roulette_depth;
    p.roulette_threshold = options->roulette_threshold;
    return p;
}

rt_status rt_renderer_aim(rt_renderer *renderer, const rt_render_options *options, rt_error *error)
{
    rt_camera_data camera;
    rt_view_aim(&camera, &renderer->camera, options->width, options->height);
    camera.filter = options->filter;
    camera.filter_radius = options->filter_radius;
    return rt_buffer_write(renderer->device, renderer->scene, offsetof(rt_scene_header, camera),
                           sizeof camera, &camera, error);
}
