/*
 * gltf_material.c - the metallic-roughness materials of glTF 2.0.
 *
 * alpha of GGX is the square of the roughness. A metal reflects its base colour at normal
 * incidence, by Schlick's approximation. What is metal in part is a blend of a plastic and a metal.
 * Textures have v = 0 at the top; here it is at the bottom, as in the meshes that are written.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "dsl/import/gltf.h"
#include "dsl/import/sheet.h"

/* The images of the file that were written. */
static const char *image_file(gltf *g, uint64_t index)
{
    const cJSON *image = rt_gltf_item(g, GLTF_IMAGES, index, "a texture");
    const unsigned char *at;
    uint64_t view;
    size_t size, stride;
    if (!image)
        return NULL;
    char *file = g->images[index];
    const char *uri = rt_gltf_string(image, "uri"), *name = rt_gltf_string(image, "name");
    if (file[0])
        return file[0] == '?' ? NULL : file;
    strcpy(file, "?");
    if (!uri && !gltf_get(image, "bufferView"))
        rt_import_note_at(g->import, 0, "images[%lu] is left out: it has no uri and no bufferView",
                          (unsigned long)index);
    char made[512];
    if (!name && uri && strncmp(uri, "data:", 5) != 0)
        name = strrchr(uri, '/') ? strrchr(uri, '/') + 1 : uri;
    if (uri) {
        char *bytes = rt_gltf_uri(g, uri, "the image", &size);
        if (bytes &&
            rt_import_image_bytes(g->import, 0, made, name ? name : "image", bytes, size)) {
            strcpy(file, made);
            g->has_alpha[index] = (char)rt_import_image_has_alpha(bytes, size);
        }
        free(bytes);
    } else if (rt_gltf_whole(g, image, "bufferView", &view) &&
               rt_gltf_view(g, view, &at, &size, &stride) && rt_gltf_count_read(g, size) &&
               rt_import_image_bytes(g->import, 0, made, name ? name : "image", at, size)) {
        strcpy(file, made);
        g->has_alpha[index] = (char)rt_import_image_has_alpha(at, size);
    }
    return file[0] == '?' ? NULL : file;
}

/* KHR_texture_transform, with v turned over. */
static void read_transform(gltf *g, const cJSON *info, import_texture *texture)
{
    const cJSON *transform = rt_gltf_extension(info, "KHR_texture_transform");
    double offset[2] = {0, 0}, scale[2] = {1, 1};
    const double angle = rt_gltf_number(g, transform, "rotation", 0), c = cos(angle),
                 s = sin(angle);
    rt_gltf_numbers(g, transform, "offset", offset, 2);
    rt_gltf_numbers(g, transform, "scale", scale, 2);
    for (int i = 0; i < 2; i++)
        if (scale[i] == 0)
            scale[i] = 1e-6; /* as good as one point of it */
    double map[2][3] = {{c * scale[0], -s * scale[1], offset[0] + s * scale[1]},
                        {s * scale[0], c * scale[1], 1 - offset[1] - c * scale[1]}};
    rt_import_texture_map(texture, map);
    if (texture->rotate == 0 && texture->scale[0] < 0 && texture->scale[1] < 0 && c < 0) {
        texture->rotate = 180; /* which turns normals, as any other angle does */
        texture->scale[0] = -texture->scale[0];
        texture->scale[1] = -texture->scale[1];
    }
}

static int wrap_of(gltf *g, const cJSON *sampler, const char *name)
{
    enum { REPEAT = 10497, MIRRORED_REPEAT = 33648, CLAMP_TO_EDGE = 33071 };
    uint64_t mode = REPEAT;
    rt_gltf_whole(g, sampler, name, &mode);
    if (mode != REPEAT && mode != MIRRORED_REPEAT && mode != CLAMP_TO_EDGE)
        rt_import_note_at(g->import, 0, "there is no %s %.0f: it became %d, REPEAT", name,
                          (double)mode, REPEAT);
    return mode == MIRRORED_REPEAT ? 1 : mode == CLAMP_TO_EDGE ? 2 : 0;
}

const char *rt_gltf_set_name(unsigned set)
{
    static const char *const names[GLTF_SETS] = {"uv0", "uv1", "uv2", "uv3",
                                                 "uv4", "uv5", "uv6", "uv7"};
    return names[set];
}

/* The set that a texture is looked up by; beyond the last it is the first. */
static unsigned set_of(gltf *g, const cJSON *info)
{
    uint64_t set = 0;
    rt_gltf_whole(g, info, "texCoord", &set);
    rt_gltf_whole(g, rt_gltf_extension(info, "KHR_texture_transform"), "texCoord", &set);
    if (set < GLTF_SETS)
        return (unsigned)set;
    rt_import_note_at(g->import, 0, "the texture coordinates %lu became the first ones",
                      (unsigned long)set);
    return 0;
}

