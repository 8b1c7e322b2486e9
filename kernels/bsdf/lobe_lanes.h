/*
 * lobe_lanes.h - the other vertices of a batch than diffuse ones: opaque surfaces with facets of
 * GGX, alike in all directions, and diffuse ones that also reflect by such facets or as a mirror,
 * by ks or by a coat. They are shaded eight at a time as bsdf/bsdf.h, ggx.h, multiple.h and
 * coated.h have them, outside of all solids.
 *
 * The light that a direction carries is told by what it weighs, fr |n.wi| over its density. The
 * functions that others call are out of line, as few batches have such vertices.
 */
#ifndef RT_KERNELS_BSDF_LOBE_LANES_H
#define RT_KERNELS_BSDF_LOBE_LANES_H

#include "bsdf/coated.h"
#include "bsdf/ggx.h"
#include "material/bump.h"
#include "math/width8.inc.h"
#include "math/frame.inc.h"
#include "sample/cosine.inc.h"
#include "bsdf/lambert.inc.h"
#include "bsdf/fresnel.inc.h"
#include "bsdf/microfacet.inc.h"
#include "bsdf/multiple.inc.h"
#include "bsdf/coated.inc.h"
#include "sample/mis.inc.h"

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

/* What the lanes of a batch hold that are not diffuse alone; kd stands in the batch. */
struct mixed_materials {
    global const rt_material_data *material[8];
    float3 ks[8]; /* of a coat: the part of the surface that it covers */
    float alpha[8];
    uint held; /* a bit for each lane that has one */
};

/* The tables of losses of facets, and of coats. */
struct tables_x8 {
    global const rt_facet_losses *table[8];
    global const float *losses[8]; /* of directions above the facets */
    uint8 rows;
    float8 row;   /* that of alpha, counted from 0 */
    float8 along; /* alpha, but of a coat at least RT_COAT_SPREAD */
    uint held;    /* a bit for each lane that has one */
};

/* What is scattered on by facets that have a table of losses. */
struct lost_x8 {
    float8 loss;   /* seen from wo; 0: none */
    float8 often;  /* how often it is sampled */
    float8 factor; /* of the loss seen from wi and n.wi */
    float8 range;  /* of its density */
    struct vec3_x8 colour;
    uint held; /* a bit for each lane that has such facets */
};

/* The reflecting lobe as seen from wo. */
struct facets_x8 {
    struct frame_x8 frame;
    struct vec3_x8 wo; /* in it */
    struct vec3_x8 ks, eta, k;
    struct vec3_x8 reflected; /* as a whole, by the smooth boundary */
    float8 alpha, facing;
    float8 index; /* before a coat over its own */
    int8 is_metal, is_schlick, is_coat, is_smooth, is_separable;
    uint metals, schlicks, coats, smooth, separable; /* a bit for each lane of these */
    struct tables_x8 tables;
    struct lost_x8 lost;
};

/* The diffuse lobe, below a coat or not, over kd: coat_parts of bsdf/coated.h. */
struct below_x8 {
    struct vec3_x8 kd, coated;
    float8 bare;
};

/* Lobes as seen from wo. */
struct lobes_x8 {
    struct facets_x8 facets;
    struct below_x8 below;
    struct vec3_x8 albedo;      /* of both */
    float8 diffuse, reflection; /* how often each is chosen */
    uint held;                  /* a bit for each lane that has lobes here, */
    uint mixed;                 /* and for those where one is diffuse */
};

/* What a direction weighs, and its density; 0: no light comes from there, or it is a mirror's. */
struct weighed_x8 {
    struct vec3_x8 weight;
    float8 pdf_w;
};

/* Without what is not kept. */
static inline struct weighed_x8 keep_x8(int8 kept, struct weighed_x8 weighed)
{
    const struct vec3_x8 none = {0.0f, 0.0f, 0.0f};
    const struct weighed_x8 left = {select_x8(kept, weighed.weight, none),
                                    kept ? weighed.pdf_w : (float8)(0.0f)};
    return left;
}

