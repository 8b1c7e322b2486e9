/* mitsuba_daylight.c - sun, sky and sunsky, of Mitsuba 3 and of 0.x, whose straight above is y. */
#include <math.h>
#include <string.h>

#include "dsl/import/daylight.h"
#include "dsl/import/mitsuba.h"

/* Where the sun stands, in the world. */
static void read_sun(mitsuba *m, xml_node *node, const matrix *to_world, double sun[3])
{
    static const char *const times[] = {"latitude", "longitude", "timezone", "year",  "month",
                                        "day",      "hour",      "minute",   "second"};
    static const double usual[] = {35.6894, 139.6917, 9, 2010, 7, 10, 15, 0, 0},
                        lowest[] = {-90, -180, -24, -9999, 1, 1, 0, 0, 0},
                        highest[] = {90, 180, 24, 9999, 12, 31, 24, 60, 60};
    double t[9], zenith, azimuth;
    int has_time = 0;
    for (int i = 0; i < 9; i++) {
        has_time |= rt_mitsuba_child(node, times[i]) != NULL;
        t[i] = rt_mitsuba_number(m, node, times[i], usual[i]);
    }
    if (rt_mitsuba_vector(m, node, "sun_direction", sun)) {
        if (has_time)
            rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                              "the time and the place are left out beside sun_direction, where "
                              "Mitsuba refuses both");
        return;
    }
    for (int i = 0; i < 9; i++) {
        if (i >= 3 && i < 6 && fabs(t[i]) > 9999) {
            rt_import_fail(rt_mitsuba_at(m, node), node->line, "there is no %s %g", times[i], t[i]);
            return;
        }
        if (t[i] < lowest[i] || t[i] > highest[i])
            rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                              "there is no %s %g: the sun stands where its formula puts it",
                              times[i], t[i]);
    }
    const daylight_time when = {.latitude = t[0],
                                .longitude = t[1],
                                .timezone = t[2],
                                .year = (int)t[3],
                                .month = (int)t[4],
                                .day = (int)t[5],
                                .hour = t[6],
                                .minute = t[7],
                                .second = t[8]};
    rt_daylight_sun_place(&when, &zenith, &azimuth);
    const double aside = sin(zenith) * sin(azimuth), ahead = sin(zenith) * cos(azimuth);
    const double old[3] = {aside, cos(zenith), -ahead}, now[3] = {-ahead, -aside, cos(zenith)};
    rt_matrix_vector(sun, to_world, m->is_old ? old : now);
}

/* Turns y to straight above and -z to the azimuth of the sun. */
static matrix place(const double up[3], const double sun[3])
{
    const double x_axis[3] = {1, 0, 0}, z_axis[3] = {0, 0, 1};
    double right[3], back[3];
    rt_vector_cross(right, sun, up);
    if (rt_vector_dot(right, right) < 1e-12)
        rt_vector_cross(right, fabs(up[0]) < 0.7 ? x_axis : z_axis, up);
    rt_vector_normalize(right);
    rt_vector_cross(back, right, up);
    matrix out = rt_matrix_identity();
    for (int i = 0; i < 3; i++) {
        out.m[i][0] = right[i];
        out.m[i][1] = up[i];
        out.m[i][2] = back[i];
    }
    return out;
}

static double read_bounded(mitsuba *m, xml_node *node, const char *name, double fallback, double lo,
                           double hi)
{
    const double value = rt_mitsuba_number(m, node, name, fallback),
                 bounded = fmin(fmax(value, lo), hi);
    if (bounded != value)
        rt_import_note_at(rt_mitsuba_at(m, node), node->line, "a %s of %g is taken as %g", name,
                          value, bounded);
    return bounded;
}

static void bound_albedo(mitsuba *m, xml_node *node, double albedo[3])
{
    int is_bounded = 0;
    for (int c = 0; c < 3; c++) {
        const double bounded = fmin(fmax(albedo[c], 0), 1);
        is_bounded |= bounded != albedo[c];
        albedo[c] = bounded;
    }
    if (is_bounded)
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "an albedo of the ground outside of 0 to 1 is brought there");
}

