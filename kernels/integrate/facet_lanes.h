/*
 * facet_lanes.h - vertices of a batch whose facets of GGX reflect light and do nothing else, alike
 * in all directions: eight at a time, as bsdf/ggx.h and bsdf/multiple.h have them. Outside of all
 * solids such a lobe is all there is, and the index of a metal is that of its material.
 *
 * The light that a direction carries is told by what it weighs, fr |n.wi| over its density: that of
 * a diffuse vertex is its albedo. The functions are out of line, as few batches have such vertices.
 */
#ifndef RT_KERNELS_INTEGRATE_FACET_LANES_H
#define RT_KERNELS_INTEGRATE_FACET_LANES_H

#include "bsdf/ggx.h"
#include "material/bump.h"
#include "math/width8.inc.h"
#include "math/frame.inc.h"
#include "sample/cosine.inc.h"
#include "bsdf/fresnel.inc.h"
#include "bsdf/microfacet.inc.h"
#include "bsdf/multiple.inc.h"

/* The lane that lane i reads from: itself where it holds something, else the first that does. */
static inline uint lane_or_first(uint held, uint i)
{
    return held >> i & 1u ? i : lane_first(held);
}

/* Where the lanes' vertices are; the normals are on the side that the path comes from. */
struct surface_x8 {
    struct vec3_x8 position, normal, shading;
    float8 error;
};

/* The materials of facets in the lanes of a batch. */
struct facet_materials {
    global const rt_material_data *material[8];
    float alpha[8];
    uint held; /* a bit for each lane that has one */
};

/* What is scattered on in the lanes that have a table of losses. */
struct lost_x8 {
    global const rt_facet_losses *table[8];
    global const float *losses[8]; /* of directions above the facets */
    uint8 rows;
    float8 row;    /* that of alpha, counted from 0 */
    float8 loss;   /* seen from wo; 0: none */
    float8 often;  /* how often it is sampled */
    float8 factor; /* of the losses seen from wo and wi and n.wi */
    float8 range;  /* of its density */
    struct vec3_x8 colour;
    uint held; /* a bit for each lane that has a table */
};

/* Facets as seen from wo. */
struct facets_x8 {
    struct frame_x8 frame;
    struct vec3_x8 wo; /* in it */
    struct vec3_x8 ks, eta, k;
    struct vec3_x8 reflected; /* by a smooth surface; without ks of no effect */
    float8 alpha, facing;
    int8 is_metal;
    uint held, metals; /* a bit for each lane with facets, and of these with those of metals */
    struct lost_x8 lost;
};

/* What a direction weighs, and its density; 0: no light comes from there. */
struct weighed_x8 {
    struct vec3_x8 weight;
    float8 pdf_w;
};

/* Without what is not kept. */
static inline struct weighed_x8 keep_x8(int8 kept, struct weighed_x8 weighed)
{
    const struct vec3_x8 none = {0.0f, 0.0f, 0.0f};
    const int8 is_there = kept && weighed.pdf_w > 0.0f;
    const struct weighed_x8 left = {select_x8(is_there, weighed.weight, none),
                                    is_there ? weighed.pdf_w : (float8)(0.0f)};
    return left;
}

/* ---- Facets ---------------------------------------------------------------------- */

/* What facets met with this cosine reflect. */
static inline struct vec3_x8 facet_colours_x8(const struct facets_x8 *facets, float8 cos_i)
{
    if (!facets->metals)
        return facets->ks;
    const struct vec3_x8 metal = {
        facets->ks.x * fresnel_conductor_x8(cos_i, facets->eta.x, facets->k.x),
        facets->ks.y * fresnel_conductor_x8(cos_i, facets->eta.y, facets->k.y),
        facets->ks.z * fresnel_conductor_x8(cos_i, facets->eta.z, facets->k.z)};
    return select_x8(facets->is_metal, metal, facets->ks);
}

/* As once_eval, of facets of the normals h. */
static inline struct weighed_x8 once_by_facets_x8(const struct facets_x8 *facets, struct vec3_x8 wi,
                                                  struct vec3_x8 h)
{
    const float8 cosine = dot_x8(facets->wo, h);
    const float8 hidden = ggx_hidden_x8(facets->alpha, wi);
    const int8 meets = wi.z > 0.0f && cosine > 0.0f;
    const float8 density = 0.25f * ggx_density_x8(facets->alpha, h) / facets->facing;
    struct weighed_x8 once;
    once.pdf_w = meets ? density : (float8)(0.0f);
    once.weight = scale_x8(unshadowed_x8(facets->facing, hidden, facets->wo, wi),
                           facet_colours_x8(facets, cosine));
    return once;
}

