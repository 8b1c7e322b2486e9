/*
 * dispersion.c - indices of refraction that depend on the wavelength: what a material says of them,
 * as the terms of Cauchy's equation or of Sellmeier's.
 */
#include <math.h>
#include <string.h>

#include "base/error.h"
#include "scene/check.h"
#include "scene/inside.h"
#include "scene/parts.h"
#include "scene/scene.h"

/* Lines of Fraunhofer, micrometres: yellow of helium, blue and red of hydrogen. */
static const double line_d = 0.5875618, line_f = 0.4861327, line_c = 0.6562725;

/* What paths may have: the knots of kernels/sample/wavelength.h. */
static const double shortest = 0.38, longest = 0.71;

static int has_cauchy(const rt_material *m)
{
    return m->cauchy[0] != 0 || m->cauchy[1] != 0;
}

static int has_sellmeier(const rt_material *m)
{
    return !rt_is_black(m->sellmeier_b);
}

int rt_material_is_dispersive(const rt_material *m)
{
    return (has_cauchy(m) || has_sellmeier(m)) && rt_material_is_transparent(m) && !m->thin;
}

double rt_material_ior_at(const rt_material *m, double wavelength)
{
    const double squared = wavelength * wavelength;
    if (has_cauchy(m))
        return m->cauchy[0] + m->cauchy[1] / squared;
    if (!has_sellmeier(m))
        return m->ior;
    double sum = 1;
    for (int i = 0; i < 3; i++)
        sum += m->sellmeier_b[i] * squared / (squared - m->sellmeier_c[i]);
    return sqrt(sum);
}

/* The member by which a material says its dispersion, or NULL; *second: another one, or NULL. */
static const char *member_of(const rt_material *m, const char **second)
{
    const char *const members[] = {m->abbe != 0 ? "abbe" : NULL, has_cauchy(m) ? "cauchy" : NULL,
                                   has_sellmeier(m) ? "sellmeier_b" : NULL,
                                   m->dispersion ? "dispersion" : NULL};
    const char *first = NULL;
    *second = NULL;
    for (size_t i = 0; i < sizeof members / sizeof *members; i++) {
        if (members[i] && first && !*second)
            *second = members[i];
        first = first ? first : members[i];
    }
    return first;
}

/* The index is finite, and in the range of ior, at whatever wavelength a path may have. */
static rt_status check_indices(const rt_material *m, const char *member, const char *who,
                               rt_error *error)
{
    const int steps = 330;
    for (int i = 0; i <= steps; i++) {
        const double wavelength = shortest + (longest - shortest) * i / steps;
        const double n = rt_material_ior_at(m, wavelength);
        if (n != n)
            return rt_fail_field(error, RT_ERROR_INPUT, member,
                                 "%s: by %s the square of the index of refraction is below 0 at %g "
                                 "micrometres",
                                 who, member, wavelength);
        if (!(n >= 0.1 && n <= 10))
            return rt_fail_field(error, RT_ERROR_INPUT, member,
                                 "%s: by %s the index of refraction is %g at %g micrometres; it "
                                 "must lie between 0.1 and 10",
                                 who, member, n, wavelength);
    }
    return RT_OK;
}

/* Cauchy's terms of an Abbe number. */
static rt_status take_abbe(rt_material *m, const char *who, rt_error *error)
{
    if (!(m->abbe >= 1 && m->abbe <= 1000))
        return rt_fail_field(error, RT_ERROR_INPUT, "abbe",
                             "%s: abbe is %g; it must lie between 1 and 1000", who, m->abbe);
    const double n = m->ior != 0 ? m->ior : 1.5;
    const double b = (n - 1) / (m->abbe * (1 / (line_f * line_f) - 1 / (line_c * line_c)));
    m->cauchy[0] = (float)(n - b / (line_d * line_d));
    m->cauchy[1] = (float)b;
    return RT_OK;
}

const char *rt_dispersion_member(const rt_material *m)
{
    const char *second;
    return member_of(m, &second);
}

rt_status rt_dispersion_complete(rt_material *m, const char *who, rt_error *error)
{
    const char *second = NULL;
    const char *member = member_of(m, &second);
    rt_status status = RT_OK;
    if (!member || m->blend)
        return RT_OK;
    if (second)
        return rt_fail_field(error, RT_ERROR_INPUT, second, "%s: takes %s or %s, not both", who,
                             member, second);
    if (m->dispersion && !m->glass)
        return rt_fail_field(error, RT_ERROR_INPUT, member,
                             "%s: dispersion is that of a glass by name: it needs glass", who);
    if (!m->dispersion && m->glass)
        return rt_fail_field(error, RT_ERROR_INPUT, member, "%s: takes glass or %s, not both", who,
                             member);
    if (m->dispersion && !rt_glass_sellmeier(m->glass, m->sellmeier_b, m->sellmeier_c))
        return rt_fail_field(error, RT_ERROR_INPUT, member,
                             "%s: the dispersion of this glass is not known: in place of glass, "
                             "say abbe and ior",
                             who);
    if (m->abbe != 0)
        status = take_abbe(m, who, error);
    else if (m->ior != 0 && !m->dispersion)
        return rt_fail_field(error, RT_ERROR_INPUT, member, "%s: takes ior or %s, not both", who,
                             member);
    if (status == RT_OK)
        status = check_indices(m, member, who, error);
    if (status == RT_OK && m->ior == 0 && !m->abbe)
        m->ior = (float)rt_material_ior_at(m, line_d);
    return status;
}

int rt_scene_has_dispersion(const rt_scene *scene)
{
    for (size_t i = 0; i < scene->shape_count; i++)
        if (rt_material_is_dispersive(scene->materials + scene->shapes[i].material))
            return 1;
    return 0;
}
