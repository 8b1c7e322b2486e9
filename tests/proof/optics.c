/* optics.c - closed forms of reflectance, and integrals of them. */
#include "proof/optics.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

/*
 * Fresnel's amplitudes; sin of refraction is sin_i / index, and beyond the critical angle its
 * cosine is imaginary.
 */
double optics_fresnel(double cos_i, double complex index)
{
    double complex q = csqrt(index * index - (1 - cos_i * cos_i)); /* index cos_t */
    double complex s = (cos_i - q) / (cos_i + q);
    double complex p = (index * index * cos_i - q) / (index * index * cos_i + q);
    return 0.5 * (creal(s * conj(s)) + creal(p * conj(p)));
}

static double lambda(double alpha, double cos_w)
{
    double tan2 = 1 / (cos_w * cos_w) - 1;
    return 0.5 * (sqrt(1 + alpha * alpha * tan2) - 1);
}

/*
 * The integral over facet normals h of F D(h) G2 (wo.h) / cos_o, with the correlated G2 = 1 / (1 +
 * Lambda_o + Lambda_i). In u = tan^2 / (alpha^2 + tan^2), D(h) (h.n) dh is du dphi / 2 pi.
 */
double optics_rough(double cos_o, double alpha, double complex index)
{
    enum { us = 4000, phis = 400 };
    double sin_o = sqrt(1 - cos_o * cos_o), sum = 0;
    for (int i = 0; i < us; i++) {
        double u = (i + 0.5) / us, tan2 = alpha * alpha * u / (1 - u), c = 1 / sqrt(1 + tan2),
               s = sqrt(1 - c * c);
        for (int j = 0; j < phis; j++) {
            double o_h = cos_o * c + sin_o * s * cos(pi * (j + 0.5) / phis),
                   cos_i = 2 * o_h * c - cos_o;
            if (o_h > 0 && cos_i > 0)
                sum += optics_fresnel(o_h, index) /
                       (1 + lambda(alpha, cos_o) + lambda(alpha, cos_i)) * o_h / (cos_o * c);
        }
    }
    return sum / (us * phis);
}

/*
 * In c^2, which diffuse light has evenly; by the midpoint rule in t, c^2 = t^2 (3 - 2 t), gentle at
 * both ends.
 */
double optics_diffuse_mean(double (*f)(double cos_i))
{
    enum { steps = 20000 };
    double sum = 0;
    for (int i = 0; i < steps; i++) {
        double t = (i + 0.5) / steps;
        sum += f(sqrt(t * t * (3 - 2 * t))) * 6 * t * (1 - t);
    }
    return sum / steps;
}
