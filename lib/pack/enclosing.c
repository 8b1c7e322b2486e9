/*
 * enclosing.c - which paths may start inside of solids, as the bounds of shapes tell: where none
 * does, nobody has to look for the solids (kernels/enclosing_media.cl), and where solids are around
 * all of a light, or around none of it, they are looked for once.
 */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "pack/packing.h"
#include "scene/inside.h"
#include "scene/shape_class.h"

/* The direction of the ray that finds the solids, before it is made a unit vector. */
static const double direction[3] = {0.3017, 0.8731, 0.3829};

/* Pairs of a place and a solid; where there are more, every light counts as partly in a solid. */
enum { PAIRS_MAX = 1 << 24 };

/*
 * Bounds that paths start in: of the eye, of a delta light with room for rounding, of all of an
 * emissive shape.
 */
typedef struct place {
    const float *lo, *hi;
    const rt_scene_shape *shape; /* NULL for a point */
    double margin;               /* for the rounding of the kernel, m */
} place;

/* A transparent shape. */
typedef struct solid {
    const rt_scene_shape *shape;
    double margin; /* as of a place */
    int is_infinite, is_closed;
} solid;

typedef struct solids {
    const rt_scene *scene;
    solid *of;
    size_t count;
    int are_too_many; /* to look at each for each place */
} solids;

/* How much of a place may lie in solids: what is more stands later. */
typedef enum amount { NOTHING, ALL, PART } amount;

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

static int is_solid(const rt_scene *scene, const rt_scene_shape *shape)
{
    return rt_material_is_transparent(scene->materials + shape->material);
}

static double margin_of(const float lo[3], const float hi[3])
{
    double largest = 0;
    for (int i = 0; i < 3; i++)
        largest = fmax(largest, fmax(fabs(lo[i]), fabs(hi[i])));
    return 1e-4 * largest;
}

static place make_place(const float lo[3], const float hi[3], const rt_scene_shape *shape)
{
    return (place){lo, hi, shape, margin_of(lo, hi)};
}

static int is_convex(const solid *of)
{
    return of->is_closed && !(rt_shape_class_of(of->shape->kind)->faces & RT_FACES_TORUS);
}

/*
 * Whether a path that starts somewhere in a place may start in the solid, as the kernel decides it:
 * by a ray that comes out of the solid more often than it goes in. None does that misses the
 * bounds, or that starts outside of them where the surface is closed.
 */
static int may_enclose(const solid *by, const place *of)
{
    const double margin = by->margin + of->margin;
    double lo[3], hi[3];
    for (int i = 0; i < 3; i++) {
        lo[i] = (double)by->shape->lo[i] - of->hi[i] - margin;
        hi[i] = (double)by->shape->hi[i] - of->lo[i] + margin;
        if (by->is_closed && (lo[i] > 0 || hi[i] < 0))
            return 0;
    }
    return is_met(lo, hi);
}

/* How much of a place may lie in the half-space behind a plane. */
static amount behind_plane(const rt_scene *scene, const rt_scene_shape *plane, const place *of)
{
    const float *point = rt_scene_parameters(scene, plane), *normal = point + 4;
    const double margin = of->margin + margin_of(point, point);
    double lowest = 0, highest = 0; /* heights over the plane */
    for (int i = 0; i < 3; i++) {
        const double a = normal[i] * ((double)of->lo[i] - point[i]),
                     b = normal[i] * ((double)of->hi[i] - point[i]);
        lowest += fmin(a, b);
        highest += fmax(a, b);
    }
    return lowest > margin ? NOTHING : highest < -margin ? ALL : PART;
}

/* How much of a place may lie in one solid. A closed shape has all its starts outside of itself. */
static amount enclosed_by(const rt_scene *scene, const solid *by, const place *of)
{
    if (by->is_infinite)
        return behind_plane(scene, by->shape, of);
    if ((by->shape == of->shape && by->is_closed) || !may_enclose(by, of))
        return NOTHING;
    if (!of->shape)
        return ALL;
    return is_convex(by) && rt_shape_contains_bounds(scene, by->shape, of->shape) ? ALL : PART;
}

static amount enclosed(const solids *by, place of)
{
    amount most = by->are_too_many ? PART : NOTHING;
    for (size_t i = 0; i < by->count && most < PART; i++) {
        const amount more = enclosed_by(by->scene, by->of + i, &of);
        most = more > most ? more : most;
    }
    return most;
}

