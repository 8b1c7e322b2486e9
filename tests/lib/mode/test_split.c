/*
 * test_split.c - camera paths of photon mapping that are split at rough surfaces: the mean stays
 * that of whole paths, and of mode path; noise falls; what is not rough is rendered as before.
 *
 * The pixels of a render share photons: a render is one value, its mean, and of the means of
 * RENDERS renders with and RENDERS without splitting Student's t is tested.
 */
#include "support.h"

#include <math.h>
#include <string.h>

#include "chance.h"

enum { RENDERS = 16, SIDE = 4, PIXELS = SIDE * SIDE };

/* ---- Scenes -------------------------------------------------------------------------- */

#define CAMERA "camera { projection orthographic  width 0.3  eye 0 1 1  look_at 0 0 0  up 0 1 0 }\n"
#define LAMP                                                                                       \
    "material lamp { emission 4 }\n"                                                               \
    "quad { corner -0.8 2 -0.8  edge1 1.6 0 0  edge2 0 0 1.6  material lamp }\n"
#define LIT                                                                                        \
    LAMP "material wall { kd 0.6 0.5 0.4 }\n"                                                      \
         "quad { corner -1 0 -1  edge1 0 2 0  edge2 2 0 0  material wall }\n"
#define FLOOR(name, y) "quad { corner -1 " y " 1  edge1 2 0 0  edge2 0 0 -2  material " name " }\n"
#define SKY "light environment { radiance 1 }\n"
#define METAL "material metal { kd 0.2  ks 0.7  roughness 0.3 }\n" FLOOR("metal", "0")
#define FROST                                                                                      \
    "material frost { kt 0.9  fresnel dielectric  ior 1.5  roughness 0.2  absorption 1 0.5 0 }\n"  \
    "box { centre 0 0.1 0  size 0.8 0.1 0.8  material frost }\n" FLOOR("wall", "0")
/* Most continuations gather at the surface itself. */
#define PAINT "material paint { kd 0.6  ks 0.2  roughness 0.3 }\n" FLOOR("paint", "0")
/* It emits itself, which is found before the path is split. */
#define GLOWING "material metal { kd 0.2  ks 0.7  exponent 20  emission 0.5 }\n" FLOOR("metal", "0")
/* A ball of fog around what is seen has the kernels for media render. */
#define FOG                                                                                        \
    "material fog { interface true  scattering 0.4 }\n"                                            \
    "sphere { centre 0 0 0  radius 0.8  material fog }\n"
/* All light comes through the surface of dark water, and none of it from photons. */
#define POOL                                                                                       \
    CAMERA SKY "material metal { ks 0.9  roughness 0.2 }\n" FLOOR(                                 \
        "metal", "0") "material water { kt 1  fresnel dielectric  ior 1.33  absorption 1 2 4 }\n"  \
                      "plane { point 0 0.1 0  normal 0 1 0  material water }\n"
/* All light is found by paths, and none of the noise is older than the rough vertex. */
#define PLATE CAMERA LAMP "material metal { ks 0.9  roughness 0.3 }\n" FLOOR("metal", "0")
/* The rough ball is out of sight, and so is what it reflects. */
#define SMOOTH                                                                                     \
    CAMERA LIT FLOOR("wall", "0") "material metal { ks 0.9  roughness 0.3 }\n"                     \
                                  "sphere { centre 0 1 9  radius 0.5  material metal }\n"

static const char metal[] = CAMERA LIT METAL, frost[] = CAMERA LIT FROST,
                  glowing[] = CAMERA LIT GLOWING, paint[] = CAMERA LIT PAINT,
                  foggy[] = CAMERA LIT GLOWING FOG;

/* ---- Renders ------------------------------------------------------------------------- */

static const rt_render_options photon = {.mode = RT_MODE_PHOTON,
                                         .width = SIDE,
                                         .height = SIDE,
                                         .spp = 8,
                                         .max_depth = 12,
                                         .photons = 5000,
                                         .k = RT_K_ALL,
                                         .radius = 0.2f};

