/* test_vdb.c - grids from files of OpenVDB and NanoVDB, which make_vdb writes. */
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/memory.h"
#include "lib/image/scratch.h"
#include "scene/scene.h"
#include "scene/vdb.h"

static char here[2048], module[4096], maker[4096]; /* paths */

/* What make_vdb puts into a voxel. */
static double fog_at(double x, double y, double z)
{
    return fmax(0, 1 - sqrt((x - 1) * (x - 1) + (y - 2) * (y - 2) + (z - 3) * (z - 3)) / 8);
}

/* The fog fills voxels -6 to 8, -5 to 9 and -4 to 10; one more is read on each side. */
static void expect_fog(const rt_vdb *read, const float unit[3])
{
    const rt_u32 channels = read->size[3];
    const float *at = read->values;
    for (int i = 0; i < 3; i++)
        assert_int_equal(read->size[i], 17);
    for (int z = -5; z <= 11; z++)
        for (int y = -6; y <= 10; y++)
            for (int x = -7; x <= 9; x++)
                for (rt_u32 c = 0; c < channels; c++, at++)
                    assert_float_equal(*at, unit[c] * fog_at(x, y, z), 1e-6);
}

static void expect_point(const rt_affine *map, const double from[3], const double to[3])
{
    for (int i = 0; i < 3; i++) {
        double made = map->m[i][3];
        for (int j = 0; j < 3; j++)
            made += map->m[i][j] * from[j];
        assert_float_equal(made, to[i], 1e-9);
    }
}

static void read_file(rt_vdb *read, const char *name, const char *layer)
{
    rt_error error;
    expect_ok(rt_vdb_read(read, name, layer, module, NULL, &error), &error);
}

static void grids_have_their_values(void **state)
{
    static const struct {
        const char *file, *layer;
        float unit[3];
        rt_u32 channels;
    } files[] = {{"fog.vdb", NULL, {1}, 1},         {"fog.vdb", "temperature", {300}, 1},
                 {"fog.nvdb", NULL, {1}, 1},        {"FOG.NVDB", NULL, {1}, 1},
                 {"double.vdb", NULL, {1}, 1},      {"two.vdb", "b", {2}, 1},
                 {"turned.vdb", "density", {1}, 1}, {"colours.vdb", NULL, {1, 0.5, 0.25}, 3}};
    (void)state;
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        rt_vdb read;
        read_file(&read, files[i].file, files[i].layer);
        assert_int_equal(read.size[3], files[i].channels);
        assert_float_equal(read.background, 0, 0);
        if (files[i].unit[0] < 300)
            expect_fog(&read, files[i].unit);
        rt_memory_free(read.values);
    }
}

/* Voxel (-7, -6, -5), which is the first, is centred at (0.5, 0.5, 0.5). */
static void grids_lie_where_their_files_say(void **state)
{
    static const double first[3] = {0.5, 0.5, 0.5}, next[3] = {1.5, 2.5, 3.5};
    rt_vdb read;
    (void)state;
    read_file(&read, "fog.vdb", NULL);
    expect_point(&read.to_world, first, (double[]){-0.35, -0.3, -0.25});
    rt_memory_free(read.values);
    read_file(&read, "fog.nvdb", NULL);
    expect_point(&read.to_world, first, (double[]){-0.35, -0.3, -0.25});
    rt_memory_free(read.values);
    read_file(&read, "turned.vdb", NULL);
    expect_point(&read.to_world, first, (double[]){5 + 0.6, 6 - 1.4, 7 - 1.5});
    expect_point(&read.to_world, next, (double[]){5 + 0.4, 6 - 1.2, 7 - 0.6});
    rt_memory_free(read.values);
}

/* Adds a grid to a scene of its own, and a medium of it; the status of what fails first. */
static rt_status add(const rt_grid *grid, rt_error *error)
{
    rt_scene *scene;
    rt_medium medium = {.scattering = {1, 1, 1}};
    expect_ok(rt_scene_create(&scene, error), error);
    rt_scene_set_vdb_module(scene, module);
    rt_status status = rt_scene_add_grid(scene, &medium.density, grid, error);
    if (status == RT_OK)
        status = rt_scene_set_medium(scene, &medium, error);
    rt_scene_destroy(scene);
    return status;
}

