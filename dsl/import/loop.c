/*
 * loop.c - Loop's scheme: C. Loop, Smooth Subdivision Surfaces Based on Triangles (1987), with the
 * boundaries of H. Hoppe et al., Piecewise Smooth Surface Reconstruction (1994), and the tangents
 * of D. Zorin et al., Subdivision for Modeling and Animation (SIGGRAPH course, 2000). All weights
 * are those of pbrt: boundaries have no corners, and 1/5 where the limit of theirs has 1/6. Its
 * tangents are of points that it has moved to the limit, these of points before that.
 *
 * Side 3f + k of triangle f runs from its corner k to the next one. Its twin runs back in the
 * triangle across, or is NONE at a boundary.
 */
#include "dsl/import/loop.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define NONE UINT32_MAX

typedef struct surface {
    double (*points)[3];
    uint32_t *corners, *twins; /* by side */
    /* By vertex a side that starts there, at boundaries that without a twin; NONE: no triangle. */
    uint32_t *starts;
    uint32_t point_count, triangle_count;
} surface;

static uint32_t next(uint32_t side)
{
    return side % 3 == 2 ? side - 2 : side + 1;
}

static uint32_t previous(uint32_t side)
{
    return side % 3 == 0 ? side + 2 : side - 1;
}

static void free_surface(surface *s)
{
    free(s->points);
    free(s->corners);
    free(s->twins);
    free(s->starts);
}

static int reserve(importer *import, surface *s, size_t points, size_t triangles)
{
    *s = (surface){.point_count = (uint32_t)points, .triangle_count = (uint32_t)triangles};
    s->points = malloc((points + 1) * sizeof *s->points);
    s->corners = malloc((3 * triangles + 1) * sizeof *s->corners);
    s->twins = malloc((3 * triangles + 1) * sizeof *s->twins);
    s->starts = malloc((points + 1) * sizeof *s->starts);
    return s->points && s->corners && s->twins && s->starts ? 1 : rt_import_fail_memory(import);
}

/* ---- What lies around -------------------------------------------------------- */

static int is_boundary(const surface *s, uint32_t vertex)
{
    return s->twins[s->starts[vertex]] == NONE;
}

/* The side that starts where this one does, counter-clockwise next to it; NONE: a boundary. */
static uint32_t turn(const surface *s, uint32_t side)
{
    return s->twins[previous(side)];
}

/* How many triangles lie around a vertex, from its start on. */
static uint32_t count_fan(const surface *s, uint32_t vertex)
{
    const uint32_t first = s->starts[vertex];
    uint32_t side = first, count = 0;
    do {
        count++;
        side = turn(s, side);
    } while (side != NONE && side != first);
    return count;
}

/* Neighbours around a vertex: at a boundary one more than triangles. */
static uint32_t valence(const surface *s, uint32_t vertex)
{
    return count_fan(s, vertex) + (is_boundary(s, vertex) ? 1 : 0);
}

typedef struct side_ends {
    uint32_t low, high, side;
} side_ends;

static int compare_ends(const void *a, const void *b)
{
    const side_ends *const x = a, *const y = b;
    if (x->low != y->low)
        return x->low < y->low ? -1 : 1;
    if (x->high != y->high)
        return x->high < y->high ? -1 : 1;
    return x->side < y->side ? -1 : x->side > y->side;
}

/* Pairs the sides of equal ends; returns 0 where that is not one with one that runs back. */
static int pair_sides(surface *s, side_ends *ends)
{
    const uint32_t count = 3 * s->triangle_count;
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t a = s->corners[i], b = s->corners[next(i)];
        if (a == b)
            return 0;
        ends[i] = (side_ends){a < b ? a : b, a < b ? b : a, i};
        s->twins[i] = NONE;
    }
    qsort(ends, count, sizeof *ends, compare_ends);
    for (uint32_t i = 1; i < count; i++) {
        if (ends[i].low != ends[i - 1].low || ends[i].high != ends[i - 1].high)
            continue;
        const uint32_t a = ends[i - 1].side, b = ends[i].side;
        if (s->twins[a] != NONE || s->corners[a] == s->corners[b])
            return 0;
        s->twins[a] = b;
        s->twins[b] = a;
    }
    return 1;
}

/* Finds where the fans start; returns 0 where a vertex has several. */
static int start_fans(surface *s)
{
    size_t in_fans = 0;
    for (uint32_t v = 0; v < s->point_count; v++)
        s->starts[v] = NONE;
    for (uint32_t i = 0; i < 3 * s->triangle_count; i++)
        if (s->starts[s->corners[i]] == NONE || s->twins[i] == NONE)
            s->starts[s->corners[i]] = i;
    for (uint32_t v = 0; v < s->point_count; v++)
        in_fans += s->starts[v] == NONE ? 0 : count_fan(s, v);
    return in_fans == 3 * (size_t)s->triangle_count;
}

