/*
 * weights.h - the MIS weights of vertex connection and merging, from partial sums that light and
 * camera paths carry from vertex to vertex.
 *
 * A light path y_0 y_1 ... and a camera path z_0 z_1 ... make paths of light by several sampling
 * techniques. The weight of technique v is
 *
 *   w_v = 1 / (sum over the techniques i that are used of (p_i / p_v)^2)
 *
 * by the power heuristic. p_i: density of the path by technique i in the product of areas, times
 * its number of samples. The sum splits into what the light path and what the camera path
 * contribute, w_v = 1 / (w_light + 1 + w_camera), and either is made of two numbers of the last
 * vertex of its path:
 *
 *   dVCM   of the technique that leaves out the last vertex,
 *   dVC    of those that leave out more, relative to connections.
 *
 * They begin and go on as Georgiev's report has it, section 4; the functions below cite equations.
 * The third number of the report, dVM, is relative to merging: it begins as dVC / (n pi r^2)^2 and
 * goes on by the same factors and terms over that (eqs. 33 and 36), so that it stays dVC / (n pi
 * r^2)^2 and need not be carried. Two more things differ. Techniques may be left out: then their
 * terms are. And the density of a point on a light, when it is sampled from a vertex, depends on
 * that vertex, so that dVCM begins at the first vertex after the light. Delta events have one
 * direction each way: dVCM is 0 after them, and what remains is the ratio of their densities there
 * and back. Russian roulette is no part of the densities: it thins out the samples of all
 * techniques, and weights need not know.
 *
 * References:
 *   Georgiev, Krivanek, Davidovic, Slusallek: "Light Transport Simulation with Vertex Connection
 *     and Merging", SIGGRAPH Asia 2012.
 *   Georgiev: "Implementing Vertex Connection and Merging", technical report, Saarland University,
 *     2012.
 *   Hachisuka, Pantaleoni, Jensen: "A Path Space Extension for Robust Light Transport Simulation",
 *     SIGGRAPH Asia 2012.
 */
#ifndef RT_KERNELS_VCM_WEIGHTS_H
#define RT_KERNELS_VCM_WEIGHTS_H

#include "math/frame.h"
#include "types.h"

/* What a path carries for the weights at its last vertex. */
struct partial_weights {
    float dVCM, dVC;
};

/*
 * What is the same for all paths of an iteration. The partial weights are squares of areas, whose
 * fourth powers of lengths single precision holds for lengths within a few orders of magnitude of
 * their unit alone.
 */
struct technique_weights {
    uint techniques; /* RT_TECHNIQUE_*, */
    uint shown;      /* and those of them whose light is added */
    float light_paths;
    float area, per_area; /* of the square of the unit, m^2, and 1 over it */
    float merging;        /* (n pi r^2)^2 where merging is used, else 0 */
    float connecting;     /* 1 / (n pi r^2)^2 where merging is used, else 0 */
};

/* The power of the power heuristic. */
static inline float mis(float ratio)
{
    return ratio * ratio;
}

static inline struct technique_weights technique_weights_of(const rt_vcm_params *vcm)
{
    struct technique_weights all;
    const float radius = vcm->radius / vcm->unit;
    const float merged = (float)vcm->light_paths * RT_PI * radius * radius;
    const bool merges = (vcm->techniques & RT_TECHNIQUE_MERGING) && merged > 0.0f;
    all.techniques = vcm->techniques;
    all.shown = vcm->shown;
    all.light_paths = (float)vcm->light_paths;
    all.area = vcm->unit * vcm->unit;
    all.per_area = 1.0f / all.area;
    all.merging = merges ? mis(merged) : 0.0f;
    all.connecting = merges ? mis(1.0f / merged) : 0.0f;
    return all;
}

/* dVCM as far as its technique is used: at the first vertex of a path that is another one. */
static inline float used_dVCM(const struct technique_weights *all,
                              const struct partial_weights *partial, bool is_first, uint at_first)
{
    return all->techniques & (is_first ? at_first : RT_TECHNIQUE_CONNECTION) ? partial->dVCM : 0.0f;
}

