/*
 * mitsuba_texture.c - the textures of Mitsuba 3, and of 0.x those that scale others. They have
 * v = 0 at the top of an image; so a texture's v is turned over, and that of OBJ files, which
 * Mitsuba turns over itself.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "dsl/import/mitsuba.h"

static const char *type_of(mitsuba *m, xml_node *node)
{
    return rt_mitsuba_text(m, node, "type");
}

/* Lays a texture on its surface as to_uv says, with u and v times this, and v turned over. */
static void read_to_uv(mitsuba *m, xml_node *node, import_texture *texture, double scale,
                       int is_turned_over)
{
    static const matrix from_here[] = {
        [MITSUBA_UV_SAME] = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}},
        [MITSUBA_UV_BACK] = {{{-1, 0, 0, 1}, {0, 1, 0, 0}, {0, 0, 1, 0}}},
        [MITSUBA_UV_UPENDED] = {{{1, 0, 0, 0}, {0, -1, 0, 1}, {0, 0, 1, 0}}},
        [MITSUBA_UV_DISK] = {{{0, 1, 0, 0}, {-1, 0, 0, 1}, {0, 0, 1, 0}}},
        [MITSUBA_UV_DISK_TURNED] = {{{0, 1, 0, 0}, {1, 0, 0, 0}, {0, 0, 1, 0}}},
    };
    /* uscale and so on are those of Mitsuba 0.x */
    const double both = rt_mitsuba_number(m, node, "uvscale", 1);
    const matrix transform = rt_mitsuba_transform(m, node, "to_uv"),
                 size = rt_matrix_scale(rt_mitsuba_number(m, node, "uscale", both),
                                        rt_mitsuba_number(m, node, "vscale", both), 1),
                 move = rt_matrix_translate(rt_mitsuba_number(m, node, "uoffset", 0),
                                            rt_mitsuba_number(m, node, "voffset", 0), 0),
                 older = rt_matrix_multiply(&move, &size),
                 own = rt_matrix_multiply(&older, &transform),
                 to_uv = rt_matrix_multiply(&own, &from_here[m->uv]);
    double map[2][3];
    for (int i = 0; i < 2; i++) {
        const double factor = i && is_turned_over ? -scale : scale;
        for (int k = 0; k < 3; k++)
            map[i][k] = factor * to_uv.m[i][k < 2 ? k : 3];
    }
    map[1][2] += is_turned_over ? 1 : 0;
    rt_import_texture_map(texture, map);
}

/* What Mitsuba 0.x says of an image besides: 1 as gamma for data, and one of its channels. */
static void read_old_bitmap(mitsuba *m, xml_node *node, import_texture *texture)
{
    const char *const channel = rt_mitsuba_string(m, node, "channel");
    const double gamma = rt_mitsuba_number(m, node, "gamma", -1);
    texture->is_linear |= gamma == 1;
    if (gamma != 1 && gamma != -1)
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "a gamma of %g is left out: the image is taken as its format says",
                          gamma);
    if (channel && strlen(channel) == 1 && strchr("rgba", *channel))
        texture->channel = *channel;
    else if (channel)
        rt_import_note_at(rt_mitsuba_at(m, node), node->line, "the channel '%.40s' is left out",
                          channel);
}

/* How an image goes on beyond its edges, in both directions. */
static const char *read_wrap(mitsuba *m, xml_node *node)
{
    const char *const wrap = rt_mitsuba_string(m, node, "wrap_mode"),
                      *const u = rt_mitsuba_string(m, node, "wrap_mode_u"),
                      *const v = rt_mitsuba_string(m, node, "wrap_mode_v");
    if (u && v && strcmp(u, v) != 0)
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "the wrap_mode '%.40s' along v became that along u, '%.40s'", v, u);
    return u ? u : v ? v : wrap;
}

static int read_bitmap(mitsuba *m, xml_node *node, import_texture *texture)
{
    char file[512];
    const char *name = rt_mitsuba_string(m, node, "filename"), *wrap = read_wrap(m, node),
               *filter = rt_mitsuba_string(m, node, "filter_type");
    if (!name) {
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "a bitmap without filename is left out");
        return IMPORT_NONE;
    }
    read_to_uv(m, node, texture, 1, 1);
    texture->is_linear |= rt_mitsuba_flag(m, node, "raw", 0);
    read_old_bitmap(m, node, texture);
    if (!rt_import_image_file(rt_mitsuba_at(m, node), node->line, file, name))
        return IMPORT_NONE;
    texture->file = file;
    texture->wrap = wrap && strcmp(wrap, "mirror") == 0   ? 1
                    : wrap && strcmp(wrap, "repeat") != 0 ? 2
                                                          : 0;
    if (texture->wrap == 2 && strcmp(wrap, "clamp") != 0)
        rt_import_note_at(rt_mitsuba_at(m, node), node->line, "the wrap_mode '%.40s' became clamp",
                          wrap);
    texture->is_nearest = filter && strcmp(filter, "nearest") == 0;
    return rt_import_add_texture(m->import, "bitmap", texture);
}

