/*
 * transform.h - affine maps in double precision: composing, inverting and what they do to points
 * and normals.
 */
#ifndef RT_LIB_SCENE_TRANSFORM_H
#define RT_LIB_SCENE_TRANSFORM_H

#include "rt.h"

/* The upper three rows of the matrix, for column vectors. */
typedef struct rt_affine {
    double m[3][4];
} rt_affine;

/*
 * The map that a transform of the public interface stands for; all zero is the identity. Rounded as
 * a device holds it, or exact.
 */
rt_affine rt_affine_from(const rt_transform *transform);
rt_affine rt_affine_exact(const rt_transform *transform);

/* Whether a transform is all zero, and so the identity. */
int rt_transform_is_none(const rt_transform *transform);

/* First b, then a. */
rt_affine rt_affine_product(const rt_affine *a, const rt_affine *b);

/* The map that takes x, y, z to these vectors and 0 to the origin. */
rt_affine rt_affine_frame(const double x[3], const double y[3], const double z[3],
                          const double origin[3]);

double rt_affine_determinant(const rt_affine *a);
int rt_affine_is_identity(const rt_affine *a);

/*
 * The factor of a map that scales all lengths alike, to the precision of float32; 0 when it does
 * not.
 */
double rt_affine_similarity(const rt_affine *a);

/*
 * The rotation, which may mirror, nearest to the linear part of a map that scales all lengths alike
 * to a thousandth, by columns: out[j] is what it makes of axis j. Returns 0 for other maps.
 */
int rt_affine_rotation(double out[3][3], const rt_affine *a);

/*
 * The cofactors of the linear part: what it does to area vectors, such as the product of two edges.
 */
void rt_affine_cofactors(double out[3][3], const rt_affine *a);

/* The inverse. Returns 0 when there is none that single precision can hold. */
int rt_affine_inverse(rt_affine *out, const rt_affine *a);

void rt_affine_point(double out[3], const rt_affine *a, const double p[3]);
void rt_affine_vector(double out[3], const rt_affine *a, const double v[3]);

/* Maps a normal so that it stays on its side of the surface; not of unit length. */
void rt_affine_normal(double out[3], const rt_affine *inverse, const double n[3]);

/*
 * A right-handed frame x, y, n about a unit vector; y points up where n is not vertical, as
 * kernels/shape/surface.h has it.
 */
void rt_frame_about(const double n[3], double x[3], double y[3]);

#endif
