/* run.c - which reader a file is for. */
#include <string.h>
#include <strings.h>

#include "import.h"
#include "rt.h"

static int ends_with(const char *path, const char *extension)
{
    size_t length = strlen(path), end = strlen(extension);
    return length > end && strcasecmp(path + length - end, extension) == 0;
}

void import_run(importer *import, const char *bytes, size_t size)
{
    const size_t mark = rt_byte_order_mark(bytes, size);
    bytes += mark;
    size -= mark;
    if (ends_with(import->path, ".glb") || ends_with(import->path, ".gltf"))
        import_gltf(import, bytes, size);
    else if (strlen(bytes) != size)
        import_fail(import, 0, "not a text: it holds a zero byte");
    else if (ends_with(import->path, ".obj"))
        import_obj(import, bytes, size);
    else if (ends_with(import->path, ".xml"))
        import_mitsuba(import, bytes, size);
    else if (ends_with(import->path, ".pbrt"))
        import_pbrt(import, bytes, size);
    else
        import_fail(import, 0,
                    "not a format that is known: the name must end in .gltf, .glb, .obj, .xml "
                    "(Mitsuba 3) or .pbrt");
}
