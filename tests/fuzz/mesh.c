/* mesh.c - reads mesh files and checks what comes of them. */
#include "fuzz/mesh.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "mesh/load.h"

static void on_log(void *user, const char *line)
{
    (void)user;
    fuzz_expect_line(line);
}

/* Reads "name" in the current directory. */
static rt_mesh *load(const char *name, rt_error *error)
{
    const rt_hooks hooks = {.log = on_log};
    rt_mesh *mesh = fuzz_untouched;
    rt_status status = rt_mesh_load(&mesh, name, &hooks, error);
    return fuzz_expect_answer(status, error, mesh) ? mesh : NULL;
}

/* A line from 1 to the one behind the last; 0 only where the file as a whole is wrong. */
static void check_place(const rt_error *error, const char *name, const uint8_t *data, size_t size,
                        int has_lines)
{
    int lines = 1;
    for (size_t i = 0; i < size; i++)
        lines += data[i] == '\n' || data[i] == '\r';
    FUZZ_EXPECT(strcmp(error->file, name) == 0);
    FUZZ_EXPECT(error->line >= (has_lines ? 1 : 0) && error->line <= lines);
}

static void check_mesh(const rt_mesh *mesh)
{
    size_t vertices = mesh->vertex_count;
    FUZZ_EXPECT(mesh->zero_area <= mesh->triangle_count);
    for (size_t i = 0; i < 3 * (size_t)mesh->triangle_count; i++)
        FUZZ_EXPECT(mesh->indices[i] < mesh->vertex_count);
    fuzz_expect_finite(mesh->positions, 3 * vertices);
    fuzz_expect_finite(mesh->uv, mesh->uv ? 2 * vertices : 0);
    fuzz_expect_finite(mesh->colours, mesh->colours ? 3 * vertices : 0);
    for (size_t i = 0; mesh->normals && i < vertices; i++) {
        const float *n = mesh->normals + 3 * i;
        double length = sqrt((double)n[0] * n[0] + (double)n[1] * n[1] + (double)n[2] * n[2]);
        FUZZ_EXPECT(fabs(length - 1.0) < 1e-3);
    }
}

/* Triangles of binary PLY. */
static void put_ply(rt_bytes *out, const rt_mesh *mesh)
{
    char header[512];
    snprintf(header, sizeof header,
             "ply\nformat binary_little_endian 1.0\nelement vertex %u\nproperty float x\n"
             "property float y\nproperty float z\n%s%s%selement face %u\n"
             "property list uchar uint vertex_indices\nend_header\n",
             mesh->vertex_count,
             mesh->normals ? "property float nx\nproperty float ny\nproperty float nz\n" : "",
             mesh->uv ? "property float u\nproperty float v\n" : "",
             mesh->colours ? "property float red\nproperty float green\nproperty float blue\n" : "",
             mesh->triangle_count);
    fuzz_put_text(out, header);
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        for (size_t c = 0; c < 3; c++)
            fuzz_put_float(out, mesh->positions[3 * i + c], 0);
        for (size_t c = 0; mesh->normals && c < 3; c++)
            fuzz_put_float(out, mesh->normals[3 * i + c], 0);
        for (size_t c = 0; mesh->uv && c < 2; c++)
            fuzz_put_float(out, mesh->uv[2 * i + c], 0);
        for (size_t c = 0; mesh->colours && c < 3; c++)
            fuzz_put_float(out, mesh->colours[3 * i + c], 0);
    }
    for (size_t i = 0; i < mesh->triangle_count; i++) {
        fuzz_put_number(out, 3, 1, 0);
        for (size_t c = 0; c < 3; c++)
            fuzz_put_number(out, mesh->indices[3 * i + c], 4, 0);
    }
}

static void expect_same(const float *a, const float *b, size_t count, float tolerance)
{
    FUZZ_EXPECT(!a == !b);
    for (size_t i = 0; a && i < count; i++)
        FUZZ_EXPECT(fabsf(a[i] - b[i]) <= tolerance);
}

static void check_round_trip(const rt_mesh *mesh)
{
    size_t vertices = mesh->vertex_count, corners = 3 * (size_t)mesh->triangle_count;
    rt_bytes file = {0};
    rt_error error;
    put_ply(&file, mesh);
    fuzz_write("again.ply", file.data, file.size);
    rt_bytes_free(&file);
    rt_mesh *again = load("again.ply", &error);
    FUZZ_EXPECT(again != NULL);
    FUZZ_EXPECT(again->vertex_count == mesh->vertex_count);
    FUZZ_EXPECT(again->triangle_count == mesh->triangle_count);
    FUZZ_EXPECT(!corners ||
                memcmp(again->indices, mesh->indices, corners * sizeof *mesh->indices) == 0);
    expect_same(mesh->positions, again->positions, 3 * vertices, 0);
    expect_same(mesh->normals, again->normals, 3 * vertices, 1e-6f);
    expect_same(mesh->uv, again->uv, 2 * vertices, 0);
    expect_same(mesh->colours, again->colours, 3 * vertices, 0);
    rt_mesh_destroy(again);
}

/* The same file as a scene takes it, with normals of its own. */
static void check_scene(const char *name, const rt_mesh *mesh)
{
    rt_scene *scene = NULL;
    rt_error error;
    rt_mesh_info info;
    uint32_t handle;
    FUZZ_EXPECT(rt_scene_create(&scene, &error) == RT_OK);
    rt_status status = rt_scene_load_mesh(scene, &handle, name, RT_SHADING_SMOOTH, &info, &error);
    if (status == RT_OK) {
        FUZZ_EXPECT(info.vertex_count == mesh->vertex_count);
        FUZZ_EXPECT(info.triangle_count == mesh->triangle_count);
        fuzz_expect_finite(info.lo, 3);
        fuzz_expect_finite(info.hi, 3);
    } else {
        FUZZ_EXPECT(status == RT_ERROR_INPUT);
        fuzz_expect_line(error.message);
    }
    rt_scene_destroy(scene);
}

int fuzz_mesh_run(const char *name, const uint8_t *data, size_t size, int has_lines)
{
    rt_error error;
    fuzz_write(name, data, size);
    rt_mesh *mesh = load(name, &error);
    if (!mesh) {
        check_place(&error, name, data, size, has_lines);
        return 0;
    }
    check_mesh(mesh);
    check_round_trip(mesh);
    check_scene(name, mesh);
    rt_mesh_destroy(mesh);
    return 1;
}
