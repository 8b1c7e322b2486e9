/* materials.c - materials, textures and the environment's image. */
#include <math.h>
#include <string.h>

#include "pack/packing.h"
#include "scene/check.h"
#include "scene/environment.h"

static const double pi = 3.14159265358979323846;

/* A handle of the public interface as an index. */
static rt_u32 texture_index(uint32_t handle)
{
    return handle ? handle - 1 : RT_NONE;
}

static rt_u32 material_flags(const rt_material *m)
{
    return (m->fresnel == RT_FRESNEL_DIELECTRIC ? RT_MATERIAL_FRESNEL : 0) |
           (m->fresnel == RT_FRESNEL_CONDUCTOR ? RT_MATERIAL_CONDUCTOR : 0) |
           (m->two_sided ? RT_MATERIAL_TWO_SIDED : 0) | (m->interface ? RT_MATERIAL_INTERFACE : 0) |
           (m->exponent > 0 ? RT_MATERIAL_PHONG : 0) | (m->coat > 0 ? RT_MATERIAL_COAT : 0) |
           (m->coat_linear ? RT_MATERIAL_LINEAR : 0) | (m->thin ? RT_MATERIAL_THIN : 0) |
           (rt_is_black(m->diffuse_transmission) ? 0 : RT_MATERIAL_TRANSLUCENT) |
           (m->distribution == RT_DISTRIBUTION_BECKMANN ? RT_MATERIAL_BECKMANN : 0) |
           (m->roughness_v > 0 && rt_material_is_specular(m) ? RT_MATERIAL_ANISOTROPIC : 0);
}

#define PACK_COLOUR(name) memcpy(out->name, m->name, sizeof out->name);
#define PACK_NUMBER(name) out->name = m->name;
#define PACK(TYPE, name, RANGE, unit, help)                                                        \
    PACK_##TYPE(name) out->name##_texture = texture_index(m->name##_texture);

void rt_pack_materials(const rt_packing *p)
{
    rt_material_data *out = rt_packing_table(p, p->header.materials);
    for (size_t i = 0; i < p->scene->material_count; i++, out++) {
        const rt_material *m = p->scene->materials + i;
        RT_SURFACE_INPUTS(PACK)
        memcpy(out->eta, m->eta, sizeof out->eta);
        memcpy(out->k, m->k, sizeof out->k);
        memcpy(out->absorption, m->absorption, sizeof out->absorption);
        out->ior = m->ior;
        out->coat_ior = m->coat_ior;
        out->exponent = m->exponent;
        out->bump_scale = m->bump_scale;
        out->priority = (rt_u32)m->priority;
        out->flags = material_flags(m);
        out->diffuse_lobe = rt_material_diffuse_lobe(m);
        out->bump_texture = texture_index(m->bump_texture);
        out->normal_scale[0] = m->normal_scale;
        out->normal_scale[1] = m->normal_flip ? -m->normal_scale : m->normal_scale;
        out->normal_texture = texture_index(m->normal_texture);
        out->opacity = m->opacity;
        out->opacity_texture = texture_index(m->opacity_texture);
        out->opacity_cutoff = m->opacity_cutoff;
        const double turn = fmod(m->anisotropy_rotation, 360) * pi / 180;
        out->facet_turn[0] = (float)cos(turn);
        out->facet_turn[1] = (float)sin(turn);
    }
}

void rt_pack_media(const rt_packing *p)
{
    rt_medium_data *out = rt_packing_table(p, p->header.media);
    if (!p->header.media)
        return;
    for (size_t i = 0; i < p->scene->material_count; i++, out++) {
        const rt_material *m = p->scene->materials + i;
        memcpy(out->absorption, m->absorption, sizeof out->absorption);
        memcpy(out->scattering, m->scattering, sizeof out->scattering);
        out->g = m->g;
        out->grid = m->density;
    }
    memcpy(out->absorption, p->scene->medium.absorption, sizeof out->absorption);
    memcpy(out->scattering, p->scene->medium.scattering, sizeof out->scattering);
    out->g = p->scene->medium.g;
    out->grid = p->scene->medium.density;
}

void rt_pack_textures(const rt_packing *p)
{
    rt_texture_data *out = rt_packing_table(p, p->header.textures);
    for (size_t i = 0; i < p->scene->texture_count; i++)
        out[i] = p->scene->textures[i].data;
    if (p->scene->texels.size)
        memcpy(rt_packing_table(p, p->header.texels), p->scene->texels.data, p->scene->texels.size);
}

void rt_pack_environment(rt_packing *p)
{
    const rt_scene_environment *from = &p->scene->environment;
    rt_environment_data *e = &p->header.environment;
    rt_environment_data *above = &p->header.compensated;
    if (!from->texels)
        return;
    memcpy(rt_packing_table(p, e->texels), from->texels,
           (size_t)from->width * from->height * 4 * sizeof(float));
    e->mean = (float)rt_environment_tabulate(rt_packing_table(p, e->conditional),
                                             rt_packing_table(p, e->marginal), from->texels,
                                             from->width, from->height, 0);
    const double floor = ((double)from->mean[0] + from->mean[1] + from->mean[2]) / 3;
    above->mean = (float)rt_environment_tabulate(rt_packing_table(p, above->conditional),
                                                 rt_packing_table(p, above->marginal), from->texels,
                                                 from->width, from->height, floor);
}
