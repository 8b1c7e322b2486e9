/* test_byte_order_mark.c - texts with a UTF-8 byte order mark are read as those without. */
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
#include "rt.h"
#include "spawn.h"

#define MARK "\xef\xbb\xbf"
#define PLY                                                                                        \
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"                \
    "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"       \
    "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"
#define IMAGE "P3\n2 1\n255\n255 0 0  0 255 0\n"
#define TRIANGLE "v 0 0 0\nv 1 0 0\nv 0 1 0\n"

/* What rtc is told, and the texts that it reads. */
static const struct {
    const char *line;
    struct {
        const char *name, *text;
    } files[3];
} imports[] = {
    {"import a.obj --out out.rts",
     {{"a.obj", "mtllib a.mtl\n" TRIANGLE "vt 0 0\nusemtl a\nf 1/1 2/1 3/1\n"},
      {"a.mtl", "newmtl a\nKd 1 0 0\nmap_Kd a.ppm\n"},
      {"a.ppm", IMAGE}}},
    {"import a.pbrt --out out.rts",
     {{"a.pbrt", "Include \"b.pbrt\"\n"},
      {"b.pbrt", "WorldBegin\nShape \"plymesh\" \"string filename\" \"a.ply\"\n"},
      {"a.ply", PLY}}},
    {"import a.xml --out out.rts",
     {{"a.xml", "<scene><include filename=\"b.xml\"/></scene>"},
      {"b.xml", "<scene><shape type=\"ply\"><string name=\"filename\" value=\"a.ply\"/></shape>"
                "</scene>"},
      {"a.ply", PLY}}},
    {"import a.xml --out out.rts",
     {{"a.xml", "<scene><shape type=\"obj\"><string name=\"filename\" value=\"a.obj\"/></shape>"
                "</scene>"},
      {"a.obj", TRIANGLE "f 1 2 3\n"}}},
    {"import a.gltf --out out.rts",
     {{"a.gltf",
       "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
       "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"accessors\":[{"
       "\"bufferView\":0,\"componentType\":5121,\"type\":\"VEC3\",\"count\":3}],"
       "\"bufferViews\":[{\"buffer\":0,\"byteLength\":9}],\"buffers\":[{\"byteLength\":9,"
       "\"uri\":\"data:;base64,AAAAAQAAAAEA\"}]}"}}},
    {"a.rts --dump",
     {{"a.rts", "include \"b.rts\"\n"},
      {"b.rts", "material a { kd 0.5 }\nsphere { centre 0 0 0 radius 1 material a }\n"}}},
};

/* The scene that is written: from texts with the mark or without. */
static char *make(size_t i, const char *mark)
{
    char text[2048];
    for (size_t k = 0; k < 3 && imports[i].files[k].name; k++) {
        snprintf(text, sizeof text, "%s%s", mark, imports[i].files[k].text);
        scratch_write(imports[i].files[k].name, text);
    }
    run run = run_rtc("%s", imports[i].line);
    expect_status(&run, 0);
    if (!strstr(imports[i].line, "--out"))
        scratch_write("out.rts", run.out);
    run_free(&run);
    return scratch_read("out.rts");
}

static void scenes_are_read_without_their_mark(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof imports / sizeof *imports; i++) {
        char *const bare = make(i, ""), *const marked = make(i, MARK);
        assert_string_equal(bare, marked);
        free(bare);
        free(marked);
    }
}

static void images_in_text_are_read_without_their_mark(void **state)
{
    float rgb[6];
    rt_image *image;
    rt_error error;
    (void)state;
    scratch_write("a.ppm", MARK IMAGE);
    assert_int_equal(rt_image_read(&image, "a.ppm", &error), RT_OK);
    assert_int_equal(rt_image_get_rgb(rgb, image, NULL, &error), RT_OK);
    assert_true(rgb[0] == 1 && rgb[1] == 0 && rgb[4] == 1);
    rt_image_destroy(image);
}

/* Points and lists of studies: what follows the first line of them is told. */
static void lists_are_read_without_their_mark(void **state)
{
    (void)state;
    scratch_write("s.rts", "camera { eye 0 1 5  look_at 0 0 0 }\nmaterial a { kd 0.5 }\n"
                           "light point { position 0 1 0  intensity 2 }\n"
                           "quad { corner -1 0 -1  edge1 0 0 2  edge2 2 0 0  material a }\n");
    scratch_write("p.txt", MARK "0 0 0\r\n");
    run run = run_rtc("photons s.rts --photons 1000 --direct photons --quiet --out s.rtp");
    expect_status(&run, 0);
    run_free(&run);
    run = run_rtc("photons illuminance s.rtp p.txt");
    expect_status(&run, 0);
    expect_out(&run, "\n0 0 0 ");
    run_free(&run);
    scratch_write("l.studies", MARK "== one One\r\n$ s.rts --sweep spp=1 --width 4 --height 2\r\n");
    run = run_rtc("study --list l.studies");
    expect_status(&run, 0);
    run_free(&run);
    expect_in_file("l.one.csv", "--width 4 --height 2\n");
}

/* The mark is no text of its own, and half of it no mark. */
static void a_mark_is_three_bytes(void **state)
{
    (void)state;
    assert_int_equal(rt_byte_order_mark(MARK "a", 4), 3);
    assert_int_equal(rt_byte_order_mark(MARK, 3), 3);
    assert_int_equal(rt_byte_order_mark(MARK, 2), 0);
    assert_int_equal(rt_byte_order_mark("a" MARK, 4), 0);
    assert_int_equal(rt_byte_order_mark(NULL, 0), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_mark_is_three_bytes),
        cmocka_unit_test_setup_teardown(scenes_are_read_without_their_mark, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(images_in_text_are_read_without_their_mark, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(lists_are_read_without_their_mark, scratch_enter,
                                        scratch_leave),
    };
    if (spawn_find_rtc() != 0)
        return 1;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
