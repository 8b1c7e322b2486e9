/*
 * study_caustic.c - a caustic by path tracing and by photon mapping, in equal time.
 *
 *     study_caustic [PASSES [REFERENCE [FILE]]]
 *
 * scenes/box_caustic.rts: the light that the glass sphere gathers on the floor. PASSES of photon mapping (32) are
 * timed, and path tracing gets as many samples a pixel as take as long. Time is that of processors, so that other
 * programs do not count. Pictures go to build/study.
 *
 * The region is the floor within 0.3 m of where the line from the lamp's centre through the sphere's meets it, as far as
 * the camera sees it beside the sphere. There are two truths: one is path traced with REFERENCE samples a pixel (1024),
 * or is the picture FILE, of the same size; the other is of photons, of another seed, in four times as many passes with
 * half the radius around caustics. As their noises are independent, the mean product of a picture's
 * differences from the one and from the other is its squared error, without theirs. Where the error is bias, which goes
 * with the squared radius, the second truth has a quarter of it, and the product is 3/4 of the square.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "image/image_file.h"
#include "studies/study.h"

enum { side = 256 };

/* ---- The region ------------------------------------------------------------- */

static const double eye_z = -3.5, half_fov = 19 * 3.14159265358979323846 / 180, floor_y = -1;
static const double glass[3] = {-0.5, -0.7, -0.25}, glass_radius = 0.3, lamp_y = 0.999, spot_radius = 0.3;

static int meets_glass(const double d[3])
{
    double o[3] = {-glass[0], -glass[1], eye_z - glass[2]};
    double b = o[0] * d[0] + o[1] * d[1] + o[2] * d[2], dd = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    double c = o[0] * o[0] + o[1] * o[1] + o[2] * o[2] - glass_radius * glass_radius;
    return b * b > dd * c;
}

static int in_region(uint32_t x, uint32_t y)
{
    /* The camera looks along +z, and +x is on the left. */
    double scale = tan(half_fov), to_spot = (lamp_y - floor_y) / (lamp_y - glass[1]);
    double d[3] = {-(2 * (x + 0.5) / side - 1) * scale, -(2 * (y + 0.5) / side - 1) * scale, 1};
    if (d[1] >= 0 || meets_glass(d))
        return 0;
    double t = floor_y / d[1], dx = t * d[0] - to_spot * glass[0], dz = eye_z + t - to_spot * glass[2];
    return dx * dx + dz * dz < spot_radius * spot_radius;
}

static double region_rmse(const float *rgb, const float *first, const float *second)
{
    double sum = 0;
    size_t count = 0;
    for (uint32_t y = 0; y < side; y++)
        for (uint32_t x = 0; x < side; x++)
            for (size_t i = 3 * ((size_t)y * side + x), c = 0; c < 3 && in_region(x, y); c++, count++)
                sum += ((double)rgb[i + c] - first[i + c]) * ((double)rgb[i + c] - second[i + c]);
    return sum > 0 ? sqrt(sum / (double)count) : 0;
}

static double region_mean(const float *rgb)
{
    double sum = 0;
    size_t count = 0;
    for (uint32_t y = 0; y < side; y++)
        for (uint32_t x = 0; x < side; x++)
            for (size_t i = 3 * ((size_t)y * side + x), c = 0; c < 3 && in_region(x, y); c++, count++)
                sum += rgb[i + c];
    return sum / (double)count;
}

/* ---- Pictures ----------------------------------------------------------------- */

/* Renders; *seconds is the time of processors. */
static rt_film *render(const study *s, const rt_render_options *options, double *seconds)
{
    clock_t began = clock();
    rt_film *film = study_render(s, options, NULL);
    *seconds = (double)(clock() - began) / CLOCKS_PER_SEC;
    return film;
}

static rt_film *trace_paths(const study *s, uint32_t spp, uint32_t seed, double *seconds)
{
    rt_render_options options = s->options;
    options.mode = RT_MODE_PATH;
    options.spp = spp;
    options.seed = seed;
    return render(s, &options, seconds);
}

