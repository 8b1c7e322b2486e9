/*
 * lacquer.h - the rough lobe of a surface whose ks lies below a coat: lacquered metal, the flakes
 * of a car's finish, glazed mirrors.
 *
 *   fr = c (coat + below + often) + (1 - c) bare
 *
 * with c the part that is coated. `coat` are the facets of a rough coat, which reflect once, and
 * `bare` those of ks where there is none. Light enters the coat along w as w', by Snell's law at
 * the mean normal, of which the part P(w) passes: 1 - F, and where the coat is rough 1 less the
 * albedo of its facets. Below,
 *
 *   below = P(wo) P(wi) A / (m^2 (1 - f A (B + kd))) fb(wo', wi'),   f = 1 - max(P(wo), P(wi))
 *
 * with m the index of the coat over that before it, fb the facets of ks, met in the coat, B what
 * they reflect at the half vector, and A what the coat leaves of light that crosses it along wi'
 * and wo'. 1 / (1 - f A (B + kd)) is the sum over the light that goes to and fro, as between two
 * smooth surfaces; the smaller f of the two keeps the lobe reciprocal, and never brighter than what
 * enters. A rough coat also blurs what is seen through it: its two
 * crossings turn a ray by the slopes of its facets times 1 - 1/m, facets of ks by twice their own;
 * so alpha^2 below is that of ks plus (1 - 1/m)^2 / 2 times that of the coat.
 *
 * What of the light that enters a white base does not leave so, because facets or the coat throw it
 * back at too wide an angle, is l(w), which the host tabulates; it leaves as multiple.h has it:
 *
 *   often = k l(wo) l(wi) A / (pi L),   L = 2 int l(u) u du
 *
 * with k as there, of the part E of that light which leaves each time: 1 - L over the mean of P,
 * or, if that is more, what leaves of even light, 1 - Fi of a clear coat (coated.h). So a white
 * base is white below a clear coat of any roughness. Where coat and ks are smooth there is no such
 * lobe, but a mirror that reflects F + (1 - F)^2 A B / (1 - F A (B + kd)); where the coat alone is
 * smooth, there are both.
 *
 * References:
 *   Weidlich, Wilkie: "Arbitrarily Layered Micro-Facet Surfaces", GRAPHITE 2007 (facets that are
 *     met through a coat).
 *   Belcour: "Efficient Rendering of Layered Materials using an Atomic Decomposition with
 *     Statistical Operators", ACM TOG 37(4), 2018 (how crossings widen a lobe).
 *   Kulla, Conty: "Revisiting Physically Based Shading at Imageworks", SIGGRAPH 2017 course
 *     "Physically Based Shading in Theory and Practice".
 */
#ifndef RT_KERNELS_BSDF_LACQUER_H
#define RT_KERNELS_BSDF_LACQUER_H

#include "bsdf/coated.h"
#include "bsdf/ggx.h"

/* ---- Through the coat ------------------------------------------------------------ */

/* Light that enters or leaves along w, w.z >= 0. */
struct crossing {
    float3 below; /* w' */
    float passes; /* P(w) */
    float3 left;  /* by the coat, of light that crosses it along w' */
};

/* excesses: those of the coat */
static inline struct crossing cross_coat(const struct bsdf *bsdf, global const float *excesses,
                                         float3 w)
{
    struct crossing crossing;
    float cosine;
    const float reflected = fresnel(w.z, bsdf->specular.eta, &cosine);
    crossing.below = (float3)(bsdf->specular.eta * w.xy, cosine);
    crossing.passes = fmax(1.0f - reflected - coat_excess(bsdf, excesses, w.z).x, 0.0f);
    crossing.left = left_by_coat(bsdf->specular.coat.absorption, cosine);
    return crossing;
}

/* The direction along which w, below the coat, leaves it; 0: it is thrown back. */
static inline float3 leave_coat(const struct bsdf *bsdf, float3 w)
{
    const float2 across = w.xy / bsdf->specular.eta;
    const float z2 = 1.0f - dot(across, across);
    return w.z > 0.0f && z2 > 0.0f ? (float3)(across, sqrt(z2)) : (float3)(0.0f);
}

/* ---- Facets ---------------------------------------------------------------------- */

/* Those of the coat. */
static inline struct specular facets_of_coat(const struct specular *specular)
{
    struct specular facets = *specular;
    facets.alpha = facets.alpha_v = specular->coat.alpha;
    return facets;
}

/* Those of ks where there is none. */
static inline struct specular bare_facets(const struct specular *specular)
{
    struct specular facets = *specular;
    facets.alpha = specular->coat.bare_alpha;
    facets.alpha_v = specular->coat.bare_alpha_v;
    return facets;
}

