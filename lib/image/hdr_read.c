/*
 * hdr_read.c - decodes Radiance pictures: four bytes a pixel, mantissas of red, green and blue and
 * their common exponent.
 *
 * References: Ward: "Real Pixels", in Graphics Gems II, 1991; "Radiance File Formats", the section
 *   on picture files, which has both schemes of runs.
 */
#include <math.h>
#include <string.h>

#include "image/decode.h"

enum { line_max = 1024, run_side_min = 8, run_side_max = 32767 };

/* An axis of the picture as the resolution line has it. */
typedef struct axis {
    char name;        /* X or Y */
    int is_ascending; /* +: x to the right, y upwards */
    uint32_t size;
} axis;

/* A file being decoded. */
typedef struct reader {
    const rt_bytes *file;
    const char *name;
    size_t at;
    axis axes[2];  /* that of the scan lines, then that within one */
    uint8_t *line; /* [axes[1].size][4] */
} reader;

static rt_status fail_input(const reader *r, const char *what, rt_error *error)
{
    return rt_fail(error, RT_ERROR_INPUT, "cannot read %.350s: %s", r->name, what);
}

/* ---- The header -------------------------------------------------------------- */

/* The next line without its end; 0 where there is none, or one that is too long. */
static int next_line(reader *r, char line[line_max])
{
    const uint8_t *start = r->file->data + r->at;
    const size_t left = r->file->size - r->at;
    const uint8_t *end = left ? memchr(start, '\n', left < line_max ? left : line_max) : NULL;
    if (!end)
        return 0;
    size_t length = (size_t)(end - start);
    r->at += length + 1;
    if (length > 0 && start[length - 1] == '\r')
        length--;
    if (length >= line_max)
        return 0;
    memcpy(line, start, length);
    line[length] = '\0';
    return 1;
}

/* Reads "-Y 512" at *text and goes behind it. */
static int read_axis(axis *out, const char **text)
{
    const char *at = *text;
    uint32_t size = 0;
    if ((at[0] != '+' && at[0] != '-') || (at[1] != 'X' && at[1] != 'Y') || at[2] != ' ')
        return 0;
    out->is_ascending = at[0] == '+';
    out->name = at[1];
    for (at += 3; *at >= '0' && *at <= '9' && size <= RT_IMAGE_SIDE_MAX; at++)
        size = 10 * size + (uint32_t)(*at - '0');
    out->size = size;
    *text = at;
    return size >= 1 && size <= RT_IMAGE_SIDE_MAX;
}

static rt_status read_resolution(reader *r, const char *line, rt_error *error)
{
    const char *at = line;
    if (!read_axis(&r->axes[0], &at) || *at++ != ' ' || !read_axis(&r->axes[1], &at) || *at ||
        r->axes[0].name == r->axes[1].name)
        return rt_fail(error, RT_ERROR_INPUT,
                       "cannot read %.350s: its resolution is not two axes of 1 to %u, as '-Y 600 "
                       "+X 800'",
                       r->name, RT_IMAGE_SIDE_MAX);
    return RT_OK;
}

static rt_status read_header(reader *r, rt_error *error)
{
    char line[line_max];
    if (!next_line(r, line) || strncmp(line, "#?", 2) != 0)
        return fail_input(r, "it is not a Radiance picture", error);
    do {
        if (!next_line(r, line))
            return fail_input(r, "its header has no end, or a line of more than 1023 characters",
                              error);
        if (strncmp(line, "FORMAT=", 7) == 0 && strcmp(line + 7, "32-bit_rle_rgbe") != 0)
            return fail_input(r,
                              "its FORMAT is not 32-bit_rle_rgbe: convert it, as by `ra_xyze -r "
                              "FILE NEW.hdr` of Radiance",
                              error);
    } while (line[0]);
    if (!next_line(r, line))
        return fail_input(r, "it has no resolution", error);
    return read_resolution(r, line, error);
}

/* Checks that the file can hold what its header promises, before anything is allocated for it. */
static rt_status check_size(const reader *r, rt_error *error)
{
    const uint64_t values = (uint64_t)r->axes[0].size * r->axes[1].size * 3;
    /* A scan line takes a pixel, and a run where it is longer. */
    const uint64_t least = (uint64_t)r->axes[0].size * (r->axes[1].size > 1 ? 8 : 4);
    if (values > RT_IMAGE_VALUES_MAX)
        return fail_input(r, "it holds more than 2^30 values", error);
    if (least > r->file->size - r->at)
        return fail_input(r, "it is too short for the size that it states", error);
    if (rt_image_is_bomb(values, r->file->size))
        return fail_input(r, "it is too large for its length: more than 64 values a byte", error);
    return RT_OK;
}

/* ---- Scan lines ---------------------------------------------------------------- */

static rt_status fail_short(const reader *r, rt_error *error)
{
    return fail_input(r, "it is cut short", error);
}

static rt_status fail_run(const reader *r, rt_error *error)
{
    return fail_input(r, "a run goes beyond its scan line", error);
}

