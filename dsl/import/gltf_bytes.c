/* gltf_bytes.c - buffers, views and accessors of a glTF file, with all bounds checked. */
#define _XOPEN_SOURCE 700 /* strncasecmp */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "dsl/import/gltf.h"

/* READ_FREE, and READ_EACH for each byte of the file: what may be read of it. */
enum { COUNT_MAX = 100000000, READ_FREE = 1 << 24, READ_EACH = 64 };

/* All of them. */
enum {
    TYPE_BYTE = 5120,
    TYPE_UNSIGNED_BYTE = GLTF_UNSIGNED_BYTE,
    TYPE_SHORT = 5122,
    TYPE_UNSIGNED_SHORT = GLTF_UNSIGNED_SHORT,
    TYPE_UNSIGNED_INT = 5125,
    TYPE_FLOAT = GLTF_FLOAT
};

int rt_gltf_count_read(gltf *g, size_t count)
{
    g->read += count;
    return g->read / READ_EACH <= g->size + READ_FREE / READ_EACH ||
           rt_import_fail(
               g->import, 0,
               "what its accessors and images share comes to more than %d times its bytes",
               READ_EACH);
}

/* ---- Buffers ----------------------------------------------------------------- */

static int base64_value(char c)
{
    return c >= 'A' && c <= 'Z'   ? c - 'A'
           : c >= 'a' && c <= 'z' ? c - 'a' + 26
           : c >= '0' && c <= '9' ? c - '0' + 52
           : c == '+' || c == '-' ? 62
           : c == '/' || c == '_' ? 63
                                  : -1;
}

/* A uri that is not read: without what it has the file is wrong, or `optional` is left out. */
static char *refuse(gltf *g, const char *optional, const char *why)
{
    if (optional)
        rt_import_note_at(g->import, 0, "%s: %s is left out", why, optional);
    else
        rt_import_fail(g->import, 0, "%s", why);
    return NULL;
}

static char *decode_base64(gltf *g, const char *text, const char *optional, size_t *size)
{
    size_t length = strlen(text), used = 0;
    char *out = malloc(length / 4 * 3 + 4);
    unsigned bits = 0;
    int have = 0;
    if (!out) {
        rt_import_fail_memory(g->import);
        return NULL;
    }
    for (size_t i = 0; i < length && text[i] != '='; i++) {
        int value = base64_value(text[i]);
        if (strchr(" \t\r\n", text[i]))
            continue;
        if (value < 0) {
            free(out);
            return refuse(g, optional, "a data URI holds what is no base64");
        }
        bits = (bits << 6 | (unsigned)value) & 0xffffff;
        have += 6;
        if (have >= 8) {
            have -= 8;
            out[used++] = (char)(bits >> have & 0xff);
        }
    }
    out[used] = '\0';
    *size = used;
    return out;
}

static int hex_value(char c)
{
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
}

/* Text with %20 and the like decoded, to be freed: a file name, or data, which may hold zeros. */
static char *decode_percent(gltf *g, const char *uri, int least, size_t *size)
{
    char *out = malloc(strlen(uri) + 1);
    size_t used = 0;
    if (!out) {
        rt_import_fail_memory(g->import);
        return NULL;
    }
    for (; *uri; uri++) {
        int high = *uri == '%' ? hex_value(uri[1]) : -1;
        int low = high >= 0 ? hex_value(uri[2]) : -1;
        int value = low >= 0 ? 16 * high + low : -1;
        out[used++] = value >= least ? (char)value : *uri;
        uri += value >= least ? 2 : 0;
    }
    out[used] = '\0';
    *size = used;
    return out;
}

/* What a data URI holds (RFC 2397). */
static char *read_data(gltf *g, const char *uri, const char *optional, size_t *size)
{
    static const char base64[] = ";base64";
    const size_t length = sizeof base64 - 1;
    const char *const comma = strchr(uri, ',');
    if (!comma)
        return refuse(g, optional, "a data URI has no comma before its data");
    if ((size_t)(comma - uri) >= length && strncasecmp(comma - length, base64, length) == 0)
        return decode_base64(g, comma + 1, optional, size);
    return decode_percent(g, comma + 1, 0, size);
}

char *rt_gltf_uri(gltf *g, const char *uri, const char *optional, size_t *size)
{
    size_t length = 0;
    if (strncmp(uri, "data:", 5) == 0)
        return read_data(g, uri, optional, size);
    if (strstr(uri, "://")) {
        char text[160];
        snprintf(text, sizeof text, "'%.60s' is no file: nothing is fetched from other places",
                 uri);
        return refuse(g, optional, text);
    }
    char *name = decode_percent(g, uri, 1, &length);
    char *bytes = NULL;
    if (name && (!optional || rt_import_find(g->import, 0, name, optional)))
        bytes = rt_import_read(g->import, 0, name, size);
    free(name);
    return bytes;
}

