/* compare.c - rt_image_compare: renders against a reference. */
#include "image/compare.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/flip.h"
#include "image/image.h"
#include "image/ssim.h"

#define DEFAULT_BLOCK 16u
#define DEFAULT_TOLERANCE 0.01
#define RELATIVE_FLOOR 0.01 /* keeps the relative error of black pixels finite */
#define EXPOSURE_MAX 126.0

enum { NAME_SIZE = 176 }; /* of an image in messages */

static rt_status check_options(const rt_compare_options *options, rt_error *error)
{
    if (!(options->tolerance >= 0.0 && options->tolerance <= 1.0))
        return rt_fail_field(error, RT_ERROR_USAGE, "tolerance",
                             "a tolerance is from 0 to 1, not %g", options->tolerance);
    if (!(fabs(options->exposure) <= EXPOSURE_MAX))
        return rt_fail_field(error, RT_ERROR_USAGE, "exposure",
                             "an exposure is from %g to %g stops, not %g", -EXPOSURE_MAX,
                             EXPOSURE_MAX, options->exposure);
    return RT_OK;
}

/* What an image is called in messages; index count is the reference. */
static const char *name_image(char *out, size_t size, const rt_compare_options *options,
                              size_t index, size_t count)
{
    if (options->names)
        snprintf(out, size, "%.160s", options->names[index]);
    else if (index == count)
        snprintf(out, size, "the reference");
    else
        snprintf(out, size, "image %zu", index + 1);
    return out;
}

static rt_status check_sizes(const rt_image *const *renders, size_t count,
                             const rt_image *reference, const rt_compare_options *options,
                             rt_error *error)
{
    char name[NAME_SIZE], reference_name[NAME_SIZE];
    if (count == 0)
        return rt_fail(error, RT_ERROR_USAGE, "there is no image to compare with the reference");
    for (size_t i = 0; i < count; i++)
        if (renders[i]->width != reference->width || renders[i]->height != reference->height)
            return rt_fail(error, RT_ERROR_INPUT, "%s has %ux%u pixels but %s %ux%u",
                           name_image(name, sizeof name, options, i, count), renders[i]->width,
                           renders[i]->height,
                           name_image(reference_name, sizeof reference_name, options, count, count),
                           reference->width, reference->height);
    return RT_OK;
}

/* ---- The pictures ------------------------------------------------------------ */

static float *create_picture(const rt_pictures *p)
{
    size_t values = 3 * (size_t)p->width * p->height;
    return values <= SIZE_MAX / sizeof(float) ? malloc(values * sizeof(float)) : NULL;
}

static void free_pictures(rt_pictures *p)
{
    for (size_t i = 0; p->renders && i < p->count; i++)
        free(p->renders[i]);
    free(p->renders);
    free(p->mean);
    free(p->reference);
    free(p->variance);
}

static rt_status allocate_pictures(rt_pictures *p, rt_error *error)
{
    p->mean = create_picture(p);
    p->reference = create_picture(p);
    p->renders = calloc(p->count, sizeof *p->renders);
    int complete = p->mean && p->reference && p->renders;
    for (size_t i = 0; i < p->count && complete; i++) {
        p->renders[i] = create_picture(p);
        complete = p->renders[i] != NULL;
    }
    if (!complete)
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory: %zu pictures of %ux%u pixels",
                       p->count + 2, p->width, p->height);
    return RT_OK;
}

/* Reads the layer of an image; says in which of them it is missing. */
static rt_status read_layer(float *rgb, const rt_image *image, const rt_compare_options *options,
                            size_t index, size_t count, rt_error *error)
{
    char name[NAME_SIZE];
    rt_error why;
    rt_status status = rt_image_get_rgb(rgb, image, options->layer, &why);
    if (status == RT_OK)
        return RT_OK;
    return rt_fail(error, status, "%s has %s", name_image(name, sizeof name, options, index, count),
                   why.message);
}

static void average_renders(rt_pictures *p)
{
    size_t values = 3 * (size_t)p->width * p->height;
    for (size_t i = 0; i < values; i++) {
        double sum = 0.0;
        for (size_t r = 0; r < p->count; r++)
            sum += p->renders[r][i];
        p->mean[i] = (float)(sum / (double)p->count);
    }
}

