/* What a good text puts into the scene, and how files are found. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "scene/scene.h"
#include "tests/dsl/collect.h"

static void assert_vector(const float found[3], float x, float y, float z)
{
    assert_float_equal(found[0], x, 1e-6);
    assert_float_equal(found[1], y, 1e-6);
    assert_float_equal(found[2], z, 1e-6);
}

/* The settings of the text below. */
static void expect_options(const rt_scene *scene)
{
    rt_render_options o;
    rt_scene_get_options(scene, &o);
    assert_true(o.width == 640 && o.height == 480 && o.mode == RT_MODE_PHOTON && o.spp == 7 &&
                o.max_depth == 9);
    assert_true(o.roulette_depth == 5 && o.roulette_threshold == 1e-6f);
    assert_true(o.seed == 4294967295u && o.sampler == RT_SAMPLER_INDEPENDENT && o.time == 2.5);
    assert_true(o.photons == 4000000000u && o.k == 60 && o.radius == 0.25f && o.cone_k == 1.5f);
    assert_true(o.kernel == RT_DENSITY_GAUSSIAN_JENSEN && o.direct == RT_DIRECT_PHOTONS &&
                o.final_gather == 2);
    assert_true(o.caustic_photons == 3000000000u && o.caustic_k == 40 &&
                o.caustic_radius == 0.125f);
    assert_true(o.caustic_kernel == RT_DENSITY_CONE);
}

/* Its shapes. */
static void expect_shapes(const rt_scene *scene)
{
    const rt_scene_shape *s = scene->shapes;
    assert_int_equal(scene->shape_count, 4);
    assert_true(s[0].kind == RT_SHAPE_PLANE && s[0].material == 1);
    assert_true(s[1].kind == RT_SHAPE_SPHERE && s[1].material == 1 && s[1].p[3] == 0.5f);
    assert_vector(s[1].p, 1, 2, 3);
    assert_vector(scene->emissions[s[1].emission].radiance, 4, 5, 6);
    const rt_scene_mesh *triangle = &scene->meshes[s[2].mesh];
    assert_true(s[2].kind == RT_SHAPE_TRIANGLES && triangle->triangle_count == 1 &&
                triangle->normals);
    assert_vector(triangle->positions + 3, 1, 0, 0);
    assert_vector(triangle->normals + 6, 1, 0, 1);
    assert_true(s[3].kind == RT_SHAPE_QUAD);
    assert_vector(rt_scene_parameters(scene, s + 3) + 3, 2, 0, 0);
    assert_vector(rt_scene_parameters(scene, s + 3) + 6, 0, 0, 2);
    assert_vector(scene->emissions[s[3].emission].power, 8, 8, 8);
}

static void every_field_reaches_the_scene(void **state)
{
    static const char text[] =
        "camera { eye 0 1 -4  look_at 0 1 0  up 0 1 1  fov 40  aperture 0.02  focal_distance 3 }\n"
        "film { width 640  height 480 }\n"
        "render { mode photon spp 7 max_depth 9 seed 4294967295 sampler independent time 2.5 "
        "photons 4000000000\n"
        "  roulette_depth 5 roulette_threshold 1e-6 k 60 radius 0.25 kernel gaussian_jensen cone_k "
        "1.5 direct photons "
        "final_gather 2\n"
        "  caustic_photons 3000000000 caustic_k 40 caustic_radius 0.125 caustic_kernel cone }\n"
        "material glass { kd 0.1  ks 0.1 0.2 0.3  kt 0.6  emission 1 2 3  ior 1.33  fresnel "
        "dielectric  two_sided "
        "true\n"
        "  priority 3 }\n"
        "material plain { kd 0.7 }\n"
        "plane { point 0 0 0  normal 0 2 0  material plain }\n"
        "sphere { centre 1 2 3  radius 0.5  material plain  radiance 4 5 6 }\n"
        "triangle { a 0 0 0  b 1 0 0  c 0 1 0  na 0 0 1  nb 0 1 1  nc 1 0 1  material glass }\n"
        "quad { corner 1 1 1  edge1 2 0 0  edge2 0 0 2  material plain  power 8 }\n"
        "light point { position 1 2 3  intensity 4 }\n";
    static collected c;
    (void)state;
    collect_text(&c, text);
    expect_clean(&c, text);

    const rt_camera *camera = &c.scene->camera;
    assert_vector(camera->eye, 0, 1, -4);
    assert_vector(camera->look_at, 0, 1, 0);
    assert_vector(camera->up, 0, 1, 1);
    assert_float_equal(camera->fov, 40, 0);
    assert_float_equal(camera->aperture, 0.02f, 0);
    assert_float_equal(camera->focal_distance, 3, 0);

    expect_options(c.scene);

    const rt_material *m = &c.scene->materials[0];
    assert_vector(m->kd, 0.1f, 0.1f, 0.1f);
    assert_vector(m->ks, 0.1f, 0.2f, 0.3f);
    assert_vector(m->kt, 0.6f, 0.6f, 0.6f);
    assert_vector(m->emission, 1, 2, 3);
    assert_true(m->ior == 1.33f && m->fresnel == 1 && m->two_sided == 1 && m->priority == 3);

    expect_shapes(c.scene);
    assert_vector(c.scene->lights[0].emission, 4, 4, 4);
    collected_free(&c);
}

