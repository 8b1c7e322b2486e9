/* split.c - bins, their costs, and the choice among them. */
#include "accel/split.h"

#include "accel/partition.h"
#include "base/parallel.h"
#include "types.h"

enum { BINS = 32, JOBS = 16 };

typedef struct bins {
    box4 box[3][BINS];
    uint32_t count[3][BINS];
} bins;

/* How a set's centres map to bins. */
typedef struct binning {
    vec4 origin, scale, limit;
    int bins;
} binning;

typedef struct set_job {
    const rt_set *set;
    const binning *map;
    rt_set *parts; /* [JOBS], or NULL */
    bins *bins;    /* [JOBS], or NULL */
} set_job;

static rt_set part_of(const rt_set *set, uint32_t index)
{
    const uint64_t all = set->count;
    const uint32_t first = (uint32_t)(all * index / JOBS),
                   end = (uint32_t)(all * (index + 1) / JOBS);
    rt_set part = *set;
    part.refs += first;
    part.count = end - first;
    return part;
}

static void measure(rt_set *set)
{
    box4 box = box4_empty(), centres = box4_empty();
    for (uint32_t i = 0; i < set->count; i++) {
        const vec4 centre = rt_ref_centre(&set->refs[i]);
        box = box4_join(box, rt_ref_box(&set->refs[i]));
        centres.lo = vec4_min(centres.lo, centre);
        centres.hi = vec4_max(centres.hi, centre);
    }
    set->box = box;
    set->centres = centres;
}

static void measure_part(void *user, uint32_t index)
{
    const set_job *job = user;
    job->parts[index] = part_of(job->set, index);
    measure(&job->parts[index]);
}

rt_set rt_set_make(rt_ref *refs, uint32_t count, uint32_t threads)
{
    rt_set set = {refs, count, box4_empty(), box4_empty()};
    if (threads <= 1) {
        measure(&set);
        return set;
    }
    rt_set parts[JOBS];
    set_job job = {&set, NULL, parts, NULL};
    rt_parallel(threads, JOBS, measure_part, &job);
    for (int i = 0; i < JOBS; i++) {
        set.box = box4_join(set.box, parts[i].box);
        set.centres = box4_join(set.centres, parts[i].centres);
    }
    return set;
}

/* Few references need few bins: their plane is then chosen among nearly all there are. */
static binning make_binning(const rt_set *set)
{
    binning map;
    map.bins = set->count <= 32 ? 8 : set->count <= 4096 ? 16 : BINS;
    map.origin = set->centres.lo;
    map.limit = vec4_all((float)(map.bins - 1));
    const vec4 extent = set->centres.hi - set->centres.lo;
    map.scale = vec4_all(0.0f);
    for (int a = 0; a < 3; a++)
        if (extent[a] > 1e-30f)
            map.scale[a] = (float)map.bins / extent[a];
    return map;
}

static inline void add_to_bin(bins *b, int axis, int bin, box4 box)
{
    box4 *into = &b->box[axis][bin];
    *into = box4_join(*into, box);
    b->count[axis][bin]++;
}

static void join_bins(bins *into, const bins *from, int count)
{
    for (int a = 0; a < 3; a++)
        for (int i = 0; i < count; i++) {
            into->box[a][i] = box4_join(into->box[a][i], from->box[a][i]);
            into->count[a][i] += from->count[a][i];
        }
}

/*
 * Fills b[0]; b[1] is for its own use. Neighbours mostly share a bin, so in long sets every second
 * one goes to b[1] until the end: none then waits for the one before it.
 */
static void fill_bins(bins b[2], const rt_set *set, const binning *map)
{
    const binning m = *map;
    const uint32_t alternate = set->count >= 256;
    for (uint32_t k = 0; k <= alternate; k++)
        for (int a = 0; a < 3; a++)
            for (int i = 0; i < m.bins; i++) {
                b[k].box[a][i] = box4_empty();
                b[k].count[a][i] = 0;
            }
    for (uint32_t i = 0; i < set->count; i++) {
        const box4 box = rt_ref_box(&set->refs[i]);
        const vec4 place = (rt_ref_centre(&set->refs[i]) - m.origin) * m.scale;
        const ivec4 bin = __builtin_convertvector(vec4_min(place, m.limit), ivec4);
        bins *into = &b[i & alternate];
        add_to_bin(into, 0, bin[0], box);
        add_to_bin(into, 1, bin[1], box);
        add_to_bin(into, 2, bin[2], box);
    }
    if (alternate)
        join_bins(&b[0], &b[1], m.bins);
}

static void fill_part(void *user, uint32_t index)
{
    const set_job *job = user;
    const rt_set part = part_of(job->set, index);
    bins b[2];
    fill_bins(b, &part, job->map);
    job->bins[index] = b[0];
}

static void fill_bins_parallel(bins *out, const rt_set *set, const binning *map, uint32_t threads)
{
    bins parts[JOBS];
    set_job job = {set, map, NULL, parts};
    rt_parallel(threads, JOBS, fill_part, &job);
    *out = parts[0];
    for (int p = 1; p < JOBS; p++)
        join_bins(out, &parts[p], map->bins);
}

