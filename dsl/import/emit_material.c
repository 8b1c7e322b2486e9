/* emit_material.c - blocks of the new scene: textures, grids and materials. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "dsl/import/import.h"

/* The value, or 0 where it is but rounding of values of this size. */
static double without_rounding(double value, double size)
{
    return fabs(value) < 1e-9 * fabs(size) ? 0 : value;
}

/* The matrix as a rotation times an upper triangular one, by the rotation that makes it so. */
void rt_import_texture_map(import_texture *texture, double m[2][3])
{
    const double length = hypot(m[0][0], m[1][0]);
    const int is_turned = without_rounding(m[1][0], length) != 0;
    const double c = is_turned ? m[0][0] / length : 1, s = is_turned ? m[1][0] / length : 0;
    const double scale[2] = {is_turned ? length : m[0][0], c * m[1][1] - s * m[0][1]};
    texture->rotate = is_turned ? atan2(s, c) * 180 / IMPORT_PI : 0;
    texture->shear = without_rounding(c * m[0][1] + s * m[1][1], hypot(m[0][1], m[1][1]));
    for (int i = 0; i < 2; i++) {
        texture->scale[i] = scale[i] != 0 ? scale[i] : 1;
        texture->offset[i] = m[i][2];
    }
}

import_material rt_import_material_begin(void)
{
#define NO_TEXTURE(TYPE, name, RANGE, NEED, unit, help) material.name##_texture = IMPORT_NONE;
    import_material material;
    memset(&material, 0, sizeof material);
    RT_MATERIAL_INPUTS(NO_TEXTURE)
    material.bump_texture = material.normal_texture = material.opacity_texture = IMPORT_NONE;
    material.blend = material.with = material.back = material.weight_texture = IMPORT_NONE;
    material.density = material.albedo = IMPORT_NONE;
    return material;
}

/* A direction without roughness has the least that the language knows, which is nearly smooth. */
void rt_import_set_alphas(import_material *material, double u, double v)
{
    const double least = 1e-3;
    material->roughness = u;
    material->roughness_v = 0;
    if (u != v) {
        material->roughness = u > least ? u : least;
        material->roughness_v = v > least ? v : least;
    }
}

/* An index as the tables have it, in decimals, which single precision is near to. */
static double to_decimal(float index)
{
    return round(1e5 * index) / 1e5;
}

double rt_import_ior(rt_glass glass)
{
    return to_decimal(rt_glass_ior(glass));
}

int rt_import_metal(const char *name, double eta[3], double k[3])
{
    float singles[2][3];
    if (!rt_metal_index(rt_metal_find(name), singles[0], singles[1]))
        return 0;
    for (int c = 0; c < 3; c++) {
        eta[c] = to_decimal(singles[0][c]);
        k[c] = to_decimal(singles[1][c]);
    }
    return 1;
}

/* Bounds indices of refraction to what the language takes; 0 is what it has without one. */
static void bound_indices(importer *import, int line, import_material *m)
{
    const double coat_ior = m->coat_ior, ior = m->ior;
    m->coat_ior = coat_ior > 3 ? 3 : coat_ior > 0 && coat_ior < 1 ? 1 : coat_ior;
    m->ior = ior < 0 ? 1.5 : ior > 0 ? fmin(fmax(ior, 0.1), 10) : 0;
    if (m->coat > 0 && m->coat_ior != coat_ior)
        rt_import_note_at(import, line, "a coat of index %g became one of %g", coat_ior,
                          m->coat_ior);
    if (m->ior != ior)
        rt_import_note_at(import, line, "an index of refraction of %g became %g", ior, m->ior);
}

/*
 * Bounds kd, ks, kt, diffuse_transmission and the roughness to what the language takes, and scales
 * the colours down where they scatter more than comes in.
 */
