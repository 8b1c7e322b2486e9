/*
 * test_import_sheets.c - glass of Blender, which has an inside where its mesh closes, and is a thin
 * sheet where that does not: of glTF and of OBJ files.
 */
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

#define BLENDER "Khronos glTF Blender I/O v4.5.51"

/* The corners of a tetrahedron, whose faces look outwards, and of a triangle beside it. */
static const float corners[5][9] = {{0, 0, 0, 0, 1, 0, 1, 0, 0},
                                    {0, 0, 0, 1, 0, 0, 0, 0, 1},
                                    {0, 0, 0, 0, 0, 1, 0, 1, 0},
                                    {1, 0, 0, 0, 1, 0, 0, 0, 1},
                                    {5, 0, 0, 6, 0, 0, 5, 1, 0}};

/* What of them is glass, and what is of another material: numbers, as "0123". */
typedef struct layout {
    const char *glass, *other;
    int has_solid, has_sheet, is_open; /* what the glass becomes */
} layout;

static const layout layouts[] = {
    {"0123", "", 1, 0, 0},  /* closed */
    {"4", "", 0, 1, 0},     /* a pane */
    {"01234", "", 1, 1, 0}, /* both */
    {"012", "3", 1, 0, 0},  /* another material closes it */
    {"012", "4", 1, 0, 1},  /* none does, but light may cross it twice */
};

/* A file whose corners are all vertices of their own. */
static void write_gltf(const layout *l, const char *maker, const char *base, double roughness,
                       double transmission)
{
    unsigned char bytes[5 * 36];
    char text[2048];
    size_t glass = 36 * strlen(l->glass), other = 36 * strlen(l->other);
    for (size_t i = 0; i < strlen(l->glass); i++)
        memcpy(bytes + 36 * i, corners[l->glass[i] - '0'], 36);
    for (size_t i = 0; i < strlen(l->other); i++)
        memcpy(bytes + glass + 36 * i, corners[l->other[i] - '0'], 36);
    scratch_write_bytes("m.bin", bytes, glass + other);
    snprintf(text, sizeof text,
             "{\"asset\":{\"version\":\"2.0\",\"generator\":\"%s\"},\"materials\":"
             "[{\"name\":\"pane\",\"pbrMetallicRoughness\":{\"metallicFactor\":0,"
             "\"roughnessFactor\":%g,\"baseColorFactor\":[%s]},\"extensions\":"
             "{\"KHR_materials_transmission\":{\"transmissionFactor\":%g}}},{}],"
             "\"buffers\":[{\"byteLength\":%lu,\"uri\":\"m.bin\"}],\"bufferViews\":"
             "[{\"buffer\":0,\"byteLength\":%lu}%s",
             maker, roughness, base, transmission, (unsigned long)(glass + other),
             (unsigned long)glass, other ? "," : "");
    size_t at = strlen(text);
    if (other)
        at += (size_t)snprintf(text + at, sizeof text - at,
                               "{\"buffer\":0,\"byteOffset\":%lu,\"byteLength\":%lu}",
                               (unsigned long)glass, (unsigned long)other);
    at += (size_t)snprintf(text + at, sizeof text - at, "],\"accessors\":[");
    for (int i = 0; i < 1 + (other > 0); i++)
        at += (size_t)snprintf(text + at, sizeof text - at,
                               "%s{\"bufferView\":%d,\"componentType\":5126,\"count\":%lu,"
                               "\"type\":\"VEC3\"}",
                               i ? "," : "", i, (unsigned long)((i ? other : glass) / 12));
    snprintf(text + at, sizeof text - at,
             "],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"material\":0}%s]}],"
             "\"nodes\":[{\"mesh\":0}],\"scenes\":[{\"nodes\":[0]}],\"scene\":0}",
             other ? ",{\"attributes\":{\"POSITION\":1},\"material\":1}" : "");
    scratch_write("m.gltf", text);
}

static void write_obj(const layout *l, const char *maker, const char *kd, double transmission)
{
    char text[2048] = "mtllib m.mtl\n";
    for (int i = 0; i < 5; i++)
        for (int c = 0; c < 3; c++)
            sprintf(text + strlen(text), "v %g %g %g\n", corners[i][3 * c], corners[i][3 * c + 1],
                    corners[i][3 * c + 2]);
    for (int k = 0; k < 2; k++) {
        const char *const faces = k ? l->other : l->glass;
        sprintf(text + strlen(text), "usemtl %s\n", k ? "other" : "pane");
        for (size_t i = 0; i < strlen(faces); i++) {
            const int first = 3 * (faces[i] - '0') + 1;
            sprintf(text + strlen(text), "f %d %d %d\n", first, first + 1, first + 2);
        }
    }
    scratch_write("m.obj", text);
    snprintf(text, sizeof text,
             "# %s 4.5.0 MTL File\nnewmtl pane\nKd %s\nKs 0.5 0.5 0.5\nNi 1.5\nd 1\nillum 2\n"
             "Pr 0\nPm 0\nTf %g\nnewmtl other\nKd 0.5 0.5 0.5\nPr 1\n",
             maker, kd, transmission);
    scratch_write("m.mtl", text);
}

