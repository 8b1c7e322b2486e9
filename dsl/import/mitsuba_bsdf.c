/* mitsuba_bsdf.c - the materials of Mitsuba 3. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "dsl/import/mitsuba.h"

static const char *type_of(mitsuba *m, xml_node *node)
{
    return rt_mitsuba_text(m, node, "type");
}

/* ---- Values ------------------------------------------------------------------ */

double rt_mitsuba_ior(mitsuba *m, xml_node *node, const char *name, double fallback)
{
    static const struct {
        const char *name;
        double ior;
    } iors[] = {{"vacuum", 1},
                {"air", 1.000277},
                {"water", 1.3330},
                {"water ice", 1.31},
                {"bk7", 1.5046},
                {"diamond", 2.419},
                {"fused quartz", 1.458},
                {"pyrex", 1.470},
                {"acrylic glass", 1.49},
                {"polypropylene", 1.49},
                {"sodium chloride", 1.544},
                {"amber", 1.55},
                {"acetone", 1.36},
                {"ethanol", 1.361},
                {"glycerol", 1.4729},
                {"benzene", 1.501},
                {"silicone oil", 1.52045},
                {"pet", 1.5750}};
    const char *word = rt_mitsuba_string(m, node, name);
    if (!word) {
        const double ior = rt_mitsuba_number(m, node, name, fallback);
        if (ior > 0)
            return ior;
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "an index of refraction of %g became %g", ior, fallback);
        return fallback;
    }
    for (size_t i = 0; i < sizeof iors / sizeof *iors; i++)
        if (strcasecmp(iors[i].name, word) == 0)
            return iors[i].ior;
    rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                      "the material '%.40s' became one of index %g", word, fallback);
    return fallback;
}

/* A number of a rough surface, or a texture of it, and 1. */
static double read_alpha(mitsuba *m, xml_node *node, const char *name, double fallback,
                         int *texture)
{
    const double alpha = rt_mitsuba_number(m, node, name, fallback);
    xml_node *child = rt_mitsuba_child(node, name);
    if (child && strcmp(child->tag, "float") != 0 && strcmp(child->tag, "integer") != 0) {
        double constant[3] = {fallback, fallback, fallback};
        *texture = rt_mitsuba_number_texture(m, node, name, constant);
        return constant[0];
    }
    if (alpha < 0)
        rt_import_note_at(rt_mitsuba_at(m, node), node->line, "a negative %.40s became 0", name);
    return alpha > 0 ? alpha : 0;
}

/* The distribution of microfacets, Beckmann's by default, and alpha in all directions. */
static double read_distribution(mitsuba *m, xml_node *node, import_material *out, int *texture)
{
    const char *distribution = rt_mitsuba_string(m, node, "distribution");
    out->is_beckmann = !distribution || strcmp(distribution, "ggx") != 0;
    if (distribution && out->is_beckmann && strcmp(distribution, "beckmann") != 0)
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "the distribution '%.40s' of microfacets became Beckmann's",
                          distribution);
    out->is_separable = 1;
    return read_alpha(m, node, "alpha", 0.1, texture);
}

/* On a disk Mitsuba's u goes from the centre outwards, ours around. */
static void turn_anisotropy(const mitsuba *m, import_material *out)
{
    if (m->uv == MITSUBA_UV_DISK || m->uv == MITSUBA_UV_DISK_TURNED)
        out->anisotropy_rotation = 90;
}

/* The microfacets of ks or kt, which may be rougher along v than along u. */
static void read_facets(mitsuba *m, xml_node *node, import_material *out)
{
    int texture = IMPORT_NONE, texture_v;
    const double alpha = read_distribution(m, node, out, &texture);
    texture_v = texture;
    const double u = read_alpha(m, node, "alpha_u", alpha, &texture),
                 v = read_alpha(m, node, "alpha_v", alpha, &texture_v);
    rt_import_set_alphas(out, u, v);
    out->roughness_texture = texture;
    if (texture != texture_v && out->roughness_v == 0)
        out->roughness_v = v;
    if (out->roughness_v > 0)
        out->roughness_v_texture = texture_v;
    turn_anisotropy(m, out);
}

