/* target_obj.c - Wavefront OBJ files. */
#include "fuzz/mesh.h"
#include "fuzz/targets.h"

static int run(const uint8_t *data, size_t size)
{
    return fuzz_mesh_run("a.obj", data, size, 1);
}

static void seed(fuzz_inputs *seeds)
{
    fuzz_add_text(seeds, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    fuzz_add_text(seeds, "mtllib a\nv 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1\nv 0 1 0 1 1 1\n"
                         "vt 0 0\nvt 1 1 0\nvn 0 0 1\nusemtl b\nf 1/1/1 2/2/1 3/1/1 4//1\n"
                         "f -4 -3 \\\n -2\nf 1/2 2/1 3/1\n");
    fuzz_add_text(seeds, "# all\no a\ng b\ns off\nv 0 0 0 1\nv 1e0 0.5 -.25\nv +2. 3 4\r\n"
                         "vt 0.5\nvn 0 0 0\nl 1 2\np 1\ncurv 0 1\nf 1//1 2//-1 3//1 1 2 # end\n");
    fuzz_add_text(seeds, "\xef\xbb\xbfv 5e6 0 0\nv 5e6 3 0\nv 5000003.1 3 0\nv 5000003 0 0 .5 1 0\n"
                         "v 5000001 1 0\nv 5000001 2 0\nv 5000002 2 0\nv 5000002 1 0\n"
                         "vn nan 0 1\nvn 0 0 1\nf 1 2 3 4 1 5 6 7 8 5\nf 1//1 3//2 2//1 4//1\n"
                         "f 6 2 3 7\nf 1 1 1 1\nf 2 8 6 7 5 1\n");
    fuzz_add_text(seeds, "v 0 0 0\rv 1 0 0\rv 0 1 0\rv 0 0 0\rf 1 2 3\rf 1 2\rf 1 1 4\r");
}

const fuzz_target fuzz_target_obj = {
    .name = "obj",
    .sources = "lib/mesh/obj.c lib/mesh/text* lib/mesh/fields* lib/mesh/unique*",
    .run = run,
    .seed = seed,
    .size_max = 4096,
    .tries = 20000,
};