/* Pixels as they are; 1, 1, 1, n repeats the one before n times, further ones n 256 times more. */
static rt_status read_flat(reader *r, rt_error *error)
{
    const uint64_t length = r->axes[1].size;
    uint64_t x = 0;
    for (unsigned shift = 0; x < length;) {
        const uint8_t *pixel = r->file->data + r->at;
        if (r->file->size - r->at < 4)
            return fail_short(r, error);
        r->at += 4;
        if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
            memcpy(r->line + 4 * x++, pixel, 4);
            shift = 0;
            continue;
        }
        if (x == 0)
            return fail_input(r, "a run has no pixel before it in its scan line", error);
        const uint64_t count = (uint64_t)pixel[3] << shift;
        if (count > length - x || shift > 24)
            return fail_run(r, error);
        for (uint64_t i = 0; i < count; i++, x++)
            memcpy(r->line + 4 * x, r->line + 4 * (x - 1), 4);
        shift += 8;
    }
    return RT_OK;
}

/* One of the four bytes of all pixels of the scan line: runs, and bytes as they are. */
static rt_status read_component(reader *r, int component, rt_error *error)
{
    const uint32_t length = r->axes[1].size;
    const uint8_t *data = r->file->data;
    for (uint32_t x = 0; x < length;) {
        if (r->file->size - r->at < 2)
            return fail_short(r, error);
        const uint32_t code = data[r->at++], count = code > 128 ? code - 128 : code;
        if (count == 0)
            return fail_input(r, "a run is empty", error);
        if (count > length - x)
            return fail_run(r, error);
        const size_t used = code > 128 ? 1 : count;
        if (r->file->size - r->at < used)
            return fail_short(r, error);
        for (uint32_t i = 0; i < count; i++, x++)
            r->line[4 * (size_t)x + (size_t)component] = data[r->at + (used > 1 ? i : 0)];
        r->at += used;
    }
    return RT_OK;
}

static rt_status read_line(reader *r, rt_error *error)
{
    const uint32_t length = r->axes[1].size;
    const uint8_t *head = r->file->data + r->at;
    if (r->file->size - r->at < 4)
        return fail_short(r, error);
    if (length < run_side_min || length > run_side_max || head[0] != 2 || head[1] != 2 ||
        head[2] > 127)
        return read_flat(r, error);
    if ((uint32_t)(head[2] << 8 | head[3]) != length)
        return fail_input(r, "a scan line has another length than the picture", error);
    r->at += 4;
    rt_status status = RT_OK;
    for (int component = 0; component < 4 && status == RT_OK; component++)
        status = read_component(r, component, error);
    return status;
}

/* Where on its axis, counted from the left or the top, the i-th item of it lies. */
static uint32_t place_of(const axis *a, uint32_t i)
{
    return a->is_ascending == (a->name == 'X') ? i : a->size - 1 - i;
}

static rt_status read_lines(reader *r, rt_image *image, rt_error *error)
{
    const int is_column = r->axes[0].name == 'X';
    for (uint32_t j = 0; j < r->axes[0].size; j++) {
        const rt_status status = read_line(r, error);
        if (status != RT_OK)
            return status;
        const uint32_t across = place_of(&r->axes[0], j);
        for (uint32_t i = 0; i < r->axes[1].size; i++) {
            const uint32_t along = place_of(&r->axes[1], i);
            const size_t x = is_column ? across : along, y = is_column ? along : across;
            const uint8_t *pixel = r->line + 4 * (size_t)i;
            for (size_t c = 0; c < 3; c++)
                image->data[3 * (y * image->width + x) + c] =
                    pixel[3] ? ldexpf((float)pixel[c], pixel[3] - 136) : 0.0f;
        }
    }
    return RT_OK;
}

/*
 * Decodes a Radiance picture, flat or run-length encoded by either scheme, of any orientation, to
 * the linear channels R, G, B. A mantissa m of exponent e stands for m 2^(e - 136); EXPOSURE and
 * other lines of the header are not followed. Fails with RT_ERROR_INPUT when the file is damaged,
 * cut short or too large, or holds XYZ; what follows its pixels is ignored. `name` stands for it in
 * messages. The caller destroys *out.
 */
rt_status rt_hdr_decode(rt_image **out, const rt_bytes *file, const char *name, rt_error *error)
{
    static const char *const rgb[3] = {"R", "G", "B"};
    reader r = {.file = file, .name = name};
    rt_image *image = NULL;
    rt_status status = read_header(&r, error);
    if (status == RT_OK)
        status = check_size(&r, error);
    if (status == RT_OK) {
        const int is_column = r.axes[0].name == 'X';
        status = rt_image_create_in(&image, file->memory, r.axes[!is_column].size,
                                    r.axes[is_column].size, rgb, 3, error);
    }
    if (status == RT_OK) {
        r.line = rt_memory_zeroed(file->memory, r.axes[1].size, 4, "a scan line", error);
        status = r.line ? read_lines(&r, image, error) : RT_ERROR_MEMORY;
    }
    rt_memory_free(r.line);
    if (status == RT_OK)
        *out = image;
    else
        rt_image_destroy(image);
    return status;
}
