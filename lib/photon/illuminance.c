/*
 * illuminance.c - irradiance and fluence rate at points, with their standard error, from the
 * photons of a map.
 *
 * At a point on a surface, the flux of the photons within a disc over its area; in a medium, that
 * of the volume photons within a sphere over its volume. The k-th nearest photon gives the radius
 * and does not count. The paths of a list, in their order, are cut into batches of equal numbers,
 * which are independent estimates: the standard error of their mean is by their scatter.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/parallel.h"
#include "photon/photon_map.h"
#include "scene/check.h"
#include "setting/options.h"
#include "types.h"

enum { BATCHES = 16, CHANNELS = 4, JOBS = 64 }; /* red, green, blue, and the luminance of them */

static const double pi = 3.14159265358979323846;

/* A list of photons, and how it is searched. */
typedef struct source {
    const rt_photon_list *list;
    const rt_path_ranges *ranges;
    uint32_t k;    /* RT_K_ALL: all within the radius */
    double radius; /* m; 0: no limit */
    int in_media;
} source;

/* The sums of flux by batches. */
typedef struct tally {
    double sums[BATCHES][CHANNELS];
    double radius;
    double nearest2; /* the squared distance of the nearest */
    size_t count;
} tally;

typedef struct reading {
    rt_photon_reading *out;
    const float *positions, *normals; /* [count][3] */
    const source *sources;            /* [RT_PHOTON_KINDS] */
    size_t count;
    double *nearest; /* [JOBS][most], scratch memory */
    size_t most;
} reading;

/* The squared distance of a photon that counts at the point; infinite for another. */
static double squared_distance(const rt_photon *photon, const float position[3],
                               const float normal[3])
{
    double sum = 0, cosine = 0;
    for (int c = 0; c < 3; c++) {
        const double d = (double)photon->position[c] - position[c];
        sum += d * d;
        cosine += normal ? (double)photon->normal[c] * normal[c] : 1;
    }
    return cosine > RT_PHOTON_NORMAL_COSINE ? sum : HUGE_VAL;
}

/* Puts a distance in the place of the greatest of a heap, which it is less than. */
static void replace_greatest(double *heap, size_t count, double value)
{
    size_t at = 0;
    for (size_t child = 1; child < count; child = 2 * at + 1) {
        child += child + 1 < count && heap[child + 1] > heap[child];
        if (heap[child] <= value)
            break;
        heap[at] = heap[child];
        at = child;
    }
    heap[at] = value;
}

/* The squared radius of the photons that count at a point, which are nearer. */
static double find_radius(const source *s, double *heap, const float position[3],
                          const float normal[3])
{
    const double limit = s->radius > 0 ? s->radius * s->radius : HUGE_VAL;
    if (s->k == RT_K_ALL)
        return limit;
    double farthest = 0;
    for (uint32_t i = 0; i < s->k; i++)
        heap[i] = HUGE_VAL;
    for (size_t i = 0; i < s->list->count; i++) {
        const double d2 = squared_distance(s->list->photons + i, position, normal);
        if (d2 < heap[0])
            replace_greatest(heap, s->k, d2);
        farthest = d2 < HUGE_VAL && d2 > farthest ? d2 : farthest;
    }
    /* Of fewer than k without a limit, the last one gives the radius. */
    const double found = heap[0] < HUGE_VAL || s->radius > 0 ? heap[0] : farthest;
    return found < limit ? found : limit;
}

/* The first path of a batch, of so many paths. */
static uint64_t batch_start(uint64_t batch, uint64_t paths)
{
    return paths / BATCHES * batch + (paths % BATCHES * batch + BATCHES - 1) / BATCHES;
}

static size_t batch_of(uint64_t path, uint64_t paths)
{
    size_t batch = (size_t)((double)path / (double)paths * BATCHES);
    batch = batch < BATCHES ? batch : BATCHES - 1;
    while (batch > 0 && path < batch_start(batch, paths))
        batch--;
    while (batch + 1 < BATCHES && path >= batch_start(batch + 1, paths))
        batch++;
    return batch;
}

/* Sums the photons within a squared radius. */
static void add_up(tally *t, const source *s, double r2, const float position[3],
                   const float normal[3])
{
    const rt_photon *photon = s->list->photons;
    uint64_t before = 0;
    for (size_t i = 0; i < s->ranges->count; i++) {
        const rt_path_range *range = s->ranges->ranges + i;
        for (uint64_t j = 0; j < range->photons; j++, photon++) {
            const double d2 = squared_distance(photon, position, normal);
            if (!(d2 < r2))
                continue;
            t->nearest2 = t->count == 0 || d2 < t->nearest2 ? d2 : t->nearest2;
            double *sums =
                t->sums[batch_of(before + (photon->path - range->first), s->list->emitted)];
            for (int c = 0; c < 3; c++)
                sums[c] += photon->flux[c];
            sums[3] +=
                0.2126 * photon->flux[0] + 0.7152 * photon->flux[1] + 0.0722 * photon->flux[2];
            t->count++;
        }
        before += range->count;
    }
}