/* Each choice of the language is the enumerator of that name. */
static void choices_match_their_enums(void **state)
{
    static const struct {
        const char *word;
        int value;
    } kernels[] = {{"epanechnikov", RT_DENSITY_EPANECHNIKOV},
                   {"box", RT_DENSITY_BOX},
                   {"cone", RT_DENSITY_CONE},
                   {"gaussian", RT_DENSITY_GAUSSIAN},
                   {"silverman", RT_DENSITY_SILVERMAN},
                   {"gaussian_jensen", RT_DENSITY_GAUSSIAN_JENSEN},
                   {"gaussian-jensen", RT_DENSITY_GAUSSIAN_JENSEN}};
    static collected c;
    (void)state;
    for (size_t i = 0; i < sizeof kernels / sizeof *kernels; i++) {
        char text[128];
        snprintf(text, sizeof text, "render { kernel %s mode path sampler sobol direct nee }",
                 kernels[i].word);
        collect_text(&c, text);
        expect_clean(&c, text);
        assert_int_equal(c.scene->options.kernel, kernels[i].value);
        assert_int_equal(c.scene->options.mode, RT_MODE_PATH);
        assert_int_equal(c.scene->options.sampler, RT_SAMPLER_SOBOL);
        assert_int_equal(c.scene->options.direct, RT_DIRECT_NEE);
        collected_free(&c);
    }
}

/* The value of an expression, seen as the position of a light. */
static void expect_position(const char *expression, float x, float y, float z)
{
    static collected c;
    char text[512];
    snprintf(text, sizeof text,
             "let a = 3\nlet v = [1 2 3]\nlet e = %s\nlet used = (a + v + e)\n"
             "light point { position e  power used }",
             expression);
    collect_text(&c, text);
    expect_clean(&c, text);
    assert_vector(c.scene->lights[0].position, x, y, z);
    collected_free(&c);
}

static void arithmetic_follows_its_rules(void **state)
{
    (void)state;
    expect_position("[1 2 3]", 1, 2, 3);
    expect_position("v", 1, 2, 3);
    expect_position("2 * v + 1", 3, 5, 7);
    expect_position("v * [4 5 6]", 4, 10, 18);
    expect_position("[6 6 6] / v", 6, 3, 2);
    expect_position("v - [0 0 1] - [0 0 1]", 1, 2, 1);
    expect_position("[1 1 1] * (1 + 2 * 3)", 7, 7, 7);
    expect_position("[1 1 1] * (12 / 3 / 2)", 2, 2, 2);
    expect_position("[1 1 1] * (7 - 2 - 1)", 4, 4, 4);
    expect_position("[1 1 1] * ((1 + 2) * 3)", 9, 9, 9);
    expect_position("[(a - 1) -a a]", 2, -3, 3);
    expect_position("[-1 -(a + 1) (--a)]", -1, -4, 3);
    expect_position("-v", -1, -2, -3);
    expect_position("v\n* 2 # over\n # lines\n + 1", 3, 5, 7);
    expect_position("[.5 5. 1e2]", 0.5f, 5, 100);
    expect_position("[1E+2 1e-2 0.1e1]", 100, 0.01f, 1);
}

static void functions_have_their_values(void **state)
{
    (void)state;
    expect_position("[sin(30) cos(60) tan(45)]", 0.5f, 0.5f, 1);
    expect_position("[sin(180) cos(90) sin(-90)]", 0, 0, -1);
    expect_position("[asin(1) acos(-1) atan(1)]", 90, 180, 45);
    expect_position("[atan2(1, -1) sqrt(9) pow(2, 10)]", 135, 3, 1024);
    expect_position("[abs(-2) min(1, 2) max(1, 2)]", 2, 1, 2);
    expect_position("[floor(-1.5) ceil(-1.5) round(2.5)]", -2, -1, 3);
    expect_position("[mod(7, 3) mod(-1, 3) sign(-4)]", 1, 2, -1);
    expect_position("[exp(0) log(exp(2)) (pi / pi)]", 1, 2, 1);
    expect_position("sqrt(v * v)", 1, 2, 3);
    expect_position("max(v, 2)", 2, 2, 3);
    expect_position("[(random(a) - random(3)) 0 (min(random(a), 1) - random(a))]", 0, 0, 0);
    expect_position("2 * sin(a * 10) * v", 1, 2, 3);
}

/* The map of a placed mesh, applied to a point. */
static void expect_mapped(const rt_scene *scene, size_t shape, double x, double y, double z,
                          float u, float v, float w)
{
    double p[3] = {x, y, z}, q[3];
    rt_affine map = rt_scene_to_world(scene, scene->shapes + shape);
    rt_affine_point(q, &map, p);
    const float found[3] = {(float)q[0], (float)q[1], (float)q[2]};
    assert_vector(found, u, v, w);
}

