/* bvh.c - builds the hierarchy from its input, and writes the arrays that kernels read. */
#include "accel/bvh.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

#include "accel/refs.h"
#include "accel/tree.h"
#include "accel/wide.h"
#include "base/memory.h"

struct rt_bvh {
    rt_bvh_input input;
    uint32_t threads;
    uint32_t count; /* primitives */
    rt_origin *origins;
    rt_tree tree;
    rt_wide_plan plan;
};

/*
 * Builds by cost; should the tree be so unbalanced that a traversal's stack would not hold it, or
 * two-wide nodes made of it be too deep, builds again by halves. Then each of fewer than 2^30
 * references' sets of blocks is halved at most 27 times, and a set that mixes kinds three times
 * more: 30 binary levels, three of which make a wide one. Ten wide levels of seven waiting children
 * and the last one's eight are below RT_BVH_STACK, and 30 levels with two for the lanes of a block
 * below RT_PAIR_STACK.
 */
static rt_status build_tree(rt_bvh *bvh, rt_ref *refs, rt_stage_progress *progress, rt_error *error)
{
    static const rt_split_rule rules[] = {RT_SPLIT_RULE_SAH, RT_SPLIT_RULE_MEDIAN};
    for (int i = 0; i < 2; i++) {
        rt_status status = rt_tree_build(&bvh->tree, refs, bvh->count, rules[i], bvh->threads,
                                         bvh->input.memory, progress, error);
        if (status == RT_OK)
            status = rt_wide_plan_make(&bvh->plan, &bvh->tree, refs, bvh->input.memory, error);
        if (status != RT_OK)
            return status;
        const int is_flat = !bvh->input.has_pairs || bvh->plan.levels <= RT_PAIR_STACK;
        if (bvh->plan.stack <= RT_BVH_STACK && is_flat)
            return RT_OK;
        rt_wide_plan_free(&bvh->plan);
        rt_tree_destroy(&bvh->tree);
    }
    assert(!"a tree of halves fits the stack");
    return RT_ERROR_MEMORY;
}

/* Keeps of each reference where it comes from, in place, and gives the rest of the memory back. */
static rt_origin *keep_origins(rt_ref *refs, uint32_t count)
{
    unsigned char *bytes = (unsigned char *)refs;
    for (uint32_t i = 0; i < count; i++) {
        const rt_origin origin = {refs[i].index, refs[i].source};
        memcpy(bytes + i * sizeof origin, &origin, sizeof origin);
    }
    void *shrunk = rt_memory_resize(NULL, refs, count, sizeof(rt_origin), RT_BVH_NAME, NULL);
    return shrunk ? shrunk : (void *)refs;
}

/* Bytes that the build takes at least: a leaf holds one analytic entry or fills a block. */
static double bytes_at_least(const rt_bvh *bvh)
{
    const double analytic = bvh->input.analytic_count, others = bvh->count - analytic;
    return bvh->count * (double)sizeof(rt_ref) +
           2 * (analytic + others / RT_BVH_WIDTH) * (double)sizeof(rt_tree_node);
}

static rt_status build(rt_bvh *bvh, rt_stage_progress *progress, rt_error *error)
{
    if (rt_memory_foresee(bvh->input.memory, bytes_at_least(bvh), RT_BVH_NAME, error) != RT_OK)
        return RT_ERROR_MEMORY;
    rt_ref *refs = rt_memory_alloc(bvh->input.memory, bvh->count, sizeof *refs, RT_BVH_NAME, error);
    if (refs == NULL)
        return RT_ERROR_MEMORY;
    rt_refs_fill(refs, &bvh->input, bvh->threads);
    const rt_status status = build_tree(bvh, refs, progress, error);
    if (status != RT_OK) {
        rt_memory_free(refs);
        return status;
    }
    bvh->origins = keep_origins(refs, bvh->count);
    return RT_OK;
}

rt_status rt_bvh_build(rt_bvh **out, const rt_bvh_input *input, uint32_t threads,
                       rt_stage_progress *progress, rt_error *error)
{
    const uint64_t count = rt_refs_count(input);
    if (count >= RT_CHILD_INDEX)
        return rt_fail(error, RT_ERROR_INPUT,
                       "%llu primitives are more than the %lu that a hierarchy can hold",
                       (unsigned long long)count, (unsigned long)RT_CHILD_INDEX);
    rt_bvh *bvh = calloc(1, sizeof *bvh);
    if (bvh == NULL)
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory for " RT_BVH_NAME);
    bvh->input = *input;
    bvh->threads = threads;
    bvh->count = (uint32_t)count;
    const rt_status status = count ? build(bvh, progress, error) : RT_OK;
    if (status != RT_OK) {
        rt_bvh_destroy(bvh);
        return status;
    }
    *out = bvh;
    return RT_OK;
}

void rt_bvh_get_counts(const rt_bvh *bvh, rt_bvh_counts *out)
{
    out->nodes = bvh->count ? bvh->plan.counts.node : 1;
    out->blocks = bvh->plan.counts.block;
    out->analytic = bvh->plan.counts.analytic;
}

void rt_bvh_get_bounds(const rt_bvh *bvh, float lo[3], float hi[3])
{
    memcpy(lo, bvh->tree.root.lo, sizeof bvh->tree.root.lo);
    memcpy(hi, bvh->tree.root.hi, sizeof bvh->tree.root.hi);
}

void rt_bvh_write(const rt_bvh *bvh, rt_bvh_node *nodes, rt_tri_block *blocks, uint32_t *analytic,
                  uint32_t first_node, uint32_t first_block)
{
    const rt_wide_output output = {&bvh->input, bvh->origins, nodes,      blocks,
                                   analytic,    first_node,   first_block};
    if (bvh->count)
        rt_wide_write(&bvh->plan, &bvh->tree, &output, bvh->threads);
    else
        rt_wide_write_empty(nodes);
}

void rt_bvh_destroy(rt_bvh *bvh)
{
    if (bvh == NULL)
        return;
    rt_wide_plan_free(&bvh->plan);
    rt_tree_destroy(&bvh->tree);
    rt_memory_free(bvh->origins);
    free(bvh);
}