/* Estimates a list at a point: adds its mean, and the square of its standard error. */
static tally estimate(const source *s, double *heap, const float position[3], const float normal[3],
                      double mean[CHANNELS], double variance[CHANNELS])
{
    tally t = {{{0}}, 0, 0, 0};
    if (s->list->count == 0)
        return t;
    const double r2 = find_radius(s, heap, position, normal);
    const double inside = s->in_media ? 4 / 3.0 * pi * r2 * sqrt(r2) : pi * r2;
    t.radius = sqrt(r2);
    if (!(r2 > 0) || !(r2 < HUGE_VAL))
        return t;
    add_up(&t, s, r2, position, normal);
    for (int c = 0; c < CHANNELS; c++) {
        double sum = 0;
        for (int b = 0; b < BATCHES; b++)
            sum += t.sums[b][c];
        const double all = sum / (inside * (double)s->list->emitted);
        mean[c] += all;
        for (uint64_t b = 0; b < BATCHES; b++) {
            const uint64_t paths =
                batch_start(b + 1, s->list->emitted) - batch_start(b, s->list->emitted);
            const double one = paths ? t.sums[b][c] / (inside * (double)paths) : all;
            variance[c] += (one - all) * (one - all) / (BATCHES * (BATCHES - 1));
        }
    }
    return t;
}

static void read_point(const reading *r, size_t i, double *heap)
{
    const float *position = r->positions + 3 * i, *normal = r->normals + 3 * i;
    const int on_surface = normal[0] != 0 || normal[1] != 0 || normal[2] != 0;
    double mean[CHANNELS] = {0}, variance[CHANNELS] = {0}, fluence[CHANNELS] = {0},
           of_fluence[CHANNELS] = {0};
    rt_photon_reading *out = r->out + i;
    memset(out, 0, sizeof *out);
    for (int kind = 0; kind < RT_PHOTONS_VOLUME && on_surface; kind++) {
        const tally t = estimate(r->sources + kind, heap, position, normal, mean, variance);
        if (t.count > 0 && (out->photons == 0 || sqrt(t.nearest2) < out->nearest))
            out->nearest = sqrt(t.nearest2);
        out->photons += t.count;
        out->radius = fmax(out->radius, t.radius);
    }
    const tally t =
        estimate(r->sources + RT_PHOTONS_VOLUME, heap, position, NULL, fluence, of_fluence);
    out->volume_photons = t.count;
    out->volume_radius = t.radius;
    out->volume_nearest = t.count > 0 ? sqrt(t.nearest2) : 0;
    for (int c = 0; c < 3; c++) {
        out->irradiance[c] = mean[c];
        out->irradiance_error[c] = sqrt(variance[c]);
        out->fluence[c] = fluence[c];
        out->fluence_error[c] = sqrt(of_fluence[c]);
    }
    out->illuminance = RT_LUMENS_PER_WATT * mean[3];
    out->illuminance_error = RT_LUMENS_PER_WATT * sqrt(variance[3]);
}

/* Every JOBS-th point. */
static void read_share(void *user, uint32_t job)
{
    const reading *r = user;
    for (size_t i = job; i < r->count; i += JOBS)
        read_point(r, i, r->nearest + job * r->most);
}

static rt_status check(const rt_render_options *o, const float *positions, const float *normals,
                       size_t count, rt_error *error)
{
    const char *lacking = o->k == RT_K_ALL && o->radius == 0                   ? "radius"
                          : o->caustic_k == RT_K_ALL && o->caustic_radius == 0 ? "caustic_radius"
                          : o->volume_k == RT_K_ALL && o->volume_radius == 0   ? "volume_radius"
                                                                               : NULL;
    if (lacking)
        return rt_fail_field(error, RT_ERROR_USAGE, lacking,
                             "to count all photons within a radius, give the radius");
    for (size_t i = 0; i < count; i++) {
        const float *n = normals + 3 * i;
        for (int c = 0; c < 3; c++)
            if (!(fabsf(positions[3 * i + (size_t)c]) <= RT_COORDINATE_MAX))
                return rt_fail_field(error, RT_ERROR_USAGE, "positions",
                                     "point %zu has the coordinate %g; it must lie within %g", i,
                                     positions[3 * i + (size_t)c], RT_COORDINATE_MAX);
        if (!rt_is_unit(n) && (n[0] != 0 || n[1] != 0 || n[2] != 0))
            return rt_fail_field(error, RT_ERROR_USAGE, "normals",
                                 "the normal (%g, %g, %g) of point %zu is not of unit length", n[0],
                                 n[1], n[2], i);
    }
    return RT_OK;
}

rt_status rt_photon_map_illuminance(rt_photon_reading *out, const rt_photon_map *map,
                                    const float *positions, const float *normals, size_t count,
                                    uint32_t threads, const rt_render_options *options,
                                    rt_error *error)
{
    static const rt_render_options defaults;
    rt_render_options o = options ? *options : defaults;
    if (rt_is_missing(map, "map", error))
        return RT_ERROR_USAGE;
    rt_status status = rt_options_check(&o, error);
    rt_options_complete(&o);
    if (status == RT_OK)
        status = check(&o, positions, normals, count, error);
    if (status != RT_OK || count == 0)
        return status;
    const uint32_t k[RT_PHOTON_KINDS] = {o.k, o.caustic_k, o.volume_k};
    const float radius[RT_PHOTON_KINDS] = {o.radius, o.caustic_radius, o.volume_radius};
    source sources[RT_PHOTON_KINDS];
    reading r = {
        .out = out, .positions = positions, .normals = normals, .sources = sources, .count = count};
    for (int kind = 0; kind < RT_PHOTON_KINDS; kind++) {
        sources[kind] = (source){map->lists + kind, map->ranges + kind, k[kind], radius[kind],
                                 kind == RT_PHOTONS_VOLUME};
        if (k[kind] != RT_K_ALL && k[kind] > r.most)
            r.most = k[kind];
    }
    r.nearest = rt_memory_alloc(map->lists->memory, r.most + 1, JOBS * sizeof *r.nearest,
                                "the nearest photons", error);
    if (!r.nearest)
        return RT_ERROR_MEMORY;
    rt_parallel(threads, JOBS, read_share, &r);
    rt_memory_free(r.nearest);
    return RT_OK;
}
