/* Textures on the device: against references that share no step with the kernel. */
#include "support.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "texture/texture.h"

enum { points_max = 4096 };

/* An image, its texture, and the table of texels. */
typedef struct sample {
    rt_image *image;
    rt_texture_data texture;
    rt_bytes texels;
} sample;

static const rt_u32 wraps[] = {RT_WRAP_REPEAT, RT_WRAP_MIRROR, RT_WRAP_CLAMP};

static uint32_t random_bits(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return *state >> 8;
}

/* Random texels from 0 to 1 of a format that is chosen by content. */
static sample make_sample(rt_u32 format, uint32_t width, uint32_t height)
{
    static const char *const rgb[3] = {"R", "G", "B"};
    sample s;
    rt_error error;
    uint32_t state = width + 77 * height;
    memset(&s, 0, sizeof s);
    expect_ok(rt_image_create(&s.image, width, height, rgb, 3, &error), &error);
    for (size_t i = 0; i < (size_t)3 * width * height; i++)
        if (format == RT_TEXELS_GREY && i % 3)
            s.image->data[i] = s.image->data[i - 1];
        else
            s.image->data[i] = format == RT_TEXELS_CODE8
                                   ? (float)(random_bits(&state) & 255) / 255.0f
                                   : (float)(random_bits(&state) & 1023) / 1024.0f;
    expect_ok(
        rt_texture_pack(&s.texture, &s.texels, s.image, &(rt_texture){.path = "made"}, &error),
        &error);
    assert_int_equal(s.texture.format, format);
    return s;
}

static void free_sample(sample *s)
{
    rt_image_destroy(s->image);
    rt_bytes_free(&s->texels);
}

/* Runs a kernel of one texture over points; `floats` a point come out. */
static void evaluate(const char *name, const rt_texture_data *texture, const rt_bytes *texels,
                     const float *uv, uint32_t count, float *out, size_t floats)
{
    cl_kernel kernel = test_kernel("texture", name);
    cl_mem t = test_buffer(sizeof *texture, texture), in = test_buffer(2 * count * sizeof *uv, uv);
    cl_mem image = test_texels(texels ? texels->data : NULL, texels ? texels->size : 0);
    cl_mem result = test_buffer(count * floats * sizeof *out, NULL);
    rt_arg args[] = {RT_ARG(count), RT_ARG(t), RT_ARG(image), RT_ARG(in), RT_ARG(result)};
    test_run(kernel, args, 5, count);
    test_read(result, count * floats * sizeof *out, out);
    rt_buffer_release(test_device(), result);
    rt_buffer_release(test_device(), image);
    rt_buffer_release(test_device(), in);
    rt_buffer_release(test_device(), t);
    rt_kernel_release(kernel);
}

static void colours(const sample *s, const float *uv, uint32_t count, float (*out)[4])
{
    evaluate("colours", &s->texture, &s->texels, uv, count, out[0], 4);
}

static void pattern(const rt_texture_data *texture, const float *uv, uint32_t count,
                    float (*out)[4])
{
    evaluate("colours", texture, NULL, uv, count, out[0], 4);
}

static long modulo(long a, long n)
{
    return (a % n + n) % n;
}

/*
 * Which texel stands at index i of the endless grid: by whole numbers, where the kernel folds
 * coordinates.
 */
static long wrap_index(long i, long size, rt_u32 wrap)
{
    if (wrap == RT_WRAP_REPEAT)
        return modulo(i, size);
    if (wrap == RT_WRAP_CLAMP)
        return i < 0 ? 0 : i < size ? i : size - 1;
    i = modulo(i, 2 * size);
    return i < size ? i : 2 * size - 1 - i;
}

