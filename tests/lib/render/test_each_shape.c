/*
 * test_each_shape.c - what must hold of every shape: lettering is upright and unmirrored, and the
 * white-furnace test of closed ones of clear glass.
 */
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lib/image/scratch.h"
#include "scene/shape_class.h"
#include "shape_kinds.h"

enum { side = 192, pixels = side * side, glass_side = 64, glass_pixels = glass_side * glass_side };
static const float apart = 1e-3f; /* metres between rays that tell how coordinates run */

static rt_renderer *open_scene(rt_scene **scene, const char *text)
{
    rt_renderer *renderer = NULL;
    rt_error error;
    expect_ok(rt_scene_parse(scene, text, "test", NULL, &error), &error);
    expect_ok(rt_renderer_create(&renderer, *scene, test_device(), NULL, &error), &error);
    return renderer;
}

/* A square picture of so many pixels a side. */
static void render(float *rgb, uint32_t width, rt_renderer *renderer, rt_render_options options)
{
    rt_film *film = NULL;
    rt_error error;
    options.width = options.height = width;
    expect_ok(rt_render(&film, renderer, &options, &error), &error);
    memcpy(rgb, rt_film_rgb(film), (size_t)width * width * 3 * sizeof *rgb);
    rt_film_destroy(film);
}

/* ---- Lettering -------------------------------------------------------------------------- */

/*
 * The letter F, of 8 x 8 texels, and its middle a texel left of that of the picture: no turn or
 * mirror keeps it.
 */
enum { letter_side = 8 };
static const char *const letter[letter_side] = {"........", ".#####..", ".#......", ".#......",
                                                ".####...", ".#......", ".#......", "........"};

static void write_letter(const char *path)
{
    char text[32 + letter_side * letter_side * 12];
    int length = sprintf(text, "P3 %d %d 255\n", letter_side, letter_side);
    for (int y = 0; y < letter_side; y++)
        for (int x = 0; x < letter_side; x++)
            length += sprintf(text + length, letter[y][x] == '#' ? "0 0 0\n" : "255 255 255\n");
    scratch_write(path, text);
}

/*
 * How black the letter is at texture coordinates that the texture's scale has multiplied; -1 near
 * the edge of a texel.
 */
static int letter_at(double u, double v)
{
    const double x = (u - floor(u)) * letter_side, y = (1 - (v - floor(v))) * letter_side;
    const double from_x = fabs(x - floor(x) - 0.5), from_y = fabs(y - floor(y) - 0.5);
    if (from_x > 0.15 || from_y > 0.15)
        return -1;
    return letter[(int)y % letter_side][(int)x % letter_side] == '#';
}

static const struct lettered {
    const char *name, *shape;
    int is_upright; /* v points up; else, as on a disc, outwards */
} lettered[] = {
    {"plane", "plane { point 0 0 0  normal 0 0 1", 1},
    {"quad", "quad { corner -0.9 -0.9 0  edge1 1.8 0 0  edge2 0 1.8 0", 1},
    {"triangle", "triangle { a -0.9 -0.9 0  b 0.9 -0.9 0  c -0.9 0.9 0  uva 0 0  uvb 1 0  uvc 0 1",
     1},
    {"triangle without coordinates", "triangle { a -0.9 -0.9 0  b 0.9 -0.9 0  c -0.9 0.9 0", 1},
    {"disc", "disc { centre 0 0 0  normal 0 0 1  radius 0.9", 0},
    {"ring", "disc { centre 0 0 0  normal 0 0 1  radius 0.9  inner_radius 0.3", 0},
    {"sphere", "sphere { centre 0 0 0  radius 0.9", 1},
    {"ellipsoid", "ellipsoid { centre 0 0 0  radii 0.6 0.9 0.8", 1},
    {"cylinder", "cylinder { a 0 -0.9 0  b 0 0.9 0  radius 0.6", 1},
    {"cap of a cylinder", "cylinder { a 0 0 -1  b 0 0 0  radius 0.9", 0},
    {"cone", "cone { base 0 -0.9 0  apex 0 0.9 0  radius 0.8", 1},
    {"frustum", "cone { base 0 -0.9 0  apex 0 0.9 0  radius 0.8  apex_radius 0.4", 1},
    {"torus", "torus { centre 0 0 0  axis 0 1 0  major_radius 0.6  minor_radius 0.3", 1},
    {"box", "box { centre 0 0 -0.5  size 1.8 1.8 1", 1},
    {"right side of a box", "box { centre 0 0 0  size 1 1.8 1.6  rotate 0 1 0 -90", 1},
    {"back of a box", "box { centre 0 0 0  size 1.6 1.8 1  rotate 0 1 0 180", 1},
    {"left side of a box", "box { centre 0 0 0  size 1 1.8 1.6  rotate 0 1 0 90", 1},
    {"top of a box", "box { centre 0 0 0  size 1.6 1 1.8  rotate 1 0 0 90", 1},
    {"box that is turned", "box { centre 0 0 0  size 1.2 1.2 1.2  rotate 0 1 0 35  rotate 1 0 0 20",
     1},
    {"sphere that is turned", "sphere { centre 0 0 0  radius 0.9  rotate 0 1 0 130", 1},
};

