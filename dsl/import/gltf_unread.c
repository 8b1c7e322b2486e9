/* gltf_unread.c - what objects of a glTF have that no reader asks for, as mistyped names. */
#include <string.h>

#include "dsl/import/gltf.h"

/* Extensions, and the members of each that are read. */
static const struct {
    const char *name, *members; /* with a space before and behind each */
} known[] = {
    {"EXT_mesh_gpu_instancing", " attributes "},
    {"KHR_lights_punctual", " light "},
    {"KHR_materials_anisotropy", " anisotropyStrength anisotropyRotation anisotropyTexture "},
    {"KHR_materials_clearcoat",
     " clearcoatFactor clearcoatTexture clearcoatRoughnessFactor clearcoatRoughnessTexture "
     "clearcoatNormalTexture "},
    {"KHR_materials_diffuse_transmission",
     " diffuseTransmissionFactor diffuseTransmissionTexture diffuseTransmissionColorFactor "
     "diffuseTransmissionColorTexture "},
    {"KHR_materials_dispersion", " dispersion "},
    {"KHR_materials_emissive_strength", " emissiveStrength "},
    {"KHR_materials_ior", " ior "},
    {"KHR_materials_pbrSpecularGlossiness",
     " diffuseFactor diffuseTexture specularFactor glossinessFactor specularGlossinessTexture "},
    {"KHR_materials_sheen",
     " sheenColorFactor sheenColorTexture sheenRoughnessFactor sheenRoughnessTexture "},
    {"KHR_materials_specular",
     " specularFactor specularTexture specularColorFactor specularColorTexture "},
    {"KHR_materials_transmission", " transmissionFactor transmissionTexture "},
    {"KHR_materials_unlit", " "},
    {"KHR_node_visibility", " visible "},
    {"KHR_texture_transform", " offset rotation scale texCoord "},
    {"KHR_materials_volume",
     " thicknessFactor thicknessTexture attenuationDistance attenuationColor "},
};

static const char of_all[] = " extensions extras name ";

/* Kinds of objects, the members of each that are read, and whose extensions are. */
static const struct {
    const char *what, *members, *extensions;
} kinds[] = {
    [GLTF_IS_SCENE] = {"a scene", " nodes ", " "},
    [GLTF_IS_NODE] = {"a node",
                      " children mesh skin weights camera matrix translation rotation scale ",
                      " EXT_mesh_gpu_instancing KHR_lights_punctual KHR_node_visibility "},
    [GLTF_IS_MESH] = {"a mesh", " primitives weights ", " "},
    [GLTF_IS_PRIMITIVE] = {"a primitive", " attributes indices material mode targets ", " "},
    [GLTF_IS_LIGHT] = {"a light", " color intensity type range spot ", " "},
    [GLTF_IS_MATERIAL] = {"a material",
                          " pbrMetallicRoughness normalTexture occlusionTexture emissiveTexture "
                          "emissiveFactor alphaMode alphaCutoff doubleSided ",
                          " KHR_materials_"},
    [GLTF_IS_METAL] = {"pbrMetallicRoughness",
                       " baseColorFactor baseColorTexture metallicFactor roughnessFactor "
                       "metallicRoughnessTexture ",
                       " "},
    [GLTF_IS_TEXTURE_INFO] = {"a texture of a material", " index texCoord scale strength ",
                              " KHR_texture_transform "},
    [GLTF_IS_TEXTURE] = {"a texture", " sampler source ", " "},
};

static int is_among(const char *members, const char *name)
{
    const size_t length = strlen(name);
    const char *at = strchr(name, ' ') ? NULL : strstr(members, name);
    while (at && length > 0 && !(at[-1] == ' ' && at[length] == ' '))
        at = strstr(at + 1, name);
    return at && length > 0;
}

static void note_members(gltf *g, const cJSON *object, const char *members, const char *what)
{
    const cJSON *member;
    if (!cJSON_IsObject(object)) {
        rt_import_note_at(g->import, 0, "%.60s is left out: it is no object", what);
        return;
    }
    cJSON_ArrayForEach(member, object)
    {
        if (!is_among(members, member->string) && !is_among(of_all, member->string))
            rt_import_note_at(g->import, 0, "'%.40s' of %.60s is left out", member->string, what);
    }
}

/* Whether an extension of that name is read where it stands. */
static int is_read(const char *extensions, const char *name)
{
    const size_t length = strlen(extensions);
    return extensions[length - 1] == '_' ? strncmp(name, extensions + 1, length - 1) == 0
                                         : is_among(extensions, name);
}

static void note_extension(gltf *g, gltf_kind kind, const cJSON *extension)
{
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (is_read(kinds[kind].extensions, extension->string) &&
            strcmp(extension->string, known[i].name) == 0) {
            note_members(g, extension, known[i].members, known[i].name);
            return;
        }
    rt_import_note_at(g->import, 0, "%.60s is left out", extension->string);
}

void rt_gltf_note_unread(gltf *g, gltf_kind kind, const cJSON *object)
{
    const cJSON *extension, *const extensions = gltf_get(object, "extensions");
    if (!object)
        return;
    note_members(g, object, kinds[kind].members, kinds[kind].what);
    if (extensions && !cJSON_IsObject(extensions))
        rt_import_note_at(g->import, 0, "its extensions are left out: they are no object");
    else
        cJSON_ArrayForEach(extension, extensions)
        {
            note_extension(g, kind, extension);
        }
}
