/*
 * pbrt_v3.c - materials of pbrt-v3, by its rules: which a file is of is told by their names, and by
 * its `Film "image"`.
 */
#include <math.h>
#include <string.h>

#include "dsl/import/pbrt.h"

static void set(double out[3], double value)
{
    out[0] = out[1] = out[2] = value;
}

/* The alpha of a roughness where that is remapped, as a rule. */
static double to_alpha(pbrt_params *params, double roughness)
{
    const double x = log(fmax(roughness, 1e-3));
    if (!rt_pbrt_flag(params, "remaproughness", 1))
        return fmax(roughness, 0);
    return 1.62142 + x * (0.819955 + x * (0.1734 + x * (0.0171201 + x * 0.000640711)));
}

/* Alpha along u and v; smooth without a roughness where `fallback` is 0. */
static void read_alphas(pbrt *p, pbrt_params *params, double fallback, double alpha[2])
{
    const double roughness = rt_pbrt_number(params, "roughness", fallback),
                 u = rt_pbrt_number(params, "uroughness", roughness),
                 v = rt_pbrt_number(params, "vroughness", roughness);
    if (rt_pbrt_find(params, "texture", "roughness") ||
        rt_pbrt_find(params, "texture", "uroughness") ||
        rt_pbrt_find(params, "texture", "vroughness"))
        rt_import_note_at(p->import, params->line, "a textured roughness became even");
    alpha[0] = u > 0 ? to_alpha(params, u) : 0;
    alpha[1] = v > 0 ? to_alpha(params, v) : 0;
}

static void read_matte(pbrt *p, pbrt_params *params, import_material *m)
{
    set(m->kd, 0.5);
    m->kd_texture = rt_pbrt_input(p, params, "Kd", m->kd);
    const double degrees = fmin(fmax(rt_pbrt_number(params, "sigma", 0), 0), 90);
    rt_import_make_rough(p->import, params->line, degrees * IMPORT_PI / 180, m);
}

static void read_mirror(pbrt *p, pbrt_params *params, import_material *m)
{
    set(m->ks, 0.9);
    m->ks_texture = rt_pbrt_input(p, params, "Kr", m->ks);
}

static double read_index(pbrt_params *params)
{
    return rt_pbrt_number(params, "eta", rt_pbrt_number(params, "index", 1.5));
}

static void read_glass(pbrt *p, pbrt_params *params, import_material *m)
{
    double reflected[3] = {1, 1, 1}, alpha[2];
    set(m->kt, 1);
    m->kt_texture = rt_pbrt_input(p, params, "Kt", m->kt);
    rt_pbrt_input(p, params, "Kr", reflected);
    if (memcmp(reflected, m->kt, sizeof reflected) != 0)
        rt_import_note_at(p->import, params->line, "glass reflects the colour that it transmits");
    m->fresnel = IMPORT_FRESNEL_DIELECTRIC;
    m->ior = read_index(params);
    read_alphas(p, params, 0, alpha);
    rt_import_set_alphas(m, alpha[0], alpha[1]);
}

/* Its eta and k are spectra; by default those of copper. */
static void read_metal(pbrt *p, pbrt_params *params, import_material *m)
{
    double alpha[2];
    set(m->ks, 1);
    m->fresnel = IMPORT_FRESNEL_CONDUCTOR;
    rt_import_metal("Cu", m->eta, m->k);
    rt_pbrt_colour(params, "eta", m->eta);
    rt_pbrt_colour(params, "k", m->k);
    read_alphas(p, params, 0.01, alpha);
    rt_import_set_alphas(m, alpha[0], alpha[1]);
}

/* A diffuse base and a glossy reflection, as a coat, which darkens the base where it grazes. */
static void read_coated(pbrt *p, pbrt_params *params, double kd, double ks, import_material *m)
{
    double gloss[3] = {ks, ks, ks}, alpha[2];
    set(m->kd, kd);
    m->kd_texture = rt_pbrt_input(p, params, "Kd", m->kd);
    if (rt_pbrt_input(p, params, "Ks", gloss) != IMPORT_NONE)
        rt_import_note_at(p->import, params->line, "a textured Ks became its mean");
    m->coat = fmin(fmax((gloss[0] + gloss[1] + gloss[2]) / 3, 0), 1);
    m->coat_ior = read_index(params);
    read_alphas(p, params, 0.1, alpha);
    m->coat_roughness = fmin(sqrt(alpha[0] * alpha[1]), 1);
    if (alpha[0] != alpha[1])
        rt_import_note_at(p->import, params->line,
                          "a roughness of a coat by direction became the same for all");
    if (!(m->coat > 0))
        m->coat_roughness = 0;
    else
        rt_import_note_at(p->import, params->line, "Kd and Ks became a coat over a diffuse base");
}

static void read_uber(pbrt *p, pbrt_params *params, import_material *m)
{
    double reflected[3] = {0, 0, 0}, transmitted[3] = {0, 0, 0}, opacity[3] = {1, 1, 1};
    read_coated(p, params, 0.25, 0.25, m);
    rt_pbrt_input(p, params, "Kr", reflected);
    rt_pbrt_input(p, params, "Kt", transmitted);
    rt_pbrt_input(p, params, "opacity", opacity);
    if (reflected[0] + reflected[1] + reflected[2] > 0 ||
        transmitted[0] + transmitted[1] + transmitted[2] > 0)
        rt_import_note_at(p->import, params->line, "Kr and Kt of an uber material are left out");
    m->opacity = fmax((opacity[0] + opacity[1] + opacity[2]) / 3, 1e-6);
    if (opacity[0] != opacity[1] || opacity[1] != opacity[2])
        rt_import_note_at(p->import, params->line, "an opacity by colours became its mean, %.3g",
                          m->opacity);
}

