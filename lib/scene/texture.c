/* texture.c - adding textures to a scene. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/file.h"
#include "image/image_file.h"
#include "image/srgb.h"
#include "scene/check.h"
#include "scene/nested.h"
#include "scene/scene.h"
#include "texture/texture.h"

static const double pi = 3.14159265358979323846;

/*
 * Mean and largest linear value of each channel, and the least of all; the channels are there, for
 * the image was packed.
 */
static void survey(rt_scene_texture *texture, const rt_image *image, const rt_texture *from)
{
    rt_texture_reading reading;
    size_t count = (size_t)image->width * image->height;
    if (rt_texture_read_as(&reading, image, from, NULL) != RT_OK)
        return;
    texture->is_srgb = reading.is_srgb;
    for (int c = 0; c < 3; c++) {
        const float *value = image->data + reading.channels[c];
        double sum = 0;
        float largest = *value;
        for (size_t i = 0; i < count; i++, value += image->channel_count) {
            sum += rt_texture_linear(&reading, *value);
            largest = *value > largest ? *value : largest;
            if (*value < texture->least) {
                texture->least = *value;
                texture->least_at[0] = (uint32_t)(i % image->width);
                texture->least_at[1] = (uint32_t)(i / image->width);
            }
        }
        texture->mean[c] = (float)(sum / (double)count);
        texture->largest[c] = (float)rt_texture_linear(&reading, largest);
    }
}

/* Whether 2 c - 1 is a vector off the surface, of length 1 but for what filters take of it. */
static int may_be_normal(const float c[3])
{
    const double x = 2.0 * c[0] - 1, y = 2.0 * c[1] - 1, z = 2.0 * c[2] - 1;
    const double length2 = x * x + y * y + z * z;
    return z > 0 && length2 > 0.5 && length2 < 1.3;
}

/* The part of the texels, but for black ones, which may be unused, that may be normals. */
static float part_of_normals(const rt_image *image, const rt_texture *from)
{
    rt_texture_reading reading;
    size_t count = (size_t)image->width * image->height, used = 0, normals = 0;
    if (rt_texture_read_as(&reading, image, from, NULL) != RT_OK)
        return 1;
    if (reading.channels[0] == reading.channels[1])
        return 0; /* grey */
    for (size_t i = 0; i < count; i++) {
        float c[3];
        for (int k = 0; k < 3; k++)
            c[k] = (float)rt_texture_linear(
                &reading, image->data[i * image->channel_count + reading.channels[k]]);
        used += c[0] != 0 || c[1] != 0 || c[2] != 0;
        normals += may_be_normal(c);
    }
    return used > 0 ? (float)((double)normals / (double)used) : 0;
}

static char *copy_of(const char *text)
{
    char *copy = malloc(strlen(text) + 1);
    return copy ? strcpy(copy, text) : NULL;
}

static rt_status read_image(rt_scene *scene, rt_scene_texture *texture, const rt_texture *from,
                            rt_error *error)
{
    rt_image *image = NULL;
    if (!from->path)
        return rt_fail_field(error, RT_ERROR_INPUT, "path", "texture: an image needs a file");
    rt_status status = rt_file_check_regular(from->path, error);
    if (status == RT_OK)
        status = rt_image_read_in(&image, from->path, scene->memory, error);
    if (status == RT_OK)
        status = rt_texture_pack(&texture->data, &scene->texels, image, from, error);
    if (status == RT_OK)
        survey(texture, image, from);
    if (status == RT_OK)
        texture->normals = texture->is_srgb ? 1 : part_of_normals(image, from);
    if (status == RT_OK && !(texture->path = copy_of(from->path)))
        status = rt_fail(error, RT_ERROR_MEMORY, "out of memory");
    if (status != RT_OK && error && !error->field[0])
        snprintf(error->field, sizeof error->field, "path");
    rt_image_destroy(image);
    return rt_at_file(status, from->path, error);
}

rt_status rt_texture_check(const rt_scene *scene, uint32_t handle, const char *who,
                           const char *field, rt_error *error)
{
    if (handle > scene->texture_count)
        return rt_fail_field(error, RT_ERROR_INPUT, field, "%s: there is no texture %u among %zu",
                             who, handle, scene->texture_count);
    return RT_OK;
}

