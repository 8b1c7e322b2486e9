/* What a scene is warned of: fields without effect, what nothing uses, what a check finds. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "lib/image/scratch.h"
#include "tests/dsl/collect.h"

#define WHITE "material white { kd 0.7 }\n"
#define BALL WHITE "sphere { centre 0 0 0  radius 1  material white }\n"

static void what_nothing_uses_is_warned_of(void **state)
{
    static collected c;
    (void)state;
    collect_text(&c, "let a = 1\nlet b = a\nmaterial m { }\nfilm { width 4 }\n");
    assert_int_equal(c.status, RT_OK);
    assert_int_equal(c.count, 2);
    assert_true(c.items[0].severity == RT_SEVERITY_WARNING &&
                c.items[1].severity == RT_SEVERITY_WARNING);
    assert_string_equal(c.items[0].message, "constant 'b' is never used");
    assert_string_equal(c.items[1].message, "material 'm' is never used");
    collected_free(&c);
}

/* Not where a repeat around it may give it iterations at other times. */
static void a_repeat_without_iterations_is_warned_of(void **state)
{
    static collected c;
    (void)state;
    collect_text(&c, BALL "repeat i from 5 to 1 { nonsense }\n");
    assert_int_equal(c.status, RT_OK);
    assert_int_equal(c.count, 1);
    assert_true(c.items[0].severity == RT_SEVERITY_WARNING && c.items[0].line == 3 &&
                c.items[0].column == 1);
    assert_string_equal(c.items[0].message,
                        "this repeat makes no iterations: it counts up from 5 to 1");
    collected_free(&c);
    collect_text(
        &c,
        BALL "repeat i from 1 to 2 { repeat j from 1 to (i - 1) { film { width (i + j) } } }\n");
    expect_clean(&c, "a triangle of iterations");
    collected_free(&c);
}

