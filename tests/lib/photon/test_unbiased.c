/*
 * test_unbiased.c - density estimates of uniform fields have the right mean, through the search on
 * the host and the sum on the device, for all kernels and by every rule that ends a search.
 *
 * A field is a number of photons laid down uniformly and independently on a unit square that
 * repeats in both directions (by copies around it), so that no disc meets an edge. The fields lie
 * far apart in one map. The mean over a field's gather points is one independent estimate, and the
 * standard error comes from the scatter of the fields. Where the radius is that of the k-th of n
 * photons, the share of the area inside has the distribution Beta(k, n - k + 1), so that (k - 1) /
 * share has the mean n, and the exact value is known.
 */
#include "support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/statistics.h"
#include "lib/photon/points.h"
#include "photon/gather.h"

/*
 * Gather points of all fields: enough that a box kernel which counted the k-th of 500 photons would
 * be off by more than 6 standard errors, and one of 50 or fewer by more than 20.
 */
enum { fields = 64, points_of_discs = 250 * fields };
static const float margin_of_small_discs = 0.1f, margin_of_large_discs = 0.25f;

static const float apart = 4; /* distance of the fields */
static const float cone_k = 1.1f;

static const char *const kernel_names[] = {"epanechnikov", "box", "cone", "gaussian", "silverman"};
enum { kernels = sizeof kernel_names / sizeof *kernel_names };

/* Fields, with copies of their photons that reach `margin` beyond the square. */
typedef struct field_map {
    rt_photon_list photons;
    float margin; /* no disc is larger */
} field_map;