/* Reflection by facets from wi to wo, both above them. */
struct facet_mirror {
    float cos_h; /* at which the facets are met */
    float pdf_w; /* of wi, sampled by visible normals; 0: there are none */
    float open;  /* the part of it that no other facet hides */
};

static inline struct facet_mirror mirror_by_facets(const struct specular *facets, float3 wo,
                                                   float3 wi)
{
    const float3 h = unit(wo + wi);
    const float facing = facing_area(facets, wo);
    struct facet_mirror mirror;
    mirror.cos_h = dot(wo, h);
    mirror.pdf_w = mirror.cos_h > 0.0f ? 0.25f * facet_density(facets, h) / facing : 0.0f;
    mirror.open = facet_unshadowed(facets, facing, hidden_area(facets, wi), wo, wi);
    return mirror;
}

/* ---- What facets lose ------------------------------------------------------------ */

/* What is scattered on of the light seen from wo, by a table of the host. */
struct lost {
    float loss, mean; /* l(wo) and L; 0: none */
    float3 colour;    /* k */
    float often;      /* the probability that a direction is sampled for it */
    float range;
    float2 rows; /* the alphas by which the table is read, */
    float least; /* and its spread */
    global const rt_facet_losses *table;
    global const float *losses;
};

/* The loss seen from w, and the mean. */
static inline float2 lost_seen(const struct specular *facets, const struct lost *lost, float3 w)
{
    return loss_seen(lost->table, is_anisotropic(facets->material), lost->rows, lost->least,
                     lost->losses, w);
}

/* The light that reaches facets below a coat, or bare ones: all. */
struct arrival {
    float part;         /* seen from wo */
    float mean;         /* over all directions */
    float least_leaves; /* of what is scattered evenly there: the part that leaves */
    float3 diffuse;     /* what scatters light on beside the facets */
    float3 left;        /* of what they throw on, by the coat that throws it back */
};

/* lost: with its table, NULL: light is lost, and how that is read. */
static inline void find_lost(struct lost *lost, const struct specular *facets,
                             const struct arrival *arrival, float3 wo)
{
    const float2 alpha = both_alphas(facets);
    struct multiple found;
    lost->loss = lost->mean = lost->often = 0.0f;
    if (!lost->table || !find_losses(lost->table, facets->eta, &found))
        return;
    lost->losses = found.above;
    const float2 seen = lost_seen(facets, lost, wo);
    const float left = fmax(1.0f - seen.y / arrival->mean, arrival->least_leaves);
    const float3 met = mean_of_facets(lost->table, facets->ks);
    const float3 again = met + arrival->diffuse;
    lost->loss = seen.x;
    lost->mean = seen.y;
    lost->colour = met * again * left / (1.0f - again * arrival->left * (1.0f - left));
    lost->often = often_probability(seen.x / fmax(arrival->part, 1e-6f));
    lost->range = lost_range(lost->table, alpha);
}

/* fr |n.wi| of it, and its density of wi. */
static inline struct lobe_value lost_eval(const struct specular *facets, const struct lost *lost,
                                          float3 wi)
{
    if (!(lost->mean > 0.0f))
        return no_light();
    struct lobe_value lobe;
    lobe.value =
        lost->colour * (lost->loss * lost_seen(facets, lost, wi).x * wi.z / (RT_PI * lost->mean));
    lobe.pdf_w = lost_pdf_w(both_alphas(facets), lost->range, wi.z);
    return lobe;
}

/*
 * That below the coat and that of bare facets, seen from wo. The rows of the first are for alphas
 * of the coat where a texture varies these, of the facets else.
 */
static inline void find_both(struct lost *below, struct lost *bare, const struct bsdf *bsdf,
                             global const float *excesses, float passes, float3 wo)
{
    const struct specular *specular = &bsdf->specular, facets = bare_facets(specular);
    global const rt_material_data *material = specular->material;
    const float m2 = 1.0f / square(specular->eta);
    const float leaves =
        1.0f - mean_inner_reflectance(1.0f / specular->eta) - coat_excess(bsdf, excesses, 1.0f).y;
    const float3 left = left_by_coat(specular->coat.absorption, RT_MEAN_COSINE);
    const struct arrival entered = {passes, leaves * m2, leaves, specular->coat.diffuse,
                                    left * left};
    const struct arrival all = {1.0f, 1.0f, 0.0f, (float3)(0.0f), (float3)(1.0f)};
    below->table = lacquer_losses(material);
    below->rows = material->coat_roughness_texture == RT_NONE ? both_alphas(specular)
                                                              : (float2)(specular->coat.alpha);
    below->least = RT_COAT_SPREAD;
    bare->table = next_losses(below->table);
    bare->rows = both_alphas(&facets);
    bare->least = 0.0f;
    find_lost(below, specular, &entered, wo);
    find_lost(bare, &facets, &all, wo);
}

