/*
 * frame.inc.h - unit vectors and orthonormal frames, width-generic (see math/width1.inc.h).
 *
 * References:
 *   Duff, Burgess, Christensen, Hery, Kensler, Liani, Villemin: "Building an Orthonormal
 *     Basis, Revisited", JCGT 6(1), 2017.
 */

static inline VEC3 W(unit)(VEC3 v)
{
    return SCALE3(1.0f / sqrt(DOT3(v, v)), v);
}

/* A right-handed orthonormal frame about the unit vector n. */
struct W(frame) {
    VEC3 s, t, n;
};

/* Duff et al., listing 3: no branch and no singular direction. */
static inline struct W(frame) W(frame_about)(VEC3 n)
{
    const REAL sign = n.z < 0.0f ? (REAL)(-1.0f) : (REAL)(1.0f);
    const REAL a = -1.0f / (sign + n.z);
    const REAL b = n.x * n.y * a;
    struct W(frame) frame;
    frame.s = VEC3_OF(1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x);
    frame.t = VEC3_OF(b, sign + n.y * n.y * a, -n.y);
    frame.n = n;
    return frame;
}

/* Local coordinates (s, t, n) to world. */
static inline VEC3 W(frame_to_world)(struct W(frame) frame, VEC3 v)
{
    return COMBINE3(v.x, frame.s, v.y, frame.t, v.z, frame.n);
}

/* World coordinates to local ones. */
static inline VEC3 W(frame_to_local)(struct W(frame) frame, VEC3 v)
{
    return VEC3_OF(DOT3(v, frame.s), DOT3(v, frame.t), DOT3(v, frame.n));
}
