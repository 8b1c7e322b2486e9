/*
 * ears.c - clips ears: a convex corner whose triangle with its neighbours holds no other corner.
 *
 * Of those, only corners that are not convex have to be looked at, which a tree of boxes finds. In
 * a simple polygon, clipping an ear makes ears of its two neighbours at most, so that each corner
 * is looked at three times. Where corners touch edges or each other there may be more, which are
 * then looked for among all.
 */
#include "mesh/ears.h"

#include <math.h>
#include <string.h>

typedef enum corner_kind {
    CONVEX,
    REFLEX,
    STRAIGHT, /* in the middle of an edge */
    NEEDLE,   /* the outline turns back there, or stays where it is: no area */
    GONE
} corner_kind;

/* Which corners on the sides of a triangle keep it from being an ear. */
typedef enum strictness {
    ALL,     /* all but those at its own corners; the rest of the polygon stays as it is then */
    ENTERING /* those whose edges go inside */
} strictness;

typedef struct clipper {
    const rt_outline *outline;
    rt_box_tree tree;         /* of the obstacles: reflex and straight corners */
    uint32_t *before, *after; /* [count] */
    uint32_t *queue;          /* [count]: a ring of corners to look at */
    uint8_t *kinds, *is_queued;
    size_t first, queued, left;
    uint64_t steps; /* for each corner */
    uint32_t (*triangles)[3];
} clipper;

static const double *at(const clipper *c, uint32_t corner)
{
    return c->outline->points[corner];
}

static corner_kind classify(const clipper *c, uint32_t corner)
{
    const double *a = at(c, c->before[corner]), *b = at(c, corner), *d = at(c, c->after[corner]);
    const double turn = rt_outline_turn(c->outline, a, b, d);
    if (turn != 0)
        return turn > 0 ? CONVEX : REFLEX;
    const double along = (b[0] - a[0]) * (d[0] - b[0]) + (b[1] - a[1]) * (d[1] - b[1]);
    return along > 0 ? STRAIGHT : NEEDLE;
}

static int is_obstacle(const clipper *c, uint32_t corner)
{
    return c->kinds[corner] == REFLEX || c->kinds[corner] == STRAIGHT;
}

/* Sets the box of the leaf that a corner belongs to. */
static void set_leaf(clipper *c, size_t leaf)
{
    rt_box box = rt_box_empty;
    for (size_t i = leaf * RT_BOX_LEAF; i < rt_box_leaf_end(&c->tree, leaf); i++)
        if (is_obstacle(c, c->tree.order[i]))
            rt_box_add(&box, at(c, c->tree.order[i]));
    rt_box_tree_set(&c->tree, leaf, &box);
}

static void set_kind(clipper *c, uint32_t corner, corner_kind kind)
{
    const int was = is_obstacle(c, corner);
    c->kinds[corner] = (uint8_t)kind;
    if (was != is_obstacle(c, corner)) {
        const size_t leaf = c->tree.places[corner] / RT_BOX_LEAF;
        set_leaf(c, leaf);
        rt_box_tree_update(&c->tree, leaf);
    }
}

static void push(clipper *c, uint32_t corner)
{
    if (c->is_queued[corner] || (c->kinds[corner] != CONVEX && c->kinds[corner] != NEEDLE))
        return;
    c->is_queued[corner] = 1;
    c->queue[(c->first + c->queued++) % c->outline->count] = corner;
}

/* Whether an edge from a corner on the side of a triangle goes into it: turns 0 are its sides. */
static int enters(const clipper *c, const double (*triangle)[2], const double turns[3],
                  uint32_t other)
{
    for (int i = 0; i < 3; i++)
        if (turns[i] == 0 &&
            !(rt_outline_turn(c->outline, triangle[i], triangle[(i + 1) % 3], at(c, other)) > 0))
            return 0;
    return 1;
}

static int blocks(const clipper *c, const double (*triangle)[2], uint32_t corner,
                  strictness strictness)
{
    double turns[3];
    int sides = 0;
    for (int i = 0; i < 3; i++) {
        turns[i] = rt_outline_turn(c->outline, triangle[i], triangle[(i + 1) % 3], at(c, corner));
        if (turns[i] < 0)
            return 0;
        sides += turns[i] == 0;
    }
    if (sides == 0 || (sides == 1 && strictness == ALL))
        return 1;
    return enters(c, triangle, turns, c->before[corner]) ||
           enters(c, triangle, turns, c->after[corner]);
}

static int is_ear(clipper *c, uint32_t corner, strictness strictness)
{
    const uint32_t own[3] = {c->before[corner], corner, c->after[corner]};
    rt_box box = rt_box_empty;
    double triangle[3][2];
    rt_box_search search;
    size_t leaf;
    if (c->kinds[corner] != CONVEX)
        return c->kinds[corner] == NEEDLE;
    for (int i = 0; i < 3; i++) {
        memcpy(triangle[i], at(c, own[i]), sizeof triangle[i]);
        rt_box_add(&box, triangle[i]);
    }
    rt_box_search_begin(&search, &c->tree, &box, (const double(*)[2])triangle);
    while ((leaf = rt_box_search_next(&search)) != SIZE_MAX)
        for (size_t i = leaf * RT_BOX_LEAF; i < rt_box_leaf_end(&c->tree, leaf); i++) {
            const uint32_t other = c->tree.order[i];
            if (is_obstacle(c, other) && other != own[0] && other != own[2] &&
                blocks(c, (const double(*)[2])triangle, other, strictness))
                return 0;
        }
    return 1;
}

