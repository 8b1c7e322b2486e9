/* collapse.c - computes costs from the leaves up, and makes the choices from the root down. */
#include "accel/collapse.h"

#include <math.h>

/*
 * The cost of visiting a node. Its eight boxes, with the sorting of those hit, took about as long
 * as a leaf's eight triangles where this was tuned; the leaves are given, so only the cost of nodes
 * matters.
 */
static const float node_cost = 1.0f;
static const float leaf_cost = 1.0f;

static float area(const rt_tree_node *node)
{
    const float x = node->hi[0] - node->lo[0], y = node->hi[1] - node->lo[1],
                z = node->hi[2] - node->lo[2];
    return x * (y + z) + y * z;
}

rt_collapse_cost rt_collapse_leaf(rt_tree_node *node)
{
    rt_collapse_cost cost;
    for (int j = 0; j < RT_BVH_WIDTH; j++) {
        cost.roots[j] = leaf_cost * area(node);
        node->choice.left[j] = 0;
    }
    return cost;
}

rt_collapse_cost rt_collapse_inner(rt_tree_node *node, const rt_collapse_cost *left,
                                   const rt_collapse_cost *right)
{
    rt_collapse_cost cost;
    for (int j = 1; j < RT_BVH_WIDTH; j++) {
        float best = INFINITY;
        int best_left = 1;
        for (int k = 1; k <= j; k++) {
            const float c = left->roots[k - 1] + right->roots[j - k];
            if (c < best) {
                best = c;
                best_left = k;
            }
        }
        cost.roots[j] = best;
        node->choice.left[j] = (uint8_t)best_left;
    }
    cost.roots[0] = cost.roots[RT_BVH_WIDTH - 1] + node_cost * area(node);
    for (int j = 1; j < RT_BVH_WIDTH - 1; j++)
        if (cost.roots[j - 1] < cost.roots[j]) {
            cost.roots[j] = cost.roots[j - 1];
            node->choice.left[j] = 0;
        }
    return cost;
}

rt_collapse_cost rt_collapse_even(rt_tree_node *node)
{
    const rt_collapse_cost none = {{0}};
    for (int j = 1; j < RT_BVH_WIDTH; j++)
        node->choice.left[j] = (uint8_t)((j + 1) / 2);
    return none;
}

/* Appends the at most j roots that represent the node; returns their number. */
static int gather(const rt_tree_node *node, int j, const rt_tree_node **out)
{
    while (j > 1 && node->choice.left[j - 1] == 0)
        j--;
    if (j == 1) {
        out[0] = node;
        return 1;
    }
    const int left = node->choice.left[j - 1];
    const int n = gather(&node->children[0], left, out);
    return n + gather(&node->children[1], j - left, out + n);
}

/* Stable, so that the order depends on nothing else. */
static void sort_by_area(const rt_tree_node **nodes, int count)
{
    for (int i = 1; i < count; i++) {
        const rt_tree_node *node = nodes[i];
        int at = i;
        for (; at > 0 && area(nodes[at - 1]) < area(node); at--)
            nodes[at] = nodes[at - 1];
        nodes[at] = node;
    }
}

int rt_collapse_children(const rt_tree_node *node, const rt_tree_node *out[RT_BVH_WIDTH])
{
    const int count = gather(node, RT_BVH_WIDTH, out);
    sort_by_area(out, count);
    return count;
}