static void conserve_energy(importer *import, int line, import_material *m)
{
    double *const alphas[] = {&m->roughness, &m->roughness_v, &m->coat_roughness};
    const int textures[] = {m->kd_texture, m->ks_texture, m->kt_texture,
                            m->diffuse_transmission_texture};
    double excess = 1;
    int is_below = 0, is_above = 0;
    for (int i = 0; i < 3; i++) {
        is_below |= *alphas[i] < 0;
        is_above |= *alphas[i] > 1;
        *alphas[i] = fmin(fmax(*alphas[i], 0), 1);
    }
    for (int c = 0; c < 3; c++) {
        double *parts[] = {&m->kd[c], &m->ks[c], &m->kt[c], &m->diffuse_transmission[c]}, sum = 0;
        for (int i = 0; i < 4; i++) {
            is_below |= *parts[i] < 0;
            is_above |= *parts[i] > 1 + 1e-6;
            *parts[i] = *parts[i] < 0 ? 0 : *parts[i] > 1 ? 1 : *parts[i];
            sum += *parts[i] * fmax(rt_import_texture_most(import, textures[i]), 1);
        }
        excess = sum > excess ? sum : excess;
    }
    if (is_below)
        rt_import_note_at(import, line,
                          "a negative reflectance, transmittance or roughness became 0");
    if (is_above)
        rt_import_note_at(import, line,
                          "a reflectance, transmittance or roughness above 1 became 1");
    if (excess > 1 + 1e-6)
        rt_import_note_at(import, line,
                          "a material reflects and transmits more light than it gets: scaled down");
    for (int c = 0; c < 3 && excess > 1; c++) {
        m->kd[c] /= excess;
        m->ks[c] /= excess;
        m->kt[c] /= excess;
        m->diffuse_transmission[c] /= excess;
    }
}

static void bound_within(importer *import, int line, const char *name, double *number, double least,
                         double most)
{
    const double given = *number;
    *number = fmin(fmax(given, least), most);
    if (*number != given)
        rt_import_note_at(import, line, "a %s of %g became %g", name, given, *number);
}

static void bound(importer *import, int line, const char *name, double *number, double most)
{
    bound_within(import, line, name, number, 0, most);
}

