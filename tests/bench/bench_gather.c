/*
 * bench_gather.c - nearest photons: the library's search on the host, and the gather on the device,
 * which both sort the queries along a curve and leave out the photons that face elsewhere, against
 * plain FLANN, in one run and in turn. The gather on the device takes the density sum as well.
 *
 *     bench_gather [PHOTONS [QUERIES [K]]]    1 000 000, 100 000 and 50 by default
 *
 * Photons lie at random on the walls of a box, queries at random on its floor. Prints thousand
 * queries a second on all cores, and the seconds in which the device's tree is built.
 */
#include <flann/flann.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/parallel.h"
#include "base/progress.h"
#include "bench/bench.h"
#include "lib/photon/points.h"
#include "photon/gather_tree.h"
#include "photon/point_order.h"
#include "photon/neighbour_search.h"

/* What all contestants are given. */
typedef struct problem {
    size_t photons, queries;
    uint32_t k, threads;
    rt_photon_list map;
    float *positions; /* [photons][3] */
    rt_gather_point *points;
    float *places;  /* [queries][3], theirs */
    int *indices;   /* [queries][k], results */
    float *squared; /* beside them */
    rt_gather_disc *discs;
} problem;

static void lay_photon(rt_photon *photon, points_stream *stream)
{
    int side = (int)(6 * points_uniform(stream)), axis = side / 2;
    photon->position[axis] = (float)(side % 2);
    photon->position[(axis + 1) % 3] = points_uniform(stream);
    photon->position[(axis + 2) % 3] = points_uniform(stream);
    photon->normal[axis] = side % 2 ? -1.0f : 1.0f;
}

static void pose(problem *p)
{
    points_stream stream = {1};
    p->map.photons = bench_allocate(p->photons, sizeof *p->map.photons);
    p->map.count = p->map.capacity = p->photons;
    p->positions = bench_allocate(p->photons, 3 * sizeof *p->positions);
    p->points = bench_allocate(p->queries, sizeof *p->points);
    p->places = bench_allocate(p->queries, 3 * sizeof *p->places);
    p->indices = bench_allocate(p->queries, p->k * sizeof *p->indices);
    p->squared = bench_allocate(p->queries, p->k * sizeof *p->squared);
    p->discs = bench_allocate(p->queries, sizeof *p->discs);
    for (size_t i = 0; i < p->photons; i++) {
        lay_photon(p->map.photons + i, &stream);
        memcpy(p->positions + 3 * i, p->map.photons[i].position, 3 * sizeof *p->positions);
    }
    for (size_t i = 0; i < p->queries; i++) {
        rt_gather_point *point = p->points + i;
        point->position[0] = points_uniform(&stream);
        point->position[2] = points_uniform(&stream);
        point->normal[1] = point->weight[0] = 1;
        memcpy(p->places + 3 * i, point->position, 3 * sizeof *p->places);
    }
}

static void discard(problem *p)
{
    rt_photon_list_clear(&p->map);
    free(p->positions);
    free(p->points);
    free(p->places);
    free(p->indices);
    free(p->squared);
    free(p->discs);
}

/* The gather on the device, with all that it needs. */
typedef struct device_side {
    rt_device *device;
    cl_kernel kernel;
    cl_mem points;
    rt_gather_point *in_order; /* [queries], along the curve */
    uint64_t *order;           /* [2][queries] */
    rt_tree_gather gather;
} device_side;

static void open_device(device_side *d, const problem *p)
{
    rt_density_params estimate = {
        RT_DENSITY_EPANECHNIKOV, 1.1f, 0, p->k, HUGE_VALF, 0, 0, 1, RT_AREA_DISC, 0, {0}};
    rt_error error;
    d->device = bench_device();
    bench_must(rt_device_kernel(d->device, &d->kernel, "gather_tree", "gather_tree", NULL, &error),
               &error);
    bench_must(rt_buffer_create(d->device, &d->points, CL_MEM_READ_WRITE,
                                p->queries * sizeof *p->points, NULL, "points", &error),
               &error);
    d->in_order = bench_allocate(p->queries, sizeof *d->in_order);
    d->order = bench_allocate(2 * p->queries, sizeof *d->order);
    double began = rt_clock();
    size_t capacity = p->queries;
    bench_must(rt_tree_gather_prepare(&d->gather, d->device, &p->map, &estimate, NULL, &capacity,
                                      NULL, &error),
               &error);
    if (capacity < p->queries) {
        fprintf(stderr, "no memory to gather at %zu points\n", p->queries);
        exit(1);
    }
    bench_figure("tree.ours", rt_clock() - began);
}

