/* crossings.c - whether the edges of a polygon in the plane cross. */
#include <math.h>

#include "mesh/ears.h"

double rt_outline_turn(const rt_outline *outline, const double a[2], const double b[2],
                       const double c[2])
{
    const double bx = b[0] - a[0], by = b[1] - a[1], cx = c[0] - a[0], cy = c[1] - a[1];
    const double area = bx * cy - by * cx;
    const double rounding = 1e-15 * outline->extent * (fabs(bx) + fabs(by) + fabs(cx) + fabs(cy));
    return fabs(area) <= rounding ? 0 : area;
}

static const double *end_of(const rt_outline *outline, size_t edge)
{
    return outline->points[edge + 1 < outline->count ? edge + 1 : 0];
}

static rt_box box_of(const rt_outline *outline, size_t edge)
{
    rt_box box = rt_box_empty;
    rt_box_add(&box, outline->points[edge]);
    rt_box_add(&box, end_of(outline, edge));
    return box;
}

static int are_apart(double x, double y)
{
    return (x > 0 && y < 0) || (x < 0 && y > 0);
}

static int edges_cross(const rt_outline *o, size_t i, size_t k)
{
    const double *a = o->points[i], *b = end_of(o, i), *c = o->points[k], *d = end_of(o, k);
    return are_apart(rt_outline_turn(o, a, b, c), rt_outline_turn(o, a, b, d)) &&
           are_apart(rt_outline_turn(o, c, d, a), rt_outline_turn(o, c, d, b));
}

/* Boxes about edges; each is listed by where it begins. */
static void fill(rt_box_tree *tree, const rt_outline *outline)
{
    for (size_t leaf = 0; leaf * RT_BOX_LEAF < outline->count; leaf++) {
        rt_box box = rt_box_empty;
        for (size_t i = leaf * RT_BOX_LEAF; i < rt_box_leaf_end(tree, leaf); i++) {
            rt_box_add(&box, outline->points[tree->order[i]]);
            rt_box_add(&box, end_of(outline, tree->order[i]));
        }
        rt_box_tree_set(tree, leaf, &box);
    }
    rt_box_tree_join(tree);
}

/* Whether an edge crosses a later one. */
static int crosses_later(rt_box_tree *tree, const rt_outline *outline, size_t edge)
{
    const rt_box box = box_of(outline, edge);
    rt_box_search search;
    size_t leaf;
    rt_box_search_begin(&search, tree, &box, NULL);
    while ((leaf = rt_box_search_next(&search)) != SIZE_MAX)
        for (size_t i = leaf * RT_BOX_LEAF; i < rt_box_leaf_end(tree, leaf); i++)
            if (tree->order[i] > edge && edges_cross(outline, edge, tree->order[i]))
                return 1;
    return 0;
}

int rt_outline_may_go_on(const rt_outline *outline, rt_box_tree *tree, uint64_t steps)
{
    if (tree->steps - tree->asked > 0xffff) {
        tree->asked = tree->steps;
        rt_mesh_step(outline->source, 1, 1);
    }
    return tree->steps < steps * outline->count && !outline->source->progress->cancelled;
}

rt_status rt_outline_cross(rt_polygon *found, const rt_outline *outline)
{
    rt_box_tree tree;
    rt_status status = rt_box_tree_make(&tree, outline->points, outline->count, outline->source);
    if (status == RT_OK) {
        fill(&tree, outline);
        for (size_t i = 0; i < outline->count && *found == RT_POLYGON_SIMPLE; i++)
            if (!rt_outline_may_go_on(outline, &tree, RT_OUTLINE_STEPS))
                *found = RT_POLYGON_TOO_INVOLVED;
            else if (crosses_later(&tree, outline, i))
                *found = RT_POLYGON_CROSSING;
        status = outline->source->progress->cancelled ? RT_CANCELLED : RT_OK;
    }
    rt_box_tree_free(&tree);
    return status;
}
