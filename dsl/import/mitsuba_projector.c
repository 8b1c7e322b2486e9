/* mitsuba_projector.c - images of Mitsuba's lights: projectors, and textures of spots. */
#include <string.h>

#include "dsl/import/mitsuba.h"

static int is_texture(const xml_node *child)
{
    return child && (strcmp(child->tag, "texture") == 0 || strcmp(child->tag, "ref") == 0);
}

/*
 * The image of a texture by this name, copied beside the scene; 0 where there is none, which is
 * told where there is a texture.
 */
static int read_image(mitsuba *m, xml_node *node, const char *name, mitsuba_image *out)
{
    xml_node *child = rt_mitsuba_child(node, name), *texture;
    if (!is_texture(child))
        return 0;
    texture = rt_mitsuba_follow(m, child);
    if (!texture)
        return 0;
    rt_mitsuba_read(m, child, texture);
    const char *type = rt_mitsuba_text(m, texture, "type"),
               *file = rt_mitsuba_string(m, texture, "filename"),
               *filter = rt_mitsuba_string(m, texture, "filter_type"),
               *wrap = rt_mitsuba_string(m, texture, "wrap_mode");
    if (strcmp(type, "bitmap") != 0 || !file) {
        rt_import_note_at(rt_mitsuba_at(m, texture), texture->line,
                          "the texture '%.40s' of a light is left out: it is no image file", type);
        rt_mitsuba_leave(texture);
        return 0;
    }
    if (rt_mitsuba_flag(m, texture, "raw", 0))
        rt_import_note_at(rt_mitsuba_at(m, texture), texture->line,
                          "the image of a light is linear only in files of floats, whatever 'raw' "
                          "says");
    matrix to_uv = rt_mitsuba_transform(m, texture, "to_uv");
    if (!rt_matrix_is_identity(&to_uv))
        rt_import_note_at(rt_mitsuba_at(m, texture), texture->line,
                          "to_uv of the image of a light is left out");
    out->repeats = !wrap || strcmp(wrap, "repeat") == 0; /* a mirrored one does not differ there */
    out->is_nearest = filter && strcmp(filter, "nearest") == 0;
    return rt_import_image_size(rt_mitsuba_at(m, texture), texture->line, file, out->size) &&
           rt_import_image_file(rt_mitsuba_at(m, texture), texture->line, out->file, file);
}

/* Mitsuba shows it turned by 180 degrees. */
void rt_mitsuba_spot_image(mitsuba *m, xml_node *node, const matrix *to_world, import_spot *spot,
                           mitsuba_image *image)
{
    static const double down[3] = {0, -1, 0};
    if (!read_image(m, node, "texture", image))
        return;
    spot->image.file = image->file;
    spot->image.is_nearest = image->is_nearest;
    spot->image.repeats = image->repeats;
    rt_matrix_vector(spot->image.up, to_world, down);
}

/* An image of one white pixel for a projector that is even; its colour is multiplied. */
static int read_even(mitsuba *m, xml_node *node, double colour[3], char file[512])
{
    static const char white[] = "P2 1 1 1 1\n";
    double irradiance[3] = {1, 1, 1};
    rt_mitsuba_colour(m, node, "irradiance", irradiance);
    for (int c = 0; c < 3; c++)
        colour[c] *= irradiance[c];
    return rt_import_image_bytes(rt_mitsuba_at(m, node), node->line, file, "even.pgm", white,
                                 sizeof white - 1);
}

/* Its picture has pi times the texture's values, 1 m away. */
void rt_mitsuba_projector(mitsuba *m, xml_node *node, const matrix *to_world)
{
    static const double origin[3] = {0, 0, 0}, forward[3] = {0, 0, 1}, up[3] = {0, 1, 0};
    const double scale = rt_mitsuba_number(m, node, "scale", 1);
    import_projector projector = {
        .colour = {IMPORT_PI * scale, IMPORT_PI * scale, IMPORT_PI * scale}};
    mitsuba_image image = {.size = {1, 1}};
    if (is_texture(rt_mitsuba_child(node, "irradiance"))
            ? !read_image(m, node, "irradiance", &image)
            : !read_even(m, node, projector.colour, image.file)) {
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "a projector without an image file is left out");
        rt_mitsuba_leave(node);
        return;
    }
    projector.fov = rt_mitsuba_fov(m, node, (double)image.size[0] / image.size[1]);
    projector.image.file = image.file;
    projector.image.is_nearest = image.is_nearest;
    projector.image.repeats = image.repeats;
    rt_matrix_point(projector.position, to_world, origin);
    rt_matrix_vector(projector.direction, to_world, forward);
    rt_matrix_vector(projector.image.up, to_world, up);
    if (rt_matrix_determinant(to_world) < 0)
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "the mirroring of a projector is left out");
    rt_import_add_projector(rt_mitsuba_at(m, node), node->line, &projector);
}
