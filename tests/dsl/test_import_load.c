/* Scenes of other programs by the library: read, written, and told of. */
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

#include "lib/image/scratch.h"
#include "rt.h"
#include "tests/support.h"

#define IN_SCRATCH(test) cmocka_unit_test_setup_teardown(test, scratch_enter, scratch_leave)

enum { TOLD_MAX = 16 };

/* What was told, and the files that were read. */
typedef struct told {
    int errors, warnings, notes, files;
    struct {
        char file[64], message[400];
        int line, column;
    } items[TOLD_MAX];
} told;

static void on_diagnostic(void *user, const rt_diagnostic *diagnostic)
{
    told *t = user;
    const int i = t->errors + t->warnings + t->notes;
    t->errors += diagnostic->severity == RT_SEVERITY_ERROR;
    t->warnings += diagnostic->severity == RT_SEVERITY_WARNING;
    t->notes += diagnostic->severity == RT_SEVERITY_NOTE;
    assert_true(i < TOLD_MAX);
    snprintf(t->items[i].file, sizeof t->items[i].file, "%s", diagnostic->file);
    snprintf(t->items[i].message, sizeof t->items[i].message, "%s", diagnostic->message);
    t->items[i].line = diagnostic->line;
    t->items[i].column = diagnostic->column;
}

static void on_file(void *user, const char *path)
{
    told *t = user;
    assert_null(strstr(path, "room_files"));
    t->files++;
}

/* Two cameras, a parameter, a mesh in a file, and what the language lacks. */
static void write_scene(void)
{
    mkdir("in", 0777);
    mkdir("work", 0777);
    scratch_write("in/tri.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    scratch_write("in/room.xml", "<scene version='3.0.0'>\n"
                                 "<default name='r' value='1'/>\n"
                                 "<sensor type='perspective' id='left'/>\n"
                                 "<sensor type='perspective' id='right'/>\n"
                                 "<shape type='obj'><string name='filename' value='tri.obj'/>\n"
                                 "<bsdf type='polarizer'/></shape>\n"
                                 "<shape type='sphere'><float name='radius' value='$r'/></shape>\n"
                                 "<emitter type='constant'/>\n"
                                 "</scene>\n");
}

static rt_load_options options_for(told *t)
{
    memset(t, 0, sizeof *t);
    return (rt_load_options){
        .diagnostic = on_diagnostic, .user = t, .file = on_file, .scratch = "work"};
}

static void a_scene_is_read_and_its_folder_removed(void **state)
{
    told t;
    rt_scene *scene = NULL;
    rt_scene_info info;
    rt_error error;
    (void)state;
    write_scene();
    const rt_load_options options = options_for(&t);
    expect_ok(rt_scene_load(&scene, "in/room.xml", &options, &error), &error);
    rt_scene_get_info(scene, &info);
    assert_true(info.shapes == 2 && info.triangles == 1 && info.has_camera);
    assert_int_equal(t.errors, 0);
    assert_true(t.warnings > 0 && t.notes == 1);
    assert_string_equal(t.items[0].file, "in/room.xml");
    assert_int_equal(t.items[0].line, 4);
    assert_int_equal(t.items[0].column, 0);
    assert_non_null(strstr(t.items[0].message, "camera 2 'right' is left out"));
    assert_int_equal(t.files, 2);
    assert_int_equal(rmdir("work"), 0); /* nothing is left in it */
    rt_scene_destroy(scene);
}

static void parameters_and_cameras_are_chosen(void **state)
{
    static const rt_definition radius = {"r", "2"}, unknown = {"s", "2"};
    told t;
    rt_scene *scene = NULL;
    rt_error error;
    (void)state;
    write_scene();
    rt_load_options options = options_for(&t);
    options.camera = "right";
    options.definitions = &radius;
    options.definition_count = 1;
    expect_ok(rt_scene_load(&scene, "in/room.xml", &options, &error), &error);
    for (int i = 0; i < t.warnings + t.notes; i++)
        assert_null(strstr(t.items[i].message, "is left out: --camera"));
    rt_scene_destroy(scene);
    options.camera = "3";
    assert_int_equal(rt_scene_load(&scene, "in/room.xml", &options, &error), RT_ERROR_INPUT);
    assert_non_null(strstr(error.message, "the file has the cameras 1 'left', 2 'right'"));
    options.camera = NULL;
    options.definitions = &unknown;
    assert_int_equal(rt_scene_load(&scene, "in/room.xml", &options, &error), RT_ERROR_INPUT);
    assert_string_equal(error.message, "definition s: the scene has no parameter of that name");
    assert_string_equal(error.file, "in/room.xml");
}

