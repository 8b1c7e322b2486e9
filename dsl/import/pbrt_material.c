/*
 * pbrt_material.c - materials and textures of pbrt-v4. Where remaproughness is true, alpha of GGX
 * is the square root of the roughness.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "dsl/import/pbrt.h"

/* ---- Textures ---------------------------------------------------------------- */

static const import_factor *find_texture(pbrt *p, int line, const char *name)
{
    const int at = rt_name_table_find(&p->texture_names, name);
    if (at >= 0)
        return &p->textures[at];
    rt_import_note_at(p->import, line, "there is no texture '%.60s': it is left out", name);
    return NULL;
}

static void read_mapping(pbrt_params *params, import_texture *texture)
{
    texture->scale[0] = rt_pbrt_number(params, "uscale", 1);
    texture->scale[1] = rt_pbrt_number(params, "vscale", 1);
    texture->offset[0] = rt_pbrt_number(params, "udelta", 0);
    texture->offset[1] = rt_pbrt_number(params, "vdelta", 0);
    if (strcmp(rt_pbrt_string(params, "mapping", "uv"), "uv") != 0)
        rt_import_note_at(params->import, params->line, "the mapping of a texture became uv");
    for (int i = 0; i < 2; i++)
        if (texture->scale[i] == 0)
            texture->scale[i] = 1;
}

static void keep_image(pbrt *p, int handle, const import_texture *texture)
{
    pbrt_image *moved = rt_pbrt_grow(p->import, p->images, &p->image_count, sizeof *p->images);
    if (!moved)
        return;
    p->images = moved;
    pbrt_image *image = moved + p->image_count - 1;
    *image = (pbrt_image){.handle = handle, .root = IMPORT_NONE, .texture = *texture};
    snprintf(image->file, sizeof image->file, "%s", texture->file);
}

/*
 * What a number takes of an image, named so here: alpha where that is not 1 everywhere, decoded as
 * the colours are, sRGB by its power of 2.2; else the mean of the colours.
 */
static void take_number(pbrt *p, pbrt_params *params, const char *name, import_texture *texture)
{
    const char *const extension = strrchr(texture->file, '.');
    if (p->tokens.is_v3 || !rt_import_alpha_counts(p->import, params->line, name))
        return;
    const int has_codes = !texture->is_linear && extension && strcmp(extension, ".exr") != 0;
    texture->channel = 'a';
    texture->power = has_codes ? 2.2 : 0;
    texture->is_linear = 0;
}

static void read_image(pbrt *p, pbrt_params *params, const char *base, const char *type,
                       import_factor *out)
{
    import_texture texture = {0};
    char file[512];
    const char *name = rt_pbrt_string(params, "filename", NULL),
               *wrap =
                   rt_pbrt_word(params, "wrap", "repeat clamp black octahedralsphere", "repeat"),
               *encoding = rt_pbrt_string(params, "encoding", "sRGB");
    double scale = rt_pbrt_number(params, "scale", 1);
    read_mapping(params, &texture);
    const char *const filter =
        rt_pbrt_word(params, "filter", "bilinear point trilinear ewa EWA", "bilinear");
    texture.is_nearest = strcmp(filter, "point") == 0;
    texture.is_linear = strcmp(encoding, "linear") == 0 || !rt_pbrt_flag(params, "gamma", 1);
    if (strcasecmp(encoding, "sRGB") != 0 && strcmp(encoding, "linear") != 0)
        rt_import_note_at(p->import, params->line, "the encoding '%.40s' of a texture became sRGB",
                          encoding);
    texture.wrap = strcmp(wrap, "clamp") == 0 || strcmp(wrap, "black") == 0 ? 2 : 0;
    if (strcmp(wrap, "black") == 0 || strcmp(wrap, "octahedralsphere") == 0)
        rt_import_note_at(p->import, params->line, "the wrap '%s' of a texture became %s", wrap,
                          texture.wrap ? "clamp" : "repeat");
    const int is_inverted = rt_pbrt_flag(params, "invert", 0),
              is_number = strcmp(type, "float") == 0;
    if (is_inverted && !is_number)
        rt_import_note_at(p->import, params->line, "the inversion of a texture is left out");
    if (!name) {
        rt_import_note_at(p->import, params->line, "an imagemap without filename is white");
        return;
    }
    out->colour[0] = out->colour[1] = out->colour[2] = scale;
    if (!rt_import_image_file(p->import, params->line, file, name))
        return;
    texture.file = file;
    if (is_number)
        take_number(p, params, name, &texture);
    out->handle = rt_import_add_texture(p->import, base, &texture);
    keep_image(p, out->handle, &texture);
    if (is_inverted && is_number) {
        const import_factor image = *out, one = {IMPORT_NONE, {1, 1, 1}}, none = {IMPORT_NONE, {0}};
        *out = rt_import_mixture(p->import, params->line, base, &one, &none, &image);
    }
}

