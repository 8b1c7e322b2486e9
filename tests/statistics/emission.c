/*
 * emission.c - where light paths start, and in which directions; and the choice of the light that
 * they start at.
 */
#include <math.h>
#include <stddef.h>
#include <string.h>

#include "kernels/light_draw.h"
#include "statistics/emitters.h"
#include "statistics/sky.h"
#include "statistics/space.h"

static emission_draw draws[most_samples];

/* ---- Area lights ------------------------------------------------------------------- */

/*
 * What is compared: the point; the direction about its normal; or one coordinate of each, which
 * are independent.
 */
typedef enum aspect { START, DIRECTION, BOTH } aspect;

typedef struct emission {
    emitter kind;
    aspect aspect;
} emission;

static rt_scene *area_light_scene(const void *setup)
{
    return emitter_scene(((const emission *)setup)->kind);
}

static void draw_area_light(const void *setup, uint32_t seed, uint32_t count)
{
    draw_many_emissions(kept_renderer(setup, area_light_scene), seed, count, draws);
}

static sampled place_area_light(const void *setup, uint32_t i)
{
    const emission *e = setup;
    const double sides = e->kind == EMIT_TWO_SIDED ? 2 : 1;
    const emission_draw *d = draws + i;
    double n[3], w[3], z = 0, turn = 0;
    sampled s = {0, 0, NAN};
    if (e->aspect != DIRECTION)
        emitter_place(e->kind, d->position, d->normal, &s.x, &s.y);
    if (e->aspect != START) {
        wide(n, d->normal);
        wide(w, d->direction);
        polar_about(n, w, &z, &turn);
        z = sides == 2 ? 0.5 + 0.5 * z : z;
    }
    /* The flux of a start is what an even area would send, over the density. */
    if (e->aspect == START && i < told_samples)
        s.pdf = sides * PI * EMITTED_RADIANCE / d->flux[0] * emitter_element(e->kind, s.x, s.y);
    if (e->aspect == DIRECTION)
        return (sampled){z, turn, NAN};
    return e->aspect == START ? s : (sampled){s.x, z, NAN};
}

/* By the cosine. */
static double of_height(const emission *e, double z)
{
    return e->kind == EMIT_TWO_SIDED ? 2 * fabs(2 * z - 1) : 2 * z;
}

static double of_area_light(const void *setup, double x, double y)
{
    const emission *e = setup;
    if (e->aspect == DIRECTION)
        return of_height(e, x);
    /* `BOTH` is only for emitters that are even along y. */
    return emitter_density(e->kind, x, y) * (e->aspect == BOTH ? of_height(e, y) : 1);
}

/* ---- Point and spot --------------------------------------------------------------- */

/* A spot: its angles in degrees. */
typedef struct cone {
    double inner, outer;
    rt_falloff falloff;
} cone;

static double radians(double degrees)
{
    return degrees * PI / 180;
}

static rt_scene *point_scene(const void *setup)
{
    rt_point_light light = {.position = {1, 2, 3}, .intensity = {5, 5, 5}};
    rt_scene *scene = light_scene();
    rt_error error;
    (void)setup;
    expect_ok(rt_scene_add_point_light(scene, &light, &error), &error);
    return scene;
}

static rt_scene *spot_scene(const void *setup)
{
    const cone *c = setup;
    rt_spot_light light = {.position = {0, 4, 0}, .target = {1, 3, 2}, .intensity = {5, 5, 5}};
    rt_scene *scene = light_scene();
    rt_error error;
    light.inner = (float)c->inner;
    light.outer = (float)c->outer;
    light.falloff = c->falloff;
    expect_ok(rt_scene_add_spot_light(scene, &light, &error), &error);
    return scene;
}

/* A part of the intensity, by the cosine, or the angle, between those of the two angles. */
static double falloff(const cone *c, double cosine)
{
    const double inner = radians(c->inner), outer = radians(c->outer);
    if (c->falloff == RT_FALLOFF_LINEAR)
        return fmax(0, fmin(1, (outer - acos(cosine)) / (outer - inner)));
    const double x = (cosine - cos(outer)) / (cos(inner) - cos(outer));
    const double inside = fmax(0, fmin(1, x));
    return c->falloff == RT_FALLOFF_SQUARE    ? inside * inside
           : c->falloff == RT_FALLOFF_QUARTIC ? pow(inside, 4)
                                              : inside * inside * (3 - 2 * inside);
}

static void draw_point(const void *setup, uint32_t seed, uint32_t count)
{
    draw_many_emissions(kept_renderer(setup, point_scene), seed, count, draws);
}

static sampled place_point(const void *setup, uint32_t i)
{
    const emission_draw *d = draws + i;
    (void)setup;
    return (sampled){0.5 + 0.5 * d->direction[1], turns_of(d->direction[0], d->direction[2]),
                     5 / d->flux[0] * 4 * PI};
}

