/* damage.c - truncates files, and flips their bits. */
#include "damage.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* Decodes a copy of exactly size bytes, so that a memory checker sees a read past its end. */
static rt_status decode_copy(const rt_bytes *file, size_t size, decoder *decode)
{
    rt_bytes copy = {malloc(size ? size : 1), size, size, NULL};
    rt_image *image = NULL;
    rt_error error = {0};
    assert_non_null(copy.data);
    memcpy(copy.data, file->data, size);
    rt_status status = decode(&image, &copy, "damaged", &error);
    assert_int_equal(status == RT_OK, image != NULL);
    assert_int_equal(error.status, status);
    if (status != RT_OK)
        assert_true(error.message[0] != '\0');
    rt_image_destroy(image);
    rt_bytes_free(&copy);
    return status;
}

void damage_truncate(const rt_bytes *file, decoder *decode)
{
    for (size_t size = 0; size < file->size; size++)
        assert_int_equal(decode_copy(file, size, decode), RT_ERROR_INPUT);
}

void damage_flip(const rt_bytes *file, decoder *decode)
{
    static const uint8_t masks[] = {0x01, 0x10, 0x7f, 0x80, 0xff};
    for (size_t i = 0; i < file->size; i++)
        for (size_t m = 0; m < sizeof masks; m++) {
            file->data[i] ^= masks[m];
            rt_status status = decode_copy(file, file->size, decode);
            file->data[i] ^= masks[m];
            assert_true(status == RT_OK || status == RT_ERROR_INPUT || status == RT_ERROR_MEMORY);
        }
}
