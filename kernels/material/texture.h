/*
 * texture.h - the colour of a texture at a point of a surface, and its slope for bump mapping.
 *
 * v points up: (u, v) = (0, 0) is the lower left corner of an image, (1, 1) the upper right one.
 * Texel (i, j), counted from that corner, has its centre at ((i + 1/2) / width, (j + 1/2) /
 * height); between centres the value is bilinear in linear light, or that of the nearest one.
 * Whatever u and v are, infinite and NaN too, no read leaves the image.
 *
 * Textures inside of another lie in rows that types.h describes, and so do those that ask for
 * attributes of meshes. All else has one row, and does not know of them.
 */
#ifndef RT_KERNELS_MATERIAL_TEXTURE_H
#define RT_KERNELS_MATERIAL_TEXTURE_H

#include "math/frame.h"
#include "math/lanes.h"
#include "scene.h"
#include "shape/surface.h"
#include "shape/triangle.h"
#include "types.h"

#define TEXTURE_CODES 256
/* step of the differences for checker and gradient, in (s, t) */
#define TEXTURE_PATTERN_STEP (1.0f / 128.0f)

/* Where a texture is looked up: u and v, and of a mesh where on which triangle that is. */
struct texture_place {
    float2 uv;
    float2 weights;
    global const rt_shape *shape;
    uint triangle;
};

static inline struct texture_place texture_place_at(global const rt_shape *shape,
                                                    const struct surface *surface)
{
    struct texture_place place;
    place.uv = (float2)(surface->u, surface->v);
    place.weights = surface->weights;
    place.shape = shape;
    place.triangle = surface->triangle;
    return place;
}

static inline struct texture_place surface_place(const struct scene *scene,
                                                 const struct surface *surface)
{
    return texture_place_at(scene->shapes + surface->shape, surface);
}

/* A coordinate brought into [0,1] as the wrap mode says; 0 for what is not a number. */
static inline float texture_fold(float x, uint wrap)
{
    float r = x;
    if (wrap == RT_WRAP_REPEAT) {
        r = x - floor(x);
    } else if (wrap == RT_WRAP_MIRROR) {
        r = x - 2.0f * floor(0.5f * x);
        r = r > 1.0f ? 2.0f - r : r;
    }
    return r >= 0.0f ? fmin(r, 1.0f) : 0.0f;
}

/* The texel for index i, which may be one outside 0 to size - 1 on either side. */
static inline int texture_index(int i, int size, uint wrap)
{
    if (wrap != RT_WRAP_REPEAT)
        return clamp(i, 0, size - 1);
    return i < 0 ? size - 1 : (i >= size ? 0 : i);
}

/* The linear colour of a texel, at its place in the image. */
static inline float3 texture_texel(global const rt_texture_data *texture, global const uchar *image,
                                   size_t place)
{
    if (texture->format == RT_TEXELS_CODE8) {
        global const float *decode = (global const float *)image;
        const uchar4 code = ((global const uchar4 *)(decode + TEXTURE_CODES))[place];
        return (float3)(decode[code.x], decode[code.y], decode[code.z]);
    }
    if (texture->format == RT_TEXELS_GREY)
        return (float3)(((global const float *)image)[place]);
    return texture->unit * vload_half4(place, (global const half *)image).xyz;
}

/* The texel that a point of the unit square lies in. */
static inline float3 texture_nearest(global const rt_texture_data *texture,
                                     global const uchar *image, float2 st)
{
    const int width = (int)texture->width, height = (int)texture->height;
    const size_t i = (size_t)min((int)(st.x * (float)width), width - 1);
    const size_t j = (size_t)min((int)(st.y * (float)height), height - 1);
    return texture_texel(texture, image, j * (size_t)width + i);
}