/* The texture of the square roots of what a texture has; IMPORT_NONE where that is no image. */
static int root_of(pbrt *p, int handle)
{
    size_t i = 0;
    while (i < p->image_count && p->images[i].handle != handle)
        i++;
    if (i == p->image_count)
        return IMPORT_NONE;
    pbrt_image *image = p->images + i;
    if (image->root == IMPORT_NONE) {
        import_texture texture = image->texture;
        texture.file = image->file;
        texture.power = texture.power != 0 ? 0.5 * texture.power : 0.5;
        image->root = rt_import_add_texture(p->import, "roughness", &texture);
    }
    return image->root;
}

/* The texture that a parameter names, or NULL, which is told where there is none of that name. */
static const import_factor *texture_of(pbrt *p, pbrt_params *params, const char *name)
{
    const pbrt_param *const param = rt_pbrt_find(params, "texture", name);
    return param && param->string_count ? find_texture(p, param->line, param->strings[0]) : NULL;
}

/* A colour, a number or a texture by its name. */
static import_factor read_factor(pbrt *p, pbrt_params *params, const char *name, double fallback)
{
    import_factor out = {IMPORT_NONE, {fallback, fallback, fallback}};
    const import_factor *const texture = texture_of(p, params, name);
    if (!texture)
        rt_pbrt_colour(params, name, out.colour);
    return texture ? *texture : out;
}

/* By their pattern: what two textures or colours become. */
static import_factor read_pair(pbrt *p, pbrt_params *params, const char *name, const char *kind)
{
    import_texture place = {0};
    if (strcmp(kind, "scale") == 0) {
        const import_factor a = read_factor(p, params, "tex", 1),
                            b = read_factor(p, params, "scale", 1),
                            old[] = {read_factor(p, params, "tex1", 1),
                                     read_factor(p, params, "tex2", 1)},
                            both = rt_import_product(p->import, params->line, name, &a, &b),
                            more =
                                rt_import_product(p->import, params->line, name, &old[0], &old[1]);
        return rt_import_product(p->import, params->line, name, &both, &more);
    }
    const import_factor a = read_factor(p, params, "tex1", strcmp(kind, "mix") != 0),
                        b = read_factor(p, params, "tex2", strcmp(kind, "mix") == 0);
    if (strcmp(kind, "mix") == 0) {
        const import_factor amount = read_factor(p, params, "amount", 0.5);
        return rt_import_mixture(p->import, params->line, name, &a, &b, &amount);
    }
    read_mapping(params, &place);
    if (rt_pbrt_number(params, "dimension", 2) != 2)
        rt_import_note_at(p->import, params->line, "a checkerboard in space became one of u and v");
    return rt_import_checker(p->import, params->line, name, &place, &a, &b);
}

