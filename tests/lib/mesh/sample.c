/* sample.c - meshes written to files, and read back. */
#include "lib/mesh/sample.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

void sample_bytes(sample *s, const void *bytes, size_t size)
{
    if (s->size + size > s->room) {
        s->room = 2 * (s->size + size);
        s->data = realloc(s->data, s->room);
        assert_non_null(s->data);
    }
    if (size)
        memcpy(s->data + s->size, bytes, size);
    s->size += size;
}

void sample_text(sample *s, const char *text)
{
    sample_bytes(s, text, strlen(text));
}

void sample_free(sample *s)
{
    free(s->data);
    memset(s, 0, sizeof *s);
}

/* The lowest `size` bytes of value. */
static void put(sample *s, uint64_t value, int size, int big)
{
    for (int i = 0; i < size; i++) {
        unsigned char byte = (unsigned char)(value >> 8 * (big ? size - 1 - i : i));
        sample_bytes(s, &byte, 1);
    }
}

void sample_u8(sample *s, unsigned value)
{
    put(s, value, 1, 0);
}

void sample_u16(sample *s, unsigned value, int big)
{
    put(s, value, 2, big);
}

void sample_u32(sample *s, unsigned long value, int big)
{
    put(s, value, 4, big);
}

void sample_f32(sample *s, float value, int big)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    put(s, bits, 4, big);
}

void sample_f64(sample *s, double value, int big)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    put(s, bits, 8, big);
}

static void check_finite(const float *values, size_t count)
{
    for (size_t i = 0; values && i < count; i++)
        assert_true(isfinite(values[i]));
}

/* What the header promises of every mesh. */
static void check(const rt_mesh *mesh)
{
    for (size_t i = 0; i < 3 * (size_t)mesh->triangle_count; i++)
        assert_true(mesh->indices[i] < mesh->vertex_count);
    check_finite(mesh->positions, 3 * (size_t)mesh->vertex_count);
    check_finite(mesh->normals, 3 * (size_t)mesh->vertex_count);
    check_finite(mesh->uv, 2 * (size_t)mesh->vertex_count);
    check_finite(mesh->colours, 3 * (size_t)mesh->vertex_count);
}

rt_status sample_read(rt_mesh **out, const sample *s, const char *name, rt_error *error)
{
    FILE *file = fopen(name, "wb");
    assert_non_null(file);
    if (s->size)
        assert_int_equal(fwrite(s->data, 1, s->size, file), s->size);
    assert_int_equal(fclose(file), 0);
    *out = NULL;
    memset(error, 0, sizeof *error);
    rt_status status = rt_mesh_load(out, name, NULL, error);
    assert_int_equal(remove(name), 0);
    if (status == RT_OK) {
        assert_non_null(*out);
        check(*out);
    } else {
        assert_null(*out);
        assert_int_equal(error->status, status);
        assert_string_equal(error->file, name);
        assert_true(error->message[0] != '\0');
    }
    return status;
}

rt_mesh *sample_accept(const char *name, const char *text)
{
    sample s = {0};
    rt_mesh *mesh;
    rt_error error;
    sample_text(&s, text);
    if (sample_read(&mesh, &s, name, &error) != RT_OK)
        fail_msg("%s:%d: %s", error.file, error.line, error.message);
    sample_free(&s);
    return mesh;
}

void sample_refuse(const char *name, const char *text, int line, const char *part)
{
    sample s = {0};
    rt_mesh *mesh;
    rt_error error;
    sample_text(&s, text);
    rt_status status = sample_read(&mesh, &s, name, &error);
    sample_free(&s);
    if (status != RT_ERROR_INPUT || error.line != line || !strstr(error.message, part))
        fail_msg("status %d at line %d with '%s'; expected line %d with '%s'", status, error.line,
                 error.message, line, part);
}

void sample_expect_triangles(const rt_mesh *mesh, const unsigned *indices, size_t count)
{
    assert_int_equal(mesh->triangle_count, count);
    for (size_t i = 0; i < 3 * count; i++)
        assert_int_equal(mesh->indices[i], indices[i]);
}

void sample_expect_floats(const float *values, const float *expected, size_t count)
{
    assert_non_null(values);
    for (size_t i = 0; i < count; i++)
        if (values[i] != expected[i])
            fail_msg("value %zu is %.9g; expected %.9g", i, values[i], expected[i]);
}
