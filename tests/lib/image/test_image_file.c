/* Images as files: the extension decides how one is written, the content how it is read. */
#include <errno.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "image/image_file.h"
#include "image/srgb.h"
#include "scratch.h"

static const char *const rgb[3] = {"R", "G", "B"};

static rt_image *create(void)
{
    rt_image *image = NULL;
    assert_int_equal(rt_image_create(&image, 5, 4, rgb, 3, NULL), RT_OK);
    for (int i = 0; i < 60; i++)
        image->data[i] = 0.37f * (float)i;
    assert_int_equal(rt_image_set_attribute(image, "scene", "box", NULL), RT_OK);
    return image;
}

static void the_extension_decides_the_format(void **state)
{
    (void)state;
    rt_image_format format;
    rt_error error = {0};
    assert_int_equal(rt_image_format_of(&format, "a.b/c.png", NULL), RT_OK);
    assert_int_equal(format, RT_IMAGE_PNG);
    assert_int_equal(rt_image_format_of(&format, "C.EXR", NULL), RT_OK);
    assert_int_equal(format, RT_IMAGE_EXR);
    assert_int_equal(rt_image_format_of(&format, "c.ppm", NULL), RT_OK);
    assert_int_equal(format, RT_IMAGE_PPM);
    assert_int_equal(rt_image_format_of(&format, "c.exr.pfm", NULL), RT_OK);
    assert_int_equal(format, RT_IMAGE_PFM);
    assert_int_equal(rt_image_format_of(&format, "dir.png/c", &error), RT_ERROR_USAGE);
    assert_non_null(strstr(error.message, "dir.png/c"));
    assert_int_equal(rt_image_format_of(&format, "c.jpeg", NULL), RT_ERROR_USAGE);
    assert_int_equal(rt_image_format_of(&format, "", NULL), RT_ERROR_USAGE);
}

static void every_format_is_written(void **state)
{
    (void)state;
    static const char *const names[] = {"a.exr", "a.png", "a.ppm", "a.pfm"};
    static const char *const magic[] = {"v/1\x01", "\x89PNG", "P6\n5", "PF\n5"};
    rt_image *image = create();
    for (int i = 0; i < 4; i++) {
        unsigned char head[4] = {0};
        assert_int_equal(rt_image_write(image, names[i], NULL, NULL), RT_OK);
        FILE *file = fopen(names[i], "rb");
        assert_non_null(file);
        assert_int_equal(fread(head, 1, 4, file), 4);
        fclose(file);
        assert_memory_equal(head, magic[i], 4);
    }
    assert_int_equal(scratch_count(), 4);
    rt_image_destroy(image);
}

static void float_formats_are_read_back(void **state)
{
    (void)state;
    static const char *const names[] = {"a.exr", "a.PFM"};
    rt_image *image = create();
    for (int i = 0; i < 2; i++) {
        rt_image *copy = NULL;
        uint32_t channels[3];
        assert_int_equal(rt_image_write(image, names[i], NULL, NULL), RT_OK);
        assert_int_equal(rt_image_read(&copy, names[i], NULL), RT_OK);
        assert_int_equal(rt_image_rgb_channels(channels, copy, NULL), RT_OK);
        for (int p = 0; p < 20; p++)
            for (int c = 0; c < 3; c++)
                assert_true(copy->data[3 * p + (int)channels[c]] == image->data[3 * p + c]);
        rt_image_destroy(copy);
    }
    rt_image_destroy(image);
}

/* The name says nothing: each is read under the name of another format. */
static void the_content_decides_how_a_file_is_read(void **state)
{
    (void)state;
    static const char *const names[] = {"a.exr", "a.png", "a.ppm", "a.pfm"};
    rt_image *image = create();
    for (int i = 0; i < 4; i++) {
        rt_image *copy = NULL;
        rt_error error = {0};
        uint32_t channels[3];
        assert_int_equal(rt_image_write(image, names[i], NULL, NULL), RT_OK);
        assert_int_equal(rename(names[i], names[(i + 1) % 4]), 0);
        assert_int_equal(rt_image_read(&copy, names[(i + 1) % 4], &error), RT_OK);
        assert_int_equal(rt_image_rgb_channels(channels, copy, NULL), RT_OK);
        assert_int_equal(copy->is_srgb, i == 1 || i == 2);
        for (int c = 0; c < 3; c++) {
            float linear = image->data[c], found = copy->data[channels[c]];
            assert_true(found ==
                        (copy->is_srgb ? (float)rt_srgb_quantise(linear) / 255.0f : linear));
        }
        rt_image_destroy(copy);
    }
    rt_image_destroy(image);
}

