/*
 * Textures inside of others on the device: against their definitions, evaluated in double by a
 * function that calls itself, with a map at each level.
 */
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "lib/scene/scenes.h"
#include "scene/scene.h"

enum { side = 4, points = 256, textures_most = 200 };

static const char image_path[] = "nested.pfm";
static float image_values[side * side * 3]; /* top row first */

/* Textures as they were added; handles count from 1. */
static rt_texture added[textures_most];
static int levels[textures_most];
static uint32_t added_count;

static uint32_t random_bits(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return *state >> 8;
}

static float random_from_to(uint32_t *state, double lo, double hi)
{
    return (float)(lo + (hi - lo) * (random_bits(state) & 0xffff) / 65536);
}

static void write_image(void)
{
    rt_image *image = NULL;
    rt_error error;
    uint32_t state = 3;
    for (int i = 0; i < side * side * 3; i++)
        image_values[i] = (float)(100 + random_bits(&state) % 900) / 1024; /* halves hold it */
    expect_ok(rt_image_from_rgb(&image, image_values, side, side, &error), &error);
    expect_ok(rt_image_write(image, image_path, NULL, &error), &error);
    rt_image_destroy(image);
}

/* ---- The definitions ----------------------------------------------------------- */

static int wrapped(long i)
{
    return (int)((i % side + side) % side);
}

static double image_at(double s, double t, int channel)
{
    const double x = s * side - 0.5, y = t * side - 0.5;
    const long i = (long)floor(x), j = (long)floor(y);
    double sum = 0;
    for (int dj = 0; dj < 2; dj++)
        for (int di = 0; di < 2; di++)
            sum +=
                (di ? x - floor(x) : 1 - x + floor(x)) * (dj ? y - floor(y) : 1 - y + floor(y)) *
                image_values[3 * ((side - 1 - wrapped(j + dj)) * side + wrapped(i + di)) + channel];
    return sum;
}

static void mapped(const rt_texture *t, double *u, double *v)
{
    const double angle = t->rotate * 3.14159265358979323846 / 180, c = cos(angle), s = sin(angle),
                 x = (t->scale[0] == 0 ? 1 : t->scale[0]) * *u + t->shear * *v,
                 y = (t->scale[1] == 0 ? 1 : t->scale[1]) * *v;
    *u = c * x - s * y + t->offset[0];
    *v = s * x + c * y + t->offset[1];
}

static int is_edge(double x)
{
    return fabs(x - nearbyint(x)) < 1e-3;
}

static int define(double out[3], uint32_t handle, double u, double v);

/* A colour, a texture, or their product; returns whether it is too near to an edge to be told. */
static int part(double out[3], const float colour[3], uint32_t handle, double u, double v)
{
    const int is_black = colour[0] == 0 && colour[1] == 0 && colour[2] == 0;
    int edge = 0;
    for (int c = 0; c < 3; c++)
        out[c] = 1;
    if (handle)
        edge = define(out, handle, u, v);
    for (int c = 0; c < 3; c++)
        out[c] *= handle && is_black ? 1 : colour[c];
    return edge;
}

static int define(double out[3], uint32_t handle, double u, double v)
{
    const rt_texture *t = &added[handle - 1];
    const float weight = t->weight != 0      ? t->weight
                         : t->weight_texture ? 1
                                             : 0.5f,
                grey[3] = {weight, weight, weight};
    double s = u, r = v, a[3], b[3], w[3];
    mapped(t, &s, &r);
    if (t->kind == RT_TEXTURE_IMAGE) {
        for (int c = 0; c < 3; c++)
            out[c] = image_at(s, r, c);
        return 0;
    }
    const int moves = t->kind == RT_TEXTURE_MULTIPLY || t->kind == RT_TEXTURE_MIX;
    int edge = part(a, t->a, t->a_texture, moves ? s : u, moves ? r : v) |
               part(b, t->b, t->b_texture, moves ? s : u, moves ? r : v);
    if (t->kind == RT_TEXTURE_MIX) {
        edge |= part(w, grey, t->weight_texture, s, r);
        w[0] = (w[0] + w[1] + w[2]) / 3;
    } else if (t->kind == RT_TEXTURE_GRADIENT) {
        w[0] = fabs(r - 2 * nearbyint(r / 2)); /* all of them are mirrored */
    } else if (t->kind == RT_TEXTURE_CHECKER) {
        edge |= is_edge(s) || is_edge(r);
        w[0] = fmod(fabs(floor(s) + floor(r)), 2);
    } else {
        w[0] = 0;
    }
    for (int c = 0; c < 3; c++)
        out[c] = t->kind == RT_TEXTURE_MULTIPLY ? a[c] * b[c] : (1 - w[0]) * a[c] + w[0] * b[c];
    return edge;
}