/* ---- Facets ---------------------------------------------------------------------- */

static inline float8 fresnel_x8(float8 cos_i, float8 eta)
{
    const float8 cos_t = refracted_cosine_x8(cos_i, eta);
    return cos_t == 0.0f ? (float8)(1.0f) : fresnel_of_cosines_x8(cos_i, cos_t, eta);
}

/* What facets met with this cosine reflect. */
static inline struct vec3_x8 facet_colours_x8(const struct facets_x8 *facets, float8 cos_i)
{
    struct vec3_x8 colours = facets->ks;
    if (facets->coats) {
        const struct vec3_x8 coat = scale_x8(fresnel_x8(cos_i, facets->index), facets->ks);
        colours = select_x8(facets->is_coat, coat, colours);
    }
    if (facets->metals) {
        const struct vec3_x8 metal = {
            facets->ks.x * fresnel_conductor_x8(cos_i, facets->eta.x, facets->k.x),
            facets->ks.y * fresnel_conductor_x8(cos_i, facets->eta.y, facets->k.y),
            facets->ks.z * fresnel_conductor_x8(cos_i, facets->eta.z, facets->k.z)};
        colours = select_x8(facets->is_metal, metal, colours);
    }
    if (facets->schlicks) {
        const struct vec3_x8 metal = {fresnel_schlick_x8(cos_i, facets->ks.x),
                                      fresnel_schlick_x8(cos_i, facets->ks.y),
                                      fresnel_schlick_x8(cos_i, facets->ks.z)};
        colours = select_x8(facets->is_schlick, metal, colours);
    }
    return colours;
}

/* As once_eval, of facets of the normals h. */
static inline struct weighed_x8 once_by_facets_x8(const struct facets_x8 *facets, struct vec3_x8 wi,
                                                  struct vec3_x8 h)
{
    const float8 cosine = dot_x8(facets->wo, h);
    const float8 hidden = ggx_hidden_x8(facets->alpha, wi);
    const int8 meets = wi.z > 0.0f && cosine > 0.0f;
    const float8 density = 0.25f * ggx_density_x8(facets->alpha, h) / facets->facing;
    float8 open = unshadowed_x8(facets->facing, hidden, facets->wo, wi);
    if (facets->separable)
        open = facets->is_separable ? unshadowed_alone_x8(hidden, wi) : open;
    struct weighed_x8 once;
    once.pdf_w = meets ? density : (float8)(0.0f);
    once.weight = scale_x8(open, facet_colours_x8(facets, cosine));
    return once;
}

/* ---- Losses of facets, and light that meets more than one --------------------------- */

/* As loss_seen, of a direction of this cosine. */
static inline struct vec2_x8 losses_seen_x8(const struct tables_x8 *tables, float8 cosine)
{
    const float8 place = RT_LOSS_PLACE(cosine, tables->along);
    const float8 x = (place < 1.0f ? place : (float8)(1.0f)) * (float)(RT_LOSS_COSINES - 1u);
    return loss_between_x8(tables->losses, tables->rows, x, tables->row);
}

/* Finds the tables of rough facets; index: as in facets_x8, 1 without a coat. */
static inline void find_tables_x8(struct tables_x8 *tables, const struct mixed_materials *materials,
                                  const struct facets_x8 *facets)
{
    float index[8];
    vstore8(facets->index, 0, index);
    tables->held = 0u;
    for (uint left = materials->held & ~facets->smooth; left; left &= left - 1u) {
        const uint i = lane_first(left);
        struct multiple found;
        if (materials->material[i]->facet_losses == 0u ||
            !find_losses(losses_of(materials->material[i]), index[i], &found))
            continue;
        tables->table[i] = losses_of(materials->material[i]);
        tables->losses[i] = found.above;
        tables->held |= 1u << i;
    }
    if (!tables->held)
        return;
    for (uint i = 0u; i < 8u; i++) {
        tables->table[i] = tables->table[lane_or_first(tables->held, i)];
        tables->losses[i] = tables->losses[lane_or_first(tables->held, i)];
    }
    const float8 part = facets->alpha / LANES_OF(float8, tables->table, ->largest_alpha);
    tables->rows = LANES_OF(uint8, tables->table, ->rows);
    tables->row = (part < 1.0f ? part : (float8)(1.0f)) * convert_float8(tables->rows - 1u);
    tables->along =
        facets->is_coat ? lane_max(facets->alpha, (float8)(RT_COAT_SPREAD)) : facets->alpha;
}

