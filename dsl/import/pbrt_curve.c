/*
 * pbrt_curve.c - curves of pbrt-v4 as meshes: ribbons as strips, all others as tubes, open at both
 * ends. Each segment is a cubic Bezier curve, along which u runs from 0 to 1. Those of one surface
 * share a mesh, as hair has very many.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "dsl/import/pbrt.h"
#include "dsl/import/tube.h"

enum { SECTIONS_MIN = 4, SECTIONS_MAX = 128, SHARED_MAX = 4000000 /* vertices of a mesh */ };

typedef struct curve {
    const double *points, *normals; /* three numbers each; normals NULL: no ribbon */
    size_t segment_count;
    int degree, is_spline;
    double width[2];
} curve;

/* ---- Parameters -------------------------------------------------------------- */

static int read_points(pbrt *p, pbrt_params *params, curve *out)
{
    const pbrt_param *const points = rt_pbrt_find(params, "point point3", "P");
    const char *const basis = rt_pbrt_string(params, "basis", "bezier");
    const double degree = rt_pbrt_number(params, "degree", 3);
    const size_t count = points ? points->number_count / 3 : 0;
    out->is_spline = strcmp(basis, "bspline") == 0;
    if ((!out->is_spline && strcmp(basis, "bezier") != 0) || (degree != 2 && degree != 3)) {
        rt_import_note_at(p->import, params->line,
                          "a curve of basis '%.40s' and degree %g is left out", basis, degree);
        return 0;
    }
    out->degree = (int)degree;
    const size_t step = (size_t)out->degree;
    if (!points || points->number_count % 3 != 0 || count < step + 1 ||
        (!out->is_spline && (count - 1) % step != 0)) {
        rt_import_note_at(
            p->import, params->line,
            "a curve is left out: \"point3 P\" of %lu numbers is no %s curve of degree %d",
            (unsigned long)(points ? points->number_count : 0), basis, out->degree);
        return 0;
    }
    out->points = points->numbers;
    out->segment_count = out->is_spline ? count - step : (count - 1) / step;
    return 1;
}

static int read_type(pbrt *p, pbrt_params *params, curve *out)
{
    const char *const type = rt_pbrt_string(params, "type", "flat");
    if (strcmp(type, "ribbon") == 0) {
        const pbrt_param *const normals = rt_pbrt_find(params, "normal normal3", "N");
        if (!normals || normals->number_count != 3 * (out->segment_count + 1)) {
            rt_import_note_at(p->import, params->line,
                              "a ribbon of %lu segments is left out: it takes %lu normals "
                              "\"normal3 N\"",
                              (unsigned long)out->segment_count,
                              (unsigned long)out->segment_count + 1);
            return 0;
        }
        out->normals = normals->numbers;
    } else if (strcmp(type, "flat") == 0) {
        rt_import_note_at(p->import, params->line, "a flat curve became a tube of its width");
    } else if (strcmp(type, "cylinder") != 0) {
        rt_import_note_at(p->import, params->line, "a curve of type '%.40s' became a tube", type);
    }
    return 1;
}

/* Returns whether there is a curve that is seen. */
static int read_curve(pbrt *p, pbrt_params *params, curve *out)
{
    const double width = rt_pbrt_number(params, "width", 1);
    out->width[0] = rt_pbrt_number(params, "width0", width);
    out->width[1] = rt_pbrt_number(params, "width1", width);
    rt_pbrt_number(params, "splitdepth", 3); /* how pbrt looks for hits */
    if (p->import->failed || !read_points(p, params, out))
        return 0;
    if (out->width[0] >= 0 && out->width[1] >= 0 && out->width[0] + out->width[1] > 0)
        return read_type(p, params, out);
    rt_import_note_at(p->import, params->line, "a curve of width %g to %g is left out",
                      out->width[0], out->width[1]);
    return 0;
}

/* ---- Segments ---------------------------------------------------------------- */