/* ---- Light that meets more than one facet ------------------------------------------ */

/* As loss_seen. */
static inline struct vec2_x8 losses_seen_x8(const struct facets_x8 *facets, struct vec3_x8 w)
{
    const float8 place = RT_LOSS_PLACE(fabs(w.z), facets->alpha);
    const float8 x = (place < 1.0f ? place : (float8)(1.0f)) * (float)(RT_LOSS_COSINES - 1u);
    return loss_between_x8(facets->lost.losses, facets->lost.rows, x, facets->lost.row);
}

/* Finds the tables of losses. */
static inline void find_lost_x8(struct facets_x8 *facets, const struct facet_materials *materials)
{
    struct lost_x8 *lost = &facets->lost;
    lost->held = 0u;
    for (uint left = materials->held; left; left &= left - 1u) {
        const uint i = lane_first(left);
        if (materials->material[i]->facet_losses == 0u)
            continue;
        lost->table[i] = losses_of(materials->material[i]);
        lost->losses[i] = (global const float *)(lost->table[i] + 1) + 1;
        lost->held |= 1u << i;
    }
    if (!lost->held)
        return;
    for (uint i = 0u; i < 8u; i++) {
        lost->table[i] = lost->table[lane_or_first(lost->held, i)];
        lost->losses[i] = lost->losses[lane_or_first(lost->held, i)];
    }
}

/* As multiple_seen and add_multiple, but for wi. */
static inline void see_lost_x8(struct facets_x8 *facets)
{
    struct lost_x8 *lost = &facets->lost;
    const float8 largest = LANES_OF(float8, lost->table, ->largest_alpha);
    const struct vec3_x8 mean = VEC3_X8_OF_ROW(lost->table, ->mean_reflectance);
    lost->rows = LANES_OF(uint8, lost->table, ->rows);
    const float8 part = facets->alpha / largest, last = convert_float8(lost->rows - 1u);
    lost->row = (part < 1.0f ? part : (float8)(1.0f)) * last;
    const struct vec2_x8 seen = losses_seen_x8(facets, facets->wo);
    const int8 is_lost = lanes_of(lost->held) && seen.y > 0.0f;
    lost->loss = is_lost ? seen.x : (float8)(0.0f);
    lost->often = often_probability_x8(lost->loss);
    lost->factor = is_lost ? lost->loss / (RT_PI * seen.y) : (float8)(0.0f);
    lost->range = LANES_OF(float8, lost->table, ->range);
    if (lane_mask(lost->range <= 0.0f))
        lost->range =
            lost->range > 0.0f ? lost->range : log(1.0f + 1.0f / (facets->alpha * facets->alpha));
    const float8 left = 1.0f - seen.y;
    const struct vec3_x8 met = mul_x8(facets->ks, mean);
    lost->colour.x = colour_of_lost_x8(met.x, left);
    lost->colour.y = colour_of_lost_x8(met.y, left);
    lost->colour.z = colour_of_lost_x8(met.z, left);
}

/* Adds what is scattered on. */
static inline struct weighed_x8 with_lost_x8(const struct facets_x8 *facets, struct vec3_x8 wi,
                                             struct weighed_x8 once)
{
    const struct lost_x8 *lost = &facets->lost;
    const struct vec2_x8 alpha = {facets->alpha, facets->alpha};
    const int8 is_lost = lost->loss > 0.0f && wi.z > 0.0f;
    const float8 density = lost->often * lost_pdf_w_x8(alpha, lost->range, wi.z);
    const float8 brightness = losses_seen_x8(facets, wi).x * lost->factor * wi.z;
    struct weighed_x8 both;
    both.pdf_w = is_lost ? (1.0f - lost->often) * once.pdf_w + density : once.pdf_w;
    const float8 inverse = both.pdf_w > 0.0f ? 1.0f / both.pdf_w : (float8)(0.0f);
    const struct vec3_x8 sum =
        along_x8(scale_x8(once.pdf_w * inverse, once.weight), brightness * inverse, lost->colour);
    both.weight = select_x8(is_lost, sum, once.weight);
    return both;
}

/* What light from wi weighs, by facets of the normals h. */
static inline struct weighed_x8 facet_weight_x8(const struct facets_x8 *facets, struct vec3_x8 wi,
                                                struct vec3_x8 h)
{
    const struct weighed_x8 once = once_by_facets_x8(facets, wi, h);
    return facets->lost.held ? with_lost_x8(facets, wi, once) : once;
}

