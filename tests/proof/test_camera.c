/*
 * test_camera.c - projection, depth of field, and texture coordinates.
 *
 * A camera of horizontal angle fov and W columns sees a point d = x right + y up + z axis from the
 * eye at the column W (1/2 + (x/z) / (2 tan(fov/2))), in a mirror at that of -x, and farther to the
 * left and down by its shift to the right and up. A lens of radius a, focused at f, spreads a
 * point at z over a disc of diameter 2 a |1/z - 1/f| W / (2 tan(fov/2)).
 */
#include <math.h>
#include <string.h>

#include "image/image_file.h"
#include "lib/image/scratch.h"
#include "proof/proof.h"

static const double pi = 3.14159265358979323846;

/* ---- Where the light of a channel is -------------------------------------------------- */

/*
 * Sums over the film of the channel's light, times the column or row of the pixel's centre, to
 * powers.
 */
static proof_values moment(const proof_films *films, int channel, int x_power, int y_power)
{
    proof_values values;
    for (int i = 0; i < proof_renders; i++) {
        values.of[i] = 0;
        for (uint32_t y = 0; y < films->height; y++)
            for (uint32_t x = 0; x < films->width; x++)
                values.of[i] += films->rgb[i][3 * (y * films->width + x) + (uint32_t)channel] *
                                pow(x + 0.5, x_power) * pow(y + 0.5, y_power);
    }
    return values;
}

static proof_values ratio(proof_values a, proof_values b)
{
    for (int i = 0; i < proof_renders; i++)
        a.of[i] /= b.of[i];
    return a;
}

/* The middle of the channel's light and its sum are as expected, in pixels. */
static void expect_spot(const char *scene, const proof_films *films, int channel,
                        const double expected[3])
{
    static const char *const what[] = {"column", "row", "area in pixels"};
    proof_values sum = moment(films, channel, 0, 0);
    for (int i = 0; i < 3; i++) {
        proof_values values = i == 2 ? sum : ratio(moment(films, channel, i == 0, i == 1), sum);
        proof_check((proof_row){proof_text("%s %d", scene, channel + 1), what[i], "projection"},
                    expected[i], &values);
    }
}

/* ---- Pinholes -------------------------------------------------------------------------- */

typedef double vector[3];

