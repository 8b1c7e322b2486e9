/* warps.c - warps of the unit square to discs, directions, triangles, lenses and filters. */
#include <math.h>

#include "kernels/statistics.h"
#include "statistics/space.h"
#include "support.h"
#include "types.h"

static float rows[most_samples][4];

/* Runs a kernel of a seed, a count, arguments of its own and the output: a row an item. */
static void draw_rows(const char *program, const char *name, uint32_t seed, uint32_t count,
                      const rt_arg *own, cl_uint own_count)
{
    cl_kernel kernel = test_kernel(program, name);
    cl_mem out = test_output(count * sizeof *rows, rows);
    rt_arg args[8] = {RT_ARG(seed), RT_ARG(count)};
    cl_uint used = 2;
    for (cl_uint i = 0; i < own_count; i++)
        args[used++] = own[i];
    args[used++] = (rt_arg)RT_ARG(out);
    test_run(kernel, args, used, count);
    test_read(out, count * sizeof *rows, rows);
    rt_buffer_release(test_device(), out);
    rt_kernel_release(kernel);
}

/* ---- Disc, hemisphere, sphere, triangle ---------------------------------- */

static void draw_disc(const void *setup, uint32_t seed, uint32_t count)
{
    (void)setup;
    draw_rows("sample", "disc", seed, count, NULL, 0);
}

static sampled place_disc(const void *setup, uint32_t i)
{
    const double r = distance(rows[i][0], rows[i][1]);
    (void)setup;
    return (sampled){r, turns_of(rows[i][0], rows[i][1]), rows[i][3] * 2 * PI * r};
}

static double disc(const void *setup, double r, double turn)
{
    (void)setup, (void)turn;
    return 2 * r;
}

static void draw_cosine(const void *setup, uint32_t seed, uint32_t count)
{
    (void)setup;
    draw_rows("sample", "cosine", seed, count, NULL, 0);
}

static sampled place_cosine(const void *setup, uint32_t i)
{
    (void)setup;
    return (sampled){rows[i][2], turns_of(rows[i][0], rows[i][1]), rows[i][3] * 2 * PI};
}

static double cosine(const void *setup, double z, double turn)
{
    (void)setup, (void)turn;
    return 2 * z;
}

static void draw_sphere(const void *setup, uint32_t seed, uint32_t count)
{
    (void)setup;
    draw_rows("sample", "sphere", seed, count, NULL, 0);
}

static sampled place_sphere(const void *setup, uint32_t i)
{
    (void)setup;
    return (sampled){0.5 + 0.5 * rows[i][2], turns_of(rows[i][0], rows[i][1]), rows[i][3] * 4 * PI};
}

static double even(const void *setup, double x, double y)
{
    (void)setup, (void)x, (void)y;
    return 1;
}

/* Edges (2, 0, 0) and (1, 0, 3): the parallelogram has 6 m^2. */
static void draw_triangle(const void *setup, uint32_t seed, uint32_t count)
{
    (void)setup;
    draw_rows("sample", "triangle", seed, count, NULL, 0);
}

static sampled place_triangle(const void *setup, uint32_t i)
{
    const double first = rows[i][0], rest = 1 - first;
    (void)setup;
    return (sampled){first, rest > 0 ? rows[i][1] / rest : 0, rows[i][3] * 6 * rest};
}

static double triangle(const void *setup, double x, double y)
{
    (void)setup, (void)y;
    return 2 * (1 - x);
}

/* ---- Rectangle by solid angle, cap of a sphere ----------------------------- */

typedef struct rectangle {
    float shape[4]; /* x0, y0, width, height */
    float z;
} rectangle;

/* Solid angle of the part of the rectangle's plane around a point, by area. */
static double steepness(const rectangle *r, double x, double y)
{
    const double px = r->shape[0] + x * r->shape[2], py = r->shape[1] + y * r->shape[3];
    const double d2 = px * px + py * py + (double)r->z * r->z;
    return r->z * (double)r->shape[2] * r->shape[3] / (d2 * sqrt(d2));
}

