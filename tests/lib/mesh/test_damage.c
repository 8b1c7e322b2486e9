/*
 * Damaged files of every format: seeds made here, changed by a fixed sequence of random edits.
 * Whatever comes, the reader accepts or refuses; it never crashes, hangs, or lets an index or a
 * number out of range through (sample_read checks that). The sequence is the same in each run.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "lib/image/scratch.h"
#include "lib/mesh/sample.h"

enum { variants = 3000, edits_max = 4 };

static uint32_t random_state;

static uint32_t below(uint32_t limit)
{
    /* Numerical Recipes' linear congruential generator; its high bits are the random ones. */
    random_state = random_state * 1664525u + 1013904223u;
    return (uint32_t)((uint64_t)random_state * limit >> 32);
}

/* What breaks readers: numbers at the edges of types, words of the formats, line ends. */
static const char *const words[] = {
    "-1",   "4294967295", "4294967296", "2147483648", "1e39",   "nan",      "0",          "255",
    "list", "float",      "uchar",      "element",    "\n",     "\r",       "end_header", " ",
    "/",    "\\\n",       "#",          "facet",      "vertex", "property", "1000000000", "\0"};

static void replace(sample *s, size_t at, size_t gone, const void *with, size_t size)
{
    sample changed = {0};
    sample_bytes(&changed, s->data, at);
    sample_bytes(&changed, with, size);
    sample_bytes(&changed, s->data + at + gone, s->size - at - gone);
    sample_free(s);
    *s = changed;
}

static void edit(sample *s)
{
    size_t at = below((uint32_t)s->size), left = s->size - at;
    size_t length = 1 + below(left < 8 ? (uint32_t)left : 8);
    const char *word = words[below(sizeof words / sizeof *words)];
    unsigned char byte = (unsigned char)below(256);
    switch (below(6)) {
    case 0:
        s->data[at] ^= (unsigned char)(1u << below(8));
        break;
    case 1:
        s->data[at] = byte;
        break;
    case 2:
        replace(s, at, length, "", 0);
        break;
    case 3:
        replace(s, at, 0, word, *word ? strlen(word) : 1);
        break;
    case 4:
        replace(s, at, length, word, *word ? strlen(word) : 1);
        break;
    case 5:
        replace(s, at, left, "", 0);
        break;
    }
}

static void damage(const sample *seed, const char *name)
{
    int accepted = 0, refused = 0;
    random_state = 12345;
    for (int i = 0; i < variants; i++) {
        sample s = {0};
        rt_mesh *mesh;
        rt_error error;
        sample_bytes(&s, seed->data, seed->size);
        for (uint32_t n = 1 + below(edits_max); n > 0 && s.size > 0; n--)
            edit(&s);
        rt_status status = sample_read(&mesh, &s, name, &error);
        assert_true(status == RT_OK || status == RT_ERROR_INPUT);
        *(status == RT_OK ? &accepted : &refused) += 1;
        rt_mesh_destroy(mesh);
        sample_free(&s);
    }
    /* Both happen: the seeds are sound, and the edits do harm. */
    assert_true(accepted > 10);
    assert_true(refused > 10);
}

static void damage_text(const char *text, const char *name)
{
    sample s = {0};
    sample_text(&s, text);
    damage(&s, name);
    sample_free(&s);
}

#define BODY                                                                                       \
    "comment TextureFile a b.png\nelement vertex 4\nproperty float x\nproperty float y\nproperty " \
    "double z\n"                                                                                   \
    "property float nx\nproperty float ny\nproperty float nz\nproperty float s\nproperty float "   \
    "t\nproperty uchar "                                                                           \
    "red\n"                                                                                        \
    "property uchar green\nproperty uchar blue\nelement face 2\nproperty list uchar int "          \
    "vertex_indices\n"                                                                             \
    "property list uchar float texcoord\nelement tristrips 1\nproperty list int int "              \
    "vertex_indices\n"
#define CORNERS                                                                                    \
    "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"     \
    "property list uchar int vertex_indices\nproperty list uchar float texcoord\nend_header\n"

