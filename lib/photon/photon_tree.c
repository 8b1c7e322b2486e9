/* photon_tree.c - builds the tree of photons, level by level. */
#include "photon/photon_tree.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/parallel.h"
#include "photon/point_order.h"

/* AHEAD: how many photons before they are needed, they are fetched */
enum { NODES_A_JOB = 256, AHEAD = 24 };

rt_status rt_photon_tree_lay_out(rt_photon_tree *shape, size_t *node_count, size_t photons,
                                 rt_error *error)
{
    size_t nodes = 0, children = (photons + 7) / 8;
    if (photons > RT_PHOTON_TREE_MAX)
        return rt_fail(error, RT_ERROR_MEMORY, "%zu photons are more than the %d a tree can hold",
                       photons, RT_PHOTON_TREE_MAX);
    memset(shape, 0, sizeof *shape);
    shape->photon_count = (rt_u32)photons;
    shape->block_count = (rt_u32)children;
    while (photons > 0 && (children > 1 || shape->levels == 0)) {
        children = (children + 7) / 8;
        shape->first_node[shape->levels++] = (rt_u32)nodes;
        nodes += children;
    }
    *node_count = nodes;
    return RT_OK;
}

static size_t level_size(const rt_photon_tree_data *tree, rt_u32 level)
{
    size_t end =
        level + 1 < tree->shape.levels ? tree->shape.first_node[level + 1] : tree->node_count;
    return end - tree->shape.first_node[level];
}

/* ---- Blocks and the nodes over them -------------------------------------- */

/*
 * Has the processor fetch the photons of items that are to come: they lie anywhere in the list, and
 * it would wait for each.
 */
static void fetch(const rt_photon_list *list, const uint64_t *items, size_t count)
{
#if defined(__GNUC__)
    for (size_t i = 0; i < count; i++)
        __builtin_prefetch(list->photons + (items[i] & RT_POINT_ORDER_INDEX));
#else
    (void)list, (void)items, (void)count;
#endif
}

static void fill_block(rt_photon_block *block, const rt_photon_list *list, const uint64_t *items,
                       size_t count)
{
    for (size_t lane = 0; lane < 8; lane++) {
        const rt_photon *photon =
            lane < count ? list->photons + (items[lane] & RT_POINT_ORDER_INDEX) : NULL;
        for (int axis = 0; axis < 3; axis++) {
            block->position[axis][lane] = photon ? photon->position[axis] : HUGE_VALF;
            block->normal[axis][lane] = photon ? photon->normal[axis] : 0;
            block->flux[axis][lane] = photon ? photon->flux[axis] * photon->shading : 0;
            block->wi[axis][lane] = photon ? photon->wi[axis] : 0;
        }
    }
}

/* In place of the normals of volume photons: what RT_VOLUME_* say, without radii yet. */
static void fill_media(rt_photon_block *block, const rt_photon_list *list, const uint64_t *items,
                       size_t count)
{
    memset(block->normal, 0, sizeof block->normal);
    for (size_t lane = 0; lane < count; lane++)
        block->normal[RT_VOLUME_MEDIUM][lane] =
            (float)(list->photons[items[lane] & RT_POINT_ORDER_INDEX].shape + 1u);
}

static void clear_bounds(rt_photon_node *node)
{
    for (int row = 0; row < 6; row++)
        for (int lane = 0; lane < 8; lane++)
            node->bounds[row][lane] = row < 3 ? HUGE_VALF : -HUGE_VALF;
}

/* Takes rows [3][8] of low and high corners, or of points as both, into one lane's box. */
static void add_bounds(rt_photon_node *node, size_t lane, const float low[3][8],
                       const float high[3][8], size_t count)
{
    for (int axis = 0; axis < 3; axis++) {
        float *lo = &node->bounds[axis][lane], *hi = &node->bounds[3 + axis][lane];
        for (size_t i = 0; i < count; i++) {
            *lo = low[axis][i] < *lo ? low[axis][i] : *lo;
            *hi = high[axis][i] > *hi ? high[axis][i] : *hi;
        }
    }
}

typedef struct building {
    rt_photon_tree_data *tree;
    const rt_photon_list *list;
    const uint64_t *items;
    int in_media; /* they are volume photons */
} building;

static void build_share(void *user, uint32_t job)
{
    const building *b = user;
    rt_photon_tree_data *tree = b->tree;
    size_t begin = (size_t)job * NODES_A_JOB, end = begin + NODES_A_JOB,
           level = level_size(tree, 0);
    for (size_t n = begin; n < end && n < level; n++) {
        clear_bounds(tree->nodes + n);
        for (size_t lane = 0; lane < 8 && 8 * n + lane < tree->shape.block_count; lane++) {
            size_t first = 8 * (8 * n + lane), left = b->list->count - first,
                   count = left < 8 ? left : 8;
            rt_photon_block *block = tree->blocks + 8 * n + lane;
            const float(*points)[8] = (const float(*)[8])block->position;
            if (left > AHEAD + 8)
                fetch(b->list, b->items + first + AHEAD, 8);
            fill_block(block, b->list, b->items + first, count);
            if (b->in_media)
                fill_media(block, b->list, b->items + first, count);
            add_bounds(tree->nodes + n, lane, points, points, count);
        }
    }
}