static int is_rough(const char *type)
{
    return strncmp(type, "rough", 5) == 0;
}

/* ---- Materials --------------------------------------------------------------- */

static void read_conductor(mitsuba *m, xml_node *node, import_material *out)
{
    const char *name = rt_mitsuba_string(m, node, "material");
    for (int c = 0; c < 3; c++)
        out->ks[c] = 1;
    out->ks_texture = rt_mitsuba_texture(m, node, "specular_reflectance", out->ks);
    if (is_rough(type_of(m, node)))
        read_facets(m, node, out);
    int has_eta = rt_mitsuba_colour(m, node, "eta", out->eta);
    if (rt_mitsuba_colour(m, node, "k", out->k) || has_eta) {
        out->fresnel = IMPORT_FRESNEL_CONDUCTOR;
    } else if (name ? strcmp(name, "none") != 0 : m->is_old) {
        name = name ? name : "Cu"; /* as Mitsuba 0.x has it */
        out->fresnel = IMPORT_FRESNEL_CONDUCTOR;
        if (!rt_mitsuba_metal(name, out->eta, out->k)) {
            rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                              "the metal '%.40s' became aluminium", name);
            rt_mitsuba_metal("Al", out->eta, out->k);
        }
    }
    double outside = rt_mitsuba_ior(m, node, "ext_eta", 1);
    for (int c = 0; c < 3 && outside > 0; c++) {
        out->eta[c] /= outside;
        out->k[c] /= outside;
    }
}

static void read_dielectric(mitsuba *m, xml_node *node, import_material *out)
{
    const char *type = type_of(m, node);
    double inside = rt_mitsuba_ior(m, node, "int_ior", 1.5046),
           outside = rt_mitsuba_ior(m, node, "ext_ior", 1.000277), reflected[3] = {1, 1, 1};
    for (int c = 0; c < 3; c++)
        out->kt[c] = 1;
    out->kt_texture = rt_mitsuba_texture(m, node, "specular_transmittance", out->kt);
    rt_mitsuba_texture(m, node, "specular_reflectance", reflected);
    if (memcmp(reflected, out->kt, sizeof reflected) != 0)
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "a dielectric reflects the colour that it transmits");
    out->is_thin = strcmp(type, "thindielectric") == 0;
    m->sheet = out->is_thin ? node : m->sheet;
    out->fresnel = IMPORT_FRESNEL_DIELECTRIC;
    out->ior = outside > 0 ? inside / outside : inside;
    if (is_rough(type))
        read_facets(m, node, out);
}

void rt_mitsuba_diffuse(mitsuba *m, xml_node *node, const char *name, import_material *out)
{
    out->kd[0] = out->kd[1] = out->kd[2] = 0.5;
    out->kd_texture = rt_mitsuba_texture(m, node, name, out->kd);
}

/* A diffuse base under a coat; without `nonlinear` its colours stay as they are. */
static void read_plastic(mitsuba *m, xml_node *node, import_material *out)
{
    double reflected[3] = {1, 1, 1};
    out->coat = 1;
    out->coat_ior =
        rt_mitsuba_ior(m, node, "int_ior", 1.49) / rt_mitsuba_ior(m, node, "ext_ior", 1.000277);
    rt_mitsuba_diffuse(m, node, "diffuse_reflectance", out);
    out->is_coat_linear = !rt_mitsuba_flag(m, node, "nonlinear", 0);
    if (is_rough(type_of(m, node)))
        out->coat_roughness = read_distribution(m, node, out, &out->coat_roughness_texture);
    out->is_coat_single = out->coat_roughness > 0;
    const int texture = rt_mitsuba_texture(m, node, "specular_reflectance", reflected);
    if (texture != IMPORT_NONE || reflected[0] != 1 || reflected[1] != 1 || reflected[2] != 1)
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "the colour of what a coat reflects is left out");
}

/* What a dielectric of this index reflects of light from outside. */
static double fresnel(double cosine, double ior)
{
    const double inside = sqrt(1 - (1 - cosine * cosine) / (ior * ior)),
                 across = (cosine - ior * inside) / (cosine + ior * inside),
                 along = (ior * cosine - inside) / (ior * cosine + inside);
    return (across * across + along * along) / 2;
}

