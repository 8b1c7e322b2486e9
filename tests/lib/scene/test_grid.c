/* test_grid.c - grids of densities and albedos: their files, and what a scene refuses. */
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "base/wire.h"
#include "scene/grid_file.h"
#include "scene/scene.h"

/* A file of 3 x 2 x 1 voxels of densities 0 to 5. */
enum { file_size = RT_GRID_HEADER + 6 * 4 };

static void make_file(uint8_t data[file_size + 4])
{
    rt_writer w = {data + 8};
    memset(data, 0, file_size + 4);
    memcpy(data, "RTGRID1\n", 8);
    for (uint32_t side = 3; side > 0; side--)
        rt_put32(&w, side);
    for (int i = 0; i < 6; i++)
        rt_put_floats(&w, &(float){(float)i}, 1);
}

static void expect_refused(const uint8_t *data, size_t size, const char *message)
{
    const rt_bytes file = {(uint8_t *)data, size, size, NULL};
    float *values = NULL;
    rt_u32 sides[4] = {7, 7, 7, 7};
    rt_error error;
    assert_int_equal(rt_grid_decode(&values, sides, &file, NULL, &error), RT_ERROR_INPUT);
    if (!strstr(error.message, message))
        fail_msg("'%s' lacks '%s'", error.message, message);
    assert_null(values);
    assert_int_equal(sides[0], 7);
}

static void a_file_is_read(void **state)
{
    uint8_t data[file_size + 4];
    const rt_bytes file = {data, file_size, file_size, NULL};
    float *values = NULL;
    rt_u32 sides[4];
    rt_error error;
    (void)state;
    make_file(data);
    expect_ok(rt_grid_decode(&values, sides, &file, NULL, &error), &error);
    for (rt_u32 i = 0; i < 6; i++)
        assert_float_equal(values[i], (float)i, 0);
    for (rt_u32 i = 0; i < 3; i++)
        assert_int_equal(sides[i], 3 - i);
    assert_int_equal(sides[3], 1);
    rt_memory_free(values);
}

/* The same numbers are those of two voxels. */
static void a_file_of_three_channels_is_read(void **state)
{
    uint8_t data[file_size + 4];
    const rt_bytes file = {data, file_size, file_size, NULL};
    float *values = NULL;
    rt_u32 sides[4];
    rt_error error;
    (void)state;
    make_file(data);
    data[6] = '3';
    expect_refused(data, file_size,
                   "44 bytes; a grid of 3 x 2 x 1 voxels of three channels has 92");
    data[8] = 1;
    expect_ok(rt_grid_decode(&values, sides, &file, NULL, &error), &error);
    for (rt_u32 i = 0; i < 6; i++)
        assert_float_equal(values[i], (float)i, 0);
    assert_true(sides[0] == 1 && sides[1] == 2 && sides[2] == 1 && sides[3] == 3);
    rt_memory_free(values);
    rt_put_floats(&(rt_writer){data + RT_GRID_HEADER + 5 * 4}, &(float){-1}, 1);
    expect_refused(data, file_size, "voxel (0, 1, 0) has the blue -1");
}

static void files_that_are_damaged_are_refused(void **state)
{
    static const float wrong[] = {-1, INFINITY, NAN, 2e28f};
    uint8_t data[file_size + 4];
    (void)state;
    make_file(data);
    expect_refused(data, file_size - 1, "43 bytes; a grid of 3 x 2 x 1 voxels has 44");
    expect_refused(data, file_size + 1, "45 bytes; a grid of 3 x 2 x 1 voxels has 44");
    expect_refused(data, 19, "a header of 19 bytes; that of a grid has 20");
    expect_refused(data, 7, "does not begin with 'RTGRID1' or 'RTGRID3'");
    for (int i = 0; i < 4; i++) {
        make_file(data);
        rt_put_floats(&(rt_writer){data + RT_GRID_HEADER + 4 * 4}, wrong + i, 1);
        expect_refused(data, file_size, "voxel (1, 1, 0) has the density");
    }
    make_file(data);
    data[12] = 0;
    expect_refused(data, file_size, "a grid of 3 x 0 x 1 voxels has none");
    make_file(data);
    memset(data + 8, 0xff, 12);
    expect_refused(data, file_size, "4294967295 voxels; at most 1073741824 are read");
    make_file(data);
    data[10] = data[14] = data[18] = 16;
    expect_refused(data, file_size, "1048577 voxels; at most 1073741824 are read");
    make_file(data);
    data[7] = '\r';
    expect_refused(data, file_size, "byte 0x0d, and not by a line feed");
    make_file(data);
    data[6] = '2';
    expect_refused(data, file_size, "does not begin with 'RTGRID1'");
}

