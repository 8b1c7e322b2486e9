/* parts.c - materials made of others: what they are made of, and which can be parts. */
#include "scene/parts.h"

#include <string.h>

#include "base/error.h"
#include "scene/check.h"
#include "scene/inside.h"

static const rt_material black = {.ior = 1.5f, .coat_ior = 1.5f, .opacity = 1};

/* ---- What a material is made of ------------------------------------------------- */

int rt_material_has_parts(const rt_material *m)
{
    return m->blend || m->back;
}

int rt_material_has_bumps(const rt_material *m)
{
    return m->bump_texture || m->normal_texture;
}

const rt_material *rt_material_part(const rt_scene *scene, uint32_t part)
{
    return part == RT_MATERIAL_BLACK ? &black : scene->materials + part - 1;
}

static void add_leaves(const rt_scene *scene, const rt_material *m, unsigned sides,
                       const rt_material *leaves[RT_PARTS_MOST], size_t *count)
{
    if (m->back && (sides & RT_SIDE_BACK)) {
        add_leaves(scene, rt_material_part(scene, m->back), RT_SIDE_FRONT, leaves, count);
        sides &= ~RT_SIDE_BACK;
    }
    if (sides && m->blend) {
        add_leaves(scene, rt_material_part(scene, m->blend), sides, leaves, count);
        add_leaves(scene, rt_material_part(scene, m->with), sides, leaves, count);
    } else if (sides && *count < RT_PARTS_MOST) {
        leaves[(*count)++] = m;
    }
}

size_t rt_material_leaves(const rt_scene *scene, const rt_material *m, unsigned sides,
                          const rt_material *leaves[RT_PARTS_MOST])
{
    size_t count = 0;
    add_leaves(scene, m, sides, leaves, &count);
    return count;
}

int rt_material_any(const rt_scene *scene, const rt_material *m, unsigned sides,
                    int (*holds)(const rt_material *leaf))
{
    const rt_material *leaves[RT_PARTS_MOST];
    const size_t count = rt_material_leaves(scene, m, sides, leaves);
    for (size_t i = 0; i < count; i++)
        if (holds(leaves[i]))
            return 1;
    return 0;
}

#define INPUT_TEXTURE(TYPE, name, RANGE, NEED, unit, help) m->name##_texture,
void rt_material_textures(const rt_scene *scene, const rt_material *m,
                          void (*found)(void *user, uint32_t handle), void *user)
{
    const uint32_t textures[] = {RT_SURFACE_INPUTS(INPUT_TEXTURE)
                                     RT_PRINCIPLED_INPUTS(INPUT_TEXTURE)
                                         RT_PRINCIPLED_NUMBERS(INPUT_TEXTURE) m->bump_texture,
                                 m->normal_texture, m->opacity_texture, m->weight_texture};
    const uint32_t parts[] = {m->back, m->blend, m->with};
    for (size_t i = 0; i < sizeof textures / sizeof *textures; i++)
        if (textures[i])
            found(user, textures[i]);
    for (int i = 0; i < 3; i++)
        if (parts[i])
            rt_material_textures(scene, rt_material_part(scene, parts[i]), found, user);
}

int rt_parts_vary(const rt_scene *scene, const rt_material *m)
{
    const uint32_t parts[] = {m->back, m->blend, m->with};
    int varies = m->blend && m->weight_texture;
    for (int i = 0; i < 3 && !varies; i++)
        varies = parts[i] && rt_parts_vary(scene, rt_material_part(scene, parts[i]));
    return varies;
}

size_t rt_material_part_rows(const rt_scene *scene, const rt_material *m)
{
    const uint32_t parts[] = {m->back, m->blend, m->with};
    size_t rows = 0;
    for (int i = 0; i < 3; i++)
        if (parts[i])
            rows += 1 + rt_material_part_rows(scene, rt_material_part(scene, parts[i]));
    return rows;
}

/* ---- What can be a part --------------------------------------------------------- */

static int lets_light_through(const rt_material *m)
{
    return !rt_material_is_opaque(m);
}