/* As multiple_seen and add_multiple, but for wi. */
static inline void see_lost_x8(struct facets_x8 *facets)
{
    struct lost_x8 *lost = &facets->lost;
    const struct tables_x8 *tables = &facets->tables;
    const struct vec3_x8 mean = VEC3_X8_OF_ROW(tables->table, ->mean_reflectance);
    const struct vec2_x8 seen = losses_seen_x8(tables, fabs(facets->wo.z));
    const int8 is_lost = lanes_of(lost->held) && seen.y > 0.0f;
    lost->loss = is_lost ? seen.x : (float8)(0.0f);
    lost->often = often_probability_x8(lost->loss);
    lost->factor = is_lost ? lost->loss / (RT_PI * seen.y) : (float8)(0.0f);
    lost->range = LANES_OF(float8, tables->table, ->range);
    if (lane_mask(lost->range <= 0.0f))
        lost->range =
            lost->range > 0.0f ? lost->range : log(1.0f + 1.0f / (facets->alpha * facets->alpha));
    const float8 left = 1.0f - seen.y;
    const float8 black = LANES_OF(float8, tables->table, ->black_reflectance);
    lost->colour.x = colour_of_lost_x8(facets->ks.x * mean.x + black, left);
    lost->colour.y = colour_of_lost_x8(facets->ks.y * mean.y + black, left);
    lost->colour.z = colour_of_lost_x8(facets->ks.z * mean.z + black, left);
}

