/*
 * emitting_side.c - whether an area light faces anything: by how far shapes reach in front of it,
 * and by lines from it to walls.
 */
#include "scene/emitting_side.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/vec.h"
#include "scene/face.h"
#include "scene/inside.h"
#include "scene/reach.h"
#include "scene/shape_class.h"

/* What is looked at for one light, a fraction of a second: shapes, vertices and triangles, and
 * solid angles. */
enum { WORK_MAX = 4000000, ANGLES_MAX = 2000000 };

/*
 * A gap before a flat light, in parts of the root of its area, that next to no light leaves: to a
 * ceiling that it lies in or all but touches.
 */
static const double gap = 0.05;

/* Points across a face that lines leave from, each straight and towards four sides. */
static const double places[] = {0.02, 0.26, 0.5, 0.74, 0.98};
enum { PLACES = sizeof places / sizeof *places, SIDES = 4 };

typedef struct search {
    const rt_scene *scene;
    const rt_scene_shape *light;
    double eye[3];
    int is_in_view;
    double near; /* m: the gap */
    size_t work;
    rt_emitting_side out;
} search;

/* ---- What is in front of a face ---------------------------------------------- */

static int sees(const search *s, const rt_face *f)
{
    return s->is_in_view && rt_vec_dot(f->normal, s->eye) > rt_vec_dot(f->normal, f->centre);
}

static int reaches_in_front(search *s, const rt_face *f)
{
    const double enough = rt_vec_dot(f->normal, f->centre) + s->near;
    for (size_t i = 0; i < s->scene->shape_count; i++) {
        const rt_scene_shape *other = s->scene->shapes + i;
        if (other != s->light &&
            rt_shape_reach(s->scene, other, f->normal, enough, &s->work) > enough)
            return 1;
    }
    return 0;
}

/* ---- Walls ------------------------------------------------------------------- */

/* An opaque solid, without the camera, that a point lies in; or RT_NONE. */
static uint32_t solid_around(search *s, const double p[3])
{
    for (size_t i = 0; i < s->scene->shape_count; i++, s->work++) {
        const rt_scene_shape *solid = s->scene->shapes + i;
        if (solid == s->light || !rt_shape_contains(s->scene, solid, p))
            continue;
        s->work += solid->kind == RT_SHAPE_TRIANGLES ? rt_face_count(s->scene, solid) : 0;
        if (rt_material_hides(s->scene->materials + solid->material) &&
            solid->emission == RT_NONE && !rt_shape_contains(s->scene, solid, s->eye))
            return (uint32_t)i;
    }
    return RT_NONE;
}

