/*
 * tree.c - builds the binary tree: the top with all threads on each split, then subtrees of bounded
 * size, each by one thread. Where the top ends depends on the references alone, so the tree is the
 * same for any number of threads.
 */
#include "accel/tree.h"

#include <assert.h>
#include <pthread.h>
#include <string.h>

#include "accel/collapse.h"
#include "accel/partition.h"
#include "accel/split.h"
#include "base/memory.h"
#include "base/parallel.h"

/* Below this depth of the binary tree sets are halved, which bounds the recursion. */
enum { SAH_DEPTH = 64 };

/* Pairs of nodes, allocated in blocks that never move. */
enum { ARENA_PAIRS = 256 };
typedef struct rt_tree_block {
    struct rt_tree_block *next;
    rt_tree_node pairs[ARENA_PAIRS][2];
} rt_tree_block;

/* A subtree to be built by one thread. */
typedef struct subtree {
    rt_tree_node *node;
    rt_set set;
    int depth;
    rt_collapse_cost cost;
} subtree;

typedef struct builder {
    rt_ref *refs;
    uint32_t count;
    rt_split_rule rule;
    uint32_t threads;
    uint32_t longest; /* a subtree's references, at most */
    /* for splits: those of the references from `first` on have it from 2 first / CHUNK on */
    uint32_t *scratch;
    rt_tree_arena *arenas; /* one a subtree */
    rt_tree_arena top;
    subtree *subtrees; /* in the order of their references */
    uint32_t *order;   /* their indices, the longest first */
    uint32_t subtree_count, subtree_room;
    rt_memory *memory;
    rt_stage_progress *progress;
    pthread_t caller;     /* the only thread that reports progress */
    pthread_mutex_t lock; /* of the following */
    /* references split, once for each level of the top and once for the subtrees */
    uint64_t done, work;
    rt_status status;
    rt_error error; /* of RT_ERROR_MEMORY */
} builder;

static rt_status get_status(builder *b)
{
    pthread_mutex_lock(&b->lock);
    const rt_status status = b->status;
    pthread_mutex_unlock(&b->lock);
    return status;
}

static void set_status(builder *b, rt_status status, const rt_error *error)
{
    pthread_mutex_lock(&b->lock);
    if (b->status == RT_OK) {
        b->status = status;
        if (error)
            b->error = *error;
    }
    pthread_mutex_unlock(&b->lock);
}

/* Memory for the builder; failure is noted. */
static void *allocate(builder *b, size_t count, size_t size)
{
    rt_error error;
    void *block = rt_memory_alloc(b->memory, count, size, RT_BVH_NAME, &error);
    if (!block)
        set_status(b, RT_ERROR_MEMORY, &error);
    return block;
}

/* Counts references as done; the caller's thread passes it on. */
static void advance(builder *b, uint32_t count)
{
    pthread_mutex_lock(&b->lock);
    b->done += count;
    const double fraction = (double)b->done / (double)b->work;
    pthread_mutex_unlock(&b->lock);
    if (b->progress && pthread_equal(b->caller, pthread_self())) {
        const rt_status status = rt_stage_update(b->progress, fraction < 1.0 ? fraction : 1.0);
        if (status != RT_OK)
            set_status(b, status, NULL);
    }
}

/* Two nodes; NULL is a failure, which is noted. */
static rt_tree_node *new_pair(builder *b, rt_tree_arena *arena)
{
    if (arena->blocks == NULL || arena->used == ARENA_PAIRS) {
        rt_tree_block *block = allocate(b, 1, sizeof *block);
        if (block == NULL)
            return NULL;
        block->next = arena->blocks;
        arena->blocks = block;
        arena->used = 0;
    }
    return arena->blocks->pairs[arena->used++];
}

static void free_arena(rt_tree_arena *arena)
{
    while (arena->blocks) {
        rt_tree_block *next = arena->blocks->next;
        rt_memory_free(arena->blocks);
        arena->blocks = next;
    }
}

