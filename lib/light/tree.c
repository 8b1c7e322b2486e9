/*
 * tree.c - builds the tree of lights.
 *
 * Lights are halved at the median along the axis in which they lie farthest apart, again and again,
 * so all levels are full and the parent of node i is i / 2. Those from infinitely far have the
 * root's second half to themselves.
 */
#include "light/tree.h"

#include <float.h>
#include <math.h>

#include "base/memory.h"
#include "light/lights.h"
#include "scene/shape_class.h"

/*
 * What is added to the squared distance of a cluster for its extent, as a fraction of the squared
 * radius of its bounding sphere. For a disc the mean squared distance calls for 0.5, but the
 * nearest lights contribute most: 0.1 to 0.3 gave the least noise, 1 twice that.
 */
static const double extent_factor = 0.3;

static const double pi = 3.14159265358979323846;

/* A light and the centre of its bounds. */
typedef struct light_centre {
    double at[3];
    rt_u32 light;
} light_centre;

/* The lights of a node. */
typedef struct cluster {
    double lo[3], hi[3]; /* lo > hi: empty */
    double weight;
    int is_distant;
} cluster;

typedef struct tree_builder {
    rt_light_node *nodes;
    const rt_scene *scene;
    const rt_scene_header *header;
    const rt_light_data *lights;
    const rt_u32 *prim_shape;
    size_t leaves;
    double environment_share, total_weight, least_radius;
} tree_builder;

/* Whether what arrives does not fall with the distance: as of light from infinitely far. */
static int is_distant(rt_u32 kind)
{
    return kind == RT_LIGHT_DIRECTIONAL || kind == RT_LIGHT_BEAM || kind == RT_LIGHT_ENVIRONMENT;
}

static size_t power_of_two(size_t least)
{
    size_t power = 1;
    while (power < least)
        power *= 2;
    return power;
}

size_t rt_light_tree_leaves(const rt_scene *scene)
{
    size_t count = rt_lights_count(scene), distant = 0;
    for (size_t i = 0; i < scene->light_count; i++)
        distant += is_distant(scene->lights[i].kind);
    if (distant == 0 || distant == count)
        return power_of_two(count);
    return 2 * power_of_two(distant > count - distant ? distant : count - distant);
}

/* ---- Clusters -------------------------------------------------------------- */

static cluster empty(void)
{
    return (cluster){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}, 0, 0};
}

static void include(cluster *c, const double p[3], double reach)
{
    for (int i = 0; i < 3; i++) {
        c->lo[i] = fmin(c->lo[i], p[i] - reach);
        c->hi[i] = fmax(c->hi[i], p[i] + reach);
    }
}

static void join(cluster *c, const cluster *other)
{
    for (int i = 0; i < 3; i++) {
        c->lo[i] = fmin(c->lo[i], other->lo[i]);
        c->hi[i] = fmax(c->hi[i], other->hi[i]);
    }
    c->weight += other->weight;
}

/* The corners of a quad or triangle. */
static void include_edges(cluster *c, const rt_light_data *light)
{
    for (int corner = 0; corner < (light->kind == RT_LIGHT_QUAD ? 4 : 3); corner++) {
        double p[3];
        for (int i = 0; i < 3; i++)
            p[i] = (double)light->a[i] + (corner & 1 ? (double)light->width * light->b[i] : 0) +
                   (corner & 2 ? (double)light->height * light->c[i] : 0);
        include(c, p, 0);
    }
}

/* Widens the bounds by those of a light; light from infinitely far is put in the scene's middle. */
static void include_light(cluster *c, const tree_builder *p, const rt_light_data *light)
{
    const rt_scene_header *h = p->header;
    const double a[3] = {light->a[0], light->a[1], light->a[2]};
    switch ((rt_light_kind)light->kind) {
    case RT_LIGHT_QUAD:
    case RT_LIGHT_TRIANGLE:
        include_edges(c, light);
        break;
    case RT_LIGHT_SPHERE:
        include(c, a, light->width);
        break;
    case RT_LIGHT_SHAPE: {
        const rt_scene_shape *shape = p->scene->shapes + p->prim_shape[light->prim];
        for (int i = 0; i < 3; i++) {
            c->lo[i] = shape->lo[i];
            c->hi[i] = shape->hi[i];
        }
        break;
    }
    case RT_LIGHT_POINT:
    case RT_LIGHT_SPOT:
    case RT_LIGHT_TABLE:
        include(c, a, 0);
        break;
    case RT_LIGHT_DIRECTIONAL:
    case RT_LIGHT_BEAM:
    case RT_LIGHT_ENVIRONMENT:
        for (int i = 0; i < 3; i++)
            c->lo[i] = c->hi[i] =
                h->radius > 0 ? 0.5 * ((double)h->bounds_lo[i] + h->bounds_hi[i]) : 0;
        break;
    }
}

