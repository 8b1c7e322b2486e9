/*
 * obj.c - Wavefront OBJ.
 *
 * Reference: Wavefront Technologies, "Advanced Visualizer" manual, appendix B1, object files
 * (.obj). Beyond it: a colour after the coordinates of a vertex.
 */
#include <string.h>

#include "mesh/colour.h"
#include "mesh/fields.h"
#include "mesh/formats.h"
#include "mesh/unique.h"

typedef struct obj {
    const rt_mesh_source *source;
    rt_canonical *mesh;
    rt_doubles positions;
    rt_floats colours, uv, normals; /* three, two, three a row; colours once there is one */
    uint64_t position_count, uv_count, normal_count;

    /*
     * Of the faces: each different corner, as indices from 1 of position, uv and normal; 0 for
     * none.
     */
    rt_unique corners;
    rt_indices polygon;
    int some_uv, some_normals;
} obj;

/* Statements that do not affect the mesh, and those whose loss is logged. */
static const char *const silent[] = {"g",     "o",        "s",        "mg",  "vp",
                                     "bevel", "c_interp", "d_interp", "lod", NULL};
static const char *const materials[] = {"usemtl",     "mtllib",    "usemap", "maplib",
                                        "shadow_obj", "trace_obj", NULL};
static const char *const shapes[] = {"p",    "l",    "curv",  "curv2", "surf", "cstype", "deg",
                                     "bmat", "step", "parm",  "trim",  "hole", "scrv",   "sp",
                                     "end",  "con",  "ctech", "stech", NULL};

static int is_one_of(rt_token word, const char *const *words)
{
    while (*words && !rt_token_is(word, *words))
        words++;
    return *words != NULL;
}

static rt_status read_vertex(obj *o, rt_mesh_text *text)
{
    double v[7];
    float colour[3] = {1, 1, 1};
    int count;
    rt_status status = rt_field_doubles(o->source, text, "v", v, 3, 7, &count);
    if (status == RT_OK)
        status = rt_doubles_add(&o->positions, o->source, v, 3);
    /* x y z r g b; a single value more is the weight of rational curves */
    const int has_colour = status == RT_OK && count >= 6;
    while (status == RT_OK && has_colour && o->colours.count < 3 * o->position_count)
        status = rt_floats_add(&o->colours, o->source, colour, 3);
    for (int i = 0; i < 3 && has_colour; i++) {
        if (rt_mesh_colour_is_bad(v[3 + i], 0))
            return rt_mesh_fail(o->source, text->line, "v: the colour %.9g is %s", v[3 + i],
                                rt_mesh_colour_fault(v[3 + i], 0));
        colour[i] = (float)rt_mesh_colour(v[3 + i], 0);
    }
    if (status == RT_OK && (has_colour || o->colours.count))
        status = rt_floats_add(&o->colours, o->source, colour, 3);
    o->position_count++;
    return status;
}

static rt_status read_uv(obj *o, rt_mesh_text *text)
{
    double values[3] = {0, 0, 0};
    int count;
    rt_status status = rt_field_doubles(o->source, text, "vt", values, 1, 3, &count);
    const float uv[2] = {(float)values[0], (float)values[1]};
    o->uv_count++;
    return status == RT_OK ? rt_floats_add(&o->uv, o->source, uv, 2) : status;
}

static rt_status read_normal(obj *o, rt_mesh_text *text)
{
    double values[3];
    int count;
    rt_status status = rt_field_reals(o->source, text, "vn", values, 3, 3, &count);
    float n[3] = {0, 0, 0};
    for (int i = 0; i < 3 && status == RT_OK; i++)
        n[i] = rt_mesh_single(values[i]);
    if (n[0] == 0 && n[1] == 0 && n[2] == 0)
        n[0] = NAN; /* it is there, but is none: zero is for corners without one */
    o->normal_count++;
    return status == RT_OK ? rt_floats_add(&o->normals, o->source, n, 3) : status;
}