static int begin(importer *import, surface *s, const import_mesh *mesh)
{
    if (!reserve(import, s, mesh->vertex_count, mesh->triangle_count))
        return 0;
    for (size_t i = 0; i < 3 * mesh->vertex_count; i++)
        s->points[i / 3][i % 3] = mesh->positions[i];
    memcpy(s->corners, mesh->indices, 3 * mesh->triangle_count * sizeof *s->corners);
    side_ends *const ends = malloc((3 * mesh->triangle_count + 1) * sizeof *ends);
    if (!ends)
        return rt_import_fail_memory(import);
    const int is_manifold = pair_sides(s, ends) && start_fans(s);
    free(ends);
    return is_manifold;
}

/* ---- Masks ------------------------------------------------------------------- */

static void add(double out[3], double weight, const double p[3])
{
    for (int c = 0; c < 3; c++)
        out[c] += weight * p[c];
}

/* The weight of each neighbour of an inner vertex. */
static double beta(uint32_t n)
{
    return n == 3 ? 3.0 / 16 : 3.0 / (8.0 * n);
}

/* The same in the limit. */
static double limit_weight(uint32_t n)
{
    return 1 / (n + 3 / (8 * beta(n)));
}

/* A vertex with its neighbours: by the weight of an inner one, or along a boundary. */
static void average(const surface *s, uint32_t vertex, double inner, double boundary, double out[3])
{
    const uint32_t first = s->starts[vertex];
    uint32_t side = first, last = first;
    memset(out, 0, 3 * sizeof *out);
    if (is_boundary(s, vertex)) {
        for (; side != NONE; side = turn(s, side))
            last = side;
        add(out, 1 - 2 * boundary, s->points[vertex]);
        add(out, boundary, s->points[s->corners[next(first)]]);
        add(out, boundary, s->points[s->corners[previous(last)]]);
        return;
    }
    add(out, 1 - valence(s, vertex) * inner, s->points[vertex]);
    do {
        add(out, inner, s->points[s->corners[next(side)]]);
        side = turn(s, side);
    } while (side != first);
}

/* The new vertex on a side. */
static void split(const surface *s, uint32_t side, double out[3])
{
    const uint32_t twin = s->twins[side];
    const double near = twin == NONE ? 0.5 : 3.0 / 8;
    memset(out, 0, 3 * sizeof *out);
    add(out, near, s->points[s->corners[side]]);
    add(out, near, s->points[s->corners[next(side)]]);
    if (twin == NONE)
        return;
    add(out, 1.0 / 8, s->points[s->corners[previous(side)]]);
    add(out, 1.0 / 8, s->points[s->corners[previous(twin)]]);
}

/* The weight of neighbour i of n at a boundary, in the tangent that leads inward. */
static double inward_weight(uint32_t n, uint32_t i)
{
    static const double regular[4] = {-1, 2, 2, -1};
    const double step = IMPORT_PI / (n - 1.0);
    if (n == 2)
        return 1;
    if (n == 3)
        return i == 1;
    if (n == 4)
        return regular[i];
    return i == 0 || i == n - 1 ? -sin(step) : (2 - 2 * cos(step)) * sin(i * step);
}

/* The normal of the limit surface, from its two tangents; all zero where they are along a line. */
static void limit_normal(const surface *s, uint32_t vertex, double out[3])
{
    const int is_open = is_boundary(s, vertex);
    const uint32_t n = valence(s, vertex);
    double a[3] = {0, 0, 0}, b[3] = {0, 0, 0};
    uint32_t side = s->starts[vertex], last = side;
    for (uint32_t i = 0; i < n; i++) {
        const double *const p = s->points[s->corners[side == NONE ? previous(last) : next(side)]];
        const double angle = 2 * IMPORT_PI * i / n;
        add(a, is_open ? (i == 0) - (i == n - 1) : cos(angle), p);
        add(b, is_open ? inward_weight(n, i) : sin(angle), p);
        last = side;
        side = side == NONE ? NONE : turn(s, side);
    }
    if (is_open && n < 5)
        add(b, n == 3 ? -1 : -2, s->points[vertex]);
    rt_vector_cross(out, a, b);
    if (!rt_vector_normalize(out))
        memset(out, 0, 3 * sizeof *out);
}

/* ---- Subdivision ------------------------------------------------------------- */

/* The halves of a side in the next level: that at its start, and that at its end. */
static uint32_t first_half(uint32_t side)
{
    return 3 * (4 * (side / 3) + side % 3);
}

