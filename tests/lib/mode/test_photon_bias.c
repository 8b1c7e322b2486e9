/*
 * test_photon_bias.c - the layer photon.bias estimates the bias of gathered light, for every way of
 * gathering, where the exact value is known.
 */
#include "support.h"

#include <math.h>

enum { side = 16, pixels = side * side };

static const double pi = 3.14159265358979323846;

#define CAMERA(height, width)                                                                      \
    "camera { projection orthographic  eye 0 0 " height "  look_at 0 0 0  up 0 1 0  width " width  \
    " }\n"
#define FLOOR                                                                                      \
    "material grey { kd 0.5 }\nquad { corner -2 -2 0  edge1 4 0 0  edge2 0 4 0  material grey }\n"
#define PEAK FLOOR "light point { position 0 0 0.25  intensity 1 }\n" CAMERA("0.2", "0.1")
#define PANE                                                                                       \
    "material pane { kt 1  ior 1 }\nquad { corner -9 -9 0.22  edge1 18 0 0  edge2 0 18 0  "        \
    "material pane }\n"
#define SUN FLOOR "light directional { direction 0 0 -1  irradiance 2 }\n"
#define ROOF                                                                                       \
    "material black { kd 0 }\nquad { corner 0 -2 0.5  edge1 2 0 0  edge2 0 4 0  material black "   \
    "}\n"

/* Means of the picture, and of its bias as the layer has it, over columns first to end - 1. */
static void means_of(const rt_film *film, int first, int end, double *picture, double *bias)
{
    const float *rgb = rt_film_rgb(film), *layer = rt_film_layer(film, "photon.bias", NULL);
    assert_non_null(layer);
    *picture = *bias = 0;
    for (int y = 0; y < side; y++)
        for (int x = first; x < end; x++) {
            *picture += rgb[3 * (y * side + x)] / (double)(side * (end - first));
            *bias += layer[y * side + x] / (double)(side * (end - first));
        }
}

static rt_film *render(rt_renderer *renderer, const rt_render_options *options)
{
    rt_render_options all = *options;
    rt_film *film = NULL;
    rt_error error;
    all.width = all.height = side;
    all.mode = RT_MODE_PHOTON;
    all.photon_layers = 1;
    expect_ok(rt_render(&film, renderer, &all, &error), &error);
    return film;
}

/* Renders of the peak below a light, and how far off the layer of the bias may be. */
static const struct {
    const char *name, *scene;
    rt_render_options options;
    double tolerance;
} peaks[] = {
    {"fixed radius", PEAK, {.k = RT_K_ALL, .radius = 0.1f}, 0.2},
    {"FLANN", PEAK, {.k = 14000, .gather = RT_GATHER_FLANN}, 0.2},
    {"device", PEAK, {.k = 14001, .gather = RT_GATHER_DEVICE}, 0.2},
    {"nearest within a radius",
     PEAK,
     {.k = 60000, .radius = 0.1f, .gather = RT_GATHER_DEVICE},
     0.2},
    {"hull", PEAK, {.k = 5000, .photons = 100000, .area = RT_AREA_HULL}, 0.3},
    {"passes", PEAK, {.passes = 4, .radius = 0.1f, .alpha = 0.999f}, 0.2},
    {"passes, pixels' own radii", PEAK, {.passes = 4, .k = 14000, .alpha = 0.999f}, 0.2},
    {"caustic map",
     PEAK PANE,
     {.k = 2, .caustic_k = RT_K_ALL, .caustic_radius = 0.1f, .caustic_photons = 400000},
     0.2},
    {"caustic map, nearest",
     PEAK PANE,
     {.k = 50, .caustic_k = 14000, .caustic_photons = 400000},
     0.2},
    {"caustics on the way", PEAK PANE, {.k = RT_K_ALL, .radius = 0.1f, .final_gather = 1}, 0.2},
    {"on the way, map apart",
     PEAK PANE,
     {.k = 50, .caustic_k = 14000, .caustic_photons = 400000, .final_gather = 2},
     0.2},
};

/*
 * Below a point light of intensity I at the height h, the mean irradiance of a square of half the
 * side a is I times its solid angle, 4 asin(a^2 / (a^2 + h^2)), over its area. Gathering lowers
 * this peak. The layer leaves out what goes by the fourth power of the radius, 5 % of the bias at a
 * radius of 0.4 h; the rest of the tolerance is noise, most with the hull, for which photons are
 * independent. The pane of glass bends no light, and makes all photons caustic ones.
 */
static void every_render_tells_how_much_a_peak_is_lowered(void **state)
{
    const double a = 0.05, h = 0.25,
                 exact = 0.5 / pi * 4 * asin(a * a / (a * a + h * h)) / (4 * a * a);
    (void)state;
    for (size_t i = 0; i < sizeof peaks / sizeof *peaks; i++) {
        rt_render_options options = peaks[i].options;
        rt_renderer *renderer = test_renderer(peaks[i].scene);
        double picture, bias;
        if (!options.photons)
            options.photons = 400000;
        options.spp = 1;
        options.seed = 3;
        options.direct = peaks[i].options.caustic_photons || options.final_gather
                             ? RT_DIRECT_NEE
                             : RT_DIRECT_PHOTONS;
        rt_film *film = render(renderer, &options);
        means_of(film, 0, side, &picture, &bias);
        print_message("%s: bias %.4f of the exact value, %.4f in the layer\n", peaks[i].name,
                      picture / exact - 1, bias / exact);
        assert_true(picture < 0.96 * exact);
        assert_true(fabs(bias / (picture - exact) - 1) < peaks[i].tolerance);
        rt_film_destroy(film);
        rt_renderer_destroy(renderer);
    }
}