/* One analytic primitive, or triangles and parallelograms that fill no more than a block. */
static int fits_leaf(const rt_set *set)
{
    if (set->count == 1)
        return 1;
    if (set->count > RT_BVH_WIDTH)
        return 0;
    for (uint32_t i = 0; i < set->count; i++)
        if (set->refs[i].source == RT_SOURCE_ANALYTIC)
            return 0;
    return 1;
}

/* Gives the node its box. */
static void open_node(rt_tree_node *node, const rt_set *set)
{
    memcpy(node->lo, &set->box.lo, sizeof node->lo);
    memcpy(node->hi, &set->box.hi, sizeof node->hi);
    node->children = NULL;
}

/* Splits the node's references between two new children; false when there is no memory. */
static int divide(builder *b, rt_tree_node *node, rt_set sides[2], const rt_set *set, int depth,
                  rt_tree_arena *arena, uint32_t threads)
{
    uint32_t *scratch = b->scratch + node->first / (RT_PARTITION_CHUNK / 2);
    rt_tree_node *pair = new_pair(b, arena);
    if (pair == NULL)
        return 0;
    if (b->rule == RT_SPLIT_RULE_SAH && depth < SAH_DEPTH)
        rt_split_sah(sides, set, threads, scratch);
    else
        rt_split_median(sides, set, threads);
    assert(sides[0].count > 0 && sides[1].count > 0);
    node->children = pair;
    pair[0].first = node->first;
    pair[0].count = sides[0].count;
    pair[1].first = node->first + sides[0].count;
    pair[1].count = sides[1].count;
    return 1;
}

static rt_collapse_cost close_node(const builder *b, rt_tree_node *node,
                                   const rt_collapse_cost *left, const rt_collapse_cost *right)
{
    return b->rule == RT_SPLIT_RULE_SAH ? rt_collapse_inner(node, left, right)
                                        : rt_collapse_even(node);
}

static rt_collapse_cost grow(builder *b, rt_tree_node *node, const rt_set *set, int depth,
                             rt_tree_arena *arena)
{
    rt_set sides[2];
    open_node(node, set);
    if (fits_leaf(set) || !divide(b, node, sides, set, depth, arena, 1))
        return rt_collapse_leaf(node);
    const rt_collapse_cost left = grow(b, &node->children[0], &sides[0], depth + 1, arena);
    const rt_collapse_cost right = grow(b, &node->children[1], &sides[1], depth + 1, arena);
    return close_node(b, node, &left, &right);
}

static void grow_subtree(void *user, uint32_t index)
{
    builder *b = user;
    const uint32_t s = b->order[index];
    subtree *tree = &b->subtrees[s];
    if (get_status(b) != RT_OK)
        return;
    tree->cost = grow(b, tree->node, &tree->set, tree->depth, &b->arenas[s]);
    advance(b, tree->node->count);
}

static void add_subtree(builder *b, rt_tree_node *node, const rt_set *set, int depth)
{
    if (b->subtree_count == b->subtree_room) {
        const uint32_t room = b->subtree_room ? 2 * b->subtree_room : 64;
        rt_error error;
        subtree *grown =
            rt_memory_resize(b->memory, b->subtrees, room, sizeof *grown, RT_BVH_NAME, &error);
        if (grown == NULL) {
            set_status(b, RT_ERROR_MEMORY, &error);
            return;
        }
        b->subtrees = grown;
        b->subtree_room = room;
    }
    b->subtrees[b->subtree_count++] = (subtree){.node = node, .set = *set, .depth = depth};
}

static void grow_top(builder *b, rt_tree_node *node, const rt_set *set, int depth)
{
    rt_set sides[2];
    if (b->status != RT_OK)
        return;
    if (node->count <= b->longest) {
        add_subtree(b, node, set, depth);
        return;
    }
    open_node(node, set);
    if (!divide(b, node, sides, set, depth, &b->top, b->threads))
        return;
    advance(b, node->count);
    grow_top(b, &node->children[0], &sides[0], depth + 1);
    grow_top(b, &node->children[1], &sides[1], depth + 1);
}

/* Costs of the top; *next is the first subtree not yet met. */
static rt_collapse_cost close_top(const builder *b, rt_tree_node *node, uint32_t *next)
{
    if (node->count <= b->longest)
        return b->subtrees[(*next)++].cost;
    const rt_collapse_cost left = close_top(b, &node->children[0], next);
    const rt_collapse_cost right = close_top(b, &node->children[1], next);
    return close_node(b, node, &left, &right);
}