/*
 * Rays that go along -z, a pixel of a picture 2 m wide apart, each with one to its right and one
 * above.
 */
static void make_rays(rt_ray rays[3 * pixels])
{
    memset(rays, 0, 3 * pixels * sizeof *rays);
    for (int i = 0; i < 3 * pixels; i++) {
        const int pixel = i / 3;
        rays[i].origin[0] =
            ((float)(pixel % side) + 0.5f) * 2 / side - 1 + (i % 3 == 1 ? apart : 0);
        rays[i].origin[1] =
            1 - ((float)(pixel / side) + 0.5f) * 2 / side + (i % 3 == 2 ? apart : 0);
        rays[i].origin[2] = 2;
        rays[i].direction[2] = -1;
        rays[i].t_max = INFINITY;
    }
}

/* The change of a coordinate that begins again at 1. */
static double change(double from, double to)
{
    return to - from - rint(to - from);
}

static void expect_upright(const struct lettered *shape, const rt_hit hits[3 * pixels],
                           const rt_ray *rays)
{
    int seen = 0;
    for (int i = 0; i < pixels; i++) {
        const rt_hit *hit = hits + 3 * i;
        const double x = rays[3 * i].origin[0], y = rays[3 * i].origin[1];
        if (hit[0].shape == RT_NONE || hit[1].shape == RT_NONE || hit[2].shape == RT_NONE ||
            hit[0].normal[2] < 0.3f)
            continue;
        const double du_dx = change(hit[0].u, hit[1].u), du_dy = change(hit[0].u, hit[2].u);
        const double dv_dx = change(hit[0].v, hit[1].v), dv_dy = change(hit[0].v, hit[2].v);
        if (!(du_dx * dv_dy - du_dy * dv_dx > 0))
            fail_msg("%s: mirrored at (%g, %g)", shape->name, x, y);
        if (!((shape->is_upright ? dv_dy : x * dv_dx + y * dv_dy) > 0))
            fail_msg("%s: upside down at (%g, %g)", shape->name, x, y);
        seen++;
    }
    assert_true(seen > pixels / 10);
}

/*
 * Whether half a pixel, by which a sample may lie off the middle, is less than a seventh of a
 * texel: then black stays below 1/2.
 */
static int is_large(const rt_hit *hit)
{
    const double texels = 0.5 * 2 / side / apart * 2 * letter_side;
    const double right = fmax(fabs(change(hit[0].u, hit[1].u)), fabs(change(hit[0].v, hit[1].v)));
    const double up = fmax(fabs(change(hit[0].u, hit[2].u)), fabs(change(hit[0].v, hit[2].v)));
    return fmax(right, up) * texels < 0.14;
}

/* The picture shows the letter where the coordinates have it. */
static void expect_letters(const struct lettered *shape, const rt_hit hits[3 * pixels],
                           const float *rgb)
{
    int black = 0, white = 0;
    for (int i = 0; i < pixels; i++) {
        const rt_hit *hit = hits + 3 * i;
        if (hit[0].shape == RT_NONE || hit[1].shape == RT_NONE || hit[2].shape == RT_NONE ||
            !is_large(hit))
            continue;
        const int expected = letter_at(2 * hit[0].u, 2 * hit[0].v);
        if (expected < 0)
            continue;
        if ((rgb[3 * i] < 0.5f) != (expected == 1))
            fail_msg("%s: %g where the letter is %s", shape->name, rgb[3 * i],
                     expected ? "black" : "white");
        *(expected ? &black : &white) += 1;
    }
    if (black == 0 || white == 0)
        fail_msg("%s: %d black and %d white pixels tell the letter", shape->name, black, white);
}

