/*
 * facet_loss.c - the integral of what visible facets keep, by the formulas of
 * kernels/bsdf/distribution.h, over a lattice of points as even as Fibonacci's numbers make it.
 */
#include "pack/facet_loss.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

/* Two Fibonacci numbers that follow each other. */
enum { points = 4181, turn_step = 2584 };

typedef struct vector {
    double x, y, z;
} vector;

static double dot(vector a, vector b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static vector unit(vector v)
{
    const double scale = 1 / sqrt(dot(v, v));
    return (vector){v.x * scale, v.y * scale, v.z * scale};
}

/* a h - b w. */
static vector combine(double a, vector h, double b, vector w)
{
    return (vector){a * h.x - b * w.x, a * h.y - b * w.y, a * h.z - b * w.z};
}

static double stretched(const rt_facets *f, vector w)
{
    return hypot(f->alpha_u * w.x, f->alpha_v * w.y);
}

/* |w.z| Lambda(w). */
static double hidden(const rt_facets *f, vector w)
{
    const double z = fabs(w.z), s = stretched(f, w);
    if (!f->is_beckmann)
        return 0.5 * s * s / (z + hypot(z, s));
    const double a = z / s;
    return s > 0 ? fmax(0.5 * (s * exp(-a * a) / sqrt(pi) - z * erfc(a)), 0) : 0;
}

/* How much of what goes from wo to wi, on the right side of the surface, no facet hides. */
static double unshadowed(const rt_facets *f, vector wo, double seen, vector wi)
{
    if (f->is_separable)
        return fabs(wi.z) / (fabs(wi.z) + hidden(f, wi));
    const double open = seen * fabs(wi.z);
    return open / (open + wo.z * hidden(f, wi));
}

/* Reflectance at this cosine; *beyond is the cosine of the refracted direction. */
static double reflectance(double cosine, double eta, double *beyond)
{
    const double squared = 1 - eta * eta * (1 - cosine * cosine);
    *beyond = squared > 0 ? sqrt(squared) : 0;
    if (eta == 0 || squared <= 0)
        return 1;
    const double s = (eta * cosine - *beyond) / (eta * cosine + *beyond);
    const double p = (cosine - eta * *beyond) / (cosine + eta * *beyond);
    return 0.5 * (s * s + p * p);
}

/* What a facet of normal h scatters to where it leaves the surface, above it and below. */
typedef struct scattered {
    double reflected, refracted;
} scattered;

static scattered scatter(const rt_facets *f, vector wo, double seen, vector h)
{
    const double cosine = dot(wo, h);
    scattered sum = {0, 0};
    double beyond;
    if (cosine <= 0)
        return sum;
    const double reflected = reflectance(cosine, f->eta, &beyond);
    const vector above = combine(2 * cosine, h, 1, wo);
    const vector below = combine(f->eta * cosine - beyond, h, f->eta, wo);
    if (above.z > 0)
        sum.reflected = reflected * unshadowed(f, wo, seen, above);
    if (reflected < 1 && below.z < 0)
        sum.refracted = (1 - reflected) * unshadowed(f, wo, seen, below);
    return sum;
}

/*
 * A normal h for the point (u, turn), of those of GGX that wo, stretched to alpha 1, sees; of
 * Beckmann's of all. Returns how many of them wo sees, in proportion.
 */
static double facet_at(const rt_facets *f, vector wo, double u, double turn, vector *h)
{
    const double x = cos(2 * pi * turn), y = sin(2 * pi * turn);
    if (f->is_beckmann) {
        const double slope = sqrt(-log(1 - u));
        *h = unit((vector){-f->alpha_u * slope * x, -f->alpha_v * slope * y, 1});
        return fmax(wo.z - slope * (x * wo.x + y * wo.y), 0);
    }
    const double z = 1 - u * (1 + wo.z), r = sqrt(fmax(1 - z * z, 0));
    *h = unit((vector){f->alpha_u * (r * x + wo.x), f->alpha_v * (r * y + wo.y), z + wo.z});
    return 1;
}

/* The means over the facets that are seen. */
static scattered scatter_all(const rt_facets *facets, double cosine, double turn)
{
    const double sine = sqrt(fmax(1 - cosine * cosine, 0));
    const vector wo = {sine * cos(turn), sine * sin(turn), cosine};
    const vector even = unit((vector){facets->alpha_u * wo.x, facets->alpha_v * wo.y, wo.z});
    const double seen = wo.z + hidden(facets, wo);
    scattered sum = {0, 0};
    double all = 0;
    for (int i = 0; i < points; i++) {
        vector h;
        const double weight = facet_at(facets, even, (i + 0.5) / points,
                                       (double)((long long)i * turn_step % points) / points, &h);
        all += weight;
        if (weight > 0) {
            const scattered one = scatter(facets, wo, seen, h);
            sum.reflected += weight * one.reflected;
            sum.refracted += weight * one.refracted;
        }
    }
    return (scattered){sum.reflected / all, sum.refracted / all};
}

double rt_facet_loss(const rt_facets *facets, double cosine, double turn)
{
    const scattered kept = scatter_all(facets, cosine, turn);
    return fmax(1 - kept.reflected - kept.refracted, 0);
}

double rt_facet_reflected(const rt_facets *facets, double cosine)
{
    return scatter_all(facets, cosine, 0).reflected;
}

double rt_facet_refracted(const rt_facets *facets, double cosine)
{
    return scatter_all(facets, cosine, 0).refracted;
}

double rt_facet_covered(const rt_facets *facets, double eta, double cosine, double turn,
                        rt_coat_passes *passes, const void *coat)
{
    const double sine = eta * sqrt(fmax(1 - cosine * cosine, 0)), enters = passes(coat, cosine);
    if (sine >= 1 || enters <= 0)
        return 0;
    const vector wo = {sine * cos(turn), sine * sin(turn), sqrt(1 - sine * sine)};
    const vector even = unit((vector){facets->alpha_u * wo.x, facets->alpha_v * wo.y, wo.z});
    const double seen = wo.z + hidden(facets, wo);
    double sum = 0, all = 0;
    for (int i = 0; i < points; i++) {
        vector h;
        const double weight = facet_at(facets, even, (i + 0.5) / points,
                                       (double)((long long)i * turn_step % points) / points, &h);
        const vector wi = combine(2 * dot(wo, h), h, 1, wo);
        const double squared = 1 - (1 - wi.z * wi.z) / (eta * eta);
        all += weight;
        if (weight > 0 && dot(wo, h) > 0 && wi.z > 0 && squared > 0)
            sum += weight * unshadowed(facets, wo, seen, wi) *
                   fmin(enters, passes(coat, sqrt(squared)));
    }
    return sum / all;
}

double rt_smooth_reflectance(double cosine, double eta)
{
    double unused;
    return reflectance(cosine, eta, &unused);
}
