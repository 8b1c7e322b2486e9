/*
 * first_hit.c - the modes that show a layer of the first hit: normals, albedo and depth. They have
 * no kernel of their own, but show a layer of layers.h.
 */
#include "mode/modes.h"
#include "mode/pixel_samples.h"

/* (n + 1) / 2, weighted by the fraction of the samples that hit. */
static void show_normals(float rgb[3], const rt_first_hits *sums)
{
    float covered = (float)(sums->hit_weight / rt_film_divisor(sums->weight, sums->count));
    rt_first_hit_layer_value(rgb, sums, RT_FILM_NORMAL);
    for (int c = 0; c < 3; c++)
        rgb[c] = 0.5f * (rgb[c] + covered);
}

static void show_albedo(float rgb[3], const rt_first_hits *sums)
{
    rt_first_hit_layer_value(rgb, sums, RT_FILM_ALBEDO);
}

static void show_depth(float rgb[3], const rt_first_hits *sums)
{
    rt_first_hit_layer_value(rgb, sums, RT_FILM_DEPTH);
    rgb[1] = rgb[2] = rgb[0];
}

const rt_mode_class rt_mode_normals = {
    .knows_media = 1,
    .knows_grids = 1,
    .state_size = sizeof(rt_pixel_samples),
    .run = rt_pixel_samples_run,
    .show = show_normals,
};

const rt_mode_class rt_mode_albedo = {
    .knows_media = 1,
    .knows_grids = 1,
    .state_size = sizeof(rt_pixel_samples),
    .run = rt_pixel_samples_run,
    .show = show_albedo,
};

const rt_mode_class rt_mode_depth = {
    .knows_media = 1,
    .knows_grids = 1,
    .state_size = sizeof(rt_pixel_samples),
    .run = rt_pixel_samples_run,
    .show = show_depth,
};