static void errors_name_the_file(void **state)
{
    rt_scene *scene = NULL;
    rt_error error;
    (void)state;
    expect_ok(rt_scene_create(&scene, &error), &error);
    assert_int_equal(rt_scene_add_grid(scene, NULL, &(rt_grid){.path = "scenes/README.md"}, &error),
                     RT_ERROR_INPUT);
    assert_string_equal(error.file, "scenes/README.md");
    assert_string_equal(error.field, "path");
    assert_int_equal(rt_scene_add_grid(scene, NULL, &(rt_grid){0}, &error), RT_ERROR_INPUT);
    assert_non_null(strstr(error.message, "needs a file, or values"));
    rt_scene_destroy(scene);
}

static void boxes_and_densities_out_of_range_are_refused(void **state)
{
    static const float values[2] = {1, 50};
    rt_grid grid = {.values = values, .size = {2, 1, 1}, .lo = {0, 0, 0}, .hi = {3, 4, 12}};
    rt_medium medium = {.absorption = {1, 2, 3}, .scattering = {300, 1, 1}};
    rt_scene *scene = NULL;
    rt_error error;
    (void)state;
    expect_ok(rt_scene_create(&scene, &error), &error);
    expect_ok(rt_scene_add_grid(scene, &medium.density, &grid, &error), &error);
    assert_int_equal(medium.density, 1);
    assert_int_equal(rt_scene_set_medium(scene, &medium, &error), RT_ERROR_INPUT);
    assert_string_equal(error.field, "density");
    assert_non_null(strstr(error.message, "an optical thickness of 195650"));
    medium.scattering[0] = 100;
    expect_ok(rt_scene_set_medium(scene, &medium, &error), &error);
    medium.density = 2;
    assert_int_equal(rt_scene_set_medium(scene, &medium, &error), RT_ERROR_INPUT);
    assert_non_null(strstr(error.message, "there is no grid 2 among 1"));
    grid.hi[1] = 0;
    assert_int_equal(rt_scene_add_grid(scene, NULL, &grid, &error), RT_ERROR_INPUT);
    assert_string_equal(error.field, "hi");
    grid.size[0] = 0;
    assert_int_equal(rt_scene_add_grid(scene, NULL, &grid, &error), RT_ERROR_INPUT);
    assert_string_equal(error.field, "size");
    assert_int_equal(scene->grid_count, 1);
    rt_scene_destroy(scene);
}

static void albedos_out_of_range_are_refused(void **state)
{
    static const float values[3] = {0.5f, 1, 1.5f};
    rt_grid grid = {.values = values, .size = {1, 1, 1}, .channels = 3, .wrap = RT_GRID_REPEAT};
    rt_medium medium = {.scattering = {1, 1, 1}};
    rt_scene *scene = NULL;
    rt_error error;
    (void)state;
    expect_ok(rt_scene_create(&scene, &error), &error);
    expect_ok(rt_scene_add_grid(scene, &medium.albedo, &grid, &error), &error);
    assert_int_equal(rt_scene_set_medium(scene, &medium, &error), RT_ERROR_INPUT);
    assert_string_equal(error.field, "albedo");
    assert_non_null(strstr(error.message, "its albedo reaches 1.5; it must lie from 0 to 1"));
    medium.albedo = 2;
    assert_int_equal(rt_scene_set_medium(scene, &medium, &error), RT_ERROR_INPUT);
    assert_non_null(strstr(error.message, "there is no grid 2 among 1"));
    medium.albedo = 0;
    medium.density = 1;
    assert_int_equal(rt_scene_set_medium(scene, &medium, &error), RT_ERROR_INPUT);
    assert_string_equal(error.field, "density");
    assert_non_null(strstr(error.message, "only an albedo has 'wrap repeat'"));
    grid.wrap = (rt_grid_wrap)2;
    assert_int_equal(rt_scene_add_grid(scene, NULL, &grid, &error), RT_ERROR_INPUT);
    assert_string_equal(error.field, "wrap");
    grid.wrap = RT_GRID_CLAMP;
    grid.channels = 2;
    assert_int_equal(rt_scene_add_grid(scene, NULL, &grid, &error), RT_ERROR_INPUT);
    assert_string_equal(error.field, "channels");
    rt_scene_destroy(scene);
}