static rt_film *render(rt_renderer *renderer, rt_render_options options)
{
    rt_film *film = NULL;
    rt_error error;
    expect_ok(rt_render(&film, renderer, &options, &error), &error);
    return film;
}

typedef struct means {
    double of[RENDERS][3];
} means;

static means render_means(rt_renderer *renderer, rt_render_options options)
{
    means m = {{{0}}};
    for (uint32_t i = 0; i < RENDERS; i++) {
        options.seed = test_seed(100 * options.split + 1000 * (uint32_t)options.mode + i);
        rt_film *film = render(renderer, options);
        for (int p = 0; p < PIXELS; p++)
            for (int c = 0; c < 3; c++)
                m.of[i][c] += rt_film_rgb(film)[3 * p + c] / (double)PIXELS;
        rt_film_destroy(film);
    }
    return m;
}

static double mean_of(const means *m, int channel, double *error)
{
    double mean = 0, square = 0;
    for (int i = 0; i < RENDERS; i++)
        mean += m->of[i][channel] / RENDERS;
    for (int i = 0; i < RENDERS; i++)
        square += pow(m->of[i][channel] - mean, 2);
    *error = sqrt(square / (RENDERS * (RENDERS - 1)));
    return mean;
}

/* Student's t of the smaller number of degrees of freedom, as variances differ. */
static void compare(const means *a, const means *b, const char *name)
{
    for (int c = 0; c < 3; c++) {
        double of_a, of_b;
        const double mean = mean_of(a, c, &of_a), other = mean_of(b, c, &of_b);
        const double error = hypot(hypot(of_a, of_b), 1e-6 * mean), off = other - mean;
        print_message("%s, channel %d: %.5f, off by %+.4f of it, %+.2f standard errors\n", name, c,
                      mean, off / mean, off / error);
        chance_compare(chance_of_student(off / error, RENDERS - 1), "%s, channel %d", name, c);
    }
}

static void compare_split(const char *text, rt_render_options options, uint32_t split,
                          const char *name)
{
    rt_renderer *renderer = test_renderer(text);
    const means whole = render_means(renderer, options);
    options.split = split;
    const means parts = render_means(renderer, options);
    compare(&whole, &parts, name);
    rt_renderer_destroy(renderer);
}

/* ---- The mean ------------------------------------------------------------------------ */

static void the_mean_is_that_of_whole_paths(void **state)
{
    rt_render_options gathers = photon, passes = photon, map = photon;
    (void)state;
    compare_split(metal, photon, 5, "metal");
    compare_split(frost, photon, 4, "frosted glass");
    compare_split(glowing, photon, 5, "metal that emits");
    compare_split(foggy, photon, 5, "metal that emits, in fog");
    gathers.final_gather = 1;
    compare_split(metal, gathers, 5, "metal, final gather");
    passes.passes = 8;
    passes.spp = 1;
    compare_split(frost, passes, 16, "frosted glass, passes");
    map.direct = RT_DIRECT_PHOTONS;
    compare_split(paint, map, 8, "paint, direct light from photons");
}

/* What paths find by themselves has the mean of mode path; the water absorbs before and after. */
static void the_mean_is_that_of_mode_path(void **state)
{
    rt_renderer *renderer = test_renderer(POOL);
    rt_render_options split = photon, paths = photon;
    (void)state;
    split.spp = 16;
    split.split = 6;
    paths.mode = RT_MODE_PATH;
    paths.spp = 64;
    const means a = render_means(renderer, paths), b = render_means(renderer, split);
    compare(&a, &b, "pool");
    rt_renderer_destroy(renderer);
}

/* ---- Noise --------------------------------------------------------------------------- */

