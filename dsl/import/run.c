/* run.c - which reader a file is for. */
#include <string.h>
#include <strings.h>

#include "dsl/import/import.h"
#include "rt.h"

/* By the end of a file's name; a reader NULL is that of bare meshes. */
static const struct format {
    const char *extension;
    void (*read)(importer *import, const char *bytes, size_t size);
    int is_text;
} formats[] = {
    {".gltf", rt_import_gltf, 0},
    {".glb", rt_import_gltf, 0},
    {".obj", rt_import_obj, 1},
    {".xml", rt_import_mitsuba, 1},
    {".pbrt", rt_import_pbrt, 1},
    {".ply", NULL, 0},
    {".stl", NULL, 0},
    {".off", NULL, 0},
};

static const struct format *format_of(const char *path)
{
    const size_t length = path ? strlen(path) : 0;
    for (size_t i = 0; i < sizeof formats / sizeof *formats; i++) {
        const size_t end = strlen(formats[i].extension);
        if (length > end && strcasecmp(path + length - end, formats[i].extension) == 0)
            return formats + i;
    }
    return NULL;
}

int rt_path_is_foreign(const char *path)
{
    return format_of(path) != NULL;
}

void rt_import_run(importer *import, char *bytes, size_t size)
{
    const struct format *const format = format_of(import->path);
    const size_t mark = rt_byte_order_mark(bytes, size);
    bytes += mark;
    size -= mark;
    if (!format)
        rt_import_fail(import, 0,
                       "not a format that is known: the name must end in .gltf, .glb, .obj, .xml "
                       "(Mitsuba), .pbrt, .ply, .stl or .off");
    else if (format->is_text && strlen(bytes) != size)
        rt_import_fail(import, 0, "not a text: it holds a zero byte");
    else if (format->read)
        format->read(import, bytes, size);
    else
        rt_import_bare_mesh(import, format->extension, bytes, size);
    rt_import_check_parameters(import);
    rt_import_check_camera(import);
}
