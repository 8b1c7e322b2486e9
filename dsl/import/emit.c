/* emit.c - blocks of the new scene: shapes, lights, the camera and the film. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "dsl/import/import.h"

int rt_import_is_black(const double colour[3])
{
    return colour[0] == 0 && colour[1] == 0 && colour[2] == 0;
}

void rt_import_put_field(importer *import, import_text *out, const char *field,
                         const double *values, int count)
{
    rt_import_put(import, out, " %s", field);
    rt_import_put_numbers(import, out, values, count);
}

int rt_import_put_colour(importer *import, int line, import_text *out, const char *field,
                         const double colour[3])
{
    double positive[3];
    int is_below = 0, is_above = 0;
    for (int c = 0; c < 3; c++) {
        is_below |= colour[c] < 0;
        is_above |= colour[c] > IMPORT_COLOUR_MAX;
        positive[c] = colour[c] > 0 ? fmin(colour[c], IMPORT_COLOUR_MAX) : 0;
    }
    if (is_below)
        rt_import_note_at(import, line, "a negative %s became 0", field);
    if (is_above)
        rt_import_note_at(import, line, "a component of %s above %g became that", field,
                          IMPORT_COLOUR_MAX);
    if (rt_import_is_black(positive))
        return 0;
    rt_import_put_field(import, out, field, positive, 3);
    return 1;
}

/* ---- Shapes ------------------------------------------------------------------ */

void rt_import_bound(importer *import, const matrix *to_world, const double lo[3],
                     const double hi[3])
{
    for (int corner = 0; corner < 8; corner++) {
        double p[3] = {corner & 1 ? hi[0] : lo[0], corner & 2 ? hi[1] : lo[1],
                       corner & 4 ? hi[2] : lo[2]};
        rt_matrix_point(p, to_world, p);
        for (int c = 0; c < 3; c++) {
            import->lo[c] = p[c] < import->lo[c] ? p[c] : import->lo[c];
            import->hi[c] = p[c] > import->hi[c] ? p[c] : import->hi[c];
        }
    }
}

/* Whether a shape can be placed so; notes or fails where it cannot. */
static int can_place(importer *import, int line, const matrix *to_world)
{
    if (++import->shape_count > IMPORT_SHAPES_MAX)
        return rt_import_fail(import, line, "the scene has more than %d shapes", IMPORT_SHAPES_MAX);
    if (!rt_matrix_is_finite(to_world))
        return rt_import_fail(import, line, "a transform is not finite");
    if (!rt_matrix_can_place(to_world)) {
        rt_import_note_at(import, line, "a shape whose transform has no inverse is left out");
        return 0;
    }
    if (rt_matrix_largest(to_world) > IMPORT_COORDINATE_MAX) {
        rt_import_note_at(import, line,
                          "a shape whose transform has the entry %g, beyond %g, is left out",
                          rt_matrix_largest(to_world), IMPORT_COORDINATE_MAX);
        return 0;
    }
    return 1;
}

static void put_surface(importer *import, int line, const import_surface *surface)
{
    import_text *out = &import->shapes;
    rt_import_put(import, out, " material %s", rt_import_label(import, surface->material));
    import->solid_count +=
        surface->material >= 0 && (size_t)surface->material < import->label_count &&
                           import->labels[surface->material].is_solid;
    const int is_light = rt_import_put_colour(import, line, out, "radiance", surface->radiance);
    import->has_light |= is_light;
    if (is_light)
        rt_import_put_texture(import, out, "texture", surface->texture);
    if (!rt_matrix_is_identity(&surface->to_world))
        rt_import_put_field(import, out, "matrix", surface->to_world.m[0], 12);
    rt_import_put(import, out, " }\n");
}

int rt_import_is_light(const import_surface *surface)
{
    return surface->radiance[0] > 0 || surface->radiance[1] > 0 || surface->radiance[2] > 0;
}

int rt_import_add_instance(importer *import, int line, int mesh, const import_surface *surface)
{
    if (import->failed || mesh == IMPORT_NONE || !can_place(import, line, &surface->to_world))
        return 0;
    rt_import_put(import, &import->shapes, "instance %s {", rt_import_label(import, mesh));
    put_surface(import, line, surface);
    return 1;
}

