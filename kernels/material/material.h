/*
 * material.h - a material at one point of a shape: its colours times textures and vertex colours,
 * and its bumps.
 */
#ifndef RT_KERNELS_MATERIAL_MATERIAL_H
#define RT_KERNELS_MATERIAL_MATERIAL_H

#include "material/bump.h"
#include "shape/mesh.h"
#include "scene.h"
#include "shape/surface.h"
#include "material/texture.h"

struct paint {
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
 * Applies what varies over the shape; where more would be scattered than arrives, all is scaled
 * down alike.
 */
static inline void vary_paint(struct paint *paint, const struct scene *scene,
                              global const rt_material_data *material,
                              const struct surface *surface)
{
    paint->kd = textured(scene, surface, paint->kd, material->kd_texture);
    paint->kd = textured(scene, surface, paint->kd, scene->shapes[surface->shape].texture);
    paint->kd *= vertex_colour(scene, surface);
    paint->ks = textured(scene, surface, paint->ks, material->ks_texture);
    paint->kt = textured(scene, surface, paint->kt, material->kt_texture);
    const float most = largest3(paint->kd + paint->ks + paint->kt);
    if (most > 1.0f) {
        const float scale = 1.0f / most;
        paint->kd *= scale;
        paint->ks *= scale;
        paint->kt *= scale;
    }
    paint->shading = bumped_normal(scene, material, surface);
}

static inline struct paint paint_at(const struct scene *scene,
                                    global const rt_material_data *material,
                                    const struct surface *surface)
{
    struct paint paint;
    paint.kd = row3(material->kd);
    paint.ks = row3(material->ks);
    paint.kt = row3(material->kt);
    paint.shading = surface->shading;
    if (scene->shapes[surface->shape].flags & RT_SHAPE_VARIED)
        vary_paint(&paint, scene, material, surface);
    return paint;
}

#endif
