/*
 * Images that others wrote: each is read and made a texture, or refused, as the corpus's manifest
 * asks; none crashes the reader, keeps it for more than two seconds or brings a value into a
 * texture that is not a number.
 *
 * RT_CORPUS names the directory that holds img/MANIFEST.tsv. Without it the program fails: it is
 * run by a target of its own.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "corpus/manifest.h"
#include "image/image_file.h"
#include "texture/texture.h"

#define SECONDS 2

/* What came of a file. A memory checker that finds an error exits with another status. */
enum { is_texture = 10, is_image, is_refused, is_wrong };

/* A file that was read may yet be no texture: one of depths, or of values that are not finite. */
static int try_image(const char *path, void *user)
{
    rt_image *image = NULL;
    rt_texture_data texture;
    rt_bytes texels = {0};
    rt_error error = {0};
    (void)user;
    rt_status status = rt_image_read(&image, path, &error);
    int result = status == RT_OK ? is_texture : is_refused;
    if (status == RT_OK) {
        status = rt_texture_pack(&texture, &texels, image, &(rt_texture){.path = path}, &error);
        result = status == RT_OK ? is_texture : is_image;
    }
    if (status != RT_OK && (status != RT_ERROR_INPUT || !strstr(error.message, path)))
        result = is_wrong;
    rt_bytes_free(&texels);
    rt_image_destroy(image);
    return result;
}

/* Whether a result is what the manifest asks for. */
static int is_as_expected(const char *expected, int result)
{
    if (strcmp(expected, "accept") == 0)
        return result == is_texture;
    if (strcmp(expected, "reject") == 0)
        return result == is_refused;
    /* The other words leave the choice to the reader. */
    return result == is_texture || result == is_image || result == is_refused;
}

static void images_do_as_the_manifest_says(void **state)
{
    (void)state;
    manifest *m = manifest_open("img");
    size_t wrong = 0;
    for (size_t row = 0; row < m->row_count; row++) {
        const char *expected = manifest_field(m, row, "expected");
        char *path = manifest_path(m, row);
        int result = manifest_attempt(try_image, path, NULL, SECONDS);
        if (!is_as_expected(expected, result)) {
            fprintf(stderr, "%s: result %d, expected %s\n", path, result, expected);
            wrong++;
        }
        free(path);
    }
    if (wrong)
        fail_msg("%zu of %zu files went wrong", wrong, m->row_count);
    manifest_close(m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(images_do_as_the_manifest_says)};
    return cmocka_run_group_tests_name("corpus/img", tests, NULL, NULL);
}
