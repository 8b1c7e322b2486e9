/*
 * roulette.inc.h - the survival probability of Russian roulette, width-generic (see
 * math/width1.inc.h).
 */

/* The largest channel of the throughput or flux to come over a reference, at most 1. */
static inline REAL W(roulette_survival)(VEC3 left, REAL reference)
{
    const REAL survival = LARGEST3(left) / reference;
    return survival < 1.0f ? survival : (REAL)(1.0f);
}

/* The survival probability of an eye path after `depth` segments, with this throughput to come. */
static inline REAL W(eye_path_survival)(const rt_params *params, UINT depth, VEC3 throughput)
{
    return depth < params->roulette_depth
               ? (REAL)(1.0f)
               : W(roulette_survival)(throughput, (REAL)(params->roulette_threshold));
}
