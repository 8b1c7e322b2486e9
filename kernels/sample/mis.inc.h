/* mis.inc.h - the power heuristic, width-generic (see math/width1.inc.h). */

/*
 * The reciprocal weight of a sample of pdf p that the other technique generates with pdf q,
 * ratio = q / p: the power heuristic weights it by p^2 / (p^2 + q^2) = 1 / (1 + ratio^2).
 */
static inline REAL W(power_heuristic_divisor)(REAL ratio)
{
    return 1.0f + ratio * ratio;
}
