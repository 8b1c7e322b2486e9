/*
 * mtl_pbr.c - the PBR fields of MTL, Pr to anisor, as Blender reads and writes them.
 *
 * alpha is the square of Pr, and along u and v that over and times sqrt(1 - 0.9 aniso) (Burley
 * 2012). A plastic reflects ((Ni - 1) / (Ni + 1))^2 at normal incidence, times twice the mean of
 * Ks. What is metal or transparent in part is a blend. Light passes a boundary of glass twice, and
 * takes the square root of its colour each time.
 */
#include "dsl/import/mtl_pbr.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "dsl/import/sheet.h"
#include "rt.h"

mtl_pbr rt_mtl_pbr_begin(void)
{
    const mtl_pbr none = {
        .level = 0.5, .roughness_texture = IMPORT_NONE, .metallic_texture = IMPORT_NONE};
    return none;
}

int rt_mtl_is_pbr(const mtl_pbr *pbr)
{
    return pbr->has_roughness || pbr->metallic > 0 || pbr->sheen > 0 || pbr->clearcoat > 0 ||
           pbr->anisotropy > 0 || pbr->roughness_texture != IMPORT_NONE ||
           pbr->metallic_texture != IMPORT_NONE;
}

/* ---- Surfaces -------------------------------------------------------------------- */

static void set_roughness(const mtl_pbr *pbr, import_material *m, double anisotropy)
{
    const double alpha = pbr->roughness * pbr->roughness, aspect = sqrt(1 - 0.9 * anisotropy);
    rt_import_set_alphas(m, fmin(alpha / aspect, 1), alpha * aspect);
    m->roughness_texture = pbr->roughness_texture;
    m->roughness_v_texture = m->roughness_v > 0 ? pbr->roughness_texture : IMPORT_NONE;
    m->anisotropy_rotation = 360 * pbr->rotation;
}

/* What the dielectric reflects at normal incidence. */
static double normal_reflectance(const mtl_pbr *pbr, const import_material *m)
{
    const double ior = m->ior > 0 ? m->ior : 1.5;
    return fmin(2 * pbr->level * pow((ior - 1) / (ior + 1), 2), 1);
}

/* Below the coat of Pc, what is a plastic reflects f0 at every angle. */
static void put_clearcoat(importer *import, int line, const char *name, const mtl_pbr *pbr,
                          import_material *m, double f0)
{
    m->coat = pbr->clearcoat / 4; /* as the clearcoat of Burley 2012 */
    m->coat_ior = 1.5;
    m->coat_roughness = pbr->coat_roughness * pbr->coat_roughness;
    m->is_coat_linear = 1;
    if (m->fresnel == IMPORT_FRESNEL_SCHLICK)
        rt_import_settle_coated(import, line, m);
    if (m->fresnel == IMPORT_FRESNEL_SCHLICK || f0 == 0)
        return;
    for (int c = 0; c < 3; c++) {
        m->kd[c] *= 1 - f0;
        m->ks[c] = f0;
    }
    rt_import_note_at(import, line, "material %.60s: " IMPORT_COATED_PLASTIC, name, f0);
}

static void make_metal(importer *import, int line, const char *name, const mtl_pbr *pbr,
                       import_material *m)
{
    set_roughness(pbr, m, pbr->clearcoat > 0 ? 0 : pbr->anisotropy);
    rt_import_make_metal(m);
    if (pbr->clearcoat > 0)
        put_clearcoat(import, line, name, pbr, m, 0);
    if (pbr->sheen > 0)
        rt_import_note_at(import, line, "material %.60s: the Ps of a metal is left out", name);
    if (pbr->clearcoat > 0 && pbr->anisotropy > 0)
        rt_import_note_at(import, line, "material %.60s: its aniso is left out below a clearcoat",
                          name);
}

/* Fuzz of cloth lies over what is diffuse alone. */
static void make_plastic(importer *import, int line, const char *name, const mtl_pbr *pbr,
                         import_material *m)
{
    const double f0 = normal_reflectance(pbr, m);
    m->ks[0] = m->ks[1] = m->ks[2] = 0;
    m->ks_texture = IMPORT_NONE;
    m->roughness = m->ior = 0;
    if (pbr->anisotropy > 0)
        rt_import_note_at(import, line, "material %.60s: the aniso of a plastic is left out", name);
    if (pbr->sheen > 0 && pbr->clearcoat == 0 && (pbr->roughness >= 0.7 || f0 == 0)) {
        m->fuzz[0] = m->fuzz[1] = m->fuzz[2] = fmin(pbr->sheen, 1);
        m->fuzz_roughness = 0.5;
        if (f0 > 0)
            rt_import_note_at(import, line,
                              "material %.60s: what is below its Ps reflects diffusely alone",
                              name);
        return;
    }
    if (pbr->sheen > 0)
        rt_import_note_at(import, line,
                          "material %.60s: its Ps is left out over what reflects by facets", name);
    if (pbr->clearcoat == 0 && f0 == 0)
        return;
    set_roughness(pbr, m, 0);
    if (pbr->clearcoat > 0)
        put_clearcoat(import, line, name, pbr, m, f0);
    else
        rt_import_make_plastic(m, f0, 1);
}

