/*
 * bidirectional.h - a vertex of a light or camera path: its scattering between any two directions,
 * with the densities of either from the other, and scattering of the path itself.
 *
 * The lobes that are no delta lobes count as one here, by the sum of their values and densities, so
 * that a path has the same densities by whichever technique it is made. A lobe is chosen
 * by the albedos alone, whatever throughput the path has, for the same reason.
 *
 * Light paths carry flux, camera paths radiance: at refraction radiance is scaled by the square of
 * the relative index, and with shading normals flux is scattered by the adjoint, adjoint.h (Veach
 * 1997, chapter 5). Whichever of the two a vertex has, the reversed path carries the other.
 */
#ifndef RT_KERNELS_SURFACE_BIDIRECTIONAL_H
#define RT_KERNELS_SURFACE_BIDIRECTIONAL_H

#include "surface/vertex.h"

/* Scattering between wo and another direction. */
struct scattering {
    /* of radiance fr |n.wi|, from wi to wo; of flux what goes to wi, per steradian of unit flux */
    float3 value;
    float pdf_w;      /* density of wi, and the choice of its lobe, */
    float back_pdf_w; /* and of wo for a path that comes along wi */
};

/* The boundary between two media at a surface of this material. */
static inline struct boundary boundary_between(const struct scene *scene, uint material,
                                               uint medium, uint beyond)
{
    const uint4 here = (uint4)(medium, (uint3)(RT_NONE)), there = (uint4)(beyond, (uint3)(RT_NONE));
    if (is_transparent(scene->materials + material))
        return media_between(scene, material, here, there);
    return media_meet(scene, here, material, false);
}

/* The vertex of a path that carries `transport`, whose densities depend on no throughput. */
static inline void make_bidir_vertex(struct vertex *vertex, const struct scene *scene,
                                     const struct meeting *met, uint medium, uint transport)
{
    make_vertex(vertex, scene, met, medium, (float3)(1.0f), transport);
}

/* Makes *out the BSDF for a path of the other kind that comes along -wi. */
static inline void make_bsdf_back(struct bsdf *out, const struct scene *scene,
                                  const struct vertex *vertex, float3 wi)
{
    const bool through = vertex_crosses(vertex, wi);
    const uint here = through ? vertex->beyond.x : vertex->medium,
               there = through ? vertex->medium : vertex->beyond.x;
    UNDISPERSED struct boundary boundary = boundary_between(scene, vertex->material, here, there);
    DISPERSED(disperse(&boundary, scene, vertex->material, here, there, vertex->wavelength));
    make_bsdf(out, &vertex->params, scene->materials + vertex->material, vertex->bsdf.normal, wi,
              &boundary, (float3)(1.0f),
              vertex->bsdf.transport == CARRY_FLUX ? CARRY_RADIANCE : CARRY_FLUX);
}

/* The density of wo for a path that comes along -wi, where there is a specular part. */
INLINE_NEVER float back_specular_pdf_w(const struct scene *scene, const struct vertex *vertex,
                                       float3 wi)
{
    struct bsdf back;
    make_bsdf_back(&back, scene, vertex, wi);
    return bsdf_pdf_w(&back, vertex->bsdf.wo);
}

/*
 * The same anywhere. Diffuse lobes go on by the cosine: of flux to the geometric normal. One that
 * transmits has chosen the side, as often from one as from the other.
 */
static inline float back_pdf_w(const struct scene *scene, const struct vertex *vertex, float3 wi)
{
    const struct bsdf *bsdf = &vertex->bsdf;
    if (has_specular(bsdf))
        return back_specular_pdf_w(scene, vertex, wi);
    const float density = lambert_density(
        bsdf->normal, bsdf->transport == CARRY_FLUX ? bsdf->shading : bsdf->normal, bsdf->wo);
    return bsdf->diffuse_lobe == RT_LOBE_TRANSLUCENT
               ? density * translucent_share(bsdf, vertex_crosses(vertex, wi))
               : density;
}

/* Whether its lobes are facets, alone or on Lambert's, about the geometric normal. */
static inline bool has_plain_facets(const struct bsdf *bsdf)
{
    return bsdf_is_rough(bsdf) && bsdf_rough_lobe(bsdf) == RT_LOBE_GGX && !is_tilted(bsdf) &&
           (bsdf->diffuse_lobe == RT_LOBE_LAMBERT || !bsdf_is_diffuse(bsdf));
}

/*
 * Scattering by such lobes, of radiance. From wi they are the same, and eta is 1 / eta beyond the
 * surface; only their albedos, by which one is chosen, are made again.
 */
static inline struct scattering plain_facets_eval(const struct bsdf *bsdf, float3 wi)
{
    const struct facets_value facets = ggx_eval_both(bsdf, wi);
    struct scattering s;
    s.value = facets.value;
    s.pdf_w = facets.pdf_w;
    s.back_pdf_w = facets.back_pdf_w;
    if (!bsdf_is_diffuse(bsdf))
        return s;
    const float cosine = dot(wi, bsdf->normal);
    const struct lobe_value diffuse = lambert_eval(bsdf, wi);
    struct specular back = bsdf->specular;
    if (cosine < 0.0f)
        back.eta = 1.0f / back.eta;
    const struct split split = split_light(&back, fabs(cosine));
    const float rough = mean3(split.reflected + split.refracted);
    const float share = rough / (rough + mean3(bsdf->kd));
    const float there = cosine > 0.0f ? cosine_pdf_w(dot(bsdf->wo, bsdf->normal)) : 0.0f;
    s.value += diffuse.value;
    s.pdf_w = mix(diffuse.pdf_w, facets.pdf_w, bsdf_share(bsdf, 1u));
    s.back_pdf_w = mix(there, facets.back_pdf_w, share);
    return s;
}

