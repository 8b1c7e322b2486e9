/* gltf_unread.c - what a glTF material has that no reader asks for, as names with typing errors. */
#include <string.h>

#include "dsl/import/gltf.h"

/* Objects in a material, and the members of each that are read. */
static const struct {
    const char *name, *members; /* with a space before and behind each */
} known[] = {
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
    {"KHR_materials_sheen",
     " sheenColorFactor sheenColorTexture sheenRoughnessFactor sheenRoughnessTexture "},
    {"KHR_materials_specular",
     " specularFactor specularTexture specularColorFactor specularColorTexture "},
    {"KHR_materials_transmission", " transmissionFactor transmissionTexture "},
    {"KHR_materials_unlit", " "},
    {"KHR_materials_volume",
     " thicknessFactor thicknessTexture attenuationDistance attenuationColor "},
};

static const char of_all[] = " extensions extras ";

static const char of_material[] =
    " name pbrMetallicRoughness normalTexture occlusionTexture emissiveTexture "
    "emissiveFactor alphaMode alphaCutoff doubleSided ";

static const char of_metal[] = " baseColorFactor baseColorTexture metallicFactor "
                               "roughnessFactor metallicRoughnessTexture ";

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

static void note_extension(gltf *g, const cJSON *extension)
{
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (strcmp(extension->string, known[i].name) == 0) {
            note_members(g, extension, known[i].members, known[i].name);
            return;
        }
    rt_import_note_at(g->import, 0, "%.60s is left out", extension->string);
}

void rt_gltf_note_unread(gltf *g, const cJSON *material)
{
    const cJSON *extension, *const extensions = gltf_get(material, "extensions"),
                                   *const metal = gltf_get(material, "pbrMetallicRoughness");
    if (!material)
        return;
    note_members(g, material, of_material, "a material");
    if (metal)
        note_members(g, metal, of_metal, "pbrMetallicRoughness");
    if (gltf_get(material, "occlusionTexture"))
        rt_import_note_at(g->import, 0, "its occlusionTexture is left out");
    if (extensions && !cJSON_IsObject(extensions))
        rt_import_note_at(g->import, 0, "its extensions are left out: they are no object");
    else
        cJSON_ArrayForEach(extension, extensions)
        {
            note_extension(g, extension);
        }
}