/* Adds what is scattered on. */
static inline struct weighed_x8 with_lost_x8(const struct facets_x8 *facets, struct vec3_x8 wi,
                                             struct weighed_x8 once)
{
    const struct lost_x8 *lost = &facets->lost;
    const struct vec2_x8 alpha = {facets->alpha, facets->alpha};
    const int8 is_lost = lost->loss > 0.0f && wi.z > 0.0f;
    const float8 density = lost->often * lost_pdf_w_x8(alpha, lost->range, wi.z);
    const float8 brightness = losses_seen_x8(&facets->tables, fabs(wi.z)).x * lost->factor * wi.z;
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

/* ---- Seen from wo ------------------------------------------------------------------ */

/* As boundary_normal. */
static inline struct vec3_x8 facet_normals_x8(const struct facets_x8 *facets,
                                              const struct surface_x8 *surface, struct vec3_x8 wo)
{
    const float8 cosine = dot_x8(wo, surface->shading);
    const struct vec3_x8 mirrored = sub_x8(scale_x8(2.0f * cosine, surface->shading), wo);
    const int8 keeps_side = cosine > 0.0f && dot_x8(mirrored, surface->normal) > 0.0f;
    const int8 is_seen = facets->is_smooth ? keeps_side : cosine >= RT_LEAST_TILT;
    return select_x8(is_seen, surface->shading, surface->normal);
}

/* Makes the reflecting lobes of lanes; wo points to where their paths come from. */
static inline void see_facets_x8(struct facets_x8 *facets, const struct mixed_materials *materials,
                                 global const rt_material_data *const material[8],
                                 const struct surface_x8 *surface, struct vec3_x8 wo)
{
    const uint8 flags = LANES_OF(uint8, material, ->flags);
    const struct vec3_x8 ks = VEC3_X8_OF(materials->ks, ), eta = VEC3_X8_OF_ROW(material, ->eta),
                         k = VEC3_X8_OF_ROW(material, ->k);
    facets->ks = ks;
    facets->eta = eta;
    facets->k = k;
    facets->alpha = vload8(0, materials->alpha);
    facets->is_smooth = facets->alpha < RT_SMOOTH_ALPHA;
    facets->is_coat = (flags & RT_MATERIAL_COAT) != 0u;
    facets->is_schlick = (flags & RT_MATERIAL_SCHLICK) != 0u && !facets->is_coat;
    facets->is_metal =
        (flags & RT_MATERIAL_CONDUCTOR) != 0u && !facets->is_coat && !facets->is_schlick;
    facets->is_separable = (flags & RT_MATERIAL_SEPARABLE) != 0u;
    facets->separable = lane_mask(facets->is_separable) & materials->held;
    facets->smooth = lane_mask(facets->is_smooth) & materials->held;
    facets->coats = lane_mask(facets->is_coat) & materials->held;
    facets->metals = lane_mask(facets->is_metal) & materials->held;
    facets->schlicks = lane_mask(facets->is_schlick) & materials->held;
    facets->index =
        facets->is_coat ? 1.0f / LANES_OF(float8, material, ->coat_ior) : (float8)(1.0f);
    facets->frame = frame_about_x8(facet_normals_x8(facets, surface, wo));
    facets->wo = frame_to_local_x8(facets->frame, wo);
    facets->facing = ggx_facing_x8(facets->alpha, facets->wo);
    facets->reflected = facet_colours_x8(facets, fabs(facets->wo.z));
    find_tables_x8(&facets->tables, materials, facets);
    facets->lost.held = facets->tables.held & ~facets->coats;
    if (facets->lost.held)
        see_lost_x8(facets);
}

/* Fi of the coats without what facets add: indices seldom differ. */
static inline float8 mean_inner_reflectances_x8(float8 index, uint lanes)
{
    float indices[8], inner[8];
    vstore8(index, 0, indices);
    for (uint last = lane_first(lanes), i = 0u; i < 8u; i++) {
        const uint here = lane_or_first(lanes, i);
        inner[i] = i > 0u && indices[here] == indices[last]
                       ? inner[i - 1u]
                       : mean_inner_reflectance(1.0f / indices[here]);
        last = here;
    }
    return vload8(0, inner);
}

/* What enters a coat from this cosine to the shading normal, and Fi more than of a smooth one. */
static inline float8 enters_coat_x8(const struct facets_x8 *facets, float8 cosine, float8 *more)
{
    const float8 c = lane_min(lane_max(cosine, (float8)(0.0f)), (float8)(1.0f));
    float8 enters = 1.0f - fresnel_x8(c, facets->index);
    *more = 0.0f;
    if (facets->tables.held & facets->coats) {
        const int8 has_table = lanes_of(facets->tables.held);
        const struct vec2_x8 seen = losses_seen_x8(&facets->tables, c);
        enters -= has_table ? seen.x : (float8)(0.0f);
        *more = has_table ? seen.y : (float8)(0.0f);
    }
    return enters;
}

/* As coat_parts_of; returns the albedo over kd. */
static inline struct vec3_x8 see_below_x8(struct below_x8 *below, const struct facets_x8 *facets,
                                          int8 is_linear, float8 cosine)
{
    const struct vec3_x8 none = {0.0f, 0.0f, 0.0f}, one = {1.0f, 1.0f, 1.0f};
    below->bare = 1.0f;
    below->coated = none;
    if (!facets->coats)
        return one;
    float8 more;
    const float8 enters = enters_coat_x8(facets, cosine, &more);
    const float8 inner = mean_inner_reflectances_x8(facets->index, facets->coats) + more;
    const struct vec3_x8 back = scale_x8(inner, select_x8(is_linear, one, below->kd));
    const float8 index2 = facets->index * facets->index;
    const float8 through = facets->ks.x * index2 * enters;
    const struct vec3_x8 coated = {through_coat_x8(through, back.x),
                                   through_coat_x8(through, back.y),
                                   through_coat_x8(through, back.z)};
    below->coated = select_x8(facets->is_coat, coated, none);
    below->bare = facets->is_coat ? 1.0f - facets->ks.x : (float8)(1.0f);
    const struct vec3_x8 bare = {below->bare, below->bare, below->bare};
    return along_x8(bare, (1.0f - inner) / index2, below->coated);
}

/*
 * Makes the lobes of the lanes that hold materials, of this kd, seen from where paths of these
 * directions and throughputs come from.
 */
INLINE_NEVER void see_lobes(struct lobes_x8 *lobes, const struct mixed_materials *materials,
                            const struct surface_x8 *surface, struct vec3_x8 direction,
                            struct vec3_x8 beta, struct vec3_x8 kd)
{
    global const rt_material_data *material[8];
    for (uint i = 0u; i < 8u; i++)
        material[i] = materials->material[lane_or_first(materials->held, i)];
    const struct vec3_x8 wo = scale_x8(-1.0f, direction);
    see_facets_x8(&lobes->facets, materials, material, surface, wo);
    lobes->held = materials->held;
    lobes->mixed = lane_mask(largest_x8(kd) > 0.0f) & materials->held;
    lobes->diffuse = 0.0f;
    lobes->reflection = 1.0f;
    lobes->albedo = lobes->facets.reflected;
    if (!lobes->mixed)
        return;
    const int8 is_linear = (LANES_OF(uint8, material, ->flags) & RT_MATERIAL_LINEAR) != 0u;
    lobes->below.kd = kd;
    const struct vec3_x8 diffuse = mul_x8(
        kd, see_below_x8(&lobes->below, &lobes->facets, is_linear, dot_x8(wo, surface->shading)));
    lobes->albedo = add_x8(diffuse, lobes->facets.reflected);
    const float8 d = dot_x8(beta, diffuse), r = dot_x8(beta, lobes->facets.reflected);
    const float8 sum = d + r;
    lobes->diffuse = sum > 0.0f ? d / sum : (float8)(0.0f);
    lobes->reflection = sum > 0.0f ? r / sum : (float8)(0.0f);
}

/* ---- Light ------------------------------------------------------------------------- */

/* As coated_eval, or lambert_eval. */
static inline struct weighed_x8 weigh_below_x8(const struct lobes_x8 *lobes,
                                               const struct surface_x8 *surface, struct vec3_x8 wi)
{
    const struct below_x8 *below = &lobes->below;
    struct weighed_x8 weighed = {below->kd,
                                 lambert_density_x8(surface->normal, surface->shading, wi)};
    if (lobes->facets.coats) {
        float8 unused;
        const struct vec3_x8 bare = {below->bare, below->bare, below->bare};
        const float8 enters = enters_coat_x8(&lobes->facets, dot_x8(wi, surface->shading), &unused);
        weighed.weight = mul_x8(below->kd, along_x8(bare, enters, below->coated));
    }
    return keep_x8(weighed.pdf_w > 0.0f, weighed);
}

/* As ggx_eval. */
static inline struct weighed_x8 weigh_facets_x8(const struct facets_x8 *facets,
                                                const struct surface_x8 *surface, struct vec3_x8 wi)
{
    const struct vec3_x8 wi_local = frame_to_local_x8(facets->frame, wi);
    const struct vec3_x8 h = unit_x8(add_x8(facets->wo, wi_local));
    const struct weighed_x8 weighed = facet_weight_x8(facets, wi_local, h);
    return keep_x8(!facets->is_smooth && weighed.pdf_w > 0.0f && wi_local.z > 0.0f &&
                       dot_x8(wi, surface->normal) > 0.0f,
                   weighed);
}

/* What a lobe that is chosen so often scatters, weighted by MIS against sampling it. */
static inline struct vec3_x8 lit_x8(struct weighed_x8 lobe, float8 chosen, float8 inv_pdf,
                                    int8 alone)
{
    const float8 share = lobe.pdf_w * inv_pdf;
    const float8 ratio = alone ? (float8)(0.0f) : chosen * share;
    return scale_x8(share / power_heuristic_divisor_x8(ratio), lobe.weight);
}

/*
 * As vertex_direct, over the density 1 / inv_pdf of light sampling; in the lanes `alone` the light
 * counts fully.
 */
INLINE_NEVER void light_lobes(struct vec3_x8 *scattered, const struct lobes_x8 *lobes,
                              const struct surface_x8 *surface, struct vec3_x8 wi, float8 inv_pdf,
                              int8 alone)
{
    struct vec3_x8 sum = {0.0f, 0.0f, 0.0f};
    if (lobes->held & ~lobes->facets.smooth)
        sum =
            lit_x8(weigh_facets_x8(&lobes->facets, surface, wi), lobes->reflection, inv_pdf, alone);
    if (lobes->mixed)
        sum =
            add_x8(sum, lit_x8(weigh_below_x8(lobes, surface, wi), lobes->diffuse, inv_pdf, alone));
    *scattered = sum;
}

/* ---- Directions -------------------------------------------------------------------- */

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

/* As ggx_sample, or specular_reflection_sample. */
static inline struct weighed_x8 sample_facets_x8(struct vec3_x8 *wi, const struct facets_x8 *facets,
                                                 const struct surface_x8 *surface, struct vec3_x8 u)
{
    const struct vec2_x8 alpha = {facets->alpha, facets->alpha}, xy = {u.x, u.y};
    const struct vec3_x8 wo = facets->wo, up = {0.0f, 0.0f, 1.0f};
    struct vec3_x8 h = select_x8(facets->is_smooth, up, sample_visible_normal_x8(alpha, wo, xy));
    struct vec3_x8 wi_local = unit_x8(sub_x8(scale_x8(2.0f * dot_x8(wo, h), h), wo));
    const uint lost =
        facets->lost.held ? lane_mask(u.z < facets->lost.often) & facets->lost.held : 0u;
    if (lost) {
        wi_local = sample_lost_x8(facets, lost, wi_local, u);
        h = select_x8(lanes_of(lost), unit_x8(add_x8(wo, wi_local)), h);
    }
    *wi = unit_x8(frame_to_world_x8(facets->frame, wi_local));
    struct weighed_x8 weighed = facet_weight_x8(facets, wi_local, h);
    const int8 is_there = facets->is_smooth || weighed.pdf_w > 0.0f;
    weighed.weight = select_x8(facets->is_smooth, facets->reflected, weighed.weight);
    weighed.pdf_w = facets->is_smooth ? (float8)(0.0f) : weighed.pdf_w;
    return keep_x8(is_there && wi_local.z > 0.0f && dot_x8(*wi, surface->normal) >= 0.0f, weighed);
}

/*
 * Samples directions as bsdf_scatter does, of the lobe that bsdf_choose takes; weight 0: of none.
 * `lambert` are those of the diffuse lobe.
 */
INLINE_NEVER void sample_lobes(struct vec3_x8 *wi, struct weighed_x8 *weighed,
                               const struct lobes_x8 *lobes, const struct surface_x8 *surface,
                               struct vec3_x8 lambert, float8 survival, struct vec3_x8 u,
                               float8 choice)
{
    const float8 d = survival * lobes->diffuse, r = survival * lobes->reflection;
    *weighed = sample_facets_x8(wi, &lobes->facets, surface, u);
    float8 chosen = lobes->reflection;
    if (lobes->mixed) {
        const int8 is_diffuse = choice < d;
        const struct weighed_x8 diffuse = weigh_below_x8(lobes, surface, lambert);
        *wi = select_x8(is_diffuse, lambert, *wi);
        weighed->weight = select_x8(is_diffuse, diffuse.weight, weighed->weight);
        weighed->pdf_w = is_diffuse ? diffuse.pdf_w : weighed->pdf_w;
        chosen = is_diffuse ? lobes->diffuse : chosen;
    }
    weighed->weight = scale_x8(1.0f / chosen, weighed->weight);
    weighed->pdf_w *= chosen;
    *weighed = keep_x8(choice < d + r && chosen > 0.0f, *weighed);
}

#endif