static void draw_rectangle(const void *setup, uint32_t seed, uint32_t count)
{
    const rectangle *r = setup;
    const rt_arg own[] = {RT_ARG(r->shape), RT_ARG(r->z)};
    draw_rows("sample", "rectangle", seed, count, own, 2);
}

static sampled place_rectangle(const void *setup, uint32_t i)
{
    const rectangle *r = setup;
    const double x = rows[i][0] / r->shape[2], y = rows[i][1] / r->shape[3];
    return (sampled){x, y, rows[i][3] * steepness(r, x, y)};
}

static double by_solid_angle(const void *setup, double x, double y)
{
    return steepness(setup, x, y);
}

/* Height of the cone under which the unit sphere is seen from a distance: 1 - cos. */
static double cone_height(double distance)
{
    const double sine2 = 1 / (distance * distance);
    return sine2 / (1 + sqrt(1 - sine2));
}

/*
 * As the viewer above the sphere's centre sees it: 1 - cos of the angle to the axis, and the angle
 * around it.
 */
static void draw_cap(const void *setup, uint32_t seed, uint32_t count)
{
    const float distance = *(const float *)setup, radius = 1, d2 = distance * distance;
    const rt_arg own[] = {RT_ARG(radius), RT_ARG(d2)};
    draw_rows("sample", "cap", seed, count, own, 2);
}

static sampled place_cap(const void *setup, uint32_t i)
{
    const double from = *(const float *)setup, height = cone_height(from);
    const double off2 = (double)rows[i][0] * rows[i][0] + (double)rows[i][1] * rows[i][1];
    const double down = from - rows[i][2], sine2 = off2 / (off2 + down * down);
    const double h = sine2 / (1 + sqrt(1 - sine2)) / height;
    /* The rim of the cap is where float32 knows the angle least. */
    return (sampled){h > 1 && h < 1.002 ? 1 : h, turns_of(rows[i][0], rows[i][1]),
                     rows[i][3] * 2 * PI * height};
}

/* ---- The lens and the pixel -------------------------------------------------- */

typedef struct polygon {
    uint32_t corners;
    float turn;
} polygon;

/* How far the edge is from the centre. */
static double edge_at(const polygon *p, double turn)
{
    const double wedge = (turn - p->turn) * p->corners;
    return cos(PI / p->corners) / cos((wedge - floor(wedge) - 0.5) * 2 * PI / p->corners);
}

static void draw_polygon(const void *setup, uint32_t seed, uint32_t count)
{
    const polygon *p = setup;
    const rt_arg own[] = {RT_ARG(p->corners), RT_ARG(p->turn)};
    draw_rows("sample", "polygon", seed, count, own, 2);
}

static sampled place_polygon(const void *setup, uint32_t i)
{
    const double turn = turns_of(rows[i][0], rows[i][1]);
    return (sampled){distance(rows[i][0], rows[i][1]) / edge_at(setup, turn), turn, NAN};
}

static double in_polygon(const void *setup, double reach, double turn)
{
    const polygon *p = setup;
    const double area = 0.5 * p->corners * sin(2 * PI / p->corners), edge = edge_at(p, turn);
    return 2 * PI * edge * edge * reach / area;
}

/* Mitchell and Netravali 1988, equation 8, B = C = 1/3. */
static double mitchell(double x)
{
    x = fabs(x);
    if (x < 1)
        return (7 * x * x * x - 12 * x * x + 16.0 / 3) / 6;
    return x < 2 ? (-7.0 / 3 * x * x * x + 12 * x * x - 20 * x + 32.0 / 3) / 6 : 0;
}

/* The Gaussian, which is round, by radius and angle; the others on the square of 4 pixels. */
static void draw_filter(const void *setup, uint32_t seed, uint32_t count)
{
    const uint32_t filter = *(const uint32_t *)setup;
    const float own_radius = 0;
    cl_kernel kernel = test_kernel("filter", "sample");
    cl_mem made = test_output(count * sizeof *rows, rows);
    rt_arg args[] = {RT_ARG(filter), RT_ARG(own_radius), RT_ARG(seed), RT_ARG(count), RT_ARG(made)};
    test_run(kernel, args, 5, count);
    test_read(made, count * sizeof *rows, rows);
    rt_buffer_release(test_device(), made);
    rt_kernel_release(kernel);
}