static void grey_files_are_read(void **state)
{
    (void)state;
    rt_image *image = NULL;
    scratch_write("a", "P2 1 1 4 3");
    assert_int_equal(rt_image_read(&image, "a", NULL), RT_OK);
    assert_string_equal(image->names[0], "Y");
    assert_true(image->data[0] == 0.75f);
    rt_image_destroy(image);
    scratch_write("a", "Pf 1 1 -1 abcd");
    assert_int_equal(rt_image_read(&image, "a", NULL), RT_OK);
    assert_string_equal(image->names[0], "Y");
    assert_false(image->is_srgb);
    rt_image_destroy(image);
}

static void failures_leave_no_file(void **state)
{
    (void)state;
    rt_image *image = create();
    rt_error error = {0};
    rt_image_options options = {0};
    assert_int_equal(rt_image_write(image, "missing/a.exr", NULL, &error), RT_ERROR_OUTPUT);
    assert_non_null(strstr(error.message, "missing/a.exr"));
    assert_non_null(strstr(error.message, strerror(ENOENT)));
    assert_int_equal(rt_image_write(image, "a.tiff", NULL, &error), RT_ERROR_USAGE);
    options.exposure = 1.0f / 0.0f;
    assert_int_equal(rt_image_write(image, "a.png", &options, &error), RT_ERROR_USAGE);
    assert_int_equal(symlink("/dev/full", "full.png"), 0);
    scratch_drop_rights();
    assert_int_equal(rt_image_write(image, "full.png", NULL, &error), RT_ERROR_OUTPUT);
    scratch_take_rights();
    assert_non_null(strstr(error.message, strerror(ENOSPC)));
    assert_int_equal(scratch_count(), 1);
    rt_image_destroy(image);
}

static void unreadable_files_are_named(void **state)
{
    (void)state;
    rt_image *image = NULL;
    rt_error error = {0};
    assert_int_equal(rt_image_read(&image, "missing.exr", &error), RT_ERROR_INPUT);
    assert_non_null(strstr(error.message, "missing.exr"));
    assert_non_null(strstr(error.message, strerror(ENOENT)));
    scratch_write("text.exr", "P, not an image");
    assert_int_equal(rt_image_read(&image, "text.exr", &error), RT_ERROR_INPUT);
    assert_non_null(strstr(error.message, "text.exr"));
    assert_non_null(strstr(error.message, "no image of the formats EXR, PNG, JPEG, Radiance HDR,"));
    scratch_write("empty.png", "");
    assert_int_equal(rt_image_read(&image, "empty.png", &error), RT_ERROR_INPUT);
    assert_non_null(strstr(error.message, "empty.png: it is empty"));
    scratch_write("short.png", "P6 9 9 255 123");
    assert_int_equal(rt_image_read(&image, "short.png", &error), RT_ERROR_INPUT);
    assert_non_null(strstr(error.message, "short.png: cut short"));
    scratch_write("sky.hdr", "#?RADIANCE\n");
    assert_int_equal(rt_image_read(&image, "sky.hdr", &error), RT_ERROR_INPUT);
    assert_non_null(strstr(error.message, "cannot read sky.hdr: its header has no end"));
    scratch_write("wood.webp", "RIFF\x10");
    assert_int_equal(rt_image_read(&image, "wood.webp", &error), RT_ERROR_INPUT);
    assert_non_null(strstr(error.message, "a WebP image: convert it"));
    scratch_write("wood.jpg", "\xff\xd8\xff\xe0");
    assert_int_equal(rt_image_read(&image, "wood.jpg", &error), RT_ERROR_INPUT);
    assert_non_null(strstr(error.message, "cannot read wood.jpg: it is cut short"));
    assert_null(image);
}

#define IN_SCRATCH(test) cmocka_unit_test_setup_teardown(test, scratch_enter, scratch_leave)

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_extension_decides_the_format),
        IN_SCRATCH(every_format_is_written),
        IN_SCRATCH(float_formats_are_read_back),
        IN_SCRATCH(the_content_decides_how_a_file_is_read),
        IN_SCRATCH(grey_files_are_read),
        IN_SCRATCH(failures_leave_no_file),
        IN_SCRATCH(unreadable_files_are_named),
    };
    return cmocka_run_group_tests_name("image/image_file", tests, NULL, NULL);
}
