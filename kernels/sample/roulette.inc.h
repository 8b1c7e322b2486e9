/* roulette.inc.h - the chance to survive Russian roulette, over a width (see math/width1.inc.h). */

/* The strongest channel of what would be left over a reference, at most 1. */
static inline REAL W(roulette_survival)(VEC3 left, REAL reference)
{
    const REAL chance = LARGEST3(left) / reference;
    return chance < 1.0f ? chance : (REAL)(1.0f);
}

/* The chance of an eye path after `depth` segments that would be left this throughput. */
static inline REAL W(eye_path_survival)(const rt_params *params, UINT depth, VEC3 throughput)
{
    return depth < params->roulette_depth
               ? (REAL)(1.0f)
               : W(roulette_survival)(throughput, (REAL)(params->roulette_threshold));
}