/* The control points of a segment as those of a cubic Bezier curve. */
static void find_segment(const curve *c, size_t segment, double out[4][3])
{
    const size_t step = c->is_spline ? 1 : (size_t)c->degree;
    const double *const p = c->points + 3 * step * segment;
    for (int i = 0; i < 3; i++) {
        const double a = p[i], b = p[3 + i], d = p[6 + i], e = c->degree == 3 ? p[9 + i] : 0;
        if (c->degree == 3) {
            out[0][i] = c->is_spline ? (a + 4 * b + d) / 6 : a;
            out[1][i] = c->is_spline ? (2 * b + d) / 3 : b;
            out[2][i] = c->is_spline ? (b + 2 * d) / 3 : d;
            out[3][i] = c->is_spline ? (b + 4 * d + e) / 6 : e;
        } else {
            out[0][i] = c->is_spline ? (a + b) / 2 : a;
            out[3][i] = c->is_spline ? (b + d) / 2 : d;
            out[1][i] = (out[0][i] + 2 * b) / 3;
            out[2][i] = (out[3][i] + 2 * b) / 3;
        }
    }
}

/* A point of it and, unless it has none there, the direction. */
static void segment_at(double (*const b)[3], double t, double at[3], double along[3])
{
    const double s = 1 - t;
    double slope[3];
    for (int c = 0; c < 3; c++) {
        at[c] = s * s * s * b[0][c] + 3 * s * s * t * b[1][c] + 3 * s * t * t * b[2][c] +
                t * t * t * b[3][c];
        slope[c] = 3 * (s * s * (b[1][c] - b[0][c]) + 2 * s * t * (b[2][c] - b[1][c]) +
                        t * t * (b[3][c] - b[2][c]));
    }
    if (rt_vector_normalize(slope))
        memcpy(along, slope, sizeof slope);
}

/* In how many sections it is off by less than 1/80 of its width, along each axis. */
static size_t count_sections(double (*const b)[3], const double width[2])
{
    double bend = 0;
    for (int i = 0; i < 2; i++)
        for (int c = 0; c < 3; c++)
            bend = fmax(bend, fabs(b[i][c] - 2 * b[i + 1][c] + b[i + 2][c]));
    const double count = ceil(sqrt(0.75 * bend / (0.0125 * fmax(width[0], width[1]))));
    return (size_t)fmin(fmax(count, SECTIONS_MIN), SECTIONS_MAX);
}

/* The length of the control polygon. */
static double segment_length(double (*const b)[3])
{
    double length = 0;
    for (int i = 0; i < 3; i++) {
        const double step[3] = {b[i + 1][0] - b[i][0], b[i + 1][1] - b[i][1],
                                b[i + 1][2] - b[i][2]};
        length += rt_vector_length(step);
    }
    return length;
}

/* ---- Tubes and strips -------------------------------------------------------- */

/* The direction of 0 around the curve, from the section before, turned as little as may be. */
static void carry_zero(const double along[3], double zero[3])
{
    const double off = rt_vector_dot(zero, along);
    for (int c = 0; c < 3; c++)
        zero[c] -= off * along[c];
    if (!rt_vector_normalize(zero))
        rt_tube_zero(along, zero);
}

/* The normal between two, at the same rate all along the arc. */
static void normal_at(const double *normals, double t, double out[3])
{
    double a[3], b[3];
    memcpy(a, normals, sizeof a);
    memcpy(b, normals + 3, sizeof b);
    rt_vector_normalize(a);
    rt_vector_normalize(b);
    const double angle = acos(fmin(fmax(rt_vector_dot(a, b), -1), 1)), sine = sin(angle),
                 from = sine > 1e-9 ? sin((1 - t) * angle) / sine : 1,
                 to = sine > 1e-9 ? sin(t * angle) / sine : 0;
    for (int c = 0; c < 3; c++)
        out[c] = from * a[c] + to * b[c];
}

