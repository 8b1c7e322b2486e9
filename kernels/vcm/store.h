/*
 * store.h - the store of light vertices: 64 bytes each.
 *
 * What is short is packed by rounding to nearest, so that means stay what they are: directions to
 * 24 bits a coordinate of the octahedron, flux to 14 bits of mantissa and partial weights to 17.
 * Directions are good to 5e-7, little less than floats; with 16 bits, cosines at grazing angles
 * would be off by a part in a hundred, and weights with them, as other techniques have them
 * exactly. The position is exact. The BSDF is made again from the material, its colours from the
 * texture coordinates, or in meshes with such from the triangle and the weights of its corners. The
 * tangent of anisotropic facets is that of the shape there, for which triangles have their slot.
 *
 * References:
 *   Cigolle, Donow, Evangelakos, Mara, McGuire, Meyer: "A Survey of Efficient Representations for
 *     Independent Unit Vectors", JCGT 3(2), 2014 (the octahedron).
 */
#ifndef RT_KERNELS_VCM_STORE_H
#define RT_KERNELS_VCM_STORE_H

#include "surface/bidirectional.h"
#include "vcm/weights.h"

/* ---- Numbers in few bits --------------------------------------------------------- */

/* The upper bits of a float that is not negative, rounded to nearest; infinity and NaN stay. */
static inline uint upper_bits(float x, uint bits)
{
    const uint left_out = 31u - bits;
    const uint all = as_uint(x) & 0x7fffffffu;
    return min((all + (1u << left_out >> 1)) >> left_out, (1u << bits) - 1u);
}

/* The same, rounded up. */
static inline uint upper_bits_above(float x, uint bits)
{
    const uint left_out = 31u - bits;
    return ((as_uint(x) & 0x7fffffffu) + (1u << left_out) - 1u) >> left_out;
}

static inline float of_upper_bits(uint x, uint bits)
{
    return as_float(x << (31u - bits));
}

/* Four numbers of 24 bits in three words. */
static inline uint3 join24(uint4 x)
{
    return (x.xyz & 0xffffffu) | (uint3)(x.w, x.w >> 8, x.w >> 16) << 24;
}

static inline uint4 split24(uint3 x)
{
    const uint3 top = x >> 24;
    return (uint4)(x & 0xffffffu, top.x | top.y << 8 | top.z << 16);
}

#define RT_NORMAL_TURNED 0x80000000u /* flag in the second of them, which flux leaves free */

/* The flux in two words, 21 bits a channel: all of the exponent. */
static inline uint2 pack_flux(float3 flux)
{
    const uint r = upper_bits(flux.x, 21u), g = upper_bits(flux.y, 21u),
               b = upper_bits(flux.z, 21u);
    return (uint2)(r | g << 21, g >> 11 | b << 10);
}

static inline float3 unpack_flux(uint2 x)
{
    return (float3)(of_upper_bits(x.x & 0x1fffffu, 21u),
                    of_upper_bits(x.x >> 21 | (x.y & 0x3ffu) << 11, 21u),
                    of_upper_bits(x.y >> 10 & 0x1fffffu, 21u));
}

/* ---- Directions -------------------------------------------------------------------- */

#define RT_OCTAHEDRON_SCALE 8388607.0f

/* The outer triangles of the square that the octahedron is unfolded to, or these folded back. */
static inline float2 fold_octahedron(float2 p)
{
    return (1.0f - fabs(p.yx)) * select((float2)(-1.0f), (float2)(1.0f), p >= 0.0f);
}

/* A unit vector in twice 24 bits; those along an axis are exact. */
static inline uint2 pack_direction(float3 w)
{
    const float2 p = w.xy * (1.0f / (fabs(w.x) + fabs(w.y) + fabs(w.z)));
    const float2 at = w.z < 0.0f ? fold_octahedron(p) : p;
    return as_uint2(convert_int2_rte(clamp(at, -1.0f, 1.0f) * RT_OCTAHEDRON_SCALE) + 8388608);
}

static inline float3 unpack_direction(uint2 x)
{
    const float2 p = convert_float2(as_int2(x) - 8388608) / RT_OCTAHEDRON_SCALE;
    const float z = 1.0f - fabs(p.x) - fabs(p.y);
    return unit((float3)(z < 0.0f ? fold_octahedron(p) : p, z));
}