/* Whether it emits on one side of a plane, or on both. */
static int is_flat(const tree_builder *p, const rt_light_data *light)
{
    if (light->kind == RT_LIGHT_QUAD || light->kind == RT_LIGHT_TRIANGLE)
        return 1;
    const rt_scene_shape *shape = p->scene->shapes + p->prim_shape[light->prim];
    return rt_shape_class_of(shape->kind)->boundary(p->scene, shape) == RT_BOUNDARY_FLAT;
}

/* The largest factor of a spot's or table's emission, mean of the channels. */
static double peak_of(const tree_builder *p, const rt_light_data *light)
{
    const rt_scene_light *from = p->scene->lights + (light - p->lights);
    return from->table ? p->scene->light_tables[from->table - 1].peak : 1;
}

/* The power of directional light of the same irradiance, W. */
static double irradiance_everywhere(const tree_builder *p, const rt_light_data *light)
{
    const double radius = p->header->radius > 0 ? p->header->radius : 1;
    return light->power / light->area * pi * radius * radius;
}

/*
 * What a light is chosen by, W: pi times the greatest irradiance at some distance times the square
 * of that distance. For a flat light this is its power, that of one side; a light of the same power
 * that emits in all directions gives a quarter of that irradiance. By power alone an environment
 * would be chosen four times too often in front of an area light. Of a beam only the points within
 * see anything: by the root of their part of all points the variance is least.
 */
static double weight_of(const tree_builder *p, const rt_light_data *light)
{
    const double sides = light->flags & RT_LIGHT_TWO_SIDED ? 2 : 1;
    const float *e = light->emission;
    if (!(light->power > 0))
        return 0;
    switch ((rt_light_kind)light->kind) {
    case RT_LIGHT_DIRECTIONAL:
        return light->power;
    case RT_LIGHT_BEAM:
        return sqrt(light->power * irradiance_everywhere(p, light));
    case RT_LIGHT_SPOT:
    case RT_LIGHT_TABLE:
        return pi / 3 * ((double)e[0] + e[1] + e[2]) * peak_of(p, light);
    case RT_LIGHT_POINT:
        return 0.25 * light->power;
    case RT_LIGHT_ENVIRONMENT:
        return 0.25 * light->power * p->environment_share;
    case RT_LIGHT_QUAD:
    case RT_LIGHT_TRIANGLE:
    case RT_LIGHT_SPHERE:
    case RT_LIGHT_SHAPE:
        break;
    }
    return (is_flat(p, light) ? 1 : 0.25) * light->power / sides;
}

static cluster cluster_of(const tree_builder *p, rt_u32 index)
{
    const rt_light_data *light = p->lights + index;
    cluster c = empty();
    c.weight = weight_of(p, light) / p->total_weight;
    c.is_distant = is_distant(light->kind);
    include_light(&c, p, light);
    return c;
}

/* ---- Halves ---------------------------------------------------------------- */

static int is_before(const light_centre *a, const light_centre *b, int axis)
{
    return a->at[axis] != b->at[axis] ? a->at[axis] < b->at[axis] : a->light < b->light;
}

static void swap(light_centre *a, light_centre *b)
{
    light_centre kept = *a;
    *a = *b;
    *b = kept;
}

/*
 * Partitions the lights so that the `half` of them that come first along the axis are in front
 * (Hoare, "Find", CACM 4(7), 1961).
 */
static void select_first(light_centre *centres, size_t count, size_t half, int axis)
{
    while (count > 1) {
        /* not the last, so that both parts are smaller */
        const light_centre pivot = centres[(count - 1) / 2];
        size_t i = 0, j = count - 1;
        for (;; i++, j--) {
            while (is_before(centres + i, &pivot, axis))
                i++;
            while (is_before(&pivot, centres + j, axis))
                j--;
            if (i >= j)
                break;
            swap(centres + i, centres + j);
        }
        /* All before j + 1 come before all behind. */
        size_t first = j + 1;
        if (half < first) {
            count = first;
        } else {
            centres += first;
            count -= first;
            half -= first;
        }
    }
}

