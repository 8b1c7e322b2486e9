/* mitsuba_bsdf_old.c - the materials that Mitsuba 0.x had and Mitsuba 3 has not. */
#include <math.h>
#include <string.h>

#include "dsl/import/mitsuba.h"

enum { MIXED_MAX = 8 };

static const char *type_of(mitsuba *m, xml_node *node)
{
    return rt_mitsuba_text(m, node, "type");
}

/*
 * Lambert's law, rougher by Oren and Nayar's: alpha is sqrt(2) times their deviation of slopes. A
 * texture of it counts by its mean.
 */
void rt_mitsuba_rough_diffuse(mitsuba *m, xml_node *node, import_material *out)
{
    double alpha[3] = {0.2, 0.2, 0.2};
    rt_mitsuba_diffuse(m, node, "reflectance", out);
    if (rt_mitsuba_number_texture(m, node, "alpha", alpha) != IMPORT_NONE)
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "the texture of the alpha of a 'roughdiffuse' is left out: it is %.3g",
                          alpha[0]);
    rt_mitsuba_flag(m, node, "use_fast_approx", 0);
    rt_import_make_rough(rt_mitsuba_at(m, node), node->line, fmax(alpha[0], 0) / sqrt(2), out);
}

/* A number that is told where it is below 0, and then is that. */
static double not_negative(mitsuba *m, xml_node *node, const char *name, double fallback)
{
    const double value = rt_mitsuba_number(m, node, name, fallback);
    if (value < 0)
        rt_import_note_at(rt_mitsuba_at(m, node), node->line, "a negative %s became 0", name);
    return fmax(value, 0);
}

/* A coat over another material, smooth or rough, that may absorb. */
void rt_mitsuba_coating(mitsuba *m, xml_node *node, import_material *out, int depth)
{
    double absorbed[3] = {0, 0, 0}, alpha[3] = {0.1, 0.1, 0.1};
    rt_mitsuba_inner(m, node, out, depth);
    const double ior =
        rt_mitsuba_ior(m, node, "int_ior", 1.5046) / rt_mitsuba_ior(m, node, "ext_ior", 1.000277);
    const double thickness = not_negative(m, node, "thickness", 1);
    rt_mitsuba_colour(m, node, "sigma_a", absorbed);
    const int is_coated = strcmp(type_of(m, node), "roughcoating") == 0,
              texture =
                  is_coated ? rt_mitsuba_number_texture(m, node, "alpha", alpha) : IMPORT_NONE;
    const double *through = out->diffuse_transmission;
    if (out->blend != IMPORT_NONE || out->coat > 0 || out->is_principled ||
        through[0] + through[1] + through[2] > 0 || rt_import_lets_light_through(out)) {
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "the coat over what is no diffuse material or metal is left out");
        return;
    }
    out->is_rough_diffuse = 0; /* the language has no coat over it */
    out->coat = 1;
    out->coat_ior = ior;
    out->coat_roughness = is_coated ? alpha[0] : 0;
    out->coat_roughness_texture = texture;
    for (int c = 0; c < 3; c++)
        out->coat_absorption[c] = absorbed[c] * fmax(thickness, 0);
    rt_import_note_at(
        rt_mitsuba_at(m, node), node->line,
        "a coat keeps the light that it reflects back inside, which Mitsuba 0.x loses");
}

/* A glossy lobe beside a diffuse one, which became GGX of the same width. */
void rt_mitsuba_glossy(mitsuba *m, xml_node *node, import_material *out)
{
    const int is_phong = strcmp(type_of(m, node), "phong") == 0;
    out->ks[0] = out->ks[1] = out->ks[2] = 0.2;
    rt_mitsuba_diffuse(m, node, "diffuse_reflectance", out);
    out->ks_texture = rt_mitsuba_texture(m, node, "specular_reflectance", out->ks);
    if (is_phong) {
        /* around the mirrored direction; around normals, at half of that, four times as much */
        out->roughness = sqrt(2 / (4 * not_negative(m, node, "exponent", 30) + 2));
    } else {
        const double alpha = rt_mitsuba_number(m, node, "alpha", 0.1);
        rt_import_set_alphas(out, rt_mitsuba_number(m, node, "alpha_u", alpha),
                             rt_mitsuba_number(m, node, "alpha_v", alpha));
    }
    rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                      "the lobe of a '%.20s' became one of GGX of the same width",
                      type_of(m, node));
}

/* As many weights as there are materials; equal ones, which is told, where some are not given. */
static void read_weights(mitsuba *m, xml_node *node, int count, double *weights)
{
    const char *at = rt_mitsuba_string(m, node, "weights");
    double sum = 0;
    int given = 0;
    for (; at && given < count && rt_import_number(&weights[given], &at); given++) {
        sum += weights[given];
        if (!(weights[given] >= 0))
            break;
        at += strspn(at, ", \t\n");
    }
    if (given < count || (at && *at) || !(sum > 0)) {
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "the weights of a 'mixturebsdf', one number from 0 to 1 for each of its "
                          "%d materials, became %.3g each",
                          count, 1.0 / count);
        for (int i = 0; i < count; i++)
            weights[i] = 1.0 / count;
    } else if (sum > 1.001) {
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "the weights of a 'mixturebsdf' add up to %.4g: divided by that", sum);
        for (int i = 0; i < count; i++)
            weights[i] /= sum;
    }
}

/* By a list of weights; what these leave is black. */
void rt_mitsuba_mixture(mitsuba *m, xml_node *node, import_material *out, int depth)
{
    import_part parts[MIXED_MAX + 2];
    double weights[MIXED_MAX + 2], all = 0;
    int count = rt_mitsuba_parts(m, node, parts, MIXED_MAX + 1, depth);
    if (count > MIXED_MAX) {
        rt_import_fail(rt_mitsuba_at(m, node), node->line,
                       "a 'mixturebsdf' of more than %d materials", MIXED_MAX);
        return;
    }
    read_weights(m, node, count, weights);
    for (int i = 0; i < count; i++)
        all += weights[i];
    if (all < 0.999) {
        parts[count] = (import_part){"black", rt_import_material_begin(), 1};
        weights[count++] = 1 - all;
    }
    *out = parts[--count].material;
    all = weights[count];
    while (count-- > 0) {
        const import_part pair[2] = {parts[count], {"rest", *out, 0}};
        all += weights[count];
        rt_import_blend(rt_mitsuba_at(m, node), node->line, out, pair,
                        all > 0 ? 1 - weights[count] / all : 0, IMPORT_NONE);
    }
}
