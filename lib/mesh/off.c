/*
 * off.c - Geomview OFF, ascii.
 *
 * Reference: The Geometry Center, "Geomview Manual", section OFF files.
 */
#include <string.h>

#include "mesh/colour.h"
#include "mesh/fields.h"
#include "mesh/formats.h"

#define VERTEX_MAX 12 /* position, normal, colour with alpha, texture coordinates */

typedef struct off {
    const rt_mesh_source *source;
    rt_canonical *mesh;
    rt_mesh_text text;
    int normals, colours, uv;
    uint64_t vertex_count, face_count;
    rt_indices polygon;
    rt_floats face_colours;    /* three a triangle; once there is one */
    uint64_t left_out_colours; /* of faces, such as numbers of a map of colours */
    int has_fractions;         /* a colour was of linear numbers */
    uint64_t bits;             /* colours of 0 and 1 before those, taken as whole numbers */
} off;

/* Takes a prefix off the word. */
static int take(rt_token *word, const char *prefix)
{
    size_t length = strlen(prefix);
    if (word->length < length || memcmp(word->at, prefix, length) != 0)
        return 0;
    word->at += length;
    word->length -= length;
    return 1;
}

/* The keyword, [ST][C][N]OFF; a file may also begin with its counts. */
static rt_status read_keyword(off *o, rt_token *first)
{
    char quote[RT_QUOTE];
    int64_t count;
    rt_token word = {"", 0}, next;
    if (!rt_mesh_text_any(&o->text, &word))
        return rt_mesh_fail(o->source, 1, "the file is empty");
    *first = word;
    if (rt_token_integer(word, &count))
        return RT_OK;
    o->uv = take(&word, "ST");
    o->colours = take(&word, "C");
    o->normals = take(&word, "N");
    if (!rt_token_is(word, "OFF"))
        return rt_mesh_fail(o->source, o->text.line,
                            "'%s' is no kind of OFF file that can be read; expected OFF with "
                            "the prefixes ST, C and N at most",
                            rt_token_quote(*first, quote));
    rt_mesh_text ahead = o->text;
    if (rt_mesh_text_token(&ahead, &next) && rt_token_is(next, "BINARY"))
        return rt_mesh_fail(o->source, o->text.line,
                            "binary OFF cannot be read; convert it to ascii OFF or to PLY");
    return rt_mesh_text_any(&o->text, first)
               ? RT_OK
               : rt_mesh_fail(o->source, o->text.line, "the file ends before its counts");
}

/*
 * Vertices, faces and, of no use, edges. The shortest vertex is "0 0 0", the shortest face "0", and
 * a line end.
 */
static rt_status read_counts(off *o, rt_token first)
{
    rt_token token = {"", 0};
    uint64_t left = (uint64_t)(o->text.end - o->text.at) + 1, edges;
    rt_status status =
        rt_field_count(o->source, &o->text, first, "count of vertices", left / 6, &o->vertex_count);
    if (status != RT_OK)
        return status;
    rt_mesh_text_token(&o->text, &token);
    status = rt_field_count(o->source, &o->text, token, "count of faces", left / 2, &o->face_count);
    if (status == RT_OK && rt_mesh_text_token(&o->text, &token))
        status = rt_field_count(o->source, &o->text, token, "count of edges", INT64_MAX, &edges);
    if (status == RT_OK && rt_mesh_text_token(&o->text, &token))
        return rt_mesh_fail(o->source, o->text.line, "more than three counts");
    return status;
}

/* Passes to the next line that holds something. */
static int next_line(off *o)
{
    rt_token token;
    while (rt_mesh_text_line(&o->text)) {
        rt_mesh_text ahead = o->text;
        if (rt_mesh_text_token(&ahead, &token))
            return 1;
    }
    return 0;
}

/*
 * A colour is of whole numbers to 255, sRGB as those of images, or of linear numbers to 1, which a
 * point or an exponent in any of them tells, or in one before it where they are 0 and 1.
 */