void rt_pbrt_make_texture(pbrt *p, pbrt_params *params, const char *name, const char *type,
                          const char *kind)
{
    import_factor made = {.handle = IMPORT_NONE, .colour = {1, 1, 1}};
    size_t at;
    if (!rt_pbrt_is_among(type, "float spectrum color"))
        rt_import_note_at(p->import, params->line,
                          "a texture of type '%.40s' is taken as one of spectrum", type);
    if (rt_name_table_find(&p->texture_names, name) >= 0)
        rt_import_note_at(p->import, params->line,
                          "the texture '%.60s' is defined again: it is another from here on", name);
    if (strcmp(kind, "imagemap") == 0) {
        read_image(p, params, name, type, &made);
    } else if (strcmp(kind, "checkerboard") == 0 || strcmp(kind, "scale") == 0 ||
               strcmp(kind, "mix") == 0) {
        made = read_pair(p, params, name, kind);
    } else if (strcmp(kind, "constant") == 0) {
        rt_pbrt_colour(params, "value", made.colour);
    } else {
        rt_import_note_at(p->import, params->line, "a texture '%.40s' became grey", kind);
        made.colour[0] = made.colour[1] = made.colour[2] = 0.5;
    }
    rt_pbrt_note_unused(params, kind);
    /* It may scale the earlier one of its name, so it is defined at last. */
    import_factor *moved =
        rt_pbrt_define(p->import, &p->texture_names, name, p->textures, sizeof *p->textures, &at);
    if (!moved)
        return;
    p->textures = moved;
    p->textures[at] = made;
}

/* A colour or texture; returns the texture. */
static int read_colour(pbrt *p, pbrt_params *params, const char *name, double out[3])
{
    const import_factor *const texture = texture_of(p, params, name);
    if (!texture) {
        rt_pbrt_colour(params, name, out);
        return IMPORT_NONE;
    }
    memcpy(out, texture->colour, sizeof texture->colour);
    return texture->handle;
}

int rt_pbrt_input(pbrt *p, pbrt_params *params, const char *name, double out[3])
{
    return read_colour(p, params, name, out);
}

/* ---- Values ------------------------------------------------------------------ */

/* A roughness, by this name or as it is without, and its texture. */
static double read_alpha(pbrt *p, pbrt_params *params, const char *name, double fallback,
                         int is_remapped, int *texture)
{
    import_factor factor = {.handle = IMPORT_NONE};
    const import_factor *const given = texture_of(p, params, name);
    if (given) {
        factor = *given;
        *texture =
            is_remapped && factor.handle != IMPORT_NONE ? root_of(p, factor.handle) : factor.handle;
        if (factor.handle != IMPORT_NONE && *texture == IMPORT_NONE)
            rt_import_note_at(
                p->import, params->line,
                "a roughness by a texture that is no image counts as if that were white");
    } else {
        const double number = rt_pbrt_number(params, name, -HUGE_VAL);
        if (number == -HUGE_VAL)
            return fallback;
        if (number < 0)
            rt_import_note_at(p->import, params->line, "a roughness of %g became 0", number);
        *texture = IMPORT_NONE;
        factor.colour[0] = number;
    }
    return is_remapped ? sqrt(fmax(factor.colour[0], 0)) : fmax(factor.colour[0], 0);
}

/* The name of a parameter of a layer, which is "" or ends in a dot. */
typedef struct layer_name {
    char text[40];
} layer_name;

static layer_name in_layer(const char *layer, const char *name)
{
    layer_name out;
    snprintf(out.text, sizeof out.text, "%s%s", layer, name);
    return out;
}

/* alpha along u and along v, and their textures. */
static void read_alphas(pbrt *p, pbrt_params *params, const char *layer, double alpha[2],
                        int textures[2])
{
    static const char *const names[] = {"uroughness", "vroughness"};
    const int is_remapped = rt_pbrt_flag(params, "remaproughness", 1);
    int texture = IMPORT_NONE;
    const double both =
        read_alpha(p, params, in_layer(layer, "roughness").text, 0, is_remapped, &texture);
    for (int i = 0; i < 2; i++) {
        textures[i] = texture;
        alpha[i] =
            read_alpha(p, params, in_layer(layer, names[i]).text, both, is_remapped, &textures[i]);
    }
}