/*
 * A rough coat whose base loses what is reflected back inside: Mitsuba's `pplastic` of light
 * without polarization. The coat here gives that back, as 1 / (1 - R) of its hemispherical
 * reflectance R from outside.
 */
static void read_pplastic(mitsuba *m, xml_node *node, import_material *out)
{
    enum { STEPS = 1000 };
    double reflected = 0;
    read_plastic(m, node, out);
    out->is_coat_linear = 1;
    out->is_coat_single = 0;
    out->coat_roughness = read_distribution(m, node, out, &out->coat_roughness_texture);
    if (out->coat_ior < 1)
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "a pplastic of index %g is brighter here", out->coat_ior);
    for (int i = 0; i < STEPS && out->coat_ior >= 1; i++) {
        const double cosine = (i + 0.5) / STEPS;
        reflected += 2 * cosine * fresnel(cosine, out->coat_ior) / STEPS;
    }
    for (int c = 0; c < 3; c++)
        out->kd[c] *= 1 - reflected;
}

/* How often its parts are sampled is nothing that a picture shows. */
static void skip_rates(mitsuba *m, xml_node *node)
{
    static const char *const names[] = {"diffuse_reflectance_sampling_rate",
                                        "main_specular_sampling_rate",
                                        "clearcoat_sampling_rate",
                                        "specular_reflectance_sampling_rate",
                                        "specular_transmittance_sampling_rate",
                                        "diffuse_transmittance_sampling_rate"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        rt_mitsuba_number(m, node, names[i], 1);
}

/* What a solid has and a sheet does not, and its index of refraction. */
static void read_principled_solid(mitsuba *m, xml_node *node, import_material *out)
{
    const double specular = rt_mitsuba_number(m, node, "specular", 0.5),
                 ior = 2 / (1 - sqrt(0.08 * fmin(fmax(specular, 0), 1))) - 1;
    out->metallic = read_alpha(m, node, "metallic", 0, &out->metallic_texture);
    out->clearcoat = read_alpha(m, node, "clearcoat", 0, &out->clearcoat_texture);
    if (out->clearcoat > 0)
        out->clearcoat_gloss =
            read_alpha(m, node, "clearcoat_gloss", 0, &out->clearcoat_gloss_texture);
    if (rt_mitsuba_child(node, "specular") && rt_mitsuba_child(node, "eta"))
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "specular is left out beside eta, where Mitsuba refuses both");
    out->ior = rt_mitsuba_number(m, node, "eta", ior);
    if (out->spec_trans > 0 && out->ior == 1)
        out->ior = specular == 0 ? 1.018 : 1.001;
}

/* The model of `principled`, and of the sheet `principledthin`, with the same parameters. */
static void read_principled(mitsuba *m, xml_node *node, import_material *out)
{
    out->is_principled = 1;
    out->is_thin = strcmp(type_of(m, node), "principledthin") == 0;
    for (int c = 0; c < 3; c++)
        out->base_color[c] = 0.5;
    out->base_color_texture = rt_mitsuba_texture(m, node, "base_color", out->base_color);
    out->roughness = read_alpha(m, node, "roughness", 0.5, &out->roughness_texture);
    out->spec_trans = read_alpha(m, node, "spec_trans", 0, &out->spec_trans_texture);
    out->spec_tint = read_alpha(m, node, "spec_tint", 0, &out->spec_tint_texture);
    out->anisotropic = read_alpha(m, node, "anisotropic", 0, &out->anisotropic_texture);
    turn_anisotropy(m, out);
    out->sheen = read_alpha(m, node, "sheen", 0, &out->sheen_texture);
    if (out->sheen > 0)
        out->sheen_tint = read_alpha(m, node, "sheen_tint", 0, &out->sheen_tint_texture);
    out->flatness = read_alpha(m, node, "flatness", 0, &out->flatness_texture);
    skip_rates(m, node);
    if (!out->is_thin) {
        read_principled_solid(m, node, out);
        return;
    }
    out->diff_trans = read_alpha(m, node, "diff_trans", 0, &out->diff_trans_texture);
    out->ior = rt_mitsuba_number(m, node, "eta", 1.5);
}