/* ---- The device ------------------------------------------------------------------ */

/* The rows of one texture and of all behind it, as they lie in the table of a scene. */
static cl_mem rows_of(const rt_scene *scene, uint32_t handle)
{
    static rt_texture_data rows[1 + 256];
    const rt_texture_data *one = &scene->textures[handle - 1].data;
    size_t count = 1;
    rows[0] = *one;
    if (one->kind == RT_TEXTURE_NESTED) {
        assert_true(one->rows <= 256);
        rows[0].texels = 1;
        memcpy(rows + 1, scene->texture_rows + one->texels, one->rows * sizeof *rows);
        count += one->rows;
    }
    return test_buffer(count * sizeof *rows, rows);
}

static void evaluate(const char *name, const rt_scene *scene, uint32_t handle, float uv[points][2],
                     float *out, size_t floats)
{
    const cl_uint count = points;
    cl_kernel kernel = test_kernel("texture", name);
    cl_mem t = rows_of(scene, handle), in = test_buffer(2 * points * sizeof(float), uv);
    cl_mem texels = test_texels(scene->texels.data, scene->texels.size);
    cl_mem result = test_buffer(points * floats * sizeof *out, NULL);
    rt_arg args[] = {RT_ARG(count), RT_ARG(t), RT_ARG(texels), RT_ARG(in), RT_ARG(result)};
    test_run(kernel, args, 5, points);
    test_read(result, points * floats * sizeof *out, out);
    rt_buffer_release(test_device(), result);
    rt_buffer_release(test_device(), texels);
    rt_buffer_release(test_device(), in);
    rt_buffer_release(test_device(), t);
    rt_kernel_release(kernel);
}

static void random_points(float uv[points][2], uint32_t seed)
{
    for (int i = 0; i < points; i++)
        for (int k = 0; k < 2; k++)
            uv[i][k] = random_from_to(&seed, -2, 3);
}

/* Compares one texture at all points that are not on the edge of a square; returns how many. */
static int expect_defined(const rt_scene *scene, uint32_t handle)
{
    const rt_scene_texture *texture = scene->textures + handle - 1;
    static float uv[points][2], out[points][4];
    int compared = 0;
    random_points(uv, 17 * handle);
    evaluate("colours", scene, handle, uv, out[0], 4);
    for (int i = 0; i < points; i++) {
        double expected[3];
        if (define(expected, handle, uv[i][0], uv[i][1]))
            continue;
        compared++;
        for (int c = 0; c < 3; c++) {
            if (!(fabs(out[i][c] - expected[c]) <= 2e-4))
                fail_msg("texture %u at %g %g: %g in place of %g", handle, uv[i][0], uv[i][1],
                         out[i][c], expected[c]);
            assert_true(out[i][c] <= texture->largest[c] + 1e-5f &&
                        out[i][c] >= texture->least - 1e-5f);
        }
    }
    return compared;
}

static uint32_t add(rt_scene *scene, const rt_texture *texture)
{
    rt_error error;
    uint32_t handle = 0;
    expect_ok(rt_scene_add_texture(scene, &handle, texture, &error), &error);
    assert_int_equal(handle, added_count + 1);
    added[added_count++] = *texture;
    return handle;
}

static rt_scene *begin(void)
{
    write_image();
    added_count = 0;
    return new_scene();
}

/* ---- Tests ----------------------------------------------------------------------- */

