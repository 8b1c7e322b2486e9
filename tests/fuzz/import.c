/* import.c - what the targets of imported scenes share. */
#include "fuzz/import.h"

#include <stdlib.h>
#include <string.h>

#include "rt.h"

/* A scene that the formatter would not change. */
static void check_scene(const char *text)
{
    char *again = NULL;
    rt_error error;
    FUZZ_EXPECT(rt_scene_format(&again, text, NULL, NULL, &error) == RT_OK);
    FUZZ_EXPECT(strcmp(again, text) == 0);
    free(again);
}

int fuzz_import_run(const char *name, const uint8_t *data, size_t size,
                    void (*read)(importer *import, const char *bytes, size_t size))
{
    importer import;
    char *copy = malloc(size + 1), *made = NULL;
    FUZZ_EXPECT(copy != NULL);
    memcpy(copy, data, size);
    copy[size] = '\0';
    FUZZ_EXPECT(rt_import_begin(&import, name, "made.rts"));
    import.is_dry = 1;
    import.root = ".";
    read(&import, copy, size);
    if (!import.failed)
        made = rt_import_finish(&import);
    FUZZ_EXPECT(import.failed == (made == NULL));
    if (import.failed)
        fuzz_expect_line(import.error);
    else
        check_scene(made);
    for (size_t i = 0; i < import.note_count; i++)
        fuzz_expect_line(import.notes[i].text);
    int is_good = made != NULL;
    free(made);
    rt_import_end(&import);
    free(copy);
    return is_good;
}

void fuzz_import_begin(void)
{
    static const char obj[] = "mtllib a.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
                      mtl[] = "newmtl m\nKd 0.5 0.5 0.5\n",
                      ply[] = "ply\nformat ascii 1.0\nelement vertex 0\nend_header\n",
                      png[] = "\x89PNG\r\n\x1a\n0000";
    fuzz_write("a.obj", obj, sizeof obj - 1);
    fuzz_write("a.mtl", mtl, sizeof mtl - 1);
    fuzz_write("a.ply", ply, sizeof ply - 1);
    fuzz_write("a.png", png, sizeof png - 1);
}
