/*
 * study_caustic.c - a caustic by path tracing and by photon mapping, in equal time.
 *
 *     study_caustic [PASSES [REFERENCE [FILE]]]
 *
 * scenes/box_caustic.rts: the light that the glass sphere gathers on the floor. PASSES of photon
 * mapping (8) are timed, and path tracing gets as many samples a pixel as take as long. Time is
 * that of processors, so that other programs do not count. Pictures go to build/study.
 *
 * The region is the floor within 0.3 m of where the line from the light's centre through the
 * sphere's meets it, as far as whole pixels see it beside the sphere. A picture's squared error is
 * the mean product of its differences from two references with independent noise, which therefore
 * enters its standard error only. It is measured twice:
 *   - by paths and photons: one reference is path traced with REFERENCE samples a pixel (1024), or
 *   is
 *     the picture FILE, of the same size, and the other is of photons, of another seed, in twice as
 *     many passes with half the radius around caustics. It owes nothing to photons being right, but
 *     paths that rarely meet the light make it uncertain;
 *   - by photons and photons: both references are of that kind, with seeds of their own. Of bias,
 *   which
 *     goes with the squared radius, they have a quarter, and the product 9/16 of the square.
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
static const double glass[3] = {-0.5, -0.7, -0.25}, glass_radius = 0.3, light_y = 0.999,
                    spot_radius = 0.3;

static int meets_glass(const double d[3])
{
    double o[3] = {-glass[0], -glass[1], eye_z - glass[2]};
    double b = o[0] * d[0] + o[1] * d[1] + o[2] * d[2],
           dd = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    double c = o[0] * o[0] + o[1] * o[1] + o[2] * o[2] - glass_radius * glass_radius;
    return b * b > dd * c;
}

/* Whether the floor is seen at a point of the film, in pixels, within the spot. */
static int in_spot(double x, double y)
{
    /* The camera looks along +z, and +x is on the left. */
    double scale = tan(half_fov), to_spot = (light_y - floor_y) / (light_y - glass[1]);
    double d[3] = {-(2 * x / side - 1) * scale, -(2 * y / side - 1) * scale, 1};
    if (d[1] >= 0 || meets_glass(d))
        return 0;
    double t = floor_y / d[1], dx = t * d[0] - to_spot * glass[0],
           dz = eye_z + t - to_spot * glass[2];
    return dx * dx + dz * dz < spot_radius * spot_radius;
}

/* Whether all of a pixel lies there. */
static int in_region(uint32_t x, uint32_t y)
{
    return in_spot(x, y) && in_spot(x + 1, y) && in_spot(x, y + 1) && in_spot(x + 1, y + 1);
}

/* Root of the mean squared error over the region, and the standard error of that. */
typedef struct region_error {
    double rmse, deviation;
} region_error;

static region_error error_of(const float *rgb, const float *first, const float *second)
{
    double sum = 0, squares = 0, count = 0;
    for (uint32_t y = 0; y < side; y++)
        for (uint32_t x = 0; x < side; x++) {
            double product = 0;
            for (size_t i = 3 * ((size_t)y * side + x), c = 0; c < 3 && in_region(x, y); c++)
                product +=
                    ((double)rgb[i + c] - first[i + c]) * ((double)rgb[i + c] - second[i + c]) / 3;
            sum += product;
            squares += product * product;
            count += in_region(x, y);
        }
    double mean = sum / count, rmse = sqrt(fmax(mean, 0));
    return (region_error){rmse, sqrt((squares / count - mean * mean) / count) / (2 * rmse)};
}

