/* emit_pdf.h - the densities with which light_emit starts light paths, the choice of the light left
 * out. */
#ifndef RT_KERNELS_LIGHT_EMIT_PDF_H
#define RT_KERNELS_LIGHT_EMIT_PDF_H

#include "light/emit.h"

/* Over points, 1/m^2, and directions of this cosine to the normal, 1/sr, of an area light. */
static inline float emit_area_pdf(const struct scene *scene, global const rt_light_data *light,
                                  const struct surface *at, float cosine)
{
    const float pdf_a = light->kind == RT_LIGHT_SHAPE ? shape_pdf_a(scene, at) : 1.0f / light->area;
    if (light->flags & RT_LIGHT_TWO_SIDED)
        return 0.5f * pdf_a * fabs(cosine) / RT_PI;
    return cosine > 0.0f ? pdf_a * cosine / RT_PI : 0.0f;
}

/* Of the direction w in which a light at a point emits, 1/sr. */
static inline float emit_point_pdf_w(const struct scene *scene, global const rt_light_data *light,
                                     float3 w)
{
    if (light_has_table(light))
        return table_pdf_w(scene, light, w);
    return light->kind == RT_LIGHT_SPOT
               ? spot_falloff(light, dot(w, row3(light->b))) / spot_solid_angle(light)
               : sphere_pdf_w();
}

/*
 * Of a ray of light of one direction, directional or a beam that the point lies in, over area that
 * faces it; of the environment: emit_distant_pdf_a.
 */
static inline float emit_parallel_pdf_a(const struct scene *scene,
                                        global const rt_light_data *light, float3 through, float3 w)
{
    return light->kind == RT_LIGHT_BEAM ? 1.0f / light->area
                                        : emit_distant_pdf_a(scene, through, w);
}

#endif
