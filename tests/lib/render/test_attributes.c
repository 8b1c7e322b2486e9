/*
 * test_attributes.c - every input of a material by a second set of texture coordinates, which a
 * mesh has as an attribute: the picture is that of the mesh whose first set it is.
 */
#include "support.h"

#include <math.h>
#include <string.h>

enum { side = 12 };

static rt_error error;

/* A bent sheet, so that nothing is the same all over. */
static const float positions[4][3] = {{-1, -1, 0}, {1, -1, 0.3f}, {1, 1, 0}, {-1, 1, 0.4f}};
static const uint32_t indices[2][3] = {{0, 1, 2}, {0, 2, 3}};
static const float wanted[4][2] = {{0.9f, 0.1f}, {0.8f, 0.95f}, {0.05f, 0.9f}, {0.1f, 0.2f}},
                   other[4][2] = {{0, 0}, {1, 0.1f}, {0.9f, 1}, {0.2f, 0.8f}};

/* What a ramp along v is used for. */
typedef enum input {
    KD,
    ROUGHNESS,
    COAT,
    METALLIC,
    CLEARCOAT,
    EMISSION,
    OPACITY,
    WEIGHT,
    BUMPS,
    NORMALS,
    OF_THE_SHAPE,
    INPUTS
} input;

static uint32_t add_material(rt_scene *scene, const rt_material *material)
{
    uint32_t index;
    expect_ok(rt_scene_add_material(scene, &index, NULL, material, &error), &error);
    return index;
}

/* The material that has the ramp there; the surface may have it as well. */
static void use(rt_scene *scene, rt_surface *surface, input in, uint32_t ramp)
{
    rt_material m = {.kd = {0.5f, 0.5f, 0.5f}};
    const uint32_t black = add_material(scene, &m);
    if (in == KD)
        m.kd_texture = ramp;
    if (in == ROUGHNESS)
        m = (rt_material){.ks = {0.8f, 0.8f, 0.8f}, .roughness = 0.9f, .roughness_texture = ramp};
    if (in == COAT)
        m.coat_texture = ramp;
    if (in == METALLIC || in == CLEARCOAT)
        m = (rt_material){.base_color = {0.8f, 0.4f, 0.2f}, .roughness = 0.6f};
    if (in == METALLIC)
        m.metallic_texture = ramp;
    if (in == CLEARCOAT)
        m.clearcoat_texture = ramp;
    if (in == EMISSION)
        m.emission_texture = ramp;
    if (in == OPACITY)
        m.opacity_texture = ramp;
    if (in == BUMPS)
        m.bump_texture = ramp;
    if (in == NORMALS)
        m.normal_texture = ramp;
    if (in == WEIGHT)
        m = (rt_material){.blend = black + 1, .with = RT_MATERIAL_BLACK, .weight_texture = ramp};
    if (in == OF_THE_SHAPE)
        surface->texture = ramp;
    surface->material = add_material(scene, &m);
}

/* A picture of the sheet, whose first set is this; `attribute` names that which is the ramp's. */
static rt_film *picture(input in, const float (*uv)[2], const char *attribute, int is_placed_twice)
{
    const rt_mesh_attribute set = {.name = "set", .values = wanted[0], .width = 2};
    const rt_mesh_data mesh = {.positions = positions[0],
                               .uv = uv[0],
                               .indices = indices[0],
                               .vertex_count = 4,
                               .triangle_count = 2,
                               .attributes = &set,
                               .attribute_count = 1};
    const rt_texture ramp = {.kind = RT_TEXTURE_GRADIENT,
                             .a = {0.2f, in == NORMALS ? 0.5f : 0.1f, in == NORMALS ? 1 : 0.3f},
                             .b = {0.8f, in == NORMALS ? 0.5f : 0.9f, in == NORMALS ? 1 : 0.6f},
                             .attribute = attribute};
    const rt_texture heights = {
        .kind = RT_TEXTURE_GRADIENT, .b = {1, 1, 1}, .attribute = attribute};
    const rt_camera camera = {.kind = RT_CAMERA_ORTHOGRAPHIC, .width = 2, .eye = {0, 0, 5}};
    const rt_environment sky = {.radiance = {0.4f, 0.4f, 0.4f}};
    const rt_directional_light sun = {.direction = {1, 0.5f, -1}, .irradiance = {2, 2, 2}};
    const rt_render_options options = {
        .width = side, .height = side, .spp = 64, .filter = RT_FILTER_BOX, .seed = 1};
    rt_surface surface;
    rt_scene *scene = NULL;
    rt_renderer *renderer = NULL;
    rt_film *film = NULL;
    uint32_t handle, texture;
    memset(&surface, 0, sizeof surface);
    expect_ok(rt_scene_create(&scene, &error), &error);
    expect_ok(rt_scene_add_texture(scene, &texture, in == BUMPS ? &heights : &ramp, &error),
              &error);
    use(scene, &surface, in, texture);
    expect_ok(rt_scene_add_mesh(scene, &handle, &mesh, &error), &error);
    expect_ok(rt_scene_add_instance(scene, NULL, handle, &surface, &error), &error);
    if (is_placed_twice) {
        surface.transform = (rt_transform){{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, -50}}};
        expect_ok(rt_scene_add_instance(scene, NULL, handle, &surface, &error), &error);
    }
    expect_ok(rt_scene_set_camera(scene, &camera, &error), &error);
    expect_ok(rt_scene_set_environment(scene, &sky, &error), &error);
    expect_ok(rt_scene_add_directional_light(scene, &sun, &error), &error);
    expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
    expect_ok(rt_render(&film, renderer, &options, &error), &error);
    rt_renderer_destroy(renderer);
    rt_scene_destroy(scene);
    return film;
}

/* The largest difference of two pictures. */
static double difference(const rt_film *a, const rt_film *b)
{
    double most = 0;
    for (int i = 0; i < 3 * side * side; i++)
        most = fmax(most, fabs((double)rt_film_rgb(a)[i] - rt_film_rgb(b)[i]));
    return most;
}

static void expect_same(input in, int is_placed_twice)
{
    rt_film *first = picture(in, wanted, NULL, is_placed_twice),
            *second = picture(in, other, "set", is_placed_twice),
            *wrong = picture(in, other, NULL, is_placed_twice);
    if (!(difference(first, second) < 1e-3 && difference(first, wrong) > 0.005))
        fail_msg("input %d, %d: %g, other coordinates %g", (int)in, is_placed_twice,
                 difference(first, second), difference(first, wrong));
    rt_film_destroy(first);
    rt_film_destroy(second);
    rt_film_destroy(wrong);
}

static void every_input_may_have_its_own_coordinates(void **state)
{
    (void)state;
    for (int in = 0; in < INPUTS; in++)
        expect_same((input)in, 0);
}

static void instances_have_theirs(void **state)
{
    (void)state;
    expect_same(KD, 1);
    expect_same(OPACITY, 1);
    expect_same(BUMPS, 1);
    expect_same(NORMALS, 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_input_may_have_its_own_coordinates),
        cmocka_unit_test(instances_have_theirs),
    };
    return cmocka_run_group_tests_name("render/attributes", tests, NULL, NULL);
}