static void make_glass(const mtl_pbr *pbr, import_material *m)
{
    const double base[3] = {m->kd[0], m->kd[1], m->kd[2]};
    set_roughness(pbr, m, pbr->anisotropy);
    memset(m->ks, 0, sizeof m->ks);
    m->ks_texture = IMPORT_NONE;
    const int is_coloured =
        m->kd_texture != IMPORT_NONE || base[0] != 1 || base[1] != 1 || base[2] != 1;
    if (is_coloured && pbr->roughness_texture == IMPORT_NONE) {
        rt_import_make_coloured_glass(m, 1, base, m->kd_texture);
        m->roughness = pbr->roughness;
        m->anisotropic = pbr->anisotropy;
        return;
    }
    for (int c = 0; c < 3; c++) {
        m->kt[c] = sqrt(base[c]);
        m->kd[c] = 0;
    }
    m->kt_texture = m->kd_texture;
    m->kd_texture = IMPORT_NONE;
    m->fresnel = IMPORT_FRESNEL_DIELECTRIC;
    m->scatters_often = 1;
}

void rt_mtl_make_pbr(importer *import, int line, const char *name, const mtl_pbr *pbr,
                     import_material *m)
{
    const import_material given = *m;
    memset(m->emission, 0, sizeof m->emission);
    m->emission_texture = IMPORT_NONE;
    import_part parts[2] = {{.base = "plastic", .material = *m}, {.base = "metal", .material = *m}};
    const double clear = pbr->has_glass ? fmin(pbr->transmission, 1) : 0;
    const int has_base = clear < 1, has_plastic = pbr->metallic < 1 || pbr->metallic_texture >= 0;
    if (has_base && has_plastic)
        make_plastic(import, line, name, pbr, &parts[0].material);
    if (pbr->metallic > 0)
        make_metal(import, line, name, pbr, &parts[1].material);
    if (clear > 0 && pbr->metallic < 1) {
        import_part inner[2] = {parts[0], {.base = "glass", .material = *m}};
        make_glass(pbr, &inner[1].material);
        if (pbr->is_sheet)
            rt_import_make_sheet(import, line, name, &inner[1].material);
        if (pbr->clearcoat > 0 || pbr->sheen > 0)
            rt_import_note_at(import, line, "material %.60s: Pc and Ps over glass are left out",
                              name);
        rt_import_blend(import, line, &parts[0].material, inner, clear, IMPORT_NONE);
    }
    rt_import_blend(import, line, m, parts, pbr->metallic, pbr->metallic_texture);
    memcpy(m->emission, given.emission, sizeof m->emission);
    m->emission_texture = given.emission_texture;
}

/* ---- Normal maps ----------------------------------------------------------------- */

/* Whether nearly all of some thousand pixels are unit vectors that point up. */
static int are_normals(const float *rgb, size_t count)
{
    const size_t step = count / 4096 + 1;
    size_t seen = 0, fitting = 0;
    for (size_t i = 0; i < count; i += step, seen++) {
        double v[3];
        for (int c = 0; c < 3; c++)
            v[c] = 2 * rt_import_encode_srgb(rgb[3 * i + c]) - 1;
        const double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
        fitting += v[2] > 0 && fabs(length - 1) < 0.15;
    }
    return seen > 0 && fitting >= 0.95 * (double)seen;
}

int rt_mtl_holds_normals(importer *import, int line, const char *file)
{
    rt_image *image = NULL;
    rt_error error;
    uint32_t width = 0, height = 0;
    int holds = 0;
    char *path = import->failed ? NULL : rt_import_resolve(import, line, file);
    if (!path)
        return 0;
    if (rt_image_read(&image, path, &error) == RT_OK) {
        rt_image_get_size(image, &width, &height);
        const size_t count = (size_t)width * height;
        float *rgb = malloc(3 * count * sizeof *rgb);
        if (rgb && rt_image_get_rgb(rgb, image, NULL, &error) == RT_OK)
            holds = are_normals(rgb, count);
        free(rgb);
        rt_image_destroy(image);
    }
    free(path);
    return holds;
}
