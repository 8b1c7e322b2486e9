/* light_tables.c - tables of the intensity of lights, and by what their cells are chosen. */
#include <string.h>

#include "pack/packing.h"
#include "scene/environment.h"
#include "scene/light_table.h"

static size_t rows_of(size_t count, size_t size)
{
    return (count * size + RT_SCENE_ROW - 1) / RT_SCENE_ROW;
}

static size_t line_rows(const rt_scene_light_table *t)
{
    return rows_of((size_t)t->columns + t->rows + 2, sizeof(float));
}

static size_t value_rows(const rt_scene_light_table *t)
{
    return rows_of(rt_light_table_values(t), 4 * sizeof(float));
}

static size_t conditional_rows(const rt_scene_light_table *t)
{
    return rows_of((size_t)t->rows * (t->columns + 1), sizeof(float));
}

static size_t marginal_rows(const rt_scene_light_table *t)
{
    return rows_of((size_t)t->rows + 1, sizeof(float));
}

size_t rt_light_tables_rows(const rt_scene *scene)
{
    size_t rows = rows_of(scene->light_table_count, sizeof(rt_light_table));
    for (size_t i = 0; i < scene->light_table_count; i++) {
        const rt_scene_light_table *t = scene->light_tables + i;
        rows += line_rows(t) + value_rows(t) + conditional_rows(t) + marginal_rows(t);
    }
    return rows;
}

/* The spot whose falloff multiplies a table, or NULL. */
static const rt_scene_light *spot_of(const rt_scene *scene, size_t table)
{
    for (size_t i = 0; i < scene->light_count; i++)
        if (scene->lights[i].table == table + 1 && scene->lights[i].kind == RT_LIGHT_SPOT)
            return scene->lights + i;
    return NULL;
}

static void tabulate(const rt_scene_light_table *t, const rt_scene_light *spot, float *conditional,
                     float *marginal)
{
    double total = 0;
    marginal[0] = 0;
    for (rt_u32 row = 0; row < t->rows; row++) {
        float *line = conditional + (size_t)row * (t->columns + 1);
        double sum = 0;
        line[0] = 0;
        for (rt_u32 column = 0; column < t->columns; column++) {
            sum += rt_light_table_weight(t, spot, column, row);
            line[column + 1] = (float)sum;
        }
        rt_cumulative_normalise(line, t->columns, sum);
        total += sum;
        marginal[row + 1] = (float)total;
    }
    rt_cumulative_normalise(marginal, t->rows, total);
}

void rt_pack_light_tables(const rt_packing *p)
{
    const rt_scene *scene = p->scene;
    rt_light_table *out = rt_packing_table(p, p->header.light_tables);
    size_t row = p->header.light_tables + rows_of(scene->light_table_count, sizeof *out);
    for (size_t i = 0; i < scene->light_table_count; i++, out++) {
        const rt_scene_light_table *t = scene->light_tables + i;
        out->columns = t->columns;
        out->rows = t->rows;
        out->flags = t->flags;
        out->cosine = t->cosine;
        out->lines = (rt_u32)row;
        out->values = (rt_u32)(row += line_rows(t));
        out->conditional = (rt_u32)(row += value_rows(t));
        out->marginal = (rt_u32)(row += conditional_rows(t));
        row += marginal_rows(t);
        memcpy(rt_packing_table(p, out->lines), t->lines,
               ((size_t)t->columns + t->rows + 2) * sizeof *t->lines);
        memcpy(rt_packing_table(p, out->values), t->values,
               rt_light_table_values(t) * 4 * sizeof *t->values);
        tabulate(t, spot_of(scene, i), rt_packing_table(p, out->conditional),
                 rt_packing_table(p, out->marginal));
    }
}