static void close_device(device_side *d)
{
    rt_tree_gather_release(&d->gather, d->device);
    rt_buffer_release(d->device, d->points);
    rt_kernel_release(d->kernel);
    free(d->in_order);
    free(d->order);
    rt_device_close(d->device);
}

enum { shares = 16 };

/* A share of the points, to be copied along the curve. */
typedef struct copying {
    const device_side *device;
    const problem *problem;
} copying;

static void copy_share(void *user, uint32_t share)
{
    const copying *c = user;
    const size_t count = c->problem->queries;
    for (size_t i = count * share / shares; i < count * (share + 1) / shares; i++)
        c->device->in_order[i] = c->problem->points[c->device->order[i] & RT_POINT_ORDER_INDEX];
}

/* From points as they come to their discs, sorting and copies included. */
static void gather_on_device(device_side *d, const problem *p)
{
    rt_error error;
    bench_must(rt_point_order(d->order, d->order + p->queries, p->points->position,
                              sizeof *p->points, p->queries, p->threads, &error),
               &error);
    copying copying = {d, p};
    rt_parallel(p->threads, shares, copy_share, &copying);
    bench_must(rt_buffer_write(d->device, d->points, 0, p->queries * sizeof *d->in_order,
                               d->in_order, &error),
               &error);
    bench_must(
        rt_tree_gather_launch(&d->gather, d->device, d->kernel, d->points, 0, p->queries, &error),
        &error);
    bench_must(rt_buffer_read(d->device, d->gather.discs, 0, p->queries * sizeof *p->discs,
                              p->discs, &error),
               &error);
}

static void compete(problem *p)
{
    struct FLANNParameters parameters = DEFAULT_FLANN_PARAMETERS;
    double plain[bench_turns], host[bench_turns], device[bench_turns];
    device_side d;
    rt_neighbour_search *search = NULL;
    rt_error error;
    float speedup;

    parameters.algorithm = FLANN_INDEX_KDTREE_SINGLE;
    parameters.checks = FLANN_CHECKS_UNLIMITED;
    parameters.eps = 0;
    parameters.sorted = 1;
    parameters.cores = (int)p->threads;
    parameters.leaf_max_size = 10;
    flann_index_t tree =
        flann_build_index_float(p->positions, (int)p->photons, 3, &speedup, &parameters);
    bench_must(
        rt_neighbour_search_create(&search, &p->map, p->k, HUGE_VALF, 0, p->threads, NULL, &error),
        &error);

    open_device(&d, p);
    gather_on_device(&d, p); /* the driver compiles at the first launch */

    for (int turn = 0; turn < bench_turns; turn++) {
        const double begin = rt_clock();
        flann_find_nearest_neighbors_index_float(tree, p->places, (int)p->queries, p->indices,
                                                 p->squared, (int)p->k, &parameters);
        const double flann_ended = rt_clock();
        bench_must(rt_neighbour_search_find(search, p->points, p->queries, (rt_u32 *)p->indices,
                                            p->discs, &error),
                   &error);
        const double host_ended = rt_clock();
        gather_on_device(&d, p);
        plain[turn] = flann_ended - begin;
        host[turn] = host_ended - flann_ended;
        device[turn] = rt_clock() - host_ended;
    }
    const double thousands = 1e-3 * (double)p->queries;
    bench_figure("gather.flann", thousands / bench_median(plain));
    bench_figure("gather.host", thousands / bench_median(host));
    bench_figure("gather.device", thousands / bench_median(device));
    close_device(&d);
    flann_free_index_float(tree, &parameters);
    rt_neighbour_search_destroy(search);
}

int main(int argc, char **argv)
{
    long cores = sysconf(_SC_NPROCESSORS_ONLN);
    problem p;
    memset(&p, 0, sizeof p);
    p.photons = argc > 1 ? strtoul(argv[1], NULL, 10) : 1000000;
    p.queries = argc > 2 ? strtoul(argv[2], NULL, 10) : 100000;
    p.k = argc > 3 ? (uint32_t)strtoul(argv[3], NULL, 10) : 50;
    p.threads = cores > 0 ? (uint32_t)cores : 1;
    if (p.k < 1 || p.photons < p.k || p.queries < 1) {
        fprintf(stderr, "usage: bench_gather [PHOTONS [QUERIES [K]]], 1 <= K <= PHOTONS\n");
        return 2;
    }
    pose(&p);
    compete(&p);
    discard(&p);
    return 0;
}
