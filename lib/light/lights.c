/* lights.c - fills the table of lights, and sets their probabilities by power. */
#include "light/lights.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/vec.h"
#include "scene/check.h"
#include "scene/shape_class.h"

static const double pi = 3.14159265358979323846;

static double mean(const float c[3])
{
    return ((double)c[0] + c[1] + c[2]) / 3;
}

size_t rt_lights_count(const rt_scene *scene)
{
    size_t count = scene->light_count;
    for (size_t i = 0; i < scene->shape_count; i++)
        if (scene->shapes[i].emission != RT_NONE)
            count += rt_scene_shape_primitives(scene, scene->shapes + i);
    return count;
}

static double table_flux(const rt_scene *scene, const rt_scene_light *light)
{
    const double *flux = scene->light_tables[light->table - 1].flux;
    return (flux[0] * light->emission[0] + flux[1] * light->emission[1] +
            flux[2] * light->emission[2]) /
           3;
}

/*
 * The power of a light other than an area light, W, mean of the channels. Of light from infinitely
 * far it is the flux through a disc of the scene's radius r: pi r^2 times the irradiance of a
 * directional light, 4 pi sr times pi r^2 times the mean radiance of an environment.
 */
static double light_power(const rt_scene *scene, const rt_scene_light *light, double radius)
{
    const float *sky = scene->environment.mean;
    double disc = pi * radius * radius;
    switch ((rt_light_kind)light->kind) {
    case RT_LIGHT_POINT:
        return 4 * pi * mean(light->emission);
    case RT_LIGHT_SPOT:
        if (!light->table)
            return rt_spot_solid_angle(light) * mean(light->emission);
        return table_flux(scene, light);
    case RT_LIGHT_TABLE:
        return table_flux(scene, light);
    case RT_LIGHT_DIRECTIONAL:
        return disc * mean(light->emission);
    case RT_LIGHT_BEAM:
        return rt_beam_area(light) * mean(light->emission);
    case RT_LIGHT_ENVIRONMENT:
        return 4 * pi * disc *
               mean((const float[3]){light->emission[0] * sky[0], light->emission[1] * sky[1],
                                     light->emission[2] * sky[2]});
    case RT_LIGHT_QUAD:
    case RT_LIGHT_TRIANGLE:
    case RT_LIGHT_SPHERE:
    case RT_LIGHT_SHAPE:
        break; /* see fill_area */
    }
    return 0;
}

/* As the table has it: more than a float holds counts as the most, as pmf is power over power. */
static float table_power(double power)
{
    return (float)fmin(power, FLT_MAX);
}

/* shown: what multiplies the emission, on the whole. */
static void set_hue(rt_light_data *light, const double shown[3])
{
    double parts[3], sum = 0;
    for (int c = 0; c < 3; c++)
        sum += parts[c] = light->emission[c] * shown[c];
    for (int c = 0; c < 3; c++)
        light->hue[c] = sum > 0 ? (float)(3 * parts[c] / sum) : 1;
}

static void fill_light(rt_light_data *light, const rt_scene *scene, const rt_scene_light *from,
                       double radius)
{
    double shown[3];
    memset(light, 0, sizeof *light);
    light->kind = from->kind;
    light->prim = RT_NONE;
    light->texture = RT_NONE;
    memcpy(light->a, from->position, sizeof light->a);
    memcpy(light->b, from->direction, sizeof light->b);
    light->c[0] = from->inner;
    light->c[1] = from->outer;
    if (rt_spot_power(from) > 0) {
        light->flags = RT_LIGHT_POWER;
        light->c[2] = (float)rt_spot_power(from);
    }
    if (from->falloff == RT_FALLOFF_LINEAR) {
        light->flags = RT_LIGHT_LINEAR;
        light->width = acosf(from->inner);
        light->height = acosf(from->outer);
        light->c[2] = (float)rt_spot_solid_angle(from);
    }
    if (from->table) {
        light->texture = from->table - 1;
        memcpy(light->normal, from->across, sizeof light->normal);
    }
    if (from->kind == RT_LIGHT_BEAM) {
        light->flags = from->is_round ? RT_LIGHT_ROUND : 0;
        light->width = from->half[0];
        light->height = from->half[1];
        light->area = (float)rt_beam_area(from);
        memcpy(light->normal, from->across, sizeof light->normal);
    }
    if (from->kind == RT_LIGHT_ENVIRONMENT && scene->environment.is_turned) {
        light->flags = RT_LIGHT_TURNED;
        memcpy(light->a, scene->environment.axes[0], sizeof light->a);
        memcpy(light->b, scene->environment.axes[1], sizeof light->b);
        memcpy(light->c, scene->environment.axes[2], sizeof light->c);
    }
    memcpy(light->emission, from->emission, sizeof light->emission);
    light->power = table_power(light_power(scene, from, radius));
    for (int c = 0; c < 3; c++)
        shown[c] = from->table ? scene->light_tables[from->table - 1].flux[c]
                   : from->kind == RT_LIGHT_ENVIRONMENT ? scene->environment.mean[c]
                                                        : 1;
    set_hue(light, shown);
}