static uint32_t second_half(uint32_t side)
{
    return first_half(next(side)) + 2;
}

/*
 * The sides of the four triangles of one: at each corner that corner, and the new vertices of the
 * side behind and of that before it; then the one of these three.
 */
static void join(const surface *s, const uint32_t *middles, surface *out)
{
    for (uint32_t side = 0; side < 3 * s->triangle_count; side++) {
        const uint32_t half = first_half(side), twin = s->twins[side],
                       centre = 3 * (4 * (side / 3) + 3);
        out->corners[half] = s->corners[side];
        out->corners[half + 1] = out->corners[centre + side % 3] = middles[side];
        out->corners[half + 2] = middles[previous(side)];
        out->twins[half] = twin == NONE ? NONE : second_half(twin);
        out->twins[second_half(side)] = twin == NONE ? NONE : first_half(twin);
        out->twins[half + 1] = centre + previous(side) % 3;
        out->twins[centre + previous(side) % 3] = half + 1;
        out->starts[middles[side]] = second_half(side);
    }
}

/* Numbers the new vertices, behind the old ones, by side; returns how many all are. */
static uint32_t number_middles(const surface *s, uint32_t *middles)
{
    uint32_t count = s->point_count;
    for (uint32_t side = 0; side < 3 * s->triangle_count; side++)
        middles[side] = s->twins[side] < side ? middles[s->twins[side]] : count++;
    return count;
}

/* One level: s becomes the finer one. Returns 0 after a failure. */
static int refine(importer *import, surface *s)
{
    surface out;
    uint32_t *const middles = malloc((3 * (size_t)s->triangle_count + 1) * sizeof *middles);
    if (!middles)
        return rt_import_fail_memory(import);
    const int is_good =
        reserve(import, &out, number_middles(s, middles), 4 * (size_t)s->triangle_count);
    if (is_good)
        join(s, middles, &out);
    for (uint32_t v = 0; is_good && v < s->point_count; v++) {
        const uint32_t start = s->starts[v];
        out.starts[v] = start == NONE ? NONE : first_half(start);
        if (start == NONE)
            memcpy(out.points[v], s->points[v], sizeof out.points[v]);
        else
            average(s, v, beta(valence(s, v)), 1.0 / 8, out.points[v]);
    }
    for (uint32_t side = 0; is_good && side < 3 * s->triangle_count; side++)
        if (!(s->twins[side] < side))
            split(s, side, out.points[middles[side]]);
    free(middles);
    free_surface(is_good ? s : &out);
    if (is_good)
        *s = out;
    return is_good;
}

/* ---- The whole --------------------------------------------------------------- */

/* Makes the mesh anew: vertices in the limit, those without a triangle where they are. */
static int finish(importer *import, surface *s, import_mesh *mesh)
{
    import_mesh made = {.vertex_count = s->point_count, .triangle_count = s->triangle_count};
    double p[3], normal[3];
    made.positions = malloc((3 * made.vertex_count + 1) * sizeof *made.positions);
    made.normals = malloc((3 * made.vertex_count + 1) * sizeof *made.normals);
    if (!made.positions || !made.normals) {
        rt_import_mesh_free(&made);
        return rt_import_fail_memory(import);
    }
    for (uint32_t v = 0; v < s->point_count; v++) {
        memcpy(p, s->points[v], sizeof p);
        memset(normal, 0, sizeof normal);
        if (s->starts[v] != NONE) {
            average(s, v, limit_weight(valence(s, v)), 1.0 / 5, p);
            limit_normal(s, v, normal);
        }
        for (size_t c = 0; c < 3; c++) {
            made.positions[3 * v + c] = (float)p[c];
            made.normals[3 * v + c] = (float)normal[c];
        }
    }
    made.indices = s->corners;
    s->corners = NULL;
    rt_import_mesh_free(mesh);
    *mesh = made;
    return 1;
}

int rt_loop_levels(size_t triangle_count, double wanted)
{
    int levels = 0;
    for (size_t made = 4 * triangle_count;
         levels < LOOP_LEVELS_MAX && levels + 1 <= wanted && made <= LOOP_TRIANGLES_MAX; made *= 4)
        levels++;
    return levels;
}

int rt_loop_subdivide(importer *import, int levels, import_mesh *mesh)
{
    surface s = {0};
    int is_good = mesh->triangle_count <= UINT32_MAX / 16 && begin(import, &s, mesh);
    for (int i = 0; is_good && i < levels; i++)
        is_good = refine(import, &s);
    is_good = is_good && finish(import, &s, mesh);
    free_surface(&s);
    return is_good;
}