/* Bilinear over the endless grid; row 0 of the grid is the bottom row of the image. */
static double reference(const sample *s, double u, double v, int channel)
{
    long width = (long)s->image->width, height = (long)s->image->height;
    double x = u * (double)width - 0.5, y = v * (double)height - 0.5, sum = 0;
    long i = (long)floor(x), j = (long)floor(y);
    for (long dj = 0; dj < 2; dj++)
        for (long di = 0; di < 2; di++) {
            long column = wrap_index(i + di, width, s->texture.wrap),
                 row = wrap_index(j + dj, height, s->texture.wrap);
            double weight = (di ? x - (double)i : 1 - (x - (double)i)) *
                            (dj ? y - (double)j : 1 - (y - (double)j));
            sum += weight * s->image->data[3 * ((height - 1 - row) * width + column) + channel];
        }
    return sum;
}

static void texel_centres_give_the_texels(void **state)
{
    static float uv[points_max][2], out[points_max][4];
    (void)state;
    for (rt_u32 format = RT_TEXELS_CODE8; format <= RT_TEXELS_HALF; format++)
        for (size_t w = 0; w < 3; w++) {
            /* Sides that are powers of two, so that the centres are exact. */
            sample s = make_sample(format, 16, 8);
            s.texture.wrap = wraps[w];
            for (int i = 0; i < 128; i++) {
                uv[i][0] = (float)((i % 16 + 0.5) / 16);
                uv[i][1] = (float)((i / 16 + 0.5) / 8);
            }
            colours(&s, uv[0], 128, out);
            for (int i = 0; i < 128; i++)
                for (int c = 0; c < 3; c++)
                    assert_true(out[i][c] == s.image->data[3 * ((7 - i / 16) * 16 + i % 16) + c]);
            free_sample(&s);
        }
}

/* The eye's test in numbers: a red mark at the picture's upper left is at small u and large v. */
static void images_are_upright_and_unmirrored(void **state)
{
    static const float uv[4][2] = {
        {0.125f, 0.875f}, {0.875f, 0.875f}, {0.125f, 0.125f}, {0.875f, 0.125f}};
    float out[4][4];
    (void)state;
    sample s = make_sample(RT_TEXELS_CODE8, 4, 4);
    memset(s.image->data, 0, 48 * sizeof(float));
    s.image->data[0] = 1.0f;          /* upper left: red */
    s.image->data[3 * 3 + 1] = 1.0f;  /* upper right: green */
    s.image->data[3 * 12 + 2] = 1.0f; /* lower left: blue */
    s.texels.size = 0;
    expect_ok(rt_texture_pack(&s.texture, &s.texels, s.image, &(rt_texture){.path = "made"}, NULL),
              &(rt_error){0});
    colours(&s, uv[0], 4, out);
    for (int i = 0; i < 4; i++)
        for (int c = 0; c < 3; c++)
            assert_true(out[i][c] == (i == c ? 1.0f : 0.0f));
    free_sample(&s);
}

static void between_centres_it_is_bilinear_in_every_wrap_mode(void **state)
{
    static const uint32_t sizes[][2] = {{1, 1}, {2, 3}, {5, 7}, {64, 33}};
    static float uv[points_max][2], out[points_max][4];
    uint32_t random = 1;
    (void)state;
    for (size_t size = 0; size < 4; size++)
        for (rt_u32 format = RT_TEXELS_CODE8; format <= RT_TEXELS_HALF; format++)
            for (size_t w = 0; w < 3; w++) {
                sample s = make_sample(format, sizes[size][0], sizes[size][1]);
                s.texture.wrap = wraps[w];
                /*
                 * From -32 to 32 in steps that float holds exactly through the whole calculation.
                 */
                for (int i = 0; i < points_max; i++)
                    for (int k = 0; k < 2; k++)
                        uv[i][k] = ((float)(random_bits(&random) & 0xffff) - 32768.0f) / 1024.0f;
                colours(&s, uv[0], points_max, out);
                for (int i = 0; i < points_max; i++)
                    for (int c = 0; c < 3; c++)
                        assert_float_equal(out[i][c], reference(&s, uv[i][0], uv[i][1], c), 1e-6);
                free_sample(&s);
            }
}