/* A texture of a material by the member that names it, read as this one, or IMPORT_NONE. */
static int read_texture_as(gltf *g, const cJSON *info, const char *what, import_texture texture)
{
    uint64_t index, image, sampler_index;
    if (info && !cJSON_IsNumber(gltf_get(info, "index"))) {
        rt_import_note_at(g->import, 0, "'%.40s' without an index is left out", info->string);
        return IMPORT_NONE;
    }
    if (!info || !rt_gltf_whole(g, info, "index", &index))
        return IMPORT_NONE;
    if (index >= g->lists[GLTF_TEXTURES].count) {
        rt_import_note_at(g->import, 0, "'%.40s' names textures[%lu] of %lu, and is left out",
                          info->string, (unsigned long)index,
                          (unsigned long)g->lists[GLTF_TEXTURES].count);
        return IMPORT_NONE;
    }
    const cJSON *entry = rt_gltf_item(g, GLTF_TEXTURES, index, what), *sampler = NULL;
    rt_gltf_note_unread(g, GLTF_IS_TEXTURE_INFO, info);
    rt_gltf_note_unread(g, GLTF_IS_TEXTURE, entry);
    if (!entry || !rt_gltf_whole(g, entry, "source", &image)) {
        rt_import_note_at(g->import, 0, "a texture without an image is left out");
        return IMPORT_NONE;
    }
    if (rt_gltf_whole(g, entry, "sampler", &sampler_index))
        sampler = rt_gltf_item(g, GLTF_SAMPLERS, sampler_index, "a texture");
    texture.wrap = wrap_of(g, sampler, "wrapS");
    if (texture.wrap != wrap_of(g, sampler, "wrapT"))
        rt_import_note_at(g->import, 0,
                          "wrapT differs from wrapS: the texture continues along v as along u");
    enum { NEAREST = 9728, LINEAR = 9729 };
    uint64_t filter = LINEAR;
    rt_gltf_whole(g, sampler, "magFilter", &filter);
    texture.is_nearest = filter == NEAREST;
    if (filter != NEAREST && filter != LINEAR)
        rt_import_note_at(g->import, 0, "there is no magFilter %.0f: it became %d, LINEAR",
                          (double)filter, LINEAR);
    read_transform(g, info, &texture);
    const unsigned set = set_of(g, info);
    texture.attribute = set == g->own_set ? NULL : rt_gltf_set_name(set);
    texture.file = g->import->failed ? NULL : image_file(g, image);
    if (texture.file && texture.channel == 'a' && !g->has_alpha[image])
        return IMPORT_NONE;
    return texture.file ? rt_import_add_texture(g->import, what, &texture) : IMPORT_NONE;
}

static int read_texture(gltf *g, const cJSON *info, const char *what, int is_linear)
{
    return read_texture_as(g, info, what, (import_texture){.is_linear = is_linear});
}

/* What older files give in place of pbrMetallicRoughness, or NULL. */
static const cJSON *gloss_of(const cJSON *entry)
{
    return rt_gltf_extension(entry, "KHR_materials_pbrSpecularGlossiness");
}

static const cJSON *base_texture(const cJSON *entry)
{
    const cJSON *const gloss = gloss_of(entry);
    return gloss ? gltf_get(gloss, "diffuseTexture")
                 : gltf_get(gltf_get(entry, "pbrMetallicRoughness"), "baseColorTexture");
}

static const cJSON *metal_texture(const cJSON *entry)
{
    return gloss_of(entry)
               ? NULL
               : gltf_get(gltf_get(entry, "pbrMetallicRoughness"), "metallicRoughnessTexture");
}

/* The roughness of a material is in green; alpha of GGX is its square. */
static int read_roughness_texture(gltf *g, const cJSON *entry)
{
    const import_texture as = {.is_linear = 1, .channel = 'g', .power = 2};
    return read_texture_as(g, metal_texture(entry), "roughness", as);
}

gltf_sets rt_gltf_texture_sets(gltf *g, int64_t material)
{
    gltf_sets sets = {0, 0};
    if (material < 0 || (size_t)material >= g->lists[GLTF_MATERIALS].count)
        return sets;
    const cJSON *entry = g->lists[GLTF_MATERIALS].items[material];
    const cJSON *const textures[] = {
        base_texture(entry),
        gltf_get(entry, "emissiveTexture"),
        metal_texture(entry),
        gltf_get(entry, "normalTexture"),
        gltf_get(rt_gltf_extension(entry, "KHR_materials_diffuse_transmission"),
                 "diffuseTransmissionColorTexture"),
        gltf_get(rt_gltf_extension(entry, "KHR_materials_clearcoat"), "clearcoatTexture"),
        gltf_get(rt_gltf_extension(entry, "KHR_materials_clearcoat"), "clearcoatRoughnessTexture"),
        gltf_get(rt_gltf_extension(entry, "KHR_materials_sheen"), "sheenColorTexture"),
        gltf_get(rt_gltf_extension(entry, "KHR_materials_sheen"), "sheenRoughnessTexture")};
    int is_first = 1;
    rt_gltf_count(g, entry);
    rt_gltf_count(g, gltf_get(entry, "pbrMetallicRoughness"));
    for (size_t i = 0; i < sizeof textures / sizeof *textures; i++) {
        rt_gltf_count(g, textures[i]);
        rt_gltf_count(g, gltf_get(textures[i], "extensions"));
        rt_gltf_count(g, rt_gltf_extension(textures[i], "KHR_texture_transform"));
        if (!textures[i])
            continue;
        const unsigned set = set_of(g, textures[i]);
        if (is_first)
            sets.own = set;
        sets.named |= 1u << set;
        is_first = 0;
    }
    return sets;
}

