/*
 * metal_rough.c - the materials of the metallic and roughness workflow, which glTF and the PBR
 * fields of MTL share: metals by their colour, plastics as diffuse colour below a coat, and blends
 * of both.
 */
#include <math.h>
#include <string.h>

#include "dsl/import/import.h"

void rt_import_make_metal(import_material *m)
{
    m->fresnel = IMPORT_FRESNEL_SCHLICK;
    m->scatters_often = 1;
    for (int c = 0; c < 3; c++)
        m->ks[c] = fmin(fmax(m->kd[c], 1e-6), 1);
    memset(m->kd, 0, sizeof m->kd);
    m->ks_texture = m->kd_texture;
    m->kd_texture = IMPORT_NONE;
}

void rt_import_settle_coated(importer *import, int line, import_material *m)
{
    if (m->roughness == 0)
        return;
    m->roughness *= 1 - m->coat * (1 - 1 / m->coat_ior);
    rt_import_note_at(import, line,
                      "a metal is less rough below its clearcoat, which bends light here: the "
                      "highlight is as wide as without it, and a dark metal up to 10 %% too dark");
}

void rt_import_make_plastic(import_material *m, double f0, double strength)
{
    const double root = sqrt(f0 / strength);
    m->coat = fmin(strength, 1);
    m->coat_ior = (1 + root) / (1 - fmin(root, 0.999));
    m->coat_roughness = m->roughness;
    m->coat_roughness_texture = m->roughness_texture;
    m->roughness = m->roughness_v = 0;
    m->roughness_texture = m->roughness_v_texture = IMPORT_NONE;
    m->is_coat_linear = 1;
}

void rt_import_make_coloured_glass(import_material *m, double factor, const double base[3],
                                   int base_texture)
{
    m->is_principled = 1;
    m->fresnel = IMPORT_FRESNEL_OFF;
    memcpy(m->base_color, base, sizeof m->base_color);
    m->base_color_texture = base_texture;
    m->spec_trans = factor;
    m->roughness = sqrt(m->roughness);
    m->roughness_v = 0;
    memset(m->kd, 0, sizeof m->kd);
    memset(m->kt, 0, sizeof m->kt);
    m->kd_texture = m->kt_texture = IMPORT_NONE;
}
