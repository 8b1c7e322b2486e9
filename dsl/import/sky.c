/*
 * sky.c - images of environments and other lights whose pixels lie otherwise than those of the
 * language, sampled anew.
 *
 * The first and the last row of Mitsuba's are at the poles. Its interpolation between rows has its
 * corners where the pixels of no image of the language are; with several rows for each of its own,
 * what is cut off of a corner is small.
 *
 * pbrt-v4's are squares of equal area, without interpolation between pixels: each pixel of the new
 * image is the mean of a grid of points.
 *
 * Reference:
 *   Clarberg: "Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD", Journal of Graphics Tools,
 *     2008.
 */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "dsl/import/import.h"
#include "rt.h"

/* Rows from which on half a row is too little to be seen; the most of what is made. */
enum { rows_enough = 512, rows_max = 1024, factor_max = 32, octahedral_max = 2048 };

/* An image [height][width][3], the top row first. */
typedef struct picture {
    float *rgb;
    uint32_t width, height;
} picture;

/* ---- The projections --------------------------------------------------------- */

/* Between the rows of Mitsuba's, where a row of `out` is; columns stay. */
static void spread_rows(picture *out, const picture *from)
{
    const size_t row = 3 * (size_t)from->width;
    for (uint32_t y = 0; y < out->height; y++) {
        const double place = (y + 0.5) / out->height * (from->height - 1);
        uint32_t above = (uint32_t)place;
        if (above + 2 > from->height)
            above = from->height - 2;
        const float part = (float)(place - above);
        const float *a = from->rgb + above * row, *b = a + row;
        for (size_t i = 0; i < row; i++)
            out->rgb[y * row + i] = (1 - part) * a[i] + part * b[i];
    }
}

/* The pixel of an equal-area square of this side in direction d. */
static size_t octahedral_pixel(const double d[3], uint32_t side)
{
    const double x = fabs(d[0]), y = fabs(d[1]), r = sqrt(fmax(0, 1 - fabs(d[2])));
    const double phi = x == 0 && y == 0 ? 0 : atan2(y, x) * 2 / IMPORT_PI;
    double v = phi * r, u = r - v;
    if (d[2] < 0) {
        const double swapped = u;
        u = 1 - v;
        v = 1 - swapped;
    }
    u = 0.5 * (copysign(u, d[0]) + 1) * side;
    v = 0.5 * (copysign(v, d[1]) + 1) * side;
    const uint32_t last = side - 1, column = u > 0 ? (uint32_t)u : 0, row = v > 0 ? (uint32_t)v : 0;
    return (size_t)(row > last ? last : row) * side + (column > last ? last : column);
}

/* The mean of points in pixel (x, y) of `out`, which has pbrt's z upwards and starts at its x. */
static void octahedral_mean(float rgb[3], const picture *out, uint32_t x, uint32_t y,
                            const picture *from, uint32_t points)
{
    double sum[3] = {0, 0, 0};
    for (uint32_t k = 0; k < points * points; k++) {
        const double longitude = 2 * IMPORT_PI * (x + (k % points + 0.5) / points) / out->width;
        const double polar = IMPORT_PI * (y + (k / points + 0.5) / points) / out->height;
        const double d[3] = {sin(polar) * cos(longitude), sin(polar) * sin(longitude), cos(polar)};
        const float *at = from->rgb + 3 * octahedral_pixel(d, from->width);
        for (int c = 0; c < 3; c++)
            sum[c] += at[c];
    }
    for (int c = 0; c < 3; c++)
        rgb[c] = (float)(sum[c] / (points * points));
}

static void unfold_to(picture *out, const picture *from, int is_mirrored)
{
    const uint32_t points = from->width <= 512 ? 8 : from->width <= 1024 ? 4 : 2;
    for (uint32_t y = 0; y < out->height; y++)
        for (uint32_t x = 0; x < out->width; x++) {
            const size_t column = is_mirrored ? out->width - 1 - x : x;
            octahedral_mean(out->rgb + 3 * ((size_t)y * out->width + column), out, x, y, from,
                            points);
        }
}

static void unfold(picture *out, const picture *from)
{
    unfold_to(out, from, 0);
}

static void unfold_mirrored(picture *out, const picture *from)
{
    unfold_to(out, from, 1);
}

static void copy_pixels(picture *out, const picture *from, int is_upended)
{
    const uint32_t width = from->width, height = from->height;
    for (uint32_t y = 0; y < height; y++)
        for (uint32_t x = 0; x < width; x++) {
            const size_t row = is_upended ? height - 1 - y : y,
                         column = is_upended ? x : width - 1 - x;
            memcpy(out->rgb + 3 * ((size_t)y * width + x), from->rgb + 3 * (row * width + column),
                   3 * sizeof *out->rgb);
        }
}

static void upend(picture *out, const picture *from)
{
    copy_pixels(out, from, 1);
}

static void mirror(picture *out, const picture *from)
{
    copy_pixels(out, from, 0);
}

/* ---- Files ------------------------------------------------------------------- */

