/*
 * coated.inc.h - diffuse reflection below a coat, width-generic (see math/width1.inc.h); coated.h
 * has the formula.
 */

/* Of light that enters, what leaves again, where each time the coat throws back so much of it. */
static inline CHANNELS W(through_coat)(REAL enters, CHANNELS thrown_back)
{
    return enters / (1.0f - thrown_back);
}
