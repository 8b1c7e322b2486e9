/* test_pack.c - the tables of a packed scene: instances share data, and indices are right. */
#include "support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/scene/scenes.h"
#include "pack/pack.h"

static const float origin[3], y_axis[3] = {0, 1, 0};

/* Flags of a mesh that has all that vertices can have. */
static const rt_u32 vertex_data =
    RT_SHAPE_SMOOTH | RT_SHAPE_UV | RT_SHAPE_COLOUR | RT_SHAPE_VARIED | RT_SHAPE_LOCATED;

static rt_scene_image pack_for(const rt_scene *scene, uint32_t width)
{
    rt_scene_image image = {0};
    rt_stage_progress progress;
    rt_error error;
    expect_ok(rt_stage_begin(&progress, NULL, RT_STAGE_BUILD), &error);
    expect_ok(rt_scene_pack(&image, scene, RT_ACCEL_BVH, width, 2, &progress, &error), &error);
    return image;
}

static rt_scene_image pack(const rt_scene *scene)
{
    return pack_for(scene, 8);
}

static const rt_scene_header *header(const rt_scene_image *image)
{
    return image->data;
}

static const void *table(const rt_scene_image *image, rt_u32 offset)
{
    assert_true((size_t)offset * RT_SCENE_ROW <= image->bytes);
    return (const char *)image->data + (size_t)offset * RT_SCENE_ROW;
}

/*
 * A sheet of 2 n^2 triangles over the unit square, with normals, texture coordinates and colours.
 */
static uint32_t add_sheet(rt_scene *scene, int n)
{
    size_t side = (size_t)n + 1, vertices = side * side, triangles = 2 * (size_t)n * (size_t)n;
    float *data = malloc(vertices * 11 * sizeof *data);
    uint32_t *indices = malloc(triangles * 3 * sizeof *indices), *index = indices, mesh;
    rt_mesh_data sheet = {.positions = data,
                          .normals = data + 3 * vertices,
                          .uv = data + 6 * vertices,
                          .colours = data + 8 * vertices,
                          .indices = indices,
                          .vertex_count = vertices,
                          .triangle_count = triangles};
    rt_error error;
    for (size_t i = 0; i < vertices; i++) {
        float u = (float)(i % side) / (float)n, v = (float)(i / side) / (float)n;
        memcpy(data + 3 * i, (float[3]){u, 0.1f * sinf(9 * u), v}, 3 * sizeof(float));
        memcpy(data + 3 * vertices + 3 * i, (float[3]){0, 2, 0}, 3 * sizeof(float));
        memcpy(data + 6 * vertices + 2 * i, (float[2]){u, v}, 2 * sizeof(float));
        memcpy(data + 8 * vertices + 3 * i, (float[3]){u, v, 0.5f}, 3 * sizeof(float));
    }
    for (uint32_t i = 0; i < (uint32_t)(n * n); i++) {
        uint32_t a = i / (uint32_t)n * (uint32_t)side + i % (uint32_t)n, b = a + (uint32_t)side;
        memcpy(index, (uint32_t[6]){a, b, a + 1, a + 1, b, b + 1}, 6 * sizeof *index);
        index += 6;
    }
    expect_ok(rt_scene_add_mesh(scene, &mesh, &sheet, &error), &error);
    free(data);
    free(indices);
    return mesh;
}

static void place_at(rt_scene *scene, uint32_t mesh, float x, float stretch, float radiance)
{
    rt_surface surface = {.transform = {{{1, 0, 0, x}, {0, stretch, 0, 0}, {0, 0, 1, 0}}}};
    rt_error error;
    surface.radiance[0] = radiance;
    expect_ok(rt_scene_add_instance(scene, NULL, mesh, &surface, &error), &error);
}

static void a_thousand_instances_take_the_memory_of_one(void **state)
{
    size_t bytes[2];
    (void)state;
    for (int i = 0; i < 2; i++) {
        rt_scene *scene = new_scene();
        uint32_t mesh = add_sheet(scene, 150);
        for (int k = 0; k < (i ? 1000 : 1); k++)
            place_at(scene, mesh, (float)k, 1, 0);
        rt_scene_image image = pack(scene);
        bytes[i] = image.bytes;
        rt_scene_image_free(&image);
        rt_scene_destroy(scene);
    }
    assert_true((double)bytes[1] < 1.2 * (double)bytes[0]);
}

/*
 * Counts the triangles below a node and checks that all references stay within the tree's own
 * blocks.
 */