static double even(const void *setup, double x, double y)
{
    (void)setup, (void)x, (void)y;
    return 1;
}

static void draw_spot(const void *setup, uint32_t seed, uint32_t count)
{
    draw_many_emissions(kept_renderer(setup, spot_scene), seed, count, draws);
}

static sampled place_spot(const void *setup, uint32_t i)
{
    const cone *c = setup;
    const double edge = cos(radians(c->outer));
    double axis[3] = {1, -1, 2}, w[3], cosine, turn;
    normalise(axis);
    wide(w, draws[i].direction);
    polar_about(axis, w, &cosine, &turn);
    return (sampled){(cosine - edge) / (1 - edge), turn,
                     5 * falloff(c, cosine) / draws[i].flux[0] * 2 * PI * (1 - edge)};
}

static double of_spot(const void *setup, double x, double y)
{
    const cone *c = setup;
    const double edge = cos(radians(c->outer));
    (void)y;
    return falloff(c, edge + x * (1 - edge));
}

/* ---- From infinitely far ------------------------------------------------------------ */

/*
 * The disc on which light starts that comes from one direction: that of a sphere around the bounds
 * of the sphere.
 */
static sampled place_on_disc(const emission_draw *d)
{
    static const double centre[3] = SKY_SPHERE_CENTRE;
    const double radius = sqrt(3) * SKY_SPHERE_RADIUS;
    double n[3], away[3], s[3], t[3];
    wide(n, d->direction);
    normalise(n);
    axes_about(n, s, t);
    for (int i = 0; i < 3; i++)
        away[i] = d->position[i] - centre[i];
    const double off = distance(dot3(away, s), dot3(away, t));
    return (sampled){off / radius, turns_of(dot3(away, s), dot3(away, t)), 2 * PI * radius * off};
}

static double on_disc(const void *setup, double r, double turn)
{
    (void)setup, (void)turn;
    return 2 * r;
}

static rt_scene *sun_scene(const void *setup)
{
    static const float centre[3] = SKY_SPHERE_CENTRE;
    rt_directional_light sun = {.direction = {1, -2, 1}, .irradiance = {5, 5, 5}};
    rt_surface surface;
    rt_scene *scene = light_scene();
    rt_error error;
    (void)setup;
    memset(&surface, 0, sizeof surface);
    expect_ok(rt_scene_add_sphere(scene, NULL, centre, (float)SKY_SPHERE_RADIUS, &surface, &error),
              &error);
    expect_ok(rt_scene_add_directional_light(scene, &sun, &error), &error);
    return scene;
}

static void draw_sun(const void *setup, uint32_t seed, uint32_t count)
{
    draw_many_emissions(kept_renderer(setup, sun_scene), seed, count, draws);
}

static sampled place_sun(const void *setup, uint32_t i)
{
    sampled s = place_on_disc(draws + i);
    (void)setup;
    s.pdf *= 5 / draws[i].flux[0];
    return s;
}

typedef struct heaven {
    int has_picture;
    aspect aspect;
} heaven;

static rt_scene *heaven_scene(const void *setup)
{
    return sky_scene(((const heaven *)setup)->has_picture);
}

static void draw_heaven(const void *setup, uint32_t seed, uint32_t count)
{
    draw_many_emissions(kept_renderer(setup, heaven_scene), seed, count, draws);
}

static sampled place_heaven(const void *setup, uint32_t i)
{
    const heaven *h = setup;
    const emission_draw *d = draws + i;
    const float w[3] = {-d->direction[0], -d->direction[1], -d->direction[2]};
    const double area = PI * 3 * SKY_SPHERE_RADIUS * SKY_SPHERE_RADIUS;
    sampled direction = {0, 0, NAN}, start = {0, 0, NAN};
    if (h->aspect != START)
        sky_place(w, &direction.x, &direction.y);
    if (h->aspect == DIRECTION && i < told_samples)
        direction.pdf = sky_radiance(h->has_picture, direction.x, direction.y) * area / d->flux[0] *
                        sky_element(direction.y);
    if (h->aspect != DIRECTION)
        start = place_on_disc(d);
    start.pdf = NAN;
    return h->aspect == START       ? start
           : h->aspect == DIRECTION ? direction
                                    : (sampled){start.x, direction.y, NAN};
}

static double of_heaven(const void *setup, double x, double y)
{
    const heaven *h = setup;
    if (h->aspect == START)
        return on_disc(setup, x, y);
    return h->aspect == DIRECTION ? sky_density(h->has_picture, x, y)
                                  : 2 * x * sky_density(0, 0, y);
}

/* ---- Choice ------------------------------------------------------------------------- */

enum { light_count = 23 };

/* Those of odd number are dark. */
static double power_of(int i)
{
    return i % 2 ? 0 : 1 + i * 5 % 13;
}

