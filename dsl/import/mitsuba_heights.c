/*
 * mitsuba_heights.c - height fields of Mitsuba 0.x: bilinear patches between the pixels of an
 * image, from -1 to 1 in x and y, whose first row is at y = -1.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "dsl/import/heights.h"
#include "dsl/import/mitsuba.h"
#include "dsl/import/spectrum.h"

/* Cells along an edge below which each is parted into more. */
enum { CELLS_ENOUGH = 256, PARTS_MAX = 16 };

/* Heights [rows][columns] and the normals there, of any length, or NULL. */
typedef struct field {
    double *heights, *normals;
    size_t columns, rows;
} field;

/* The image of a height field: its own, or that of a bitmap inside; NULL is told. */
static const char *find_image(mitsuba *m, xml_node *node)
{
    const char *const own = rt_mitsuba_string(m, node, "filename");
    for (xml_node *child = node->first; child && !own; child = child->next) {
        const int may_be = strcmp(child->tag, "texture") == 0 || strcmp(child->tag, "ref") == 0;
        xml_node *const texture = may_be ? rt_mitsuba_follow(m, child) : NULL;
        if (!texture || strcmp(texture->tag, "texture") != 0)
            continue;
        const char *const name = rt_mitsuba_string(m, texture, "filename");
        if (name && strcmp(rt_mitsuba_text(m, texture, "type"), "bitmap") == 0) {
            rt_mitsuba_read(m, child, texture);
            return name;
        }
    }
    if (!own)
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "a heightfield without an image file is left out");
    return own;
}

/* By the luminance of its pixels. */
static int read_heights(mitsuba *m, xml_node *node, const char *name, double scale, field *out)
{
    uint32_t size[2];
    float *const rgb =
        rt_import_image_rgb(rt_mitsuba_at(m, node), node->line, name, "a height field", size);
    const size_t count = rgb ? (size_t)size[0] * size[1] : 0;
    int is_good = rgb != NULL;
    if (rgb && (size[0] < 2 || size[1] < 2 || count > HEIGHTS_MAX)) {
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "a heightfield of %lu x %lu pixels is left out", (unsigned long)size[0],
                          (unsigned long)size[1]);
        is_good = 0;
    }
    out->columns = size[0];
    out->rows = size[1];
    out->heights = is_good ? malloc(count * sizeof *out->heights) : NULL;
    if (is_good && !out->heights)
        is_good = rt_import_fail_memory(m->import);
    for (size_t i = 0; is_good && i < count; i++) {
        const double colour[3] = {rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2]};
        out->heights[i] = scale * rt_spectrum_luminance(colour);
    }
    free(rgb);
    return is_good;
}

/* The sum of those that the cells around a pixel have there, with a cell as the unit of x and y. */
static int add_normals(mitsuba *m, field *f)
{
    const size_t w = f->columns;
    f->normals = calloc(3 * w * f->rows, sizeof *f->normals);
    if (!f->normals)
        return rt_import_fail_memory(m->import);
    for (size_t i = 0; i + w < w * f->rows; i++) {
        if (i % w == w - 1)
            continue;
        for (size_t corner = 0; corner < 4; corner++) {
            const size_t x = corner % 2, y = corner / 2;
            const double *const z = f->heights + i;
            double normal[3] = {z[y * w] - z[y * w + 1], z[x] - z[w + x], 1};
            rt_vector_normalize(normal);
            for (size_t c = 0; c < 3; c++)
                f->normals[3 * (i + y * w + x) + c] += normal[c];
        }
    }
    return 1;
}

/* Between four of `stride` numbers each, at x and y in cells. */
static double between(const double *from, size_t columns, size_t rows, size_t stride, double x,
                      double y)
{
    const size_t column = x < (double)(columns - 2) ? (size_t)x : columns - 2,
                 row = y < (double)(rows - 2) ? (size_t)y : rows - 2;
    const double s = x - (double)column, t = y - (double)row;
    const double *const a = from + stride * (row * columns + column), *const b =
                                                                          a + stride * columns;
    return (1 - t) * ((1 - s) * a[0] + s * a[stride]) + t * ((1 - s) * b[0] + s * b[stride]);
}

/* The mesh of a field each of whose cells is parted so many times along x and y. */
static int make_mesh(mitsuba *m, const field *f, size_t parts, import_mesh *out)
{
    const size_t columns = parts * (f->columns - 1) + 1, rows = parts * (f->rows - 1) + 1;
    const double side[3] = {(double)(f->columns - 1) / 2, (double)(f->rows - 1) / 2, 1};
    double *const z = malloc(columns * rows * sizeof *z);
    for (size_t i = 0; z && i < columns * rows; i++)
        z[i] = between(f->heights, f->columns, f->rows, 1, (double)(i % columns) / (double)parts,
                       (double)(i / columns) / (double)parts);
    int is_good = z ? rt_import_heights(m->import, z, columns, rows, -1, out)
                    : rt_import_fail_memory(m->import);
    free(z);
    if (!is_good || !f->normals)
        return is_good;
    out->normals = malloc(3 * columns * rows * sizeof *out->normals);
    if (!out->normals)
        return rt_import_fail_memory(m->import);
    for (size_t i = 0; i < columns * rows; i++) {
        double normal[3];
        for (size_t c = 0; c < 3; c++)
            normal[c] = side[c] * between(f->normals + c, f->columns, f->rows, 3,
                                          (double)(i % columns) / (double)parts,
                                          (double)(i / columns) / (double)parts);
        rt_vector_normalize(normal);
        for (size_t c = 0; c < 3; c++)
            out->normals[3 * i + c] = (float)normal[c];
    }
    return 1;
}

/* Mitsuba's own number of pixels is 2^n + 1, to which it resamples others. */
static int is_as_mitsuba_has_it(size_t pixels)
{
    return pixels >= 2 && ((pixels - 1) & (pixels - 2)) == 0;
}

int rt_mitsuba_read_heights(mitsuba *m, xml_node *node, int is_flat, import_mesh *out)
{
    const double scale = rt_mitsuba_number(m, node, "scale", 1);
    const char *const name = find_image(m, node);
    field f = {NULL, NULL, 0, 0};
    memset(out, 0, sizeof *out);
    rt_mitsuba_number(m, node, "width", 0); /* of textures without a size of their own */
    rt_mitsuba_number(m, node, "height", 0);
    int is_good = name && rt_import_find(rt_mitsuba_at(m, node), node->line, name, "the image") &&
                  read_heights(m, node, name, scale, &f) && (is_flat || add_normals(m, &f));
    if (is_good) {
        const size_t edge = (f.columns > f.rows ? f.columns : f.rows) - 1,
                     wanted = CELLS_ENOUGH / edge;
        if (!is_as_mitsuba_has_it(f.columns) || !is_as_mitsuba_has_it(f.rows))
            rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                              "a heightfield keeps its %lu x %lu pixels, where Mitsuba has powers "
                              "of two and one more",
                              (unsigned long)f.columns, (unsigned long)f.rows);
        is_good = make_mesh(m, &f, wanted < 1 ? 1 : wanted > PARTS_MAX ? PARTS_MAX : wanted, out);
    }
    free(f.heights);
    free(f.normals);
    return is_good;
}
