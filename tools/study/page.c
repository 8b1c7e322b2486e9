/*
 * page.c - writes the page of studies: page.html with its data as JSON in the place of @DATA@.
 *
 * Pixels are linear light as RGB9E5, 32 bits: three mantissas of 9 bits, red in the lowest, and an
 * exponent of 5 bits in the highest, as the OpenGL extension EXT_texture_shared_exponent has them;
 * little-endian and in base 64.
 */
#define _POSIX_C_SOURCE 200809L /* open_memstream */

#include "page.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../message.h"
#include "../status.h"
#include "page_source.h"

/* ---- Pixels ------------------------------------------------------------------- */

/* The largest value, and the exponent bias, of RGB9E5. */
static const float pixel_max = 65408.0f;
enum { BIAS = 15, MANTISSA = 9 };

static uint32_t pixel_of(const float rgb[3])
{
    float value[3], most = 0.0f;
    int exponent;
    for (int c = 0; c < 3; c++) {
        value[c] = rgb[c] > 0.0f ? fminf(rgb[c], pixel_max) : 0.0f; /* 0 for what is no number */
        most = fmaxf(most, value[c]);
    }
    frexpf(most, &exponent); /* most < 2^exponent */
    exponent = most > 0.0f && exponent > -BIAS ? exponent : -BIAS;
    if (lrintf(ldexpf(most, MANTISSA - exponent)) == 1 << MANTISSA)
        exponent++;
    uint32_t pixel = (uint32_t)(exponent + BIAS) << 27;
    for (int c = 0; c < 3; c++)
        pixel |= (uint32_t)lrintf(ldexpf(value[c], MANTISSA - exponent)) << MANTISSA * c;
    return pixel;
}

int study_cell_set_pixels(study_cell *cell, const float *rgb, uint32_t width, uint32_t height)
{
    const size_t count = (size_t)width * height;
    cell->pixels = malloc(count * sizeof *cell->pixels);
    if (!cell->pixels)
        return 0;
    cell->width = width;
    cell->height = height;
    for (size_t i = 0; i < count; i++)
        cell->pixels[i] = pixel_of(rgb + 3 * i);
    return 1;
}

void study_cell_free(study_cell *cell)
{
    free(cell->command);
    free(cell->pixels);
    *cell = (study_cell){0};
}

static void put_base64(FILE *out, const uint32_t *words, size_t count)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const size_t bytes = 4 * count;
    for (size_t at = 0; at < bytes; at += 3) {
        uint32_t three = 0;
        for (size_t i = at; i < at + 3; i++)
            three = three << 8 | (i < bytes ? words[i / 4] >> 8 * (i % 4) & 255u : 0u);
        for (int i = 0; i < 4; i++)
            putc(at + (size_t)i > bytes ? '=' : digits[three >> (18 - 6 * i) & 63u], out);
    }
}

/* ---- JSON, within HTML ---------------------------------------------------------- */

static void put_text(FILE *out, const char *text)
{
    putc('"', out);
    for (const unsigned char *c = (const unsigned char *)(text ? text : ""); *c; c++)
        if (*c == '"' || *c == '\\' || *c == '<' || *c < 0x20)
            fprintf(out, "\\u%04x", *c);
        else
            putc(*c, out);
    putc('"', out);
}

static void put_number(FILE *out, const char *name, double value)
{
    if (isfinite(value))
        fprintf(out, ",\"%s\":%.9g", name, value);
    else
        fprintf(out, ",\"%s\":null", name);
}

/* The members of a cell behind its first; *pictures counts those so far. */
static void put_measures(FILE *out, const study_cell *cell, size_t *pictures)
{
    fputs("\"command\":", out);
    put_text(out, cell->command);
    put_number(out, "seconds", cell->seconds);
    put_number(out, "rmse", cell->rmse);
    put_number(out, "relmse", cell->relmse);
    put_number(out, "flip", cell->flip);
    put_number(out, "ratio", cell->ratio);
    put_number(out, "noise", cell->noise);
    put_number(out, "bias", cell->bias);
    if (cell->leaves_out) {
        fputs(",\"leaves_out\":", out);
        put_text(out, cell->leaves_out);
    }
    if (cell->pixels)
        fprintf(out, ",\"picture\":%zu", (*pictures)++);
}

static void put_axes(FILE *out, const sweep *axes)
{
    for (size_t a = 0; a < axes->count; a++) {
        const sweep_axis *axis = &axes->axes[a];
        fprintf(out, "%s{\"name\":", a > 0 ? "," : "");
        put_text(out, axis->name);
        fprintf(out, ",\"numeric\":%s,\"values\":[", sweep_is_numeric(axis) ? "true" : "false");
        for (size_t v = 0; v < axis->count; v++) {
            fputs(v > 0 ? "," : "", out);
            put_text(out, axis->values[v]);
        }
        fputs("]}", out);
    }
}

