/*
 * obj_normals.c - normals of the corners of an OBJ file that have none.
 *
 * References:
 *   Thuermer, Wuethrich: "Computing Vertex Normals from Polygonal Facets", Journal of Graphics
 *     Tools 3(1), 1998: weights by angle.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "dsl/import/obj_data.h"

/* The sum of a position in a group of smoothing. */
typedef struct smooth_sum {
    uint32_t position, smooth, normal; /* normal: where it is in the file's, or OBJ_NONE */
    double sum[3];
} smooth_sum;

/* A hash table of open addressing, as that of corners in obj_data.c. */
typedef struct smooth_table {
    uint32_t *slots; /* number of the sum plus 1, or 0 */
    size_t mask, count;
    smooth_sum *sums;
} smooth_table;

static smooth_sum *find_sum(smooth_table *table, uint32_t position, uint32_t smooth)
{
    uint64_t hash = (uint64_t)(uintptr_t)table->slots;
    hash = (hash ^ position) * 0x9e3779b97f4a7c15u;
    hash = (hash ^ hash >> 32 ^ smooth) * 0x9e3779b97f4a7c15u;
    size_t at = (size_t)(hash ^ hash >> 32) & table->mask;
    for (; table->slots[at]; at = (at + 1) & table->mask) {
        smooth_sum *const known = table->sums + table->slots[at] - 1;
        if (known->position == position && known->smooth == smooth)
            return known;
    }
    smooth_sum *const made = table->sums + table->count;
    *made = (smooth_sum){position, smooth, OBJ_NONE, {0, 0, 0}};
    table->slots[at] = (uint32_t)++table->count;
    return made;
}

static void corners_of(const obj_data *data, size_t triangle, double out[9])
{
    for (size_t i = 0; i < 9; i++) {
        const size_t from = 3 * (size_t)data->corners[3 * triangle + i / 3].position + i % 3;
        out[i] = (double)data->positions.values[from] + data->low.values[from];
    }
}

/* The unit normal of a triangle; all zero where it has no area. */
static void face_normal(const obj_data *data, size_t triangle, double out[3])
{
    double corners[9];
    corners_of(data, triangle, corners);
    rt_vector_normal(out, corners);
    if (!rt_vector_normalize(out))
        memset(out, 0, 3 * sizeof *out);
}

static void add_face(smooth_table *table, const obj_data *data, size_t triangle)
{
    double p[9], normal[3], e[3], f[3], cross[3];
    corners_of(data, triangle, p);
    face_normal(data, triangle, normal);
    for (int corner = 0; corner < 3; corner++) {
        for (int c = 0; c < 3; c++) {
            e[c] = p[3 * ((corner + 1) % 3) + c] - p[3 * corner + c];
            f[c] = p[3 * ((corner + 2) % 3) + c] - p[3 * corner + c];
        }
        rt_vector_cross(cross, e, f);
        const double angle = atan2(rt_vector_length(cross), rt_vector_dot(e, f));
        smooth_sum *const at = find_sum(
            table, data->corners[3 * triangle + (size_t)corner].position, data->smooth[triangle]);
        for (int c = 0; c < 3; c++)
            at->sum[c] += angle * normal[c];
    }
}

static int lacks_normal(const obj_data *data, size_t triangle)
{
    const obj_corner *const corners = data->corners + 3 * triangle;
    return corners[0].normal == OBJ_NONE || corners[1].normal == OBJ_NONE ||
           corners[2].normal == OBJ_NONE;
}

/* Of each use of a material, whether its mesh has normals, given or by smoothing. To be freed. */
static unsigned char *find_uses(importer *import, const obj_data *data, int *is_needed)
{
    unsigned char *const has_normals = calloc(data->materials.count + 1, 1);
    *is_needed = 0;
    if (!has_normals)
        rt_import_fail_memory(import);
    for (size_t i = 0; has_normals && i < data->triangle_count; i++) {
        const obj_corner *const c = data->corners + 3 * i;
        const int lacks = lacks_normal(data, i);
        has_normals[data->groups[i]] |= data->smooth[i] != 0 || c[0].normal != OBJ_NONE ||
                                        c[1].normal != OBJ_NONE || c[2].normal != OBJ_NONE;
        *is_needed |= lacks;
    }
    return has_normals;
}

/* The normal of a corner in a group of smoothing, as one of the file's. */
static uint32_t smooth_normal(importer *import, obj_data *data, smooth_table *table,
                              uint32_t position, uint32_t smooth)
{
    smooth_sum *const at = find_sum(table, position, smooth);
    if (at->normal == OBJ_NONE) {
        double normal[3];
        memcpy(normal, at->sum, sizeof normal);
        if (!rt_vector_normalize(normal))
            memset(normal, 0, sizeof normal);
        at->normal = (uint32_t)(data->normals.count / 3);
        rt_obj_push_normal(import, data, normal);
    }
    return at->normal;
}

/* A triangle's own normal, or that of its group of smoothing, where a corner has none. */
static void fill_triangle(importer *import, obj_data *data, smooth_table *table, size_t triangle)
{
    const uint32_t smooth = data->smooth[triangle];
    uint32_t own = OBJ_NONE;
    for (size_t i = 3 * triangle; i < 3 * triangle + 3 && !import->failed; i++) {
        obj_corner *const corner = data->corners + i;
        if (corner->normal != OBJ_NONE)
            continue;
        if (smooth) {
            corner->normal = smooth_normal(import, data, table, corner->position, smooth);
            continue;
        }
        if (own == OBJ_NONE) {
            double normal[3];
            face_normal(data, triangle, normal);
            own = (uint32_t)(data->normals.count / 3);
            rt_obj_push_normal(import, data, normal);
        }
        corner->normal = own;
    }
}

/* Corners whose normal has no direction have none. */
static void drop_zeros(obj_data *data)
{
    for (size_t i = 0; i < 3 * data->triangle_count; i++) {
        uint32_t *const normal = &data->corners[i].normal;
        const float *const n = *normal == OBJ_NONE ? NULL : data->normals.values + 3 * *normal;
        if (n && n[0] == 0 && n[1] == 0 && n[2] == 0)
            *normal = OBJ_NONE;
    }
}

void rt_obj_fill_normals(importer *import, obj_data *data)
{
    int is_needed;
    drop_zeros(data);
    unsigned char *const has_normals = find_uses(import, data, &is_needed);
    size_t slots = 16;
    while (is_needed && slots < 6 * data->triangle_count)
        slots *= 2;
    smooth_table table = {calloc(slots, sizeof *table.slots), slots - 1, 0, NULL};
    if (is_needed)
        table.sums = malloc((3 * data->triangle_count + 1) * sizeof *table.sums);
    if (is_needed && has_normals && (!table.slots || !table.sums))
        rt_import_fail_memory(import);
    for (size_t i = 0; is_needed && i < data->triangle_count && !import->failed; i++)
        if (data->smooth[i])
            add_face(&table, data, i);
    for (size_t i = 0; is_needed && i < data->triangle_count && !import->failed; i++)
        if (has_normals[data->groups[i]])
            fill_triangle(import, data, &table, i);
    free(table.slots);
    free(table.sums);
    free(has_normals);
}