static void transforms_apply_in_the_order_written(void **state)
{
    static const char text[] =
        "let up = [0 1 0]\n"
        "material m { }\n"
        "triangle { a 0 0 0 b 1 0 0 c 0 1 0 material m  rotate 0 0 1 90  translate 5 0 0 }\n"
        "triangle { a 0 0 0 b 1 0 0 c 0 1 0 material m  translate 5 0 0  rotate 0 0 1 90 }\n"
        "triangle { a 0 0 0 b 1 0 0 c 0 1 0 material m  scale 1 2 3  scale 2  rotate up (-90) }\n"
        "triangle { a 0 0 0 b 1 0 0 c 0 1 0 material m  matrix 1 2 0 4  0 1 0 5  0 0 -1 6 }\n";
    static collected c;
    (void)state;
    collect_text(&c, text);
    expect_clean(&c, text);
    expect_mapped(c.scene, 0, 1, 0, 0, 5, 1, 0);
    expect_mapped(c.scene, 1, 1, 0, 0, 0, 6, 0);
    expect_mapped(c.scene, 2, 1, 1, 1, -6, 4, 2);
    expect_mapped(c.scene, 3, 1, 1, 1, 7, 6, 5);
    collected_free(&c);
}

static void repeats_count_and_scope_their_names(void **state)
{
    static const char text[] =
        "let n = 3\n"
        "repeat i from 1 to n {\n"
        "    let x = 10 * i\n"
        "    material paint { kd (i / 10) }\n"
        "    repeat j from i to (i + 1.5) { sphere { centre x j 0 radius 1 material paint } }\n"
        "}\n"
        "repeat i from 1 to 1 { repeat j from 2 to i { this is not even read } }\n"
        "let x = 7\n"
        "material paint { }\n"
        "sphere { centre x 0 0 radius 1 material paint }\n";
    static collected c;
    (void)state;
    collect_text(&c, text);
    expect_clean(&c, text);
    assert_int_equal(c.scene->material_count, 4);
    assert_int_equal(c.scene->shape_count, 7);
    for (int i = 0; i < 6; i++) {
        const rt_scene_shape *s = &c.scene->shapes[i];
        assert_vector(s->p, 10.0f * (float)(i / 2 + 1), (float)(i / 2 + 1 + i % 2), 0);
        assert_float_equal(c.scene->materials[s->material].kd[0], (float)(i / 2 + 1) / 10, 1e-6);
    }
    assert_vector(c.scene->shapes[6].p, 7, 0, 0);
    collected_free(&c);
}

static const char placed_text[] =
    "camera { projection orthographic eye 0 0 1 look_at 0 0 0 width 3 aperture 0.1 blades 6 "
    "blade_rotation 30 shift 0.5 -2 mirror true hide_emitters true }\n"
    "film { filter mitchell filter_radius 1.5 }\n"
    "render { mode direct aov true estimator bsdf variance true target_error 0.02 }\n"
    "texture letter { file \"scenes/textures/letter.png\" wrap mirror scale 4 2 offset 0.5 -1 "
    "linear true filter nearest }\n"
    "texture squares { pattern checker a 1 b 0 0.5 0 }\n"
    "material gold { kd 0.1 ks 0.9 fresnel conductor eta 0.2 k 3 2 1 roughness 0.1 bump_texture "
    "letter bump_scale 0.1 }\n"
    "material water { kt 1 fresnel dielectric absorption 0.1 0.2 0.3 kt_texture squares }\n"
    "material fog { interface true scattering 2 0 1 g -0.5 }\n"
    "medium { absorption 0.5 scattering 1 g 0.25 }\n"
    "mesh knot { file \"scenes/meshes/knot.ply\" }\n"
    "repeat i from 1 to 3 { instance knot { material gold texture squares translate i 0 0 } }\n"
    "model { file \"scenes/meshes/knot.ply\" shading flat material water }\n"
    "cylinder { a 0 0 0 b 0 1 0 radius 1 material fog }\n"
    "cone { base 0 0 0 apex 0 1 0 radius 1 caps false material gold }\n"
    "triangle { a 0 0 0 b 1 0 0 c 0 1 0 uva 0 1 uvb 0 0 uvc 1 0 material gold }\n"
    "light spot { position 1 2 3 target 1 0 3 intensity 5 outer 60 inner 60 falloff linear }\n"
    "light spot { position 1 2 3 target 1 0 3 intensity 5 file \"scenes/textures/letter.png\" up "
    "1 0 0 filter nearest }\n"
    "light projector { position 1 2 3 target 1 0 3 intensity 1 2 3 fov 20 file "
    "\"scenes/textures/letter.png\" }\n"
    "light projector { position 1 2 3 target 1 0 3 irradiance 4 file "
    "\"scenes/textures/letter.png\" filter nearest up 0 0 1 }\n"
    "light goniometric { position 1 2 3 target 1 0 3 file \"scenes/luminaires/wallwasher.ies\" }\n"
    "light goniometric { position 1 2 3 target 1 0 3 file \"scenes/textures/letter.png\" up 0 0 1 "
    "intensity 2 1 1 }\n"
    "light beam { position 1 2 3 target 1 0 3 width 2 height 3 up 0 0 1 irradiance 4 3 2 }\n"
    "light beam { position 1 2 3 target 1 0 3 width 2 power 5 cross_section rectangular }\n"
    "light directional { direction 0 0 -2 irradiance 3 }\n"
    "light environment { file \"scenes/textures/letter.png\" rotation 90 }\n";