static rt_status read_colour(off *o, const char *what, const rt_token *tokens, int count,
                             double *out)
{
    int64_t whole, most = 0;
    int wholes = 0;
    rt_status status = RT_OK;
    for (; wholes < count && rt_token_integer(tokens[wholes], &whole); wholes++)
        most = whole > most ? whole : most;
    const int is_whole = wholes == count && !(o->has_fractions && most <= 1);
    const double largest = is_whole ? 255 : 0;
    o->has_fractions |= wholes < count;
    o->bits += is_whole && most == 1;
    for (int i = 0; i < count && status == RT_OK; i++) {
        status = rt_field_double(o->source, &o->text, tokens[i], what, &out[i]);
        if (status == RT_OK && rt_mesh_colour_is_bad(out[i], largest))
            return rt_mesh_fail(o->source, o->text.line, "%s: the colour %.9g is %s", what, out[i],
                                rt_mesh_colour_fault(out[i], largest));
        out[i] = rt_mesh_colour(out[i], largest);
    }
    return status;
}

static void put(float *out, const double *values, int count)
{
    for (int i = 0; i < count; i++)
        out[i] = rt_mesh_single(values[i]);
}

static rt_status read_vertex(off *o, uint32_t vertex)
{
    int fixed = 3 + 3 * o->normals + 2 * o->uv, count = 0, colour_at = 3 + 3 * o->normals;
    rt_token tokens[VERTEX_MAX + 1]; /* room to see that there is one too many */
    double values[VERTEX_MAX];
    rt_status status = RT_OK;
    while (count <= VERTEX_MAX && rt_mesh_text_token(&o->text, &tokens[count]))
        count++;
    int colour_count = count - fixed;
    if (o->colours ? colour_count != 3 && colour_count != 4 : colour_count != 0)
        return rt_mesh_fail(o->source, o->text.line, "vertex %u has %s%d values; expected %d%s",
                            vertex, count > VERTEX_MAX ? "at least " : "", count, fixed,
                            o->colours ? " and 3 or 4 of colour" : "");
    for (int i = 0; i < count && status == RT_OK; i++)
        if (i == colour_at && colour_count) {
            status = read_colour(o, "vertex", tokens + i, colour_count, values + i);
            i += colour_count - 1;
        } else { /* whether a normal is good matters only where it is used */
            status = (i >= 3 && i < colour_at ? rt_field_real : rt_field_double)(
                o->source, &o->text, tokens[i], "vertex", &values[i]);
        }
    if (status != RT_OK)
        return status;
    memcpy(o->mesh->exact + 3 * (size_t)vertex, values, 3 * sizeof *values);
    if (o->normals)
        put(rt_canonical_normal(o->mesh, vertex), values + 3, 3);
    if (o->colours)
        put(o->mesh->colours + 3 * (size_t)vertex, values + colour_at, 3);
    if (o->uv)
        put(rt_canonical_uv(o->mesh, vertex), values + count - 2, 2);
    return RT_OK;
}

/* Adds the colour, or white, of triangles up to the last that there is. */
static rt_status add_colour(off *o, const double values[3])
{
    const float colour[3] = {(float)values[0], (float)values[1], (float)values[2]};
    rt_status status = RT_OK;
    while (o->face_colours.count < 3 * (size_t)o->mesh->triangle_count && status == RT_OK)
        status = rt_floats_add(&o->face_colours, o->source, colour, 3);
    return status;
}

/* The face, and what is left of its line: nothing, or its colour, of 3 or 4 values. */
static rt_status add_face(off *o)
{
    static const double white[3] = {1, 1, 1};
    rt_token tokens[5];
    double colour[4];
    int count = 0;
    rt_status status = RT_OK;
    while (count < 5 && rt_mesh_text_token(&o->text, &tokens[count]))
        count++;
    const int has_colour = !o->colours && (count == 3 || count == 4);
    o->left_out_colours += count > 0 && !has_colour;
    if (has_colour)
        status = read_colour(o, "face", tokens, count, colour);
    if (status == RT_OK && (has_colour || o->face_colours.count))
        status = add_colour(o, white);
    if (status == RT_OK)
        status = rt_canonical_polygon(o->mesh, o->source, o->polygon.data, o->polygon.count);
    return status == RT_OK && has_colour ? add_colour(o, colour) : status;
}