static double transmission_factor(gltf *g, const cJSON *entry)
{
    return rt_gltf_number(g, rt_gltf_extension(entry, "KHR_materials_transmission"),
                          "transmissionFactor", 0);
}

static double specular_factor(gltf *g, const cJSON *entry)
{
    return rt_gltf_number(g, rt_gltf_extension(entry, "KHR_materials_specular"), "specularFactor",
                          1);
}

/* The Abbe number of KHR_materials_dispersion, which holds 20 over it; 0: no dispersion. */
static double read_abbe(gltf *g, const cJSON *entry)
{
    const double dispersion =
        rt_gltf_number(g, rt_gltf_extension(entry, "KHR_materials_dispersion"), "dispersion", 0);
    if (dispersion < 0 || dispersion > 20)
        rt_import_note_at(g->import, 0, "a dispersion of %g is taken as %d", dispersion,
                          dispersion < 0 ? 0 : 20);
    return dispersion > 0.02 ? fmax(20 / dispersion, 1) : dispersion > 0 ? 1000 : 0;
}

/* Whether glass has an inside: with a thickness, and in files by Blender in any case. */
static int has_inside(gltf *g, const cJSON *entry)
{
    const cJSON *volume = rt_gltf_extension(entry, "KHR_materials_volume");
    return g->is_blender || rt_gltf_number(g, volume, "thicknessFactor", 0) > 0;
}

/* Glass where it has an inside, a sheet that light crosses straight where it has none. */
static void read_transmission(gltf *g, const cJSON *entry, import_material *m, double metallic,
                              const double base[3])
{
    const cJSON *transmission = rt_gltf_extension(entry, "KHR_materials_transmission"),
                *volume = rt_gltf_extension(entry, "KHR_materials_volume");
    double factor = transmission_factor(g, entry), colour[3] = {1, 1, 1};
    double distance = rt_gltf_number(g, volume, "attenuationDistance", 0);
    if (!(factor > 0) || metallic == 1)
        return; /* no light enters a metal */
    if (gltf_get(volume, "attenuationDistance") && !(distance > 0))
        rt_import_note_at(g->import, 0, "an attenuationDistance of %g is left out: it is above 0",
                          distance);
    if (metallic > 0)
        rt_import_note_at(g->import, 0,
                          "the metal in a material that lets light through is left out");
    if (specular_factor(g, entry) != 1 ||
        gltf_get(rt_gltf_extension(entry, "KHR_materials_specular"), "specularColorFactor"))
        rt_import_note_at(g->import, 0, "KHR_materials_specular of glass is left out");
    if (gltf_get(transmission, "transmissionTexture"))
        rt_import_note_at(g->import, 0, "a transmissionTexture is left out");
    for (int c = 0; c < 3; c++) {
        m->kt[c] = factor * base[c];
        m->kd[c] *= 1 - factor;
    }
    m->kt_texture = m->kd_texture;
    m->fresnel = IMPORT_FRESNEL_DIELECTRIC;
    memset(m->ks, 0, sizeof m->ks);
    if (has_inside(g, entry)) {
        m->abbe = read_abbe(g, entry);
        rt_gltf_numbers(g, volume, "attenuationColor", colour, 3);
        for (int c = 0; c < 3 && distance > 0; c++)
            m->absorption[c] = -log(colour[c] > 1e-6 ? colour[c] : 1e-6) / distance;
        if (g->is_blender && !(m->abbe > 0) && m->roughness_texture == IMPORT_NONE &&
            (m->kt_texture != IMPORT_NONE || base[0] < 1 || base[1] < 1 || base[2] < 1))
            rt_import_make_coloured_glass(m, factor, base, m->kt_texture);
    } else {
        m->is_thin = 1;
        if (m->roughness > 0)
            rt_import_note_at(g->import, 0,
                              "a rough glass without the thickness of KHR_materials_volume is a "
                              "thin sheet: its roughness is left out");
        m->roughness = m->roughness_v = 0;
        m->roughness_texture = m->roughness_v_texture = IMPORT_NONE;
    }
}

/* The reflectance of a plastic's coat at normal incidence, of KHR_materials_specular; the most. */
static double read_coat(gltf *g, const cJSON *entry, double ior, double coat[3])
{
    const cJSON *specular = rt_gltf_extension(entry, "KHR_materials_specular");
    const cJSON *const gloss = gloss_of(entry);
    const double strength = specular_factor(g, entry),
                 f0 = gloss ? 1 : pow((ior - 1) / (ior + 1), 2);
    double colour[3] = {1, 1, 1};
    rt_gltf_numbers(g, gloss ? gloss : specular, gloss ? "specularFactor" : "specularColorFactor",
                    colour, 3);
    if (gltf_get(specular, "specularTexture") || gltf_get(specular, "specularColorTexture"))
        rt_import_note_at(g->import, 0, "its specular textures are left out: the factors hold");
    for (int c = 0; c < 3; c++)
        coat[c] = strength * fmin(f0 * fmax(colour[c], 0), 1);
    return fmax(coat[0], fmax(coat[1], coat[2]));
}