/* Whether a part is a material that was added before, and can be one. */
static rt_status check_part(const rt_scene *scene, uint32_t part, const char *field,
                            const char *who, rt_error *error)
{
    if (!part || part == RT_MATERIAL_BLACK)
        return RT_OK;
    if (part > scene->material_count)
        return rt_fail_field(error, RT_ERROR_INPUT, field, "%s: there is no material %u among %zu",
                             who, part - 1, scene->material_count);
    const rt_material *m = rt_material_part(scene, part);
    const char *what = !rt_is_black(m->emission)              ? "emission"
                       : m->opacity < 1 || m->opacity_texture ? "an opacity"
                                                              : NULL;
    if (m->interface)
        return rt_fail_field(error, RT_ERROR_INPUT, field,
                             "%s: an interface has no surface to be a part of another", who);
    if (what)
        return rt_fail_field(error, RT_ERROR_INPUT, field,
                             "%s: a part of it has %s: give that to the whole material instead",
                             who, what);
    return RT_OK;
}

/* The first member that is given and that a blend leaves to its parts, or NULL. */
static const char *member_of_parts(const rt_material *m)
{
    if (m->metal || m->glass)
        return m->metal ? "metal" : "glass";
    RT_SURFACE_INPUTS(RT_GIVEN_INPUT)
    return rt_principled_member(m)       ? rt_principled_member(m)
           : m->exponent != 0            ? "exponent"
           : m->fresnel                  ? "fresnel"
           : m->ior != 0                 ? "ior"
           : m->relative_ior             ? "relative_ior"
           : rt_dispersion_member(m)     ? rt_dispersion_member(m)
           : m->thin                     ? "thin"
           : m->interface                ? "interface"
           : !rt_is_black(m->absorption) ? "absorption"
           : !rt_is_black(m->scattering) ? "scattering"
           : m->density                  ? "density"
           : m->albedo                   ? "albedo"
           : m->priority                 ? "priority"
                                         : NULL;
}

/* The lobes and the inside of a blend are those of its parts. */
static rt_status check_blend(const rt_scene *scene, rt_material *m, const char *who,
                             rt_error *error)
{
    const char *field = member_of_parts(m);
    if (field)
        return rt_fail_field(error, RT_ERROR_INPUT, field,
                             "%s: a blend has no %s of its own: give it to its parts", who, field);
    if (m->weight == 0)
        m->weight = m->weight_texture ? 1 : 0.5f;
    if (!(m->weight > 0 && m->weight <= 1))
        return rt_fail_field(error, RT_ERROR_INPUT, "weight",
                             "%s: weight is %g; it must lie above 0, and be at most 1", who,
                             m->weight);
    return rt_texture_check_number(scene, m->weight, m->weight_texture, 1, who, "weight_texture",
                                   error);
}

/* ---- The boundary of a blend ------------------------------------------------------ */

static int same_colour(const float a[3], const float b[3])
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

static int same_dispersion(const rt_material *a, const rt_material *b)
{
    return memcmp(a->cauchy, b->cauchy, sizeof a->cauchy) == 0 &&
           same_colour(a->sellmeier_b, b->sellmeier_b) &&
           same_colour(a->sellmeier_c, b->sellmeier_c);
}

/* What two solids differ in, or NULL. */
static const char *difference(const rt_material *a, const rt_material *b)
{
    return a->ior != b->ior                             ? "ior"
           : a->relative_ior != b->relative_ior         ? "relative_ior"
           : !same_dispersion(a, b)                     ? "dispersion"
           : a->fresnel != b->fresnel                   ? "fresnel"
           : !same_colour(a->absorption, b->absorption) ? "absorption"
           : !same_colour(a->scattering, b->scattering) ? "scattering"
           : a->g != b->g                               ? "g"
           : a->density != b->density                   ? "density"
           : a->albedo != b->albedo                     ? "albedo"
           : a->priority != b->priority                 ? "priority"
                                                        : NULL;
}

/* Takes the boundary and the inside of a part that lets light in. */
static void take_inside(rt_material *m, const rt_material *solid)
{
    memcpy(m->ks, solid->ks, sizeof m->ks);
    memcpy(m->kt, solid->kt, sizeof m->kt);
    memcpy(m->absorption, solid->absorption, sizeof m->absorption);
    memcpy(m->scattering, solid->scattering, sizeof m->scattering);
    m->fresnel = solid->fresnel;
    m->ior = solid->ior;
    m->relative_ior = solid->relative_ior;
    memcpy(m->cauchy, solid->cauchy, sizeof m->cauchy);
    memcpy(m->sellmeier_b, solid->sellmeier_b, sizeof m->sellmeier_b);
    memcpy(m->sellmeier_c, solid->sellmeier_c, sizeof m->sellmeier_c);
    m->g = solid->g;
    m->density = solid->density;
    m->albedo = solid->albedo;
    m->priority = solid->priority;
}

