/*
 * fingerprint.c - FNV-1a over 32-bit words, with a final mix, of the scene's tables.
 *
 * Triangles lie in blocks in the order of the hierarchy, some of them more than once; each is hashed
 * by itself, and then the hashes in the order of primitives.
 *
 * Reference:
 *   Fowler, Noll, Vo, Eastlake: "The FNV Non-Cryptographic Hash Algorithm", IETF draft.
 */
#include "photon/fingerprint.h"

#include <stdlib.h>
#include <string.h>

#include "error.h"
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

static uint64_t hash_table(uint64_t h, const rt_scene_header *scene, rt_u32 offset, rt_u32 count, size_t size)
{
    h = hash(h, &count, sizeof count);
    return hash(h, table(scene, offset), count * size);
}

/* The hash of one lane of a block: vertices, and whether they span a triangle or a parallelogram. */
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

static rt_status hash_triangles(uint64_t *h, const rt_scene_header *scene, rt_error *error)
{
    const rt_tri_block *blocks = table(scene, scene->blocks);
    uint64_t *prims = calloc(scene->prim_count + (size_t)1, sizeof *prims);
    if (!prims)
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory for the fingerprint of a scene");
    for (rt_u32 b = 0; b < scene->block_count; b++)
        for (int lane = 0; lane < RT_BVH_WIDTH; lane++)
            if (blocks[b].prim[lane] != RT_NONE)
                prims[blocks[b].prim[lane] & RT_BLOCK_PRIM] = hash_lane(blocks + b, lane);
    *h = hash(*h, prims, scene->prim_count * sizeof *prims);
    free(prims);
    return RT_OK;
}

static rt_status hash_scene(uint64_t *out, const rt_scene_header *scene, rt_error *error)
{
    uint64_t h = basis;
    h = hash_table(h, scene, scene->shapes, scene->shape_count, sizeof(rt_shape));
    h = hash_table(h, scene, scene->materials, scene->material_count, sizeof(rt_material_data));
    h = hash_table(h, scene, scene->lights, scene->light_count, sizeof(rt_light_data));
    h = hash_table(h, scene, scene->normals, scene->normal_count, 4 * sizeof(float));
    rt_status status = hash_triangles(&h, scene, error);
    if (status == RT_OK)
        *out = h;
    return status;
}

rt_status rt_scene_fingerprint(uint64_t *out, rt_device *device, cl_mem scene, rt_error *error)
{
    const void *mapped = NULL;
    rt_status status = rt_buffer_map(device, scene, 0, &mapped, "the scene", error);
    if (status != RT_OK)
        return status;
    status = hash_scene(out, mapped, error);
    rt_status unmapped = rt_buffer_unmap(device, scene, mapped, status == RT_OK ? error : NULL);
    return status == RT_OK ? unmapped : status;
}
