/*
 * triangle.inc.h - points of a triangle, uniform in area, width-generic (see math/width1.inc.h).
 *
 * References:
 *   Heitz: "A Low-Distortion Map Between Triangle and Square", 2019.
 */

/* Barycentric weights of the second and third vertex. */
static inline VEC2 W(sample_triangle)(VEC2 u)
{
    const REAL fold = 0.5f * (u.x < u.y ? u.x : u.y);
    return VEC2_OF(u.x - fold, u.y - fold);
}
