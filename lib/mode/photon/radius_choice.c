/* radius_choice.c - classes of pixels, and the radius of least mean squared error for each. */
#include "mode/photon/radius_choice.h"

#include <math.h>
#include <stdlib.h>

#include "mode/shrink.h"

enum {
    reach = 2,             /* of a neighbourhood, pixels to each side */
    fewest_in_class = 128, /* pixels, where there are as many */
    most_classes = 256,
    levels = 3 /* differences that a power of the area is fitted to */
};

static const double area_least = 1.0 / 64; /* t */

/* What is chosen for. */
typedef struct picture {
    uint32_t width, height;
    const rt_radius_passes *passes;
    uint32_t first; /* the largest disc that is tried */
} picture;

/* A pixel and how uneven its neighbourhood is. */
typedef struct ranked {
    float rank;
    uint32_t pixel;
} ranked;

/* Of the pixels of a class, in one pass, together. */
typedef struct class_sums {
    double bias[levels]; /* squares of the difference that halving makes */
    double variance;
} class_sums;

/* Pixels of similar rank, from the end of the class before. */
typedef struct pixel_class {
    size_t end;
    class_sums sums;
} pixel_class;

/* ---- Estimates ---------------------------------------------------------------- */

/*
 * Adds a pixel, by the halvings from disc `first` on. The square of a mean is that of pairs of
 * passes, whose noise is independent.
 */
static void add(class_sums *sums, const rt_radius_trial *t, uint32_t first)
{
    const float *change = t->change + first, *square = t->square + first;
    const double n = t->passes;
    if (t->passes < 2)
        return;
    for (uint32_t l = 0; l < levels; l++)
        sums->bias[l] += ((double)change[l] * change[l] - square[l]) / (n * (n - 1));
    sums->variance += t->variance[first > 0] / n;
}

/*
 * The square of the first difference, fitted to all by least squares: with g they fall as q^l, and
 * the variances of their estimates rise as 4^l.
 */
static double fit(const class_sums *sums, double g)
{
    const double q = pow(2, -2 * g);
    double above = 0, below = 0, power = 1, weight = 1;
    for (uint32_t l = 0; l < levels; l++, power *= q, weight *= 0.25) {
        above += weight * power * sums->bias[l];
        below += weight * power * power;
    }
    return above / below;
}

static const double usual_order = 0.5; /* g */

/*
 * g, from how fast the differences fall, within what edges and smooth light have. Where there is
 * little bias it is lost in noise, and the usual one is taken.
 */
static double order_of(const class_sums *sums)
{
    const double low = 0.25, high = 1, little = 0.05 * sums->variance;
    const double larger = fmax(sums->bias[0], 0) + little,
                 smaller = fmax(sums->bias[1], 0) + little * pow(2, -2 * usual_order);
    return fmin(fmax(0.5 * log2(larger / smaller), low), high);
}

/* The mean of a power of s over the passes. */
static double mean_power(const rt_radius_passes *p, double power)
{
    rt_shrink shrink = {0, 0};
    double sum = 0;
    for (uint32_t i = 0; i < p->count; i++)
        sum += pow(rt_shrink_after(&shrink, i, p->pilot, p->alpha), power);
    return sum / p->count;
}

/* The area of least mean squared error, over that of the first disc. */
static double best_area(const class_sums *sums, const rt_radius_passes *passes)
{
    const double g = order_of(sums), first = fit(sums, g);
    if (!(first > 0 && sums->variance > 0))
        return 1;
    const double bias = first / pow(1 - pow(2, -g), 2) * pow(mean_power(passes, g), 2),
                 variance = sums->variance * mean_power(passes, -1) / passes->count;
    return fmin(fmax(pow(variance / (2 * g * bias), 1 / (2 * g + 1)), area_least), 1);
}

/* ---- Classes ------------------------------------------------------------------ */

static float rank_of(const picture *p, const rt_radius_trial *trials, uint32_t x, uint32_t y)
{
    class_sums around = {{0}, 0};
    for (uint32_t v = y > reach ? y - reach : 0; v <= y + reach && v < p->height; v++)
        for (uint32_t u = x > reach ? x - reach : 0; u <= x + reach && u < p->width; u++)
            add(&around, trials + (size_t)v * p->width + u, p->first);
    return around.variance > 0 ? (float)(fit(&around, usual_order) / around.variance) : 0;
}