static int is_opaque(gltf *g, const cJSON *entry)
{
    const cJSON *diffuse = rt_gltf_extension(entry, "KHR_materials_diffuse_transmission");
    return !(transmission_factor(g, entry) > 0) &&
           !(rt_gltf_number(g, diffuse, "diffuseTransmissionFactor", 0) > 0);
}

/* Whether it is opaque and no metal, with a coat without colour: as plastics nearly always are. */
static int is_plastic(gltf *g, const cJSON *entry, double metallic, const double coat[3])
{
    return metallic == 0 && coat[0] > 0 && coat[0] == coat[1] && coat[1] == coat[2] &&
           (coat[0] < 0.6 || !gloss_of(entry)) && is_opaque(g, entry);
}

/* ---- Principled materials -------------------------------------------------------- */

static double largest(const double colour[3])
{
    return fmax(colour[0], fmax(colour[1], colour[2]));
}

/* The colour of KHR_materials_sheen, black without. */
static double read_sheen(gltf *g, const cJSON *entry, double sheen[3])
{
    memset(sheen, 0, 3 * sizeof *sheen);
    rt_gltf_numbers(g, rt_gltf_extension(entry, "KHR_materials_sheen"), "sheenColorFactor", sheen,
                    3);
    return largest(sheen);
}

static double read_clearcoat(gltf *g, const cJSON *entry)
{
    return rt_gltf_number(g, rt_gltf_extension(entry, "KHR_materials_clearcoat"), "clearcoatFactor",
                          0);
}

/*
 * Whether it is sheen over what is no cloth, as a principled material has it: opaque, alike in all
 * directions, and with a coat without colour.
 */
static int is_principled(gltf *g, const cJSON *entry, const double coat[3])
{
    const cJSON *anisotropy = rt_gltf_extension(entry, "KHR_materials_anisotropy");
    double sheen[3];
    return read_sheen(g, entry, sheen) > 0 && coat[0] == coat[1] && coat[1] == coat[2] &&
           coat[0] < 0.6 && is_opaque(g, entry) &&
           rt_gltf_number(g, anisotropy, "anisotropyStrength", 0) == 0;
}

/*
 * Whether it is cloth: sheen over what is opaque, no metal, and reflects by its coat nothing or as
 * evenly as roughness makes it: below 0.7 a principled material, whose sheen is another, is closer.
 */
static int is_cloth(gltf *g, const cJSON *entry, double metallic, double roughness,
                    const double coat[3])
{
    double sheen[3];
    return read_sheen(g, entry, sheen) > 0 && metallic == 0 &&
           (roughness >= 0.7 || largest(coat) == 0) && !(read_clearcoat(g, entry) > 0) &&
           is_opaque(g, entry);
}

static void note_sheen(gltf *g)
{
    if (g->is_blender)
        rt_import_note_at(g->import, 0,
                          "its sheen is as strong as its tint: Blender writes no weight of it");
}

/* The base colour stays that of kd. */
static void read_cloth(gltf *g, const cJSON *entry, import_material *m, const double coat[3])
{
    const cJSON *sheen = rt_gltf_extension(entry, "KHR_materials_sheen");
    const import_texture as = {.is_linear = 1, .channel = 'a'};
    read_sheen(g, entry, m->fuzz);
    for (int c = 0; c < 3; c++)
        m->fuzz[c] = fmin(fmax(m->fuzz[c], 0), 1);
    m->fuzz_texture = read_texture(g, gltf_get(sheen, "sheenColorTexture"), "sheen", 0);
    m->fuzz_roughness = fmin(fmax(rt_gltf_number(g, sheen, "sheenRoughnessFactor", 0), 0), 1);
    if (m->fuzz_roughness > 0)
        m->fuzz_roughness_texture =
            read_texture_as(g, gltf_get(sheen, "sheenRoughnessTexture"), "sheen_roughness", as);
    note_sheen(g);
    if (largest(coat) > 0)
        rt_import_note_at(g->import, 0,
                          "what is below its sheen reflects diffusely alone: its rough reflection "
                          "of %.3g is left out",
                          largest(coat));
}