float *rt_import_image_rgb(importer *import, int line, const char *name, const char *what,
                           uint32_t size[2])
{
    rt_image *image = NULL;
    rt_error error;
    float *rgb = NULL;
    char *path = import->failed ? NULL : rt_import_resolve(import, line, name);
    size[0] = size[1] = 0;
    if (!path)
        return NULL;
    rt_status status = rt_image_read(&image, path, &error);
    free(path);
    if (status == RT_OK) {
        rt_image_get_size(image, &size[0], &size[1]);
        rgb = malloc(3 * (size_t)size[0] * size[1] * sizeof *rgb);
        if (!rgb)
            rt_import_fail_memory(import);
        else
            status = rt_image_get_rgb(rgb, image, NULL, &error);
        rt_image_destroy(image);
    }
    if (status == RT_OK)
        return rgb;
    rt_import_note_at(import, line, "the image of %s is left out: %.150s", what, error.message);
    free(rgb);
    return NULL;
}

/* Reads an image; returns 0 where there is none, which is told. */
static int read_picture(importer *import, int line, picture *out, const char *name)
{
    uint32_t size[2];
    out->rgb = rt_import_image_rgb(import, line, name, "a light", size);
    out->width = size[0];
    out->height = size[1];
    return out->rgb != NULL;
}

/* The rows of a .pfm rise, and its floats are big-endian. */
int rt_import_write_picture(importer *import, char out[512], const char *name, const float *rgb,
                            uint32_t width, uint32_t height)
{
    const char *slash = strrchr(name, '/');
    const size_t row = 3 * (size_t)width, count = row * height;
    unsigned char *bytes = malloc(64 + 4 * count);
    if (!bytes)
        return rt_import_fail_memory(import);
    unsigned char *at = bytes + sprintf((char *)bytes, "PF\n%lu %lu\n1\n", (unsigned long)width,
                                        (unsigned long)height);
    for (size_t i = 0; i < count; i++, at += 4) {
        uint32_t word;
        memcpy(&word, rgb + (height - 1 - i / row) * row + i % row, sizeof word);
        for (int k = 0; k < 4; k++)
            at[k] = (unsigned char)(word >> (24 - 8 * k));
    }
    const int is_there =
        rt_import_write(import, out, slash ? slash + 1 : name, ".pfm", bytes, (size_t)(at - bytes));
    free(bytes);
    return is_there;
}

/* Makes `to` of `from` by a projection, and writes it. */
static int convert(importer *import, char out[512], const char *name, const picture *from,
                   picture *to, void (*project)(picture *out, const picture *from))
{
    to->rgb = malloc(3 * (size_t)to->width * to->height * sizeof *to->rgb);
    if (!to->rgb)
        return rt_import_fail_memory(import);
    project(to, from);
    const int is_there = rt_import_write_picture(import, out, name, to->rgb, to->width, to->height);
    free(to->rgb);
    return is_there;
}

/* Writes an image of the same size by a projection. */
static int copy_by(importer *import, int line, char out[512], const char *name,
                   void (*project)(picture *out, const picture *from))
{
    picture from = {NULL, 0, 0};
    int is_there = 0;
    if (read_picture(import, line, &from, name)) {
        picture to = {NULL, from.width, from.height};
        is_there = convert(import, out, name, &from, &to, project);
    }
    free(from.rgb);
    return is_there;
}

int rt_import_upended_image(importer *import, int line, char out[512], const char *name)
{
    return copy_by(import, line, out, name, upend);
}

int rt_import_mirrored_image(importer *import, int line, char out[512], const char *name)
{
    return copy_by(import, line, out, name, mirror);
}

int rt_import_image_size(importer *import, int line, const char *name, uint32_t size[2])
{
    picture from = {NULL, 0, 0};
    const int is_there = read_picture(import, line, &from, name);
    size[0] = from.width;
    size[1] = from.height;
    free(from.rgb);
    return is_there;
}

int rt_import_mitsuba_sky(importer *import, int line, char out[512], const char *name)
{
    picture from = {NULL, 0, 0};
    int is_there = 0;
    if (read_picture(import, line, &from, name)) {
        const uint32_t gaps = from.height > 1 ? from.height - 1 : 1, most = rows_max / gaps;
        picture to = {NULL, from.width, gaps * (most < factor_max ? most : factor_max)};
        if (from.height < 2 || from.height >= rows_enough || from.width > 8 * rows_max)
            is_there = rt_import_image_file(import, line, out, name);
        else
            is_there = convert(import, out, name, &from, &to, spread_rows);
    }
    free(from.rgb);
    return is_there;
}

int rt_import_octahedral_sky(importer *import, int line, char out[512], const char *name,
                             int is_mirrored)
{
    picture from = {NULL, 0, 0};
    int is_there = 0;
    if (read_picture(import, line, &from, name)) {
        const uint32_t rows = from.width < octahedral_max ? from.width : octahedral_max;
        picture to = {NULL, 2 * rows, rows};
        if (from.width != from.height || from.width == 0) {
            rt_import_note_at(import, line, "the image of a light is left out: it is not square");
        } else {
            rt_import_note_at(import, line,
                              "the octahedral image of a light was sampled anew, as %lu x "
                              "%lu pixels of longitude and latitude",
                              (unsigned long)to.width, (unsigned long)to.height);
            is_there =
                convert(import, out, name, &from, &to, is_mirrored ? unfold_mirrored : unfold);
        }
    }
    free(from.rgb);
    return is_there;
}
