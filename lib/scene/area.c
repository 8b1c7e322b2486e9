/*
 * area.c - A linear map with cofactor matrix C stretches a surface element of unit normal n by |C
 * n|.
 *
 * Carlson's symmetric integrals: B. C. Carlson, "Numerical computation of real or complex elliptic
 * integrals", Numerical Algorithms 10, 1995; the surface of the ellipsoid: NIST Digital Library of
 * Mathematical Functions, 19.33.1 and 19.21.10.
 */
#include "scene/area.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

enum { turn_steps_min = 32, turn_steps_max = 1 << 18, tube_steps_max = 512 };
static const double enough = 1e-9; /* relative change at which an integral has settled */

/* |C n| */
static double stretch(double c[3][3], double x, double y, double z)
{
    double square = 0;
    for (int i = 0; i < 3; i++) {
        double t = c[i][0] * x + c[i][1] * y + c[i][2] * z;
        square += t * t;
    }
    return sqrt(square);
}

/*
 * The integral of |C (r cos phi, r sin phi, z)| over a turn, by the trapezium rule, which converges
 * faster than any power of the number of steps on a smooth periodic function.
 */
static double turn(double c[3][3], double r, double z, int steps_max)
{
    double sum = 0, before;
    int steps = turn_steps_min;
    for (int i = 0; i < steps; i++)
        sum += stretch(c, r * cos(2 * pi * i / steps), r * sin(2 * pi * i / steps), z);
    do {
        before = sum / steps;
        /* Twice the steps: the old ones and those between. */
        for (int i = 0; i < steps; i++) {
            double phi = 2 * pi * (i + 0.5) / steps;
            sum += stretch(c, r * cos(phi), r * sin(phi), z);
        }
        steps *= 2;
    } while (steps < steps_max && fabs(sum / steps - before) > enough * before);
    return 2 * pi * sum / steps;
}

double rt_area_disc(const rt_affine *to_world, double inner_radius)
{
    double c[3][3];
    rt_affine_cofactors(c, to_world);
    return pi * (1 - inner_radius * inner_radius) * stretch(c, 0, 0, 1);
}

/* The side has radius r = 1 - (1 - p) z and the element (cos phi, sin phi, 1 - p) r dphi dz. */
double rt_area_cone(const rt_affine *to_world, double apex_radius, int caps)
{
    double c[3][3], p = apex_radius;
    rt_affine_cofactors(c, to_world);
    double side = 0.5 * (1 + p) * turn(c, 1, 1 - p, turn_steps_max);
    return side + (caps ? pi * (1 + p * p) * stretch(c, 0, 0, 1) : 0);
}

/*
 * The element is (cos phi cos theta, sin phi cos theta, sin theta) (1 + m cos theta) m dphi dtheta.
 */
double rt_area_torus(const rt_affine *to_world, double minor_radius)
{
    double c[3][3], sum = 0, before, m = minor_radius, offset = 0;
    int steps = turn_steps_min, total = 0;
    rt_affine_cofactors(c, to_world);
    do {
        before = total ? sum / total : 0;
        for (int i = 0; i < steps; i++) {
            double theta = 2 * pi * (i + offset) / steps;
            sum += m * (1 + m * cos(theta)) * turn(c, cos(theta), sin(theta), 4 * tube_steps_max);
        }
        steps = total ? 2 * steps : steps;
        total += total ? steps / 2 : steps;
        offset = 0.5;
    } while (total < tube_steps_max && fabs(sum / total - before) > enough * sum / total);
    return 2 * pi * sum / total;
}

/* ---- The ellipsoid --------------------------------------------------------- */

/* Eigenvalues of a symmetric matrix by Jacobi rotations, in rising order. */
static void eigenvalues(double a[3][3], double out[3])
{
    for (int sweep = 0; sweep < 30; sweep++)
        for (int p = 0; p < 2; p++)
            for (int q = p + 1; q < 3; q++) {
                if (a[p][q] == 0)
                    continue;
                double theta = 0.5 * atan2(2 * a[p][q], a[q][q] - a[p][p]), s = sin(theta),
                       co = cos(theta);
                for (int k = 0; k < 3; k++) {
                    double x = a[k][p], y = a[k][q];
                    a[k][p] = co * x - s * y;
                    a[k][q] = s * x + co * y;
                }
                for (int k = 0; k < 3; k++) {
                    double x = a[p][k], y = a[q][k];
                    a[p][k] = co * x - s * y;
                    a[q][k] = s * x + co * y;
                }
                a[p][q] = a[q][p] = 0;
            }
    double x = a[0][0], y = a[1][1], z = a[2][2];
    out[0] = fmin(x, fmin(y, z));
    out[2] = fmax(x, fmax(y, z));
    out[1] = fmax(fmin(x, y), fmin(fmax(x, y), z));
}

/* R_F(x, y, z) and R_D(x, y, z) by duplication. */
static void carlson(double x, double y, double z, double *rf, double *rd)
{
    double sum = 0, weight = 1;
    for (int i = 0; i < 60; i++) {
        double lambda = sqrt(x * y) + sqrt(y * z) + sqrt(z * x);
        sum += weight / (sqrt(z) * (z + lambda));
        weight *= 0.25;
        x = 0.25 * (x + lambda);
        y = 0.25 * (y + lambda);
        z = 0.25 * (z + lambda);
        if (fmax(fabs(x - y), fabs(y - z)) < 1e-12 * z)
            break;
    }
    *rf = 1 / sqrt(z);
    *rd = 3 * sum + weight / (z * sqrt(z));
}

/*
 * 4 pi R_G(a^2 b^2, a^2 c^2, b^2 c^2), whose arguments are the squared singular values of the
 * cofactors.
 */
double rt_area_ellipsoid(const rt_affine *to_world)
{
    double c[3][3], square[3][3], e[3], rf, rd;
    rt_affine_cofactors(c, to_world);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            square[i][j] = c[0][i] * c[0][j] + c[1][i] * c[1][j] + c[2][i] * c[2][j];
    eigenvalues(square, e);
    /*
     * 2 R_G = z R_F - (x - z)(y - z) R_D / 3 + sqrt(x y / z), with z the middle one: then no term
     * is negative.
     */
    double z = e[1], x = e[0] / z, y = e[2] / z;
    carlson(x, y, 1, &rf, &rd);
    return 2 * pi * sqrt(z) * (rf - (x - 1) * (y - 1) * rd / 3 + sqrt(x * y));
}