/* The longest subtree first, so that no thread is left alone with one at the end. */
static rt_status order_subtrees(builder *b)
{
    b->arenas = allocate(b, b->subtree_count, sizeof *b->arenas);
    b->order = allocate(b, b->subtree_count, sizeof *b->order);
    if (b->arenas)
        memset(b->arenas, 0, b->subtree_count * sizeof *b->arenas);
    if (b->arenas == NULL || b->order == NULL)
        return RT_ERROR_MEMORY;
    for (uint32_t i = 0; i < b->subtree_count; i++) {
        uint32_t at = i;
        for (; at > 0 && b->subtrees[b->order[at - 1]].node->count < b->subtrees[i].node->count;
             at--)
            b->order[at] = b->order[at - 1];
        b->order[at] = i;
    }
    return RT_OK;
}

/*
 * Enough subtrees for each thread that they end at about the same time, and no more: the threads
 * wait for each other in every split of the top.
 */
static uint32_t longest_subtree(uint32_t count, uint32_t threads)
{
    enum { SUBTREES_A_THREAD = 8, LEAST = 16384 };
    const uint32_t part = count / (SUBTREES_A_THREAD * threads);
    return part > LEAST ? part : LEAST;
}

/*
 * References to be split in all, for progress: once for each halving of the top and once for the
 * subtrees.
 */
static uint64_t estimate_work(uint32_t count, uint32_t longest)
{
    uint64_t work = count;
    for (uint32_t n = count; n > longest; n /= 2)
        work += count;
    return work;
}

static rt_status build(builder *b, rt_tree *tree)
{
    b->scratch = allocate(b, b->count / (RT_PARTITION_CHUNK / 2) + 1, sizeof *b->scratch);
    if (b->scratch == NULL)
        return RT_ERROR_MEMORY;
    tree->root.first = 0;
    tree->root.count = b->count;
    const rt_set all = rt_set_make(b->refs, b->count, b->threads);
    grow_top(b, &tree->root, &all, 0);
    if (b->status != RT_OK)
        return b->status;
    const rt_status ordered = order_subtrees(b);
    if (ordered != RT_OK)
        return ordered;
    rt_parallel(b->threads, b->subtree_count, grow_subtree, b);
    if (b->status != RT_OK)
        return b->status;
    uint32_t next = 0;
    close_top(b, &tree->root, &next);
    return RT_OK;
}

rt_status rt_tree_build(rt_tree *out, rt_ref *refs, uint32_t count, rt_split_rule rule,
                        uint32_t threads, rt_memory *memory, rt_stage_progress *progress,
                        rt_error *error)
{
    builder b = {0};
    b.memory = memory;
    b.refs = refs;
    b.count = count;
    b.rule = rule;
    b.threads = threads;
    b.progress = progress;
    b.caller = pthread_self();
    b.longest = longest_subtree(count, threads);
    b.work = estimate_work(count, b.longest);
    pthread_mutex_init(&b.lock, NULL);
    memset(out, 0, sizeof *out);
    const rt_status status = build(&b, out);
    pthread_mutex_destroy(&b.lock);
    rt_memory_free(b.scratch);
    rt_memory_free(b.subtrees);
    rt_memory_free(b.order);
    out->top = b.top;
    out->arenas = b.arenas;
    out->arena_count = b.arenas ? b.subtree_count : 0;
    if (status == RT_OK)
        return RT_OK;
    rt_tree_destroy(out);
    return status == RT_CANCELLED
               ? rt_fail(error, RT_CANCELLED, "cancelled while the hierarchy was built")
               : rt_fail(error, status, "%s", b.error.message);
}

void rt_tree_destroy(rt_tree *tree)
{
    free_arena(&tree->top);
    for (uint32_t i = 0; i < tree->arena_count; i++)
        free_arena(&tree->arenas[i]);
    rt_memory_free(tree->arenas);
    tree->arenas = NULL;
    tree->arena_count = 0;
}