static float side_cost(box4 box, uint32_t count)
{
    return box4_area(box) * (float)((count + RT_BVH_WIDTH - 1) / RT_BVH_WIDTH);
}

/*
 * The cheapest plane along one axis; returns its bin, or 0 when none has references on both sides.
 */
static int best_plane(const box4 *box, const uint32_t *count, int n, float *cost)
{
    float right_cost[BINS];
    box4 side = box4_empty();
    uint32_t in_side = 0;
    for (int i = n - 1; i > 0; i--) {
        side = box4_join(side, box[i]);
        in_side += count[i];
        right_cost[i] = in_side ? side_cost(side, in_side) : INFINITY;
    }
    int best = 0;
    side = box4_empty();
    in_side = 0;
    for (int i = 1; i < n; i++) {
        side = box4_join(side, box[i - 1]);
        in_side += count[i - 1];
        if (in_side == 0)
            continue;
        const float c = side_cost(side, in_side) + right_cost[i];
        if (c < *cost) {
            *cost = c;
            best = i;
        }
    }
    return best;
}

/* Joins the bins on either side of a plane: the boxes of the references there. */
static void join_sides(rt_set sides[2], const bins *b, const rt_plane_split *plane, int count)
{
    sides[0].box = sides[1].box = box4_empty();
    for (int i = 0; i < count; i++) {
        rt_set *side = sides + (i >= plane->bin);
        side->box = box4_join(side->box, b->box[plane->axis][i]);
    }
}

/* The sides are measured as they are found. */
static void split_at(rt_set sides[2], const rt_set *set, const bins *b, const rt_plane_split *plane,
                     int count, uint32_t threads, uint32_t *scratch)
{
    box4 centres[2];
    const uint32_t left = rt_partition(set->refs, set->count, plane, threads, scratch, centres);
    join_sides(sides, b, plane, count);
    sides[0].refs = set->refs;
    sides[0].count = left;
    sides[0].centres = centres[0];
    sides[1].refs = set->refs + left;
    sides[1].count = set->count - left;
    sides[1].centres = centres[1];
}

void rt_split_sah(rt_set sides[2], const rt_set *set, uint32_t threads, uint32_t *scratch)
{
    const binning map = make_binning(set);
    bins b[2];
    if (threads > 1)
        fill_bins_parallel(&b[0], set, &map, threads);
    else
        fill_bins(b, set, &map);

    rt_plane_split plane = {-1, 0.0f, 0.0f, (float)(map.bins - 1), 0};
    float cost = INFINITY;
    for (int a = 0; a < 3; a++) {
        const int bin = best_plane(b[0].box[a], b[0].count[a], map.bins, &cost);
        if (bin > 0) {
            plane.axis = a;
            plane.bin = bin;
        }
    }
    if (plane.axis < 0) {
        rt_split_median(sides, set, threads);
        return;
    }
    plane.origin = map.origin[plane.axis];
    plane.scale = map.scale[plane.axis];
    split_at(sides, set, &b[0], &plane, map.bins, threads, scratch);
}

static float centre_along(const rt_ref *ref, int axis)
{
    return ref->lo[axis] + ref->hi[axis];
}

static void swap_refs(rt_ref *a, rt_ref *b)
{
    const rt_ref t = *a;
    *a = *b;
    *b = t;
}

/* Hoare's selection: after it, no reference before `nth` has a larger centre than one behind. */
static void select_nth(rt_ref *refs, uint32_t count, uint32_t nth, int axis)
{
    int64_t lo = 0, hi = (int64_t)count - 1;
    while (lo < hi) {
        const float pivot = centre_along(&refs[lo + (hi - lo) / 2], axis);
        int64_t i = lo, j = hi;
        while (i <= j) {
            while (centre_along(&refs[i], axis) < pivot)
                i++;
            while (centre_along(&refs[j], axis) > pivot)
                j--;
            if (i <= j)
                swap_refs(&refs[i++], &refs[j--]);
        }
        if ((int64_t)nth <= j)
            hi = j;
        else if ((int64_t)nth >= i)
            lo = i;
        else
            return;
    }
}

void rt_split_median(rt_set sides[2], const rt_set *set, uint32_t threads)
{
    const vec4 extent = set->centres.hi - set->centres.lo;
    const int axis = extent[0] >= extent[1] ? (extent[0] >= extent[2] ? 0 : 2)
                                            : (extent[1] >= extent[2] ? 1 : 2);
    const uint32_t blocks = (set->count + RT_BVH_WIDTH - 1) / RT_BVH_WIDTH;
    const uint32_t left = blocks > 1 ? (blocks + 1) / 2 * RT_BVH_WIDTH : set->count / 2;
    select_nth(set->refs, set->count, left, axis);
    sides[0] = rt_set_make(set->refs, left, threads);
    sides[1] = rt_set_make(set->refs + left, set->count - left, threads);
}
