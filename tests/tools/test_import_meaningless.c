/*
 * test_import_meaningless.c - what an import says of values, names and elements without a meaning.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "expect.h"
#include "lib/image/scratch.h"
#include "spawn.h"
#include "tools/gltf_triangle.h"

/* Numbers of no meaning, and names of what is no file. */
static const struct {
    const char *name, *text, *told;
    int status;
} meaningless[] = {
    {"a.pbrt", "WorldBegin\nRotate 30 0 0 0\nShape \"sphere\"\n",
     "a.pbrt:2: a rotation about no axis turns nothing", 0},
    {"b.pbrt", "WorldBegin\nShape \"sphere\" \"float radius\" nan\n",
     "b.pbrt:2: \"float radius\" has a number that is not finite: it counts as not given", 0},
    {"range.pbrt",
     "WorldBegin\nMaterial \"coateddiffuse\" \"float roughness\" -1\nShape \"sphere\"\n",
     "range.pbrt:2: a roughness of -1 became 0", 0},
    {"index.pbrt", "WorldBegin\nMaterial \"dielectric\" \"float eta\" 0.0001\nShape \"sphere\"\n",
     "index.pbrt:2: an index of refraction of 0.0001 became 0.1", 0},
    {"range.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"materials\":[{\"pbrMetallicRoughness\":"
     "{\"metallicFactor\":1.5,\"roughnessFactor\":0.5}}]," GLTF_TRIANGLE,
     "range.gltf: materials[0]: metallicFactor 1.5 is taken as 1: it lies from 0 to 1", 0},
    {"low.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"materials\":[{\"pbrMetallicRoughness\":"
     "{\"metallicFactor\":0},\"extensions\":{\"KHR_materials_ior\":{\"ior\":0.5}}}]," GLTF_TRIANGLE,
     "low.gltf: materials[0]: an ior of 0.5 is taken as 1.5", 0},
    {"list.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"materials\":[{\"extensions\":{\"KHR_materials_ior\":[]}}]"
     "," GLTF_TRIANGLE,
     "list.gltf: materials[0]: KHR_materials_ior is left out: it is no object", 0},
    {"typo.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"materials\":[{\"extensions\":{\"KHR_materials_ior\":{"
     "\"IOR\":1.4}}}]," GLTF_TRIANGLE,
     "typo.gltf: materials[0]: 'IOR' of KHR_materials_ior is left out", 0},
    {"metal.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"materials\":[{\"pbrMetallicRoughness\":{"
     "\"rougnessFactor\":0.2}}]," GLTF_TRIANGLE,
     "metal.gltf: materials[0]: 'rougnessFactor' of pbrMetallicRoughness is left out", 0},
    {"none.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"materials\":[{\"normalTexture\":{\"scale\":2}}]"
     "," GLTF_TRIANGLE,
     "none.gltf: materials[0]: 'normalTexture' without an index is left out", 0},
    {"word.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"materials\":[{\"extensions\":\"KHR_materials_unlit\"}]"
     "," GLTF_TRIANGLE,
     "word.gltf: materials[0]: its extensions are left out: they are no object", 0},
    {"need.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"extensionsRequired\":[\"X_y\",\"KHR_mesh_quantization\"],"
     "\"materials\":[{}]," GLTF_TRIANGLE,
     "need.gltf: X_y, which the file requires, is left out", 0},
    {"nan.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"materials\":[{\"pbrMetallicRoughness\":"
     "{\"baseColorFactor\":[1,1,1e999,1],\"roughnessFactor\":\"0.5\"}}]," GLTF_TRIANGLE,
     "nan.gltf: materials[0]: 'baseColorFactor' is left out: it is not 4 finite numbers", 0},
    {"quoted.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"materials\":[{\"pbrMetallicRoughness\":"
     "{\"roughnessFactor\":\"0.5\"}}]," GLTF_TRIANGLE,
     "quoted.gltf: materials[0]: 'roughnessFactor' is no finite number: it counts as 1", 0},
    {"node.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"translaton\":[5,"
     "0,0]}]}",
     "node.gltf: nodes[0]: 'translaton' of a node is left out", 0},
    {"foo.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"extensions\":{"
     "\"KHR_node_foo\":{}}}]}",
     "foo.gltf: nodes[0]: KHR_node_foo is left out", 0},
    {"sky.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"extensions\":{\"EXT_lights_image_based\":{}},"
     "\"nodes\":[0]}],\"nodes\":[{}]}",
     "sky.gltf: EXT_lights_image_based is left out", 0},
    {"both.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"scale\":[2,2,2],"
     "\"matrix\":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]}]}",
     "both.gltf: nodes[0]: what stands beside its matrix is left out", 0},
    {"row.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{"
     "\"matrix\":[1,0,0,0.5,0,1,0,0,0,0,1,0,0,0,0,1]}]}",
     "row.gltf: nodes[0]: the last row of its matrix, 0 0 0 1 by the format, is left out", 0},
    {"unlit.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"materials\":[{\"pbrMetallicRoughness\":{"
     "\"metallicFactor\":0},\"extensions\":{\"KHR_materials_unlit\":{}}}]," GLTF_TRIANGLE,
     "unlit.gltf: materials[0]: an unlit material became one that emits its colour", 0},
    {"zero.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"materials\":[{\"pbrMetallicRoughness\":{"
     "\"metallicFactor\":0},\"extensions\":{\"KHR_materials_ior\":{\"ior\":0}}}]," GLTF_TRIANGLE,
     "zero.gltf: materials[0]: an ior of 0 is taken as 1.5", 0},
    {"volume.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"materials\":[{\"pbrMetallicRoughness\":{"
     "\"metallicFactor\":0},\"extensions\":{\"KHR_materials_transmission\":{\"transmissionFactor\":"
     "1},\"KHR_materials_volume\":{\"attenuationDistance\":-1}}}]," GLTF_TRIANGLE,
     "volume.gltf: materials[0]: an attenuationDistance of -1 is left out: it is above 0", 0},
    {"two.xml",
     "<scene><shape type=\"sphere\"><bsdf type=\"twosided\"><bsdf type=\"dielectric\"/></bsdf>"
     "</shape></scene>",
     "two.xml:1: a 'twosided' has no effect around what lets light through", 0},
    {"eta.xml",
     "<scene><shape type=\"sphere\"><bsdf type=\"principled\"><float name=\"specular\" "
     "value=\"0.9\"/><float name=\"eta\" value=\"1.2\"/></bsdf></shape></scene>",
     "eta.xml:1: specular is left out beside eta", 0},
    {"zero.pbrt", "WorldBegin\nMaterial \"dielectric\" \"float eta\" 0\nShape \"sphere\"\n",
     "zero.pbrt:2: an index of refraction of 0 became 1.5", 0},
    {"c.pbrt", "WorldBegin\nShape \"trianglemesh\" \"point3 P\" [0 0 0 1]\n",
     "c.pbrt:2: \"point3 P\" of 4 numbers, not three a point", 1},
    {"d.pbrt", "WorldBegin\nShape \"plymesh\" \"string filename\" \".\"\n",
     "d.pbrt:2: '.' is no file: the mesh is left out", 0},
    {"e.pbrt", "WorldBegin\nShape \"plymesh\" \"string filename\" \"x.ply\"\n",
     "e.pbrt:2: 'x.ply' is not there: the mesh is left out", 0},
    {"f.xml",
     "<scene><shape type=\"sphere\"><transform name=\"to_world\"><matrix value=\"nan 1 2 3 4 5 "
     "6 "
     "7 8\"/></transform></shape></scene>",
     "f.xml:1: a matrix has more than 16 values, or one that is not a finite number", 1},
    {"g.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"rotation\":"
     "[0,0,0,0]}]}",
     "g.gltf: nodes[0]: a rotation of four zeros turns nothing", 0},
    {"q.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"rotation\":"
     "[0,3,0,4]}]}",
     "q.gltf: nodes[0]: a rotation of a length other than 1 is made 1 long", 0},
    {"v.gltf", "{\"asset\":{\"version\":\"2.0\",\"minVersion\":\"2.9\"},\"scenes\":[{}]}",
     "v.gltf: asset.minVersion is 2.9: the file is read as glTF 2.0", 0},
    {"u.xml",
     "<scene><shape type=\"sphere\"><emitter type=\"area\"><spectrum name=\"radiance\" "
     "value=\"0.4:1, 0.7:1\"/></emitter></shape></scene>",
     "u.xml:1: a spectrum from 0.4 to 0.7 nm has no light that is seen, which is of 360 to 830 nm",
     0},
    {"j.pbrt", "Shape \"sphere\"\nWorldBegin\n",
     "j.pbrt:1: Shape stands before WorldBegin, where pbrt refuses it", 0},
    {"k.pbrt", "WorldBegin\nShape \"sphere\"\nCamera \"perspective\"\n",
     "k.pbrt:3: Camera stands behind WorldBegin, where pbrt refuses it", 0},
    {"j.xml", "<scene>\n<integrator type=\"path\"/>\n<integrator type=\"direct\"/>\n</scene>",
     "j.xml:3: a second integrator is left out", 0},
    {"k.xml",
     "<scene><sensor type=\"perspective\"><float name=\"fov\" value=\"$f\"/></sensor></scene>",
     "k.xml:1: '$f' has no <default>: 'fov' counts as not given", 0},
    {"l.xml",
     "<scene><sensor type=\"perspective\"><float name=\"near_clip\" value=\"4.5\"/><transform "
     "name=\"to_world\"><lookat origin=\"0, 0, -5\" target=\"0, 0, 0\" up=\"0, 1, 0\"/>"
     "</transform></sensor><shape type=\"sphere\"/></scene>",
     "l.xml:1: near_clip 4.5 is left out: what is nearer is seen", 0},
    {"m.xml",
     "<scene><sensor type=\"perspective\"><float name=\"far_clip\" value=\"5\"/><transform "
     "name=\"to_world\"><lookat origin=\"0, 0, -5\" target=\"0, 0, 0\" up=\"0, 1, 0\"/>"
     "</transform></sensor><shape type=\"sphere\"/></scene>",
     "m.xml:1: far_clip 5 is left out: what is farther is seen", 0},
    {"n.xml",
     "<scene><shape type=\"sphere\"><bsdf type=\"blendbsdf\"><float name=\"weight\" "
     "value=\"3\"/><bsdf type=\"diffuse\"/><bsdf type=\"plastic\"/></bsdf></shape></scene>",
     "n.xml:1: a weight of 3 is out of range: it became 1", 0},
    {"near.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0,1]}],\"nodes\":[{\"mesh\":0},"
     "{\"camera\":0,\"translation\":[0,0,5]}],\"cameras\":[{\"name\":\"eye\",\"perspective\":{"
     "\"yfov\":1,\"znear\":6}}],"
     "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"accessors\":[{"
     "\"bufferView\":0,\"componentType\":5126,\"type\":\"VEC3\",\"count\":3}],\"bufferViews\":[{"
     "\"buffer\":0,\"byteLength\":36}],\"buffers\":[{\"byteLength\":36,\"uri\":\"data:;base64,"
     "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}",
     "near.gltf: cameras[0] 'eye': znear 6 is left out: what is nearer is seen", 0},
    {"far.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0,1]}],\"nodes\":[{\"mesh\":0},"
     "{\"camera\":0,\"translation\":[0,0,5]}],\"cameras\":[{\"name\":\"eye\",\"orthographic\":{"
     "\"znear\":1,\"zfar\":4}}],"
     "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"accessors\":[{"
     "\"bufferView\":0,\"componentType\":5126,\"type\":\"VEC3\",\"count\":3}],\"bufferViews\":[{"
     "\"buffer\":0,\"byteLength\":36}],\"buffers\":[{\"byteLength\":36,\"uri\":\"data:;base64,"
     "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}",
     "far.gltf: cameras[0] 'eye': zfar 4 is left out: what is farther is seen", 0},
    {"o.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
     "\"materials\":[{\"pbrMetalicRoughness\":{}}],\"meshes\":[{\"primitives\":[{"
     "\"attributes\":{\"POSITION\":0},\"material\":0}]}],\"accessors\":[{\"bufferView\":0,"
     "\"componentType\":5126,\"type\":\"VEC3\",\"count\":3}],\"bufferViews\":[{\"buffer\":0,"
     "\"byteLength\":36}],\"buffers\":[{\"byteLength\":36,\"uri\":\"data:;base64,"
     "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}",
     "o.gltf: materials[0]: 'pbrMetalicRoughness' of a material is left out", 0},
    {"texture.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
     "\"materials\":[{\"normalTexture\":{\"index\":99}}],\"meshes\":[{\"primitives\":[{"
     "\"attributes\":{\"POSITION\":0},\"material\":0}]}],\"accessors\":[{\"bufferView\":0,"
     "\"componentType\":5126,\"type\":\"VEC3\",\"count\":3}],\"bufferViews\":[{\"buffer\":0,"
     "\"byteLength\":36}],\"buffers\":[{\"byteLength\":36,\"uri\":\"data:;base64,"
     "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}",
     "texture.gltf: materials[0]: 'normalTexture' names textures[99] of 0, and is left out", 0},
    {"p.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
     "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"accessors\":[{"
     "\"bufferView\":0,\"componentType\":5121,\"type\":\"VEC3\",\"count\":4}],\"bufferViews\":"
     "[{\"buffer\":0,\"byteLength\":12}],\"buffers\":[{\"byteLength\":12,\"uri\":"
     "\"data:;base64,AAAAAQAAAAEAAAAB\"}]}",
     "p.gltf: meshes[0]: of 4 corners the last 1 make no triangle", 0},
    {"q.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
     "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"accessors\":[{"
     "\"bufferView\":0,\"componentType\":5121,\"type\":\"VEC3\",\"count\":4}],\"bufferViews\":"
     "[{\"buffer\":0,\"byteLength\":12}],\"buffers\":[{\"byteLength\":12,\"uri\":"
     "\"data:;base64,AAAAAQAAAAEAAAAB\"}]}",
     "q.gltf: meshes[0]: POSITION of whole numbers needs KHR_mesh_quantization", 0},
    {"s.xml", "<scene>\n<include filename=\"s.xml\"/></scene>", "s.xml:2: 's.xml' includes itself",
     1},
    {"tags.xml", "<scene>\n<shape\ntype=\"sphere\">\n</scene>",
     "tags.xml:4: mismatched tag: <shape> of line 2 is still open", 1},
    {"t.xml",
     "<scene><emitter type=\"spot\"><float name=\"cutoff_angle\" value=\"20\"/>"
     "<float name=\"beam_width\" value=\"30\"/></emitter></scene>",
     "t.xml:1: the cone of a spot light begins to fall off at 30 degrees and ends at 20", 1},
    {"u.xml",
     "<scene>\n<shape type=\"obj\"><string name=\"filename\" value=\"bent.obj\"/>"
     "<emitter type=\"area\"><rgb name=\"radiance\" value=\"1\"/></emitter></shape></scene>",
     "u.xml:2: a light of a mesh with normals emits as its faces lie", 0},
    {"i.obj", "v 0 0 0\nv 1 0 0\nv 0 1e16 0\nf 1 2 3\n",
     "i.obj:3: '1e16' does not lie within 1e+15", 1},
    {"i.pbrt",
     "WorldBegin\nShape \"trianglemesh\" \"integer indices\" [0 1 2]\n"
     "\"point3 P\" [0 0 0 1 0 0 0 1e16 0]\n",
     "i.pbrt:2: vertex 2 of a mesh has the number 1e+16; it must lie within 1e+15", 1},
    {"i.xml",
     "<scene>\n<shape type=\"sphere\"><transform name=\"to_world\"><scale value=\"1e30\"/>"
     "</transform></shape>\n</scene>",
     "i.xml:2: a shape whose transform has the entry 1e+30, beyond 1e+15, is left out", 0},
};

static void what_has_no_meaning_is_told(void **state)
{
    (void)state;
    scratch_write("bent.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 3 4\n");
    for (size_t i = 0; i < sizeof meaningless / sizeof *meaningless; i++) {
        scratch_write(meaningless[i].name, meaningless[i].text);
        run run = run_rtc("import %s --out told.rts", meaningless[i].name);
        expect_status(&run, meaningless[i].status);
        expect_err(&run, meaningless[i].told);
        run_free(&run);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(what_has_no_meaning_is_told, scratch_enter, scratch_leave),
    };
    if (spawn_find_rtc() != 0)
        return 1;
    return cmocka_run_group_tests_name("import_meaningless", tests, NULL, NULL);
}