/* ---- Seen from wo, light, and a direction ------------------------------------------- */

/*
 * Makes the facets of the lanes that hold materials, of this ks, seen from where paths of these
 * directions come from.
 */
INLINE_NEVER void see_facets(struct facets_x8 *facets, const struct facet_materials *materials,
                             const struct surface_x8 *surface, struct vec3_x8 direction,
                             struct vec3_x8 ks)
{
    global const rt_material_data *material[8];
    for (uint i = 0u; i < 8u; i++)
        material[i] = materials->material[lane_or_first(materials->held, i)];
    const struct vec3_x8 wo = scale_x8(-1.0f, direction);
    const int8 has_facets = dot_x8(wo, surface->shading) >= RT_LEAST_TILT;
    facets->frame = frame_about_x8(select_x8(has_facets, surface->shading, surface->normal));
    facets->wo = frame_to_local_x8(facets->frame, wo);
    facets->ks = ks;
    facets->alpha = vload8(0, materials->alpha);
    facets->facing = ggx_facing_x8(facets->alpha, facets->wo);
    facets->held = materials->held;
    facets->is_metal = (LANES_OF(uint8, material, ->flags) & RT_MATERIAL_CONDUCTOR) != 0u;
    facets->metals = lane_mask(facets->is_metal) & materials->held;
    if (facets->metals) {
        const struct vec3_x8 eta = VEC3_X8_OF_ROW(material, ->eta);
        const struct vec3_x8 k = VEC3_X8_OF_ROW(material, ->k);
        facets->eta = eta;
        facets->k = k;
    }
    facets->reflected = facet_colours_x8(facets, fabs(facets->wo.z));
    find_lost_x8(facets, materials);
    if (facets->lost.held)
        see_lost_x8(facets);
}

/* As ggx_eval. */
INLINE_NEVER void weigh_facets(struct weighed_x8 *weighed, const struct facets_x8 *facets,
                               const struct surface_x8 *surface, struct vec3_x8 wi)
{
    const struct vec3_x8 wi_local = frame_to_local_x8(facets->frame, wi);
    const struct vec3_x8 h = unit_x8(add_x8(facets->wo, wi_local));
    *weighed = keep_x8(wi_local.z > 0.0f && dot_x8(wi, surface->normal) > 0.0f,
                       facet_weight_x8(facets, wi_local, h));
}

/* Samples directions of light that is scattered on in the lanes of this mask, one by one. */
static inline struct vec3_x8 sample_lost_x8(const struct facets_x8 *facets, uint lanes,
                                            struct vec3_x8 wi, struct vec3_x8 u)
{
    float3 rows[8], numbers[8];
    float alphas[8], ranges[8];
    vec3_x8_rows(wi, rows);
    vec3_x8_rows(u, numbers);
    vstore8(facets->alpha, 0, alphas);
    vstore8(facets->lost.range, 0, ranges);
    for (; lanes; lanes &= lanes - 1u) {
        const uint i = lane_first(lanes);
        rows[i] = sample_lost((float2)(alphas[i]), ranges[i], numbers[i].xy);
    }
    const struct vec3_x8 sampled = VEC3_X8_OF(rows, );
    return sampled;
}

/* As ggx_sample. */
INLINE_NEVER void sample_facets(struct vec3_x8 *wi, struct weighed_x8 *weighed,
                                const struct facets_x8 *facets, const struct surface_x8 *surface,
                                struct vec3_x8 u)
{
    const struct vec2_x8 alpha = {facets->alpha, facets->alpha}, xy = {u.x, u.y};
    const struct vec3_x8 wo = facets->wo;
    struct vec3_x8 h = sample_visible_normal_x8(alpha, wo, xy);
    struct vec3_x8 wi_local = unit_x8(sub_x8(scale_x8(2.0f * dot_x8(wo, h), h), wo));
    if (facets->lost.held) {
        const uint lost = lane_mask(u.z < facets->lost.often) & facets->lost.held;
        if (lost) {
            wi_local = sample_lost_x8(facets, lost, wi_local, u);
            h = select_x8(lanes_of(lost), unit_x8(add_x8(wo, wi_local)), h);
        }
    }
    *wi = unit_x8(frame_to_world_x8(facets->frame, wi_local));
    *weighed = keep_x8(wi_local.z > 0.0f && dot_x8(*wi, surface->normal) >= 0.0f,
                       facet_weight_x8(facets, wi_local, h));
}

#endif