/* Of light without polarization a polarizer lets half through, and a retarder all. */
static void read_polarizer(mitsuba *m, xml_node *node, import_material *out)
{
    double transmittance[3] = {1, 1, 1}, theta[3];
    rt_mitsuba_colour(m, node, "transmittance", transmittance);
    rt_mitsuba_colour(m, node, "theta", theta);
    rt_mitsuba_colour(m, node, "delta", theta);
    rt_mitsuba_flag(m, node, "polarizing", 1);
    rt_mitsuba_flag(m, node, "left_handed", 0);
    const int is_retarder = strcmp(type_of(m, node), "retarder") == 0;
    rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                      "polarization is left out: a %s lets %s of the light through",
                      is_retarder ? "retarder" : "polarizer", is_retarder ? "all" : "half");
    for (int c = 0; c < 3; c++)
        out->kt[c] = (is_retarder ? 1 : 0.5) * transmittance[c];
    out->ior = 1;
}

static void read_bsdf(mitsuba *m, xml_node *node, import_material *out, int depth);

int rt_mitsuba_parts(mitsuba *m, xml_node *node, import_part *parts, int most, int depth)
{
    int count = 0;
    for (xml_node *child = node->first; child && count < most; child = child->next) {
        xml_node *inner = strcmp(child->tag, "bsdf") == 0 || strcmp(child->tag, "ref") == 0
                              ? rt_mitsuba_follow(m, child)
                              : NULL;
        if (!inner || strcmp(inner->tag, "bsdf") != 0)
            continue;
        rt_mitsuba_read(m, child, inner);
        const char *id = rt_xml_attribute(inner, "id");
        parts[count] = (import_part){id ? id : "part", rt_import_material_begin(),
                                     strcmp(type_of(m, inner), "diffuse") == 0};
        read_bsdf(m, inner, &parts[count++].material, depth + 1);
    }
    if (count == 0) {
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "a '%.40s' needs another material inside: diffuse grey of 0.5 stands in "
                          "its place",
                          type_of(m, node));
        parts[count++] = (import_part){"part", rt_import_material_begin(), 1};
        parts[0].material.kd[0] = parts[0].material.kd[1] = parts[0].material.kd[2] = 0.5;
    }
    return count;
}

void rt_mitsuba_inner(mitsuba *m, xml_node *node, import_material *out, int depth)
{
    import_part inner;
    rt_mitsuba_parts(m, node, &inner, 1, depth);
    *out = inner.material;
}

/* One material on both sides, or one on each. */
static void read_twosided(mitsuba *m, xml_node *node, import_material *out, int depth)
{
    import_part sides[2];
    const int count = rt_mitsuba_parts(m, node, sides, 2, depth);
    *out = sides[0].material;
    out->back = IMPORT_NONE;
    for (int i = 0; i < count; i++)
        if (rt_import_lets_light_through(&sides[i].material))
            rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                              "a 'twosided' has no effect around what lets light through, where "
                              "Mitsuba refuses it");
    if (count == 2) {
        sides[1].material.back = IMPORT_NONE;
        out->back = rt_import_add_material(rt_mitsuba_at(m, node), node->line, sides[1].base,
                                           &sides[1].material);
    }
}

/*
 * Two colours by a weight of the vertices or faces of meshes: colours of these. Returns 0 where the
 * blend is another.
 */
static int read_ramp(mitsuba *m, xml_node *node, const import_part parts[2], import_material *out)
{
    import_ramp ramp = {.weight = NULL};
    const import_colours of = rt_mitsuba_weight(m, node, "weight", &ramp.weight);
    for (int i = 0; i < 2; i++) {
        if (of == IMPORT_COLOURS_NONE || !parts[i].is_diffuse ||
            parts[i].material.kd_texture != IMPORT_NONE ||
            parts[i].material.colours != IMPORT_COLOURS_NONE)
            return 0;
        memcpy(ramp.ends[i], parts[i].material.kd, sizeof ramp.ends[i]);
    }
    *out = parts[0].material;
    out->kd[0] = out->kd[1] = out->kd[2] = 1;
    out->colours = of;
    out->ramp = ramp;
    return 1;
}

