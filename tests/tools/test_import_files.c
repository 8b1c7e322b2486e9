/*
 * test_import_files.c - the files of an import: a failed one leaves those of an earlier one, and
 * none of its own; it writes through no link or pipe.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "expect.h"
#include "lib/image/scratch.h"
#include "spawn.h"

static void a_scene_that_was_there_stays(void **state)
{
    static const char text[] = "<scene>\n<shape type=\"sphere\"><bsdf type=\"diffuse\"><texture "
                               "name=\"reflectance\" type=\"bitmap\"><string name=\"filename\" "
                               "value=\"bad.png\"/></texture></bsdf></shape>\n</scene>\n";
    (void)state;
    scratch_write("bad.png", "\x89PNG\r\n\x1a\nxxxxxxxx");
    scratch_write("bad.xml", text);
    expect_rtc(1, "import bad.xml --out bad.rts");
    expect_no_file("bad.rts");
    expect_no_file("bad_files");
    scratch_write("mine.rts", "# mine\n");
    scratch_write("bad.rts", "# mine\n");
    expect_rtc(1, "import bad.xml --out bad.rts");
    expect_same_files("mine.rts", "bad.rts");
    expect_no_file("bad_files");
}

/* What is wrong comes behind a mesh that has changed, and is seen by who reads the whole scene. */
static void a_failed_import_leaves_the_meshes_of_an_earlier_one(void **state)
{
#define KEPT "<scene><shape type=\"obj\"><string name=\"filename\" value=\"kept.obj\"/></shape>"
    static const char before[] = KEPT "</scene>\n",
                      after[] = KEPT "<shape type=\"sphere\"><bsdf type=\"diffuse\"><texture "
                                     "name=\"reflectance\" type=\"bitmap\"><string "
                                     "name=\"filename\" value=\"bad.png\"/></texture></bsdf>"
                                     "</shape></scene>\n",
                      mesh[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
                      other[] = "v 0 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\n";
    (void)state;
    scratch_write("bad.png", "\x89PNG\r\n\x1a\nxxxxxxxx");
    scratch_write("kept.obj", mesh);
    scratch_write("kept.xml", before);
    assert_int_equal(mkdir("made", 0777), 0);
    expect_rtc(0, "import kept.xml --out made/kept.rts");
    expect_rtc(0, "made/kept.rts --spp 1 --width 8 --height 8 --quiet --out before.pfm");
    scratch_write("kept.obj", other);
    scratch_write("kept.xml", after);
    expect_rtc(1, "import kept.xml --out made/kept.rts");
    expect_rtc(0, "made/kept.rts --spp 1 --width 8 --height 8 --quiet --out after.pfm");
    expect_same_files("before.pfm", "after.pfm");
    expect_no_file("made/.kept.rts.import");
    /* One that was killed has left its folder. */
    assert_int_equal(mkdir("made/.kept.rts.import", 0777), 0);
    scratch_write("made/.kept.rts.import/kept.rts", "#");
    scratch_write("kept.xml", before);
    expect_rtc(0, "import kept.xml --out made/kept.rts");
    expect_no_file("made/.kept.rts.import");
    expect_rtc(0, "made/kept.rts --spp 1 --width 8 --height 8 --quiet --out other.pfm");
    expect_different_files("before.pfm", "other.pfm");
}

/* Files that a failed import wrote, and no others. */
static void what_fails_leaves_no_files(void **state)
{
    static const char obj[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
                      text[] = "<scene>\n"
                               "<shape type=\"obj\"><string name=\"filename\" value=\"m.obj\"/>"
                               "</shape>\n<shape type=\"sphere\"><ref id=\"none\"/></shape>\n"
                               "</scene>\n";
    (void)state;
    scratch_write("m.obj", obj);
    scratch_write("m.xml", text);
    expect_rtc(1, "import m.xml --out m.rts");
    expect_no_file("m_files");
    assert_int_equal(mkdir("m_files", 0777), 0);
    scratch_write("m_files/notes", "x");
    expect_rtc(1, "import m.xml --out m.rts");
    expect_no_file("m_files/mesh_1.ply");
    expect_file("m_files/notes");
}

/* A package of a stranger may hold links and pipes by the names of what an import makes. */
static void planted_names_are_not_followed(void **state)
{
    static const char text[] = "<scene><shape type=\"obj\"><string name=\"filename\" "
                               "value=\"a.obj\"/></shape></scene>\n",
                      mesh[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    (void)state;
    scratch_write("a.xml", text);
    scratch_write("a.obj", mesh);
    assert_int_equal(mkdir("victim", 0777), 0);
    scratch_write("victim/precious", "mine");
    /* The folder in which an import is tried, or the one in there, leads elsewhere. */
    scratch_write("a.rts", "# mine\n");
    assert_int_equal(mkdir(".a.rts.import", 0777), 0);
    assert_int_equal(symlink("../victim", ".a.rts.import/a_files"), 0);
    expect_rtc(0, "import a.xml --out a.rts");
    assert_int_equal(symlink("victim", ".a.rts.import"), 0);
    expect_rtc(0, "import a.xml --out a.rts");
    expect_no_file(".a.rts.import");
    expect_file("victim/precious");
    /* So does the folder of the files, or one of them. */
    assert_int_equal(unlink("a_files/mesh_1.ply"), 0);
    assert_int_equal(rmdir("a_files"), 0);
    assert_int_equal(symlink("victim", "a_files"), 0);
    expect_rtc(4, "import a.xml --out a.rts");
    assert_int_equal(unlink("a_files"), 0);
    assert_int_equal(mkdir("a_files", 0777), 0);
    assert_int_equal(symlink("../victim/precious", "a_files/mesh_1.ply"), 0);
    expect_rtc(4, "import a.xml --out a.rts");
    assert_int_equal(unlink("a_files/mesh_1.ply"), 0);
    assert_int_equal(mkfifo("a_files/mesh_1.ply", 0600), 0);
    expect_rtc(4, "import a.xml --out a.rts");
    scratch_write("mine", "mine");
    expect_same_files("victim/precious", "mine");
}

/* A name of the folder in which an import is tried that a file has stays its own. */
static void a_file_by_the_name_of_the_folder_stays(void **state)
{
    (void)state;
    scratch_write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    scratch_write("a.rts", "# mine\n");
    scratch_write(".a.rts.import", "mine");
    run run = run_rtc("import a.obj --out a.rts");
    expect_status(&run, 4);
    expect_err(&run, "cannot make the folder .a.rts.import: File exists");
    run_free(&run);
    scratch_expect(".a.rts.import", "mine");
    scratch_expect("a.rts", "# mine\n");
}

/* Two of the greatest length for which the folder of the meshes is a name as well. */
static void a_long_name_is_imported_again(void **state)
{
    char name[254], line[300];
    (void)state;
    memset(name, 'n', sizeof name);
    strcpy(name + sizeof name - sizeof ".rts", ".rts");
    scratch_write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    snprintf(line, sizeof line, "import a.obj --out %s", name);
    expect_rtc(0, line);
    expect_rtc(0, line);
    assert_int_equal(scratch_count(), 3);
}

/* The first file that is written removes what a killed process left; none changes a mode. */
static void meshes_are_written_as_other_outputs(void **state)
{
    struct stat entry;
    (void)state;
    scratch_write("a.xml", "<scene><shape type=\"obj\"><string name=\"filename\" value=\"a.obj\"/>"
                           "</shape><shape type=\"obj\"><string name=\"filename\" "
                           "value=\"b.obj\"/></shape></scene>\n");
    scratch_write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    scratch_write("b.obj", "v 0 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\n");
    expect_rtc(0, "import a.xml --out a.rts");
    assert_int_equal(chmod("a_files/mesh_3.ply", 0600), 0);
    scratch_write("a_files/.rt-1-0.tmp", "left");
    expect_rtc(0, "import a.xml --out a.rts");
    expect_no_file("a_files/.rt-1-0.tmp");
    assert_int_equal(stat("a_files/mesh_3.ply", &entry), 0);
    assert_int_equal(entry.st_mode & 0777, 0600);
    expect_rtc(0, "check a.rts");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_scene_that_was_there_stays, scratch_enter, scratch_leave),
        cmocka_unit_test_setup_teardown(a_failed_import_leaves_the_meshes_of_an_earlier_one,
                                        scratch_enter, scratch_leave),
        cmocka_unit_test_setup_teardown(what_fails_leaves_no_files, scratch_enter, scratch_leave),
        cmocka_unit_test_setup_teardown(planted_names_are_not_followed, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(a_file_by_the_name_of_the_folder_stays, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(a_long_name_is_imported_again, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(meshes_are_written_as_other_outputs, scratch_enter,
                                        scratch_leave),
    };
    if (spawn_find_rtc() != 0)
        return 1;
    return cmocka_run_group_tests_name("import_files", tests, NULL, NULL);
}