void rt_import_add_shape(importer *import, int line, const char *block, const double lo[3],
                         const double hi[3], const import_surface *surface)
{
    if (import->failed || !can_place(import, line, &surface->to_world))
        return;
    rt_import_bound(import, &surface->to_world, lo, hi);
    rt_import_put(import, &import->shapes, "%s", block);
    put_surface(import, line, surface);
}

/* ---- Camera and film --------------------------------------------------------- */

void rt_import_set_camera(importer *import, int line, const import_camera *camera)
{
    import_text *out = &import->camera_block;
    double look_at[3], direction[3], up[3], across[3];
    memcpy(direction, camera->direction, sizeof direction);
    memcpy(up, camera->up, sizeof up);
    rt_vector_cross(across, direction, up);
    if (!rt_vector_normalize(direction) || !rt_vector_normalize(across)) {
        rt_import_fail(import, line, "the camera has no direction, or its up is along it");
        return;
    }
    double reach = camera->focal_distance > 0 ? camera->focal_distance : 1, ahead = reach;
    /* Far from the origin numbers of single precision lie apart. */
    for (int c = 0; c < 3; c++)
        ahead = fmax(ahead, 1e-6 * fabs(camera->eye[c]));
    for (int c = 0; c < 3; c++)
        look_at[c] = camera->eye[c] + ahead * direction[c];
    rt_import_put(import, out, "camera {\n");
    if (camera->is_orthographic)
        rt_import_put(import, out, " projection orthographic\n");
    rt_import_put_field(import, out, "eye", camera->eye, 3);
    rt_import_put(import, out, "\n");
    rt_import_put_field(import, out, "look_at", look_at, 3);
    rt_import_put(import, out, "\n");
    rt_import_put_field(import, out, "up", up, 3);
    rt_import_put(import, out, "\n");
    rt_import_put_field(import, out, camera->is_orthographic ? "width" : "fov",
                        camera->is_orthographic ? &camera->width : &camera->fov, 1);
    rt_import_put(import, out, "\n");
    if (camera->aperture > 0) {
        rt_import_put_field(import, out, "aperture", &camera->aperture, 1);
        rt_import_put(import, out, "\n");
        rt_import_put_field(import, out, "focal_distance", &reach, 1);
        rt_import_put(import, out, "\n");
    }
    if (camera->shift[0] != 0 || camera->shift[1] != 0) {
        if (!(fabs(camera->shift[0]) <= 1000 && fabs(camera->shift[1]) <= 1000)) {
            rt_import_fail(import, line, "the camera sees a part far off its axis");
            return;
        }
        rt_import_put_field(import, out, "shift", camera->shift, 2);
        rt_import_put(import, out, "\n");
    }
    if (camera->is_mirrored)
        rt_import_put(import, out, " mirror true\n");
    import->has_camera = 1;
}

void rt_import_crop_camera(import_camera *camera, const double part[4])
{
    static const double half_degree = IMPORT_PI / 360;
    camera->shift[0] = 0.5 - (0.5 - camera->shift[0] - part[0]) / part[2];
    camera->shift[1] = (0.5 + camera->shift[1] - part[1]) / part[3] - 0.5;
    camera->fov = atan(part[2] * tan(camera->fov * half_degree)) / half_degree;
    camera->width *= part[2];
}

void rt_import_set_film(importer *import, uint32_t width, uint32_t height, const char *filter,
                        double radius)
{
    import->width = width;
    import->height = height;
    rt_import_put(import, &import->settings, "film { width %lu height %lu", (unsigned long)width,
                  (unsigned long)height);
    if (filter)
        rt_import_put(import, &import->settings, " filter %s", filter);
    if (radius > 0)
        rt_import_put_field(import, &import->settings, "filter_radius", &radius, 1);
    rt_import_put(import, &import->settings, " }\n");
}

/* ---- Lights ------------------------------------------------------------------ */