/* Without ks and kt a metal reflects and a glass refracts all that Fresnel's equations leave. */
static void metals_and_glasses_have_names(void **state)
{
    static collected c;
    (void)state;
    collect_text(&c, "camera { eye 4 4 -30  look_at 4 4 0 }\nlight environment { radiance 1 }\n"
                     "material ring { metal aluminum  roughness 0.1 }\n"
                     "material window { glass bk7  priority 1 }\n"
                     "material pane { glass fused-silica  ks 0.5 }\n"
                     "sphere { centre 9 0 0  radius 1  material ring }\n"
                     "sphere { centre 9 9 0  radius 1  material window }\n"
                     "sphere { centre 0 9 0  radius 1  material pane }\n");
    expect_clean(&c, "metals and glasses by name");
    const rt_material *m = c.scene->materials + c.scene->material_count - 3;
    assert_true(m[0].fresnel == RT_FRESNEL_CONDUCTOR && m[0].ks[2] == 1);
    assert_true(m[0].eta[0] == 1.503f && m[0].k[2] == 5.351f);
    assert_true(m[1].fresnel == RT_FRESNEL_DIELECTRIC && m[1].ior == 1.5168f);
    assert_true(m[1].kt[2] == 1 && m[1].ks[0] == 0);
    assert_true(m[2].kt[0] == 0 && m[2].ks[1] == 0.5f && m[2].ior == 1.45846f);
    collected_free(&c);
}

/* Whatever texture or image it multiplies; the library takes a zero for a field left out. */
static void zero_is_zero(void **state)
{
    static collected c;
    (void)state;
    collect_text(&c, "let off = 0\ntexture t { file \"scenes/textures/letter.png\" }\n"
                     "texture u { pattern checker  a off  a_texture t  b 1  b_texture t }\n"
                     "material m { kd off  kd_texture t  emission 0 0 0  emission_texture t }\n"
                     "material n { ks 1  roughness off  roughness_texture t }\n"
                     "light point { position 0 1 0  intensity 1 }\n"
                     "light environment { radiance off  file \"scenes/textures/letter.png\" }\n");
    assert_int_equal(c.status, RT_OK);
    const rt_material *const m = c.scene->materials + c.scene->material_count - 2;
    assert_int_equal(m[0].kd_texture, 0);
    assert_int_equal(m[0].emission_texture, 0);
    assert_int_equal(m[1].roughness_texture, 0);
    assert_int_equal(c.scene->textures[1].parts[0], 0);
    assert_int_equal(c.scene->textures[1].parts[1], 1);
    assert_int_equal(c.scene->light_count, 1);
    collected_free(&c);
}

/* By the matrix: scaled and sheared, turned counter-clockwise, moved; right angles exactly. */
static void textures_are_rotated_and_sheared(void **state)
{
    static collected c;
    (void)state;
    collect_text(&c, "texture a { pattern checker a 0.3 scale 2 3 rotate 90 offset 5 6 }\n"
                     "texture b { pattern checker a 0.3 scale 2 3 shear 0.5 rotate 30 }\n"
                     "texture c { pattern checker a 0.3 rotate -450 }\n"
                     "material m { kd_texture a ks_texture b kt_texture c }\n"
                     "sphere { centre 0 0 0 radius 1 material m }\n");
    expect_clean(&c, "maps");
    const rt_texture_data *a = &c.scene->textures[0].data, *b = a, *third = a;
    b = &c.scene->textures[1].data;
    third = &c.scene->textures[2].data;
    assert_true(a->scale[0] == 0 && a->scale[1] == 0 && a->shear[0] == -3 && a->shear[1] == 2);
    assert_true(a->offset[0] == 5 && a->offset[1] == 6 && a->turn[0] == 0 && a->turn[1] == 1);
    const double cosine = sqrt(0.75), sine = 0.5;
    assert_float_equal(b->scale[0], 2 * cosine, 1e-6);
    assert_float_equal(b->scale[1], 0.5 * sine + 3 * cosine, 1e-6);
    assert_float_equal(b->shear[0], 0.5 * cosine - 3 * sine, 1e-6);
    assert_float_equal(b->shear[1], 2 * sine, 1e-6);
    assert_true(third->shear[0] == 1 && third->shear[1] == -1 && third->turn[1] == -1);
    collected_free(&c);
}