static size_t count_triangles(const rt_bvh_node *nodes, const rt_tri_block *blocks, rt_u32 child,
                              rt_u32 first, rt_u32 count)
{
    size_t sum = 0;
    if (child == RT_NONE)
        return 0;
    if (child & RT_CHILD_LEAF) {
        rt_u32 block = child & RT_CHILD_INDEX;
        assert_true(!(child & RT_CHILD_ANALYTIC) && block >= first && block < first + count);
        for (int i = 0; i < RT_BVH_WIDTH; i++)
            sum += blocks[block].prim[i] != RT_NONE;
        return sum;
    }
    for (int i = 0; i < RT_BVH_WIDTH; i++)
        sum += count_triangles(nodes, blocks, nodes[child].child[i], first, count);
    return sum;
}

static void instances_have_trees_of_their_own(void **state)
{
    rt_scene *scene = new_scene();
    rt_error error;
    rt_surface surface = {0};
    uint32_t small = add_sheet(scene, 3), large = add_sheet(scene, 20);
    (void)state;
    place_at(scene, small, 0, 2, 0);
    place_at(scene, large, 5, 1, 0);
    place_at(scene, small, 1, 1, 0);
    place_at(scene, large, 7, 1, 0);
    expect_ok(rt_scene_add_torus(scene, NULL, origin, y_axis, 1, 0.3f, &surface, &error), &error);
    rt_scene_image image = pack(scene);
    const rt_scene_header *h = header(&image);
    const rt_shape *shapes = table(&image, h->shapes);
    const rt_bvh_node *nodes = table(&image, h->nodes);
    const rt_tri_block *blocks = table(&image, h->blocks);
    const rt_transform_data *transforms = table(&image, h->transforms);
    const rt_u32 *prim_shape = table(&image, h->prim_shape);

    assert_true(h->analytic_count == 5 && h->block_count == 0 && h->prim_count == 5 &&
                h->transform_count == 5);
    for (rt_u32 i = 0; i < 4; i++) {
        size_t triangles = i % 2 ? 800 : 18;
        assert_int_equal(shapes[i].kind, RT_SHAPE_INSTANCE);
        assert_int_equal(shapes[i].flags, vertex_data | RT_SHAPE_SIMPLE);
        assert_int_equal(prim_shape[shapes[i].first_prim], i);
        assert_int_equal(count_triangles(nodes, blocks, shapes[i].root, shapes[i].first_block,
                                         shapes[i].block_count),
                         triangles);
    }
    assert_true(shapes[0].root == shapes[2].root && shapes[1].root == shapes[3].root &&
                shapes[0].root != shapes[1].root);
    assert_true(shapes[0].first_normal == shapes[2].first_normal &&
                shapes[0].first_uv == shapes[2].first_uv);
    assert_float_equal(transforms[shapes[0].transform].to_world[1][1], 2, 0);
    assert_float_equal(transforms[shapes[0].transform].to_object[1][1], 0.5, 0);
    assert_float_equal(transforms[shapes[3].transform].to_object[0][3], -7, 0);
    assert_int_equal(shapes[4].kind, RT_SHAPE_TORUS);
    rt_scene_image_free(&image);
    rt_scene_destroy(scene);
}

/* A mesh placed once, or one that emits, lies in the tree of all shapes, in world space. */
static void single_and_emissive_meshes_are_baked(void **state)
{
    rt_scene *scene = new_scene();
    uint32_t mesh = add_sheet(scene, 2);
    (void)state;
    place_at(scene, mesh, 3, -1, 0);
    place_at(scene, mesh, 6, 1, 2);
    rt_scene_image image = pack(scene);
    const rt_scene_header *h = header(&image);
    const rt_shape *shapes = table(&image, h->shapes);
    const rt_light_data *lights = table(&image, h->lights);
    const float(*normals)[4] = (const float(*)[4])table(&image, h->normals);
    const float(*uvs)[2] = (const float(*)[2])table(&image, h->uvs);
    const rt_u32 *indices = table(&image, h->indices);

    assert_true(h->prim_count == 16 && h->light_count == 8 && h->transform_count == 0 &&
                h->analytic_count == 0);
    assert_int_equal(shapes[0].kind, RT_SHAPE_TRIANGLES);
    assert_int_equal(shapes[0].flags, vertex_data | RT_SHAPE_MIRRORED | RT_SHAPE_SIMPLE);
    assert_int_equal(shapes[1].flags, vertex_data);
    assert_true(shapes[0].first_light == RT_NONE && shapes[1].first_light == 0 &&
                lights[0].prim == 8);
    assert_true(h->bounds_lo[0] == 3 && h->bounds_hi[0] == 7);

    /* Coordinates and corners are shared, normals follow the placement. */
    assert_true(shapes[0].first_index == shapes[1].first_index &&
                shapes[0].first_uv == shapes[1].first_uv);
    assert_float_equal(normals[shapes[0].first_normal + 4][1], -1, 1e-6);
    assert_float_equal(normals[shapes[1].first_normal + 4][1], 1, 1e-6);
    assert_true(indices[shapes[0].first_index + 1] == 3 && uvs[shapes[0].first_uv + 4][0] == 0.5f);
    assert_true(lights[0].a[0] >= 6 && lights[0].normal[1] > 0.5f);
    rt_scene_image_free(&image);
    rt_scene_destroy(scene);
}

