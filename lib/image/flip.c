/*
 * References: P. Andersson, J. Nilsson, T. Akenine-Moeller, M. Oskarsson, K. Astroem, M. Fairchild,
 * "FLIP: A Difference
 *   Evaluator for Alternating Images", Proceedings of the ACM on Computer Graphics and Interactive
 *     Techniques 3(2),
 *   2020. The sections named below are the paper's; so is the viewer, 0.7 m before a display 0.7 m
 *     and 3840 pixels
 *   wide.
 * IEC 61966-2-1:1999, for the primaries of sRGB; CIE 15, for L*a*b*.
 *
 * The picture is worked on in tiles, so that memory is bounded: each is read with a margin as wide
 * as the filters.
 */
#include "image/flip.h"

#include <math.h>
#include <stdlib.h>

#define PI 3.14159265358979323846
#define PIXELS_PER_DEGREE (0.7 * (3840.0 / 0.7) * PI / 180.0)
#define FEATURE_WIDTH 0.082 /* degrees, section 4.2 */

enum {
    RADIUS = 10, /* of all filters: three deviations of the widest */
    TAPS = 2 * RADIUS + 1,
    TILE = 64,
    WIDE = TILE + 2 * RADIUS /* a tile with its margin */
};

/*
 * A filter along one axis; weights sum to 1, of the derivatives the positive ones to 1 and the
 * negative to -1.
 */
typedef struct taps {
    double weight[TAPS];
} taps;

/* The filters, each a product of one across and one down. */
typedef struct filters {
    taps achromatic, red_green, blue_yellow[2]; /* contrast sensitivity of the eye, section 4.1.1 */
    double blue_yellow_share[2];
    taps smooth, edge, point; /* feature detection, section 4.2: a Gaussian and its derivatives */
} filters;

/*
 * What is made of one of the pictures in a tile; in double, for the root of a small difference of
 * features counts.
 */
typedef struct view {
    double opponent[3][WIDE * WIDE]; /* YCxCz */
    double rows[WIDE * TILE];        /* filtered across, not yet down */
    double part[TILE * TILE];
    double colour[3][TILE * TILE]; /* filtered; then L*a*b* with the Hunt effect */
    double edge[2][TILE * TILE], point[2][TILE * TILE]; /* derivatives across and down */
} view;

/* ---- Filters ------------------------------------------------------------------ */

/*
 * exp(-x^2 / (2 deviation^2)), x and deviation in pixels, with weights that sum to 1; returns their
 * sum before.
 */
static double set_gaussian(taps *out, double deviation)
{
    double weights[TAPS], sum = 0.0;
    for (int i = 0; i < TAPS; i++) {
        double x = (i - RADIUS) / deviation;
        sum += weights[i] = exp(-0.5 * x * x);
    }
    for (int i = 0; i < TAPS; i++)
        out->weight[i] = weights[i] / sum;
    return sum;
}

/* The first or second derivative of a Gaussian within three deviations. */
static void set_derivative(taps *out, double deviation, int order)
{
    double weights[TAPS], positive = 0.0, negative = 0.0;
    for (int i = 0; i < TAPS; i++) {
        double x = (i - RADIUS) / deviation, g = exp(-0.5 * x * x);
        weights[i] = abs(i - RADIUS) > ceil(3.0 * deviation) ? 0.0
                     : order == 1                            ? -x * g
                                                             : (x * x - 1.0) * g;
        positive += fmax(weights[i], 0.0);
        negative -= fmin(weights[i], 0.0);
    }
    for (int i = 0; i < TAPS; i++)
        out->weight[i] = weights[i] / (weights[i] > 0.0 ? positive : negative);
}

/* The deviation in pixels of exp(-pi^2 d^2 / b), d in degrees. */
static double deviation_of(double b)
{
    return sqrt(b / 2.0) / PI * PIXELS_PER_DEGREE;
}

/*
 * Table 1 of the paper: a sqrt(pi / b) exp(-pi^2 d^2 / b); of blue and yellow the sum of two such.
 */
static void set_filters(filters *f)
{
    static const double a[2] = {34.1, 13.5}, b[2] = {0.04, 0.025};
    double share[2], deviation = 0.5 * FEATURE_WIDTH * PIXELS_PER_DEGREE;
    set_gaussian(&f->achromatic, deviation_of(0.0047));
    set_gaussian(&f->red_green, deviation_of(0.0053));
    for (int i = 0; i < 2; i++) {
        double sum = set_gaussian(&f->blue_yellow[i], deviation_of(b[i]));
        share[i] = a[i] * sqrt(PI / b[i]) * sum * sum;
    }
    for (int i = 0; i < 2; i++)
        f->blue_yellow_share[i] = (share[i] / (share[0] + share[1]));
    set_gaussian(&f->smooth, deviation);
    set_derivative(&f->edge, deviation, 1);
    set_derivative(&f->point, deviation, 2);
}

