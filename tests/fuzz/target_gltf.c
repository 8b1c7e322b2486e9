/* target_gltf.c - glTF 2.0 as JSON. */
#include "fuzz/import.h"
#include "fuzz/targets.h"

static int run(const uint8_t *data, size_t size)
{
    return fuzz_import_run("a.gltf", data, size, rt_import_gltf);
}

/* Sparse accessors, a morph target, a skin and instances. */
static void seed_poses(fuzz_inputs *seeds)
{
    fuzz_add_text(
        seeds,
        "{\"asset\":{\"version\":\"2.0\"},\"extensionsRequired\":[\"KHR_mesh_quantization\"],"
        "\"nodes\":[{\"mesh\":0,\"skin\":0,\"weights\":[0.5]},{\"translation\":[0,1,0]},{\"me"
        "sh\":0,\"extensions\":{\"EXT_mesh_gpu_instancing\":{\"attributes\":{\"TRANSLATION\":"
        "0,\"ROTATION\":2}}}}],\"skins\":[{\"joints\":[1],\"inverseBindMatrices\""
        ":3}],\"meshes\":[{\"weights\":[1],\"primitives\":[{\"attributes\":{\"POSITION\":6,\""
        "JOINTS_0\":5,\"WEIGHTS_0\":2},\"targets\":[{\"POSITION\":0}],\"indices\":4}]}],\"acc"
        "essors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},{"
        "\"bufferView\":1,\"componentType\":5126,\"count\":1,\"type\":\"VEC3\"},{\"bufferView"
        "\":2,\"componentType\":5126,\"count\":4,\"type\":\"VEC4\"},{\"bufferView\":3,\"compo"
        "nentType\":5126,\"count\":1,\"type\":\"MAT4\"},{\"bufferView\":4,\"componentType\":5"
        "123,\"count\":6,\"type\":\"SCALAR\"},{\"bufferView\":6,\"componentType\":5121,\"coun"
        "t\":4,\"type\":\"VEC4\"},{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type"
        "\":\"VEC3\",\"sparse\":{\"count\":1,\"indices\":{\"bufferView\":5,\"componentType\":"
        "5123},\"values\":{\"bufferView\":1}}}],\"bufferViews\":[{\"buffer\":0,\"byteOffset\""
        ":0,\"byteLength\":48},{\"buffer\":0,\"byteOffset\":48,\"byteLength\":12},{\"buffer\""
        ":0,\"byteOffset\":60,\"byteLength\":64},{\"buffer\":0,\"byteOffset\":124,\"byteLengt"
        "h\":64},{\"buffer\":0,\"byteOffset\":188,\"byteLength\":12},{\"buffer\":0,\"byteOffs"
        "et\":200,\"byteLength\":4},{\"buffer\":0,\"byteOffset\":204,\"byteLength\":16}],\"bu"
        "ffers\":[{\"byteLength\":220,\"uri\":\"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAA"
        "AACAPwAAgD8AAAAAAAAAAAAAgD8AAAAAAAAAQAAAAEAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAA"
        "AAAAAAAAAIA/AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAAAAAACAPwAA"
        "AAAAAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAAAAAAAAAAAAgD8AAAEAAgAAAAIAAwACAAAAAAAAAAAAAAAA"
        "AAAAAAAAAA==\"}]}");
}

static void seed(fuzz_inputs *seeds)
{
    seed_poses(seeds);
    fuzz_add_text(
        seeds,
        "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0,2,3]}],\"nodes\":["
        "{\"children\":[1],\"translation\":[0,1,0],\"rotation\":[0,0,0,1]},"
        "{\"mesh\":0,\"scale\":[1,2,1]},{\"camera\":0},"
        "{\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}}],\"meshes\":[{\"name\":\"m\","
        "\"primitives\":[{\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":1},\"indices\":2,"
        "\"material\":0,\"mode\":4}]}],\"materials\":[{\"doubleSided\":true,"
        "\"emissiveFactor\":[1,0,0],\"pbrMetallicRoughness\":{\"metallicFactor\":0.5,"
        "\"roughnessFactor\":0.5,\"baseColorFactor\":[1,0.5,0.2,1]},\"extensions\":{"
        "\"KHR_materials_ior\":{\"ior\":1.4},\"KHR_materials_emissive_strength\":"
        "{\"emissiveStrength\":3},\"KHR_materials_specular\":{\"specularFactor\":0.5}}}],"
        "\"cameras\":[{\"perspective\":{\"yfov\":0.8,\"aspectRatio\":1.5}}],"
        "\"extensions\":{\"KHR_lights_punctual\":{\"lights\":[{\"type\":\"spot\","
        "\"intensity\":683,\"spot\":{\"outerConeAngle\":0.5}}]}},"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"type\":\"VEC3\",\"count\":3},"
        "{\"bufferView\":0,\"componentType\":5121,\"normalized\":true,\"type\":\"VEC2\","
        "\"count\":3},{\"bufferView\":1,\"componentType\":5123,\"type\":\"SCALAR\",\"count\":3}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36},{\"buffer\":0,\"byteOffset\":36,"
        "\"byteLength\":6}],\"buffers\":[{\"byteLength\":42,\"uri\":\"data:;base64,"
        "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAABAAIA\"}]}");
    fuzz_add_text(
        seeds,
        "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0,1]}],\"nodes\":["
        "{\"mesh\":0,\"matrix\":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]},{\"camera\":0}],"
        "\"cameras\":[{\"orthographic\":{\"xmag\":2,\"ymag\":1}}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"COLOR_0\":0},"
        "\"material\":0,\"mode\":5}]}],\"materials\":[{\"alphaMode\":\"BLEND\","
        "\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0,\"extensions\":{"
        "\"KHR_texture_transform\":{\"scale\":[2,2],\"offset\":[0.5,0]}}}},\"extensions\":{"
        "\"KHR_materials_transmission\":{\"transmissionFactor\":1},\"KHR_materials_volume\":"
        "{\"thicknessFactor\":1,\"attenuationDistance\":2,\"attenuationColor\":[1,0.5,0.5]}}}],"
        "\"textures\":[{\"source\":0,\"sampler\":0}],\"images\":[{\"uri\":\"a.png\"}],"
        "\"samplers\":[{\"wrapS\":33648}],\"accessors\":[{\"bufferView\":0,\"byteOffset\":0,"
        "\"componentType\":5126,\"type\":\"VEC3\",\"count\":4}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":48,\"byteStride\":12}],"
        "\"buffers\":[{\"byteLength\":48,\"uri\":\"data:;base64,"
        "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAACAPwAAgD8AAAAA\"}]}");
}

const fuzz_target fuzz_target_gltf = {
    .name = "gltf",
    .sources = "dsl/import/gltf.c dsl/import/gltf_bytes.c dsl/import/gltf_json.c "
               "dsl/import/gltf_material.c dsl/import/gltf_mesh.c dsl/import/gltf_pose.c "
               "dsl/import/gltf_unread.c",
    .run = run,
    .seed = seed,
    .begin = fuzz_import_begin,
    .size_max = 8192,
    .tries = 3000,
};