static void clip(clipper *c, uint32_t corner)
{
    const uint32_t ends[2] = {c->before[corner], c->after[corner]};
    uint32_t *triangle = *c->triangles++;
    triangle[0] = ends[0];
    triangle[1] = corner;
    triangle[2] = ends[1];
    c->after[ends[0]] = ends[1];
    c->before[ends[1]] = ends[0];
    set_kind(c, corner, GONE);
    c->left--;
    for (int i = 0; i < 2; i++) {
        set_kind(c, ends[i], classify(c, ends[i]));
        push(c, ends[i]);
    }
}

static int may_go_on(clipper *c)
{
    return c->left > 3 && rt_outline_may_go_on(c->outline, &c->tree, c->steps);
}

/* Clips the ears that are waiting. */
static void clip_queue(clipper *c)
{
    while (c->queued > 0 && may_go_on(c)) {
        const uint32_t corner = c->queue[c->first];
        c->first = (c->first + 1) % c->outline->count;
        c->queued--;
        c->is_queued[corner] = 0;
        if (c->kinds[corner] != GONE && is_ear(c, corner, ALL))
            clip(c, corner);
    }
}

/* An ear among all corners, from one on; UINT32_MAX: there is none. */
static uint32_t find_ear(clipper *c, uint32_t from, strictness strictness)
{
    uint32_t corner = from;
    for (size_t i = 0; i < c->left && may_go_on(c); i++, corner = c->after[corner], c->tree.steps++)
        if (is_ear(c, corner, strictness))
            return corner;
    return UINT32_MAX;
}

static uint32_t find_kind(clipper *c, uint32_t from, corner_kind kind)
{
    uint32_t corner = from;
    for (size_t i = 0; i < c->left && may_go_on(c); i++, corner = c->after[corner], c->tree.steps++)
        if (c->kinds[corner] == kind)
            return corner;
    return UINT32_MAX;
}

/*
 * The next corner to clip where no ear waits. A straight corner spans no area. Only a polygon that
 * crosses itself has none of all these.
 */
static uint32_t find_next(clipper *c, rt_polygon *found, uint32_t from)
{
    uint32_t corner = find_ear(c, from, ALL);
    if (corner == UINT32_MAX)
        corner = find_ear(c, from, ENTERING);
    if (corner == UINT32_MAX)
        corner = find_kind(c, from, STRAIGHT);
    if (corner != UINT32_MAX)
        return corner;
    if (*found == RT_POLYGON_SIMPLE)
        *found = may_go_on(c) ? RT_POLYGON_CROSSING : RT_POLYGON_TOO_INVOLVED;
    corner = find_kind(c, from, CONVEX);
    return corner != UINT32_MAX ? corner : from;
}

/* Clips all; what is left when the steps are used up becomes a fan. */
static void clip_all(clipper *c, rt_polygon *found)
{
    uint32_t last = 0;
    c->steps = *found == RT_POLYGON_SIMPLE ? RT_OUTLINE_STEPS : RT_OUTLINE_FEWER_STEPS;
    for (uint32_t i = 0; i < c->outline->count; i++)
        push(c, i);
    while (c->left > 3) {
        clip_queue(c);
        while (c->kinds[last] == GONE)
            last = c->after[last];
        if (may_go_on(c))
            clip(c, find_next(c, found, last));
        else if (c->left > 3 && *found == RT_POLYGON_SIMPLE)
            *found = RT_POLYGON_TOO_INVOLVED;
        while (c->left > 3 && !may_go_on(c))
            clip(c, c->after[last]);
    }
    while (c->kinds[last] == GONE)
        last = c->after[last];
    clip(c, last);
}

static rt_status make(clipper *c)
{
    const size_t count = c->outline->count;
    rt_status status = rt_box_tree_make(&c->tree, c->outline->points, count, c->outline->source);
    if (status == RT_OK) /* all in one block */
        status = rt_mesh_resize(c->outline->source, (void **)&c->before, count,
                                3 * sizeof *c->before + 2 * sizeof *c->kinds);
    if (status != RT_OK)
        return status;
    c->after = c->before + count;
    c->queue = c->after + count;
    c->kinds = (uint8_t *)(c->queue + count);
    c->is_queued = c->kinds + count;
    memset(c->is_queued, 0, count);
    for (uint32_t i = 0; i < count; i++) {
        c->before[i] = i > 0 ? i - 1 : (uint32_t)count - 1;
        c->after[i] = i + 1 < count ? i + 1 : 0;
    }
    for (uint32_t i = 0; i < count; i++)
        c->kinds[i] = (uint8_t)classify(c, i);
    for (size_t leaf = 0; leaf * RT_BOX_LEAF < count; leaf++)
        set_leaf(c, leaf);
    rt_box_tree_join(&c->tree);
    return RT_OK;
}

rt_status rt_outline_cut(uint32_t (*triangles)[3], rt_polygon *found, const rt_outline *outline)
{
    clipper c = {.outline = outline, .left = outline->count, .triangles = triangles};
    rt_status status = make(&c);
    if (status == RT_OK) {
        clip_all(&c, found);
        status = outline->source->progress->cancelled ? RT_CANCELLED : RT_OK;
    }
    rt_box_tree_free(&c.tree);
    rt_memory_free(c.before);
    return status;
}
