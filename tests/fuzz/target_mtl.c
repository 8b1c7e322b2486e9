/* target_mtl.c - the materials of OBJ files, and OBJ files that are imported with theirs. */
#include <stdlib.h>
#include <string.h>

#include "fuzz/import.h"
#include "fuzz/targets.h"
#include "dsl/import/mtl.h"

/* Materials, where the text has some; else an OBJ file. */
static void read(importer *import, const char *text, size_t size)
{
    mtl_list list;
    memset(&list, 0, sizeof list);
    if (!strstr(text, "newmtl")) {
        rt_import_obj(import, text, size);
        return;
    }
    char *copy = malloc(size + 1);
    FUZZ_EXPECT(copy != NULL);
    memcpy(copy, text, size + 1);
    rt_mtl_read(import, &list, "a.mtl", copy);
    for (size_t i = 0; i < list.names.count; i++)
        FUZZ_EXPECT(import->failed ||
                    rt_mtl_find(import, &list, list.names.names[i]) != IMPORT_NONE);
    rt_mtl_free(&list);
    free(copy);
}

static int run(const uint8_t *data, size_t size)
{
    return fuzz_import_run("a.obj", data, size, read);
}

static void seed(fuzz_inputs *seeds)
{
    fuzz_add_text(seeds, "newmtl a\nKd 0.5 0.4 0.3\nKs 0.2\nNs 100\nd 0.5\nillum 2\n"
                         "map_Kd -s 2 2 1 -o 0.5 -clamp on a.png\n"
                         "newmtl b\nillum 7\nNi 1.5\nTf 1 1 1\n"
                         "newmtl c\nPr 0.3\nPm 1\nKe 1 2 3\nmap_Ke a.png\nbump -bm 2 a.png\n"
                         "Tr 0.25\nKd spectral a.rfl\n");
    fuzz_add_text(seeds, "newmtl a b # c\nmap_Kd a.png # d\nPc 0\nnewmtl #1\nKd 0 0 0\nillum 5\n"
                         "map_Kd a.png\nPm 0.5\nmap_Ke a.png\n");
    fuzz_add_text(seeds, "mtllib a.mtl b c.mtl # d\nv 0 0 0 1 0 0\nv 1 0 0\n"
                         "v 0 1 0 0 0.5 1 1\nusemtl a b # c\nf 1 2 3\nusemtl #1\nf 3 2 1\n");
    fuzz_add_text(seeds, "mtllib a.mtl\no cube\nv 0 0 0\nv 1 0 0\nv 0 1 \\\n0\nvt 0 0\n"
                         "vn 0 0 1\nusemtl m\nf 1/1/1 2/1/1 3/1/1\nusemtl n\nf -3//1 -2//1 -1//1\n"
                         "s off\nf 1 2 3\nl 1 2\n");
}

const fuzz_target fuzz_target_mtl = {
    .name = "mtl",
    .sources = "dsl/import/mtl*.c dsl/import/names.c dsl/import/obj*.c",
    .run = run,
    .seed = seed,
    .begin = fuzz_import_begin,
    .size_max = 4096,
    .tries = 3000,
};
