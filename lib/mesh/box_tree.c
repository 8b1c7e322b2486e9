/*
 * box_tree.c - sorts items along a curve, builds boxes about runs of them from the leaves up, and
 * searches from the root.
 */
#include "mesh/box_tree.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const rt_box rt_box_empty = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};

void rt_box_add(rt_box *box, const double point[2])
{
    for (int i = 0; i < 2; i++) {
        box->lo[i] = fmin(box->lo[i], point[i]);
        box->hi[i] = fmax(box->hi[i], point[i]);
    }
}

/* ---- The curve --------------------------------------------------------------- */

typedef struct item {
    uint32_t key, item;
} item;

static int compare(const void *a, const void *b)
{
    const item *x = a, *y = b;
    return x->key != y->key ? (x->key > y->key) - (x->key < y->key)
                            : (x->item > y->item) - (x->item < y->item);
}

/* Every second bit of a number of 16 bits. */
static uint32_t spread(double fraction)
{
    uint32_t bits = (uint32_t)(fraction * 65535);
    bits = (bits | bits << 8) & 0x00ff00ff;
    bits = (bits | bits << 4) & 0x0f0f0f0f;
    bits = (bits | bits << 2) & 0x33333333;
    return (bits | bits << 1) & 0x55555555;
}

/* Morton's order in the square about all. */
static rt_status sort(rt_box_tree *tree, const double (*points)[2], const rt_mesh_source *source)
{
    rt_box box = rt_box_empty;
    item *items = NULL;
    if (rt_mesh_resize(source, (void **)&items, tree->count, sizeof *items) != RT_OK)
        return RT_ERROR_MEMORY;
    for (size_t i = 0; i < tree->count; i++)
        rt_box_add(&box, points[i]);
    const double side = fmax(box.hi[0] - box.lo[0], box.hi[1] - box.lo[1]);
    for (size_t i = 0; i < tree->count; i++) {
        const double x = points[i][0] - box.lo[0], y = points[i][1] - box.lo[1];
        items[i].item = (uint32_t)i;
        items[i].key = side > 0 ? spread(x / side) | spread(y / side) << 1 : 0;
    }
    qsort(items, tree->count, sizeof *items, compare);
    for (size_t i = 0; i < tree->count; i++) {
        tree->order[i] = items[i].item;
        tree->places[items[i].item] = (uint32_t)i;
    }
    rt_memory_free(items);
    return RT_OK;
}

/* ---- The tree ---------------------------------------------------------------- */

rt_status rt_box_tree_make(rt_box_tree *tree, const double (*points)[2], size_t count,
                           const rt_mesh_source *source)
{
    *tree = (rt_box_tree){.leaf_count = 1, .count = count};
    while (tree->leaf_count * RT_BOX_LEAF < count)
        tree->leaf_count *= 2;
    rt_status status =
        rt_mesh_resize(source, (void **)&tree->nodes, 2 * tree->leaf_count, sizeof *tree->nodes);
    if (status == RT_OK)
        status = rt_mesh_resize(source, (void **)&tree->order, count, 2 * sizeof *tree->order);
    if (status != RT_OK)
        return status;
    tree->places = tree->order + count;
    for (size_t i = 0; i < 2 * tree->leaf_count; i++)
        tree->nodes[i] = rt_box_empty;
    return sort(tree, points, source);
}

void rt_box_tree_free(rt_box_tree *tree)
{
    rt_memory_free(tree->nodes);
    rt_memory_free(tree->order);
    memset(tree, 0, sizeof *tree);
}

void rt_box_tree_set(rt_box_tree *tree, size_t leaf, const rt_box *box)
{
    tree->nodes[tree->leaf_count + leaf] = *box;
}

static void join(rt_box_tree *tree, size_t node)
{
    const rt_box *below = tree->nodes + 2 * node;
    for (int i = 0; i < 2; i++) {
        tree->nodes[node].lo[i] = fmin(below[0].lo[i], below[1].lo[i]);
        tree->nodes[node].hi[i] = fmax(below[0].hi[i], below[1].hi[i]);
    }
}

void rt_box_tree_join(rt_box_tree *tree)
{
    for (size_t node = tree->leaf_count; --node > 0;)
        join(tree, node);
}

void rt_box_tree_update(rt_box_tree *tree, size_t leaf)
{
    for (size_t node = (tree->leaf_count + leaf) / 2; node > 0; node /= 2) {
        join(tree, node);
        tree->steps++;
    }
}

/* ---- Searching --------------------------------------------------------------- */

void rt_box_search_begin(rt_box_search *search, rt_box_tree *tree, const rt_box *box,
                         const double (*triangle)[2])
{
    search->tree = tree;
    search->box = *box;
    search->triangle = triangle;
    search->stack[0] = 1;
    search->depth = 1;
}

/* Whether the whole box lies to the right of the line from a to b. */
static int is_right_of(const rt_box *box, const double a[2], const double b[2])
{
    const double x = b[0] - a[0], y = b[1] - a[1];
    /* its corner farthest to the left */
    const double left[2] = {y < 0 ? box->hi[0] : box->lo[0], x < 0 ? box->lo[1] : box->hi[1]};
    const double l = x * (left[1] - a[1]), r = y * (left[0] - a[0]);
    return l - r < -1e-12 * (fabs(l) + fabs(r));
}

static int meets(const rt_box_search *search, const rt_box *box)
{
    for (int i = 0; i < 2; i++)
        if (!(box->lo[i] <= search->box.hi[i] && search->box.lo[i] <= box->hi[i]))
            return 0;
    for (int i = 0; search->triangle && i < 3; i++)
        if (is_right_of(box, search->triangle[i], search->triangle[(i + 1) % 3]))
            return 0;
    return 1;
}

size_t rt_box_search_next(rt_box_search *search)
{
    rt_box_tree *tree = search->tree;
    while (search->depth > 0) {
        size_t node = search->stack[--search->depth];
        tree->steps++;
        if (!meets(search, tree->nodes + node))
            continue;
        if (node >= tree->leaf_count)
            return node - tree->leaf_count;
        search->stack[search->depth++] = 2 * node + 1;
        search->stack[search->depth++] = 2 * node;
    }
    return SIZE_MAX;
}