/* What the sky is, and the sun that it has; `type` says which of both there are. */
static void read_light(mitsuba *m, xml_node *node, const char *type, daylight *out)
{
    const double scale = m->is_old ? read_bounded(m, node, "scale", 1, 0, HUGE_VAL) : 1,
                 sky = read_bounded(m, node, "sky_scale", scale, 0, HUGE_VAL),
                 sun = read_bounded(m, node, "sun_scale", scale, 0, HUGE_VAL),
                 albedo = m->is_old ? 0.2 : 0.3,
                 aperture = read_bounded(m, node, "sun_aperture", 0.5358, 1e-6, 90);
    out->turbidity = read_bounded(m, node, "turbidity", 3, 1, 10);
    out->albedo[0] = out->albedo[1] = out->albedo[2] = albedo;
    rt_mitsuba_colour(m, node, "albedo", out->albedo);
    bound_albedo(m, node, out->albedo);
    out->stretch = m->is_old ? read_bounded(m, node, "stretch", 1, 1, 2) : 1;
    out->extends = m->is_old && rt_mitsuba_flag(m, node, "extend", 0);
    out->sky_scale = strcmp(type, "sun") == 0 ? 0 : sky;
    out->sun_half_aperture = 0.5 * aperture * IMPORT_PI / 180;
    if (strcmp(type, "sky") == 0)
        return;
    if (m->is_old)
        rt_daylight_old_sun_irradiance(rt_mitsuba_at(m, node), node->line, out->turbidity,
                                       out->zenith, out->sun_irradiance);
    else
        rt_daylight_sun_irradiance(out->turbidity, out->zenith, out->sun_irradiance);
    for (int c = 0; c < 3; c++)
        out->sun_irradiance[c] *= sun;
}

/* Words that say how the same picture is made. */
static void skip_sampling(mitsuba *m, xml_node *node)
{
    rt_mitsuba_number(m, node, "resolution", 512);
    rt_mitsuba_number(m, node, "sampling_weight", 1);
    if (rt_mitsuba_flag(m, node, "complex_sun", 0))
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "the disc of the sun is even, without 'complex_sun', of the same power");
}

/* The sun as a direction: of 0.x where it has no radius, and where it is a light beside the sky. */
static void add_direction(mitsuba *m, xml_node *node, const double sun[3], const daylight *light)
{
    const double direction[3] = {-sun[0], -sun[1], -sun[2]};
    rt_import_add_directional_light(rt_mitsuba_at(m, node), node->line, direction,
                                    light->sun_irradiance);
}

void rt_mitsuba_daylight(mitsuba *m, xml_node *node, const char *type, const matrix *to_world)
{
    static const double y_axis[3] = {0, 1, 0}, z_axis[3] = {0, 0, 1}, white[3] = {1, 1, 1};
    daylight light = {.zenith = 0};
    double sun[3], up[3];
    char file[512];
    const double radius = m->is_old ? read_bounded(m, node, "sun_radius_scale", 1, 0, 300) : 1;
    read_sun(m, node, to_world, sun);
    rt_matrix_vector(up, to_world, m->is_old ? y_axis : z_axis);
    rt_vector_normalize(up);
    if (!rt_vector_normalize(sun)) {
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "the direction of the sun is zero: it stands straight above");
        memcpy(sun, up, sizeof up);
    }
    light.zenith = acos(fmin(fmax(rt_vector_dot(sun, up), -1), 1));
    if (m->import->failed)
        return;
    read_light(m, node, type, &light);
    skip_sampling(m, node);
    if (light.zenith >= IMPORT_PI / 2) {
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "the sun is below the horizon, where '%s' has no light", type);
        m->import->has_light = 1;
        return;
    }
    light.sun_half_aperture *= radius;
    if (strcmp(type, "sun") == 0 && radius > 0)
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "the sun became a direction: its shadows are sharp, and mirrors lack it");
    if (strcmp(type, "sky") != 0 && (strcmp(type, "sun") == 0 || radius <= 0)) {
        add_direction(m, node, sun, &light);
        memset(light.sun_irradiance, 0, sizeof light.sun_irradiance);
    }
    const matrix turned = place(up, sun);
    if (strcmp(type, "sun") != 0 && (m->import->has_environment || m->import->has_even_sky ||
                                     rt_import_daylight(m->import, file, &light)))
        rt_import_set_environment(rt_mitsuba_at(m, node), node->line, white, file, &turned);
}
