/*
 * width1.inc.h - the macros of width-generic code, for one path at a time.
 *
 * Sampling, light and lobe code that the scalar integrator shares with the batch of eight paths is
 * written once for both widths, in files named *.inc.h, which have no include guard. In them REAL
 * and UINT are a number for each path, BOOL is the result of a comparison, VEC2 and VEC3 are
 * vectors of REAL, and W(name) is the name of a function or struct at that width. A header includes
 * such a file after this one; integrate/batch.h includes it once more, after width8.inc.h. INT is
 * as UINT is, FLOATS where the floats of each path begin, and CHANNELS the channels of a colour
 * that one call computes: all three at width 1, at width 8 one of each path's.
 * Comparisons, ?: and the built-in functions work at both widths as they are.
 *
 * POINT3, COMBINE3, SUM3 and DIVIDE3 add and divide in a different order at each width, whichever
 * is faster there: they alone make the two widths round differently.
 */
#undef W
#undef REAL
#undef UINT
#undef INT
#undef BOOL
#undef CHANNELS
#undef FLOATS
#undef VEC2
#undef VEC3
#undef VEC2_OF
#undef VEC3_OF
#undef REAL_OF
#undef INT_OF
#undef UINT_OF
#undef FLOAT_AT
#undef ADD3
#undef SUB3
#undef SCALE3
#undef DOT2
#undef DOT3
#undef CROSS3
#undef LENGTH3
#undef SAFE_LENGTH3
#undef ABS3
#undef LARGEST3
#undef POINT3
#undef COMBINE3
#undef SUM3
#undef DIVIDE3

#define W(name) name
#define REAL float
#define UINT uint
#define INT int
#define BOOL bool
#define CHANNELS float3
#define FLOATS global const float *
#define VEC2 float2
#define VEC3 float3
#define VEC2_OF(x, y) ((float2)(x, y))
#define VEC3_OF(x, y, z) ((float3)(x, y, z))
#define REAL_OF(i) ((float)(i))
#define INT_OF(x) ((int)(x))
#define UINT_OF(x) ((uint)(x))
#define FLOAT_AT(from, i) ((from)[i])

#define ADD3(a, b) ((a) + (b))
#define SUB3(a, b) ((a) - (b))
#define SCALE3(s, a) ((s) * (a))
#define DOT2(a, b) dot(a, b)
#define DOT3(a, b) dot(a, b)
#define CROSS3(a, b) cross(a, b)
#define LENGTH3(a) length(a)
#define SAFE_LENGTH3(a) length(a)
#define ABS3(a) fabs(a)
#define LARGEST3(a) largest3(a)

#define POINT3(a, s, b, t, c) ((a) + ((s) * (b) + (t) * (c)))          /* a + s b + t c */
#define COMBINE3(r, a, s, b, t, c) ((r) * (a) + (s) * (b) + (t) * (c)) /* r a + s b + t c */
#define SUM3(a, b, c) ((a) + (b) + (c))
#define DIVIDE3(a, s) ((a) / (s))
