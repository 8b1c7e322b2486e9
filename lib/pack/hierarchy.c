/* hierarchy.c - lists the primitives of a scene and builds its trees. */
#include "pack/hierarchy.h"

#include <string.h>

#include "accel/pairs.h"
#include "base/error.h"
#include "base/memory.h"
#include "scene/shape_class.h"

static const char what[] = "the input of the bounding volume hierarchy";

/* ---- Input of the tree of all shapes ---------------------------------------- */

/* The mesh's vertices where the shape places them. */
static rt_status place_vertices(float **out, rt_memory *memory, const rt_scene *scene,
                                const rt_scene_shape *shape, rt_error *error)
{
    size_t count = scene->meshes[shape->mesh].vertex_count;
    float *positions = rt_memory_alloc(memory, count, 3 * sizeof *positions, what, error);
    if (!positions)
        return RT_ERROR_MEMORY;
    for (size_t i = 0; i < count; i++)
        rt_scene_vertex(scene, shape, i, positions + 3 * i);
    *out = positions;
    return RT_OK;
}

static rt_status list_mesh(rt_hierarchy *h, rt_bvh_mesh *out, const rt_scene *scene, size_t index,
                           rt_u32 first_prim, rt_error *error)
{
    const rt_scene_shape *shape = scene->shapes + index;
    const rt_scene_mesh *mesh = scene->meshes + shape->mesh;
    rt_status status = RT_OK;
    out->positions = mesh->positions;
    if (shape->has_transform) {
        status = place_vertices(h->positions + h->placed_count, h->memory, scene, shape, error);
        if (status == RT_OK)
            out->positions = h->positions[h->placed_count++];
    }
    out->indices = mesh->indices;
    out->triangle_count = (uint32_t)mesh->triangle_count;
    out->first_prim = first_prim;
    return status;
}

static void list_quad(rt_bvh_quad *quad, const float *p, rt_u32 prim)
{
    memcpy(quad->corner, p, sizeof quad->corner);
    memcpy(quad->edge1, p + 3, sizeof quad->edge1);
    memcpy(quad->edge2, p + 6, sizeof quad->edge2);
    quad->prim = prim;
}

/* A leaf of the tree, found by its bounds: an analytic shape or an instance. */
static void list_leaf(rt_bvh_analytic *entry, const rt_scene_shape *shape, rt_u32 index)
{
    memcpy(entry->lo, shape->lo, sizeof entry->lo);
    memcpy(entry->hi, shape->hi, sizeof entry->hi);
    entry->shape = index;
}

/* Counts shapes as they are stored; instances as leaves. */
static void count_stored(size_t stored[RT_STORED_INFINITE + 1], const rt_scene *scene)
{
    memset(stored, 0, (RT_STORED_INFINITE + 1) * sizeof *stored);
    for (size_t i = 0; i < scene->shape_count; i++) {
        const rt_scene_shape *shape = scene->shapes + i;
        stored[rt_scene_is_instance(scene, shape) ? RT_STORED_ANALYTIC
                                                  : rt_shape_class_of(shape->kind)->storage]++;
    }
}

/* Lists all finite shapes. */
static rt_status list_shapes(rt_hierarchy *h, rt_bvh_input *input, const rt_scene *scene,
                             const rt_u32 *first_prim, rt_error *error)
{
    size_t shapes = scene->shape_count, stored[RT_STORED_INFINITE + 1];
    rt_status status = RT_OK;
    count_stored(stored, scene);
    h->meshes = rt_memory_alloc(h->memory, stored[RT_STORED_MESH], sizeof *h->meshes, what, error);
    if (h->meshes)
        h->quads =
            rt_memory_alloc(h->memory, stored[RT_STORED_QUAD], sizeof *h->quads, what, error);
    if (h->quads)
        h->analytic = rt_memory_alloc(h->memory, stored[RT_STORED_ANALYTIC], sizeof *h->analytic,
                                      what, error);
    if (h->analytic)
        h->positions =
            rt_memory_zeroed(h->memory, stored[RT_STORED_MESH], sizeof *h->positions, what, error);
    if (!h->positions)
        return RT_ERROR_MEMORY;
    for (size_t i = 0; i < shapes && status == RT_OK; i++) {
        const rt_scene_shape *shape = scene->shapes + i;
        switch (rt_shape_class_of(shape->kind)->storage) {
        case RT_STORED_MESH:
            if (rt_scene_is_instance(scene, shape))
                list_leaf(h->analytic + input->analytic_count++, shape, (rt_u32)i);
            else
                status =
                    list_mesh(h, h->meshes + input->mesh_count++, scene, i, first_prim[i], error);
            break;
        case RT_STORED_QUAD:
            list_quad(h->quads + input->quad_count++, rt_scene_parameters(scene, shape),
                      first_prim[i]);
            break;
        case RT_STORED_ANALYTIC:
            list_leaf(h->analytic + input->analytic_count++, shape, (rt_u32)i);
            break;
        case RT_STORED_INFINITE:
            break;
        }
    }
    input->meshes = h->meshes;
    input->quads = h->quads;
    input->analytic = h->analytic;
    return status;
}

/* ---- Trees of meshes ------------------------------------------------------- */

