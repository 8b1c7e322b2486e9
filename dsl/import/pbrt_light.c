/* pbrt_light.c - lights of pbrt-v4. */
#include <math.h>
#include <string.h>

#include "dsl/import/pbrt.h"

/*
 * The colour of a light by its scale, without one white; and by how long and how much the film
 * takes of it, which changes nothing in v3 but for the scale of its film.
 */
static void read_scaled(pbrt *p, pbrt_params *params, const char *name, double out[3])
{
    const double exposure = p->gain * (p->tokens.is_v3 || !(p->shutter > 0) ? 1 : p->shutter);
    double scale[3] = {1, 1, 1}; /* a colour in v3 */
    if (p->tokens.is_v3) {       /* these change noise alone */
        rt_pbrt_number(params, "nsamples", 1);
        rt_pbrt_number(params, "samples", 1);
    }
    out[0] = out[1] = out[2] = 1;
    rt_pbrt_colour(params, "scale", scale);
    rt_pbrt_colour(params, name, out);
    for (int c = 0; c < 3; c++)
        out[c] *= scale[c] * exposure;
}

/* The same by its scale and power. sphere: what its power is by its colour. */
static void read_emission(pbrt *p, pbrt_params *params, const char *name, double sphere,
                          double out[3])
{
    const double power = rt_pbrt_number(params, "power", 0);
    read_scaled(p, params, name, out);
    for (int c = 0; c < 3 && power > 0 && sphere > 0; c++)
        out[c] *= power / sphere;
    if (power > 0 && !(sphere > 0))
        rt_import_note_at(p->import, params->line, "the power of a light is left out");
}

/* Of a light whose radiance of 1 makes the illuminance `unit`. */
static void read_illuminance(pbrt_params *params, double unit, double colour[3])
{
    const double wanted = rt_pbrt_number(params, "illuminance", -1);
    for (int c = 0; c < 3 && wanted > 0; c++)
        colour[c] *= wanted / unit;
}

static void read_place(pbrt *p, pbrt_params *params, double from[3], double direction[3])
{
    double to[3] = {0, 0, 1};
    matrix to_world = rt_matrix_multiply(&p->mirror, &p->state.ctm);
    memset(from, 0, 3 * sizeof *from);
    rt_pbrt_point(params, "from", from);
    rt_pbrt_point(params, "to", to);
    for (int c = 0; c < 3; c++)
        direction[c] = to[c] - from[c];
    rt_matrix_point(from, &to_world, from);
    rt_matrix_vector(direction, &to_world, direction);
}

/* cos of the half-angles of a spot light; its power by its intensity. */
static double spot_sphere(double inner, double outer)
{
    double a = cos(inner * IMPORT_PI / 180), b = cos(outer * IMPORT_PI / 180);
    return 2 * IMPORT_PI * ((1 - a) + (a - b) / 2);
}

/*
 * The opening, a rectangle of the world, through which alone pbrt lets the light of a sky in. Only
 * its first two edges count, which others must go along.
 */
static void read_portal(pbrt *p, pbrt_params *params)
{
    const pbrt_param *param = rt_pbrt_find(params, "point3 point", "portal");
    double corners[3][3], unit[2][3];
    if (!param)
        return;
    if (param->number_count != 12) {
        rt_import_note_at(p->import, params->line,
                          "a portal that is not of four points is left out");
        return;
    }
    static const int taken[3] = {0, 1, 3};
    for (int i = 0; i < 3; i++)
        rt_matrix_point(corners[i], &p->mirror, param->numbers + 3 * taken[i]);
    double area = 1;
    for (int i = 0; i < 2; i++) {
        for (int c = 0; c < 3; c++)
            unit[i][c] = corners[i + 1][c] -= corners[0][c];
        area *= rt_vector_length(unit[i]);
        rt_vector_normalize(unit[i]);
    }
    if (!(area > 1e-20)) {
        rt_import_note_at(p->import, params->line, "a portal without area is left out");
        return;
    }
    if (fabs(rt_vector_dot(unit[0], unit[1])) > 1e-3) { /* which pbrt refuses, too */
        rt_import_note_at(p->import, params->line, "a portal that is no rectangle is left out");
        return;
    }
    rt_import_add_portal(p->import, corners[0], corners[1], corners[2]);
    rt_import_note_at(p->import, params->line,
                      "light of a sky comes through other openings than its portal, too");
}

/*
 * Images of pbrt-v4 are octahedral, those of pbrt-v3, whose `mapname` they have, of longitude and
 * latitude.
 */
static void read_infinite(pbrt *p, pbrt_params *params)
{
    /* Our z, the left edge of an image, is its x, our y its z and our x against its y. */
    static const matrix axes = {{{0, 0, 1, 0}, {-1, 0, 0, 0}, {0, 1, 0, 0}}};
    const matrix mirrored = rt_matrix_multiply(&p->mirror, &p->state.ctm),
                 to_world = rt_matrix_multiply(&mirrored, &axes);
    const char *octahedral = rt_pbrt_string(params, "filename", NULL),
               *map = rt_pbrt_string(params, "mapname", NULL);
    double radiance[3];
    char file[512];
    int has_image = 0;
    read_emission(p, params, "L", 0, radiance);
    if (octahedral)
        has_image = rt_import_octahedral_sky(p->import, params->line, file, octahedral, 0);
    else if (map)
        has_image = rt_import_image_file(p->import, params->line, file, map);
    else
        read_illuminance(params, IMPORT_PI, radiance);
    rt_import_set_environment(p->import, params->line, radiance, has_image ? file : NULL,
                              &to_world);
    read_portal(p, params);
}

