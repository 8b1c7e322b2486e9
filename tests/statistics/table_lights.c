/* table_lights.c - directions of light paths from projectors, luminaires and images of spots. */
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "image/image_file.h"
#include "kernels/light_draw.h"
#include "statistics/emitters.h"
#include "statistics/space.h"

static emission_draw draws[most_samples];

static double radians(double degrees)
{
    return degrees * PI / 180;
}

/* ---- Images -------------------------------------------------------------------------- */

enum { width = 4, height = 3 };

static double texel(int x, int y)
{
    return x == 1 && y == 1 ? 0 : x == 2 && y == 0 ? 30 : 1 + (x * 5 + y * 3) % 7;
}

static const char *write_picture(void)
{
    static const char file[] = "slide.pfm";
    static const char *const names[] = {"R", "G", "B"};
    rt_image *image = NULL;
    rt_error error;
    expect_ok(rt_image_create(&image, width, height, names, 3, &error), &error);
    for (int i = 0; i < 3 * width * height; i++)
        image->data[i] = (float)texel(i / 3 % width, i / 3 / width);
    expect_ok(rt_image_write(image, file, NULL, &error), &error);
    rt_image_destroy(image);
    return file;
}

/* The axis of all of these, and the directions to the right of it and down. */
static const double axis[3] = {0.6, 0, -0.8}, right[3] = {0.8, 0, 0.6}, down[3] = {0, -1, 0};
static const float position[3] = {1, 2, 3}, target[3] = {1.6f, 2, 2.2f};
static const double half = 0.8; /* of the image's width, on the plane at distance 1 */

/* Even in each texel, so that what light paths choose is known; by irradiance, or in a cone. */
static rt_scene *projector_scene(const void *setup)
{
    rt_projector_light light = {
        .irradiance = {5, 5, 5}, .path = write_picture(), .filter = RT_TEXTURE_FILTER_NEAREST};
    rt_scene *scene = light_scene();
    rt_error error;
    (void)setup;
    memcpy(light.position, position, sizeof position);
    memcpy(light.target, target, sizeof target);
    light.fov = (float)(2 * atan(half) * 180 / PI);
    expect_ok(rt_scene_add_projector_light(scene, &light, &error), &error);
    return scene;
}

static void draw_projector(const void *setup, uint32_t seed, uint32_t count)
{
    draw_many_emissions(kept_renderer(setup, projector_scene), seed, count, draws);
}

/* Where a direction meets the plane, as parts of the image, and its cosine to the axis. */
static double on_plane(const double w[3], double across, double along, double *x, double *y)
{
    const double cosine = dot3(w, axis);
    *x = 0.5 + 0.5 * dot3(w, right) / cosine / across;
    *y = 0.5 + 0.5 * dot3(w, down) / cosine / along;
    return cosine;
}

static double of_projector(const void *setup, double x, double y)
{
    (void)setup;
    return texel((int)fmin(x * width, width - 1), (int)fmin(y * height, height - 1));
}

static sampled place_projector(const void *setup, uint32_t i)
{
    const double along = half * height / width;
    sampled s = {0, 0, NAN};
    double w[3];
    wide(w, draws[i].direction);
    const double cosine = on_plane(w, half, along, &s.x, &s.y);
    /* An area of the plane is 1 / cos^3 of its solid angle. */
    const double intensity = 5 * of_projector(setup, s.x, s.y) / pow(cosine, 3);
    s.pdf = intensity / draws[i].flux[0] * 4 * half * along * pow(cosine, 3);
    return s;
}

/* ---- Luminaires ------------------------------------------------------------------------- */

/* Vertical angles whose cosines are even; on both sides of a plane. */
static const double candela[3][5] = {{8, 6, 4, 2, 1}, {5, 5, 2, 1, 0}, {1, 2, 3, 4, 0}};

static const char *write_ies(void)
{
    static const char name[] = "luminaire.ies";
    FILE *file = fopen(name, "w");
    assert_non_null(file);
    fprintf(file, "IESNA:LM-63-1995\nTILT=NONE\n1 1000 2 5 3 1 2 0 0 0\n1 1 10\n");
    for (int i = 0; i < 5; i++)
        fprintf(file, "%.9g ", acos(1 - 0.25 * i) * 180 / PI);
    fprintf(file, "\n0, 90, 180\n");
    for (int i = 0; i < 15; i++)
        fprintf(file, "%g\n", candela[i / 5][i % 5] / 2);
    assert_int_equal(fclose(file), 0);
    return name;
}

static rt_scene *luminaire_scene(const void *setup)
{
    rt_goniometric_light light = {.up = {0, 1, 0}, .intensity = {3, 3, 3}, .path = write_ies()};
    rt_scene *scene = light_scene();
    rt_error error;
    (void)setup;
    memcpy(light.position, position, sizeof position);
    memcpy(light.target, target, sizeof target);
    expect_ok(rt_scene_add_goniometric_light(scene, &light, &error), &error);
    return scene;
}

