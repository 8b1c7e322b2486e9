/*
 * page.c - the page of a pixel's paths: page.html with its data in the place of @PATHS@, the JSON
 * of the paths, and of @PIXELS@, the picture as the words of study_cell_set_pixels in hexadecimal.
 */
#include <stdlib.h>
#include <string.h>

#include "../message.h"
#include "../status.h"
#include "../study/page.h"
#include "page_source.h"
#include "write.h"

static int put_pixels(FILE *out, const rt_film *film)
{
    study_cell cell = {0};
    uint32_t width, height;
    rt_film_get_size(film, &width, &height);
    if (!study_cell_set_pixels(&cell, rt_film_rgb(film), width, height)) {
        message_error("out of memory");
        return STATUS_DEVICE;
    }
    for (size_t i = 0; i < (size_t)width * height; i++)
        fprintf(out, "%08x", (unsigned)cell.pixels[i]);
    study_cell_free(&cell);
    return STATUS_DONE;
}

/* Copies the page up to a mark, and returns where to go on behind it. */
static const unsigned char *put_until(FILE *out, const unsigned char *from, const char *mark)
{
    const size_t length = strlen(mark);
    const unsigned char *at = from, *end = paths_page + paths_page_size;
    while ((size_t)(end - at) > length && memcmp(at, mark, length) != 0)
        at++;
    fwrite(from, 1, (size_t)(at - from), out);
    return at + length;
}

int paths_write_page(const pixel_paths *pixel, text_file *file)
{
    FILE *out = file->stream;
    const unsigned char *at = put_until(out, paths_page, "@PATHS@");
    int status = paths_write_json(pixel, file);
    at = put_until(out, at, "@PIXELS@");
    if (status == STATUS_DONE)
        status = put_pixels(out, pixel->film);
    fwrite(at, 1, (size_t)(paths_page + paths_page_size - at), out);
    return status;
}