/* The variance of a pixel between renders, the mean of all pixels. */
static double variance_of(rt_renderer *renderer, rt_render_options options)
{
    enum { SEEDS = 24 };
    double variance = 0, sums[PIXELS] = {0}, squares[PIXELS] = {0};
    for (uint32_t i = 0; i < SEEDS; i++) {
        options.seed = test_seed(500 + 64 * options.split + i);
        rt_film *film = render(renderer, options);
        for (int p = 0; p < PIXELS; p++) {
            const double value = rt_film_rgb(film)[3 * p + 1];
            sums[p] += value;
            squares[p] += value * value;
        }
        rt_film_destroy(film);
    }
    for (int p = 0; p < PIXELS; p++)
        variance += (squares[p] - sums[p] * sums[p] / SEEDS) / (SEEDS - 1) / PIXELS;
    return variance;
}

/*
 * Of independent continuations 16 would leave a sixteenth of the variance, of stratified ones they
 * leave less, and so do those of four samples together: four other seeds gave 0.009 at most.
 */
static void continuations_are_stratified(void **state)
{
    rt_renderer *renderer = test_renderer(PLATE);
    rt_render_options options = photon;
    (void)state;
    options.spp = 4;
    const double whole = variance_of(renderer, options);
    options.split = 16;
    const double split = variance_of(renderer, options);
    options.sampler = RT_SAMPLER_INDEPENDENT;
    const double independent = variance_of(renderer, options);
    print_message("variance: %.3g whole, split by 16 %.4f of it, independent %.4f\n", whole,
                  split / whole, independent / whole);
    assert_true(split < whole / 50);
    assert_true(independent < whole && independent > 16 * split);
    rt_renderer_destroy(renderer);
}

/* ---- The film ------------------------------------------------------------------------ */

static void expect_same_picture(const rt_film *a, const rt_film *b)
{
    assert_memory_equal(rt_film_rgb(a), rt_film_rgb(b), PIXELS * 3 * sizeof(float));
}

static void smooth_scenes_stay_as_they_are(void **state)
{
    rt_renderer *renderer = test_renderer(SMOOTH);
    rt_render_options options = photon;
    (void)state;
    for (uint32_t bounces = 0; bounces < 2; bounces++) {
        options.split = 1;
        options.final_gather = bounces;
        rt_film *whole = render(renderer, options);
        options.split = 8;
        rt_film *split = render(renderer, options);
        expect_same_picture(whole, split);
        rt_film_stats a, b;
        rt_film_get_stats(whole, &a);
        rt_film_get_stats(split, &b);
        assert_true(a.gathers == b.gathers && a.gathers > 0);
        assert_true(a.gathers_empty == b.gathers_empty);
        rt_film_destroy(whole);
        rt_film_destroy(split);
    }
    rt_renderer_destroy(renderer);
}

/* Parts of the film sum to the whole; one of another `split` is refused. */
static void films_know_the_setting(void **state)
{
    rt_renderer *renderer = test_renderer(metal);
    rt_render_options options = photon;
    rt_film *parts[2], *whole, *other = NULL;
    rt_error error;
    (void)state;
    options.split = 3;
    options.passes = 6;
    options.spp = 1;
    whole = render(renderer, options);
    options.parts = 2;
    for (options.part = 1; options.part <= 2; options.part++)
        parts[options.part - 1] = render(renderer, options);
    options.part = options.parts = 0;
    expect_ok(rt_film_add(parts[0], parts[1], &error), &error);
    expect_ok(rt_film_resolve(parts[0], NULL, &error), &error);
    expect_same_picture(whole, parts[0]);

    options.split = 4;
    options.part = 1;
    options.parts = 2;
    other = render(renderer, options);
    assert_int_equal(rt_film_add(parts[0], other, &error), RT_ERROR_USAGE);
    assert_string_equal(error.field, "split");
    assert_string_equal(error.message, "split is 3 in one film and 4 in the other");
    rt_film_destroy(other);
    rt_film_destroy(parts[0]);
    rt_film_destroy(parts[1]);
    rt_film_destroy(whole);
    rt_renderer_destroy(renderer);
}