static sampled place_filter(const void *setup, uint32_t i)
{
    const double x = rows[i][0] - 0.5, y = rows[i][1] - 0.5;
    if (*(const uint32_t *)setup == RT_FILTER_GAUSSIAN)
        return (sampled){distance(x, y) / 1.5, turns_of(x, y), NAN};
    return (sampled){(x + 2) / 4, (y + 2) / 4, NAN};
}

static double filter_magnitude(const void *setup, double x, double y)
{
    const double px = 4 * x - 2, py = 4 * y - 2;
    switch (*(const uint32_t *)setup) {
    case RT_FILTER_BOX:
        return fabs(px) < 0.5 && fabs(py) < 0.5;
    case RT_FILTER_TENT:
        return fmax(0, 1 - fabs(px)) * fmax(0, 1 - fabs(py));
    case RT_FILTER_GAUSSIAN:
        return x * exp(-2 * (1.5 * x) * (1.5 * x));
    default:
        return fabs(mitchell(px) * mitchell(py));
    }
}

/* ---- Tables -------------------------------------------------------------------- */

static const method by_disc = {draw_disc, place_disc, disc, 0, 0};
static const method by_cosine = {draw_cosine, place_cosine, cosine, 0, 0};
static const method by_sphere = {draw_sphere, place_sphere, even, 0, 0};
static const method by_triangle = {draw_triangle, place_triangle, triangle, 0, 0};
static const method by_rectangle = {draw_rectangle, place_rectangle, by_solid_angle, 1, 0};
static const method by_cap = {draw_cap, place_cap, even, 0, 0};
static const method by_polygon = {draw_polygon, place_polygon, in_polygon, 0, 0};
static const method by_filter = {draw_filter, place_filter, filter_magnitude, 1, 0};

static const routine routines[] = {
    {"disc", 16, 16, &by_disc, NULL},
    {"cosine hemisphere", 16, 16, &by_cosine, NULL},
    {"sphere", 16, 16, &by_sphere, NULL},
    {"triangle", 16, 16, &by_triangle, NULL},
    {"rectangle by solid angle", 16, 16, &by_rectangle,
     &(const rectangle){{-0.5f, -0.5f, 1, 1}, 1}},
    {"rectangle, close", 16, 16, &by_rectangle, &(const rectangle){{-0.5f, -0.5f, 1, 1}, 0.05f}},
    {"rectangle, from beside", 16, 16, &by_rectangle,
     &(const rectangle){{0.7f, -0.2f, 1, 1}, 0.3f}},
    {"rectangle, over a corner", 16, 16, &by_rectangle,
     &(const rectangle){{0.1f, 0.1f, 1, 1}, 0.1f}},
    {"rectangle, small", 16, 16, &by_rectangle,
     &(const rectangle){{1e-3f, 2e-3f, 1e-3f, 1e-3f}, 2e-3f}},
    {"rectangle, high", 16, 16, &by_rectangle, &(const rectangle){{0.25f, -4, 0.5f, 8}, 0.2f}},
    {"cap of a sphere, close", 16, 16, &by_cap, &(const float){1.001f}},
    {"cap of a sphere, near", 16, 16, &by_cap, &(const float){1.1f}},
    {"cap of a sphere", 16, 16, &by_cap, &(const float){2}},
    {"cap of a sphere, far", 16, 16, &by_cap, &(const float){50}},
    {"lens of 3 blades", 12, 24, &by_polygon, &(const polygon){3, 0.1f}},
    {"lens of 5 blades", 12, 20, &by_polygon, &(const polygon){5, 0}},
    {"box filter", 32, 32, &by_filter, &(const uint32_t){RT_FILTER_BOX}},
    {"tent filter", 24, 24, &by_filter, &(const uint32_t){RT_FILTER_TENT}},
    {"Gaussian filter", 16, 16, &by_filter, &(const uint32_t){RT_FILTER_GAUSSIAN}},
    {"Mitchell filter", 24, 24, &by_filter, &(const uint32_t){RT_FILTER_MITCHELL}},
};

const routine_table map_routines = {routines, sizeof routines / sizeof *routines};