/* One index of a corner: from 1 on, or negative, back from those that stand above this line. */
static rt_status read_index(const obj *o, const rt_mesh_text *text, rt_token token,
                            const char *what, uint64_t all, uint64_t above, uint32_t *out)
{
    char quote[RT_QUOTE];
    int64_t index;
    if (!rt_token_integer(token, &index))
        return rt_mesh_fail(o->source, text->line, "f: '%s' is not an index",
                            rt_token_quote(token, quote));
    if (index < 0)
        index += (int64_t)above + 1;
    if (index < 1 || (uint64_t)index > all || index > RT_CANONICAL_MAX)
        return rt_mesh_fail(o->source, text->line, "f: %s %s is out of range; there are %llu", what,
                            rt_token_quote(token, quote), (unsigned long long)all);
    *out = (uint32_t)index;
    return RT_OK;
}

/* A corner: v, v/vt, v//vn or v/vt/vn. `above` counts the v, vt and vn above this line. */
static rt_status read_corner(obj *o, const rt_mesh_text *text, rt_token token,
                             const uint64_t above[3])
{
    static const char *const names[3] = {"vertex", "texture coordinate", "normal"};
    const uint64_t all[3] = {o->position_count, o->uv_count, o->normal_count};
    char quote[RT_QUOTE];
    uint32_t key[3] = {0, 0, 0}, number;
    const char *at = token.at, *end = token.at + token.length;
    rt_status status = RT_OK;
    for (int i = 0; at <= end && status == RT_OK; i++) {
        const char *slash = memchr(at, '/', (size_t)(end - at));
        rt_token part = {at, (size_t)((slash ? slash : end) - at)};
        if (i == 3)
            return rt_mesh_fail(o->source, text->line, "f: '%s' has more than three indices",
                                rt_token_quote(token, quote));
        /* Only the middle one may be left out. */
        if (part.length || i != 1 || !slash)
            status = read_index(o, text, part, names[i], all[i], above[i], &key[i]);
        at += part.length + 1;
    }
    o->some_uv |= key[1] != 0;
    o->some_normals |= key[2] != 0;
    if (status == RT_OK)
        status = rt_unique_add(&o->corners, o->source, key, &number);
    return status == RT_OK ? rt_indices_add(&o->polygon, o->source, &number, 1) : status;
}

static rt_status read_face(obj *o, rt_mesh_text *text, const uint64_t above[3])
{
    rt_token token;
    rt_status status = RT_OK;
    o->polygon.count = 0;
    while (status == RT_OK && rt_mesh_text_token(text, &token))
        status = read_corner(o, text, token, above);
    return status == RT_OK
               ? rt_canonical_polygon(o->mesh, o->source, o->polygon.data, o->polygon.count)
               : status;
}

static rt_mesh_text begin(const rt_mesh_source *source)
{
    rt_mesh_text text = rt_mesh_text_begin(source->data, source->size);
    text.comments = 1;
    text.continued = 1;
    return text;
}

/* Each pass reports as one half. */
static rt_status step(const obj *o, const rt_mesh_text *text, int pass)
{
    if (text->line & 0xfff)
        return RT_OK;
    size_t done = (size_t)(text->at - (const char *)o->source->data);
    return rt_mesh_step(o->source, done + (pass ? o->source->size : 0),
                        2 * (uint64_t)o->source->size);
}

/* First pass: all that faces refer to, and what is no statement of the format. */
static rt_status read_points(obj *o)
{
    char quote[RT_QUOTE];
    rt_mesh_text text = begin(o->source);
    rt_token word;
    int lost_shapes = 0;
    rt_status status = RT_OK;
    do {
        if (!rt_mesh_text_token(&text, &word) || rt_token_is(word, "f") || is_one_of(word, silent))
            ;
        else if (rt_token_is(word, "v"))
            status = read_vertex(o, &text);
        else if (rt_token_is(word, "vt"))
            status = read_uv(o, &text);
        else if (rt_token_is(word, "vn"))
            status = read_normal(o, &text);
        else if (is_one_of(word, materials))
            o->mesh->names_materials = 1;
        else if (is_one_of(word, shapes))
            lost_shapes = 1;
        else
            status = rt_mesh_fail(o->source, text.line, "'%s' is no statement of the OBJ format",
                                  rt_token_quote(word, quote));
        if (status == RT_OK)
            status = step(o, &text, 0);
    } while (status == RT_OK && rt_mesh_text_line(&text));
    if (o->mesh->names_materials)
        rt_mesh_log(o->source, "the materials (mtllib, usemtl) are left out");
    if (lost_shapes)
        rt_mesh_log(o->source, "the points, lines, curves and free-form surfaces are ignored");
    return status;
}