/* The microfacets of ks or kt. */
static void read_facets(pbrt *p, pbrt_params *params, const char *layer, import_material *m)
{
    double alpha[2];
    int textures[2];
    read_alphas(p, params, layer, alpha, textures);
    rt_import_set_alphas(m, alpha[0], alpha[1]);
    m->roughness_texture = textures[0];
    if (textures[0] != textures[1] && m->roughness_v == 0)
        m->roughness_v = alpha[1];
    if (m->roughness_v > 0)
        m->roughness_v_texture = textures[1];
}

/* The glass of a named spectrum, as glass-BK7. Three of pbrt's names leave out the S of theirs. */
static rt_glass find_glass(const char *spectrum)
{
    static const struct {
        const char *name;
        rt_glass glass;
    } flints[] = {
        {"glass-F5", RT_GLASS_SF5}, {"glass-F10", RT_GLASS_SF10}, {"glass-F11", RT_GLASS_SF11}};
    for (size_t i = 0; i < sizeof flints / sizeof *flints; i++)
        if (strcmp(spectrum, flints[i].name) == 0)
            return flints[i].glass;
    return strncmp(spectrum, "glass-", 6) == 0 ? rt_glass_find(spectrum + 6) : RT_GLASS_NONE;
}

/* The glass that a dielectric names, which disperses light; none where its index is a number. */
static rt_glass read_glass(pbrt_params *params)
{
    const pbrt_param *param = rt_pbrt_find(params, "spectrum", "eta");
    float b[3], c[3];
    const rt_glass glass =
        param && param->string_count ? find_glass(param->strings[0]) : RT_GLASS_NONE;
    return rt_glass_sellmeier(glass, b, c) ? glass : RT_GLASS_NONE;
}

/* An index of refraction: a number, or the name of a glass. */
static double read_eta(pbrt *p, pbrt_params *params, const char *layer)
{
    const layer_name eta = in_layer(layer, "eta");
    const pbrt_param *param = rt_pbrt_find(params, "spectrum", eta.text);
    double value = rt_pbrt_number(params, eta.text, 1.5);
    if (param && param->string_count) {
        const rt_glass glass = find_glass(param->strings[0]);
        if (glass != RT_GLASS_NONE)
            return rt_import_ior(glass);
        rt_import_note_at(p->import, param->line, "the glass '%.40s' became one of index %g",
                          param->strings[0], value);
    }
    if (param && param->number_count >= 2) {
        rt_import_note_at(p->import, param->line, "the dispersion of a glass is left out");
        return param->numbers[2 * (param->number_count / 4) + 1];
    }
    value = param && param->number_count == 1 ? param->numbers[0] : value;
    if (value == 0)
        rt_import_note_at(p->import, params->line, "an index of refraction of 0 became 1.5");
    return value;
}

/* eta or k of a metal: a colour, or by name as metal-Cu-eta. */
static void read_metal(pbrt *p, pbrt_params *params, const char *name, int is_k, double out[3])
{
    char metal[16] = "Cu";
    double eta[3], k[3];
    const pbrt_param *param = rt_pbrt_find(params, "spectrum", name);
    if (param && param->string_count)
        sscanf(param->strings[0], "metal-%15[A-Za-z]", metal);
    else if (rt_pbrt_colour(params, name, out))
        return;
    if (!rt_import_metal(metal, eta, k)) {
        rt_import_note_at(p->import, params->line, "the metal '%.20s' became copper", metal);
        rt_import_metal("Cu", eta, k);
    }
    memcpy(out, is_k ? k : eta, sizeof eta);
}

/* ---- Materials --------------------------------------------------------------- */

