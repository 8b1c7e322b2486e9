/* mis.inc.h - the power heuristic, over a width (see math/width1.inc.h). */

/*
 * What divides a sample of density p that another technique makes with density q, ratio = q / p:
 * the power heuristic weighs it with p^2 / (p^2 + q^2) = 1 / (1 + ratio^2).
 */
static inline REAL W(power_heuristic_divisor)(REAL ratio)
{
    return 1.0f + ratio * ratio;
}