rt_status rt_texture_check_colours(const rt_scene *scene, uint32_t handle, const char *who,
                                   const char *field, rt_error *error)
{
    rt_status status = rt_texture_check(scene, handle, who, field, error);
    if (status != RT_OK || handle == 0)
        return status;
    const rt_scene_texture *texture = scene->textures + handle - 1;
    if (texture->least >= 0)
        return RT_OK;
    if (texture->least_of)
        texture = scene->textures + texture->least_of - 1;
    return rt_fail_field(error, RT_ERROR_INPUT, field,
                         "%s: %s, %.200s, has the value %g at pixel (%u, %u) from the top left; "
                         "only heights may be negative",
                         who, field, texture->path, texture->least, texture->least_at[0],
                         texture->least_at[1]);
}

/* By the mean of the largest of each channel; a little more is rounding. */
rt_status rt_texture_check_number(const rt_scene *scene, float number, uint32_t handle, float limit,
                                  const char *who, const char *field, rt_error *error)
{
    const float *largest = handle ? scene->textures[handle - 1].largest : NULL;
    const double most =
        handle ? (double)number * ((double)largest[0] + largest[1] + largest[2]) / 3 : 0;
    if (most <= limit * (1 + 1e-6))
        return RT_OK;
    return rt_fail_field(error, RT_ERROR_INPUT, field, "%s: %s reaches %g; it must not exceed %g",
                         who, field, most, limit);
}

/* The squares of a constant are alike. */
static rt_status make_pattern(rt_scene_texture *texture, const rt_texture *from, rt_error *error)
{
    const float *const a = from->a, *const b = from->kind == RT_TEXTURE_CONSTANT ? a : from->b;
    rt_status status = rt_check_colour(a, "texture", "a", error);
    if (status == RT_OK)
        status = rt_check_colour(b, "texture", "b", error);
    texture->data.kind = from->kind;
    texture->data.axis = 1;
    if (from->kind == RT_TEXTURE_CONSTANT)
        texture->normals = may_be_normal(a) ? 1 : 0;
    for (int c = 0; c < 3; c++) {
        texture->data.a[c] = a[c];
        texture->data.b[c] = b[c];
        texture->mean[c] = 0.5f * (a[c] + b[c]);
        texture->largest[c] = a[c] > b[c] ? a[c] : b[c];
    }
    return status;
}