static void read_conductor(pbrt *p, pbrt_params *params, const char *layer, import_material *m)
{
    double reflectance[3];
    read_facets(p, params, layer, m);
    for (int c = 0; c < 3; c++)
        m->ks[c] = 1;
    if (rt_pbrt_find(params, "texture", "reflectance")) {
        m->ks_texture = read_colour(p, params, "reflectance", m->ks);
        m->fresnel = IMPORT_FRESNEL_SCHLICK;
        rt_import_note_at(p->import, params->line,
                          "a textured metal reflects by Schlick's approximation");
        return;
    }
    m->fresnel = IMPORT_FRESNEL_CONDUCTOR;
    if (rt_pbrt_colour(params, "reflectance", reflectance)) {
        for (int c = 0; c < 3; c++) {
            double r = fmin(fmax(reflectance[c], 0), 0.9995);
            m->eta[c] = 1;
            m->k[c] = 2 * sqrt(r / (1 - r));
        }
        return;
    }
    read_metal(p, params, in_layer(layer, "eta").text, 0, m->eta);
    read_metal(p, params, in_layer(layer, "k").text, 1, m->k);
}

/* What scatters inside of a coat; where nothing does, its thickness has no effect. */
static void note_inside(pbrt *p, pbrt_params *params)
{
    double albedo[3] = {0, 0, 0};
    rt_pbrt_number(params, "maxdepth", 0);
    rt_pbrt_number(params, "nsamples", 0);
    read_colour(p, params, "albedo", albedo);
    if (albedo[0] + albedo[1] + albedo[2] > 0)
        rt_import_note_at(p->import, params->line, "scattering inside of a coat is left out");
    rt_pbrt_number(params, "thickness", 0);
    rt_pbrt_number(params, "g", 0);
}

/* The coat over a base. */
static void read_coat(pbrt *p, pbrt_params *params, const char *layer, import_material *m)
{
    double alpha[2];
    int textures[2];
    m->coat = 1;
    m->coat_ior = read_eta(p, params, layer);
    note_inside(p, params);
    read_alphas(p, params, layer, alpha, textures);
    m->coat_roughness = sqrt(alpha[0] * alpha[1]);
    m->is_coat_single = m->coat_roughness > 0;
    m->coat_roughness_texture = textures[0];
    if (alpha[0] != alpha[1] || textures[0] != textures[1])
        rt_import_note_at(p->import, params->line,
                          "a roughness of a coat by direction became the same for all");
}

/* The same colour of both sides, a quarter of it each, unless the file says otherwise. */
static void read_translucent(pbrt *p, pbrt_params *params, import_material *m)
{
    const double scale = rt_pbrt_number(params, "scale", 1);
    for (int c = 0; c < 3; c++)
        m->kd[c] = m->diffuse_transmission[c] = 0.25;
    m->kd_texture = read_colour(p, params, "reflectance", m->kd);
    m->diffuse_transmission_texture =
        read_colour(p, params, "transmittance", m->diffuse_transmission);
    for (int c = 0; c < 3; c++) {
        m->kd[c] *= scale;
        m->diffuse_transmission[c] *= scale;
    }
}

/* The material of a name, or NULL, which is told. */
static const pbrt_material *find_material(pbrt *p, int line, const char *name)
{
    const int at = rt_name_table_find(&p->material_names, name);
    if (at >= 0)
        return &p->materials[p->latest[at]];
    rt_import_note_at(p->import, line, "there is no material '%.60s': the mix became grey", name);
    return NULL;
}

/* A blend of two materials by name. */
static void read_mix(pbrt *p, pbrt_params *params, import_material *m)
{
    const pbrt_param *names = rt_pbrt_find(params, "string", "materials");
    double amount[3] = {0.5, 0.5, 0.5};
    import_part parts[2];
    m->kd[0] = m->kd[1] = m->kd[2] = 0.5; /* where it cannot be mixed */
    const char *of_v3[2] = {rt_pbrt_string(params, "namedmaterial1", NULL),
                            rt_pbrt_string(params, "namedmaterial2", NULL)};
    const int is_v3 = !names && of_v3[0] && of_v3[1];
    if (!is_v3 && (!names || names->string_count != 2)) {
        rt_import_note_at(p->import, params->line,
                          "a mix became grey: it needs the names of two materials");
        return;
    }
    for (int i = 0; i < 2; i++) {
        /* The amount of v3 is that of the first. */
        const char *name = is_v3 ? of_v3[1 - i] : names->strings[i];
        const pbrt_material *part = find_material(p, params->line, name);
        if (!part)
            return;
        parts[i] = (import_part){.base = part->name, .material = part->material};
    }
    const int texture = read_colour(p, params, "amount", amount);
    if (rt_pbrt_find(params, "float", "amount"))
        amount[0] = amount[1] = amount[2] = rt_pbrt_number(params, "amount", 0.5);
    if (texture == IMPORT_NONE && (amount[0] != amount[1] || amount[1] != amount[2]))
        rt_import_note_at(p->import, params->line, "an amount by colours became its mean");
    rt_import_blend(p->import, params->line, m, parts, (amount[0] + amount[1] + amount[2]) / 3,
                    texture);
}

