/* image.c - decodes images and checks what comes of them. */
#include "fuzz/image.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "rt.h"

/* Values of an image above which the slower checks are left out. */
#define CHECKED_MAX 65536u

static size_t value_count(const rt_image *image)
{
    return (size_t)image->width * image->height * image->channel_count;
}

static void check_image(const rt_image *image)
{
    FUZZ_EXPECT(image->width >= 1 && image->width <= RT_IMAGE_SIDE_MAX);
    FUZZ_EXPECT(image->height >= 1 && image->height <= RT_IMAGE_SIDE_MAX);
    FUZZ_EXPECT(image->channel_count >= 1 && image->channel_count <= RT_IMAGE_CHANNELS_MAX);
    FUZZ_EXPECT((uint64_t)value_count(image) <= RT_IMAGE_VALUES_MAX);
    for (uint32_t i = 0; i < image->channel_count; i++) {
        FUZZ_EXPECT(image->names[i][0] != '\0' && memchr(image->names[i], 0, RT_IMAGE_NAME_SIZE));
        FUZZ_EXPECT(rt_image_channel(image, image->names[i]) == i);
    }
    for (size_t i = 0; image->is_srgb && i < value_count(image); i++)
        FUZZ_EXPECT(image->data[i] >= 0.0f && image->data[i] <= 1.0f);
}

rt_image *fuzz_image_decode(fuzz_decoder *decode, const uint8_t *data, size_t size)
{
    rt_image *image = fuzz_untouched;
    rt_error error;
    const rt_bytes file = {(uint8_t *)data, size, size, NULL};
    rt_status status = decode(&image, &file, "fuzz", &error);
    return fuzz_expect_answer(status, &error, image) ? image : NULL;
}

static int is_same(const rt_image *a, const rt_image *b)
{
    return a->width == b->width && a->height == b->height && a->channel_count == b->channel_count &&
           a->is_srgb == b->is_srgb &&
           memcmp(a->data, b->data, value_count(a) * sizeof *a->data) == 0;
}

/* rt_image_read chooses the same decoder. */
static void check_file(const rt_image *image, const uint8_t *data, size_t size)
{
    rt_image *again = NULL;
    rt_error error;
    fuzz_write("image", data, size);
    FUZZ_EXPECT(rt_image_read(&again, "image", &error) == RT_OK);
    FUZZ_EXPECT(is_same(image, again));
    rt_image_destroy(again);
}

/* As a file it is refused too, by its name, unless it is one of another format. */
static void check_refused(const uint8_t *data, size_t size)
{
    rt_image *image = fuzz_untouched;
    rt_error error;
    fuzz_write("image", data, size);
    if (fuzz_expect_answer(rt_image_read(&image, "image", &error), &error, image))
        rt_image_destroy(image);
    else
        FUZZ_EXPECT(strcmp(error.file, "image") == 0);
}

/* Code of the picture's channel c at pixel i; alpha may stand beside one or three. */
static float value_of(const rt_image *image, size_t i, uint32_t c)
{
    return image->data[i * image->channel_count + (image->channel_count <= 2 ? 0 : c)];
}

/* The picture, encoded and decoded again. */
static void check_round_trip(const rt_image *image, fuzz_decoder *decode, fuzz_encoder *encode)
{
    size_t pixels = (size_t)image->width * image->height;
    float *rgb = malloc(3 * pixels * sizeof *rgb);
    rt_image *picture = NULL;
    rt_bytes file = {0};
    rt_error error;
    FUZZ_EXPECT(rgb && rt_image_get_rgb(rgb, image, NULL, &error) == RT_OK);
    FUZZ_EXPECT(rt_image_from_rgb(&picture, rgb, image->width, image->height, &error) == RT_OK);
    FUZZ_EXPECT(encode(&file, picture, &error) == RT_OK);
    rt_image *again = fuzz_image_decode(decode, file.data, file.size);
    FUZZ_EXPECT(again && again->width == image->width && again->height == image->height);
    FUZZ_EXPECT(again->channel_count == 3 && again->is_srgb == image->is_srgb);
    for (size_t i = 0; image->is_srgb && i < pixels; i++)
        for (uint32_t c = 0; c < 3; c++)
            FUZZ_EXPECT(fabsf(value_of(again, i, c) - value_of(image, i, c)) < 0.502f / 255.0f);
    FUZZ_EXPECT(image->is_srgb || memcmp(again->data, rgb, 3 * pixels * sizeof *rgb) == 0);
    rt_image_destroy(again);
    rt_bytes_free(&file);
    rt_image_destroy(picture);
    free(rgb);
}

int fuzz_image_run(fuzz_decoder *decode, fuzz_encoder *encode, const uint8_t *data, size_t size)
{
    rt_image *image = fuzz_image_decode(decode, data, size);
    if (!image) {
        check_refused(data, size);
        return 0;
    }
    check_image(image);
    if (value_count(image) <= CHECKED_MAX) {
        check_file(image, data, size);
        if (encode)
            check_round_trip(image, decode, encode);
    }
    rt_image_destroy(image);
    return 1;
}