static const struct {
    const char *text;
    int column;
    const char *message;
} fields_cases[] = {
    {"material m { kd 0.5 eta 1 }", 21, "'eta' has no effect without 'fresnel conductor'"},
    {"material m { ks 1 fresnel dielectric k 1 }", 38,
     "'k' has no effect without 'fresnel conductor'"},
    {"material m { emission 1 roughness 0.1 }", 25,
     "'roughness' has no effect without 'kd', 'ks' or 'kt'"},
    {"material m { kd 0.5 roughness 0.2 roughness_v 0.1 }", 35,
     "'roughness_v' has no effect without 'ks' or 'kt'"},
    {"material m { ks 1 roughness 0.2 anisotropy_rotation 9 }", 33,
     "'anisotropy_rotation' has no effect without 'roughness_v'"},
    {"material m { ks 1 roughness 0.2 anisotropy_turn 0.1 }", 33,
     "'anisotropy_turn' has no effect without 'roughness_v'"},
    {"material m { kd 1 abbe 30 }", 19, "'abbe' has no effect without a solid of 'kt'"},
    {"material m { kt 1 thin true abbe 30 }", 29, "'abbe' has no effect without a solid of 'kt'"},
    {"material m { kt 1 sellmeier_c 1 2 3 }", 19,
     "'sellmeier_c' has no effect without 'sellmeier_b'"},
    {"material m { ks 1 distribution beckmann }", 19,
     "'distribution' has no effect without 'coat_roughness', or 'ks' or 'kt' and 'roughness'"},
    {"material m { kd 0.5 fresnel dielectric }", 21,
     "'fresnel' has no effect without 'ks' or 'kt'"},
    {"material m { ior 1.2 }", 14,
     "'ior' has no effect without 'kt', 'base_color', or 'ks' and 'fresnel dielectric'"},
    {"material m { ks 0.5 fresnel schlick ior 1.3 }", 37, "'ior' has no effect without 'kt'"},
    {"material m { ks 0.5 relative_ior true }", 21,
     "'relative_ior' has no effect without 'kt', 'coat', a metal, or"},
    {"material m { absorption 1 }", 14, "'absorption' has no effect without 'kt', 'interface'"},
    {"material m { metal gold scattering 2 }", 25,
     "'scattering' has no effect without 'kt', 'interface', 'spec_trans', or 'ks' and"},
    {"material m { kd 0.5 priority 2 }", 21,
     "'priority' has no effect without 'kt', 'interface', 'spec_trans', or 'ks' and"},
    {"material m { ks 0.5 priority 2 }", 21,
     "'priority' has no effect without 'kt', 'interface', 'spec_trans', or"},
    {"material m { kt 1 thin true ior 1.5 }", 29,
     "'ior' has no effect without 'fresnel dielectric'"},
    {"material m { kd 1 bump_shadowing true }", 19,
     "'bump_shadowing' has no effect without 'bump_texture' or 'normal_texture'"},
    {"material m { kd 1 normal_flip true }", 19,
     "'normal_flip' has no effect without 'normal_texture'"},
    {"material m { bump_scale 1 }", 14, "'bump_scale' has no effect without 'bump_texture'"},
    {"camera { eye 0 0 0 look_at 0 0 1 width 2 }", 34,
     "'width' has no effect without 'projection orthographic'"},
    {"camera { eye 0 0 0 look_at 0 0 1 projection orthographic fov 2 }", 58,
     "'fov' has no effect without 'projection perspective'"},
    {"camera { eye 0 0 0 look_at 0 0 1 blades 5 }", 34,
     "'blades' has no effect without 'aperture'"},
    {"camera { eye 0 0 0 look_at 0 0 1 focal_distance 5 }", 34,
     "'focal_distance' has no effect without 'aperture'"},
    {"camera { projection environment eye 0 0 0 look_at 0 0 1 shift 1 0 }", 57,
     "'shift' has no effect without another 'projection'"},
    {"camera { eye 0 0 0 look_at 0 0 1 aperture 1 blade_rotation 5 }", 45,
     "'blade_rotation' has no effect without 'blades'"},
    {"texture t { pattern checker file \"none.png\" }", 29,
     "'file' has no effect without 'pattern image'"},
    {"texture t { pattern checker linear true }", 29,
     "'linear' has no effect without 'pattern image'"},
    {"texture t { pattern gradient b 1 filter nearest }", 34,
     "'filter' has no effect without 'pattern image'"},
    {"texture t { pattern gradient b 1 channel r }", 34,
     "'channel' has no effect without 'pattern image'"},
    {"texture t { pattern gradient b 1 power 2 }", 34,
     "'power' has no effect without 'pattern image'"},
    {"texture t { file \"scenes/textures/letter.png\" a 1 }", 47,
     "'a' has no effect without a 'pattern' of colours"},
    {"texture s { pattern constant a 1 } texture t { file \"scenes/textures/letter.png\" b_texture "
     "s }",
     82, "'b_texture' has no effect without a 'pattern' of two colours"},
    {"texture t { pattern constant a 1 b 1 }", 34,
     "'b' has no effect without a 'pattern' of two colours"},
    {"texture t { pattern constant a 1 rotate 3 }", 34,
     "'rotate' has no effect without a 'pattern' other than constant or attribute"},
    {"texture t { pattern constant a 1 wrap clamp }", 34,
     "'wrap' has no effect without 'pattern image' or 'pattern gradient'"},
    {"texture t { pattern multiply a 1 b 1 weight 0.2 }", 38,
     "'weight' has no effect without 'pattern mix'"},
    {"texture s { pattern constant a 1 } texture t { pattern checker a 0 a_texture s }", 64,
     "'a' of 0 leaves nothing of 'a_texture'"},
    {"texture t { pattern checker a 1 wrap clamp }", 33,
     "'wrap' has no effect without 'pattern image' or 'pattern gradient'"},
    {"texture t { pattern checker a 1 } material glass { kt 1 } sphere { centre 0 0 0 radius 1 "
     "material glass texture t }",
     105, "'texture' has no effect: material 'glass' has no 'kd'"},
    {"grid g { file \"scenes/media/puff.grid\" } medium { density g }", 51,
     "'density' has no effect without 'absorption' or 'scattering'"},
    {"grid g { file \"scenes/media/puff.grid\" } material m { kd 1 density g }", 60,
     "'density' has no effect without 'kt', 'interface', 'spec_trans', or 'ks' and"},
    {"grid g { file \"scenes/media/puff.grid\" } material m { interface true density g }", 70,
     "'density' has no effect without 'absorption' or 'scattering'"},
    {"grid g { file \"scenes/media/puff.grid\" } medium { absorption 1 albedo g }", 64,
     "'albedo' has no effect without 'scattering'"},
    {"grid g { file \"scenes/media/puff.grid\" } material m { kt 1 absorption 1 albedo g }", 73,
     "'albedo' has no effect without 'scattering'"},
    {"material m { emission 7 } sphere { centre 0 0 0 radius 1 material m radiance 2 }", 69,
     "'radiance' replaces the emission of material 'm', which has no effect here"},
    {"material m { emission 7 } sphere { radiance 0 centre 0 0 0 radius 1 material m }", 36,
     "'radiance' of 0 has no effect: it counts as left out"},
    {"material m { emission 7 } disc { centre 0 0 0 normal 0 1 0 radius 1 power 0 material m }", 69,
     "'power' of 0 has no effect"},
    {"light environment { radiance 1 rotate 1 0 0 9 }", 32,
     "'rotate' has no effect without 'file'"},
    {"light environment { radiance 1 rotation 9 }", 32, "'rotation' has no effect without 'file'"},
    {"light environment { radiance 0 file \"scenes/textures/letter.png\" }", 21,
     "'radiance' of 0: the light is left out"},
    {"light goniometric { position 0 1 0 target 0 0 0 intensity 0 file "
     "\"scenes/textures/letter.png\" }",
     49, "'intensity' of 0: the light is left out"},
    {"texture t { file \"scenes/textures/letter.png\" } material m { kd 0 kd_texture t }", 62,
     "'kd' of 0 leaves nothing of 'kd_texture'"},
    {"render { mode photon area hull kernel cone }", 32, "'kernel' has no effect with 'area' hull"},
    {"render { mode photon kernel box cone_k 2 }", 33,
     "'cone_k' has no effect without 'kernel' cone"},
    {"film { filter_radius 2 }", 8, "'filter_radius' has no effect with 'filter' box"},
    {"render { caustic_k 5 }", 10, "'caustic_k' has no effect without 'caustic_photons'"},
    {"render { passes 2 radius 1 k 5 }", 28, "'k' has no effect with 'passes' and 'radius'"},
    {"texture t { pattern multiply a 0.5 b 0.3 scale 2 2 }", 42,
     "'scale' has no effect without 'a_texture' or 'b_texture'"},
    {"texture t { pattern checker scale 4 4 }", 21, "this pattern is black all over"},
    {"texture t { pattern gradient }", 21, "this pattern is black all over"},
    {"texture t { pattern constant }", 21, "this pattern is black all over"},
    {"texture t { pattern mix }", 21, "this pattern is black all over"},
    {"material m { base_color 0.5 coat_ior 1.3 }", 29, "'coat_ior' has no effect without 'coat'"},
    {"repeat i from 1 to 3 { material m { ior 1.2 } }\nfilm { width 4 }", 37,
     "'ior' has no effect"},
};

