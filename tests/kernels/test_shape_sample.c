/*
 * test_shape_sample.c - points chosen on shapes: they lie on the surface, and their densities give
 * the areas of its parts back, bin by bin.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/shape_check.h"
#include "kernels/statistics.h"
#include "render/renderer.h"
#include "support.h"

enum { bins = 8, fine = 24, samples = 40000 };
static const double pi = 3.14159265358979323846;

/* ---- Each kind --------------------------------------------------------------- */

enum { parts_max = 6 };

/*
 * Of each kind: the number of its parts, each of which has u and v for itself; the part with this
 * unit normal in object space; and the point of a part at u, v.
 */
static int one_part(const reference_shape *shape)
{
    (void)shape;
    return 1;
}

static int first_part(const double n[3])
{
    (void)n;
    return 0;
}

#define ellipsoid_parts one_part
#define ellipsoid_part_of first_part
static void ellipsoid_point(const reference_shape *shape, int part, double u, double v, double p[3])
{
    (void)shape, (void)part;
    p[0] = sin(pi * v) * cos(2 * pi * u);
    p[1] = -cos(pi * v);
    p[2] = -sin(pi * v) * sin(2 * pi * u);
}

static void ring_point(double r, double z, double u, double p[3])
{
    p[0] = r * cos(2 * pi * u);
    p[1] = r * sin(2 * pi * u);
    p[2] = z;
}

#define disc_parts one_part
#define disc_part_of first_part
static void disc_point(const reference_shape *shape, int part, double u, double v, double p[3])
{
    (void)part;
    ring_point(shape->p + (1 - shape->p) * v, 0, u, p);
}

/* Of a cylinder or cone: the side, and the caps. */
enum { side, base, top };

static int frustum_parts(const reference_shape *shape)
{
    return shape->caps ? 3 : 1;
}

static int frustum_part_of(const double n[3])
{
    return n[2] < -0.9 ? base : n[2] > 0.9 ? top : side;
}

static void frustum_point(double end, int part, double u, double v, double p[3])
{
    if (part == side)
        ring_point(1 - (1 - end) * v, v, u, p);
    else
        ring_point(part == top ? v * end : v, part == top, u, p);
}

#define cylinder_parts frustum_parts
#define cylinder_part_of frustum_part_of
static void cylinder_point(const reference_shape *shape, int part, double u, double v, double p[3])
{
    (void)shape;
    frustum_point(1, part, u, v, p);
}

#define cone_parts frustum_parts
#define cone_part_of frustum_part_of
static void cone_point(const reference_shape *shape, int part, double u, double v, double p[3])
{
    frustum_point(shape->p, part, u, v, p);
}

#define torus_parts one_part
#define torus_part_of first_part
static void torus_point(const reference_shape *shape, int part, double u, double v, double p[3])
{
    (void)part;
    ring_point(1 + shape->p * cos(2 * pi * v), shape->p * sin(2 * pi * v), u, p);
}

static int box_parts(const reference_shape *shape)
{
    (void)shape;
    return 6;
}

static int box_part_of(const double n[3])
{
    const int axis = fabs(n[0]) > 0.5 ? 0 : fabs(n[1]) > 0.5 ? 1 : 2;
    return 2 * axis + (n[axis] > 0);
}

static void box_point(const reference_shape *shape, int part, double u, double v, double p[3])
{
    const int axis = part / 2, side = part % 2 ? 1 : -1;
    (void)shape;
    p[axis] = side;
    p[axis == 0 ? 2 : 0] = (axis == 0 ? -side : side) * (2 * u - 1);
    p[axis == 1 ? 2 : 1] = (axis == 1 ? -1 : 1) * (2 * v - 1);
}

#define KIND_PARTS(KIND, name, number)                                                             \
    [RT_SHAPE_##KIND] = {name##_parts, name##_part_of, name##_point},
static const struct {
    int (*parts)(const reference_shape *shape);
    int (*part_of)(const double normal[3]);
    void (*point)(const reference_shape *shape, int part, double u, double v, double p[3]);
} kinds[] = {RT_PLACED_SHAPES(KIND_PARTS)};

/* The point of a part at u, v, in the world. */
static void world_point(const reference_shape *shape, int part, double u, double v, double out[3])
{
    double p[3];
    kinds[shape->kind].point(shape, part, u, v, p);
    for (int i = 0; i < 3; i++)
        out[i] = shape->to_world.m[i][0] * p[0] + shape->to_world.m[i][1] * p[1] +
                 shape->to_world.m[i][2] * p[2];
}

static int part_of(const reference_shape *shape, const float normal[3])
{
    double n[3] = {0}, length;
    for (int j = 0; j < 3; j++)
        for (int i = 0; i < 3; i++)
            n[j] += shape->to_world.m[i][j] * normal[i];
    length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int j = 0; j < 3; j++)
        n[j] /= length;
    return kinds[shape->kind].part_of(n);
}

/* ---- Areas ------------------------------------------------------------------- */

