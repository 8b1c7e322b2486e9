/*
 * bench_trace.c - the hierarchy's build and closest hits, ours against Embree's, in one run and in
 * turn.
 *
 *     bench_trace [CELLS]    cells around the equator, 1224 by default: 1.5 M triangles
 *
 * The mesh is a bumpy ball, made by formula, in a box. Rays: one million from a camera, in tiles of
 * 8 x 8, and from where those end one million diffuse bounces, on all cores. Prints seconds, and
 * million rays a second; our rays are timed on the device, without the copies there and back.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "accel/bvh.h"
#include "base/progress.h"
#include "bench/bench.h"
#include "bench/embree_peer.h"
#include "device/device.h"
#include "render/renderer.h"
#include "rt.h"

enum { film_side = 1024, ray_count = film_side * film_side };

typedef struct mesh {
    float *positions;
    uint32_t *indices;
    uint32_t vertices, triangles;
} mesh;

/* The two contestants, with what they work on. */
typedef struct contest {
    mesh mesh;
    uint32_t threads;
    rt_device *device;
    rt_renderer *renderer;
    cl_kernel kernel;
    cl_mem rays_there, hits_there;
    rt_ray *rays;
    rt_hit *hits;
    embree_peer *peer;
} contest;

static void set_vertex(float *p, double radius, double u, double v)
{
    p[0] = (float)(radius * sin(v) * cos(u));
    p[1] = (float)(radius * cos(v));
    p[2] = (float)(radius * sin(v) * sin(u));
}

/*
 * The ball has radius 1 and bumps of three sizes; the box, half as wide as 3, stops every bounce.
 */
static mesh make_mesh(uint32_t around)
{
    static const uint32_t faces[12][3] = {{0, 1, 3}, {0, 3, 2}, {4, 6, 7}, {4, 7, 5},
                                          {0, 4, 5}, {0, 5, 1}, {2, 3, 7}, {2, 7, 6},
                                          {0, 2, 6}, {0, 6, 4}, {1, 5, 7}, {1, 7, 3}};
    const double pi = acos(-1.0);
    const uint32_t rows = around / 2, ball = around * (rows + 1);
    mesh m = {NULL, NULL, ball + 8, 2 * around * rows + 12};
    m.positions = bench_allocate(1, (size_t)m.vertices * 12 + 16);
    m.indices = bench_allocate(1, (size_t)m.triangles * 12);

    for (uint32_t j = 0; j <= rows; j++)
        for (uint32_t i = 0; i < around; i++) {
            const double u = 2 * pi * i / around, v = pi * j / rows;
            const double bumps = 0.05 * sin(9 * u) * sin(7 * v) +
                                 0.01 * sin(61 * u + 3 * v) * sin(53 * v) +
                                 0.002 * sin(401 * u) * sin(307 * v);
            set_vertex(m.positions + 3 * (size_t)(j * around + i), 1 + bumps, u, v);
        }
    uint32_t *at = m.indices;
    for (uint32_t j = 0; j < rows; j++)
        for (uint32_t i = 0; i < around; i++) {
            const uint32_t a = j * around + i, b = j * around + (i + 1) % around;
            const uint32_t pair[6] = {a, b, a + around, b, b + around, a + around};
            memcpy(at, pair, sizeof pair);
            at += 6;
        }
    for (uint32_t i = 0; i < 8; i++)
        for (uint32_t a = 0; a < 3; a++)
            m.positions[3 * (size_t)(ball + i) + a] = i >> a & 1 ? 3.0f : -3.0f;
    for (uint32_t i = 0; i < 36; i++)
        at[i] = ball + faces[i / 3][i % 3];
    return m;
}