/* What it reflects and transmits of Kd is diffuse, of Ks it would be glossy. */
static void read_translucent(pbrt *p, pbrt_params *params, import_material *m)
{
    double kd[3] = {0.25, 0.25, 0.25}, ks[3] = {0.25, 0.25, 0.25}, reflect[3] = {0.5, 0.5, 0.5},
           transmit[3] = {0.5, 0.5, 0.5};
    m->kd_texture = m->diffuse_transmission_texture = rt_pbrt_input(p, params, "Kd", kd);
    if (rt_pbrt_input(p, params, "Ks", ks) != IMPORT_NONE || ks[0] + ks[1] + ks[2] > 0)
        rt_import_note_at(p->import, params->line, "the Ks of a translucent material is left out");
    rt_pbrt_input(p, params, "reflect", reflect);
    rt_pbrt_input(p, params, "transmit", transmit);
    rt_pbrt_number(params, "roughness", 0.1);
    rt_pbrt_flag(params, "remaproughness", 1);
    for (int c = 0; c < 3; c++) {
        m->kd[c] = kd[c] * reflect[c];
        m->diffuse_transmission[c] = kd[c] * transmit[c];
    }
}

/* A number of a disney material, or the texture that stands for it, times 1. */
static double read_part(pbrt *p, pbrt_params *params, const char *name, double fallback,
                        int *texture)
{
    double value[3] = {fallback, fallback, fallback};
    *texture = rt_pbrt_input(p, params, name, value);
    return value[0];
}

static void read_disney(pbrt *p, pbrt_params *params, import_material *m)
{
    const struct {
        const char *name;
        double *value;
        int *texture;
        double fallback;
    } parts[] = {
        {"metallic", &m->metallic, &m->metallic_texture, 0},
        {"roughness", &m->roughness, &m->roughness_texture, 0.5},
        {"speculartint", &m->spec_tint, &m->spec_tint_texture, 0},
        {"anisotropic", &m->anisotropic, &m->anisotropic_texture, 0},
        {"sheen", &m->sheen, &m->sheen_texture, 0},
        {"sheentint", &m->sheen_tint, &m->sheen_tint_texture, 0.5},
        {"clearcoat", &m->clearcoat, &m->clearcoat_texture, 0},
        {"clearcoatgloss", &m->clearcoat_gloss, &m->clearcoat_gloss_texture, 1},
        {"spectrans", &m->spec_trans, &m->spec_trans_texture, 0},
        {"flatness", &m->flatness, &m->flatness_texture, 0},
        {"difftrans", &m->diff_trans, &m->diff_trans_texture, 1},
    };
    m->is_principled = 1;
    set(m->base_color, 0.5);
    m->base_color_texture = rt_pbrt_input(p, params, "color", m->base_color);
    m->ior = rt_pbrt_number(params, "eta", 1.5);
    m->is_thin = rt_pbrt_flag(params, "thin", 0);
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        *parts[i].value = read_part(p, params, parts[i].name, parts[i].fallback, parts[i].texture);
    if (m->is_thin) {
        m->metallic = m->clearcoat = 0;
        m->metallic_texture = m->clearcoat_texture = IMPORT_NONE;
    } else {
        m->diff_trans = 0;
        m->diff_trans_texture = IMPORT_NONE;
    }
    if (m->sheen == 0)
        m->sheen_tint = 0, m->sheen_tint_texture = IMPORT_NONE;
    if (m->clearcoat == 0)
        m->clearcoat_gloss = 0, m->clearcoat_gloss_texture = IMPORT_NONE;
    rt_import_note_at(p->import, params->line,
                      "a disney material became principled, whose lobes differ by some percent");
}

int rt_pbrt_v3_material(pbrt *p, pbrt_params *params, const char *type, import_material *m)
{
    if (strcmp(type, "matte") == 0)
        read_matte(p, params, m);
    else if (strcmp(type, "mirror") == 0)
        read_mirror(p, params, m);
    else if (strcmp(type, "glass") == 0)
        read_glass(p, params, m);
    else if (strcmp(type, "metal") == 0)
        read_metal(p, params, m);
    else if (strcmp(type, "plastic") == 0)
        read_coated(p, params, 0.25, 0.25, m);
    else if (strcmp(type, "substrate") == 0)
        read_coated(p, params, 0.5, 0.5, m);
    else if (strcmp(type, "uber") == 0)
        read_uber(p, params, m);
    else if (strcmp(type, "translucent") == 0)
        read_translucent(p, params, m);
    else if (strcmp(type, "disney") == 0)
        read_disney(p, params, m);
    else
        return 0;
    if (rt_pbrt_find(params, "texture", "bumpmap"))
        rt_pbrt_bump(p, params, "bumpmap", m);
    const size_t told = p->import->told; /* the material is none the worse for it */
    rt_import_note_addition(p->import, "a file of pbrt-v3: its materials are read by its rules");
    p->import->told = told;
    return 1;
}
