/* materials.c - materials, textures and the environment's image. */
#include <math.h>
#include <string.h>

#include "bsdf/lobes.h"
#include "pack/packing.h"
#include "scene/check.h"
#include "scene/environment.h"
#include "scene/inside.h"
#include "scene/parts.h"

static const double pi = 3.14159265358979323846;

/* A handle of the public interface as an index. */
static rt_u32 texture_index(uint32_t handle)
{
    return handle ? handle - 1 : RT_NONE;
}

static int is_anisotropic(const rt_material *m)
{
    return (m->roughness_v > 0 && rt_material_is_specular(m)) || m->anisotropic > 0;
}

static int is_translucent(const rt_material *m)
{
    return !rt_is_black(m->diffuse_transmission);
}

static rt_u32 dispersion_flags(const rt_material *m)
{
    if (!rt_material_is_dispersive(m))
        return 0;
    return RT_MATERIAL_DISPERSIVE | (rt_is_black(m->sellmeier_b) ? RT_MATERIAL_CAUCHY : 0);
}

/* A principled material's facets are so without a word. */
static int has_separable_facets(const rt_material *m)
{
    return m->facet_scattering == RT_FACET_SCATTERING_SEPARABLE && !rt_material_is_principled(m);
}

/* What lies behind a material one of whose parts transmits is what lies behind that. */
static rt_u32 material_flags(const rt_scene *scene, const rt_material *m)
{
    const rt_u32 parts = !rt_material_has_parts(m) ? 0
                         : rt_material_any(scene, m, RT_SIDE_BOTH, is_anisotropic)
                             ? RT_MATERIAL_PARTS | RT_MATERIAL_PARTS_ANISOTROPIC
                             : RT_MATERIAL_PARTS;
    return parts | (m->fresnel == RT_FRESNEL_DIELECTRIC ? RT_MATERIAL_FRESNEL : 0) |
           (rt_material_is_conductor(m) ? RT_MATERIAL_CONDUCTOR : 0) |
           (m->fresnel == RT_FRESNEL_SCHLICK ? RT_MATERIAL_SCHLICK : 0) |
           (m->two_sided ? RT_MATERIAL_TWO_SIDED : 0) | (m->interface ? RT_MATERIAL_INTERFACE : 0) |
           (m->exponent > 0 ? RT_MATERIAL_PHONG : 0) | (m->coat > 0 ? RT_MATERIAL_COAT : 0) |
           (rt_material_is_lacquer(m) ? RT_MATERIAL_LACQUER : 0) |
           (m->coat_linear ? RT_MATERIAL_LINEAR : 0) | (m->thin ? RT_MATERIAL_THIN : 0) |
           (has_separable_facets(m) ? RT_MATERIAL_SEPARABLE : 0) |
           (rt_material_is_filled(m) ? RT_MATERIAL_FILLED : 0) |
           (m->relative_ior ? RT_MATERIAL_RELATIVE : 0) |
           (rt_material_any(scene, m, RT_SIDE_BOTH, is_translucent) ? RT_MATERIAL_TRANSLUCENT : 0) |
           (m->distribution == RT_DISTRIBUTION_BECKMANN ? RT_MATERIAL_BECKMANN : 0) |
           (is_anisotropic(m) ? RT_MATERIAL_ANISOTROPIC : 0) | dispersion_flags(m) |
           (rt_material_is_principled(m) ? RT_MATERIAL_PRINCIPLED : 0);
}

#define PACK_COLOUR(name) memcpy(out->name, m->name, sizeof out->name);
#define PACK_NUMBER(name) out->name = m->name;
#define PACK(TYPE, name, RANGE, NEED, unit, help)                                                  \
    PACK_##TYPE(name) out->name##_texture = texture_index(m->name##_texture);

static void pack_normals(rt_material_data *out, const rt_material *m)
{
    out->bump_scale = m->bump_scale;
    out->bump_texture = texture_index(m->bump_texture);
    out->normal_scale[0] = m->normal_scale;
    out->normal_scale[1] = m->normal_flip ? -m->normal_scale : m->normal_scale;
    out->normal_texture = texture_index(m->normal_texture);
    out->flags &= ~RT_MATERIAL_SHADOWED;
    if (m->bump_shadowing && rt_material_has_bumps(m))
        out->flags |= RT_MATERIAL_SHADOWED;
}

/* A dispersive material is no conductor, so eta and k are left for its terms. */
static void pack_index(rt_material_data *out, const rt_material *m)
{
    const int is_dispersive = rt_material_is_dispersive(m);
    const int is_cauchy = rt_is_black(m->sellmeier_b);
    memcpy(out->eta, is_dispersive ? m->sellmeier_b : m->eta, sizeof out->eta);
    memcpy(out->k, is_dispersive ? m->sellmeier_c : m->k, sizeof out->k);
    if (is_dispersive && is_cauchy)
        memcpy(out->eta, m->cauchy, sizeof m->cauchy);
    out->ior = rt_material_inner_ior(m);
}