/*
 * A solid that scatters, in which light walks: pbrt has its diffusion at the surface, by a
 * separable BSSRDF. By the mean free path and a colour, its albedo is that of Chiang, Kutz and
 * Burley ("Practical and Controllable Subsurface Scattering for Production Path Tracing", SIGGRAPH
 * 2016 talks).
 */
static void read_subsurface(pbrt *p, pbrt_params *params, import_material *m)
{
    double absorbed[3], scattered[3], path[3], colour[3];
    const double scale = rt_pbrt_number(params, "scale", 1);
    m->kt[0] = m->kt[1] = m->kt[2] = 1;
    m->fresnel = IMPORT_FRESNEL_DIELECTRIC;
    m->ior = rt_pbrt_number(params, "eta", 1.33);
    m->g = fmin(fmax(rt_pbrt_number(params, "g", 0), -0.99), 0.99);
    read_facets(p, params, "", m);
    rt_pbrt_preset(p, params, "name", absorbed, scattered);
    rt_pbrt_colour(params, "sigma_a", absorbed);
    rt_pbrt_colour(params, "sigma_s", scattered);
    const int has_path = rt_pbrt_colour(params, "mfp", path),
              has_colour = rt_pbrt_colour(params, "reflectance", colour);
    const int is_named = rt_pbrt_string(params, "name", NULL) != NULL;
    for (int c = 0; c < 3 && has_colour && !is_named; c++) {
        const double a = fmin(fmax(colour[c], 0), 1),
                     total = 1 / fmax(has_path ? path[c] : 1, 1e-6);
        const double albedo = 1 - exp(-5.09406 * a + 2.61188 * a * a - 4.31805 * a * a * a);
        absorbed[c] = total * (1 - albedo);
        scattered[c] = total * albedo;
    }
    for (int c = 0; c < 3; c++) {
        m->absorption[c] = fmax(absorbed[c] * scale, 0);
        m->scattering[c] = fmax(scattered[c] * scale, 0);
    }
    if (is_named && (has_path || has_colour))
        rt_import_note_at(p->import, params->line,
                          "reflectance and mfp of a subsurface are left out beside its name");
    rt_import_note_at(p->import, params->line,
                      "a subsurface became a solid in which light scatters");
}

