/* light.c - adding lights that are no shapes to a scene. */
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/file.h"
#include "image/image_file.h"
#include "image/srgb.h"
#include "scene/check.h"
#include "scene/environment.h"
#include "scene/scene.h"

static const double pi = 3.14159265358979323846;

/*
 * The edge of a spot is at least so wide in the cosine, for what is sharper has no slope in
 * float32.
 */
static const float edge_min = 1e-5f;

static rt_status add_light(rt_scene *scene, const rt_scene_light *light, rt_error *error)
{
    rt_status status = rt_grow((void **)&scene->lights, &scene->light_room, scene->light_count,
                               sizeof *light, error);
    if (status == RT_OK)
        scene->lights[scene->light_count++] = *light;
    return status;
}

rt_status rt_scene_add_point_light(rt_scene *scene, const rt_point_light *light, rt_error *error)
{
    rt_scene_light l = {.kind = RT_LIGHT_POINT};
    rt_status status;

    if ((status = rt_check_point(light->position, "point light", "position", error)) != RT_OK ||
        (status = rt_check_colour(light->intensity, "point light", "intensity", error)) != RT_OK ||
        (status = rt_check_colour(light->power, "point light", "power", error)) != RT_OK)
        return status;
    int has_power = !rt_is_black(light->power);
    if (has_power && !rt_is_black(light->intensity))
        return rt_fail_field(error, RT_ERROR_INPUT, "power",
                             "point light: give intensity or power, not both");
    memcpy(l.position, light->position, sizeof l.position);
    for (int c = 0; c < 3; c++)
        l.emission[c] = has_power ? (float)(light->power[c] / (4 * pi)) : light->intensity[c];
    return add_light(scene, &l, error);
}

/* The unit vector of v; 0 when it has no length. */
static int normalise(float out[3], const double v[3])
{
    double length = rt_vec_length(v);
    for (int i = 0; i < 3; i++)
        out[i] = (float)(v[i] / length);
    return length > 0;
}

rt_status rt_scene_add_spot_light(rt_scene *scene, const rt_spot_light *light, rt_error *error)
{
    rt_scene_light l = {.kind = RT_LIGHT_SPOT};
    double axis[3];
    rt_status status;

    if ((status = rt_check_point(light->position, "spot light", "position", error)) != RT_OK ||
        (status = rt_check_point(light->target, "spot light", "target", error)) != RT_OK ||
        (status = rt_check_colour(light->intensity, "spot light", "intensity", error)) != RT_OK)
        return status;
    float outer = light->outer == 0 ? 30 : light->outer;
    if (!(outer > 0 && outer <= 180))
        return rt_fail_field(error, RT_ERROR_INPUT, "outer",
                             "spot light: outer is %g degrees; it must lie from 0 to 180", outer);
    if (!(light->inner >= 0 && light->inner <= outer))
        return rt_fail_field(error, RT_ERROR_INPUT, "inner",
                             "spot light: inner is %g degrees; it must lie from 0 to outer, %g",
                             light->inner, outer);
    rt_vec_sub(axis, light->target, light->position);
    if (!normalise(l.direction, axis))
        return rt_fail_field(error, RT_ERROR_INPUT, "target",
                             "spot light: position and target are the same point");
    l.outer = (float)cos(outer * pi / 180);
    l.inner = (float)cos(light->inner * pi / 180);
    if (l.outer > 1 - edge_min)
        l.outer = 1 - edge_min;
    if (l.inner < l.outer + edge_min)
        l.inner = l.outer + edge_min;
    memcpy(l.position, light->position, sizeof l.position);
    memcpy(l.emission, light->intensity, sizeof l.emission);
    return add_light(scene, &l, error);
}

rt_status rt_scene_add_directional_light(rt_scene *scene, const rt_directional_light *light,
                                         rt_error *error)
{
    static const float zero[3];
    rt_scene_light l = {.kind = RT_LIGHT_DIRECTIONAL};
    double direction[3];
    rt_status status;

    if ((status = rt_check_point(light->direction, "directional light", "direction", error)) !=
            RT_OK ||
        (status = rt_check_colour(light->irradiance, "directional light", "irradiance", error)) !=
            RT_OK)
        return status;
    rt_vec_sub(direction, light->direction, zero);
    if (!normalise(l.direction, direction))
        return rt_fail_field(error, RT_ERROR_INPUT, "direction",
                             "directional light: direction is zero");
    memcpy(l.emission, light->irradiance, sizeof l.emission);
    return add_light(scene, &l, error);
}

/* Copies the image's colours, decoded. */
static rt_status copy_texels(rt_scene_environment *out, const rt_image *image, const char *path,
                             rt_error *error)
{
    uint32_t channels[3];
    size_t count = (size_t)image->width * image->height;
    if (rt_image_rgb_channels(channels, image, NULL) != RT_OK) {
        uint32_t grey = image->channel_count == 1 ? 0 : rt_image_channel(image, "Y");
        if (grey == RT_IMAGE_NO_CHANNEL)
            return rt_fail(error, RT_ERROR_INPUT,
                           "environment: %.350s has neither the channels R, G and B nor Y", path);
        channels[0] = channels[1] = channels[2] = grey;
    }
    out->texels = calloc(count, 4 * sizeof *out->texels);
    if (!out->texels)
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory for an environment of %zu pixels",
                       count);
    for (size_t i = 0; i < count; i++)
        for (int c = 0; c < 3; c++) {
            float value = image->data[i * image->channel_count + channels[c]];
            if (!(value >= 0 && value <= 1e30f))
                return rt_fail(error, RT_ERROR_INPUT,
                               "environment: %.300s has the value %g at pixel (%zu, %zu)", path,
                               value, i % image->width, i / image->width);
            out->texels[4 * i + (size_t)c] = image->is_srgb ? (float)rt_srgb_decode(value) : value;
        }
    out->width = image->width;
    out->height = image->height;
    return RT_OK;
}

static rt_status read_environment(rt_scene_environment *out, const char *path, rt_error *error)
{
    rt_image *image = NULL;
    rt_status status = rt_file_check_regular(path, error);
    if (status == RT_OK)
        status = rt_image_read(&image, path, error);
    if (status == RT_OK)
        status = copy_texels(out, image, path, error);
    if (status == RT_OK)
        rt_environment_mean(out->mean, out->texels, out->width, out->height);
    else if (error)
        snprintf(error->field, sizeof error->field, "path");
    rt_image_destroy(image);
    return rt_at_file(status, path, error);
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
        return rt_fail_field(error, RT_ERROR_INPUT, "rotation",
                             "environment: rotation is %g degrees", environment->rotation);
    memcpy(l.emission, environment->radiance, sizeof l.emission);
    if (environment->path) {
        status = read_environment(&made, environment->path, error);
        if (rt_is_black(l.emission))
            l.emission[0] = l.emission[1] = l.emission[2] = 1;
    }
    made.turn = (float)(environment->rotation / 360.0 - floor(environment->rotation / 360.0));
    made.light = (rt_u32)scene->light_count;
    if (status == RT_OK)
        status = add_light(scene, &l, error);
    if (status == RT_OK)
        scene->environment = made;
    else
        free(made.texels);
    return status;
}