/* Two vertices across a ribbon; v is that of pbrt for who sees its front. */
static void add_pair(import_mesh *mesh, const double at[3], const double along[3],
                     const double normal[3], double width, double u, int is_joined)
{
    const uint32_t start = (uint32_t)mesh->vertex_count;
    const uint32_t corners[6] = {start - 2, start + 1, start, start - 2, start - 1, start + 1};
    double across[3], upright[3];
    rt_vector_cross(across, normal, along);
    rt_vector_normalize(across);
    rt_vector_cross(upright, along, across);
    for (uint32_t i = 0; i < 2; i++) {
        for (uint32_t c = 0; c < 3; c++) {
            mesh->positions[3 * (start + i) + c] =
                (float)(at[c] + (i ? -0.5 : 0.5) * width * across[c]);
            mesh->normals[3 * (start + i) + c] = (float)upright[c];
        }
        mesh->uv[2 * (start + i)] = (float)u;
        mesh->uv[2 * (start + i) + 1] = (float)i;
    }
    mesh->vertex_count += 2;
    if (!is_joined)
        return;
    memcpy(mesh->indices + 3 * mesh->triangle_count, corners, sizeof corners);
    mesh->triangle_count += 2;
}

/* Where a curve is on its way: at a smooth joint of segments both have the same section. */
typedef struct progress {
    double along[3], zero[3];
    int has_begun;
} progress;

static void begin_segment(double (*const b)[3], progress *on)
{
    double at[3], along[3] = {0, 0, 0};
    for (int i = 1; i < 4 && rt_vector_length(along) == 0; i++)
        for (int c = 0; c < 3; c++)
            along[c] = b[i][c] - b[0][c];
    if (!rt_vector_normalize(along))
        along[2] = 1;
    segment_at(b, 0, at, along);
    if (on->has_begun && rt_vector_dot(along, on->along) > 1 - 1e-9)
        return;
    memcpy(on->along, along, sizeof along);
    if (!on->has_begun)
        rt_tube_zero(along, on->zero);
    on->has_begun = 1;
}

static void add_segment(tube *out, const curve *c, size_t segment, progress *on)
{
    const double count = (double)c->segment_count, whole = c->width[1] - c->width[0];
    double b[4][3], normal[3];
    find_segment(c, segment, b);
    begin_segment(b, on);
    const size_t sections = count_sections(b, c->width);
    const double length = segment_length(b), rise = length > 0 ? whole / 2 / count / length : 0;
    for (size_t k = 0; k <= sections; k++) {
        const double t = (double)k / (double)sections,
                     width = c->width[0] + whole * ((double)segment + t) / count;
        tube_ring ring = {.radius = width / 2, .at = t, .lean = rise / sqrt(1 + rise * rise)};
        double along[3];
        memcpy(along, on->along, sizeof along);
        segment_at(b, t, ring.centre, along);
        if (k > 0)
            memcpy(on->along, along, sizeof along);
        memcpy(ring.along, on->along, sizeof along);
        carry_zero(ring.along, on->zero);
        memcpy(ring.zero, on->zero, sizeof ring.zero);
        if (!c->normals) {
            rt_tube_add_ring(out, &ring, k > 0);
            continue;
        }
        normal_at(c->normals + 3 * segment, t, normal);
        add_pair(&out->mesh, ring.centre, ring.along, normal, width, t, k > 0);
    }
}

/* Sides of a tube: fewer where the scene has very many segments. */
static uint32_t choose_sides(const pbrt *p)
{
    return p->segment_count < 1000 ? 24 : p->segment_count < 20000 ? 12 : 8;
}

static int make_mesh(pbrt *p, const curve *c, import_mesh *out)
{
    tube made = {.around = choose_sides(p), .is_u_along = 1};
    const size_t per = c->normals ? 2 : made.around + 1;
    size_t rings = 0;
    progress on = {.has_begun = 0};
    for (size_t i = 0; i < c->segment_count; i++) {
        double b[4][3];
        find_segment(c, i, b);
        rings += count_sections(b, c->width) + 1;
    }
    p->segment_count += c->segment_count;
    int is_good =
        rings * per <= UINT32_MAX / 8 ? 1 : rt_import_fail(p->import, 0, "too long a curve");
    is_good = is_good && rt_tube_reserve(p->import, &made, rings * per, 2 * rings * per);
    for (size_t i = 0; is_good && i < c->segment_count; i++)
        add_segment(&made, c, i, &on);
    *out = made.mesh;
    return is_good;
}

