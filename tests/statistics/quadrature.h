/* quadrature.h - integrals of functions of two variables, by adaptive Gauss-Legendre rules. */
#ifndef RT_TESTS_STATISTICS_QUADRATURE_H
#define RT_TESTS_STATISTICS_QUADRATURE_H

typedef double (*integrand)(const void *of, double x, double y);

/*
 * The integral over [x0, x1] x [y0, y1]. Where halving in both directions changes a part by more
 * than `near`, the part is halved again, 9 times at most.
 */
double integral(integrand f, const void *of, double x0, double y0, double x1, double y1,
                double near);

#endif
