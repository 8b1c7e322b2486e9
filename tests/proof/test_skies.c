/*
 * test_skies.c - environments turned about any axis: what is seen of them in a known direction, and
 * the radiance of a white floor below them.
 *
 * Under L(w) = 1 + d . w, where w is a direction along the image's axes and d a unit vector, the
 * radiance of a white floor of normal n is 1 + 2/3 (M d) . n, whatever the rotation M is. The image
 * has so many pixels that the interpolation between them changes this by 2 in 10^5 at most.
 */
#include <math.h>
#include <string.h>

#include "image/image_file.h"
#include "lib/image/scratch.h"
#include "proof/proof.h"

enum { width = 512, height = 256, coarse_width = 16, coarse_height = 8, step_max = 2 };

static const double pi = 3.14159265358979323846;
static const double gradient[3] = {0.48, 0.6, 0.64};

/* ---- Orientations ------------------------------------------------------------------ */

/* A transform as the language writes it, and as steps about an axis, of so many degrees. */
typedef struct orientation {
    const char *name, *text;
    double mirror[3], steps[step_max][4];
} orientation;

static const orientation orientations[] = {
    {"about x", "rotate 1 0 0 70", {1, 1, 1}, {{1, 0, 0, 70}}},
    {"about z", "rotate 0 0 1 -50", {1, 1, 1}, {{0, 0, 1, -50}}},
    {"about a leaning axis", "rotate 1 2 -0.5 110", {1, 1, 1}, {{1, 2, -0.5, 110}}},
    {"about y, then x",
     "rotate 1 0 0 130  rotation 40",
     {1, 1, 1},
     {{0, 1, 0, 40}, {1, 0, 0, 130}}},
    {"mirrored, then turned", "scale -2 2 2  rotate 0.3 0 1 140", {-1, 1, 1}, {{0.3, 0, 1, 140}}},
    {"by a matrix", "matrix 0 0 3 0  -3 0 0 0  0 -3 0 0", {1, 1, 1}, {{-1, 1, -1, 120}}},
};

enum { orientation_count = sizeof orientations / sizeof *orientations };

/* By the formula of Rodrigues. */
static void turn(double v[3], const double step[4])
{
    const double length = sqrt(step[0] * step[0] + step[1] * step[1] + step[2] * step[2]);
    if (length == 0)
        return;
    const double k[3] = {step[0] / length, step[1] / length, step[2] / length};
    const double c = cos(step[3] * pi / 180), s = sin(step[3] * pi / 180);
    const double along = (k[0] * v[0] + k[1] * v[1] + k[2] * v[2]) * (1 - c);
    const double across[3] = {k[1] * v[2] - k[2] * v[1], k[2] * v[0] - k[0] * v[2],
                              k[0] * v[1] - k[1] * v[0]};
    for (int i = 0; i < 3; i++)
        v[i] = v[i] * c + across[i] * s + k[i] * along;
}

static void to_world(double v[3], const orientation *o)
{
    for (int i = 0; i < 3; i++)
        v[i] *= o->mirror[i];
    for (int i = 0; i < step_max; i++)
        turn(v, o->steps[i]);
}

/* ---- Images ------------------------------------------------------------------------ */

/* The direction of the middle of a pixel. */
static void direction(double out[3], int x, int y, int columns, int rows)
{
    const double longitude = 2 * pi * ((x + 0.5) / columns - 0.5), polar = pi * (y + 0.5) / rows;
    out[0] = sin(polar) * sin(longitude);
    out[1] = cos(polar);
    out[2] = -sin(polar) * cos(longitude);
}

static double cosine(int x, int y)
{
    double w[3];
    direction(w, x, y, width, height);
    return 1 + gradient[0] * w[0] + gradient[1] * w[1] + gradient[2] * w[2];
}

/* Above 1 in one pixel alone. */
static double spot(int x, int y)
{
    return x == 11 && y == 2 ? 40 : 1;
}

