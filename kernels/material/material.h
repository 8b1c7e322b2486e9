/*
 * material.h - evaluates a material at one point of a shape: its colours times textures and vertex
 * colours, and the shading normal with its bumps.
 */
#ifndef RT_KERNELS_MATERIAL_MATERIAL_H
#define RT_KERNELS_MATERIAL_MATERIAL_H

#include "material/bump.h"
#include "scene.h"
#include "shape/shapes.h"
#include "material/texture.h"

/* The BSDF parameters of a surface: its material, evaluated. */
struct bsdf_params {
    float3 kd, ks, kt;
    float3 shading; /* unit normal, on the side of the geometric one */
};

/* A colour times a texture, if there is one; never below 0. */
static inline float3 textured(const struct scene *scene, const struct surface *surface,
                              float3 colour, uint texture)
{
    if (texture == RT_NONE)
        return colour;
    return colour *
           fmax(texture_value(scene->textures + texture, scene->texels, surface->u, surface->v),
                0.0f);
}

/*
 * Applies textures and vertex colours; where more would be scattered than arrives, all lobes are
 * scaled down alike.
 */
static inline void apply_colours(struct bsdf_params *params, const struct scene *scene,
                                 global const rt_material_data *material,
                                 const struct surface *surface)
{
    params->kd = textured(scene, surface, params->kd, material->kd_texture);
    params->kd = textured(scene, surface, params->kd, scene->shapes[surface->shape].texture);
    params->kd *= vertex_colour(scene, surface);
    params->ks = textured(scene, surface, params->ks, material->ks_texture);
    params->kt = textured(scene, surface, params->kt, material->kt_texture);
    const float most = largest3(params->kd + params->ks + params->kt);
    if (most > 1.0f) {
        const float scale = 1.0f / most;
        params->kd *= scale;
        params->ks *= scale;
        params->kt *= scale;
    }
}

static inline struct bsdf_params evaluate_material(const struct scene *scene,
                                                   global const rt_material_data *material,
                                                   const struct surface *surface)
{
    struct bsdf_params params;
    params.kd = row3(material->kd);
    params.ks = row3(material->ks);
    params.kt = row3(material->kt);
    params.shading = surface->shading;
    if (scene->shapes[surface->shape].flags & RT_SHAPE_VARIED) {
        apply_colours(&params, scene, material, surface);
        params.shading = bumped_normal(scene, material, surface);
    }
    return params;
}

#endif
