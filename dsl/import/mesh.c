/* mesh.c - meshes of an import, as binary PLY files. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "dsl/import/import.h"

enum { HEADER_SIZE = 640 + IMPORT_ATTRIBUTES_MAX * 3 * (IMPORT_NAME + 24), FACE_SIZE = 13 };

void rt_import_mesh_free(import_mesh *mesh)
{
    free(mesh->positions);
    free(mesh->low);
    free(mesh->normals);
    free(mesh->uv);
    free(mesh->colours);
    for (size_t i = 0; i < mesh->more_count; i++)
        free(mesh->more[i].values);
    free(mesh->indices);
    memset(mesh, 0, sizeof *mesh);
}

void rt_import_mesh_turn(import_mesh *mesh)
{
    for (size_t i = 0; i < 3 * mesh->triangle_count; i += 3) {
        const uint32_t second = mesh->indices[i + 1];
        mesh->indices[i + 1] = mesh->indices[i + 2];
        mesh->indices[i + 2] = second;
    }
    for (size_t i = 0; mesh->normals && i < 3 * mesh->vertex_count; i++)
        mesh->normals[i] = -mesh->normals[i];
}

/* A coordinate of a vertex, of all in a row. */
static double coordinate(const import_mesh *mesh, size_t i)
{
    return mesh->low ? (double)mesh->positions[i] + mesh->low[i] : mesh->positions[i];
}

/* The normal of a face at length 1; returns 0 for one without area. */
static int face_normal(double out[3], const import_mesh *mesh, size_t triangle)
{
    double corners[9];
    for (size_t i = 0; i < 9; i++)
        corners[i] = coordinate(mesh, 3 * (size_t)mesh->indices[3 * triangle + i / 3] + i % 3);
    rt_vector_normal(out, corners);
    return rt_vector_normalize(out);
}

int rt_import_mesh_has_area(const import_mesh *mesh)
{
    double normal[3];
    for (size_t i = 0; i < mesh->triangle_count; i++)
        if (face_normal(normal, mesh, i))
            return 1;
    return 0;
}

int rt_import_mesh_smooth(importer *import, import_mesh *mesh)
{
    double *firsts = calloc(3 * mesh->vertex_count + 1, sizeof *firsts), normal[3];
    mesh->is_smooth = 0;
    if (!firsts)
        return rt_import_fail_memory(import);
    for (size_t i = 0; i < 3 * mesh->triangle_count && !mesh->is_smooth; i++) {
        double *first = firsts + 3 * (size_t)mesh->indices[i];
        if (!face_normal(normal, mesh, i / 3))
            continue;
        if (rt_vector_length(first) == 0)
            memcpy(first, normal, sizeof normal);
        mesh->is_smooth = rt_vector_dot(first, normal) < 1 - 1e-9;
    }
    free(firsts);
    return mesh->is_smooth;
}

/* Everything in the order of the file, whatever the machine's. */
static void put_u32(unsigned char **at, uint32_t value)
{
    for (int i = 0; i < 4; i++)
        *(*at)++ = (unsigned char)(value >> 8 * i & 0xff);
}

static void put_floats(unsigned char **at, const float *values, int count)
{
    for (int i = 0; i < count; i++) {
        uint32_t bits;
        memcpy(&bits, &values[i], sizeof bits);
        put_u32(at, bits);
    }
}

/* Positions, in double precision where single loses something. */
static void put_position(unsigned char **at, const import_mesh *mesh, size_t vertex)
{
    for (size_t i = 3 * vertex; mesh->low && i < 3 * vertex + 3; i++) {
        const double value = coordinate(mesh, i);
        uint64_t bits;
        memcpy(&bits, &value, sizeof bits);
        put_u32(at, (uint32_t)bits);
        put_u32(at, (uint32_t)(bits >> 32));
    }
    if (!mesh->low)
        put_floats(at, mesh->positions + 3 * vertex, 3);
}

static size_t put_header(char *out, const import_mesh *mesh)
{
    const char *const type = mesh->low ? "double" : "float";
    char *at = out;
    at += sprintf(at,
                  "ply\nformat binary_little_endian 1.0\nelement vertex %lu\n"
                  "property %s x\nproperty %s y\nproperty %s z\n%s%s%s",
                  (unsigned long)mesh->vertex_count, type, type, type,
                  mesh->normals ? "property float nx\nproperty float ny\nproperty float nz\n" : "",
                  mesh->uv ? "property float u\nproperty float v\n" : "",
                  mesh->colours ? "property float red\nproperty float green\nproperty float blue\n"
                                : "");
    for (size_t i = 0; i < mesh->more_count; i++)
        for (int c = 0; c < mesh->more[i].width; c++)
            at += sprintf(at, "property float %s_%c\n", mesh->more[i].name,
                          (mesh->more[i].width == 2 ? "uv" : "rgb")[c]);
    at += sprintf(at, "element face %lu\nproperty list uchar int vertex_indices\nend_header\n",
                  (unsigned long)mesh->triangle_count);
    return (size_t)(at - out);
}