/* Whether it is Lambert's lobe alone, about the geometric normal. */
static inline bool is_plain_lambert(const struct bsdf *bsdf)
{
    return bsdf->diffuse_lobe == RT_LOBE_LAMBERT && bsdf_is_diffuse(bsdf) && !has_specular(bsdf) &&
           !is_tilted(bsdf);
}

/* Scattering by that. */
static inline struct scattering plain_lambert_eval(const struct bsdf *bsdf, float3 wi)
{
    const struct lobe_value lobe = lambert_eval(bsdf, wi);
    struct scattering s;
    s.value = lobe.value;
    s.pdf_w = lobe.pdf_w;
    s.back_pdf_w = cosine_pdf_w(dot(bsdf->wo, bsdf->normal));
    return s;
}

/* Scattering by any lobes. */
INLINE_NEVER struct scattering mixture_eval(const struct scene *scene, const struct vertex *vertex,
                                            float3 wi)
{
    const struct bsdf *bsdf = &vertex->bsdf;
    const bool is_plain = has_plain_facets(bsdf);
    struct scattering s;
    if (is_plain) {
        s = plain_facets_eval(bsdf, wi);
    } else {
        const struct lobe_value there = bsdf_eval_all(bsdf, wi);
        s.value = there.value;
        s.pdf_w = there.pdf_w;
        s.back_pdf_w = 0.0f;
    }
    if (!(s.pdf_w > 0.0f))
        return s;
    /* Where the BSDF is symmetric, flux has the lobes of radiance, but for what scales that. */
    const bool through = vertex_crosses(vertex, wi);
    if (through && bsdf->transport == CARRY_FLUX && !is_adjoint(bsdf))
        s.value *= 1.0f / square(bsdf->specular.eta);
    if (!is_plain)
        s.back_pdf_w = back_pdf_w(scene, vertex, wi);
    return s;
}

static inline struct scattering bidir_eval(const struct scene *scene, const struct vertex *vertex,
                                           float3 wi)
{
    return is_plain_lambert(&vertex->bsdf) ? plain_lambert_eval(&vertex->bsdf, wi)
                                           : mixture_eval(scene, vertex, wi);
}

/* The least cosine that partial weights divide by: along a light, or at a silhouette. */
#define RT_GRAZING 1e-6f

/*
 * |n.w| where a path begins or arrives, as partial weights divide by it and multiply with it again:
 * not so small that they become infinite. normal: geometric
 */
static inline float grazing_cosine(float3 w, float3 normal)
{
    return fmax(fabs(dot(w, normal)), RT_GRAZING);
}

/* ---- Scattering of a path -------------------------------------------------------- */

/* One event of a path, given survival. */
struct bidir_event {
    float3 wi;
    float3 weight;    /* as that of struct scatter */
    float eta_scale;  /* likewise */
    float cosine;     /* |n.wi|; of a delta event that of arrival */
    float pdf_w;      /* of all lobes; 0: a delta event */
    float back_pdf_w; /* of a delta event: its delta_ratio */
    bool through;
};

/* The probability of a delta event that goes along wi. */
static inline float delta_probability(const struct bsdf *bsdf, uint lobe, float3 wi)
{
    float probability = bsdf_probability(bsdf, lobe);
    if (is_adjoint(bsdf)) {
        const struct bsdf adjoint = *bsdf; /* a copy, as in make_bsdf */
        probability *= adjoint_delta_share(&adjoint, lobe, wi);
    }
    return probability;
}

/*
 * The density of a delta event on the way back over that on the way: the probabilities of its
 * choice, and the square of the relative index, by which refraction changes projected solid angles.
 */
static inline float delta_ratio(const struct scene *scene, const struct vertex *vertex, uint lobe,
                                float3 wi)
{
    const struct bsdf *bsdf = &vertex->bsdf;
    struct bsdf back;
    make_bsdf_back(&back, scene, vertex, wi);
    const bool through = vertex_crosses(vertex, wi);
    return delta_probability(&back, lobe, bsdf->wo) / delta_probability(bsdf, lobe, wi) *
           (through ? square(bsdf->specular.eta) : 1.0f);
}

/* Samples the chosen lobe by u in [0,1)^3. */
static inline struct bidir_event bidir_scatter(const struct scene *scene,
                                               const struct vertex *vertex, uint lobe, float3 u)
{
    const struct bsdf *bsdf = &vertex->bsdf;
    const struct scatter scatter = bsdf_scatter(bsdf, lobe, u);
    struct bidir_event event;
    event.wi = scatter.wi;
    event.weight = scatter.weight;
    event.eta_scale = scatter.eta_scale;
    event.cosine = fabs(dot(scatter.wi, vertex->bsdf.normal));
    event.pdf_w = 0.0f;
    event.through = scatter.through;
    if (!(largest3(event.weight) > 0.0f))
        return event;
    if (scatter.pdf_w == 0.0f) {
        event.cosine = grazing_cosine(bsdf->wo, vertex->bsdf.normal);
        event.back_pdf_w = delta_ratio(scene, vertex, lobe, event.wi);
        return event;
    }
    /* One lobe alone has the value and the density of all. */
    if (bsdf_lobes(bsdf) == 1u << lobe) {
        event.pdf_w = lobe_is_diffuse(lobe) ? bsdf_pdf_w(bsdf, event.wi) : scatter.pdf_w;
        event.back_pdf_w = back_pdf_w(scene, vertex, event.wi);
        return event;
    }
    const struct scattering s = bidir_eval(scene, vertex, event.wi);
    event.pdf_w = s.pdf_w;
    event.back_pdf_w = s.back_pdf_w;
    event.weight = s.value / (event.eta_scale * s.pdf_w);
    return event;
}

#endif