static rt_status read_pictures(rt_pictures *p, const rt_image *const *renders,
                               const rt_image *reference, const rt_compare_options *options,
                               rt_error *error)
{
    rt_status status = allocate_pictures(p, error);
    if (status == RT_OK)
        status = read_layer(p->reference, reference, options, p->count, p->count, error);
    for (size_t i = 0; i < p->count && status == RT_OK; i++)
        status = read_layer(p->renders[i], renders[i], options, i, p->count, error);
    if (status == RT_OK)
        average_renders(p);
    return status;
}

/* Adds share times the variance layer of an image to that of the difference. */
static rt_status add_variance(rt_pictures *p, float *layer, const rt_image *image, double share,
                              rt_error *error)
{
    size_t values = 3 * (size_t)p->width * p->height;
    rt_status status = rt_image_get_rgb(layer, image, "variance", error);
    for (size_t i = 0; i < values && status == RT_OK; i++)
        p->variance[i] += (float)(share * layer[i]);
    return status;
}

/* Where every image says how noisy its picture is: the variance of the difference. */
static rt_status read_variance(rt_pictures *p, const rt_image *const *renders,
                               const rt_image *reference, rt_error *error)
{
    int known = rt_image_has_layer(reference, "variance");
    for (size_t i = 0; i < p->count; i++)
        known = known && rt_image_has_layer(renders[i], "variance");
    if (!known)
        return RT_OK;
    float *layer = create_picture(p);
    p->variance = calloc(3 * (size_t)p->width, p->height * sizeof *p->variance);
    if (!layer || !p->variance) {
        free(layer);
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory: a picture of %ux%u pixels", p->width,
                       p->height);
    }
    double share = 1.0 / ((double)p->count * (double)p->count);
    rt_status status = add_variance(p, layer, reference, 1.0, error);
    for (size_t i = 0; i < p->count && status == RT_OK; i++)
        status = add_variance(p, layer, renders[i], share, error);
    free(layer);
    return status;
}

/* ---- What is measured -------------------------------------------------------- */

static int is_finite(const float rgb[3])
{
    return isfinite(rgb[0]) && isfinite(rgb[1]) && isfinite(rgb[2]);
}

/*
 * Errors and means over all pixels that are finite in both pictures; keeps the difference of each.
 */
static void measure_pixels(rt_comparison *c, const rt_pictures *p)
{
    rt_comparison_info *info = &c->info;
    double squares = 0.0, relative = 0.0, sum[3] = {0}, reference_sum[3] = {0};
    size_t pixel_count = (size_t)p->width * p->height, used = 0;
    for (size_t i = 0; i < pixel_count; i++) {
        const float *a = p->mean + 3 * i, *b = p->reference + 3 * i;
        int counts = is_finite(a) && is_finite(b);
        info->not_finite[0] += !is_finite(a);
        info->not_finite[1] += !is_finite(b);
        used += (size_t)counts;
        for (int k = 0; k < 3; k++) {
            double d = (double)a[k] - b[k];
            c->difference[3 * i + (size_t)k] = (float)d;
            if (!counts)
                continue;
            squares += d * d;
            relative += d * d / ((double)b[k] * b[k] + RELATIVE_FLOOR);
            sum[k] += a[k];
            reference_sum[k] += b[k];
        }
    }
    info->mse = squares / (3.0 * (double)used);
    info->rmse = sqrt(info->mse);
    info->relmse = relative / (3.0 * (double)used);
    for (int k = 0; k < 3; k++)
        info->ratio_rgb[k] = reference_sum[k] == 0.0 ? NAN : sum[k] / reference_sum[k];
    double total = reference_sum[0] + reference_sum[1] + reference_sum[2];
    info->ratio = total == 0.0 ? NAN : (sum[0] + sum[1] + sum[2]) / total;
}

/* Counts the blocks that are off and finds the worst. */
static void judge_blocks(rt_comparison *c)
{
    rt_comparison_info *info = &c->info;
    for (size_t i = 0; i < info->blocks; i++) {
        const double *excess = c->blocks[i].excess;
        info->off += excess[0] > 1.0 || excess[1] > 1.0 || excess[2] > 1.0;
        for (uint32_t k = 0; k < 3; k++)
            if (excess[k] > c->blocks[info->worst].excess[info->worst_channel]) {
                info->worst = i;
                info->worst_channel = k;
            }
    }
}