/* Above 1 about +y. */
static double pole(int x, int y)
{
    (void)x;
    return y == 0 ? 7 : 1;
}

static void write_image(const char *path, int columns, int rows, double (*of)(int x, int y))
{
    static const char *const names[] = {"R", "G", "B"};
    rt_image *image = NULL;
    rt_error error;
    expect_ok(rt_image_create(&image, (uint32_t)columns, (uint32_t)rows, names, 3, &error), &error);
    for (int i = 0; i < 3 * columns * rows; i++)
        image->data[i] = (float)of(i / 3 % columns, i / 3 / columns);
    expect_ok(rt_image_write(image, path, NULL, &error), &error);
    rt_image_destroy(image);
}

/* Into a directory of their own, which is left with scratch_leave. */
static int enter_images(void **state)
{
    if (scratch_enter(state) != 0)
        return 1;
    write_image("spot.exr", coarse_width, coarse_height, spot);
    write_image("pole.exr", coarse_width, coarse_height, pole);
    write_image("cosine.exr", width, height, cosine);
    return 0;
}

/* ---- The tests --------------------------------------------------------------------- */

/* The radiance in the middle of a narrow view. */
static float seen(const char *file, const double at[3], const char *light, rt_mode mode)
{
    const rt_render_options options = {
        .width = 1, .height = 1, .spp = 1, .mode = mode, .photons = 100};
    rt_scene *scene = NULL;
    rt_renderer *renderer = NULL;
    rt_film *film = NULL;
    rt_error error;
    const char *text =
        proof_text("camera { eye 1 2 3  look_at %.9g %.9g %.9g  up 0.3 0.4 0.5  fov 1e-3 }\n"
                   "light environment { file \"%s\"  %s }\n",
                   1 + at[0], 2 + at[1], 3 + at[2], file, light);
    expect_ok(rt_scene_parse(&scene, text, "test", NULL, &error), &error);
    expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
    expect_ok(rt_render(&film, renderer, &options, &error), &error);
    const float radiance = rt_film_rgb(film)[1];
    rt_film_destroy(film);
    rt_renderer_destroy(renderer);
    rt_scene_destroy(scene);
    return radiance;
}

static void a_bright_pixel_is_seen_where_the_sky_is_turned_to(void **state)
{
    static const rt_mode modes[] = {RT_MODE_PATH, RT_MODE_DIRECT, RT_MODE_PHOTON, RT_MODE_VCM};
    (void)state;
    for (int i = 0; i < orientation_count; i++)
        for (int m = 0; m < 4; m++) {
            const orientation *o = orientations + i;
            double w[3], beside[3];
            direction(w, 11, 2, coarse_width, coarse_height);
            direction(beside, 10, 2, coarse_width, coarse_height);
            to_world(w, o);
            to_world(beside, o);
            assert_float_equal(seen("spot.exr", w, o->text, modes[m]), 40, 0.02);
            assert_float_equal(seen("spot.exr", beside, o->text, modes[m]), 1, 0.02);
        }
}

/* What lies along the axes of the world after turns by right angles: no formula is in between. */
static void poles_are_seen_along_axes(void **state)
{
    static const struct {
        const char *text;
        double at[3];
    } cases[] = {{"scale 1", {0, 1, 0}},          {"rotate 1 0 0 90", {0, 0, 1}},
                 {"rotate 0 0 1 90", {-1, 0, 0}}, {"rotate 1 1 1 120", {0, 0, 1}},
                 {"scale 1 -1 1", {0, -1, 0}},    {"matrix 0 1 0 0  1 0 0 0  0 0 1 0", {1, 0, 0}}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const double *at = cases[i].at, against[3] = {-at[0], -at[1], -at[2]};
        assert_float_equal(seen("pole.exr", at, cases[i].text, RT_MODE_PATH), 7, 1e-4);
        assert_float_equal(seen("pole.exr", against, cases[i].text, RT_MODE_PATH), 1, 1e-4);
    }
}