/* The nodes of a higher level, from those of the one below. */
static void build_level(rt_photon_tree_data *tree, rt_u32 level)
{
    const rt_photon_node *below = tree->nodes + tree->shape.first_node[level - 1];
    size_t children = level_size(tree, level - 1);
    for (size_t n = 0; n < level_size(tree, level); n++) {
        rt_photon_node *node = tree->nodes + tree->shape.first_node[level] + n;
        clear_bounds(node);
        for (size_t lane = 0; lane < 8 && 8 * n + lane < children; lane++)
            add_bounds(node, lane, below[8 * n + lane].bounds, below[8 * n + lane].bounds + 3, 8);
    }
}

/* ---- The whole ------------------------------------------------------------ */

static const char what[] = "the tree of the photon map";

static rt_status allocate(rt_photon_tree_data *tree, size_t photons, rt_error *error)
{
    size_t node_bytes = (tree->node_count * sizeof *tree->nodes + 63) / 64 * 64;
    size_t bytes = node_bytes + tree->shape.block_count * sizeof *tree->blocks;
    rt_status status = rt_memory_take(tree->memory, bytes, what, error);
    if (status != RT_OK)
        return status;
    tree->bytes = bytes;
    if (posix_memalign(&tree->block, 64, bytes ? bytes : 64) != 0) {
        tree->block = NULL;
        return rt_fail(error, RT_ERROR_MEMORY, "no memory for the tree of %zu photons", photons);
    }
    tree->nodes = tree->block;
    tree->blocks = (rt_photon_block *)((char *)tree->block + node_bytes);
    return RT_OK;
}

static rt_status build(rt_photon_tree_data *out, const rt_photon_list *list, int in_media,
                       uint32_t threads, rt_memory *memory, rt_error *error)
{
    rt_photon_tree_data tree = {.memory = memory};
    rt_status status = rt_photon_tree_lay_out(&tree.shape, &tree.node_count, list->count, error);
    if (status != RT_OK)
        return status;
    uint64_t *items = rt_memory_alloc(memory, list->count, 2 * sizeof *items, what, error);
    if (!items)
        return RT_ERROR_MEMORY;

    status = allocate(&tree, list->count, error);
    if (status == RT_OK && list->count > 0)
        status = rt_point_order(items, items + list->count, list->photons->position,
                                sizeof *list->photons, list->count, threads, error);
    if (status == RT_OK && list->count > 0) {
        building b = {&tree, list, items, in_media};
        rt_parallel(threads, (uint32_t)((level_size(&tree, 0) + NODES_A_JOB - 1) / NODES_A_JOB),
                    build_share, &b);
        for (rt_u32 level = 1; level < tree.shape.levels; level++)
            build_level(&tree, level);
    }
    rt_memory_free(items);
    if (status == RT_OK)
        *out = tree;
    else
        rt_photon_tree_free(&tree);
    return status;
}

rt_status rt_photon_tree_build(rt_photon_tree_data *out, const rt_photon_list *list,
                               uint32_t threads, rt_memory *memory, rt_error *error)
{
    return build(out, list, 0, threads, memory, error);
}

rt_status rt_photon_tree_build_in_media(rt_photon_tree_data *out, const rt_photon_list *list,
                                        uint32_t threads, rt_memory *memory, rt_error *error)
{
    return build(out, list, 1, threads, memory, error);
}

/* Takes the spheres of a block's photons into one lane's box. */
static void bound_spheres(rt_photon_node *node, size_t lane, const rt_photon_block *block,
                          size_t count)
{
    const float *radius = block->normal[RT_VOLUME_RADIUS];
    for (int axis = 0; axis < 3; axis++) {
        float *lo = &node->bounds[axis][lane], *hi = &node->bounds[3 + axis][lane];
        for (size_t i = 0; i < count; i++) {
            *lo = fminf(*lo, block->position[axis][i] - radius[i]);
            *hi = fmaxf(*hi, block->position[axis][i] + radius[i]);
        }
    }
}

void rt_photon_tree_bound_spheres(rt_photon_tree_data *tree)
{
    for (size_t n = 0; tree->shape.levels > 0 && n < level_size(tree, 0); n++) {
        clear_bounds(tree->nodes + n);
        for (size_t lane = 0; lane < 8 && 8 * n + lane < tree->shape.block_count; lane++) {
            const size_t block = 8 * n + lane, left = tree->shape.photon_count - 8 * block;
            bound_spheres(tree->nodes + n, lane, tree->blocks + block, left < 8 ? left : 8);
        }
    }
    for (rt_u32 level = 1; level < tree->shape.levels; level++)
        build_level(tree, level);
}

void rt_photon_tree_free(rt_photon_tree_data *tree)
{
    free(tree->block);
    rt_memory_give(tree->memory, tree->bytes, what);
    *tree = (rt_photon_tree_data){0};
}
