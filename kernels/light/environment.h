/*
 * environment.h - the environment: light from infinitely far in every direction.
 *
 * Its image covers the unit square: u is the longitude, 1/2 towards -z and 3/4 towards +x, v the
 * polar angle from 0 at +y to 1 at -y. Between the centres of pixels the radiance is bilinear;
 * beyond the edges u wraps around, and v is clamped to the outermost row. These axes are those of
 * the image, and directions named w_local are along them: a rotation, which may mirror, takes them
 * to the world, and as it keeps solid angles, to densities it is nothing.
 *
 * The sampled density is bilinear as well, between values in proportion to radiance and the sine of
 * the polar angle. Bilinear interpolation is a sum of tents, one a pixel: a pixel is chosen from
 * the tables and a point of its tent taken, so that the density of a point is exactly the
 * interpolation of the pixels' probabilities. Where the radiance is not 0, neither is the density,
 * unless MIS compensation leaves the direction to BSDF sampling (scene.h).
 * A tent that reaches over a pole is folded back, which is what clamping amounts to.
 */
#ifndef RT_KERNELS_LIGHT_ENVIRONMENT_H
#define RT_KERNELS_LIGHT_ENVIRONMENT_H

#include "math/frame.h"
#include "math/lanes.h"
#include "sample/sample.h"
#include "scene.h"
#include "types.h"

/* ---- Between directions and the unit square -------------------------------- */

static inline struct frame environment_axes(global const rt_light_data *light)
{
    struct frame axes;
    axes.s = row3(light->a);
    axes.t = row3(light->b);
    axes.n = row3(light->c);
    return axes;
}

static inline float3 environment_to_local(const struct scene *scene, float3 w)
{
    global const rt_light_data *light = scene->lights + scene->environment->light;
    return light->flags & RT_LIGHT_TURNED ? frame_to_local(environment_axes(light), w) : w;
}

static inline float3 environment_to_world(const struct scene *scene, float3 w_local)
{
    global const rt_light_data *light = scene->lights + scene->environment->light;
    return light->flags & RT_LIGHT_TURNED ? frame_to_world(environment_axes(light), w_local)
                                          : w_local;
}

static inline float2 environment_point(const struct scene *scene, float3 w_local)
{
    const float u =
        0.5f + atan2(w_local.x, -w_local.z) * (0.5f * M_1_PI_F) + scene->environment->turn;
    return (float2)(u - floor(u), acos(clamp(w_local.y, -1.0f, 1.0f)) * M_1_PI_F);
}

static inline float3 environment_direction(const struct scene *scene, float2 point)
{
    const float turn = point.x - 0.5f - scene->environment->turn;
    const float2 longitude = sin_cos(2.0f * RT_PI * (turn - floor(turn)));
    const float2 polar = sin_cos(RT_PI * point.y);
    return (float3)(polar.x * longitude.x, polar.y, -polar.x * longitude.y);
}

/* ---- The image and its tables ---------------------------------------------- */

static inline global const float *environment_table(const struct scene *scene, uint row)
{
    return (global const float *)((global const uchar *)scene->header + (size_t)row * RT_SCENE_ROW);
}

/* Four neighbouring pixels and where a point lies between their centres. */
struct environment_cell {
    uint left, right, above, below;
    float2 weight; /* of right and below */
};

static inline struct environment_cell environment_cell_at(const struct scene *scene, float2 point)
{
    global const rt_environment_data *sky = scene->environment;
    const int width = (int)sky->width, height = (int)sky->height;
    const float2 place = point * (float2)(width, height) - 0.5f;
    const float2 corner = floor(place);
    const int i = (int)corner.x, j = (int)corner.y;
    struct environment_cell cell;
    cell.left = (uint)(i < 0 ? width - 1 : min(i, width - 1));
    cell.right = (uint)(i + 1 < width ? i + 1 : 0);
    cell.above = (uint)clamp(j, 0, height - 1);
    cell.below = (uint)clamp(j + 1, 0, height - 1);
    cell.weight = place - corner;
    return cell;
}

