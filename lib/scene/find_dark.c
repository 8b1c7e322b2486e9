/*
 * find_dark.c - lights that light nothing: area lights that face away from all there is, spot
 * lights with nothing in their cone, and lights that an opaque plane parts from the camera.
 *
 * Only what is certain is reported: what may be in front counts as lit, whatever stands between.
 */
#include <stdio.h>
#include <string.h>

#include "scene/check.h"
#include "scene/emitting_side.h"
#include "scene/inside.h"
#include "scene/inspection.h"
#include "scene/reach.h"
#include "scene/shape_class.h"
#include "scene/view.h"
#include "setting/options.h"

static const double pi = 3.14159265358979323846;

/* Planes that a cone lies in front of, besides the one that its axis is normal to. */
enum { CONE_SIDES = 16 };

/* Shapes, vertices and triangles that are looked at; lights that are left then count as lit. */
enum { WORK_MAX = 20000000 };

typedef struct search {
    const rt_scene *scene;
    rt_camera_data camera;
    int is_gated; /* lights out of view are not seen; else those count that face the eye */
    uint32_t planes[RT_CHECKED_MAX]; /* opaque ones */
    size_t plane_count;
    rt_finding finding;
    char message[256];
    size_t work;
} search;

static double height(const float plane[8], const float p[3])
{
    double sum = 0;
    for (int i = 0; i < 3; i++)
        sum += plane[4 + i] * ((double)p[i] - plane[i]);
    return sum;
}

/* ---- Opaque planes ----------------------------------------------------------- */

static int is_opaque_plane(const rt_scene *scene, const rt_scene_shape *shape)
{
    return shape->kind == RT_SHAPE_PLANE && rt_material_hides(scene->materials + shape->material);
}

/* Whether all of a light is off a plane, on the side of its normal, or, by sign, of the other. */
static int is_in_front(search *s, const rt_scene_light *delta, const rt_scene_shape *emitter,
                       const float plane[8], int sign)
{
    if (emitter) {
        const double away[3] = {-sign * plane[4], -sign * plane[5], -sign * plane[6]};
        double at = 0;
        for (int i = 0; i < 3; i++)
            at += away[i] * plane[i];
        return rt_shape_reach(s->scene, emitter, away, at, &s->work) < at;
    }
    if (delta->kind == RT_LIGHT_BEAM)
        return sign * height(plane, delta->position) > hypot(delta->half[0], delta->half[1]);
    if (delta->kind != RT_LIGHT_DIRECTIONAL)
        return sign * height(plane, delta->position) > 0;
    double along = 0;
    for (int i = 0; i < 3; i++)
        along += plane[4 + i] * (double)delta->direction[i];
    return sign * along < 0;
}

/* An opaque plane between the light and the camera, or RT_NONE. */
static uint32_t plane_between(search *s, const rt_scene_light *delta, const rt_scene_shape *emitter)
{
    const rt_scene *scene = s->scene;
    /* The rays of an orthographic camera start beside its eye. */
    if (scene->camera.kind == RT_CAMERA_ORTHOGRAPHIC)
        return RT_NONE;
    for (size_t i = 0; i < s->plane_count && s->work <= WORK_MAX; i++) {
        const float *plane = rt_scene_parameters(scene, scene->shapes + s->planes[i]);
        const double eye = height(plane, scene->camera.eye);
        if (fabs(eye) > scene->camera.aperture &&
            is_in_front(s, delta, emitter, plane, eye > 0 ? -1 : 1))
            return s->planes[i];
    }
    return RT_NONE;
}

static int is_behind_plane(search *s, const rt_scene_light *delta, const rt_scene_shape *emitter)
{
    s->finding.shape = plane_between(s, delta, emitter);
    if (s->finding.shape == RT_NONE)
        return 0;
    snprintf(s->message, sizeof s->message,
             "this light lights nothing that is seen: %s an opaque plane that the camera is on the "
             "other side of",
             delta && delta->kind == RT_LIGHT_DIRECTIONAL ? "it comes from behind"
                                                          : "it is behind");
    return 1;
}

/* ---- Area lights ------------------------------------------------------------- */

/* "; 2 m behind it is a quad", and which: what a line from p meets first. */
static void add_behind(search *s, const rt_scene_shape *from, const double p[3], const double d[3])
{
    const size_t used = strlen(s->message);
    double distance = INFINITY;
    s->finding.shape = rt_scene_first_along(s->scene, from, p, d, 0, &distance, &s->work);
    if (s->finding.shape != RT_NONE)
        snprintf(s->message + used, sizeof s->message - used, "; %.3g m behind it is a %s",
                 distance, rt_inspection_name(s->scene->shapes + s->finding.shape));
}

