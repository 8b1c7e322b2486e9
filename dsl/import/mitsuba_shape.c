/* mitsuba_shape.c - shapes of Mitsuba 3; mitsuba_mesh.c has its meshes. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "dsl/import/mitsuba.h"

/* ---- Shapes by formula ------------------------------------------------------- */

/* Numbers as the blocks of the language have them. */
static void put_block(mitsuba *m, xml_node *node, const char *start, const double *values,
                      const char *const *fields, const int *counts, const import_surface *surface,
                      double extent[2][3])
{
    import_text block = {NULL, 0, 0};
    rt_import_put(m->import, &block, "%s", start);
    for (size_t i = 0; fields[i]; i++) {
        rt_import_put(m->import, &block, " %s", fields[i]);
        rt_import_put_numbers(m->import, &block, values, counts[i]);
        values += counts[i];
    }
    if (!m->import->failed)
        rt_import_add_shape(rt_mitsuba_at(m, node), node->line, block.text, extent[0], extent[1],
                            surface);
    free(block.text);
}

/* Spheres and cylinders face outward; Mitsuba may turn them over, and mirrored spheres, too. */
static int material_of_round(mitsuba *m, xml_node *node, const import_surface *surface,
                             mitsuba_uv uv, const char *shape)
{
    const matrix own = rt_mitsuba_transform(m, node, "to_world");
    const int is_mirrored = strcmp(shape, "sphere") == 0 && rt_matrix_determinant(&own) < 0;
    return rt_mitsuba_flag(m, node, "flip_normals", 0) != is_mirrored
               ? rt_mitsuba_turned_material(m, node, surface, uv, shape)
               : surface->material;
}

/* Whether it counts how a shape lies on itself: for a texture, of its light too, or anisotropy. */
static int has_directions(mitsuba *m, const import_surface *surface)
{
    return surface->texture != IMPORT_NONE ||
           rt_import_has_directions(m->import, surface->material);
}

/* A sphere of Mitsuba has its poles at +z and -z, here at +y and -y before it is turned. */
static void place_sphere(mitsuba *m, xml_node *node, const import_surface *surface)
{
    static const char *const fields[] = {"centre", "radius", NULL};
    static const int counts[] = {3, 1};
    static const matrix turn = {{{1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}}};
    double values[4] = {0, 0, 0, rt_mitsuba_number(m, node, "radius", 1)}, extent[2][3];
    import_surface turned = *surface;
    rt_mitsuba_vector(m, node, "center", values);
    if (has_directions(m, surface)) {
        const matrix to_centre = rt_matrix_translate(values[0], values[1], values[2]),
                     placed = rt_matrix_multiply(&surface->to_world, &to_centre);
        turned.to_world = rt_matrix_multiply(&placed, &turn);
        values[0] = values[1] = values[2] = 0;
    }
    for (int c = 0; c < 3; c++) {
        extent[0][c] = values[c] - values[3];
        extent[1][c] = values[c] + values[3];
    }
    turned.material = material_of_round(m, node, surface, MITSUBA_UV_UPENDED, "sphere");
    if (!(values[3] > 1e-15))
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "a sphere of radius %g is left out: it is above 0", values[3]);
    else
        put_block(m, node, "sphere {", values, fields, counts, &turned, extent);
}

/* From -1 to 1 in x and y, facing +z. */
static void place_rectangle(mitsuba *m, xml_node *node, const import_surface *surface)
{
    static const char *const fields[] = {"corner", "edge1", "edge2", NULL};
    static const int counts[] = {3, 3, 3};
    double extent[2][3] = {{-1, -1, 0}, {1, 1, 0}};
    static const double ahead[9] = {-1, -1, 0, 2, 0, 0, 0, 2, 0},
                        back[9] = {1, -1, 0, -2, 0, 0, 0, 2, 0};
    int is_flipped = rt_mitsuba_flag(m, node, "flip_normals", 0);
    put_block(m, node, "quad {", is_flipped ? back : ahead, fields, counts, surface, extent);
}