static void put_study(FILE *out, const study_result *study, size_t *pictures)
{
    const size_t cells = sweep_cells(study->axes);
    fputs("{\"id\":", out);
    put_text(out, study->id);
    fputs(",\"title\":", out);
    put_text(out, study->title);
    fputs(",\"text\":", out);
    put_text(out, study->text);
    fputs(",\"axes\":[", out);
    put_axes(out, study->axes);
    fputs("],\"cells\":[", out);
    for (size_t i = 0; i < cells; i++) {
        fprintf(out, "%s{\"values\":[", i > 0 ? "," : "");
        for (size_t a = 0; a < study->axes->count; a++) {
            fputs(a > 0 ? "," : "", out);
            put_text(out, sweep_value(study->axes, i, a));
        }
        fputs("],", out);
        if (study->views > 0)
            fprintf(out, "\"view\":%zu,", study->view[i]);
        put_measures(out, &study->cells[i], pictures);
        putc('}', out);
    }
    fputs("],\"references\":[", out);
    for (size_t i = 0; i < study->views; i++) {
        fputs(i > 0 ? ",{" : "{", out);
        const study_cell *reference = &study->references[i];
        put_measures(out, reference, pictures);
        if (reference->target > 0)
            fprintf(out, ",\"target\":%.9g,\"limit\":%u", reference->target,
                    (unsigned)reference->limit);
        fputs(reference->hides_bias ? ",\"hides_bias\":true" : "", out);
        fputs(reference->is_coarse ? ",\"coarse\":true}" : "}", out);
    }
    fputs("]}", out);
}

static void put_picture(FILE *out, const study_cell *cell, size_t *pictures)
{
    if (!cell->pixels)
        return;
    fprintf(out, "%s{\"width\":%u,\"height\":%u,\"data\":\"", (*pictures)++ > 0 ? ",\n" : "",
            (unsigned)cell->width, (unsigned)cell->height);
    put_base64(out, cell->pixels, (size_t)cell->width * cell->height);
    fputs("\"}", out);
}

static void put_data(FILE *out, const char *title, const study_result *studies, size_t count)
{
    size_t pictures = 0;
    fputs("{\"title\":", out);
    put_text(out, title);
    fprintf(out, ",\"footer\":\"librt %s\",\"studies\":[", rt_version());
    for (size_t i = 0; i < count; i++) {
        fputs(i > 0 ? ",\n" : "", out);
        put_study(out, &studies[i], &pictures);
    }
    fputs("],\n\"pictures\":[", out);
    pictures = 0;
    for (size_t i = 0; i < count; i++) {
        for (size_t cell = 0; cell < sweep_cells(studies[i].axes); cell++)
            put_picture(out, &studies[i].cells[cell], &pictures);
        for (size_t view = 0; view < studies[i].views; view++)
            put_picture(out, &studies[i].references[view], &pictures);
    }
    fputs("]}", out);
}

/* ---- Files ---------------------------------------------------------------------- */

/* Ends a text in memory and makes it the content of a file. */
static int finish(FILE *out, char **data, size_t *size, const char *path)
{
    rt_error error;
    int failed = ferror(out);
    failed |= fclose(out) != 0;
    if (failed) {
        message_error("out of memory");
        free(*data);
        return STATUS_DEVICE;
    }
    const rt_status status = rt_file_write(path, *data, *size, &error);
    free(*data);
    return status == RT_OK ? STATUS_DONE : message_failure(&error);
}

static FILE *begin(char **data, size_t *size)
{
    FILE *out = open_memstream(data, size);
    if (!out)
        message_error("out of memory");
    return out;
}

int page_write(const char *path, const char *title, const study_result *studies, size_t count)
{
    static const char mark[] = "@DATA@";
    char *data = NULL;
    size_t size = 0, before = 0;
    FILE *out = begin(&data, &size);
    if (!out)
        return STATUS_DEVICE;
    while (memcmp(page_source + before, mark, sizeof mark - 1) != 0)
        before++;
    const size_t after = before + sizeof mark - 1;
    fwrite(page_source, 1, before, out);
    put_data(out, title, studies, count);
    fwrite(page_source + after, 1, page_source_size - after, out);
    return finish(out, &data, &size, path);
}

/* A value of a table, in quotes where it has to be. */
static void put_value(FILE *out, const char *text)
{
    if (!strpbrk(text, ",\"\n")) {
        fputs(text, out);
        return;
    }
    putc('"', out);
    for (; *text; text++)
        fprintf(out, *text == '"' ? "\"%c" : "%c", *text);
    putc('"', out);
}

/* own: the error of the reference itself, in the unit of the bias. */
static void put_row(FILE *out, const study_cell *cell, double own)
{
    const double measures[] = {cell->rmse,  cell->relmse, cell->flip, cell->ratio,
                               cell->noise, cell->bias,   own,        cell->seconds};
    for (size_t i = 0; i < sizeof measures / sizeof *measures; i++)
        if (isfinite(measures[i]))
            fprintf(out, ",%.9g", measures[i]);
        else
            putc(',', out);
    putc(',', out);
    put_value(out, cell->command ? cell->command : "");
    putc('\n', out);
}

int table_write(const char *path, const study_result *study)
{
    char *data = NULL;
    size_t size = 0;
    FILE *out = begin(&data, &size);
    if (!out)
        return STATUS_DEVICE;
    for (size_t a = 0; a < study->axes->count; a++) {
        put_value(out, study->axes->axes[a].name);
        putc(',', out);
    }
    fputs("relative_rmse,relmse,flip,ratio,noise,bias,reference_error,seconds,command\n", out);
    for (size_t i = 0; i < sweep_cells(study->axes); i++) {
        for (size_t a = 0; a < study->axes->count; a++) {
            fputs(a > 0 ? "," : "", out);
            put_value(out, sweep_value(study->axes, i, a));
        }
        put_row(out, &study->cells[i],
                study->views > 0 ? study->references[study->view[i]].noise : NAN);
    }
    return finish(out, &data, &size, path);
}
