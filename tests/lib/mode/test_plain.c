/*
 * test_plain.c - the programs of plain scenes: what they leave out is nothing that such a scene
 * has, so pictures have the bits that the programs of all scenes make of them.
 */
#include "support.h"

#include <math.h>
#include <stdio.h>

#include "film_renders.h"
#include "render/renderer.h"

/* A room with each lobe of plain materials, and a ball of another that no light reaches. */
static rt_renderer *room(const char *hidden)
{
    char text[1200];
    snprintf(text, sizeof text,
             "camera { eye 0 1 3.4  look_at 0 1 0  fov 50 }\n"
             "texture tiles { pattern checker  a 0.7 0.6 0.5  b 0.2 0.3 0.4  scale 4 4 }\n"
             "material white { kd 1  kd_texture tiles }\n"
             "material glass { kt 1 1 1  ior 1.5  fresnel dielectric }\n"
             "material frosted { kt 0.9  ior 1.3  fresnel dielectric  roughness 0.3 }\n"
             "material brushed { metal copper  roughness 0.2 }\n"
             "material gloss { kd 0.5 0.2 0.2  ks 0.3  roughness 0.1 }\n"
             "quad { corner -1 0 -1  edge1 2 0 0  edge2 0 0 2  material white }\n"
             "quad { corner -1 0 -1  edge1 2 0 0  edge2 0 2 0  material white }\n"
             "sphere { centre 0.2 0.5 0  radius 0.3  material glass }\n"
             "sphere { centre -0.6 0.3 0.2  radius 0.2  material frosted }\n"
             "sphere { centre 0.7 0.3 0.4  radius 0.2  material brushed }\n"
             "box { centre -0.05 0.1 0.55  size 0.3 0.2 0.3  material gloss }\n"
             "material hidden { kd 0.5 %s }\n"
             "sphere { centre -0.05 0.1 0.55  radius 0.02  material hidden }\n"
             "light point { position 0.1 1.8 0.3  intensity 3 2 1 }\n",
             hidden);
    return test_renderer(text);
}

/* Aimed starts are rounded as the compiler contracts them, which depends on what surrounds them. */
static void expect_close_films(const rt_film *a, const rt_film *b, const char *name)
{
    const size_t numbers = (size_t)3 * a->options.width * a->options.height;
    const float *const x = rt_film_rgb(a), *const y = rt_film_rgb(b);
    double differ = 0, all = 0;
    for (size_t i = 0; i < numbers; i++) {
        differ += pow((double)x[i] - y[i], 2);
        all += pow(x[i], 2);
    }
    if (!(differ <= 1e-6 * all))
        fail_msg("%s: films differ by %g", name, sqrt(differ / all));
}

static void plain_programs_make_the_bits_of_all(void **state)
{
    rt_renderer *const plain = room(""), *const any = room("ks 0.3  exponent 9");
    (void)state;
    assert_true(plain->is_plain);
    assert_false(any->is_plain);
    for (size_t i = 0; i < FILM_RENDERS; i++) {
        const rt_render_options o = film_render_options(film_renders + i);
        rt_film *a = NULL, *b = NULL;
        rt_error error;
        expect_ok(rt_render(&a, plain, &o, &error), &error);
        expect_ok(rt_render(&b, any, &o, &error), &error);
        if (o.caustic_photons > 0)
            expect_close_films(a, b, film_renders[i].name);
        else
            expect_same_film(a, b, film_renders[i].name);
        rt_film_destroy(a);
        rt_film_destroy(b);
    }
    rt_renderer_destroy(plain);
    rt_renderer_destroy(any);
}

/* By the material of a shape; a material that no shape has counts for nothing. */
static void materials_of_shapes_decide(void **state)
{
    static const struct {
        const char *material, *name;
        int is_plain;
    } cases[] = {
        {"material m { kd 0.5 }\nmaterial other { kd 0.5  coat 1 }\n", "m", 1},
        {"material m { ks 0.5  roughness 0.2 }\n", "m", 1},
        {"material m { kd 0.5  coat 1 }\n", "m", 0},
        {"material m { ks 0.5  coat 1 }\n", "m", 0},
        {"material m { kd 0.5  roughness 0.3 }\n", "m", 0},
        {"material m { kd 0.5  fuzz 0.2 }\n", "m", 0},
        {"material m { kd 0.5  diffuse_transmission 0.3 }\n", "m", 0},
        {"material m { ks 0.5  exponent 40 }\n", "m", 0},
        {"material m { ks 0.5  roughness 0.2  distribution beckmann }\n", "m", 0},
        {"material m { ks 0.5  roughness 0.2  roughness_v 0.4 }\n", "m", 0},
        {"material m { base_color 0.5 }\n", "m", 0},
        {"material a { kd 0.5 }\nmaterial m { blend a with black }\n", "m", 0},
        {"material m { kd 0.5  opacity 0.5 }\n", "m", 0},
        {"material m { glass bk7  dispersion true }\n", "m", 0},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[400];
        snprintf(text, sizeof text, "%ssphere { centre 0 0 0  radius 1  material %s }\n",
                 cases[i].material, cases[i].name);
        rt_renderer *renderer = test_renderer(text);
        if (!renderer->is_plain != !cases[i].is_plain)
            fail_msg("%s is %s", cases[i].material, renderer->is_plain ? "plain" : "not plain");
        rt_renderer_destroy(renderer);
    }
}

int main(void)
{
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(plain_programs_make_the_bits_of_all),
        cmocka_unit_test(materials_of_shapes_decide),
    };
    return cmocka_run_group_tests_name("lib/mode/plain", tests, NULL, NULL);
}
