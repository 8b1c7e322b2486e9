/*
 * test_unbiased.c - density estimates of uniform fields have the right mean, through the search on
 * the host and the sum on the device, for all kernels and by every rule that ends a search.
 *
 * A field is a number of photons laid down uniformly and independently on a unit square that
 * repeats in both directions (by copies around it), so that no disc meets an edge. The fields lie
 * far apart in one map. The mean over a field's gather points is one independent estimate, and the
 * standard error comes from the scatter of the fields. Where the radius is that of the k-th of n
 * photons, the share of the area inside has the distribution Beta(k, n - k + 1), so that (k - 1) /
 * share has the mean n: the truth is known exactly.
 */
#include "support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/statistics.h"
#include "lib/photon/points.h"
#include "photon/gather.h"

enum { fields = 100, points_a_field = 1000, estimates = fields * points_a_field };

/* copies reach so far beyond the square; no disc is larger */
static const float margin = 0.25f;
static const float apart = 4; /* distance of the fields */
static const float cone_k = 1.1f;

static const char *const kernel_names[] = {"epanechnikov", "box", "cone", "gaussian", "silverman"};
enum { kernels = sizeof kernel_names / sizeof *kernel_names };

/*
 * A map of all fields, n photons in each square, of which one in `facing` faces the gather points.
 */
static void lay_down(rt_photon_list *map, int n, int facing)
{
    points_stream stream = {test_seed(12)};
    map->emitted = 1;
    map->capacity = (size_t)fields * n * 9;
    map->photons = calloc(map->capacity, sizeof *map->photons);
    assert_non_null(map->photons);
    for (int field = 0; field < fields; field++)
        for (int i = 0; i < n; i++) {
            float x = points_uniform(&stream), z = points_uniform(&stream);
            for (int copy = 0; copy < 9; copy++) {
                float cx = x + (float)(copy % 3 - 1), cz = z + (float)(copy / 3 - 1);
                if (cx < -margin || cx > 1 + margin || cz < -margin || cz > 1 + margin)
                    continue;
                rt_photon *p = map->photons + map->count++;
                p->position[0] = cx;
                p->position[1] = apart * (float)field;
                p->position[2] = cz;
                p->shading = 1;
                p->normal[1] = i % facing == 0 ? 1.0f : -1.0f;
                p->flux[0] = p->flux[1] = p->flux[2] = 1;
            }
        }
}

/* Takes out the photons beyond x = 1. */
static void cut_off(rt_photon_list *map)
{
    size_t kept = 0;
    for (size_t i = 0; i < map->count; i++)
        if (map->photons[i].position[0] <= 1)
            map->photons[kept++] = map->photons[i];
    map->count = kept;
}

static rt_gather_point *make_points(int at_edge)
{
    points_stream stream = {test_seed(99)};
    rt_gather_point *points = calloc(estimates, sizeof *points);
    assert_non_null(points);
    for (int i = 0; i < estimates; i++) {
        points[i].position[0] = at_edge ? 1 : points_uniform(&stream);
        points[i].position[1] = apart * (float)(i / points_a_field);
        points[i].position[2] = points_uniform(&stream);
        points[i].normal[1] = 1;
        points[i].weight[0] = points[i].weight[1] = points[i].weight[2] = 1;
        points[i].pixel = (rt_u32)i;
    }
    return points;
}

/* The mean of the fields' estimated densities, and its standard error. */
static void estimate(const rt_photon_list *map, const rt_gather_options *options, int at_edge,
                     double *mean, double *error_of_mean)
{
    static const char *const programs[] = {"gather_neighbours", "gather_tree"};
    const char *program = programs[options->search];
    rt_gather_point *points = make_points(at_edge);
    rt_gather_disc *discs = calloc(estimates, sizeof *discs);
    rt_gatherer *gatherer = NULL;
    cl_kernel kernel = NULL;
    cl_mem buffer = test_buffer(estimates * sizeof *points, points);
    rt_error error;
    double sum = 0, squares = 0;

    assert_non_null(discs);
    expect_ok(rt_device_kernel(test_device(), &kernel, program, program, NULL, &error), &error);
    expect_ok(rt_gatherer_create(&gatherer, test_device(), kernel, map, options, &error), &error);
    size_t batch = rt_gatherer_capacity(gatherer);
    for (size_t first = 0; first < estimates; first += batch) {
        size_t count = estimates - first < batch ? estimates - first : batch;
        expect_ok(rt_gatherer_add(gatherer, buffer, first, count, discs + first, &error), &error);
    }
    test_read(buffer, estimates * sizeof *points, points);
    for (int field = 0; field < fields; field++) {
        double one = 0;
        for (int i = field * points_a_field; i < (field + 1) * points_a_field; i++) {
            assert_true(discs[i].squared_radius < margin * margin);
            one += points[i].radiance[1] * 3.14159265358979323846 / points_a_field;
        }
        sum += one;
        squares += one * one;
    }
    *mean = sum / fields;
    *error_of_mean = sqrt((squares / fields - *mean * *mean) / (fields - 1));
    rt_gatherer_destroy(gatherer);
    rt_kernel_release(kernel);
    rt_buffer_release(buffer);
    free(points);
    free(discs);
}