/* The standard error of the mean ratio: blocks are independent, channels are not. */
static double ratio_error(const rt_comparison *c)
{
    double variance = 0.0, total = 0.0;
    for (size_t i = 0; i < c->info.blocks; i++) {
        const rt_image_block *b = &c->blocks[i];
        double n = (double)b->width * b->height;
        double error = b->error[0] + b->error[1] + b->error[2];
        double reference = b->reference[0] + b->reference[1] + b->reference[2];
        if (!isfinite(error) || !isfinite(reference))
            continue;
        variance += n * n * error * error;
        total += n * reference;
    }
    return total == 0.0 ? NAN : sqrt(variance) / fabs(total);
}

static rt_status measure(rt_comparison **out, const rt_pictures *p,
                         const rt_compare_options *options, rt_error *error)
{
    uint32_t side = options->block ? options->block : DEFAULT_BLOCK;
    size_t blocks = rt_block_count(p, side);
    rt_comparison *c = calloc(1, sizeof *c);
    if (c) {
        c->blocks = calloc(blocks, sizeof *c->blocks);
        c->difference = create_picture(p);
    }
    if (!c || !c->blocks || !c->difference) {
        rt_comparison_destroy(c);
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory: a comparison of %ux%u pixels",
                       p->width, p->height);
    }
    c->info.width = p->width;
    c->info.height = p->height;
    c->info.blocks = blocks;
    measure_pixels(c, p);
    rt_status status =
        rt_compare_blocks(c->blocks, p, side,
                          options->tolerance > 0.0 ? options->tolerance : DEFAULT_TOLERANCE, error);
    if (status == RT_OK)
        status = rt_typical_difference(&c->info.typical, c->difference,
                                       (size_t)p->width * p->height, error);
    if (status == RT_OK)
        status = rt_ssim(&c->info.ssim, p->mean, p->reference, p->width, p->height,
                         options->exposure, error);
    if (status == RT_OK)
        status = rt_flip(&c->info.flip, p->mean, p->reference, p->width, p->height,
                         options->exposure, error);
    if (status == RT_OK) {
        judge_blocks(c);
        c->info.ratio_error = ratio_error(c);
        *out = c;
    } else {
        rt_comparison_destroy(c);
    }
    return status;
}

/* ---- The interface ----------------------------------------------------------- */

/* Whether an image says that it was made in photon mode. */
static int is_of_photons(const rt_image *image)
{
    const char *mode = rt_image_attribute_value(image, "librt.mode");
    return mode && strcmp(mode, rt_mode_name(RT_MODE_PHOTON)) == 0;
}

rt_status rt_image_compare(rt_comparison **out, const rt_image *const *renders, size_t count,
                           const rt_image *reference, const rt_compare_options *options,
                           rt_error *error)
{
    static const rt_compare_options defaults;
    for (size_t i = 0; i < count; i++)
        if (rt_is_missing(renders[i], "image", error))
            return RT_ERROR_USAGE;
    if (rt_is_missing(reference, "reference", error))
        return RT_ERROR_USAGE;
    if (!options)
        options = &defaults;
    rt_status status = check_options(options, error);
    if (status == RT_OK)
        status = check_sizes(renders, count, reference, options, error);
    if (status != RT_OK)
        return status;
    rt_pictures pictures = {.width = reference->width, .height = reference->height, .count = count};
    status = read_pictures(&pictures, renders, reference, options, error);
    /* The variance is that of the picture, not of a layer beside it. */
    if (status == RT_OK && !options->layer)
        status = read_variance(&pictures, renders, reference, error);
    if (status == RT_OK)
        status = measure(out, &pictures, options, error);
    if (status == RT_OK && !options->layer) {
        (*out)->info.shares_photons[0] = count == 1 && is_of_photons(renders[0]);
        (*out)->info.shares_photons[1] = is_of_photons(reference);
    }
    free_pictures(&pictures);
    return status;
}

void rt_comparison_destroy(rt_comparison *comparison)
{
    if (!comparison)
        return;
    free(comparison->blocks);
    free(comparison->difference);
    free(comparison);
}

void rt_comparison_get_info(const rt_comparison *comparison, rt_comparison_info *out)
{
    *out = comparison->info;
}

const rt_image_block *rt_comparison_blocks(const rt_comparison *comparison, size_t *count)
{
    *count = comparison->info.blocks;
    return comparison->blocks;
}