static rt_status read_face(off *o, uint64_t face)
{
    rt_token token = {"", 0};
    uint64_t count, index;
    rt_mesh_text_token(&o->text, &token);
    rt_status status = rt_field_count(o->source, &o->text, token, "corners of a face",
                                      (uint64_t)(o->text.end - o->text.at) / 2, &count);
    o->polygon.count = 0;
    for (uint64_t i = 0; i < count && status == RT_OK; i++) {
        if (!rt_mesh_text_any(&o->text, &token))
            return rt_mesh_fail(o->source, o->text.line, "the file ends in face %llu of %llu",
                                (unsigned long long)face, (unsigned long long)o->face_count);
        if (o->vertex_count == 0)
            return rt_mesh_fail(o->source, o->text.line, "a face, but no vertices");
        status = rt_field_count(o->source, &o->text, token, "vertex of a face", o->vertex_count - 1,
                                &index);
        if (status == RT_OK)
            status = rt_indices_add(&o->polygon, o->source, &(uint32_t){(uint32_t)index}, 1);
    }
    return status == RT_OK ? add_face(o) : status;
}

static rt_status read_rows(off *o)
{
    rt_status status = RT_OK;
    for (uint64_t i = 0; i < o->vertex_count + o->face_count && status == RT_OK; i++) {
        if (!next_line(o))
            return rt_mesh_fail(o->source, o->text.line,
                                "the file ends after %llu of %llu vertices and %llu of %llu faces",
                                (unsigned long long)(i < o->vertex_count ? i : o->vertex_count),
                                (unsigned long long)o->vertex_count,
                                (unsigned long long)(i < o->vertex_count ? 0 : i - o->vertex_count),
                                (unsigned long long)o->face_count);
        status =
            i < o->vertex_count ? read_vertex(o, (uint32_t)i) : read_face(o, i - o->vertex_count);
        if (status == RT_OK && (i & 0xfff) == 0)
            status = rt_mesh_step(o->source, (uint64_t)(o->text.at - (const char *)o->source->data),
                                  o->source->size);
    }
    if (status == RT_OK && next_line(o))
        rt_mesh_warn(&o->mesh->warnings, o->source, o->text.line,
                     "what follows the last of %llu faces is ignored",
                     (unsigned long long)o->face_count);
    return status;
}

/* Gives the triangles the colours of their faces; one without a colour is white. */
static rt_status colour_faces(off *o)
{
    static const double white[3] = {1, 1, 1};
    if (o->left_out_colours)
        rt_mesh_warn(&o->mesh->warnings, o->source, 0,
                     o->colours ? "vertices and faces have colours: those of the %llu faces are "
                                  "left out"
                                : "what stands behind the corners of %llu faces is no colour of "
                                  "3 or 4 values: it is left out",
                     (unsigned long long)o->left_out_colours);
    if (o->has_fractions && o->bits)
        rt_mesh_warn(&o->mesh->warnings, o->source, 0,
                     "colours of 0 and 1, %llu of them, before one of fractions are taken as of "
                     "255: nearly black",
                     (unsigned long long)o->bits);
    if (!o->face_colours.count)
        return RT_OK;
    rt_status status = add_colour(o, white);
    return status == RT_OK ? rt_canonical_face_colours(o->mesh, o->source, o->face_colours.data)
                           : status;
}

rt_status rt_off_read(rt_canonical *mesh, const rt_mesh_source *source)
{
    off o = {
        .source = source, .mesh = mesh, .text = rt_mesh_text_begin(source->data, source->size)};
    rt_token first;
    o.text.comments = 1;
    rt_status status = read_keyword(&o, &first);
    if (status == RT_OK)
        status = read_counts(&o, first);
    if (status == RT_OK)
        status = rt_canonical_vertices(mesh, source, o.vertex_count, o.normals, o.uv, o.colours);
    if (status == RT_OK)
        status = rt_canonical_exact(mesh, source);
    if (status == RT_OK)
        status = read_rows(&o);
    if (status == RT_OK)
        status = colour_faces(&o);
    if (status == RT_OK)
        status = rt_canonical_cut(mesh, source, NULL);
    mesh->file_vertices = o.vertex_count;
    rt_indices_free(&o.polygon);
    rt_floats_free(&o.face_colours);
    return status;
}