/* The whole file, to be freed. */
static unsigned char *make_ply(const import_mesh *mesh, size_t *size)
{
    size_t vertex_size = (mesh->low ? 24 : 12) + (mesh->normals ? 12 : 0) + (mesh->uv ? 8 : 0) +
                         (mesh->colours ? 12 : 0);
    for (size_t i = 0; i < mesh->more_count; i++)
        vertex_size += (size_t)mesh->more[i].width * sizeof(float);
    unsigned char *bytes =
        malloc(HEADER_SIZE + vertex_size * mesh->vertex_count + FACE_SIZE * mesh->triangle_count);
    if (!bytes)
        return NULL;
    unsigned char *at = bytes + put_header((char *)bytes, mesh);
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        put_position(&at, mesh, i);
        if (mesh->normals)
            put_floats(&at, mesh->normals + 3 * i, 3);
        if (mesh->uv)
            put_floats(&at, mesh->uv + 2 * i, 2);
        if (mesh->colours)
            put_floats(&at, mesh->colours + 3 * i, 3);
        for (size_t k = 0; k < mesh->more_count; k++)
            put_floats(&at, mesh->more[k].values + (size_t)mesh->more[k].width * i,
                       mesh->more[k].width);
    }
    for (size_t i = 0; i < mesh->triangle_count; i++) {
        *at++ = 3;
        for (int c = 0; c < 3; c++)
            put_u32(&at, mesh->indices[3 * i + (size_t)c]);
    }
    *size = (size_t)(at - bytes);
    return bytes;
}

static int check_numbers(importer *import, int line, const import_mesh *mesh, const float *values,
                         size_t width)
{
    for (size_t i = 0; values && i < width * mesh->vertex_count; i++)
        if (!(fabsf(values[i]) <= IMPORT_COORDINATE_MAX))
            return rt_import_fail(import, line,
                                  "vertex %lu of a mesh has the number %g; it must lie within %g",
                                  (unsigned long)(i / width), values[i], IMPORT_COORDINATE_MAX);
    return 1;
}

int rt_import_mesh_check(importer *import, int line, const import_mesh *mesh)
{
    for (size_t i = 0; i < 3 * mesh->triangle_count; i++)
        if (mesh->indices[i] >= mesh->vertex_count)
            return rt_import_fail(import, line, "a triangle has vertex %lu of %lu",
                                  (unsigned long)mesh->indices[i],
                                  (unsigned long)mesh->vertex_count);
    const float *arrays[] = {mesh->positions, mesh->normals, mesh->uv, mesh->colours};
    static const size_t widths[] = {3, 3, 2, 3};
    for (size_t a = 0; a < 4; a++)
        if (!check_numbers(import, line, mesh, arrays[a], widths[a]))
            return 0;
    for (size_t i = 0; i < mesh->more_count; i++)
        if (!check_numbers(import, line, mesh, mesh->more[i].values, (size_t)mesh->more[i].width))
            return 0;
    return 1;
}

int rt_import_add_mesh(importer *import, int line, const char *base, const import_mesh *mesh)
{
    char file[512];
    size_t size;
    if (import->failed || !rt_import_mesh_check(import, line, mesh))
        return IMPORT_NONE;
    if (mesh->triangle_count == 0 || mesh->vertex_count == 0) {
        rt_import_note_at(import, line, "a mesh without triangles is left out");
        return IMPORT_NONE;
    }
    if (!rt_import_mesh_has_area(mesh)) {
        rt_import_note_at(import, line, "a mesh without a triangle that has an area is left out");
        return IMPORT_NONE;
    }
    unsigned char *bytes = make_ply(mesh, &size);
    if (!bytes) {
        rt_import_fail_memory(import);
        return IMPORT_NONE;
    }
    int is_there = rt_import_write(import, file, base, ".ply", bytes, size);
    free(bytes);
    return is_there ? rt_import_add_mesh_file(import, base, file, mesh->is_smooth ? "smooth" : NULL)
                    : IMPORT_NONE;
}

int rt_import_add_mesh_file(importer *import, const char *base, const char *file,
                            const char *shading)
{
    int handle = rt_import_name(import, base);
    rt_import_put(import, &import->definitions, "mesh %s { file \"%s\"%s%s }\n",
                  rt_import_label(import, handle), file, shading ? " shading " : "",
                  shading ? shading : "");
    return handle;
}
