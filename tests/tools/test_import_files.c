/*
 * test_import_files.c - the files of an import: a failed one leaves those of an earlier one, and
 * none of its own; it writes through no link or pipe; JPEGs that a glTF holds become files.
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
#include "lib/image/jpeg_sample.h"
#include "lib/image/scratch.h"
#include "spawn.h"

/* The bytes as base64 (RFC 4648). */
static void write_base64(FILE *file, const rt_bytes *bytes)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < bytes->size; i += 3) {
        uint32_t word = 0;
        for (size_t k = 0; k < 3; k++)
            word = word << 8 | (i + k < bytes->size ? bytes->data[i + k] : 0);
        for (size_t k = 0; k < 4; k++)
            fputc(i + k > bytes->size ? '=' : digits[word >> (18 - 6 * k) & 63], file);
    }
}

static void a_scene_that_was_there_stays(void **state)
{
    static const char text[] = "<scene>\n<shape type=\"sphere\"><bsdf type=\"diffuse\"><texture "
                               "name=\"reflectance\" type=\"bitmap\"><string name=\"filename\" "
                               "value=\"bad.png\"/></texture></bsdf></shape>\n</scene>\n";
    (void)state;
    scratch_write("bad.png", "\x89PNG\r\n\x1a\nxxxxxxxx");
    scratch_write("bad.xml", text);
    expect_rtc(1, "import bad.xml --strict --out bad.rts");
    expect_no_file("bad.rts");
    expect_no_file("bad_files");
    scratch_write("mine.rts", "# mine\n");
    scratch_write("bad.rts", "# mine\n");
    expect_rtc(1, "import bad.xml --strict --out bad.rts");
    expect_same_files("mine.rts", "bad.rts");
    expect_no_file("bad_files");
}

/* A glTF with two images, one in its text and one in the buffer behind the corners. */
static void write_gltf_with_images(const rt_bytes *image)
{
    static const uint8_t corners[36] = {[14] = 0x80, [15] = 0x3f, [30] = 0x80, [31] = 0x3f};
    rt_bytes buffer = {0};
    assert_int_equal(rt_bytes_put(&buffer, 0, corners, sizeof corners, NULL), RT_OK);
    assert_int_equal(rt_bytes_put(&buffer, 36, image->data, image->size, NULL), RT_OK);
    FILE *file = fopen("j.gltf", "w");
    assert_non_null(file);
    fprintf(
        file,
        "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0,1]}],"
        "\"nodes\":[{\"mesh\":0},{\"mesh\":1}],\"meshes\":["
        "{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":1},\"material\":0}]},"
        "{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":1},\"material\":1}]}],"
        "\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}},"
        "{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":1}}}],"
        "\"textures\":[{\"source\":0},{\"source\":1}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},"
        "{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC2\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36},"
        "{\"buffer\":0,\"byteOffset\":36,\"byteLength\":%d}],"
        "\"images\":[{\"name\":\"text\",\"uri\":\"data:image/jpeg;base64,",
        (int)image->size);
    write_base64(file, image);
    fprintf(file,
            "\"},{\"name\":\"view\",\"mimeType\":\"image/jpeg\",\"bufferView\":1}],"
            "\"buffers\":[{\"byteLength\":%d,\"uri\":\"data:;base64,",
            (int)buffer.size);
    write_base64(file, &buffer);
    fprintf(file, "\"}]}");
    assert_int_equal(fclose(file), 0);
    rt_bytes_free(&buffer);
}

static void jpegs_within_a_gltf_become_files(void **state)
{
    const jpeg_sample sample = {
        .colours = JPEG_420, .width = 16, .height = 16, .is_progressive = 1};
    (void)state;
    rt_bytes image = jpeg_sample_file(&sample);
    write_gltf_with_images(&image);
    scratch_write_bytes("same.jpg", image.data, image.size);
    expect_rtc(0, "import j.gltf --out j.rts");
    expect_same_files("j_files/text_0.jpg", "same.jpg");
    expect_same_files("j_files/view_5.jpg", "same.jpg");
    expect_in_file("j.rts", "j_files/text_0.jpg");
    expect_in_file("j.rts", "j_files/view_5.jpg");
    expect_rtc(0, "check j.rts");
    rt_bytes_free(&image);
}