/* ---- Curves that share a mesh ------------------------------------------------ */

void rt_pbrt_flush_curves(pbrt *p)
{
    pbrt_strands *const strands = &p->strands;
    const pbrt_place here = rt_pbrt_here(&p->tokens);
    if (strands->mesh.vertex_count > 0 && !p->import->failed) {
        const int line = rt_pbrt_at(p->import, strands->place);
        strands->item.mesh = rt_pbrt_add_mesh(p, line, &strands->mesh, &strands->item);
        rt_pbrt_deliver(p, line, &strands->item);
        rt_pbrt_at(p->import, here);
    }
    rt_import_mesh_free(&strands->mesh);
    strands->vertex_room = strands->triangle_room = 0;
}

static int is_alike(const import_surface *a, const import_surface *b)
{
    return a->material == b->material &&
           memcmp(a->radiance, b->radiance, sizeof a->radiance) == 0 &&
           memcmp(&a->to_world, &b->to_world, sizeof a->to_world) == 0;
}

/* A list with room for `count` values of four bytes; as it was, and *is_good 0, without memory. */
static void *grow(void *list, size_t count, int *is_good)
{
    void *const moved = realloc(list, 4 * count);
    *is_good = *is_good && moved;
    return moved ? moved : list;
}

static void append(pbrt *p, const import_mesh *from)
{
    pbrt_strands *const to = &p->strands;
    import_mesh *const mesh = &to->mesh;
    const size_t vertices = mesh->vertex_count, triangles = mesh->triangle_count;
    int is_good = 1;
    if (vertices + from->vertex_count > to->vertex_room) {
        const size_t room = to->vertex_room = 2 * (vertices + from->vertex_count);
        mesh->positions = grow(mesh->positions, 3 * room, &is_good);
        mesh->normals = grow(mesh->normals, 3 * room, &is_good);
        mesh->uv = grow(mesh->uv, 2 * room, &is_good);
    }
    if (triangles + from->triangle_count > to->triangle_room) {
        to->triangle_room = 2 * (triangles + from->triangle_count);
        mesh->indices = grow(mesh->indices, 3 * to->triangle_room, &is_good);
    }
    if (!is_good) {
        rt_import_fail_memory(p->import);
        return;
    }
    memcpy(mesh->positions + 3 * vertices, from->positions, 12 * from->vertex_count);
    memcpy(mesh->normals + 3 * vertices, from->normals, 12 * from->vertex_count);
    memcpy(mesh->uv + 2 * vertices, from->uv, 8 * from->vertex_count);
    for (size_t i = 0; i < 3 * from->triangle_count; i++)
        mesh->indices[3 * triangles + i] = from->indices[i] + (uint32_t)vertices;
    mesh->vertex_count += from->vertex_count;
    mesh->triangle_count += from->triangle_count;
}

void rt_pbrt_curve(pbrt *p, pbrt_params *params)
{
    pbrt_item item = {.mesh = IMPORT_NONE};
    import_mesh mesh = {0};
    curve c = {0};
    const int is_seen = read_curve(p, params, &c);
    item.surface.material = is_seen ? rt_pbrt_use_material(p, params) : IMPORT_NONE;
    if (is_seen)
        rt_pbrt_note_unused(params, "curve");
    rt_pbrt_settle(p, params->line, &item);
    if (is_seen && make_mesh(p, &c, &mesh)) {
        if (c.normals && p->state.is_reversed)
            rt_import_mesh_turn(&mesh);
        if (!is_alike(&item.surface, &p->strands.item.surface) ||
            p->strands.mesh.vertex_count + mesh.vertex_count > SHARED_MAX)
            rt_pbrt_flush_curves(p);
        if (p->strands.mesh.vertex_count == 0) {
            p->strands.item = item;
            p->strands.place = rt_pbrt_here(&p->tokens);
        }
        append(p, &mesh);
    }
    rt_import_mesh_free(&mesh);
}
