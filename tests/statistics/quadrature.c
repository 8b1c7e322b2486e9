/* quadrature.c - adaptive Gauss-Legendre rules in two variables. */
#include "statistics/quadrature.h"

#include <math.h>

/* halvings: at most, and at least, so that no corner is overlooked */
enum { deepest = 9, always = 1 };

/* Three points each way. */
static double gauss(integrand f, const void *of, double x0, double y0, double x1, double y1)
{
    static const double points[3] = {-0.774596669241483377, 0, 0.774596669241483377};
    static const double weights[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
    double sum = 0;
    for (int i = 0; i < 9; i++) {
        const double x = 0.5 * (x0 + x1 + points[i % 3] * (x1 - x0)),
                     y = 0.5 * (y0 + y1 + points[i / 3] * (y1 - y0));
        sum += weights[i % 3] * weights[i / 3] * f(of, x, y);
    }
    return sum * (x1 - x0) * (y1 - y0);
}

/* Refines an estimate until its quarters agree with it. */
static double refined(integrand f, const void *of, double x0, double y0, double x1, double y1,
                      double whole, int depth, double near)
{
    const double x = 0.5 * (x0 + x1), y = 0.5 * (y0 + y1);
    const double a = gauss(f, of, x0, y0, x, y), b = gauss(f, of, x, y0, x1, y);
    const double c = gauss(f, of, x0, y, x, y1), d = gauss(f, of, x, y, x1, y1);
    if (depth == 0 || (depth <= deepest - always && fabs(a + b + c + d - whole) < near))
        return a + b + c + d;
    depth--;
    return refined(f, of, x0, y0, x, y, a, depth, near) +
           refined(f, of, x, y0, x1, y, b, depth, near) +
           refined(f, of, x0, y, x, y1, c, depth, near) +
           refined(f, of, x, y, x1, y1, d, depth, near);
}

double integral(integrand f, const void *of, double x0, double y0, double x1, double y1,
                double near)
{
    return refined(f, of, x0, y0, x1, y1, gauss(f, of, x0, y0, x1, y1), deepest, near);
}