/* One ray a pixel, tile by tile. */
static void aim_camera(rt_ray *rays)
{
    for (uint32_t i = 0; i < ray_count; i++) {
        const uint32_t tile = i / 64, in_tile = i % 64, tiles = film_side / 8;
        const float x = (float)(tile % tiles * 8 + in_tile % 8) + 0.5f,
                    y = (float)(tile / tiles * 8 + in_tile / 8) + 0.5f;
        const rt_ray ray = {{0.3f, 0.4f, 2.9f},
                            0.0f,
                            {(x / (film_side / 2) - 1.0f) * 0.45f - 0.1f,
                             (1.0f - y / (film_side / 2)) * 0.45f - 0.13f, -1.0f},
                            INFINITY};
        rays[i] = ray;
    }
}

static float uniform(uint64_t *state)
{
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    return (float)(*state >> 40) * 0x1p-24f;
}

/*
 * Turns each ray into one that leaves its hit with the cosine's density: the normal plus a point of
 * the unit sphere.
 */
static void bounce(rt_ray *rays, const rt_hit *hits)
{
    uint64_t state = 88172645463325252u;
    for (uint32_t i = 0; i < ray_count; i++) {
        rt_ray *ray = &rays[i];
        const float *n = hits[i].normal, *d = ray->direction;
        const float side = n[0] * d[0] + n[1] * d[1] + n[2] * d[2] > 0.0f ? -1.0f : 1.0f;
        const float y = 2.0f * uniform(&state) - 1.0f, turn = 6.2831853f * uniform(&state),
                    r = sqrtf(1.0f - y * y);
        const float point[3] = {r * cosf(turn), y, r * sinf(turn)};
        for (int a = 0; a < 3; a++) {
            ray->origin[a] += hits[i].t * d[a] + 1e-3f * side * n[a];
            ray->direction[a] = 1.001f * side * n[a] + point[a];
        }
    }
}

static double our_build(const contest *c)
{
    const rt_bvh_mesh part = {c->mesh.positions, c->mesh.indices, c->mesh.triangles, 0};
    const rt_bvh_input input = {.meshes = &part, .mesh_count = 1};
    rt_bvh *bvh = NULL;
    rt_bvh_counts counts;
    rt_error error;
    const double begin = rt_clock();
    bench_must(rt_bvh_build(&bvh, &input, c->threads, NULL, &error), &error);
    rt_bvh_get_counts(bvh, &counts);
    rt_bvh_node *nodes = malloc(counts.nodes * sizeof *nodes);
    rt_tri_block *blocks = malloc(counts.blocks * sizeof *blocks);
    if (nodes == NULL || blocks == NULL)
        bench_must(RT_ERROR_MEMORY, &(rt_error){.message = "out of memory"});
    rt_bvh_write(bvh, nodes, blocks, NULL, 0, 0);
    const double seconds = rt_clock() - begin;
    rt_bvh_destroy(bvh);
    free(nodes);
    free(blocks);
    return seconds;
}

static double our_trace(const contest *c)
{
    const cl_uint count = ray_count;
    const rt_arg args[] = {RT_ARG(c->renderer->scene), RT_ARG(c->rays_there), RT_ARG(count),
                           RT_ARG(c->hits_there)};
    rt_error error;
    bench_must(rt_kernel_args(c->kernel, args, 4, &error), &error);
    const double begin = rt_clock();
    bench_must(rt_launch(c->device, c->kernel,
                         rt_trace_items(c->device, RT_TRACE_CLOSEST, ray_count), &error),
               &error);
    bench_must(rt_device_finish(c->device, &error), &error);
    return rt_clock() - begin;
}

static void compete_in_building(const contest *c)
{
    double ours[bench_turns], theirs[bench_turns];
    for (int turn = 0; turn < bench_turns; turn++) {
        ours[turn] = our_build(c);
        const double begin = rt_clock();
        if (c->peer)
            embree_peer_build(c->peer);
        theirs[turn] = rt_clock() - begin;
    }
    bench_figure("build.ours", bench_median(ours));
    if (c->peer)
        bench_figure("build.embree", bench_median(theirs));
}