static void read_blend(mitsuba *m, xml_node *node, import_material *out, int depth)
{
    import_part parts[2];
    double weight[3] = {0.5, 0.5, 0.5};
    if (rt_mitsuba_parts(m, node, parts, 2, depth) == 1) {
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "a 'blendbsdf' needs two materials inside: it became the one");
        *out = parts[0].material;
        return;
    }
    if (read_ramp(m, node, parts, out))
        return;
    const int texture = rt_mitsuba_number_texture(m, node, "weight", weight);
    const double mean = (weight[0] + weight[1] + weight[2]) / 3, bounded = fmin(fmax(mean, 0), 1);
    if (bounded != mean)
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "a weight of %.9g is out of range: it became %.9g", mean, bounded);
    rt_import_blend(rt_mitsuba_at(m, node), node->line, out, parts, bounded, texture);
}

/*
 * How Mitsuba treats normals that a map tilts. Those that face away from who looks it mirrors, or
 * they are black; here they scatter as they are.
 */
static void read_tilting(mitsuba *m, xml_node *node, import_material *out)
{
    out->has_bump_shadows = rt_mitsuba_flag(m, node, "use_shadowing_function", 1);
    rt_import_note_at(
        rt_mitsuba_at(m, node), node->line,
        rt_mitsuba_flag(m, node, "flip_invalid_normals", 1)
            ? "Mitsuba flips back normals that a '%s' tilts away from the viewer: here they stay"
            : "Mitsuba shows black what a '%s' tilts away from the viewer: here it is not",
        type_of(m, node));
}

static void read_normal_map(mitsuba *m, xml_node *node, import_material *out)
{
    double scale = 1;
    out->normal_texture = rt_mitsuba_map(m, node, 1, &scale);
    if (out->normal_texture == IMPORT_NONE)
        rt_import_note_at(rt_mitsuba_at(m, node), node->line, "a normal map has no texture");
    else if (!rt_mitsuba_is_raw(m, node))
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "a normal map without `raw` is taken as raw, not decoded from sRGB");
    if (scale != 1)
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "the scale of a normal map is left out");
    read_tilting(m, node, out);
}

/* What is not opaque lets rays through, without refraction. */
static void read_mask(mitsuba *m, xml_node *node, import_material *out, int depth)
{
    double opacity[3] = {0.5, 0.5, 0.5};
    rt_mitsuba_inner(m, node, out, depth);
    const int texture = rt_mitsuba_number_texture(m, node, "opacity", opacity);
    const double mean = (opacity[0] + opacity[1] + opacity[2]) / 3;
    if (rt_import_is_solid(out)) {
        if (texture != IMPORT_NONE || mean < 1)
            rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                              "the opacity of glass is left out");
        return;
    }
    if (opacity[0] != opacity[1] || opacity[1] != opacity[2])
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "an opacity is that of all colours: its mean is taken");
    if (texture == IMPORT_NONE && mean <= 0)
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "an opacity of %g is taken as 1e-6: leave the shape out", mean);
    if (mean > 1)
        rt_import_note_at(rt_mitsuba_at(m, node), node->line, "an opacity of %g is taken as 1",
                          mean);
    const double inner = out->opacity > 0 ? out->opacity : 1;
    if (out->opacity_texture != IMPORT_NONE && texture != IMPORT_NONE)
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "the textured opacity of the mask inside is left out");
    m->mask = node;
    out->opacity = fmax(inner * mean, 1e-6);
    out->opacity_texture = texture != IMPORT_NONE ? texture : out->opacity_texture;
}

/* What is opaque is black from behind, unless it stands in a 'twosided'. */
static int is_one_sided(const char *type, const import_material *m)
{
    static const char *const opaque[] = {
        "diffuse",  "conductor",  "roughconductor", "plastic", "roughplastic",
        "pplastic", "principled", "roughdiffuse",   "phong",   "ward"};
    for (size_t i = 0; i < sizeof opaque / sizeof *opaque; i++)
        if (strcmp(type, opaque[i]) == 0)
            return m->kt[0] + m->kt[1] + m->kt[2] + m->spec_trans == 0;
    return 0;
}