static void what_is_no_density_is_refused(void **state)
{
    static const struct {
        const char *file, *layer, *field, *message;
    } files[] = {{"fog.vdb", "heat", "path", "it has no grid 'heat', but 'density', 'temperature'"},
                 {"two.vdb", NULL, "path", "choose a layer, of 'a', 'b'"},
                 {"level_set.vdb", NULL, "path", "its grid 'density' is a level set"},
                 {"frustum.vdb", NULL, "path", "lies in a frustum"},
                 {"empty.vdb", NULL, "path", "has no active voxel"},
                 {"wide.vdb", NULL, "path", "more than 1022 x 1022 x 1022 voxels"},
                 {"whole.vdb", NULL, "path", "has values of type int32"},
                 {"negative.vdb", NULL, "path", "it must lie from 0 to"},
                 {"endless.vdb", NULL, "density", "is 0.5 outside of the voxels"},
                 {"broken.vdb", NULL, "path", ""},
                 {"broken.nvdb", NULL, "path", ""},
                 {"none.vdb", NULL, "path", "No such file"}};
    (void)state;
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        rt_error error;
        const rt_grid grid = {.path = files[i].file, .layer = files[i].layer};
        assert_int_equal(add(&grid, &error), RT_ERROR_INPUT);
        if (!strstr(error.message, files[i].message))
            fail_msg("'%s' lacks '%s'", error.message, files[i].message);
        assert_string_equal(error.field, files[i].field);
    }
}

/*
 * A file with each of its words of 8 bytes that may be an offset, and those of its head, changed to
 * one that is far away.
 */
static void offsets_of_nanovdb_are_checked(void **state)
{
    static unsigned char data[1 << 23];
    FILE *file = fopen("fog.nvdb", "rb");
    size_t refused = 0, changed = 0;
    (void)state;
    assert_non_null(file);
    const size_t size = fread(data, 1, sizeof data, file);
    fclose(file);
    assert_true(size > 4096 && size < sizeof data);
    for (size_t at = 0; at + 8 <= size; at += 8) {
        uint64_t word, far;
        memcpy(&word, data + at, 8);
        if ((word == 0 || word > size) && at > 1024)
            continue;
        for (int i = 0; i < 2; i++) {
            rt_vdb read;
            rt_error error;
            far = i ? UINT64_MAX : word + ((uint64_t)1 << 40);
            memcpy(data + at, &far, 8);
            scratch_write_bytes("far.nvdb", data, size);
            const rt_status status = rt_vdb_read(&read, "far.nvdb", NULL, module, NULL, &error);
            assert_true(status == RT_OK || status == RT_ERROR_INPUT || status == RT_ERROR_MEMORY);
            if (status == RT_OK)
                rt_memory_free(read.values);
            refused += status != RT_OK;
            changed++;
        }
        memcpy(data + at, &word, 8);
    }
    assert_true(changed > 100 && refused > 20);
}

static void the_place_is_that_of_the_file(void **state)
{
    rt_error error;
    rt_grid grid = {.path = "fog.vdb", .hi = {1, 1, 1}};
    (void)state;
    assert_int_equal(add(&grid, &error), RT_ERROR_INPUT);
    assert_non_null(strstr(error.message, "has a place of its own"));
    grid = (rt_grid){.path = "a.grid", .layer = "density"};
    assert_int_equal(add(&grid, &error), RT_ERROR_INPUT);
    assert_string_equal(error.field, "layer");
}

/* A scene of fog.vdb, moved by a transform, and of the same voxels as an array. */
static void a_grid_is_as_its_voxels(void **state)
{
    rt_scene *scene;
    rt_vdb read;
    rt_error error;
    uint32_t handle;
    (void)state;
    read_file(&read, "fog.vdb", NULL);
    rt_grid file = {.path = "fog.vdb"};
    rt_grid array = {.values = read.values, .size = {17, 17, 17}, .channels = 1};
    for (int i = 0; i < 3; i++) {
        file.transform.m[i][i] = array.transform.m[i][i] = 2;
        file.transform.m[i][3] = array.transform.m[i][3] = (float)(i + 1);
        array.lo[i] = (float)read.to_world.m[i][3];
        array.hi[i] = array.lo[i] + 17 * 0.05f;
    }
    expect_ok(rt_scene_create(&scene, &error), &error);
    rt_scene_set_vdb_module(scene, module);
    expect_ok(rt_scene_add_grid(scene, &handle, &file, &error), &error);
    expect_ok(rt_scene_add_grid(scene, &handle, &array, &error), &error);
    assert_memory_equal(scene->grids[0].values, scene->grids[1].values,
                        17 * 17 * 17 * sizeof(float));
    assert_float_equal(scene->grids[0].diagonal, scene->grids[1].diagonal, 1e-5);
    for (int i = 0; i < 12; i++)
        assert_float_equal(scene->grids[0].to_voxels.m[i / 4][i % 4],
                           scene->grids[1].to_voxels.m[i / 4][i % 4], 1e-4);
    rt_memory_free(read.values);
    rt_scene_destroy(scene);
}

