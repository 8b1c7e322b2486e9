/* rng_draw.c - runs the kernels of rng.cl. */
#include "kernels/rng_draw.h"

#include <string.h>

#include "pack/sobol.h"
#include "types.h"

cl_mem rng_scene(void)
{
    static struct {
        rt_scene_header header;
        uint32_t table[RT_SOBOL_WORDS];
    } scene;
    scene.header.sobol = sizeof scene.header / RT_SCENE_ROW;
    rt_sobol_table(scene.table);
    return test_buffer(sizeof scene, &scene);
}

void rng_draw_pairs(rt_sampler kind, uint32_t seed, int along, uint32_t set, uint32_t count,
                    float (*out)[8])
{
    const uint32_t is_along = along != 0;
    rt_params params;
    memset(&params, 0, sizeof params);
    params.sampler = kind;
    params.seed = seed;
    cl_kernel kernel = test_kernel("rng", "pairs");
    cl_mem scene = rng_scene(), made = test_output(count * sizeof *out, out);
    rt_arg args[] = {RT_ARG(params), RT_ARG(scene), RT_ARG(is_along),
                     RT_ARG(set),    RT_ARG(count), RT_ARG(made)};
    test_run(kernel, args, 6, count);
    test_read(made, count * sizeof *out, out);
    rt_buffer_release(test_device(), made);
    rt_buffer_release(test_device(), scene);
    rt_kernel_release(kernel);
}
