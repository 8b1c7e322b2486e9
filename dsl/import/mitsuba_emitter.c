/* mitsuba_emitter.c - emitters and sensors of Mitsuba 3. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "dsl/import/mitsuba.h"

static const double degrees = 180 / IMPORT_PI;

/* ---- Emitters ---------------------------------------------------------------- */

static void read_point(mitsuba *m, xml_node *node, const matrix *to_world)
{
    static const double origin[3] = {0, 0, 0};
    double intensity[3] = {1, 1, 1}, position[3];
    rt_mitsuba_colour(m, node, "intensity", intensity);
    if (!rt_mitsuba_vector(m, node, "position", position))
        rt_matrix_point(position, to_world, origin);
    else if (!rt_matrix_is_identity(to_world))
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "to_world of a light with a position is left out");
    rt_import_add_point_light(rt_mitsuba_at(m, node), node->line, position, intensity);
}

static void read_spot(mitsuba *m, xml_node *node, const matrix *to_world)
{
    static const double origin[3] = {0, 0, 0}, forward[3] = {0, 0, 1};
    import_spot spot = {.intensity = {1, 1, 1}, .falloff = "linear"};
    mitsuba_image image;
    spot.outer = rt_mitsuba_number(m, node, "cutoff_angle", 20);
    spot.inner = rt_mitsuba_number(m, node, "beam_width", spot.outer * 0.75);
    rt_mitsuba_colour(m, node, "intensity", spot.intensity);
    rt_matrix_point(spot.position, to_world, origin);
    rt_matrix_vector(spot.direction, to_world, forward);
    rt_mitsuba_spot_image(m, node, to_world, &spot, &image);
    rt_import_add_spot_light(rt_mitsuba_at(m, node), node->line, &spot);
}

static void read_directional(mitsuba *m, xml_node *node, const matrix *to_world)
{
    static const double forward[3] = {0, 0, 1};
    double irradiance[3] = {1, 1, 1}, direction[3];
    rt_mitsuba_colour(m, node, "irradiance", irradiance);
    if (!rt_mitsuba_vector(m, node, "direction", direction))
        rt_matrix_vector(direction, to_world, forward);
    else if (!rt_matrix_is_identity(to_world))
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "to_world of a light with a direction is left out");
    rt_import_add_directional_light(rt_mitsuba_at(m, node), node->line, direction, irradiance);
}

/* Its image has u = 0 towards -z, where ours has its middle. A translation does nothing. */
static void read_envmap(mitsuba *m, xml_node *node, const matrix *to_world)
{
    char file[512];
    const char *name = rt_mitsuba_string(m, node, "filename");
    double scale = rt_mitsuba_number(m, node, "scale", 1), radiance[3] = {scale, scale, scale};
    if (!name) {
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "an envmap without filename is left out");
        return;
    }
    const matrix half_turn = rt_matrix_scale(-1, 1, -1),
                 place = rt_matrix_multiply(to_world, &half_turn);
    if (fabs(fabs(rt_matrix_determinant(to_world)) - 1) > 1e-3)
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "the scale of an envmap's to_world, which distorts it, is left out");
    if (rt_import_mitsuba_sky(rt_mitsuba_at(m, node), node->line, file, name))
        rt_import_set_environment(rt_mitsuba_at(m, node), node->line, radiance, file, &place);
}

void rt_mitsuba_emitter(mitsuba *m, xml_node *node)
{
    const char *type = rt_mitsuba_text(m, node, "type");
    double radiance[3] = {1, 1, 1};
    if (strcmp(type, "area") == 0 && rt_xml_attribute(node, "id"))
        return; /* of the shapes that name it */
    node->is_read = READ;
    matrix to_world = rt_mitsuba_transform(m, node, "to_world");
    if (strcmp(type, "point") == 0) {
        read_point(m, node, &to_world);
    } else if (strcmp(type, "spot") == 0) {
        read_spot(m, node, &to_world);
    } else if (strcmp(type, "projector") == 0) {
        rt_mitsuba_projector(m, node, &to_world);
    } else if (strcmp(type, "directional") == 0) {
        read_directional(m, node, &to_world);
    } else if (strcmp(type, "envmap") == 0) {
        read_envmap(m, node, &to_world);
    } else if (strcmp(type, "sunsky") == 0 || strcmp(type, "sky") == 0 ||
               strcmp(type, "sun") == 0) {
        rt_mitsuba_daylight(m, node, type, &to_world);
    } else if (strcmp(type, "constant") == 0) {
        rt_mitsuba_colour(m, node, "radiance", radiance);
        rt_import_set_environment(rt_mitsuba_at(m, node), node->line, radiance, NULL, NULL);
    } else {
        rt_import_note_at(rt_mitsuba_at(m, node), node->line, "an emitter '%.40s' is left out",
                          type);
        rt_mitsuba_leave(node);
    }
}

/* ---- The sensor -------------------------------------------------------------- */

