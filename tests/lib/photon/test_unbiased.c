/*
 * test_unbiased.c - density estimates of uniform fields have the right mean, through the search on the
 * host and the sum on the device, for all kernels and by every rule that ends a search.
 *
 * A field is a number of photons laid down uniformly and independently on a unit square that repeats in
 * both directions (by copies around it), so that no disc meets an edge. The fields lie far apart in one
 * map. The mean over a field's gather points is one independent estimate, and the standard error comes
 * from the scatter of the fields. Where the radius is that of the k-th of n photons, the share of the
 * area inside has the distribution Beta(k, n - k + 1), so that (k - 1) / share has the mean n: the truth
 * is known exactly. Seeds are fixed; false alarms cannot come and go.
 */
#include "support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/photon/points.h"
#include "photon/search.h"

enum { fields = 100, points_a_field = 1000, estimates = fields * points_a_field };

static const float margin = 0.25f;       /* copies reach so far beyond the square; no disc is larger */
static const float apart = 4;            /* distance of the fields */
static const float cone_k = 1.1f;
static const double standard_errors = 3; /* that a mean may be off */

static const char *const kernel_names[] = {"epanechnikov", "box", "cone", "gaussian", "silverman"};
enum { kernels = sizeof kernel_names / sizeof *kernel_names };

