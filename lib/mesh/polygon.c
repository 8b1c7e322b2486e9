/*
 * polygon.c - polygons as triangles: a fan where that is right, else ears of the outline that the
 * polygon has along its mean normal.
 */
#include <float.h>
#include <math.h>
#include <string.h>

#include "base/vec.h"
#include "mesh/ears.h"

enum { CORNERS_MAX = 1 << 30, FEW = 16 };

/* A polygon as seen along its mean normal. */
typedef struct view {
    const double *corners;
    size_t count;
    int axes[2];     /* of the plane that it is seen in: two of space, in such an order that it is
                        counter-clockwise there */
    double slope[2]; /* how far they move with the third axis along the normal */
    int third;
    double extent;     /* the farthest that a corner is from the first along an axis of space */
    double twice_area; /* in that plane */
} view;

/*
 * The normal times twice the area (M. Newell), about the first corner; and the sum of the lengths
 * of its terms, of which it is a small part where the polygon has no area.
 */
static double mean_normal(double normal[3], const double *p, size_t count)
{
    double sum = 0;
    memset(normal, 0, 3 * sizeof *normal);
    for (size_t i = 2; i < count; i++) {
        double a[3], b[3], n[3];
        for (int c = 0; c < 3; c++) {
            a[c] = p[3 * (i - 1) + (size_t)c] - p[c];
            b[c] = p[3 * i + (size_t)c] - p[c];
        }
        rt_vec_cross(n, a, b);
        for (int c = 0; c < 3; c++)
            normal[c] += n[c];
        sum += rt_vec_length(n);
    }
    return sum;
}

static double extent_of(const double *p, size_t count)
{
    double extent = 0;
    for (size_t i = 1; i < count; i++)
        for (size_t c = 0; c < 3; c++)
            extent = fmax(extent, fabs(p[3 * i + c] - p[c]));
    return extent;
}

/*
 * Chooses the plane of two axes that the normal is nearest to; along the normal all is moved into
 * it, so that it is exact where the polygon lies in such a plane. Returns what that finds.
 */
static rt_polygon look(view *v)
{
    double normal[3];
    const double sum = mean_normal(normal, v->corners, v->count);
    int z = fabs(normal[1]) > fabs(normal[0]);
    z = fabs(normal[2]) > fabs(normal[z]) ? 2 : z;
    v->extent = extent_of(v->corners, v->count);
    if (!(sum > 1e-14 * v->extent * v->extent))
        return RT_POLYGON_NO_AREA;
    if (!(rt_vec_length(normal) > 1e-12 * sum))
        return RT_POLYGON_CROSSING;
    v->third = z;
    v->axes[0] = (z + (normal[z] > 0 ? 1 : 2)) % 3;
    v->axes[1] = (z + (normal[z] > 0 ? 2 : 1)) % 3;
    v->twice_area = fabs(normal[z]);
    for (int i = 0; i < 2; i++)
        v->slope[i] = normal[v->axes[i]] / normal[z];
    return RT_POLYGON_SIMPLE;
}

static void see(double out[2], const view *v, size_t corner)
{
    const double *p = v->corners + 3 * corner, *first = v->corners;
    for (int i = 0; i < 2; i++)
        out[i] = p[v->axes[i]] - first[v->axes[i]] - v->slope[i] * (p[v->third] - first[v->third]);
}

/*
 * Whether a fan around the first corner covers the inside once: its triangles all turn to the left,
 * less than once around. One that turns to the right may come from rounding in single precision;
 * all such together are less than a millionth of the area.
 */
static int is_fan(const view *v)
{
    double last[2] = {0, 0}, angle = 0, inverted = 0;
    const double rounding = 2 * FLT_EPSILON * v->extent;
    for (size_t i = 1; i < v->count; i++) {
        double p[2];
        see(p, v, i);
        const double turn = last[0] * p[1] - last[1] * p[0];
        const double along = last[0] * p[0] + last[1] * p[1];
        if (turn < 0 && (-turn > rounding * hypot(last[0], last[1]) || along < 0))
            return 0;
        inverted += turn < 0 ? -turn : 0;
        angle += atan2(turn, along);
        if (p[0] != 0 || p[1] != 0)
            memcpy(last, p, sizeof last);
    }
    return angle < 6.28 && inverted <= 1e-6 * v->twice_area;
}

