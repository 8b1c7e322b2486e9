/* light_draw.c - runs the kernels of light.cl. */
#include "light_draw.h"

#include <string.h>

#include "chance.h"
#include "photon/light_sources.h"

rt_scene *light_scene(void)
{
    rt_scene *scene = NULL;
    rt_material black;
    rt_error error;
    uint32_t index;
    memset(&black, 0, sizeof black);
    expect_ok(rt_scene_create(&scene, &error), &error);
    expect_ok(rt_scene_add_material(scene, &index, NULL, &black, &error), &error);
    return scene;
}

rt_renderer *light_renderer(rt_scene *scene)
{
    rt_renderer *renderer = NULL;
    rt_error error;
    expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
    rt_scene_destroy(scene);
    return renderer;
}

static void draw_told(rt_renderer *renderer, uint32_t seed, const float from[3], uint32_t count,
                      uint32_t told, light_draw *out)
{
    float point[4] = {from[0], from[1], from[2], 0};
    cl_kernel kernel = test_kernel("light", "sample");
    cl_mem made = test_output(count * sizeof *out, out);
    rt_arg args[] = {RT_ARG(renderer->scene), RT_ARG(seed), RT_ARG(count), RT_ARG(told),
                     RT_ARG(point),           RT_ARG(made)};
    test_run(kernel, args, 6, count);
    test_read(made, count * sizeof *out, out);
    rt_buffer_release(test_device(), made);
    rt_kernel_release(kernel);
}

void draw_many_lights(rt_renderer *renderer, uint32_t seed, const float from[3], uint32_t count,
                      light_draw *out)
{
    draw_told(renderer, seed, from, count, 0, out);
}

void draw_many_emissions(rt_renderer *renderer, uint32_t seed, uint32_t count, emission_draw *out)
{
    cl_kernel kernel = test_kernel("light", "emit");
    rt_light_sources lights;
    rt_error error;
    expect_ok(rt_light_sources_read(&lights, test_device(), renderer->scene, NULL, 0, &error),
              &error);
    cl_mem shares = test_buffer(lights.light_count * sizeof *lights.shares, lights.shares);
    cl_mem made = test_output(count * sizeof *out, out);
    rt_arg args[] = {RT_ARG(renderer->scene), RT_ARG(seed), RT_ARG(count), RT_ARG(shares),
                     RT_ARG(made)};
    test_run(kernel, args, 5, count);
    test_read(made, count * sizeof *out, out);
    rt_light_sources_free(&lights);
    rt_buffer_release(test_device(), shares);
    rt_buffer_release(test_device(), made);
    rt_kernel_release(kernel);
}

void draw_lights(rt_renderer *renderer, uint32_t seed, const float from[3], light_draw *out)
{
    draw_told(renderer, test_seed(seed), from, light_draws, light_draws, out);
}

void draw_compensated(rt_renderer *renderer, uint32_t seed, const float from[3],
                      compensated_draw *out)
{
    float point[4] = {from[0], from[1], from[2], 0};
    uint32_t seeded = test_seed(seed), count = light_draws;
    cl_kernel kernel = test_kernel("light", "compensated");
    cl_mem made = test_output(count * sizeof *out, out);
    rt_arg args[] = {RT_ARG(renderer->scene), RT_ARG(seeded), RT_ARG(count), RT_ARG(point),
                     RT_ARG(made)};
    test_run(kernel, args, 5, count);
    test_read(made, count * sizeof *out, out);
    rt_buffer_release(test_device(), made);
    rt_kernel_release(kernel);
}

void draw_emissions(rt_renderer *renderer, uint32_t seed, emission_draw *out)
{
    draw_many_emissions(renderer, test_seed(seed), light_draws, out);
}

void light_chances(rt_renderer *renderer, const float from[3], uint32_t count, float *out)
{
    float point[4] = {from[0], from[1], from[2], 0};
    cl_kernel kernel = test_kernel("light", "chances");
    cl_mem made = test_buffer(count * sizeof *out, NULL);
    rt_arg args[] = {RT_ARG(renderer->scene), RT_ARG(point), RT_ARG(count), RT_ARG(made)};
    test_run(kernel, args, 4, count);
    test_read(made, count * sizeof *out, out);
    rt_buffer_release(test_device(), made);
    rt_kernel_release(kernel);
}
