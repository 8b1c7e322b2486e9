/*
 * tree_node.h - a node of the binary tree, and the choices by which it is collapsed to wide nodes.
 */
#ifndef RT_LIB_ACCEL_TREE_NODE_H
#define RT_LIB_ACCEL_TREE_NODE_H

#include <stdint.h>

#include "types.h"

/*
 * How a node of the binary tree is represented by at most j roots: left[j] of them in its left
 * child and the others in the right one, or, where left[j] is 0, by j - 1 roots.
 */
typedef struct rt_collapse_choice {
    uint8_t left[RT_BVH_WIDTH]; /* of j = index + 1; left[0] has no meaning */
} rt_collapse_choice;

typedef struct rt_tree_node {
    float lo[3], hi[3];
    struct rt_tree_node *children; /* two; NULL where the references can be one leaf */
    uint32_t first, count;         /* its references */
    rt_collapse_choice choice;
} rt_tree_node;

#endif
