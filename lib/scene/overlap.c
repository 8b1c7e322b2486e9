/* overlap.c - whether solids overlap or touch, by points inside of them. */
#include "scene/overlap.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "scene/inside.h"

enum { samples_max = 512, bisections = 48 };

/* A box that points are sampled in. */
typedef struct region {
    double lo[3], hi[3];
} region;

/*
 * Point i of a sequence that fills a region evenly: the additive recurrence by the powers of the
 * root of x^4 = x + 1 (Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences", 2018).
 */
static void sample_point(double p[3], const region *of, int i)
{
    static const double steps[3] = {0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
    for (int axis = 0; axis < 3; axis++) {
        const double turn = 0.5 + i * steps[axis];
        p[axis] = of->lo[axis] + (turn - floor(turn)) * (of->hi[axis] - of->lo[axis]);
    }
}

void rt_shape_sample(double p[3], const rt_scene_shape *shape, int i)
{
    region bounds;
    for (int axis = 0; axis < 3; axis++) {
        bounds.lo[axis] = shape->lo[axis];
        bounds.hi[axis] = shape->hi[axis];
    }
    sample_point(p, &bounds, i);
}

/* Farther than rounding moves a face of either, and far less than a gap that one sees. */
static double step_of(const rt_scene_shape *a, const rt_scene_shape *b)
{
    double largest = 0;
    for (int i = 0; i < 3; i++) {
        largest = fmax(largest, fmax(fabs(a->lo[i]), fabs(a->hi[i])));
        largest = fmax(largest, fmax(fabs(b->lo[i]), fabs(b->hi[i])));
    }
    return 16 * FLT_EPSILON * largest;
}

/* What the bounds of two solids share; returns whether they come as close as a step. */
static int shared_bounds(region *out, const rt_scene_shape *a, const rt_scene_shape *b, double step)
{
    for (int i = 0; i < 3; i++) {
        out->lo[i] = fmax(a->lo[i], b->lo[i]);
        out->hi[i] = fmin(a->hi[i], b->hi[i]);
        if (!(out->lo[i] <= out->hi[i] + step))
            return 0;
    }
    return 1;
}

/* The bounds of a solid, and a tenth of their size on every side. */
static region around(const rt_scene_shape *shape)
{
    region out;
    for (int i = 0; i < 3; i++) {
        const double tenth = 0.1 * ((double)shape->hi[i] - shape->lo[i]);
        out.lo[i] = shape->lo[i] - tenth;
        out.hi[i] = shape->hi[i] + tenth;
    }
    return out;
}

size_t rt_shape_cost(const rt_scene *scene, const rt_scene_shape *shape)
{
    return shape->kind == RT_SHAPE_TRIANGLES ? scene->meshes[shape->mesh].triangle_count + 1 : 1;
}

static int contains(const rt_scene *scene, const rt_scene_shape *shape, const double p[3])
{
    return rt_shape_contains(scene, shape, p) != 0;
}

/* Whether the bounds of a shape reach beyond those of another. */
static int reaches_beyond(const rt_scene_shape *a, const rt_scene_shape *b, double step)
{
    for (int i = 0; i < 3; i++)
        if (a->lo[i] < b->lo[i] - step || a->hi[i] > b->hi[i] + step)
            return 1;
    return 0;
}

static double bounds_size(const rt_scene_shape *shape)
{
    double size = 0;
    for (int i = 0; i < 3; i++)
        size = hypot(size, (double)shape->hi[i] - shape->lo[i]);
    return size;
}

/* A point at the fraction t from p to q. */
static void between(double out[3], const double p[3], const double q[3], double t)
{
    for (int i = 0; i < 3; i++)
        out[i] = p[i] + t * (q[i] - p[i]);
}

/*
 * Where the line from p, inside of a, to q, outside, leaves it, and the points a step before and
 * behind.
 */
typedef struct exit_of {
    double place[3], before[3], behind[3];
} exit_of;

static void leave(exit_of *out, const rt_scene *scene, const rt_scene_shape *a, const double p[3],
                  const double q[3], double step)
{
    double inside = 0, outside = 1, length = 0;
    for (int i = 0; i < bisections; i++) {
        const double middle = 0.5 * (inside + outside);
        between(out->place, p, q, middle);
        *(contains(scene, a, out->place) ? &inside : &outside) = middle;
    }
    for (int i = 0; i < 3; i++)
        length = hypot(length, q[i] - p[i]);
    between(out->before, p, q, inside - step / length);
    between(out->behind, p, q, outside + step / length);
}

/*
 * Whether a face of b is where the line from p to q leaves a, so that b's inside changes within the
 * same two steps.
 */
static int share_face(const rt_scene *scene, const rt_scene_shape *a, const rt_scene_shape *b,
                      const double p[3], const double q[3], double step, double place[3])
{
    exit_of end;
    leave(&end, scene, a, p, q, step);
    memcpy(place, end.place, sizeof end.place);
    return contains(scene, b, end.before) != contains(scene, b, end.behind);
}

/* Whether faces of the two coincide: where lines out of a leave it, b begins or ends. */
static rt_meeting touching(const rt_scene *scene, const rt_scene_shape *a, const rt_scene_shape *b,
                           double step, double place[3], size_t *work)
{
    const size_t cost = (bisections + 2) * (rt_shape_cost(scene, a) + rt_shape_cost(scene, b));
    const region bounds = around(a);
    int found = 0;
    for (int i = 0; i < samples_max && *work >= cost; i++, *work -= cost) {
        double p[3], q[3];
        sample_point(p, &bounds, i);
        sample_point(q, &bounds, 7919 * i + 1); /* in ever new directions */
        if (contains(scene, a, p) && !contains(scene, a, q) &&
            share_face(scene, a, b, p, q, step, place) && ++found == 2)
            return RT_TOUCHING;
    }
    return RT_APART;
}

static rt_meeting overlapping(const rt_scene *scene, const rt_scene_shape *a,
                              const rt_scene_shape *b, const region *shared, double step,
                              double place[3], size_t *work)
{
    const size_t cost = rt_shape_cost(scene, a) + rt_shape_cost(scene, b);
    for (int i = 0; i < 3; i++)
        if (shared->hi[i] - shared->lo[i] <= step)
            return RT_APART;
    int is_both = 0, is_a_alone = reaches_beyond(a, b, step),
        is_b_alone = reaches_beyond(b, a, step);
    for (int i = 0; i < samples_max && *work >= cost; i++, *work -= cost) {
        double p[3];
        sample_point(p, shared, i);
        const int in_a = contains(scene, a, p), in_b = contains(scene, b, p);
        is_a_alone |= in_a && !in_b;
        is_b_alone |= in_b && !in_a;
        if (in_a && in_b && !is_both)
            memcpy(place, p, sizeof p);
        is_both |= in_a && in_b;
        if (is_both && is_a_alone && is_b_alone)
            return RT_OVERLAPPING;
    }
    return RT_APART;
}

rt_meeting rt_shapes_meeting(const rt_scene *scene, const rt_scene_shape *a,
                             const rt_scene_shape *b, double place[3], size_t *work)
{
    const double step = step_of(a, b);
    region shared;
    if (!shared_bounds(&shared, a, b, step))
        return RT_APART;
    if (overlapping(scene, a, b, &shared, step, place, work) == RT_OVERLAPPING)
        return RT_OVERLAPPING;
    /* More of the lines out of the smaller one meet the other. */
    return bounds_size(a) <= bounds_size(b) ? touching(scene, a, b, step, place, work)
                                            : touching(scene, b, a, step, place, work);
}

/* ---- Within ---------------------------------------------------------------- */

enum { lines_max = 64, points_min = 16 };

/* Takes evaluations; returns whether there were as many. */
static int spend(size_t *work, size_t cost)
{
    const int is_enough = *work >= cost;
    *work -= is_enough ? cost : *work;
    return is_enough;
}

static int is_inside(const rt_scene *scene, const rt_scene_shape *shape, const double p[3])
{
    return rt_shape_contains(scene, shape, p) == 1;
}

static int points_are_within(const rt_scene *scene, const rt_scene_shape *inner,
                             const rt_scene_shape *outer, size_t *work)
{
    const size_t cost = rt_shape_cost(scene, inner) + rt_shape_cost(scene, outer);
    int found = 0;
    for (int i = 0; i < samples_max; i++) {
        double p[3];
        rt_shape_sample(p, inner, i);
        if (!spend(work, cost))
            return 0;
        if (!is_inside(scene, inner, p))
            continue;
        if (!is_inside(scene, outer, p))
            return 0;
        found++;
    }
    return found >= points_min;
}

static int lines_are_within(const rt_scene *scene, const rt_scene_shape *inner,
                            const rt_scene_shape *outer, double step, size_t *work)
{
    const size_t cost =
        (bisections + 2) * (rt_shape_cost(scene, inner) + rt_shape_cost(scene, outer));
    const region bounds = around(inner);
    for (int i = 0, found = 0; i < samples_max && found < lines_max; i++) {
        double p[3], q[3];
        sample_point(p, &bounds, i);
        sample_point(q, &bounds, 7919 * i + 1);
        if (!is_inside(scene, inner, p) || is_inside(scene, inner, q))
            continue;
        exit_of end;
        if (!spend(work, cost))
            return 0;
        leave(&end, scene, inner, p, q, step);
        if (!is_inside(scene, outer, end.before))
            return 0;
        found++;
    }
    return 1;
}

static int vertices_are_within(const rt_scene *scene, const rt_scene_shape *mesh,
                               const rt_scene_shape *outer, size_t *work)
{
    const size_t count = scene->meshes[mesh->mesh].vertex_count, cost = rt_shape_cost(scene, outer);
    for (size_t i = 0; i < count; i++) {
        float vertex[3];
        rt_scene_vertex(scene, mesh, i, vertex);
        if (!spend(work, cost) ||
            !is_inside(scene, outer, (const double[3]){vertex[0], vertex[1], vertex[2]}))
            return 0;
    }
    return 1;
}

int rt_shape_is_within(const rt_scene *scene, const rt_scene_shape *inner,
                       const rt_scene_shape *outer, size_t *work)
{
    const double step = step_of(inner, outer);
    if (reaches_beyond(inner, outer, step) || !points_are_within(scene, inner, outer, work))
        return 0;
    return inner->kind == RT_SHAPE_TRIANGLES ? vertices_are_within(scene, inner, outer, work)
                                             : lines_are_within(scene, inner, outer, step, work);
}
