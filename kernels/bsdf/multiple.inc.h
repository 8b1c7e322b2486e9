/*
 * multiple.inc.h - light that meets more than one facet, width-generic (see math/width1.inc.h);
 * multiple.h says how it is scattered.
 */

/*
 * Reads a side of a table of losses: x the place in a row, y that between its rows, counted from 0.
 * The loss, and the mean over the side.
 */
static inline VEC2 W(loss_between)(FLOATS losses, UINT rows, REAL x, REAL y)
{
    const UINT i = min(UINT_OF(x), RT_LOSS_COSINES - 2u), j = min(UINT_OF(y), rows - 1u),
               k = min(j + 1u, rows - 1u);
    const UINT low = j * (RT_LOSS_COSINES + 1u), high = k * (RT_LOSS_COSINES + 1u);
    const REAL across = x - REAL_OF(i), along = y - REAL_OF(j);
    const REAL from = mix(FLOAT_AT(losses, low + i), FLOAT_AT(losses, low + i + 1u), across);
    const REAL to = mix(FLOAT_AT(losses, high + i), FLOAT_AT(losses, high + i + 1u), across);
    return VEC2_OF(mix(from, to, along), mix(FLOAT_AT(losses, low + RT_LOSS_COSINES),
                                             FLOAT_AT(losses, high + RT_LOSS_COSINES), along));
}

/* How often a direction is sampled for what is lost. */
static inline REAL W(often_probability)(REAL loss)
{
    return loss < 0.5f ? loss : (REAL)(0.5f);
}

/*
 * The density over the hemisphere is |n.w| / (pi (s^2 + |n.w|^2) log(1 + 1/s^2)), with s alpha: so
 * much nearer to the horizon than the cosine's do smooth facets lose light. range: the logarithm.
 */
static inline REAL W(lost_pdf_w)(VEC2 alpha, REAL range, REAL cosine)
{
    return cosine / (RT_PI * (alpha.x * alpha.y + cosine * cosine) * range);
}

/* c of the light that meets two facets or more, of which each keeps `met` and lets `left` leave. */
static inline CHANNELS W(colour_of_lost)(CHANNELS met, CHANNELS left)
{
    return met * met * left / (1.0f - met * (1.0f - left));
}