/* Looks straight down on the middle of it. */
#define FLOOR                                                                                      \
    "camera { projection orthographic  eye 0 0.4 0  look_at 0 0 0  up 0 0 -1  width 1 }\n"         \
    "material white { kd 1 }\n"                                                                    \
    "quad { corner -1 0 1  edge1 2 0 0  edge2 0 0 -2  material white }\n"

/* Above half of what is seen, one that leans, and one below it: all say nothing of the sky. */
#define PORTALS                                                                                    \
    "portal { corner -1 0.2 1  edge1 1 0 0  edge2 0 0 -2 }\n"                                      \
    "portal { corner 0.3 0.1 0.2  edge1 0.5 0.3 0  edge2 0 0 -0.7 }\n"                             \
    "portal { corner -1 -0.5 1  edge1 2 0 0  edge2 0 0 -2 }\n"

/* The radiance of the floor in all modes, under a sky that is turned so. */
static void expect_floor(const orientation *o, const char *portals)
{
    enum { side = 8, spp = 8 };
    static const struct {
        const char *by;
        rt_render_options options;
    } ways[] = {
        {"path", {.mode = RT_MODE_PATH}},
        {"path, lights sampled", {.mode = RT_MODE_PATH, .estimator = RT_ESTIMATOR_LIGHT}},
        {"path, BSDF sampled", {.mode = RT_MODE_PATH, .estimator = RT_ESTIMATOR_BSDF}},
        {"direct", {.mode = RT_MODE_DIRECT}},
        {"photons", {.mode = RT_MODE_PHOTON, .direct = RT_DIRECT_PHOTONS}},
        {"photons of importance",
         {.mode = RT_MODE_PHOTON, .direct = RT_DIRECT_PHOTONS, .photon_importance = 1}},
        {"light tracing", {.mode = RT_MODE_VCM, .techniques = RT_TECHNIQUES_CAMERA}},
        {"bpt", {.mode = RT_MODE_VCM, .techniques = RT_TECHNIQUES_BPT}},
        {"vcm", {.mode = RT_MODE_VCM}},
    };
    double d[3] = {gradient[0], gradient[1], gradient[2]};
    to_world(d, o);
    for (size_t k = 0; k < sizeof ways / sizeof *ways; k++) {
        rt_render_options options = ways[k].options;
        options.width = options.height = side;
        options.spp = spp;
        options.max_depth = 3;
        if (options.mode == RT_MODE_PHOTON) {
            options.photons = 10000;
            options.k = RT_K_ALL;
            options.radius = 0.15f;
            options.spp = 2;
        }
        const char *scene =
            proof_text("cosine sky, %s%s", o->name, portals[0] ? ", with portals" : "");
        const char *text =
            proof_text(FLOOR "light environment { file \"cosine.exr\"  %s }\n%s", o->text, portals);
        proof_radiance((proof_row){scene, ways[k].by, "1 + 2/3 (M d) . n"}, 1 + 2 * d[1] / 3, text,
                       &options);
    }
}

static void cosine_skies_light_a_floor(void **state)
{
    (void)state;
    for (int i = 0; i < orientation_count; i++)
        expect_floor(orientations + i, "");
}

/* Portals change the noise alone, wherever they are. */
static void portals_leave_the_light_as_it_is(void **state)
{
    (void)state;
    expect_floor(orientations, PORTALS);
    expect_floor(orientations + 4, PORTALS);
}

static void the_page_has_the_rows(void **state)
{
    (void)state;
    proof_page("Turned skies");
}

#define IN_IMAGES(test) cmocka_unit_test_setup_teardown(test, enter_images, scratch_leave)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_IMAGES(a_bright_pixel_is_seen_where_the_sky_is_turned_to),
        IN_IMAGES(poles_are_seen_along_axes),
        IN_IMAGES(cosine_skies_light_a_floor),
        IN_IMAGES(portals_leave_the_light_as_it_is),
        cmocka_unit_test(the_page_has_the_rows),
    };
    return cmocka_run_group_tests_name("proof/skies", tests, NULL, NULL);
}