static double dot(const vector a, const vector b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross_unit(vector out, const vector a, const vector b)
{
    vector c = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    double length = sqrt(dot(c, c));
    for (int i = 0; i < 3; i++)
        out[i] = c[i] / length;
}

/* The mean of the middles of the pixels that x0 to x1 covers, each by how much it is covered. */
static double middle_of_pixels(double x0, double x1)
{
    double sum = 0;
    for (double pixel = floor(x0); pixel < x1; pixel++)
        sum += (pixel + 0.5) * (fmin(x1, pixel + 1) - fmax(x0, pixel));
    return sum / (x1 - x0);
}

/*
 * Three area lights, red, green and blue, squares of 0.2 m across the view, at places right, up and
 * ahead of the eye, by a shifted camera and in a mirror.
 */
static void squares_by_their_projection(void **state)
{
    static const vector eye = {1, 2, -3}, ahead = {0.6, -0.48, 0.64}, up = {0.1, 1, 0.2};
    static const vector places[3] = {{-1, 0.6, 4}, {1.6, 0.9, 5}, {0.3, -0.8, 3}};
    static const rt_render_options options = {.width = 60, .height = 40, .spp = 16};
    double scale = 60 / (2 * tan(25 * pi / 180));
    vector x, y;
    char lights[2048] = "";
    proof_films films;
    (void)state;
    cross_unit(x, ahead, up);
    cross_unit(y, x, ahead);
    for (int k = 0; k < 3; k++) {
        vector corner;
        for (int i = 0; i < 3; i++)
            corner[i] = eye[i] + (places[k][0] - 0.1) * x[i] + (places[k][1] - 0.1) * y[i] +
                        places[k][2] * ahead[i];
        strcat(
            lights,
            proof_text("quad { corner %.9g %.9g %.9g  edge1 %.9g %.9g %.9g  edge2 %.9g %.9g %.9g\n"
                       "  material emitter  radiance %d %d %d }\n",
                       corner[0], corner[1], corner[2], 0.2 * x[0], 0.2 * x[1], 0.2 * x[2],
                       0.2 * y[0], 0.2 * y[1], 0.2 * y[2], k == 0, k == 1, k == 2));
    }
    proof_render(&films,
                 proof_text("camera { eye 1 2 -3  look_at 1.6 1.52 -2.36  up 0.1 1 0.2  fov 50\n"
                            "    shift 0.1 -0.075  mirror true }\n"
                            "material emitter { }\n%s",
                            lights),
                 &options);
    for (int k = 0; k < 3; k++) {
        const double *p = places[k];
        double x_middle = 30 - scale * p[0] / p[2] - 6, y_middle = 20 - scale * p[1] / p[2] - 3,
               half = scale * 0.1 / p[2];
        double expected[3] = {middle_of_pixels(x_middle - half, x_middle + half),
                              middle_of_pixels(y_middle - half, y_middle + half), 4 * half * half};
        expect_spot("pinhole camera, square", &films, k, expected);
    }
    proof_free(&films);
}

/* Spheres, seen by parallel rays and all around. */
static void other_cameras(void **state)
{
    static const char lights[] =
        "material emitter { }\nsphere { centre 0.5 0.3 2  radius 0.1  material emitter  radiance 1 "
        "0 0 "
        "}\n"
        "sphere { centre -0.8 0 3  radius 0.1  material emitter  radiance 0 1 0 }\n"
        "sphere { centre 0.7 -0.4 -2  radius 0.1  material emitter  radiance 0 0 1 }\n";
    static const rt_render_options options = {.width = 40, .height = 20, .spp = 64};
    proof_films films;
    (void)state;
    /* One who looks along +z has +x on the left. */
    proof_render(
        &films,
        proof_text("camera { projection orthographic  eye 0 0 -5  look_at 0 0 0  width 4 }\n%s",
                   lights),
        &options);
    const double expected[3][3] = {{15, 7, pi}, {28, 10, pi}, {13, 14, pi}};
    for (int k = 0; k < 3; k++)
        expect_spot("orthographic camera, sphere", &films, k, expected[k]);
    proof_free(&films);

    proof_render(
        &films,
        proof_text("camera { projection environment  eye 0 0 3  look_at 0 0 4 }\n%s",
                   "material emitter { }\nsphere { centre 0 0 5  radius 0.1  material emitter  "
                   "radiance 1 0 0 }\n"
                   "sphere { centre -2 0 3  radius 0.1  material emitter  radiance 0 1 0 }\n"
                   "sphere { centre 2 0 5  radius 0.1  material emitter  radiance 0 0 1 }\n"),
        &options);
    static const double turns[3] = {0, 0.25, -0.125};
    for (int k = 0; k < 3; k++) {
        proof_values sum = moment(&films, k, 0, 0), x = ratio(moment(&films, k, 1, 0), sum),
                     y = ratio(moment(&films, k, 0, 1), sum);
        const char *scene = proof_text("environment camera, sphere %d", k + 1);
        proof_check((proof_row){scene, "column", "longitude"}, 20 + 40 * turns[k], &x);
        proof_check((proof_row){scene, "row", "latitude"}, 10, &y);
    }
    proof_free(&films);
}

/* ---- Lenses ---------------------------------------------------------------------------- */

static const double aperture = 0.1, focus = 2, half_view = 0.125; /* tan(fov/2) */

static double blur_radius(double z, double width)
{
    return aperture * fabs(1 / z - 1 / focus) * width / (2 * half_view);
}

static const char *lens(const char *light)
{
    return proof_text("camera { eye 0 0 0  look_at 0 0 1  fov (2 * atan(0.125))  aperture 0.1  "
                      "focal_distance 2 }\n"
                      "material black { }\n%s",
                      light);
}

/* The part of a disc of radius 1 on one side of the line at t. */
static double segment(double t)
{
    return t <= -1 ? 0 : t >= 1 ? 1 : 0.5 + (t * sqrt(1 - t * t) + asin(t)) / pi;
}

/* Its mean over the column from x to x + 1, for a disc of radius r. */
static double column(double x, double r)
{
    enum { steps = 2000 };
    double sum = 0;
    for (int i = 0; i < steps; i++)
        sum += segment((x + (i + 0.5) / steps) / r);
    return sum / steps;
}

/*
 * An emissive half plane on the left, before and behind the plane in focus: each column has its
 * part of the disc.
 */
static void edges_through_a_lens(void **state)
{
    static const rt_render_options options = {.width = 64, .height = 2, .spp = 64};
    static const double distances[] = {1.25, 2, 5};
    (void)state;
    for (int k = 0; k < 3; k++) {
        double z = distances[k], r = blur_radius(z, 64);
        proof_films films;
        proof_render(
            &films,
            lens(proof_text(
                "quad { corner 0 -9 %g  edge1 0 18 0  edge2 9 0 0  material black  radiance 1 }\n",
                z)),
            &options);
        static const int columns[] = {0, 24, 27, 31, 32, 36, 39, 63};
        for (int i = 0; i < 8; i++) {
            uint32_t x = (uint32_t)columns[i];
            proof_values values = proof_mean_of(&films, 1, x, 0, x + 1, 2);
            double expected = r > 0 ? column(31 - (double)x, r) : x < 32;
            proof_check((proof_row){proof_text("edge at %g m, lens focused at 2 m", z),
                                    proof_text("column %u", x), "segment of the disc of confusion"},
                        expected, &values);
        }
        proof_free(&films);
    }
}

/*
 * A small disc: the variance of the light's column is that of the disc of confusion, D^2/16, that
 * of the light's image, and 1/12, which the pixels add (Sheppard). Its light is that of a pinhole.
 */
static void discs_of_confusion(void **state)
{
    static const rt_render_options options = {.width = 48, .height = 48, .spp = 64};
    static const double distances[] = {1.4, 4};
    (void)state;
    for (int k = 0; k < 2; k++) {
        double z = distances[k], own = 0.02 / z * 48 / (2 * half_view);
        proof_films films;
        proof_render(&films,
                     lens(proof_text(
                         "disc { centre 0.01 -0.02 %g  normal 0 0 -1  radius 0.02  material black  "
                         "radiance 1 }\n",
                         z)),
                     &options);
        proof_values sum = moment(&films, 1, 0, 0), mean = ratio(moment(&films, 1, 1, 0), sum);
        proof_values square = ratio(moment(&films, 1, 2, 0), sum);
        for (int i = 0; i < proof_renders; i++)
            square.of[i] =
                4 * sqrt(square.of[i] - mean.of[i] * mean.of[i] - 1 / 12.0 - own * own / 4);
        const char *scene = proof_text("point at %g m, lens focused at 2 m", z);
        proof_check((proof_row){scene, "diameter in pixels", "2 a abs(1/z - 1/f), projected"},
                    2 * blur_radius(z, 48), &square);
        proof_check((proof_row){scene, "area in pixels", "that of the light, projected"},
                    pi * own * own, &sum);
        proof_free(&films);
    }
}

/* ---- Textures ---------------------------------------------------------------------------- */

static const rt_render_options window = {.width = 4, .height = 4, .spp = 4};

/* Points of emissive shapes, and v there. */
static const struct {
    const char *name, *shape;
    double at[3], normal[3], v;
} gradients[] = {
    {"quad", "quad { corner 0 0 0  edge1 2 0 0  edge2 0 1 0", {0.5, 0.75, 0}, {0, 0, 1}, 0.75},
    {"triangle",
     "triangle { a 0 0 0  b 2 0 0  c 0 1 0  uva 0 0.1  uvb 0 0.5  uvc 0 0.9",
     {0.5, 0.25, 0},
     {0, 0, 1},
     0.4},
    {"sphere",
     "sphere { centre 0 0 0  radius 1",
     {0.8, -0.6, 0},
     {0.8, -0.6, 0},
     0.2951672353008665},
    {"ellipsoid",
     "ellipsoid { centre 0 0 0  radii 2 1 1",
     {0, 0.8, 0.6},
     {0, 0.8, 0.6},
     0.7951672353008665},
    {"ring",
     "disc { centre 0 0 0  normal 0 0 1  radius 2  inner_radius 1",
     {0, 1.25, 0},
     {0, 0, 1},
     0.25},
    {"cylinder", "cylinder { a 0 0 0  b 0 2 0  radius 1", {0, 0.5, 1}, {0, 0, 1}, 0.25},
    {"cap of a cylinder", "cylinder { a 0 0 0  b 0 2 0  radius 1", {0.25, 2, 0}, {0, 1, 0}, 0.25},
    {"cone", "cone { base 0 0 0  apex 0 1 0  radius 1", {0, 0.25, 0.75}, {0, 1, 1}, 0.25},
    {"torus, outside",
     "torus { centre 0 0 0  axis 0 0 1  major_radius 2  minor_radius 1",
     {2, 0, 1},
     {0, 0, 1},
     0.25},
};

/* A gradient is 2 + 3 v, seen through a very small window at right angles to the surface. */
static void gradients_at_known_places(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof gradients / sizeof *gradients; i++) {
        const double *p = gradients[i].at, *n = gradients[i].normal;
        proof_radiance(
            (proof_row){proof_text("gradient, %s", gradients[i].name),
                        proof_text("v = %.4g", gradients[i].v), "2 + 3 v"},
            2 + 3 * gradients[i].v,
            proof_text("camera { projection orthographic  width 1e-4  look_at %.9g %.9g %.9g  eye "
                       "%.9g %.9g %.9g\n"
                       "  up 0.3 0.2 -0.1 }\n"
                       "texture steps { pattern gradient  a 2  b 5 }\nmaterial black { }\n"
                       "%s  material black  radiance 1  texture steps }\n",
                       p[0], p[1], p[2], p[0] + n[0], p[1] + n[1], p[2] + n[2], gradients[i].shape),
            &window);
    }
}