/* What is given as it would be without it needs nothing beside it. */
static void a_default_is_not_warned_of(void **state)
{
    static collected c;
    (void)state;
    collect_text(&c, "film { filter_radius 0 }");
    assert_int_equal(c.status, RT_OK);
    assert_int_equal(c.count, 0);
    collected_free(&c);
}

/* Each is read, and changes nothing beside the others of its block. */
static void fields_without_effect_are_warned_of(void **state)
{
    static collected c;
    (void)state;
    for (size_t i = 0; i < sizeof fields_cases / sizeof *fields_cases; i++) {
        int found = 0;
        collect_text(&c, fields_cases[i].text);
        assert_int_equal(c.status, RT_OK);
        for (int j = 0; j < c.count; j++)
            found += c.items[j].severity == RT_SEVERITY_WARNING && c.items[j].line == 1 &&
                     c.items[j].column == fields_cases[i].column &&
                     strstr(c.items[j].message, fields_cases[i].message);
        if (found != 1)
            fail_msg("%d times at column %d: %s\nin %s", found, fields_cases[i].column,
                     fields_cases[i].message, fields_cases[i].text);
        collected_free(&c);
    }
}

static const char obj[] = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

/* Once, however often the mesh is placed. */
static void materials_of_a_mesh_file_are_warned_of(void **state)
{
    static const char *const texts[] = {
        "material m { kd 1 }\nmodel { file \"a.obj\"  material m }\n",
        "material m { kd 1 }\nmesh a { file \"a.obj\" }\ninstance a { material m }\n"
        "instance a { material m  translate 1 0 0 }\n"};
    static collected c;
    (void)state;
    scratch_write("a.obj", obj);
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        collect_text(&c, texts[i]);
        assert_int_equal(c.status, RT_OK);
        assert_int_equal(c.count, 1);
        assert_true(c.items[0].severity == RT_SEVERITY_WARNING && c.items[0].line == 2);
        assert_string_equal(c.items[0].message,
                            "the materials that this file names (mtllib, usemtl) are left out");
        collected_free(&c);
    }
    scratch_write("a.obj", strchr(obj, '\n') + 1);
    collect_text(&c, texts[0]);
    expect_clean(&c, texts[0]);
    collected_free(&c);
}