/* Filters a tile with its margin across and down. */
static void convolve(double out[TILE * TILE], const double in[WIDE * WIDE], const taps *across,
                     const taps *down, double rows[WIDE * TILE])
{
    for (int y = 0; y < WIDE; y++) {
        double *row = rows + y * TILE;
        for (int x = 0; x < TILE; x++)
            row[x] = 0.0;
        for (int i = 0; i < TAPS; i++)
            for (int x = 0; x < TILE; x++)
                row[x] += across->weight[i] * in[y * WIDE + x + i];
    }
    for (int y = 0; y < TILE; y++) {
        double *row = out + y * TILE;
        for (int x = 0; x < TILE; x++)
            row[x] = 0.0;
        for (int i = 0; i < TAPS; i++)
            for (int x = 0; x < TILE; x++)
                row[x] += down->weight[i] * rows[(y + i) * TILE + x];
    }
}

/* ---- Colour spaces -------------------------------------------------------------- */

static const double xyz_of_rgb[3][3] = {{0.4123908, 0.3575843, 0.1804808},
                                        {0.2126390, 0.7151687, 0.0721923},
                                        {0.0193308, 0.1191948, 0.9505322}};
static const double rgb_of_xyz[3][3] = {{3.2409699, -1.5373832, -0.4986108},
                                        {-0.9692436, 1.8759675, 0.0415551},
                                        {0.0556301, -0.2039770, 1.0569715}};

/* XYZ by that of white, which is RGB (1, 1, 1). */
static void relative_xyz(double out[3], const double rgb[3])
{
    for (int i = 0; i < 3; i++) {
        const double *m = xyz_of_rgb[i];
        out[i] = (m[0] * rgb[0] + m[1] * rgb[1] + m[2] * rgb[2]) / (m[0] + m[1] + m[2]);
    }
}

/* YCxCz, L*a*b* without its roots: an opponent space that can be filtered. */
static void opponent_of_rgb(double out[3], const double rgb[3])
{
    double xyz[3];
    relative_xyz(xyz, rgb);
    out[0] = 116.0 * xyz[1] - 16.0;
    out[1] = 500.0 * (xyz[0] - xyz[1]);
    out[2] = 200.0 * (xyz[1] - xyz[2]);
}

static double clamp(double value)
{
    return value > 0.0 ? fmin(value, 1.0) : 0.0;
}

/* The inverse, to a colour that a display can show. */
static void rgb_of_opponent(double out[3], const double opponent[3])
{
    double y = (opponent[0] + 16.0) / 116.0;
    double xyz[3] = {y + opponent[1] / 500.0, y, y - opponent[2] / 200.0};
    for (int i = 0; i < 3; i++)
        xyz[i] *= xyz_of_rgb[i][0] + xyz_of_rgb[i][1] + xyz_of_rgb[i][2];
    for (int i = 0; i < 3; i++)
        out[i] = clamp(rgb_of_xyz[i][0] * xyz[0] + rgb_of_xyz[i][1] * xyz[1] +
                       rgb_of_xyz[i][2] * xyz[2]);
}

static double lab_root(double t)
{
    const double delta = 6.0 / 29.0;
    return t > delta * delta * delta ? cbrt(t) : t / (3.0 * delta * delta) + 4.0 / 29.0;
}

/* L*a*b*, whose chroma counts the less the darker it is (the Hunt effect), section 4.1.2. */
static void hunt_lab_of_rgb(double out[3], const double rgb[3])
{
    double xyz[3];
    relative_xyz(xyz, rgb);
    double x = lab_root(xyz[0]), y = lab_root(xyz[1]), z = lab_root(xyz[2]);
    out[0] = 116.0 * y - 16.0;
    out[1] = 0.01 * out[0] * 500.0 * (x - y);
    out[2] = 0.01 * out[0] * 200.0 * (y - z);
}

/* The HyAB distance, to the power that compresses large ones; section 4.1.2. */
static double colour_distance(const double a[3], const double b[3])
{
    return pow(fabs(a[0] - b[0]) + hypot(a[1] - b[1], a[2] - b[2]), 0.7);
}

/* ---- A tile ------------------------------------------------------------------------ */

