/* tree.h - the binary tree that is collapsed to the eight-wide one. */
#ifndef RT_LIB_ACCEL_TREE_H
#define RT_LIB_ACCEL_TREE_H

#include <stdint.h>

#include "accel/refs.h"
#include "accel/tree_node.h"
#include "base/progress.h"
#include "rt.h"

/* What needs the memory, as messages say it. */
#define RT_BVH_NAME "the bounding volume hierarchy"

typedef enum rt_split_rule {
    RT_SPLIT_RULE_SAH,   /* best cost; no bound on depth */
    RT_SPLIT_RULE_MEDIAN /* depth at most log2 of the number of references */
} rt_split_rule;

/* Where nodes live: blocks that never move. */
typedef struct rt_tree_arena {
    struct rt_tree_block *blocks;
    int used; /* pairs of the first block */
} rt_tree_arena;

typedef struct rt_tree {
    rt_tree_node root;
    rt_tree_arena top;
    rt_tree_arena *arenas; /* one for each subtree that was built by itself */
    uint32_t arena_count;
} rt_tree;

/*
 * Reorders refs and builds a tree over them, which counts in `memory`; count > 0. Fails with
 * RT_ERROR_MEMORY or RT_CANCELLED.
 */
rt_status rt_tree_build(rt_tree *out, rt_ref *refs, uint32_t count, rt_split_rule rule,
                        uint32_t threads, rt_memory *memory, rt_stage_progress *progress,
                        rt_error *error);
void rt_tree_destroy(rt_tree *tree);

#endif