static void place_disk(mitsuba *m, xml_node *node, const import_surface *surface)
{
    static const char *const fields[] = {"centre", "normal", "radius", NULL};
    static const int counts[] = {3, 3, 1};
    double extent[2][3] = {{-1, -1, 0}, {1, 1, 0}};
    static const double values[7] = {0, 0, 0, 0, 0, 1, 1};
    static const matrix turn = {{{1, 0, 0, 0}, {0, -1, 0, 0}, {0, 0, -1, 0}}};
    import_surface turned = *surface;
    if (rt_mitsuba_flag(m, node, "flip_normals", 0))
        turned.to_world = rt_matrix_multiply(&surface->to_world, &turn);
    put_block(m, node, "disc {", values, fields, counts, &turned, extent);
}

/* From -1 to 1; where a texture lies on it, as a mesh whose faces have their own u and v. */
static void place_cube(mitsuba *m, xml_node *node, const import_surface *surface)
{
    static const char *const fields[] = {"centre", "size", NULL};
    static const int counts[] = {3, 3};
    static const double values[6] = {0, 0, 0, 2, 2, 2};
    double extent[2][3] = {{-1, -1, -1}, {1, 1, 1}};
    const int is_turned = rt_mitsuba_flag(m, node, "flip_normals", 0);
    if (is_turned || has_directions(m, surface))
        rt_mitsuba_place_cube(m, node, is_turned, surface);
    else
        put_block(m, node, "box {", values, fields, counts, surface, extent);
}

/* Two axes across another (Duff et al. 2017), as Mitsuba has them. */
static matrix frame_of(const double n[3])
{
    const double sign = n[2] < 0 ? -1 : 1, a = -1 / (sign + n[2]), b = n[0] * n[1] * a;
    const matrix out = {{{1 + sign * n[0] * n[0] * a, b, n[0], 0},
                         {sign * b, sign + n[1] * n[1] * a, n[1], 0},
                         {-sign * n[0], -n[1], n[2], 0}}};
    return out;
}

/* Puts a cylinder up from its transform, where its angle counts. */
static matrix stand_up(const matrix *to_world, double ends[6])
{
    double axis[3] = {ends[3] - ends[0], ends[4] - ends[1], ends[5] - ends[2]};
    const double length = rt_vector_length(axis);
    rt_vector_normalize(axis);
    const matrix move = rt_matrix_translate(ends[0], ends[1], ends[2]), frame = frame_of(axis),
                 placed = rt_matrix_multiply(to_world, &move);
    memset(ends, 0, 6 * sizeof *ends);
    ends[5] = length;
    return rt_matrix_multiply(&placed, &frame);
}

static void place_cylinder(mitsuba *m, xml_node *node, const import_surface *surface)
{
    static const char *const fields[] = {"a", "b", "radius", NULL};
    static const int counts[] = {3, 3, 1};
    double values[7] = {0, 0, 0, 0, 0, 1, rt_mitsuba_number(m, node, "radius", 1)}, extent[2][3];
    import_surface turned = *surface;
    rt_mitsuba_vector(m, node, "p0", values);
    rt_mitsuba_vector(m, node, "p1", values + 3);
    turned.material = material_of_round(m, node, surface, MITSUBA_UV_SAME, "cylinder");
    if (has_directions(m, surface))
        turned.to_world = stand_up(&surface->to_world, values);
    for (int c = 0; c < 3; c++) {
        extent[0][c] = fmin(values[c], values[3 + c]) - values[6];
        extent[1][c] = fmax(values[c], values[3 + c]) + values[6];
    }
    put_block(m, node, "cylinder { caps false", values, fields, counts, &turned, extent);
}

/* ---- All --------------------------------------------------------------------- */

/* Of a shape. */
typedef enum emitter { NO_EMITTER, AREA_EMITTER, BEAM_EMITTER } emitter;