/* Reads a tile at (x0, y0) with its margin; over the border the picture goes on as its edge is. */
static void read_tile(view *v, const float *rgb, uint32_t width, uint32_t height, uint32_t x0,
                      uint32_t y0, double scale)
{
    for (int j = 0; j < WIDE; j++)
        for (int i = 0; i < WIDE; i++) {
            int64_t x = (int64_t)x0 + i - RADIUS, y = (int64_t)y0 + j - RADIUS;
            x = x < 0 ? 0 : x < width ? x : (int64_t)width - 1;
            y = y < 0 ? 0 : y < height ? y : (int64_t)height - 1;
            const float *pixel = rgb + 3 * ((size_t)y * width + (size_t)x);
            double shown[3] = {clamp(scale * pixel[0]), clamp(scale * pixel[1]),
                               clamp(scale * pixel[2])},
                   opponent[3];
            opponent_of_rgb(opponent, shown);
            for (int c = 0; c < 3; c++)
                v->opponent[c][j * WIDE + i] = opponent[c];
        }
}

/* The colours that the eye resolves at this distance. */
static void see_colours(view *v, const filters *f)
{
    convolve(v->colour[0], v->opponent[0], &f->achromatic, &f->achromatic, v->rows);
    convolve(v->colour[1], v->opponent[1], &f->red_green, &f->red_green, v->rows);
    convolve(v->colour[2], v->opponent[2], &f->blue_yellow[0], &f->blue_yellow[0], v->rows);
    convolve(v->part, v->opponent[2], &f->blue_yellow[1], &f->blue_yellow[1], v->rows);
    for (int i = 0; i < TILE * TILE; i++) {
        double mixed =
            f->blue_yellow_share[0] * v->colour[2][i] + f->blue_yellow_share[1] * v->part[i];
        double opponent[3] = {v->colour[0][i], v->colour[1][i], mixed}, rgb[3], lab[3];
        rgb_of_opponent(rgb, opponent);
        hunt_lab_of_rgb(lab, rgb);
        for (int c = 0; c < 3; c++)
            v->colour[c][i] = lab[c];
    }
}

/*
 * Edges and points of the achromatic channel; that it is 116 times too large is undone where they
 * are compared.
 */
static void see_features(view *v, const filters *f)
{
    convolve(v->edge[0], v->opponent[0], &f->edge, &f->smooth, v->rows);
    convolve(v->edge[1], v->opponent[0], &f->smooth, &f->edge, v->rows);
    convolve(v->point[0], v->opponent[0], &f->point, &f->smooth, v->rows);
    convolve(v->point[1], v->opponent[0], &f->smooth, &f->point, v->rows);
}

static double feature_difference(double a[2][TILE * TILE], double b[2][TILE * TILE], int i)
{
    return fabs(hypot(a[0][i], a[1][i]) - hypot(b[0][i], b[1][i])) / 116.0;
}

/* The difference of a pixel, section 4.3: that of colours, raised where features differ. */
static double pixel_difference(view v[2], int i, double largest)
{
    double a[3] = {v[0].colour[0][i], v[0].colour[1][i], v[0].colour[2][i]};
    double b[3] = {v[1].colour[0][i], v[1].colour[1][i], v[1].colour[2][i]};
    /* Distances up to 0.4 of the largest fill 0 to 0.95. */
    double distance = colour_distance(a, b), knee = 0.4 * largest;
    double colour = distance < knee ? 0.95 * distance / knee
                                    : 0.95 + 0.05 * (distance - knee) / (largest - knee);
    double edge = feature_difference(v[0].edge, v[1].edge, i),
           point = feature_difference(v[0].point, v[1].point, i);
    return pow(colour, 1.0 - sqrt(fmax(edge, point) / sqrt(2.0)));
}

/* The largest distance of two colours: that of green and blue. */
static double largest_distance(void)
{
    static const double green[3] = {0.0, 1.0, 0.0}, blue[3] = {0.0, 0.0, 1.0};
    double a[3], b[3];
    hunt_lab_of_rgb(a, green);
    hunt_lab_of_rgb(b, blue);
    return colour_distance(a, b);
}

rt_status rt_flip(double *out, const float *a, const float *b, uint32_t width, uint32_t height,
                  double exposure, rt_error *error)
{
    const float *pictures[2] = {a, b};
    double sum = 0.0, scale = exp2(exposure), largest = largest_distance();
    filters f;
    view *views = malloc(2 * sizeof *views);
    if (!views)
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory: two tiles of %dx%d pixels", WIDE,
                       WIDE);
    set_filters(&f);
    for (uint32_t y0 = 0; y0 < height; y0 += TILE)
        for (uint32_t x0 = 0; x0 < width; x0 += TILE) {
            for (int p = 0; p < 2; p++) {
                read_tile(&views[p], pictures[p], width, height, x0, y0, scale);
                see_colours(&views[p], &f);
                see_features(&views[p], &f);
            }
            for (uint32_t y = 0; y < TILE && y0 + y < height; y++)
                for (uint32_t x = 0; x < TILE && x0 + x < width; x++)
                    sum += pixel_difference(views, (int)(y * TILE + x), largest);
        }
    free(views);
    *out = sum / ((double)width * height);
    return RT_OK;
}