/* ---- The lobe -------------------------------------------------------------------- */

/* What is chosen from as seen from wo; the shares add up to 1, or all are 0. */
struct lacquer {
    struct crossing from;
    global const float *excesses; /* of the coat */
    float coat, bare, below;
    struct lost lost_below, lost_bare;
};

static inline struct lacquer lacquer_seen(const struct bsdf *bsdf, float3 wo)
{
    const struct specular *specular = &bsdf->specular;
    const float amount = specular->coat.amount;
    struct lacquer lacquer;
    lacquer.excesses = coat_excesses(bsdf);
    lacquer.from = cross_coat(bsdf, lacquer.excesses, wo);
    find_both(&lacquer.lost_below, &lacquer.lost_bare, bsdf, lacquer.excesses, lacquer.from.passes,
              wo);
    lacquer.coat = specular->coat.alpha > 0.0f ? amount * (1.0f - lacquer.from.passes) : 0.0f;
    const float3 left = lacquer.from.left;
    lacquer.below = amount * lacquer.from.passes *
                    mean3(left * left * reflected_below(specular, lacquer.from.below.z));
    lacquer.bare = specular->coat.bare_alpha > 0.0f
                       ? (1.0f - amount) * mean3(reflected_bare(specular, wo.z))
                       : 0.0f;
    const float sum = lacquer.coat + lacquer.below + lacquer.bare;
    const float scale = sum > 0.0f ? 1.0f / sum : 0.0f;
    lacquer.coat *= scale;
    lacquer.below *= scale;
    lacquer.bare *= scale;
    return lacquer;
}

/* Adds a part of the lobe, chosen with this share. */
static inline void add_to_lobe(struct lobe_value *sum, float3 weight, float share,
                               struct lobe_value part)
{
    sum->value += weight * part.value;
    sum->pdf_w += share * part.pdf_w;
}

/*
 * What comes from below the coat out of wi, which enters it at `to`, but for what it absorbs along
 * both, `left`; and the density of wi by the facets there.
 */
static inline struct lobe_value below_eval(const struct specular *specular,
                                           const struct crossing *from, const struct crossing *to,
                                           float3 left, float3 wi)
{
    if (!(from->passes * to->passes > 0.0f))
        return no_light();
    const struct facet_mirror mirror = mirror_by_facets(specular, from->below, to->below);
    const float3 base = reflected_below(specular, mirror.cos_h);
    const float thrown_back = 1.0f - fmax(from->passes, to->passes);
    struct lobe_value lobe;
    lobe.pdf_w = mirror.pdf_w * square(specular->eta) * wi.z / to->below.z;
    lobe.value = base * (from->passes * to->passes * lobe.pdf_w * mirror.open) /
                 (1.0f - thrown_back * left * (base + specular->coat.diffuse));
    return lobe;
}

/* What facets reflect that have this reflectance at the half vector, and the density of wi. */
static inline struct lobe_value facets_part(struct facet_mirror mirror, float3 reflectance)
{
    struct lobe_value lobe;
    lobe.value = reflectance * (mirror.pdf_w * mirror.open);
    lobe.pdf_w = mirror.pdf_w;
    return lobe;
}

static inline struct lobe_value lacquer_value(const struct bsdf *bsdf,
                                              const struct lacquer *lacquer, float3 wo, float3 wi)
{
    const struct specular *specular = &bsdf->specular;
    const struct crossing *from = &lacquer->from, to = cross_coat(bsdf, lacquer->excesses, wi);
    const float3 left = from->left * to.left;
    const float3 covered = (float3)(specular->coat.amount), beside = 1.0f - covered;
    const struct lost *below = &lacquer->lost_below, *bare = &lacquer->lost_bare;
    struct lobe_value sum = no_light();
    add_to_lobe(&sum, covered * left, lacquer->below * (1.0f - below->often),
                below_eval(specular, from, &to, left, wi));
    add_to_lobe(&sum, covered * left, lacquer->below * below->often,
                lost_eval(specular, below, wi));
    if (lacquer->coat > 0.0f) {
        const struct specular facets = facets_of_coat(specular);
        const struct facet_mirror mirror = mirror_by_facets(&facets, wo, wi);
        float unused;
        const float reflectance = fresnel(mirror.cos_h, specular->eta, &unused);
        add_to_lobe(&sum, covered, lacquer->coat, facets_part(mirror, (float3)(reflectance)));
    }
    if (lacquer->bare > 0.0f) {
        const struct specular facets = bare_facets(specular);
        const struct facet_mirror mirror = mirror_by_facets(&facets, wo, wi);
        add_to_lobe(&sum, beside, lacquer->bare * (1.0f - bare->often),
                    facets_part(mirror, reflected_bare(specular, mirror.cos_h)));
        add_to_lobe(&sum, beside, lacquer->bare * bare->often, lost_eval(&facets, bare, wi));
    }
    return sum;
}

