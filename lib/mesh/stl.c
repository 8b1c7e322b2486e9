/*
 * stl.c - STL, ascii and binary.
 *
 * Reference: M. Burns, "Automated Fabrication", section 6.5, 1993 (3D Systems' format).
 */
#include <math.h>
#include <string.h>

#include "mesh/fields.h"
#include "mesh/formats.h"
#include "mesh/ply_reader.h"
#include "mesh/unique.h"

#define HEADER_SIZE 80
#define FACET_SIZE 50 /* normal and three corners as floats, a word of attributes */

typedef struct stl {
    const rt_mesh_source *source;
    rt_canonical *mesh;
    rt_unique corners; /* the bits of their coordinates */
} stl;

/* Adds a facet; corners in the same place become one vertex. */
static rt_status add_facet(stl *s, float corners[9])
{
    uint32_t numbers[3];
    rt_status status = RT_OK;
    for (int i = 0; i < 3 && status == RT_OK; i++) {
        uint32_t key[3];
        for (int axis = 0; axis < 3; axis++)
            corners[3 * i + axis] += 0.0f; /* -0 and 0 are one place */
        memcpy(key, corners + 3 * i, sizeof key);
        status = rt_unique_add(&s->corners, s->source, key, &numbers[i]);
    }
    if (status == RT_OK && (s->mesh->file_faces & 0xfff) == 0)
        status = rt_mesh_step(s->source, s->mesh->file_faces * FACET_SIZE, s->source->size);
    return status == RT_OK ? rt_canonical_polygon(s->mesh, s->source, numbers, 3) : status;
}

/* ---- Binary ---- */

static uint64_t announced(const rt_mesh_source *source)
{
    return (uint64_t)rt_ply_decode(source->data + HEADER_SIZE, RT_PLY_UINT32,
                                   rt_ply_is_native(RT_PLY_LITTLE_ENDIAN));
}

static rt_status read_binary(stl *s)
{
    const rt_mesh_source *source = s->source;
    if (source->size < HEADER_SIZE + 4)
        return rt_mesh_fail(
            source, 0,
            "not an STL file: it neither begins with 'solid' nor has the %d bytes of a binary "
            "header",
            HEADER_SIZE + 4);
    uint64_t count = announced(source), room = (source->size - HEADER_SIZE - 4) / FACET_SIZE;
    int native = rt_ply_is_native(RT_PLY_LITTLE_ENDIAN);
    if (count > room)
        return rt_mesh_fail(source, 0, "%llu facets announced, but the file has room for only %llu",
                            (unsigned long long)count, (unsigned long long)room);
    rt_status status = rt_canonical_reserve(s->mesh, source, count);
    for (uint64_t i = 0; i < count && status == RT_OK; i++) {
        const uint8_t *at = source->data + HEADER_SIZE + 4 + (size_t)i * FACET_SIZE + 12;
        float corners[9];
        for (int k = 0; k < 9; k++) {
            corners[k] = (float)rt_ply_decode(at + 4 * k, RT_PLY_FLOAT32, native);
            if (!isfinite(corners[k]))
                return rt_mesh_fail(source, 0, "facet %llu of %llu: %g is not a finite float",
                                    (unsigned long long)i, (unsigned long long)count, corners[k]);
        }
        status = add_facet(s, corners);
    }
    uint64_t used = HEADER_SIZE + 4 + count * FACET_SIZE;
    if (status == RT_OK && used < source->size)
        rt_mesh_log(source, "%llu bytes after the last facet are ignored",
                    (unsigned long long)(source->size - used));
    return status;
}

/* ---- Ascii ---- */

/* Keywords are in lower case, but some write them in upper case. */
static int is_word(rt_token token, const char *word)
{
    size_t i = 0;
    for (; i < token.length && word[i]; i++)
        if ((token.at[i] | 0x20) != word[i])
            return 0;
    return i == token.length && !word[i];
}

/* Passes over the words, which must come next. */
static rt_status expect(const stl *s, rt_mesh_text *text, const char *const *words)
{
    char quote[RT_QUOTE];
    rt_token token;
    for (; *words; words++) {
        if (!rt_mesh_text_any(text, &token))
            return rt_mesh_fail(s->source, text->line, "the file ends where '%s' is expected",
                                *words);
        if (!is_word(token, *words))
            return rt_mesh_fail(s->source, text->line, "'%s'; expected '%s'",
                                rt_token_quote(token, quote), *words);
    }
    return RT_OK;
}