static void each_pattern_is_its_definition(void **state)
{
    (void)state;
    rt_scene *scene = begin();
    const uint32_t image = add(scene, &(rt_texture){.path = image_path, .scale = {2, 3}}),
                   squares = add(scene, &(rt_texture){.kind = RT_TEXTURE_CHECKER,
                                                      .a = {0.1f, 0.2f, 0.3f},
                                                      .b = {0.9f, 0.5f, 1},
                                                      .rotate = 30});
    const rt_texture cases[] = {
        {.kind = RT_TEXTURE_CONSTANT, .a = {0.25f, 0.5f, 0.75f}, .b = {9, 9, 9}},
        {.kind = RT_TEXTURE_MULTIPLY, .a_texture = image, .b = {0.5f, 0.25f, 0.125f}},
        {.kind = RT_TEXTURE_MULTIPLY, .a = {0.5f, 0.25f, 1}, .b_texture = image},
        {.kind = RT_TEXTURE_MULTIPLY, .a_texture = image, .b_texture = squares},
        {.kind = RT_TEXTURE_MULTIPLY, .a = {0.5f, 0.5f, 0.5f}, .b = {0.5f, 1, 0.25f}},
        {.kind = RT_TEXTURE_MIX, .a = {1, 0, 0}, .b = {0, 0, 1}},
        {.kind = RT_TEXTURE_MIX, .a = {1, 0, 0}, .b_texture = squares, .weight = 0.125f},
        {.kind = RT_TEXTURE_MIX, .a_texture = image, .b = {0, 1, 0}, .weight_texture = squares},
        {.kind = RT_TEXTURE_MIX,
         .a_texture = image,
         .b_texture = squares,
         .weight = 0.5f,
         .weight_texture = image},
        {.kind = RT_TEXTURE_CHECKER, .a_texture = image, .b = {0.5f, 0, 1}, .scale = {4, 4}},
        {.kind = RT_TEXTURE_CHECKER,
         .a = {0.5f, 0.25f, 1},
         .a_texture = image,
         .b_texture = squares,
         .offset = {0.25f, 0.5f}},
        {.kind = RT_TEXTURE_GRADIENT,
         .wrap = RT_WRAP_MIRROR,
         .a_texture = squares,
         .b_texture = image},
        {.kind = RT_TEXTURE_GRADIENT, .wrap = RT_WRAP_MIRROR, .b_texture = image, .rotate = 45},
        {.kind = RT_TEXTURE_MULTIPLY, .a_texture = image, .b = {1, 1, 1}, .scale = {2, -0.5f}},
        {.kind = RT_TEXTURE_MIX,
         .a_texture = image,
         .b_texture = squares,
         .weight_texture = squares,
         .scale = {0.5f, 2},
         .shear = 0.25f,
         .rotate = 60,
         .offset = {0.1f, 0.7f}}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_true(expect_defined(scene, add(scene, &cases[i])) > points / 2);
    assert_int_equal(scene->textures[image - 1].data.kind, RT_TEXTURE_IMAGE);
    assert_int_equal(scene->textures[2].data.kind, RT_TEXTURE_CONSTANT);
    rt_scene_destroy(scene);
}

/* A texture of random parts among those that were added. */
static rt_texture random_texture(uint32_t *state, int *level)
{
    rt_texture t = {.kind = (rt_texture_kind)(random_bits(state) % 6), .wrap = RT_WRAP_MIRROR};
    uint32_t *const parts[] = {&t.a_texture, &t.b_texture, &t.weight_texture};
    *level = 1;
    for (int c = 0; c < 3; c++) {
        t.a[c] = random_from_to(state, 0.1, 1);
        t.b[c] = random_from_to(state, 0.1, 1);
    }
    for (int i = 0; i < 2; i++) {
        t.scale[i] = random_from_to(state, 0.75, 1.25) * (random_bits(state) & 1 ? 1 : -1);
        t.offset[i] = random_from_to(state, -1, 1);
    }
    t.shear = random_from_to(state, -0.5, 0.5);
    t.rotate = random_from_to(state, -180, 180);
    if (t.kind == RT_TEXTURE_IMAGE) {
        t.path = image_path;
        t.wrap = RT_WRAP_REPEAT;
    }
    for (int i = 0; i < (t.kind == RT_TEXTURE_MIX ? 3 : 2); i++)
        if (added_count > 0 && t.kind != RT_TEXTURE_IMAGE && t.kind != RT_TEXTURE_CONSTANT &&
            random_bits(state) % 8 < 5) {
            const uint32_t recent = added_count < 20 ? added_count : 20;
            *parts[i] = added_count - random_bits(state) % recent;
            if (levels[*parts[i] - 1] >= *level)
                *level = levels[*parts[i] - 1] + 1;
        }
    return t;
}

static void random_ones_are_their_definitions(void **state)
{
    uint32_t random = 5;
    int refused = 0, deepest = 0;
    (void)state;
    rt_scene *scene = begin();
    for (int i = 0; i < textures_most; i++) {
        int level;
        rt_error error;
        const rt_texture t = random_texture(&random, &level);
        const rt_status status = rt_scene_add_texture(scene, NULL, &t, &error);
        if (status != RT_OK && level <= RT_TEXTURE_LEVELS) {
            assert_non_null(strstr(error.message, "more than 256"));
            continue;
        }
        assert_int_equal(status, level > RT_TEXTURE_LEVELS ? RT_ERROR_INPUT : RT_OK);
        refused += status != RT_OK;
        if (status != RT_OK)
            continue;
        deepest = level > deepest ? level : deepest;
        levels[added_count] = level;
        added[added_count++] = t;
        assert_int_equal(scene->texture_count, added_count);
        assert_true(expect_defined(scene, added_count) >= points / 4);
    }
    assert_true(refused > 0 && added_count > textures_most / 2);
    assert_int_equal(deepest, RT_TEXTURE_LEVELS);
    rt_scene_destroy(scene);
}

/* Weights in weights keep two colours each: the most that the stack ever holds. */
static void the_deepest_weights_have_room(void **state)
{
    (void)state;
    rt_scene *scene = begin();
    uint32_t inner = 0;
    for (int i = 0; i < RT_TEXTURE_LEVELS; i++) {
        inner = add(scene, &(rt_texture){.kind = RT_TEXTURE_MIX,
                                         .a = {0.1f, 0.2f, 0.3f},
                                         .b = {0.9f, 0.6f, (float)i / 8},
                                         .weight_texture = inner});
        assert_int_equal(expect_defined(scene, inner), points);
    }
    rt_scene_destroy(scene);
}

/* h = s t with s = 2 u, t = v + u / 2, and a mixture that a gradient weighs. */
static void slopes_follow_the_rules_of_products(void **state)
{
    static float uv[points][2], slope[points][2];
    (void)state;
    rt_scene *scene = begin();
    const uint32_t along = add(scene, &(rt_texture){.kind = RT_TEXTURE_GRADIENT,
                                                    .wrap = RT_WRAP_CLAMP,
                                                    .b = {1, 1, 1},
                                                    .rotate = 90}),
                   across = add(scene, &(rt_texture){.kind = RT_TEXTURE_GRADIENT,
                                                     .wrap = RT_WRAP_CLAMP,
                                                     .b = {1, 1, 1}}),
                   product = add(scene, &(rt_texture){.kind = RT_TEXTURE_MULTIPLY,
                                                      .a_texture = along,
                                                      .b_texture = across,
                                                      .scale = {0.5f, 0.25f}}),
                   mixture = add(scene, &(rt_texture){.kind = RT_TEXTURE_MIX,
                                                      .a_texture = along,
                                                      .b = {0.5f, 0.5f, 0.5f},
                                                      .weight_texture = across});
    for (int i = 0; i < points; i++) {
        uv[i][0] = 0.1f + 0.8f * (float)(i % 16) / 16;
        uv[i][1] = 0.1f + 0.8f * (float)(i / 16) / 16;
    }
    evaluate("slopes", scene, product, uv, slope[0], 2);
    for (int i = 0; i < points; i++) {
        assert_float_equal(slope[i][0], 0.125 * uv[i][1], 1e-4);
        assert_float_equal(slope[i][1], 0.125 * uv[i][0], 1e-4);
    }
    evaluate("slopes", scene, mixture, uv, slope[0], 2);
    for (int i = 0; i < points; i++) {
        assert_float_equal(slope[i][0], 1 - uv[i][1], 1e-4);
        assert_float_equal(slope[i][1], 0.5 - uv[i][0], 1e-4);
    }
    rt_scene_destroy(scene);
}

/* The slope inside of another is that of the image itself: half a texel to each side of a point. */
static void an_image_inside_has_its_own_slopes(void **state)
{
    static float uv[points][2], alone[points][2], inside[points][2];
    (void)state;
    rt_scene *scene = begin();
    const uint32_t image = add(scene, &(rt_texture){.path = image_path, .scale = {32, 64}}),
                   same = add(scene, &(rt_texture){.kind = RT_TEXTURE_MULTIPLY,
                                                   .a_texture = image,
                                                   .b = {1, 1, 1}});
    random_points(uv, 8);
    uv[0][0] = NAN;
    uv[1][1] = INFINITY;
    uv[2][0] = 1e30f;
    evaluate("slopes", scene, image, uv, alone[0], 2);
    evaluate("slopes", scene, same, uv, inside[0], 2);
    for (int i = 0; i < points; i++)
        for (int k = 0; k < 2; k++) {
            assert_true(isfinite(inside[i][k]));
            if (i > 2)
                assert_float_equal(inside[i][k], alone[i][k], 0.02 + 0.002 * fabsf(alone[i][k]));
        }
    rt_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_pattern_is_its_definition),
        cmocka_unit_test(random_ones_are_their_definitions),
        cmocka_unit_test(the_deepest_weights_have_room),
        cmocka_unit_test(slopes_follow_the_rules_of_products),
        cmocka_unit_test(an_image_inside_has_its_own_slopes),
    };
    return cmocka_run_group_tests_name("kernels/nested", tests, NULL, NULL);
}