/* A mesh is read once; its instances share it, and what is not named otherwise is the default. */
static void expect_lights(const rt_scene *s)
{
    assert_true(s->light_count == 10 && s->environment.light == 9 && s->environment.width == 128);
    assert_vector(s->lights[0].direction, 0, -1, 0);
    assert_float_equal(s->lights[0].outer, 0.5f, 1e-6);
    assert_true(s->lights[0].inner > s->lights[0].outer);
    assert_vector(s->lights[1].across, 0, 0, 1);
    assert_true(s->lights[1].table == 1 && s->light_tables[0].flags & RT_TABLE_CELLS);
    assert_vector(s->lights[2].emission, 1, 2, 3);
    assert_vector(s->lights[3].emission, 4, 4, 4);
    assert_true(s->light_tables[2].flags & RT_TABLE_IRRADIANCE);
    assert_vector(s->lights[4].emission, 1 / 179.0f, 1 / 179.0f, 1 / 179.0f);
    assert_vector(s->lights[5].across, 0, 0, 1);
    assert_vector(s->lights[6].across, -1, 0, 0);
    assert_vector(s->lights[6].emission, 4, 3, 2);
    assert_true(s->lights[6].is_round && s->lights[6].half[0] == 1 && s->lights[6].half[1] == 1.5f);
    assert_true(!s->lights[7].is_round && s->lights[7].half[1] == 1);
    assert_vector(s->lights[7].emission, 1.25f, 1.25f, 1.25f);
    assert_vector(s->lights[8].direction, 0, 0, -1);
    assert_vector(s->lights[9].emission, 1, 1, 1);
    assert_float_equal(s->environment.turn, 0.25f, 1e-6);
}

static void meshes_textures_and_lights_reach_the_scene(void **state)
{
    static collected c;
    (void)state;
    collect_text(&c, placed_text);
    expect_clean(&c, placed_text);
    const rt_scene *s = c.scene;
    assert_true(s->camera.kind == RT_CAMERA_ORTHOGRAPHIC && s->camera.width == 3 &&
                s->camera.blades == 6);
    assert_true(s->options.filter == RT_FILTER_MITCHELL && s->options.filter_radius == 1.5f &&
                s->options.mode == RT_MODE_DIRECT && s->options.aov);
    assert_true(s->options.estimator == RT_ESTIMATOR_BSDF);
    assert_true(s->options.variance && s->options.target_error == 0.02);
    const rt_texture_data *letter = &s->textures[0].data;
    assert_true(letter->kind == RT_TEXTURE_IMAGE && letter->width == 128 &&
                letter->wrap == RT_WRAP_MIRROR && letter->filter == RT_TEXTURE_FILTER_NEAREST);
    assert_true(letter->scale[0] == 4 && letter->scale[1] == 2 && letter->offset[1] == -1);
    assert_true(s->textures[1].data.kind == RT_TEXTURE_CHECKER && s->textures[1].data.b[1] == 0.5f);
    assert_true(s->materials[0].fresnel == RT_FRESNEL_CONDUCTOR && s->materials[0].eta[2] == 0.2f);
    assert_true(s->materials[0].bump_texture == 1 && s->materials[1].kt_texture == 2);
    assert_true(s->materials[1].absorption[2] == 0.3f &&
                s->materials[1].fresnel == RT_FRESNEL_DIELECTRIC);
    assert_true(s->materials[2].interface && s->materials[2].kt[1] == 1 &&
                s->materials[2].ior == 1 && s->materials[2].scattering[0] == 2 &&
                s->materials[2].g == -0.5f);
    assert_true(s->medium.absorption[2] == 0.5f && s->medium.scattering[0] == 1 &&
                s->medium.g == 0.25f);

    assert_true(s->shape_count == 7 && s->mesh_count == 3 && s->meshes[0].placed == 3);
    assert_true(s->meshes[0].normals && s->meshes[0].uv && s->meshes[0].triangle_count == 2400);
    assert_true(!s->meshes[1].normals && s->shapes[2].texture == 2 && s->shapes[3].texture == 0);
    assert_true(s->shapes[4].caps && !s->shapes[5].caps && s->meshes[2].uv[1] == 1 &&
                s->meshes[2].uv[4] == 1);

    expect_lights(s);
    collected_free(&c);
}

static void spaces_lines_and_marks_do_not_matter(void **state)
{
    static const char *const texts[] = {
        "film{width 4 height 5}",
        "film\n{\nwidth\n4\nheight 5 }",
        "film {\r\n\twidth 4\r\n\theight 5\r\n}\r\n",
        "\xef\xbb\xbf"
        "film { height 5 width 4 }",
        "# \xc3\xa9t\xc3\xa9\nfilm { width 4 # } \n height 5 }",
        "let width = 4\nfilm { width (width) height 5 }",
    };
    static collected c;
    (void)state;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        collect_text(&c, texts[i]);
        expect_clean(&c, texts[i]);
        assert_int_equal(c.scene->options.width, 4);
        assert_int_equal(c.scene->options.height, 5);
        collected_free(&c);
    }
}