/* Black is light too, as the file has it. */
static void put_light_colour(importer *import, int line, const char *field, const double colour[3])
{
    if (!rt_import_put_colour(import, line, &import->lights, field, colour))
        rt_import_put(import, &import->lights, " %s 0", field);
    rt_import_put(import, &import->lights, " }\n");
    import->has_light = 1;
}

void rt_import_add_point_light(importer *import, int line, const double position[3],
                               const double intensity[3])
{
    rt_import_put(import, &import->lights, "light point {");
    rt_import_put_field(import, &import->lights, "position", position, 3);
    put_light_colour(import, line, "intensity", intensity);
}

static void put_image(importer *import, const import_light_image *image)
{
    if (!image->file)
        return;
    rt_import_put(import, &import->lights, " file \"%s\"", image->file);
    rt_import_put_field(import, &import->lights, "up", image->up, 3);
    if (image->is_nearest)
        rt_import_put(import, &import->lights, " filter nearest");
    else if (image->repeats)
        rt_import_put(import, &import->lights, " repeat true");
}

void rt_import_add_spot_light(importer *import, int line, const import_spot *spot)
{
    const double *const direction = spot->direction;
    double target[3], d[3] = {direction[0], direction[1], direction[2]};
    if (!rt_vector_normalize(d)) {
        rt_import_note_at(import, line, "a spot light without a direction is left out");
        return;
    }
    if (!(spot->outer > 0) || spot->outer > 180 || !(spot->inner >= 0) ||
        spot->inner > spot->outer) {
        rt_import_note_at(import, line,
                          "a spot light is left out: its cone ends at %.9g degrees, which must lie "
                          "between 0 and 180, and begins to fall off at %.9g, from 0 up to there",
                          spot->outer, spot->inner);
        return;
    }
    for (int c = 0; c < 3; c++)
        target[c] = spot->position[c] + d[c];
    rt_import_put(import, &import->lights, "light spot {");
    rt_import_put_field(import, &import->lights, "position", spot->position, 3);
    rt_import_put_field(import, &import->lights, "target", target, 3);
    rt_import_put_field(import, &import->lights, "outer", &spot->outer, 1);
    rt_import_put_field(import, &import->lights, "inner", &spot->inner, 1);
    if (strcmp(spot->falloff, "smooth") != 0)
        rt_import_put(import, &import->lights, " falloff %s", spot->falloff);
    put_image(import, &spot->image);
    put_light_colour(import, line, "intensity", spot->intensity);
}

/* Where a light is, and where to; 0 after a failure. */
static int put_aim(importer *import, int line, const char *kind, const double position[3],
                   const double direction[3])
{
    double target[3], d[3] = {direction[0], direction[1], direction[2]};
    if (!rt_vector_normalize(d)) {
        rt_import_fail(import, line, "a light '%s' has no direction", kind);
        return 0;
    }
    /* Far from the origin a target 1 m away would be rounded to another direction. */
    const double far = rt_vector_length(position), length = far > 64 ? far : 1;
    for (int c = 0; c < 3; c++)
        target[c] = position[c] + length * d[c];
    rt_import_put(import, &import->lights, "light %s {", kind);
    rt_import_put_field(import, &import->lights, "position", position, 3);
    rt_import_put_field(import, &import->lights, "target", target, 3);
    return 1;
}

void rt_import_add_projector(importer *import, int line, const import_projector *projector)
{
    if (!(projector->fov >= 1e-3 && projector->fov <= 179)) {
        rt_import_note_at(import, line, "a projector of %.6g degrees is left out", projector->fov);
        return;
    }
    if (!put_aim(import, line, "projector", projector->position, projector->direction))
        return;
    rt_import_put_field(import, &import->lights, "fov", &projector->fov, 1);
    put_image(import, &projector->image);
    put_light_colour(import, line, projector->is_intensity ? "intensity" : "irradiance",
                     projector->colour);
}

void rt_import_add_goniometric(importer *import, int line, const import_goniometric *light)
{
    if (!put_aim(import, line, "goniometric", light->position, light->direction))
        return;
    put_image(import, &light->image);
    put_light_colour(import, line, "intensity", light->intensity);
}

