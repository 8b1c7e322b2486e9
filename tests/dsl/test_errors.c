/* Malformed scenes: each mistake gives its one error, at its place, in these words. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/dsl/collect.h"

/* A text with one error. `hint` is a part of the hint; "" when there must be none. */
typedef struct bad_text {
    const char *text;
    int line, column, length;
    const char *message, *hint;
} bad_text;

#define WHITE "material white { kd 0.7 }\n"
#define BALL WHITE "sphere { centre 0 0 0  radius 1  material white }\n"

static const bad_text bad_texts[] = {
    /* Whole texts. */
    {"", 1, 1, 1, "the scene is empty: expected a block, such as camera { ... }", ""},
    {"# only a comment\n", 1, 1, 1, "the scene is empty", ""},
    {"let a = 1\n", 1, 1, 1, "the scene is empty", ""},
    {"\xff\xfe"
     "c\1",
     1, 1, 1, "the file is UTF-16 text", "UTF-8"},

    /* Characters. */
    {"camera { eye 0 0 -1 $ look_at 0 0 0 }", 1, 21, 1, "unexpected '$'", ""},
    {"\x01" BALL, 1, 1, 1, "unexpected byte 0x01", ""},
    {"# \xff\n" BALL, 1, 3, 1, "byte 0xff is not UTF-8", "save the file as UTF-8"},
    {"\xc0\xaf" BALL, 1, 1, 2, "byte 0xc0 is not UTF-8", "UTF-8"},
    {"\xe2\x82\xac" BALL, 1, 1, 3, "unexpected '\xe2\x82\xac'", ""},
    {"// no comment\n" BALL, 1, 1, 2, "'//' begins no comment", "begins with '#'"},
    {"/* no\n * comment **/" BALL, 1, 1, 2, "'/*' begins no comment", "begins with '#'"},
    {BALL "film { width 8 // wide }\n  height 4 }\n", 3, 16, 2, "'//' begins no comment", "'#'"},
    {BALL "film {\n // wide\n width 8 }\n", 4, 2, 2, "'//' begins no comment", "'#'"},
    {BALL "let a = 3 // b\nfilm { width (8 * a) }\n", 3, 11, 2, "'//' begins no comment", "'#'"},
    {BALL "film { width /* wide */ 8 }\n", 3, 14, 2, "'/*' begins no comment", "'#'"},
    {BALL "/* open\n{ film", 3, 1, 2, "'/*' begins no comment", "'#'"},

    /* Statements. */
    {"spere { centre 0 0 0 radius 1 }", 1, 1, 5, "unknown block 'spere'", "did you mean 'sphere'?"},
    {"cube { centre 0 0 0 }", 1, 1, 4, "unknown block 'cube'", "did you mean 'box'?"},
    {"material m { color 0.7 }", 1, 14, 5, "unknown field 'color' in material",
     "did you mean 'kd'?"},
    {"render { max-depth 3 }", 1, 10, 9, "'max-depth' is not a name", "did you mean 'max_depth'?"},
    {"render { k ALL }", 1, 12, 3, "'k' takes a whole number or all, found 'ALL'",
     "did you mean 'all'?"},
    {"camera { eye 0 0 0 look_at 0 0 1 projection ortho }", 1, 45, 5,
     "'projection' takes perspective, orthographic or environment, found 'ortho'",
     "did you mean 'orthographic'?"},
    {"environment { radiance 1 }", 1, 1, 11, "unknown block 'environment'",
     "did you mean 'light environment'?"},
    {"Camera { eye 0 0 0 }", 1, 1, 6, "unknown block 'Camera'", "did you mean 'camera'?"},
    {"teapot { size 3 }", 1, 1, 6, "unknown block 'teapot'",
     "begins with one of: let include repeat camera film"},
    {BALL "}\n", 3, 1, 1, "'}' closes nothing", ""},
    {BALL "42\n", 3, 1, 2, "expected a block, 'let', 'include' or 'repeat', found '42'", ""},
    {"{ centre 0 0 0 }\n" BALL, 1, 1, 1,
     "expected a block, 'let', 'include' or 'repeat', found '{'", ""},
    {"light { position 0 0 0 }", 1, 1, 5, "expected a kind of light, found '{'",
     "light point { ... }"},
    {"light pont { position 0 0 0 }", 1, 7, 4, "expected a kind of light, found 'pont'",
     "did you mean 'point'?"},
    {"light sun { direction 0 -1 0 }", 1, 7, 3, "expected a kind of light, found 'sun'",
     "did you mean 'directional'?"},
    {"light area { radiance 3 }", 1, 7, 4, "expected a kind of light, found 'area'",
     "a light with an area is a shape that emits, as in: quad { ...  power 60 }"},
    {"material m { whatsoever 1 }", 1, 14, 10, "unknown field 'whatsoever' in material",
     "fields: `man 5 rts` and dsl/reference.md list them"},
    {"material m { metalness 1 }", 1, 14, 9, "unknown field 'metalness' in material",
     "did you mean 'metallic'?"},
    {"material m { alpha 1 }", 1, 14, 5, "unknown field 'alpha' in material",
     "did you mean 'opacity'?"},
    {"texture t { pattern checker a 1 }\nmaterial m { texture t }", 2, 14, 7,
     "unknown field 'texture' in material", "as `kd_texture NAME`"},
    {"texture t { pattern checker a 1 }\nmaterial m { glass bk7 ior_texture t }", 2, 24, 11,
     "unknown field 'ior_texture' in material", "is a number, without a texture"},
    {"texture t { pattern checker a 1 }\nmaterial m { kd t }", 2, 17, 1, "unknown constant 't'",
     "'t' is a texture: the field that takes it ends in `_texture`"},
    {WHITE "sphere { centre 0 0 0 radius 1 material white texture white }", 2, 55, 5,
     "unknown texture 'white'", "'white' is a material"},
    {"material white { color 0.7 }", 1, 18, 5, "unknown field 'color' in material",
     "did you mean 'kd'?"},
    {"cube { centre 0 0 0 }", 1, 1, 4, "unknown block 'cube'", "did you mean 'box'?"},
    {"light sphere { radiance 3 }", 1, 7, 6, "expected a kind of light, found 'sphere'",
     "a shape that emits"},
    {"material { kd 1 }", 1, 1, 8, "material needs a name, found '{'", "material white { ... }"},
    {"material \"white\" { kd 1 }", 1, 1, 8, "material needs a name, found a string",
     "material white { ... }"},
    {"material off-white { kd 1 }", 1, 10, 9, "'off-white' is not a name", "'_'"},
    {WHITE "sphere ball { centre 0 0 0 radius 1 material white }", 2, 8, 4,
     "sphere takes no name, found 'ball'", ""},
    {WHITE "sphere centre 0 0 0 radius 1 material white }", 2, 8, 6,
     "expected '{' after sphere, found 'centre'", ""},
    {WHITE "sphere { centre 0 0 0 radius 1 material white\n", 2, 1, 6,
     "sphere is not closed: expected '}' before the end of the file", ""},
    {"film { width", 1, 1, 4, "film is not closed", ""},
    {"render { mode", 1, 1, 6, "render is not closed", ""},
    {"camera = { eye 0 0 0 }", 1, 8, 1, "expected '{' after camera, found '='", ""},
    {WHITE "sphere { centre 0 0 0 radius 1 material white\nlight point { position 0 0 0 power 1 }",
     2, 1, 6, "sphere is not closed: expected '}' before 'light'", "line 3"},
    {"material white {\n kd 0.7\nmaterial black { }\n", 1, 1, 8,
     "material is not closed: expected '}' before 'material'", "line 3"},
    {"film { width 4 }\nfilm { height 4 }", 2, 1, 4, "a scene has only one film",
     "the first is at text:1"},
    {WHITE WHITE, 2, 10, 5, "material 'white' is defined twice", "first at text:1"},

    /* Fields. */
    {"camera { eye 0 0 0 lookat 0 0 1 }", 1, 20, 6, "unknown field 'lookat' in camera",
     "did you mean 'look_at'?"},
    {WHITE "sphere { center 0 0 0 radius 1 material white }", 2, 10, 6,
     "unknown field 'center' in sphere", "did you mean 'centre'?"},
    {WHITE "sphere { centre 0 0 0 radius 1 color white }", 2, 32, 5,
     "unknown field 'color' in sphere", "did you mean 'material'?"},
    {WHITE "sphere { centre 0 0 0 radius 1 priority 2 material white }", 2, 32, 8,
     "unknown field 'priority' in sphere",
     "'priority' is a field of material: write it in that of the sphere"},
    {"film { spp 4 }", 1, 8, 3, "unknown field 'spp' in film", "'spp' is a field of render"},
    {"render { width 4 }", 1, 10, 5, "unknown field 'width' in render",
     "'width' is a field of film"},
    {"material m { kd 0.5 transmission 1 }", 1, 21, 12, "unknown field 'transmission'",
     "did you mean 'kt'?"},
    {"material m { base_color 0.5 transmission 1 }", 1, 29, 12, "unknown field 'transmission'",
     "did you mean 'spec_trans'?"},
    {"material m { base_color 0.5 clearcoat_roughness 0 }", 1, 29, 19,
     "unknown field 'clearcoat_roughness'", "'clearcoat_gloss' is its inverse"},
    {"material m { kd 0.5 clearcoat_roughness 0 }", 1, 21, 19,
     "unknown field 'clearcoat_roughness'", "did you mean 'coat_roughness'?"},
    {"material m { kd 0.5 smoothness 1 }", 1, 21, 10, "unknown field 'smoothness'",
     "did you mean 'roughness'?"},
    {"material m { kd 0.5 albedo_texture t }", 1, 21, 14, "unknown field 'albedo_texture'",
     "did you mean 'kd_texture'?"},
    {"light spot { position 0 0 0  intensity 1  direction 0 0 1 }", 1, 43, 9,
     "unknown field 'direction' in light spot", "did you mean 'target'?"},
    {"material m { base_color 0.5 specular_tint 1 }", 1, 29, 13, "unknown field 'specular_tint'",
     "did you mean 'spec_tint'?"},
    {"render { fov 4 }", 1, 10, 3, "unknown field 'fov' in render", "'fov' is a field of camera"},
    {"film { colour 3 }", 1, 8, 6, "unknown field 'colour' in film",
     "the fields of film are: width height"},
    {"film { width 3 width 4 }", 1, 16, 5, "'width' is given twice", "first at line 1"},
    {"camera { eye 0 0 0 }", 1, 1, 6, "camera needs 'look_at'", ""},
    {WHITE "sphere { material white }", 2, 1, 6, "sphere needs 'centre', 'radius'", ""},
    {"light point { position 0 0 0 }", 1, 1, 11, "light point needs 'intensity' or 'power'", ""},
    {"light point { position 0 0 0 intensity 1 power 2 }", 1, 42, 5,
     "light point takes 'intensity' or 'power', not both", ""},
    {WHITE "sphere { centre 0 0 0 radius 1 material white power 1 radiance 2 }", 2, 55, 8,
     "sphere takes 'radiance' or 'power', not both", ""},
    {WHITE "triangle { a 0 0 0 b 1 0 0 c 0 1 0 na 0 0 1 material white }", 2, 1, 8,
     "triangle needs all of 'na', 'nb' and 'nc', or none", ""},
    {"film { 4 width 4 }", 1, 8, 1, "expected a field of film or '}', found '4'", ""},
    {"film { width 4 { } }", 1, 16, 1, "expected a field of film or '}', found '{'", ""},

    /* Numbers of numbers. */
    {"camera { eye 0 0 look_at 0 0 1 }", 1, 10, 7, "'eye' takes three numbers, found two", ""},
    {"camera { eye look_at 0 0 1 }", 1, 10, 3, "'eye' takes three numbers, found 'look_at'", ""},
    {"camera { eye 0 0 0 7 look_at 0 0 1 }", 1, 20, 1,
     "'eye' takes three numbers, found one more: '7'", ""},
    {"material m { kd 0.5 0.5 }", 1, 14, 10, "'kd' takes one or three numbers, found two", ""},
    {"film { width }", 1, 8, 5, "'width' takes a whole number, found '}'", ""},
    {"film { width \"4\" }", 1, 8, 5, "'width' takes a whole number, found a string", ""},
    {"film { width [1 2 3] }", 1, 14, 7, "'width' takes a whole number, found a vector", ""},
    {"let v = [1 2 3]\ncamera { eye v 0 0 look_at 0 0 9 }", 2, 16, 1,
     "'eye' takes three numbers, found one more: '0'", ""},
    {"camera { eye 0, 0, 0 look_at 0 0 1 }", 1, 15, 1, "unexpected ',' in 'eye'",
     "separated by spaces"},
    {"film { width = 4 }", 1, 14, 1, "unexpected '=' in 'width'", "without a sign"},
    {"film { width: 4; }", 1, 13, 1, "unexpected ':' in 'width'", "without a sign"},

    /* Words. */
    {"render { mode phton }", 1, 15, 5,
     "'mode' takes path, photon, direct, normals, albedo, depth or vcm, found 'phton'",
     "did you mean 'photon'?"},
    {"render { mode 3 }", 1, 15, 1,
     "'mode' takes path, photon, direct, normals, albedo, depth or vcm, found '3'", ""},
    {"render { kernel gaussian-jense }", 1, 17, 14,
     "'kernel' takes epanechnikov, box, cone, gaussian, silverman or gaussian-jensen, found "
     "'gaussian-jense'",
     "did you mean 'gaussian-jensen'?"},
    {"material g { fresnel yes }", 1, 22, 3,
     "'fresnel' takes off, dielectric, conductor or schlick, found 'yes'",
     "did you mean 'dielectric'?"},
    {"material g { fresnel true }", 1, 22, 4,
     "'fresnel' takes off, dielectric, conductor or schlick, found 'true'",
     "did you mean 'dielectric'?"},
    {"material g { fresnel false }", 1, 22, 5,
     "'fresnel' takes off, dielectric, conductor or schlick, found 'false'", "did you mean 'off'?"},
    {"render { mode pathtrace }", 1, 15, 9,
     "'mode' takes path, photon, direct, normals, albedo, depth or vcm, found 'pathtrace'",
     "did you mean 'path'?"},
    /* A field's name that stands for the value it is like; but not where it has a value itself. */
    {"render { mode photons }", 1, 15, 7,
     "'mode' takes path, photon, direct, normals, albedo, depth or vcm, found 'photons'",
     "did you mean 'photon'?"},
    {"render { mode photons spp 4 }", 1, 15, 7, "found 'photons'", "did you mean 'photon'?"},
    {"render { mode photons 400 }", 1, 10, 4, "'mode' takes path, photon, direct", ""},
    {WHITE "sphere { centre 0 0 0 radius 1 material whit }", 2, 41, 4, "unknown material 'whit'",
     "did you mean 'white'?"},
    {"sphere { centre 0 0 0 radius 1 material late }\nmaterial late { }", 1, 41, 4,
     "unknown material 'late'", "it is defined further down, at text:2"},
    {WHITE "sphere { centre 0 0 0 material radius 1 }", 2, 23, 8,
     "'material' takes the name of a material, found 'radius'", ""},

    /* Values. */
    {"film { width 0 }", 1, 14, 1, "'width' is 0; it must be from 1 to 65536", ""},
    {"film { width 2.5 }", 1, 14, 3, "'width' is 2.5; it must be a whole number", ""},
    {"film { width 1e9 }", 1, 14, 3, "'width' is 1000000000; it must be from 1 to 65536", ""},
    {"camera { eye 0 0 0 look_at 0 0 1 fov 180 }", 1, 38, 3,
     "'fov' is 180; it must be between 0 and 180, both excluded", ""},
    {"camera { eye 0 0 1e39 look_at 0 0 1 }", 1, 18, 4,
     "'eye' is 1e+39; numbers must not exceed 3.4", ""},
    {"film { width 1e999 }", 1, 14, 5, "the number '1e999' is too large", ""},
    {"film { width 1.2.3 }", 1, 14, 5, "'1.2.3' is not a number", "1e-3"},
    {"film { width 12px }", 1, 14, 4, "'12px' is not a number", "1e-3"},
    {"film { width 0x10 }", 1, 14, 4, "'0x10' is not a number", "1e-3"},
    {"film { width 1e }", 1, 14, 2, "'1e' is not a number", "1e-3"},
    {"film { width nan }", 1, 14, 3, "unknown constant 'nan'", "every number is finite"},
    {"film { width -inf }", 1, 15, 3, "unknown constant 'inf'", "every number is finite"},
    {WHITE "sphere { centre 0 0 0 radius -1 material white }", 2, 30, 2,
     "'radius' is -1; it must be from 1e-15 to 1e+15", ""},
    {WHITE "sphere { centre 0 0 0 radius 1e-60 material white }", 2, 30, 5,
     "'radius' is 1e-60; it must be from 1e-15 to 1e+15", ""},
    {WHITE "box { centre 0 0 0 size 1 0 1 material white }", 2, 27, 1,
     "'size' is 0; it must be from 1e-15 to 1e+15", ""},
    {WHITE "box { centre 0 0 0 size 2 material white }", 2, 20, 6,
     "'size' takes three numbers, found one", ""},
    {WHITE "box { centre 0 0 0 material white }", 2, 1, 3, "box needs 'size'", ""},
    {"camera { eye 0 0 0 look_at 0 0 1 fov 1e-60 }", 1, 38, 5,
     "'fov' is 0; it must be between 0 and 180", ""},
    {WHITE "plane { point 0 0 0 normal 0 0 0 material white }", 2, 28, 5,
     "'normal' must not be zero", ""},
    {"material m { kd 0.5 1.5 0.5 }", 1, 21, 3, "'kd' is 1.5; it must be from 0 to 1", ""},
    {"material m { kd 0.6 ks 0.6 }", 1, 17, 3, "kd + ks + kt is 1.2", ""},
    {"material m { kd 0.6 diffuse_transmission 0.6 }", 1, 17, 3,
     "kd + ks + kt + diffuse_transmission is 1.2", ""},
    {"material m { base_color 0.5 diffuse_transmission 0.3 }", 1, 50, 3,
     "a principled material has no diffuse_transmission", ""},
    {"material m { base_color 0.5 coat_roughness 0.3 }", 1, 44, 3,
     "a principled material has no coat_roughness", ""},
    {"material m { base_color 0.5 metal gold }", 1, 35, 4, "a principled material has no metal",
     ""},
    {"material m { fuzz 0.5 ks 0.2 }", 1, 26, 3, "fuzz lies over kd alone; it goes without ks", ""},
    {"material m { base_color 0.5 fuzz 0.3 }", 1, 25, 3, "it goes without base_color", ""},
    {"material m { fuzz 0.5 fresnel dielectric }", 1, 31, 10, "it goes without fresnel", ""},
    {"material m { fuzz 0.5 roughness 0.2 }", 1, 33, 3, "it goes without roughness", ""},
    {"material m { kd 0.5 fuzz_roughness 0.2 }", 1, 36, 3, "fuzz_roughness goes with fuzz", ""},
    {"material m { fuzz 0.5 1.5 0.5 }", 1, 23, 3, "'fuzz' is 1.5", ""},
    {"texture t { pattern constant a 4 } material m { fuzz_texture t }", 1, 62, 1,
     "fuzz reaches 4; it must not exceed 1", ""},
    {"material m { diffuse_transmission 0.5 kt 0.2 }", 1, 42, 3, "is no solid", ""},
    {"material m { diffuse_transmission 0.5 ks 0.2 fresnel dielectric }", 1, 54, 10, "is no solid",
     ""},
    {"material m { diffuse_transmission 0.5 coat 1 }", 1, 44, 1, "is no solid", ""},
    {"material m { diffuse_transmission 0.5 roughness 0.2 }", 1, 49, 3, "roughness of ks alone",
     ""},
    {"material m { diffuse_transmission 0.5 interface true }", 1, 49, 4, "is no solid", ""},
    {"material m { diffuse_transmission 0.5 metal gold }", 1, 45, 4, "is no solid", ""},
    {"camera { eye 1 2 3 look_at 1 2 3 }", 1, 28, 5, "eye and look_at are the same point", ""},
    {WHITE "quad { corner 0 0 0 edge1 1 0 0 edge2 2 0 0 material white }", 2, 39, 5,
     "its area is zero", ""},
    {WHITE "triangle { a 0 0 0 b 1 0 0 c 2 0 0 material white }", 2, 1, 8, "its area is zero", ""},
    {"material l { emission 1 }\nplane { point 0 0 0 normal 0 1 0 material l }", 2, 43, 1,
     "cannot emit", ""},

    /* What a render would refuse. */
    {"render { mode photon k all }", 1, 24, 3,
     "to gather all photons within a radius, give the radius", ""},
    {"render { mode photon radius 1 caustic_k all k 9 passes 2 area hull }", 1, 63, 4,
     "not for passes", ""},
    {"render { variance true mode photon }", 1, 19, 4,
     "the samples of one photon map share its photons", ""},
    {"material m { kt 1 opacity 0.5 }", 1, 27, 3, "a solid has no opacity below 1", ""},
    {"material m { kt 1 thin true absorption 1 opacity 0.5 }", 1, 50, 3,
     "of a sheet around a medium, leave out absorption and scattering", ""},
    {"material m { kd 1 opacity 0 }", 1, 27, 1, "opacity", ""},
    {"material b { kd 1 }\nmaterial m { blend a with b }", 2, 20, 1, "unknown material 'a'",
     "above their use"},
    {"material a { kd 1 }\nmaterial m { blend a with m }", 2, 27, 1, "unknown material 'm'",
     "'m' cannot name itself"},
    {"let a = a + 1", 1, 9, 1, "unknown constant 'a'", "'a' cannot name itself"},
    {"material m { kd 1 back a }\nmaterial a { kd 1 }", 1, 24, 1, "unknown material 'a'",
     "define it before its use"},
    {"material a { kd 1 }\nmaterial m { blend a }", 2, 20, 1, "it needs with", ""},
    {"material a { kd 1 }\nmaterial m { with a }", 2, 19, 1, "with goes with blend", ""},
    {"material a { kd 1 }\nmaterial m { blend a with black weight 1.5 }", 2, 40, 3,
     "'weight' is 1.5; it must be from 1e-06 to 1", ""},
    {"material a { kd 1 }\nmaterial m { kd 1 blend a with black }", 2, 17, 1,
     "a blend has no kd of its own: give it to its parts", ""},
    {"material a { kd 1 }\nmaterial m { blend a with black fuzz 0.5 }", 2, 20, 1,
     "fuzz lies over kd alone; it goes without blend", ""},
    {"material a { kd 1 }\nmaterial m { blend a with black coat_absorption 0.5 }", 2, 49, 3,
     "a blend has no coat_absorption of its own: give it to its parts", ""},
    {"material a { emission 1 }\nmaterial m { kd 1 back a }", 2, 24, 1, "a part of it has emission",
     ""},
    {"material a { kd 1 opacity 0.5 }\nmaterial m { blend a with black }", 2, 20, 1,
     "a part of it has an opacity", ""},
    {"material a { interface true }\nmaterial m { blend a with black }", 2, 20, 1,
     "an interface has no surface", ""},
    {"material a { kt 1 }\nmaterial m { kd 1 back a }", 2, 24, 1,
     "back goes with opaque materials alone", ""},
    {"material a { kt 1 }\nmaterial b { kt 1 ior 1.3 }\nmaterial m { blend a with b }", 3, 27, 1,
     "its parts bound solids of another ior", ""},
    {"material a { kt 1 }\nmaterial b { kt 1 thin true }\nmaterial m { blend a with b }", 3, 27, 1,
     "a part of it is a thin sheet, another bounds a solid", ""},
    {"material a { kt 1 thin true scattering 1 }\nmaterial b { kd 1 }\n"
     "material m { blend a with b }",
     3, 27, 1, "sheets of blends are hollow", ""},
    {"texture t { pattern checker a 1 }\nmaterial a { kd 1 bump_texture t }\n"
     "material m { blend a with black }",
     3, 20, 1, "give that to the whole blend instead", ""},
    {"render { target_error 0.1 mode depth }", 1, 23, 3,
     "the error is that of light, and mode depth shows none", ""},

    /* let and arithmetic. */
    {"let = 3\n" BALL, 1, 1, 3, "expected a name after 'let', found '='", ""},
    {"let\nx = 3\n" BALL, 1, 1, 3, "expected a name after 'let' on the same line, found 'x'", ""},
    {"let a 3\n" BALL, 1, 7, 1, "expected '=' after 'let a', found '3'", ""},
    {"let a =\n" BALL, 1, 8, 1, "expected a number, found 'material'", ""},
    {"let a = 1\nlet a = 2\n" BALL, 2, 5, 1, "constant 'a' is defined twice", "first at text:1"},
    {"let a = 1 / 0\n" BALL, 1, 11, 1, "division by zero", ""},
    {"let a = [1 2 3] / [1 0 1]\n" BALL, 1, 17, 1, "division by zero", ""},
    {"let a = 1e200 * 1e200\n" BALL, 1, 15, 1, "the result of this '*' is too large", ""},
    {"let a = (1 + 2\n" BALL, 1, 15, 1, "expected ')', found 'material'",
     "closes the '(' at line 1, column 9"},
    {"let a = 1 + * 2\n" BALL, 1, 13, 1, "expected a number, found '*'", ""},
    {"let a = 0.6 0.1 0.1\n" BALL, 1, 13, 3, "unexpected '0.1' after the value of 'a'",
     "in brackets"},
    {"let a = 5;\n" BALL, 1, 10, 1, "unexpected ';' after the value of 'a'",
     "begins on a new line"},
    {"let a = [1 2]\n" BALL, 1, 13, 1, "a vector has three numbers, found 2", ""},
    {"let a = [1 2 3 4]\n" BALL, 1, 16, 1, "expected ']', found '4'",
     "closes the '[' at line 1, column 9"},
    {"let a = [1, 2, 3]\n" BALL, 1, 11, 1, "expected a number, found ','", "separated by spaces"},
    {"let a = [[1 2 3] 2 3]\n" BALL, 1, 10, 7, "expected a number, found a vector", ""},
    {"let height = 1\nfilm { width heigth }", 2, 14, 6, "unknown constant 'heigth'",
     "did you mean 'height'?"},
    {"film { width w }\nlet w = 3", 1, 14, 1, "unknown constant 'w'",
     "it is defined further down, at text:2"},
    {"let a = b\nlet b = 3\n" BALL, 1, 9, 1, "unknown constant 'b'", "further down"},
    {"camera { eye 0 1 - 4 look_at 0 0 1 }", 1, 18, 1,
     "this '-' is neither a sign nor inside parentheses", "(a - b)"},
    {"camera { eye 0 1-4 look_at 0 0 1 }", 1, 17, 1,
     "this '-' is neither a sign nor inside parentheses", "(a - b)"},
    {"film { width 2 * 3 }", 1, 16, 1, "unexpected '*' after the value of 'width'", "(2 * 3)"},
    {"camera { eye 0 3/2 1 look_at 0 0 1 }", 1, 17, 1, "unexpected '/' after the value of 'eye'",
     "(2 * 3)"},
    {WHITE "let n = 2\nrepeat i from 0 to n + 1 {\n let z = i\n"
           " sphere { centre z 0 0 radius 1 material white }\n}\n",
     3, 22, 1, "expected '{' after repeat, found '+'", "(n - 1)"},
    {"film { width 5 -3 }", 1, 16, 1, "unexpected '-' after the value of 'width'",
     "in parentheses"},
    {"film { width +3 }", 1, 8, 5, "'width' takes a whole number, found '+'", ""},
    {"let radius = 1\n" WHITE "sphere { centre 0 0 0 radius radius material white }", 3, 23, 6,
     "'radius' takes a number, found 'radius'", "in parentheses"},

    {"let pi = 4\n" BALL, 1, 5, 2, "'pi' is already defined", "a constant of the language"},
    {"repeat pi from 1 to 2 { }\n" BALL, 1, 8, 2, "'pi' is already defined",
     "a constant of the language"},

    /* Functions. */
    {"let a = sine(3)\n" BALL, 1, 9, 4, "unknown function 'sine'", "did you mean 'sin'?"},
    {"let a = 1\nlet b = a(3)\n" BALL, 2, 9, 1, "unknown function 'a'", "a space separates"},
    {"let a = min(3)\n" BALL, 1, 9, 3, "'min' takes two values, separated by a comma, found 1", ""},
    {"let a = sin(1, 2)\n" BALL, 1, 9, 3, "'sin' takes one value, found 2", ""},
    {"let a = sqrt(-1)\n" BALL, 1, 9, 4, "'sqrt' has no finite value here", ""},
    {"let a = sin (30)\n" BALL, 1, 9, 3, "'sin' is apart from its '('", "sin(...)"},
    {"camera { eye 0 0 pow (2, 3) look_at 0 0 0 }", 1, 18, 3, "'pow' is apart from its '('",
     "pow(...)"},
    {"let a = 2 ^ 3\n" BALL, 1, 11, 1, "unexpected '^' after the value of 'a'", "pow(x, y)"},
    {"let a = (5 % 3)\n" BALL, 1, 12, 1, "expected ')', found '%'", "mod(x, y)"},
    {"material m { kd 0.5 roughness 30% }\n", 1, 33, 1,
     "unexpected '%' after the value of 'roughness'", "write 0.3"},
    {"film { width 30 % 7 }", 1, 17, 1, "unexpected '%' after the value of 'width'", "mod(x, y)"},
    {"camera { eye (0,1,0) look_at 0 0 1 }", 1, 16, 1, "expected ')', found ','",
     "separated by spaces"},
    {WHITE "sphere { centre 0 0 0 radius 1 material \"white\" }", 2, 41, 7, "found a string",
     "only names of files and layers stand in double quotes"},
    {"material m { kd #ff0000 }\n", 1, 1, 8, "material is not closed",
     "'#' begins a comment, in which a '}' stands at line 1"},
    {"sphere { centre 0 0 0 material radius radius 1 }\nmaterial radius { kd 0.5 }", 1, 32, 6,
     "unknown material 'radius'", "it is defined further down, at text:2"},
    {"film { width 2 ^ 3 }", 1, 16, 1, "unexpected '^' after the value of 'width'", "pow(x, y)"},
    {"film { width 10 cm }", 1, 17, 2, "unknown field 'cm' in film", "without units"},
    {"film { width 10px }", 1, 14, 4, "'10px' is not a number", "without units"},
    {"light { }", 1, 1, 5, "expected a kind of light",
     "the kinds are: point spot projector goniometric beam directional environment; as in"},
    {"let a = sin(1\n" BALL, 1, 14, 1, "expected ')', found 'material'", "closes the '('"},

    /* repeat. */
    {"repeat\ni from 1 to 2 { " BALL "}", 1, 1, 6,
     "expected a name after 'repeat' on the same line, found 'i'",
     "as in: repeat i from 1 to 10 { ... }"},
    {"repeat { }\n" BALL, 1, 1, 6, "expected a name after 'repeat', found '{'",
     "repeat i from 1 to 10"},
    {"repeat i to 3 { }\n" BALL, 1, 10, 2, "expected 'from', found 'to'", "repeat i from 1 to 10"},
    {"repeat i from 1 3 { }\n" BALL, 1, 17, 1, "expected 'to', found '3'", "repeat i from 1 to 10"},
    {"repeat i from 1 to 2 - 1 { }\n" BALL, 1, 22, 1, "expected '{' after repeat, found '-'",
     "in parentheses"},
    {"repeat i from 1 to [1 2 3] { }\n" BALL, 1, 20, 7, "expected a number, found a vector", ""},
    {"repeat i from 0 to 1e9 { }\n" BALL, 1, 1, 6,
     "the repeats of a scene have more than 10000000 iterations", ""},
    {BALL "repeat i from 1 to 3 {\n", 3, 8, 1, "this repeat is not closed", ""},
    {BALL "repeat i from 1 to 3 { film { width 0 } }\n", 3, 37, 1,
     "'width' is 0; it must be from 1 to 65536", ""},
    {"let i = 1\n" BALL "repeat i from 1 to 3 { }\n", 4, 8, 1, "constant 'i' is defined twice",
     "first at text:1"},
    {"repeat i from 1 to 2 { material m { } sphere { centre i 0 0 radius 1 material m } }\n"
     "sphere { centre 0 0 0 radius 1 material m }",
     2, 41, 1, "unknown material 'm'", "above their use"},

    /* Transforms. */
    {WHITE "sphere { centre 0 0 0 radius 1 material white scale 0 }", 2, 53, 1,
     "'scale' is 0; it must be not zero", ""},
    {WHITE "sphere { centre 0 0 0 radius 1 material white rotate 0 0 0 9 }", 2, 54, 7,
     "the axis of 'rotate' must not be zero", ""},
    {WHITE "sphere { centre 0 0 0 radius 1 material white rotate 0 1 0 }", 2, 47, 12,
     "'rotate' takes four numbers, found three", ""},
    {WHITE "sphere { centre 0 0 0 radius 1 material white matrix 1 0 0 0  0 1 0 0  0 0 0 1 }", 2,
     54, 25, "the transform cannot be inverted", ""},

    {WHITE "sphere { centre 0 0 0 radius 1 material white matrix 0 0 0 0  0 0 0 0  0 0 0 0 }", 2,
     54, 25, "the transform cannot be inverted: it is zero", ""},
    {WHITE "sphere { centre 0 0 0 radius 1 material white scale 1e-30 scale 1e-30 }", 2, 65, 5,
     "the transform cannot be inverted: it is zero", ""},
    {WHITE "sphere { centre 0 0 0 radius 1 material white scale 1e-30 scale 1e-30 scale }", 2, 71,
     5, "'scale' takes", ""},
    {WHITE "sphere { centre 0 0 0 radius 1 material white scale 1e-30 scale 1e-30 rotate }", 2, 71,
     6, "'rotate' takes", ""},

    /* Textures, meshes, files. */
    {"material m { kd_texture wood }\n", 1, 25, 4, "unknown texture 'wood'",
     "textures are defined by 'texture NAME"},
    {"texture wood { file \"none.png\" }\n", 1, 22, 8, "none.png", ""},
    {"texture wood { }\n", 1, 1, 7, "an image needs a file", ""},
    {"texture wood { file \"\" }\n", 1, 22, 0 + 1, "the name of the file is empty", ""},
    {"texture wood { file wood }\n", 1, 21, 4, "'file' takes a file name in quotes, found 'wood'",
     "double quotes"},
    {"texture t { pattern checker layer albedo }\n", 1, 35, 6,
     "'layer' takes a name in quotes, found 'albedo'", "names of layers stand in double quotes"},
    {"texture t { pattern checker layer \"\" }\n", 1, 36, 1, "'layer' is empty", ""},
    {"light environment { radiance 1 matrix 1 0 0 0  0 1 0 0  0 0.1 1 0 }\n", 1, 39, 27,
     "environment: the transform must be a rotation, a mirroring or both, with one scale for all",
     ""},
    {"light environment { radiance 1 scale 1 -1 1.01 }\n", 1, 38, 9,
     "environment: the transform must be a rotation, a mirroring or both", ""},
    {"light environment { radiance 1 matrix 1 0 0 0  0 1 0 2  0 0 1 0 }\n", 1, 39, 25,
     "environment: it is infinitely far, and the transform moves it by (0, 2, 0)", ""},
    {"light environment { radiance 1 rotate 0 0 0 9 }\n", 1, 39, 7,
     "the axis of 'rotate' must not be zero", ""},
    {"light environment { radiance 1 translate 0 0 1 }\n", 1, 32, 9,
     "unknown field 'translate' in light environment",
     "the fields of light environment are: radiance file rotation rotate scale matrix layer"},
    {"light environment { layer \"a\" }\n", 1, 28, 1,
     "environment: a layer is one of an image: name its file", ""},
    {"light environment { file \"scenes/textures/letter.png\" layer \"albedo\" }\n", 1, 62, 6,
     "environment: scenes/textures/letter.png: no layer 'albedo': the image holds no layers beside "
     "R, G, B",
     ""},
    {"texture t { file \"scenes/textures/letter.png\" layer \"albedo\" }\n", 1, 54, 6,
     "cannot use scenes/textures/letter.png as a texture: no layer 'albedo'", ""},
    {"texture t { pattern checker a 1 }\nmaterial m { kd_texture t  ks 0.1 }", 2, 25, 1,
     "kd + ks + kt is 1.1 in red where the textures are brightest", ""},
    {"texture wood { pattern checker a_texture wood }\n", 1, 42, 4,
     "texture 'wood' cannot lie inside of itself", ""},
    {"texture oak { pattern mix a 1 weight_texture ash }\n"
     "texture ash { pattern mix a 1 weight_texture oak }\n",
     1, 46, 3, "unknown texture 'ash'",
     "'oak' lies inside of 'ash', at text:2: textures cannot lie inside of each other"},
    {"texture elm { pattern constant a 1 }\n"
     "texture oak { pattern mix a 1 b_texture ash }\n"
     "texture ash { pattern mix a 1 b_texture elm }\n",
     2, 41, 3, "unknown texture 'ash'", "it is defined further down, at text:3"},
    {"texture t { pattern multiply a 0.5 }\n", 1, 1, 7,
     "a product with a black b is black: it needs b or b_texture", ""},
    {"texture t { pattern checker a 4 }\ntexture m { pattern mix b 1 weight_texture t }\n", 2, 44,
     1, "texture: weight_texture reaches 4; it must not exceed 1", ""},
    {"texture t { pattern mix b 1 weight 0 }\n", 1, 36, 1, "'weight' is 0; it must", ""},
    {"texture t1 { pattern multiply a 1 b 1 }\n"
     "texture t2 { pattern checker a_texture t1 }\n"
     "texture t3 { pattern gradient b_texture t2 }\n"
     "texture t4 { pattern multiply a_texture t3 b 1 }\n"
     "texture t5 { pattern mix a 1 weight_texture t4 }\n"
     "texture t6 { pattern mix a_texture t1 b_texture t5 }\n"
     "texture t7 { pattern checker a_texture t6 }\n"
     "texture t8 { pattern checker a_texture t7 }\n"
     "texture t9 { pattern checker a_texture t1 b_texture t8 }\n",
     9, 53, 2,
     "texture: more than 8 textures lie in each other: 't9', in it 't8', in it 't7', in it 't6', "
     "in "
     "it 't5', in it 't4', in it 't3', in it 't2', in it 't1'",
     ""},
    {"texture t { pattern constant a 1 }\ntexture d { pattern multiply a_texture t b 1.5 }\n"
     "material m { kd_texture d }",
     3, 25, 1, "kd + ks + kt is 1.5 in red where the textures are brightest", ""},
    {"texture t { pattern gradient b 0.5 rotate 8 }\n"
     "texture d { pattern multiply a_texture t b 1 }\n"
     "material m { kd 1 normal_texture d }",
     3, 34, 1, "normal_texture has a rotated texture inside", ""},
    {"texture t { file \"scenes/textures/letter.png\" }\n"
     "texture d { pattern multiply a_texture t b 1 }\n"
     "material m { kd 1 normal_texture d }",
     3, 34, 1, "normal_texture holds directions, not sRGB", ""},
    {"material m { interface true  density puff }\n", 1, 38, 4, "unknown grid 'puff'",
     "grids are defined by 'grid NAME"},
    {"grid g { file \"none.grid\" }\n", 1, 16, 9, "none.grid", ""},
    {"grid g { file \"scenes/README.md\" }\n", 1, 16, 16, "does not begin with 'RTGRID1'", ""},
    {"grid g { }\n", 1, 1, 4, "grid needs 'file'", ""},
    {"grid g { file \"scenes/media/puff.grid\" lo 0 0 0 }\n", 1, 1, 4,
     "grid needs all of 'lo' and 'hi', or none", ""},
    {"grid g { file \"scenes/media/puff.grid\" lo 0 0 0 hi 1 1 0 }\n", 1, 52, 5, "hi has", ""},
    {"grid g { file \"scenes/media/puff.grid\" }\nmedium { scattering 1e6 density g }\n", 2, 33, 1,
     "an optical thickness of", ""},
    {"grid g { file \"scenes/media/puff.grid\" wrap repeat }\nmedium { scattering 1 density g }\n",
     2, 31, 1, "only an albedo has 'wrap repeat'", ""},
    {"mesh m { file \"none.ply\" }\n", 1, 16, 8, "none.ply", ""},
    {"mesh m { file \"scenes/README.md\" }\n", 1, 16, 16, "unknown mesh format", ""},
    {WHITE "instance bunny { material white }\n", 2, 10, 5, "unknown mesh 'bunny'",
     "meshes are defined by 'mesh NAME"},
    {WHITE "instance { material white }\n", 2, 1, 8, "instance needs a name, found '{'",
     "instance bunny"},
    {WHITE "triangle { a 0 0 0 b 1 0 0 c 0 1 0 uva 0 0 material white }\n", 2, 1, 8,
     "triangle needs all of 'uva', 'uvb' and 'uvc', or none", ""},
    {"material m { ks 1 fresnel conductor }", 1, 1, 8, "a conductor needs eta", ""},

    /* Metals and glasses by name. */
    {"material m { metal gild }", 1, 20, 4, "'metal' takes one of 19 words, found 'gild'",
     "did you mean 'gold'?"},
    {"material m { glass xyzzyqqq }", 1, 20, 8, "'glass' takes one of 27 words, found 'xyzzyqqq'",
     "baf10, bk7, "},
    {"material m { metal gold eta 1 }", 1, 25, 3, "material takes 'metal' or 'eta', not both",
     "'metal' sets 'fresnel conductor', 'eta' and 'k'"},
    {"material m { metal gold k 0 }", 1, 25, 1, "material takes 'metal' or 'k', not both",
     "'metal' sets"},
    {"material m { fresnel off metal gold }", 1, 14, 7,
     "material takes 'metal' or 'fresnel', not both", "'metal' sets"},
    {"material m { ior 1.5 glass bk7 }", 1, 14, 3, "material takes 'glass' or 'ior', not both",
     "'glass' sets 'fresnel dielectric' and 'ior'"},
    {"material m { metal gold glass bk7 }", 1, 25, 5, "material takes 'metal' or 'glass', not both",
     ""},
    {"material m { metal gold kt 0.5 }", 1, 28, 3, "material 'm': takes metal or kt, not both", ""},
    {"material m { interface true glass water }", 1, 35, 5,
     "an interface has no surface, and so no glass", ""},
    {"material m { kt 1 abbe -3 }", 1, 24, 2, "'abbe' is -3; it must be from 1 to 1000", ""},
    {"material m { kt 1 cauchy 1.5 0 }", 1, 30, 1, "'cauchy'", ""},
    {"material m { kt 1 cauchy 1.5 0.01 ior 1.4 }", 1, 35, 3,
     "material takes 'cauchy' or 'ior', not both", "'cauchy' sets 'ior'"},
    {"material m { ior 1.4 kt 1 sellmeier_b 1 0 0 }", 1, 14, 3,
     "material takes 'sellmeier_b' or 'ior', not both", "'sellmeier_b' sets 'ior'"},
    {"material m { kt 1 dispersion true }", 1, 30, 4, "it needs glass", ""},
    {"material m { glass ethanol dispersion true }", 1, 39, 4,
     "the dispersion of this glass is not known", ""},
    {"material m { kt 1 abbe 30 cauchy 1.5 0.1 }", 1, 34, 7, "takes abbe or cauchy, not both", ""},
    {"material m { kt 1 sellmeier_b 1 0 0 sellmeier_c 0.3 0 0 }", 1, 31, 5,
     "by sellmeier_b the index of refraction is", ""},
    {"material a { kt 1 abbe 30 }\nmaterial b { kt 1 abbe 20 }\nmaterial c { blend a with b }", 3,
     27, 1, "its parts bound solids of another dispersion", ""},
    {"light environment { radiance 1 }\nlight environment { radiance 1 }", 2, 1, 17,
     "a scene has only one light environment", "the first is at text:1"},
    {WHITE "cone { base 0 0 0 apex 0 1 0 radius 1 apex_radius 2 material white }\n", 2, 51, 1,
     "apex_radius is 2 m", ""},

    /* include and strings. */
    {"mesh m { file \"wood.ply shading flat }\n" BALL, 1, 15, 1, "the string is not closed", ""},
    {"texture wood { file \"wood.png  scale 2 2\n wrap clamp\n}\n" BALL, 1, 21, 1,
     "the string is not closed", ""},
    {"model { file \"wood.ply  material white }\n" BALL, 1, 14, 1, "the string is not closed", ""},
    {WHITE "sphere (\n centre 0 0 0\n radius 1\n material white\n}\n", 2, 8, 1,
     "expected '{' after sphere, found '('", ""},
    {WHITE "sphere\n centre 0 0 0\n radius 1\n material white\n}\n", 2, 7, 1,
     "expected '{' after sphere, found 'centre'", ""},
    {"include box\n" BALL, 1, 1, 7, "expected a file name in quotes after 'include', found 'box'",
     "materials.rts"},
    {"include \"box.rts\n" BALL, 1, 9, 1, "the string is not closed", ""},
    {"include \"\"\n" BALL, 1, 10, 1, "the name of the file to include is empty", ""},
    {"include \"no/such/file.rts\"\n" BALL, 1, 10, 16,
     "cannot include 'no/such/file.rts': No such file", ""},
    {"include \"scenes\"\n" BALL, 1, 10, 6, "cannot include 'scenes': it is a directory", ""},
};

