/* light.c - delta lights: point, spot, directional; and what is known of all lights. */
#include <math.h>
#include <string.h>

#include "base/error.h"
#include "scene/check.h"
#include "scene/parts.h"
#include "scene/scene.h"
#include "scene/table_light.h"

static const double pi = 3.14159265358979323846;

/* Least width of a spot's edge, in the cosine: a sharper one has no slope in float32. */
static const float edge_min = 1e-5f;

rt_status rt_scene_take_light(rt_scene *scene, const rt_scene_light *light, rt_error *error)
{
    rt_status status = rt_grow(scene->memory, (void **)&scene->lights, &scene->light_room,
                               scene->light_count, sizeof *light, "the list of lights", error);
    if (status == RT_OK)
        scene->lights[scene->light_count++] = *light;
    return status;
}

rt_status rt_scene_add_point_light(rt_scene *scene, const rt_point_light *light, rt_error *error)
{
    rt_scene_light l = {.kind = RT_LIGHT_POINT};
    rt_status status;

    if ((status = rt_check_point(light->position, "point light", "position", error)) != RT_OK ||
        (status = rt_check_colour(light->intensity, "point light", "intensity", error)) != RT_OK ||
        (status = rt_check_colour(light->power, "point light", "power", error)) != RT_OK)
        return status;
    int has_power = !rt_is_black(light->power);
    if (has_power && !rt_is_black(light->intensity))
        return rt_fail_field(error, RT_ERROR_INPUT, "power",
                             "point light: give intensity or power, not both");
    memcpy(l.position, light->position, sizeof l.position);
    for (int c = 0; c < 3; c++)
        l.emission[c] = has_power ? (float)(light->power[c] / (4 * pi)) : light->intensity[c];
    return rt_scene_take_light(scene, &l, error);
}

/* The unit vector of v; 0 when it has no length. */
static int normalise(float out[3], const double v[3])
{
    double length = rt_vec_length(v);
    for (int i = 0; i < 3; i++)
        out[i] = (float)(v[i] / length);
    return length > 0;
}

double rt_spot_power(const rt_scene_light *spot)
{
    return spot->falloff == RT_FALLOFF_QUARTIC ? 4 : spot->falloff == RT_FALLOFF_SQUARE ? 2 : 0;
}

/*
 * The mean of 3x^2 - 2x^3 over the edge is 1/2, in the cosine, of x^n it is 1 / (n + 1). Linear in
 * the angle, the integral of (o - t) sin t from i to o is (o - i) cos i - (sin o - sin i).
 */
double rt_spot_solid_angle(const rt_scene_light *spot)
{
    const double i = acosf(spot->inner), o = acosf(spot->outer);
    if (spot->falloff == RT_FALLOFF_LINEAR)
        return 2 * pi * (1 - (sin(o) - sin(i)) / (o - i));
    if (spot->falloff == RT_FALLOFF_SMOOTH)
        return 2 * pi * (1 - 0.5 * ((double)spot->inner + spot->outer));
    return 2 * pi *
           (1 - (double)spot->inner +
            ((double)spot->inner - spot->outer) / (1 + rt_spot_power(spot)));
}

rt_status rt_scene_add_spot_light(rt_scene *scene, const rt_spot_light *light, rt_error *error)
{
    rt_scene_light l = {.kind = RT_LIGHT_SPOT};
    rt_status status;

    if ((status = rt_light_aim(&l, light->position, light->target, "spot light", error)) != RT_OK ||
        (status = rt_check_colour(light->intensity, "spot light", "intensity", error)) != RT_OK)
        return status;
    float outer = light->outer == 0 ? 30 : light->outer;
    if (!(outer > 0 && outer <= 180))
        return rt_fail_field(error, RT_ERROR_INPUT, "outer",
                             "spot light: outer is %g degrees; it must lie from 0 to 180", outer);
    if (!(light->inner >= 0 && light->inner <= outer))
        return rt_fail_field(error, RT_ERROR_INPUT, "inner",
                             "spot light: inner is %g degrees; it must lie from 0 to outer, %g",
                             light->inner, outer);
    if ((unsigned)light->falloff > RT_FALLOFF_QUARTIC)
        return rt_fail_field(error, RT_ERROR_INPUT, "falloff", "spot light: there is no falloff %d",
                             (int)light->falloff);
    l.falloff = light->falloff;
    l.outer = (float)cos(outer * pi / 180);
    l.inner = (float)cos(light->inner * pi / 180);
    if (l.outer > 1 - edge_min)
        l.outer = 1 - edge_min;
    if (l.inner < l.outer + edge_min)
        l.inner = l.outer + edge_min;
    memcpy(l.emission, light->intensity, sizeof l.emission);
    if (light->path)
        return rt_spot_add_image(scene, &l, light, error);
    if (light->layer)
        return rt_fail_field(error, RT_ERROR_INPUT, "layer",
                             "spot light: a layer is one of an image: name its file");
    return rt_scene_take_light(scene, &l, error);
}