static rt_status read_point(const stl *s, rt_mesh_text *text, float point[3])
{
    rt_token token;
    rt_status status = RT_OK;
    for (int i = 0; i < 3 && status == RT_OK; i++)
        status = rt_mesh_text_any(text, &token)
                     ? rt_field_float(s->source, text, token, "vertex", &point[i])
                     : rt_mesh_fail(s->source, text->line, "the file ends in a vertex");
    return status;
}

/*
 * A facet, after the word `facet`. Its normal may be anything, even nan: the corners say it better.
 */
static rt_status read_facet(stl *s, rt_mesh_text *text)
{
    static const char *const normal[] = {"normal", NULL}, *const loop[] = {"outer", "loop", NULL};
    static const char *const vertex[] = {"vertex", NULL}, *const end[] = {"endloop", "endfacet",
                                                                          NULL};
    char quote[RT_QUOTE];
    float corners[9];
    rt_token token = {"", 0};
    double ignored;
    rt_status status = expect(s, text, normal);
    for (int i = 0; i < 3 && status == RT_OK; i++)
        if (!rt_mesh_text_any(text, &token) || !rt_token_real(token, &ignored))
            return rt_mesh_fail(s->source, text->line, "normal: '%s' is not a number",
                                rt_token_quote(token, quote));
    if (status == RT_OK)
        status = expect(s, text, loop);
    for (int i = 0; i < 3 && status == RT_OK; i++) {
        status = expect(s, text, vertex);
        if (status == RT_OK)
            status = read_point(s, text, corners + 3 * i);
    }
    if (status == RT_OK)
        status = expect(s, text, end);
    return status == RT_OK ? add_facet(s, corners) : status;
}

/* Solids one after another. */
static rt_status read_ascii(stl *s)
{
    char quote[RT_QUOTE];
    rt_mesh_text text = rt_mesh_text_begin(s->source->data, s->source->size);
    rt_token token;
    int inside = 0;
    rt_status status = RT_OK;
    while (status == RT_OK && rt_mesh_text_any(&text, &token)) {
        if (is_word(token, inside ? "endsolid" : "solid")) {
            inside = !inside;
            rt_mesh_text_rest(&text); /* its name */
        } else if (inside && is_word(token, "facet")) {
            status = read_facet(s, &text);
        } else {
            status = rt_mesh_fail(s->source, text.line, "'%s'; expected '%s'",
                                  rt_token_quote(token, quote),
                                  inside ? "facet' or 'endsolid" : "solid");
        }
    }
    if (status == RT_OK && inside)
        return rt_mesh_fail(s->source, text.line,
                            "the file ends where 'facet' or 'endsolid' is expected");
    return status;
}

/* Binary files may begin with "solid" too; their length gives them away. */
static int is_ascii(const rt_mesh_source *source)
{
    static const char word[] = "solid";
    size_t length = sizeof word - 1;
    if (source->size >= HEADER_SIZE + 4 &&
        source->size == HEADER_SIZE + 4 + announced(source) * FACET_SIZE)
        return 0;
    rt_token start = {(const char *)source->data, source->size < length ? source->size : length};
    return is_word(start, word);
}

static rt_status make_vertices(stl *s)
{
    rt_status status = rt_canonical_vertices(s->mesh, s->source, s->corners.count, 0, 0, 0);
    if (status == RT_OK && s->corners.count)
        memcpy(s->mesh->vertices, s->corners.keys, s->corners.count * sizeof *s->corners.keys);
    s->mesh->file_vertices = 3 * s->mesh->file_faces;
    return status;
}

rt_status rt_stl_read(rt_canonical *mesh, const rt_mesh_source *source)
{
    stl s = {.source = source, .mesh = mesh};
    rt_status status = is_ascii(source) ? read_ascii(&s) : read_binary(&s);
    if (status == RT_OK)
        status = make_vertices(&s);
    rt_unique_free(&s.corners);
    return status;
}