static void every_mistake_is_one_error_at_its_place(void **state)
{
    static collected c;
    int failures = 0;
    (void)state;
    for (size_t i = 0; i < sizeof bad_texts / sizeof *bad_texts; i++) {
        const bad_text *bad = &bad_texts[i];
        const collected_diagnostic *d = &c.items[0];
        collect_text(&c, bad->text);
        int good = c.status == RT_ERROR_INPUT && c.scene == NULL && c.count == 1 &&
                   d->line == bad->line && d->column == bad->column && d->length == bad->length &&
                   strstr(d->message, bad->message) &&
                   (bad->hint[0] ? strstr(d->hint, bad->hint) != NULL : d->hint[0] == '\0');
        /* The caller's error says the same. */
        good = good && c.error.status == RT_ERROR_INPUT && c.error.line == d->line &&
               c.error.column == d->column && strcmp(c.error.file, "text") == 0 &&
               strcmp(c.error.message, d->message) == 0;
        if (good)
            continue;
        failures++;
        print_error("text %zu:\n%s\nexpected %d:%d+%d %s (%s)\n", i, bad->text, bad->line,
                    bad->column, bad->length, bad->message, bad->hint);
        for (int j = 0; j < c.count && j < COLLECTED_MAX; j++)
            print_error("   found %d:%d+%d %s (%s)\n", c.items[j].line, c.items[j].column,
                        c.items[j].length, c.items[j].message, c.items[j].hint);
        collected_free(&c);
    }
    assert_int_equal(failures, 0);
}