/* Four columns and two rows of numbers, the lower row first, in green. */
static void write_texels(const char *path, int width, int height, const float *texels)
{
    static const char *const names[] = {"R", "G", "B"};
    rt_image *image = NULL;
    rt_error error;
    expect_ok(rt_image_create(&image, (uint32_t)width, (uint32_t)height, names, 3, &error), &error);
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++)
            image->data[3 * ((height - 1 - y) * width + x) + 1] = texels[y * width + x];
    expect_ok(rt_image_write(image, path, NULL, &error), &error);
    rt_image_destroy(image);
}

/*
 * On a quad of 4 x 2 m, on which a texel is a square of 1 m with its number in the middle, and
 * linear between.
 */
static void images_at_known_places(void **state)
{
    static const float texels[] = {1, 2, 4, 8, 16, 32, 64, 128};
    static const struct {
        const char *what, *options;
        double u, v, expected;
    } gradients[] = {
        {"middle of the lower left texel", "", 0.125, 0.25, 1},
        {"middle of the upper left texel", "", 0.125, 0.75, 16},
        {"middle of the lower right texel", "", 0.875, 0.25, 8},
        {"between two texels", "", 0.25, 0.25, 1.5},
        {"a quarter of the way to the next", "", 0.4375, 0.75, 40},
        {"between four texels", "", 0.5, 0.5, (2 + 4 + 32 + 64) / 4.0},
        {"left edge, repeated", "offset -0.125 0", 0.125, 0.25, 4.5},
        {"left edge, clamped", "wrap clamp  offset -0.125 0", 0.125, 0.25, 1},
        {"left edge, mirrored", "wrap mirror  offset -0.125 0", 0.125, 0.25, 1},
        {"scaled by 2 in u", "scale 2 1", 0.1875, 0.25, 2},
        {"moved by 1/4 in u", "offset 0.25 0", 0.125, 0.25, 2},
        {"a whole turn on in u", "offset 1 0", 0.125, 0.25, 1},
    };
    (void)state;
    write_texels("texels.exr", 4, 2, texels);
    for (size_t i = 0; i < sizeof gradients / sizeof *gradients; i++)
        proof_radiance(
            (proof_row){proof_text("image, %s", gradients[i].what),
                        proof_text("u, v = %g, %g", gradients[i].u, gradients[i].v), "bilinear"},
            gradients[i].expected,
            proof_text("camera { projection orthographic  width 1e-9  eye %.9g %.9g 1  look_at "
                       "%.9g %.9g 0 }\n"
                       "texture numbers { file \"texels.exr\"  %s }\nmaterial black { }\n"
                       "quad { corner 0 0 0  edge1 4 0 0  edge2 0 2 0  material black  radiance 1  "
                       "texture numbers }\n",
                       4 * gradients[i].u, 2 * gradients[i].v, 4 * gradients[i].u,
                       2 * gradients[i].v, gradients[i].options),
            &window);
}

