/*
 * fingerprint.c - FNV-1a over 32-bit words, with a final mix, of the scene's tables.
 *
 * Triangles lie in blocks in the order of the hierarchy, some of them more than once; each is
 * hashed by itself, and then the hashes in the order of primitives.
 *
 * Reference:
 *   Fowler, Noll, Vo, Eastlake: "The FNV Non-Cryptographic Hash Algorithm", IETF draft.
 */
#include "photon/fingerprint.h"

#include <stddef.h>
#include <string.h>

#include "base/memory.h"
#include "shape/shapes.h"
#include "types.h"

static const uint64_t basis = 0xcbf29ce484222325u, prime = 0x100000001b3u;

/* bytes: a multiple of 4. */
static uint64_t hash(uint64_t h, const void *data, size_t bytes)
{
    const unsigned char *at = data;
    for (size_t i = 0; i < bytes; i += sizeof(rt_u32)) {
        rt_u32 word;
        memcpy(&word, at + i, sizeof word);
        h = (h ^ word) * prime;
        h ^= h >> 29;
    }
    return h;
}

static const void *table(const rt_scene_header *scene, rt_u32 offset)
{
    return (const char *)scene + (size_t)offset * RT_SCENE_ROW;
}

static uint64_t hash_table(uint64_t h, const rt_scene_header *scene, rt_u32 offset, rt_u32 count,
                           size_t size)
{
    h = hash(h, &count, sizeof count);
    return hash(h, table(scene, offset), count * size);
}

/*
 * The hash of one lane of a block: vertices, and whether they span a triangle or a parallelogram.
 */
static uint64_t hash_lane(const rt_tri_block *block, int lane)
{
    float v[9];
    rt_u32 quad = block->prim[lane] & RT_BLOCK_QUAD;
    for (int i = 0; i < 3; i++) {
        v[i] = block->v0[i][lane];
        v[3 + i] = block->v1[i][lane];
        v[6 + i] = block->v2[i][lane];
    }
    return hash(hash(basis, v, sizeof v), &quad, sizeof quad);
}

/* Blocks that hold primitives from 0 to prim_count - 1, in the order of these. */
static rt_status hash_triangles(uint64_t *h, const rt_tri_block *blocks, rt_u32 block_count,
                                rt_u32 prim_count, rt_memory *memory, rt_error *error)
{
    uint64_t *prims =
        rt_memory_zeroed(memory, prim_count, sizeof *prims, "the fingerprint of the scene", error);
    if (!prims)
        return RT_ERROR_MEMORY;
    for (rt_u32 b = 0; b < block_count; b++)
        for (int lane = 0; lane < RT_BVH_WIDTH; lane++)
            if (blocks[b].prim[lane] != RT_NONE)
                prims[blocks[b].prim[lane] & RT_BLOCK_PRIM] = hash_lane(blocks + b, lane);
    *h = hash(*h, prims, prim_count * sizeof *prims);
    rt_memory_free(prims);
    return RT_OK;
}

/* The triangles of a mesh that instances share. */
static rt_status hash_mesh(uint64_t *h, const rt_tri_block *blocks, rt_u32 block_count,
                           rt_memory *memory, rt_error *error)
{
    rt_u32 prim_count = 0;
    for (rt_u32 b = 0; b < block_count; b++)
        for (int lane = 0; lane < RT_BVH_WIDTH; lane++)
            if (blocks[b].prim[lane] != RT_NONE &&
                (blocks[b].prim[lane] & RT_BLOCK_PRIM) >= prim_count)
                prim_count = (blocks[b].prim[lane] & RT_BLOCK_PRIM) + 1;
    return hash_triangles(h, blocks, block_count, prim_count, memory, error);
}

/*
 * The shapes, but for their places in the hierarchy. A mesh is hashed where its first instance is;
 * the others name the blocks of it, counted from the first of any mesh.
 */
static rt_status hash_shapes(uint64_t *h, const rt_scene_header *scene, rt_memory *memory,
                             rt_error *error)
{
    const rt_shape *shapes = table(scene, scene->shapes);
    const rt_tri_block *blocks = table(scene, scene->blocks);
    rt_status status = RT_OK;
    rt_u32 end = scene->block_count;
    *h = hash(*h, &scene->shape_count, sizeof scene->shape_count);
    for (rt_u32 i = 0; i < scene->shape_count && status == RT_OK; i++) {
        rt_shape shape = shapes[i];
        if (shape.kind == RT_SHAPE_INSTANCE) {
            if (shape.first_block >= end) {
                status = hash_mesh(h, blocks + shape.first_block, shape.block_count, memory, error);
                end = shape.first_block + shape.block_count;
            }
            shape.first_block -= scene->block_count;
        }
        shape.root = 0;
        *h = hash(*h, &shape, sizeof shape);
    }
    return status;
}

/* The image around the scene; what it is sampled by follows from it. */
static uint64_t hash_environment(uint64_t h, const rt_scene_header *scene)
{
    const rt_environment_data *e = &scene->environment;
    h = hash(h, &e->turn, sizeof e->turn);
    h = hash(h, &e->height, sizeof e->height);
    return hash_table(h, scene, e->texels, e->width, e->height * 4 * sizeof(float));
}

