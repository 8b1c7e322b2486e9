/*
 * environment.c - the environment of a scene: its image, the mean of that, and the distribution by
 * which it is sampled.
 */
#include "scene/environment.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/error.h"
#include "scene/check.h"
#include "scene/light_image.h"
#include "scene/scene.h"
#include "scene/transform.h"

static const double pi = 3.14159265358979323846;

/* ---- Mean and distribution ------------------------------------------------- */

/* Sine of the polar angle in the middle of a row. */
static double row_sine(uint32_t row, uint32_t height)
{
    return sin(pi * (row + 0.5) / height);
}

void rt_environment_mean(float mean[3], const float *texels, uint32_t width, uint32_t height)
{
    double sum[3] = {0, 0, 0}, weights = 0;
    for (uint32_t y = 0; y < height; y++) {
        double sine = row_sine(y, height);
        const float *texel = texels + 4 * (size_t)y * width;
        weights += sine * width;
        for (uint32_t x = 0; x < width; x++, texel += 4)
            for (int c = 0; c < 3; c++)
                sum[c] += sine * texel[c];
    }
    for (int c = 0; c < 3; c++)
        mean[c] = (float)(sum[c] / weights);
}

void rt_cumulative_normalise(float *cdf, uint32_t count, double total)
{
    for (uint32_t i = 0; i <= count; i++)
        cdf[i] = total > 0 ? (float)(cdf[i] / total) : (float)i / (float)count;
    cdf[count] = 1;
    /* Rounding up to 1 must not reach back beyond the last value that can be chosen. */
    for (uint32_t i = count; i-- > 0 && cdf[i] > 1;)
        cdf[i] = 1;
}

double rt_environment_tabulate(float *conditional, float *marginal, const float *texels,
                               uint32_t width, uint32_t height, double floor)
{
    double total = 0;
    marginal[0] = 0;
    for (uint32_t y = 0; y < height; y++) {
        float *row = conditional + (size_t)y * (width + 1);
        const float *texel = texels + 4 * (size_t)y * width;
        double sum = 0;
        row[0] = 0;
        for (uint32_t x = 0; x < width; x++, texel += 4) {
            sum += fmax(((double)texel[0] + texel[1] + texel[2]) / 3 - floor, 0);
            row[x + 1] = (float)sum;
        }
        rt_cumulative_normalise(row, width, sum);
        total += sum * row_sine(y, height) / width;
        marginal[y + 1] = (float)total;
    }
    rt_cumulative_normalise(marginal, height, total);
    return total / height;
}

/* ---- The image ------------------------------------------------------------- */

static rt_status read_environment(rt_scene_environment *out, const rt_environment *from,
                                  rt_memory *memory, rt_error *error)
{
    rt_light_image image;
    const rt_status status =
        rt_light_image_read(&image, from->path, from->layer, "environment", memory, error);
    if (status != RT_OK)
        return status;
    out->texels = image.texels;
    out->width = image.width;
    out->height = image.height;
    rt_environment_mean(out->mean, out->texels, out->width, out->height);
    return RT_OK;
}

/* The axes of the image, by its transform. */
static rt_status set_axes(rt_scene_environment *out, const rt_environment *from, rt_error *error)
{
    const rt_affine a = rt_affine_exact(&from->transform);
    double axes[3][3];
    for (int i = 0; i < 12; i++)
        if (!(fabs(a.m[i / 4][i % 4]) <= FLT_MAX))
            return rt_fail_field(error, RT_ERROR_INPUT, "transform",
                                 "environment: the transform has the entry %g", a.m[i / 4][i % 4]);
    if (a.m[0][3] != 0 || a.m[1][3] != 0 || a.m[2][3] != 0)
        return rt_fail_field(error, RT_ERROR_INPUT, "transform",
                             "environment: it is infinitely far, and the transform moves it by "
                             "(%g, %g, %g)",
                             a.m[0][3], a.m[1][3], a.m[2][3]);
    if (!rt_affine_rotation(axes, &a))
        return rt_fail_field(error, RT_ERROR_INPUT, "transform",
                             "environment: the transform must be a rotation, a mirroring or both, "
                             "with one scale for all axes");
    for (int i = 0; i < 9; i++) {
        out->axes[i / 3][i % 3] = (float)axes[i / 3][i % 3];
        if (out->width > 0 && out->axes[i / 3][i % 3] != (i % 4 == 0))
            out->is_turned = 1;
    }
    return RT_OK;
}

rt_status rt_scene_set_environment(rt_scene *scene, const rt_environment *environment,
                                   rt_error *error)
{
    rt_scene_light l = {.kind = RT_LIGHT_ENVIRONMENT};
    rt_scene_environment made = {.mean = {1, 1, 1}};
    rt_status status = rt_check_colour(environment->radiance, "environment", "radiance", error);
    if (status != RT_OK)
        return status;
    if (scene->environment.light != RT_NONE)
        return rt_fail(error, RT_ERROR_INPUT, "environment: a scene has only one");
    if (!(fabsf(environment->rotation) <= 1e6f))
        return rt_fail_field(
            error, RT_ERROR_INPUT, "rotation",
            "environment: rotation is %g degrees; it must lie between -1e6 and 1e6",
            environment->rotation);
    if (environment->layer && !environment->path)
        return rt_fail_field(error, RT_ERROR_INPUT, "layer",
                             "environment: a layer is one of an image: name its file");
    memcpy(l.emission, environment->radiance, sizeof l.emission);
    if (environment->path) {
        status = read_environment(&made, environment, scene->memory, error);
        if (rt_is_black(l.emission))
            l.emission[0] = l.emission[1] = l.emission[2] = 1;
    }
    if (status == RT_OK)
        status = set_axes(&made, environment, error);
    made.turn = (float)(environment->rotation / 360.0 - floor(environment->rotation / 360.0));
    made.light = (rt_u32)scene->light_count;
    if (status == RT_OK)
        status = rt_scene_take_light(scene, &l, error);
    if (status == RT_OK)
        scene->environment = made;
    else
        rt_memory_free(made.texels);
    return status;
}
