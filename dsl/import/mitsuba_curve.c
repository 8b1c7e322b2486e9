/*
 * mitsuba_curve.c - curves of Mitsuba 3 as meshes: `linearcurve`, straight between its control
 * points with a sphere at each, and `bsplinecurve`, cubic. A file has a control point with its
 * radius on each line, and an empty line between two curves. u goes around, v along all curves.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "dsl/import/mitsuba.h"
#include "dsl/import/tube.h"

/* Around a curve and along a segment of a spline; fewer where there are very many. */
enum { AROUND = 24, ALONG = 12, TRIANGLES_MAX = 16000000, POINTS_MAX = 4000000 };

typedef struct curve_points {
    double (*at)[4]; /* [count]: position and radius */
    size_t *first;   /* [curve_count + 1] into at */
    size_t count, curve_count;
} curve_points;

/* ---- The file ---------------------------------------------------------------- */

/* Where a curve ends: at an empty line, or at the end. Returns whether there is room. */
static int end_curve(mitsuba *m, curve_points *points)
{
    if (points->first[points->curve_count] == points->count)
        return 1;
    size_t *moved = rt_import_grow(m->import, points->first, ++points->curve_count, sizeof *moved);
    if (!moved)
        return 0;
    points->first = moved;
    points->first[points->curve_count] = points->count;
    return 1;
}

static int read_point(mitsuba *m, xml_node *node, const char *name, const char **text, int line,
                      curve_points *points)
{
    double(*moved)[4] = rt_import_grow(m->import, points->at, points->count, sizeof *moved);
    if (!moved)
        return 0;
    points->at = moved;
    for (int c = 0; c < 4; c++) {
        *text += strspn(*text, " \t,");
        if (!rt_import_number(&points->at[points->count][c], text) ||
            (c == 3 && !(points->at[points->count][c] >= 0)))
            return rt_import_fail(rt_mitsuba_at(m, node), node->line,
                                  "'%.100s': line %d is no position and radius", name, line);
    }
    if (points->count++ == POINTS_MAX)
        return rt_import_fail(rt_mitsuba_at(m, node), node->line,
                              "'%.100s' has more than %d control points", name, POINTS_MAX);
    return 1;
}

static int read_points(mitsuba *m, xml_node *node, const char *name, size_t least,
                       curve_points *points)
{
    size_t size;
    char *const text = rt_import_read_text(rt_mitsuba_at(m, node), node->line, name, &size);
    int is_good = text && (points->first = calloc(1, sizeof *points->first)) != NULL;
    if (text && !is_good)
        rt_import_fail_memory(m->import);
    int line = 1;
    for (const char *at = text; is_good && *at; line++) {
        at += strspn(at, " \t\r");
        is_good = *at == '\n' || *at == '\0' ? end_curve(m, points)
                                             : read_point(m, node, name, &at, line, points);
        at += strcspn(at, "\n");
        at += *at == '\n';
    }
    is_good = is_good && end_curve(m, points);
    free(text);
    for (size_t i = 0; is_good && i < points->curve_count; i++)
        if (points->first[i + 1] - points->first[i] < least)
            is_good = rt_import_fail(rt_mitsuba_at(m, node), node->line,
                                     "'%.100s': curve %lu has fewer than %lu control points", name,
                                     (unsigned long)i + 1, (unsigned long)least);
    if (is_good && points->curve_count == 0)
        is_good = rt_import_fail(rt_mitsuba_at(m, node), node->line, "'%.100s' has no curve", name);
    return is_good;
}

/* ---- Rings ------------------------------------------------------------------- */

/* A ring of vertices about a centre, as tube.h has it. */
static void add_ring(tube *out, const double centre[3], double radius, const double along[3],
                     double lean, double v, int is_joined)
{
    tube_ring ring = {.radius = radius, .lean = lean, .at = v};
    memcpy(ring.centre, centre, sizeof ring.centre);
    memcpy(ring.along, along, sizeof ring.along);
    rt_tube_zero(along, ring.zero);
    rt_tube_add_ring(out, &ring, is_joined);
}

static void add_sphere(tube *out, const double at[4], const double along[3], double v)
{
    const uint32_t rings = out->around / 2;
    for (uint32_t i = 0; i <= rings; i++) {
        const double angle = IMPORT_PI * i / rings, height = -cos(angle);
        double centre[3];
        for (int c = 0; c < 3; c++)
            centre[c] = at[c] + at[3] * height * along[c];
        add_ring(out, centre, at[3] * sin(angle), along, -height, v, i > 0);
    }
}

/* ---- Straight curves --------------------------------------------------------- */

