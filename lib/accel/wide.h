/*
 * wide.h - numbers and writes the eight-wide nodes and leaves that a collapsed binary tree stands
 * for.
 */
#ifndef RT_LIB_ACCEL_WIDE_H
#define RT_LIB_ACCEL_WIDE_H

#include <stdint.h>

#include "accel/input.h"
#include "accel/tree.h"
#include "types.h"

/* Places in the three output arrays. */
typedef struct rt_wide_cursor {
    uint32_t node, block, analytic;
} rt_wide_cursor;

/* A part of the tree that is written by itself: the wide node `root` and all below it. */
typedef struct rt_wide_part {
    const rt_tree_node *root;
    rt_wide_cursor begin, end;
} rt_wide_part;

typedef struct rt_wide_plan {
    rt_wide_cursor counts;
    uint32_t stack;  /* most entries that a traversal can have on its stack */
    uint32_t levels; /* of the two-wide nodes that stand for it where they split by halves */
    rt_wide_part *parts;
    uint32_t part_count, part_room;
    rt_memory *memory;
} rt_wide_plan;

/* Where a primitive comes from: what is left of its reference once the tree stands. */
typedef struct rt_origin {
    uint32_t index, source;
} rt_origin;

/* The arrays to write, and what is written from. */
typedef struct rt_wide_output {
    const rt_bvh_input *input;
    const rt_origin *origins; /* of the tree's references, in their order */
    rt_bvh_node *nodes;
    rt_tri_block *blocks;
    uint32_t *analytic;
    uint32_t first_node, first_block; /* added to references */
} rt_wide_output;

/*
 * Numbers nodes and leaves depth first; the plan counts in `memory` and is to be freed whatever is
 * returned. Fails with RT_ERROR_MEMORY.
 */
rt_status rt_wide_plan_make(rt_wide_plan *plan, const rt_tree *tree, const rt_ref *refs,
                            rt_memory *memory, rt_error *error);
void rt_wide_plan_free(rt_wide_plan *plan);

/* Writes what was planned. */
void rt_wide_write(const rt_wide_plan *plan, const rt_tree *tree, const rt_wide_output *output,
                   uint32_t threads);

/* Writes a root without children. */
void rt_wide_write_empty(rt_bvh_node *root);

#endif
