/* shape_reference.c - the nearest hit, by equations in double and extended precision. */
#include "kernels/shape_reference.h"

#include <float.h>
#include <math.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

/* ---- Placement ------------------------------------------------------------- */

void reference_place(reference_shape *shape, const rt_transform *to_world)
{
    double c[3][3], det = 0;
    shape->to_world = *to_world;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
            c[i][j] = (double)to_world->m[i1][j1] * to_world->m[i2][j2] -
                      (double)to_world->m[i1][j2] * to_world->m[i2][j1];
        }
    for (int j = 0; j < 3; j++)
        det += to_world->m[0][j] * c[0][j];
    for (int i = 0; i < 3; i++) {
        shape->to_object[i][3] = 0;
        for (int j = 0; j < 3; j++) {
            shape->to_object[i][j] = c[j][i] / det;
            shape->to_object[i][3] -= c[j][i] / det * to_world->m[j][3];
        }
    }
}

double reference_ray(const reference_shape *shape, const rt_ray *ray, double o[3], double d[3])
{
    for (int i = 0; i < 3; i++) {
        o[i] = shape->to_object[i][3];
        d[i] = 0;
        for (int j = 0; j < 3; j++) {
            o[i] += shape->to_object[i][j] * ray->origin[j];
            d[i] += shape->to_object[i][j] * ray->direction[j];
        }
    }
    return sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
}

void reference_normal(const reference_shape *shape, const double normal[3], double out[3])
{
    double square = 0;
    for (int j = 0; j < 3; j++) {
        out[j] = 0;
        for (int i = 0; i < 3; i++)
            out[j] += shape->to_object[i][j] * normal[i];
        square += out[j] * out[j];
    }
    for (int j = 0; j < 3; j++)
        out[j] /= sqrt(square);
}

/* ---- Candidates ------------------------------------------------------------ */

/* A ray in the shape's space, and the nearest hit so far. */
typedef struct search {
    const reference_shape *shape;
    double wider, longer;
    double o[3], d[3];
    reference_hit best;
} search;

static void at(const search *s, double t, double p[3])
{
    for (int i = 0; i < 3; i++)
        p[i] = s->o[i] + t * s->d[i];
}

static void take(search *s, double t, double x, double y, double z)
{
    if (!(t >= 0 && t < s->best.t))
        return;
    const double length = sqrt(x * x + y * y + z * z);
    s->best.t = t;
    at(s, t, s->best.position);
    s->best.normal[0] = x / length;
    s->best.normal[1] = y / length;
    s->best.normal[2] = z / length;
}

/* Roots of a t^2 + 2 b t + c. */
static int quadratic(double a, double b, double c, double roots[2])
{
    const double discriminant = b * b - a * c;
    if (!(discriminant >= 0))
        return 0;
    const double q = -(b + copysign(sqrt(discriminant), b));
    roots[0] = c / q;
    roots[1] = q / a;
    return 2;
}

static void ellipsoid_meet(search *s)
{
    double a = 0, b = 0, c = -(1 + s->wider) * (1 + s->wider), roots[2], p[3];
    for (int i = 0; i < 3; i++) {
        a += s->d[i] * s->d[i];
        b += s->o[i] * s->d[i];
        c += s->o[i] * s->o[i];
    }
    for (int k = quadratic(a, b, c, roots); k-- > 0;) {
        at(s, roots[k], p);
        take(s, roots[k], p[0], p[1], p[2]);
    }
}

static void meet_ring(search *s, double z, double hole, double radius, double normal)
{
    const double t = (z - s->o[2]) / s->d[2];
    double p[3];
    at(s, t, p);
    const double from_axis = hypot(p[0], p[1]);
    if (from_axis <= radius && from_axis >= hole)
        take(s, t, 0, 0, normal);
}

static void disc_meet(search *s)
{
    meet_ring(s, s->wider, s->shape->p - s->longer, 1 + s->wider, 1);
}

static void meet_frustum(search *s, double top)
{
    const double slope = 1 - top, r = 1 + s->wider;
    const double w = r - slope * s->o[2], dw = -slope * s->d[2];
    const double lo = -s->longer, hi = 1 + s->longer;
    double roots[2], p[3];
    const double a = s->d[0] * s->d[0] + s->d[1] * s->d[1] - dw * dw;
    const double b = s->o[0] * s->d[0] + s->o[1] * s->d[1] - w * dw;
    const double c = s->o[0] * s->o[0] + s->o[1] * s->o[1] - w * w;
    for (int k = quadratic(a, b, c, roots); k-- > 0;) {
        at(s, roots[k], p);
        if (p[2] >= lo && p[2] <= hi && r - slope * p[2] >= 0)
            take(s, roots[k], p[0], p[1], slope * hypot(p[0], p[1]));
    }
    if (s->shape->caps) {
        meet_ring(s, lo, 0, r - slope * lo, -1);
        meet_ring(s, hi, 0, r - slope * hi, 1);
    }
}