/* Of a kind that is not read, it says what converts it. */
static void a_jpeg_of_cmyk_is_told(void **state)
{
    const jpeg_sample sample = {.colours = JPEG_YCCK, .width = 16, .height = 16};
    (void)state;
    rt_bytes image = jpeg_sample_file(&sample);
    write_gltf_with_images(&image);
    run run = run_rtc("import j.gltf --out j.rts");
    expect_status(&run, 0);
    expect_err(&run, "the image text is left out: it has CMYK colours: convert it");
    run_free(&run);
    rt_bytes_free(&image);
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
    expect_rtc(1, "import kept.xml --strict --out made/kept.rts");
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
                               "</shape>\n<shape type=\"merge\" id=\"a\"><ref id=\"a\"/></shape>\n"
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

/* What is named and is not there is told, and the rest of the scene is imported. */
static void what_is_missing_is_told(void **state)
{
    static const struct {
        const char *name, *text, *says;
    } cases[] = {
        {"missing.xml",
         "<scene>\n<shape type=\"obj\"><string name=\"filename\" value=\"no.obj\"/></shape>\n"
         "<shape type=\"sphere\"/></scene>\n",
         "missing.xml:2: 'no.obj' is not there: the mesh is left out"},
        {"missing.xml",
         "<scene>\n<shape type=\"sphere\"><bsdf type=\"diffuse\">\n<texture name=\"reflectance\" "
         "type=\"bitmap\"><string name=\"filename\" value=\"no.png\"/></texture></bsdf></shape>"
         "</scene>\n",
         "missing.xml:3: 'no.png' is not there: the image is left out"},
        {"missing.pbrt",
         "WorldBegin\nShape \"plymesh\" \"string filename\" \"no.ply\"\nShape "
         "\"sphere\"\n",
         "missing.pbrt:2: 'no.ply' is not there: the mesh is left out"},
        {"missing.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/2 3/-2\n",
         "missing.obj:5: texture coordinate 2 of 1 so far is left out"},
        {"missing.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3\n",
         "corners of a mesh without a texture coordinate get 0 0"},
        {"missing.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/1/1 2/1/1 3/1/1\n",
         "missing.obj:4: normal 1 of 0 so far is left out"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        scratch_write(cases[i].name, cases[i].text);
        run run = run_rtc("import %s --out missing.rts", cases[i].name);
        expect_status(&run, 0);
        expect_out(&run, "1 shape,");
        expect_err(&run, cases[i].says);
        run_free(&run);
    }
}

/* What is wrong in a copy of a file is told of that file, rendered or imported. */
static void faults_are_told_of_the_users_files(void **state)
{
    static const char *const commands[] = {"check bad.xml", "import bad.xml --out bad.rts",
                                           "bad.pbrt --out bad.png"};
    (void)state;
    scratch_write("torn.ply", "ply\nformat ascii 1.0\nelement vertex 900\nproperty float x\n"
                              "property float y\nproperty float z\nelement face 1\n"
                              "property list uchar int vertex_indices\nend_header\n0 0 0\n");
    scratch_write("bad.xml", "<scene>\n<shape type=\"ply\"><string name=\"filename\" "
                             "value=\"torn.ply\"/></shape></scene>\n");
    scratch_write("bad.pbrt", "WorldBegin\nShape \"plymesh\" \"string filename\" \"torn.ply\"\n");
    for (size_t i = 0; i < sizeof commands / sizeof *commands; i++) {
        run run = run_rtc(commands[i]);
        expect_status(&run, 1);
        expect_err(&run, "torn.ply:3: element vertex: 900 of them do not fit");
        expect_no_err(&run, "mesh_1.ply:");
        run_free(&run);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(what_is_missing_is_told, scratch_enter, scratch_leave),
        cmocka_unit_test_setup_teardown(faults_are_told_of_the_users_files, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(a_scene_that_was_there_stays, scratch_enter, scratch_leave),
        cmocka_unit_test_setup_teardown(a_failed_import_leaves_the_meshes_of_an_earlier_one,
                                        scratch_enter, scratch_leave),
        cmocka_unit_test_setup_teardown(jpegs_within_a_gltf_become_files, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(a_jpeg_of_cmyk_is_told, scratch_enter, scratch_leave),
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
