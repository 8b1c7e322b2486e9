/*
 * collapse.h - which nodes of the binary tree become the eight-wide ones.
 *
 * The expected cost of a ray is the sum over wide nodes of their area times the cost of a node,
 * plus that over leaves. Dynamic programming from the leaves up finds for each subtree the least
 * cost of representing it by at most j roots, j = 1 .. 8 (Ylitie, Karras and Laine, "Efficient
 * Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs", High Performance Graphics 2017,
 * section 3).
 */
#ifndef RT_LIB_ACCEL_COLLAPSE_H
#define RT_LIB_ACCEL_COLLAPSE_H

#include "accel/tree_node.h"
#include "types.h"

/* Least cost of a subtree by at most j roots, at index j - 1. */
typedef struct rt_collapse_cost {
    float roots[RT_BVH_WIDTH];
} rt_collapse_cost;

/* For a node without children. */
rt_collapse_cost rt_collapse_leaf(rt_tree_node *node);

/* For a node whose children have these costs. */
rt_collapse_cost rt_collapse_inner(rt_tree_node *node, const rt_collapse_cost *left,
                                   const rt_collapse_cost *right);

/*
 * The same with roots divided evenly whatever their cost, so that three binary levels make a wide
 * one.
 */
rt_collapse_cost rt_collapse_even(rt_tree_node *node);

/*
 * The nodes that are the children of the wide node made of `node`, the largest area first: a ray
 * that asks only whether anything is hit tries them in this order. Returns their number, 1 to 8.
 */
int rt_collapse_children(const rt_tree_node *node, const rt_tree_node *out[RT_BVH_WIDTH]);

#endif