/* A clearcoat of GGX and the sheen of Estevez and Kulla, by those of Disney. */
static void read_layers(gltf *g, const cJSON *entry, import_material *m)
{
    const cJSON *clearcoat = rt_gltf_extension(entry, "KHR_materials_clearcoat"),
                *sheen = rt_gltf_extension(entry, "KHR_materials_sheen");
    const double rough = rt_gltf_number(g, clearcoat, "clearcoatRoughnessFactor", 0);
    double colour[3];
    m->clearcoat = read_clearcoat(g, entry);
    if (m->clearcoat > 0) {
        m->clearcoat_gloss = fmin(fmax((0.1 - rough * rough) / 0.099, 0), 1);
        rt_import_note_at(g->import, 0,
                          "its clearcoat became Disney's, which takes no light from what is below");
    }
    m->sheen = read_sheen(g, entry, colour);
    note_sheen(g);
    rt_import_note_at(g->import, 0, "its sheen became Disney's, which is white");
    if (m->clearcoat > 0)
        m->clearcoat_texture = read_texture_as(g, gltf_get(clearcoat, "clearcoatTexture"), "coat",
                                               (import_texture){.is_linear = 1, .channel = 'r'});
    m->sheen_texture = read_texture(g, gltf_get(sheen, "sheenColorTexture"), "sheen", 0);
    if (gltf_get(clearcoat, "clearcoatRoughnessTexture") ||
        gltf_get(clearcoat, "clearcoatNormalTexture") || gltf_get(sheen, "sheenRoughnessTexture"))
        rt_import_note_at(
            g->import, 0,
            "the roughness textures of its clearcoat and sheen, and the normals of the "
            "clearcoat, are left out");
}

/* By metallic, which is in blue, and roughness, in green; the coat has the reflectance f0. */
static void read_principled(gltf *g, const cJSON *entry, import_material *m, double metallic,
                            double roughness, double f0)
{
    const double root = sqrt(fmax(f0, 0));
    const cJSON *textures = metal_texture(entry);
    m->is_principled = 1;
    memcpy(m->base_color, m->kd, sizeof m->base_color);
    memset(m->kd, 0, sizeof m->kd);
    m->base_color_texture = m->kd_texture;
    m->kd_texture = IMPORT_NONE;
    m->metallic = metallic;
    m->roughness = roughness;
    if (metallic > 0)
        m->metallic_texture = read_texture_as(g, textures, "metallic",
                                              (import_texture){.is_linear = 1, .channel = 'b'});
    if (roughness > 0)
        m->roughness_texture = read_texture_as(g, textures, "roughness",
                                               (import_texture){.is_linear = 1, .channel = 'g'});
    m->ior = (1 + root) / (1 - root);
    read_layers(g, entry, m);
}

/* What of such a material the others leave out. */
static void note_layers(gltf *g, const cJSON *entry)
{
    double sheen[3];
    if (read_clearcoat(g, entry) > 0)
        rt_import_note_at(g->import, 0, "KHR_materials_clearcoat is left out");
    if (read_sheen(g, entry, sheen) > 0)
        rt_import_note_at(g->import, 0, "KHR_materials_sheen is left out");
}

/* ---- Others ---------------------------------------------------------------------- */

/*
 * KHR_materials_anisotropy: rougher along a direction, turned from u, by a strength squared.
 * Blender writes its own anisotropy there, by which it makes alpha 1 / sqrt(1 - 0.9 of it) as large
 * along that direction, and as small across (Burley 2012).
 */
static void read_facets(gltf *g, const cJSON *entry, import_material *m, double alpha)
{
    const cJSON *anisotropy = rt_gltf_extension(entry, "KHR_materials_anisotropy");
    const double strength = rt_gltf_number(g, anisotropy, "anisotropyStrength", 0);
    const double aspect = sqrt(1 - 0.9 * fmin(fmax(strength, 0), 1));
    if (g->is_blender)
        rt_import_set_alphas(m, fmin(alpha / aspect, 1), alpha * aspect);
    else
        rt_import_set_alphas(m, alpha + (1 - alpha) * strength * strength, alpha);
    m->anisotropy_rotation =
        rt_gltf_number(g, anisotropy, "anisotropyRotation", 0) * 180 / IMPORT_PI;
    if (gltf_get(anisotropy, "anisotropyTexture"))
        rt_import_note_at(g->import, 0,
                          "an anisotropyTexture is left out: the factors hold all over");
}

/* Whether a coat can lie over it: an opaque metal or plastic, without sheen. */
static int is_below_clearcoat(gltf *g, const cJSON *entry)
{
    const cJSON *anisotropy = rt_gltf_extension(entry, "KHR_materials_anisotropy");
    double sheen[3];
    return read_clearcoat(g, entry) > 0 && !(read_sheen(g, entry, sheen) > 0) &&
           is_opaque(g, entry) && rt_gltf_number(g, anisotropy, "anisotropyStrength", 0) == 0;
}

