/*
 * stl.c - STL, ascii and binary.
 *
 * Reference: M. Burns, "Automated Fabrication", section 6.5, 1993 (3D Systems' format).
 */
#include <math.h>
#include <string.h>

#include "mesh/fields.h"
#include "mesh/formats.h"
#include "mesh/origin.h"
#include "mesh/ply_reader.h"
#include "mesh/unique.h"

#define HEADER_SIZE 80
#define FACET_SIZE 50 /* normal and three corners as floats, a word of attributes */

typedef struct stl {
    const rt_mesh_source *source;
    rt_canonical *mesh;
    uint64_t facets;
    rt_doubles text;   /* [facets][9], of an ascii file: the coordinates of the corners */
    rt_doubles places; /* [corners.count][3], of an ascii file */
    rt_unique corners; /* the bits of their coordinates as vertices have them */
} stl;

/* The corners of a facet. */
static void get_facet(const stl *s, uint64_t facet, double corners[9])
{
    const int native = rt_ply_is_native(RT_PLY_LITTLE_ENDIAN);
    const uint8_t *at = s->source->data + HEADER_SIZE + 4 + (size_t)facet * FACET_SIZE + 12;
    for (int k = 0; k < 9; k++)
        corners[k] = s->text.count ? s->text.data[9 * facet + (size_t)k]
                                   : rt_ply_decode(at + 4 * k, RT_PLY_FLOAT32, native);
}

/* The point that coordinates are taken relative to. */
static void choose_origin(stl *s)
{
    double lo[3] = {INFINITY, INFINITY, INFINITY}, hi[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (uint64_t i = 0; i < s->facets; i++) {
        double corners[9];
        get_facet(s, i, corners);
        for (int k = 0; k < 9; k++) {
            lo[k % 3] = fmin(lo[k % 3], corners[k]);
            hi[k % 3] = fmax(hi[k % 3], corners[k]);
        }
    }
    if (s->facets)
        s->mesh->has_origin = rt_mesh_origin(s->mesh->origin, lo, hi);
}

/* Adds a facet; corners in the same place become one vertex. */
static rt_status add_facet(stl *s, const double corners[9])
{
    uint32_t numbers[3];
    rt_status status = RT_OK;
    for (int i = 0; i < 3 && status == RT_OK; i++) {
        const uint32_t before = s->corners.count;
        uint32_t key[3];
        float place[3];
        for (int axis = 0; axis < 3; axis++) /* -0 and 0 are one place */
            place[axis] = (float)(corners[3 * i + axis] - s->mesh->origin[axis]) + 0.0f;
        memcpy(key, place, sizeof key);
        status = rt_unique_add(&s->corners, s->source, key, &numbers[i]);
        if (status == RT_OK && s->text.count && s->corners.count > before)
            status = rt_doubles_add(&s->places, s->source, corners + 3 * i, 3);
    }
    if (status == RT_OK && (s->mesh->file_faces & 0xfff) == 0)
        status = rt_mesh_step(s->source, s->mesh->file_faces * FACET_SIZE, s->source->size);
    return status == RT_OK ? rt_canonical_polygon(s->mesh, s->source, numbers, 3) : status;
}

static rt_status add_facets(stl *s)
{
    rt_status status = rt_canonical_reserve(s->mesh, s->source, s->facets);
    choose_origin(s);
    for (uint64_t i = 0; i < s->facets && status == RT_OK; i++) {
        double corners[9];
        get_facet(s, i, corners);
        status = add_facet(s, corners);
    }
    return status;
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
    if (count > room)
        return rt_mesh_fail(source, 0, "%llu facets announced, but the file has room for only %llu",
                            (unsigned long long)count, (unsigned long long)room);
    s->facets = count;
    for (uint64_t i = 0; i < count; i++) {
        double corners[9];
        get_facet(s, i, corners);
        for (int k = 0; k < 9; k++)
            if (!isfinite(corners[k]))
                return rt_mesh_fail(source, 0, "facet %llu of %llu: %g is not a finite float",
                                    (unsigned long long)i, (unsigned long long)count, corners[k]);
    }
    uint64_t used = HEADER_SIZE + 4 + count * FACET_SIZE;
    if (used < source->size)
        rt_mesh_warn(&s->mesh->warnings, source, 0,
                     "%llu bytes behind the last of %llu facets are ignored",
                     (unsigned long long)(source->size - used), (unsigned long long)count);
    return RT_OK;
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

static rt_status read_point(const stl *s, rt_mesh_text *text, double point[3])
{
    rt_token token;
    rt_status status = RT_OK;
    for (int i = 0; i < 3 && status == RT_OK; i++)
        status = rt_mesh_text_any(text, &token)
                     ? rt_field_double(s->source, text, token, "vertex", &point[i])
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
    double corners[9];
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
    if (status == RT_OK)
        status = rt_doubles_add(&s->text, s->source, corners, 9);
    if (status == RT_OK && (++s->facets & 0xfff) == 0)
        status = rt_mesh_step(s->source, (uint64_t)(text->at - (const char *)s->source->data) / 2,
                              s->source->size);
    return status;
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

int rt_stl_is_binary(const rt_mesh_source *source)
{
    return source->size >= HEADER_SIZE + 4 &&
           source->size == HEADER_SIZE + 4 + announced(source) * FACET_SIZE;
}

/* Binary files may begin with "solid" too; their length gives them away. */
static int is_ascii(const rt_mesh_source *source)
{
    static const char word[] = "solid";
    size_t length = sizeof word - 1;
    if (rt_stl_is_binary(source))
        return 0;
    rt_token start = {(const char *)source->data, source->size < length ? source->size : length};
    return is_word(start, word);
}

static rt_status make_vertices(stl *s)
{
    rt_status status = rt_canonical_vertices(s->mesh, s->source, s->corners.count, 0, 0, 0);
    if (status == RT_OK && s->corners.count)
        memcpy(s->mesh->vertices, s->corners.keys, s->corners.count * 3 * sizeof(float));
    if (status == RT_OK && s->places.count) {
        s->mesh->exact = s->places.data;
        memset(&s->places, 0, sizeof s->places);
    }
    s->mesh->file_vertices = 3 * s->mesh->file_faces;
    return status;
}

rt_status rt_stl_read(rt_canonical *mesh, const rt_mesh_source *source)
{
    stl s = {.source = source, .mesh = mesh, .corners.words = 3};
    rt_status status = is_ascii(source) ? read_ascii(&s) : read_binary(&s);
    if (status == RT_OK)
        status = add_facets(&s);
    if (status == RT_OK)
        status = make_vertices(&s);
    rt_unique_free(&s.corners);
    rt_doubles_free(&s.text);
    rt_doubles_free(&s.places);
    return status;
}