static void five_errors_give_five_reports_in_order(void **state)
{
    static const char text[] = "camera { eye 0 0  look_at 0 0 1  fov 200 }\n" /* two numbers, fov */
                               "let a = 2 * (3 + )\n"
                               /* field, material */
                               "sphere { centre 0 0 0  raduis a  material white }\n"
                               "light point { position 0 0 0  intensity a }\n";
    static const int places[5][2] = {{1, 10}, {1, 38}, {2, 18}, {3, 24}, {3, 43}};
    static collected c;
    (void)state;
    collect_text(&c, text);
    assert_int_equal(c.count, 5);
    for (int i = 0; i < 5; i++) {
        assert_int_equal(c.items[i].line, places[i][0]);
        assert_int_equal(c.items[i].column, places[i][1]);
    }
    assert_string_equal(c.error.message, "'eye' takes three numbers, found two (and 4 more)");
    assert_int_equal(c.error.line, 1);
    assert_int_equal(c.error.column, 10);
}

static void the_source_line_is_quoted_whole(void **state)
{
    static collected c;
    (void)state;
    collect_text(&c, "\xef\xbb\xbf"
                     "film {\r\n\twidth 0 # none\r\n}\r\n");
    assert_int_equal(c.count, 1);
    assert_string_equal(c.items[0].source_line, "\twidth 0 # none");
    assert_int_equal(c.items[0].column, 8);
    collect_text(&c, "\xef\xbb\xbf"
                     "flim { }");
    assert_string_equal(c.items[0].source_line, "flim { }");
    assert_int_equal(c.items[0].column, 1);
}