/* KHR_materials_clearcoat over a metal or a plastic; specular: what this reflects below it. */
static void read_below_clearcoat(gltf *g, const cJSON *entry, import_material *m, double metallic,
                                 double roughness, const double specular[3])
{
    const cJSON *clearcoat = rt_gltf_extension(entry, "KHR_materials_clearcoat");
    const double rough = rt_gltf_number(g, clearcoat, "clearcoatRoughnessFactor", 0);
    m->coat = read_clearcoat(g, entry);
    m->coat_ior = 1.5;
    m->is_coat_linear = 1;
    m->coat_roughness = rough * rough;
    m->coat_texture = read_texture_as(g, gltf_get(clearcoat, "clearcoatTexture"), "coat",
                                      (import_texture){.is_linear = 1, .channel = 'r'});
    if (rough > 0)
        m->coat_roughness_texture =
            read_texture_as(g, gltf_get(clearcoat, "clearcoatRoughnessTexture"), "coat_roughness",
                            (import_texture){.is_linear = 1, .channel = 'g', .power = 2});
    if (gltf_get(clearcoat, "clearcoatNormalTexture"))
        rt_import_note_at(g->import, 0, "the normals of its clearcoat are left out");
    m->roughness = roughness * roughness;
    if (metallic > 0) {
        rt_import_make_metal(m);
        rt_import_settle_coated(g->import, 0, m);
        return;
    }
    for (int c = 0; c < 3; c++) {
        m->kd[c] *= 1 - specular[c];
        m->ks[c] = specular[c];
    }
    if (largest(specular) > 0)
        rt_import_note_at(g->import, 0, IMPORT_COATED_PLASTIC, largest(specular));
}

/*
 * A metal or a plastic, metallic 1 or 0, whose texture of roughness is read; metallic between them:
 * of what lets light through.
 */
static void read_kind(gltf *g, const cJSON *entry, import_material *m, double metallic,
                      double roughness)
{
    double coat[3], base[3] = {m->kd[0], m->kd[1], m->kd[2]};
    const double f0 = read_coat(g, entry, m->ior, coat);
    if (is_below_clearcoat(g, entry)) {
        read_below_clearcoat(g, entry, m, metallic, roughness, coat);
        return;
    }
    note_layers(g, entry);
    const int texture = m->roughness_texture;
    if (is_plastic(g, entry, metallic, coat)) {
        m->roughness = roughness * roughness;
        rt_import_make_plastic(m, f0, specular_factor(g, entry));
        if (rt_gltf_extension(entry, "KHR_materials_anisotropy"))
            rt_import_note_at(g->import, 0, "the anisotropy of a plastic is left out");
        return;
    }
    read_facets(g, entry, m, roughness * roughness);
    if (m->roughness_v > 0 && texture != IMPORT_NONE) {
        m->roughness_v_texture = texture;
        rt_import_note_at(g->import, 0, "its anisotropy is the same part of a textured roughness");
    }
    if (metallic == 1) {
        rt_import_make_metal(m);
        return;
    }
    const cJSON *volume = rt_gltf_extension(entry, "KHR_materials_volume");
    if (f0 > 0 && !(transmission_factor(g, entry) > 0) &&
        !(rt_gltf_number(g, volume, "thicknessFactor", 0) > 0))
        rt_import_note_at(g->import, 0,
                          is_opaque(g, entry)
                              ? "a plastic that reflects a colour does so at every angle, as %.3g"
                              : "what is neither a metal nor opaque reflects %.3g at every angle",
                          f0);
    for (int c = 0; c < 3; c++) {
        m->kd[c] = (1 - metallic) * (1 - f0) * base[c];
        m->ks[c] = metallic * base[c] + (1 - metallic) * coat[c];
    }
    if (metallic > 0) {
        m->ks_texture = m->kd_texture;
        rt_import_note_at(g->import, 0, "the metal in it reflects its colour at every angle");
    }
}

/* What is metal in part, by metallic times the blue of a texture: a blend of both. */
static void read_alloy(gltf *g, const cJSON *entry, import_material *m, double metallic,
                       double roughness)
{
    const import_texture as = {.is_linear = 1, .channel = 'b'};
    const int weight = read_texture_as(g, metal_texture(entry), "metallic", as);
    import_part parts[2] = {{.base = "plastic", .material = *m}, {.base = "metal", .material = *m}};
    read_kind(g, entry, &parts[0].material, 0, roughness);
    read_kind(g, entry, &parts[1].material, 1, roughness);
    rt_import_blend(g->import, 0, m, parts, metallic, weight);
}

static void read_specular(gltf *g, const cJSON *entry, import_material *m, double metallic,
                          double roughness)
{
    double coat[3];
    const double f0 = read_coat(g, entry, m->ior, coat);
    m->scatters_often = 1;
    if (is_cloth(g, entry, metallic, roughness, coat)) {
        read_cloth(g, entry, m, coat);
        return;
    }
    if (is_principled(g, entry, coat)) {
        read_principled(g, entry, m, metallic, roughness, f0);
        return;
    }
    m->roughness_texture = roughness > 0 ? read_roughness_texture(g, entry) : IMPORT_NONE;
    if (metallic > 0 && (metallic < 1 || metal_texture(entry)) && is_opaque(g, entry))
        read_alloy(g, entry, m, metallic, roughness);
    else
        read_kind(g, entry, m, metallic, roughness);
}

/*
 * KHR_materials_diffuse_transmission: a part of what is scattered below the coat goes to the other
 * side, in a colour of its own.
 */
