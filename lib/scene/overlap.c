/* overlap.c - whether solids overlap or touch, by points inside of them. */
#include "scene/overlap.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "scene/inside.h"

enum { samples_max = 512 };

/* What two solids have in common of their bounds. */
typedef struct shared_bounds {
    double lo[3], hi[3];
    double step; /* farther than rounding moves a face, and far less than a gap that one sees */
} shared_bounds;

/* Returns whether the bounds meet. */
static int share_bounds(shared_bounds *out, const rt_scene_shape *a, const rt_scene_shape *b)
{
    double largest = 0;
    for (int i = 0; i < 3; i++) {
        largest = fmax(largest, fmax(fabs(a->lo[i]), fabs(a->hi[i])));
        largest = fmax(largest, fmax(fabs(b->lo[i]), fabs(b->hi[i])));
    }
    out->step = 16 * FLT_EPSILON * largest;
    for (int i = 0; i < 3; i++) {
        out->lo[i] = fmax(a->lo[i], b->lo[i]);
        out->hi[i] = fmin(a->hi[i], b->hi[i]);
        if (!(out->lo[i] <= out->hi[i] + out->step))
            return 0;
    }
    return 1;
}

/*
 * Point i of a sequence that fills the bounds evenly: the additive recurrence by the powers of the
 * root of x^4 = x + 1 (Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences", 2018).
 */
static void sample_point(double p[3], const shared_bounds *s, int i)
{
    static const double steps[3] = {0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
    for (int axis = 0; axis < 3; axis++) {
        const double turn = 0.5 + i * steps[axis];
        p[axis] = s->lo[axis] + (turn - floor(turn)) * (s->hi[axis] - s->lo[axis]);
    }
}

/* Evaluations that one test of a point takes. */
static size_t cost_of(const rt_scene *scene, const rt_scene_shape *shape)
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

/* Whether a point lies between the two: one is on one side of it, the other on the other. */
static int is_between(const rt_scene *scene, const rt_scene_shape *a, const rt_scene_shape *b,
                      const double p[3], int axis, double step)
{
    double before[3] = {p[0], p[1], p[2]}, behind[3] = {p[0], p[1], p[2]};
    before[axis] -= step;
    behind[axis] += step;
    const int a_before = contains(scene, a, before), a_behind = contains(scene, a, behind),
              b_before = contains(scene, b, before), b_behind = contains(scene, b, behind);
    return a_before != a_behind && b_before != b_behind && a_before != b_before;
}

/* Whether the solids touch where their bounds share no more than a face across this axis. */
static rt_meeting touching(const rt_scene *scene, const rt_scene_shape *a, const rt_scene_shape *b,
                           const shared_bounds *s, int axis, double place[3], size_t *work)
{
    const size_t cost = 4 * (cost_of(scene, a) + cost_of(scene, b));
    for (int i = 0; i < samples_max && *work >= cost; i++, *work -= cost) {
        sample_point(place, s, i);
        if (is_between(scene, a, b, place, axis, s->step))
            return RT_TOUCHING;
    }
    return RT_APART;
}

static rt_meeting overlapping(const rt_scene *scene, const rt_scene_shape *a,
                              const rt_scene_shape *b, const shared_bounds *s, double place[3],
                              size_t *work)
{
    const size_t cost = cost_of(scene, a) + cost_of(scene, b);
    int is_both = 0, is_a_alone = reaches_beyond(a, b, s->step),
        is_b_alone = reaches_beyond(b, a, s->step);
    for (int i = 0; i < samples_max && *work >= cost; i++, *work -= cost) {
        double p[3];
        sample_point(p, s, i);
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
    shared_bounds s;
    if (!share_bounds(&s, a, b))
        return RT_APART;
    for (int axis = 0; axis < 3; axis++)
        if (s.hi[axis] - s.lo[axis] <= s.step)
            return touching(scene, a, b, &s, axis, place, work);
    return overlapping(scene, a, b, &s, place, work);
}