static inline float3 environment_radiance_at(const struct scene *scene, float2 point)
{
    global const rt_environment_data *sky = scene->environment;
    global const float4 *texels = (global const float4 *)environment_table(scene, sky->texels);
    const struct environment_cell cell = environment_cell_at(scene, point);
    global const float4 *above = texels + (size_t)cell.above * sky->width;
    global const float4 *below = texels + (size_t)cell.below * sky->width;
    return mix(mix(above[cell.left], above[cell.right], cell.weight.x),
               mix(below[cell.left], below[cell.right], cell.weight.x), cell.weight.y)
        .xyz;
}

/*
 * The probability with which a row, and in it the pixels `cell.left` and `cell.right` mixed, are
 * chosen.
 */
static inline float environment_row_share(const struct scene *scene,
                                          const struct environment_cell *cell, uint row)
{
    global const rt_environment_data *sky = scene->environment;
    global const float *marginal = environment_table(scene, sky->marginal) + row;
    global const float *conditional =
        environment_table(scene, sky->conditional) + (size_t)row * (sky->width + 1u);
    const float left = conditional[cell->left + 1u] - conditional[cell->left];
    const float right = conditional[cell->right + 1u] - conditional[cell->right];
    return (marginal[1] - marginal[0]) * mix(left, right, cell->weight.x);
}

/* Density over the unit square. */
static inline float environment_pdf_uv(const struct scene *scene, float2 point)
{
    global const rt_environment_data *sky = scene->environment;
    const struct environment_cell cell = environment_cell_at(scene, point);
    const float share = mix(environment_row_share(scene, &cell, cell.above),
                            environment_row_share(scene, &cell, cell.below), cell.weight.y);
    return share * (float)sky->width * (float)sky->height;
}

static inline float2 sample_environment_point(const struct scene *scene, float2 u)
{
    global const rt_environment_data *sky = scene->environment;
    float rest_x, rest_y;
    const uint row =
        find_interval(environment_table(scene, sky->marginal), sky->height, u.y, &rest_y);
    global const float *conditional =
        environment_table(scene, sky->conditional) + (size_t)row * (sky->width + 1u);
    const uint column = find_interval(conditional, sky->width, u.x, &rest_x);
    const float2 off = sample_tent((float2)(rest_x, rest_y));
    const float2 point = ((float2)(column, row) + 0.5f + off) / (float2)(sky->width, sky->height);
    return (float2)(point.x - floor(point.x), 1.0f - fabs(1.0f - fabs(point.y)));
}

/* ---- As a light -------------------------------------------------------------- */

static inline bool has_environment(const struct scene *scene)
{
    return scene->environment->light != RT_NONE;
}

/* The radiance that comes from direction w. */
static inline float3 environment_radiance(const struct scene *scene, float3 w)
{
    const float3 emission = row3(scene->lights[scene->environment->light].emission);
    return scene->environment->width
               ? emission * environment_radiance_at(
                                scene, environment_point(scene, environment_to_local(scene, w)))
               : emission;
}

/*
 * The density of w by sample_environment. An area du dv of the image is 2 pi^2 sin(pi v) du dv of
 * solid angle.
 */
static inline float environment_pdf_w(const struct scene *scene, float3 w)
{
    if (!scene->environment->width)
        return sphere_pdf_w();
    const float3 w_local = environment_to_local(scene, w);
    return environment_pdf_uv(scene, environment_point(scene, w_local)) /
           (2.0f * RT_PI * RT_PI * sqrt(w_local.x * w_local.x + w_local.z * w_local.z));
}

/*
 * Samples a direction, in proportion to radiance: writes what comes from there, returns 1 / pdf_w;
 * 0: rounding made it a direction that is never sampled.
 */
static inline float sample_environment(const struct scene *scene, float2 u, float3 *w,
                                       float3 *radiance)
{
    const float3 emission = row3(scene->lights[scene->environment->light].emission);
    if (!scene->environment->width) {
        *w = sample_sphere(u);
        *radiance = emission;
        return 1.0f / sphere_pdf_w();
    }
    const float2 point = sample_environment_point(scene, u);
    const float3 w_local = environment_direction(scene, point);
    *w = environment_to_world(scene, w_local);
    *radiance = emission * environment_radiance_at(scene, point);
    const float pdf_uv = environment_pdf_uv(scene, point);
    const float sine = sqrt(w_local.x * w_local.x + w_local.z * w_local.z);
    return pdf_uv > 0.0f ? 2.0f * RT_PI * RT_PI * sine / pdf_uv : 0.0f;
}

#endif