static void materials_and_textures_reach_their_tables(void **state)
{
    rt_scene *scene = new_scene();
    rt_error error;
    rt_texture checker = {
        .kind = RT_TEXTURE_CHECKER, .a = {1, 1, 1}, .b = {0, 0.5f, 0}, .scale = {4, 0}};
    rt_material m = {.ks = {1, 1, 1},
                     .fresnel = RT_FRESNEL_CONDUCTOR,
                     .eta = {0.2f, 0.4f, 1.4f},
                     .k = {3, 2, 1},
                     .roughness = 0.3f,
                     .absorption = {1, 2, 3},
                     .two_sided = 1};
    rt_surface surface = {.material = 1, .texture = 1},
               emitter = {.radiance = {2, 2, 2}, .texture = 1};
    (void)state;
    expect_ok(rt_scene_add_texture(scene, &m.ks_texture, &checker, &error), &error);
    m.bump_texture = m.ks_texture;
    expect_ok(rt_scene_add_material(scene, NULL, NULL, &m, &error), &error);
    expect_ok(rt_scene_add_sphere(scene, NULL, origin, 1, &surface, &error), &error);
    expect_ok(rt_scene_add_sphere(scene, NULL, origin, 1, &emitter, &error), &error);
    rt_scene_image image = pack(scene);
    const rt_scene_header *h = header(&image);
    const rt_material_data *materials = table(&image, h->materials);
    const rt_texture_data *textures = table(&image, h->textures);
    const rt_shape *shapes = table(&image, h->shapes);
    const rt_light_data *lights = table(&image, h->lights);

    assert_true(materials[0].kd_texture == RT_NONE && materials[0].flags == 0 &&
                materials[0].bump_scale == 1);
    assert_true(materials[1].flags == (RT_MATERIAL_CONDUCTOR | RT_MATERIAL_TWO_SIDED));
    assert_true(materials[1].ks_texture == 0 && materials[1].bump_texture == 0 &&
                materials[1].kt_texture == RT_NONE);
    assert_true(materials[1].eta[2] == 1.4f && materials[1].k[0] == 3 &&
                materials[1].absorption[1] == 2);
    assert_true(materials[1].roughness == 0.3f);
    assert_true(h->texture_count == 1 && textures[0].kind == RT_TEXTURE_CHECKER &&
                textures[0].scale[0] == 4);
    assert_true(textures[0].scale[1] == 1 && textures[0].b[1] == 0.5f);
    /*
     * The texture of a shape multiplies its kd, or its light if it brings one; the light's power
     * counts its mean.
     */
    assert_true(shapes[0].texture == 0 && shapes[1].texture == RT_NONE && lights[0].texture == 0);
    assert_float_equal(lights[0].power, 3.14159265 * 4 * 3.14159265 * 2 * (0.5 + 0.75 + 0.5) / 3,
                       1e-3);
    rt_scene_image_free(&image);
    rt_scene_destroy(scene);
}