/* The cone that touches the spheres around both ends. */
static void add_cone(tube *out, const double a[4], const double b[4], double v, double v_end)
{
    double along[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const double length = rt_vector_length(along);
    if (length <= fabs(b[3] - a[3]) || !rt_vector_normalize(along))
        return; /* one sphere holds the other */
    const double lean = (b[3] - a[3]) / length, upright = sqrt(1 - lean * lean);
    for (int end = 0; end < 2; end++) {
        const double *const at = end ? b : a;
        double centre[3];
        for (int c = 0; c < 3; c++)
            centre[c] = at[c] - at[3] * lean * along[c];
        add_ring(out, centre, at[3] * upright, along, lean, end ? v_end : v, end);
    }
}

static void add_straight(tube *out, const curve_points *points, size_t curve, size_t *segment,
                         size_t segments)
{
    const size_t first = points->first[curve], last = points->first[curve + 1] - 1;
    double along[3] = {0, 0, 1};
    for (size_t i = first; i <= last; i++) {
        const double v = (double)*segment / (double)segments;
        const double *const a = points->at[i];
        if (i < last)
            for (int c = 0; c < 3; c++)
                along[c] = points->at[i + 1][c] - a[c];
        rt_vector_normalize(along);
        add_sphere(out, a, along, v);
        if (i < last)
            add_cone(out, a, points->at[i + 1], v, (double)++*segment / (double)segments);
    }
}

/* ---- Splines ----------------------------------------------------------------- */

/* Position and radius of a uniform cubic B-spline, and their derivatives. */
static void spline_at(double (*p)[4], double t, double at[4], double slope[4])
{
    const double s = 1 - t,
                 weights[4] = {s * s * s / 6, (4 - 6 * t * t + 3 * t * t * t) / 6,
                               (4 - 6 * s * s + 3 * s * s * s) / 6, t * t * t / 6},
                 slopes[4] = {-s * s / 2, (3 * t * t - 4 * t) / 2, (4 * s - 3 * s * s) / 2,
                              t * t / 2};
    for (int c = 0; c < 4; c++) {
        at[c] = slope[c] = 0;
        for (int i = 0; i < 4; i++) {
            at[c] += weights[i] * p[i][c];
            slope[c] += slopes[i] * p[i][c];
        }
    }
}

static void add_spline(tube *out, const curve_points *points, size_t curve, size_t *segment,
                       size_t segments)
{
    const size_t first = points->first[curve], last = points->first[curve + 1] - 3;
    double at[4], slope[4], along[3] = {0, 0, 1};
    for (size_t i = first; i < last; i++, ++*segment)
        for (size_t k = i == first ? 0 : 1; k <= ALONG; k++) {
            const double t = (double)k / ALONG;
            spline_at(points->at + i, t, at, slope);
            const double speed = rt_vector_length(slope);
            if (speed > 0)
                for (int c = 0; c < 3; c++)
                    along[c] = slope[c] / speed;
            const double rise = speed > 0 ? slope[3] / speed : 0;
            add_ring(out, at, at[3], along, rise / sqrt(1 + rise * rise),
                     ((double)*segment + t) / (double)segments, i > first || k > 0);
        }
}

/* ---- The whole --------------------------------------------------------------- */

/* Rings that all curves come to, at most. */
static size_t rings_of(const curve_points *points, size_t segments, int is_spline, uint32_t around)
{
    return is_spline ? segments * ALONG + points->curve_count
                     : 2 * segments + points->count * (around / 2 + 1);
}

int rt_mitsuba_read_curves(mitsuba *m, xml_node *node, const char *name, int is_spline,
                           const matrix *to_world, import_mesh *out)
{
    curve_points points = {NULL, NULL, 0, 0};
    tube made = {.around = AROUND};
    size_t segment = 0;
    int is_good = read_points(m, node, name, is_spline ? 4 : 2, &points);
    const size_t segments = is_good ? points.count - (is_spline ? 3 : 1) * points.curve_count : 0;
    while (made.around > 4 &&
           2 * made.around * rings_of(&points, segments, is_spline, made.around) > TRIANGLES_MAX)
        made.around -= 2;
    const size_t rings = rings_of(&points, segments, is_spline, made.around);
    for (size_t i = 0; i < points.count; i++)
        rt_matrix_point(points.at[i], to_world, points.at[i]);
    is_good = is_good &&
              rt_tube_reserve(m->import, &made, rings * (made.around + 1), 2 * rings * made.around);
    for (size_t i = 0; is_good && i < points.curve_count; i++)
        if (is_spline)
            add_spline(&made, &points, i, &segment, segments);
        else
            add_straight(&made, &points, i, &segment, segments);
    free(points.at);
    free(points.first);
    *out = made.mesh;
    return is_good;
}
