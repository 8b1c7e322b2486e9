/* run.c - which reader a file is for. */
#include <string.h>
#include <strings.h>

#include "dsl/import/import.h"
#include "rt.h"

static int ends_with(const char *path, const char *extension)
{
    size_t length = strlen(path), end = strlen(extension);
    return length > end && strcasecmp(path + length - end, extension) == 0;
}

/* The extension of a mesh, or NULL. */
static const char *mesh_extension(const char *path)
{
    static const char *const extensions[] = {".ply", ".stl", ".off"};
    for (size_t i = 0; i < sizeof extensions / sizeof *extensions; i++)
        if (ends_with(path, extensions[i]))
            return extensions[i];
    return NULL;
}

void rt_import_run(importer *import, char *bytes, size_t size)
{
    const size_t mark = rt_byte_order_mark(bytes, size);
    bytes += mark;
    size -= mark;
    if (ends_with(import->path, ".glb") || ends_with(import->path, ".gltf"))
        rt_import_gltf(import, bytes, size);
    else if (mesh_extension(import->path))
        rt_import_bare_mesh(import, mesh_extension(import->path), bytes, size);
    else if (strlen(bytes) != size)
        rt_import_fail(import, 0, "not a text: it holds a zero byte");
    else if (ends_with(import->path, ".obj"))
        rt_import_obj(import, bytes, size);
    else if (ends_with(import->path, ".xml"))
        rt_import_mitsuba(import, bytes, size);
    else if (ends_with(import->path, ".pbrt"))
        rt_import_pbrt(import, bytes, size);
    else
        rt_import_fail(import, 0,
                       "not a format that is known: the name must end in .gltf, .glb, .obj, .xml "
                       "(Mitsuba 3), .pbrt, .ply, .stl or .off");
    rt_import_check_parameters(import);
    rt_import_check_camera(import);
}
