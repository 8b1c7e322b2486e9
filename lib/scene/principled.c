/* principled.c - principled materials: ranges, what goes with them, and what kernels find. */
#include <math.h>
#include <string.h>

#include "base/error.h"
#include "scene/check.h"
#include "scene/scene.h"

/* The first member of a principled material that is given, or NULL. */
const char *rt_principled_member(const rt_material *m)
{
    RT_PRINCIPLED_INPUTS(RT_GIVEN_INPUT)
    RT_PRINCIPLED_NUMBERS(RT_GIVEN_INPUT)
    return m->specular != 0 ? "specular" : NULL;
}

int rt_material_is_principled(const rt_material *m)
{
    return rt_principled_member(m) != NULL;
}

/* Of the inputs of other materials it has those that need no lobe of theirs. */
#define OTHER_NOTHING RT_GIVEN_INPUT
#define OTHER_SPECULAR RT_GIVEN_INPUT
#define OTHER_COAT RT_GIVEN_INPUT
#define OTHER_COLOUR(TYPE, name, RANGE, NEED, unit, help)
#define OTHER_DIRECTIONS(TYPE, name, RANGE, NEED, unit, help)
#define OTHER_INPUT(TYPE, name, RANGE, NEED, unit, help)                                           \
    OTHER_##NEED(TYPE, name, RANGE, NEED, unit, help)

/* The first member that is given and that materials of other kinds have, or NULL. */
static const char *other_member(const rt_material *m)
{
    if (m->metal || m->glass)
        return m->metal ? "metal" : "glass";
    RT_SURFACE_INPUTS(OTHER_INPUT)
    return m->exponent != 0  ? "exponent"
           : m->fresnel      ? "fresnel"
           : m->distribution ? "distribution"
           : m->interface    ? "interface"
                             : NULL;
}

static rt_status check_others(const rt_material *m, const char *who, rt_error *error)
{
    const char *field = other_member(m);
    if (!field)
        return RT_OK;
    return rt_fail_field(error, RT_ERROR_INPUT, field,
                         "%s: %s makes it principled, and a principled material has no %s", who,
                         rt_principled_member(m), field);
}

/* What has no meaning on one side of `thin`. */
static rt_status check_sheet(const rt_material *m, const char *who, rt_error *error)
{
    const char *field = !m->thin                      ? NULL
                        : m->metallic != 0            ? "metallic"
                        : m->metallic_texture         ? "metallic_texture"
                        : m->clearcoat != 0           ? "clearcoat"
                        : m->clearcoat_texture        ? "clearcoat_texture"
                        : !rt_is_black(m->absorption) ? "absorption"
                        : !rt_is_black(m->scattering) ? "scattering"
                        : m->density                  ? "density"
                        : m->albedo                   ? "albedo"
                        : m->priority != 0            ? "priority"
                                                      : NULL;
    if (field)
        return rt_fail_field(error, RT_ERROR_INPUT, field, "%s: a principled sheet has no %s", who,
                             field);
    if (m->diff_trans != 0 && !m->thin)
        return rt_fail_field(error, RT_ERROR_INPUT, "diff_trans",
                             "%s: diff_trans is of a sheet, and goes with `thin true`", who);
    return RT_OK;
}

static rt_status check_index(rt_material *m, const char *who, rt_error *error)
{
    if (!(m->specular >= 0 && m->specular <= 1))
        return rt_fail_field(error, RT_ERROR_INPUT, "specular",
                             "%s: specular is %g; it must lie from 0 to 1", who, m->specular);
    if (m->specular != 0 && m->ior != 0)
        return rt_fail_field(error, RT_ERROR_INPUT, "specular",
                             "%s: takes ior or specular, not both", who);
    if (m->specular != 0)
        m->ior = 2 / (1 - sqrtf(0.08f * m->specular)) - 1;
    return RT_OK;
}

static void spread(float colour[3], float number)
{
    colour[0] = colour[1] = colour[2] = number;
}

rt_status rt_principled_complete(rt_material *m, const char *who, rt_error *error)
{
    rt_status status;
    if (!rt_material_is_principled(m))
        return RT_OK;
    if ((status = check_others(m, who, error)) != RT_OK ||
        (status = check_sheet(m, who, error)) != RT_OK ||
        (status = check_index(m, who, error)) != RT_OK)
        return status;
    memcpy(m->kd, m->base_color, sizeof m->kd);
    spread(m->ks, m->metallic);
    spread(m->kt, m->spec_trans);
    m->kd_texture = m->base_color_texture;
    m->ks_texture = m->metallic_texture;
    m->kt_texture = m->spec_trans_texture;
    if (m->spec_trans > 0 && !m->thin)
        m->fresnel = RT_FRESNEL_DIELECTRIC;
    return RT_OK;
}
