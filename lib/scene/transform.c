/* transform.c - affine maps: products, inverses, cofactors. */
#include "scene/transform.h"

#include <math.h>
#include <string.h>

#include "base/vec.h"

/* Entries of an inverse that kernels can still work with. */
static const double inverse_max = 1e30;

/*
 * Columns that differ in length, or from a right angle, by less than this count as equal: a few
 * roundings.
 */
static const double same = 4e-7;

/* The same where matrices are written with few digits. */
static const double nearly = 1e-3;

static void set_identity_for_zero(rt_affine *a)
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            if (a->m[i][j] != 0)
                return;
    for (int i = 0; i < 3; i++)
        a->m[i][i] = 1;
}

rt_affine rt_affine_exact(const rt_transform *transform)
{
    rt_affine a;
    memcpy(a.m, transform->m, sizeof a.m);
    set_identity_for_zero(&a);
    return a;
}

rt_affine rt_affine_from(const rt_transform *transform)
{
    rt_affine a;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            a.m[i][j] = (float)transform->m[i][j];
    set_identity_for_zero(&a);
    return a;
}

int rt_transform_is_none(const rt_transform *transform)
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            if (transform->m[i][j] != 0)
                return 0;
    return 1;
}

rt_affine rt_affine_product(const rt_affine *a, const rt_affine *b)
{
    rt_affine c;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++) {
            c.m[i][j] = j == 3 ? a->m[i][3] : 0;
            for (int k = 0; k < 3; k++)
                c.m[i][j] += a->m[i][k] * b->m[k][j];
        }
    return c;
}

rt_affine rt_affine_frame(const double x[3], const double y[3], const double z[3],
                          const double origin[3])
{
    rt_affine a;
    for (int i = 0; i < 3; i++) {
        a.m[i][0] = x[i];
        a.m[i][1] = y[i];
        a.m[i][2] = z[i];
        a.m[i][3] = origin[i];
    }
    return a;
}

void rt_affine_cofactors(double out[3][3], const rt_affine *a)
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            int r = (i + 1) % 3, s = (i + 2) % 3, u = (j + 1) % 3, v = (j + 2) % 3;
            out[i][j] = a->m[r][u] * a->m[s][v] - a->m[r][v] * a->m[s][u];
        }
}

double rt_affine_determinant(const rt_affine *a)
{
    double c[3][3];
    rt_affine_cofactors(c, a);
    return a->m[0][0] * c[0][0] + a->m[0][1] * c[0][1] + a->m[0][2] * c[0][2];
}

int rt_affine_is_identity(const rt_affine *a)
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            if (a->m[i][j] != (i == j))
                return 0;
    return 1;
}

double rt_affine_similarity(const rt_affine *a)
{
    double square[3], dot[3];
    for (int j = 0; j < 3; j++) {
        int k = (j + 1) % 3;
        square[j] = a->m[0][j] * a->m[0][j] + a->m[1][j] * a->m[1][j] + a->m[2][j] * a->m[2][j];
        dot[j] = a->m[0][j] * a->m[0][k] + a->m[1][j] * a->m[1][k] + a->m[2][j] * a->m[2][k];
    }
    double mean = (square[0] + square[1] + square[2]) / 3;
    for (int j = 0; j < 3; j++)
        if (!(fabs(square[j] - mean) <= 2 * same * mean && fabs(dot[j]) <= same * mean))
            return 0;
    return sqrt(mean);
}

/* The products of columns: squares of their lengths in [j][j]. */
static void products(double out[3][3], double columns[3][3])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            out[i][j] = columns[i][0] * columns[j][0] + columns[i][1] * columns[j][1] +
                        columns[i][2] * columns[j][2];
}

int rt_affine_rotation(double out[3][3], const rt_affine *a)
{
    enum { steps = 4 };
    double q[3][3], gram[3][3], largest = 0;
    for (int i = 0; i < 9; i++)
        largest = fmax(largest, fabs(a->m[i / 3][i % 3]));
    for (int i = 0; i < 9; i++)
        q[i / 3][i % 3] = a->m[i % 3][i / 3] / largest;
    products(gram, q);
    const double scale = sqrt((gram[0][0] + gram[1][1] + gram[2][2]) / 3);
    for (int i = 0; i < 9; i++)
        q[i / 3][i % 3] /= scale;
    products(gram, q);
    for (int i = 0; i < 9; i++)
        if (!(fabs(gram[i / 3][i % 3] - (i % 4 == 0)) <= (i % 4 == 0 ? 2 : 1) * nearly))
            return 0;
    /* Newton's steps to the polar factor, q (3 - q^T q) / 2, square the error. */
    for (int step = 0; step < steps; step++) {
        products(gram, q);
        for (int j = 0; j < 3; j++)
            for (int i = 0; i < 3; i++) {
                out[j][i] = 1.5 * q[j][i];
                for (int k = 0; k < 3; k++)
                    out[j][i] -= 0.5 * gram[j][k] * q[k][i];
            }
        memcpy(q, out, sizeof q);
    }
    return 1;
}

int rt_affine_inverse(rt_affine *out, const rt_affine *a)
{
    double c[3][3], determinant = rt_affine_determinant(a), volume = 1;
    rt_affine_cofactors(c, a);
    for (int j = 0; j < 3; j++) {
        double column[3] = {a->m[0][j], a->m[1][j], a->m[2][j]};
        volume *= rt_vec_length(column);
    }
    /* Columns that lie in a plane to the precision of float32 span no volume. */
    if (!(fabs(determinant) > same * volume))
        return 0;
    for (int i = 0; i < 3; i++) {
        out->m[i][3] = 0;
        for (int j = 0; j < 3; j++) {
            out->m[i][j] = c[j][i] / determinant;
            out->m[i][3] -= out->m[i][j] * a->m[j][3];
        }
        for (int j = 0; j < 4; j++)
            if (!(fabs(out->m[i][j]) <= inverse_max))
                return 0;
    }
    return 1;
}

void rt_affine_vector(double out[3], const rt_affine *a, const double v[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = a->m[i][0] * v[0] + a->m[i][1] * v[1] + a->m[i][2] * v[2];
}

void rt_affine_point(double out[3], const rt_affine *a, const double p[3])
{
    rt_affine_vector(out, a, p);
    for (int i = 0; i < 3; i++)
        out[i] += a->m[i][3];
}

void rt_affine_normal(double out[3], const rt_affine *inverse, const double n[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = inverse->m[0][i] * n[0] + inverse->m[1][i] * n[1] + inverse->m[2][i] * n[2];
}

void rt_frame_about(const double n[3], double x[3], double y[3])
{
    static const double upwards[3] = {0, 1, 0}, backwards[3] = {0, 0, -1};
    rt_vec_cross(x, fabs(n[1]) > 0.999 ? backwards : upwards, n);
    double length = rt_vec_length(x);
    for (int i = 0; i < 3; i++)
        x[i] /= length;
    rt_vec_cross(y, n, x);
}
