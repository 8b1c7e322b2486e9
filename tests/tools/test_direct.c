/*
 * test_direct.c - scenes of other programs where one of the language is expected: the same bytes as
 * when they are imported first, and no file is left of it.
 */
#define _XOPEN_SOURCE 700 /* setenv */
#include <dirent.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>

#include "expect.h"
#include "lib/image/scratch.h"
#include "spawn.h"

static const struct {
    const char *name, *text;
} scenes[] = {
    {"a.xml", "<scene><default name=\"radius\" value=\"1\"/><shape type=\"sphere\"><float "
              "name=\"radius\" value=\"$radius\"/></shape></scene>\n"},
    {"b.pbrt", "LookAt 0 0 5 0 0 0 0 1 0\nCamera \"perspective\"\nWorldBegin\nLightSource "
               "\"infinite\"\nShape \"sphere\"\n"},
    {"c.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
    {"d.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
              "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
              "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
    {"e.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
    {"f.stl", "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
              "endloop\nendfacet\nendsolid s\n"},
    {"g.gltf", "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":"
               "0}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
               "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":"
               "\"VEC3\"}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],\"buffers\":["
               "{\"byteLength\":36,\"uri\":\"data:application/octet-stream;base64,"
               "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}"},
};

enum { SCENES = sizeof scenes / sizeof *scenes };

/* Whether a folder of an import is in that for temporary files, which is this one. */
static int has_folder(void)
{
    int is_there = 0;
    DIR *here = opendir(".");
    assert_non_null(here);
    for (const struct dirent *entry; (entry = readdir(here)) != NULL;)
        is_there |= strncmp(entry->d_name, "rt-", 3) == 0;
    closedir(here);
    return is_there;
}

static void expect_no_folder(void)
{
    assert_false(has_folder());
}

static void every_format_renders_as_imported(void **state)
{
    static const char options[] = "--width 20 --height 16 --quiet";
    (void)state;
    for (int i = 0; i < SCENES; i++)
        for (int is_photon = 0; is_photon < 2; is_photon++) {
            const char *const mode = is_photon ? "--mode photon --photons 1000 --spp 1" : "--spp 2";
            scratch_write(scenes[i].name, scenes[i].text);
            run run = run_rtc("%s %s %s --out direct.pfm", scenes[i].name, mode, options);
            expect_status(&run, 0);
            run_free(&run);
            expect_no_folder();
            run = run_rtc("import %s --out imported.rts", scenes[i].name);
            expect_status(&run, 0);
            run_free(&run);
            run = run_rtc("imported.rts %s %s --out imported.pfm", mode, options);
            expect_status(&run, 0);
            run_free(&run);
            expect_same_files("direct.pfm", "imported.pfm");
        }
}

static void every_command_takes_them(void **state)
{
    (void)state;
    scratch_write("a.xml", scenes[0].text);
    run run = run_rtc("check a.xml");
    expect_status(&run, 0);
    expect_out(&run, "a.xml: ok: 1 shape");
    expect_err(&run, "warning: a.xml: the file has no camera");
    run_free(&run);
    expect_rtc(0, "photons a.xml --photons 1000 --out a.rtp");
    expect_rtc(0, "paths a.xml --pixel 3,4 --width 20 --height 16");
    expect_no_folder();
}

/* Parameters of Mitsuba, by both options; one that the scene has not is refused. */
static void parameters_are_set(void **state)
{
    (void)state;
    scratch_write("a.xml", scenes[0].text);
    expect_rtc(0, "import a.xml --set radius=3 --out a.rts");
    expect_in_file("a.rts", "radius 3");
    expect_rtc(0, "import a.xml -D radius=4 --out a.rts");
    expect_in_file("a.rts", "radius 4");
    expect_rtc(0, "import a.xml -Dradius=5 --out a.rts");
    expect_in_file("a.rts", "radius 5");
    run run = run_rtc("check a.xml -D raduis=5");
    expect_status(&run, 1);
    expect_err(&run, "a.xml: --set raduis: the scene has no parameter of that name");
    run_free(&run);
    scratch_write("c.obj", scenes[2].text);
    expect_rtc(1, "check c.obj --set radius=3");
    run = run_rtc("check a.xml -D");
    expect_status(&run, 2);
    expect_err(&run, "--set needs a value");
    run_free(&run);
    run = run_rtc("compare a.pfm b.pfm -D a=1");
    expect_status(&run, 2);
    expect_err(&run, "`rtc compare` takes no option -D");
    run_free(&run);
}

#define SENSOR(id, eye, width)                                                                     \
    "<sensor type=\"perspective\" id=\"" id                                                        \
    "\"><transform name=\"to_world\"><lookat origin=\"" eye                                        \
    "\" target=\"0,0,0\" up=\"0,1,0\"/></transform><film type=\"hdrfilm\"><integer "               \
    "name=\"width\" "                                                                              \
    "value=\"" width "\"/></film></sensor>"

static void expect_eye(const char *command, const char *eye)
{
    char line[100];
    snprintf(line, sizeof line, "eye     %s", eye);
    expect_rtc(0, command);
    expect_in_file("eye.rts", line);
}

static void a_camera_is_chosen(void **state)
{
    (void)state;
    scratch_write("two.xml",
                  "<scene>" SENSOR("front", "0,0,5", "32")
                      SENSOR("side", "6,0,0",
                             "48") "<shape type=\"sphere\"/><emitter type=\"constant\"/></scene>");
    scratch_write(
        "two.gltf",
        "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0,1]}],\"nodes\":["
        "{\"camera\":1,\"name\":\"near\"},{\"camera\":0,\"translation\":[7,0,9]}],\"cameras\":["
        "{\"type\":\"perspective\",\"name\":\"far\",\"perspective\":{\"yfov\":0.5}},"
        "{\"type\":\"perspective\",\"perspective\":{\"yfov\":0.5}}]}");
    expect_eye("import two.xml --out eye.rts", "0 0 5");
    expect_eye("import two.xml --camera 2 --out eye.rts", "6 0 0");
    expect_in_file("eye.rts", "width 48");
    expect_eye("import two.xml --camera side --strict --out eye.rts", "6 0 0");
    expect_eye("import two.gltf --out eye.rts", "0 0 0");
    expect_eye("import two.gltf --camera far --out eye.rts", "7 0 9");
    expect_eye("import two.gltf --camera near --out eye.rts", "0 0 0");
    scratch_write("three.xml", "<scene>" SENSOR("3", "0,0,5", "32") SENSOR("b", "6,0,0", "48")
                                   SENSOR("1", "7,0,0", "48") "<shape type=\"sphere\"/></scene>");
    expect_eye("import three.xml --camera 3 --out eye.rts", "7 0 0");
    run run = run_rtc("check two.xml");
    expect_status(&run, 0);
    expect_err(&run, "two.xml:1: camera 2 'side' is left out: --camera 2 takes it");
    run_free(&run);
    run = run_rtc("check two.xml --camera top");
    expect_status(&run, 1);
    expect_err(&run, "--camera top: the file has the cameras 1 'front', 2 'side'");
    run_free(&run);
    scratch_write("c.obj", scenes[2].text);
    run = run_rtc("check c.obj --camera 1");
    expect_status(&run, 1);
    expect_err(&run, "--camera 1: the file has no camera");
    run_free(&run);
    /* A file of meshes needs neither camera nor light. */
    scratch_write("bare.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    run = run_rtc("check bare.obj --strict");
    expect_status(&run, 0);
    expect_err(&run, "rtc: warning: bare.obj: the file has no camera");
    run_free(&run);
    scratch_write("lost.obj", "mtllib lost.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    run = run_rtc("check lost.obj --strict");
    expect_status(&run, 1);
    expect_err(&run, "rtc: error: lost.obj:1: ");
    expect_no_err(&run, "error: lost.obj: the file has no camera");
    run_free(&run);
    scratch_write("own.rts", "sphere { centre 0 0 0  radius 1 }\n");
    expect_rtc(2, "check own.rts --camera 1");
}

static void a_file_of_one_camera_has_no_other(void **state)
{
    (void)state;
    scratch_write("one.pbrt", "Camera \"perspective\"\nWorldBegin\nShape \"sphere\"\n");
    expect_rtc(0, "import one.pbrt --camera 1 --out one.rts");
    run run = run_rtc("import one.pbrt --camera 2 --out one.rts");
    expect_status(&run, 1);
    expect_err(&run, "one.pbrt: --camera 2: the file has one camera, 1");
    run_free(&run);
}

static void strict_imports_fail_where_others_warn(void **state)
{
    (void)state;
    scratch_write(
        "strict.xml",
        "<scene>" SENSOR("front", "0,0,5",
                         "32") "<shape type=\"sphere\"/><emitter type=\"constant\"/></scene>");
    scratch_write(
        "near.xml",
        "<scene>" SENSOR("front", "0,0,5",
                         "32") "<shape type=\"nothing\"/><emitter type=\"constant\"/></scene>");
    expect_rtc(0, "check strict.xml --strict");
    expect_rtc(0, "import strict.xml --strict --out strict.rts");
    expect_rtc(0, "check near.xml");
    run run = run_rtc("check near.xml --strict --quiet");
    expect_status(&run, 1);
    expect_err(&run, "rtc: error: near.xml:1: ");
    run_free(&run);
    expect_rtc(1, "import near.xml --strict --out near.rts");
    expect_no_file("near.rts");
    scratch_write("own.rts", "sphere { centre 0 0 0  radius 1 }\n");
    expect_rtc(2, "check own.rts --strict");
    expect_no_folder();
}

static void what_is_wrong_is_told_of_their_file(void **state)
{
    (void)state;
    scratch_write("bad.xml", "<scene>\n<shape type=\"sphere\"><float name=\"radius\" "
                             "value=\"-1\"/></shape></scene>\n");
    run run = run_rtc("bad.xml");
    expect_status(&run, 1);
    expect_err(&run, "bad.xml:2: a sphere of radius -1");
    run_free(&run);
    scratch_write("more.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\nmore\n");
    run = run_rtc("check more.off");
    expect_status(&run, 0);
    expect_err(&run, "more.off:7: what follows the last of 1 faces is ignored");
    expect_no_err(&run, "mesh");
    run_free(&run);
    expect_rtc(1, "nothing.gltf");
    scratch_write("a.xml", scenes[0].text);
    run = run_rtc("a.xml --out a.xml.png --width 8 --height 8 --spp 1");
    expect_status(&run, 0);
    run_free(&run);
    expect_no_folder();
}

/* The text that --dump writes names the files that an import writes, and renders to the same. */
static void a_dump_is_in_the_language(void **state)
{
    static const char options[] = "--width 20 --height 16 --spp 2 --quiet";
    (void)state;
    for (int i = 0; i < SCENES; i++) {
        scratch_write(scenes[i].name, scenes[i].text);
        run run = run_rtc("%s --dump --quiet", scenes[i].name);
        expect_status(&run, 0);
        if (strstr(run.out, "mesh"))
            expect_out(&run, "_files are written by `rtc import ");
        assert_null(strstr(run.out, "/rt-"));
        scratch_write("dumped.rts", run.out);
        run_free(&run);
        run = run_rtc("import %s --out %c.rts --quiet", scenes[i].name, scenes[i].name[0]);
        expect_status(&run, 0);
        run_free(&run);
        run = run_rtc("dumped.rts %s --out dumped.pfm", options);
        expect_status(&run, 0);
        run_free(&run);
        run = run_rtc("%s %s --out direct.pfm", scenes[i].name, options);
        expect_status(&run, 0);
        run_free(&run);
        expect_same_files("dumped.pfm", "direct.pfm");
    }
    expect_no_folder();
}

/* A signal while a scene is loaded ends the program once the folder is removed. */
static void an_interrupted_load_leaves_nothing(void **state)
{
    enum { faces = 100000 };
    static const int signals[] = {SIGINT, SIGTERM};
    static const char *const lines[] = {"large.obj --spp 1 --quiet --out a.pfm", "check large.obj"};
    char said[1 << 12] = "";
    (void)state;
    FILE *file = fopen("large.obj", "w");
    assert_non_null(file);
    for (int i = 0; i < faces; i++)
        fprintf(file, "v %d 0 0\nv %d 0 1\nv %d 1 0\nf -3 -2 -1\n", i, i, i);
    assert_int_equal(fclose(file), 0);
    for (int i = 0; i < 2; i++) {
        const struct timespec nap = {.tv_nsec = 1000000};
        running running = start_rtc("%s", lines[i]);
        for (int left = 20000; left > 0 && !has_folder(); left--)
            nanosleep(&nap, NULL);
        assert_true(has_folder());
        assert_int_equal(kill(running.pid, signals[i]), 0);
        assert_int_not_equal(running_finish(&running, said, sizeof said), 0);
        expect_no_folder();
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_format_renders_as_imported),
        cmocka_unit_test(every_command_takes_them),
        cmocka_unit_test(parameters_are_set),
        cmocka_unit_test(a_camera_is_chosen),
        cmocka_unit_test(a_file_of_one_camera_has_no_other),
        cmocka_unit_test(strict_imports_fail_where_others_warn),
        cmocka_unit_test(what_is_wrong_is_told_of_their_file),
        cmocka_unit_test(a_dump_is_in_the_language),
        cmocka_unit_test(an_interrupted_load_leaves_nothing),
    };
    if (spawn_find_rtc() != 0 || setenv("TMPDIR", ".", 1) != 0)
        return 1;
    return cmocka_run_group_tests(tests, scratch_enter, scratch_leave);
}
