/* beam_light.c - beams of parallel light. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "base/error.h"
#include "scene/check.h"
#include "scene/scene.h"
#include "scene/table_light.h"

static const double pi = 3.14159265358979323846;
static const char who[] = "beam";

/* Of a width or height, m: the area of both is a float. */
static const float least = 1e-15f, most = 1e15f;

double rt_beam_area(const rt_scene_light *beam)
{
    return (beam->is_round ? pi : 4) * beam->half[0] * beam->half[1];
}

static rt_status check_size(float size, const char *field, rt_error *error)
{
    if (size >= least && size <= most)
        return RT_OK;
    return rt_fail_field(error, RT_ERROR_INPUT, field,
                         "%s: %s is %g m; it must lie between %g and %g", who, field, size, least,
                         most);
}

/* Far away single precision moves points across the beam, which by a part of its width shows. */
static rt_status check_rounding(const rt_scene_light *l, rt_error *error)
{
    double moved = 0;
    for (int i = 0; i < 3; i++)
        moved += fabs((double)l->position[i]) * sqrt(1 - (double)l->direction[i] * l->direction[i]);
    moved *= 2 * FLT_EPSILON;
    if (moved <= 0.1 * fmin(l->half[0], l->half[1]))
        return RT_OK;
    return rt_fail_field(error, RT_ERROR_INPUT, "position",
                         "%s: so far from the origin, single precision moves its light by up to "
                         "%.2g m, more than a twentieth of its width; let it start nearer",
                         who, moved);
}

static rt_status set_section(rt_scene_light *l, const rt_beam_light *light, rt_error *error)
{
    const float height = light->height == 0 ? light->width : light->height;
    rt_status status = check_size(light->width, "width", error);
    if (status == RT_OK)
        status = check_size(height, "height", error);
    if (status == RT_OK && (unsigned)light->cross_section > RT_BEAM_RECTANGULAR)
        return rt_fail_field(error, RT_ERROR_INPUT, "cross_section",
                             "%s: there is no cross section %d", who, (int)light->cross_section);
    l->half[0] = 0.5f * light->width;
    l->half[1] = 0.5f * height;
    l->is_round = light->cross_section == RT_BEAM_ROUND;
    return status == RT_OK ? check_rounding(l, error) : status;
}

static rt_status set_emission(rt_scene_light *l, const rt_beam_light *light, rt_error *error)
{
    const int has_power = !rt_is_black(light->power);
    rt_status status = rt_check_colour(light->irradiance, who, "irradiance", error);
    if (status == RT_OK)
        status = rt_check_colour(light->power, who, "power", error);
    if (status != RT_OK)
        return status;
    if (has_power && !rt_is_black(light->irradiance))
        return rt_fail_field(error, RT_ERROR_INPUT, "power",
                             "%s: give irradiance or power, not both", who);
    for (int c = 0; c < 3; c++) {
        const double irradiance =
            has_power ? light->power[c] / rt_beam_area(l) : light->irradiance[c];
        if (irradiance > RT_COLOUR_MAX)
            return rt_fail_field(
                error, RT_ERROR_INPUT, "power",
                "%s: of this width the power is an irradiance of %g W/m^2, above %g", who,
                irradiance, RT_COLOUR_MAX);
        l->emission[c] = (float)irradiance;
    }
    return RT_OK;
}

rt_status rt_scene_add_beam_light(rt_scene *scene, const rt_beam_light *light, rt_error *error)
{
    rt_scene_light l = {.kind = RT_LIGHT_BEAM, .outer = 1};
    rt_status status = rt_light_aim(&l, light->position, light->target, who, error);
    if (status == RT_OK)
        status = rt_light_set_across(&l, light->up, 1, who, error);
    if (status == RT_OK)
        status = set_section(&l, light, error);
    if (status == RT_OK)
        status = set_emission(&l, light, error);
    return status == RT_OK ? rt_scene_take_light(scene, &l, error) : status;
}
