/* pbrt_light.c - lights of pbrt-v4. */
#include <math.h>
#include <string.h>

#include "pbrt.h"

static const double pi = 3.14159265358979323846;

/* The colour of a light by its scale and power. sphere: what its power is by its colour. */
static void read_emission(pbrt *p, pbrt_params *params, const char *name, double sphere,
                          double out[3])
{
    double scale = pbrt_number(params, "scale", 1), power = pbrt_number(params, "power", 0);
    out[0] = out[1] = out[2] = 1;
    pbrt_colour(params, name, out);
    if (power > 0 && sphere > 0)
        scale *= power / sphere;
    else if (power > 0)
        import_note_at(p->import, params->line, "the power of a light is left out");
    for (int c = 0; c < 3; c++)
        out[c] *= scale;
}

static void read_place(pbrt *p, pbrt_params *params, double from[3], double direction[3])
{
    double to[3] = {0, 0, 1};
    matrix to_world = matrix_multiply(&p->mirror, &p->state.ctm);
    memset(from, 0, 3 * sizeof *from);
    pbrt_point(params, "from", from);
    pbrt_point(params, "to", to);
    for (int c = 0; c < 3; c++)
        direction[c] = to[c] - from[c];
    matrix_point(from, &to_world, from);
    matrix_vector(direction, &to_world, direction);
}

/* cos of the half-angles of a spot light; its power by its intensity. */
static double spot_sphere(double inner, double outer)
{
    double a = cos(inner * pi / 180), b = cos(outer * pi / 180);
    return 2 * pi * ((1 - a) + (a - b) / 2);
}

/*
 * Images of pbrt-v4 are octahedral, those of pbrt-v3, whose `mapname` they have, of longitude and
 * latitude.
 */
static void read_infinite(pbrt *p, pbrt_params *params)
{
    /* Our z, the left edge of an image, is its x, our y its z and our x against its y. */
    static const matrix axes = {{{0, 0, 1, 0}, {-1, 0, 0, 0}, {0, 1, 0, 0}}};
    const matrix mirrored = matrix_multiply(&p->mirror, &p->state.ctm),
                 to_world = matrix_multiply(&mirrored, &axes);
    const char *octahedral = pbrt_string(params, "filename", NULL),
               *map = pbrt_string(params, "mapname", NULL);
    double radiance[3];
    char file[512];
    int has_image = 0;
    read_emission(p, params, "L", 0, radiance);
    if (octahedral)
        has_image = import_octahedral_sky(p->import, params->line, file, octahedral);
    else if (map)
        has_image = import_image_file(p->import, params->line, file, map);
    import_set_environment(p->import, params->line, radiance, has_image ? file : NULL, &to_world);
}

void pbrt_light(pbrt *p, pbrt_params *params, const char *type)
{
    double from[3], direction[3], colour[3];
    if (strcmp(type, "point") == 0) {
        read_place(p, params, from, direction);
        read_emission(p, params, "I", 4 * pi, colour);
        import_add_point_light(p->import, params->line, from, colour);
    } else if (strcmp(type, "spot") == 0) {
        import_spot spot = {.outer = pbrt_number(params, "coneangle", 30), .falloff = "smooth"};
        spot.inner = fmax(0, spot.outer - pbrt_number(params, "conedeltaangle", 5));
        read_place(p, params, spot.position, spot.direction);
        read_emission(p, params, "I", spot_sphere(spot.inner, spot.outer), spot.intensity);
        import_add_spot_light(p->import, params->line, &spot);
    } else if (strcmp(type, "distant") == 0) {
        read_place(p, params, from, direction);
        read_emission(p, params, "L", 0, colour);
        import_add_directional_light(p->import, params->line, direction, colour);
    } else if (strcmp(type, "infinite") == 0) {
        read_infinite(p, params);
    } else {
        import_note_at(p->import, params->line, "a light '%.40s' is left out", type);
        return;
    }
    pbrt_note_unused(params, type);
}

void pbrt_area_light(pbrt *p, pbrt_params *params, const char *type)
{
    if (strcmp(type, "diffuse") != 0)
        import_note_at(p->import, params->line, "an area light '%.40s' became diffuse", type);
    read_emission(p, params, "L", 0, p->state.radiance);
    p->state.is_two_sided = pbrt_flag(params, "twosided", 0);
    pbrt_note_unused(params, "an area light");
}
