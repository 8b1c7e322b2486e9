/* matrix.c - affine maps in double precision. */
#include "dsl/import/matrix.h"

#include <float.h>
#include <math.h>

static const double radians = IMPORT_PI / 180;

/* Those of rt_affine_inverse: the largest entries of an inverse, and what volume counts as none. */
static const double inverse_max = 1e30, flat = 4e-7;

matrix rt_matrix_identity(void)
{
    matrix out = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
    return out;
}

matrix rt_matrix_from_columns(const double m[16])
{
    matrix out;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            out.m[i][j] = m[4 * j + i];
    return out;
}

matrix rt_matrix_multiply(const matrix *a, const matrix *b)
{
    matrix out;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            out.m[i][j] = a->m[i][0] * b->m[0][j] + a->m[i][1] * b->m[1][j] +
                          a->m[i][2] * b->m[2][j] + (j == 3 ? a->m[i][3] : 0);
    return out;
}

matrix rt_matrix_translate(double x, double y, double z)
{
    matrix out = {{{1, 0, 0, x}, {0, 1, 0, y}, {0, 0, 1, z}}};
    return out;
}

matrix rt_matrix_scale(double x, double y, double z)
{
    matrix out = {{{x, 0, 0, 0}, {0, y, 0, 0}, {0, 0, z, 0}}};
    return out;
}

matrix rt_matrix_rotate(double degrees, const double axis[3])
{
    double a[3] = {axis[0], axis[1], axis[2]};
    return rt_vector_normalize(a) ? rt_matrix_rotate_as_is(degrees, a) : rt_matrix_identity();
}

matrix rt_matrix_rotate_as_is(double degrees, const double a[3])
{
    double s = sin(degrees * radians), c = cos(degrees * radians), t = 1 - c;
    matrix out = {
        {{t * a[0] * a[0] + c, t * a[0] * a[1] - s * a[2], t * a[0] * a[2] + s * a[1], 0},
         {t * a[0] * a[1] + s * a[2], t * a[1] * a[1] + c, t * a[1] * a[2] - s * a[0], 0},
         {t * a[0] * a[2] - s * a[1], t * a[1] * a[2] + s * a[0], t * a[2] * a[2] + c, 0}}};
    return out;
}

double rt_matrix_determinant(const matrix *a)
{
    double x[3] = {a->m[0][0], a->m[1][0], a->m[2][0]}, y[3] = {a->m[0][1], a->m[1][1], a->m[2][1]},
           z[3] = {a->m[0][2], a->m[1][2], a->m[2][2]}, cross[3];
    rt_vector_cross(cross, x, y);
    return rt_vector_dot(cross, z);
}

int rt_matrix_invert(matrix *out, const matrix *a)
{
    double determinant = rt_matrix_determinant(a);
    const double(*m)[4] = a->m;
    if (determinant == 0 || !isfinite(1 / determinant))
        return 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            int r = (j + 1) % 3, s = (j + 2) % 3, t = (i + 1) % 3, u = (i + 2) % 3;
            out->m[i][j] = (m[r][t] * m[s][u] - m[r][u] * m[s][t]) / determinant;
        }
    for (int i = 0; i < 3; i++)
        out->m[i][3] = -(out->m[i][0] * m[0][3] + out->m[i][1] * m[1][3] + out->m[i][2] * m[2][3]);
    return 1;
}

void rt_matrix_vector(double out[3], const matrix *a, const double v[3])
{
    double x = v[0], y = v[1], z = v[2];
    for (int i = 0; i < 3; i++)
        out[i] = a->m[i][0] * x + a->m[i][1] * y + a->m[i][2] * z;
}

void rt_matrix_point(double out[3], const matrix *a, const double p[3])
{
    rt_matrix_vector(out, a, p);
    for (int i = 0; i < 3; i++)
        out[i] += a->m[i][3];
}

double rt_matrix_axis_length(const matrix *a, int axis)
{
    double v[3] = {a->m[0][axis], a->m[1][axis], a->m[2][axis]};
    return rt_vector_length(v);
}

int rt_matrix_keeps_angles(const matrix *a)
{
    return rt_matrix_nearly_keeps_angles(a, 2e-6);
}

int rt_matrix_nearly_keeps_angles(const matrix *a, double nearly)
{
    double product[3][3], scale = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            product[i][j] = 0;
            for (int k = 0; k < 3; k++)
                product[i][j] += a->m[k][i] * a->m[k][j];
        }
    for (int i = 0; i < 3; i++)
        scale += product[i][i] / 3;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            if (!(fabs(product[i][j] - (i == j ? scale : 0)) <= nearly * scale))
                return 0;
    return 1;
}

int rt_matrix_is_identity(const matrix *a)
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            if (a->m[i][j] != (i == j))
                return 0;
    return 1;
}

int rt_matrix_is_finite(const matrix *a)
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            if (!(fabs(a->m[i][j]) <= FLT_MAX))
                return 0;
    return 1;
}

double rt_matrix_largest(const matrix *a)
{
    double largest = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            largest = fmax(largest, fabs(a->m[i][j]));
    return largest;
}

int rt_matrix_can_place(const matrix *a)
{
    matrix single, inverse;
    double volume = 1;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            single.m[i][j] = (float)a->m[i][j];
    for (int j = 0; j < 3; j++)
        volume *= rt_matrix_axis_length(&single, j);
    if (!(fabs(rt_matrix_determinant(&single)) > flat * volume) ||
        !rt_matrix_invert(&inverse, &single))
        return 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            if (!(fabs(inverse.m[i][j]) <= inverse_max))
                return 0;
    return 1;
}

double rt_vector_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

void rt_vector_cross(double out[3], const double a[3], const double b[3])
{
    double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2],
           z = a[0] * b[1] - a[1] * b[0];
    out[0] = x;
    out[1] = y;
    out[2] = z;
}

double rt_vector_length(const double v[3])
{
    return sqrt(rt_vector_dot(v, v));
}

void rt_vector_normal(double out[3], const double corners[9])
{
    double to[2][3];
    for (int i = 0; i < 6; i++)
        to[i / 3][i % 3] = corners[3 + i] - corners[i % 3];
    rt_vector_cross(out, to[0], to[1]);
}

int rt_vector_normalize(double v[3])
{
    double length = rt_vector_length(v);
    if (!(length > 0) || !isfinite(length))
        return 0;
    for (int i = 0; i < 3; i++)
        v[i] /= length;
    return 1;
}