static void without_the_module_a_message_says_so(void **state)
{
    rt_vdb read;
    rt_error error;
    (void)state;
    assert_int_equal(rt_vdb_read(&read, "fog.vdb", NULL, "", NULL, &error), RT_ERROR_INPUT);
    assert_non_null(strstr(error.message, "none may be opened"));
    assert_int_equal(rt_vdb_read(&read, "fog.vdb", NULL, "no.so", NULL, &error), RT_ERROR_INPUT);
    assert_non_null(strstr(error.message, "libopenvdb-dev"));
}

/* pbrt's medium of such a file, at the place of the file in the frame of the medium. */
static void a_medium_of_pbrt_is_imported(void **state)
{
    static const char pbrt[] = "Translate 0 0 4\n"
                               "Camera \"perspective\"\n"
                               "WorldBegin\n"
                               "LightSource \"infinite\"\n"
                               "AttributeBegin\n"
                               "Translate 1 2 3\n"
                               "MakeNamedMedium \"fog\" \"string type\" \"nanovdb\"\n"
                               "  \"string filename\" \"fog.nvdb\" \"float scale\" 3\n"
                               "AttributeEnd\n"
                               "MediumInterface \"fog\" \"\"\n"
                               "Material \"interface\"\n"
                               "Shape \"sphere\" \"float radius\" 9\n";
    const rt_load_options options = {.vdb_module = module};
    rt_scene *scene;
    rt_error error;
    double at[3];
    (void)state;
    scratch_write("fog.pbrt", pbrt);
    expect_ok(rt_scene_load(&scene, "fog.pbrt", &options, &error), &error);
    assert_int_equal(scene->grid_count, 1);
    assert_float_equal(scene->grids[0].largest, 1, 0);
    /* pbrt's x runs to the left. */
    rt_affine_point(at, &scene->grids[0].to_voxels,
                    (double[]){-1.0 - 0.05 * 1, 2 + 0.05 * 2, 3 + 0.05 * 3});
    for (int i = 0; i < 3; i++)
        assert_float_equal(at[i], 8.5, 1e-3);
    assert_float_equal(scene->materials[0].scattering[1], 3, 1e-6);
    rt_scene_destroy(scene);
}

/* The first half of a file, as broken.* */
static void break_file(const char *name, const char *broken)
{
    static char data[1 << 16];
    FILE *file = fopen(name, "rb");
    assert_non_null(file);
    const size_t size = fread(data, 1, sizeof data, file);
    fclose(file);
    file = fopen(broken, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(data, 1, size / 2, file), size / 2);
    assert_int_equal(fclose(file), 0);
}

static int make_files(void **state)
{
    char command[5000];
    if (scratch_enter(state) != 0)
        return -1;
    snprintf(command, sizeof command, "'%s' .", maker);
    if (system(command) != 0)
        return -1;
    break_file("fog.vdb", "broken.vdb");
    break_file("fog.nvdb", "broken.nvdb");
    return 0;
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(grids_have_their_values),
        cmocka_unit_test(grids_lie_where_their_files_say),
        cmocka_unit_test(what_is_no_density_is_refused),
        cmocka_unit_test(offsets_of_nanovdb_are_checked),
        cmocka_unit_test(the_place_is_that_of_the_file),
        cmocka_unit_test(a_grid_is_as_its_voxels),
        cmocka_unit_test(a_medium_of_pbrt_is_imported),
        cmocka_unit_test(without_the_module_a_message_says_so),
    };
    const char *slash = argc > 0 ? strrchr(argv[0], '/') : NULL;
    const int folder = slash ? (int)(slash - argv[0]) : 0;
    if (!getcwd(here, sizeof here))
        return 1;
    snprintf(maker, sizeof maker, "%s%s%.*s/make_vdb", *argv[0] == '/' ? "" : here,
             *argv[0] == '/' ? "" : "/", folder, argv[0]);
    snprintf(module, sizeof module, "%.*s../../../librt-render-vdb.so.0",
             (int)strlen(maker) - (int)strlen("make_vdb"), maker);
    return cmocka_run_group_tests(tests, make_files, scratch_leave);
}
