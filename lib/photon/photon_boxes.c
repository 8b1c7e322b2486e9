/* photon_boxes.c - boxes of photons along a curve, in two levels, and the bounds that they give. */
#include "photon/photon_boxes.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "photon/point_order.h"
#include "types.h"

enum { BOX_PHOTONS = 16 }; /* of a box of the lower level */

/* Far more than the rounding of a squared distance, or of a cosine, in single precision. */
static const float margin = 1e-4f;

/* Around the positions and the normals of `count` photons. */
typedef struct photon_box {
    float lo[3], hi[3], normal_lo[3], normal_hi[3];
    size_t count;
} photon_box;

struct rt_photon_boxes {
    photon_box *boxes, *groups; /* a group is `width` boxes, the last one may be fewer */
    size_t box_count, group_count, width, reach;
};

/* ---- Building ---------------------------------------------------------------- */

static void grow(float lo[3], float hi[3], const float from[3], const float to[3])
{
    for (int c = 0; c < 3; c++) {
        lo[c] = fminf(lo[c], from[c]);
        hi[c] = fmaxf(hi[c], to[c]);
    }
}

static photon_box empty_box(void)
{
    photon_box box;
    for (int c = 0; c < 3; c++) {
        box.lo[c] = box.normal_lo[c] = HUGE_VALF;
        box.hi[c] = box.normal_hi[c] = -HUGE_VALF;
    }
    box.count = 0;
    return box;
}

static void add_box(photon_box *box, const photon_box *other)
{
    grow(box->lo, box->hi, other->lo, other->hi);
    grow(box->normal_lo, box->normal_hi, other->normal_lo, other->normal_hi);
    box->count += other->count;
}

/* order [map->count]: the photons along the curve. */
static void fill(rt_photon_boxes *b, const rt_photon_list *map, const uint64_t *order)
{
    for (size_t i = 0; i < b->box_count; i++)
        b->boxes[i] = empty_box();
    for (size_t i = 0; i < map->count; i++) {
        const rt_photon *photon = map->photons + (order[i] & RT_POINT_ORDER_INDEX);
        photon_box *box = b->boxes + i / BOX_PHOTONS;
        grow(box->lo, box->hi, photon->position, photon->position);
        grow(box->normal_lo, box->normal_hi, photon->normal, photon->normal);
        box->count++;
    }
    for (size_t i = 0; i < b->group_count; i++)
        b->groups[i] = empty_box();
    for (size_t i = 0; i < b->box_count; i++)
        add_box(b->groups + i / b->width, b->boxes + i);
}

rt_status rt_photon_boxes_create(rt_photon_boxes **out, const rt_photon_list *map, size_t reach,
                                 uint32_t threads, rt_memory *memory, rt_error *error)
{
    static const char what[] = "the search of the photon map";
    rt_photon_boxes *b = rt_memory_zeroed(NULL, 1, sizeof *b, what, error);
    uint64_t *order =
        b ? rt_memory_alloc(memory, map->count, 2 * sizeof *order, what, error) : NULL;
    rt_status status = RT_OK;

    if (order) {
        b->reach = reach;
        b->width = (reach + BOX_PHOTONS - 1) / BOX_PHOTONS;
        b->box_count = (map->count + BOX_PHOTONS - 1) / BOX_PHOTONS;
        b->group_count = (b->box_count + b->width - 1) / b->width;
        b->boxes = rt_memory_alloc(memory, b->box_count, sizeof *b->boxes, what, error);
        if (b->boxes)
            b->groups = rt_memory_alloc(memory, b->group_count, sizeof *b->groups, what, error);
    }
    if (!order || !b->groups)
        status = RT_ERROR_MEMORY;
    if (status == RT_OK && map->count > 0)
        status = rt_point_order(order, order + map->count, map->photons[0].position,
                                sizeof *map->photons, map->count, threads, error);
    if (status == RT_OK)
        fill(b, map, order);
    rt_memory_free(order);
    if (status == RT_OK)
        *out = b;
    else
        rt_photon_boxes_destroy(b);
    return status;
}

void rt_photon_boxes_destroy(rt_photon_boxes *boxes)
{
    if (!boxes)
        return;
    rt_memory_free(boxes->boxes);
    rt_memory_free(boxes->groups);
    rt_memory_free(boxes);
}

/* ---- Bounds ------------------------------------------------------------------ */

/* The least and the greatest squared distance from a point to a box. */
static float least_distance(const photon_box *box, const float p[3])
{
    float sum = 0;
    for (int c = 0; c < 3; c++) {
        const float d = fmaxf(fmaxf(box->lo[c] - p[c], p[c] - box->hi[c]), 0);
        sum += d * d;
    }
    return sum * (1 - margin);
}

static float greatest_distance(const photon_box *box, const float p[3])
{
    float sum = 0;
    for (int c = 0; c < 3; c++) {
        const float d = fmaxf(p[c] - box->lo[c], box->hi[c] - p[c]);
        sum += d * d;
    }
    return sum * (1 + margin);
}

/* Whether a photon of the box may be accepted by its normal. */
static int may_fit(const photon_box *box, const float normal[3])
{
    float cosine = 0;
    for (int c = 0; c < 3; c++)
        cosine += fmaxf(normal[c] * box->normal_lo[c], normal[c] * box->normal_hi[c]);
    return cosine > RT_PHOTON_NORMAL_COSINE - margin;
}

int rt_photon_boxes_none(const rt_photon_boxes *b, const float position[3], const float normal[3],
                         float squared_limit)
{
    float bound = squared_limit;
    for (size_t i = 0; i < b->group_count; i++)
        if (b->groups[i].count >= b->reach)
            bound = fminf(bound, greatest_distance(b->groups + i, position));
    for (size_t i = 0; i < b->group_count; i++) {
        if (!may_fit(b->groups + i, normal) || !(least_distance(b->groups + i, position) <= bound))
            continue;
        size_t end = (i + 1) * b->width < b->box_count ? (i + 1) * b->width : b->box_count;
        for (size_t j = i * b->width; j < end; j++)
            if (may_fit(b->boxes + j, normal) && least_distance(b->boxes + j, position) <= bound)
                return 0;
    }
    return 1;
}
