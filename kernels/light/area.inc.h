/* area.inc.h - the density of points by area, over a width (see math/width1.inc.h). */

/*
 * 1 / pdf_w of sampling an area uniformly, seen along `towards` (not of unit length): its solid
 * angle, were it all there.
 */
static inline REAL W(area_inv_pdf)(REAL area, VEC3 towards, VEC3 normal)
{
    const REAL d2 = DOT3(towards, towards);
    return fabs(DOT3(towards, normal)) * area / (d2 * sqrt(d2));
}