/* What else its file says, once; with flat shading a bad normal matters to nobody. */
static void what_a_mesh_file_says_in_vain_is_warned_of(void **state)
{
    static const char text[] = "material m { kd 1 }\nmodel { file \"a.obj\"  material m }\n"
                               "model { file \"a.obj\"  material m  shading flat }\n";
    static const char *const says[] = {
        "a.obj:6: this face of 4 corners crosses itself: parts of it may be covered twice or not "
        "at all",
        "a.obj: 2 normals are zero or not finite, and are made from the faces around"};
    static collected c;
    (void)state;
    scratch_write("a.obj", "v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\nvn nan 0 1\nf 1 2 3 4\n"
                           "f 1//1 3//1 2\n");
    collect_text(&c, text);
    assert_int_equal(c.status, RT_OK);
    assert_int_equal(c.count, 3);
    for (int i = 0; i < 3; i++) {
        assert_true(c.items[i].severity == RT_SEVERITY_WARNING);
        assert_int_equal(c.items[i].line, i < 2 ? 2 : 3);
        assert_string_equal(c.items[i].message, says[i % 2]);
    }
    collected_free(&c);
}

/* Shapes behind a mesh that is several are still found at their places. */
static void parts_of_a_mesh_are_at_one_place(void **state)
{
    static const char ply[] =
        "ply\nformat ascii 1.0\ncomment TextureFile a.ppm\ncomment TextureFile b.ppm\n"
        "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 2\nproperty list uchar int vertex_indices\nproperty int texnumber\n"
        "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 0\n3 2 1 0 1\n";
    static const char text[] = "material m { kd 1 }\nmaterial g { kt 1  fresnel dielectric }\n"
                               "mesh a { file \"a.ply\" }\ninstance a { material m }\n"
                               "model { file \"a.ply\"  material m }\n"
                               "disc { centre 0 0 0  normal 0 0 1  radius 1  material g }\n";
    static collected c;
    int line = 0;
    (void)state;
    scratch_write("a.ply", ply);
    scratch_write("a.ppm", "P3 1 1 255 255 0 0\n");
    scratch_write("b.ppm", "P3 1 1 255 0 0 255\n");
    check_text(&c, text);
    assert_int_equal(c.status, RT_OK);
    for (int i = 0; i < c.count; i++)
        line = c.items[i].finding == RT_FINDING_OPEN_GLASS ? c.items[i].line : line;
    assert_int_equal(line, 6);
    collected_free(&c);
}

/* The rest of a PLY that has more faces than its header says. */
static void a_mesh_file_that_goes_on_is_warned_of(void **state)
{
    static const char text[] = "material m { kd 1 }\nmodel { file \"a.ply\"  material m }\n";
    static const char head[] =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
        "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n\n";
    char more[sizeof head + 16];
    static collected c;
    (void)state;
    scratch_write("a.ply", head);
    collect_text(&c, text);
    expect_clean(&c, text);
    collected_free(&c);
    snprintf(more, sizeof more, "%s3 2 1 0\n", head);
    scratch_write("a.ply", more);
    collect_text(&c, text);
    assert_int_equal(c.count, 1);
    assert_true(c.items[0].severity == RT_SEVERITY_WARNING && c.items[0].line == 2);
    assert_non_null(strstr(c.items[0].message, "goes on after the elements"));
    collected_free(&c);
    /* An aperture that --set can change is no reason to warn. */
    static const char lens[] = "let a = 0\ncamera { eye 0 0 0 look_at 0 0 1 aperture (a) "
                               "focal_distance 2 }\nsphere { centre 0 0 3 radius 1 material m }\n";
    char whole[sizeof lens + 32];
    snprintf(whole, sizeof whole, "material m { kd 1 }\n%s", lens);
    collect_text(&c, whole);
    expect_clean(&c, whole);
    collected_free(&c);
}

