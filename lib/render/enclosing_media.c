/* enclosing_media.c - runs the kernel enclosing_media for the camera and each light. */
#include "render/enclosing_media.h"

#include <math.h>
#include <string.h>

#include "base/error.h"
#include "light/lights.h"
#include "render/prepare.h"
#include "scene/inside.h"
#include "scene/shape_class.h"
#include "types.h"

/* The direction of the ray that the kernel follows, before it is made a unit vector. */
static const double direction[3] = {0.3017, 0.8731, 0.3829};

/* Pairs of a source and a solid; where there are more, the kernel is the quicker answer. */
enum { PAIRS_MAX = 1 << 20 };

/* A box in which paths start: the eye, a delta light, or all of an emissive shape. */
typedef struct source {
    const float *lo, *hi;
} source;

/* Whether a ray that leaves the origin in that direction meets a box. */
static int is_met(const double lo[3], const double hi[3])
{
    double near = 0, far = INFINITY;
    for (int i = 0; i < 3; i++) {
        near = fmax(near, lo[i] / direction[i]);
        far = fmin(far, hi[i] / direction[i]);
    }
    return near <= far;
}

/* Whether a surface is closed by itself; of meshes that is not known. */
static int is_closed(const rt_scene *scene, const rt_scene_shape *shape)
{
    const rt_shape_class *class = rt_shape_class_of(shape->kind);
    if (class->storage != RT_STORED_ANALYTIC)
        return 0;
    const rt_shape_boundary boundary = class->boundary(scene, shape);
    return boundary == RT_BOUNDARY_SOLID || boundary == RT_BOUNDARY_CURVED_CLOSED;
}

/*
 * Whether a path that starts somewhere in the source may start in the solid, as the kernel decides
 * it: by a ray that comes out of the solid more often than it goes in. None does that misses the
 * bounds, or that starts outside of them where the surface is closed.
 */
static int may_enclose(const rt_scene_shape *solid, source from, const rt_scene *scene)
{
    const rt_shape_class *class = rt_shape_class_of(solid->kind);
    if (class->storage == RT_STORED_INFINITE)
        return 1;
    double lo[3], hi[3], margin = 0;
    int is_outside = 0;
    for (int i = 0; i < 3; i++)
        margin = fmax(margin, fmax(fmax(fabs(solid->lo[i]), fabs(solid->hi[i])),
                                   fmax(fabs(from.lo[i]), fabs(from.hi[i]))));
    margin *= 1e-4;
    for (int i = 0; i < 3; i++) {
        lo[i] = (double)solid->lo[i] - from.hi[i] - margin;
        hi[i] = (double)solid->hi[i] - from.lo[i] + margin;
        is_outside |= lo[i] > 0 || hi[i] < 0;
    }
    return is_met(lo, hi) && !(is_outside && is_closed(scene, solid));
}

static int is_solid(const rt_scene *scene, const rt_scene_shape *shape)
{
    return rt_material_is_transparent(scene->materials + shape->material);
}

static int any_encloses(const rt_scene *scene, source from)
{
    for (size_t i = 0; i < scene->shape_count; i++)
        if (is_solid(scene, scene->shapes + i) && may_enclose(scene->shapes + i, from, scene))
            return 1;
    return 0;
}

/* Whether there are so many pairs that looking at them would take longer than the kernel. */
static int are_too_many(const rt_scene *scene)
{
    size_t solids = 0, sources = 1 + scene->light_count;
    for (size_t i = 0; i < scene->shape_count; i++) {
        solids += is_solid(scene, scene->shapes + i);
        sources += scene->shapes[i].emission != RT_NONE;
    }
    return solids > 0 && sources > PAIRS_MAX / solids;
}

int rt_enclosing_media_are_possible(const rt_scene *scene)
{
    if (are_too_many(scene) || any_encloses(scene, (source){scene->camera.eye, scene->camera.eye}))
        return 1;
    for (size_t i = 0; i < scene->light_count; i++) {
        const rt_scene_light *light = scene->lights + i;
        if ((light->kind == RT_LIGHT_POINT || light->kind == RT_LIGHT_SPOT) &&
            any_encloses(scene, (source){light->position, light->position}))
            return 1;
    }
    for (size_t i = 0; i < scene->shape_count; i++) {
        const rt_scene_shape *shape = scene->shapes + i;
        if (shape->emission != RT_NONE && any_encloses(scene, (source){shape->lo, shape->hi}))
            return 1;
    }
    return 0;
}

rt_status rt_enclosing_media_find(rt_device *device, cl_mem image, const rt_scene *scene,
                                  rt_stage_progress *progress, rt_error *error)
{
    float eye[4] = {scene->camera.eye[0], scene->camera.eye[1], scene->camera.eye[2], 0};
    cl_kernel kernel = NULL;
    rt_params params;

    memset(&params, 0, sizeof params);
    rt_arg args[] = {RT_ARG(params), RT_ARG(image), RT_ARG(eye)};
    rt_status status = rt_kernel_prepare(device, &kernel, "enclosing_media", "enclosing_media",
                                         args, 3, progress, error);
    if (status != RT_OK)
        return status;
    params.item_count = (rt_u32)rt_lights_count(scene) + 1;
    status = rt_kernel_args(kernel, args, 3, error);
    if (status == RT_OK)
        status = rt_launch(device, kernel, params.item_count, error);
    if (status == RT_OK)
        status = rt_device_finish(device, error);
    rt_kernel_release(kernel);
    return status;
}
