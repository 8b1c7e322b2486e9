/*
 * table.h - lights at a point whose intensity depends on the direction by a table: spots with an
 * image in their cone, projectors, and luminaires by a file or an image of intensities.
 *
 * A direction is a point (u, v): where it meets the plane at the distance 1 along the axis, or its
 * angles about and from the axis. Lines along u and v make cells. The table has a value at each
 * corner, bilinear between them, or one for each cell, as rt_light_table says. Light paths choose a
 * cell in proportion to what it emits, and a direction in it, even over the plane or over solid
 * angle; what they carry is the intensity over that density.
 */
#ifndef RT_KERNELS_LIGHT_TABLE_H
#define RT_KERNELS_LIGHT_TABLE_H

#include "light/delta.h"
#include "math/frame.h"
#include "sample/sample.h"
#include "scene.h"
#include "types.h"

/* Whether a light, which is no area light, has a table. */
static inline bool light_has_table(global const rt_light_data *light)
{
    return light->kind == RT_LIGHT_TABLE ||
           (light->kind == RT_LIGHT_SPOT && light->texture != RT_NONE);
}

static inline global const rt_light_table *light_table(const struct scene *scene,
                                                       global const rt_light_data *light)
{
    return scene->light_tables + light->texture;
}

static inline global const float *table_floats(const struct scene *scene, uint row)
{
    return (global const float *)((global const uchar *)scene->header + (size_t)row * RT_SCENE_ROW);
}

/* ---- Directions and cells ------------------------------------------------------ */

static inline float2 table_point(global const rt_light_table *table, float3 w_local)
{
    if (table->flags & RT_TABLE_PLANE)
        return w_local.z > 0.0f ? w_local.xy / w_local.z : (float2)(INFINITY);
    const float turn = atan2(-w_local.y, w_local.x);
    const float across = sqrt(w_local.x * w_local.x + w_local.y * w_local.y);
    return (float2)(turn < 0.0f ? turn + 2.0f * RT_PI : turn, atan2(across, w_local.z));
}

/* A cell, its lines, and where a point lies between these. */
struct table_cell {
    uint column, row;
    float2 lo, hi, at;
};

/* False where the point is beyond the lines. */
static inline bool table_cell_at(const struct scene *scene, global const rt_light_table *table,
                                 float2 point, struct table_cell *cell)
{
    global const float *us = table_floats(scene, table->lines), *vs = us + table->columns + 1u;
    if (!(point.x >= us[0] && point.x <= us[table->columns] && point.y >= vs[0] &&
          point.y <= vs[table->rows]))
        return false;
    float x, y;
    cell->column = find_interval(us, table->columns, point.x, &x);
    cell->row = find_interval(vs, table->rows, point.y, &y);
    cell->at = (float2)(x, y);
    cell->lo = (float2)(us[cell->column], vs[cell->row]);
    cell->hi = (float2)(us[cell->column + 1u], vs[cell->row + 1u]);
    return true;
}

/* ---- Intensity ------------------------------------------------------------------- */

/* What multiplies a light's emission in direction w, without the falloff of a spot. */
static inline float3 table_pattern(const struct scene *scene, global const rt_light_data *light,
                                   float3 w)
{
    global const rt_light_table *table = light_table(scene, light);
    global const float4 *values = (global const float4 *)table_floats(scene, table->values);
    const float3 w_local = frame_to_local(light_frame(light), w);
    struct table_cell cell;
    if (!table_cell_at(scene, table, table_point(table, w_local), &cell))
        return (float3)(0.0f);
    float3 value;
    if (table->flags & RT_TABLE_CELLS) {
        value = values[(size_t)cell.row * table->columns + cell.column].xyz;
    } else {
        values += (size_t)cell.row * (table->columns + 1u) + cell.column;
        value =
            mix(mix(values[0], values[1], cell.at.x),
                mix(values[table->columns + 1u], values[table->columns + 2u], cell.at.x), cell.at.y)
                .xyz;
    }
    return table->flags & RT_TABLE_IRRADIANCE ? value / (w_local.z * w_local.z * w_local.z) : value;
}

/* ---- Light paths ----------------------------------------------------------------- */

/*
 * The density of the directions of light paths. On the plane at distance 1 an area dA is cos^3 dA
 * of solid angle.
 */
static inline float table_pdf_w(const struct scene *scene, global const rt_light_data *light,
                                float3 w)
{
    global const rt_light_table *table = light_table(scene, light);
    const float3 w_local = frame_to_local(light_frame(light), w);
    struct table_cell cell;
    if (!table_cell_at(scene, table, table_point(table, w_local), &cell))
        return 0.0f;
    global const float *marginal = table_floats(scene, table->marginal) + cell.row;
    global const float *conditional = table_floats(scene, table->conditional) +
                                      (size_t)cell.row * (table->columns + 1u) + cell.column;
    const float pmf = (marginal[1] - marginal[0]) * (conditional[1] - conditional[0]);
    const float2 size = cell.hi - cell.lo;
    if (table->flags & RT_TABLE_PLANE)
        return pmf / (size.x * size.y * w_local.z * w_local.z * w_local.z);
    /* cos(lo) - cos(hi) */
    return pmf / (size.x * 2.0f * sin(0.5f * (cell.lo.y + cell.hi.y)) * sin(0.5f * size.y));
}

static inline float3 sample_table(const struct scene *scene, global const rt_light_data *light,
                                  float2 u)
{
    global const rt_light_table *table = light_table(scene, light);
    global const float *us = table_floats(scene, table->lines), *vs = us + table->columns + 1u;
    float rest_x, rest_y;
    const uint row = find_interval(table_floats(scene, table->marginal), table->rows, u.y, &rest_y);
    const uint column =
        find_interval(table_floats(scene, table->conditional) + (size_t)row * (table->columns + 1u),
                      table->columns, u.x, &rest_x);
    const float x = mix(us[column], us[column + 1u], rest_x);
    float3 w_local;
    if (table->flags & RT_TABLE_PLANE) {
        w_local = unit((float3)(x, mix(vs[row], vs[row + 1u], rest_y), 1.0f));
    } else {
        /* The square of the sine of half the angle is even over solid angle. */
        const float lo = sin(0.5f * vs[row]), hi = sin(0.5f * vs[row + 1u]);
        const float s = mix(lo * lo, hi * hi, rest_y), sine = 2.0f * sqrt(s * max(1.0f - s, 0.0f));
        const float2 arc = sin_cos(x);
        w_local = (float3)(sine * arc.y, -sine * arc.x, 1.0f - 2.0f * s);
    }
    return frame_to_world(light_frame(light), w_local);
}

/* The intensity in direction w, W/sr. */
static inline float3 table_intensity(const struct scene *scene, global const rt_light_data *light,
                                     float3 w)
{
    const float3 shown = row3(light->emission) * table_pattern(scene, light, w);
    return light->kind == RT_LIGHT_SPOT ? shown * spot_falloff(light, dot(w, row3(light->b)))
                                        : shown;
}

#endif
