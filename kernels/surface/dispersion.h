/*
 * dispersion.h - the wavelength by which a path is refracted, in programs for scenes with
 * dispersive materials, which define RT_DISPERSION.
 *
 * A path has no wavelength until it meets a dispersive boundary, where one is drawn (wavelength.h)
 * and weighs its throughput. It is kept over a run of delta events, so that a prism refracts the
 * same light twice, and forgotten where the path is scattered by another event: from there on light
 * is three channels again. A vertex at a dispersive boundary that may scatter by other than delta
 * events has a wavelength of its own, for whatever technique makes or joins a path there.
 *
 * Wavelengths so are labels of a path, one for each run and each such vertex, as those of
 * parts.h: every technique draws each label once, with the mean 1 of weights, and MIS weights are
 * those of paths of the same labels.
 */
#ifndef RT_KERNELS_SURFACE_DISPERSION_H
#define RT_KERNELS_SURFACE_DISPERSION_H

#ifdef RT_DISPERSION
#define DISPERSED(statement) statement
#define UNDISPERSED /* written to in such programs, else constant */
#else
#define DISPERSED(statement)
#define UNDISPERSED const
#endif

#ifdef RT_DISPERSION
#include "bsdf/boundary.h"
#include "material/medium.h"
#include "sample/wavelength.h"
#include "scene.h"
#include "types.h"

static inline bool is_dispersive(const struct scene *scene, uint medium)
{
    return medium != RT_NONE && (scene->materials[medium].flags & RT_MATERIAL_DISPERSIVE) != 0u;
}

/* The index of a medium at a wavelength, micrometres: Cauchy's equation, or Sellmeier's. */
static inline float ior_at(const struct scene *scene, uint medium, float wavelength)
{
    if (medium == RT_NONE)
        return 1.0f;
    global const rt_material_data *material = scene->materials + medium;
    if (!(material->flags & RT_MATERIAL_DISPERSIVE))
        return material->ior;
    const float3 a = row3(material->eta), b = row3(material->k);
    const float squared = square(wavelength);
    if (material->flags & RT_MATERIAL_CAUCHY)
        return a.x + a.y / squared;
    const float3 terms = a * squared / (squared - b);
    return sqrt(1.0f + terms.x + terms.y + terms.z);
}

/* Whether what a boundary between two media does depends on the wavelength. */
static inline bool disperses(const struct scene *scene, uint material, uint here, uint beyond)
{
    return here != beyond && is_transparent(scene->materials + material) &&
           (is_dispersive(scene, here) || is_dispersive(scene, beyond));
}

/*
 * Gives a boundary of this material between two media its index at a wavelength; 0: none was drawn.
 */
static inline void disperse(struct boundary *boundary, const struct scene *scene, uint material,
                            uint here, uint beyond, float wavelength)
{
    if (!(wavelength > 0.0f))
        return;
    const bool relative = has_relative_ior(scene, material);
    boundary->eta = ior_at(scene, relative && here != material ? RT_NONE : here, wavelength) /
                    ior_at(scene, relative && beyond != material ? RT_NONE : beyond, wavelength);
}

/* Whether a vertex of this material has a wavelength of its own: delta lobes are not all it has. */
static inline bool has_own_wavelength(global const rt_material_data *material)
{
    const float3 diffuse = row3(material->kd) + row3(material->diffuse_transmission);
    return is_principled(material) || largest3(diffuse) > 0.0f || is_anisotropic(material) ||
           material->roughness >= RT_SMOOTH_ALPHA;
}

/*
 * The wavelength of a dispersive boundary of this material that a path of throughput beta meets;
 * *run: that of the path. Returns what it weighs where it is drawn, by u in [0,1).
 */
static inline float3 meet_wavelength(float *run, float *wavelength,
                                     global const rt_material_data *material, float3 beta, float u)
{
    const bool is_own = has_own_wavelength(material);
    *wavelength = is_own ? 0.0f : *run;
    float3 weight = (float3)(1.0f);
    if (*wavelength == 0.0f && largest3(beta) > 0.0f) {
        const struct wavelength drawn = sample_wavelength(beta, u);
        *wavelength = drawn.length;
        weight = drawn.weight;
    }
    *run = is_own ? 0.0f : *wavelength;
    return weight;
}
#endif

#endif
