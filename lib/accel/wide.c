/* wide.c - numbers nodes depth first, so that those visited in turn are close in memory. */
#include "accel/wide.h"

#include <math.h>
#include <string.h>

#include "accel/collapse.h"
#include "base/memory.h"
#include "base/parallel.h"

/* A part holds at most so many references. */
enum { PART_REFS = 16384 };

static int starts_part(const rt_tree_node *node)
{
    return node->count <= PART_REFS;
}

static int add_part(rt_wide_plan *plan, const rt_tree_node *node, rt_wide_cursor begin,
                    rt_wide_cursor end, rt_error *error)
{
    if (plan->part_count == plan->part_room) {
        const uint32_t room = plan->part_room ? 2 * plan->part_room : 64;
        rt_wide_part *grown =
            rt_memory_resize(plan->memory, plan->parts, room, sizeof *grown, RT_BVH_NAME, error);
        if (grown == NULL)
            return 0;
        plan->parts = grown;
        plan->part_room = room;
    }
    plan->parts[plan->part_count++] = (rt_wide_part){node, begin, end};
    return 1;
}

/* Levels of two-wide nodes that stand for so many children, and for the lanes of a block. */
static uint32_t levels_of(int children)
{
    return children <= 2 ? 1 : children <= 4 ? 2 : 3;
}

enum { LANE_LEVELS = 2 };

/*
 * Numbers the wide node made of `node` and all below it. Returns the most entries that its
 * traversal adds to a stack: its k children are pushed at once, and while one is visited the other
 * k - 1 wait. 0: no memory.
 */
static uint32_t number(rt_wide_plan *plan, const rt_ref *refs, const rt_tree_node *node,
                       int in_part, uint32_t level, rt_error *error)
{
    const rt_tree_node *children[RT_BVH_WIDTH];
    const int k = rt_collapse_children(node, children);
    const int part = !in_part && starts_part(node);
    const rt_wide_cursor begin = plan->counts;
    const uint32_t last = level + levels_of(k);
    uint32_t deepest = 1;

    plan->counts.node++;
    plan->levels = last + LANE_LEVELS > plan->levels ? last + LANE_LEVELS : plan->levels;
    for (int i = 0; i < k; i++) {
        if (children[i]->children == NULL) {
            if (refs[children[i]->first].source == RT_SOURCE_ANALYTIC)
                plan->counts.analytic++;
            else
                plan->counts.block++;
            continue;
        }
        const uint32_t below = number(plan, refs, children[i], in_part || part, last, error);
        if (below == 0)
            return 0;
        deepest = below > deepest ? below : deepest;
    }
    if (part && !add_part(plan, node, begin, plan->counts, error))
        return 0;
    return (uint32_t)k - 1 + deepest;
}

rt_status rt_wide_plan_make(rt_wide_plan *plan, const rt_tree *tree, const rt_ref *refs,
                            rt_memory *memory, rt_error *error)
{
    memset(plan, 0, sizeof *plan);
    plan->memory = memory;
    plan->stack = number(plan, refs, &tree->root, 0, 0, error);
    return plan->stack > 0 ? RT_OK : RT_ERROR_MEMORY;
}

void rt_wide_plan_free(rt_wide_plan *plan)
{
    rt_memory_free(plan->parts);
    plan->parts = NULL;
    plan->part_count = 0;
}

/* A traversal in the order of the numbering. */
typedef struct writer {
    const rt_wide_output *out;
    const rt_wide_part *next_part; /* part not yet met; NULL inside a part */
    rt_wide_cursor at;
} writer;

static void write_block(const rt_wide_output *out, rt_tri_block *block, const rt_tree_node *leaf)
{
    memset(block, 0, sizeof *block);
    for (uint32_t lane = 0; lane < RT_BVH_WIDTH; lane++) {
        if (lane >= leaf->count) {
            block->prim[lane] = RT_NONE;
            continue;
        }
        const rt_origin origin = out->origins[leaf->first + lane];
        float v[3][3];
        block->prim[lane] = rt_ref_vertices(out->input, origin.source, origin.index, v);
        for (int a = 0; a < 3; a++) {
            block->v0[a][lane] = v[0][a];
            block->v1[a][lane] = v[1][a];
            block->v2[a][lane] = v[2][a];
        }
    }
}

static uint32_t write_leaf(writer *w, const rt_tree_node *leaf)
{
    const rt_origin origin = w->out->origins[leaf->first];
    if (origin.source == RT_SOURCE_ANALYTIC) {
        w->out->analytic[w->at.analytic] = w->out->input->analytic[origin.index].shape;
        return w->at.analytic++ | RT_CHILD_LEAF | RT_CHILD_ANALYTIC;
    }
    write_block(w->out, &w->out->blocks[w->at.block], leaf);
    return (w->out->first_block + w->at.block++) | RT_CHILD_LEAF;
}

static void write_lane(rt_bvh_node *node, int lane, const rt_tree_node *child, uint32_t reference)
{
    for (int a = 0; a < 3; a++) {
        node->bounds[a][lane] = child ? child->lo[a] : INFINITY;
        node->bounds[3 + a][lane] = child ? child->hi[a] : -INFINITY;
    }
    node->child[lane] = reference;
}

static void write_node(writer *w, const rt_tree_node *from)
{
    const rt_tree_node *children[RT_BVH_WIDTH];
    const int k = rt_collapse_children(from, children);
    rt_bvh_node *node = &w->out->nodes[w->at.node++];
    memset(node, 0, sizeof *node);
    for (int i = 0; i < k; i++) {
        const rt_tree_node *child = children[i];
        if (child->children == NULL) {
            write_lane(node, i, child, write_leaf(w, child));
        } else if (w->next_part && w->next_part->root == child) {
            /* Another thread writes it: go on behind it. */
            write_lane(node, i, child, w->out->first_node + w->at.node);
            w->at = w->next_part++->end;
        } else {
            write_lane(node, i, child, w->out->first_node + w->at.node);
            write_node(w, child);
        }
    }
    for (int i = k; i < RT_BVH_WIDTH; i++)
        write_lane(node, i, NULL, RT_NONE);
}

typedef struct write_job {
    const rt_wide_plan *plan;
    const rt_wide_output *out;
} write_job;

static void write_part(void *user, uint32_t index)
{
    const write_job *job = user;
    const rt_wide_part *part = &job->plan->parts[index];
    writer w = {job->out, NULL, part->begin};
    write_node(&w, part->root);
}

void rt_wide_write(const rt_wide_plan *plan, const rt_tree *tree, const rt_wide_output *output,
                   uint32_t threads)
{
    write_job job = {plan, output};
    rt_parallel(threads, plan->part_count, write_part, &job);
    if (plan->part_count > 0 && plan->parts[0].root == &tree->root)
        return;
    writer w = {output, plan->parts, {0, 0, 0}};
    write_node(&w, &tree->root);
}

void rt_wide_write_empty(rt_bvh_node *root)
{
    memset(root, 0, sizeof *root);
    for (int i = 0; i < RT_BVH_WIDTH; i++)
        write_lane(root, i, NULL, RT_NONE);
}