/* Direction k from a face: its normal, or 60 degrees off it. */
static void direction(double out[3], const rt_face *f, int k)
{
    static const double across[SIDES + 1][2] = {{0, 0}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    double x[3], y[3];
    rt_frame_about(f->normal, x, y);
    for (int i = 0; i < 3; i++)
        out[i] = (k > 0 ? 0.5 : 1) * f->normal[i] +
                 sqrt(0.75) * (across[k][0] * x[i] + across[k][1] * y[i]);
}

/* Whether all lines from a point of a face meet a wall before they leave the gap. */
static int is_walled_in_at(search *s, const rt_face *f, const double p[3])
{
    const double from[3] = {p[0] + s->out.step * f->normal[0], p[1] + s->out.step * f->normal[1],
                            p[2] + s->out.step * f->normal[2]};
    const uint32_t solid = solid_around(s, from);
    if (solid != RT_NONE) {
        s->out.wall = solid;
        s->out.distance = 0;
        return 1;
    }
    for (int k = 0; k <= SIDES; k++) {
        double d[3], distance = (k > 0 ? 2 : 1) * s->near;
        direction(d, f, k);
        const uint32_t wall =
            rt_scene_first_along(s->scene, s->light, from, d, 1, &distance, &s->work);
        if (wall == RT_NONE || s->work > WORK_MAX)
            return 0;
        if (k == 0) {
            s->out.wall = wall;
            s->out.distance = distance + s->out.step;
        }
    }
    return 1;
}

static int is_walled_in(search *s, const rt_face *f)
{
    if (!is_walled_in_at(s, f, f->centre))
        return 0;
    for (int i = 0; i < PLACES * PLACES; i++) {
        double p[3];
        rt_face_point(p, f, places[i / PLACES], places[i % PLACES]);
        if (!is_walled_in_at(s, f, p))
            return 0;
    }
    return is_walled_in_at(s, f, f->centre); /* which is told */
}

/* ---- Faces ------------------------------------------------------------------- */

static double rounding_of(const rt_scene_shape *shape)
{
    double largest = 0;
    for (int i = 0; i < 3; i++)
        largest = fmax(largest, fmax(fabs(shape->lo[i]), fabs(shape->hi[i])));
    return 4 * FLT_EPSILON * largest;
}

/* Keeps what is told of a face, and finds what may be within the gap before it. */
static void describe(search *s, const rt_face *f)
{
    double distance = INFINITY;
    memcpy(s->out.centre, f->centre, sizeof f->centre);
    memcpy(s->out.normal, f->normal, sizeof f->normal);
    if (s->out.wall != RT_NONE)
        return;
    s->out.wall =
        rt_scene_first_along(s->scene, s->light, f->centre, f->normal, 0, &distance, &s->work);
    s->out.distance = s->out.wall == RT_NONE || distance <= s->out.step ? 0 : distance;
}

/* Looks at all faces; each has to miss all there is. */
static rt_miss miss_of_faces(search *s)
{
    const size_t count = rt_face_count(s->scene, s->light);
    double area = 0;
    int is_flat = 1;
    if (count > WORK_MAX)
        return RT_MISS_NONE;
    s->work += count;
    for (size_t i = 0; i < count; i++)
        area += rt_face_of(s->scene, s->light, i).area;
    s->out.step = rounding_of(s->light);
    s->near = fmax(gap * sqrt(area), s->out.step);
    for (size_t i = 0; i < count; i++) {
        const rt_face f = rt_face_of(s->scene, s->light, i);
        if (!(f.area > 0))
            continue;
        if ((sees(s, &f) || reaches_in_front(s, &f)) && !is_walled_in(s, &f))
            return RT_MISS_NONE;
        if (s->work > WORK_MAX)
            return RT_MISS_NONE;
        if (rt_vec_length(s->out.normal) == 0)
            describe(s, &f);
        is_flat = is_flat && rt_vec_dot(f.normal, s->out.normal) > 0.999;
    }
    return is_flat ? RT_MISS_FLAT : RT_MISS_OUTSIDE;
}

/* ---- Solids ------------------------------------------------------------------ */

/* Whether bounds lie beside those of the light, or touch them. */
static int are_beside(const search *s, const float lo[3], const float hi[3])
{
    const double touch = rounding_of(s->light);
    for (int i = 0; i < 3; i++)
        if (hi[i] <= s->light->lo[i] + touch || lo[i] >= s->light->hi[i] - touch)
            return 1;
    return 0;
}

static int is_mesh_beside(search *s, const rt_scene_shape *other)
{
    const rt_scene_mesh *mesh = s->scene->meshes + other->mesh;
    for (size_t i = 0; i < mesh->triangle_count; i++, s->work++) {
        float v[3], lo[3] = {INFINITY, INFINITY, INFINITY},
                    hi[3] = {-INFINITY, -INFINITY, -INFINITY};
        for (size_t k = 0; k < 3; k++) {
            rt_scene_vertex(s->scene, other, mesh->indices[3 * i + k], v);
            for (int c = 0; c < 3; c++) {
                lo[c] = fminf(lo[c], v[c]);
                hi[c] = fmaxf(hi[c], v[c]);
            }
        }
        if (!are_beside(s, lo, hi))
            return 0;
    }
    return 1;
}

/* Whether all of the light is on one side of a plane. */
static int is_plane_beside(search *s, const float p[8])
{
    int sides = 0;
    for (int sign = -1; sign <= 1; sign += 2) {
        const double n[3] = {sign * p[4], sign * p[5], sign * p[6]};
        const double at = rt_vec_dot(n, (const double[3]){p[0], p[1], p[2]});
        sides += rt_shape_reach(s->scene, s->light, n, at, &s->work) > at;
    }
    return sides < 2;
}

/* Whether a shape surely has no part within the light. */
static int is_apart(search *s, const rt_scene_shape *other)
{
    if (other->kind == RT_SHAPE_PLANE)
        return is_plane_beside(s, rt_scene_parameters(s->scene, other));
    return are_beside(s, other->lo, other->hi) ||
           rt_shape_contains_bounds(s->scene, other, s->light) ||
           (other->kind == RT_SHAPE_TRIANGLES && is_mesh_beside(s, other));
}

/*
 * Whether a closed mesh emits inwards all over, and nothing is in it: each face has the inside in
 * front.
 */
static int emits_into_itself(search *s)
{
    const size_t count = rt_face_count(s->scene, s->light);
    if (count * count > ANGLES_MAX ||
        !rt_material_hides(s->scene->materials + s->light->material) ||
        rt_shape_contains(s->scene, s->light, s->eye))
        return 0;
    for (size_t i = 0; i < count; i++, s->work += count) {
        const rt_face f = rt_face_of(s->scene, s->light, i);
        double p[3];
        for (int k = 0; k < 3; k++)
            p[k] = f.centre[k] + 1e-3 * sqrt(f.area) * f.normal[k];
        if (f.area > 0 && rt_shape_contains(s->scene, s->light, p) >= 0)
            return 0;
    }
    for (size_t i = 0; i < s->scene->shape_count; i++)
        if (s->scene->shapes + i != s->light && !is_apart(s, s->scene->shapes + i))
            return 0;
    return 1;
}

/* Whether all there is lies in a convex solid, which emits outwards. */
static int contains_all(search *s)
{
    if (s->is_in_view && !rt_shape_contains(s->scene, s->light, s->eye))
        return 0;
    for (size_t i = 0; i < s->scene->shape_count; i++, s->work++) {
        const rt_scene_shape *other = s->scene->shapes + i;
        if (other != s->light &&
            (other->kind == RT_SHAPE_PLANE || !rt_shape_contains_bounds(s->scene, s->light, other)))
            return 0;
    }
    return 1;
}

rt_emitting_side rt_emitting_side_of(const rt_scene *scene, const rt_scene_shape *light,
                                     int is_in_view, size_t *work)
{
    search s = {.scene = scene, .light = light, .is_in_view = is_in_view, .out.wall = RT_NONE};
    for (int i = 0; i < 3; i++)
        s.eye[i] = scene->camera.eye[i];
    if (scene->materials[light->material].two_sided)
        return s.out;
    if (rt_face_count(scene, light) > 0) {
        s.out.miss = miss_of_faces(&s);
        if (s.out.miss == RT_MISS_NONE && light->kind == RT_SHAPE_TRIANGLES &&
            emits_into_itself(&s))
            s.out.miss = RT_MISS_INSIDE;
    } else if (light->kind != RT_SHAPE_TORUS && rt_shape_class_of(light->kind)->contains &&
               contains_all(&s)) {
        s.out.miss = RT_MISS_OUTSIDE;
    }
    *work += s.work;
    return s.out;
}