static void fill_geometry(rt_light_data *light, const rt_scene *scene, const rt_scene_shape *shape,
                          size_t primitive)
{
    const rt_shape_class *class = rt_shape_class_of(shape->kind);
    if (class->light)
        class->light(light, scene, shape, primitive);
    else
        light->kind = RT_LIGHT_SHAPE;
    for (int i = 0; i < 3 && rt_scene_is_mirrored(scene, shape); i++)
        light->normal[i] = -light->normal[i];
}

/*
 * One emitting primitive: power = pi radiance area, on one side or both; a texture counts by its
 * mean.
 */
static void fill_area(rt_light_data *light, const rt_scene *scene, const rt_scene_shape *shape,
                      size_t primitive, const float radiance[3])
{
    int two_sided = scene->materials[shape->material].two_sided;
    double area = rt_scene_primitive_area(scene, shape, primitive);
    uint32_t texture = rt_scene_emission_texture(scene, shape);
    double shown[3];

    memset(light, 0, sizeof *light);
    light->flags = (two_sided ? RT_LIGHT_TWO_SIDED : 0) |
                   (rt_scene_is_cutout(scene, shape) ? RT_LIGHT_CUTOUT : 0);
    light->texture = texture ? texture - 1 : RT_NONE;
    fill_geometry(light, scene, shape, primitive);
    light->area = (float)area;
    memcpy(light->emission, radiance, sizeof light->emission);
    for (int c = 0; c < 3; c++)
        shown[c] = texture ? scene->textures[texture - 1].mean[c] : 1;
    const float power[3] = {(float)(radiance[0] * shown[0]), (float)(radiance[1] * shown[1]),
                            (float)(radiance[2] * shown[2])};
    light->power = table_power(pi * mean(power) * area * (two_sided ? 2 : 1));
    set_hue(light, shown);
}

/* A portal that is no opening must not leave a light without paths. */
static const double least_part = 0.01;

/*
 * By which a light starts light paths, W: its power; of light from infinitely far, where there are
 * portals, the flux through these, which is all of it that such paths follow but for a tenth.
 */
static double starting_power(const rt_scene *scene, const rt_light_data *light, double radius)
{
    double across = 0;
    if (!scene->portal_count ||
        (light->kind != RT_LIGHT_DIRECTIONAL && light->kind != RT_LIGHT_ENVIRONMENT))
        return light->power;
    for (size_t i = 0; i < scene->portal_count; i++) {
        const rt_portal *portal = scene->portals + i;
        double b[3], c[3], n[3];
        for (int k = 0; k < 3; k++) {
            b[k] = portal->edge1[k];
            c[k] = portal->edge2[k];
        }
        rt_vec_cross(n, b, c);
        across += light->kind == RT_LIGHT_DIRECTIONAL
                      ? fabs(n[0] * light->b[0] + n[1] * light->b[1] + n[2] * light->b[2])
                      : 0.5 * rt_vec_length(n); /* the mean over all directions */
    }
    const double part = across / (pi * radius * radius);
    return light->power * (part > 0 ? fmin(fmax(part, least_part), 1) : 1);
}

/* Makes the probabilities of choice, and returns the power of all. */
static double normalise(const rt_scene *scene, rt_light_data *lights, size_t count, double radius)
{
    double power = 0, total = 0, sum = 0;
    for (size_t i = 0; i < count; i++) {
        power += lights[i].power;
        total += starting_power(scene, lights + i, radius);
    }
    for (size_t i = 0; i < count && total > 0; i++) {
        const double part = starting_power(scene, lights + i, radius);
        sum += part;
        lights[i].pmf = (float)(part / total);
        lights[i].cdf = (float)(sum / total);
    }
    /* Rounding must not leave a gap above the last light that can be chosen. */
    for (size_t i = count; i > 0 && total > 0; i--) {
        lights[i - 1].cdf = 1;
        if (lights[i - 1].pmf > 0)
            break;
    }
    return power;
}

double rt_lights_fill(const rt_scene *scene, const rt_u32 *first_prim, double radius,
                      rt_light_data *lights, rt_u32 *first_light)
{
    const double everywhere = radius > 0 ? radius : 1;
    size_t count = 0;
    for (size_t i = 0; i < scene->light_count; i++)
        fill_light(lights + count++, scene, scene->lights + i, everywhere);
    for (size_t i = 0; i < scene->shape_count; i++) {
        const rt_scene_shape *shape = scene->shapes + i;
        float radiance[3];
        first_light[i] = RT_NONE;
        if (shape->emission == RT_NONE)
            continue;
        rt_scene_shape_radiance(scene, shape, radiance);
        first_light[i] = (rt_u32)count;
        for (size_t k = 0; k < rt_scene_shape_primitives(scene, shape); k++) {
            fill_area(lights + count, scene, shape, k, radiance);
            lights[count++].prim = first_prim[i] + (rt_u32)k;
        }
    }
    return normalise(scene, lights, count, everywhere);
}