static inline float3 texture_image(global const rt_texture_data *texture,
                                   global const uchar *texels, float2 st)
{
    global const uchar *image = texels + (size_t)texture->texels * RT_SCENE_ROW;
    const uint wrap = texture->wrap;
    const int width = (int)texture->width, height = (int)texture->height;
    const float2 inside = (float2)(texture_fold(st.x, wrap), texture_fold(st.y, wrap));
    if (texture->filter == RT_TEXTURE_FILTER_NEAREST)
        return texture_nearest(texture, image, inside);

    /* Find the texel to the lower left and how far the point is from its centre. */
    const float x = inside.x * (float)width - 0.5f;
    const float y = inside.y * (float)height - 0.5f;
    const float left = floor(x), bottom = floor(y);

    /* Mix it with its three neighbours. */
    const size_t i0 = (size_t)texture_index((int)left, width, wrap);
    const size_t i1 = (size_t)texture_index((int)left + 1, width, wrap);
    const size_t row0 = (size_t)texture_index((int)bottom, height, wrap) * (size_t)width;
    const size_t row1 = (size_t)texture_index((int)bottom + 1, height, wrap) * (size_t)width;
    const float3 below = mix(texture_texel(texture, image, row0 + i0),
                             texture_texel(texture, image, row0 + i1), x - left);
    const float3 above = mix(texture_texel(texture, image, row1 + i0),
                             texture_texel(texture, image, row1 + i1), x - left);
    return mix(below, above, y - bottom);
}

static inline float2 texture_point(global const rt_texture_data *texture, float u, float v)
{
    return (float2)(texture->scale[0] * u + (texture->shear[0] * v + texture->offset[0]),
                    texture->scale[1] * v + (texture->shear[1] * u + texture->offset[1]));
}

/*
 * Whether floor(s) + floor(t) is odd: exactly one of them is, that is in the second half of a
 * period of two.
 */
static inline bool texture_is_odd(float2 st)
{
    return (texture_fold(0.5f * st.x, RT_WRAP_REPEAT) >= 0.5f) !=
           (texture_fold(0.5f * st.y, RT_WRAP_REPEAT) >= 0.5f);
}

/* The colour of a gradient or checker at (s, t), or of a constant, whose squares are alike. */
static inline float3 texture_pattern(global const rt_texture_data *texture, float2 st)
{
    const float3 a = row3(texture->a), b = row3(texture->b);
    if (texture->kind == RT_TEXTURE_GRADIENT)
        return mix(a, b, texture_fold(texture->axis ? st.y : st.x, texture->wrap));
    return texture_is_odd(st) ? b : a;
}

/* The colour of a texture of several rows, in their order. */
RARELY_CALLED float3 texture_nested(global const rt_scene_header *header,
                                    global const rt_texture_data *texture,
                                    struct texture_place place)
{
    const struct scene scene = scene_open(header);
    float3 stack[RT_TEXTURE_STACK];
    uint top = 0u; /* the first place that is free */
    float2 uv = place.uv;
    global const rt_texture_data *row = texture + texture->texels;
    global const rt_texture_data *const end = row + texture->rows;
    for (; row < end; row++) {
        if (row->kind == RT_TEXTURE_COORDINATES) {
            uv = mesh_attribute(&scene, place.shape, place.triangle, place.weights, row->texels).xy;
            continue;
        }
        const float2 st = texture_point(row, uv.x, uv.y);
        uv = place.uv;
        if (row->kind == RT_TEXTURE_MULTIPLY) {
            top--;
            stack[top - 1u] *= stack[top];
        } else if (row->kind == RT_TEXTURE_MIX) {
            top -= 2u;
            const float weight = clamp(row->a[0] * mean3(stack[top + 1u]), 0.0f, 1.0f);
            stack[top - 1u] = mix(stack[top - 1u], stack[top], weight);
        } else if (row->kind == RT_TEXTURE_SCALE) {
            stack[top - 1u] *= row3(row->a);
        } else if (row->kind == RT_TEXTURE_SKIP ||
                   (row->kind == RT_TEXTURE_CHOICE && texture_is_odd(st))) {
            row += row->rows;
        } else if (row->kind == RT_TEXTURE_ATTRIBUTE) {
            stack[top++] = fmin(
                mesh_attribute(&scene, place.shape, place.triangle, place.weights, row->texels),
                1.0f);
        } else if (row->kind != RT_TEXTURE_CHOICE) {
            stack[top++] = row->kind == RT_TEXTURE_IMAGE ? texture_image(row, scene.texels, st)
                                                         : texture_pattern(row, st);
        }
    }
    return stack[0];
}