/* Between the edges of texels, where float holds the whole calculation exactly. */
static void the_nearest_texel_fills_its_square_in_every_wrap_mode(void **state)
{
    static const uint32_t sizes[][2] = {{1, 1}, {2, 4}, {64, 32}};
    static float uv[points_max][2], out[points_max][4];
    uint32_t random = 3;
    (void)state;
    for (size_t size = 0; size < 3; size++)
        for (rt_u32 format = RT_TEXELS_CODE8; format <= RT_TEXELS_HALF; format++)
            for (size_t w = 0; w < 3; w++) {
                sample s = make_sample(format, sizes[size][0], sizes[size][1]);
                s.texture.wrap = wraps[w];
                s.texture.filter = RT_TEXTURE_FILTER_NEAREST;
                for (int i = 0; i < points_max; i++)
                    for (int k = 0; k < 2; k++)
                        uv[i][k] = ((float)(random_bits(&random) & 0xfffe) - 32767.0f) / 1024.0f;
                colours(&s, uv[0], points_max, out);
                for (int i = 0; i < points_max; i++) {
                    const long width = s.image->width, height = s.image->height,
                               x = wrap_index((long)floor(uv[i][0] * width), width, wraps[w]),
                               y = wrap_index((long)floor(uv[i][1] * height), height, wraps[w]);
                    for (int c = 0; c < 3; c++)
                        assert_true(out[i][c] ==
                                    s.image->data[3 * ((height - 1 - y) * width + x) + c]);
                }
                free_sample(&s);
            }
}

static void srgb_is_mixed_in_linear_light(void **state)
{
    static const char *const grey[1] = {"Y"};
    static const float uv[1][2] = {{0.5f, 0.5f}};
    float out[1][4];
    sample s;
    (void)state;
    memset(&s, 0, sizeof s);
    expect_ok(rt_image_create(&s.image, 2, 1, grey, 1, NULL), &(rt_error){0});
    s.image->is_srgb = 1;
    s.image->data[1] = 1.0f;
    expect_ok(rt_texture_pack(&s.texture, &s.texels, s.image, &(rt_texture){.path = "made"}, NULL),
              &(rt_error){0});
    colours(&s, uv[0], 1, out);
    assert_true(out[0][0] == 0.5f);
    free_sample(&s);
}

static void mirrored_edges_meet(void **state)
{
    static float uv[2 * 64][2], out[2 * 64][4];
    (void)state;
    sample s = make_sample(RT_TEXELS_HALF, 8, 8);
    s.texture.wrap = RT_WRAP_MIRROR;
    /* The two sides of u = 1, of v = 0 and of both at -3 are images of each other. */
    for (int i = 0; i < 64; i++) {
        float d = (float)(i + 1) / 64.0f;
        const float here[2] = {i % 3 == 1 ? 0.3125f : 1 - d, i % 3 ? d : 0.7f};
        const float there[2] = {i % 3 == 1 ? 0.3125f : 1 + d, i % 3 ? -d : 0.7f};
        for (int k = 0; k < 2; k++) {
            uv[2 * i][k] = here[k];
            uv[2 * i + 1][k] = there[k];
        }
    }
    colours(&s, uv[0], 128, out);
    for (int i = 0; i < 64; i++)
        for (int c = 0; c < 3; c++)
            assert_float_equal(out[2 * i][c], out[2 * i + 1][c], 1e-6);
    free_sample(&s);
}

