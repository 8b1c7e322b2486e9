/* matrix.h - affine maps in double precision, as the scenes of other programs write them. */
#ifndef RT_DSL_IMPORT_MATRIX_H
#define RT_DSL_IMPORT_MATRIX_H

#define IMPORT_PI 3.14159265358979323846

/* The upper three rows; the columns are the images of the axes and of the origin. */
typedef struct matrix {
    double m[3][4];
} matrix;

matrix rt_matrix_identity(void);

/* That of its columns, four numbers each, of which the last is left out. */
matrix rt_matrix_from_columns(const double m[16]);

/* a after b: (a b) x = a (b x). */
matrix rt_matrix_multiply(const matrix *a, const matrix *b);

matrix rt_matrix_translate(double x, double y, double z);
matrix rt_matrix_scale(double x, double y, double z);

/* About an axis of any length but zero, counter-clockwise seen against it; degrees. */
matrix rt_matrix_rotate(double degrees, const double axis[3]);

/* The same formula for an axis that is not of unit length, where it is no rotation. */
matrix rt_matrix_rotate_as_is(double degrees, const double a[3]);

/* 0 where it has no inverse. */
int rt_matrix_invert(matrix *out, const matrix *a);

/* Of the linear part. */
double rt_matrix_determinant(const matrix *a);

void rt_matrix_point(double out[3], const matrix *a, const double p[3]);
void rt_matrix_vector(double out[3], const matrix *a, const double v[3]);

/* Whether it scales all directions alike, to a millionth, or to `nearly` of its squared scale. */
int rt_matrix_keeps_angles(const matrix *a);
int rt_matrix_nearly_keeps_angles(const matrix *a, double nearly);

/* The length of the image of an axis, 0 to 2. */
double rt_matrix_axis_length(const matrix *a, int axis);

int rt_matrix_is_identity(const matrix *a);

/*
 * Whether a shape can have it in single precision: the test of the library, which refuses entries
 * of the inverse that are too large, and columns that lie in a plane.
 */
int rt_matrix_can_place(const matrix *a);

/* The largest of its numbers, without their signs. */
double rt_matrix_largest(const matrix *a);

/* Whether all of its numbers are finite in single precision. */
int rt_matrix_is_finite(const matrix *a);

double rt_vector_dot(const double a[3], const double b[3]);
void rt_vector_cross(double out[3], const double a[3], const double b[3]);
double rt_vector_length(const double v[3]);

/* The normal of a triangle, of twice its area. */
void rt_vector_normal(double out[3], const double corners[9]);

/* 0 where it has no direction. */
int rt_vector_normalize(double v[3]);

#endif