/* The linear colour at (s, t), which of nested textures are u and v; else the same place. */
static inline float3 texture_colour(const struct scene *scene,
                                    global const rt_texture_data *texture,
                                    const struct texture_place *place, float2 st)
{
    if (texture->kind == RT_TEXTURE_IMAGE)
        return texture_image(texture, scene->texels, st);
    if (UNLIKELY(texture->kind == RT_TEXTURE_NESTED)) {
        struct texture_place at = *place;
        at.uv = st;
        return texture_nested(scene->header, texture, at);
    }
    return texture_pattern(texture, st);
}

/* The linear colour. */
static inline float3 texture_value(const struct scene *scene, global const rt_texture_data *texture,
                                   const struct texture_place *place)
{
    return texture_colour(scene, texture, place, texture_point(texture, place->uv.x, place->uv.y));
}

/*
 * A coordinate moved near the unit square, where float resolves small steps, to a point of the same
 * colour; of nested textures, which need not repeat there, the same if it is one.
 */
static inline float texture_near(global const rt_texture_data *texture, float x)
{
    if (texture->kind == RT_TEXTURE_NESTED)
        return fabs(x) <= 1e9f ? x : 0.0f;
    const int has_edge = texture->wrap == RT_WRAP_CLAMP && texture->kind != RT_TEXTURE_CHECKER;
    const float r = has_edge ? clamp(x, -1.0f, 2.0f) : x - 2.0f * floor(0.5f * x);
    return r >= -1.0f ? r : 0.0f;
}

/* The centre, near a coordinate, of the texel that it lies in, of so many in the unit. */
static inline float texture_centre(float x, float count)
{
    return (floor(x * count) + 0.5f) / count;
}

/* The step of differences along one axis; count: texels of an image, x: the coordinate. */
static inline float texture_step(global const rt_texture_data *texture, int axis, float count,
                                 float x)
{
    if (texture->kind == RT_TEXTURE_IMAGE)
        return (texture->filter == RT_TEXTURE_FILTER_NEAREST ? 1.0f : 0.5f) / count;
    if (texture->kind == RT_TEXTURE_NESTED)
        return fmax(texture->a[axis], 0x1p-20f * fabs(x));
    return TEXTURE_PATTERN_STEP;
}

/*
 * The derivatives by u and v of the height, which is the mean of the colour's channels: central
 * differences over one texel, which makes them continuous, or over 1/64 of a square of a pattern.
 * Where the nearest texel counts, a texel has one slope: from its neighbour on one side to that on
 * the other. Nested textures say their steps, the least of those inside.
 */
static inline float2 texture_slope(const struct scene *scene, global const rt_texture_data *texture,
                                   const struct texture_place *place)
{
    const int is_nearest =
        texture->kind == RT_TEXTURE_IMAGE && texture->filter == RT_TEXTURE_FILTER_NEAREST;
    const float width = (float)texture->width, height = (float)texture->height;
    const float2 point = texture_point(texture, place->uv.x, place->uv.y);
    float s = texture_near(texture, point.x), t = texture_near(texture, point.y);
    if (is_nearest) {
        s = texture_centre(s, width);
        t = texture_centre(t, height);
    }

    const float ds = texture_step(texture, 0, width, s), dt = texture_step(texture, 1, height, t);
    /* Divide by the steps as they were rounded. */
    const float left = s - ds, right = s + ds, below = t - dt, above = t + dt;
    const float along_s = mean3(texture_colour(scene, texture, place, (float2)(right, t)) -
                                texture_colour(scene, texture, place, (float2)(left, t))) /
                          (right - left);
    const float along_t = mean3(texture_colour(scene, texture, place, (float2)(s, above)) -
                                texture_colour(scene, texture, place, (float2)(s, below))) /
                          (above - below);
    /* The gradient by (u, v) is the transpose of the map's matrix times that by (s, t). */
    return (float2)(texture->scale[0] * along_s + texture->shear[1] * along_t,
                    texture->shear[0] * along_s + texture->scale[1] * along_t);
}