static void scale_and_offset_move_the_image(void **state)
{
    static float uv[256][2], out[256][4];
    uint32_t random = 5;
    (void)state;
    sample s = make_sample(RT_TEXELS_CODE8, 8, 4);
    s.texture.scale[0] = 3.0f;
    s.texture.scale[1] = -0.5f;
    s.texture.offset[0] = 0.25f;
    s.texture.offset[1] = -2.125f;
    for (int i = 0; i < 256; i++)
        for (int k = 0; k < 2; k++)
            uv[i][k] = (float)(random_bits(&random) & 1023) / 256.0f - 2.0f;
    colours(&s, uv[0], 256, out);
    for (int i = 0; i < 256; i++)
        for (int c = 0; c < 3; c++)
            assert_float_equal(
                out[i][c], reference(&s, 3.0 * uv[i][0] + 0.25, -0.5 * uv[i][1] - 2.125, c), 1e-6);
    free_sample(&s);
}

/* Any affine map, by its matrix: the colour there, and of a ramp the slope of the composition. */
static void an_affine_map_moves_the_image_and_turns_slopes(void **state)
{
    static float uv[256][2], out[256][4], slope[256][2];
    uint32_t random = 6;
    (void)state;
    sample s = make_sample(RT_TEXELS_GREY, 64, 32);
    for (int i = 0; i < 64 * 32; i++)
        for (int c = 0; c < 3; c++)
            s.image->data[3 * i + c] = (float)(0.01 * (i % 64) + 0.03 * (31 - i / 64));
    s.texels.size = 0;
    expect_ok(rt_texture_pack(&s.texture, &s.texels, s.image, &(rt_texture){.path = "made"}, NULL),
              &(rt_error){0});
    const double m[2][3] = {{0.5, -0.125, 0.25}, {0.375, 0.25, 0.125}};
    for (int i = 0; i < 2; i++) {
        s.texture.scale[i] = (float)m[i][i];
        s.texture.shear[i] = (float)m[i][1 - i];
        s.texture.offset[i] = (float)m[i][2];
    }
    for (int i = 0; i < 256; i++)
        for (int k = 0; k < 2; k++)
            uv[i][k] = (float)(random_bits(&random) & 1023) / 1024.0f;
    colours(&s, uv[0], 256, out);
    evaluate("slopes", &s.texture, &s.texels, uv[0], 256, slope[0], 2);
    for (int i = 0; i < 256; i++) {
        const double at[2] = {m[0][0] * uv[i][0] + m[0][1] * uv[i][1] + m[0][2],
                              m[1][0] * uv[i][0] + m[1][1] * uv[i][1] + m[1][2]};
        assert_float_equal(out[i][0], reference(&s, at[0], at[1], 0), 1e-5);
        if (at[0] > 0.02 && at[1] > 0.04) {
            /* The ramp rises by 0.64 a unit of s and by 0.96 a unit of t. */
            assert_float_equal(slope[i][0], 0.64 * m[0][0] + 0.96 * m[1][0], 1e-3);
            assert_float_equal(slope[i][1], 0.64 * m[0][1] + 0.96 * m[1][1], 1e-3);
        }
    }
    free_sample(&s);
}