static void read_difftrans(mitsuba *m, xml_node *node, import_material *out)
{
    for (int c = 0; c < 3; c++)
        out->diffuse_transmission[c] = 0.5;
    out->diffuse_transmission_texture =
        rt_mitsuba_texture(m, node, "transmittance", out->diffuse_transmission);
}

static void read_null(mitsuba *m, xml_node *node, import_material *out)
{
    (void)m, (void)node;
    out->kt[0] = out->kt[1] = out->kt[2] = out->ior = 1;
}

static void read_lambertian(mitsuba *m, xml_node *node, import_material *out)
{
    const int has_old_name = m->is_old && !rt_mitsuba_child(node, "reflectance") &&
                             rt_mitsuba_child(node, "diffuse_reflectance");
    rt_mitsuba_diffuse(m, node, has_old_name ? "diffuse_reflectance" : "reflectance", out);
}

static void read_bump(mitsuba *m, xml_node *node, import_material *out, int depth)
{
    rt_mitsuba_inner(m, node, out, depth);
    out->bump_scale = rt_mitsuba_number(m, node, "scale", 1);
    out->bump_texture = rt_mitsuba_map(m, node, 0, &out->bump_scale);
    if (out->bump_texture == IMPORT_NONE)
        rt_import_note_at(rt_mitsuba_at(m, node), node->line, "a bump map has no texture");
    read_tilting(m, node, out);
}

static void read_normals(mitsuba *m, xml_node *node, import_material *out, int depth)
{
    rt_mitsuba_inner(m, node, out, depth);
    read_normal_map(m, node, out);
}

/* A material of this type; returns 0 where it is none. */
static int read_type(mitsuba *m, xml_node *node, const char *type, import_material *out, int depth)
{
    static const struct {
        const char *type;
        void (*read)(mitsuba *m, xml_node *node, import_material *out);
    } single[] = {{"diffuse", read_lambertian},
                  {"conductor", read_conductor},
                  {"roughconductor", read_conductor},
                  {"dielectric", read_dielectric},
                  {"roughdielectric", read_dielectric},
                  {"thindielectric", read_dielectric},
                  {"plastic", read_plastic},
                  {"roughplastic", read_plastic},
                  {"pplastic", read_pplastic},
                  {"principled", read_principled},
                  {"principledthin", read_principled},
                  {"difftrans", read_difftrans},
                  {"roughdiffuse", rt_mitsuba_rough_diffuse},
                  {"phong", rt_mitsuba_glossy},
                  {"ward", rt_mitsuba_glossy},
                  {"null", read_null},
                  {"polarizer", read_polarizer},
                  {"circular", read_polarizer},
                  {"retarder", read_polarizer}};
    static const struct {
        const char *type;
        void (*read)(mitsuba *m, xml_node *node, import_material *out, int depth);
    } nested[] = {{"twosided", read_twosided},
                  {"blendbsdf", read_blend},
                  {"mixturebsdf", rt_mitsuba_mixture},
                  {"coating", rt_mitsuba_coating},
                  {"roughcoating", rt_mitsuba_coating},
                  {"mask", read_mask},
                  {"bumpmap", read_bump},
                  {"normalmap", read_normals}};
    for (size_t i = 0; i < sizeof single / sizeof *single; i++)
        if (strcmp(single[i].type, type) == 0) {
            single[i].read(m, node, out);
            return 1;
        }
    for (size_t i = 0; i < sizeof nested / sizeof *nested; i++)
        if (strcmp(nested[i].type, type) == 0) {
            nested[i].read(m, node, out, depth);
            return 1;
        }
    return 0;
}