/* The part of the film that is rendered, as rt_import_crop_camera has it; the film becomes that. */
static void read_crop(mitsuba *m, xml_node *film, double part[4], double *width, double *height)
{
    const double w = rt_mitsuba_number(m, film, "crop_width", *width),
                 h = rt_mitsuba_number(m, film, "crop_height", *height),
                 x = rt_mitsuba_number(m, film, "crop_offset_x", 0),
                 y = rt_mitsuba_number(m, film, "crop_offset_y", 0);
    if (!(w >= 1 && h >= 1 && x >= 0 && y >= 0 && x + w <= *width && y + h <= *height)) {
        rt_import_note_at(rt_mitsuba_at(m, film), film->line,
                          "a crop window of %g x %g pixels at %g, %g does not fit into the film of "
                          "%g x %g: the whole film is rendered",
                          w, h, x, y, *width, *height);
        return;
    }
    part[0] = x / *width;
    part[1] = y / *height;
    part[2] = w / *width;
    part[3] = h / *height;
    *width = w;
    *height = h;
}

/* The last element of a tag in another, marked, or NULL; it is told where there are several. */
static xml_node *take_last(mitsuba *m, xml_node *node, const char *tag)
{
    xml_node *last = NULL;
    for (xml_node *child = node->first; child; child = child->next) {
        if (strcmp(child->tag, tag) != 0)
            continue;
        if (last)
            rt_import_note_at(rt_mitsuba_at(m, child), child->line,
                              "a second %s takes the place of the first", tag);
        child->is_read = READ;
        last = child;
    }
    return last;
}

static const char *read_filter(mitsuba *m, xml_node *node, double *radius)
{
    static const struct {
        const char *name, *filter;
    } filters[] = {
        {"box", "box"}, {"tent", "tent"}, {"gaussian", "gaussian"}, {"mitchell", "mitchell"}};
    const char *const type = rt_mitsuba_text(m, node, "type");
    size_t i = 0;
    while (i < 4 && strcmp(filters[i].name, type) != 0)
        i++;
    if (i == 4)
        rt_import_note_at(rt_mitsuba_at(m, node), node->line, "the filter '%.40s' became gaussian",
                          type);
    const char *const filter = i < 4 ? filters[i].filter : "gaussian";
    /* The language's ends at three deviations, Mitsuba's at four. */
    if (strcmp(filter, "tent") == 0)
        *radius = rt_mitsuba_number(m, node, "radius", 0);
    else if (strcmp(filter, "gaussian") == 0)
        *radius = 3 * rt_mitsuba_number(m, node, "stddev", 0);
    if (*radius != 0 && !(*radius >= 0.01 && *radius <= 64)) {
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "a filter of radius %g became one of its default radius", *radius);
        *radius = 0;
    }
    return filter;
}

/* Size of the film and its filter, the shape of the whole film, and the part that is rendered. */
static void read_film(mitsuba *m, xml_node *sensor, double *aspect, double part[4])
{
    static const char *const types[] = {"hdrfilm", "specfilm", "ldrfilm", "tiledhdrfilm", NULL};
    xml_node *const film = take_last(m, sensor, "film"), *const own =
                                                             film ? take_last(m, film, "rfilter")
                                                                  : NULL;
    double width = 768, height = 576, radius = 0;
    if (film) {
        rt_mitsuba_note_type(m, film, types);
        width = rt_mitsuba_number(m, film, "width", width);
        height = rt_mitsuba_number(m, film, "height", height);
    }
    if (!(width >= 1 && width <= 65536 && height >= 1 && height <= 65536 &&
          width * height <= 268435456)) {
        rt_import_note_at(rt_mitsuba_at(m, film), film->line,
                          "a film of %g x %g pixels became 768 x 576", width, height);
        width = 768;
        height = 576;
    }
    *aspect = width / height;
    if (film)
        read_crop(m, film, part, &width, &height);
    const char *const filter = own ? read_filter(m, own, &radius) : "gaussian";
    rt_import_set_film(m->import, (uint32_t)width, (uint32_t)height, filter, radius);
}