/* ---- Where on its shape a vertex lies ------------------------------------------------ */

/* Whether its colours are mixed from the corners of a triangle. */
static inline bool mixes_corners(global const rt_shape *shape)
{
    return (shape->flags & (RT_SHAPE_UV | RT_SHAPE_COLOUR)) != 0u;
}

/* Whether a vertex keeps its slot, from which its tangent follows. */
static inline bool keeps_slot(const struct scene *scene, global const rt_shape *shape)
{
    const uint anisotropic = RT_MATERIAL_ANISOTROPIC | RT_MATERIAL_PARTS_ANISOTROPIC;
    return has_flag(scene->materials + shape->material, anisotropic) && shape_has_blocks(shape);
}

static inline uint2 pack_place(const struct scene *scene, const struct surface *surface)
{
    global const rt_shape *shape = scene->shapes + surface->shape;
    const bool has_slot = keeps_slot(scene, shape);
    if (!has_slot && !mixes_corners(shape))
        return as_uint2((float2)(surface->u, surface->v));
    const uint2 w = convert_uint2_sat_rte(surface->weights * 65535.0f);
    return (uint2)(has_slot ? surface->slot : surface->triangle, w.x | w.y << 16);
}

/* The part of a surface that colours depend on. */
static inline void unpack_place(struct surface *surface, const struct scene *scene,
                                global const rt_shape *shape, uint2 place)
{
    const bool has_slot = keeps_slot(scene, shape);
    surface->slot = surface->shape | RT_SLOT_ANALYTIC;
    surface->u = as_float(place.x);
    surface->v = as_float(place.y);
    if (!has_slot && !mixes_corners(shape))
        return;
    surface->triangle = place.x;
    if (has_slot) {
        surface->slot = place.x;
        surface->triangle = triangle_of_slot(scene, shape, place.x);
    }
    surface->weights = (float2)(place.y & 0xffffu, place.y >> 16) * (1.0f / 65535.0f);
    mesh_parameters(surface, scene, shape);
}

/* ---- Vertices -------------------------------------------------------------------------- */

static inline uint stored_medium(uint medium)
{
    return medium & RT_STORED_MATERIALS;
}

static inline uint medium_of(uint word)
{
    const uint medium = word & RT_STORED_MATERIALS;
    return medium == RT_STORED_MATERIALS ? RT_NONE : medium;
}

/* Stores a vertex at this surface, and with it what its path is. */
static inline void store_vertex(global rt_light_vertex *out, const struct scene *scene,
                                const struct vertex *vertex, const struct surface *surface,
                                float3 flux, const struct partial_weights *partial, uint depth)
{
    const uint4 directions =
        (uint4)(pack_direction(vertex->bsdf.normal), pack_direction(vertex->bsdf.wo));
    const uint4 rest = (uint4)(pack_direction(vertex->params.shading),
                               upper_bits(partial->dVCM, 24u), upper_bits(partial->dVC, 24u));
    const bool is_turned = dot(vertex->bsdf.normal, surface->normal) < 0.0f;
    vstore3(vertex->position, 0, out->position);
    out->shape = surface->shape;
    vstore2(pack_flux(flux) | (uint2)(0u, is_turned ? RT_NORMAL_TURNED : 0u), 0, out->flux);
    vstore3(join24(directions), 0, out->normal_wo);
    vstore3(join24(rest), 0, out->shading_weights);
    out->media[0] = stored_medium(vertex->medium) | depth << 20;
    out->media[1] = stored_medium(vertex->behind) | upper_bits_above(vertex->error, 12u) << 20;
    vstore2(pack_place(scene, surface), 0, out->place);
}

/* Whether its normal is that of the surface turned over, to the side of wo. */
static inline bool stored_turned(global const rt_light_vertex *from)
{
    return (from->flux[1] & RT_NORMAL_TURNED) != 0u;
}

static inline uint stored_depth(global const rt_light_vertex *from)
{
    return from->media[0] >> 20;
}

static inline struct partial_weights stored_weights(global const rt_light_vertex *from)
{
    const uint4 rest = split24(vload3(0, from->shading_weights));
    struct partial_weights partial;
    partial.dVCM = of_upper_bits(rest.z, 24u);
    partial.dVC = of_upper_bits(rest.w, 24u);
    return partial;
}

/*
 * The geometric normal, and wo on its side: lifted to the least cosine that weights know, as
 * rounding could have taken it across.
 */