/* The radiance of the shape's own emitter. */
static emitter read_radiance(mitsuba *m, xml_node *node, import_surface *surface)
{
    emitter kind = NO_EMITTER;
    for (xml_node *at = node->first; at; at = at->next) {
        const int may_be = strcmp(at->tag, "emitter") == 0 || strcmp(at->tag, "ref") == 0;
        xml_node *const child = may_be ? rt_mitsuba_follow(m, at) : NULL;
        if (!child || strcmp(child->tag, "emitter") != 0)
            continue;
        const char *type = rt_mitsuba_text(m, child, "type");
        if (kind != NO_EMITTER) {
            rt_import_note_at(rt_mitsuba_at(m, at), at->line,
                              "a second emitter of a shape is left out");
            rt_mitsuba_leave(at);
            continue;
        }
        kind = strcmp(type, "directionalarea") == 0 ? BEAM_EMITTER : AREA_EMITTER;
        rt_mitsuba_read(m, at, child);
        if (kind == AREA_EMITTER && strcmp(type, "area") != 0)
            rt_import_note_at(rt_mitsuba_at(m, child), child->line,
                              "an emitter '%.40s' became area", type);
        for (int c = 0; c < 3; c++)
            surface->radiance[c] = 1;
        surface->texture = rt_mitsuba_texture(m, child, "radiance", surface->radiance);
        if (kind == BEAM_EMITTER && surface->texture != IMPORT_NONE)
            rt_import_note_at(rt_mitsuba_at(m, child), child->line,
                              "the texture of a directionalarea is left out");
    }
    return kind;
}

/*
 * What leaves a flat shape along its normal, as a beam that starts there; the shape itself, whose
 * radiance that was, is then none that emits.
 */
static void place_beam(mitsuba *m, xml_node *node, const char *type, import_surface *surface)
{
    static const double origin[3] = {0, 0, 0}, x[3] = {1, 0, 0}, y[3] = {0, 1, 0};
    const matrix *to_world = &surface->to_world;
    const int is_back =
        rt_mitsuba_flag(m, node, "flip_normals", 0) != (rt_matrix_determinant(to_world) < 0);
    import_beam beam = {.is_round = strcmp(type, "disk") == 0};
    double side[3];
    memcpy(beam.irradiance, surface->radiance, sizeof beam.irradiance);
    memset(surface->radiance, 0, sizeof surface->radiance);
    surface->texture = IMPORT_NONE;
    rt_matrix_point(beam.position, to_world, origin);
    rt_matrix_vector(side, to_world, x);
    rt_matrix_vector(beam.up, to_world, y);
    beam.width = 2 * rt_vector_length(side);
    beam.height = 2 * rt_vector_length(beam.up);
    const double slant = rt_vector_dot(side, beam.up) * 4 / (beam.width * beam.height);
    if ((!beam.is_round && strcmp(type, "rectangle") != 0) || !(fabs(slant) < 1e-4)) {
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "the directionalarea of a shape that is no disk or rectangle, or a "
                          "sheared one, is left out");
        return;
    }
    rt_vector_cross(beam.direction, is_back ? beam.up : side, is_back ? side : beam.up);
    rt_import_add_beam(rt_mitsuba_at(m, node), node->line, &beam);
}

/* Here the opacity of a surface counts for what it emits, too. */
static void note_mask(mitsuba *m, xml_node *node)
{
    for (xml_node *child = node->first; child; child = child->next) {
        xml_node *bsdf = strcmp(child->tag, "ref") == 0 ? rt_mitsuba_follow(m, child) : child;
        if (bsdf && strcmp(bsdf->tag, "bsdf") == 0 &&
            strcmp(rt_mitsuba_text(m, bsdf, "type"), "mask") == 0)
            rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                              "an emitter emits by the opacity of its mask");
    }
}

/* Whether a shape of a group may be placed once more, an instance of another too. */
static int may_place(mitsuba *m, const xml_node *shape)
{
    if (++m->grouped > IMPORT_SHAPES_MAX)
        rt_import_fail(rt_mitsuba_at(m, shape), shape->line,
                       "the instances of groups come to more than %d shapes", IMPORT_SHAPES_MAX);
    return !m->import->failed;
}

