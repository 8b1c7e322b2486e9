/* bsdf_draw.h - scattering events of one surface of one material, for the tests of materials. */
#ifndef RT_TESTS_KERNELS_BSDF_DRAW_H
#define RT_TESTS_KERNELS_BSDF_DRAW_H

#include <stdint.h>

#include "bsdf/lobes.h"
#include "types.h"

/* As enum transport of bsdf.h. */
enum { carry_radiance, carry_flux };

/* What a path chooses: a lobe, or to be absorbed. */
enum {
    diffuse = RT_LOBE_LAMBERT,
    reflected = RT_LOBE_SPECULAR_REFLECTION,
    refracted = RT_LOBE_SPECULAR_TRANSMISSION,
    rough = RT_LOBE_GGX,
    absorbed = RT_LOBE_NONE,
    event_count
};

/* Whether an event is the choice of a lobe that photons are gathered by. */
int is_diffuse(int event);

/* How a path meets the surface; eta: index on the side of wo over that on the other. */
typedef struct situation {
    float normal[4], shading[4];
    float wo[3], eta;
    float beta[3], survival;
} situation;

/* w: unit, of this height, and this part of a turn about the normal. */
void direction_at(float w[4], double z, double turn);

/* Seen along wo, a surface that faces up, from a medium of this index. */
situation situation_along(const float wo[4], float eta);

/* The i-th of directions that are spread evenly over the hemisphere, by the golden ratio. */
void spread_pair(float wo[4], float wi[4], int i);

/* An event; eval and eval_pdf_w: light and density of its lobe at wi. */
typedef struct bsdf_draw {
    float wi[3], event;
    float weight[3], eta_scale; /* over survival */
    float eval[3], eval_pdf_w;
    float albedo[3], pdf_w;
} bsdf_draw;

/* What an event makes of the direction, alone. */
typedef struct bsdf_event {
    float wi[3], pdf_w;
    float event, unused[3];
} bsdf_event;

/* Light and densities of all lobes at a direction. */
typedef struct bsdf_value {
    float diffuse[3], diffuse_pdf_w;
    float rough[3], rough_pdf_w;
} bsdf_value;

/*
 * What a situation keeps of the light: mean and mean square over samples, and the most that one
 * keeps.
 */
typedef struct bsdf_albedo {
    float mean[3], most;
    float square[3], unused;
} bsdf_albedo;

/* A sample of one lobe by itself, and what its other functions say of it. */
typedef struct lobe_draw {
    float wi[3], pdf_w;
    float weight[3], through;
    float eval[3], eval_pdf_w;
    float albedo[3], pdf_w_alone;
} lobe_draw;

/* Fills out[count] with samples of a lobe. */
void draw_lobe(const rt_material_data *material, const situation *at, uint32_t lobe, uint32_t seed,
               uint32_t count, lobe_draw *out);

/* Fills out[count] with light and density of a lobe: what each wo gets from each wi. */
void evaluate_lobe(const rt_material_data *material, const situation *at, const float (*wi)[4],
                   uint32_t lobe, uint32_t count, float (*out)[4]);

/* Fill out[count] with events. */
void draw_scatter(const rt_material_data *material, const situation *at, uint32_t transport,
                  uint32_t seed, uint32_t count, bsdf_draw *out);
void draw_events(const rt_material_data *material, const situation *at, uint32_t seed,
                 uint32_t count, bsdf_event *out);

/* An event at a vertex of mode vcm, and value and density of all lobes at its direction. */
typedef struct vertex_draw {
    float weight[3], lobe; /* lobe: -1 where the path is absorbed */
    float value[3], pdf_w;
} vertex_draw;

/* Fills out[count] with events at a vertex that is opaque, outside of all solids. */
void draw_vertex_scatter(const rt_material_data *material, const situation *at, uint32_t transport,
                         uint32_t seed, uint32_t count, vertex_draw *out);

/* Light from l to c at a vertex of mode vcm, as a path from each end has it. */
typedef struct both_ways {
    float radiance[3], pdf_l; /* per projected solid angle; density of l */
    float flux[3], pdf_c;
    float back_pdf_c, back_pdf_l; /* as the path of the other end has them */
    float cosine_c, cosine_l;
} both_ways;

/* Fills out[count] for random c and l; outside of the surface is nothing. */
void draw_both_ways(const rt_material_data *material, const situation *at, uint32_t seed,
                    uint32_t count, both_ways *out);

/* A delta event of a camera path, and the light path that comes along it the other way. */
typedef struct delta_draw {
    float wi[3], ratio; /* of the density on the way back to that on the way; -1: no event */
    float c[3], light_ratio;
} delta_draw;

/* Fills out[count] for random directions c above a mirror. */
void draw_delta_ratios(const rt_material_data *material, const situation *at, uint32_t seed,
                       uint32_t count, delta_draw *out);

/* A direction, what comes of it, and how both are weighted. */
typedef struct exchange_draw {
    float wo[3], weight;
    float wi[3], mismatch; /* of the weight and eval, relative */
} exchange_draw;

/*
 * Fills out[count] with events from all directions, whose weights are of one channel, with respect
 * to the cosine of wo to the normal; at->eta: index above the surface over that below.
 */
void draw_exchange(const rt_material_data *material, const situation *at, uint32_t transport,
                   uint32_t seed, uint32_t count, exchange_draw *out);

/* Fills out[count] with what each wo of the situations gets from each wi. */
void evaluate_scatter(const rt_material_data *material, const situation *at, const float (*wi)[4],
                      uint32_t count, bsdf_value *out);

/* Fills out[count] with what each of the situations keeps. */
void measure_albedo(const rt_material_data *material, const situation *at, uint32_t samples,
                    uint32_t count, bsdf_albedo *out);

#endif