static inline float3 mirror_about(float3 wo, float3 h)
{
    return unit(2.0f * dot(wo, h) * h - wo);
}

/* One for what is lost, with its probability by u.z in [0,share), else about a facet. */
static inline float3 sample_part(const struct specular *facets, const struct lost *lost,
                                 float share, float3 wo, float3 u, bool *is_lost)
{
    *is_lost = u.z < share * lost->often;
    return *is_lost ? sample_lost(both_alphas(facets), lost->range, u.xy)
                    : mirror_about(wo, sample_facet(facets, wo, u.xy));
}

/* A direction by u in [0,1)^3; z <= 0: the light is lost. */
static inline float3 lacquer_direction(const struct bsdf *bsdf, const struct lacquer *lacquer,
                                       float3 wo, float3 u)
{
    const struct specular *specular = &bsdf->specular;
    bool is_lost;
    if (u.z < lacquer->coat) {
        const struct specular facets = facets_of_coat(specular);
        return mirror_about(wo, sample_facet(&facets, wo, u.xy));
    }
    u.z -= lacquer->coat;
    if (u.z < lacquer->bare) {
        const struct specular facets = bare_facets(specular);
        return sample_part(&facets, &lacquer->lost_bare, lacquer->bare, wo, u, &is_lost);
    }
    u.z -= lacquer->bare;
    const float3 wi = sample_part(specular, &lacquer->lost_below, lacquer->below,
                                  lacquer->from.below, u, &is_lost);
    return is_lost ? wi : leave_coat(bsdf, wi);
}

/* In the frame of the facets; one that grazes them, as by rounding, is above. */
static inline float3 above_facets(struct frame frame, float3 w)
{
    const float3 above = frame_to_local(frame, w);
    return (float3)(above.xy, fmax(above.z, 1e-6f));
}

static inline struct lobe_value lacquer_eval(const struct bsdf *bsdf, float3 wi)
{
    const struct frame frame = facet_frame(&bsdf->specular);
    const float3 wo_local = above_facets(frame, bsdf->wo), wi_local = frame_to_local(frame, wi);
    if (!(wi_local.z > 0.0f && dot(wi, bsdf->normal) > 0.0f))
        return no_light();
    const struct lacquer lacquer = lacquer_seen(bsdf, wo_local);
    return lacquer_value(bsdf, &lacquer, wo_local, wi_local);
}

static inline struct lobe_sample lacquer_sample(const struct bsdf *bsdf, float3 u)
{
    const struct frame frame = facet_frame(&bsdf->specular);
    const float3 wo_local = above_facets(frame, bsdf->wo);
    const struct lacquer lacquer = lacquer_seen(bsdf, wo_local);
    const float3 wi_local = lacquer_direction(bsdf, &lacquer, wo_local, u);
    struct lobe_sample sample;
    sample.through = false;
    sample.wi = bsdf->normal;
    sample.weight = (float3)(0.0f);
    sample.pdf_w = 0.0f;
    if (!(wi_local.z > 0.0f))
        return sample;
    sample.wi = unit(frame_to_world(frame, wi_local));
    if (!(dot(sample.wi, bsdf->normal) > 0.0f))
        return sample;
    const struct lobe_value lobe = lacquer_value(bsdf, &lacquer, wo_local, wi_local);
    sample.pdf_w = lobe.pdf_w;
    sample.weight = lobe.pdf_w > 0.0f ? lobe.value / lobe.pdf_w : (float3)(0.0f);
    return sample;
}

static inline float lacquer_pdf_w(const struct bsdf *bsdf, float3 wi)
{
    return lacquer_eval(bsdf, wi).pdf_w;
}

/* That of smooth surfaces, an upper bound of what facets leave. */
static inline float3 lacquer_albedo(const struct bsdf *bsdf)
{
    return bsdf->refracted;
}

#endif
