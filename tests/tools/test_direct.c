/*
 * test_direct.c - scenes of other programs where one of the language is expected: the same bytes as
 * when they are imported first, and no file is left of it.
 */
#define _XOPEN_SOURCE 700 /* setenv */
#include <dirent.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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

/* Nothing of an import stays in the folder for temporary files, which is this one. */
static void expect_no_folder(void)
{
    DIR *here = opendir(".");
    assert_non_null(here);
    for (const struct dirent *entry; (entry = readdir(here)) != NULL;)
        if (strncmp(entry->d_name, "rtc-", 4) == 0)
            fail_msg("%s is left", entry->d_name);
    closedir(here);
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

static void what_is_wrong_is_told_of_their_file(void **state)
{
    (void)state;
    scratch_write("bad.xml", "<scene>\n<shape type=\"sphere\"><float name=\"radius\" "
                             "value=\"-1\"/></shape></scene>\n");
    run run = run_rtc("bad.xml");
    expect_status(&run, 1);
    expect_err(&run, "bad.xml:2: a sphere of radius -1");
    run_free(&run);
    expect_rtc(1, "nothing.gltf");
    scratch_write("a.xml", scenes[0].text);
    run = run_rtc("a.xml --untrusted");
    expect_status(&run, 2);
    expect_err(&run, "rtc import a.xml --untrusted --out NAME.rts");
    run_free(&run);
    run = run_rtc("a.xml --dump");
    expect_status(&run, 1);
    expect_err(&run, "rtc import a.xml --out NAME.rts");
    run_free(&run);
    run = run_rtc("a.xml --out a.xml.png --width 8 --height 8 --spp 1");
    expect_status(&run, 0);
    run_free(&run);
    expect_no_folder();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_format_renders_as_imported),
        cmocka_unit_test(every_command_takes_them),
        cmocka_unit_test(parameters_are_set),
        cmocka_unit_test(what_is_wrong_is_told_of_their_file),
    };
    if (spawn_find_rtc() != 0 || setenv("TMPDIR", ".", 1) != 0)
        return 1;
    return cmocka_run_group_tests(tests, scratch_enter, scratch_leave);
}
