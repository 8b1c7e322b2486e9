/*
 * material.h - evaluates a material at one point of a shape: its colours times textures and vertex
 * colours, the shading normal with its bumps, and the direction of anisotropic facets about it.
 */
#ifndef RT_KERNELS_MATERIAL_MATERIAL_H
#define RT_KERNELS_MATERIAL_MATERIAL_H

#include "material/bump.h"
#include "scene.h"
#include "shape/shapes.h"
#include "material/texture.h"

/* The BSDF parameters of a surface: the inputs of its material, evaluated. */
#define COLOUR_PARAMETER(name) float3 name;
#define NUMBER_PARAMETER(name) float name;
#define PARAMETER(TYPE, name, RANGE, NEED, unit, help) TYPE##_PARAMETER(name)
struct bsdf_params {
    RT_SURFACE_INPUTS(PARAMETER)
    float3 shading;                    /* unit normal, on the side of the geometric one */
    float3 tangent;                    /* of anisotropic facets, as facet_tangent has it; else 0 */
    struct principled_numbers numbers; /* only where the material is principled */
};

/* The values of the inputs, without textures. */
#define COLOUR_VALUE(name) params->name = row3(material->name);
#define NUMBER_VALUE(name) params->name = material->name;
#define VALUE(TYPE, name, RANGE, NEED, unit, help) TYPE##_VALUE(name)
#define PRINCIPLED_VALUE(TYPE, name, RANGE, NEED, unit, help) params->numbers.name = material->name;
static inline void untextured_params(struct bsdf_params *params,
                                     global const rt_material_data *material, float3 shading)
{
    RT_SURFACE_INPUTS(VALUE)
    params->shading = shading;
    params->tangent = (float3)(0.0f);
    if (is_principled(material)) {
        RT_PRINCIPLED_NUMBERS(PRINCIPLED_VALUE)
    }
}

/* A colour times a texture, if there is one; never below 0. */
static inline float3 textured(const struct scene *scene, const struct surface *surface,
                              float3 colour, uint texture)
{
    if (texture == RT_NONE)
        return colour;
    const struct texture_place place = surface_place(scene, surface);
    return colour * fmax(texture_value(scene, scene->textures + texture, &place), 0.0f);
}

/* A number from 0 to most likewise, by the mean of the texture's channels. */
static inline float textured_number(const struct scene *scene, const struct surface *surface,
                                    float number, float most, uint texture)
{
    return texture == RT_NONE
               ? number
               : fmin(mean3(textured(scene, surface, (float3)(number), texture)), most);
}

/* The numbers of a principled material likewise. */
#define PRINCIPLED_TEXTURE(TYPE, name, RANGE, NEED, unit, help)                                    \
    numbers.name = textured_number(&scene, &at, material->name, (float)RT_MOST_##RANGE,            \
                                   material->name##_texture);
RARELY_CALLED struct principled_numbers textured_numbers(global const rt_scene_header *header,
                                                         global const rt_material_data *material,
                                                         float2 uv, float2 weights, uint shape,
                                                         uint triangle)
{
    const struct scene scene = scene_open(header);
    struct principled_numbers numbers;
    struct surface at;
    at.u = uv.x;
    at.v = uv.y;
    at.weights = weights;
    at.shape = shape;
    at.triangle = triangle;
    RT_PRINCIPLED_NUMBERS(PRINCIPLED_TEXTURE)
    return numbers;
}

/*
 * Applies textures and vertex colours; where more would be scattered than arrives, all lobes are
 * scaled down alike.
 */
#define COLOUR_TEXTURE(name)                                                                       \
    params->name = textured(scene, surface, params->name, material->name##_texture);
#define NUMBER_TEXTURE(name)                                                                       \
    params->name = textured_number(scene, surface, params->name, 1.0f, material->name##_texture);
#define TEXTURE(TYPE, name, RANGE, NEED, unit, help) TYPE##_TEXTURE(name)
CALLED_ON_CPUS void apply_textures(struct bsdf_params *params, const struct scene *scene,
                                   global const rt_material_data *material,
                                   const struct surface *surface)
{
    RT_SURFACE_INPUTS(TEXTURE)
    params->kd = textured(scene, surface, params->kd, scene->shapes[surface->shape].texture);
    params->kd *= vertex_colour(scene, surface);
    if (is_principled(material))
        params->numbers =
            textured_numbers(scene->header, material, (float2)(surface->u, surface->v),
                             surface->weights, surface->shape, surface->triangle);
    const float most =
        largest3(params->kd + params->ks + params->kt + params->diffuse_transmission);
    if (most > 1.0f && !is_principled(material)) {
        const float scale = 1.0f / most;
        params->kd *= scale;
        params->ks *= scale;
        params->kt *= scale;
        params->diffuse_transmission *= scale;
    }
}

/* What a material would scatter of all light, but for textures. */
static inline float3 untextured_albedo(global const rt_material_data *material)
{
    if (is_principled(material))
        return (float3)(1.0f);
    return fmax(row3(material->kd), row3(material->fuzz)) + row3(material->ks) +
           row3(material->kt) + row3(material->diffuse_transmission);
}

/*
 * The direction along which anisotropic facets about this shading normal have alpha: x of tangent
 * space, turned towards y, and on by `turn` of a full turn; 0 where there is none.
 */
RARELY_CALLED float3 facet_tangent(const struct scene *scene,
                                   global const rt_material_data *material,
                                   const struct surface *surface, float3 shading, float turn)
{
    const struct tangents along = tangents_at(scene, surface);
    float3 x, y;
    if (!tangent_axes(shading, &along, &x, &y))
        return (float3)(0.0f);
    const float c = material->facet_turn[0], s = material->facet_turn[1];
    if (turn == 0.0f)
        return c * x + s * y;
    const float more_c = cospi(2.0f * turn), more_s = sinpi(2.0f * turn);
    return (c * more_c - s * more_s) * x + (c * more_s + s * more_c) * y;
}

/*
 * Directs the facets of evaluated parameters, if they have a direction. It asks with a copy of the
 * surface, so that the other can live in registers.
 */
static inline void direct_facets(struct bsdf_params *params, const struct scene *scene,
                                 global const rt_material_data *material,
                                 const struct surface *surface)
{
    if (!is_anisotropic(material))
        return;
    const struct surface at = *surface;
    params->tangent = facet_tangent(scene, material, &at, params->shading, params->anisotropy_turn);
}

/* The inputs of a material at this point; made where they are used, as surface_at makes those. */
static inline void evaluate_material(struct bsdf_params *params, const struct scene *scene,
                                     global const rt_material_data *material,
                                     const struct surface *surface)
{
    untextured_params(params, material, surface->shading);
    if (scene->shapes[surface->shape].flags & RT_SHAPE_VARIED) {
        apply_textures(params, scene, material, surface);
        params->shading = bumped_normal(scene, material, surface);
    }
    direct_facets(params, scene, material, surface);
}

#endif