static int longest_axis(const light_centre *centres, size_t count)
{
    cluster c = empty();
    int axis = 0;
    for (size_t i = 0; i < count; i++)
        include(&c, centres[i].at, 0);
    for (int i = 1; i < 3; i++)
        if (c.hi[i] - c.lo[i] > c.hi[axis] - c.lo[axis])
            axis = i;
    return axis;
}

/* ---- Nodes ----------------------------------------------------------------- */

static void fill_node(const tree_builder *p, rt_light_node *node, const cluster *c)
{
    double radius = 0;
    for (int i = 0; i < 3 && c->lo[i] <= c->hi[i]; i++) {
        node->centre[i] = (float)(0.5 * (c->lo[i] + c->hi[i]));
        radius = hypot(radius, 0.5 * (c->hi[i] - c->lo[i]));
    }
    radius = fmax(radius, p->least_radius);
    node->falloff = c->is_distant ? 0 : 1;
    node->extent = (float)fmax(extent_factor * radius * radius, FLT_MIN);
    /* The power of distant lights was computed for a disc of the scene's radius. */
    if (c->is_distant)
        node->extent = p->header->radius > 0 ? p->header->radius * p->header->radius : 1;
    node->weight = (float)c->weight;
}

/* Fills a node and all below it with these lights, no more than there are leaves below. */
static cluster build_node(const tree_builder *p, size_t index, light_centre *centres, size_t count)
{
    cluster c = empty();
    if (index < p->leaves) {
        size_t half = (count + 1) / 2;
        if (count > 1)
            select_first(centres, count, half, longest_axis(centres, count));
        c = build_node(p, 2 * index, centres, half);
        cluster other = build_node(p, 2 * index + 1, centres + half, count - half);
        c.is_distant |= other.is_distant;
        join(&c, &other);
    } else if (count > 0) {
        c = cluster_of(p, centres->light);
        p->nodes[index].light = centres->light;
        p->nodes[centres->light].leaf = (rt_u32)index;
    }
    fill_node(p, p->nodes + index, &c);
    return c;
}

/* Lists the finite lights before the distant ones; returns the number of finite ones. */
static size_t list_centres(tree_builder *p, light_centre *centres, size_t count)
{
    size_t nearby = 0, distant = count;
    cluster all = empty();
    for (size_t i = 0; i < count; i++) {
        cluster c = cluster_of(p, (rt_u32)i);
        light_centre *s = centres + (c.is_distant ? --distant : nearby++);
        s->light = (rt_u32)i;
        for (int k = 0; k < 3; k++)
            s->at[k] = 0.5 * (c.lo[k] + c.hi[k]);
        if (!c.is_distant)
            join(&all, &c);
    }
    /* At the position of a point light, others must still have a chance to be chosen. */
    for (int k = 0; k < 3 && nearby > 0; k++)
        p->least_radius = fmax(p->least_radius, 0x1p-20 * (all.hi[k] - all.lo[k]));
    return nearby;
}

rt_status rt_light_tree_fill(rt_light_node *nodes, const rt_scene *scene,
                             const rt_scene_header *header, const rt_light_data *lights,
                             const rt_u32 *prim_shape, double environment_share, rt_memory *memory,
                             rt_error *error)
{
    tree_builder p = {.nodes = nodes,
                      .scene = scene,
                      .header = header,
                      .lights = lights,
                      .prim_shape = prim_shape,
                      .environment_share = environment_share};
    size_t count = rt_lights_count(scene);
    p.leaves = rt_light_tree_leaves(scene);
    for (size_t i = 0; i < count; i++)
        p.total_weight += weight_of(&p, lights + i);
    if (!(p.total_weight > 0))
        return RT_OK;
    light_centre *centres =
        rt_memory_alloc(memory, count, sizeof *centres, "the tree of lights", error);
    if (!centres)
        return RT_ERROR_MEMORY;
    size_t nearby = list_centres(&p, centres, count);
    if (nearby == 0 || nearby == count) {
        build_node(&p, 1, centres, count);
    } else {
        nodes[1].weight = 1;
        build_node(&p, 2, centres, nearby);
        build_node(&p, 3, centres + nearby, count - nearby);
    }
    rt_memory_free(centres);
    return RT_OK;
}