/* The tables of lights; what their cells are chosen by follows from them. */
static uint64_t hash_light_tables(uint64_t h, const rt_scene_header *scene)
{
    const rt_light_table *t = table(scene, scene->light_tables);
    for (rt_u32 i = 0; i < scene->light_table_count; i++, t++) {
        const rt_u32 more = t->flags & RT_TABLE_CELLS ? 0 : 1;
        h = hash(h, &t->flags, sizeof t->flags);
        h = hash_table(h, scene, t->lines, t->columns + t->rows + 2, sizeof(float));
        h = hash_table(h, scene, t->values, t->rows + more,
                       ((size_t)t->columns + more) * 4 * sizeof(float));
    }
    return h;
}

static uint64_t hash_grid(uint64_t h, const rt_scene_header *scene, const rt_grid_data *grid)
{
    h = hash(h, grid->to_voxels, sizeof grid->to_voxels);
    return hash_table(h, scene, grid->values, grid->size[2],
                      (size_t)grid->size[0] * grid->size[1] * grid->channels * sizeof(float));
}

/* The coefficients of each medium, but for the grids. */
static uint64_t hash_media(uint64_t h, const rt_scene_header *scene)
{
    const rt_medium_data *media = table(scene, scene->media);
    for (rt_u32 i = 0; i <= scene->material_count; i++)
        h = hash(h, media + i, offsetof(rt_medium_data, albedo));
    return h;
}

/* The density and the albedo of each medium that has one on a grid. */
static uint64_t hash_grids(uint64_t h, const rt_scene_header *scene)
{
    const rt_medium_data *media = table(scene, scene->media);
    const rt_grid_data *grids = table(scene, scene->grids);
    for (rt_u32 i = 0; scene->grids && i <= scene->material_count; i++) {
        if (media[i].grid)
            h = hash_grid(h, scene, grids + (media[i].grid - 1));
        if (media[i].albedo) {
            const rt_grid_data *albedo = grids + (media[i].albedo - 1);
            h = hash(h, &albedo->repeats, sizeof albedo->repeats);
            h = hash_grid(h, scene, albedo);
        }
    }
    return h;
}

static rt_status hash_scene(uint64_t *out, const rt_scene_header *scene, rt_memory *memory,
                            rt_error *error)
{
    uint64_t h = basis;
    rt_status status = hash_shapes(&h, scene, memory, error);
    h = hash_table(h, scene, scene->transforms, scene->transform_count, sizeof(rt_transform_data));
    h = hash_table(h, scene, scene->materials, scene->material_count, sizeof(rt_material_data));
    h = hash_table(h, scene, scene->lights, scene->light_count, sizeof(rt_light_data));
    h = hash_table(h, scene, scene->indices, scene->index_count, sizeof(rt_u32));
    h = hash_table(h, scene, scene->normals, scene->normal_count, 4 * sizeof(float));
    h = hash_table(h, scene, scene->uvs, scene->uv_count, 2 * sizeof(float));
    h = hash_table(h, scene, scene->colours, scene->colour_count, 4 * sizeof(float));
    h = hash_table(h, scene, scene->textures, scene->texture_count, sizeof(rt_texture_data));
    h = hash_table(h, scene, scene->texels, scene->texel_rows, RT_SCENE_ROW);
    h = hash_environment(h, scene);
    if (scene->media)
        h = hash_media(h, scene);
    h = hash_grids(h, scene);
    h = hash_light_tables(h, scene);
    if (status == RT_OK)
        status = hash_triangles(&h, table(scene, scene->blocks), scene->block_count,
                                scene->prim_count, memory, error);
    if (status == RT_OK)
        *out = h;
    return status;
}

/* Of the scene, and of its camera too if it is asked for. */
static rt_status fingerprint(uint64_t *out, rt_device *device, cl_mem scene, int has_camera,
                             rt_error *error)
{
    const void *mapped = NULL;
    rt_status status = rt_buffer_map(device, scene, 0, &mapped, "the scene", error);
    if (status != RT_OK)
        return status;
    status = hash_scene(out, mapped, device->memory, error);
    if (has_camera && status == RT_OK) {
        const rt_scene_header *header = mapped;
        *out = hash(*out, &header->camera, sizeof header->camera);
    }
    rt_status unmapped = rt_buffer_unmap(device, scene, mapped, status == RT_OK ? error : NULL);
    return status == RT_OK ? unmapped : status;
}

rt_status rt_scene_fingerprint(uint64_t *out, rt_device *device, cl_mem scene, rt_error *error)
{
    return fingerprint(out, device, scene, 0, error);
}

rt_status rt_picture_fingerprint(uint64_t *out, rt_device *device, cl_mem scene, rt_error *error)
{
    return fingerprint(out, device, scene, 1, error);
}

uint64_t rt_fingerprint(uint64_t seed, const void *words, size_t bytes)
{
    return hash(seed ? seed : basis, words, bytes);
}