/* A medium without coefficients, or a material that nothing is made of, needs no tracking. */
static void grids_count_where_they_are_used(void **state)
{
    static const float value[1] = {1};
    const rt_grid grid = {.values = value, .size = {1, 1, 1}};
    rt_material smoke = {.interface = 1, .absorption = {1, 1, 1}, .density = 1};
    rt_surface surface = {0};
    rt_scene *scene = NULL;
    rt_error error;
    (void)state;
    expect_ok(rt_scene_create(&scene, &error), &error);
    expect_ok(rt_scene_add_grid(scene, NULL, &grid, &error), &error);
    expect_ok(rt_scene_add_material(scene, &surface.material, NULL, &smoke, &error), &error);
    assert_false(rt_scene_has_grids(scene));
    expect_ok(rt_scene_add_sphere(scene, NULL, (float[]){0, 0, 0}, 1, &surface, &error), &error);
    assert_true(rt_scene_has_grids(scene) && rt_scene_has_media(scene));
    rt_scene_destroy(scene);
}

/* An albedo is a grid of what scatters, and of nothing else. */
static void albedos_count_where_light_is_scattered(void **state)
{
    static const float value[1] = {1};
    const rt_grid grid = {.values = value, .size = {1, 1, 1}};
    rt_material smoke = {.interface = 1, .absorption = {1, 1, 1}, .albedo = 1};
    rt_medium medium = {.absorption = {1, 1, 1}, .albedo = 1};
    rt_surface surface = {0};
    rt_scene *scene = NULL;
    rt_error error;
    (void)state;
    expect_ok(rt_scene_create(&scene, &error), &error);
    expect_ok(rt_scene_add_grid(scene, NULL, &grid, &error), &error);
    expect_ok(rt_scene_set_medium(scene, &medium, &error), &error);
    expect_ok(rt_scene_add_material(scene, &surface.material, NULL, &smoke, &error), &error);
    expect_ok(rt_scene_add_sphere(scene, NULL, (float[]){0, 0, 0}, 1, &surface, &error), &error);
    assert_false(rt_scene_has_grids(scene));
    smoke.scattering[1] = 1;
    expect_ok(rt_scene_add_material(scene, &surface.material, NULL, &smoke, &error), &error);
    expect_ok(rt_scene_add_sphere(scene, NULL, (float[]){0, 3, 0}, 1, &surface, &error), &error);
    assert_true(rt_scene_has_grids(scene));
    rt_scene_destroy(scene);
    expect_ok(rt_scene_create(&scene, &error), &error);
    expect_ok(rt_scene_add_grid(scene, NULL, &grid, &error), &error);
    medium.scattering[2] = 1;
    expect_ok(rt_scene_set_medium(scene, &medium, &error), &error);
    assert_true(rt_scene_has_grids(scene));
    rt_scene_destroy(scene);
}

/* A density without coefficients is no medium: no program of media is to look for its table. */
static void a_grid_of_nothing_fills_no_space(void **state)
{
    static const float value[1] = {1};
    const rt_grid grid = {.values = value, .size = {1, 1, 1}};
    rt_medium medium = {.density = 1};
    rt_scene *scene = NULL;
    rt_error error;
    (void)state;
    expect_ok(rt_scene_create(&scene, &error), &error);
    expect_ok(rt_scene_add_grid(scene, NULL, &grid, &error), &error);
    expect_ok(rt_scene_set_medium(scene, &medium, &error), &error);
    assert_false(rt_scene_has_grids(scene) || rt_scene_has_media(scene));
    medium.absorption[1] = 1;
    expect_ok(rt_scene_set_medium(scene, &medium, &error), &error);
    assert_true(rt_scene_has_grids(scene) && rt_scene_has_media(scene));
    rt_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_file_is_read),
        cmocka_unit_test(a_file_of_three_channels_is_read),
        cmocka_unit_test(files_that_are_damaged_are_refused),
        cmocka_unit_test(errors_name_the_file),
        cmocka_unit_test(boxes_and_densities_out_of_range_are_refused),
        cmocka_unit_test(albedos_out_of_range_are_refused),
        cmocka_unit_test(albedos_count_where_light_is_scattered),
        cmocka_unit_test(grids_count_where_they_are_used),
        cmocka_unit_test(a_grid_of_nothing_fills_no_space),
    };
    return cmocka_run_group_tests_name("scene/grid", tests, NULL, NULL);
}