/* Cosine and sine of an angle in degrees, those of right angles exactly. */
static void turn_by(double turn[2], double degrees)
{
    static const double right[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    const double rest = fmod(degrees, 360), angle = rest < 0 ? rest + 360 : rest;
    if (fmod(angle, 90) == 0) {
        memcpy(turn, right[(int)(angle / 90) % 4], sizeof right[0]);
        return;
    }
    turn[0] = cos(angle * pi / 180);
    turn[1] = sin(angle * pi / 180);
}

/* The map from (u, v) to the texture: scale and shear, then the rotation, then the offset. */
static void make_map(rt_texture_data *out, const rt_texture *from)
{
    const double scale[2] = {from->scale[0] == 0 ? 1 : from->scale[0],
                             from->scale[1] == 0 ? 1 : from->scale[1]};
    double turn[2];
    turn_by(turn, from->rotate);
    out->scale[0] = (float)(turn[0] * scale[0]);
    out->scale[1] = (float)(turn[1] * from->shear + turn[0] * scale[1]);
    out->shear[0] = (float)(turn[0] * from->shear - turn[1] * scale[1]);
    out->shear[1] = (float)(turn[1] * scale[0]);
    for (int i = 0; i < 2; i++) {
        out->turn[i] = (float)turn[i];
        out->offset[i] = from->offset[i];
    }
}

static rt_status check_map(const rt_texture *from, rt_error *error)
{
    for (int i = 0; i < 2; i++) {
        if (!(fabsf(from->scale[i]) <= 1e9f))
            return rt_fail_field(error, RT_ERROR_INPUT, "scale",
                                 "texture: scale is %g; it must lie within 1e9", from->scale[i]);
        if (!(fabsf(from->offset[i]) <= 1e9f))
            return rt_fail_field(error, RT_ERROR_INPUT, "offset",
                                 "texture: offset is %g; it must lie within 1e9", from->offset[i]);
    }
    if (!(fabsf(from->shear) <= 1e9f))
        return rt_fail_field(error, RT_ERROR_INPUT, "shear",
                             "texture: shear is %g; it must lie within 1e9", from->shear);
    if (!(fabsf(from->rotate) <= 1e9f))
        return rt_fail_field(error, RT_ERROR_INPUT, "rotate",
                             "texture: rotate is %g; it must lie within 1e9", from->rotate);
    return RT_OK;
}

/* Where on the texture a point of the surface is. */
static rt_status place(rt_texture_data *out, const rt_texture *from, rt_error *error)
{
    const rt_status status = check_map(from, error);
    if (status != RT_OK)
        return status;
    make_map(out, from);
    out->wrap = from->wrap;
    out->filter = from->filter;
    return RT_OK;
}

#define IS_KIND(constant, word, help) || kind == constant
static int is_kind(rt_texture_kind kind)
{
    return 0 RT_TEXTURE_KINDS(IS_KIND);
}

static rt_status check_words(const rt_texture *texture, rt_error *error)
{
    if (!is_kind(texture->kind))
        return rt_fail_field(error, RT_ERROR_INPUT, "kind", "texture: there is no kind %d",
                             (int)texture->kind);
    if ((unsigned)texture->wrap > RT_WRAP_CLAMP)
        return rt_fail_field(error, RT_ERROR_INPUT, "wrap", "texture: there is no wrap mode %d",
                             (int)texture->wrap);
    if ((unsigned)texture->filter > RT_TEXTURE_FILTER_NEAREST)
        return rt_fail_field(error, RT_ERROR_INPUT, "filter", "texture: there is no filter %d",
                             (int)texture->filter);
    if ((unsigned)texture->channel > RT_TEXTURE_CHANNEL_A)
        return rt_fail_field(error, RT_ERROR_INPUT, "channel", "texture: there is no channel %d",
                             (int)texture->channel);
    if (texture->power != 0 && !(texture->power >= 0.1f && texture->power <= 10))
        return rt_fail_field(error, RT_ERROR_INPUT, "power",
                             "texture: power is %g; it must lie within 0.1 to 10", texture->power);
    return RT_OK;
}

static rt_status make_texture(rt_scene *scene, rt_scene_texture *made, const rt_texture *from,
                              rt_error *error)
{
    const int is_nested = rt_texture_is_nested(from);
    rt_status status = RT_OK;
    made->levels = 1;
    if (from->name && !(made->name = copy_of(from->name)))
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory");
    if (from->kind == RT_TEXTURE_IMAGE)
        status = read_image(scene, made, from, error);
    else if (!is_nested)
        status = make_pattern(made, from, error);
    if (status == RT_OK)
        status = place(&made->data, from, error);
    if (status != RT_OK)
        return status;
    if (is_nested)
        return rt_texture_nest(scene, made, from, error);
    made->is_turned = made->data.turn[0] != 1 || made->data.turn[1] != 0;
    return RT_OK;
}

rt_status rt_scene_add_texture(rt_scene *scene, uint32_t *out, const rt_texture *texture,
                               rt_error *error)
{
    rt_scene_texture made;
    memset(&made, 0, sizeof made);
    made.normals = 1;
    rt_status status = check_words(texture, error);
    if (status == RT_OK)
        status = rt_grow(scene->memory, (void **)&scene->textures, &scene->texture_room,
                         scene->texture_count, sizeof made, "the list of textures", error);
    if (status == RT_OK)
        status = make_texture(scene, &made, texture, error);
    if (status != RT_OK) {
        free(made.path);
        free(made.name);
        return status;
    }
    if (made.data.kind == RT_TEXTURE_NESTED)
        scene->texture_row_count += made.data.rows;
    scene->textures[scene->texture_count++] = made;
    if (out)
        *out = (uint32_t)scene->texture_count;
    return RT_OK;
}
