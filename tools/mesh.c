/* mesh.c - `rtc mesh`: writes meshes of any size, made from formulas, as PLY files. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "mesh_shape.h"
#include "message.h"
#include "nearest.h"
#include "rtc.h"

enum { DEFAULT_TRIANGLES = 20000, NAME_SIZE = 4096 };

static int find_kind(mesh_kind *out, const char *word)
{
    nearest search = nearest_begin(word);
    for (int i = 0; i < MESH_KIND_COUNT; i++) {
        if (strcmp(word, mesh_kind_names[i]) == 0) {
            *out = (mesh_kind)i;
            return STATUS_DONE;
        }
        nearest_offer(&search, mesh_kind_names[i]);
    }
    message_error("no mesh is called '%s'; there are sphere, torus, knot and terrain", word);
    if (search.best)
        message_hint("did you mean %s?", search.best);
    return STATUS_USAGE;
}

static void put_u32(FILE *file, uint32_t value)
{
    for (int i = 0; i < 4; i++)
        putc((int)(value >> 8 * i & 0xff), file);
}

static void put_float(FILE *file, double value)
{
    float narrow = (float)value;
    uint32_t bits;
    memcpy(&bits, &narrow, sizeof bits);
    put_u32(file, bits);
}

static void put_header(FILE *file, const mesh_grid *grid)
{
    static const char *const properties[] = {"x", "y", "z", "nx", "ny", "nz", "u", "v"};
    fprintf(file, "ply\nformat binary_little_endian 1.0\ncomment %s made by rtc mesh\nelement vertex %llu\n",
            mesh_kind_names[grid->kind], (unsigned long long)grid->vertices);
    for (int i = 0; i < 8; i++)
        fprintf(file, "property float %s\n", properties[i]);
    fprintf(file, "element face %llu\nproperty list uchar int vertex_indices\nend_header\n",
            (unsigned long long)grid->triangles);
}

static void put_vertices(FILE *file, const mesh_grid *grid)
{
    for (uint64_t row = 0; row <= grid->rows; row++)
        for (uint64_t column = 0; column <= grid->columns; column++) {
            double u = (double)column / (double)grid->columns, v = (double)row / (double)grid->rows;
            mesh_point point = mesh_shape_point(grid->kind, u, v);
            for (int i = 0; i < 3; i++)
                put_float(file, point.position[i]);
            for (int i = 0; i < 3; i++)
                put_float(file, point.normal[i]);
            put_float(file, u);
            put_float(file, v);
        }
}

static void put_faces(FILE *file, const mesh_grid *grid)
{
    for (uint64_t row = 0; row < grid->rows; row++)
        for (uint64_t column = 0; column < grid->columns; column++) {
            uint32_t triangles[2][3];
            int count = mesh_grid_cell(grid, column, row, triangles);
            for (int i = 0; i < count; i++) {
                putc(3, file);
                for (int corner = 0; corner < 3; corner++)
                    put_u32(file, triangles[i][corner]);
            }
        }
}

static int fail_write(const char *path, int code)
{
    message_error("cannot write %s: %s", path, strerror(code));
    return STATUS_OUTPUT;
}

/* Writes beside the file and renames, so that none is ever half there. */
static int write_mesh(const char *path, const mesh_grid *grid)
{
    char temporary[NAME_SIZE];
    int length = snprintf(temporary, sizeof temporary, "%s.tmp", path);
    if (length < 0 || (size_t)length >= sizeof temporary)
        return fail_write(path, ENAMETOOLONG);
    FILE *file = fopen(temporary, "wb");
    if (!file)
        return fail_write(path, errno);
    put_header(file, grid);
    put_vertices(file, grid);
    put_faces(file, grid);
    int code = ferror(file) ? EIO : 0;
    if (fclose(file) != 0 && !code)
        code = errno;
    if (!code && rename(temporary, path) != 0)
        code = errno;
    if (!code)
        return STATUS_DONE;
    remove(temporary);
    return fail_write(path, code);
}

int command_mesh(const command_line *arguments)
{
    const option_value *triangles = &arguments->options[OPTION_TRIANGLES], *file = &arguments->options[OPTION_MESH_OUT];
    char name[64];
    mesh_kind kind;
    if (arguments->operand_count != 1) {
        message_error("which mesh? usage: rtc mesh sphere|torus|knot|terrain [OPTION]...");
        return STATUS_USAGE;
    }
    int status = find_kind(&kind, arguments->operands[0]);
    if (status != STATUS_DONE)
        return status;
    mesh_grid grid = mesh_grid_plan(kind, triangles->given ? triangles->count : DEFAULT_TRIANGLES);
    snprintf(name, sizeof name, "%s.ply", mesh_kind_names[kind]);
    const char *path = file->given ? file->text : name;
    status = write_mesh(path, &grid);
    if (status == STATUS_DONE)
        printf("%s: %llu vertices, %llu triangles\n", path, (unsigned long long)grid.vertices,
               (unsigned long long)grid.triangles);
    return status;
}
