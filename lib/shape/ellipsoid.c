/*
 * ellipsoid.c - the ellipsoid: in object space the unit sphere.
 *
 * Its area by Carlson's symmetric integrals: B. C. Carlson, "Numerical computation of real or
 * complex elliptic integrals", Numerical Algorithms 10, 1995; NIST Digital Library of Mathematical
 * Functions, 19.33.1 and 19.21.10.
 */
#include "shape/unit_sphere.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

static int contains(const rt_scene *scene, const rt_scene_shape *shape, const double p[3])
{
    double q[3];
    return rt_shape_to_object(q, scene, shape, p) && hypot(hypot(q[0], q[1]), q[2]) < 1;
}

/* ---- Area -------------------------------------------------------------------- */

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
static double area(const rt_scene_shape *shape, const rt_affine *to_world)
{
    (void)shape;
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

const rt_shape_class rt_shape_ellipsoid = {.name = "ellipsoid",
                                           .storage = RT_STORED_ANALYTIC,
                                           .faces = RT_FACES_BALL,
                                           .boundary = rt_boundary_solid,
                                           .contains = contains,
                                           .extent = rt_unit_sphere_extent,
                                           .area = area};

rt_status rt_scene_add_ellipsoid(rt_scene *scene, uint32_t *out, const float centre[3],
                                 const float radii[3], const rt_surface *surface, rt_error *error)
{
    rt_status status = rt_check_point(centre, "ellipsoid", "centre", error);
    for (int i = 0; i < 3 && status == RT_OK; i++)
        status = rt_check_length(radii[i], "ellipsoid", "radii", error);
    if (status != RT_OK)
        return status;
    rt_affine placement = rt_placement_scaled(centre, radii[0], radii[1], radii[2]);
    return rt_shape_add_unit_sphere(scene, out, &placement, surface, "ellipsoid", error);
}