static void what_is_lacking_may_be_an_error(void **state)
{
    told t;
    rt_scene *scene = NULL;
    rt_error error;
    (void)state;
    write_scene();
    rt_load_options options = options_for(&t);
    options.is_strict = 1;
    assert_int_equal(rt_scene_load(&scene, "in/room.xml", &options, &error), RT_ERROR_INPUT);
    assert_true(t.errors > 1 && t.warnings == 0);
    assert_int_equal(strncmp(error.message, t.items[0].message, strlen(t.items[0].message)), 0);
    char more[32];
    snprintf(more, sizeof more, " (and %d more)", t.errors - 1);
    assert_non_null(strstr(error.message, more));
    assert_string_equal(error.file, "in/room.xml");
    assert_true(error.line == 4 && error.column == 0);
    assert_int_equal(rmdir("work"), 0);
}

static void a_root_keeps_files_out(void **state)
{
    told t;
    rt_scene *scene = NULL;
    rt_scene_info info;
    rt_error error;
    (void)state;
    write_scene();
    scratch_write("out.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    scratch_write("in/far.xml", "<scene version='3.0.0'>\n"
                                "<shape type='obj'><string name='filename' value='../out.obj'/>\n"
                                "</shape><shape type='sphere'/></scene>\n");
    rt_load_options options = options_for(&t);
    options.root = "in";
    expect_ok(rt_scene_load(&scene, "in/far.xml", &options, &error), &error);
    rt_scene_get_info(scene, &info);
    assert_int_equal(info.triangles, 0);
    /* Behind the camera and the light that were added, which concern all of the picture. */
    assert_non_null(strstr(t.items[2].message, "outside of the scene's folder"));
    rt_scene_destroy(scene);
    expect_ok(rt_scene_load(&scene, "in/room.xml", &options, &error), &error);
    rt_scene_get_info(scene, &info);
    assert_int_equal(info.triangles, 1);
    rt_scene_destroy(scene);
}

static void options_of_others_are_refused(void **state)
{
    rt_scene *scene = NULL;
    rt_error error;
    (void)state;
    const rt_load_options camera = {.camera = "1"}, strict = {.is_strict = 1};
    assert_int_equal(rt_scene_parse(&scene, "sphere { }", NULL, &camera, &error), RT_ERROR_USAGE);
    assert_string_equal(error.field, "camera");
    assert_int_equal(rt_scene_load(&scene, "a.rts", &strict, &error), RT_ERROR_USAGE);
    assert_string_equal(error.field, "is_strict");
}

static void an_import_writes_what_a_load_reads(void **state)
{
    told t;
    rt_scene *written = NULL, *read = NULL;
    rt_scene_info a, b;
    rt_error error;
    (void)state;
    write_scene();
    const rt_load_options options = options_for(&t);
    expect_ok(rt_scene_import(&written, "room.rts", "in/room.xml", &options, &error), &error);
    assert_int_equal(access("room_files/mesh_1.ply", F_OK), 0);
    expect_ok(rt_scene_load(&read, "room.rts", NULL, &error), &error);
    rt_scene_get_info(written, &a);
    rt_scene_get_info(read, &b);
    assert_memory_equal(&a, &b, sizeof a);
    rt_scene_destroy(written);
    rt_scene_destroy(read);
    /* What is wrong leaves the earlier one. */
    char *const before = scratch_read("room.rts");
    scratch_write("in/bad.xml", "<scene>\n<shape type='sphere'>");
    assert_int_equal(rt_scene_import(NULL, "room.rts", "in/bad.xml", &options, &error),
                     RT_ERROR_INPUT);
    assert_string_equal(error.file, "in/bad.xml");
    scratch_expect("room.rts", before);
    free(before);
    assert_int_equal(rt_scene_import(NULL, "room.txt", "in/room.xml", NULL, &error),
                     RT_ERROR_USAGE);
    assert_int_equal(rt_scene_import(NULL, NULL, "in/room.xml", NULL, &error), RT_ERROR_USAGE);
    assert_int_equal(rt_scene_import(NULL, "no/room.rts", "in/room.xml", NULL, &error),
                     RT_ERROR_OUTPUT);
}

static void names_of_scenes_are_known(void **state)
{
    (void)state;
    assert_true(rt_path_is_foreign("a.xml") && rt_path_is_foreign("b/a.GLB"));
    assert_false(rt_path_is_foreign("a.rts") || rt_path_is_foreign(".xml") ||
                 rt_path_is_foreign(NULL) || rt_path_is_foreign("xml"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_SCRATCH(a_scene_is_read_and_its_folder_removed),
        IN_SCRATCH(parameters_and_cameras_are_chosen),
        IN_SCRATCH(what_is_lacking_may_be_an_error),
        IN_SCRATCH(a_root_keeps_files_out),
        cmocka_unit_test(options_of_others_are_refused),
        IN_SCRATCH(an_import_writes_what_a_load_reads),
        cmocka_unit_test(names_of_scenes_are_known),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