double rt_mitsuba_fov(mitsuba *m, xml_node *node, double aspect)
{
    const char *axis = rt_mitsuba_string(m, node, "fov_axis");
    double fov = rt_mitsuba_number(m, node, "fov", NAN), tangent, millimetres = 50;
    static const char *const axes[] = {"x", "y", "diagonal", "smaller", "larger"};
    const char *length = rt_mitsuba_string(m, node, "focal_length"), *end = length;
    size_t known = 0;
    while (axis && known < 5 && strcmp(axes[known], axis) != 0)
        known++;
    if (known == 5)
        rt_import_note_at(rt_mitsuba_at(m, node), node->line, "a fov_axis '%.40s' became x", axis);
    if (!isnan(fov) && !(fov > 0 && fov < 180)) {
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "a field of view of %g degrees counts as not given", fov);
        fov = NAN;
    }
    if (length && !isnan(fov))
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "focal_length is left out beside fov");
    if (length && !(rt_import_number(&millimetres, &end) && millimetres > 0 &&
                    (strcmp(end, "mm") == 0 || *end == '\0'))) {
        rt_import_note_at(rt_mitsuba_at(m, node), node->line, "a focal_length '%.40s' became 50 mm",
                          length);
        millimetres = 50;
    }
    /* Of film of 36 x 24 mm, along its diagonal. */
    if (isnan(fov))
        fov = 2 * atan(sqrt(36.0 * 36 + 24 * 24) / 2 / millimetres) * degrees, axis = "diagonal";
    tangent = tan(fov / 2 / degrees);
    if (axis && (strcmp(axis, "y") == 0 || (strcmp(axis, "smaller") == 0 && aspect > 1) ||
                 (strcmp(axis, "larger") == 0 && aspect < 1)))
        tangent *= aspect;
    else if (axis && strcmp(axis, "diagonal") == 0)
        tangent *= aspect / sqrt(1 + aspect * aspect);
    return 2 * atan(tangent) * degrees;
}

static void note_scale(mitsuba *m, const xml_node *node, const matrix *to_world)
{
    const double across = rt_matrix_axis_length(to_world, 0),
                 upright = rt_matrix_axis_length(to_world, 1);
    if (fabs(across / upright - 1) > 1e-4)
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "a sensor that is scaled by %g across and %g upwards is taken as scaled "
                          "by the former: pixels are square",
                          across, upright);
}

/* Keeps between which depths the sensor sees, Mitsuba's by default. */
static void read_clip(mitsuba *m, xml_node *node, const import_camera *camera)
{
    const import_plane planes[2] = {{"near_clip", rt_mitsuba_number(m, node, "near_clip", 1e-2)},
                                    {"far_clip", rt_mitsuba_number(m, node, "far_clip", 1e4)}};
    rt_import_keep_clip(rt_mitsuba_at(m, node), node->line, planes, camera);
}

/* A pinhole has no focus, though its distance is often written. */
static void read_lens(mitsuba *m, xml_node *node, int has_lens, import_camera *camera)
{
    const double focus = rt_mitsuba_number(m, node, "focus_distance", 0),
                 aperture = has_lens ? rt_mitsuba_number(m, node, "aperture_radius", 0) : 0;
    if (aperture < 0 || (has_lens && focus < 0)) {
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "the lens of aperture_radius %g and focus_distance %g is left out",
                          aperture, focus);
        return;
    }
    camera->aperture = aperture;
    camera->focal_distance = has_lens ? focus : 0;
    if (aperture > 0 && focus == 0)
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "a thinlens without a focus_distance above 0 is focused at 1");
}

void rt_mitsuba_sensor(mitsuba *m, xml_node *node)
{
    static const double origin[3] = {0, 0, 0}, forward[3] = {0, 0, 1}, up[3] = {0, 1, 0};
    const char *type = rt_mitsuba_text(m, node, "type");
    import_camera camera = {0};
    matrix to_world = rt_mitsuba_transform(m, node, "to_world");
    double aspect = 1, part[4] = {0, 0, 1, 1};
    node->is_read = READ;
    if (strcmp(type, "perspective") != 0 && strcmp(type, "thinlens") != 0 &&
        strcmp(type, "orthographic") != 0) {
        rt_import_note_at(rt_mitsuba_at(m, node), node->line, "a sensor '%.40s' is left out", type);
        rt_mitsuba_leave(node);
        return;
    }
    if (!rt_import_takes_camera(rt_mitsuba_at(m, node), node->line, rt_xml_attribute(node, "id"),
                                NULL)) {
        rt_mitsuba_leave(node);
        return;
    }
    read_film(m, node, &aspect, part);
    xml_node *const sampler = take_last(m, node, "sampler");
    if (sampler)
        rt_mitsuba_sampler(m, sampler);
    rt_matrix_point(camera.eye, &to_world, origin);
    rt_matrix_vector(camera.direction, &to_world, forward);
    rt_matrix_vector(camera.up, &to_world, up);
    camera.is_mirrored = rt_matrix_determinant(&to_world) < 0;
    note_scale(m, node, &to_world);
    camera.is_orthographic = strcmp(type, "orthographic") == 0;
    camera.width = 2 * rt_matrix_axis_length(&to_world, 0);
    camera.fov = camera.is_orthographic ? 45 : rt_mitsuba_fov(m, node, aspect);
    read_lens(m, node, strcmp(type, "thinlens") == 0, &camera);
    camera.shift[0] = rt_mitsuba_number(m, node, "principal_point_offset_x", 0);
    camera.shift[1] = -rt_mitsuba_number(m, node, "principal_point_offset_y", 0);
    rt_import_crop_camera(&camera, part);
    read_clip(m, node, &camera);
    rt_import_set_camera(rt_mitsuba_at(m, node), node->line, &camera);
}
