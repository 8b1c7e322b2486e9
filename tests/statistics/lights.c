/*
 * lights.c - the points on lights that are sampled from a point in the scene, and the choice among
 * lights.
 */
#include <math.h>
#include <string.h>

#include "kernels/light_draw.h"
#include "statistics/emitters.h"
#include "statistics/sky.h"
#include "statistics/space.h"

static light_draw draws[most_samples];

/* ---- Area lights ------------------------------------------------------------------- */

typedef struct viewed {
    emitter kind;
    float from[3];
    int by_solid_angle;
} viewed;

static rt_scene *viewed_scene(const void *setup)
{
    return emitter_scene(((const viewed *)setup)->kind);
}

static void draw_area_light(const void *setup, uint32_t seed, uint32_t count)
{
    const viewed *v = setup;
    draw_many_lights(kept_renderer(v, viewed_scene), seed, v->from, count, draws);
}

static sampled place_area_light(const void *setup, uint32_t i)
{
    const viewed *v = setup;
    const light_draw *d = draws + i;
    double away[3], n[3];
    sampled s = {0, 0, NAN};
    emitter_place(v->kind, d->position, d->normal, &s.x, &s.y);
    if (i < told_samples) {
        /* 1 / inv_pdf is a density of solid angle. */
        rt_vec_sub(away, d->position, v->from);
        wide(n, d->normal);
        const double d2 = dot3(away, away), cosine = fabs(dot3(away, n)) / sqrt(d2);
        s.pdf = emitter_element(v->kind, s.x, s.y) * cosine / (d2 * d->inv_pdf);
    }
    return s;
}

/*
 * Evenly by area, or by the solid angle of what faces the point. Of a mesh only from far, where no
 * triangle is nearer.
 */
static double of_area_light(const void *setup, double x, double y)
{
    const viewed *v = setup;
    double p[3], n[3], away[3];
    if (!v->by_solid_angle)
        return emitter_density(v->kind, x, y);
    emitter_point(v->kind, x, y, p);
    emitter_normal(v->kind, x, y, n);
    for (int i = 0; i < 3; i++)
        away[i] = p[i] - v->from[i];
    const double d2 = dot3(away, away), cosine = dot3(away, n) / sqrt(d2);
    /*
     * The normal of a sphere's parameters points inwards. Only a sphere has a side that the point
     * cannot see.
     */
    const double faces = v->kind == EMIT_SPHERE ? fmax(0, cosine) : fabs(cosine);
    return faces * emitter_element(v->kind, x, y) / d2;
}

/* ---- Sky ------------------------------------------------------------------------- */

static rt_scene *sky_scene_of(const void *setup)
{
    return sky_scene(*(const int *)setup);
}

static void draw_sky(const void *setup, uint32_t seed, uint32_t count)
{
    static const float from[3] = {0, 0, 0};
    draw_many_lights(kept_renderer(setup, sky_scene_of), seed, from, count, draws);
}

static sampled place_sky(const void *setup, uint32_t i)
{
    sampled s;
    (void)setup;
    sky_place(draws[i].wi, &s.x, &s.y);
    s.pdf = sky_element(s.y) / draws[i].inv_pdf;
    return s;
}

static double of_sky(const void *setup, double u, double v)
{
    return sky_density(*(const int *)setup, u, v);
}

/* ---- Choice ---------------------------------------------------------------------- */

enum { light_count = 37 };
static const float beside_lights[3] = {11.3f, 9, 4};

static double power_of(int i)
{
    return i % 5 == 3 ? 0 : 1 + i * 11 % 17;
}

/* Light i is a point at x = i; some are dark. */
static rt_scene *many_lights(const void *setup)
{
    rt_scene *scene = light_scene();
    rt_error error;
    (void)setup;
    for (int i = 0; i < light_count; i++) {
        rt_point_light light;
        memset(&light, 0, sizeof light);
        light.position[0] = (float)i;
        light.power[0] = light.power[1] = light.power[2] = (float)power_of(i);
        expect_ok(rt_scene_add_point_light(scene, &light, &error), &error);
    }
    return scene;
}