/*
 * How a light of an image lies: its position, and where its x, y and z are. Returns whether pbrt's
 * axes are left-handed there, as they are in its own files.
 */
static int read_axes(pbrt *p, double position[3], double axes[3][3])
{
    static const double origin[3] = {0, 0, 0}, units[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const matrix to_world = rt_matrix_multiply(&p->mirror, &p->state.ctm);
    rt_matrix_point(position, &to_world, origin);
    for (int i = 0; i < 3; i++)
        rt_matrix_vector(axes[i], &to_world, units[i]);
    return rt_matrix_determinant(&to_world) < 0;
}

/*
 * Along z; pbrt has the top row of the image below, and the left edge on its -x. The image of v4 is
 * even in each pixel. fov is that of the shorter side.
 */
static void read_projection(pbrt *p, pbrt_params *params)
{
    import_projector projector = {.is_intensity = 1};
    double axes[3][3], tangent = tan(rt_pbrt_number(params, "fov", 90) * IMPORT_PI / 360);
    const char *now = rt_pbrt_string(params, "filename", NULL),
               *name = rt_pbrt_string(params, "mapname", now);
    char file[512];
    uint32_t size[2];
    const int is_left_handed = read_axes(p, projector.position, axes);
    read_emission(p, params, "I", 0, projector.colour);
    if (!name || !rt_import_image_size(p->import, params->line, name, size)) {
        rt_import_note_at(p->import, params->line,
                          "a light 'projection' without image is left out");
        return;
    }
    /* Turned over without being mirrored, it is turned by 180 degrees. */
    for (int c = 0; c < 3; c++)
        projector.image.up[c] = is_left_handed ? axes[1][c] : -axes[1][c];
    if (!(is_left_handed ? rt_import_upended_image : rt_import_image_file)(p->import, params->line,
                                                                           file, name))
        return;
    memcpy(projector.direction, axes[2], sizeof projector.direction);
    projector.image.file = file;
    projector.image.is_nearest = name == now;
    tangent *= size[0] > size[1] ? (double)size[0] / size[1] : 1;
    projector.fov = 2 * atan(tangent) * 180 / IMPORT_PI;
    rt_import_add_projector(p->import, params->line, &projector);
}

/* Octahedral about z (v4), or of longitude from x to z and latitude from y (v3). */
static void read_goniometric(pbrt *p, pbrt_params *params)
{
    import_goniometric light = {.position = {0, 0, 0}};
    double axes[3][3];
    const char *octahedral = rt_pbrt_string(params, "filename", NULL),
               *map = rt_pbrt_string(params, "mapname", NULL);
    char file[512];
    const int is_left_handed = read_axes(p, light.position, axes);
    int has_image = 0;
    read_emission(p, params, "I", 0, light.intensity);
    if (octahedral) {
        has_image =
            rt_import_octahedral_sky(p->import, params->line, file, octahedral, !is_left_handed);
    } else if (map) {
        has_image = (is_left_handed ? rt_import_mirrored_image
                                    : rt_import_image_file)(p->import, params->line, file, map);
    }
    if (!has_image) {
        rt_import_note_at(p->import, params->line,
                          "a light 'goniometric' without image is left out");
        return;
    }
    memcpy(light.direction, axes[octahedral ? 2 : 1], sizeof light.direction);
    memcpy(light.image.up, axes[0], sizeof light.image.up);
    light.image.file = file;
    rt_import_add_goniometric(p->import, params->line, &light);
}

void rt_pbrt_light(pbrt *p, pbrt_params *params, const char *type)
{
    double from[3], direction[3], colour[3];
    if (strcmp(type, "point") == 0) {
        read_place(p, params, from, direction);
        read_emission(p, params, "I", 4 * IMPORT_PI, colour);
        rt_import_add_point_light(p->import, params->line, from, colour);
    } else if (strcmp(type, "spot") == 0) {
        import_spot spot = {.outer = rt_pbrt_number(params, "coneangle", 30),
                            .falloff = p->tokens.is_v3 ? "quartic" : "smooth"};
        spot.inner = fmax(0, spot.outer - rt_pbrt_number(params, "conedeltaangle", 5));
        read_place(p, params, spot.position, spot.direction);
        read_emission(p, params, "I", spot_sphere(spot.inner, spot.outer), spot.intensity);
        rt_import_add_spot_light(p->import, params->line, &spot);
    } else if (strcmp(type, "distant") == 0) {
        read_place(p, params, from, direction);
        read_emission(p, params, "L", 0, colour);
        read_illuminance(params, 1, colour);
        rt_import_add_directional_light(p->import, params->line, direction, colour);
    } else if (strcmp(type, "projection") == 0) {
        read_projection(p, params);
    } else if (strcmp(type, "goniometric") == 0) {
        read_goniometric(p, params);
    } else if (strcmp(type, "infinite") == 0) {
        read_infinite(p, params);
    } else {
        rt_import_note_at(p->import, params->line, "a light '%.40s' is left out", type);
        return;
    }
    rt_pbrt_note_unused(params, type);
}

void rt_pbrt_area_light(pbrt *p, pbrt_params *params, const char *type)
{
    if (strcmp(type, "diffuse") != 0)
        rt_import_note_at(p->import, params->line, "an area light '%.40s' became diffuse", type);
    p->state.power = rt_pbrt_number(params, "power", 0);
    read_scaled(p, params, "L", p->state.radiance);
    p->state.is_two_sided = rt_pbrt_flag(params, "twosided", 0);
    rt_pbrt_note_unused(params, "an area light");
}
