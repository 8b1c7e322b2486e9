/*
 * test_denoise.c - the layer denoised: what Open Image Denoise is given and gives back, by a
 * library that stands in for it; what is refused; and, where RT_TEST_OIDN names the real library,
 * that it lowers the error.
 */
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The stand-ins, beside this program. */
static char whole_stub[4096], lacking_stub[4096];
static rt_denoise_options stub = {.library = whole_stub};

/* On one side a mirror, which shows the wall behind the camera; on the other glass. */
static const char guide_scene[] =
    "camera { eye 0 0 0  look_at 0 0 1  fov 60 }\n"
    "film { width 32  height 16 }\n"
    "render { spp 4 }\n"
    "material mirror { ks 0.5 }\n"
    "material glass { kt 1  ior 1.0001  fresnel dielectric }\n"
    "material front { kd 0.2 0.4 0.6 }\n"
    "material back { kd 0.8 0.6 0.4 }\n"
    "quad { corner -9 -9 3  edge1 9 0 0  edge2 0 18 0  material mirror }\n"
    "box { centre 5 0 3  size 9.9 18 0.5  material glass }\n"
    "quad { corner -30 -30 6  edge1 60 0 0  edge2 0 60 0  material front }\n"
    "quad { corner -30 -30 -6  edge1 60 0 0  edge2 0 60 0  material back }\n"
    "light point { position 0 0 0  intensity 20 }\n";

/* A film of the scene. */
static rt_film *render(rt_renderer *renderer, const rt_render_options *o)
{
    rt_film *film = NULL;
    rt_error error;
    expect_ok(rt_render(&film, renderer, o, &error), &error);
    return film;
}

/* A pixel of a film's denoised layer, when the stand-in does `what`. */
static const float *guide_at(rt_film *film, rt_renderer *renderer, const char *what, int x, int y)
{
    uint32_t channels = 0;
    rt_error error;
    setenv("STUB_OIDN", what, 1);
    expect_ok(rt_film_denoise(film, renderer, &stub, &error), &error);
    unsetenv("STUB_OIDN");
    const float *layer = rt_film_layer(film, "denoised", &channels);
    assert_int_equal(channels, 3);
    return layer + 3 * (y * 32 + x);
}

static void expect_triple(const float *found, float a, float b, float c)
{
    const float wanted[3] = {a, b, c};
    for (int i = 0; i < 3; i++)
        if (fabsf(found[i] - wanted[i]) > 2e-3f)
            fail_msg("%g %g %g, not %g %g %g", found[0], found[1], found[2], a, b, c);
}

static void guides_see_through_mirrors_and_glass(void **state)
{
    (void)state;
    rt_renderer *renderer = test_renderer(guide_scene);
    rt_film *film = render(renderer, NULL);
    /* On the side that is brighter. */
    const int mirror =
        rt_film_rgb(film)[3 * (8 * 32 + 4)] > rt_film_rgb(film)[3 * (8 * 32 + 27)] ? 4 : 27;
    expect_triple(guide_at(film, renderer, "albedo", mirror, 8), 0.4f, 0.3f, 0.2f);
    expect_triple(guide_at(film, renderer, "albedo", 31 - mirror, 8), 0.2f, 0.4f, 0.6f);
    expect_triple(guide_at(film, renderer, "normal", mirror, 8), 0, 0, 1);
    expect_triple(guide_at(film, renderer, "normal", 31 - mirror, 8), 0, 0, -1);
    rt_film_destroy(film);
    rt_renderer_destroy(renderer);
}

static void the_picture_stays_and_the_layer_is_the_filter_s(void **state)
{
    rt_error error;
    (void)state;
    rt_renderer *renderer = test_renderer(guide_scene);
    rt_film *film = render(renderer, NULL), *plain = render(renderer, NULL);
    assert_null(rt_film_layer(film, "denoised", NULL));
    expect_ok(rt_film_denoise(film, renderer, &stub, &error), &error);
    const float *rgb = rt_film_rgb(film), *layer = rt_film_layer(film, "denoised", NULL);
    assert_memory_equal(rgb, rt_film_rgb(plain), 32 * 16 * 3 * sizeof *rgb);
    for (int i = 0; i < 32 * 16 * 3; i++)
        assert_true(layer[i] == rgb[i] / 2);
    rt_film_destroy(film);
    rt_film_destroy(plain);
    rt_renderer_destroy(renderer);
}

/* That denoising fails for this reason, and leaves no layer. */
static void expect_failure(rt_film *film, rt_renderer *renderer, const char *library,
                           rt_status status, const char *why)
{
    const rt_denoise_options o = {.library = library};
    rt_error error;
    assert_int_equal(rt_film_denoise(film, renderer, &o, &error), status);
    if (!strstr(error.message, why))
        fail_msg("'%s' does not say '%s'", error.message, why);
    assert_null(rt_film_layer(film, "denoised", NULL));
}

