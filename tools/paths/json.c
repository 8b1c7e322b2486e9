/* json.c - the paths of a pixel as JSON. */
#define _POSIX_C_SOURCE 200809L /* open_memstream */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../interrupt.h"
#include "../message.h"
#include "../status.h"
#include "write.h"

int text_file_begin(text_file *out)
{
    memset(out, 0, sizeof *out);
    out->stream = open_memstream(&out->data, &out->size);
    if (!out->stream)
        message_error("out of memory");
    return out->stream != NULL;
}

int text_file_end(text_file *out, int keep, const char *path)
{
    rt_error error;
    int failed = ferror(out->stream);
    failed |= fclose(out->stream) != 0;
    int status = STATUS_DONE;
    if (failed) {
        message_error("out of memory");
        status = STATUS_DEVICE;
    } else if (keep && path) {
        status = rt_file_write(path, out->data, out->size, &error) == RT_OK
                     ? STATUS_DONE
                     : message_failure(&error);
    } else if (keep) {
        fwrite(out->data, 1, out->size, stdout); /* checked when the program ends */
    }
    free(out->data);
    return status;
}

void paths_mean(double mean[3], const pixel_paths *pixel)
{
    double weight = 0;
    mean[0] = mean[1] = mean[2] = 0;
    for (size_t i = 0; i < pixel->path_count; i++) {
        const rt_camera_path *path = &pixel->paths[i];
        weight += path->weight;
        for (int c = 0; c < 3 && path->weight != 0; c++)
            mean[c] += (double)path->weight * path->radiance[c];
    }
    for (int c = 0; c < 3; c++)
        mean[c] = weight != 0 ? mean[c] / weight : 0;
}

/* ---- Values ---------------------------------------------------------------------------------- */

/* In quotes; < too is escaped, so that it can stand in a page. */
static void put_text(FILE *out, const char *text)
{
    putc('"', out);
    for (const unsigned char *c = (const unsigned char *)text; *c; c++)
        if (*c == '"' || *c == '\\' || *c == '<' || *c < 0x20)
            fprintf(out, "\\u%04x", *c);
        else
            putc(*c, out);
    putc('"', out);
}

/* A number that a float is read back from; null for what is not finite. */
static void put_number(FILE *out, double value)
{
    if (isfinite(value))
        fprintf(out, "%.9g", value);
    else
        fputs("null", out);
}

static void put_member(FILE *out, const char *name, double value)
{
    fprintf(out, ",\"%s\":", name);
    put_number(out, value);
}

static void put_floats(FILE *out, const char *name, const float *values, int count)
{
    fprintf(out, ",\"%s\":[", name);
    for (int i = 0; i < count; i++) {
        fputs(i > 0 ? "," : "", out);
        put_number(out, values[i]);
    }
    putc(']', out);
}

/* Pixels; null for what the camera does not see. */
static void put_raster(FILE *out, const char *name, const float raster[2])
{
    if (isfinite(raster[0]) && isfinite(raster[1]))
        put_floats(out, name, raster, 2);
    else
        fprintf(out, ",\"%s\":null", name);
}

/* ---- Paths ----------------------------------------------------------------------------------- */

/* The light that is met, and the one that is sampled. */
static void put_lights(FILE *out, const rt_path_vertex *v)
{
    if (v->emitter != RT_NONE) {
        fprintf(out, ",\"emitted\":{\"light\":%u", v->emitter);
        put_member(out, "weight", v->emitted_weight);
        put_floats(out, "radiance", v->emitted, 3);
        putc('}', out);
    }
    if (v->light != RT_NONE) {
        fprintf(out, ",\"direct\":{\"light\":%u", v->light);
        put_floats(out, v->flags & RT_PATH_LIGHT_DISTANT ? "direction" : "position",
                   v->light_position, 3);
        put_raster(out, "raster", v->light_raster);
        fprintf(out, ",\"delta\":%s,\"occluded\":%s",
                v->flags & RT_PATH_LIGHT_DELTA ? "true" : "false",
                v->flags & RT_PATH_LIGHT_OCCLUDED ? "true" : "false");
        put_member(out, "pdf_w", v->light_pdf_w);
        put_member(out, "weight", v->direct_weight);
        put_floats(out, "radiance", v->direct, 3);
        putc('}', out);
    }
}

static void put_vertex(FILE *out, const rt_path_vertex *v)
{
    fprintf(out, "{\"event\":\"%s\",\"depth\":%u", rt_path_event_name(v->event), v->depth);
    put_floats(out, v->event == RT_PATH_ESCAPED ? "direction" : "position", v->position, 3);
    put_floats(out, "throughput", v->throughput, 3);
    if (v->shape != RT_NONE) {
        fprintf(out, ",\"shape\":%u,\"material\":%u", v->shape, v->material);
        put_floats(out, "normal", v->normal, 3);
        put_raster(out, "raster", v->raster);
        put_member(out, "pdf_w", v->pdf_w);
        put_member(out, "survival", v->survival);
    }
    put_lights(out, v);
    putc('}', out);
}

static void put_path(FILE *out, const pixel_paths *pixel, const rt_camera_path *path)
{
    fprintf(out, "{\"sample\":%u", path->sample);
    put_member(out, "weight", path->weight);
    put_floats(out, "radiance", path->radiance, 3);
    put_member(out, "cut_off", path->cut_off);
    fputs(",\"vertices\":[\n", out);
    for (uint32_t i = 0; i < path->vertex_count; i++) {
        fputs(i > 0 ? ",\n" : "", out);
        put_vertex(out, pixel->vertices + path->first_vertex + i);
    }
    fputs("]}", out);
}

int paths_write_json(const pixel_paths *pixel, text_file *file)
{
    FILE *out = file->stream;
    double mean[3];
    paths_mean(mean, pixel);
    fputs("{\"scene\":", out);
    put_text(out, pixel->scene);
    fprintf(out, ",\"pixel\":[%u,%u],\"width\":%u,\"height\":%u,\"first\":%u,\"count\":%zu",
            pixel->x, pixel->y, pixel->width, pixel->height, pixel->first, pixel->path_count);
    fputs(",\"radiance\":[", out);
    for (int c = 0; c < 3; c++) {
        fputs(c > 0 ? "," : "", out);
        put_number(out, mean[c]);
    }
    fputs("],\"paths\":[\n", out);
    for (size_t i = 0; i < pixel->path_count && !interrupt_pending(); i++) {
        fputs(i > 0 ? ",\n" : "", out);
        put_path(out, pixel, pixel->paths + i);
    }
    fputs("]}\n", out);
    return STATUS_DONE;
}