static void cylinder_meet(search *s)
{
    meet_frustum(s, 1);
}

static void cone_meet(search *s)
{
    meet_frustum(s, s->shape->p);
}

/* Of the cube, x and y are moved out by `wider` and z by `longer`. */
static void box_meet(search *s)
{
    for (int axis = 0; axis < 3; axis++)
        for (int side = -1; side < 2; side += 2) {
            const double out = 1 + (axis == 2 ? s->longer : s->wider);
            const double t = (side * out - s->o[axis]) / s->d[axis];
            double p[3], n[3] = {0};
            at(s, t, p);
            n[axis] = side;
            if (fabs(p[(axis + 1) % 3]) <= 1 + ((axis + 1) % 3 == 2 ? s->longer : s->wider) &&
                fabs(p[(axis + 2) % 3]) <= 1 + ((axis + 2) % 3 == 2 ? s->longer : s->wider))
                take(s, t, n[0], n[1], n[2]);
        }
}

/* ---- The torus: real roots of its quartic, told apart by those of the derivatives ------ */

typedef long double real;

static real value(const real *c, int degree, real x)
{
    real sum = c[degree];
    while (degree-- > 0)
        sum = sum * x + c[degree];
    return sum;
}

/* How far rounding may put a value of the polynomial off, for |x| <= reach. */
static real rounding(const real *c, int degree, real reach)
{
    real sum = 0;
    for (int i = degree; i >= 0; i--)
        sum = sum * reach + fabsl(c[i]);
    return 2 * LDBL_EPSILON * sum;
}

/*
 * The root between lo and hi, by Newton's method, halving where that leads out, until the value
 * there is rounding alone.
 */
static real root_between(const real *c, const real *slope, int degree, real lo, real hi)
{
    const int rises = value(c, degree, lo) < 0;
    const real zero = rounding(c, degree, fmaxl(fabsl(lo), fabsl(hi)));
    real x = 0.5L * (lo + hi), before = lo;
    for (int i = 0; i < 100 && fabsl(x - before) > 1e-17L; i++) {
        const real y = value(c, degree, x);
        if (fabsl(y) <= zero)
            break;
        if ((y < 0) == rises)
            lo = x;
        else
            hi = x;
        before = x;
        x -= y / value(slope, degree - 1, x);
        if (!(x > lo && x < hi))
            x = 0.5L * (lo + hi);
    }
    return x;
}

/* The same, for a polynomial of the second degree: its turn is known, and so are its roots. */
static int quadratic_roots(const real *c, real lo, real hi, real *roots)
{
    const real half = -0.5L * c[1] / c[2], square = half * half - c[0] / c[2];
    int count = 0;
    if (!(square > 0))
        return 0;
    const real first = half - sqrtl(square), second = half + sqrtl(square);
    if (first > lo && first < hi)
        roots[count++] = first;
    if (second > lo && second < hi)
        roots[count++] = second;
    return count;
}

/*
 * The roots in [lo, hi] at which the polynomial changes its sign, in rising order; returns their
 * number.
 */
static int real_roots(const real *c, int degree, real lo, real hi, real *roots)
{
    real slope[4], turns[6];
    int count = 0;
    if (degree == 2)
        return quadratic_roots(c, lo, hi, roots);
    for (int i = 1; i <= degree; i++)
        slope[i - 1] = i * c[i];
    turns[0] = lo;
    const int turn_count = real_roots(slope, degree - 1, lo, hi, turns + 1);
    turns[turn_count + 1] = hi;
    for (int i = 0; i <= turn_count; i++)
        if ((value(c, degree, turns[i]) < 0) != (value(c, degree, turns[i + 1]) < 0))
            roots[count++] = root_between(c, slope, degree, turns[i], turns[i + 1]);
    return count;
}

