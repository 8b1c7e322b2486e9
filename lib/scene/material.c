/* material.c - adding materials to a scene: defaults, ranges, and energy conservation. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/error.h"
#include "bsdf/lobes.h"
#include "scene/check.h"
#include "scene/inside.h"
#include "scene/parts.h"
#include "scene/scene.h"

/* What a fraction in decimals may exceed 1 by. */
static const double rounding = 1e-6;

/* ---- Inputs ------------------------------------------------------------------ */

/* A texture stands for a value that is all zero. */
static void complete_colour(float colour[3], uint32_t texture)
{
    if (texture && rt_is_black(colour))
        colour[0] = colour[1] = colour[2] = 1;
}

static void complete_number(float *number, uint32_t texture)
{
    *number = texture && *number == 0 ? 1 : *number;
}

static rt_status check_number(float number, float most, const char *who, const char *field,
                              rt_error *error)
{
    if (number >= 0 && number <= most)
        return RT_OK;
    return rt_fail_field(error, RT_ERROR_INPUT, field, "%s: %s is %g; it must lie from 0 to %g",
                         who, field, number, most);
}

#define CHECK_COLOUR_TEXTURE(name, RANGE)
#define CHECK_NUMBER_TEXTURE(name, RANGE)                                                          \
    if (status == RT_OK)                                                                           \
        status = rt_texture_check_number(scene, m->name, m->name##_texture, RT_MOST_##RANGE, who,  \
                                         #name "_texture", error);
#define CHECK_COLOUR(name, RANGE)                                                                  \
    status = rt_check_colour(m->name, who, #name, error);                                          \
    complete_colour(m->name, m->name##_texture);
#define CHECK_NUMBER(name, RANGE)                                                                  \
    status = check_number(m->name, RT_MOST_##RANGE, who, #name, error);                            \
    complete_number(&m->name, m->name##_texture);
#define CHECK_INPUT(TYPE, name, RANGE, NEED, unit, help)                                           \
    if (status == RT_OK) {                                                                         \
        CHECK_##TYPE(name, RANGE)                                                                  \
    }                                                                                              \
    if (status == RT_OK)                                                                           \
        status = rt_texture_check_colours(scene, m->name##_texture, who, #name "_texture", error); \
    CHECK_##TYPE##_TEXTURE(name, RANGE)

/* Checks and completes the inputs. */
static rt_status check_inputs(const rt_scene *scene, rt_material *m, const char *who,
                              rt_error *error)
{
    rt_status status = RT_OK;
    RT_MATERIAL_INPUTS(CHECK_INPUT)
    return status;
}

/* Decoded from sRGB, a normal map would lean all normals to one side. */
static rt_status check_normals(const rt_scene *scene, rt_material *m, const char *who,
                               rt_error *error)
{
    rt_status status = rt_texture_check(scene, m->normal_texture, who, "normal_texture", error);
    if (status != RT_OK)
        return status;
    if (m->normal_texture && scene->textures[m->normal_texture - 1].is_srgb)
        return rt_fail_field(
            error, RT_ERROR_INPUT, "normal_texture",
            "%s: normal_texture holds directions, not sRGB: its texture needs `linear true`", who);
    if (m->normal_texture && scene->textures[m->normal_texture - 1].is_turned &&
        scene->textures[m->normal_texture - 1].levels > 1)
        return rt_fail_field(
            error, RT_ERROR_INPUT, "normal_texture",
            "%s: normal_texture has a rotated texture inside, whose directions would stay", who);
    if (m->normal_scale == 0)
        m->normal_scale = 1;
    if (!(fabsf(m->normal_scale) <= RT_COORDINATE_MAX))
        return rt_fail_field(error, RT_ERROR_INPUT, "normal_scale",
                             "%s: normal_scale is %g; at most %g is allowed", who, m->normal_scale,
                             RT_COORDINATE_MAX);
    return RT_OK;
}

static rt_status check_bumps(const rt_scene *scene, rt_material *m, const char *who,
                             rt_error *error)
{
    rt_status status = rt_texture_check(scene, m->bump_texture, who, "bump_texture", error);
    if (status != RT_OK)
        return status;
    if (m->bump_scale == 0)
        m->bump_scale = 1;
    if (!(fabsf(m->bump_scale) <= RT_COORDINATE_MAX))
        return rt_fail_field(error, RT_ERROR_INPUT, "bump_scale", "%s: bump_scale is %g m", who,
                             m->bump_scale);
    return RT_OK;
}

/* ---- Energy conservation ----------------------------------------------------- */

static double largest(const rt_scene *scene, float colour, uint32_t texture, int channel)
{
    return texture ? (double)colour * scene->textures[texture - 1].largest[channel] : colour;
}

/* The field to point at: the first that counts, or its texture. */
static const char *largest_field(const rt_material *m, double kd, double ks, double kt)
{
    if (kd > 0)
        return m->kd_texture ? "kd_texture" : "kd";
    if (ks > 0)
        return m->ks_texture ? "ks_texture" : "ks";
    if (kt > 0)
        return m->kt_texture ? "kt_texture" : "kt";
    return m->diffuse_transmission_texture ? "diffuse_transmission_texture"
                                           : "diffuse_transmission";
}

/* Adds the file of a texture to a list, if it has one that fits, or those of what is inside. */
static void name_image(char *list, size_t size, const rt_scene *scene, uint32_t texture)
{
    const size_t used = strlen(list);
    if (!texture)
        return;
    const rt_scene_texture *const named = scene->textures + texture - 1;
    if (named->path && used + 1 < size)
        snprintf(list + used, size - used, "%s%.80s", used > 0 ? ", " : "", named->path);
    for (int i = 0; i < 2; i++)
        name_image(list, size, scene, named->parts[i]);
}

/* What messages say of the textures behind a colour; out: "" where there are none. */
static void describe_textures(char *out, size_t size, const rt_scene *scene, const rt_material *m,
                              uint32_t shape_texture)
{
    const uint32_t textures[] = {m->kd_texture, shape_texture, m->ks_texture, m->kt_texture,
                                 m->diffuse_transmission_texture};
    char images[300] = "";
    int is_any = 0;
    for (size_t i = 0; i < sizeof textures / sizeof *textures; i++) {
        is_any |= textures[i] != 0;
        name_image(images, sizeof images, scene, textures[i]);
    }
    snprintf(out, size, "%s%s%s%s", is_any ? " where the textures are brightest" : "",
             *images ? " (" : "", images, *images ? ")" : "");
}

rt_status rt_material_check_albedo(const rt_scene *scene, const rt_material *m,
                                   uint32_t shape_texture, const char *who, const char *field,
                                   rt_error *error)
{
    static const char *const channel[] = {"red", "green", "blue"};
    for (int c = 0; c < 3; c++) {
        double kd = largest(scene, m->kd[c], m->kd_texture, c),
               ks = largest(scene, m->ks[c], m->ks_texture, c);
        double kt = largest(scene, m->kt[c], m->kt_texture, c);
        double through =
            largest(scene, m->diffuse_transmission[c], m->diffuse_transmission_texture, c);
        double sum = largest(scene, (float)kd, shape_texture, c) + through;
        sum += rt_material_is_principled(m) ? 0 : ks + kt;
        if (sum > 1 + rounding) {
            char textures[350];
            describe_textures(textures, sizeof textures, scene, m, shape_texture);
            return rt_fail_field(
                error, RT_ERROR_INPUT, field ? field : largest_field(m, kd, ks, kt),
                "%s: %s%s is %g in %s%s; it must not exceed 1%s", who,
                rt_material_is_principled(m) ? "base_color" : "kd + ks + kt",
                through > 0 ? " + diffuse_transmission" : "", sum, channel[c], textures,
                m->metal   ? ": a metal has ks 1 where it is left out"
                : m->glass ? ": a glass has kt 1 where it is left out"
                           : "");
        }
    }
    return RT_OK;
}

/* ---- The rest ---------------------------------------------------------------- */

static rt_status check_conductor(const rt_material *m, const char *who, rt_error *error)
{
    for (int c = 0; c < 3; c++) {
        if (rt_is_black(m->eta))
            return rt_fail_field(error, RT_ERROR_INPUT, "eta",
                                 "%s: a conductor needs eta, its index of refraction", who);
        if (!(m->eta[c] > 0 && m->eta[c] <= 100))
            return rt_fail_field(
                error, RT_ERROR_INPUT, "eta",
                "%s: eta has the component %g; that of a conductor must lie between 0 and 100", who,
                m->eta[c]);
        if (!(m->k[c] >= 0 && m->k[c] <= 100))
            return rt_fail_field(error, RT_ERROR_INPUT, "k",
                                 "%s: k has the component %g; it must lie from 0 to 100", who,
                                 m->k[c]);
        if (m->kt[c] != 0)
            return rt_fail_field(error, RT_ERROR_INPUT, "kt",
                                 "%s: a conductor lets no light through", who);
    }
    return RT_OK;
}

int rt_material_is_conductor(const rt_material *m)
{
    return m->fresnel == RT_FRESNEL_CONDUCTOR || m->fresnel == RT_FRESNEL_SCHLICK;
}

/* At grazing angles such a metal reflects all light, which leaves none for another lobe. */
static rt_status check_schlick(const rt_material *m, const char *who, rt_error *error)
{
    const char *other = !rt_is_black(m->kd) ? "kd" : !rt_is_black(m->kt) ? "kt" : NULL;
    if (rt_is_black(m->ks))
        return rt_fail_field(error, RT_ERROR_INPUT, "fresnel",
                             "%s: fresnel schlick needs ks above 0, what the metal reflects at "
                             "normal incidence",
                             who);
    if (other)
        return rt_fail_field(error, RT_ERROR_INPUT, other,
                             "%s: fresnel schlick is a metal, which has no %s; a blend mixes it "
                             "with other materials",
                             who, other);
    return RT_OK;
}

/* A solid whose boundary is not there for some rays would have no inside. */
static rt_status check_opacity(const rt_scene *scene, rt_material *m, const char *who,
                               rt_error *error)
{
    if (m->opacity == 0)
        m->opacity = 1;
    if (!(m->opacity > 0 && m->opacity <= 1))
        return rt_fail_field(error, RT_ERROR_INPUT, "opacity",
                             "%s: opacity is %g; it must lie above 0, and be at most 1", who,
                             m->opacity);
    if (!(m->opacity_cutoff >= 0 && m->opacity_cutoff <= 1))
        return rt_fail_field(error, RT_ERROR_INPUT, "opacity_cutoff",
                             "%s: opacity_cutoff is %g; it must lie from 0 to 1", who,
                             m->opacity_cutoff);
    rt_status status =
        rt_texture_check_colours(scene, m->opacity_texture, who, "opacity_texture", error);
    if (status == RT_OK)
        status = rt_texture_check_number(scene, m->opacity, m->opacity_texture, 1, who,
                                         "opacity_texture", error);
    if (status != RT_OK || (m->opacity == 1 && !m->opacity_texture))
        return status;
    if (rt_material_is_transparent(m) || m->interface)
        return rt_fail_field(error, RT_ERROR_INPUT,
                             m->opacity_texture ? "opacity_texture" : "opacity",
                             "%s: a solid has no opacity below 1: it would have no inside where "
                             "its surface is not; of a sheet%s",
                             who,
                             m->thin ? " around a medium, leave out absorption and scattering"
                                     : ", say `thin true`");
    return RT_OK;
}

static rt_status check_surface(rt_material *m, const char *who, rt_error *error)
{
    if (m->ior == 0)
        m->ior = 1.5f;
    if (!(m->ior >= 0.1f && m->ior <= 10))
        return rt_fail_field(error, RT_ERROR_INPUT, "ior",
                             "%s: ior is %g; it must lie between 0.1 and 10", who, m->ior);
    if (m->exponent != 0 && !(m->exponent >= 1 && m->exponent <= 1e4f))
        return rt_fail_field(error, RT_ERROR_INPUT, "exponent",
                             "%s: exponent is %g; it must lie between 1 and 10000", who,
                             m->exponent);
    if (m->priority < 0)
        return rt_fail_field(error, RT_ERROR_INPUT, "priority",
                             "%s: priority is %d; it must not be negative", who, m->priority);
    if ((unsigned)m->fresnel > RT_FRESNEL_SCHLICK)
        return rt_fail_field(error, RT_ERROR_INPUT, "fresnel", "%s: there is no fresnel mode %d",
                             who, (int)m->fresnel);
    return m->fresnel == RT_FRESNEL_CONDUCTOR ? check_conductor(m, who, error)
           : m->fresnel == RT_FRESNEL_SCHLICK ? check_schlick(m, who, error)
                                              : RT_OK;
}

/* Phong's lobe is that of ks alone, at any angle. */
static rt_status check_exponent(const rt_material *m, const char *who, rt_error *error)
{
    const char *field = rt_is_black(m->ks)             ? "exponent"
                        : !rt_is_black(m->kt)          ? "kt"
                        : m->roughness != 0            ? "roughness"
                        : m->distribution              ? "distribution"
                        : m->fresnel != RT_FRESNEL_OFF ? "fresnel"
                                                       : NULL;
    if (m->exponent == 0 || !field)
        return RT_OK;
    return rt_fail_field(
        error, RT_ERROR_INPUT, field,
        "%s: exponent goes with ks, and without kt, roughness, distribution and fresnel", who);
}

/* Facets have two directions where they have a roughness along both. */
static rt_status check_anisotropy(const rt_material *m, const char *who, rt_error *error)
{
    if (m->roughness_v > 0 && m->roughness == 0)
        return rt_fail_field(error, RT_ERROR_INPUT,
                             m->roughness_v_texture ? "roughness_v_texture" : "roughness_v",
                             "%s: roughness_v goes with roughness, which is alpha along u", who);
    if (!isfinite(m->anisotropy_rotation))
        return rt_fail_field(error, RT_ERROR_INPUT, "anisotropy_rotation",
                             "%s: anisotropy_rotation is %g degrees; it must be finite", who,
                             m->anisotropy_rotation);
    if ((unsigned)m->facet_scattering > RT_FACET_SCATTERING_SEPARABLE)
        return rt_fail_field(error, RT_ERROR_INPUT, "facet_scattering",
                             "%s: there is no facet_scattering %d", who, (int)m->facet_scattering);
    if ((unsigned)m->distribution > RT_DISTRIBUTION_BECKMANN)
        return rt_fail_field(error, RT_ERROR_INPUT, "distribution",
                             "%s: there is no distribution %d", who, (int)m->distribution);
    return RT_OK;
}

/* A coat lies over Lambert's law, over ks, or over both. */
static rt_status check_coat(rt_material *m, const char *who, rt_error *error)
{
    if (m->coat_ior == 0)
        m->coat_ior = 1.5f;
    if (!(m->coat_ior >= 1 && m->coat_ior <= 3))
        return rt_fail_field(error, RT_ERROR_INPUT, "coat_ior",
                             "%s: coat_ior is %g; it must lie between 1 and 3", who, m->coat_ior);
    const char *field = !rt_is_black(m->kt)                       ? "kt"
                        : m->exponent != 0                        ? "exponent"
                        : m->fresnel == RT_FRESNEL_DIELECTRIC     ? "fresnel"
                        : m->roughness != 0 && rt_is_black(m->ks) ? "roughness"
                        : m->fresnel != 0 && rt_is_black(m->ks)   ? "fresnel"
                                                                  : NULL;
    if (m->coat == 0 || !field)
        return RT_OK;
    return rt_fail_field(error, RT_ERROR_INPUT, field,
                         "%s: a coat lies over kd and ks; it goes without kt, exponent and fresnel "
                         "dielectric, and with roughness of ks alone",
                         who);
}

/* What scatters light evenly to both sides has the same medium there, and no facets. */
static rt_status check_translucent(const rt_material *m, const char *who, rt_error *error)
{
    const char *field = m->metal                                  ? "metal"
                        : m->glass && !m->thin                    ? "glass"
                        : rt_material_is_conductor(m)             ? "fresnel"
                        : m->interface                            ? "interface"
                        : !m->thin && !rt_is_black(m->kt)         ? "kt"
                        : !m->thin && m->fresnel                  ? "fresnel"
                        : m->coat != 0                            ? "coat"
                        : m->roughness != 0 && rt_is_black(m->ks) ? "roughness"
                                                                  : NULL;
    if (rt_is_black(m->diffuse_transmission) || !field)
        return RT_OK;
    return rt_fail_field(error, RT_ERROR_INPUT, field,
                         "%s: what has diffuse_transmission is no solid: it goes without metal, "
                         "coat and interface, with kt and fresnel where it is `thin`, and with "
                         "roughness of ks alone",
                         who);
}

/* Cloth is kd below fuzz, and nothing else. */
static rt_status check_fuzz(const rt_scene *scene, const rt_material *m, const char *who,
                            rt_error *error)
{
    const char *field = m->blend                                ? "blend"
                        : m->metal                              ? "metal"
                        : m->glass                              ? "glass"
                        : rt_material_is_principled(m)          ? rt_principled_member(m)
                        : !rt_is_black(m->ks)                   ? "ks"
                        : !rt_is_black(m->kt)                   ? "kt"
                        : !rt_is_black(m->diffuse_transmission) ? "diffuse_transmission"
                        : m->roughness != 0                     ? "roughness"
                        : m->coat != 0                          ? "coat"
                        : m->fresnel                            ? "fresnel"
                        : m->interface                          ? "interface"
                                                                : NULL;
    if (m->fuzz_roughness != 0 && rt_is_black(m->fuzz))
        return rt_fail_field(error, RT_ERROR_INPUT,
                             m->fuzz_roughness_texture ? "fuzz_roughness_texture"
                                                       : "fuzz_roughness",
                             "%s: fuzz_roughness goes with fuzz", who);
    for (int c = 0; c < 3; c++) {
        const double most = largest(scene, m->fuzz[c], m->fuzz_texture, c);
        if (most > 1)
            return rt_fail_field(error, RT_ERROR_INPUT, m->fuzz_texture ? "fuzz_texture" : "fuzz",
                                 "%s: fuzz reaches %g; it must not exceed 1", who, most);
    }
    if (rt_is_black(m->fuzz) || !field)
        return RT_OK;
    return rt_fail_field(error, RT_ERROR_INPUT, field,
                         "%s: fuzz lies over kd alone; it goes without %s", who, field);
}

/* A sheet is smooth; one around a medium has no other light through it than straight. */
static rt_status check_thin(const rt_material *m, const char *who, rt_error *error)
{
    const int is_filled = rt_material_is_filled(m);
    const char *field = m->roughness != 0                ? "roughness"
                        : m->exponent != 0               ? "exponent"
                        : m->coat != 0                   ? "coat"
                        : m->interface                   ? "interface"
                        : m->metal                       ? "metal"
                        : rt_material_is_conductor(m)    ? "fresnel"
                        : m->density && !is_filled       ? "density"
                        : m->albedo && !is_filled        ? "albedo"
                        : m->priority != 0 && !is_filled ? "priority"
                        : is_filled && !rt_is_black(m->diffuse_transmission)
                            ? "diffuse_transmission"
                            : NULL;
    if (!m->thin || !field || rt_material_is_principled(m))
        return RT_OK;
    const char *what = strcmp(field, "fresnel") != 0        ? field
                       : m->fresnel == RT_FRESNEL_CONDUCTOR ? "fresnel conductor"
                                                            : "fresnel schlick";
    return rt_fail_field(error, RT_ERROR_INPUT, field,
                         "%s: a thin sheet %s is a smooth dielectric, and has no %s", who,
                         is_filled ? "around a medium" : "without absorption or scattering", what);
}

/* An interface is kept as a boundary that all light passes: nothing else holds of its surface. */
static rt_status complete_interface(rt_material *m, const char *who, rt_error *error)
{
    if (!m->interface)
        return RT_OK;
    const char *field = !rt_is_black(m->kd)   ? "kd"
                        : !rt_is_black(m->ks) ? "ks"
                        : !rt_is_black(m->kt) ? "kt"
                        : m->roughness != 0   ? "roughness"
                        : m->exponent != 0    ? "exponent"
                        : m->coat != 0        ? "coat"
                        : m->bump_texture     ? "bump_texture"
                        : m->normal_texture   ? "normal_texture"
                        : m->metal            ? "metal"
                        : m->glass            ? "glass"
                        : m->fresnel          ? "fresnel"
                                              : rt_dispersion_member(m);
    if (field)
        return rt_fail_field(error, RT_ERROR_INPUT, field,
                             "%s: an interface has no surface, and so no %s", who, field);
    m->kt[0] = m->kt[1] = m->kt[2] = 1;
    m->ior = 1;
    return RT_OK;
}

static void whiten(float colour[3])
{
    colour[0] = colour[1] = colour[2] = 1;
}

/* What a metal or a glass by name stands for takes the place of members that are left out. */
static rt_status complete_named(rt_material *m, const char *who, rt_error *error)
{
    const char *field = !m->metal && !m->glass             ? NULL
                        : m->metal && m->glass             ? "glass"
                        : m->fresnel                       ? "fresnel"
                        : m->ior != 0                      ? "ior"
                        : m->metal && !rt_is_black(m->eta) ? "eta"
                        : m->metal && !rt_is_black(m->k)   ? "k"
                        : m->metal && !rt_is_black(m->kt)  ? "kt"
                                                           : NULL;
    if (field)
        return rt_fail_field(error, RT_ERROR_INPUT, field, "%s: takes %s or %s, not both", who,
                             m->metal ? "metal" : "glass", field);
    if (m->metal && !rt_metal_index(m->metal, m->eta, m->k))
        return rt_fail_field(error, RT_ERROR_INPUT, "metal", "%s: there is no metal %d", who,
                             (int)m->metal);
    if (m->glass && (m->ior = rt_glass_ior(m->glass)) == 0)
        return rt_fail_field(error, RT_ERROR_INPUT, "glass", "%s: there is no glass %d", who,
                             (int)m->glass);
    if (m->metal || m->glass)
        m->fresnel = m->metal ? RT_FRESNEL_CONDUCTOR : RT_FRESNEL_DIELECTRIC;
    if (m->metal && rt_is_black(m->ks))
        whiten(m->ks);
    if (m->glass && rt_is_black(m->ks) && rt_is_black(m->kt))
        whiten(m->kt);
    return RT_OK;
}

int rt_material_is_rough(const rt_material *m)
{
    return rt_material_is_principled(m) ||
           fmaxf(m->coat > 0 ? m->coat_roughness : 0, fmaxf(m->roughness, m->roughness_v)) >=
               RT_SMOOTH_ALPHA ||
           m->exponent > 0;
}

int rt_material_is_lacquer(const rt_material *m)
{
    return m->coat > 0 && !rt_is_black(m->ks);
}

/* A coat, and ks where there is none, may be smooth where the other is rough. */
int rt_material_is_mirror(const rt_material *m)
{
    const int is_bare = m->coat < 1 || m->coat_texture;
    if (!rt_material_is_specular(m))
        return 0;
    if (!rt_material_is_lacquer(m))
        return !rt_material_is_rough(m);
    return m->coat_roughness < RT_SMOOTH_ALPHA ||
           (is_bare && fmaxf(m->roughness, m->roughness_v) < RT_SMOOTH_ALPHA);
}

int rt_material_is_diffuse(const rt_material *m)
{
    return !rt_is_black(m->kd) || !rt_is_black(m->diffuse_transmission) || !rt_is_black(m->fuzz);
}

int rt_material_is_specular(const rt_material *m)
{
    return !rt_is_black(m->ks) || !rt_is_black(m->kt) || m->coat > 0 ||
           rt_material_is_principled(m);
}

/* Beside ks or kt, roughness is theirs. */
rt_u32 rt_material_diffuse_lobe(const rt_material *m)
{
    if (!rt_is_black(m->fuzz))
        return RT_LOBE_FUZZ;
    if (m->coat > 0)
        return RT_LOBE_COATED;
    if (!rt_is_black(m->diffuse_transmission))
        return RT_LOBE_TRANSLUCENT;
    if (rt_material_is_principled(m))
        return RT_LOBE_PRINCIPLED_DIFFUSE;
    const int is_rough = m->roughness > 0 && rt_is_black(m->ks) && rt_is_black(m->kt);
    return is_rough ? RT_LOBE_OREN_NAYAR : RT_LOBE_LAMBERT;
}

rt_status rt_scene_add_material(rt_scene *scene, uint32_t *out, const char *name,
                                const rt_material *material, rt_error *error)
{
    char who[128] = "material";
    rt_material m = *material;
    rt_status status;

    if (name)
        snprintf(who, sizeof who, "material '%.100s'", name);
    if ((status = check_inputs(scene, &m, who, error)) != RT_OK ||
        (status = rt_check_colour(m.absorption, who, "absorption", error)) != RT_OK ||
        (status = rt_medium_check(m.scattering, m.g, who, error)) != RT_OK ||
        (status = rt_grid_check_medium(scene, m.density, m.absorption, m.scattering, who, error)) !=
            RT_OK ||
        (status = rt_grid_check_albedo(scene, m.albedo, who, error)) != RT_OK ||
        (status = check_bumps(scene, &m, who, error)) != RT_OK ||
        (status = check_normals(scene, &m, who, error)) != RT_OK ||
        (status = check_fuzz(scene, &m, who, error)) != RT_OK ||
        (status = rt_parts_complete(scene, &m, who, error)) != RT_OK ||
        (status = complete_interface(&m, who, error)) != RT_OK ||
        (status = complete_named(&m, who, error)) != RT_OK ||
        (status = rt_principled_complete(&m, who, error)) != RT_OK ||
        (status = rt_dispersion_complete(&m, who, error)) != RT_OK ||
        (status = check_thin(&m, who, error)) != RT_OK ||
        (status = check_translucent(&m, who, error)) != RT_OK ||
        (status = rt_material_check_albedo(scene, &m, 0, who, NULL, error)) != RT_OK ||
        (status = check_surface(&m, who, error)) != RT_OK ||
        (status = check_exponent(&m, who, error)) != RT_OK ||
        (status = check_anisotropy(&m, who, error)) != RT_OK ||
        (status = check_coat(&m, who, error)) != RT_OK ||
        (status = check_opacity(scene, &m, who, error)) != RT_OK ||
        (status = rt_parts_check_back(scene, &m, who, error)) != RT_OK)
        return status;
    status = rt_grow(scene->memory, (void **)&scene->materials, &scene->material_room,
                     scene->material_count, sizeof m, "the list of materials", error);
    if (status != RT_OK)
        return status;
    if (out)
        *out = (uint32_t)scene->material_count;
    scene->materials[scene->material_count++] = m;
    return RT_OK;
}