static void read_diffuse_transmission(gltf *g, const cJSON *entry, import_material *m,
                                      double metallic)
{
    const cJSON *diffuse = rt_gltf_extension(entry, "KHR_materials_diffuse_transmission");
    const double factor = rt_gltf_number(g, diffuse, "diffuseTransmissionFactor", 0);
    double coat[3], colour[3] = {1, 1, 1};
    if (!(factor > 0) || metallic == 1)
        return;
    if (m->fresnel != IMPORT_FRESNEL_OFF) {
        rt_import_note_at(g->import, 0, "its diffuse transmission is left out: it is %s",
                          metallic > 0 ? "metallic" : "glass");
        return;
    }
    if (gltf_get(diffuse, "diffuseTransmissionTexture"))
        rt_import_note_at(g->import, 0,
                          "a diffuseTransmissionTexture is left out: the factor holds all over");
    if (rt_gltf_number(g, rt_gltf_extension(entry, "KHR_materials_volume"), "thicknessFactor", 0) >
        0)
        rt_import_note_at(
            g->import, 0,
            "the volume of diffuse transmission is left out: light crosses it as air");
    rt_gltf_numbers(g, diffuse, "diffuseTransmissionColorFactor", colour, 3);
    const double below = (1 - metallic) * (1 - read_coat(g, entry, m->ior, coat));
    for (int c = 0; c < 3; c++) {
        m->diffuse_transmission[c] = below * factor * colour[c];
        m->kd[c] *= 1 - factor;
    }
    m->diffuse_transmission_texture =
        read_texture(g, gltf_get(diffuse, "diffuseTransmissionColorTexture"), "transmission", 0);
}

static void read_emission(gltf *g, const cJSON *entry, import_material *m)
{
    double strength = rt_gltf_number(g, rt_gltf_extension(entry, "KHR_materials_emissive_strength"),
                                     "emissiveStrength", 1);
    rt_gltf_numbers(g, entry, "emissiveFactor", m->emission, 3);
    for (int c = 0; c < 3; c++)
        m->emission[c] *= strength;
    if (m->emission[0] > 0 || m->emission[1] > 0 || m->emission[2] > 0) {
        m->emission_texture = read_texture(g, gltf_get(entry, "emissiveTexture"), "emission", 0);
        m->is_two_sided = rt_gltf_flag(g, entry, "doubleSided", 0);
    }
}

/* Alpha is an opacity, that of the base colour and of its texture. */
static void read_alpha(gltf *g, const cJSON *entry, import_material *m, double alpha)
{
    const char *mode = rt_gltf_string(entry, "alphaMode");
    const import_texture as = {.is_linear = 1, .channel = 'a'};
    const double cutoff = rt_gltf_number(g, entry, "alphaCutoff", 0.5);
    const int is_mask = mode && strcmp(mode, "MASK") == 0;
    if (!mode || strcmp(mode, "OPAQUE") == 0 || (is_mask && cutoff <= 0))
        return;
    if (!is_mask && strcmp(mode, "BLEND") != 0)
        rt_import_note_at(g->import, 0, "the alphaMode '%.30s' became BLEND", mode);
    if (!m->is_thin && (m->kt[0] > 0 || m->kt[1] > 0 || m->kt[2] > 0)) {
        rt_import_note_at(g->import, 0, "its alpha is left out: the material is glass");
        return;
    }
    m->opacity_texture = read_texture_as(g, base_texture(entry), "alpha", as);
    m->opacity = fmin(fmax(alpha, 1e-6), 1);
    if (is_mask && (m->opacity_texture == IMPORT_NONE || cutoff > 1)) {
        m->opacity = cutoff <= 1 && alpha >= cutoff ? 1 : 1e-6;
        m->opacity_texture = IMPORT_NONE;
    } else if (is_mask) {
        m->opacity_cutoff = fmax(cutoff, 1e-6);
    }
}

/* The texture of the base colour, times the colours of vertices where these are shown. */
static int read_base(gltf *g, const cJSON *entry, int has_colours)
{
    const import_texture shown = {
        .pattern = IMPORT_ATTRIBUTE, .scale = {1, 1}, .attribute = GLTF_COLOURS};
    const import_factor image = {read_texture(g, base_texture(entry), "base", 0), {1, 1, 1}};
    if (!has_colours)
        return image.handle;
    const import_factor colours = {rt_import_add_texture(g->import, GLTF_COLOURS, &shown),
                                   {1, 1, 1}};
    return rt_import_product(g->import, 0, "base", &image, &colours).handle;
}

/* The factors of a material: how much of it is metal, and how rough it is. */
typedef struct gltf_factors {
    double base[4], metallic, roughness;
} gltf_factors;

static gltf_factors read_factors(gltf *g, const cJSON *entry)
{
    const cJSON *const pbr = gltf_get(entry, "pbrMetallicRoughness"), *gloss = gloss_of(entry);
    gltf_factors out = {{1, 1, 1, 1}, 0, 0};
    if (gloss) {
        rt_gltf_numbers(g, gloss, "diffuseFactor", out.base, 4);
        out.roughness = fmin(fmax(1 - rt_gltf_number(g, gloss, "glossinessFactor", 1), 0), 1);
        if (gltf_get(gloss, "specularGlossinessTexture"))
            rt_import_note_at(g->import, 0,
                              "its specularGlossinessTexture is left out: the factors hold");
        return out;
    }
    rt_gltf_numbers(g, pbr, "baseColorFactor", out.base, 4);
    out.metallic = rt_gltf_number(g, pbr, "metallicFactor", 1);
    out.roughness = rt_gltf_number(g, pbr, "roughnessFactor", 1);
    if (metal_texture(entry) && transmission_factor(g, entry) > 0) {
        rt_import_note_at(g->import, 0,
                          "the metalness of a texture is left out: what lets light through is no "
                          "metal");
        out.metallic = 0;
    }
    return out;
}