static void read_kind(pbrt *p, pbrt_params *params, const char *type, import_material *m)
{
    if (strcmp(type, "diffuse") == 0) {
        m->kd[0] = m->kd[1] = m->kd[2] = 0.5;
        m->kd_texture = read_colour(p, params, "reflectance", m->kd);
    } else if (strcmp(type, "conductor") == 0) {
        read_conductor(p, params, "", m);
    } else if (strcmp(type, "dielectric") == 0) {
        m->kt[0] = m->kt[1] = m->kt[2] = 1;
        m->fresnel = IMPORT_FRESNEL_DIELECTRIC;
        m->ior = read_eta(p, params, "");
        m->glass = read_glass(params);
        read_facets(p, params, "", m);
    } else if (strcmp(type, "thindielectric") == 0) {
        m->kt[0] = m->kt[1] = m->kt[2] = 1;
        m->fresnel = IMPORT_FRESNEL_DIELECTRIC;
        m->ior = read_eta(p, params, "");
        m->is_thin = 1;
    } else if (strcmp(type, "interface") == 0 || type[0] == '\0' || strcmp(type, "none") == 0) {
        m->kt[0] = m->kt[1] = m->kt[2] = m->ior = 1;
    } else if (strcmp(type, "coateddiffuse") == 0) {
        m->kd[0] = m->kd[1] = m->kd[2] = 0.5;
        m->kd_texture = read_colour(p, params, "reflectance", m->kd);
        read_coat(p, params, "", m);
    } else if (strcmp(type, "coatedconductor") == 0) {
        read_conductor(p, params, "conductor.", m);
        read_coat(p, params, "interface.", m);
    } else if (strcmp(type, "mix") == 0) {
        read_mix(p, params, m);
    } else if (strcmp(type, "diffusetransmission") == 0) {
        read_translucent(p, params, m);
    } else if (strcmp(type, "subsurface") == 0) {
        read_subsurface(p, params, m);
    } else if (!rt_pbrt_v3_material(p, params, type, m)) {
        rt_import_note_at(p->import, params->line,
                          "a material '%.40s' is unknown: diffuse grey of 0.5 stands in its place",
                          type);
        m->kd[0] = m->kd[1] = m->kd[2] = 0.5;
    }
}

void rt_pbrt_bump(pbrt *p, pbrt_params *params, const char *name, import_material *m)
{
    const import_factor height = read_factor(p, params, name, 0);
    m->bump_texture = height.handle;
    m->bump_scale = height.colour[0];
}

/* The maps of normals and of heights. */
static void read_maps(pbrt *p, pbrt_params *params, import_material *m)
{
    const char *normals = rt_pbrt_string(params, "normalmap", NULL);
    char file[512];
    if (normals && rt_import_image_file(p->import, params->line, file, normals)) {
        const import_texture texture = {.file = file, .is_linear = 1, .scale = {1, 1}};
        m->normal_texture = rt_import_add_texture(p->import, "normals", &texture);
    }
    if (rt_pbrt_find(params, "texture", "displacement"))
        rt_pbrt_bump(p, params, "displacement", m);
}

/* From now on the name means the material of that index. */
static void name_material(pbrt *p, const char *name, size_t index)
{
    size_t at;
    size_t *moved =
        rt_pbrt_define(p->import, &p->material_names, name, p->latest, sizeof *p->latest, &at);
    if (!moved)
        return;
    p->latest = moved;
    p->latest[at] = index;
}

size_t rt_pbrt_make_material(pbrt *p, pbrt_params *params, const char *name, const char *type)
{
    pbrt_material *moved =
        rt_pbrt_grow(p->import, p->materials, &p->material_count, sizeof *p->materials);
    if (!moved)
        return 0;
    p->materials = moved;
    pbrt_material made = {.material = rt_import_material_begin(),
                          .place = {p->import->place.file, params->line},
                          .handles = {IMPORT_NONE, IMPORT_NONE}};
    snprintf(made.name, sizeof made.name, "%s", name);
    if (name[0] && rt_name_table_find(&p->material_names, name) >= 0)
        rt_import_note_at(p->import, params->line,
                          "the material '%.60s' is defined again: it is another from here on",
                          name);
    const size_t told = p->import->told;
    read_kind(p, params, type, &made.material);
    if (!rt_import_is_nothing(&made.material) && made.material.blend == IMPORT_NONE)
        read_maps(p, params, &made.material);
    rt_pbrt_note_unused(params, type[0] ? type : "interface");
    made.is_near = p->import->told != told;
    if (p->material_count > 1) /* the first is that of a scene without */
        rt_import_tally(p->import, told, name[0] ? name : type);
    const size_t index = p->material_count - 1;
    p->materials[index] = made;
    if (index > 0)
        name_material(p, name, index);
    return index;
}

/*
 * The index of a material with this opacity and this medium inside, which is made where there is
 * none yet.
 */