/* The shapes of a group, placed once more. */
static void place_group(mitsuba *m, xml_node *node, const matrix *to_world)
{
    int has_group = 0;
    for (xml_node *child = node->first; child; child = child->next) {
        xml_node *group = strcmp(child->tag, "ref") == 0 ? rt_mitsuba_follow(m, child) : child;
        if (!group || strcmp(group->tag, "shape") != 0 || m->import->failed)
            continue;
        if (strcmp(rt_mitsuba_text(m, group, "type"), "shapegroup") != 0)
            continue;
        has_group = 1;
        rt_mitsuba_read(m, child, group);
        if (++m->depth > IMPORT_DEPTH_MAX)
            rt_import_fail(rt_mitsuba_at(m, node), node->line,
                           "groups are nested deeper than %d, or in themselves", IMPORT_DEPTH_MAX);
        for (xml_node *shape = group->first; shape && !m->import->failed; shape = shape->next)
            if (strcmp(shape->tag, "shape") == 0 && may_place(m, shape))
                rt_mitsuba_shape(m, shape, to_world);
        m->depth--;
    }
    if (!has_group)
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "an instance without a shapegroup is empty");
}

/* Shapes that Mitsuba joins to one mesh. */
static void place_merged(mitsuba *m, xml_node *node, const matrix *around)
{
    if (++m->depth > IMPORT_DEPTH_MAX)
        rt_import_fail(rt_mitsuba_at(m, node), node->line, "shapes are nested deeper than %d",
                       IMPORT_DEPTH_MAX);
    for (xml_node *child = node->first; child && !m->import->failed; child = child->next) {
        xml_node *const shape = strcmp(child->tag, "shape") == 0 || strcmp(child->tag, "ref") == 0
                                    ? rt_mitsuba_follow(m, child)
                                    : NULL;
        if (!shape || strcmp(shape->tag, "shape") != 0)
            continue;
        rt_mitsuba_read(m, child, shape);
        if (may_place(m, shape))
            rt_mitsuba_shape(m, shape, around);
    }
    m->depth--;
}

static mitsuba_uv uv_of(mitsuba *m, xml_node *node, const char *type)
{
    if (strcmp(type, "disk") == 0)
        return rt_mitsuba_flag(m, node, "flip_normals", 0) ? MITSUBA_UV_DISK_TURNED
                                                           : MITSUBA_UV_DISK;
    if (strcmp(type, "rectangle") == 0 && rt_mitsuba_flag(m, node, "flip_normals", 0))
        return MITSUBA_UV_BACK;
    /* Of the files, by which normal maps lie: v of textures is turned over in their place. */
    if (strcmp(type, "obj") == 0 && rt_mitsuba_flag(m, node, "flip_tex_coords", 1))
        return MITSUBA_UV_UPENDED;
    return strcmp(type, "sphere") == 0 ? MITSUBA_UV_UPENDED : MITSUBA_UV_SAME;
}

void rt_mitsuba_shape(mitsuba *m, xml_node *node, const matrix *around)
{
    static const struct {
        const char *type;
        void (*place)(mitsuba *m, xml_node *node, const import_surface *surface);
    } shapes[] = {{"sphere", place_sphere},
                  {"rectangle", place_rectangle},
                  {"disk", place_disk},
                  {"cube", place_cube},
                  {"cylinder", place_cylinder}};
    const char *type = rt_mitsuba_text(m, node, "type");
    matrix own = rt_mitsuba_transform(m, node, "to_world");
    import_surface surface = {.texture = IMPORT_NONE, .to_world = rt_matrix_multiply(around, &own)};
    if (m->import->failed || strcmp(type, "shapegroup") == 0)
        return;
    node->is_read = READ;
    if (strcmp(type, "instance") == 0) {
        place_group(m, node, &surface.to_world);
        return;
    }
    if (strcmp(type, "merge") == 0) {
        place_merged(m, node, &surface.to_world);
        return;
    }
    m->shape = node;
    m->uv = uv_of(m, node, type);
    const emitter kind = read_radiance(m, node, &surface);
    m->uv = MITSUBA_UV_SAME;
    const int is_emitter = kind == AREA_EMITTER;
    if (kind == BEAM_EMITTER)
        place_beam(m, node, type, &surface);
    surface.material = rt_mitsuba_material(m, node, is_emitter, uv_of(m, node, type));
    if (is_emitter)
        note_mask(m, node);
    if (rt_mitsuba_place_mesh(m, node, type, &surface))
        return;
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++)
        if (strcmp(shapes[i].type, type) == 0) {
            shapes[i].place(m, node, &surface);
            return;
        }
    rt_import_note_at(rt_mitsuba_at(m, node), node->line, "a shape '%.40s' is left out", type);
    rt_mitsuba_leave(node);
}