static inline float3 stored_normal(global const rt_light_vertex *from, float3 *wo)
{
    const uint4 directions = split24(vload3(0, from->normal_wo));
    const float3 normal = unpack_direction(directions.xy);
    *wo = unpack_direction(directions.zw);
    const float cosine = dot(*wo, normal);
    *wo += fmax(RT_GRAZING - cosine, 0.0f) * normal;
    return normal;
}

/*
 * The part of a material with parts that a stored vertex is met by. It need not be that which its
 * path went on with: they have the same probability.
 */
static inline uint stored_part(const struct scene *scene, global const rt_light_vertex *from,
                               const struct surface *surface, uint material)
{
    const uint3 directions = vload3(0, from->normal_wo);
    const uint4 chance = pcg4d((uint4)(as_uint3(row3(from->position)), from->shape));
    return part_at(scene->header, material, stored_turned(from), surface_place(scene, surface),
                   chance ^ (uint4)(directions, 2u));
}

#ifdef RT_DISPERSION
/*
 * Draws a wavelength of its own for a light vertex at a dispersive boundary, other than that by
 * which its path went on: a new label of the path that is joined there.
 */
static inline void draw_stored_wavelength(struct vertex *vertex, struct boundary *boundary,
                                          const struct scene *scene,
                                          global const rt_light_vertex *from)
{
    const uint here = vertex->medium, beyond = vertex->beyond.x;
    vertex->wavelength = 0.0f;
    vertex->drawn = (float3)(1.0f);
    if (!disperses(scene, vertex->material, here, beyond))
        return;
    const uint4 bits = pcg4d((uint4)(as_uint3(vertex->position), from->flux[0]));
    float run = 0.0f;
    vertex->drawn =
        meet_wavelength(&run, &vertex->wavelength, scene->materials + vertex->material,
                        unpack_flux(vload2(0, from->flux)), (float)(bits.x >> 8) * 0x1p-24f);
    disperse(boundary, scene, vertex->material, here, beyond, vertex->wavelength);
}
#endif

static inline void load_vertex(struct vertex *vertex, const struct scene *scene,
                               global const rt_light_vertex *from)
{
    global const rt_shape *shape = scene->shapes + from->shape;
    const uint4 rest = split24(vload3(0, from->shading_weights));
    float3 wo;
    vertex->position = row3(from->position);
    const float3 normal = stored_normal(from, &wo);
    vertex->error = of_upper_bits(from->media[1] >> 20, 12u);
    vertex->material = shape->material;
    vertex->lobes = 0u;
    vertex->medium = medium_of(from->media[0]);
    vertex->behind = medium_of(from->media[1]);
    vertex->beyond = (uint4)(vertex->behind, (uint3)(RT_NONE));
    struct surface surface;
    surface.shape = from->shape;
    surface.position = vertex->position;
    surface.normal = stored_turned(from) ? -normal : normal;
    if (UNLIKELY(has_parts(scene->materials + shape->material))) {
        unpack_place(&surface, scene, shape, vload2(0, from->place));
        vertex->material = stored_part(scene, from, &surface, shape->material);
    }
    global const rt_material_data *material = scene->materials + vertex->material;
    untextured_params(&vertex->params, material, unpack_direction(rest.xy));
    if ((shape->flags & RT_SHAPE_VARIED) || is_anisotropic(material)) {
        unpack_place(&surface, scene, shape, vload2(0, from->place));
        if (shape->flags & RT_SHAPE_VARIED)
            apply_textures(&vertex->params, scene, material, &surface);
        direct_facets(&vertex->params, scene, material, &surface);
    }
    UNDISPERSED struct boundary boundary =
        boundary_between(scene, vertex->material, vertex->medium, vertex->beyond.x);
    DISPERSED(draw_stored_wavelength(vertex, &boundary, scene, from));
    make_bsdf(&vertex->bsdf, &vertex->params, material, normal, wo, &boundary, (float3)(1.0f),
              CARRY_FLUX);
}

/* The flux of a loaded vertex, with what its own wavelength weighs. */
static inline float3 joined_flux(global const rt_light_vertex *from, const struct vertex *vertex)
{
    const float3 flux = unpack_flux(vload2(0, from->flux));
#ifdef RT_DISPERSION
    return flux * vertex->drawn;
#else
    return flux;
#endif
}

#endif
