/* scene_files.c - writes small files of every format that scenes read. */
#include "faults/scene_files.h"

#include "lib/image/scratch.h"
#include "rt.h"

int scene_files_enter(void **state)
{
    static const char *const names[] = {"a.png", "a.exr", "a.pfm", "a.ppm"};
    const float rgb[12] = {0.2f, 0.3f, 0.4f, 0.5f, 0.6f, 0.7f, 0.3f, 0.2f, 0.5f, 0.1f, 0.4f, 0.6f};
    rt_image *image = NULL;
    if (scratch_enter(state) != 0 || rt_image_from_rgb(&image, rgb, 2, 2, NULL) != RT_OK)
        return -1;
    int code = 0;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (rt_image_write(image, names[i], NULL, NULL) != RT_OK)
            code = -1;
    rt_image_destroy(image);
    scratch_write("a.obj", "v -2 3 1\nv 2 3 1\nv 0 4 2\nv 0 3 3\nf 1 2 3\nf 1 3 4\nf 2 4 3\n");
    scratch_write("a.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                           "property float y\nproperty float z\nelement face 1\n"
                           "property list uchar int vertex_indices\nend_header\n"
                           "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    scratch_write("a.off", "OFF\n3 1 0\n0 0 1\n-1 0 1\n0 1 1\n3 0 1 2\n");
    scratch_write("a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 2\n"
                           "vertex 1 2 2\nvertex 0 2 2\nendloop\nendfacet\nendsolid a\n");
    scratch_write("materials.rts", "texture picture { file \"a.ppm\" }\n"
                                   "material paper { kd_texture picture }\n"
                                   "material glass { kt 1  ior 1.5  fresnel dielectric }\n");
    return code;
}
