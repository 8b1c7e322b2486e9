/* shapes.c - shapes, their primitives, transforms and vertex data. */
#include <string.h>

#include "base/memory.h"
#include "base/vec.h"
#include "bsdf/lobes.h"
#include "light/lights.h"
#include "pack/packing.h"
#include "scene/attributes.h"
#include "scene/check.h"
#include "scene/parts.h"
#include "scene/shape_class.h"

/* ---- Numbering ------------------------------------------------------------- */

static int needs_transform(const rt_packing *p, const rt_scene_shape *shape)
{
    switch (rt_shape_class_of(shape->kind)->storage) {
    case RT_STORED_MESH:
        return rt_scene_is_instance(p->scene, shape);
    case RT_STORED_QUAD:
        break;
    case RT_STORED_ANALYTIC:
    case RT_STORED_INFINITE:
        return shape->has_transform;
    }
    return 0;
}

/* Takes so many entries of a table. */
static rt_u32 take(size_t *count, size_t entries)
{
    size_t first = *count;
    *count += entries;
    return (rt_u32)first;
}

/* Whether a mesh has a transform, beyond that its origin is where its file has it. */
static int is_turned_about(const rt_scene *scene, const rt_scene_shape *shape)
{
    if (!shape->has_transform)
        return 0;
    rt_affine a = rt_scene_to_world(scene, shape);
    for (int i = 0; i < 3; i++)
        a.m[i][3] -= scene->meshes[shape->mesh].origin[i];
    return !rt_affine_is_identity(&a);
}

/* The rows of colours that an attribute takes which textures name by this number. */
static size_t attribute_rows(const rt_scene *scene, const rt_scene_mesh *mesh, uint32_t number)
{
    const rt_attributes *of;
    if (!rt_mesh_attribute_of(&of, scene, mesh, number))
        return 0;
    return of == &mesh->of_triangles ? mesh->triangle_count : mesh->vertex_count;
}

/* Places the attributes of a mesh, and its indices behind the table of where each is. */
static void number_attributes(rt_packing *p, const rt_scene_mesh *mesh, rt_mesh_place *place)
{
    size_t rows = 0;
    for (uint32_t i = 0; i < p->scene->attribute_count && place->index == RT_NONE; i++)
        rows += attribute_rows(p->scene, mesh, i);
    if (rows == 0)
        return;
    place->attributes = take(&p->colour_count, rows);
    take(&p->index_count, p->scene->attribute_count);
    place->index = take(&p->index_count, 3 * mesh->triangle_count);
}

/*
 * Places the vertex data of a mesh, shared by all that place it, but for normals that a transform
 * turns.
 */
static void number_vertices(rt_packing *p, size_t index)
{
    const rt_scene_shape *shape = p->scene->shapes + index;
    const rt_scene_mesh *mesh = p->scene->meshes + shape->mesh;
    rt_mesh_place *place = p->meshes + shape->mesh;
    int is_turned = is_turned_about(p->scene, shape) && !rt_scene_is_instance(p->scene, shape);

    number_attributes(p, mesh, place);
    if (place->index == RT_NONE && (mesh->normals || mesh->uv || mesh->colours))
        place->index = take(&p->index_count, 3 * mesh->triangle_count);
    if (place->uv == RT_NONE && mesh->uv)
        place->uv = take(&p->uv_count, mesh->vertex_count);
    if (place->colour == RT_NONE && mesh->colours)
        place->colour = take(&p->colour_count, mesh->vertex_count);
    if (mesh->normals && is_turned) {
        p->shapes[index].normal = take(&p->normal_count, mesh->vertex_count);
    } else if (mesh->normals) {
        if (place->normal == RT_NONE)
            place->normal = take(&p->normal_count, mesh->vertex_count);
        p->shapes[index].normal = place->normal;
    }
}

