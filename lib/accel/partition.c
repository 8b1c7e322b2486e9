/*
 * partition.c - partitions references in place and in parallel; the order does not depend on
 * threads.
 *
 * First each chunk of fixed length is partitioned by itself. Then the left references that lie
 * behind the boundary are exchanged with the right ones that lie before it, both counted in order.
 */
#include "accel/partition.h"

#include <string.h>

#include "base/parallel.h"

enum { JOBS = 64, EXCHANGE_JOBS = 16 };

typedef struct partition_job {
    rt_ref *refs;
    uint32_t count;
    const rt_plane_split *plane;
    uint32_t *lefts; /* left references of each chunk */
    uint32_t chunks;
    uint32_t boundary;     /* all lefts */
    uint32_t misplaced;    /* references to exchange */
    box4 centres[JOBS][2]; /* that each job met on either side */
} partition_job;

static int is_left(const rt_ref *ref, const rt_plane_split *plane)
{
    const float x = (ref->lo[plane->axis] + ref->hi[plane->axis] - plane->origin) * plane->scale;
    return (int32_t)(x < plane->limit ? x : plane->limit) < plane->bin;
}

/* The lanes of a where the mask is set, else those of b. */
static vec4 choose(ivec4 mask, vec4 a, vec4 b)
{
    return (vec4)((mask & (ivec4)a) | (~mask & (ivec4)b));
}

/*
 * Keeps the order on both sides, and joins the centres of either to its box; free of branches that
 * could be mispredicted.
 */
static uint32_t partition_chunk(rt_ref *refs, uint32_t count, const rt_plane_split *plane,
                                box4 centres[2])
{
    const vec4 high = vec4_all(INFINITY), low = vec4_all(-INFINITY);
    rt_ref right[RT_PARTITION_CHUNK];
    box4 of_left = centres[0], of_right = centres[1];
    uint32_t lefts = 0, rights = 0;
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t left = (uint32_t)is_left(&refs[i], plane);
        const rt_ref ref = refs[i];
        const vec4 centre = rt_ref_centre(&ref);
        const int32_t side = -(int32_t)left;
        const ivec4 mask = {side, side, side, side};
        of_left.lo = vec4_min(of_left.lo, choose(mask, centre, high));
        of_left.hi = vec4_max(of_left.hi, choose(mask, centre, low));
        of_right.lo = vec4_min(of_right.lo, choose(mask, high, centre));
        of_right.hi = vec4_max(of_right.hi, choose(mask, low, centre));
        refs[lefts] = ref;
        right[rights] = ref;
        lefts += left;
        rights += 1 - left;
    }
    memcpy(refs + lefts, right, rights * sizeof *right);
    centres[0] = of_left;
    centres[1] = of_right;
    return lefts;
}

static void partition_chunks(void *user, uint32_t index)
{
    partition_job *job = user;
    const uint64_t all = job->chunks;
    const uint32_t first = (uint32_t)(all * index / JOBS),
                   end = (uint32_t)(all * (index + 1) / JOBS);
    box4 centres[2] = {box4_empty(), box4_empty()};
    for (uint32_t c = first; c < end; c++) {
        const uint32_t begin = c * RT_PARTITION_CHUNK;
        const uint32_t left = job->count - begin;
        const uint32_t length = left < RT_PARTITION_CHUNK ? left : RT_PARTITION_CHUNK;
        job->lefts[c] = partition_chunk(job->refs + begin, length, job->plane, centres);
    }
    memcpy(job->centres[index], centres, sizeof centres);
}

/* A run of references that lie on the wrong side. */
typedef struct run {
    uint32_t chunk, begin, end;
} run;

/* The part of the chunk's right side before the boundary, or of its left side behind it. */
static run misplaced_run(const partition_job *job, uint32_t chunk, int rights)
{
    const uint32_t begin = chunk * RT_PARTITION_CHUNK;
    const uint32_t end =
        job->count - begin < RT_PARTITION_CHUNK ? job->count : begin + RT_PARTITION_CHUNK;
    const uint32_t middle = begin + job->lefts[chunk];
    const uint32_t edge = job->boundary;
    run r = {chunk, 0, 0};
    if (rights) {
        r.begin = middle;
        r.end = end < edge ? end : edge;
    } else {
        r.begin = begin > edge ? begin : edge;
        r.end = middle;
    }
    if (r.end < r.begin)
        r.end = r.begin;
    return r;
}

/* Skips `skip` misplaced references from the start of run r on. */
static run skip_misplaced(const partition_job *job, run r, int rights, uint32_t skip)
{
    while (r.end - r.begin <= skip && r.chunk + 1 < job->chunks) {
        skip -= r.end - r.begin;
        r = misplaced_run(job, r.chunk + 1, rights);
    }
    r.begin += skip;
    return r;
}

/* Exchanges one part of the misplaced pairs. */
static void exchange(void *user, uint32_t index)
{
    const partition_job *job = user;
    const uint64_t all = job->misplaced;
    const uint32_t first = (uint32_t)(all * index / EXCHANGE_JOBS);
    uint32_t left = (uint32_t)(all * (index + 1) / EXCHANGE_JOBS) - first;
    if (left == 0)
        return;
    run a = skip_misplaced(job, misplaced_run(job, 0, 1), 1, first);
    run b = skip_misplaced(job, misplaced_run(job, 0, 0), 0, first);
    while (left) {
        const uint32_t in_a = a.end - a.begin, in_b = b.end - b.begin;
        uint32_t n = in_a < in_b ? in_a : in_b;
        n = n < left ? n : left;
        for (uint32_t i = 0; i < n; i++) {
            const rt_ref swapped = job->refs[a.begin + i];
            job->refs[a.begin + i] = job->refs[b.begin + i];
            job->refs[b.begin + i] = swapped;
        }
        left -= n;
        if (left) {
            a = skip_misplaced(job, a, 1, n);
            b = skip_misplaced(job, b, 0, n);
        }
    }
}

uint32_t rt_partition(rt_ref *refs, uint32_t count, const rt_plane_split *plane, uint32_t threads,
                      uint32_t *scratch, box4 centres[2])
{
    const uint32_t chunks = (count + RT_PARTITION_CHUNK - 1) / RT_PARTITION_CHUNK;
    centres[0] = centres[1] = box4_empty();
    if (chunks <= 1)
        return partition_chunk(refs, count, plane, centres);

    partition_job job = {
        .refs = refs, .count = count, .plane = plane, .lefts = scratch, .chunks = chunks};
    rt_parallel(threads, JOBS, partition_chunks, &job);
    for (uint32_t i = 0; i < 2 * JOBS; i++)
        centres[i % 2] = box4_join(centres[i % 2], job.centres[i / 2][i % 2]);
    for (uint32_t c = 0; c < job.chunks; c++)
        job.boundary += job.lefts[c];
    for (uint32_t c = 0; c < job.chunks; c++) {
        const run r = misplaced_run(&job, c, 1);
        job.misplaced += r.end - r.begin;
    }
    rt_parallel(threads, EXCHANGE_JOBS, exchange, &job);
    return job.boundary;
}