/* Second pass: the faces. */
static rt_status read_faces(obj *o)
{
    rt_mesh_text text = begin(o->source);
    rt_token word;
    uint64_t above[3] = {0, 0, 0};
    rt_status status = RT_OK;
    do {
        if (!rt_mesh_text_token(&text, &word))
            continue;
        above[0] += rt_token_is(word, "v") != 0;
        above[1] += rt_token_is(word, "vt") != 0;
        above[2] += rt_token_is(word, "vn") != 0;
        if (rt_token_is(word, "f"))
            status = read_face(o, &text, above);
        if (status == RT_OK)
            status = step(o, &text, 1);
    } while (status == RT_OK && rt_mesh_text_line(&text));
    return status;
}

/*
 * One vertex for each different corner. Where a corner has no normal, it is zero and made from the
 * faces later.
 */
static rt_status make_vertices(obj *o)
{
    int coloured = o->colours.count > 0;
    int has_bare_corners = 0;
    rt_canonical *mesh = o->mesh;
    rt_status status = rt_canonical_vertices(mesh, o->source, o->corners.count, o->some_normals,
                                             o->some_uv, coloured);
    if (status == RT_OK)
        status = rt_canonical_exact(mesh, o->source);
    for (uint32_t i = 0; i < o->corners.count && status == RT_OK; i++) {
        const uint32_t *key = rt_unique_key(&o->corners, i);
        size_t position = key[0] - 1;
        has_bare_corners |= key[1] == 0;
        memcpy(mesh->exact + 3 * (size_t)i, o->positions.data + 3 * position, 3 * sizeof(double));
        if (key[1])
            memcpy(rt_canonical_uv(mesh, i), o->uv.data + 2 * (size_t)(key[1] - 1),
                   2 * sizeof(float));
        if (key[2])
            memcpy(rt_canonical_normal(mesh, i), o->normals.data + 3 * (size_t)(key[2] - 1),
                   3 * sizeof(float));
        if (coloured)
            memcpy(mesh->colours + 3 * (size_t)i, o->colours.data + 3 * position,
                   3 * sizeof(float));
    }
    if (status == RT_OK)
        status = rt_canonical_share(mesh, o->source, &o->corners, 1, o->position_count);
    mesh->file_vertices = o->position_count;
    mesh->zero_is_bare = 1;
    mesh->has_bare_corners = o->some_uv && has_bare_corners;
    return status;
}

/* The line where a face ends, of those with three corners or more. */
static size_t line_of(const rt_mesh_source *source, uint64_t face)
{
    rt_mesh_text text = begin(source);
    rt_token word;
    uint64_t faces = 0;
    do {
        int corners = 0;
        if (!rt_mesh_text_token(&text, &word) || !rt_token_is(word, "f"))
            continue;
        while (corners < 3 && rt_mesh_text_token(&text, &word))
            corners++;
        if (corners == 3 && faces++ == face)
            return text.line;
    } while (rt_mesh_text_line(&text));
    return 0;
}

rt_status rt_obj_read(rt_canonical *mesh, const rt_mesh_source *source)
{
    obj o = {.source = source, .mesh = mesh, .corners.words = 3};
    rt_status status = read_points(&o);
    if (status == RT_OK)
        status = read_faces(&o);
    if (status == RT_OK)
        status = make_vertices(&o);
    if (status == RT_OK)
        status = rt_canonical_cut(mesh, source, line_of);
    rt_doubles_free(&o.positions);
    rt_floats_free(&o.colours);
    rt_floats_free(&o.uv);
    rt_floats_free(&o.normals);
    rt_unique_free(&o.corners);
    rt_indices_free(&o.polygon);
    return status;
}