/* The texture lies between two others of huge values: a read outside would show. */
static void no_coordinate_reads_outside(void **state)
{
    static const float hard[] = {
        0.0f,   -0.0f,       1.0f,          -2.0f,          3.0f,          -1e-30f,
        1e-30f, -1e-8f,      0.99999994f,   1.0000001f,     1.9999999f,    1e7f,
        -1e7f,  16777217.0f, 2147483648.0f, -2147483648.0f, 4294967296.0f, 1e30f,
        -1e30f, FLT_MAX,     -FLT_MAX,      INFINITY,       -INFINITY,     NAN};
    enum { hard_count = sizeof hard / sizeof *hard };
    static float uv[hard_count * hard_count][2], out[hard_count * hard_count][4],
        slope[hard_count * hard_count][2];
    (void)state;
    sample outer = make_sample(RT_TEXELS_GREY, 4, 4), inner = make_sample(RT_TEXELS_GREY, 4, 4);
    for (int i = 0; i < 48; i++)
        outer.image->data[i] = 1e30f;
    sample s = outer;
    rt_texture_data guard;
    memset(&s.texels, 0, sizeof s.texels);
    expect_ok(rt_texture_pack(&guard, &s.texels, outer.image, &(rt_texture){.path = "guard"}, NULL),
              &(rt_error){0});
    expect_ok(
        rt_texture_pack(&s.texture, &s.texels, inner.image, &(rt_texture){.path = "made"}, NULL),
        &(rt_error){0});
    expect_ok(rt_texture_pack(&guard, &s.texels, outer.image, &(rt_texture){.path = "guard"}, NULL),
              &(rt_error){0});
    assert_int_equal(s.texels.size, 3 * RT_SCENE_ROW);
    for (int i = 0; i < hard_count * hard_count; i++) {
        uv[i][0] = hard[i / hard_count];
        uv[i][1] = hard[i % hard_count];
    }
    for (size_t w = 0; w < 6; w++) {
        s.texture.wrap = wraps[w % 3];
        s.texture.filter = w < 3 ? RT_TEXTURE_FILTER_BILINEAR : RT_TEXTURE_FILTER_NEAREST;
        colours(&s, uv[0], hard_count * hard_count, out);
        evaluate("slopes", &s.texture, &s.texels, uv[0], hard_count * hard_count, slope[0], 2);
        for (int i = 0; i < hard_count * hard_count; i++) {
            assert_true(out[i][0] >= 0.0f && out[i][0] <= 1.0f);
            assert_true(fabsf(slope[i][0]) <= 4.001f && fabsf(slope[i][1]) <= 4.001f);
        }
    }
    rt_bytes_free(&s.texels);
    free_sample(&inner);
    free_sample(&outer);
}

static rt_texture_data make_pattern(rt_u32 kind)
{
    const rt_texture_data t = {.kind = kind,
                               .wrap = RT_WRAP_REPEAT,
                               .scale = {1, 1},
                               .a = {1, 2, 4},
                               .b = {3, 0.5f, 0},
                               .turn = {1, 0}};
    return t;
}

static void a_checker_alternates_by_unit_squares(void **state)
{
    static float uv[points_max][2], out[points_max][4];
    const float beyond[2][2] = {{NAN, 0.0f}, {INFINITY, -INFINITY}};
    uint32_t random = 9;
    (void)state;
    rt_texture_data t = make_pattern(RT_TEXTURE_CHECKER);
    for (int i = 0; i < points_max; i++)
        for (int k = 0; k < 2; k++)
            uv[i][k] = ((float)(random_bits(&random) & 0xffff) - 32768.0f) / 1024.0f;
    uv[0][0] = -1e-12f;
    uv[0][1] = 1e-12f;
    for (size_t w = 0; w < 3; w++) {
        t.wrap = wraps[w];
        pattern(&t, uv[0], points_max, out);
        for (int i = 0; i < points_max; i++) {
            long sum = (long)floor(uv[i][0]) + (long)floor(uv[i][1]);
            const float *expected = modulo(sum, 2) ? t.b : t.a;
            assert_memory_equal(out[i], expected, 3 * sizeof(float));
        }
    }
    pattern(&t, beyond[0], 2, out);
    for (int i = 0; i < 2; i++)
        assert_true(memcmp(out[i], t.a, 3 * sizeof(float)) == 0 ||
                    memcmp(out[i], t.b, 3 * sizeof(float)) == 0);
}

static double fold(double x, rt_u32 wrap)
{
    if (wrap == RT_WRAP_CLAMP)
        return fmin(fmax(x, 0), 1);
    return wrap == RT_WRAP_REPEAT ? x - floor(x)
                                  : acos(cos(3.14159265358979323846 * x)) / 3.14159265358979323846;
}