static rt_status allocate(rt_packing *p, rt_error *error)
{
    size_t shapes = p->scene->shape_count, meshes = p->scene->mesh_count;
    static const char what[] = "the packing of the scene";
    p->first_prim = rt_memory_alloc(p->memory, shapes, sizeof *p->first_prim, what, error);
    if (p->first_prim)
        p->first_light = rt_memory_alloc(p->memory, shapes, sizeof *p->first_light, what, error);
    if (p->first_light)
        p->shapes = rt_memory_alloc(p->memory, shapes, sizeof *p->shapes, what, error);
    if (p->shapes)
        p->meshes = rt_memory_alloc(p->memory, meshes, sizeof *p->meshes, what, error);
    if (!p->meshes)
        return RT_ERROR_MEMORY;
    memset(p->shapes, 0xff, shapes * sizeof *p->shapes); /* RT_NONE */
    memset(p->meshes, 0xff, meshes * sizeof *p->meshes);
    return RT_OK;
}

rt_status rt_pack_number(rt_packing *p, rt_error *error)
{
    rt_status status = allocate(p, error);
    for (size_t i = 0; i < p->scene->shape_count && status == RT_OK; i++) {
        const rt_scene_shape *shape = p->scene->shapes + i;
        p->first_prim[i] = take(&p->prim_count, rt_scene_shape_primitives(p->scene, shape));
        p->plane_count += rt_shape_class_of(shape->kind)->storage == RT_STORED_INFINITE;
        if (needs_transform(p, shape))
            p->shapes[i].transform = take(&p->transform_count, 1);
        if (shape->kind == RT_SHAPE_TRIANGLES)
            number_vertices(p, i);
        if (p->prim_count > RT_BLOCK_PRIM - 1 || p->index_count > UINT32_MAX - 1 ||
            p->normal_count > UINT32_MAX - 1 || p->colour_count > RT_ATTRIBUTE_OF_TRIANGLES - 1)
            status = rt_fail(error, RT_ERROR_INPUT, "the scene has more than %u primitives",
                             RT_BLOCK_PRIM - 1);
    }
    p->light_count = rt_lights_count(p->scene);
    return status;
}

/* ---- Shapes ---------------------------------------------------------------- */

static void pack_transform(rt_transform_data *out, rt_affine to_world)
{
    rt_affine inverse;
    /* there is one: that was checked when the shape was added */
    rt_affine_inverse(&inverse, &to_world);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++) {
            out->to_world[i][j] = (float)to_world.m[i][j];
            out->to_object[i][j] = (float)inverse.m[i][j];
        }
}

/* What triangles and instances have besides. */
static void pack_mesh(const rt_packing *p, rt_shape *out, const rt_scene_shape *shape,
                      rt_u32 first_normal)
{
    const rt_scene_mesh *mesh = p->scene->meshes + shape->mesh;
    const rt_mesh_place *place = p->meshes + shape->mesh;
    const rt_mesh_tree *tree = p->hierarchy.trees + shape->mesh;
    out->flags |= (mesh->normals ? RT_SHAPE_SMOOTH : 0) | (mesh->uv ? RT_SHAPE_UV : 0) |
                  (mesh->colours ? RT_SHAPE_COLOUR : 0) |
                  (place->attributes != RT_NONE ? RT_SHAPE_ATTRIBUTES : 0);
    out->first_index = place->index;
    out->first_normal = first_normal;
    out->first_uv = place->uv;
    out->first_colour = place->colour;
    if (!rt_scene_is_instance(p->scene, shape))
        return;
    out->kind = RT_SHAPE_INSTANCE;
    out->root = tree->root;
    out->first_block = tree->first_block;
    out->block_count = tree->block_count;
}

/* Whether the material differs from point to point. */
#define HAS_TEXTURE(TYPE, name, RANGE, NEED, unit, help) || m->name##_texture
static int is_textured(const rt_material *m)
{
    return rt_material_has_bumps(m) RT_SURFACE_INPUTS(HAS_TEXTURE)
        RT_PRINCIPLED_NUMBERS(HAS_TEXTURE);
}

static int is_varied(const rt_scene *scene, const rt_shape *shape)
{
    const rt_material *m = scene->materials + shape->material;
    return shape->texture != RT_NONE || (shape->flags & RT_SHAPE_COLOUR) ||
           rt_material_has_bumps(m) || rt_material_any(scene, m, RT_SIDE_BOTH, is_textured);
}