/* A map of all fields, n photons in each square, of which one in `facing` faces the gather points. */
static void lay_down(rt_photon_map *map, int n, int facing)
{
    points_stream stream = {12};
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

static rt_gather_point *make_points(void)
{
    points_stream stream = {99};
    rt_gather_point *points = calloc(estimates, sizeof *points);
    assert_non_null(points);
    for (int i = 0; i < estimates; i++) {
        points[i].position[0] = points_uniform(&stream);
        points[i].position[1] = apart * (float)(i / points_a_field);
        points[i].position[2] = points_uniform(&stream);
        points[i].normal[1] = 1;
        points[i].weight[0] = points[i].weight[1] = points[i].weight[2] = 1;
        points[i].pixel = (rt_u32)i;
    }
    return points;
}

/* A scene buffer of one material with kd = 1, so that fr = 1/pi. */
static cl_mem make_scene(void)
{
    struct {
        rt_scene_header header;
        rt_material_data white;
    } scene;
    memset(&scene, 0, sizeof scene);
    scene.header.materials = sizeof scene.header / RT_SCENE_ROW;
    scene.header.material_count = 1;
    for (int c = 0; c < 3; c++)
        scene.white.kd[c] = 1;
    return test_buffer(sizeof scene, &scene);
}

/* The search's results and what else stays the same for all kernels, on the device. */
typedef struct setup {
    cl_mem scene, points, discs, lists, photons, film;
    rt_u32 stride;
} setup;

static setup find(const rt_photon_map *map, uint32_t k, float max_radius)
{
    rt_photon_search *search = NULL;
    rt_gather_point *points = make_points();
    rt_gather_disc *discs = malloc(estimates * sizeof *discs);
    rt_error error;
    setup s;

    expect_ok(rt_photon_search_create(&search, map, k, max_radius, test_device()->threads, &error), &error);
    s.stride = (rt_u32)rt_photon_search_stride(search);
    rt_u32 *lists = calloc((size_t)estimates * s.stride, sizeof *lists);
    expect_ok(rt_photon_search_find(search, points, estimates, lists, discs, NULL, &error), &error);
    for (int i = 0; i < estimates; i++)
        assert_true(discs[i].squared_radius < margin * margin);
    s.scene = make_scene();
    s.points = test_buffer(estimates * sizeof *points, points);
    s.discs = test_buffer(estimates * sizeof *discs, discs);
    s.lists = test_buffer((size_t)estimates * s.stride * sizeof *lists, lists);
    s.photons = test_buffer(map->count * sizeof *map->photons, map->photons);
    s.film = test_buffer(estimates * sizeof(rt_film_pixel), NULL);
    rt_photon_search_destroy(search);
    free(points);
    free(discs);
    free(lists);
    return s;
}

static void release(setup *s)
{
    rt_buffer_release(s->scene);
    rt_buffer_release(s->points);
    rt_buffer_release(s->discs);
    rt_buffer_release(s->lists);
    rt_buffer_release(s->photons);
    rt_buffer_release(s->film);
}

/* The mean of the fields' estimated densities, and its standard error. */
static void estimate(const setup *s, uint32_t density, double *mean, double *error_of_mean)
{
    static rt_film_pixel film[estimates];
    rt_error error;
    cl_kernel kernel = NULL;
    rt_params params;
    rt_density_params how = {density, cone_k, s->stride, 0};
    double sum = 0, squares = 0;

    memset(&params, 0, sizeof params);
    params.item_count = estimates;
    memset(film, 0, sizeof film);
    expect_ok(rt_buffer_write(test_device(), s->film, 0, sizeof film, film, &error), &error);
    expect_ok(rt_device_kernel(test_device(), &kernel, "photon_gather", "photon_gather", NULL, &error), &error);
    rt_arg args[] = {RT_ARG(params),   RT_ARG(s->scene), RT_ARG(how),        RT_ARG(s->points),
                     RT_ARG(s->discs), RT_ARG(s->lists), RT_ARG(s->photons), RT_ARG(s->film)};
    test_run(kernel, args, sizeof args / sizeof *args, estimates);
    test_read(s->film, sizeof film, film);
    rt_kernel_release(kernel);

    for (int field = 0; field < fields; field++) {
        double one = 0;
        for (int i = 0; i < points_a_field; i++)
            one += film[field * points_a_field + i].sum[1] * 3.14159265358979323846 / points_a_field;
        sum += one;
        squares += one * one;
    }
    *mean = sum / fields;
    *error_of_mean = sqrt((squares / fields - *mean * *mean) / (fields - 1));
}

/* Every kernel's mean is `truth`; a box that counts the k-th photon as well would be caught. */
static void check(const setup *s, uint32_t k, double truth, int by_nearest)
{
    for (uint32_t density = 0; density < kernels; density++) {
        double mean, sigma;
        estimate(s, density, &mean, &sigma);
        print_message("k %u %s: %.3f of %.0f, %+.2f standard errors of %.4f %%\n", (unsigned)k, kernel_names[density],
                      mean, truth, (mean - truth) / sigma, 100 * sigma / truth);
        assert_true(fabs(mean - truth) < standard_errors * sigma);
        if (by_nearest && density == RT_DENSITY_BOX)
            assert_true(truth / (k - 1) > 2 * standard_errors * sigma);
    }
}

static void nearest_photons_give_the_true_density(void **state)
{
    enum { n = 4000 };
    static const uint32_t ks[] = {5, 10, 50, 500};
    rt_photon_map map = {0};
    (void)state;
    lay_down(&map, n, 1);
    for (size_t i = 0; i < sizeof ks / sizeof *ks; i++) {
        setup s = find(&map, ks[i], INFINITY);
        check(&s, ks[i], n, 1);
        release(&s);
    }
    rt_photon_map_clear(&map);
}

static void a_limit_on_the_radius_gives_the_true_density(void **state)
{
    enum { n = 4000, k = 50 };
    rt_photon_map map = {0};
    (void)state;
    lay_down(&map, n, 1);
    /* The expected number inside is 48: about half of the searches end at the limit. */
    setup s = find(&map, k, sqrtf(48 / (3.14159265f * n)));
    check(&s, k, n, 0);
    release(&s);
    rt_photon_map_clear(&map);
}

static void photons_that_face_elsewhere_leave_the_density_true(void **state)
{
    enum { n = 4000, k = 10, facing = 25 };
    rt_photon_map map = {0};
    (void)state;
    /* With few that fit, nearly all searches end at the most photons looked at. */
    lay_down(&map, n, facing);
    setup s = find(&map, k, INFINITY);
    check(&s, k, n / facing, 0);
    release(&s);
    rt_photon_map_clear(&map);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nearest_photons_give_the_true_density),
        cmocka_unit_test(a_limit_on_the_radius_gives_the_true_density),
        cmocka_unit_test(photons_that_face_elsewhere_leave_the_density_true),
    };
    return cmocka_run_group_tests_name("lib/photon/unbiased", tests, NULL, NULL);
}