static rt_film *map_photons(const study *s, uint32_t passes, float radius, uint32_t seed, double *seconds)
{
    rt_render_options options = s->options;
    options.mode = RT_MODE_PHOTON;
    options.passes = passes;
    options.seed = seed;
    options.spp = 4;
    options.photons = 20000; /* few: what comes by diffuse bounces is smooth */
    options.radius = 0.1f;
    options.caustic_photons = 800000;
    options.caustic_radius = radius;
    return render(s, &options, seconds);
}

/* Reads the colours of a picture of the study's size. */
static float *read_reference(const char *path)
{
    rt_image *image = NULL;
    rt_error error;
    uint32_t channels[3];
    float *rgb = malloc(sizeof(float) * 3 * side * side);
    if (!rgb || rt_image_read(&image, path, &error) != RT_OK || image->width != side || image->height != side ||
        rt_image_rgb_channels(channels, image, &error) != RT_OK) {
        fprintf(stderr, "study_caustic: %s is no picture of %d x %d pixels\n", path, side, side);
        exit(1);
    }
    for (size_t i = 0; i < (size_t)side * side; i++)
        for (int c = 0; c < 3; c++)
            rgb[3 * i + c] = image->data[i * image->channel_count + channels[c]];
    rt_image_destroy(image);
    return rgb;
}

int main(int argc, char **argv)
{
    uint32_t passes = argc > 1 ? (uint32_t)strtoul(argv[1], NULL, 10) : 32;
    const float radius = 0.008f; /* metres, of the first pass around caustics */
    uint32_t spp = argc > 2 ? (uint32_t)strtoul(argv[2], NULL, 10) : 1024;
    double photon_seconds, path_seconds, other_seconds;
    study s;
    study_open(&s, "study_caustic", "scenes/box_caustic.rts", side);
    rt_film_destroy(map_photons(&s, 2, radius, 1, &other_seconds)); /* compiles */
    rt_film_destroy(trace_paths(&s, 1, 1, &other_seconds));

    float *read = argc > 3 ? read_reference(argv[3]) : NULL;
    rt_film *own = read ? NULL : trace_paths(&s, spp, 1000, &other_seconds);
    rt_film *second = map_photons(&s, 4 * passes, radius / 2, 1001, &other_seconds);
    const float *truth[2] = {read ? read : rt_film_rgb(own), rt_film_rgb(second)};

    /* Photons, then paths for as long as a first round says. */
    rt_film *photon = map_photons(&s, passes, radius, 1, &photon_seconds);
    uint32_t equal = 64;
    rt_film *path = trace_paths(&s, equal, 1, &path_seconds);
    equal = (uint32_t)fmax(1, photon_seconds / path_seconds * equal + 0.5);
    rt_film_destroy(path);
    path = trace_paths(&s, equal, 1, &path_seconds);
    double photon_rmse = region_rmse(rt_film_rgb(photon), truth[0], truth[1]);
    double path_rmse = region_rmse(rt_film_rgb(path), truth[0], truth[1]), mean = region_mean(truth[1]);
    printf("%-28s %10s %12s %10s\n", "caustic under glass", "seconds", "RMSE", "mean");
    printf("path, %4u samples a pixel   %10.2f %12.5f %10.5f\n", equal, path_seconds, path_rmse,
           region_mean(rt_film_rgb(path)) / mean);
    printf("photon, %4u passes          %10.2f %12.5f %10.5f\n", passes, photon_seconds, photon_rmse,
           region_mean(rt_film_rgb(photon)) / mean);
    printf("photons have 1/%.1f of the error, at a mean radiance of %.3f\n\n", path_rmse / photon_rmse, mean);
    study_write(&s, (const rt_film *[]){path}, 1, "caustic-path");
    study_write(&s, (const rt_film *[]){photon}, 1, "caustic-photon");

    rt_film_destroy(path);
    rt_film_destroy(photon);
    rt_film_destroy(own);
    rt_film_destroy(second);
    free(read);
    study_close(&s);
    return 0;
}