/* The eye, the lights that are points, and the shapes that emit. */
static size_t count_places(const rt_scene *scene)
{
    size_t places = 1 + scene->light_count;
    for (size_t i = 0; i < scene->shape_count; i++)
        places += scene->shapes[i].emission != RT_NONE;
    return places;
}

static rt_status find_solids(solids *out, const rt_scene *scene, rt_memory *memory, rt_error *error)
{
    size_t count = 0;
    for (size_t i = 0; i < scene->shape_count; i++)
        count += is_solid(scene, scene->shapes + i);
    *out = (solids){.scene = scene};
    out->of = rt_memory_alloc(memory, count, sizeof *out->of, "the transparent shapes", error);
    if (!out->of)
        return RT_ERROR_MEMORY;
    out->are_too_many = count > 0 && count_places(scene) > PAIRS_MAX / count;
    for (size_t i = 0; i < scene->shape_count; i++) {
        const rt_scene_shape *shape = scene->shapes + i;
        const int is_infinite = rt_shape_class_of(shape->kind)->storage == RT_STORED_INFINITE;
        if (is_solid(scene, shape))
            out->of[out->count++] =
                (solid){shape, is_infinite ? 0 : margin_of(shape->lo, shape->hi), is_infinite,
                        is_closed(scene, shape)};
    }
    return RT_OK;
}

static amount eye_enclosed(const solids *by)
{
    return enclosed(by, make_place(by->scene->camera.eye, by->scene->camera.eye, NULL));
}

/* How much of what lies as far from a light as its paths may start may lie in solids. */
static amount light_enclosed(const solids *by, const rt_light_data *light, double radius)
{
    const float *at = light->a;
    const double half =
        light->kind == RT_LIGHT_BEAM ? hypot((double)light->width, (double)light->height) : 0;
    rt_scene_shape room;
    memset(&room, 0, sizeof room);
    for (int i = 0; i < 3; i++) {
        const double more = 1e-5 * (fabs(at[0]) + fabs(at[1]) + fabs(at[2]) + radius) + half;
        room.lo[i] = (float)(at[i] - more);
        room.hi[i] = (float)(at[i] + more);
    }
    return enclosed(by, make_place(room.lo, room.hi, &room));
}

/*
 * Marks lights that are no shapes; returns how much of the most enclosed one may lie in solids.
 * Light from infinitely far starts in the half-spaces that lie towards it.
 */
static amount mark_other_lights(const rt_packing *p, const solids *by)
{
    rt_light_data *lights = rt_packing_table(p, p->header.lights);
    amount most = NOTHING;
    int is_endless = 0;
    for (size_t i = 0; i < by->count; i++)
        is_endless |= by->of[i].is_infinite;
    for (size_t i = 0; i < p->scene->light_count; i++) {
        const amount part = RT_LIGHT_IS_PLACED(lights[i].kind)
                                ? light_enclosed(by, lights + i, p->header.radius)
                            : is_endless ? PART
                                         : NOTHING;
        if (part == PART)
            lights[i].flags |= RT_LIGHT_PARTLY_ENCLOSED;
        most = part > most ? part : most;
    }
    return most;
}

/* The same of the shapes that emit. */
static amount mark_shapes(const rt_packing *p, const solids *by)
{
    rt_light_data *lights = rt_packing_table(p, p->header.lights);
    amount most = NOTHING;
    for (size_t i = 0; i < by->scene->shape_count && by->count > 0; i++) {
        const rt_scene_shape *shape = by->scene->shapes + i;
        if (shape->emission == RT_NONE)
            continue;
        const amount part = enclosed(by, make_place(shape->lo, shape->hi, shape));
        const size_t primitives = rt_scene_shape_primitives(by->scene, shape);
        for (size_t k = 0; k < primitives && part == PART; k++)
            lights[p->first_light[i] + k].flags |= RT_LIGHT_PARTLY_ENCLOSED;
        most = part > most ? part : most;
    }
    return most;
}

rt_status rt_pack_enclosing(rt_packing *p, rt_error *error)
{
    solids by;
    const rt_status status = find_solids(&by, p->scene, p->memory, error);
    if (status != RT_OK)
        return status;
    const amount others = mark_other_lights(p, &by), shapes = mark_shapes(p, &by);
    p->may_start_in_solids = eye_enclosed(&by) || others || shapes;
    rt_memory_free(by.of);
    return RT_OK;
}