/* (|p|^2 + 1 - m^2)^2 = 4 (x^2 + y^2) along the line, from its point nearest to the middle. */
static void torus_meet(search *s)
{
    const real m = s->shape->p + s->wider,
               speed2 = (real)s->d[0] * s->d[0] + (real)s->d[1] * s->d[1] + (real)s->d[2] * s->d[2];
    const real speed = sqrtl(speed2);
    real along = 0, n[3], d[3], n2 = 0, flat[3] = {0}, roots[4];
    for (int i = 0; i < 3; i++)
        along -= (real)s->o[i] * s->d[i] / speed2;
    for (int i = 0; i < 3; i++) {
        n[i] = s->o[i] + along * s->d[i];
        d[i] = s->d[i] / speed;
        n2 += n[i] * n[i];
    }
    const real reach = 1.01L * (1 + m), half2 = reach * reach - n2;
    if (half2 < 0)
        return;
    for (int i = 0; i < 2; i++) {
        flat[0] += n[i] * n[i];
        flat[1] += 2 * n[i] * d[i];
        flat[2] += d[i] * d[i];
    }
    /*
     * |p|^2 + 1 - m^2 = k + x^2, for the line's own length x has no part along the nearest point.
     */
    const real k = n2 + 1 - m * m;
    const real c[5] = {k * k - 4 * flat[0], -4 * flat[1], 2 * k - 4 * flat[2], 0, 1};
    const int count = real_roots(c, 4, -sqrtl(half2), sqrtl(half2), roots);
    for (int i = 0; i < count; i++) {
        const double t = (double)(along + roots[i] / speed);
        double p[3];
        at(s, t, p);
        const double from_axis = hypot(p[0], p[1]), x = 1 - 1 / from_axis;
        take(s, t, p[0] * x, p[1] * x, p[2]);
    }
}

/* ---- Texture coordinates ---------------------------------------------------- */

static double turns(double y, double x)
{
    const double turn = atan2(y, x) / (2 * pi);
    return turn < 0 ? turn + 1 : turn;
}

static double from_axis(const double p[3])
{
    return hypot(p[0], p[1]);
}

static int ellipsoid_parameters(const reference_shape *shape, const reference_hit *hit,
                                double uv[2])
{
    const double *p = hit->position;
    (void)shape;
    uv[0] = turns(-p[2], p[0]);
    uv[1] = 0.5 + asin(fmax(-1, fmin(1, p[1]))) / pi;
    return hypot(p[0], p[2]) > 0.05;
}

static int disc_parameters(const reference_shape *shape, const reference_hit *hit, double uv[2])
{
    const double *p = hit->position;
    uv[0] = turns(hit->normal[2] > 0 ? -p[1] : p[1], p[0]);
    uv[1] = (from_axis(p) - shape->p) / (1 - shape->p);
    return from_axis(p) > 0.05;
}

static int frustum_parameters(const reference_hit *hit, double top, double uv[2])
{
    const double *p = hit->position, *n = hit->normal;
    const int is_cap = fabs(n[2]) > 0.9;
    uv[0] = turns(is_cap && n[2] > 0 ? -p[1] : p[1], p[0]);
    uv[1] = is_cap ? from_axis(p) / (n[2] > 0 ? top : 1) : p[2];
    return from_axis(p) > 0.05;
}

static int cylinder_parameters(const reference_shape *shape, const reference_hit *hit, double uv[2])
{
    (void)shape;
    return frustum_parameters(hit, 1, uv);
}

static int cone_parameters(const reference_shape *shape, const reference_hit *hit, double uv[2])
{
    return frustum_parameters(hit, shape->p, uv);
}

static int torus_parameters(const reference_shape *shape, const reference_hit *hit, double uv[2])
{
    const double *p = hit->position;
    (void)shape;
    uv[0] = turns(p[1], p[0]);
    uv[1] = turns(p[2], from_axis(p) - 1);
    return from_axis(p) > 0.05;
}

/* As from a picture on each face: u to the right and v up, seen from outside. */
static int box_parameters(const reference_shape *shape, const reference_hit *hit, double uv[2])
{
    const double *p = hit->position, *n = hit->normal;
    (void)shape;
    uv[0] = 0.5 + 0.5 * (fabs(n[0]) > 0.5 ? -n[0] * p[2] : (n[1] + n[2]) * p[0]);
    uv[1] = 0.5 + 0.5 * (fabs(n[1]) > 0.5 ? -p[2] : p[1]);
    return 1;
}

/* ---- All ------------------------------------------------------------------- */

/* The functions above, by kind. */
#define REFERENCE(KIND, name, number) [RT_SHAPE_##KIND] = {name##_meet, name##_parameters},
static const struct {
    void (*meet)(search *s);
    int (*parameters)(const reference_shape *shape, const reference_hit *hit, double uv[2]);
} references[] = {RT_PLACED_SHAPES(REFERENCE)};

reference_hit reference_nearest(const reference_shape *shape, double wider, double longer,
                                const rt_ray *ray)
{
    search s = {shape, wider, longer, {0}, {0}, {INFINITY, {0}, {0}}};
    reference_ray(shape, ray, s.o, s.d);
    references[shape->kind].meet(&s);
    return s.best;
}

int reference_parameters(const reference_shape *shape, const reference_hit *hit, double uv[2])
{
    return references[shape->kind].parameters(shape, hit, uv);
}