/* Their rows stand behind all textures, counted from each; lights count their mean. */
static void nested_textures_find_their_rows(void **state)
{
    rt_scene *scene = new_scene();
    rt_error error;
    rt_texture grey = {.kind = RT_TEXTURE_CONSTANT, .a = {0.5f, 0.5f, 0.5f}},
               twice = {.kind = RT_TEXTURE_MULTIPLY, .b = {0.5f, 1, 2}},
               mixed = {.kind = RT_TEXTURE_MIX, .a = {1, 1, 1}, .weight = 0.25f};
    rt_surface emitter = {.radiance = {2, 2, 2}};
    (void)state;
    expect_ok(rt_scene_add_texture(scene, &twice.a_texture, &grey, &error), &error);
    expect_ok(rt_scene_add_texture(scene, &mixed.b_texture, &twice, &error), &error);
    expect_ok(rt_scene_add_texture(scene, &emitter.texture, &mixed, &error), &error);
    expect_ok(rt_scene_add_texture(scene, NULL, &grey, &error), &error);
    expect_ok(rt_scene_add_sphere(scene, NULL, origin, 1, &emitter, &error), &error);
    rt_scene_image image = pack(scene);
    const rt_scene_header *h = header(&image);
    const rt_texture_data *textures = table(&image, h->textures);
    const rt_light_data *lights = table(&image, h->lights);

    /* Grey and its scale; 1, those two, the weight, and the mixture. */
    assert_int_equal(h->texture_count, 4 + 2 + 5);
    assert_true(textures[1].kind == RT_TEXTURE_NESTED && textures[1].texels == 4 - 1 &&
                textures[1].rows == 2);
    assert_true(textures[2].kind == RT_TEXTURE_NESTED && textures[2].texels == 6 - 2 &&
                textures[2].rows == 5);
    assert_true(textures[4].kind == RT_TEXTURE_CONSTANT && textures[5].kind == RT_TEXTURE_SCALE &&
                textures[10].kind == RT_TEXTURE_MIX);
    assert_true(lights[0].texture == 2);
    /* Of 3/4 and 1/4 of 0.25, 0.5 and 1. */
    assert_float_equal(lights[0].power, 3.14159265 * 4 * 3.14159265 * 2 * (0.8125 + 0.875 + 1) / 3,
                       1e-3);
    rt_scene_image_free(&image);
    rt_scene_destroy(scene);
}

