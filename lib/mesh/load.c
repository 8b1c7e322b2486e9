/* load.c - reads a file, hands its canonical form to OpenMesh and completes the normals. */
#include "mesh/load.h"

#include <string.h>
#include <strings.h>

#include "base/file.h"
#include "mesh/canonical.h"
#include "mesh/formats.h"
#include "mesh/normals.h"
#include "mesh/openmesh.h"
#include "rt/field.h"

static rt_status read_file(rt_bytes *bytes, const char *path, rt_error *error)
{
    rt_status status = rt_file_check_regular(path, error);
    return status == RT_OK ? rt_file_read(bytes, path, SIZE_MAX / 4, error) : status;
}

typedef rt_status reader(rt_canonical *mesh, const rt_mesh_source *source);

static const struct {
    const char *ending;
    reader *read;
} formats[] = {
    {".ply", rt_ply_read}, {".obj", rt_obj_read}, {".off", rt_off_read}, {".stl", rt_stl_read}};

/* Passes over a byte order mark; a binary STL begins with any bytes. */
static void skip_mark(rt_mesh_source *source)
{
    const size_t mark = rt_byte_order_mark(source->data, source->size);
    if (mark == 0 || rt_stl_is_binary(source))
        return;
    source->data += mark;
    source->size -= mark;
}

/* By the content where it says so, else by the ending of the name. */
static reader *find_reader(const rt_mesh_source *source)
{
    const char *dot = strrchr(source->path, '.');
    if (rt_ply_is(source->data, source->size))
        return rt_ply_read;
    for (size_t i = 0; dot && i < sizeof formats / sizeof *formats; i++)
        if (strcasecmp(dot, formats[i].ending) == 0)
            return formats[i].read;
    return NULL;
}

/* Our own reader goes through the file; nothing is left of it afterwards but the canonical form. */
static rt_status read_canonical(rt_canonical *canonical, const char *path,
                                rt_stage_progress *progress, rt_error *error)
{
    rt_bytes bytes = {.memory = canonical->memory};
    rt_status status = read_file(&bytes, path, error);
    if (status != RT_OK)
        return status;
    /* An empty file has no bytes to point at. */
    const uint8_t *data = bytes.data ? bytes.data : (const uint8_t *)"";
    rt_mesh_source source = {path, data, bytes.size, progress, error, canonical->memory};
    skip_mark(&source);
    reader *read = find_reader(&source);
    status =
        read ? read(canonical, &source)
             : rt_mesh_fail(&source, 0, "unknown mesh format; PLY, OBJ, OFF and STL can be read");
    if (status == RT_OK)
        rt_canonical_settle(canonical, &source);
    if (status == RT_OK && canonical->skipped_faces)
        rt_mesh_log(
            &source,
            "%llu of %llu faces have fewer than three corners, thus no area, and are left out; "
            "the first is face %llu, counted from 0",
            (unsigned long long)canonical->skipped_faces, (unsigned long long)canonical->file_faces,
            (unsigned long long)canonical->first_skipped);
    rt_bytes_free(&bytes);
    return status;
}

/* What is left to do once the arrays are there. */
static rt_status finish(rt_mesh *mesh, const char *path, const rt_hooks *hooks, rt_error *error)
{
    uint64_t replaced = 0;
    rt_status status = mesh->normals ? rt_normals_repair(mesh, &replaced, error) : RT_OK;
    if (replaced)
        rt_log(hooks, "%s: %llu normals have no length and are made from the faces around", path,
               (unsigned long long)replaced);
    mesh->zero_area = rt_normals_zero_area(mesh);
    if (mesh->zero_area)
        rt_log(hooks, "%s: %llu of %u triangles have no area", path,
               (unsigned long long)mesh->zero_area, mesh->triangle_count);
    rt_log(hooks,
           "%s: %llu vertices and %llu faces in the file, %u vertices and %u triangles in the mesh",
           path, (unsigned long long)mesh->file_vertices, (unsigned long long)mesh->file_faces,
           mesh->vertex_count, mesh->triangle_count);
    return status;
}

rt_status rt_mesh_load(rt_mesh **out, const char *path, const rt_hooks *hooks, rt_error *error)
{
    return rt_mesh_load_in(out, path, NULL, hooks, error);
}

rt_status rt_mesh_load_in(rt_mesh **out, const char *path, rt_memory *memory, const rt_hooks *hooks,
                          rt_error *error)
{
    rt_stage_progress progress;
    rt_canonical canonical = {.memory = memory};
    rt_mesh *mesh = NULL;
    rt_status status = rt_stage_begin(&progress, hooks, RT_STAGE_LOAD);
    if (status != RT_OK)
        goto out;
    status = read_canonical(&canonical, path, &progress, error);
    if (status != RT_OK)
        goto out;
    status = rt_mesh_from_canonical(&mesh, &canonical, path, &progress, error);
    rt_canonical_free(&canonical); /* now, for it is as large as the mesh */
    if (status != RT_OK)
        goto out;
    status = finish(mesh, path, hooks, error);
    if (status != RT_OK)
        goto out;
    status = rt_stage_end(&progress, NULL);
    if (status != RT_OK)
        goto out;
    *out = mesh;
    mesh = NULL;
out:
    rt_canonical_free(&canonical);
    rt_mesh_destroy(mesh);
    if (status == RT_CANCELLED)
        rt_fail(error, RT_CANCELLED, "cancelled while reading %.400s", path);
    return rt_at_file(status, path, error);
}