/* Whether it has Lambert's lobe alone, but for its back, without bumps' shadows, and is dark. */
static int is_lambert(const rt_scene *scene, const rt_shape *shape)
{
    const rt_material *m = scene->materials + shape->material;
    for (int i = 0; i < 3; i++)
        if (m->ks[i] > 0 || m->kt[i] > 0)
            return 0;
    return rt_material_diffuse_lobe(m) == RT_LOBE_LAMBERT && !m->blend && !m->bump_shadowing &&
           shape->first_light == RT_NONE;
}

/*
 * Whether it is opaque and reflects by facets of GGX, alike in all directions, or beside Lambert's
 * lobe as a mirror, by ks or by a clear coat, likewise.
 */
static int is_mixed(const rt_scene *scene, const rt_shape *shape)
{
    const rt_material *m = scene->materials + shape->material;
    const rt_u32 diffuse = rt_material_diffuse_lobe(m);
    const int is_clear = !rt_material_is_lacquer(m) && rt_is_black(m->coat_absorption);
    const int has_lobe = (diffuse == RT_LOBE_COATED && is_clear) ||
                         (diffuse == RT_LOBE_LAMBERT && !rt_is_black(m->ks));
    const int is_mirror = rt_is_black(m->kd) && m->coat == 0 && m->roughness < RT_SMOOTH_ALPHA;
    const int is_isotropic =
        m->roughness_v == 0 && m->exponent == 0 && m->distribution == RT_DISTRIBUTION_GGX;
    return has_lobe && !is_mirror && is_isotropic && rt_is_black(m->kt) &&
           rt_is_black(m->diffuse_transmission) && m->fresnel != RT_FRESNEL_DIELECTRIC &&
           !m->thin && !m->interface && !m->blend && !m->bump_shadowing &&
           shape->first_light == RT_NONE;
}

static int is_flat(const rt_shape *shape)
{
    const rt_u32 other = RT_SHAPE_SMOOTH | RT_SHAPE_VARIED | RT_SHAPE_MIRRORED;
    return (shape->kind == RT_SHAPE_TRIANGLES || shape->kind == RT_SHAPE_QUAD) &&
           !(shape->flags & other);
}

static void pack_shape(const rt_packing *p, rt_shape *out, size_t index)
{
    const rt_scene_shape *shape = p->scene->shapes + index;
    const float *parameters = rt_scene_parameters(p->scene, shape);
    out->kind = shape->kind;
    out->material = shape->material;
    out->first_prim = p->first_prim[index];
    out->prim_count = (rt_u32)rt_scene_shape_primitives(p->scene, shape);
    out->first_light = p->first_light[index];
    out->transform = p->shapes[index].transform;
    out->texture =
        shape->texture && !rt_scene_has_own_light(p->scene, shape) ? shape->texture - 1 : RT_NONE;
    out->flags = shape->caps ? RT_SHAPE_CAPS : 0;
    memcpy(out->p, parameters, parameters == shape->p ? sizeof shape->p : sizeof out->p);
    if (shape->kind == RT_SHAPE_TRIANGLES)
        pack_mesh(p, out, shape, p->shapes[index].normal);
    if ((out->kind == RT_SHAPE_TRIANGLES || out->kind == RT_SHAPE_QUAD) &&
        rt_scene_is_mirrored(p->scene, shape))
        out->flags |= RT_SHAPE_MIRRORED;
    if (is_varied(p->scene, out))
        out->flags |= RT_SHAPE_VARIED | RT_SHAPE_LOCATED;
    if (rt_parts_vary(p->scene, p->scene->materials + shape->material))
        out->flags |= RT_SHAPE_LOCATED;
    if (rt_scene_is_cutout(p->scene, shape))
        out->flags |= RT_SHAPE_CUTOUT | RT_SHAPE_LOCATED;
    if (rt_scene_emission_texture(p->scene, shape))
        out->flags |= RT_SHAPE_LOCATED;
    if (is_lambert(p->scene, out))
        out->flags |= RT_SHAPE_SIMPLE;
    if (is_mixed(p->scene, out))
        out->flags |= RT_SHAPE_MIXED;
    if (p->scene->materials[shape->material].back)
        out->flags |= RT_SHAPE_BACKED;
    if (is_flat(out))
        out->flags |= RT_SHAPE_FLAT;
    out->reach = p->shapes[index].reach;
    if (out->reach > 0)
        out->flags |= RT_SHAPE_TOUCHES;
}

