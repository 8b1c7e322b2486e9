/*
 * serialized.c - meshes in the compressed binary files of Mitsuba (versions 3 and 4), inflated by
 * zlib. A file is a row of meshes, and behind them where each starts and how many there are. A mesh
 * is a mark and a version, two bytes each, and a stream of zlib: flags, of version 4 a name, how
 * many vertices and triangles there are, positions, normals, (u, v), colours and indices.
 */
#include "dsl/import/serialized.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

enum { MARK = 0x041c, HEAD_SIZE = 4, NAME_MAX_LENGTH = 4096, CHUNK = 1 << 14 };

/* Deflate makes no more of a byte. */
enum { EXPANSION_MAX = 1032 };

/* Flags of a mesh. */
enum {
    HAS_NORMALS = 0x1,
    HAS_UV = 0x2,
    HAS_COLOURS = 0x8,
    HAS_FACE_NORMALS = 0x10,
    IS_DOUBLE = 0x2000
};

typedef struct reader {
    importer *import;
    int line, version;
    const char *name;
    z_stream stream;
    size_t most; /* bytes that may come of the stream */
    uint32_t flags;
} reader;

/* A number of the file, its lowest byte first. */
static uint64_t number(const unsigned char *bytes, int size)
{
    uint64_t value = 0;
    for (int i = size; i-- > 0;)
        value = value << 8 | bytes[i];
    return value;
}

static int fail(reader *r, const char *what)
{
    return rt_import_fail(r->import, r->line, "'%.100s': %s", r->name, what);
}

/* The next bytes of the stream. */
static int take(reader *r, void *out, size_t size)
{
    r->stream.next_out = out;
    while (size > 0) {
        const uInt part = size < UINT_MAX ? (uInt)size : UINT_MAX;
        r->stream.avail_out = part;
        const int status = inflate(&r->stream, Z_NO_FLUSH);
        const uInt made = part - r->stream.avail_out;
        size -= made;
        if (size > 0 && (status != Z_OK || made == 0))
            return fail(r, "a mesh is damaged, or ends before its last triangle");
    }
    return 1;
}

static int take_number(reader *r, int size, uint64_t *out)
{
    unsigned char bytes[8];
    if (!take(r, bytes, (size_t)size))
        return 0;
    *out = number(bytes, size);
    return 1;
}

/* Where a mesh starts, and how many bytes it has at most. */
static int find_mesh(reader *r, const unsigned char *bytes, size_t size, size_t index,
                     size_t *start, size_t *length)
{
    const size_t width = r->version == 3 ? 4 : 8;
    const uint64_t count = size > 8 ? number(bytes + size - 4, 4) : 0;
    if (index == 0) {
        *start = 0;
        *length = size;
        return 1;
    }
    if (count == 0 || count > (size - 4) / width)
        return fail(r, "the table of its meshes is damaged");
    if (index >= count)
        return rt_import_fail(r->import, r->line, "'%.100s' has %lu meshes, not one of index %lu",
                              r->name, (unsigned long)count, (unsigned long)index);
    const uint64_t at = number(bytes + size - 4 - (count - index) * width, (int)width);
    if (at >= size || size - at < HEAD_SIZE)
        return fail(r, "a mesh starts behind the end of the file");
    *start = (size_t)at;
    *length = size - *start;
    return 1;
}

/* Numbers of single precision, or of double, of which *low gets what single precision loses. */
static float *take_floats(reader *r, size_t count, float **low)
{
    const size_t size = r->flags & IS_DOUBLE ? 8 : 4;
    float *const out = malloc((count + 1) * sizeof *out), *const rest =
                                                              low && size == 8
                                                                  ? calloc(count + 1, sizeof *rest)
                                                                  : NULL;
    unsigned char bytes[CHUNK];
    int is_good = out && (rest || !low || size == 4);
    if (!is_good)
        rt_import_fail_memory(r->import);
    for (size_t i = 0; is_good && i < count;) {
        const size_t room = CHUNK / size, part = count - i < room ? count - i : room;
        is_good = take(r, bytes, part * size);
        for (size_t k = 0; is_good && k < part; k++, i++) {
            const uint64_t bits = number(bytes + k * size, (int)size);
            const uint32_t half = (uint32_t)bits;
            double value;
            memcpy(&value, &bits, sizeof value);
            if (size == 4)
                memcpy(&out[i], &half, sizeof half);
            else
                out[i] = (float)value;
            if (rest)
                rest[i] = (float)(value - out[i]);
        }
    }
    if (is_good && low)
        *low = rest;
    else
        free(rest);
    if (is_good)
        return out;
    free(out);
    return NULL;
}

