/*
 * mis.h - multiple importance sampling: the weights of light sampling and BSDF sampling.
 *
 * Direct light is estimated by sampling points on lights and by sampling directions from the BSDF.
 * Each sample is weighted by the power heuristic, exponent 2; with an estimator that uses one
 * technique alone, its samples count fully and the other's not at all.
 *
 * References:
 *   Veach, Guibas: "Optimally Combining Sampling Techniques for Monte Carlo Rendering", SIGGRAPH
 *     1995.
 */
#ifndef RT_KERNELS_SAMPLE_MIS_H
#define RT_KERNELS_SAMPLE_MIS_H

#include "types.h"
#include "math/width1.inc.h"
#include "sample/mis.inc.h"

/*
 * The weight of a sample of `technique`, RT_ESTIMATOR_LIGHT or RT_ESTIMATOR_BSDF, whose direction
 * the other technique generates with `ratio` times its density.
 */
static inline float mis_weight(const rt_params *params, uint technique, float ratio)
{
    if (params->estimator != RT_ESTIMATOR_MIS)
        return params->estimator == technique ? 1.0f : 0.0f;
    return 1.0f / power_heuristic_divisor(ratio);
}

#endif