enum { left_out = -3 }; /* the handle of a texture that was left out */

static int read_input(mitsuba *m, xml_node *node, const char *name, double out[3], int is_number);
static import_factor read_texture(mitsuba *m, xml_node *node, int is_linear, int is_number);

/* A colour, or a texture times a colour; the fallback where there is none, or it is left out. */
static import_factor read_input_factor(mitsuba *m, xml_node *node, const char *name,
                                       double fallback, int is_number)
{
    import_factor out = {IMPORT_NONE, {fallback, fallback, fallback}};
    out.handle = read_input(m, node, name, out.colour, is_number);
    return out;
}

/*
 * Where u and v are in the same half of a period Mitsuba 3 has color0, but color1 where a number is
 * asked for, not a colour.
 */
static import_factor read_checker(mitsuba *m, xml_node *node, int is_number)
{
    import_texture place = {.is_linear = 0};
    const import_factor colours[2] = {read_input_factor(m, node, "color0", 0.4, is_number),
                                      read_input_factor(m, node, "color1", 0.2, is_number)};
    read_to_uv(m, node, &place, 2, 0);
    return rt_import_checker(rt_mitsuba_at(m, node), node->line, "checker", &place,
                             &colours[is_number], &colours[!is_number]);
}

/* The texture inside of another element, whatever its name, but for a scale; or NULL. */
static xml_node *find_inside(mitsuba *m, xml_node *node)
{
    for (xml_node *child = node->first; child; child = child->next) {
        const char *name = rt_xml_attribute(child, "name");
        xml_node *texture =
            (strcmp(child->tag, "texture") == 0 || strcmp(child->tag, "ref") == 0) &&
                    !(name && strcmp(name, "scale") == 0)
                ? rt_mitsuba_follow(m, child)
                : NULL;
        if (texture && strcmp(texture->tag, "texture") == 0) {
            rt_mitsuba_read(m, child, texture);
            return texture;
        }
    }
    return NULL;
}

/* Of Mitsuba 0.x: the texture inside, whatever its name, times a number or colour. */
static import_factor read_scale(mitsuba *m, xml_node *node, int is_linear, int is_number)
{
    const import_factor scale = read_input_factor(m, node, "scale", 1, is_number);
    xml_node *const texture = find_inside(m, node);
    const import_factor none = {IMPORT_NONE, {1, 1, 1}},
                        inner = texture ? read_texture(m, texture, is_linear, is_number) : none;
    if (inner.handle == left_out)
        return inner;
    return rt_import_product(rt_mitsuba_at(m, node), node->line, "scaled", &inner, &scale);
}

/* Finds the name here of what Mitsuba calls this; returns 0 where the mesh has none. */
static int find_attribute(char own[IMPORT_NAME], const char *has, const char *name)
{
    char wanted[2 * IMPORT_NAME];
    const char *at = NULL;
    if (has && name && strlen(name) < IMPORT_NAME && !name[strcspn(name, " \t=\"\\")]) {
        snprintf(wanted, sizeof wanted, " %s=", name);
        at = strstr(has, wanted);
    }
    if (!at)
        return 0;
    at += strlen(wanted);
    snprintf(own, IMPORT_NAME, "%.*s", (int)strcspn(at, " "), at);
    return !own[strcspn(own, "\"\\")];
}

/* What vertices or faces of the mesh have, as a texture; `left_out` where it has none. */
static import_factor read_attribute(mitsuba *m, xml_node *node)
{
    const char *const name = rt_mitsuba_string(m, node, "name"), *const has =
                                                                     rt_mitsuba_attributes(m);
    const double scale = rt_mitsuba_number(m, node, "scale", 1);
    import_factor out = {left_out, {scale, scale, scale}};
    char own[IMPORT_NAME], same[2 * IMPORT_NAME];
    m->asks = 1;
    int is_there = find_attribute(own, has, name);
    /* in the language, vertices go before faces */
    snprintf(same, sizeof same, "=%s ", is_there ? own : "");
    const char *at = is_there && strncmp(name, "face_", 5) == 0 ? strstr(has, same) : NULL;
    for (; at; at = strstr(at + 1, same)) {
        const char *start = at;
        while (start[-1] != ' ')
            start--;
        is_there = is_there && strncmp(start, "face_", 5) == 0;
    }
    if (!is_there) {
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "a texture by '%.40s' of a mesh is left out", name ? name : "");
        return out;
    }
    const import_texture texture = {.pattern = IMPORT_ATTRIBUTE, .scale = {1, 1}, .attribute = own};
    out.handle = rt_import_add_texture(m->import, "attribute", &texture);
    return out;
}