/* Every kernel's mean is `truth`; a box that counts the k-th photon as well would be caught. */
static void check(const rt_photon_list *map, uint32_t k, float max_radius, int on_device,
                  double truth)
{
    /*
     * The kernels are evaluated by the same function in both searches, and the tree of FLANN is
     * slow to build.
     */
    for (uint32_t density = 0; density < (on_device ? kernels : 2u); density++) {
        rt_gather_options options = {k, max_radius, density, cone_k, RT_AREA_DISC, on_device};
        double mean, sigma;
        estimate(map, &options, 0, &mean, &sigma);
        print_message("%s, k %u, radius %g, %s: %.3f of %.0f, %+.2f standard errors of %.4f %%\n",
                      on_device ? "device" : "FLANN", (unsigned)k, max_radius,
                      kernel_names[density], mean, truth, (mean - truth) / sigma,
                      100 * sigma / truth);
        chance_compare(chance_of_student((mean - truth) / sigma, fields - 1),
                       "%s, k %u: %g, should be %g, +- %g", kernel_names[density], (unsigned)k,
                       mean, truth, sigma);
        if (k > 0 && max_radius == 0 && density == RT_DENSITY_BOX && truth > 1000)
            assert_true(truth / (k - 1) > 6 * sigma);
    }
}

static void nearest_photons_give_the_true_density(void **state)
{
    enum { n = 4000 };
    static const uint32_t ks[] = {5, 10, 50, 500};
    rt_photon_list map = {0};
    (void)state;
    lay_down(&map, n, 1);
    for (size_t i = 0; i < sizeof ks / sizeof *ks; i++)
        for (int on_device = 0; on_device < 2; on_device++)
            check(&map, ks[i], 0, on_device, n);
    rt_photon_list_clear(&map);
}

static void a_limit_on_the_radius_gives_the_true_density(void **state)
{
    enum { n = 4000, k = 50 };
    rt_photon_list map = {0};
    (void)state;
    lay_down(&map, n, 1);
    /* The expected number inside is 48: about half of the searches end at the limit. */
    for (int on_device = 0; on_device < 2; on_device++)
        check(&map, k, sqrtf(48 / (3.14159265f * n)), on_device, n);
    rt_photon_list_clear(&map);
}

static void a_fixed_radius_gives_the_true_density(void **state)
{
    enum { n = 4000 };
    static const float inside[] = {2, 48, 600};
    rt_photon_list map = {0};
    (void)state;
    lay_down(&map, n, 1);
    for (size_t i = 0; i < sizeof inside / sizeof *inside; i++)
        check(&map, 0, sqrtf(inside[i] / (3.14159265f * n)), 1, n);
    rt_photon_list_clear(&map);
}

/*
 * Estimates by the hull, anywhere in the fields and at the edge that photons beyond x = 1 would
 * have.
 */
static void the_hull_gives_the_true_density_at_edges_too(void **state)
{
    enum { n = 4000, k = 50 };
    static const rt_gather_options hull = {k, 0, RT_DENSITY_BOX, 1.1f, RT_AREA_HULL, 0};
    rt_gather_options disc = hull;
    double mean, sigma;
    rt_photon_list map = {0};
    (void)state;
    lay_down(&map, n, 1);
    estimate(&map, &hull, 0, &mean, &sigma);
    print_message("hull inside: %.4f of the truth, sigma %.4f\n", mean / n, sigma / n);
    expect_close(mean / n, 1, 0.01, "hull inside");
    cut_off(&map);
    estimate(&map, &hull, 1, &mean, &sigma);
    print_message("hull at the edge: %.4f of the truth, sigma %.4f\n", mean / n, sigma / n);
    expect_close(mean / n, 1, 0.03, "hull at the edge");
    disc.area = RT_AREA_DISC;
    estimate(&map, &disc, 1, &mean, &sigma);
    print_message("disc at the edge: %.4f of the truth\n", mean / n);
    expect_close(mean / n, 0.5, 0.02, "disc at the edge");
    rt_photon_list_clear(&map);
}

static void photons_that_face_elsewhere_leave_the_density_true(void **state)
{
    enum { n = 4000, k = 10, facing = 25 };
    rt_photon_list map = {0};
    (void)state;
    /* With few that fit, nearly all searches end at the most photons looked at. */
    lay_down(&map, n, facing);
    for (int on_device = 0; on_device < 2; on_device++)
        check(&map, k, 0, on_device, n / facing);
    rt_photon_list_clear(&map);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        statistical_test(nearest_photons_give_the_true_density),
        statistical_test(a_limit_on_the_radius_gives_the_true_density),
        statistical_test(a_fixed_radius_gives_the_true_density),
        statistical_test(the_hull_gives_the_true_density_at_edges_too),
        statistical_test(photons_that_face_elsewhere_leave_the_density_true),
    };
    return cmocka_run_group_tests_name("lib/photon/unbiased", tests, NULL, NULL);
}