/*
 * The code 188 of an 8-bit file is ((188/255 + 0.055) / 1.055)^2.4 of light, or 188/255 where it is
 * linear.
 */
static void codes_of_files(void **state)
{
    static const float half[] = {0.5f};
    (void)state;
    write_texels("code.png", 1, 1, half);
    for (int linear = 0; linear < 2; linear++)
        proof_radiance(
            (proof_row){"image, code 188 of a PNG", linear ? "linear true" : "linear false",
                        linear ? "188/255" : "sRGB"},
            linear ? 188 / 255.0 : pow((188 / 255.0 + 0.055) / 1.055, 2.4),
            proof_text("camera { projection orthographic  width 1  eye 0 0 1  look_at 0 0 0 }\n"
                       "texture grey { file \"code.png\"  linear %s }\nmaterial black { }\n"
                       "quad { corner -1 -1 0  edge1 2 0 0  edge2 0 2 0  material black  radiance "
                       "1  texture grey }\n",
                       linear ? "true" : "false"),
            &window);
}

static void the_page_has_the_rows(void **state)
{
    (void)state;
    proof_page("Cameras and textures");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(squares_by_their_projection),
        cmocka_unit_test(other_cameras),
        cmocka_unit_test(edges_through_a_lens),
        cmocka_unit_test(discs_of_confusion),
        cmocka_unit_test(gradients_at_known_places),
        cmocka_unit_test_setup_teardown(images_at_known_places, scratch_enter, scratch_leave),
        cmocka_unit_test_setup_teardown(codes_of_files, scratch_enter, scratch_leave),
        cmocka_unit_test(the_page_has_the_rows),
    };
    return cmocka_run_group_tests_name("proof/camera", tests, NULL, NULL);
}
