/*
 * width8.inc.h - the macros of width-generic code, for eight paths at a time, one per lane; see
 * width1.inc.h.
 */
#include "math/vec8.h"

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

#define W(name) name##_x8
#define REAL float8
#define UINT uint8
#define INT int8
#define BOOL int8
#define CHANNELS float8
#define FLOATS global const float *const *
#define VEC2 struct vec2_x8
#define VEC3 struct vec3_x8
#define VEC2_OF(x, y) vec2_x8(x, y)
#define VEC3_OF(x, y, z) vec3_x8(x, y, z)
#define REAL_OF(i) convert_float8(i)
#define INT_OF(x) convert_int8(x)
#define UINT_OF(x) convert_uint8(x)
#define FLOAT_AT(from, i) lanes_gather_at(from, i)

#define ADD3(a, b) add_x8(a, b)
#define SUB3(a, b) sub_x8(a, b)
#define SCALE3(s, a) scale_x8(s, a)
#define DOT2(a, b) ((a).x * (b).x + (a).y * (b).y)
#define DOT3(a, b) dot_x8(a, b)
#define CROSS3(a, b) cross_x8(a, b)
#define LENGTH3(a) length_x8(a)
#define SAFE_LENGTH3(a) safe_length_x8(a)
#define ABS3(a) abs_x8(a)
#define LARGEST3(a) largest_x8(a)

#define POINT3(a, s, b, t, c) along_x8(along_x8(a, s, b), t, c)
#define COMBINE3(r, a, s, b, t, c) along_x8(along_x8(scale_x8(r, a), s, b), t, c)
#define SUM3(a, b, c) add_x8(a, add_x8(b, c))
#define DIVIDE3(a, s) scale_x8(1.0f / (s), a)