static void lettering_is_upright_and_unmirrored_on_every_shape(void **state)
{
    static rt_ray rays[3 * pixels];
    static rt_hit hits[3 * pixels];
    static float rgb[3 * pixels];
    int seen[SHAPE_KINDS_MAX] = {[RT_SHAPE_INSTANCE] = 1}; /* triangles, but placed twice */
    char text[1024];
    (void)state;
    write_letter("letter.ppm");
    make_rays(rays);
    for (size_t i = 0; i < sizeof lettered / sizeof *lettered; i++) {
        rt_scene *scene = NULL;
        rt_error error;
        snprintf(text, sizeof text,
                 "camera { projection orthographic  eye 0 0 2  look_at 0 0 0  width 2 }\nlight "
                 "environment { radiance 1 }\n"
                 "texture letter { file \"letter.ppm\"  scale 2 2 }\nmaterial paper { kd_texture "
                 "letter }\n"
                 "%s  material paper }\n",
                 lettered[i].shape);
        rt_renderer *renderer = open_scene(&scene, text);
        expect_ok(rt_trace(renderer, RT_TRACE_CLOSEST, rays, 3 * pixels, hits, &error), &error);
        render(rgb, side, renderer, (rt_render_options){.mode = RT_MODE_ALBEDO, .spp = 1});
        expect_upright(lettered + i, hits, rays);
        expect_letters(lettered + i, hits, rgb);
        seen[scene->shapes[0].kind] = 1;
        rt_renderer_destroy(renderer);
        rt_scene_destroy(scene);
    }
    RT_SHAPES(EXPECT_SEEN)
}

/* ---- Glass ------------------------------------------------------------------------------ */

/* For EXPECT_SEEN, which shapes that have no inside pass. */
#define MARK_OPEN(KIND, name, number)                                                              \
    seen[RT_SHAPE_##KIND] |= !rt_shape_class_of(RT_SHAPE_##KIND)->contains;

static void clear_glass_of_every_closed_shape_passes_the_white_furnace(void **state)
{
    static const struct {
        const char *name, *shape;
    } closed[] = {
        {"sphere", "sphere { centre 0 0 0  radius 1"},
        {"ellipsoid", "ellipsoid { centre 0 0 0  radii 1 0.5 0.7  rotate 0 0 1 30"},
        {"cylinder", "cylinder { a 0 -0.7 0  b 0 0.7 0  radius 0.8"},
        {"cone", "cone { base 0 -0.7 0  apex 0 0.8 0  radius 0.9"},
        {"frustum", "cone { base 0 -0.7 0  apex 0 0.7 0  radius 0.9  apex_radius 0.4"},
        {"torus", "torus { centre 0 0 0  axis 0 1 0.3  major_radius 0.8  minor_radius 0.3"},
        {"box", "box { centre 0 0.1 0  size 1.4 0.9 1.1  rotate 0 1 0 30"},
        {"flat mesh", "model { file \"octahedron.off\"  shading flat"},
    };
    static float rgb[3 * glass_pixels];
    int seen[SHAPE_KINDS_MAX] = {[RT_SHAPE_INSTANCE] = 1}; /* triangles, but placed twice */
    char text[1024];
    (void)state;
    scratch_write(
        "octahedron.off",
        "OFF\n6 8 12\n1 0 0\n-1 0 0\n0 1 0\n0 -1 0\n0 0 1\n0 0 -1\n3 0 2 4\n3 2 1 4\n3 1 3 4\n"
        "3 3 0 4\n3 2 0 5\n3 1 2 5\n3 3 1 5\n3 0 3 5\n");
    for (size_t i = 0; i < sizeof closed / sizeof *closed; i++) {
        rt_scene *scene = NULL;
        snprintf(
            text, sizeof text,
            "camera { eye 0.4 1.5 -3  look_at 0 0 0  fov 40 }\nlight environment { radiance 1 }\n"
            "material glass { kt 1  ior 1.5  fresnel dielectric }\n%s  material glass }\n",
            closed[i].shape);
        rt_renderer *renderer = open_scene(&scene, text);
        /* Light that total reflection holds back leaves at last. */
        render(rgb, glass_side, renderer, (rt_render_options){.spp = 8, .max_depth = 4096});
        for (int k = 0; k < 3 * glass_pixels; k++)
            if (!(fabsf(rgb[k] - 1) < 5e-3f))
                fail_msg("%s of glass: a pixel of %g", closed[i].name, rgb[k]);
        seen[scene->shapes[0].kind] = 1;
        rt_renderer_destroy(renderer);
        rt_scene_destroy(scene);
    }
    RT_SHAPES(MARK_OPEN)
    RT_SHAPES(EXPECT_SEEN)
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(lettering_is_upright_and_unmirrored_on_every_shape,
                                        scratch_enter, scratch_leave),
        cmocka_unit_test_setup_teardown(clear_glass_of_every_closed_shape_passes_the_white_furnace,
                                        scratch_enter, scratch_leave),
    };
    return cmocka_run_group_tests_name("render/each shape", tests, NULL, NULL);
}