/* The same of a principled material, which a black base_color alone would not make one. */
#define BOUND(TYPE, name, RANGE, NEED, unit, help)                                                 \
    bound(import, line, #name, &m->name, RT_MOST_##RANGE);
static void bound_principled(importer *import, int line, import_material *m)
{
    int is_out = 0;
    for (int c = 0; c < 3; c++) {
        const double given = m->base_color[c],
                     most = 1 / fmax(rt_import_texture_most(import, m->base_color_texture), 1);
        m->base_color[c] = fmin(fmax(given, 0), most);
        is_out |= m->base_color[c] != given;
    }
    bound(import, line, "metallic", &m->metallic, 1);
    bound(import, line, "spec_trans", &m->spec_trans, 1);
    RT_PRINCIPLED_NUMBERS(BOUND)
    if (is_out)
        rt_import_note_at(import, line,
                          "a base colour beyond 0 to 1, its texture included, was bounded to it");
    if (rt_import_is_black(m->base_color))
        m->base_color[0] = m->base_color[1] = m->base_color[2] = 1e-6;
}

static void bound_material(importer *import, int line, import_material *m)
{
    bound_indices(import, line, m);
    conserve_energy(import, line, m);
    bound_within(import, line, "scale of a bump map", &m->bump_scale, -IMPORT_COORDINATE_MAX,
                 IMPORT_COORDINATE_MAX);
    bound_within(import, line, "scale of a normal map", &m->normal_scale, -IMPORT_COORDINATE_MAX,
                 IMPORT_COORDINATE_MAX);
    if (m->is_principled)
        bound_principled(import, line, m);
}

void rt_import_put_texture(importer *import, import_text *out, const char *field, int handle)
{
    if (handle != IMPORT_NONE)
        rt_import_put(import, out, " %s %s", field, rt_import_label(import, handle));
}

/* The value of an input, and its texture where it is not zero. */
#define PUT_COLOUR(name)                                                                           \
    if (rt_import_put_colour(import, line, out, #name, m.name))                                    \
        rt_import_put_texture(import, out, #name "_texture", m.name##_texture);
#define PUT_NUMBER(name)                                                                           \
    if (m.name > 0) {                                                                              \
        rt_import_put_field(import, out, #name, &m.name, 1);                                       \
        rt_import_put_texture(import, out, #name "_texture", m.name##_texture);                    \
    }
#define PUT_INPUT(TYPE, name, RANGE, NEED, unit, help) PUT_##TYPE(name)
#define IS_TEXTURED(TYPE, name, RANGE, NEED, unit, help) || m->name##_texture != IMPORT_NONE

/* A map that tilts shading normals, and its scale. */
static void put_map(importer *import, import_text *out, const char *field, int texture,
                    const char *scale_field, double scale)
{
    rt_import_put_texture(import, out, field, texture);
    if (texture != IMPORT_NONE && scale != 0 && scale != 1)
        rt_import_put_field(import, out, scale_field, &scale, 1);
}

/*
 * A + B sin tan, of (Oren and Nayar 1994), without interreflection, is 1 + r sin tan but for a
 * factor, which is how roughness r goes into the lobe of the language.
 */
void rt_import_make_rough(importer *import, int line, double deviation, import_material *m)
{
    const double s2 = deviation * deviation, a = 1 - 0.5 * s2 / (s2 + 0.33),
                 b = 0.45 * s2 / (s2 + 0.09);
    if (!(s2 > 0))
        return;
    m->is_rough_diffuse = 1;
    m->roughness = fmin(b / a, 1);
    rt_import_note_at(import, line,
                      "a rough diffuse surface keeps all light, of which Oren and Nayar's loses up "
                      "to %.2g %%",
                      100 * (1 - a));
}

/* What its microfacets have beside their roughness. */
static void put_facets(importer *import, import_text *out, const import_material *m)
{
    const int loses_light = m->roughness > 0 && !m->is_principled && !m->is_rough_diffuse &&
                            m->coat == 0 && !m->scatters_often;
    if (loses_light || m->is_coat_single)
        rt_import_put(import, out, " facet_scattering %s",
                      m->is_separable ? "separable" : "single");
    if (m->is_beckmann && fmax(m->coat_roughness, m->roughness) > 0)
        rt_import_put(import, out, " distribution beckmann");
    if ((m->roughness_v > 0 || m->anisotropic > 0) && m->anisotropy_rotation != 0)
        rt_import_put_field(import, out, "anisotropy_rotation", &m->anisotropy_rotation, 1);
}

/* The medium inside. */
static void put_inside(importer *import, int line, import_text *out, const import_material *m)
{
    if (m->is_interface)
        rt_import_put(import, out, " interface true");
    const int absorbs = rt_import_put_colour(import, line, out, "absorption", m->absorption),
              scatters = rt_import_put_colour(import, line, out, "scattering", m->scattering);
    if (scatters && m->g != 0)
        rt_import_put_field(import, out, "g", &m->g, 1);
    if ((absorbs || scatters) && m->density != IMPORT_NONE)
        rt_import_put(import, out, " density %s", rt_import_label(import, m->density));
    if (scatters && m->albedo != IMPORT_NONE)
        rt_import_put(import, out, " albedo %s", rt_import_label(import, m->albedo));
}

void rt_import_add_medium(importer *import, int line, const import_material *medium)
{
    rt_import_put(import, &import->definitions, "medium {");
    put_inside(import, line, &import->definitions, medium);
    rt_import_put(import, &import->definitions, " }\n");
}

int rt_import_takes_medium(importer *import, int line, import_material *material)
{
    if (material->is_thin && !rt_import_is_pane(material)) {
        rt_import_note_at(import, line,
                          "the medium inside of a thin sheet is left out, as the "
                          "sheet is not clear all over");
        return 0;
    }
    if (material->blend != IMPORT_NONE) {
        rt_import_note_at(import, line, "the medium inside of a blend of materials is left out");
        return 0;
    }
    if (!rt_import_lets_light_through(material)) {
        rt_import_note_at(import, line, "the medium inside of an opaque surface is left out");
        return 0;
    }
    if (rt_import_is_nothing(material)) {
        material->is_interface = 1;
        material->kt[0] = material->kt[1] = material->kt[2] = 0;
    }
    return 1;
}

/* The materials that it is made of. */
static void put_parts(importer *import, import_text *out, const import_material *m)
{
    if (m->blend != IMPORT_NONE) {
        rt_import_put(import, out, " blend %s", rt_import_label(import, m->blend));
        rt_import_put(import, out, " with %s", rt_import_label(import, m->with));
        if (m->weight_texture == IMPORT_NONE || m->weight != 1)
            rt_import_put_field(import, out, "weight", &m->weight, 1);
        rt_import_put_texture(import, out, "weight_texture", m->weight_texture);
    }
    if (m->back != IMPORT_NONE)
        rt_import_put(import, out, " back %s",
                      m->back == IMPORT_BLACK ? "black" : rt_import_label(import, m->back));
}

/* Whether a part has a texture, or a direction of roughness. */
static int is_marked(const importer *import, int handle, int is_direction)
{
    if (handle < 0)
        return 0;
    const import_label_entry *label = &import->labels[handle];
    return is_direction ? label->is_anisotropic : label->is_textured;
}

static int has_marked_part(const importer *import, const import_material *m, int is_direction)
{
    return is_marked(import, m->blend, is_direction) || is_marked(import, m->with, is_direction) ||
           is_marked(import, m->back, is_direction);
}

/* Whether its base colour, or that of a part, is another than kd. */
static int hides_colours(const importer *import, const import_material *m)
{
    const int parts[2] = {m->blend, m->with};
    int hides =
        m->fresnel == IMPORT_FRESNEL_SCHLICK || m->is_principled || !rt_import_is_black(m->kt);
    for (int i = 0; i < 2; i++)
        hides |= parts[i] >= 0 && (size_t)parts[i] < import->label_count &&
                 import->labels[parts[i]].hides_colours;
    return hides;
}

void rt_import_note_colours(importer *import, int line, int material, const import_mesh *mesh)
{
    size_t i = 0;
    while (mesh->colours && i < 3 * mesh->vertex_count && mesh->colours[i] == 1)
        i++;
    if (mesh->colours && i < 3 * mesh->vertex_count && material >= 0 &&
        (size_t)material < import->label_count && import->labels[material].hides_colours)
        rt_import_note_at(import, line,
                          "colours of vertices are left out on metal, glass and sheen: they "
                          "multiply what is diffuse");
}

static void put_normals(importer *import, import_text *out, const import_material *m)
{
    put_map(import, out, "normal_texture", m->normal_texture, "normal_scale", m->normal_scale);
    put_map(import, out, "bump_texture", m->bump_texture, "bump_scale", m->bump_scale);
    if (m->has_bump_shadows && (m->bump_texture != IMPORT_NONE || m->normal_texture != IMPORT_NONE))
        rt_import_put(import, out, " bump_shadowing true");
}

/* Says what the shapes of a material must have for it. */
static void mark_label(const importer *import, import_label_entry *label, const import_material *m)
{
    label->is_anisotropic =
        m->roughness_v > 0 || m->anisotropic > 0 || has_marked_part(import, m, 1);
    label->is_solid = rt_import_is_solid(m);
    label->hides_colours = hides_colours(import, m);
    label->colours = m->colours;
    label->ramp = m->ramp;
    label->is_textured = has_marked_part(import, m, 0) || m->weight_texture != IMPORT_NONE ||
                         m->normal_texture != IMPORT_NONE || m->opacity_texture != IMPORT_NONE ||
                         m->bump_texture != IMPORT_NONE RT_SURFACE_INPUTS(IS_TEXTURED)
                                                RT_PRINCIPLED_INPUTS(IS_TEXTURED)
                                                    RT_PRINCIPLED_NUMBERS(IS_TEXTURED);
}

/*
 * Leaves room for `relative_ior true`, which is known to matter once all shapes are: where another
 * lies in a solid, or may.
 */
static const char relative[] = "relative_ior true";

static void put_relative(importer *import, import_text *out, const import_material *m)
{
    const int has_index = m->fresnel == IMPORT_FRESNEL_DIELECTRIC ||
                          m->fresnel == IMPORT_FRESNEL_CONDUCTOR || m->coat > 0 ||
                          m->is_principled || (!m->is_interface && rt_import_is_solid(m));
    if (import->is_relative && has_index && m->blend == IMPORT_NONE)
        rt_import_put(import, out, " \1%*s", (int)strlen(relative) - 1, "");
}

static void put_index(importer *import, import_text *out, const import_material *m)
{
    const int has_index =
        m->is_principled || !rt_import_is_black(m->kt) || m->fresnel == IMPORT_FRESNEL_DIELECTRIC;
    if (m->ior > 0 && has_index && m->fresnel < IMPORT_FRESNEL_CONDUCTOR && !m->glass)
        rt_import_put_field(import, out, "ior", &m->ior, 1);
    put_relative(import, out, m);
    if (m->abbe > 0)
        rt_import_put_field(import, out, "abbe", &m->abbe, 1);
}

void rt_import_settle_relative(importer *import)
{
    const int matters = import->solid_count > 0 && import->shape_count > 1;
    char *at = import->definitions.text ? strchr(import->definitions.text, 1) : NULL;
    for (; at; at = strchr(at, 1))
        memcpy(at, matters ? relative : " ", matters ? strlen(relative) : 1);
}

static const char *glass_word(rt_glass glass)
{
    static const rt_word words[] = {RT_GLASSES(RT_WORD) RT_WORD_END};
    const rt_word *word = words;
    while (word->name && word->value != (int)glass)
        word++;
    return word->name ? word->name : "";
}

int rt_import_add_material(importer *import, int line, const char *base,
                           const import_material *material)
{
    import_text *out = &import->definitions;
    import_material m = *material;
    int handle = rt_import_name(import, base);
    bound_material(import, line, &m);
    const int is_specular =
        !rt_import_is_black(m.ks) || !rt_import_is_black(m.kt) || m.is_principled;
    m.roughness = is_specular || m.is_rough_diffuse ? m.roughness : 0;
    m.roughness_v = is_specular ? m.roughness_v : 0;
    rt_import_put(import, out, "material %s {", rt_import_label(import, handle));
    RT_MATERIAL_INPUTS(PUT_INPUT)
    if (m.fresnel == IMPORT_FRESNEL_CONDUCTOR) {
        rt_import_put(import, out, " fresnel conductor");
        rt_import_put_field(import, out, "eta", m.eta, 3);
        rt_import_put_field(import, out, "k", m.k, 3);
    } else if (m.fresnel == IMPORT_FRESNEL_SCHLICK && !rt_import_is_black(m.ks)) {
        rt_import_put(import, out, " fresnel schlick");
    } else if (m.glass) {
        rt_import_put(import, out, " glass %s dispersion true", glass_word(m.glass));
    } else if (m.fresnel == IMPORT_FRESNEL_DIELECTRIC && is_specular) {
        rt_import_put(import, out, " fresnel dielectric");
    }
    put_index(import, out, &m);
    if (m.coat > 0 && m.coat_ior > 0)
        rt_import_put_field(import, out, "coat_ior", &m.coat_ior, 1);
    if (m.coat > 0 && m.is_coat_linear)
        rt_import_put(import, out, " coat_linear true");
    if (m.is_thin)
        rt_import_put(import, out, " thin true");
    put_facets(import, out, &m);
    if (m.opacity > 0 && m.opacity < 1)
        rt_import_put_field(import, out, "opacity", &m.opacity, 1);
    rt_import_put_texture(import, out, "opacity_texture", m.opacity_texture);
    if (m.opacity_texture != IMPORT_NONE && m.opacity_cutoff > 0)
        rt_import_put_field(import, out, "opacity_cutoff", &m.opacity_cutoff, 1);
    put_normals(import, out, &m);
    if (m.is_interface || (is_specular && (!m.is_principled || m.spec_trans > 0)))
        put_inside(import, line, out, &m);
    put_parts(import, out, &m);
    if (m.is_two_sided)
        rt_import_put(import, out, " two_sided true");
    rt_import_put(import, out, " }\n");
    for (int c = 0; c < 3; c++)
        import->has_light |= m.emission[c] > 0;
    if (handle != IMPORT_NONE)
        mark_label(import, &import->labels[handle], &m);
    return handle;
}

int rt_import_add_grid(importer *import, const char *base, const char *file, const char *layer,
                       const matrix *to_world, int repeats)
{
    import_text *out = &import->definitions;
    const int handle = rt_import_name(import, base);
    rt_import_put(import, out, "grid %s { file \"%s\"", rt_import_label(import, handle), file);
    if (layer)
        rt_import_put(import, out, " layer \"%s\"", layer);
    if (!rt_matrix_is_identity(to_world))
        rt_import_put_field(import, out, "matrix", to_world->m[0], 12);
    rt_import_put(import, out, repeats ? " wrap repeat }\n" : " }\n");
    return handle;
}

import_colours rt_import_colours_of(const importer *import, int material)
{
    return material < 0 || (size_t)material >= import->label_count
               ? IMPORT_COLOURS_NONE
               : import->labels[material].colours;
}

import_ramp rt_import_ramp_of(const importer *import, int material)
{
    const import_ramp none = {.weight = NULL};
    return material < 0 || (size_t)material >= import->label_count ? none
                                                                   : import->labels[material].ramp;
}

int rt_import_has_directions(const importer *import, int material)
{
    return is_marked(import, material, 0) || is_marked(import, material, 1);
}

void rt_import_note_uv(importer *import, int line, int material, const char *shape)
{
    if (material < 0 || (size_t)material >= import->label_count)
        return;
    if (import->labels[material].is_textured)
        rt_import_note_at(import, line, "a texture lies otherwise on a %s", shape);
    if (import->labels[material].is_anisotropic)
        rt_import_note_at(import, line, "the directions of roughness are others on a %s", shape);
}