static void draw_luminaire(const void *setup, uint32_t seed, uint32_t count)
{
    draw_many_emissions(kept_renderer(setup, luminaire_scene), seed, count, draws);
}

/* The values at the corners of the cell that holds a point of the square. */
static void corners_at(double x, double y, double out[2][2])
{
    static const int planes[5] = {0, 1, 2, 1, 0};
    const int column = (int)fmin(4 * x, 3), row = (int)fmin(4 * y, 3);
    for (int i = 0; i < 4; i++)
        out[i / 2][i % 2] = candela[planes[column + i % 2]][row + i / 2];
}

static double of_luminaire(const void *setup, double x, double y)
{
    double c[2][2];
    (void)setup;
    corners_at(x, y, c);
    return c[0][0] + c[0][1] + c[1][0] + c[1][1];
}

/* Bilinear in the angles. */
static double intensity_at(double x, double y, double polar)
{
    const double row = fmin(floor(4 * y), 3), lo = acos(1 - 0.25 * row),
                 hi = acos(0.75 - 0.25 * row), v = (polar - lo) / (hi - lo),
                 u = 4 * x - fmin(floor(4 * x), 3);
    double c[2][2];
    corners_at(x, y, c);
    return 3 *
           ((c[0][0] * (1 - u) + c[0][1] * u) * (1 - v) + (c[1][0] * (1 - u) + c[1][1] * u) * v);
}

/* From up counter-clockwise as seen along the axis, which is to the left. */
static sampled place_luminaire(const void *setup, uint32_t i)
{
    sampled s = {0, 0, NAN};
    double w[3];
    (void)setup;
    wide(w, draws[i].direction);
    const double turn = atan2(-dot3(w, right), -dot3(w, down)), cosine = dot3(w, axis);
    s.x = turn / (2 * PI);
    s.x -= floor(s.x);
    s.y = 1 - cosine;
    s.pdf = intensity_at(s.x, s.y, acos(fmin(1, cosine))) / draws[i].flux[0] * 2 * PI;
    return s;
}

/* ---- The image of a spot -------------------------------------------------------------------- */

/* So narrow in its edge that what it is chosen by is nearly what it emits. */
static const double outer = 40;

static rt_scene *gobo_scene(const void *setup)
{
    rt_spot_light light = {.intensity = {5, 5, 5},
                           .inner = (float)outer,
                           .outer = (float)outer,
                           .falloff = RT_FALLOFF_LINEAR,
                           .path = write_picture(),
                           .filter = RT_TEXTURE_FILTER_NEAREST};
    rt_scene *scene = light_scene();
    rt_error error;
    (void)setup;
    memcpy(light.position, position, sizeof position);
    memcpy(light.target, target, sizeof target);
    expect_ok(rt_scene_add_spot_light(scene, &light, &error), &error);
    return scene;
}

static void draw_gobo(const void *setup, uint32_t seed, uint32_t count)
{
    draw_many_emissions(kept_renderer(setup, gobo_scene), seed, count, draws);
}

/* A cell counts by its value times cos^3 at its point nearest to the axis. */
static double of_gobo(const void *setup, double x, double y)
{
    const int column = (int)fmin(x * width, width - 1), row = (int)fmin(y * height, height - 1);
    const double side = tan(radians(outer)), lo_u = (2.0 * column / width - 1) * side,
                 hi_u = lo_u + 2 * side / width, lo_v = (2.0 * row / height - 1) * side,
                 hi_v = lo_v + 2 * side / height, u = fmax(lo_u, fmin(hi_u, 0)),
                 v = fmax(lo_v, fmin(hi_v, 0));
    (void)setup;
    return texel(column, row) * pow(1 + u * u + v * v, -1.5);
}

static sampled place_gobo(const void *setup, uint32_t i)
{
    const double side = tan(radians(outer));
    sampled s = {0, 0, NAN};
    double w[3];
    wide(w, draws[i].direction);
    const double cosine = on_plane(w, side, side, &s.x, &s.y);
    /* In the corners beyond the cone there is no light. */
    if (cosine > cos(radians(outer)) + 1e-4)
        s.pdf =
            5 * of_projector(setup, s.x, s.y) / draws[i].flux[0] * 4 * side * side * pow(cosine, 3);
    return s;
}

/* ---- Table ----------------------------------------------------------------------------- */

static const method by_projector = {draw_projector, place_projector, of_projector, 1, 0};
static const method by_luminaire = {draw_luminaire, place_luminaire, of_luminaire, 1, 0};
static const method by_gobo = {draw_gobo, place_gobo, of_gobo, 1, 0};

static const routine routines[] = {
    {"emission: projector", 4 * width, 4 * height, &by_projector, "a projector"},
    {"emission: luminaire", 16, 16, &by_luminaire, "a luminaire"},
    {"emission: spot with an image", 4 * width, 4 * height, &by_gobo, "a spot"},
};

const routine_table table_light_routines = {routines, sizeof routines / sizeof *routines};