/* Finds the boundary: that of all solids among the parts; a sheet where all of them are sheets. */
static rt_status find_boundary(const rt_scene *scene, rt_material *m, const char *who,
                               rt_error *error)
{
    const rt_material *leaves[RT_PARTS_MOST], *solid = NULL;
    const size_t count = rt_material_leaves(scene, m, RT_SIDE_BOTH, leaves);
    size_t sheets = 0;
    for (size_t i = 0; i < count; i++) {
        sheets += leaves[i]->thin != 0;
        if (!rt_material_is_transparent(leaves[i]))
            continue;
        const char *unlike = solid ? difference(solid, leaves[i]) : NULL;
        if (unlike)
            return rt_fail_field(error, RT_ERROR_INPUT, "with",
                                 "%s: its parts bound solids of another %s: a blend has one inside",
                                 who, unlike);
        solid = leaves[i];
    }
    if (solid && sheets > 0)
        return rt_fail_field(error, RT_ERROR_INPUT, "with", "%s: %s", who,
                             solid->thin ? "a part of it is a thin sheet around a medium: sheets "
                                           "of blends are hollow"
                                         : "a part of it is a thin sheet, another bounds a solid");
    m->thin = sheets == count;
    if (solid)
        take_inside(m, solid);
    return RT_OK;
}

/* ---- Completing --------------------------------------------------------------------- */

rt_status rt_parts_check_back(const rt_scene *scene, const rt_material *m, const char *who,
                              rt_error *error)
{
    if (!m->back || !rt_material_any(scene, m, RT_SIDE_BOTH, lets_light_through))
        return RT_OK;
    return rt_fail_field(error, RT_ERROR_INPUT, "back",
                         "%s: what lets light through is the same on both sides: back goes with "
                         "opaque materials alone",
                         who);
}

static rt_status check_counts(const rt_scene *scene, const rt_material *m, const char *who,
                              rt_error *error)
{
    if (m->blend && !m->with)
        return rt_fail_field(error, RT_ERROR_INPUT, "blend",
                             "%s: a blend is one of two materials: it needs with", who);
    if (m->with && !m->blend)
        return rt_fail_field(error, RT_ERROR_INPUT, "with", "%s: with goes with blend", who);
    if (rt_material_part_rows(scene, m) > RT_PARTS_MOST)
        return rt_fail_field(error, RT_ERROR_INPUT, m->blend ? "blend" : "back",
                             "%s: it is made of more than %d materials", who, RT_PARTS_MOST);
    return RT_OK;
}

/* Photons, which stand for light on all parts of a blend, know one shading normal. */
static rt_status check_bumps(const rt_scene *scene, const rt_material *m, const char *who,
                             rt_error *error)
{
    const uint32_t parts[] = {m->blend, m->with};
    for (int i = 0; i < 2 && m->blend; i++) {
        const rt_material *part = rt_material_part(scene, parts[i]);
        if (rt_material_has_bumps(part) ||
            rt_material_any(scene, part, RT_SIDE_BOTH, rt_material_has_bumps))
            return rt_fail_field(error, RT_ERROR_INPUT, i ? "with" : "blend",
                                 "%s: a part of it has a bump or normal map: give that to the "
                                 "whole blend instead",
                                 who);
    }
    return RT_OK;
}

rt_status rt_parts_complete(const rt_scene *scene, rt_material *m, const char *who, rt_error *error)
{
    rt_status status;
    if ((status = rt_texture_check_colours(scene, m->weight_texture, who, "weight_texture",
                                           error)) != RT_OK ||
        (status = check_part(scene, m->blend, "blend", who, error)) != RT_OK ||
        (status = check_part(scene, m->with, "with", who, error)) != RT_OK ||
        (status = check_part(scene, m->back, "back", who, error)) != RT_OK ||
        (status = check_counts(scene, m, who, error)) != RT_OK)
        return status;
    if (!m->blend)
        return RT_OK;
    if ((status = check_blend(scene, m, who, error)) != RT_OK ||
        (status = check_bumps(scene, m, who, error)) != RT_OK)
        return status;
    return find_boundary(scene, m, who, error);
}