/* Once for all of a repeat, with what is behind it. */
static void a_light_that_faces_away_is_told_at_its_place(void **state)
{
    static collected c;
    (void)state;
    check_text(&c, "material m { kd 0.5 }\nplane { point 0 0 0 normal 0 1 0 material m }\n"
                   "camera { eye 0 1 -4 look_at 0 1 0 }\nmaterial lamp { emission 1 }\n"
                   "repeat i from 1 to 3 {\n"
                   " disc { centre i 2 0 normal 0 1 0 radius 0.1 material lamp }\n}\n");
    assert_int_equal(c.count, 1);
    assert_true(c.items[0].finding == RT_FINDING_LIGHTS_NOTHING && c.items[0].line == 6 &&
                c.items[0].column == 2);
    assert_non_null(strstr(c.items[0].message, "along 0 1 0, where nothing is; 2 m behind it"));
    assert_string_equal(c.items[0].hint, "turn it round, or set `two_sided` of its material; the "
                                         "plane is at text:2");
    collected_free(&c);
}

/* With `check`, at the block that it is about; what no block is about, at the text as a whole. */
static void what_a_check_finds_stands_at_its_place(void **state)
{
    static collected c;
    (void)state;
    check_text(&c,
               "material m { kd 0.5 }\nsphere { centre 0 0 0 radius 1 material m }\n"
               "camera { eye 0 0 -4 look_at 0 0 -9 }\nlight point { position 9 9 9 intensity 1 }\n"
               "repeat i from 1 to 3 {\n light point { position 0 0 0.1 intensity 1 }\n}\n");
    assert_int_equal(c.status, RT_OK);
    assert_int_equal(c.count, 2);
    assert_int_equal(c.items[0].finding, RT_FINDING_NOTHING_IN_VIEW);
    assert_true(c.items[0].line == 3 && c.items[0].column == 1 &&
                c.items[0].severity == RT_SEVERITY_WARNING);
    assert_int_equal(c.items[1].finding, RT_FINDING_LIGHT_IN_OPAQUE);
    assert_true(c.items[1].line == 6 && c.items[1].column == 2);
    assert_string_equal(c.items[1].hint, "the sphere is at text:2");
    collected_free(&c);

    check_text(&c, "material m { kt 1 }\nsphere { centre 0 0 0 radius 1 material m }\n"
                   "camera { eye 0 0 0 look_at 0 0 9 }\n");
    assert_int_equal(c.count, 2);
    assert_true(c.items[0].finding == RT_FINDING_NO_LIGHT && c.items[0].line == 0);
    assert_true(c.items[1].finding == RT_FINDING_CAMERA_IN_MEDIUM && c.items[1].line == 3);
    assert_int_equal(c.items[1].severity, RT_SEVERITY_NOTE);
    collected_free(&c);

    check_text(&c,
               "material m { kt 1 }\nlight point { position 0 3 0 power 1 }\ncamera { eye 0 0 -4 "
               "look_at 0 0 0 }\n"
               "repeat i from 1 to 3 { disc { centre 0 0 0 normal 0 0 1 radius 1 material m } }\n");
    assert_int_equal(c.count, 1);
    assert_true(c.items[0].finding == RT_FINDING_OPEN_GLASS && c.items[0].line == 4 &&
                c.items[0].column == 24);
    assert_true(strstr(c.items[0].hint, "closed shape") != NULL);
    collected_free(&c);

    /* Not where the text has errors; and not unless asked for. */
    check_text(&c, "film { width 0 }\n");
    assert_int_equal(c.count, 1);
    collect_text(&c, "film { width 4 }\n");
    assert_int_equal(c.count, 0);
    collected_free(&c);
}

static void solids_are_found_at_their_places(void **state)
{
    static collected c;
    (void)state;
    check_text(&c,
               "material m { kt 1 }\nlight point { position 0 3 0 power 1 }\ncamera { eye 0 0 "
               "-9 look_at 0 0 0 }\n"
               "sphere { centre 0 0 0 radius 2 material m }\n"
               "repeat i from 1 to 3 { sphere { centre 0 0 0 radius (1 + i / 10) material m } }\n"
               "box { centre 0 0 0 size 1 1 1 material m }\n");
    assert_int_equal(c.count, 1);
    assert_true(c.items[0].finding == RT_FINDING_TOO_MANY_SOLIDS && c.items[0].line == 6);
    assert_non_null(
        strstr(c.items[0].message, "this box and 4 more transparent solids lie around"));
    assert_string_equal(c.items[0].hint, "the others are at text:4, text:5");
    collected_free(&c);

    check_text(&c,
               "material m { kt 1 priority 1 }\nmaterial n { kt 1 }\nlight point { position 0 3 0 "
               "power 1 }\ncamera { eye 0 0 -9 look_at 0 0 0 }\n"
               "sphere { centre 0 0 0 radius 2 material m }\n"
               "box { centre 0 0 0 size 1 1 1 material n }\n");
    assert_int_equal(c.count, 1);
    assert_true(c.items[0].finding == RT_FINDING_HIDDEN && c.items[0].line == 6);
    assert_string_equal(c.items[0].message,
                        "this box lies wholly in a sphere of higher priority: it has no effect");
    assert_string_equal(c.items[0].hint, "the other is at text:5; give the material of this one a "
                                         "priority as high");
    collected_free(&c);
}