/* ---- Files --------------------------------------------------------------- */

typedef struct scratch {
    char directory[64];
} scratch;

static void write_file(const scratch *s, const char *name, const char *text, size_t size,
                       char path[256])
{
    snprintf(path, 256, "%s/%s", s->directory, name);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(text, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

static int make_scratch(void **state)
{
    static scratch s;
    strcpy(s.directory, "/tmp/librt-dsl-XXXXXX");
    *state = &s;
    return mkdtemp(s.directory) == NULL;
}

static int remove_scratch(void **state)
{
    static const char *const names[] = {"a.rts", "b.rts", "sub/c.rts", "sub"};
    const scratch *s = *state;
    char path[256];
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        snprintf(path, sizeof path, "%s/%s", s->directory, names[i]);
        remove(path);
    }
    return rmdir(s->directory);
}

static void includes_are_relative_to_the_file_that_names_them(void **state)
{
    static const char a[] = "include \"sub/c.rts\"\nfilm { width w  height h }\n";
    static const char b[] = "let h = 5\n";
    static const char c_text[] = "include \"../b.rts\"\nlet w = 4\nmaterial spare { }\n";
    const scratch *s = *state;
    static collected c;
    char path[256], sub[128];
    snprintf(sub, sizeof sub, "%s/sub", s->directory);
    assert_int_equal(mkdir(sub, 0700), 0);
    write_file(s, "b.rts", b, strlen(b), path);
    write_file(s, "sub/c.rts", c_text, strlen(c_text), path);
    write_file(s, "a.rts", a, strlen(a), path);
    collect_file(&c, path);
    expect_clean(&c, a);
    assert_int_equal(c.scene->options.width, 4);
    assert_int_equal(c.scene->options.height, 5);
    collected_free(&c);
}

static void errors_name_the_included_file_and_keep_the_order(void **state)
{
    static const char a[] = "foo\ninclude \"b.rts\"\nbar\n";
    static const char b[] = "\nfilm { width 0 }\n";
    const scratch *s = *state;
    static collected c;
    char path[256], included[256];
    write_file(s, "b.rts", b, strlen(b), included);
    write_file(s, "a.rts", a, strlen(a), path);
    collect_file(&c, path);
    assert_int_equal(c.count, 3);
    assert_string_equal(c.items[0].file, path);
    assert_string_equal(c.items[1].file, included);
    assert_int_equal(c.items[1].line, 2);
    assert_string_equal(c.items[1].source_line, "film { width 0 }");
    assert_string_equal(c.items[2].file, path);
    assert_int_equal(c.items[2].line, 3);
}

static void cycles_and_explosions_of_includes_are_refused(void **state)
{
    static const char self[] = "include \"a.rts\"\n";
    static const char twice[] = "include \"b.rts\"\ninclude \"b.rts\"\n";
    const scratch *s = *state;
    static collected c;
    char path[256];
    write_file(s, "a.rts", self, strlen(self), path);
    collect_file(&c, path);
    assert_int_equal(c.count, 1);
    assert_non_null(strstr(c.items[0].message, "it would include itself"));

    write_file(s, "b.rts", self, strlen(self), path);
    write_file(s, "a.rts", twice, strlen(twice), path);
    collect_file(&c, path);
    assert_int_equal(c.count, 2);
    assert_int_equal(c.items[0].line, 1);
    assert_non_null(strstr(c.items[0].file, "/b.rts"));
    assert_non_null(strstr(c.items[0].message, "it would include itself"));
    assert_non_null(strstr(c.items[0].hint, "/a.rts includes "));
    assert_non_null(strstr(c.items[0].hint, "/b.rts, which includes it"));
}

static void what_is_no_text_is_one_error(void **state)
{
    static const char binary[] = "film { width 4 }\n\x89PNG\0\1\2\xff\xfe{{{";
    const scratch *s = *state;
    static collected c;
    char path[256];
    write_file(s, "a.rts", binary, sizeof binary, path);
    collect_file(&c, path);
    assert_int_equal(c.count, 1);
    assert_int_equal(c.items[0].line, 2);
    assert_int_equal(c.items[0].column, 5);
    assert_string_equal(c.items[0].message, "the file is not text: it holds a NUL byte here");
}

static void a_file_that_cannot_be_read_is_an_error_without_place(void **state)
{
    static const struct {
        const char *path, *message;
    } cases[] = {{"/no/such/scene.rts", "cannot read the scene: No such file or directory"},
                 {"/tmp", "cannot read the scene: it is a directory"}};
    static collected c;
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        collect_file(&c, cases[i].path);
        assert_int_equal(c.status, RT_ERROR_INPUT);
        assert_string_equal(c.error.file, cases[i].path);
        assert_string_equal(c.error.message, cases[i].message);
        assert_int_equal(c.error.line, 0);
        assert_int_equal(c.count, 1);
        assert_int_equal(c.items[0].line, 0);
        assert_string_equal(c.items[0].source_line, "");
    }
}