/*
 * Beside a sharp edge the bias is in proportion to the radius, not to its square: of a half-plane's
 * light L, blurred by a kernel whose share beyond a line at the distance d is S(d / r), the lit
 * side loses the integral of L S, which is c r. The layer has 2 (c r - c r / sqrt 2), which is 2 -
 * sqrt 2 of it; on the other side the same with another sign.
 */
static void both_sides_of_a_shadow_edge_are_told(void **state)
{
    const double light = 0.5 / pi * 2, share = 2 - sqrt(2);
    rt_render_options options = {.k = RT_K_ALL,
                                 .radius = 0.1f,
                                 .photons = 400000,
                                 .spp = 16,
                                 .seed = 3,
                                 .direct = RT_DIRECT_PHOTONS};
    double picture[2], bias[2];
    (void)state;
    rt_renderer *renderer = test_renderer(SUN ROOF CAMERA("0.3", "1"));
    rt_film *film = render(renderer, &options);
    means_of(film, 0, side / 2, picture, bias);
    means_of(film, side / 2, side, picture + 1, bias + 1);
    int lit = picture[0] < picture[1];
    double lost = picture[lit] - light, gained = picture[!lit];
    print_message("lit side %.4f, layer %.4f of it; dark side %.4f, layer %.4f of it\n",
                  lost / light, bias[lit] / lost, gained / light, bias[!lit] / gained);
    assert_true(lost < -0.03 * light && gained > 0.03 * light);
    assert_true(fabs(bias[lit] / lost - share) < 0.1);
    assert_true(fabs(bias[!lit] / gained - share) < 0.05);

    /* The picture is the same to the bit as without the layer. */
    rt_film *plain = NULL;
    rt_error error;
    options.width = options.height = side;
    options.mode = RT_MODE_PHOTON;
    expect_ok(rt_render(&plain, renderer, &options, &error), &error);
    assert_memory_equal(rt_film_rgb(plain), rt_film_rgb(film), 3 * pixels * sizeof(float));
    rt_film_destroy(plain);
    rt_film_destroy(film);
    rt_renderer_destroy(renderer);
}

/*
 * Over 8 seeds, mean and standard error; Student's t with 7 degrees of freedom is below 8 but for
 * 1e-4 of cases.
 */
static void uniform_irradiance_has_no_bias(void **state)
{
    enum { renders = 8 };
    static const rt_render_options ways[] = {
        {.k = RT_K_ALL, .radius = 0.05f},
        {.k = 50},
        {.k = 51, .area = RT_AREA_HULL},
    };
    const double light = 0.5 / pi * 2;
    (void)state;
    rt_renderer *renderer = test_renderer(SUN CAMERA("1", "1"));
    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++) {
        double sum = 0, squares = 0;
        for (uint32_t seed = 1; seed <= renders; seed++) {
            rt_render_options options = ways[i];
            double picture, bias;
            options.photons = 50000;
            options.spp = 4;
            options.seed = seed;
            options.direct = RT_DIRECT_PHOTONS;
            options.sampler = RT_SAMPLER_INDEPENDENT;
            rt_film *film = render(renderer, &options);
            means_of(film, 0, side, &picture, &bias);
            sum += bias / light;
            squares += bias / light * (bias / light);
            rt_film_destroy(film);
        }
        double mean = sum / renders,
               sigma = sqrt((squares / renders - mean * mean) / (renders - 1));
        print_message("%.5f of the light, standard error %.5f\n", mean, sigma);
        assert_true(sigma < 0.01);
        assert_true(fabs(mean) < 8 * sigma);
    }
    rt_renderer_destroy(renderer);
}

/* With k 2, or below 9 with the hull, there is no smaller k to gather with; the layer is then 0. */
static void without_fewer_photons_the_layer_is_black(void **state)
{
    static const rt_render_options ways[] = {{.k = 2}, {.k = 8, .area = RT_AREA_HULL}};
    (void)state;
    rt_renderer *renderer = test_renderer(PEAK);
    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++) {
        rt_render_options options = ways[i];
        options.photons = 10000;
        options.spp = 1;
        options.direct = RT_DIRECT_PHOTONS;
        rt_film *film = render(renderer, &options);
        for (int p = 0; p < pixels; p++)
            assert_true(rt_film_layer(film, "photon.bias", NULL)[p] == 0);
        rt_film_destroy(film);
    }
    rt_renderer_destroy(renderer);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_render_tells_how_much_a_peak_is_lowered),
        cmocka_unit_test(both_sides_of_a_shadow_edge_are_told),
        cmocka_unit_test(uniform_irradiance_has_no_bias),
        cmocka_unit_test(without_fewer_photons_the_layer_is_black),
    };
    return cmocka_run_group_tests_name("lib/mode/photon_bias", tests, NULL, NULL);
}