/* Whether a texture asks for attributes of the mesh. */
static inline bool texture_has_attributes(global const rt_texture_data *texture)
{
    return texture->kind == RT_TEXTURE_NESTED && texture->format != 0u;
}

/* The number of the first attribute that is coordinates in it, or RT_NONE. */
RARELY_CALLED uint texture_coordinates(global const rt_texture_data *texture)
{
    global const rt_texture_data *const row = texture + texture->texels;
    for (uint i = 0u; i < texture->rows; i++)
        if (row[i].kind == RT_TEXTURE_COORDINATES)
            return row[i].texels;
    return RT_NONE;
}

/*
 * The steps of differences along the two weights, by which no coordinates of the texture change by
 * more than its own steps.
 */
static inline float2 texture_weight_steps(const struct scene *scene,
                                          global const rt_texture_data *texture,
                                          global const rt_shape *shape, uint triangle)
{
    const float2 corner[3] = {(float2)(0.0f), (float2)(1.0f, 0.0f), (float2)(0.0f, 1.0f)};
    const float2 uv = mesh_uv(scene, shape, triangle, corner[0]);
    float2 along_u = fabs(mesh_uv(scene, shape, triangle, corner[1]) - uv);
    float2 along_v = fabs(mesh_uv(scene, shape, triangle, corner[2]) - uv);
    global const rt_texture_data *row = texture + texture->texels;
    for (uint i = 0u; i < texture->rows; i++, row++) {
        if (row->kind != RT_TEXTURE_COORDINATES)
            continue;
        const float2 at = mesh_attribute(scene, shape, triangle, corner[0], row->texels).xy;
        along_u = fmax(
            along_u, fabs(mesh_attribute(scene, shape, triangle, corner[1], row->texels).xy - at));
        along_v = fmax(
            along_v, fabs(mesh_attribute(scene, shape, triangle, corner[2], row->texels).xy - at));
    }
    const float2 step = vload2(0, texture->a);
    return clamp((float2)(fmin(step.x / along_u.x, step.y / along_u.y),
                          fmin(step.x / along_v.x, step.y / along_v.y)),
                 0x1p-18f, 0x1p-4f);
}

/* The derivatives of the height by the weights, of a texture that asks for attributes. */
RARELY_CALLED float2 texture_slope_by_weights(global const rt_scene_header *header,
                                              global const rt_texture_data *texture,
                                              global const rt_shape *shape, uint triangle,
                                              float2 weights)
{
    const struct scene scene = scene_open(header);
    const float2 steps = texture_weight_steps(&scene, texture, shape, triangle);
    float heights[4];
    for (uint i = 0u; i < 4u; i++) {
        const float2 step =
            (i & 1u ? 1.0f : -1.0f) * (i & 2u ? (float2)(0.0f, steps.y) : (float2)(steps.x, 0.0f));
        struct texture_place place;
        place.weights = weights + step;
        place.uv = mesh_uv(&scene, shape, triangle, place.weights);
        place.shape = shape;
        place.triangle = triangle;
        heights[i] = mean3(texture_nested(header, texture, place));
    }
    return (float2)(heights[1] - heights[0], heights[3] - heights[2]) / (2.0f * steps);
}

/*
 * A direction on the picture along s and t, as one along u and v: turned back by the rotation of
 * the map. Scale and shear leave directions as they are.
 */
static inline float2 texture_direction(global const rt_texture_data *texture, float2 st)
{
    const float2 turn = vload2(0, texture->turn);
    return (float2)(turn.x * st.x + turn.y * st.y, turn.x * st.y - turn.y * st.x);
}

#endif