/* Builds the tree of a mesh in its own space, behind those before. */
static rt_status build_mesh(rt_hierarchy *h, rt_mesh_tree *tree, const rt_scene_mesh *mesh,
                            uint32_t threads, rt_stage_progress *progress, rt_error *error)
{
    rt_bvh_counts counts;
    tree->input.positions = mesh->positions;
    tree->input.indices = mesh->indices;
    tree->input.triangle_count = (uint32_t)mesh->triangle_count;
    rt_bvh_input input = {
        .meshes = &tree->input, .mesh_count = 1, .has_pairs = h->has_pairs, .memory = h->memory};
    rt_status status = rt_bvh_build(&tree->bvh, &input, threads, progress, error);
    if (status != RT_OK)
        return status;
    rt_bvh_get_counts(tree->bvh, &counts);
    tree->first_node = h->counts.nodes;
    tree->first_block = h->counts.blocks;
    tree->block_count = counts.blocks;
    if ((uint64_t)h->counts.nodes + counts.nodes >= RT_CHILD_INDEX)
        return rt_fail(error, RT_ERROR_INPUT, "the meshes are more than the hierarchy can hold");
    h->counts.nodes += counts.nodes;
    h->counts.blocks += counts.blocks;
    return RT_OK;
}

/* ---- All ------------------------------------------------------------------- */

rt_status rt_hierarchy_build(rt_hierarchy *h, const rt_scene *scene, const rt_u32 *first_prim,
                             uint32_t threads, rt_stage_progress *progress, rt_error *error)
{
    rt_bvh_input input;
    memset(&input, 0, sizeof input);
    input.memory = h->memory;
    input.has_pairs = h->has_pairs;
    h->trees = rt_memory_zeroed(h->memory, scene->mesh_count, sizeof *h->trees, what, error);
    if (!h->trees)
        return RT_ERROR_MEMORY;
    h->mesh_count = scene->mesh_count;
    rt_status status = list_shapes(h, &input, scene, first_prim, error);
    if (status == RT_OK)
        status = rt_bvh_build(&h->top, &input, threads, progress, error);
    if (status != RT_OK)
        return status;
    rt_bvh_get_counts(h->top, &h->top_counts);
    rt_bvh_get_bounds(h->top, h->lo, h->hi);
    h->counts = h->top_counts;
    for (size_t i = 0; i < scene->mesh_count && status == RT_OK; i++)
        if (scene->meshes[i].placed > 1)
            status = build_mesh(h, h->trees + i, scene->meshes + i, threads, progress, error);
    if (status == RT_OK && h->has_pairs && rt_hierarchy_pairs(h) > RT_CHILD_INDEX)
        return rt_fail(error, RT_ERROR_INPUT, "the shapes are more than the hierarchy can hold");
    return status;
}

void rt_hierarchy_write(rt_hierarchy *h, rt_bvh_node *nodes, rt_tri_block *blocks, rt_u32 *analytic)
{
    rt_bvh_write(h->top, nodes, blocks, analytic, 0, 0);
    for (size_t i = 0; i < h->mesh_count; i++) {
        rt_mesh_tree *tree = h->trees + i;
        tree->root = tree->first_node;
        if (tree->bvh)
            rt_bvh_write(tree->bvh, nodes + tree->first_node, blocks + tree->first_block, NULL,
                         tree->first_node, tree->first_block);
    }
}

uint64_t rt_hierarchy_pairs(const rt_hierarchy *h)
{
    uint64_t most = rt_pairs_most(&h->top_counts);
    for (size_t i = 0; i < h->mesh_count; i++) {
        rt_bvh_counts counts;
        if (h->trees[i].bvh) {
            rt_bvh_get_counts(h->trees[i].bvh, &counts);
            most += rt_pairs_most(&counts);
        }
    }
    return most;
}

rt_status rt_hierarchy_write_pairs(rt_hierarchy *h, rt_pair_node *nodes, rt_tri_block *blocks,
                                   rt_u32 *analytic, rt_error *error)
{
    rt_bvh_node *wide =
        rt_memory_alloc(h->memory, h->counts.nodes, sizeof *wide, "the wide hierarchy", error);
    if (!wide)
        return RT_ERROR_MEMORY;
    rt_hierarchy_write(h, wide, blocks, analytic);
    rt_u32 at = rt_pairs_write(nodes, 0, wide, 0, blocks);
    for (size_t i = 0; i < h->mesh_count; i++) {
        rt_mesh_tree *tree = h->trees + i;
        tree->root = at;
        if (tree->bvh)
            at += rt_pairs_write(nodes, at, wide, tree->first_node, blocks);
    }
    rt_memory_free(wide);
    return RT_OK;
}

void rt_hierarchy_free(rt_hierarchy *h)
{
    rt_bvh_destroy(h->top);
    for (size_t i = 0; i < h->mesh_count; i++)
        rt_bvh_destroy(h->trees[i].bvh);
    for (size_t i = 0; i < h->placed_count; i++)
        rt_memory_free(h->positions[i]);
    rt_memory_free(h->positions);
    rt_memory_free(h->trees);
    rt_memory_free(h->meshes);
    rt_memory_free(h->quads);
    rt_memory_free(h->analytic);
    memset(h, 0, sizeof *h);
}
