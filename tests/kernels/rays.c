/* rays.c - makes scenes and rays, and traces them on the device. */
#include "kernels/rays.h"

#include <stdlib.h>
#include <string.h>

#include "render/renderer.h"
#include "support.h"

static uint32_t next(rays_stream *stream)
{
    const uint64_t old = stream->state;
    stream->state = old * 6364136223846793005u + 1442695040888963407u;
    const uint32_t mixed = (uint32_t)(((old >> 18) ^ old) >> 27), turn = (uint32_t)(old >> 59);
    return (mixed >> turn) | (mixed << (-turn & 31));
}

float rays_uniform(rays_stream *stream)
{
    return (float)(next(stream) >> 8) * 0x1p-24f;
}

float rays_between(rays_stream *stream, float lo, float hi)
{
    return lo + (hi - lo) * rays_uniform(stream);
}

void rays_point(rays_stream *stream, float half, float out[3])
{
    for (int a = 0; a < 3; a++)
        out[a] = rays_between(stream, -half, half);
}

void rays_direction(rays_stream *stream, float out[3])
{
    float square;
    do {
        rays_point(stream, 1.0f, out);
        square = out[0] * out[0] + out[1] * out[1] + out[2] * out[2];
    } while (square > 1.0f || square < 0.01f);
}

rt_ray rays_make(const float origin[3], const float direction[3], float t_min, float t_max)
{
    rt_ray ray = {{0}, t_min, {0}, t_max};
    memcpy(ray.origin, origin, sizeof ray.origin);
    memcpy(ray.direction, direction, sizeof ray.direction);
    return ray;
}

static const rt_surface plain;

rt_scene *rays_scene(void)
{
    const rt_material white = {.kd = {0.5f, 0.5f, 0.5f}};
    rt_scene *scene = NULL;
    rt_error error;
    uint32_t index;
    expect_ok(rt_scene_create(&scene, &error), &error);
    expect_ok(rt_scene_add_material(scene, &index, "white", &white, &error), &error);
    return scene;
}

void rays_add_triangles(rt_scene *scene, const float *positions, size_t vertices,
                        const uint32_t *indices, size_t triangles)
{
    rt_error error;
    expect_ok(rt_scene_add_triangles(scene, NULL, positions, vertices, indices, triangles, NULL,
                                     &plain, &error),
              &error);
}

void rays_add_quad(rt_scene *scene, const float corner[3], const float edge1[3],
                   const float edge2[3])
{
    rt_error error;
    expect_ok(rt_scene_add_quad(scene, NULL, corner, edge1, edge2, &plain, &error), &error);
}

void rays_add_sphere(rt_scene *scene, const float centre[3], float radius)
{
    rt_error error;
    expect_ok(rt_scene_add_sphere(scene, NULL, centre, radius, &plain, &error), &error);
}

void rays_add_plane(rt_scene *scene, const float point[3], const float normal[3])
{
    rt_error error;
    expect_ok(rt_scene_add_plane(scene, NULL, point, normal, &plain, &error), &error);
}

rt_renderer *rays_renderer(const rt_scene *scene, rt_accel accel)
{
    const rt_renderer_options options = {accel, NULL};
    rt_renderer *renderer = NULL;
    rt_error error;
    expect_ok(rt_renderer_create(&renderer, scene, test_device(), &options, &error), &error);
    return renderer;
}

rt_hit *rays_trace(rt_renderer *renderer, rt_trace_kind kind, const rt_ray *rays, size_t count)
{
    rt_error error;
    rt_hit *hits = malloc(count * sizeof *hits);
    assert_non_null(hits);
    expect_ok(rt_trace(renderer, kind, rays, count, hits, &error), &error);
    return hits;
}

float *rays_leave(rt_scene *scene, const rt_ray *rays, float (*away)[4], uint32_t count)
{
    rt_renderer *renderer = rays_renderer(scene, RT_ACCEL_BVH);
    float *next = malloc(count * sizeof *next);
    assert_non_null(next);
    cl_mem in = test_buffer(count * sizeof *rays, rays),
           to = test_buffer(count * sizeof *away, away);
    cl_mem out = test_buffer(count * sizeof *next, NULL);
    cl_kernel kernel = test_kernel("leave", "leave");
    const rt_arg args[] = {RT_ARG(renderer->scene), RT_ARG(in), RT_ARG(to), RT_ARG(count),
                           RT_ARG(out)};
    test_run(kernel, args, 5, count);
    test_read(out, count * sizeof *next, next);
    rt_kernel_release(kernel);
    rt_buffer_release(test_device(), in);
    rt_buffer_release(test_device(), to);
    rt_buffer_release(test_device(), out);
    rt_renderer_destroy(renderer);
    rt_scene_destroy(scene);
    return next;
}