/*
 * The first vertex of a light path (eqs. 31 to 33 and 34 to 36). direct_ratio: density of the start
 * by light sampling from the vertex over that by emission, both with the vertex, which the camera
 * path samples in the first case; 0: light sampling cannot find it. back: the cosine at the light
 * over the density of emission and the cosine at the vertex; 0: no ray can meet the light. Both are
 * areas, m^2.
 */
static inline struct partial_weights begin_light_weights(const struct technique_weights *all,
                                                         float direct_ratio, float back)
{
    struct partial_weights partial;
    partial.dVCM = mis(direct_ratio * all->per_area);
    partial.dVC = all->techniques & RT_TECHNIQUE_EMISSION ? mis(back * all->per_area) : 0.0f;
    return partial;
}

/* The first vertex of a camera path (eq. 31): pdf_a is its density over area, for a given pixel. */
static inline struct partial_weights begin_camera_weights(const struct technique_weights *all,
                                                          float pdf_a)
{
    struct partial_weights partial;
    partial.dVCM = mis(all->light_paths / (pdf_a * all->area));
    partial.dVC = 0.0f;
    return partial;
}

/* A path arrives at a vertex, at this distance and cosine (eqs. 34 to 36). */
static inline void arrive_weights(struct partial_weights *partial,
                                  const struct technique_weights *all, float distance, float cosine)
{
    const float inverse = mis(1.0f / cosine);
    partial->dVCM *= mis(distance * distance * all->per_area) * inverse;
    partial->dVC *= inverse;
}

/*
 * A path is scattered: cosine of the direction in which it goes on, density of that direction, and
 * of the direction back where the path is followed in reverse (eqs. 34 to 36). vcm_used:
 * used_dVCM of the vertex.
 */
static inline void scatter_weights(struct partial_weights *partial,
                                   const struct technique_weights *all, float vcm_used,
                                   float cosine, float pdf_w, float back_pdf_w)
{
    const float forward = mis(cosine / pdf_w), back = mis(back_pdf_w);
    partial->dVC = forward * (partial->dVC * back + vcm_used + all->merging);
    partial->dVCM = mis(1.0f / pdf_w);
}

/*
 * A delta event: cosine of the direction that the path came along, ratio of the density of the
 * event on the way back to that on the way. Both have one direction, in which projected solid
 * angles differ by the square of the relative index alone, so that the cosine of arrive_weights
 * goes out again.
 */
static inline void scatter_delta_weights(struct partial_weights *partial, float cosine, float ratio)
{
    const float factor = mis(cosine * ratio);
    partial->dVCM = 0.0f;
    partial->dVC *= factor;
}

/* A path goes straight on through a boundary that does not exist: it cannot be connected there. */
static inline void pass_weights(struct partial_weights *partial)
{
    partial->dVCM = 0.0f;
}

/*
 * What a path contributes to 1 / w where its vertex is connected (eqs. 37, 40, 44, 46): pdf_a is
 * the density with which the other path samples the vertex, back_pdf_w that of the direction from
 * there to the vertex before.
 */
static inline float connection_weight(const struct technique_weights *all, float vcm_used,
                                      float dVC, float pdf_a, float back_pdf_w)
{
    return mis(pdf_a * all->area) * (all->merging + vcm_used + dVC * mis(back_pdf_w));
}

/*
 * What a camera path contributes where it meets a light (eq. 43): direct_ratio is the density of
 * the point, seen from the vertex before, by light sampling over that of the path, emission_pdf
 * that of the light path that starts there.
 */
static inline float emission_weight(const struct technique_weights *all, float dVC,
                                    float direct_ratio, float emission_pdf)
{
    const float nee = all->techniques & RT_TECHNIQUE_NEE ? mis(direct_ratio) : 0.0f;
    return nee + mis(emission_pdf * all->area) * dVC;
}

/* What a path contributes where its vertex is merged (eqs. 38 and 39). */
static inline float merging_weight(const struct technique_weights *all, float vcm_used, float dVC,
                                   float back_pdf_w)
{
    return all->connecting * (vcm_used + dVC * mis(back_pdf_w));
}

#endif