static double region_mean(const float *rgb)
{
    double sum = 0;
    size_t count = 0;
    for (uint32_t y = 0; y < side; y++)
        for (uint32_t x = 0; x < side; x++)
            for (size_t i = 3 * ((size_t)y * side + x), c = 0; c < 3 && in_region(x, y);
                 c++, count++)
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

static rt_film *map_photons(const study *s, uint32_t passes, float radius, uint32_t seed,
                            double *seconds)
{
    rt_render_options options = s->options;
    options.mode = RT_MODE_PHOTON;
    options.passes = passes;
    options.seed = seed;
    options.spp = 4;
    options.photons = 160000;
    options.radius = 0.1f; /* wide: what comes by diffuse bounces is smooth */
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
    if (!rgb || rt_image_read(&image, path, &error) != RT_OK || image->width != side ||
        image->height != side || rt_image_rgb_channels(channels, image, &error) != RT_OK) {
        fprintf(stderr, "study_caustic: %s is no picture of %d x %d pixels\n", path, side, side);
        exit(1);
    }
    for (size_t i = 0; i < (size_t)side * side; i++)
        for (int c = 0; c < 3; c++)
            rgb[3 * i + c] = image->data[i * image->channel_count + channels[c]];
    rt_image_destroy(image);
    return rgb;
}

static void print_row(const char *what, const rt_film *film, double seconds,
                      const region_error errors[2], double mean)
{
    printf("%-28s %8.2f %11.5f +- %.5f %11.5f +- %.5f %9.5f\n", what, seconds, errors[0].rmse,
           errors[0].deviation, errors[1].rmse, errors[1].deviation,
           region_mean(rt_film_rgb(film)) / mean);
}

/* Paths for as long as photons took: a first round of as many samples says how many more. */
static rt_film *trace_as_long(const study *s, double photon_seconds, uint32_t *spp, double *seconds)
{
    *spp = 64;
    for (int round = 0; round < 2; round++) {
        rt_film_destroy(trace_paths(s, *spp, 1, seconds));
        *spp = (uint32_t)fmax(1, photon_seconds / *seconds * *spp + 0.5);
    }
    return trace_paths(s, *spp, 1, seconds);
}

int main(int argc, char **argv)
{
    uint32_t passes = argc > 1 ? (uint32_t)strtoul(argv[1], NULL, 10) : 8;
    const float radius = 0.006f; /* metres, of the first pass around caustics */
    uint32_t spp = argc > 2 ? (uint32_t)strtoul(argv[2], NULL, 10) : 1024, equal;
    double photon_seconds, path_seconds, other_seconds;
    char what[64];
    study s;
    study_open(&s, "study_caustic", "scenes/box_caustic.rts", side);
    rt_film_destroy(map_photons(&s, 2, radius, 1, &other_seconds)); /* compiles */
    rt_film_destroy(trace_paths(&s, 1, 1, &other_seconds));

    float *read = argc > 3 ? read_reference(argv[3]) : NULL;
    rt_film *own = read ? NULL : trace_paths(&s, spp, 1000, &other_seconds);
    rt_film *first = map_photons(&s, 2 * passes, radius / 2, 1001, &other_seconds);
    rt_film *second = map_photons(&s, 2 * passes, radius / 2, 1002, &other_seconds);
    const float *by_paths = read ? read : rt_film_rgb(own);
    const float *by_photons[2] = {rt_film_rgb(first), rt_film_rgb(second)};

    rt_film *photon = map_photons(&s, passes, radius, 1, &photon_seconds);
    rt_film *path = trace_as_long(&s, photon_seconds, &equal, &path_seconds);
    region_error errors[2][2];
    for (int i = 0; i < 2; i++) {
        const float *rgb = rt_film_rgb(i == 0 ? path : photon);
        errors[i][0] = error_of(rgb, by_paths, by_photons[0]);
        errors[i][1] = error_of(rgb, by_photons[0], by_photons[1]);
    }
    double mean = region_mean(by_photons[0]);
    printf("%-28s %8s %22s %22s %9s\n", "caustic under glass", "seconds", "RMSE, path reference",
           "RMSE, photon reference", "mean");
    snprintf(what, sizeof what, "path, %u samples a pixel", equal);
    print_row(what, path, path_seconds, errors[0], mean);
    snprintf(what, sizeof what, "photon, %u passes", passes);
    print_row(what, photon, photon_seconds, errors[1], mean);
    printf("photons have 1/%.1f of the error by the one reference, 1/%.1f by the other; the path "
           "reference "
           "has a mean of %.5f\n\n",
           errors[0][0].rmse / errors[1][0].rmse, errors[0][1].rmse / errors[1][1].rmse,
           region_mean(by_paths) / mean);
    study_write(&s, (const rt_film *[]){path}, 1, "caustic-path");
    study_write(&s, (const rt_film *[]){photon}, 1, "caustic-photon");

    rt_film *films[] = {path, photon, own, first, second};
    for (size_t i = 0; i < sizeof films / sizeof *films; i++)
        rt_film_destroy(films[i]);
    free(read);
    study_close(&s);
    return 0;
}