static size_t make_variant(pbrt *p, size_t index, const import_factor *opacity, size_t inside)
{
    size_t i = 0;
    while (i < p->material_count &&
           !(p->materials[i].of == index + 1 && p->materials[i].inside == inside &&
             p->materials[i].material.opacity == opacity->colour[0] &&
             p->materials[i].material.opacity_texture == opacity->handle))
        i++;
    if (i < p->material_count)
        return i;
    pbrt_material *moved =
        rt_pbrt_grow(p->import, p->materials, &p->material_count, sizeof *p->materials);
    if (!moved)
        return index;
    p->materials = moved;
    pbrt_material made = p->materials[index];
    made.of = index + 1;
    made.inside = inside;
    made.material.opacity = opacity->colour[0];
    made.material.opacity_texture = opacity->handle;
    made.handles[0] = made.handles[1] = IMPORT_NONE;
    if (inside)
        rt_pbrt_fill(p, rt_pbrt_line(&p->tokens), inside, &made.material);
    p->materials[i] = made;
    return i;
}

/* The opacity of the material of the state, with the alpha of a shape. */
static import_factor read_opacity(pbrt *p, pbrt_params *params)
{
    const import_material *m = &p->materials[p->state.material].material;
    const import_factor own = {.handle = m->opacity_texture, .colour = {m->opacity}};
    import_factor alpha = read_factor(p, params, "alpha", 1);
    if (alpha.handle == IMPORT_NONE)
        alpha.colour[0] = rt_pbrt_number(params, "alpha", alpha.colour[0]);
    const double *const radiance = p->state.radiance;
    if (alpha.handle == IMPORT_NONE && alpha.colour[0] == 0 &&
        fmax(radiance[0], fmax(radiance[1], radiance[2])) > 0) {
        /* pbrt samples such a light, and lets rays go through */
        rt_import_note_at(p->import, params->line,
                          "an area light of alpha 0, which pbrt does not show, is seen");
        return own;
    }
    if (alpha.handle == IMPORT_NONE && alpha.colour[0] >= 1)
        return own;
    if (rt_import_is_solid(m) || (m->opacity > 0 && m->opacity < 1) ||
        m->opacity_texture != IMPORT_NONE || m->is_interface) {
        rt_import_note_at(p->import, params->line,
                          "the alpha of a shape of glass, or of what has an opacity, is left out");
        return own;
    }
    alpha.colour[0] = fmin(fmax(alpha.colour[0], 1e-6), 1);
    return alpha;
}

/* The index of the material of the state, with the alpha and the medium of a shape. */
static size_t choose_variant(pbrt *p, pbrt_params *params)
{
    const size_t index = p->state.material;
    const import_factor opacity = read_opacity(p, params);
    const import_material *m = &p->materials[index].material;
    return opacity.colour[0] == m->opacity && opacity.handle == m->opacity_texture &&
                   !p->state.inside
               ? index
               : make_variant(p, index, &opacity, p->state.inside);
}

/* Counts one of which something was told where it is written as approximated, and that it is of. */
static void note_near(pbrt *p, size_t index)
{
    pbrt_material *material = &p->materials[index];
    if (material->of)
        material = &p->materials[material->of - 1];
    if (material->is_near || material == p->materials)
        return;
    char name[PBRT_TEXT];
    snprintf(name, sizeof name, "material of line %d", material->place.line);
    rt_import_tally_near(p->import, material->name[0] ? material->name : name);
    material->is_near = 1;
}

int rt_pbrt_use_material(pbrt *p, pbrt_params *params)
{
    const size_t index = choose_variant(p, params); /* which may move them */
    pbrt_material *material = &p->materials[index];
    int side = p->state.is_two_sided != 0;
    if (material->handles[side] == IMPORT_NONE) {
        import_material copy = material->material;
        copy.is_two_sided = side;
        const pbrt_place here = rt_pbrt_here(&p->tokens);
        const int line = rt_pbrt_at(p->import, material->place);
        const size_t told = p->import->told;
        material->handles[side] = rt_import_add_material(
            p->import, line, material->name[0] ? material->name : "material", &copy);
        rt_pbrt_at(p->import, here);
        if (p->import->told != told)
            note_near(p, index);
    }
    return material->handles[side];
}