static void reading_stops_after_a_thousand_errors(void **state)
{
    static collected c;
    const size_t lines = 100000;
    char *text = malloc(4 * lines + 1);
    (void)state;
    assert_non_null(text);
    for (size_t i = 0; i < lines; i++)
        memcpy(text + 4 * i, "foo\n", 4);
    text[4 * lines] = '\0';
    collect_text(&c, text);
    assert_int_equal(c.status, RT_ERROR_INPUT);
    assert_int_equal(c.errors, 1001);
    free(text);
}

/* Deep or long input neither overflows a stack nor takes more than linear time. */
static void deep_and_long_texts_are_refused(void **state)
{
    static const struct {
        const char *head, *repeated, *message;
    } cases[] = {
        {"let a = ", "(", "parentheses are nested deeper than 64"},
        {"let a = ", "[", "parentheses are nested deeper than 64"},
        {"let a = ", "-", "expected a number, found the end of the file"},
        {"let a = 1", "+1", "the expression is too long"},
        {"film { width ", "{", "'width' takes a whole number, found '{'"},
        {"foo ", "{", "unknown block 'foo'"},
        {"", "{", "expected a block, 'let', 'include' or 'repeat', found '{'"},
    };
    static collected c;
    const size_t count = 1000000;
    (void)state;
    char *text = malloc(3 * count);
    assert_non_null(text);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char *end = text + sprintf(text, "%s", cases[i].head);
        for (size_t j = 0; j < count; j++, end += strlen(cases[i].repeated))
            strcpy(end, cases[i].repeated);
        collect_text(&c, text);
        assert_int_equal(c.status, RT_ERROR_INPUT);
        int found = 0;
        for (int j = 0; j < c.count && j < COLLECTED_MAX; j++)
            found |= strstr(c.items[j].message, cases[i].message) != NULL;
        if (!found)
            fail_msg("%s...: %s", cases[i].head, c.items[0].message);
    }
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_mistake_is_one_error_at_its_place),
        cmocka_unit_test(five_errors_give_five_reports_in_order),
        cmocka_unit_test(the_source_line_is_quoted_whole),
        cmocka_unit_test(reading_stops_after_a_thousand_errors),
        cmocka_unit_test(deep_and_long_texts_are_refused),
    };
    return cmocka_run_group_tests_name("errors", tests, NULL, NULL);
}