static const gltf_bytes *read_buffer(gltf *g, uint64_t index)
{
    const cJSON *buffer = rt_gltf_item(g, GLTF_BUFFERS, index, "a buffer view");
    uint64_t length = 0;
    if (!buffer)
        return NULL;
    gltf_bytes *bytes = &g->buffers[index];
    if (bytes->at)
        return bytes;
    const char *uri = rt_gltf_string(buffer, "uri");
    if (uri) {
        bytes->owned = rt_gltf_uri(g, uri, NULL, &bytes->size);
        bytes->at = (const unsigned char *)bytes->owned;
        g->size += bytes->at ? bytes->size : 0;
    } else if (index == 0 && g->chunk) {
        bytes->at = g->chunk;
        bytes->size = g->chunk_size;
    } else {
        rt_import_fail(g->import, 0, "buffers[%lu] has neither a uri nor a binary chunk",
                       (unsigned long)index);
    }
    if (bytes->at && (!rt_gltf_whole(g, buffer, "byteLength", &length) || length > bytes->size))
        rt_import_fail(g->import, 0, "buffers[%lu] has %lu bytes; its byteLength is %lu",
                       (unsigned long)index, (unsigned long)bytes->size, (unsigned long)length);
    return g->import->failed ? NULL : bytes;
}

int rt_gltf_view(gltf *g, uint64_t index, const unsigned char **at, size_t *size, size_t *stride)
{
    const cJSON *view = rt_gltf_item(g, GLTF_VIEWS, index, "an accessor or image");
    uint64_t buffer = 0, offset = 0, length = 0, step = 0;
    if (!view)
        return 0;
    if (!rt_gltf_whole(g, view, "buffer", &buffer) ||
        !rt_gltf_whole(g, view, "byteLength", &length))
        return rt_import_fail(g->import, 0, "bufferViews[%lu] needs buffer and byteLength",
                              (unsigned long)index);
    rt_gltf_whole(g, view, "byteOffset", &offset);
    rt_gltf_whole(g, view, "byteStride", &step);
    const gltf_bytes *bytes = g->import->failed ? NULL : read_buffer(g, buffer);
    if (!bytes)
        return 0;
    if (offset > bytes->size || length > bytes->size - offset)
        return rt_import_fail(g->import, 0,
                              "bufferViews[%lu] has bytes %lu to %lu of a buffer of %lu",
                              (unsigned long)index, (unsigned long)offset,
                              (unsigned long)(offset + length), (unsigned long)bytes->size);
    if (step != 0 && (step < 4 || step > 252))
        return rt_import_fail(g->import, 0,
                              "bufferViews[%lu]: a stride of %lu; 4 to 252 are allowed",
                              (unsigned long)index, (unsigned long)step);
    *at = bytes->at + offset;
    *size = (size_t)length;
    *stride = (size_t)step;
    return 1;
}

/* ---- Accessors --------------------------------------------------------------- */

/* The elements of an accessor, whose bounds have been checked. */
typedef struct elements {
    const unsigned char *at; /* NULL: all are zero, but those of `sparse` */
    const cJSON *sparse;     /* which elements others replace, or NULL */
    unsigned long accessor;
    size_t count, stride;
    int type;
    int components, is_normalized;
} elements;

static size_t type_size(uint64_t type)
{
    return type == TYPE_BYTE || type == TYPE_UNSIGNED_BYTE     ? 1
           : type == TYPE_SHORT || type == TYPE_UNSIGNED_SHORT ? 2
           : type == TYPE_UNSIGNED_INT || type == TYPE_FLOAT   ? 4
                                                               : 0;
}