rt_status rt_scene_add_directional_light(rt_scene *scene, const rt_directional_light *light,
                                         rt_error *error)
{
    static const float zero[3];
    rt_scene_light l = {.kind = RT_LIGHT_DIRECTIONAL};
    double direction[3];
    rt_status status;

    if ((status = rt_check_point(light->direction, "directional light", "direction", error)) !=
            RT_OK ||
        (status = rt_check_colour(light->irradiance, "directional light", "irradiance", error)) !=
            RT_OK)
        return status;
    rt_vec_sub(direction, light->direction, zero);
    if (!normalise(l.direction, direction))
        return rt_fail_field(error, RT_ERROR_INPUT, "direction",
                             "directional light: direction is zero");
    memcpy(l.emission, light->irradiance, sizeof l.emission);
    return rt_scene_take_light(scene, &l, error);
}

/* ---- All lights of a scene --------------------------------------------------- */

int rt_scene_has_light(const rt_scene *scene)
{
    for (size_t i = 0; i < scene->light_count; i++)
        if (!rt_is_black(scene->lights[i].emission))
            return 1;
    for (size_t i = 0; i < scene->shape_count; i++)
        if (scene->shapes[i].emission != RT_NONE)
            return 1;
    return 0;
}

double rt_scene_brightest(const rt_scene *scene)
{
    const double pi = 3.14159265358979323846;
    double brightest = 0;
    for (size_t i = 0; i < scene->light_count; i++)
        if (!rt_is_black(scene->lights[i].emission))
            return 0;
    for (size_t i = 0; i < scene->shape_count; i++) {
        const rt_scene_shape *shape = scene->shapes + i;
        if (shape->emission == RT_NONE)
            continue;
        const rt_scene_emission *e = scene->emissions + shape->emission;
        for (int c = 0; c < 3; c++) {
            brightest = fmax(brightest, scene->materials[shape->material].emission[c]);
            brightest = fmax(brightest, e->radiance[c]);
            if (e->power[c] > 0 && e->area > 0)
                brightest = fmax(brightest, e->power[c] / (pi * e->area));
        }
    }
    return brightest;
}

static int has_delta_light(const rt_scene *scene)
{
    for (size_t i = 0; i < scene->light_count; i++)
        if (scene->lights[i].kind != RT_LIGHT_ENVIRONMENT &&
            !rt_is_black(scene->lights[i].emission))
            return 1;
    return 0;
}

/* Adds what the parts of a material do with caustics. */
static void note_caustics(const rt_scene *scene, const rt_material *whole, int *casts, int *shows)
{
    const rt_material *leaves[RT_PARTS_MOST];
    const size_t count = rt_material_leaves(scene, whole, RT_SIDE_BOTH, leaves);
    for (size_t i = 0; i < count; i++) {
        const rt_material *m = leaves[i];
        const int is_specular = !m->interface && rt_material_is_specular(m),
                  is_rough = rt_material_is_rough(m);
        *casts |= !m->interface && rt_material_is_mirror(m);
        *shows |= rt_material_is_diffuse(m) ? RT_CAUSTICS_DIFFUSE : 0;
        *shows |= is_specular && is_rough ? RT_CAUSTICS_ROUGH : 0;
    }
}

int rt_scene_hidden_caustics(const rt_scene *scene)
{
    int casts = 0, shows = 0;
    for (size_t i = 0; i < scene->shape_count; i++)
        note_caustics(scene, scene->materials + scene->shapes[i].material, &casts, &shows);
    return casts && has_delta_light(scene) ? shows : 0;
}