/* Imports a file; says which kinds of glass instances there are. */
static void expect_kinds(const char *file, const layout *l)
{
    char command[64];
    snprintf(command, sizeof command, "import %s --out m.rts", file);
    run run = run_rtc(command);
    expect_status(&run, 0);
    if (l->has_sheet)
        expect_err(&run, "where its mesh has one side it became a thin sheet");
    else
        expect_no_err(&run, "thin sheet");
    if (l->is_open)
        expect_err(&run, "a mesh of glass does not close");
    else
        expect_no_err(&run, "does not close");
    run_free(&run);
    if (l->has_sheet)
        expect_in_file("m.rts", "thin true");
    else
        expect_not_in_file("m.rts", "thin");
    if (l->has_solid)
        expect_in_file("m.rts", "{ kt 1 1 1  fresnel dielectric  ior 1.5");
    expect_rtc(0, "check m.rts");
}

static void glass_is_a_sheet_where_it_does_not_close(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof layouts / sizeof *layouts; i++) {
        write_gltf(&layouts[i], BLENDER, "1,1,1,1", 0, 1);
        expect_kinds("m.gltf", &layouts[i]);
        if (!layouts[i].has_solid)
            expect_not_in_file("m.rts", "kt");
        write_obj(&layouts[i], "Blender", "1 1 1", 1);
        expect_kinds("m.obj", &layouts[i]);
    }
}

/* A sheet lets light through as one face of the solid does. */
static void what_the_glass_becomes(void **state)
{
    static const struct {
        int layout;
        const char *maker, *base;
        double roughness;
        const char *becomes;
    } cases[] = {
        {0, BLENDER, "1,1,1,1", 0, "{ kt 1 1 1  fresnel dielectric  ior 1.5 }"},
        {0, BLENDER, "0.5,0.25,1,1", 0.5,
         "{ roughness 0.5  base_color 0.5 0.25 1  spec_trans 1  ior 1.5 }"},
        {1, BLENDER, "0.25,1,1,1", 0.5,
         "{ roughness 0.5  base_color 0.5 1 1  spec_trans 1  ior 1.5  thin true }"},
        {1, BLENDER, "1,1,1,1", 0.25, "{ roughness 0.25  base_color 1 1 1  spec_trans 1"},
        {0, "another", "1,1,1,1", 0, "{ kt 1 1 1  fresnel dielectric  ior 1.5  thin true }"}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        write_gltf(&layouts[cases[i].layout], cases[i].maker, cases[i].base, cases[i].roughness, 1);
        expect_rtc(0, "import m.gltf --out m.rts");
        expect_in_file("m.rts", cases[i].becomes);
        expect_rtc(0, "check m.rts");
    }
}

/* The colour of what is opaque in part is its own, and its glass has the root of that. */
static void a_sheet_in_part_is_a_blend(void **state)
{
    (void)state;
    for (int is_obj = 0; is_obj < 2; is_obj++) {
        write_gltf(&layouts[1], BLENDER, "0.25,1,1,1", 0.5, 0.75);
        write_obj(&layouts[1], "Blender", "0.25 1 1", 0.75);
        expect_rtc(0, is_obj ? "import m.obj --out m.rts" : "import m.gltf --out m.rts");
        expect_in_file("m.rts", "0.25 1 1");
        expect_in_file("m.rts", "base_color 0.5 1 1");
        expect_in_file("m.rts", "thin true");
        expect_in_file("m.rts", "weight 0.75 }");
        expect_rtc(0, "check m.rts");
    }
}

/* Only Blender's: others say what they mean. */
static void glass_of_others_stays_as_it_is(void **state)
{
    (void)state;
    write_obj(&layouts[1], "3ds", "1 1 1", 1);
    expect_rtc(0, "import m.obj --out m.rts");
    expect_not_in_file("m.rts", "thin");
}

int main(void)
{
#define IN_SCRATCH(test) cmocka_unit_test_setup_teardown(test, scratch_enter, scratch_leave)
    const struct CMUnitTest tests[] = {
        IN_SCRATCH(glass_is_a_sheet_where_it_does_not_close),
        IN_SCRATCH(what_the_glass_becomes),
        IN_SCRATCH(a_sheet_in_part_is_a_blend),
        IN_SCRATCH(glass_of_others_stays_as_it_is),
    };
    if (spawn_find_rtc() != 0)
        return 1;
    return cmocka_run_group_tests_name("import_sheets", tests, NULL, NULL);
}
