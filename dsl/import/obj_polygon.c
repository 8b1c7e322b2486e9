/* obj_polygon.c - faces of an OBJ file as triangles. */
#include <stdlib.h>

#include "dsl/import/obj_data.h"
#include "rt.h"

enum { TRIANGLES_MAX = 100000000 };

static void push_triangle(importer *import, obj_data *data, int line, const obj_corner *a,
                          const obj_corner *b, const obj_corner *c)
{
    if (data->triangle_count == data->triangle_capacity) {
        size_t grown = 2 * data->triangle_capacity + 1024;
        obj_corner *corners =
            grown < TRIANGLES_MAX ? realloc(data->corners, 3 * grown * sizeof *corners) : NULL;
        data->corners = corners ? corners : data->corners;
        int *groups = corners ? realloc(data->groups, grown * sizeof *groups) : NULL;
        data->groups = groups ? groups : data->groups;
        uint32_t *smooth = groups ? realloc(data->smooth, grown * sizeof *smooth) : NULL;
        data->smooth = smooth ? smooth : data->smooth;
        if (!smooth) {
            rt_import_fail(import, line, "too many triangles for the memory that there is");
            import->is_memory = 1;
            return;
        }
        data->triangle_capacity = grown;
    }
    obj_corner *at = data->corners + 3 * data->triangle_count;
    at[0] = *a;
    at[1] = *b;
    at[2] = *c;
    data->smooth[data->triangle_count] = data->smoothing;
    data->groups[data->triangle_count++] = data->group;
}

int rt_obj_polygon_grow(importer *import, obj_polygon *polygon)
{
    if (polygon->count < polygon->capacity)
        return 1;
    const size_t grown = 2 * polygon->capacity + 16;
    obj_corner *corners = realloc(polygon->corners, grown * sizeof *corners);
    polygon->corners = corners ? corners : polygon->corners;
    double *points = realloc(polygon->points, 3 * grown * sizeof *points);
    polygon->points = points ? points : polygon->points;
    uint32_t *triangles = realloc(polygon->triangles, 3 * grown * sizeof *triangles);
    polygon->triangles = triangles ? triangles : polygon->triangles;
    if (!corners || !points || !triangles)
        return rt_import_fail_memory(import);
    polygon->capacity = grown;
    return 1;
}

static int has_area(const double corners[9])
{
    double normal[3];
    rt_vector_normal(normal, corners);
    return rt_vector_length(normal) > 0;
}

static void note_polygon(importer *import, int line_number, rt_polygon found)
{
    if (found == RT_POLYGON_NO_AREA)
        rt_import_note_at(import, line_number,
                          "a face has all its corners on one line: it is not seen");
    else
        rt_import_note_at(
            import, line_number, "a face %s: parts of it may be covered twice or not at all",
            found == RT_POLYGON_CROSSING ? "crosses itself" : "is too involved to cut");
}

void rt_obj_polygon_cut(importer *import, obj_data *data, int line_number)
{
    const obj_polygon *polygon = &data->polygon;
    rt_polygon found = RT_POLYGON_SIMPLE;
    rt_error error;
    for (size_t i = 0; i < 3 * polygon->count; i++) {
        const size_t from = 3 * (size_t)polygon->corners[i / 3].position + i % 3;
        polygon->points[i] = (double)data->positions.values[from] + data->low.values[from];
    }
    rt_status status =
        rt_polygon_cut(polygon->triangles, &found, polygon->points, polygon->count, &error);
    if (status == RT_ERROR_MEMORY)
        rt_import_fail_memory(import);
    else if (status != RT_OK)
        rt_import_fail(import, line_number, "%s", error.message);
    else if (polygon->count == 3 && !has_area(polygon->points))
        note_polygon(import, line_number, RT_POLYGON_NO_AREA);
    else if (found != RT_POLYGON_SIMPLE && polygon->count > 3)
        note_polygon(import, line_number, found);
    for (size_t i = 0; i + 2 < polygon->count && !import->failed; i++) {
        const uint32_t *t = polygon->triangles + 3 * i;
        push_triangle(import, data, line_number, polygon->corners + t[0], polygon->corners + t[1],
                      polygon->corners + t[2]);
    }
}

void rt_obj_polygon_free(obj_polygon *polygon)
{
    free(polygon->corners);
    free(polygon->points);
    free(polygon->triangles);
}