/* Not even a file without end is read further. */
static void reading_ends_at_what_is_no_text(void **state)
{
    static collected c;
    (void)state;
    collect_file(&c, "/dev/zero");
    assert_int_equal(c.status, RT_ERROR_INPUT);
    assert_int_equal(c.count, 1);
    assert_int_equal(c.items[0].line, 1);
    assert_string_equal(c.error.message, "the file is not text: it holds a NUL byte here");
}

/* What a progress callback was told, and when it asks to stop. */
typedef struct watcher {
    double last, stop_from;
    int calls, is_wrong;
} watcher;

static int watch(void *user, const rt_progress *progress)
{
    watcher *w = user;
    w->is_wrong |= progress->stage != RT_STAGE_LOAD || progress->fraction < w->last ||
                   progress->fraction > 1 || (w->calls == 0 && progress->fraction != 0);
    w->last = progress->fraction;
    w->calls++;
    return progress->fraction >= w->stop_from;
}

static rt_status read_watched(watcher *w, const char *text, rt_error *error)
{
    const rt_hooks hooks = {.progress = watch, .user = w};
    const rt_load_options options = {.hooks = &hooks};
    rt_scene *scene = NULL;
    rt_status status = rt_scene_parse(&scene, text, NULL, &options, error);
    assert_true((status == RT_OK) == (scene != NULL));
    rt_scene_destroy(scene);
    return status;
}

static void progress_goes_from_0_to_1_and_may_cancel(void **state)
{
    static const char few[] = "material m { }\nrepeat i from 1 to 3 {\nlet x = i\n}\n",
                      many[] = "repeat i from 1 to 10000000 {\nlet x = i\n}\n";
    static const struct {
        const char *text;
        double stop_from;
        rt_status status;
    } cases[] = {{few, 2, RT_OK},
                 {few, 0, RT_CANCELLED},
                 {few, 1, RT_CANCELLED},
                 {many, 1e-9, RT_CANCELLED}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        watcher w = {0, cases[i].stop_from, 0, 0};
        rt_error error;
        assert_int_equal(read_watched(&w, cases[i].text, &error), cases[i].status);
        assert_false(w.is_wrong);
        assert_true(w.calls == (cases[i].stop_from == 0 ? 1 : 2));
        if (cases[i].status == RT_OK)
            assert_true(w.last == 1);
        else
            assert_string_equal(error.message, "cancelled");
        if (cases[i].text == many)
            assert_true(w.last < 0.9);
    }
}

static void all_stands_for_a_number_of_photons(void **state)
{
    static collected c;
    rt_render_options o;
    const char *text =
        "let all = 7\nrender { k all\n caustic_k (all) caustic_photons 9 spp (all) radius 1 "
        "photon_layers true }";
    (void)state;
    collect_text(&c, text);
    expect_clean(&c, text);
    rt_scene_get_options(c.scene, &o);
    assert_true(o.k == RT_K_ALL && o.caustic_k == 7 && o.spp == 7 && o.photon_layers == 1 &&
                o.aov == 0);
    collected_free(&c);
    collect_text(&c, "render { spp all }");
    assert_int_equal(c.errors, 1);
    collect_text(&c, "render { k all 3 }");
    assert_int_equal(c.errors, 1);
}

static void without_callback_or_error_it_still_works(void **state)
{
    rt_scene *scene = NULL;
    (void)state;
    assert_int_equal(rt_scene_parse(&scene, "film { width 0 }", "text", NULL, NULL),
                     RT_ERROR_INPUT);
    assert_null(scene);
    assert_int_equal(rt_scene_parse(&scene, "film { width 1 }", "text", NULL, NULL), RT_OK);
    rt_scene_destroy(scene);
}

/* The radius of the sphere of a text whose constants are set, or -1 with the message in *error. */
static float radius_with(const char *text, const rt_definition *definitions, size_t count,
                         rt_error *error)
{
    rt_scene *scene = NULL;
    const rt_load_options options = {.definitions = definitions, .definition_count = count};
    if (rt_scene_parse(&scene, text, NULL, &options, error) != RT_OK)
        return -1;
    const float radius = scene->shapes[0].p[3];
    rt_scene_destroy(scene);
    return radius;
}

static void a_definition_stands_for_the_value_of_a_let(void **state)
{
    static const char text[] = "let base = 1\n"
                               "let size = 2 * base\n"
                               "material m { kd 0.5 }\n"
                               "sphere { centre 0 0 0  radius size  material m }\n";
    static const rt_definition number = {"size", "0.25"}, sum = {"base", "(1 + 2) * pi"};
    const rt_definition both[] = {number, sum};
    rt_error error;
    (void)state;
    assert_float_equal(radius_with(text, NULL, 0, &error), 2, 0);
    assert_float_equal(radius_with(text, &number, 1, &error), 0.25, 0);
    assert_float_equal(radius_with(text, &sum, 1, &error), 18.849556f, 1e-5);
    assert_float_equal(radius_with(text, both, 2, &error), 0.25, 0);
}

