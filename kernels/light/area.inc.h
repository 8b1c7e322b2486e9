/* area.inc.h - the density of points by area, width-generic (see math/width1.inc.h). */

/*
 * 1 / pdf_w of a point sampled uniformly by area, for the unnormalised direction `towards`:
 * |cos| area / d^2.
 */
static inline REAL W(area_inv_pdf)(REAL area, VEC3 towards, VEC3 normal)
{
    const REAL d2 = DOT3(towards, towards);
    return fabs(DOT3(towards, normal)) * area / (d2 * sqrt(d2));
}