static rt_scene *many_lights(const void *setup)
{
    rt_scene *scene = light_scene();
    rt_error error;
    (void)setup;
    for (int i = 0; i < light_count; i++) {
        rt_point_light light;
        memset(&light, 0, sizeof light);
        light.power[0] = light.power[1] = light.power[2] = (float)power_of(i);
        expect_ok(rt_scene_add_point_light(scene, &light, &error), &error);
    }
    return scene;
}

static void draw_choice(const void *setup, uint32_t seed, uint32_t count)
{
    draw_many_emissions(kept_renderer(setup, many_lights), seed, count, draws);
}

static sampled place_choice(const void *setup, uint32_t i)
{
    const double light = draws[i].light;
    (void)setup;
    return (sampled){(light + 0.5) / light_count, 0.5,
                     light_count * power_of((int)light) / draws[i].flux[0]};
}

static double by_power(const void *setup, double x, double y)
{
    double sum = 0;
    (void)setup, (void)y;
    for (int i = 0; i < light_count; i++)
        sum += power_of(i);
    return light_count * power_of((int)floor(x * light_count)) / sum;
}

/* ---- Table ----------------------------------------------------------------------- */

static const method by_area_light = {draw_area_light, place_area_light, of_area_light, 0,
                                     offsetof(emission, aspect)};
static const method by_point = {draw_point, place_point, even, 0, 0};
static const method by_spot = {draw_spot, place_spot, of_spot, 1, 0};
static const method by_sun = {draw_sun, place_sun, on_disc, 0, 0};
static const method by_heaven = {draw_heaven, place_heaven, of_heaven, 1, offsetof(heaven, aspect)};
static const method by_choice = {draw_choice, place_choice, by_power, 0, 0};

static const routine routines[] = {
    {"emission: rectangle", 16, 16, &by_area_light, &(const emission){EMIT_RECTANGLE, START}},
    {"emission: two-sided rectangle", 16, 16, &by_area_light,
     &(const emission){EMIT_TWO_SIDED, START}},
    {"emission: mesh", 48, 8, &by_area_light, &(const emission){EMIT_MESH, START}},
    {"emission: sphere", 16, 16, &by_area_light, &(const emission){EMIT_SPHERE, START}},
    {"emission: box", 24, 12, &by_area_light, &(const emission){EMIT_BOX, START}},
    {"emission: frustum", 24, 12, &by_area_light, &(const emission){EMIT_FRUSTUM, START}},
    {"emission: direction from a rectangle", 16, 16, &by_area_light,
     &(const emission){EMIT_RECTANGLE, DIRECTION}},
    {"emission: direction from both sides", 16, 16, &by_area_light,
     &(const emission){EMIT_TWO_SIDED, DIRECTION}},
    {"emission: direction from a sphere", 16, 16, &by_area_light,
     &(const emission){EMIT_SPHERE, DIRECTION}},
    {"emission: direction from a frustum", 16, 16, &by_area_light,
     &(const emission){EMIT_FRUSTUM, DIRECTION}},
    {"emission: point and direction of both sides", 16, 16, &by_area_light,
     &(const emission){EMIT_TWO_SIDED, BOTH}},
    {"emission: point and direction of a torus", 16, 16, &by_area_light,
     &(const emission){EMIT_TORUS, BOTH}},
    {"emission: point light", 16, 16, &by_point, NULL},
    {"emission: spot", 32, 8, &by_spot, &(const cone){30, 60, RT_FALLOFF_SMOOTH}},
    {"emission: linear spot", 32, 8, &by_spot, &(const cone){30, 60, RT_FALLOFF_LINEAR}},
    {"emission: square spot", 32, 8, &by_spot, &(const cone){30, 60, RT_FALLOFF_SQUARE}},
    {"emission: wide quartic spot", 32, 8, &by_spot, &(const cone){0, 150, RT_FALLOFF_QUARTIC}},
    {"emission: narrow linear spot", 32, 8, &by_spot, &(const cone){0, 12, RT_FALLOFF_LINEAR}},
    {"emission: wide linear spot", 32, 8, &by_spot, &(const cone){10, 175, RT_FALLOFF_LINEAR}},
    {"emission: directional light", 16, 16, &by_sun, NULL},
    {"emission: direction from an even sky", 16, 16, &by_heaven, &(const heaven){0, DIRECTION}},
    {"emission: start of an even sky", 16, 16, &by_heaven, &(const heaven){0, START}},
    {"emission: start and direction of an even sky", 16, 16, &by_heaven, &(const heaven){0, BOTH}},
    {"emission: direction from a sky of a picture", 32, 16, &by_heaven,
     &(const heaven){1, DIRECTION}},
    {"emission: start of a sky of a picture", 16, 16, &by_heaven, &(const heaven){1, START}},
    {"emission: choice of light", light_count, 1, &by_choice, NULL},
};

const routine_table emission_routines = {routines, sizeof routines / sizeof *routines};