static int component_count(const char *type)
{
    static const char *const types[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
    for (int i = 0; type && i < 4; i++)
        if (strcmp(type, types[i]) == 0)
            return i + 1;
    return type && strcmp(type, "MAT4") == 0 ? 16 : 0;
}

/* Those in a view, from an offset on; count, type and components are known. */
static int find_bytes(gltf *g, uint64_t view, uint64_t offset, elements *out)
{
    size_t size = 0, stride = 0;
    if (!rt_gltf_view(g, view, &out->at, &size, &stride))
        return 0;
    const size_t element = type_size((uint64_t)out->type) * (size_t)out->components;
    if (stride > 0 && stride < element)
        return rt_import_fail(g->import, 0,
                              "accessors[%lu]: elements of %lu bytes overlap by the byteStride %lu "
                              "of their view",
                              out->accessor, (unsigned long)element, (unsigned long)stride);
    out->stride = stride ? stride : element;
    if (out->count == 0 || out->count > COUNT_MAX || offset > size || element > size - offset ||
        (out->count - 1) > (size - offset - element) / out->stride)
        return rt_import_fail(g->import, 0,
                              "accessors[%lu]: %lu elements of %lu bytes do not fit into its view "
                              "of %lu bytes",
                              out->accessor, (unsigned long)out->count, (unsigned long)element,
                              (unsigned long)size);
    out->at += offset;
    return 1;
}

static int find_elements(gltf *g, uint64_t index, elements *out)
{
    const cJSON *accessor = rt_gltf_item(g, GLTF_ACCESSORS, index, "a mesh");
    uint64_t view = 0, offset = 0, count = 0, type = 0;
    if (!accessor)
        return 0;
    out->sparse = gltf_get(accessor, "sparse");
    const int has_view = rt_gltf_whole(g, accessor, "bufferView", &view);
    if (!has_view && !out->sparse)
        rt_import_note_at(g->import, 0, "accessors[%lu] has no bufferView: it holds zeros",
                          (unsigned long)index);
    rt_gltf_whole(g, accessor, "byteOffset", &offset);
    rt_gltf_whole(g, accessor, "count", &count);
    rt_gltf_whole(g, accessor, "componentType", &type);
    out->accessor = (unsigned long)index;
    out->components = component_count(rt_gltf_string(accessor, "type"));
    out->is_normalized = rt_gltf_flag(g, accessor, "normalized", 0);
    out->type = (int)type;
    out->count = (size_t)count;
    out->at = NULL;
    if (type_size(type) == 0 || out->components == 0)
        return rt_import_fail(g->import, 0, "accessors[%lu]: unknown type or componentType",
                              (unsigned long)index);
    if (g->import->failed || (has_view && !find_bytes(g, view, offset, out)))
        return 0;
    if (count == 0 || count > COUNT_MAX)
        return rt_import_fail(g->import, 0, "accessors[%lu] has %lu elements", (unsigned long)index,
                              (unsigned long)count);
    return 1;
}

/* A whole component, little-endian. */
static uint32_t whole_at(const unsigned char *at, size_t size)
{
    uint32_t value = 0;
    for (size_t i = 0; i < size; i++)
        value |= (uint32_t)at[i] << 8 * i;
    return value;
}

static float float_at(const unsigned char *at, const elements *e)
{
    float value;
    uint32_t bits = whole_at(at, type_size((uint64_t)e->type));
    if (e->type == TYPE_FLOAT) {
        memcpy(&value, &bits, sizeof value);
        return value;
    }
    double whole = bits;
    if (e->type == TYPE_BYTE && bits >= 0x80)
        whole -= 256;
    if (e->type == TYPE_SHORT && bits >= 0x8000)
        whole -= 65536;
    if (!e->is_normalized)
        return (float)whole;
    const double value_of_1 = e->type == TYPE_BYTE             ? 127
                              : e->type == TYPE_UNSIGNED_BYTE  ? 255
                              : e->type == TYPE_SHORT          ? 32767
                              : e->type == TYPE_UNSIGNED_SHORT ? 65535
                                                               : 1;
    return (float)fmax(whole / value_of_1, -1); /* glTF 2.0, 3.11: the least whole number is -1 */
}

static void copy_floats(float *out, size_t components, const unsigned char *at, const elements *e)
{
    const size_t size = type_size((uint64_t)e->type);
    for (size_t c = 0; c < components; c++)
        out[c] = float_at(at + c * size, e);
}

/* Finds where a sparse accessor has the indices of its own elements, and these, which are read. */
static int find_sparse(gltf *g, const elements *whole, elements *indices, elements *values)
{
    const cJSON *const from[] = {gltf_get(whole->sparse, "indices"),
                                 gltf_get(whole->sparse, "values")};
    elements *const out[] = {indices, values};
    uint64_t count = 0, type = 0;
    rt_gltf_whole(g, whole->sparse, "count", &count);
    rt_gltf_whole(g, from[0], "componentType", &type);
    *indices = *values = *whole;
    indices->components = 1;
    indices->type = (int)type;
    indices->count = values->count = count <= whole->count ? (size_t)count : 0;
    if (type != TYPE_UNSIGNED_BYTE && type != TYPE_UNSIGNED_SHORT && type != TYPE_UNSIGNED_INT)
        return rt_import_fail(g->import, 0, "accessors[%lu]: its sparse indices have no type",
                              whole->accessor);
    for (int i = 0; i < 2; i++) {
        uint64_t view = 0, offset = 0;
        rt_gltf_whole(g, from[i], "byteOffset", &offset);
        if (!rt_gltf_whole(g, from[i], "bufferView", &view))
            return rt_import_fail(g->import, 0,
                                  "accessors[%lu]: its sparse values have no "
                                  "bufferView",
                                  whole->accessor);
        if (!find_bytes(g, view, offset, out[i]))
            return 0;
    }
    return rt_gltf_count_read(g, indices->count * (size_t)(1 + whole->components));
}

/* The element that the i-th of those of a sparse accessor replaces; the import fails without it. */
static uint32_t sparse_index(gltf *g, const elements *whole, const elements *indices, size_t i)
{
    const uint32_t index =
        whole_at(indices->at + i * indices->stride, type_size((uint64_t)indices->type));
    if (index < whole->count)
        return index;
    rt_import_fail(g->import, 0, "accessors[%lu]: the sparse index %lu of %lu", whole->accessor,
                   (unsigned long)index, (unsigned long)whole->count);
    return 0;
}

/* The place of an element among those that are wanted; SIZE_MAX: it is none of them. */
static size_t place_of(const gltf_selection *wanted, uint32_t index)
{
    size_t low = 0, high = wanted ? wanted->count : 0;
    if (!wanted)
        return index;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (wanted->vertices[middle] < index)
            low = middle + 1;
        else
            high = middle;
    }
    return low < wanted->count && wanted->vertices[low] == index ? low : SIZE_MAX;
}