/* What eight paths may shade together, see kernels/integrate/batch.h. */
static void lambert_and_flat_shapes_are_marked_and_lights_by_area(void **state)
{
    static const float x[3] = {1, 0, 0}, y[3] = {0, 1, 0}, skew[3] = {1, 1, 0};
    static const rt_transform mirroring = {{{-1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
    static const rt_material glass = {.kt = {1, 1, 1}, .ior = 1.5f};
    static const rt_texture checker = {.kind = RT_TEXTURE_CHECKER, .a = {1, 1, 1}};
    rt_surface quads[6] = {{0},
                           {.transform = mirroring},
                           {0},
                           {.material = 1},
                           {.radiance = {1, 1, 1}},
                           {.radiance = {1, 1, 1}}};
    const rt_u32 lambert = RT_SHAPE_SIMPLE, flat = RT_SHAPE_FLAT;
    const rt_u32 expected[6] = {lambert | flat, lambert, lambert, flat, flat, flat};
    rt_scene *scene = new_scene();
    rt_error error;
    (void)state;
    expect_ok(rt_scene_add_material(scene, NULL, NULL, &glass, &error), &error);
    expect_ok(rt_scene_add_texture(scene, &quads[2].texture, &checker, &error), &error);
    for (int i = 0; i < 6; i++)
        expect_ok(rt_scene_add_quad(scene, NULL, origin, x, i == 5 ? skew : y, &quads[i], &error),
                  &error);
    rt_scene_image image = pack(scene);
    const rt_shape *shapes = table(&image, header(&image)->shapes);
    const rt_light_data *lights = table(&image, header(&image)->lights);
    for (int i = 0; i < 6; i++)
        assert_int_equal(shapes[i].flags & (lambert | flat), expected[i]);
    /* The quad of glass is open: whether it holds a part of lights at the same place is unknown. */
    assert_int_equal(lights[0].flags,
                     RT_LIGHT_RECTANGLE | RT_LIGHT_PLAIN | RT_LIGHT_PARTLY_ENCLOSED);
    assert_int_equal(lights[1].flags, RT_LIGHT_PLAIN | RT_LIGHT_PARTLY_ENCLOSED);
    rt_scene_image_free(&image);
    rt_scene_destroy(scene);
}

/* Those that lanes shade beside what is diffuse alone: kernels/bsdf/lobe_lanes.h. */
static void surfaces_of_mixed_lobes_are_marked(void **state)
{
    static const rt_material
        mixed[] = {{.ks = {1, 1, 1}, .roughness = 0.2f},
                   {.ks = {0.5f, 0, 0}, .kd = {0.5f, 0, 0}},
                   {.kd = {1, 1, 1}, .coat = 1, .coat_ior = 1.5f},
                   {.ks = {1, 1, 1},
                    .roughness = 0.2f,
                    .fresnel = RT_FRESNEL_CONDUCTOR,
                    .eta = {0.2f, 0.9f, 1.1f},
                    .k = {3.9f, 2.4f, 2.1f}}},
        others[] = {
            {.kd = {1, 1, 1}},
            {.ks = {1, 1, 1}},
            {.kd = {1, 1, 1}, .roughness = 0.2f},
            {.ks = {1, 1, 1}, .roughness = 0.2f, .roughness_v = 0.1f},
            {.ks = {1, 1, 1}, .exponent = 9},
            {.ks = {1, 1, 1}, .roughness = 0.2f, .distribution = RT_DISTRIBUTION_BECKMANN},
            {.ks = {1, 1, 1}, .roughness = 0.2f, .emission = {1, 1, 1}},
            {.kt = {1, 1, 1}, .roughness = 0.2f, .ior = 1.5f, .fresnel = RT_FRESNEL_DIELECTRIC},
            {.ks = {1, 1, 1}, .roughness = 0.2f, .coat = 1, .coat_ior = 1.5f}};
    enum { marked = sizeof mixed / sizeof *mixed, count = marked + sizeof others / sizeof *others };
    static const float x[3] = {1, 0, 0}, y[3] = {0, 1, 0};
    rt_scene *scene = new_scene();
    rt_error error;
    (void)state;
    for (int i = 0; i < count; i++) {
        rt_surface surface = {0};
        expect_ok(rt_scene_add_material(scene, &surface.material, NULL,
                                        i < marked ? mixed + i : others + i - marked, &error),
                  &error);
        expect_ok(rt_scene_add_quad(scene, NULL, origin, x, y, &surface, &error), &error);
    }
    rt_scene_image image = pack(scene);
    const rt_shape *shapes = table(&image, header(&image)->shapes);
    for (int i = 0; i < count; i++)
        if (((shapes[i].flags & RT_SHAPE_MIXED) != 0) != (i < marked))
            fail_msg("material %d", i);
    rt_scene_image_free(&image);
    rt_scene_destroy(scene);
}

/* u and v are made where a texture of the material, of the shape or of its light needs them. */
static void shapes_with_textures_are_located(void **state)
{
    static const rt_texture checker = {.kind = RT_TEXTURE_CHECKER, .a = {1, 1, 1}};
    static const int expected[4] = {0, 0, 1, 1};
    rt_surface spheres[4] = {{0}, {.radiance = {1, 1, 1}}, {.radiance = {1, 1, 1}}, {0}};
    rt_scene *scene = new_scene();
    rt_error error;
    (void)state;
    expect_ok(rt_scene_add_texture(scene, &spheres[2].texture, &checker, &error), &error);
    spheres[3].texture = spheres[2].texture;
    for (int i = 0; i < 4; i++)
        expect_ok(rt_scene_add_sphere(scene, NULL, origin, 1, &spheres[i], &error), &error);
    rt_scene_image image = pack(scene);
    const rt_shape *shapes = table(&image, header(&image)->shapes);
    for (int i = 0; i < 4; i++)
        assert_int_equal((shapes[i].flags & RT_SHAPE_LOCATED) != 0, expected[i]);
    assert_false(shapes[2].flags & RT_SHAPE_VARIED);
    rt_scene_image_free(&image);
    rt_scene_destroy(scene);
}

/* An emitter of 1e59 W, which no float holds, beside a weak one: the chances add up to 1. */
static void a_power_beyond_floats_has_a_probability(void **state)
{
    static const float huge[3] = {9e14f, 9e14f, 9e14f};
    const rt_surface surfaces[2] = {{.radiance = {1e28f, 1e28f, 1e28f}}, {.power = {1, 1, 1}}};
    rt_scene *scene = new_scene();
    rt_error error;
    (void)state;
    expect_ok(rt_scene_add_ellipsoid(scene, NULL, origin, huge, &surfaces[0], &error), &error);
    expect_ok(rt_scene_add_sphere(scene, NULL, origin, 1, &surfaces[1], &error), &error);
    rt_scene_image image = pack(scene);
    const rt_light_data *lights = table(&image, header(&image)->lights);
    assert_true(isfinite(image.light_power));
    assert_float_equal(lights[0].pmf + lights[1].pmf, 1, 1e-6);
    assert_true(lights[0].pmf > 0.5f && lights[1].pmf >= 0 && lights[1].cdf == 1);
    rt_scene_image_free(&image);
    rt_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_thousand_instances_take_the_memory_of_one),
        cmocka_unit_test(instances_have_trees_of_their_own),
        cmocka_unit_test(single_and_emissive_meshes_are_baked),
        cmocka_unit_test(materials_and_textures_reach_their_tables),
        cmocka_unit_test(nested_textures_find_their_rows),
        cmocka_unit_test(lambert_and_flat_shapes_are_marked_and_lights_by_area),
        cmocka_unit_test(surfaces_of_mixed_lobes_are_marked),
        cmocka_unit_test(shapes_with_textures_are_located),
        cmocka_unit_test(a_power_beyond_floats_has_a_probability),
    };
    return cmocka_run_group_tests_name("lib/pack/pack", tests, NULL, NULL);
}