static void make_fan(uint32_t (*triangles)[3], size_t count)
{
    for (uint32_t i = 2; i < count; i++) {
        uint32_t *triangle = triangles[i - 2];
        triangle[0] = 0;
        triangle[1] = i - 1;
        triangle[2] = i;
    }
}

/* Whether the outline is known not to turn round to the left once, as a simple one does. */
static int turns_too_often(const rt_outline *outline)
{
    double angle = 0;
    for (size_t i = 0; i < outline->count; i++) {
        const double *a = outline->points[i];
        const double *b = outline->points[(i + 1) % outline->count];
        const double *c = outline->points[(i + 2) % outline->count];
        const double u[2] = {b[0] - a[0], b[1] - a[1]}, w[2] = {c[0] - b[0], c[1] - b[1]};
        const double turn = rt_outline_turn(outline, a, b, c);
        const double along = u[0] * w[0] + u[1] * w[1];
        if (turn == 0 && along <= 0)
            return 0; /* a half-turn to the left or to the right: it cannot be told */
        angle += atan2(turn, along);
    }
    return fabs(angle - 6.283185307179586) > 3;
}

static rt_status cut_ears(uint32_t (*triangles)[3], rt_polygon *found, const view *v,
                          const rt_mesh_source *source)
{
    double few[FEW][2], (*many)[2] = NULL;
    if (v->count > FEW && rt_mesh_resize(source, (void **)&many, v->count, sizeof *many) != RT_OK)
        return RT_ERROR_MEMORY;
    double(*const points)[2] = many ? many : few;
    const rt_outline outline = {(const double(*)[2])points, v->count, v->extent, source};
    for (size_t i = 0; i < v->count; i++)
        see(points[i], v, i);
    rt_status status = rt_outline_cross(found, &outline);
    if (*found == RT_POLYGON_SIMPLE && turns_too_often(&outline))
        *found = RT_POLYGON_CROSSING;
    if (status == RT_OK)
        status = rt_outline_cut(triangles, found, &outline);
    rt_memory_free(many);
    return status;
}

static rt_status check(const double *corners, size_t count, rt_error *error)
{
    if (count < 3 || count > CORNERS_MAX)
        return rt_fail_field(error, RT_ERROR_INPUT, "count",
                             "polygon: %zu corners; there must be 3 to %d", count, CORNERS_MAX);
    for (size_t i = 0; i < 3 * count; i++)
        if (!(fabs(corners[i]) <= FLT_MAX))
            return rt_fail_field(error, RT_ERROR_INPUT, "corners",
                                 "polygon: %g of corner %zu is not a finite float", corners[i],
                                 i / 3);
    return RT_OK;
}

rt_status rt_polygon_cut_of(uint32_t *triangles, rt_polygon *found, const double *corners,
                            size_t count, const rt_mesh_source *source)
{
    uint32_t(*out)[3] = (uint32_t(*)[3])(void *)triangles;
    view v = {.corners = corners, .count = count};
    rt_status status = check(corners, count, source->error);
    if (status != RT_OK)
        return status;
    rt_polygon kind = look(&v);
    if (kind != RT_POLYGON_SIMPLE || count == 3 || is_fan(&v))
        make_fan(out, count);
    else
        status = cut_ears(out, &kind, &v, source);
    if (found)
        *found = kind;
    return status;
}

rt_status rt_polygon_cut(uint32_t *triangles, rt_polygon *found, const double *corners,
                         size_t count, rt_error *error)
{
    rt_stage_progress progress = {.hooks = NULL};
    return rt_polygon_cut_of(triangles, found, corners, count,
                             &(rt_mesh_source){.progress = &progress, .error = error});
}