/* All fields, n photons in each square, of which one in `facing` faces the gather points. */
static void lay_down(field_map *map, int n, int facing, float margin)
{
    points_stream stream = {test_seed(12)};
    const float reach = 1 + margin;
    *map = (field_map){.margin = margin};
    rt_photon_list *list = &map->photons;
    list->emitted = 1;
    list->capacity = (size_t)fields * n * 9;
    list->photons = calloc(list->capacity, sizeof *list->photons);
    assert_non_null(list->photons);
    for (int field = 0; field < fields; field++)
        for (int i = 0; i < n; i++) {
            float x = points_uniform(&stream), z = points_uniform(&stream);
            for (int copy = 0; copy < 9; copy++) {
                float cx = x + (float)(copy % 3 - 1), cz = z + (float)(copy / 3 - 1);
                if (cx < -margin || cx > reach || cz < -margin || cz > reach)
                    continue;
                rt_photon *p = list->photons + list->count++;
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
static void cut_off(field_map *map)
{
    size_t kept = 0;
    rt_photon_list *list = &map->photons;
    for (size_t i = 0; i < list->count; i++)
        if (list->photons[i].position[0] <= 1)
            list->photons[kept++] = list->photons[i];
    list->count = kept;
}

static rt_gather_point *make_points(int count, int at_edge)
{
    points_stream stream = {test_seed(99)};
    rt_gather_point *points = calloc((size_t)count, sizeof *points);
    assert_non_null(points);
    for (int i = 0; i < count; i++) {
        points[i].position[0] = at_edge ? 1 : points_uniform(&stream);
        points[i].position[1] = apart * (float)(i / (count / fields));
        points[i].position[2] = points_uniform(&stream);
        points[i].normal[1] = 1;
        points[i].weight[0] = points[i].weight[1] = points[i].weight[2] = 1;
        points[i].pixel = (rt_u32)i;
    }
    return points;
}

/* A map made ready for one search. */
typedef struct prepared {
    const field_map *map;
    cl_kernel kernel;
    rt_gatherer *gatherer;
    int points; /* gather points of all fields */
} prepared;

static void prepare(prepared *p, const field_map *map, const rt_gather_options *options, int points)
{
    const char *program = rt_gather_kernel_name(options->search, 0);
    rt_error error;
    *p = (prepared){.map = map, .points = points};
    expect_ok(rt_device_kernel(test_device(), &p->kernel, program, program, NULL, &error), &error);
    expect_ok(rt_gatherer_create(&p->gatherer, test_device(), p->kernel, &map->photons, options,
                                 NULL, &error),
              &error);
}

static void release(prepared *p)
{
    rt_gatherer_destroy(p->gatherer);
    rt_kernel_release(p->kernel);
}

/* Adds to copies of the points `first` and those after it by each of the density kernels. */
static void gather_batch(const prepared *p, const uint32_t *densities, int count,
                         const cl_mem *copies, size_t first, rt_gather_disc *discs)
{
    const size_t batch = rt_gatherer_capacity(p->gatherer), left = (size_t)p->points - first,
                 size = left < batch ? left : batch;
    rt_error error;
    for (int i = 0; i < count; i++) {
        rt_gatherer_set_density(p->gatherer, densities[i], cone_k);
        expect_ok(i == 0
                      ? rt_gatherer_add(p->gatherer, copies[i], first, size, discs + first, &error)
                      : rt_gatherer_add_again(p->gatherer, copies[i], first, size, &error),
                  &error);
    }
}

/*
 * Gathers at points by each of the density kernels, and expects discs that the map holds whole.
 * Sets results[i] to the points of kernel i, to be freed.
 */
static void gather(const prepared *p, int at_edge, const uint32_t *densities, int count,
                   rt_gather_point **results)
{
    const size_t bytes = (size_t)p->points * sizeof **results, all = (size_t)p->points;
    rt_gather_disc *discs = calloc(all, sizeof *discs);
    cl_mem copies[kernels];
    assert_non_null(discs);
    for (int i = 0; i < count; i++) {
        results[i] = make_points(p->points, at_edge);
        copies[i] = test_buffer(bytes, results[i]);
    }
    for (size_t first = 0; first < all; first += rt_gatherer_capacity(p->gatherer))
        gather_batch(p, densities, count, copies, first, discs);
    for (size_t i = 0; i < all; i++)
        assert_true(discs[i].squared_radius < p->map->margin * p->map->margin);
    for (int i = 0; i < count; i++) {
        test_read(copies[i], bytes, results[i]);
        rt_buffer_release(test_device(), copies[i]);
    }
    free(discs);
}

/* The mean of the fields' estimated densities, and its standard error. */
static void estimate(const prepared *p, const rt_gather_point *points, double *mean,
                     double *error_of_mean)
{
    const int each = p->points / fields;
    double sum = 0, squares = 0;
    for (int field = 0; field < fields; field++) {
        double one = 0;
        for (int i = field * each; i < (field + 1) * each; i++)
            one += points[i].radiance[1] * 3.14159265358979323846 / each;
        sum += one;
        squares += one * one;
    }
    *mean = sum / fields;
    *error_of_mean = sqrt((squares / fields - *mean * *mean) / (fields - 1));
}

/*
 * Every kernel's mean is `exact`; a box kernel that counted the k-th photon as well would fail. The
 * kernels are evaluated by the same function in both searches: two of them do for FLANN.
 */
static void check(const field_map *map, int points, uint32_t k, float max_radius, int on_device,
                  double exact)
{
    const rt_gather_options options = {k, max_radius, 0, cone_k, RT_AREA_DISC, on_device, 0, NULL};
    static const uint32_t densities[kernels] = {0, 1, 2, 3, 4};
    const int count = on_device ? kernels : 2;
    rt_gather_point *results[kernels];
    prepared p;
    prepare(&p, map, &options, points);
    gather(&p, 0, densities, count, results);
    for (int density = 0; density < count; density++) {
        double mean, sigma;
        estimate(&p, results[density], &mean, &sigma);
        free(results[density]);
        print_message("%s, k %u, radius %g, %s: %.3f of %.0f, %+.2f standard errors of %.4f %%\n",
                      on_device ? "device" : "FLANN", (unsigned)k, max_radius,
                      kernel_names[density], mean, exact, (mean - exact) / sigma,
                      100 * sigma / exact);
        chance_compare(chance_of_student((mean - exact) / sigma, fields - 1),
                       "%s, k %u: %g, should be %g, +- %g", kernel_names[density], (unsigned)k,
                       mean, exact, sigma);
        if (k > 0 && max_radius == 0 && density == RT_DENSITY_BOX && exact > 1000)
            assert_true(exact / (k - 1) > 6 * sigma);
    }
    release(&p);
}

static void nearest_photons_give_the_true_density(void **state)
{
    enum { n = 4000 };
    static const uint32_t ks[] = {5, 10, 50};
    field_map map;
    (void)state;
    lay_down(&map, n, 1, margin_of_small_discs);
    for (size_t i = 0; i < sizeof ks / sizeof *ks; i++)
        for (int on_device = 0; on_device < 2; on_device++)
            check(&map, points_of_discs, ks[i], 0, on_device, n);
    rt_photon_list_clear(&map.photons);
    lay_down(&map, n, 1, margin_of_large_discs);
    for (int on_device = 0; on_device < 2; on_device++)
        check(&map, points_of_discs, 500, 0, on_device, n);
    rt_photon_list_clear(&map.photons);
}

/* The radius of a disc that holds so many of n photons on average. */
static float radius_of(float inside, int n)
{
    return sqrtf(inside / (3.14159265f * (float)n));
}

static void a_limit_on_the_radius_gives_the_true_density(void **state)
{
    enum { n = 4000, k = 50 };
    field_map map;
    (void)state;
    lay_down(&map, n, 1, margin_of_small_discs);
    /* The expected number inside is 48: about half of the searches end at the limit. */
    for (int on_device = 0; on_device < 2; on_device++)
        check(&map, points_of_discs, k, radius_of(48, n), on_device, n);
    rt_photon_list_clear(&map.photons);
}

static void a_fixed_radius_gives_the_true_density(void **state)
{
    enum { n = 4000 };
    field_map map;
    (void)state;
    lay_down(&map, n, 1, margin_of_small_discs);
    check(&map, points_of_discs, 0, radius_of(2, n), 1, n);
    check(&map, points_of_discs, 0, radius_of(48, n), 1, n);
    rt_photon_list_clear(&map.photons);
    lay_down(&map, n, 1, margin_of_large_discs);
    check(&map, points_of_discs, 0, radius_of(600, n), 1, n);
    rt_photon_list_clear(&map.photons);
}

/* The mean of one estimate with the box kernel, as a share of n. */
static double share(const field_map *map, rt_area area, uint32_t k, int at_edge, int n,
                    const char *what)
{
    const rt_gather_options options = {k, 0,   RT_DENSITY_BOX, cone_k, area, RT_SEARCH_NEIGHBOURS,
                                       0, NULL};
    const uint32_t box = RT_DENSITY_BOX;
    rt_gather_point *points;
    double mean, sigma;
    prepared p;
    prepare(&p, map, &options, points_of_discs);
    gather(&p, at_edge, &box, 1, &points);
    estimate(&p, points, &mean, &sigma);
    free(points);
    release(&p);
    print_message("%s: %.4f of the exact value, sigma %.4f\n", what, mean / n, sigma / n);
    return mean / n;
}

/*
 * Estimates by the hull, anywhere in the fields and at the edge that photons beyond x = 1 would
 * have.
 */
static void the_hull_gives_the_true_density_at_edges_too(void **state)
{
    enum { n = 4000, k = 50 };
    field_map map;
    (void)state;
    lay_down(&map, n, 1, margin_of_large_discs);
    expect_close(share(&map, RT_AREA_HULL, k, 0, n, "hull inside"), 1, 0.01, "hull inside");
    cut_off(&map);
    expect_close(share(&map, RT_AREA_HULL, k, 1, n, "hull at the edge"), 1, 0.03,
                 "hull at the edge");
    expect_close(share(&map, RT_AREA_DISC, k, 1, n, "disc at the edge"), 0.5, 0.02,
                 "disc at the edge");
    rt_photon_list_clear(&map.photons);
}

static void photons_that_face_elsewhere_leave_the_density_true(void **state)
{
    enum { n = 4000, k = 10, facing = 25, points = 400 * fields };
    field_map map;
    (void)state;
    /* With few accepted photons, nearly all searches end at max_candidates. */
    lay_down(&map, n, facing, margin_of_large_discs);
    for (int on_device = 0; on_device < 2; on_device++)
        check(&map, points, k, 0, on_device, n / facing);
    rt_photon_list_clear(&map.photons);
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