static void a_gradient_is_linear_along_its_axis(void **state)
{
    static float uv[points_max][2], out[points_max][4];
    uint32_t random = 11;
    (void)state;
    rt_texture_data t = make_pattern(RT_TEXTURE_GRADIENT);
    for (int i = 0; i < points_max; i++)
        for (int k = 0; k < 2; k++)
            uv[i][k] = ((float)(random_bits(&random) & 0xffff) - 32768.0f) / 4096.0f;
    for (t.axis = 0; t.axis < 2; t.axis++)
        for (size_t w = 0; w < 3; w++) {
            t.wrap = wraps[w];
            pattern(&t, uv[0], points_max, out);
            for (int i = 0; i < points_max; i++)
                for (int c = 0; c < 3; c++)
                    assert_float_equal(
                        out[i][c], t.a[c] + ((double)t.b[c] - t.a[c]) * fold(uv[i][t.axis], t.wrap),
                        2e-6);
        }
}

static void the_slope_of_a_ramp_is_its_steepness(void **state)
{
    static float uv[256][2], out[256][2];
    uint32_t random = 13;
    (void)state;
    sample s = make_sample(RT_TEXELS_GREY, 64, 32);
    for (int i = 0; i < 64 * 32; i++)
        for (int c = 0; c < 3; c++)
            s.image->data[3 * i + c] = (float)(0.01 * (i % 64) + 0.03 * (31 - i / 64));
    s.texels.size = 0;
    expect_ok(rt_texture_pack(&s.texture, &s.texels, s.image, &(rt_texture){.path = "made"}, NULL),
              &(rt_error){0});
    s.texture.wrap = RT_WRAP_MIRROR;
    s.texture.scale[0] = 2.0f;
    s.texture.scale[1] = -1.0f;
    /*
     * 0.64 a unit of s, 0.96 of t; on (u, v) it is scaled, and each second copy is mirrored.
     */
    for (int i = 0; i < 256; i++) {
        int copy = (int)(random_bits(&random) % 64) - 32;
        uv[i][0] =
            0.5f * ((float)copy + 0.1f + 0.8f * (float)(random_bits(&random) & 255) / 256.0f);
        uv[i][1] = -((float)(i % 8) + 0.5f);
    }
    evaluate("slopes", &s.texture, &s.texels, uv[0], 256, out[0], 2);
    for (int i = 0; i < 256; i++) {
        double sign_s = modulo((long)floor(2 * uv[i][0]), 2) ? -1 : 1, sign_t = i % 2 ? -1 : 1;
        assert_float_equal(out[i][0], 2 * 0.64 * sign_s, 1e-3);
        assert_float_equal(out[i][1], -0.96 * sign_t, 1e-3);
    }
    free_sample(&s);
}

/*
 * The integral of the slope along a line of texture is the difference of the heights at its ends.
 */
static void the_slope_integrates_to_the_height(void **state)
{
    static float uv[points_max][2], slope[points_max][2];
    (void)state;
    sample s = make_sample(RT_TEXELS_HALF, 16, 16);
    for (int axis = 0; axis < 2; axis++) {
        double sum = 0;
        /*
         * From 1/4 to 3/4, whose central differences reach half a texel further: take heights as
         * means there.
         */
        for (int i = 0; i < points_max; i++) {
            uv[i][axis] = (float)(0.25 + 0.5 * (i + 0.5) / points_max);
            uv[i][1 - axis] = 0.40625f;
        }
        evaluate("slopes", &s.texture, &s.texels, uv[0], points_max, slope[0], 2);
        for (int i = 0; i < points_max; i++)
            sum += 0.5 * slope[i][axis] / points_max;
        double expected = 0;
        for (int end = 0; end < 2; end++)
            for (int i = 0; i < 64; i++) {
                double at = 0.25 + 0.5 * end + ((i + 0.5) / 64 - 0.5) / 16;
                for (int c = 0; c < 3; c++)
                    expected += (end ? 1 : -1) / (3 * 64.0) *
                                reference(&s, axis ? 0.40625 : at, axis ? at : 0.40625, c);
            }
        assert_float_equal(sum, expected, 1e-4);
    }
    free_sample(&s);
}

