/* radius_test.c - the kernels of photon_radius, and the quantiles that their tests take. */
#include "mode/photon/radius_test.h"

#include <math.h>
#include <string.h>

#include "render/prepare.h"

/*
 * Passes from which on radii are worth a pilot: half as many as the radius of least error is meant
 * for. With fewer, even walls are mottled where the radii of knaus leave them smooth.
 */
enum { WORTH_A_PILOT = 8 * RT_PILOT_PASSES };

rt_radius_rule rt_radius_rule_of(const rt_render_options *o)
{
    if (o->radius_rule != RT_RADIUS_AUTO)
        return o->radius_rule;
    return o->radius > 0 || o->passes < WORTH_A_PILOT ? RT_RADIUS_KNAUS : RT_RADIUS_MSE;
}

int rt_radius_is_tested(const rt_render_options *o)
{
    return o->passes > 1 && rt_radius_rule_of(o) != RT_RADIUS_KNAUS;
}

/* Quantiles of 0.99 of chi-square of 7, and of F of 7 and 8 (m - 1) degrees of freedom. */
const float *rt_radius_test_critical(rt_radius_rule rule)
{
    static const float chi_square[RT_RADIUS_LENGTHS] = {18.4753f, 18.4753f, 18.4753f, 18.4753f,
                                                        18.4753f};
    static const float f[RT_RADIUS_LENGTHS] = {INFINITY, 6.1776f, 3.4959f, 2.9443f, 2.7918f};
    return rule == RT_RADIUS_FTEST ? f : chi_square;
}

rt_status rt_radius_test_prepare(cl_kernel *sectors, cl_kernel *test, rt_radius_rule rule,
                                 rt_device *device, cl_mem any, rt_stage_progress *progress,
                                 rt_error *error)
{
    const int is_mse = rule == RT_RADIUS_MSE;
    rt_params params;
    rt_density_params estimate;
    rt_photon_tree tree;
    memset(&params, 0, sizeof params);
    memset(&estimate, 0, sizeof estimate);
    memset(&tree, 0, sizeof tree);
    rt_arg args[] = {RT_ARG(params), RT_ARG(estimate), RT_ARG(any), RT_ARG(tree), RT_ARG(any),
                     RT_ARG(any),    RT_ARG(any),      RT_ARG(any), RT_ARG(any)};
    rt_status status =
        rt_kernel_prepare(device, sectors, "photon_radius",
                          is_mse ? "halve_discs" : "count_sectors", args, 9, progress, error);
    return status == RT_OK && !is_mse
               ? rt_device_kernel(device, test, "photon_radius", "test_sectors", NULL, error)
               : status;
}