void rt_pack_shapes(const rt_packing *p)
{
    rt_shape *out = rt_packing_table(p, p->header.shapes);
    rt_transform_data *transforms = rt_packing_table(p, p->header.transforms);
    rt_u32 *prim_shape = rt_packing_table(p, p->header.prim_shape),
           *plane = rt_packing_table(p, p->header.planes);

    for (size_t i = 0; i < p->scene->shape_count; i++) {
        pack_shape(p, out + i, i);
        if (out[i].transform != RT_NONE)
            pack_transform(transforms + out[i].transform,
                           rt_scene_to_world(p->scene, p->scene->shapes + i));
        for (rt_u32 k = 0; k < out[i].prim_count; k++)
            prim_shape[out[i].first_prim + k] = (rt_u32)i;
        if (out[i].kind == RT_SHAPE_PLANE)
            *plane++ = (rt_u32)i;
    }
}

/* ---- Cutouts --------------------------------------------------------------- */

/* Marks the lanes of blocks that hold cutouts: those of the tree of all shapes one by one, ... */
static void mark_blocks(rt_tri_block *blocks, rt_u32 count, const rt_shape *shapes,
                        const rt_u32 *prim_shape)
{
    for (rt_u32 b = 0; b < count; b++)
        for (int lane = 0; lane < RT_BVH_WIDTH; lane++) {
            rt_u32 *prim = blocks[b].prim + lane;
            if (*prim != RT_NONE &&
                shapes[prim_shape[*prim & RT_BLOCK_PRIM]].flags & RT_SHAPE_CUTOUT)
                *prim |= RT_BLOCK_CUTOUT;
        }
}

/* ... those of a mesh that is placed all of them. */
static void mark_instance(rt_tri_block *blocks, const rt_shape *shape)
{
    for (rt_u32 b = shape->first_block; b < shape->first_block + shape->block_count; b++)
        for (int lane = 0; lane < RT_BVH_WIDTH; lane++)
            if (blocks[b].prim[lane] != RT_NONE)
                blocks[b].prim[lane] |= RT_BLOCK_CUTOUT;
}

void rt_pack_cutouts(rt_packing *p)
{
    rt_scene_header *h = &p->header;
    const rt_shape *shapes = rt_packing_table(p, h->shapes);
    rt_tri_block *blocks = rt_packing_table(p, h->blocks);
    for (rt_u32 i = 0; i < h->shape_count; i++)
        h->has_cutouts |= (shapes[i].flags & RT_SHAPE_CUTOUT) != 0;
    if (!h->has_cutouts)
        return;
    mark_blocks(blocks, h->block_count, shapes, rt_packing_table(p, h->prim_shape));
    for (rt_u32 i = 0; i < h->shape_count; i++)
        if (shapes[i].kind == RT_SHAPE_INSTANCE && shapes[i].flags & RT_SHAPE_CUTOUT)
            mark_instance(blocks, shapes + i);
}

/* ---- Vertices -------------------------------------------------------------- */

/* Writes a mesh's normals, of unit length; one of no length stays so. */
static void pack_normals(float (*out)[4], const rt_scene_mesh *mesh)
{
    static const float zero[3];
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        double n[3];
        rt_vec_sub(n, mesh->normals + 3 * i, zero);
        double length = rt_vec_length(n);
        for (int c = 0; c < 3; c++)
            out[i][c] = length > 0 ? (float)(n[c] / length) : 0;
    }
}

/*
 * Maps them, and scales all alike so that the longest is of unit length: their mix is then that
 * which is mapped after it was mixed, as instances do.
 */
