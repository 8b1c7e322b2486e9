/* light_table.c - tables of the intensity of a light by direction, and those of images. */
#include "scene/light_table.h"

#include <math.h>
#include <string.h>

#include "scene/check.h"

static const double pi = 3.14159265358979323846;

static rt_u32 corners_along(const rt_scene_light_table *t, rt_u32 cells)
{
    return t->flags & RT_TABLE_CELLS ? cells : cells + 1;
}

size_t rt_light_table_values(const rt_scene_light_table *t)
{
    return (size_t)corners_along(t, t->columns) * corners_along(t, t->rows);
}

rt_status rt_light_table_alloc(rt_scene_light_table *t, rt_memory *memory, rt_error *error)
{
    static const char what[] = "the table of a light";
    const size_t lines = (size_t)t->columns + t->rows + 2;
    t->values = NULL;
    t->lines = rt_memory_zeroed(memory, lines, sizeof *t->lines, what, error);
    if (t->lines)
        t->values =
            rt_memory_zeroed(memory, rt_light_table_values(t), 4 * sizeof *t->values, what, error);
    if (t->values)
        return RT_OK;
    rt_light_table_free(t);
    return RT_ERROR_MEMORY;
}

/* ---- What cells emit --------------------------------------------------------- */

/* A cell: its lines, and the values at its corners, which may be one. */
typedef struct cell {
    double u[2], v[2];
    const float *at[2][2]; /* by v, then by u */
} cell;

static cell cell_of(const rt_scene_light_table *t, rt_u32 column, rt_u32 row)
{
    const float *us = t->lines + column, *vs = t->lines + t->columns + 1 + row;
    const size_t stride = corners_along(t, t->columns);
    const int has_corners = !(t->flags & RT_TABLE_CELLS);
    const float *value = t->values + 4 * (row * stride + column);
    cell c = {{us[0], us[1]}, {vs[0], vs[1]}, {{NULL, NULL}, {NULL, NULL}}};
    for (int j = 0; j < 2; j++)
        for (int i = 0; i < 2; i++)
            c.at[j][i] = value + (has_corners ? 4 * ((size_t)j * stride + (size_t)i) : 0);
    return c;
}

static double falloff(const rt_scene_light *spot, double cosine)
{
    const double inner = spot->inner, outer = spot->outer;
    if (spot->falloff == RT_FALLOFF_LINEAR)
        return fmax(0, fmin(1, (acos(outer) - acos(cosine)) / (acos(outer) - acos(inner))));
    const double x = fmax(0, fmin(1, (cosine - outer) / (inner - outer)));
    const double power = rt_spot_power(spot);
    return power > 0 ? pow(x, power) : x * x * (3 - 2 * x);
}

/* What multiplies a value of the plane where light paths are counted by area. */
static double factor_at(const rt_scene_light_table *t, const rt_scene_light *spot, double u,
                        double v)
{
    const double cosine = 1 / sqrt(1 + u * u + v * v);
    return (t->flags & RT_TABLE_IRRADIANCE ? 1 : cosine * cosine * cosine) *
           (spot ? falloff(spot, cosine) : 1);
}

static double nearest_zero(const double range[2])
{
    return fmax(range[0], fmin(range[1], 0));
}

double rt_light_table_weight(const rt_scene_light_table *t, const rt_scene_light *spot,
                             rt_u32 column, rt_u32 row)
{
    const cell c = cell_of(t, column, row);
    double sum = 0;
    for (int k = 0; k < 12; k++)
        sum += c.at[k / 6][k / 3 % 2][k % 3];
    const double mean = sum / 12, width = c.u[1] - c.u[0];
    if (t->flags & RT_TABLE_PLANE)
        return mean * width * (c.v[1] - c.v[0]) *
               factor_at(t, spot, nearest_zero(c.u), nearest_zero(c.v));
    return mean * width * (cos(c.v[0]) - cos(c.v[1]));
}

/* The integral of a value that is bilinear over the plane, times its factor, by midpoints. */
static double plane_flux(const rt_scene_light_table *t, const rt_scene_light *spot, const cell *c,
                         int channel, int steps)
{
    const double area = (c->u[1] - c->u[0]) * (c->v[1] - c->v[0]) / (steps * steps);
    double sum = 0;
    for (int j = 0; j < steps; j++)
        for (int i = 0; i < steps; i++) {
            const double x = (i + 0.5) / steps, y = (j + 0.5) / steps;
            const double above = c->at[0][0][channel] * (1 - x) + c->at[0][1][channel] * x,
                         below = c->at[1][0][channel] * (1 - x) + c->at[1][1][channel] * x;
            sum += (above * (1 - y) + below * y) * factor_at(t, spot,
                                                             c->u[0] + x * (c->u[1] - c->u[0]),
                                                             c->v[0] + y * (c->v[1] - c->v[0]));
        }
    return sum * area;
}

/* The integral of a value that is linear in the angle v, times sin v. */
static double sphere_flux(const cell *c, int channel)
{
    const double a = 0.5 * ((double)c->at[0][0][channel] + c->at[0][1][channel]),
                 b = 0.5 * ((double)c->at[1][0][channel] + c->at[1][1][channel]);
    const double v0 = c->v[0], v1 = c->v[1];
    return (c->u[1] - c->u[0]) *
           (a * cos(v0) - b * cos(v1) + (b - a) / (v1 - v0) * (sin(v1) - sin(v0)));
}