import_colours rt_mitsuba_weight(mitsuba *m, xml_node *node, const char *name,
                                 const char **attribute)
{
    xml_node *const child = rt_mitsuba_child(node, name);
    xml_node *const texture =
        child && !rt_xml_attribute(child, "value") ? rt_mitsuba_follow(m, child) : NULL;
    if (!texture || strcmp(texture->tag, "texture") != 0 ||
        strcmp(type_of(m, texture), "mesh_attribute") != 0)
        return IMPORT_COLOURS_NONE;
    rt_mitsuba_read(m, child, texture);
    const char *const full = rt_mitsuba_string(m, texture, "name");
    const int is_vertex = full && strncmp(full, "vertex_", 7) == 0,
              is_face = full && strncmp(full, "face_", 5) == 0;
    *attribute = is_vertex ? full + 7 : is_face ? full + 5 : NULL;
    return is_vertex ? IMPORT_COLOURS_OF_VERTICES
           : is_face ? IMPORT_COLOURS_OF_FACES
                     : IMPORT_COLOURS_NONE;
}

/* A texture, or the colour that it is. */
static import_factor read_texture(mitsuba *m, xml_node *node, int is_linear, int is_number)
{
    import_texture texture = {.is_linear = is_linear};
    import_factor out = {IMPORT_NONE, {1, 1, 1}};
    const char *type = type_of(m, node);
    if (m->texture_depth > RT_TEXTURE_LEVELS) {
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "textures lie too deep in each other: some became colours");
        rt_mitsuba_leave(node);
        return out;
    }
    m->texture_depth++;
    if (strcmp(type, "bitmap") == 0) {
        out.handle = read_bitmap(m, node, &texture);
        out.handle = out.handle == IMPORT_NONE ? left_out : out.handle;
        if (is_linear && texture.rotate != 0)
            rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                              "the normals of a rotated map are turned with it");
    } else if (strcmp(type, "checkerboard") == 0) {
        out = read_checker(m, node, is_number);
    } else if (strcmp(type, "scale") == 0) {
        out = read_scale(m, node, is_linear, is_number);
    } else if (strcmp(type, "mesh_attribute") == 0) {
        out = read_attribute(m, node);
    } else {
        read_to_uv(m, node, &texture, 1, 0);
        rt_import_note_at(rt_mitsuba_at(m, node), node->line, "a texture '%.40s' is left out",
                          type);
        rt_mitsuba_leave(node);
        out.handle = left_out;
    }
    m->texture_depth--;
    return out;
}

static int read_input(mitsuba *m, xml_node *node, const char *name, double out[3], int is_number)
{
    xml_node *child = rt_mitsuba_child(node, name);
    if (!child || rt_mitsuba_colour(m, node, name, out))
        return IMPORT_NONE;
    xml_node *texture = rt_mitsuba_follow(m, child);
    if (!texture || strcmp(texture->tag, "texture") != 0)
        return IMPORT_NONE;
    const char *type = type_of(m, texture);
    rt_mitsuba_read(m, child, texture);
    if (strcmp(type, "uniform") == 0 || strcmp(type, "srgb") == 0 || strcmp(type, "d65") == 0) {
        rt_mitsuba_spectrum(m, texture, out);
        return IMPORT_NONE;
    }
    const import_factor factor = read_texture(m, texture, 0, is_number);
    if (factor.handle == left_out)
        return IMPORT_NONE;
    memcpy(out, factor.colour, sizeof factor.colour);
    return factor.handle;
}

int rt_mitsuba_texture(mitsuba *m, xml_node *node, const char *name, double out[3])
{
    return read_input(m, node, name, out, 0);
}

int rt_mitsuba_number_texture(mitsuba *m, xml_node *node, const char *name, double out[3])
{
    return read_input(m, node, name, out, 1);
}

int rt_mitsuba_is_raw(mitsuba *m, xml_node *node)
{
    xml_node *const texture = find_inside(m, node);
    return !texture || strcmp(type_of(m, texture), "bitmap") != 0 ||
           rt_mitsuba_flag(m, texture, "raw", 0) || rt_mitsuba_number(m, texture, "gamma", -1) == 1;
}

int rt_mitsuba_map(mitsuba *m, xml_node *node, int is_linear, double *scale)
{
    xml_node *texture = find_inside(m, node);
    for (int depth = 0; texture && strcmp(type_of(m, texture), "scale") == 0; depth++) {
        double colour[3] = {1, 1, 1};
        rt_mitsuba_colour(m, texture, "scale", colour);
        *scale *= (colour[0] + colour[1] + colour[2]) / 3;
        texture = depth < RT_TEXTURE_LEVELS ? find_inside(m, texture) : NULL;
    }
    if (!texture)
        return IMPORT_NONE;
    const import_factor map = read_texture(m, texture, is_linear, 0);
    return map.handle == left_out ? IMPORT_NONE : map.handle;
}