static void draw_choice(const void *setup, uint32_t seed, uint32_t count)
{
    draw_many_lights(kept_renderer(setup, many_lights), seed, beside_lights, count, draws);
}

static sampled place_choice(const void *setup, uint32_t i)
{
    (void)setup;
    return (sampled){(draws[i].position[0] + 0.5) / light_count, 0.5,
                     light_count / draws[i].inv_pdf};
}

static double by_chance(const void *setup, double x, double y)
{
    static float chances[light_count];
    (void)y;
    if (chances[0] == 0)
        light_chances(kept_renderer(setup, many_lights), beside_lights, light_count, chances);
    return light_count * (double)chances[(int)floor(x * light_count)];
}

/* ---- Table ----------------------------------------------------------------------- */

static const method by_area_light = {draw_area_light, place_area_light, of_area_light, 1, 0};
static const method by_sky = {draw_sky, place_sky, of_sky, 1, 0};
static const method by_choice = {draw_choice, place_choice, by_chance, 0, 0};

static const routine routines[] = {
    {"light: rectangle", 16, 16, &by_area_light,
     &(const viewed){EMIT_RECTANGLE, {2, 1.5f, 3.5f}, 1}},
    {"light: rectangle, far", 16, 16, &by_area_light,
     &(const viewed){EMIT_RECTANGLE, {-20, -30, 10}, 0}},
    {"light: parallelogram", 16, 16, &by_area_light,
     &(const viewed){EMIT_PARALLELOGRAM, {2, 1, 3.5f}, 0}},
    {"light: mesh, far", 48, 8, &by_area_light, &(const viewed){EMIT_MESH, {1e5f, -5e5f, 1e5f}, 0}},
    {"light: sphere", 16, 16, &by_area_light, &(const viewed){EMIT_SPHERE, {2, 4, 1.5f}, 1}},
    {"light: sphere, near", 16, 16, &by_area_light,
     &(const viewed){EMIT_SPHERE, {0.5f, 0.7f, 0.1f}, 1}},
    {"light: sphere, from inside", 16, 16, &by_area_light,
     &(const viewed){EMIT_SPHERE, {0.3f, 0.3f, -0.1f}, 0}},
    {"light: ellipsoid", 16, 16, &by_area_light, &(const viewed){EMIT_ELLIPSOID, {2, 4, 1.5f}, 0}},
    {"light: disc with a hole", 16, 16, &by_area_light,
     &(const viewed){EMIT_DISC, {2, 4, 1.5f}, 0}},
    {"light: torus", 16, 16, &by_area_light, &(const viewed){EMIT_TORUS, {2, 4, 1.5f}, 0}},
    {"light: pipe", 16, 16, &by_area_light, &(const viewed){EMIT_PIPE, {2, 4, 1.5f}, 0}},
    {"light: cylinder", 24, 12, &by_area_light, &(const viewed){EMIT_CYLINDER, {2, 4, 1.5f}, 0}},
    {"light: cone", 24, 12, &by_area_light, &(const viewed){EMIT_CONE, {2, 4, 1.5f}, 0}},
    {"light: box", 24, 12, &by_area_light, &(const viewed){EMIT_BOX, {2, 4, 1.5f}, 0}},
    {"light: frustum", 24, 12, &by_area_light, &(const viewed){EMIT_FRUSTUM, {2, 4, 1.5f}, 0}},
    {"light: even sky", 16, 16, &by_sky, &(const int){0}},
    {"light: sky of a picture", 32, 16, &by_sky, &(const int){1}},
    {"choice of light", light_count, 1, &by_choice, NULL},
};

const routine_table light_routines = {routines, sizeof routines / sizeof *routines};