/* The area of a bin, by central differences at the middles of a fine grid. */
static double bin_area(const reference_shape *shape, int part, int bin_u, int bin_v)
{
    const double h = 1e-5, width = 1.0 / (bins * fine);
    double area = 0;
    for (int i = 0; i < fine; i++)
        for (int j = 0; j < fine; j++) {
            const double u = (bin_u * fine + i + 0.5) * width, v = (bin_v * fine + j + 0.5) * width;
            double a[3], b[3], c[3], d[3], square = 0;
            world_point(shape, part, u - h, v, a);
            world_point(shape, part, u + h, v, b);
            world_point(shape, part, u, v - h, c);
            world_point(shape, part, u, v + h, d);
            for (int k = 0; k < 3; k++) {
                const int k1 = (k + 1) % 3, k2 = (k + 2) % 3;
                const double x =
                    (b[k1] - a[k1]) * (d[k2] - c[k2]) - (b[k2] - a[k2]) * (d[k1] - c[k1]);
                square += x * x;
            }
            area += sqrt(square) / (4 * h * h) * width * width;
        }
    return area;
}

typedef struct points {
    float positions[samples][4], normals[samples][4], parameters[samples][2];
} points;

/* Chooses points of the shape, one in each cell of a grid of u. */
static points *choose(const reference_shape *shape, uint64_t seed)
{
    static float u[samples][2];
    const int across = 200;
    rays_stream stream = {seed};
    points *out = malloc(sizeof *out);
    rt_scene *scene = shape_scene(shape);
    rt_renderer *renderer = rays_renderer(scene, RT_ACCEL_BVH);
    for (int i = 0; i < samples; i++) {
        u[i][0] =
            fminf(((float)(i % across) + rays_uniform(&stream)) / (float)across, 0x1.fffffep-1f);
        u[i][1] = fminf(((float)(i / across) + rays_uniform(&stream)) / (float)(samples / across),
                        0x1.fffffep-1f);
    }
    cl_mem in = test_buffer(sizeof u, u), positions = test_buffer(sizeof out->positions, NULL);
    cl_mem normals = test_buffer(sizeof out->normals, NULL),
           parameters = test_buffer(sizeof out->parameters, NULL);
    cl_kernel kernel = test_kernel("shape_sample", "sample_points");
    const cl_uint n = samples;
    const rt_arg args[] = {RT_ARG(renderer->scene), RT_ARG(in),      RT_ARG(n),
                           RT_ARG(positions),       RT_ARG(normals), RT_ARG(parameters)};
    test_run(kernel, args, 6, samples);
    test_read(positions, sizeof out->positions, out->positions);
    test_read(normals, sizeof out->normals, out->normals);
    test_read(parameters, sizeof out->parameters, out->parameters);
    rt_kernel_release(kernel);
    rt_buffer_release(test_device(), in);
    rt_buffer_release(test_device(), positions);
    rt_buffer_release(test_device(), normals);
    rt_buffer_release(test_device(), parameters);
    rt_renderer_destroy(renderer);
    rt_scene_destroy(scene);
    return out;
}

/* Each point is met by a ray that falls on it along its normal, with the same normal. */
static void expect_on_surface(const reference_shape *shape, const float position[4],
                              const float normal[4])
{
    rt_ray ray = {.t_min = 0, .t_max = INFINITY};
    const float back = 0.01f * shape_places[1].size;
    double n[3];
    for (int i = 0; i < 3; i++) {
        ray.origin[i] = position[i] + back * normal[i];
        ray.direction[i] = -normal[i];
    }
    const reference_hit hit = reference_nearest(shape, 1e-5, 1e-5, &ray);
    assert_true(fabs(hit.t - back) <= 0.02 * back);
    reference_normal(shape, hit.normal, n);
    for (int i = 0; i < 3; i++)
        assert_true(fabs(n[i] - normal[i]) <= 2e-3);
}

static void expect_areas(const reference_shape *shape, const points *chosen)
{
    static double sums[parts_max][bins][bins], squares[parts_max][bins][bins];
    const int parts = kinds[shape->kind].parts(shape);
    memset(sums, 0, sizeof sums);
    memset(squares, 0, sizeof squares);
    for (int i = 0; i < samples; i++) {
        const int part = part_of(shape, chosen->normals[i]);
        const int u = (int)fmin(bins - 1, chosen->parameters[i][0] * bins);
        const int v = (int)fmin(bins - 1, chosen->parameters[i][1] * bins);
        const double weight = 1.0 / (samples * (double)chosen->positions[i][3]);
        assert_true(fabs(chosen->positions[i][3] / chosen->normals[i][3] - 1) < 1e-3);
        sums[part][u][v] += weight;
        squares[part][u][v] += weight * weight;
    }
    for (int part = 0; part < parts; part++)
        for (int u = 0; u < bins; u++)
            for (int v = 0; v < bins; v++) {
                const double area = bin_area(shape, part, u, v);
                const double off = fmax(0, fabs(sums[part][u][v] - area) - 1e-3 * area);
                expect_deviate(off > 0 ? off / sqrt(squares[part][u][v]) : 0, "area of a bin");
            }
}

/*
 * The deviations are those of independent points; as the points are stratified, their own are
 * smaller.
 */
static void points_have_their_density(void **state)
{
    (void)state;
    shape_expect_all_kinds();
    rays_stream stream = {3};
    for (size_t kind = 0; kind < shape_kind_count; kind++) {
        const reference_shape shape = shape_placed(&stream, kind, 1);
        points *chosen = choose(&shape, test_seed(70 + (uint32_t)kind));
        if (shape.p != 0.01f)
            for (int i = 0; i < samples; i += 37)
                expect_on_surface(&shape, chosen->positions[i], chosen->normals[i]);
        expect_areas(&shape, chosen);
        free(chosen);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        statistical_test(points_have_their_density),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
