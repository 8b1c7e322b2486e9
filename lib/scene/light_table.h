/*
 * light_table.h - tables of the intensity of a light by direction, as kernels/light/table.h uses
 * them: what they emit, and by what light paths choose their cells.
 */
#ifndef RT_LIB_SCENE_LIGHT_TABLE_H
#define RT_LIB_SCENE_LIGHT_TABLE_H

#include "scene/scene.h"

/* Values of the table: of its cells, or of their corners. */
size_t rt_light_table_values(const rt_scene_light_table *table);

/* Allocates lines and values; columns, rows and flags are set. */
rt_status rt_light_table_alloc(rt_scene_light_table *table, rt_memory *memory, rt_error *error);

/*
 * Sets the flux, the peak and the cosine, from the rest. spot: its falloff multiplies the values;
 * NULL: none.
 */
void rt_light_table_measure(rt_scene_light_table *table, const rt_scene_light *spot);

/*
 * What a cell is chosen by: its mean value times its solid angle, or area of the plane, times what
 * else multiplies values there, at the point of it that is nearest to the axis.
 */
double rt_light_table_weight(const rt_scene_light_table *table, const rt_scene_light *spot,
                             rt_u32 column, rt_u32 row);

/*
 * The table of an image: its texels lie evenly over the plane from -half to half along u and v, or,
 * with flags 0, over the angles about and from the axis. RT_TABLE_CELLS: its texels are the cells;
 * else values are theirs at their centres, and at the edges those nearest to these, or on both
 * sides of the seam.
 */
rt_status rt_light_table_of_image(rt_scene_light_table *out, const float *texels, rt_u32 width,
                                  rt_u32 height, rt_u32 flags, const double half[2],
                                  rt_memory *memory, rt_error *error);

/*
 * Makes the edges of that of an image on a plane what they are of an image that repeats: between
 * its first and its last texels.
 */
void rt_light_table_repeat(rt_scene_light_table *table);

/* Appends a table, which the scene then owns; its number from 1 is *out. */
rt_status rt_scene_take_light_table(rt_scene *scene, rt_u32 *out, const rt_scene_light_table *table,
                                    rt_error *error);

#endif