static int take_indices(reader *r, import_mesh *out)
{
    const size_t count = 3 * out->triangle_count;
    unsigned char bytes[CHUNK];
    out->indices = malloc((count + 1) * sizeof *out->indices);
    if (!out->indices)
        return rt_import_fail_memory(r->import);
    for (size_t i = 0; i < count;) {
        const size_t part = count - i < CHUNK / 4 ? count - i : CHUNK / 4;
        if (!take(r, bytes, 4 * part))
            return 0;
        for (size_t k = 0; k < part; k++, i++)
            out->indices[i] = (uint32_t)number(bytes + 4 * k, 4);
    }
    return 1;
}

/* Flags, name and counts. */
static int take_head(reader *r, import_mesh *out)
{
    uint64_t flags = 0, vertices = 0, triangles = 0;
    if (!take_number(r, 4, &flags))
        return 0;
    unsigned char letter = 1;
    for (int i = 0; r->version == 4 && letter; i++)
        if (i == NAME_MAX_LENGTH || !take(r, &letter, 1))
            return fail(r, "the name of a mesh is damaged");
    if (!take_number(r, 8, &vertices) || !take_number(r, 8, &triangles))
        return 0;
    /* Each vertex has a position, each triangle three indices. */
    if (vertices > r->most / 12 || triangles > r->most / 12 || vertices > UINT32_MAX)
        return fail(r, "a mesh has more vertices or triangles than its file can hold");
    r->flags = (uint32_t)flags;
    out->vertex_count = (size_t)vertices;
    out->triangle_count = (size_t)triangles;
    return 1;
}

static int take_mesh(reader *r, import_mesh *out)
{
    const size_t count = out->vertex_count;
    if (!(out->positions = take_floats(r, 3 * count, &out->low)))
        return 0;
    if (r->flags & HAS_NORMALS && !(out->normals = take_floats(r, 3 * count, NULL)))
        return 0;
    if (r->flags & HAS_UV && !(out->uv = take_floats(r, 2 * count, NULL)))
        return 0;
    if (r->flags & HAS_COLOURS && !(out->colours = take_floats(r, 3 * count, NULL)))
        return 0;
    return take_indices(r, out);
}

/* Goes to the end of the stream, where its checksum is. */
static int take_end(reader *r)
{
    unsigned char rest[CHUNK];
    int status = Z_OK;
    for (size_t taken = 0; status == Z_OK && taken <= r->most; taken += CHUNK) {
        r->stream.next_out = rest;
        r->stream.avail_out = CHUNK;
        status = inflate(&r->stream, Z_NO_FLUSH);
    }
    return status == Z_STREAM_END || fail(r, "a mesh is damaged: its checksum is another");
}

/* Mark and version, which every mesh has. */
static int read_version(reader *r, const unsigned char *head, size_t length)
{
    if (length < HEAD_SIZE || number(head, 2) != MARK)
        return fail(r, "not a file of serialized meshes");
    r->version = (int)number(head + 2, 2);
    return r->version == 3 || r->version == 4 ||
           fail(r, "serialized meshes of another version than 3 and 4");
}

static int inflate_mesh(reader *r, unsigned char *bytes, size_t size, size_t index,
                        import_mesh *out)
{
    size_t start = 0, length = 0;
    if (!read_version(r, bytes, size) || !find_mesh(r, bytes, size, index, &start, &length) ||
        !read_version(r, bytes + start, length))
        return 0;
    length -= HEAD_SIZE;
    r->stream.next_in = bytes + start + HEAD_SIZE;
    r->stream.avail_in = (uInt)length; /* a file is smaller: IMPORT_FILE_MAX */
    r->most = length * EXPANSION_MAX;
    if (inflateInit(&r->stream) != Z_OK)
        return rt_import_fail_memory(r->import);
    const int is_made = take_head(r, out) && take_mesh(r, out) && take_end(r);
    inflateEnd(&r->stream);
    return is_made;
}

int rt_serialized_read(importer *import, int line, const char *name, size_t index, import_mesh *out,
                       int *is_flat)
{
    size_t size = 0;
    reader r = {.import = import, .line = line, .name = name};
    memset(out, 0, sizeof *out);
    char *const bytes = rt_import_read(import, line, name, &size);
    const int is_made = bytes && inflate_mesh(&r, (unsigned char *)bytes, size, index, out);
    free(bytes);
    *is_flat = (r.flags & HAS_FACE_NORMALS) != 0;
    return is_made;
}