static void describe_flat(search *s, const rt_scene_shape *light, const rt_emitting_side *side)
{
    const double *n = side->normal;
    double behind[3], back[3];
    char ahead[64] = "where nothing is";
    const char *const name =
        side->wall == RT_NONE ? "" : rt_inspection_name(s->scene->shapes + side->wall);
    if (side->distance > 0)
        snprintf(ahead, sizeof ahead, "where a %s is %.2g m away", name, side->distance);
    else if (side->wall != RT_NONE)
        snprintf(ahead, sizeof ahead, "where it touches a %s", name);
    /* + 0.0 makes -0 0. */
    snprintf(s->message, sizeof s->message,
             "this light lights nothing%s: it emits along %.3g %.3g %.3g, %s",
             side->distance > 0 ? ", or next to it" : "", n[0] + 0.0, n[1] + 0.0, n[2] + 0.0,
             ahead);
    for (int i = 0; i < 3; i++) {
        back[i] = -n[i];
        behind[i] = side->centre[i] - 64 * side->step * n[i];
    }
    add_behind(s, light, behind, back);
}

/* Whether it is reported as a light in a solid, or a solid that the camera is in. */
static int is_told_before(const search *s, const rt_scene_shape *light,
                          const rt_emitting_side *side)
{
    const float *eye = s->scene->camera.eye;
    return side->miss == RT_MISS_OUTSIDE
               ? rt_shape_contains(s->scene, light, (const double[3]){eye[0], eye[1], eye[2]})
               : side->wall != RT_NONE &&
                     rt_shape_contains_shape(s->scene, s->scene->shapes + side->wall, light);
}

/* Leaves no message where it is told before. */
static int emitter_lights_nothing(search *s, const rt_scene_shape *light)
{
    const int is_in_view = !s->is_gated || rt_view_may_see(&s->camera, s->scene, light);
    const rt_emitting_side side = rt_emitting_side_of(s->scene, light, is_in_view, &s->work);
    switch (side.miss) {
    case RT_MISS_NONE:
        return is_behind_plane(s, NULL, light);
    case RT_MISS_FLAT:
        describe_flat(s, light, &side);
        break;
    case RT_MISS_OUTSIDE:
        snprintf(s->message, sizeof s->message,
                 "this light lights nothing: all there is lies behind the side that emits");
        break;
    case RT_MISS_INSIDE:
        snprintf(s->message, sizeof s->message,
                 "this light lights nothing: it emits inwards, and nothing is in it");
        break;
    }
    if (is_told_before(s, light, &side))
        s->message[0] = '\0';
    return 1;
}

/* ---- Spot lights and beams ---------------------------------------------------- */

/* The n . x of the plane through a light. */
static double offset_of(const double n[3], const rt_scene_light *light)
{
    return n[0] * light->position[0] + n[1] * light->position[1] + n[2] * light->position[2];
}

/*
 * Planes that hold the cone on their positive side, by unit vectors n and the n . x of their
 * points; returns how many.
 */
static int planes_of_cone(double planes[CONE_SIDES + 1][4], const rt_scene_light *spot)
{
    const double axis[3] = {spot->direction[0], spot->direction[1], spot->direction[2]};
    const double along = sqrt(fmax(1 - (double)spot->outer * spot->outer, 0)), across = spot->outer;
    double x[3], y[3];
    if (spot->outer < 0)
        return 0; /* wider than a half-space */
    rt_frame_about(axis, x, y);
    for (int k = 0; k < CONE_SIDES; k++) {
        const double turn = 2 * pi * k / CONE_SIDES;
        for (int i = 0; i < 3; i++)
            planes[k][i] = along * axis[i] + across * (cos(turn) * x[i] + sin(turn) * y[i]);
    }
    for (int i = 0; i < 3; i++)
        planes[CONE_SIDES][i] = axis[i];
    for (int k = 0; k <= CONE_SIDES; k++)
        planes[k][3] = offset_of(planes[k], spot);
    return CONE_SIDES + 1;
}

/* The same of a beam, whose axis is the last of five. */
static int planes_of_beam(double planes[CONE_SIDES + 1][4], const rt_scene_light *beam)
{
    const double axis[3] = {beam->direction[0], beam->direction[1], beam->direction[2]},
                 side[3] = {beam->across[0], beam->across[1], beam->across[2]};
    double up[3];
    rt_vec_cross(up, axis, side);
    for (int k = 0; k < 5; k++) {
        const double *n = k == 4 ? axis : k < 2 ? side : up;
        for (int i = 0; i < 3; i++)
            planes[k][i] = k % 2 ? -n[i] : n[i];
        planes[k][3] = offset_of(planes[k], beam) - (k == 4 ? 0 : (double)beam->half[k / 2]);
    }
    return 5;
}

/* Whether no direction of the cone, or no part of the beam, leads to an infinite plane. */
static int leads_away(const float plane[8], const rt_scene_light *spot)
{
    if (fabs(height(plane, spot->position)) < hypot(spot->half[0], spot->half[1]))
        return 0;
    const double side = height(plane, spot->position) > 0 ? 1 : -1;
    double cosine = 0;
    for (int i = 0; i < 3; i++)
        cosine += side * plane[4 + i] * spot->direction[i];
    return acos(fmax(fmin(cosine, 1), -1)) + acos(spot->outer) <= 0.5 * pi;
}