/* The cosine of the farthest direction from the axis. */
static double cosine_of(const rt_scene_light_table *t, const rt_scene_light *spot)
{
    const float *us = t->lines, *vs = us + t->columns + 1;
    if (spot)
        return spot->outer;
    /* A right angle is a little more in float. */
    if (!(t->flags & RT_TABLE_PLANE))
        return fabs(cos(vs[t->rows])) < 1e-7 ? 0 : cos(vs[t->rows]);
    const double u = fmax(fabs(us[0]), fabs(us[t->columns])),
                 v = fmax(fabs(vs[0]), fabs(vs[t->rows]));
    return 1 / sqrt(1 + u * u + v * v);
}

void rt_light_table_measure(rt_scene_light_table *t, const rt_scene_light *spot)
{
    const rt_u32 most = t->columns > t->rows ? t->columns : t->rows;
    const int is_plane = t->flags & RT_TABLE_PLANE ? 1 : 0;
    const int steps = is_plane && (spot || !(t->flags & RT_TABLE_IRRADIANCE)) && most < 256
                          ? (int)(256 / most)
                          : 1;
    const size_t values = rt_light_table_values(t);
    memset(t->flux, 0, sizeof t->flux);
    t->peak = 0;
    for (rt_u32 row = 0; row < t->rows; row++)
        for (rt_u32 column = 0; column < t->columns; column++) {
            const cell c = cell_of(t, column, row);
            for (int k = 0; k < 3; k++)
                t->flux[k] += is_plane ? plane_flux(t, spot, &c, k, steps) : sphere_flux(&c, k);
        }
    for (size_t i = 0; i < values; i++)
        t->peak = fmax(
            t->peak, ((double)t->values[4 * i] + t->values[4 * i + 1] + t->values[4 * i + 2]) / 3);
    t->cosine = (float)cosine_of(t, spot);
    /* Irradiance is intensity times the cube of the cosine. */
    if (t->flags & RT_TABLE_IRRADIANCE)
        t->peak /= pow(t->cosine, 3);
}

/* ---- Images -------------------------------------------------------------------- */

/* Lines along one side of an image of so many texels: at their edges, or centres and both ends. */
static void set_lines(float *lines, rt_u32 cells, rt_u32 texels, double from, double to)
{
    for (rt_u32 i = 0; i <= cells; i++) {
        const double at = cells == texels ? i : i == 0 ? 0 : i == cells ? texels : i - 0.5;
        lines[i] = (float)(from + (to - from) * at / texels);
    }
}

/* The texels that a corner lies between; they are one but at the seam. */
static void texels_at(rt_u32 out[2], rt_u32 corner, rt_u32 texels, int wraps)
{
    const int is_end = corner == 0 || corner == texels + 1;
    out[0] = out[1] = corner == 0 ? 0 : corner > texels ? texels - 1 : corner - 1;
    if (is_end && wraps) {
        out[0] = 0;
        out[1] = texels - 1;
    }
}

static void set_corners(rt_scene_light_table *t, const float *texels, rt_u32 width, rt_u32 height)
{
    float *value = t->values;
    for (rt_u32 row = 0; row <= t->rows; row++)
        for (rt_u32 column = 0; column <= t->columns; column++, value += 4) {
            rt_u32 x[2], y[2];
            texels_at(x, column, width, !(t->flags & RT_TABLE_PLANE));
            texels_at(y, row, height, 0);
            const float *line = texels + 4 * (size_t)y[0] * width;
            for (int c = 0; c < 3; c++)
                value[c] = 0.5f * line[4 * (size_t)x[0] + c] + 0.5f * line[4 * (size_t)x[1] + c];
        }
}

rt_status rt_light_table_of_image(rt_scene_light_table *out, const float *texels, rt_u32 width,
                                  rt_u32 height, rt_u32 flags, const double half[2],
                                  rt_memory *memory, rt_error *error)
{
    const rt_u32 more = flags & RT_TABLE_CELLS ? 0 : 1;
    rt_scene_light_table t = {.flags = flags, .columns = width + more, .rows = height + more};
    const int is_plane = flags & RT_TABLE_PLANE ? 1 : 0;
    const rt_status status = rt_light_table_alloc(&t, memory, error);
    if (status != RT_OK)
        return status;
    set_lines(t.lines, t.columns, width, is_plane ? -half[0] : 0, is_plane ? half[0] : 2 * pi);
    set_lines(t.lines + t.columns + 1, t.rows, height, is_plane ? -half[1] : 0,
              is_plane ? half[1] : pi);
    if (flags & RT_TABLE_CELLS)
        memcpy(t.values, texels, 4 * sizeof *texels * (size_t)width * height);
    else
        set_corners(&t, texels, width, height);
    *out = t;
    return RT_OK;
}

/* Both become their mean. */
static void mix_ends(float first[4], float last[4])
{
    for (int c = 0; c < 4; c++)
        first[c] = last[c] = 0.5f * first[c] + 0.5f * last[c];
}

void rt_light_table_repeat(rt_scene_light_table *t)
{
    const size_t across = 4 * ((size_t)t->columns + 1);
    if (t->flags & RT_TABLE_CELLS)
        return;
    for (rt_u32 row = 0; row <= t->rows; row++)
        mix_ends(t->values + row * across, t->values + (row + 1) * across - 4);
    for (rt_u32 column = 0; column <= t->columns; column++)
        mix_ends(t->values + 4 * (size_t)column, t->values + t->rows * across + 4 * (size_t)column);
}

rt_status rt_scene_take_light_table(rt_scene *scene, rt_u32 *out, const rt_scene_light_table *table,
                                    rt_error *error)
{
    rt_status status =
        rt_grow(scene->memory, (void **)&scene->light_tables, &scene->light_table_room,
                scene->light_table_count, sizeof *table, "the list of tables of lights", error);
    if (status == RT_OK) {
        scene->light_tables[scene->light_table_count++] = *table;
        *out = (rt_u32)scene->light_table_count;
    }
    return status;
}
