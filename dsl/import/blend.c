/*
 * blend.c - blends of two materials, as other programs have them: by parts of the language's own
 * blend, or, where one of the two is nothing, by opacity.
 */
#include <math.h>
#include <string.h>

#include "dsl/import/import.h"

int rt_import_lets_light_through(const import_material *m)
{
    return m->kt[0] > 0 || m->kt[1] > 0 || m->kt[2] > 0 || m->kt_texture != IMPORT_NONE ||
           m->spec_trans > 0 || m->is_thin || m->has_glass;
}

int rt_import_is_solid(const import_material *m)
{
    return rt_import_lets_light_through(m) && !m->is_thin;
}

int rt_import_is_nothing(const import_material *m)
{
    return m->blend == IMPORT_NONE && m->kt[0] == 1 && m->kt[1] == 1 && m->kt[2] == 1 &&
           m->ior == 1 && m->fresnel == IMPORT_FRESNEL_OFF && !m->is_thin;
}

static int has_opacity(const import_material *m)
{
    return (m->opacity > 0 && m->opacity < 1) || m->opacity_texture != IMPORT_NONE;
}

int rt_import_is_pane(const import_material *m)
{
    const double *d = m->diffuse_transmission;
    return m->is_thin && !m->is_principled && m->blend == IMPORT_NONE && !has_opacity(m) &&
           d[0] == 0 && d[1] == 0 && d[2] == 0;
}

/* Whether two materials that let light through can be parts of one surface. */
static int same_inside(const import_material *a, const import_material *b)
{
    return !a->has_glass && !b->has_glass && a->ior == b->ior && a->fresnel == b->fresnel &&
           a->glass == b->glass && a->abbe == b->abbe && !a->is_thin == !b->is_thin &&
           memcmp(a->absorption, b->absorption, sizeof a->absorption) == 0;
}

/* A surface that is there for a part of the rays. */
static void blend_with_nothing(importer *import, int line, import_material *out,
                               const import_material *something, double weight, int texture,
                               int is_second)
{
    *out = *something;
    if (rt_import_lets_light_through(something) || has_opacity(something)) {
        rt_import_note_at(
            import, line,
            "a blend of nothing with glass, or with what has an opacity, is left out");
        return;
    }
    if (texture != IMPORT_NONE && !is_second) {
        rt_import_note_at(import, line, "a texture by which a surface is not there is left out");
        return;
    }
    out->opacity = fmax(is_second ? weight : 1 - weight, 1e-6);
    out->opacity_texture = texture;
}

/*
 * Takes opacities from parts to the blend: by weights, the second is met by w o2 / o of what is
 * met, with o = (1 - w) o1 + w o2.
 */
static void join_opacities(importer *import, int line, import_material *out, import_part parts[2],
                           double *weight, int weight_texture)
{
    import_material *a = &parts[0].material, *b = &parts[1].material;
    const double first = a->opacity > 0 ? a->opacity : 1, second = b->opacity > 0 ? b->opacity : 1;
    const int has_any = has_opacity(a) || has_opacity(b),
              is_textured = a->opacity_texture != IMPORT_NONE || b->opacity_texture != IMPORT_NONE,
              is_same = first == second && a->opacity_texture == b->opacity_texture &&
                        a->opacity_cutoff == b->opacity_cutoff;
    if (has_any && (rt_import_lets_light_through(a) || rt_import_lets_light_through(b) ||
                    (!is_same && (is_textured || weight_texture != IMPORT_NONE)))) {
        rt_import_note_at(import, line, "the opacities of a blend's two materials are left out");
    } else if (has_any && is_same) {
        out->opacity = first;
        out->opacity_texture = a->opacity_texture;
        out->opacity_cutoff = a->opacity_cutoff;
    } else if (has_any) {
        out->opacity = (1 - *weight) * first + *weight * second;
        *weight *= second / out->opacity;
    }
    for (int i = 0; i < 2; i++) {
        parts[i].material.opacity = parts[i].material.opacity_cutoff = 0;
        parts[i].material.opacity_texture = IMPORT_NONE;
    }
}

/* Takes maps that tilt normals from parts to the blend, which has them for both. */
static void join_maps(importer *import, int line, import_material *out, import_part parts[2])
{
    const import_material *a = &parts[0].material, *b = &parts[1].material;
    if (a->bump_texture == b->bump_texture && a->normal_texture == b->normal_texture &&
        a->bump_scale == b->bump_scale && a->normal_scale == b->normal_scale &&
        a->has_bump_shadows == b->has_bump_shadows) {
        out->has_bump_shadows = a->has_bump_shadows;
        out->bump_texture = a->bump_texture;
        out->bump_scale = a->bump_scale;
        out->normal_texture = a->normal_texture;
        out->normal_scale = a->normal_scale;
    } else {
        rt_import_note_at(import, line,
                          "bump and normal maps of one of the materials of a blend are left out");
    }
    for (int i = 0; i < 2; i++) {
        parts[i].material.bump_texture = parts[i].material.normal_texture = IMPORT_NONE;
        parts[i].material.has_bump_shadows = 0;
    }
}

static const double least = 1e-6; /* weight of the language: of less nothing is to be seen */

void rt_import_blend(importer *import, int line, import_material *out, const import_part parts[2],
                     double weight, int weight_texture)
{
    import_part own[2] = {parts[0], parts[1]};
    import_material *a = &own[0].material, *b = &own[1].material;
    if (weight_texture == IMPORT_NONE && (weight < least || weight >= 1)) {
        *out = weight < least ? *a : *b;
        return;
    }
    if (rt_import_is_nothing(a) || rt_import_is_nothing(b)) {
        blend_with_nothing(import, line, out, rt_import_is_nothing(a) ? b : a, weight,
                           weight_texture, rt_import_is_nothing(a));
        return;
    }
    if (rt_import_lets_light_through(a) && rt_import_lets_light_through(b) && !same_inside(a, b)) {
        rt_import_note_at(import, line, "a blend of two kinds of glass became one of them");
        *out = weight < 0.5 ? *a : *b;
        return;
    }
    *out = rt_import_material_begin();
    join_opacities(import, line, out, own, &weight, weight_texture);
    join_maps(import, line, out, own);
    if (a->back == b->back && a->back == IMPORT_BLACK) {
        out->back = IMPORT_BLACK;
        a->back = b->back = IMPORT_NONE;
    }
    out->has_glass = rt_import_lets_light_through(a) || rt_import_lets_light_through(b);
    out->weight = fmin(fmax(weight, least), 1);
    out->weight_texture = weight_texture;
    out->blend = rt_import_add_material(import, line, own[0].base, a);
    out->with = rt_import_add_material(import, line, own[1].base, b);
}