/* One slope in all of a texel, that of the line through its neighbours, whatever lies between. */
static void the_nearest_texel_has_the_slope_between_its_neighbours(void **state)
{
    static float uv[points_max][2], out[points_max][2];
    uint32_t random = 17;
    (void)state;
    for (size_t w = 0; w < 3; w++) {
        sample s = make_sample(RT_TEXELS_GREY, 32, 16);
        s.texture.wrap = wraps[w];
        s.texture.filter = RT_TEXTURE_FILTER_NEAREST;
        s.texture.scale[0] = 2.0f;
        for (int i = 0; i < points_max; i++)
            for (int k = 0; k < 2; k++)
                uv[i][k] = ((float)(random_bits(&random) & 0xffe) - 1023.0f) / 1024.0f;
        evaluate("slopes", &s.texture, &s.texels, uv[0], points_max, out[0], 2);
        for (int i = 0; i < points_max; i++) {
            const double x = floor(2.0 * uv[i][0] * 32) + 0.5, y = floor(uv[i][1] * 16.0) + 0.5;
            const double along_s =
                reference(&s, (x + 1) / 32, y / 16, 0) - reference(&s, (x - 1) / 32, y / 16, 0);
            const double along_t =
                reference(&s, x / 32, (y + 1) / 16, 0) - reference(&s, x / 32, (y - 1) / 16, 0);
            assert_float_equal(out[i][0], 2 * along_s * 16, 1e-3);
            assert_float_equal(out[i][1], along_t * 8, 1e-3);
        }
        free_sample(&s);
    }
}

static void the_slope_of_a_pattern_is_that_of_its_colours(void **state)
{
    static const float uv[4][2] = {{0.5f, 0.25f}, {1.75f, 0.5f}, {20.0f, 0.5f}, {0.5f, 0.998f}};
    float out[4][2];
    (void)state;
    rt_texture_data t = make_pattern(RT_TEXTURE_GRADIENT);
    t.scale[0] = 2.0f;
    t.wrap = RT_WRAP_CLAMP;
    evaluate("slopes", &t, NULL, uv[0], 4, out[0], 2);
    /* at the upper edge: half of the steps beyond */
    assert_float_equal(out[0][0], 0.5 * 2 * (3.5 - 7.0) / 3, 1e-4);
    assert_true(out[0][1] == 0.0f);
    assert_true(out[1][0] == 0.0f && out[2][0] == 0.0f);

    t = make_pattern(RT_TEXTURE_CHECKER);
    evaluate("slopes", &t, NULL, uv[0], 4, out[0], 2);
    assert_true(out[0][0] == 0.0f && out[0][1] == 0.0f);
    assert_true(out[3][0] == 0.0f);
    assert_float_equal(out[3][1], (3.5 - 7.0) / 3 * 64, 1e-2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(texel_centres_give_the_texels),
        cmocka_unit_test(images_are_upright_and_unmirrored),
        cmocka_unit_test(between_centres_it_is_bilinear_in_every_wrap_mode),
        cmocka_unit_test(the_nearest_texel_fills_its_square_in_every_wrap_mode),
        cmocka_unit_test(srgb_is_mixed_in_linear_light),
        cmocka_unit_test(mirrored_edges_meet),
        cmocka_unit_test(scale_and_offset_move_the_image),
        cmocka_unit_test(an_affine_map_moves_the_image_and_turns_slopes),
        cmocka_unit_test(no_coordinate_reads_outside),
        cmocka_unit_test(a_checker_alternates_by_unit_squares),
        cmocka_unit_test(a_gradient_is_linear_along_its_axis),
        cmocka_unit_test(the_slope_of_a_ramp_is_its_steepness),
        cmocka_unit_test(the_slope_integrates_to_the_height),
        cmocka_unit_test(the_nearest_texel_has_the_slope_between_its_neighbours),
        cmocka_unit_test(the_slope_of_a_pattern_is_that_of_its_colours),
    };
    return cmocka_run_group_tests_name("kernels/texture", tests, NULL, NULL);
}
