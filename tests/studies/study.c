/* study.c - opens a scene, renders it and measures errors. */
#include "studies/study.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void must(const study *s, rt_status status, const rt_error *error)
{
    if (status == RT_OK)
        return;
    fprintf(stderr, "%s: %s\n", s->name, error->message);
    exit(1);
}

static rt_device *device;

static void close_device(void)
{
    rt_device_close(device);
}

void study_open(study *s, const char *name, const char *scene, uint32_t side)
{
    rt_error error;
    memset(s, 0, sizeof *s);
    s->name = name;
    must(s, rt_scene_load(&s->scene, scene, NULL, &error), &error);
    if (!device) {
        must(s, rt_device_open(&device, NULL, &error), &error);
        atexit(close_device);
    }
    s->device = device;
    must(s, rt_renderer_create(&s->renderer, s->scene, s->device, NULL, &error), &error);
    rt_scene_get_options(s->scene, &s->options);
    s->options.width = s->options.height = side;
}

void study_close(study *s)
{
    rt_renderer_destroy(s->renderer);
    rt_scene_destroy(s->scene);
}

rt_film *study_render(const study *s, const rt_render_options *options, double *seconds)
{
    rt_film *film = NULL;
    rt_film_stats stats;
    rt_error error;
    must(s, rt_render(&film, s->renderer, options, &error), &error);
    rt_film_get_stats(film, &stats);
    if (seconds)
        *seconds = stats.emit_seconds + stats.gather_seconds + stats.render_seconds;
    return film;
}

/* Above this, a pixel sees an area light. */
static float emitter_threshold(const rt_film *reference, size_t count)
{
    float brightest = 0;
    for (size_t i = 0; i < count; i++)
        brightest = fmaxf(brightest, rt_film_rgb(reference)[i]);
    return brightest > 20 * study_mean(reference) ? brightest / 2 : HUGE_VALF;
}

static int near_emitter(const rt_film *reference, uint32_t x, uint32_t y, float threshold)
{
    uint32_t width, height;
    rt_film_get_size(reference, &width, &height);
    for (uint32_t v = y > 0 ? y - 1 : 0; v <= y + 1 && v < height; v++)
        for (uint32_t u = x > 0 ? x - 1 : 0; u <= x + 1 && u < width; u++)
            for (int c = 0; c < 3; c++)
                if (rt_film_rgb(reference)[3 * ((size_t)v * width + u) + c] > threshold)
                    return 1;
    return 0;
}

double study_mse_of_two(const rt_film *film, const rt_film *a, const rt_film *b)
{
    uint32_t width, height;
    double sum = 0, count = 0;
    rt_film_get_size(a, &width, &height);
    float threshold = emitter_threshold(a, (size_t)3 * width * height);
    for (uint32_t y = 0; y < height; y++)
        for (uint32_t x = 0; x < width; x++) {
            if (near_emitter(a, x, y, threshold))
                continue;
            for (int c = 0; c < 3; c++) {
                size_t at = 3 * ((size_t)y * width + x) + c;
                double value = rt_film_rgb(film)[at];
                sum += (value - rt_film_rgb(a)[at]) * (value - rt_film_rgb(b)[at]);
                count++;
            }
        }
    return count > 0 ? sum / count : 0;
}

double study_mse(const rt_film *film, const rt_film *reference)
{
    return study_mse_of_two(film, reference, reference);
}

double study_mean(const rt_film *film)
{
    uint32_t width, height;
    double sum = 0;
    rt_film_get_size(film, &width, &height);
    size_t count = (size_t)3 * width * height;
    for (size_t i = 0; i < count; i++)
        sum += rt_film_rgb(film)[i];
    return sum / (double)count;
}

double study_slope(const double *x, const double *y, int count)
{
    double mx = 0, my = 0, xy = 0, xx = 0;
    for (int i = 0; i < count; i++) {
        mx += log(x[i]) / count;
        my += log(y[i]) / count;
    }
    for (int i = 0; i < count; i++) {
        xy += (log(x[i]) - mx) * (log(y[i]) - my);
        xx += (log(x[i]) - mx) * (log(x[i]) - mx);
    }
    return xy / xx;
}
