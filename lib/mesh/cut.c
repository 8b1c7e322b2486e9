/* cut.c - cuts the polygons of a file that are no fans, and tells of those that are not simple. */
#include <stdio.h>
#include <string.h>

#include "mesh/canonical.h"
#include "mesh/ears.h"

/* A polygon that is being cut. */
typedef struct polygon {
    uint32_t *corners;
    double *points;      /* [room][3] */
    uint32_t *triangles; /* [room][3], numbers of corners */
    size_t count, room;
} polygon;

static rt_status make_room(polygon *p, const rt_mesh_source *source, size_t count)
{
    p->count = count;
    if (count <= p->room)
        return RT_OK;
    const size_t room = count < 16 ? 16 : count;
    rt_status status = rt_mesh_resize(source, (void **)&p->corners, room, sizeof *p->corners);
    if (status == RT_OK)
        status = rt_mesh_resize(source, (void **)&p->points, room, 3 * sizeof *p->points);
    if (status == RT_OK)
        status = rt_mesh_resize(source, (void **)&p->triangles, room, 3 * sizeof *p->triangles);
    p->room = status == RT_OK ? room : 0;
    return status;
}

static uint8_t *face_at(const rt_canonical *mesh, uint32_t triangle)
{
    return mesh->faces + (size_t)triangle * RT_CANONICAL_FACE;
}

/* Takes the corners back out of a fan. */
static void gather(polygon *p, const rt_canonical *mesh, uint32_t first)
{
    memcpy(p->corners, face_at(mesh, first) + 1, 2 * sizeof *p->corners);
    for (size_t i = 2; i < p->count; i++)
        memcpy(p->corners + i, face_at(mesh, first + (uint32_t)i - 2) + 9, sizeof *p->corners);
    for (size_t i = 0; i < p->count; i++)
        rt_canonical_point(p->points + 3 * i, mesh, p->corners[i]);
}

static void replace(const polygon *p, const rt_canonical *mesh, uint32_t first)
{
    for (size_t i = 0; i < 3 * (p->count - 2); i++)
        memcpy(face_at(mesh, first + (uint32_t)(i / 3)) + 1 + 4 * (i % 3),
               p->corners + p->triangles[i], sizeof *p->corners);
}

/* Polygons of one kind. */
typedef struct odd {
    uint64_t count, face; /* how many, and the first one, from 0 */
    size_t corners;       /* of that */
} odd;

static void warn_of(rt_canonical *mesh, const rt_mesh_source *source, rt_polygon found,
                    const odd *first, size_t line)
{
    static const char *const what[] = {
        [RT_POLYGON_SIMPLE] = "",
        [RT_POLYGON_CROSSING] = "crosses itself: parts of it may be covered twice or not at all",
        [RT_POLYGON_NO_AREA] = "has all its corners on one line: it is not seen",
        [RT_POLYGON_TOO_INVOLVED] =
            "is too involved to cut: parts of it may be covered twice or not at all",
    };
    char others[64] = "", number[80] = "this face";
    if (first->count > 1)
        snprintf(others, sizeof others, " (and %llu more faces)",
                 (unsigned long long)first->count - 1);
    if (!line)
        snprintf(number, sizeof number, "face %llu%s, counted from 0,",
                 (unsigned long long)first->face,
                 mesh->skipped_faces ? " of those with three corners or more" : "");
    rt_mesh_warn(&mesh->warnings, source, line, "%s of %zu corners %s%s", number, first->corners,
                 what[found], others);
}

static rt_status cut_fan(rt_canonical *mesh, const rt_mesh_source *source, polygon *p,
                         uint32_t first, rt_polygon *found)
{
    rt_status status = make_room(p, source, p->count);
    if (status != RT_OK)
        return status;
    gather(p, mesh, first);
    status = rt_polygon_cut_of(p->triangles, found, p->points, p->count, source);
    if (status == RT_OK)
        replace(p, mesh, first);
    return status;
}

static rt_status cut_all(rt_canonical *mesh, const rt_mesh_source *source, polygon *p,
                         odd odds[RT_POLYGON_TOO_INVOLVED + 1])
{
    uint64_t face = 0, corners = 0; /* since a cancel was asked for */
    rt_status status = RT_OK;
    for (uint32_t i = 0, next; i < mesh->triangle_count && status == RT_OK; i = next, face++) {
        for (next = i + 1;
             next < mesh->triangle_count && *face_at(mesh, next) == RT_CANONICAL_GOES_ON; next++)
            *face_at(mesh, next) = RT_CANONICAL_FIRST;
        if (next - i < 2)
            continue;
        rt_polygon found = RT_POLYGON_SIMPLE;
        p->count = next - i + 2;
        status = cut_fan(mesh, source, p, i, &found);
        if (odds[found].count++ == 0)
            odds[found] = (odd){1, face, p->count};
        corners += p->count;
        if (status == RT_OK && corners > 0xfff) {
            status = rt_mesh_step(source, source->size, source->size);
            corners = 0;
        }
    }
    return status;
}

rt_status rt_canonical_cut(rt_canonical *mesh, const rt_mesh_source *source,
                           rt_line_of_face *line_of)
{
    polygon p = {NULL, NULL, NULL, 0, 0};
    odd odds[RT_POLYGON_TOO_INVOLVED + 1] = {{0, 0, 0}};
    rt_status status = cut_all(mesh, source, &p, odds);
    for (int i = RT_POLYGON_SIMPLE + 1; i <= RT_POLYGON_TOO_INVOLVED && status == RT_OK; i++)
        if (odds[i].count)
            warn_of(mesh, source, (rt_polygon)i, &odds[i],
                    line_of ? line_of(source, odds[i].face) : 0);
    rt_memory_free(p.corners);
    rt_memory_free(p.points);
    rt_memory_free(p.triangles);
    return status;
}