static void compete_in_tracing(const contest *c, const char *name, const char *peer_name)
{
    double ours[bench_turns], theirs[bench_turns];
    rt_error error;
    bench_must(
        rt_buffer_write(c->device, c->rays_there, 0, ray_count * sizeof *c->rays, c->rays, &error),
        &error);
    our_trace(c); /* compiles */
    for (int turn = 0; turn < bench_turns; turn++) {
        ours[turn] = our_trace(c);
        const double begin = rt_clock();
        if (c->peer)
            embree_peer_trace(c->peer, c->rays, ray_count, c->hits);
        theirs[turn] = rt_clock() - begin;
    }
    bench_must(
        rt_buffer_read(c->device, c->hits_there, 0, ray_count * sizeof *c->hits, c->hits, &error),
        &error);
    bench_figure(name, 1e-6 * ray_count / bench_median(ours));
    if (c->peer)
        bench_figure(peer_name, 1e-6 * ray_count / bench_median(theirs));
}

static void open_contest(contest *c, uint32_t around)
{
    static const rt_surface plain;
    const long cores = sysconf(_SC_NPROCESSORS_ONLN);
    rt_material white = {.kd = {0.5f, 0.5f, 0.5f}};
    rt_scene *scene = NULL;
    rt_error error;
    uint32_t index;
    c->threads = cores > 0 ? (uint32_t)cores : 1;
    c->mesh = make_mesh(around);
    c->rays = bench_allocate(1, ray_count * sizeof *c->rays);
    c->hits = bench_allocate(1, ray_count * sizeof *c->hits);
    c->peer = embree_peer_create(c->mesh.positions, c->mesh.vertices, c->mesh.indices,
                                 c->mesh.triangles, c->threads);
    c->device = bench_device();
    bench_must(rt_scene_create(&scene, &error), &error);
    bench_must(rt_scene_add_material(scene, &index, NULL, &white, &error), &error);
    bench_must(rt_scene_add_triangles(scene, NULL, c->mesh.positions, c->mesh.vertices,
                                      c->mesh.indices, c->mesh.triangles, NULL, &plain, &error),
               &error);
    bench_must(rt_renderer_create(&c->renderer, scene, c->device, NULL, &error), &error);
    rt_scene_destroy(scene);
    bench_must(rt_device_kernel(c->device, &c->kernel, "trace", "trace_closest", NULL, &error),
               &error);
    bench_must(rt_buffer_create(c->device, &c->rays_there, CL_MEM_READ_ONLY,
                                ray_count * sizeof *c->rays, NULL, "rays", &error),
               &error);
    bench_must(rt_buffer_create(c->device, &c->hits_there, CL_MEM_WRITE_ONLY,
                                ray_count * sizeof *c->hits, NULL, "hits", &error),
               &error);
}

static void close_contest(contest *c)
{
    embree_peer_destroy(c->peer);
    rt_buffer_release(c->device, c->rays_there);
    rt_buffer_release(c->device, c->hits_there);
    rt_kernel_release(c->kernel);
    rt_renderer_destroy(c->renderer);
    rt_device_close(c->device);
    free(c->rays);
    free(c->hits);
    free(c->mesh.positions);
    free(c->mesh.indices);
}

int main(int argc, char **argv)
{
    const unsigned long around = argc > 1 ? strtoul(argv[1], NULL, 10) : 1224;
    if (around < 8 || around > 10000) {
        fprintf(stderr, "usage: bench_trace [CELLS], 8 to 10000\n");
        return 2;
    }
    contest c;
    memset(&c, 0, sizeof c);
    open_contest(&c, (uint32_t)around);
    compete_in_building(&c);
    aim_camera(c.rays);
    compete_in_tracing(&c, "camera.ours", "camera.embree");
    bounce(c.rays, c.hits);
    compete_in_tracing(&c, "diffuse.ours", "diffuse.embree");
    close_contest(&c);
    return 0;
}