static void what_the_library_fails_with_is_told(void **state)
{
    static const struct {
        const char *what, *why;
    } faults[] = {{"no-device", "no device"},
                  {"device-error", "the device is broken"},
                  {"filter-error", "the filter is broken"}};
    (void)state;
    rt_renderer *renderer = test_renderer(guide_scene);
    rt_film *film = render(renderer, NULL);
    for (int i = 0; i < 3; i++) {
        setenv("STUB_OIDN", faults[i].what, 1);
        expect_failure(film, renderer, whole_stub, RT_ERROR_DEVICE, faults[i].why);
        unsetenv("STUB_OIDN");
    }
    expect_failure(film, renderer, lacking_stub, RT_ERROR_DEVICE, "oidnSetFilterBool");
    expect_failure(film, renderer, "./none.so", RT_ERROR_DEVICE, "none.so");
    expect_failure(film, renderer, "libm.so.6", RT_ERROR_DEVICE, "oidnNewDevice");
    rt_film_destroy(film);
    rt_renderer_destroy(renderer);
}

static void note_warning(void *user, const char *text)
{
    *(int *)user += strstr(text, "noise of photons") != NULL;
}

/* A film of this mode in so many passes. */
static rt_film *render_mode(rt_renderer *renderer, rt_mode mode, uint32_t passes)
{
    const rt_render_options o = {
        .width = 8, .height = 8, .photons = 1000, .mode = mode, .passes = passes};
    return render(renderer, &o);
}

static void what_neighbours_share_is_warned_of(void **state)
{
    int warnings = 0;
    const rt_hooks hooks = {.warning = note_warning, .user = &warnings};
    const rt_denoise_options o = {.library = whole_stub, .hooks = &hooks};
    const rt_mode modes[] = {RT_MODE_PATH, RT_MODE_PHOTON, RT_MODE_PHOTON};
    (void)state;
    rt_renderer *renderer = test_renderer(guide_scene);
    for (int i = 0; i < 3; i++) {
        rt_film *film = render_mode(renderer, modes[i], i == 2 ? 2 : 0);
        rt_error error;
        expect_ok(rt_film_denoise(film, renderer, &o, &error), &error);
        assert_int_equal(warnings, i);
        rt_film_destroy(film);
    }
    rt_renderer_destroy(renderer);
}

static void modes_without_light_are_refused(void **state)
{
    (void)state;
    rt_renderer *renderer = test_renderer(guide_scene);
    rt_film *film = render_mode(renderer, RT_MODE_DEPTH, 0);
    expect_failure(film, renderer, whole_stub, RT_ERROR_USAGE, "shows no light");
    rt_film_destroy(film);
    rt_renderer_destroy(renderer);
}

static void the_version_is_told(void **state)
{
    char version[16];
    rt_error error;
    (void)state;
    expect_ok(rt_denoiser_check(version, &stub, &error), &error);
    assert_string_equal(version, "2.3.4");
}

/* Mean squared error of a picture over the squared reference. */
static double error_of(const float *rgb, const rt_film *reference, size_t count)
{
    double sum = 0;
    for (size_t i = 0; i < count; i++) {
        const double b = rt_film_rgb(reference)[i], d = rgb[i] - b;
        sum += d * d / (b * b + 0.01);
    }
    return sum / (double)count;
}

static void the_real_library_lowers_the_error(void **state)
{
    rt_scene *scene = NULL;
    rt_renderer *renderer = NULL;
    rt_error error;
    const rt_denoise_options real = {.library = getenv("RT_TEST_OIDN")};
    rt_render_options o = {.width = 96, .height = 96, .spp = 8};
    (void)state;
    if (!real.library)
        skip();
    expect_ok(rt_scene_load(&scene, "scenes/soft_shadow.rts", NULL, &error), &error);
    expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
    rt_film *film = render(renderer, &o);
    o.spp = 512;
    o.seed = 9;
    rt_film *reference = render(renderer, &o);
    expect_ok(rt_film_denoise(film, renderer, &real, &error), &error);
    const double raw = error_of(rt_film_rgb(film), reference, 96 * 96 * 3);
    const double denoised = error_of(rt_film_layer(film, "denoised", NULL), reference, 96 * 96 * 3);
    print_message("relative MSE %.3g, denoised %.3g\n", raw, denoised);
    assert_true(denoised < 0.5 * raw);
    rt_film_destroy(film);
    rt_film_destroy(reference);
    rt_renderer_destroy(renderer);
    rt_scene_destroy(scene);
}

int main(int argc, char **argv)
{
    const char *slash = argc > 0 ? strrchr(argv[0], '/') : NULL;
    const int folder = slash ? (int)(slash - argv[0]) : 0;
    snprintf(whole_stub, sizeof whole_stub, "%.*s/stub.so", folder, argv[0]);
    snprintf(lacking_stub, sizeof lacking_stub, "%.*s/stub_lacking.so", folder, argv[0]);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(guides_see_through_mirrors_and_glass),
        cmocka_unit_test(the_picture_stays_and_the_layer_is_the_filter_s),
        cmocka_unit_test(what_the_library_fails_with_is_told),
        cmocka_unit_test(what_neighbours_share_is_warned_of),
        cmocka_unit_test(modes_without_light_are_refused),
        cmocka_unit_test(the_version_is_told),
        cmocka_unit_test(the_real_library_lowers_the_error),
    };
    return cmocka_run_group_tests_name("lib/denoise", tests, NULL, NULL);
}