/* Whether one of the planes parts a shape from the cone or beam. */
static int is_beside(search *s, const rt_scene_light *spot, const rt_scene_shape *shape,
                     double planes[CONE_SIDES + 1][4], int count)
{
    if (shape->kind == RT_SHAPE_PLANE)
        return leads_away(rt_scene_parameters(s->scene, shape), spot);
    for (int k = 0; k < count; k++) {
        const double at = planes[k][3];
        if (rt_shape_reach(s->scene, shape, planes[k], at, &s->work) < at)
            return 1;
    }
    return 0;
}

static int confined_lights_nothing(search *s, const rt_scene_light *light)
{
    double planes[CONE_SIDES + 1][4];
    const int is_beam = light->kind == RT_LIGHT_BEAM;
    const int count = is_beam ? planes_of_beam(planes, light) : planes_of_cone(planes, light);
    for (size_t i = 0; i < s->scene->shape_count; i++)
        if (!is_beside(s, light, s->scene->shapes + i, planes, count) || s->work > WORK_MAX)
            return 0;
    const double p[3] = {light->position[0], light->position[1], light->position[2]};
    const double axis[3] = {light->direction[0], light->direction[1], light->direction[2]};
    const double back[3] = {-axis[0], -axis[1], -axis[2]};
    if (is_beam)
        snprintf(s->message, sizeof s->message,
                 "this light lights nothing: nothing is in its beam along %.3g %.3g %.3g",
                 axis[0] + 0.0, axis[1] + 0.0, axis[2] + 0.0);
    else
        snprintf(s->message, sizeof s->message,
                 "this light lights nothing: nothing is in its cone, %.3g degrees about %.3g %.3g "
                 "%.3g",
                 acos(light->outer) * 180 / pi, axis[0] + 0.0, axis[1] + 0.0, axis[2] + 0.0);
    add_behind(s, NULL, p, back);
    return 1;
}

/* ---- All lights -------------------------------------------------------------- */

/* Whether it lights a cone or a beam alone. */
static int is_confined(const rt_scene_light *light)
{
    return light->kind == RT_LIGHT_SPOT || light->kind == RT_LIGHT_TABLE ||
           light->kind == RT_LIGHT_BEAM;
}

static int delta_lights_nothing(search *s, const rt_scene_light *light)
{
    return light->kind != RT_LIGHT_ENVIRONMENT &&
           ((is_confined(light) && confined_lights_nothing(s, light)) ||
            is_behind_plane(s, light, NULL));
}

/* Begins; returns 0 where a medium is everywhere, so that all light is seen, and without a view. */
static int begin(search *s, const rt_scene *scene, int is_gated)
{
    s->scene = scene;
    s->is_gated = is_gated;
    s->work = 0;
    s->finding = rt_finding_of(RT_FINDING_LIGHTS_NOTHING);
    if (!rt_is_black(scene->medium.scattering) || scene->shape_count == 0 || !scene->has_camera)
        return 0;
    rt_render_options options = scene->options;
    rt_options_complete(&options);
    rt_view_aim(&s->camera, &scene->camera, options.width, options.height);
    s->plane_count = 0;
    for (size_t i = 0; i < scene->shape_count && s->plane_count < RT_CHECKED_MAX; i++)
        if (is_opaque_plane(scene, scene->shapes + i))
            s->planes[s->plane_count++] = (uint32_t)i;
    return 1;
}

/*
 * Reports lights that light nothing; with `in` NULL returns whether there are others, or more than
 * are looked at.
 */
static int report_dark(rt_inspection *in, const rt_scene *scene, int is_gated)
{
    search s;
    int checked = 0;
    if (!begin(&s, scene, is_gated))
        return 1;
    for (size_t i = 0; i < scene->light_count + scene->shape_count; i++) {
        const int is_delta = i < scene->light_count;
        const uint32_t place = (uint32_t)(is_delta ? i : i - scene->light_count);
        const rt_scene_light *delta = is_delta ? scene->lights + i : NULL;
        if (!is_delta && scene->shapes[place].emission == RT_NONE)
            continue;
        if (checked++ == RT_CHECKED_MAX || s.work > WORK_MAX)
            return 1;
        s.finding.shape = RT_NONE;
        const int is_dark = delta ? delta_lights_nothing(&s, delta)
                                  : emitter_lights_nothing(&s, scene->shapes + place);
        if (!in && !is_dark)
            return 1;
        if (!in || !is_dark || !s.message[0])
            continue;
        s.finding.light = is_delta ? place : RT_NONE;
        s.finding.emitter = is_delta ? RT_NONE : place;
        rt_inspection_report(in, s.finding, "%s", s.message);
    }
    return 0;
}

/* Among lights that are seen, one out of view that faces the camera is no mistake. */
void rt_find_dark_lights(rt_inspection *in)
{
    report_dark(in, in->scene, rt_scene_is_dark(in->scene));
}

int rt_scene_is_dark(const rt_scene *scene)
{
    return rt_scene_has_light(scene) && !report_dark(NULL, scene, 1);
}
