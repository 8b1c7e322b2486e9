/* bare_mesh.c - a mesh alone, as a scene: PLY, STL and OFF files. */
#include <string.h>

#include "dsl/import/import.h"
#include "dsl/import/ply.h"

/* The file as it is, where the scene can name it there, or a copy of it. */
static int copy_file(importer *import, char out[512], const char *extension, char *bytes,
                     size_t size)
{
    if (strcmp(extension, ".ply") == 0)
        return rt_import_ply_write(import, 0, out, bytes, size, IMPORT_COLOURS_KEPT, NULL);
    const int is_written = rt_import_write(import, out, "mesh", extension, bytes, size);
    if (is_written)
        rt_import_keep_copy(import, out);
    return is_written;
}

void rt_import_bare_mesh(importer *import, const char *extension, char *bytes, size_t size)
{
    char file[512];
    rt_scene *scene = NULL;
    rt_mesh_info info;
    rt_error error;
    uint32_t mesh;
    import_surface surface = {.texture = IMPORT_NONE, .to_world = rt_matrix_identity()};
    rt_status status = rt_scene_create(&scene, &error);
    if (status == RT_OK)
        status = rt_scene_load_mesh(scene, &mesh, import->path, RT_SHADING_FILE, &info, &error);
    rt_scene_destroy(scene);
    if (status != RT_OK && error.line > 0) {
        rt_import_fail(import, error.line, "%s", error.message);
    } else if (status != RT_OK) {
        rt_import_fail(import, 0, "%s", error.message);
    } else if (copy_file(import, file, extension, bytes, size)) {
        import_material m = rt_import_material_begin();
        double lo[3], hi[3];
        for (int c = 0; c < 3; c++) {
            m.kd[c] = info.has_colours ? 1 : 0.5;
            lo[c] = info.lo[c];
            hi[c] = info.hi[c];
        }
        surface.material =
            rt_import_add_material(import, 0, info.has_colours ? "white" : "grey", &m);
        const int handle = rt_import_add_mesh_file(import, "mesh", file, NULL);
        if (rt_import_add_instance(import, 0, handle, &surface))
            rt_import_bound(import, &surface.to_world, lo, hi);
    }
}