static int compare(const void *first, const void *second)
{
    const ranked *a = first, *b = second;
    if (a->rank != b->rank)
        return a->rank < b->rank ? -1 : 1;
    return a->pixel < b->pixel ? -1 : a->pixel > b->pixel;
}

/* Whether the bias of a class is smaller against its noise than that of the one before. */
static int is_below(const class_sums *sums, const class_sums *before)
{
    return fit(sums, usual_order) * before->variance < fit(before, usual_order) * sums->variance;
}

static void join(class_sums *sums, const class_sums *more)
{
    for (uint32_t l = 0; l < levels; l++)
        sums->bias[l] += more->bias[l];
    sums->variance += more->variance;
}

/*
 * Divides pixels in the order of their ranks into classes; returns how many. Bias rises with the
 * rank, so classes where it falls, as noise has it, are joined with those before: isotonic
 * regression by the pooling of adjacent violators.
 */
static size_t classify(pixel_class *classes, const ranked *order, const picture *p,
                       const rt_radius_trial *trials)
{
    const size_t pixels = (size_t)p->width * p->height;
    const size_t most =
        pixels / fewest_in_class < most_classes ? pixels / fewest_in_class + 1 : most_classes;
    size_t count = 0, first = 0;
    for (size_t c = 0; c < most; c++) {
        pixel_class *next = classes + count++;
        *next = (pixel_class){.end = (c + 1) * pixels / most};
        for (size_t i = first; i < next->end; i++)
            add(&next->sums, trials + order[i].pixel, p->first);
        first = next->end;
        for (; count > 1 && is_below(&classes[count - 1].sums, &classes[count - 2].sums); count--) {
            join(&classes[count - 2].sums, &classes[count - 1].sums);
            classes[count - 2].end = classes[count - 1].end;
        }
    }
    return count;
}

/* Multiplies the areas by the root of t, with pixels in the order of their ranks. */
static void choose(float *areas, const ranked *order, const picture *p,
                   const rt_radius_trial *trials)
{
    pixel_class classes[most_classes];
    const size_t count = classify(classes, order, p, trials);
    for (size_t i = 0, pixel = 0; i < count; i++) {
        const float root = (float)sqrt(best_area(&classes[i].sums, p->passes));
        for (; pixel < classes[i].end; pixel++)
            areas[order[pixel].pixel] *= root;
    }
}

/* The areas t of least error, as parts of the disc p->first; order is overwritten. */
static void find_areas(float *areas, ranked *order, const picture *p,
                       const rt_radius_trial *const halves[2])
{
    const uint32_t pixels = p->width * p->height;
    for (uint32_t i = 0; i < pixels; i++)
        areas[i] = 1;
    for (int half = 0; half < 2; half++) {
        for (uint32_t i = 0; i < pixels; i++)
            order[i] = (ranked){rank_of(p, halves[half], i % p->width, i / p->width), i};
        qsort(order, pixels, sizeof *order, compare);
        choose(areas, order, p, halves[1 - half]);
    }
}

/* Where a disc keeps this part of its area, a larger one is looked for. */
static const float kept = 0.5f;

rt_status rt_radius_choose(float *squared, const rt_radius_trial *const halves[2], uint32_t width,
                           uint32_t height, const rt_radius_passes *passes, rt_memory *memory,
                           rt_error *error)
{
    const size_t pixels = (size_t)width * height;
    const float larger = (float)(1u << passes->larger);
    picture p = {width, height, passes, passes->larger};
    float *areas = rt_memory_alloc(memory, pixels, 2 * sizeof *areas + sizeof(ranked),
                                   "the choice of gather radii", error);
    if (!areas)
        return RT_ERROR_MEMORY;
    float *of_larger = areas + pixels;
    ranked *order = (ranked *)(of_larger + pixels);
    find_areas(areas, order, &p, halves);
    if (passes->larger > 0) {
        p.first = 0;
        find_areas(of_larger, order, &p, halves);
        for (size_t i = 0; i < pixels; i++)
            if (areas[i] >= kept)
                areas[i] = fmaxf(areas[i], larger * of_larger[i]);
    }
    for (size_t i = 0; i < pixels; i++)
        squared[i] *= areas[i];
    rt_memory_free(areas);
    return RT_OK;
}
