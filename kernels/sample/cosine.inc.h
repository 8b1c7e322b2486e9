/*
 * cosine.inc.h - the unit disc, and the hemisphere in proportion to the cosine, width-generic (see
 * math/width1.inc.h).
 *
 * References:
 *   Shirley, Chiu: "A Low Distortion Map Between Disk and Square", JGT 2(3), 1997.
 *   Moshier: the Cephes library (minimax polynomials of sin and cos).
 */

/* (sin x, cos x) for |x| <= pi/4; the same bits on every device. */
static inline VEC2 W(sin_cos_eighth)(REAL x)
{
    const REAL x2 = x * x;
    const REAL s =
        x + x * x2 * (-1.6666654611e-1f + x2 * (8.3321608736e-3f + x2 * -1.9515295891e-4f));
    const REAL c =
        1.0f - 0.5f * x2 +
        x2 * x2 *
            (4.166664568298827e-2f + x2 * (-1.388731625493765e-3f + x2 * 2.443315711809948e-5f));
    return VEC2_OF(s, c);
}

/* (sin x, cos x) for |x| <= 2 pi, absolute error below 3e-7. */
static inline VEC2 W(sin_cos)(REAL x)
{
    /* Subtract the nearest multiple k of pi/2, in two parts to keep full precision. */
    const REAL turns = x * 0.636619772f;
    const INT k = INT_OF(turns + (turns < 0.0f ? (REAL)(-0.5f) : (REAL)(0.5f)));
    const VEC2 arc = W(sin_cos_eighth)((x - REAL_OF(k) * 1.5703125f) - REAL_OF(k) * 4.83826792e-4f);
    const REAL s = (k & 1) != 0 ? arc.y : arc.x, c = (k & 1) != 0 ? arc.x : arc.y;
    return VEC2_OF((k & 2) != 0 ? -s : s, ((k + 1) & 2) != 0 ? -c : c);
}

/* The unit disc, by Shirley and Chiu's concentric map. */
static inline VEC2 W(sample_disc)(VEC2 u)
{
    const REAL x = 2.0f * u.x - 1.0f, y = 2.0f * u.y - 1.0f;
    const BOOL wide = fabs(x) > fabs(y);
    const REAL r = wide ? x : y;
    const REAL angle = 0.25f * RT_PI * (wide ? y : x) / (r == 0.0f ? (REAL)(1.0f) : r);
    const VEC2 arc = W(sin_cos_eighth)(angle);
    return VEC2_OF(r * (wide ? arc.y : arc.x), r * (wide ? arc.x : arc.y));
}

/* The hemisphere about +z, in proportion to the cosine: the disc, lifted (Malley's method). */
static inline VEC3 W(sample_cosine)(VEC2 u)
{
    const VEC2 p = W(sample_disc)(u);
    const REAL z2 = 1.0f - DOT2(p, p);
    return VEC3_OF(p.x, p.y, sqrt(z2 > 0.0f ? z2 : (REAL)(0.0f)));
}

static inline REAL W(cosine_pdf_w)(REAL cosine)
{
    return cosine > 0.0f ? cosine * (1.0f / RT_PI) : (REAL)(0.0f);
}