static double mean_of_layer(const rt_film *film, const char *name)
{
    uint32_t channels = 0;
    const float *values = rt_film_layer(film, name, &channels);
    double mean = 0;
    assert_non_null(values);
    for (int i = 0; i < PIXELS; i++)
        mean += values[i] / (double)PIXELS;
    return mean;
}

/* A sample counts once, and its layers are those of whole paths, with less noise. */
static void layers_are_of_samples(void **state)
{
    static const char *const names[] = {"photon.count", "photon.radius", "photon.density"};
    rt_renderer *renderer = test_renderer(metal);
    rt_render_options options = photon;
    (void)state;
    options.spp = 64;
    options.photon_layers = 1;
    rt_film *whole = render(renderer, options);
    options.split = 4;
    rt_film *split = render(renderer, options);
    for (int i = 0; i < 3; i++) {
        const double a = mean_of_layer(whole, names[i]), b = mean_of_layer(split, names[i]);
        print_message("%s: %g and %g\n", names[i], a, b);
        assert_true(fabs(b - a) < 0.15 * fabs(a));
    }
    const double a = mean_of_layer(whole, "photon.variance"),
                 b = mean_of_layer(split, "photon.variance");
    print_message("photon.variance: %g and %g\n", a, b);
    assert_true(b < 0.7 * a && b > 0.02 * a);
    rt_film_destroy(whole);
    rt_film_destroy(split);
    rt_renderer_destroy(renderer);
}

/* Larger discs are gathered from at all points of a sample, which gives the bias. */
static void the_bias_stays(void **state)
{
    rt_renderer *renderer = test_renderer(metal);
    rt_render_options options = photon;
    rt_film_stats whole, split;
    (void)state;
    options.spp = 1;
    options.passes = 64;
    options.variance = 1;
    rt_film *film = render(renderer, options);
    rt_film_get_stats(film, &whole);
    rt_film_destroy(film);
    options.split = 4;
    film = render(renderer, options);
    rt_film_get_stats(film, &split);
    rt_film_destroy(film);
    print_message("bias %g and %g, noise %g and %g, error %g and %g\n", whole.relative_bias,
                  split.relative_bias, whole.relative_noise, split.relative_noise,
                  whole.relative_error, split.relative_error);
    assert_true(fabs(split.relative_bias - whole.relative_bias) < 0.05);
    assert_true(split.relative_noise < whole.relative_noise);
    assert_true(split.relative_error < 0.8 * whole.relative_error);
    rt_renderer_destroy(renderer);
}

/* The part of the throughput that max_depth cuts off. */
static void what_is_cut_off_stays(void **state)
{
    rt_renderer *renderer = test_renderer(frost);
    rt_render_options options = photon;
    rt_film_stats whole, split;
    (void)state;
    options.spp = 256;
    options.max_depth = 3;
    rt_film *film = render(renderer, options);
    rt_film_get_stats(film, &whole);
    rt_film_destroy(film);
    options.split = 4;
    film = render(renderer, options);
    rt_film_get_stats(film, &split);
    rt_film_destroy(film);
    print_message("cut off: %g and %g\n", whole.cut_off_throughput, split.cut_off_throughput);
    assert_true(whole.cut_off_throughput > 0.1);
    assert_true(fabs(split.cut_off_throughput / whole.cut_off_throughput - 1) < 0.05);
    rt_renderer_destroy(renderer);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        statistical_test(the_mean_is_that_of_whole_paths),
        statistical_test(the_mean_is_that_of_mode_path),
        cmocka_unit_test(continuations_are_stratified),
        cmocka_unit_test(smooth_scenes_stay_as_they_are),
        cmocka_unit_test(films_know_the_setting),
        cmocka_unit_test(layers_are_of_samples),
        cmocka_unit_test(the_bias_stays),
        cmocka_unit_test(what_is_cut_off_stays),
    };
    return cmocka_run_group_tests_name("lib/mode/split", tests, NULL, NULL);
}