static void read_bsdf(mitsuba *m, xml_node *node, import_material *out, int depth)
{
    const char *type = type_of(m, node);
    if (depth > IMPORT_DEPTH_MAX) {
        rt_import_fail(rt_mitsuba_at(m, node), node->line,
                       "materials are nested deeper than %d, or in themselves", IMPORT_DEPTH_MAX);
    } else if (!read_type(m, node, type, out, depth)) {
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "a material '%.40s' is unknown: diffuse grey of 0.5 stands in its place",
                          type);
        out->kd[0] = out->kd[1] = out->kd[2] = 0.5;
        rt_mitsuba_leave(node);
    }
    if (is_one_sided(type, out))
        out->back = IMPORT_BLACK;
}

/* The element of a shape's material, or NULL. */
static xml_node *find_bsdf(mitsuba *m, xml_node *shape)
{
    for (xml_node *child = shape->first; child; child = child->next) {
        int may_be = strcmp(child->tag, "bsdf") == 0 || strcmp(child->tag, "ref") == 0;
        xml_node *bsdf = may_be ? rt_mitsuba_follow(m, child) : NULL;
        if (bsdf && strcmp(bsdf->tag, "bsdf") == 0) {
            child->is_read = bsdf->is_read = READ;
            return bsdf;
        }
    }
    return NULL;
}

/* Keeps what became of a material; without textures it is the same on all shapes. */
static void keep_made(mitsuba *m, int *made, int is_emitter, mitsuba_uv uv, int handle)
{
    for (int k = 0; k < XML_MADE; k += 2)
        if (k == 2 * (int)uv || !rt_import_has_directions(m->import, handle))
            made[k + is_emitter] = handle + 1;
}

/*
 * Where the handle of a material that asks for attributes is kept, for shapes whose meshes have the
 * same; NULL after a failure. 0: not yet.
 */
static int *find_asked(mitsuba *m, const xml_node *node, int is_emitter, mitsuba_uv uv)
{
    import_text key = {NULL, 0, 0};
    const char *const has = rt_mitsuba_attributes(m);
    if (!has)
        return NULL;
    rt_import_put(m->import, &key, "%p %d %d%s", (const void *)node, is_emitter, (int)uv, has);
    int at = key.text ? rt_name_table_find(&m->asked_keys, key.text) : -1;
    if (key.text && at < 0) {
        const size_t count = m->asked_keys.count;
        int *const moved = rt_import_grow(m->import, m->asked, count, sizeof *moved);
        m->asked = moved ? moved : m->asked;
        at = moved ? rt_name_table_add(&m->asked_keys, key.text) : -1;
        if (at < 0)
            rt_import_fail_memory(m->import);
        else
            m->asked[at] = 0;
    }
    free(key.text);
    return at < 0 ? NULL : m->asked + at;
}

/* What a material is called where it is counted. */
static void name_of(char out[80], mitsuba *m, xml_node *node, int line)
{
    const char *const id = node ? rt_xml_attribute(node, "id") : NULL;
    if (id)
        snprintf(out, 80, "%.79s", id);
    else
        snprintf(out, 80, "%.40s of line %d", node ? type_of(m, node) : "material", line);
}

/* Adds a material that was read, and counts it as exact where nothing was told since `told`. */
static int add_read(mitsuba *m, xml_node *node, const xml_node *shape,
                    const import_material *material, size_t told)
{
    const xml_node *const place = node ? node : shape;
    const char *const id = node ? rt_xml_attribute(node, "id") : NULL;
    char name[80];
    const int handle = rt_import_add_material(rt_mitsuba_at(m, place), place->line,
                                              id ? id : "material", material);
    name_of(name, m, node, place->line);
    rt_import_tally(m->import, told, name);
    if (node)
        node->is_exact = m->import->told == told;
    return handle;
}

void rt_mitsuba_note_material(mitsuba *m, xml_node *node)
{
    while (node && !node->is_exact)
        node = node->parent;
    if (!node)
        return;
    char name[80];
    name_of(name, m, node, node->line);
    rt_import_tally_near(m->import, name);
    node->is_exact = 0;
}