static void a_definition_holds_in_every_turn_of_a_repeat(void **state)
{
    static const char text[] = "material m { kd 0.5 }\n"
                               "repeat i from 0 to 2 {\n"
                               "    let size = 2 + i\n"
                               "    sphere { centre i 0 0  radius size  material m }\n"
                               "}\n";
    static const rt_definition set = {"size", "0.25"};
    rt_scene *scene = NULL;
    rt_error error;
    const rt_load_options options = {.definitions = &set, .definition_count = 1};
    (void)state;
    assert_int_equal(rt_scene_parse(&scene, text, NULL, &options, &error), RT_OK);
    assert_int_equal(scene->shape_count, 3);
    for (int i = 0; i < 3; i++)
        assert_float_equal(scene->shapes[i].p[3], 0.25, 0);
    rt_scene_destroy(scene);
}

static void a_wrong_definition_says_what_is_wrong(void **state)
{
    static const char text[] = "let size = 1\n"
                               "material m { kd 0.5 }\n"
                               "sphere { centre 0 0 0  radius size  material m }\n";
    static const char twice[] = "let size = 1\n"
                                "let size = 2\n"
                                "material m { kd 0.5 }\n"
                                "sphere { centre 0 0 0  radius size  material m }\n";
    static const struct {
        rt_definition set;
        const char *message;
    } wrong[] = {
        {{"sise", "1"}, "the scene has no constant 'sise'"},
        {{"m", "1"}, "the scene has no constant 'm'"},
        {{"size", "1 2"}, "unexpected"},
        {{"size", "abc"}, "abc"},
        {{"size", "1 / 0"}, "zero"},
        {{"size", "1\nsphere { }"}, "more than one line"},
        {{"size", ""}, "expected"},
        {{"", "1"}, "expected a name"},
        {{"a b", "1"}, "expected '='"},
        {{"pi", "3"}, "'pi' is already defined"},
        {{"size", "\xff"}, "UTF-8"},
    };
    rt_error error;
    (void)state;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        assert_float_equal(radius_with(text, &wrong[i].set, 1, &error), -1, 0);
        if (!strstr(error.message, wrong[i].message))
            fail_msg("%s = %s: %s", wrong[i].set.name, wrong[i].set.value, error.message);
        assert_string_equal(error.file, "definition");
    }
    const rt_load_options named = {
        .definitions = &wrong[0].set, .definition_count = 1, .definition_name = "--set"};
    rt_scene *scene = NULL;
    assert_int_equal(rt_scene_parse(&scene, text, NULL, &named, &error), RT_ERROR_INPUT);
    assert_string_equal(error.file, "--set");
    const rt_definition again[] = {{"size", "1"}, {"size", "2"}}, once = {"size", "3"};
    assert_float_equal(radius_with(text, again, 2, &error), -1, 0);
    assert_non_null(strstr(error.message, "defined twice"));
    assert_float_equal(radius_with(twice, &once, 1, &error), -1, 0);
    assert_non_null(strstr(error.message, "defined twice"));
    assert_int_equal(error.line, 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_field_reaches_the_scene),
        cmocka_unit_test(choices_match_their_enums),
        cmocka_unit_test(arithmetic_follows_its_rules),
        cmocka_unit_test(functions_have_their_values),
        cmocka_unit_test(transforms_apply_in_the_order_written),
        cmocka_unit_test(repeats_count_and_scope_their_names),
        cmocka_unit_test(textures_are_rotated_and_sheared),
        cmocka_unit_test(meshes_textures_and_lights_reach_the_scene),
        cmocka_unit_test(metals_and_glasses_have_names),
        cmocka_unit_test(zero_is_zero),
        cmocka_unit_test(spaces_lines_and_marks_do_not_matter),
        cmocka_unit_test_setup_teardown(includes_are_relative_to_the_file_that_names_them,
                                        make_scratch, remove_scratch),
        cmocka_unit_test_setup_teardown(errors_name_the_included_file_and_keep_the_order,
                                        make_scratch, remove_scratch),
        cmocka_unit_test_setup_teardown(cycles_and_explosions_of_includes_are_refused, make_scratch,
                                        remove_scratch),
        cmocka_unit_test_setup_teardown(what_is_no_text_is_one_error, make_scratch, remove_scratch),
        cmocka_unit_test(a_file_that_cannot_be_read_is_an_error_without_place),
        cmocka_unit_test(progress_goes_from_0_to_1_and_may_cancel),
        cmocka_unit_test(reading_ends_at_what_is_no_text),
        cmocka_unit_test(all_stands_for_a_number_of_photons),
        cmocka_unit_test(without_callback_or_error_it_still_works),
        cmocka_unit_test(a_definition_stands_for_the_value_of_a_let),
        cmocka_unit_test(a_definition_holds_in_every_turn_of_a_repeat),
        cmocka_unit_test(a_wrong_definition_says_what_is_wrong),
    };
    return cmocka_run_group_tests_name("load", tests, NULL, NULL);
}