void rt_import_add_beam(importer *import, int line, const import_beam *beam)
{
    if (!put_aim(import, line, "beam", beam->position, beam->direction))
        return;
    rt_import_put_field(import, &import->lights, "up", beam->up, 3);
    rt_import_put_field(import, &import->lights, "width", &beam->width, 1);
    if (beam->height != beam->width)
        rt_import_put_field(import, &import->lights, "height", &beam->height, 1);
    if (!beam->is_round)
        rt_import_put(import, &import->lights, " cross_section rectangular");
    put_light_colour(import, line, "irradiance", beam->irradiance);
}

void rt_import_add_directional_light(importer *import, int line, const double direction[3],
                                     const double irradiance[3])
{
    double d[3] = {direction[0], direction[1], direction[2]};
    if (!rt_vector_normalize(d)) {
        rt_import_fail(import, line, "a directional light has no direction");
        return;
    }
    rt_import_put(import, &import->lights, "light directional {");
    rt_import_put_field(import, &import->lights, "direction", d, 3);
    put_light_colour(import, line, "irradiance", irradiance);
}

void rt_import_add_portal(importer *import, const double corner[3], const double edge1[3],
                          const double edge2[3])
{
    rt_import_put(import, &import->lights, "portal {");
    rt_import_put_field(import, &import->lights, "corner", corner, 3);
    rt_import_put_field(import, &import->lights, "edge1", edge1, 3);
    rt_import_put_field(import, &import->lights, "edge2", edge2, 3);
    rt_import_put(import, &import->lights, " }\n");
}

int rt_import_bounded(importer *import, int line, const char *name, double value, int most)
{
    const int taken = value < 1 ? 1 : value > most ? most : (int)value;
    if (value < 1 || value > most)
        rt_import_note_at(import, line, "%s %.9g became %d", name, value, taken);
    return taken;
}

/* The turn of a sky, about y in degrees where that is all. */
static void put_turn(importer *import, int line, const matrix *to_world)
{
    static const double degrees = 180 / IMPORT_PI;
    matrix turn = *to_world;
    const double size = rt_matrix_axis_length(&turn, 1);
    if (!(size > 0) || !rt_matrix_nearly_keeps_angles(&turn, 5e-4)) {
        rt_import_note_at(import, line, "the transform of a sky is left out: it is not a rotation");
        return;
    }
    for (int i = 0; i < 12; i++)
        turn.m[i / 4][i % 4] = i % 4 == 3 ? 0 : turn.m[i / 4][i % 4] / size;
    double rotation = atan2(turn.m[0][2], turn.m[2][2]) * degrees;
    if (fabs(turn.m[1][1] - 1) > 1e-12 || rt_matrix_determinant(&turn) < 0)
        rt_import_put_field(import, &import->lights, "matrix", turn.m[0], 12);
    else if (fabs(rotation) > 1e-9)
        rt_import_put_field(import, &import->lights, "rotation", &rotation, 1);
}

/* Even skies add up: their sum is put at last. */
static void keep_even_sky(importer *import, int line, const double radiance[3])
{
    if (fmin(radiance[0], fmin(radiance[1], radiance[2])) < 0)
        rt_import_note_at(import, line, "the negative radiance of a sky became 0");
    for (int c = 0; c < 3; c++)
        import->even_sky[c] += fmax(radiance[c], 0);
    import->has_even_sky = import->has_light = 1;
}

void rt_import_put_even_sky(importer *import)
{
    if (!import->has_even_sky)
        return;
    rt_import_put(import, &import->lights, "light environment {");
    put_light_colour(import, 0, "radiance", import->even_sky);
}

void rt_import_set_environment(importer *import, int line, const double radiance[3],
                               const char *file, const matrix *to_world)
{
    if (import->has_environment || (file && import->has_even_sky)) {
        rt_import_note_at(import, line, "a second environment light is left out");
        return;
    }
    if (!file) {
        keep_even_sky(import, line, radiance);
        return;
    }
    import->has_environment = 1;
    rt_import_put(import, &import->lights, "light environment { file \"%s\"", file);
    if (to_world)
        put_turn(import, line, to_world);
    put_light_colour(import, line, "radiance", radiance);
}