/* Replaces the elements that are sparse; returns 0 after a failure. */
static int replace_floats(gltf *g, float *out, size_t components, const elements *whole)
{
    elements indices, values;
    if (!find_sparse(g, whole, &indices, &values))
        return 0;
    for (size_t i = 0; i < indices.count; i++) {
        const size_t at = place_of(g->wanted, sparse_index(g, whole, &indices, i));
        if (g->import->failed)
            return 0;
        if (at != SIZE_MAX)
            copy_floats(out + at * components, components, values.at + i * values.stride, &values);
    }
    return 1;
}

/* Reads the elements that are wanted, which have their memory. */
static int read_floats(gltf *g, const elements *e, size_t components, float *out)
{
    const gltf_selection *const wanted = g->wanted;
    const size_t count = wanted ? wanted->count : e->count;
    for (size_t i = 0; e->at && i < count; i++)
        copy_floats(out + i * components, components,
                    e->at + (wanted ? wanted->vertices[i] : i) * e->stride, e);
    return !e->sparse || replace_floats(g, out, components, e);
}

float *rt_gltf_floats(gltf *g, uint64_t accessor, int components, size_t *count)
{
    elements e;
    if (!find_elements(g, accessor, &e))
        return NULL;
    if (e.components != components && e.components != components + 1) {
        rt_import_fail(g->import, 0, "accessors[%lu] has %d components, expected %d",
                       (unsigned long)accessor, e.components, components);
        return NULL;
    }
    const size_t there = g->wanted ? g->wanted->of : *count;
    if (there && e.count != there) {
        rt_import_fail(g->import, 0, "accessors[%lu] has %lu elements, the positions have %lu",
                       (unsigned long)accessor, (unsigned long)e.count, (unsigned long)there);
        return NULL;
    }
    *count = g->wanted ? g->wanted->count : e.count;
    if (!rt_gltf_count_read(g, *count * (size_t)e.components))
        return NULL;
    float *out = calloc(*count + 1, (size_t)components * sizeof *out);
    if (!out) {
        rt_import_fail_memory(g->import);
        return NULL;
    }
    if (!read_floats(g, &e, (size_t)components, out)) {
        free(out);
        return NULL;
    }
    return out;
}

/* The indices that others replace; returns 0 after a failure. */
static int replace_indices(gltf *g, uint32_t *out, const elements *whole)
{
    elements at, values;
    if (!find_sparse(g, whole, &at, &values))
        return 0;
    for (size_t i = 0; i < at.count; i++) {
        const uint32_t index = sparse_index(g, whole, &at, i);
        if (g->import->failed)
            return 0;
        out[index] = whole_at(values.at + i * values.stride, type_size((uint64_t)values.type));
    }
    return 1;
}

uint32_t *rt_gltf_indices(gltf *g, uint64_t accessor, size_t *count)
{
    elements e;
    if (!find_elements(g, accessor, &e) || !rt_gltf_count_read(g, e.count))
        return NULL;
    if (e.components != 1 || (e.type != TYPE_UNSIGNED_BYTE && e.type != TYPE_UNSIGNED_SHORT &&
                              e.type != TYPE_UNSIGNED_INT)) {
        rt_import_fail(g->import, 0, "accessors[%lu] holds no indices", (unsigned long)accessor);
        return NULL;
    }
    uint32_t *out = calloc(e.count, sizeof *out);
    if (!out)
        rt_import_fail_memory(g->import);
    for (size_t i = 0; out && e.at && i < e.count; i++)
        out[i] = whole_at(e.at + i * e.stride, type_size((uint64_t)e.type));
    if (out && e.sparse && !replace_indices(g, out, &e)) {
        free(out);
        return NULL;
    }
    *count = e.count;
    return out;
}