static void portals_without_a_sky_are_told(void **state)
{
    static const char portal[] =
        BALL "camera { eye 0 0 9  look_at 0 0 0 }\nlight point { position 0 0 5  intensity 1 }\n"
             "portal { corner 0 0 3  edge1 1 0 0  edge2 0 1 0 }\n";
    static collected c;
    char text[sizeof portal + 64];
    (void)state;
    check_text(&c, portal);
    assert_int_equal(c.count, 1);
    assert_non_null(strstr(c.items[0].message, "portals have no effect"));
    collected_free(&c);
    snprintf(text, sizeof text, "%slight environment { radiance 1 }\n", portal);
    check_text(&c, text);
    assert_int_equal(c.count, 0);
    collected_free(&c);
}

static void a_grid_beside_its_solid_is_named(void **state)
{
    static collected c;
    (void)state;
    check_text(&c, "grid g2 { file \"scenes/media/puff.grid\"  lo 5 0 0  hi 6 1 1 }\n"
                   "material m { interface true  scattering 1  density g2 }\n"
                   "light point { position 0 3 0 power 1 }\ncamera { eye 0 0 -9 look_at 0 0 0 }\n"
                   "sphere { centre 0 0 0 radius 2 material m }\n");
    assert_int_equal(c.count, 1);
    assert_true(c.items[0].finding == RT_FINDING_GRID_APART && c.items[0].line == 5);
    assert_string_equal(c.items[0].message, "this sphere does not meet the box of the grid of its "
                                            "medium, which has no density in it");
    assert_string_equal(c.items[0].hint, "grid 'g2' is at text:1");
    collected_free(&c);
}

static void calls_can_ask_what_a_field_lacks(void **state)
{
    rt_material material = {.kd = {1, 1, 1}};
    rt_camera camera = {.kind = RT_CAMERA_ORTHOGRAPHIC};
    const rt_texture texture = {.kind = RT_TEXTURE_CHECKER};
    rt_medium medium = {.g = 0.5f};
    (void)state;
    assert_string_equal(rt_material_lacks(&material, "eta"), "'fresnel conductor'");
    assert_null(rt_material_lacks(&material, "roughness"));
    material.fresnel = RT_FRESNEL_CONDUCTOR;
    assert_null(rt_material_lacks(&material, "eta"));
    assert_null(rt_material_lacks(&material, "no such field"));
    assert_string_equal(rt_camera_lacks(&camera, "fov"), "'projection perspective'");
    camera.kind = RT_CAMERA_PERSPECTIVE;
    assert_null(rt_camera_lacks(&camera, "fov"));
    assert_string_equal(rt_texture_lacks(&texture, "file"), "'pattern image'");
    assert_null(rt_texture_lacks(&texture, "a"));
    assert_string_equal(rt_medium_lacks(&medium, "g"), "'scattering'");
    medium.scattering[1] = 1;
    assert_null(rt_medium_lacks(&medium, "g"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_nothing_uses_is_warned_of),
        cmocka_unit_test(a_repeat_without_iterations_is_warned_of),
        cmocka_unit_test(fields_without_effect_are_warned_of),
        cmocka_unit_test(a_default_is_not_warned_of),
        cmocka_unit_test_setup_teardown(materials_of_a_mesh_file_are_warned_of, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(what_a_mesh_file_says_in_vain_is_warned_of, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(parts_of_a_mesh_are_at_one_place, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(a_mesh_file_that_goes_on_is_warned_of, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test(what_a_check_finds_stands_at_its_place),
        cmocka_unit_test(a_light_that_faces_away_is_told_at_its_place),
        cmocka_unit_test(solids_are_found_at_their_places),
        cmocka_unit_test(portals_without_a_sky_are_told),
        cmocka_unit_test(a_grid_beside_its_solid_is_named),
        cmocka_unit_test(calls_can_ask_what_a_field_lacks),
    };
    return cmocka_run_group_tests_name("warnings", tests, NULL, NULL);
}