static void pack_material(rt_material_data *out, const rt_scene *scene, const rt_material *m)
{
    RT_SURFACE_INPUTS(PACK)
    RT_PRINCIPLED_NUMBERS(PACK)
    pack_index(out, m);
    memcpy(out->absorption, m->absorption, sizeof out->absorption);
    out->coat_ior = rt_material_is_filled(m) ? m->ior : m->coat_ior;
    out->exponent = m->exponent;
    out->priority = (rt_u32)m->priority;
    out->flags = material_flags(scene, m);
    out->diffuse_lobe = rt_material_diffuse_lobe(m);
    pack_normals(out, m);
    out->opacity = m->opacity;
    out->opacity_texture = texture_index(m->opacity_texture);
    out->opacity_cutoff = m->opacity_cutoff;
    const double turn = fmod(m->anisotropy_rotation, 360) * pi / 180;
    out->facet_turn[0] = (float)cos(turn);
    out->facet_turn[1] = (float)sin(turn);
    out->back = out->blend[0] = out->blend[1] = RT_NONE;
    out->weight = m->weight;
    out->weight_texture = texture_index(m->weight_texture);
}

/* ---- Parts ----------------------------------------------------------------------- */

static int has_facets(const rt_material *m)
{
    return rt_material_is_rough(m) && rt_material_is_specular(m);
}

static rt_u32 lobes_on(const rt_scene *scene, const rt_material *m, unsigned side)
{
    return (rt_material_any(scene, m, side, rt_material_is_diffuse) ? RT_PARTS_DIFFUSE : 0) |
           (rt_material_any(scene, m, side, has_facets) ? RT_PARTS_ROUGH : 0);
}

/* The distance from a row to the losses of the facets of this part, which are packed; 0: none. */
static rt_u32 losses_from(const rt_material_data *table, size_t row, uint32_t part)
{
    const size_t own = part - 1;
    if (part == RT_MATERIAL_BLACK || table[own].facet_losses == 0)
        return 0;
    return table[own].facet_losses - (rt_u32)((row - own) * sizeof *table);
}

/*
 * Packs the parts of a material into the rows from *next on, and their parts; normals: the material
 * that tilts shading normals, which is the whole of a blend.
 */
static void pack_parts(rt_material_data *row, rt_material_data *table, size_t *next,
                       const rt_scene *scene, const rt_material *m, const rt_material *normals)
{
    const uint32_t parts[] = {m->back, m->blend, m->with};
    rt_u32 *const rows[] = {&row->back, &row->blend[0], &row->blend[1]};
    for (int i = 0; i < 3; i++) {
        if (!parts[i])
            continue;
        const rt_material *part = rt_material_part(scene, parts[i]);
        const rt_material *own = i == 0 ? part : normals;
        const size_t index = (*next)++;
        *rows[i] = (rt_u32)index;
        pack_material(table + index, scene, part);
        pack_normals(table + index, own);
        table[index].medium = row->medium;
        table[index].facet_losses = losses_from(table, index, parts[i]);
        pack_parts(table + index, table, next, scene, part, own);
    }
    row->lobes_of_parts = lobes_on(scene, m, RT_SIDE_FRONT) | lobes_on(scene, m, RT_SIDE_BACK)
                                                                  << RT_PARTS_BACK;
}

size_t rt_materials_rows(const rt_scene *scene)
{
    size_t rows = scene->material_count;
    for (size_t i = 0; i < scene->material_count; i++)
        rows += rt_material_part_rows(scene, scene->materials + i);
    return rows;
}

void rt_pack_materials(const rt_packing *p)
{
    rt_material_data *table = rt_packing_table(p, p->header.materials);
    for (size_t i = 0; i < p->scene->material_count; i++) {
        pack_material(table + i, p->scene, p->scene->materials + i);
        table[i].medium = (rt_u32)i;
    }
}

int rt_materials_are_plain(const rt_packing *p)
{
    const rt_material_data *table = rt_packing_table(p, p->header.materials);
    for (size_t i = 0; i < p->scene->shape_count; i++) {
        const rt_material_data *row = table + p->scene->shapes[i].material;
        if (row->flags & RT_MATERIAL_NOT_PLAIN || row->diffuse_lobe != RT_LOBE_LAMBERT)
            return 0;
    }
    return 1;
}

void rt_pack_parts(const rt_packing *p)
{
    rt_material_data *table = rt_packing_table(p, p->header.materials);
    size_t next = p->scene->material_count;
    for (size_t i = 0; i < p->scene->material_count; i++) {
        const rt_material *m = p->scene->materials + i;
        if (rt_material_has_parts(m))
            pack_parts(table + i, table, &next, p->scene, m, m);
    }
}

static void pack_grids_of(rt_medium_data *out, const rt_scene *scene, uint32_t density,
                          uint32_t albedo)
{
    out->grid = density;
    out->albedo = albedo;
    out->is_coloured = density && scene->grids[density - 1].size[3] == 3;
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
        pack_grids_of(out, p->scene, m->density, m->albedo);
    }
    memcpy(out->absorption, p->scene->medium.absorption, sizeof out->absorption);
    memcpy(out->scattering, p->scene->medium.scattering, sizeof out->scattering);
    out->g = p->scene->medium.g;
    pack_grids_of(out, p->scene, p->scene->medium.density, p->scene->medium.albedo);
}

void rt_pack_textures(const rt_packing *p)
{
    const rt_scene *const scene = p->scene;
    rt_texture_data *out = rt_packing_table(p, p->header.textures);
    for (size_t i = 0; i < scene->texture_count; i++) {
        out[i] = scene->textures[i].data;
        if (out[i].kind == RT_TEXTURE_NESTED)
            out[i].texels += (rt_u32)(scene->texture_count - i);
    }
    if (scene->texture_row_count)
        memcpy(out + scene->texture_count, scene->texture_rows,
               scene->texture_row_count * sizeof *out);
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