int rt_mitsuba_material(mitsuba *m, xml_node *shape, int is_emitter, mitsuba_uv uv)
{
    xml_node *const node = find_bsdf(m, shape), *const medium = rt_mitsuba_find_medium(m, shape);
    int *all = node ? node->made : m->made, *made = all + is_emitter + 2 * (int)uv;
    if (medium) {
        all = NULL;
        made = &m->filled_made[is_emitter];
        if (m->filled[0] != medium || m->filled[1] != node)
            m->filled_made[0] = m->filled_made[1] = 0;
        m->filled[0] = medium;
        m->filled[1] = node;
    }
    m->shape = shape;
    if (node && node->asks && !medium)
        made = find_asked(m, node, is_emitter, uv);
    if (!made)
        return IMPORT_NONE;
    if (*made)
        return *made - 1;
    import_material material = rt_import_material_begin();
    const size_t told = m->import->told;
    m->uv = uv;
    m->asks = 0;
    if (node)
        read_bsdf(m, node, &material, 0);
    else if (medium && m->is_old) {
        read_null(m, shape, &material);
    } else if (!is_emitter) {
        material.kd[0] = material.kd[1] = material.kd[2] = 0.5;
        material.back = IMPORT_BLACK;
    }
    if (medium)
        rt_mitsuba_fill(m, medium, &material);
    const int handle = add_read(m, node, shape, &material, told);
    m->uv = MITSUBA_UV_SAME;
    if (node && m->asks)
        node->asks = 1;
    if (m->asks && !medium)
        made = find_asked(m, node, is_emitter, uv);
    if (all && !m->asks)
        keep_made(m, all, is_emitter, uv, handle);
    else if (made && !(m->asks && medium))
        *made = handle + 1;
    return handle;
}

/* Whether the material is the same seen from both sides. */
static int is_alike(const import_material *m)
{
    return m->back == IMPORT_NONE && m->kt[0] + m->kt[1] + m->kt[2] + m->spec_trans == 0;
}

/* Whether another may stand before it, whose back it is. */
static int may_be_back(const import_material *m)
{
    return m->back == IMPORT_BLACK && m->opacity == 0 && m->opacity_texture == IMPORT_NONE;
}

/* Whether it is a dielectric, whose sides are exchanged by the inverse of its index. */
static int is_refracting(const import_material *m)
{
    return m->fresnel == IMPORT_FRESNEL_DIELECTRIC && rt_import_is_solid(m) && m->ior > 0 &&
           m->blend == IMPORT_NONE && !m->is_principled;
}

int rt_mitsuba_turned_material(mitsuba *m, xml_node *shape, const import_surface *surface,
                               mitsuba_uv uv, const char *what)
{
    xml_node *const node = find_bsdf(m, shape);
    const char *const id = node ? rt_xml_attribute(node, "id") : NULL;
    const int line = node ? node->line : shape->line;
    import_material material = rt_import_material_begin(), front = rt_import_material_begin();
    const int is_light = rt_import_is_light(surface);
    m->shape = shape;
    m->uv = uv;
    if (node) {
        read_bsdf(m, node, &material, 0);
    } else {
        material.kd[0] = material.kd[1] = material.kd[2] = 0.5;
        material.back = IMPORT_BLACK;
    }
    m->uv = MITSUBA_UV_SAME;
    if (is_alike(&material) && !is_light)
        return surface->material;
    const int has_medium = rt_mitsuba_find_medium(m, shape) != NULL;
    rt_mitsuba_at(m, shape);
    if (is_light) {
        material.is_two_sided = 1;
        rt_import_note_at(m->import, shape->line,
                          "a %s that is turned over by flip_normals or a mirroring sends light "
                          "outwards, too",
                          what);
        return rt_import_add_material(m->import, line, "turned", &material);
    }
    if (is_refracting(&material) && !has_medium) {
        material.ior = 1 / material.ior;
        return rt_import_add_material(m->import, line, "turned", &material);
    }
    if (!may_be_back(&material) || has_medium) {
        rt_import_note_at(m->import, shape->line,
                          "a %s that is turned over by flip_normals or a mirroring stays as it is",
                          what);
        return surface->material;
    }
    material.back = IMPORT_NONE;
    front.back = rt_import_add_material(rt_mitsuba_at(m, node ? node : shape), line,
                                        id ? id : "material", &material);
    return rt_import_add_material(m->import, line, "turned", &front);
}