static void map_normals(float (*normals)[4], size_t count, const rt_affine *inverse)
{
    double longest = 0;
    for (size_t i = 0; i < count; i++) {
        double n[3] = {normals[i][0], normals[i][1], normals[i][2]}, m[3];
        rt_affine_normal(m, inverse, n);
        longest = fmax(longest, rt_vec_length(m));
        for (int c = 0; c < 3; c++)
            normals[i][c] = (float)m[c];
    }
    for (size_t i = 0; i < count && longest > 0; i++)
        for (int c = 0; c < 3; c++)
            normals[i][c] = (float)(normals[i][c] / longest);
}

/* Normals of meshes as they are placed in world space. */
static void pack_placed_normals(const rt_packing *p)
{
    float(*normals)[4] = rt_packing_table(p, p->header.normals);
    for (size_t i = 0; i < p->scene->shape_count; i++) {
        const rt_scene_shape *shape = p->scene->shapes + i;
        rt_u32 first = p->shapes[i].normal;
        rt_affine inverse, to_world;
        if (shape->kind != RT_SHAPE_TRIANGLES || first == RT_NONE ||
            first == p->meshes[shape->mesh].normal)
            continue;
        to_world = rt_scene_to_world(p->scene, shape);
        rt_affine_inverse(&inverse, &to_world);
        pack_normals(normals + first, p->scene->meshes + shape->mesh);
        map_normals(normals + first, p->scene->meshes[shape->mesh].vertex_count, &inverse);
    }
}

/* Writes the rows of an attribute, of which one number stands in all three channels. */
static void pack_attribute(float (*out)[4], const rt_attribute *a, const rt_attributes *of,
                           size_t rows)
{
    for (size_t i = 0; i < rows; i++)
        for (uint32_t c = 0; c < (a->width == 2 ? 2 : 3); c++)
            out[i][c] = of->values[i * of->width + a->first + (a->width == 1 ? 0 : c)];
}

/* Writes the attributes of a mesh that textures name, and where they are before its indices. */
static void pack_attributes(rt_u32 *indices, float (*colours)[4], const rt_scene *scene,
                            const rt_scene_mesh *mesh, const rt_mesh_place *place)
{
    rt_u32 first = place->attributes;
    for (uint32_t i = 0; i < scene->attribute_count; i++) {
        const rt_attributes *of;
        const rt_attribute *const a = rt_mesh_attribute_of(&of, scene, mesh, i);
        const size_t rows = attribute_rows(scene, mesh, i);
        rt_u32 *const entry = indices + place->index - 1 - i;
        *entry = !a                          ? RT_NONE
                 : of == &mesh->of_triangles ? first | RT_ATTRIBUTE_OF_TRIANGLES
                                             : first;
        if (a)
            pack_attribute(colours + first, a, of, rows);
        first += (rt_u32)rows;
    }
}

void rt_pack_vertices(const rt_packing *p)
{
    rt_u32 *indices = rt_packing_table(p, p->header.indices);
    float(*normals)[4] = rt_packing_table(p, p->header.normals);
    float(*uvs)[2] = rt_packing_table(p, p->header.uvs);
    float(*colours)[4] = rt_packing_table(p, p->header.colours);

    for (size_t m = 0; m < p->scene->mesh_count; m++) {
        const rt_scene_mesh *mesh = p->scene->meshes + m;
        const rt_mesh_place *place = p->meshes + m;
        if (place->index != RT_NONE)
            memcpy(indices + place->index, mesh->indices,
                   3 * mesh->triangle_count * sizeof *indices);
        if (place->normal != RT_NONE)
            pack_normals(normals + place->normal, mesh);
        if (place->uv != RT_NONE)
            memcpy(uvs + place->uv, mesh->uv, mesh->vertex_count * sizeof *uvs);
        for (size_t i = 0; place->colour != RT_NONE && i < mesh->vertex_count; i++)
            memcpy(colours[place->colour + i], mesh->colours + 3 * i, 3 * sizeof(float));
        if (place->attributes != RT_NONE)
            pack_attributes(indices, colours, p->scene, mesh, place);
    }
    pack_placed_normals(p);
}