static double read_ior(gltf *g, const cJSON *entry)
{
    const double ior = rt_gltf_number(g, rt_gltf_extension(entry, "KHR_materials_ior"), "ior", 1.5);
    if (ior < 1)
        rt_import_note_at(g->import, 0, "an ior of %g is taken as 1.5%s", ior,
                          ior == 0 ? "" : ": it is 0 or at least 1");
    return ior >= 1 ? ior : 1.5;
}

/* A material that emits its base colour alone. */
static void read_unlit(gltf *g, const cJSON *entry, import_material *m)
{
    rt_import_note_at(g->import, 0, "an unlit material became one that emits its colour");
    memcpy(m->emission, m->kd, sizeof m->emission);
    memset(m->kd, 0, sizeof m->kd);
    m->emission_texture = m->kd_texture;
    m->is_two_sided = rt_gltf_flag(g, entry, "doubleSided", 0);
}

static int read_material(gltf *g, const cJSON *entry, int has_colours, int is_sheet)
{
    const char *name = rt_gltf_string(entry, "name");
    import_material m = rt_import_material_begin();
    gltf_factors factors = read_factors(g, entry);
    memcpy(m.kd, factors.base, sizeof m.kd);
    m.ior = read_ior(g, entry);
    m.kd_texture = read_base(g, entry, has_colours);
    if (g->is_blender && entry && !gltf_get(entry, "pbrMetallicRoughness") &&
        !gltf_get(entry, "extensions"))
        rt_import_note_at(
            g->import, 0,
            "it is white: Blender writes no other materials than its Principled BSDF");
    if (rt_gltf_extension(entry, "KHR_materials_unlit")) {
        read_unlit(g, entry, &m);
        read_alpha(g, entry, &m, factors.base[3]);
        return rt_import_add_material(g->import, 0, name ? name : "unlit", &m);
    }
    m.normal_texture = read_texture(g, gltf_get(entry, "normalTexture"), "normals", 1);
    m.normal_scale = rt_gltf_number(g, gltf_get(entry, "normalTexture"), "scale", 1);
    if (m.normal_scale == 0)
        m.normal_texture = IMPORT_NONE; /* flat */
    read_specular(g, entry, &m, factors.metallic, factors.roughness);
    for (int c = 0; c < 3; c++)
        factors.base[c] *= 1 - factors.metallic;
    read_transmission(g, entry, &m, factors.metallic, factors.base);
    read_diffuse_transmission(g, entry, &m, factors.metallic);
    read_emission(g, entry, &m);
    read_alpha(g, entry, &m, factors.base[3]);
    if (is_sheet && rt_import_is_solid(&m))
        rt_import_make_sheet(g->import, 0, NULL, &m);
    return rt_import_add_material(g->import, 0, name ? name : "material", &m);
}

int rt_gltf_may_be_sheet(gltf *g, int64_t index)
{
    const int is_there = index >= 0 && (uint64_t)index < g->lists[GLTF_MATERIALS].count;
    return g->is_blender && is_there &&
           transmission_factor(g, g->lists[GLTF_MATERIALS].items[index]) > 0;
}

int rt_gltf_material(gltf *g, int64_t index, int has_colours, int is_sheet)
{
    static const char none[] = "a primitive";
    size_t at = index < 0 ? g->lists[GLTF_MATERIALS].count : (size_t)index;
    const cJSON *entry = index < 0 ? NULL : rt_gltf_item(g, GLTF_MATERIALS, at, none);
    if (g->import->failed || (index >= 0 && !entry))
        return IMPORT_NONE;
    int *const made = &g->materials[at][is_sheet][has_colours];
    if (*made == IMPORT_NONE) {
        const import_place before =
            index < 0 ? g->import->place : rt_gltf_enter(g, GLTF_MATERIALS, at);
        const size_t told = g->import->told;
        const char *const name = rt_gltf_string(entry, "name");
        rt_gltf_note_unread(g, GLTF_IS_MATERIAL, entry);
        rt_gltf_note_unread(g, GLTF_IS_METAL, gltf_get(entry, "pbrMetallicRoughness"));
        if (gltf_get(entry, "occlusionTexture"))
            rt_import_note_at(g->import, 0, "its occlusionTexture is left out");
        g->own_set = rt_gltf_texture_sets(g, index).own;
        *made = read_material(g, entry, has_colours, is_sheet);
        rt_import_tally(g->import, told, name ? name : "material");
        g->import->place = before;
    }
    return *made;
}
