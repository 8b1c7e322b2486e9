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
     "node.gltf: nodes[0]: 'translaton' of a node is left out", 1},
    {"foo.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"extensions\":{"
     "\"KHR_node_foo\":{}}}]}",
     "foo.gltf: nodes[0]: KHR_node_foo is left out", 1},
    {"sky.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"extensions\":{\"EXT_lights_image_based\":{}},"
     "\"nodes\":[0]}],\"nodes\":[{}]}",
     "sky.gltf: EXT_lights_image_based is left out", 1},
    {"both.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"scale\":[2,2,2],"
     "\"matrix\":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]}]}",
     "both.gltf: nodes[0]: what stands beside its matrix is left out", 1},
    {"row.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{"
     "\"matrix\":[1,0,0,0.5,0,1,0,0,0,0,1,0,0,0,0,1]}]}",
     "row.gltf: nodes[0]: the last row of its matrix, 0 0 0 1 by the format, is left out", 1},
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
     "c.pbrt:2: a mesh with \"point3 P\" of 4 numbers, not three a point, is left out", 1},
    {"d.pbrt", "WorldBegin\nShape \"plymesh\" \"string filename\" \".\"\n",
     "d.pbrt:2: '.' is no file: the mesh is left out", 1},
    {"e.pbrt", "WorldBegin\nShape \"plymesh\" \"string filename\" \"x.ply\"\n",
     "e.pbrt:2: 'x.ply' is not there: the mesh is left out", 1},
    {"f.xml",
     "<scene><shape type=\"sphere\"><transform name=\"to_world\"><matrix value=\"nan 1 2 3 4 5 "
     "6 "
     "7 8\"/></transform></shape></scene>",
     "f.xml:1: a <matrix> of other than 9 or 16 finite numbers is left out", 0},
    {"g.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"rotation\":"
     "[0,0,0,0]}]}",
     "g.gltf: nodes[0]: a rotation of four zeros turns nothing", 1},
    {"q.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"rotation\":"
     "[0,3,0,4]}]}",
     "q.gltf: nodes[0]: a rotation of a length other than 1 is made 1 long", 1},
    {"v.gltf", "{\"asset\":{\"version\":\"2.0\",\"minVersion\":\"2.9\"},\"scenes\":[{}]}",
     "v.gltf: asset.minVersion is 2.9: the file is read as glTF 2.0", 1},
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
     "j.xml:3: a second integrator is left out", 1},
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
     "t.xml:1: a spot light is left out: its cone ends at 20 degrees, which must lie between 0 and",
     1},
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
    {"wrap.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"materials\":[{\"pbrMetallicRoughness\":{"
     "\"baseColorTexture\":{\"index\":0}}}],\"textures\":[{\"source\":0,\"sampler\":0}],"
     "\"images\":[{\"uri\":\"none.png\"}],\"samplers\":[{\"wrapS\":12}]," GLTF_TRIANGLE,
     "wrap.gltf: materials[0]: there is no wrapS 12: it became 10497, REPEAT", 0},
    {"filter.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"materials\":[{\"pbrMetallicRoughness\":{"
     "\"baseColorTexture\":{\"index\":0}}}],\"textures\":[{\"source\":0,\"sampler\":0}],"
     "\"images\":[{\"uri\":\"none.png\"}],\"samplers\":[{\"magFilter\":9987}]," GLTF_TRIANGLE,
     "filter.gltf: materials[0]: there is no magFilter 9987: it became 9729, LINEAR", 0},
    {"flag.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"materials\":[{\"emissiveFactor\":[1,1,1],"
     "\"doubleSided\":\"yes\"}]," GLTF_TRIANGLE,
     "flag.gltf: materials[0]: 'doubleSided' is neither true nor false: it counts as false", 0},
    {"twice.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"materials\":[{\"name\":\"a\",\"alphaMode\":\"OPAQUE\","
     "\"name\":\"b\",\"name\":\"c\"}]," GLTF_TRIANGLE,
     "twice.gltf: an object has the member 'name' more than once: the first is taken", 0},
    {"after.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"materials\":[{}]," GLTF_TRIANGLE " \n {\"more\":1}",
     "after.gltf: what follows the JSON is left out: '{\"more\":1}'", 0},
    {"light.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"extensions\":{\"KHR_lights_punctual\":{\"lights\":[{"
     "\"type\":\"glow\"}]}},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"extensions\":{"
     "\"KHR_lights_punctual\":{\"light\":0}}}]}",
     "light.gltf: lights[0]: a light of type 'glow' is left out", 1},
    {"prose.gltf", "No scene.\n", "prose.gltf:1: it is neither JSON nor GLB: it begins with 'No s",
     1},
    {"text.xml", "<scene>\n<shape type=\"sphere\">\n  radius 2 </shape></scene>",
     "text.xml:3: the text 'radius 2' in <shape> is left out", 0},
    {"radius.xml",
     "<scene><shape type=\"cube\"/>\n<shape type=\"sphere\"><float name=\"radius\" value=\"-1\"/>"
     "</shape></scene>",
     "radius.xml:2: a sphere of radius -1 is left out: it is above 0", 0},
    {"fov.xml",
     "<scene><sensor type=\"perspective\"><float name=\"fov\" value=\"180\"/></sensor></scene>",
     "fov.xml:1: a field of view of 180 degrees counts as not given", 0},
    {"samples.xml",
     "<scene><sensor type=\"perspective\"><sampler type=\"independent\"><integer "
     "name=\"sample_count\" value=\"0\"/></sampler></sensor></scene>",
     "samples.xml:1: a sampler of 0 samples became one of 16", 0},
    {"lens.xml",
     "<scene><sensor type=\"thinlens\"><float name=\"aperture_radius\" value=\"-1\"/></sensor>"
     "</scene>",
     "lens.xml:1: the lens of aperture_radius -1 and focus_distance 0 is left out", 0},
    {"filter.xml",
     "<scene><sensor type=\"perspective\"><film type=\"hdrfilm\"><rfilter type=\"gaussian\"><float "
     "name=\"stddev\" value=\"100\"/></rfilter></film></sensor></scene>",
     "filter.xml:1: a filter of radius 300 became one of its default radius", 0},
    {"ref.xml", "<scene>\n<shape type=\"cube\">\n<ref id=\"red\"/></shape></scene>",
     "ref.xml:3: there is no element with the id 'red' so far: the <ref> is left out", 0},
    {"inner.xml",
     "<scene><shape type=\"cube\"><bsdf type=\"twosided\"><ref id=\"red\"/></bsdf></shape></scene>",
     "inner.xml:1: a 'twosided' needs another material inside: diffuse grey of 0.5 stands in", 0},
    {"one.xml",
     "<scene><shape type=\"cube\"><bsdf type=\"blendbsdf\"><bsdf type=\"plastic\"/></bsdf></shape>"
     "</scene>",
     "one.xml:1: a 'blendbsdf' needs two materials inside: it became the one", 0},
    {"nan.xml",
     "<scene><shape type=\"sphere\"><transform name=\"to_world\">\n<translate x=\"nan\"/>"
     "</transform></shape></scene>",
     "nan.xml:2: a <translate> is left out: 'nan' is not one or three finite numbers", 0},
    {"angle.xml",
     "<scene><shape type=\"cube\"><transform name=\"to_world\"><rotate y=\"1\" angle=\"1e\"/>"
     "</transform></shape></scene>",
     "angle.xml:1: a <rotate> is left out: its angle '1e' is not a finite number", 0},
    {"axis.xml",
     "<scene><shape type=\"cube\"><transform name=\"to_world\"><rotate angle=\"1\"/></transform>"
     "</shape></scene>",
     "axis.xml:1: a <rotate> is left out: its axis is zero", 0},
    {"step.xml",
     "<scene><shape type=\"cube\"><transform name=\"to_world\"><shear x=\"1\"/></transform></shape>"
     "</scene>",
     "step.xml:1: the step <shear> of a transform is unknown, and left out", 0},
    {"look.xml",
     "<scene><shape type=\"cube\"><transform name=\"to_world\"><lookat origin=\"1 2\" "
     "target=\"0 0 0\"/></transform></shape></scene>",
     "look.xml:1: a lookat is left out: its origin, target and up are three numbers each", 0},
    {"up.xml",
     "<scene><shape type=\"cube\"><transform name=\"to_world\"><lookat origin=\"0 1 0\" "
     "target=\"0 0 0\"/></transform></shape></scene>",
     "up.xml:1: a lookat is left out: it has no direction, or its up is along it", 0},
    {"word.pbrt", "WorldBegin\nShpae \"sphere\" \"float radius\" [1]\nShape \"sphere\"\n",
     "word.pbrt:2: the unknown directive 'Shpae' is left out", 0},
    {"look.pbrt",
     "LookAt 0 0 1 0 0 1 0 1 0\nCamera \"perspective\"\nWorldBegin\nShape \"sphere\"\n",
     "look.pbrt:1: LookAt is left out: it has no direction, or its up is along it", 0},
    {"fov.pbrt", "Camera \"perspective\" \"float fov\" 180\nWorldBegin\nShape \"sphere\"\n",
     "fov.pbrt:1: a field of view of 180 degrees became 90", 0},
    {"window.pbrt",
     "Camera \"perspective\" \"float screenwindow\" [1 -1 0 1]\nWorldBegin\nShape \"sphere\"\n",
     "window.pbrt:1: screenwindow is left out: it takes 4 numbers: x from, to, y from, to", 0},
    {"shutter.pbrt",
     "Camera \"perspective\" \"float shutterclose\" 0\nWorldBegin\nShape \"sphere\"\n",
     "shutter.pbrt:1: a shutter that is open for 0 counts as open for 1", 0},
    {"film.pbrt", "Film \"rgb\" \"integer xresolution\" 0\nWorldBegin\nShape \"sphere\"\n",
     "film.pbrt:1: a film of 0 x 720 pixels became 1280 x 720", 0},
    {"option.pbrt", "Option \"seed\"\nWorldBegin\nShape \"sphere\"\n",
     "option.pbrt:1: Option \"seed\" has no value", 0},
    {"frame.pbrt", "WorldBegin\nCoordSysTransform \"x\"\nShape \"sphere\"\n",
     "frame.pbrt:2: there is no coordinate system 'x': CoordSysTransform is left out", 0},
    {"named.pbrt", "WorldBegin\nNamedMaterial \"x\"\nShape \"sphere\"\n",
     "named.pbrt:2: there is no material 'x': the one before goes on", 0},
    {"mix.pbrt",
     "WorldBegin\nMaterial \"mix\" \"string materials\" [\"x\" \"y\"]\nShape \"sphere\"\n",
     "mix.pbrt:2: there is no material 'x': the mix became grey", 0},
    {"three.pbrt", "WorldBegin\nMaterial \"mix\" \"string materials\" [\"x\"]\nShape \"sphere\"\n",
     "three.pbrt:2: a mix became grey: it needs the names of two materials", 0},
    {"texture.pbrt",
     "WorldBegin\nMaterial \"diffuse\" \"texture reflectance\" \"x\"\nShape \"sphere\"\n",
     "texture.pbrt:2: there is no texture 'x': it is left out", 0},
    {"file.pbrt", "WorldBegin\nTexture \"x\" \"spectrum\" \"imagemap\"\nShape \"sphere\"\n",
     "file.pbrt:2: an imagemap without filename is white", 0},
    {"object.pbrt", "WorldBegin\nObjectInstance \"x\"\nShape \"sphere\"\n",
     "object.pbrt:2: there is no object 'x': the instance is left out", 0},
    {"index.pbrt",
     "WorldBegin\nShape \"sphere\"\nShape \"trianglemesh\" \"integer indices\" [ 0 1 7 ]\n"
     "\"point3 P\" [ 0 0 0 1 0 0 0 1 0 ]",
     "index.pbrt:3: a mesh is left out: the index 7 of 3 vertices", 0},
    {"faces.pbrt",
     "WorldBegin\nShape \"sphere\"\nShape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 ]\n"
     "\"point3 P\" [ 0 0 0 1 0 0 0 1 0 ]",
     "faces.pbrt:3: a mesh of 4 indices, not 3 for each face, is left out", 0},
    {"normals.pbrt",
     "WorldBegin\nShape \"trianglemesh\" \"integer indices\" [ 0 1 2 ] \"normal N\" [ 0 0 1 ]\n"
     "\"point3 P\" [ 0 0 0 1 0 0 0 1 0 ]",
     "normals.pbrt:2: N or uv of a mesh are left out: they are not as many as P", 0},
    {"lens.pbrt", "Camera \"perspective\" \"float lensradius\" -1\nWorldBegin\nShape \"sphere\"\n",
     "lens.pbrt:1: the lens of lensradius -1 and focaldistance 0 is left out", 0},
    {"typo.pbrt", "Camera \"perspective\" \"float fvo\" 40\nWorldBegin\nShape \"sphere\"\n",
     "typo.pbrt:1: \"float fvo\" of the camera is left out: did you mean 'fov'?", 0},
    {"type.pbrt", "Camera \"perspective\" \"flaot fov\" 40\nWorldBegin\nShape \"sphere\"\n",
     "type.pbrt:1: \"flaot fov\" of the camera is left out: expected \"float fov\"", 0},
    {"again.pbrt",
     "Camera \"perspective\" \"float fov\" 40 \"float fov\" 41\nWorldBegin\nShape \"sphere\"\n",
     "again.pbrt:1: \"float fov\" of the camera is given again: the first counts", 0},
    {"two.pbrt", "Camera \"perspective\"\nCamera \"perspective\"\nWorldBegin\nShape \"sphere\"\n",
     "two.pbrt:2: a second Camera takes the place of the first", 0},
    {"depth.pbrt", "Integrator \"path\" \"integer maxdepth\" -3\nWorldBegin\nShape \"sphere\"\n",
     "depth.pbrt:1: a maxdepth of -3 became 5", 0},
    {"world.pbrt", "WorldBegin\nWorldBegin\nShape \"sphere\"\n",
     "world.pbrt:2: a second WorldBegin: the transform begins anew", 0},
    {"medium.pbrt",
     "WorldBegin\nMakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [-1 1 "
     "1]\nShape \"sphere\"\n",
     "medium.pbrt:2: negative coefficients of a medium became 0", 0},
    {"kind.pbrt", "WorldBegin\nTexture \"a\" \"flot\" \"constant\"\nShape \"sphere\"\n",
     "kind.pbrt:2: a texture of type 'flot' is taken as one of spectrum", 0},
    {"wrap.pbrt",
     "WorldBegin\nTexture \"a\" \"spectrum\" \"imagemap\" \"string filename\" \"a.png\" \"string "
     "wrap\" \"\"\nShape \"sphere\"\n",
     "wrap.pbrt:2: there is no wrap '': it became repeat", 0},
    {"filter.pbrt",
     "WorldBegin\nTexture \"a\" \"spectrum\" \"imagemap\" \"string filename\" \"a.png\" \"string "
     "filter\" \"poi\"\nShape \"sphere\"\n",
     "filter.pbrt:2: there is no filter 'poi': it became bilinear", 0},
    {"code.pbrt",
     "WorldBegin\nTexture \"a\" \"spectrum\" \"imagemap\" \"string filename\" \"a.png\" \"string "
     "encoding\" \"bar\"\nShape \"sphere\"\n",
     "code.pbrt:2: the encoding 'bar' of a texture became sRGB", 0},
    {"texture2.pbrt",
     "WorldBegin\nTexture \"a\" \"float\" \"constant\"\nTexture \"a\" \"float\" "
     "\"constant\"\nShape \"sphere\"\n",
     "texture2.pbrt:3: the texture 'a' is defined again: it is another from here on", 0},
    {"material2.pbrt",
     "WorldBegin\nMakeNamedMaterial \"a\"\nMakeNamedMaterial \"a\" \"string type\" "
     "\"diffuse\"\nShape \"sphere\"\n",
     "material2.pbrt:3: the material 'a' is defined again: it is another from here on", 0},
    {"named2.pbrt", "WorldBegin\nMakeNamedMaterial \"a\"\nShape \"sphere\"\n",
     "named2.pbrt:2: a named material without a type became diffuse", 0},
    {"object2.pbrt",
     "WorldBegin\nObjectBegin \"a\"\nObjectEnd\nObjectBegin \"a\"\nObjectEnd\nShape \"sphere\"\n",
     "object2.pbrt:4: a second object 'a' is left out", 0},
    {"three2.pbrt",
     "WorldBegin\nMaterial \"diffuse\" \"rgb reflectance\" [0.5 0.5]\nShape \"sphere\"\n",
     "three2.pbrt:2: \"rgb reflectance\" takes three numbers: it counts as not given", 0},
    {"last.pbrt", "WorldBegin\nTranslate 1 2\n", "last.pbrt:2: Translate takes 3 numbers", 1},
    {"film2.xml",
     "<scene><sensor type=\"perspective\">\n<film type=\"hdrfilm\"/>\n<film "
     "type=\"hdrfilm\"/></sensor><shape type=\"sphere\"/></scene>",
     "film2.xml:3: a second film takes the place of the first", 0},
    {"sampler2.xml",
     "<scene><sensor type=\"perspective\">\n<sampler type=\"sobol\"/>\n<sampler "
     "type=\"sobol\"/></sensor><shape type=\"sphere\"/></scene>",
     "sampler2.xml:3: a second sampler takes the place of the first", 0},
    {"default2.xml",
     "<scene><default name=\"a\" value=\"1\"/>\n<default name=\"a\" value=\"2\"/><shape "
     "type=\"sphere\"/></scene>",
     "default2.xml:2: the default 'a' is given again: the first counts", 0},
    {"fov2.xml",
     "<scene><sensor type=\"perspective\">\n<float name=\"fov\" value=\"40\"/>\n<float "
     "name=\"fov\" value=\"50\"/></sensor><shape type=\"sphere\"/></scene>",
     "fov2.xml:3: <float name=\"fov\"> of <sensor type=\"perspective\"> is given again: the first "
     "counts",
     0},
    {"cone.xml",
     "<scene><emitter type=\"spot\"><float name=\"cutoff_angle\" value=\"300\"/></emitter><shape "
     "type=\"sphere\"/></scene>",
     "cone.xml:1: a spot light is left out: its cone ends at 300 degrees", 0},
    {"second.obj", "mtllib second.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
     "second.mtl:3: material a: a second Kd takes the place of the first", 0},
    {"more.obj", "mtllib second.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
     "second.mtl:3: material a: '0.3' behind 3 numbers is left out", 0},
    {"none.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl none\nf 1 2 3\n",
     "none.obj:4: there are no materials: grey ones were added", 0},
    {"image.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"materials\":[{\"pbrMetallicRoughness\":{"
     "\"baseColorTexture\":{\"index\":0}}}],\"textures\":[{\"source\":0}],\"images\":[{}]"
     "," GLTF_TRIANGLE,
     "image.gltf: materials[0]: images[0] is left out: it has no uri and no bufferView", 0},
    {"type.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"camera\":0}],"
     "\"cameras\":[{\"type\":\"perspektive\",\"perspective\":{\"yfov\":1}}]}",
     "type.gltf: cameras[0]: its type is 'perspektive': it is taken as perspective", 0},
    {"angle.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"camera\":0}],"
     "\"cameras\":[{\"type\":\"perspective\"}]}",
     "angle.gltf: cameras[0]: it has no yfov, the angle of view: 0.7 radians are taken", 0},
    {"mag.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"camera\":0}],"
     "\"cameras\":[{\"type\":\"orthographic\",\"orthographic\":{\"xmag\":0,\"ymag\":0}}]}",
     "mag.gltf: cameras[0]: its xmag of 0 counts as 1", 0},
    {"five.obj", "v 0 0 0 1 1\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
     "five.obj:1: the last two of the 5 numbers of a vertex are left out", 0},
    {"seven.obj", "v 0 0 0 1 1 1 1\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
     "seven.obj:1: of the 7 numbers of a vertex the last is left out", 0},
    {"even.pbrt",
     "WorldBegin\nMakeNamedMedium \"m\" \"string type\" \"uniformgrid\"\nShape \"sphere\"\n",
     "even.pbrt:2: a grid of a medium without \"float density\" is even", 0},
    {"line.xml",
     "<scene><shape type=\"sphere\"><bsdf type=\"diffuse\"><spectrum name=\"reflectance\" "
     "value=\"550:0.5\"/></bsdf></shape></scene>",
     "line.xml:1: a spectrum of one wavelength, 550 nm, is all but black: two or more are expected",
     0},
    {"iso.pbrt", "Film \"rgb\" \"float iso\" -1\nWorldBegin\nShape \"sphere\"\n",
     "iso.pbrt:1: the iso of a film, which is above 0, counts as not given", 0},
    {"scale.pbrt", "Film \"rgb\" \"float scale\" 2\nWorldBegin\nShape \"sphere\"\n",
     "scale.pbrt:1: \"float scale\" of the film is left out", 0},
    {"face.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\nf 1 2 3\n",
     "face.obj:4: a face is left out: it names vertex 4 of 3 so far", 0},
    {"corner.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3x\nf 1 2 3\n",
     "corner.obj:4: a face is left out: '3x' has more than indices", 0},
};

static void what_has_no_meaning_is_told(void **state)
{
    (void)state;
    scratch_write("second.mtl", "newmtl a\nKd 1 0 0\nKd 0.5 0.5 0.5 0.3\n");
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
