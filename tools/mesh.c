/* mesh.c - `rtc mesh`: writes meshes made from formulas as PLY files. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "commands.h"
#include "interrupt.h"
#include "mesh_shape.h"
#include "message.h"
#include "outputs.h"
#include "status.h"

enum { DEFAULT_TRIANGLES = 20000 };

/* Bytes of a PLY file: room for the header, and what a vertex and a face take. */
enum { HEADER_SIZE = 512, VERTEX_SIZE = 32, FACE_SIZE = 13 };

static int find_kind(mesh_kind *out, const char *word)
{
    rt_nearest search;
    rt_nearest_begin(&search, word, strlen(word));
    for (int i = 0; i < MESH_KIND_COUNT; i++) {
        if (strcmp(word, mesh_kind_names[i]) == 0) {
            *out = (mesh_kind)i;
            return STATUS_DONE;
        }
        rt_nearest_offer(&search, mesh_kind_names[i], strlen(mesh_kind_names[i]));
    }
    message_error("no mesh is called '%s'; there are sphere, torus, knot and terrain", word);
    if (search.best)
        message_hint("did you mean %s?", search.best);
    return STATUS_USAGE;
}

/* The bytes of a file, in an array that is large enough. */
typedef struct mesh_bytes {
    unsigned char *data;
    size_t size;
} mesh_bytes;

static void put_u32(mesh_bytes *out, uint32_t value)
{
    for (int i = 0; i < 4; i++)
        out->data[out->size++] = (unsigned char)(value >> 8 * i & 0xff);
}

static void put_float(mesh_bytes *out, double value)
{
    float narrow = (float)value;
    uint32_t bits;
    memcpy(&bits, &narrow, sizeof bits);
    put_u32(out, bits);
}

static void put_header(mesh_bytes *out, const mesh_grid *grid)
{
    int length =
        snprintf((char *)out->data, HEADER_SIZE,
                 "ply\nformat binary_little_endian 1.0\ncomment %s made by rtc mesh\n"
                 "element vertex %llu\nproperty float x\nproperty float y\nproperty float z\n"
                 "property float nx\nproperty float ny\nproperty float nz\n"
                 "property float u\nproperty float v\n"
                 "element face %llu\nproperty list uchar int vertex_indices\nend_header\n",
                 mesh_kind_names[grid->kind], (unsigned long long)grid->vertices,
                 (unsigned long long)grid->triangles);
    out->size = (size_t)length;
}

static void put_vertices(mesh_bytes *out, const mesh_grid *grid, uint64_t row)
{
    for (uint64_t column = 0; column <= grid->columns; column++) {
        double u = (double)column / (double)grid->columns, v = (double)row / (double)grid->rows;
        mesh_point point = mesh_shape_point(grid->kind, u, v);
        for (int i = 0; i < 3; i++)
            put_float(out, point.position[i]);
        for (int i = 0; i < 3; i++)
            put_float(out, point.normal[i]);
        put_float(out, u);
        put_float(out, v);
    }
}

static void put_faces(mesh_bytes *out, const mesh_grid *grid, uint64_t row)
{
    for (uint64_t column = 0; column < grid->columns; column++) {
        uint32_t triangles[2][3];
        int count = mesh_grid_cell(grid, column, row, triangles);
        for (int i = 0; i < count; i++) {
            out->data[out->size++] = 3;
            for (int corner = 0; corner < 3; corner++)
                put_u32(out, triangles[i][corner]);
        }
    }
}

/* Fills in the whole file; an interrupt stops it. */
static int make_mesh(mesh_bytes *out, const mesh_grid *grid)
{
    out->data = malloc(HEADER_SIZE + VERTEX_SIZE * grid->vertices + FACE_SIZE * grid->triangles);
    if (!out->data) {
        message_error("out of memory for %llu triangles", (unsigned long long)grid->triangles);
        return STATUS_DEVICE;
    }
    put_header(out, grid);
    for (uint64_t row = 0; row <= grid->rows && !interrupt_pending(); row++)
        put_vertices(out, grid, row);
    for (uint64_t row = 0; row < grid->rows && !interrupt_pending(); row++)
        put_faces(out, grid, row);
    return interrupt_pending() ? STATUS_INTERRUPTED : STATUS_DONE;
}

static int write_mesh(const char *path, const mesh_grid *grid)
{
    mesh_bytes bytes = {NULL, 0};
    rt_error error;
    int status = make_mesh(&bytes, grid);
    if (status == STATUS_DONE && rt_file_write(path, bytes.data, bytes.size, &error) != RT_OK)
        status = message_failure(&error);
    free(bytes.data);
    return status;
}

static int check_extension(const char *path)
{
    if (strcasecmp(outputs_extension(path), ".ply") == 0)
        return outputs_check_writable(path);
    message_error("--out %s: a mesh is written as .ply", path);
    return STATUS_USAGE;
}

static void print_summary(const char *path, const mesh_grid *grid)
{
    message_put_name("", path, ": ");
    printf("%llu vertices, %llu triangles\n", (unsigned long long)grid->vertices,
           (unsigned long long)grid->triangles);
}

int command_mesh(const command_line *arguments)
{
    const option_value *triangles = &arguments->options[OPTION_TRIANGLES],
                       *file = &arguments->options[OPTION_MESH_OUT];
    char name[64];
    mesh_kind kind;
    if (arguments->operand_count > 1) {
        message_error("one mesh at a time: '%s' and '%s'", arguments->operands[0],
                      arguments->operands[1]);
        return STATUS_USAGE;
    }
    if (arguments->operand_count == 0) {
        message_error("which mesh? usage: rtc mesh sphere|torus|knot|terrain [OPTION]...");
        return STATUS_USAGE;
    }
    int status = find_kind(&kind, arguments->operands[0]);
    if (status != STATUS_DONE)
        return status;
    mesh_grid grid = mesh_grid_plan(kind, triangles->given ? triangles->count : DEFAULT_TRIANGLES);
    snprintf(name, sizeof name, "%s.ply", mesh_kind_names[kind]);
    const char *path = file->given ? file->text : name;
    status = check_extension(path);
    if (status != STATUS_DONE)
        return status;
    interrupt_catch(0, 0);
    interrupt_defer();
    status = write_mesh(path, &grid);
    if (status == STATUS_DONE)
        print_summary(path, &grid);
    return status;
}