static void damaged_ascii_ply(void **state)
{
    (void)state;
    damage_text("ply\nformat ascii 1.0\n" BODY
                "end_header\n0 0 0 0 0 1 0 0 255 0 0\n1 0 0 0 0 1 1 0 0 255 0\n"
                "1 1 0 0 0 1 1 1 0 0 255\n0 1 0 0 0 1 0 1 9 9 9\n3 0 1 2 6 0 0 1 0 1 1\n4 0 1 2 3 "
                "0\n6 0 1 2 -1 3 2\n",
                "a.ply");
    damage_text("ply\nformat ascii 1.0\n" CORNERS "0 0 0\n1 0 0\n0 1 0\n3 0 1 2 6 0 0 1 0 1 1\n",
                "a.ply");
}

static void damaged_binary_ply(void **state)
{
    (void)state;
    for (int big = 0; big < 2; big++) {
        sample s = {0};
        sample_text(&s, big ? "ply\nformat binary_big_endian 1.0\n"
                            : "ply\nformat binary_little_endian 1.0\n");
        sample_text(&s, BODY "end_header\n");
        for (unsigned vertex = 0; vertex < 4; vertex++) {
            sample_f32(&s, (float)vertex, big);
            sample_f32(&s, (float)(vertex * vertex), big);
            sample_f64(&s, 0.5 * vertex, big);
            for (int i = 0; i < 5; i++)
                sample_f32(&s, 0.25f * (float)i, big);
            for (unsigned i = 0; i < 3; i++)
                sample_u8(&s, 60 * i + vertex);
        }
        for (unsigned face = 0; face < 2; face++) {
            sample_u8(&s, 3 + face);
            for (unsigned i = 0; i < 3 + face; i++)
                sample_u32(&s, i, big);
            sample_u8(&s, 0);
        }
        sample_u32(&s, 5, big);
        for (unsigned i = 0; i < 5; i++)
            sample_u32(&s, i == 3 ? 0xffffffff : i % 4, big);
        damage(&s, "a.ply");
        sample_free(&s);
    }
}

static void damaged_obj(void **state)
{
    (void)state;
    damage_text("mtllib a\nv 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1\nv 0 1 0 1 1 1\nvt 0 0\nvt "
                "1 1\nvn 0 0 1\n"
                "usemtl b\nf 1/1/1 2/2/1 3/1/1 4//1\nf -4 -3 \\\n -2\nf 1/2 2/1 3/1\n",
                "a.obj");
}

static void damaged_off(void **state)
{
    (void)state;
    damage_text("STCNOFF\n# all\n4 2 0\n0 0 0 0 0 1 255 0 0 0 0\n1 0 0 0 0 1 0 1.0 0 1 0\n1 1 0 0 "
                "0 1 0 0 255 1 1 1\n"
                "0 1 0 0 0 1 9 9 9 0 1\n4 0 1 2 3 1.0 0 0\n3 0 1 2\n",
                "a.off");
}

static void damaged_stl(void **state)
{
    (void)state;
    damage_text("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
                "0\nendloop\nendfacet\n"
                "facet normal 0 0 1\nouter loop\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 "
                "0\nendloop\nendfacet\nendsolid a\n",
                "a.stl");
    sample s = {0};
    for (unsigned i = 0; i < 80; i++)
        sample_u8(&s, i);
    sample_u32(&s, 3, 0);
    for (unsigned facet = 0; facet < 3; facet++) {
        for (unsigned i = 0; i < 12; i++)
            sample_f32(&s, (float)(facet * i % 5), 0);
        sample_u16(&s, 0, 0);
    }
    damage(&s, "a.stl");
    sample_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(damaged_ascii_ply), cmocka_unit_test(damaged_binary_ply),
        cmocka_unit_test(damaged_obj),       cmocka_unit_test(damaged_off),
        cmocka_unit_test(damaged_stl),
    };
    return cmocka_run_group_tests_name("mesh/damage", tests, scratch_enter, scratch_leave);
}
