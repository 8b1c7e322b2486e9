/* portals.c - the geometry of portals, and tables of the sky as it is seen through them. */
#include <math.h>
#include <string.h>

#include "pack/packing.h"
#include "shape/edges.h"

enum { least_cells = 64, most_cells = 512 };

/* Of all portals together, where there are many. */
static const double most_floats = 1 << 23;

static const double pi = 3.14159265358979323846;

/*
 * Cells along an edge of a table: as fine as the image, in the middle of it, unless there are many
 * portals.
 */
static uint32_t cells_of(const rt_scene *scene)
{
    const double share = sqrt(most_floats / (4 * (double)scene->portal_count));
    const double half = fmin(scene->environment.width / 2, fmin(share, most_cells));
    return (uint32_t)fmax(half, least_cells);
}

static size_t floats_of(uint32_t cells)
{
    return (size_t)(cells + 1) * (cells + 1) + (size_t)cells * cells;
}

/* Of one portal: two tables. */
static size_t rows_of(const rt_scene *scene)
{
    return (2 * floats_of(cells_of(scene)) * sizeof(float) + RT_SCENE_ROW - 1) / RT_SCENE_ROW;
}

size_t rt_portal_table_rows(const rt_scene *scene)
{
    return scene->environment.texels ? scene->portal_count * rows_of(scene) : 0;
}

/* ---- The sky ----------------------------------------------------------------- */

/* The mean of the channels of the image in a direction, bilinear, as the device has it. */
static double radiance(const rt_scene_environment *sky, const double w[3])
{
    double l[3] = {w[0], w[1], w[2]};
    for (int i = 0; i < 3 && sky->is_turned; i++)
        l[i] = sky->axes[i][0] * w[0] + sky->axes[i][1] * w[1] + sky->axes[i][2] * w[2];
    double u = 0.5 + atan2(l[0], -l[2]) / (2 * pi) + sky->turn;
    const double v = acos(fmax(-1, fmin(l[1], 1))) / pi;
    u -= floor(u);
    const double x = u * sky->width - 0.5, y = v * sky->height - 0.5;
    const double s = x - floor(x), t = y - floor(y);
    const uint32_t left = x < 0 ? sky->width - 1 : (uint32_t)x;
    const uint32_t right = left + 1 < sky->width ? left + 1 : 0;
    const uint32_t above = y < 0 ? 0 : (uint32_t)y;
    const uint32_t below = y < 0 || above + 1 >= sky->height ? above : above + 1;
    const uint32_t column[2] = {left, right}, row[2] = {above, below};
    const double weight[2][2] = {{(1 - s) * (1 - t), s * (1 - t)}, {(1 - s) * t, s * t}};
    double sum = 0;
    for (int j = 0; j < 2; j++)
        for (int i = 0; i < 2; i++) {
            const float *texel = sky->texels + 4 * ((size_t)row[j] * sky->width + column[i]);
            sum += weight[j][i] * ((double)texel[0] + texel[1] + texel[2]) / 3;
        }
    return sum;
}

/* What comes from the directions of a cell: the mean of so many by so many of them. */
static double light_of_cell(const rt_scene_environment *sky, const rt_light_data *portal,
                            double side, const double lo[2], double width, int samples)
{
    double sum = 0;
    for (int j = 0; j < samples; j++)
        for (int i = 0; i < samples; i++) {
            const double x = tan(lo[0] + width * (i + 0.5) / samples),
                         y = tan(lo[1] + width * (j + 0.5) / samples);
            const double squares[2] = {1 + x * x, 1 + y * y}, r2 = 1 + x * x + y * y;
            double w[3];
            for (int k = 0; k < 3; k++)
                w[k] = (x * portal->b[k] + y * portal->c[k] + side * portal->normal[k]) / sqrt(r2);
            sum += radiance(sky, w) * squares[0] * squares[1] / (r2 * sqrt(r2));
        }
    return sum / (samples * samples);
}

/* Fills a table of cells, whose sum is 1, and their sums; without light it is even. */
static void fill_table(float *sums, const rt_scene *scene, const rt_light_data *portal, double side)
{
    const rt_scene_environment *sky = &scene->environment;
    const uint32_t count = cells_of(scene);
    const int samples = sky->width > 2 * count ? (int)(sky->width / count) : 2;
    float *cells = sums + (size_t)(count + 1) * (count + 1);
    const double width = pi / count;
    double total = 0;
    for (uint32_t j = 0; j < count; j++)
        for (uint32_t i = 0; i < count; i++) {
            const double lo[2] = {width * i - pi / 2, width * j - pi / 2};
            const double light = light_of_cell(sky, portal, side, lo, width, samples);
            cells[(size_t)j * count + i] = (float)light;
            total += light;
        }
    memset(sums, 0, (count + 1) * sizeof *sums);
    for (uint32_t j = 0; j < count; j++) {
        const float *below = sums + (size_t)j * (count + 1);
        float *row = sums + (size_t)(j + 1) * (count + 1);
        double sum = 0;
        row[0] = 0;
        for (uint32_t i = 0; i < count; i++) {
            float *cell = cells + (size_t)j * count + i;
            *cell = total > 0 ? (float)(*cell / total) : 1.0f / ((float)count * (float)count);
            sum += *cell;
            row[i + 1] = (float)(below[i + 1] + sum);
        }
    }
}

/* ---- Portals ----------------------------------------------------------------- */

/* Its edges at right angles exactly: edge2 is turned, and as long. */
static void set_geometry(rt_light_data *out, const rt_portal *portal)
{
    double b[3], c[3], along = 0, length2 = 0, before = 0, after = 0;
    for (int i = 0; i < 3; i++) {
        b[i] = portal->edge1[i];
        c[i] = portal->edge2[i];
        along += b[i] * c[i];
        length2 += b[i] * b[i];
        before += c[i] * c[i];
    }
    for (int i = 0; i < 3; i++) {
        c[i] -= along / length2 * b[i];
        after += c[i] * c[i];
    }
    for (int i = 0; i < 3; i++)
        c[i] *= sqrt(before / after);
    memset(out, 0, sizeof *out);
    out->kind = RT_LIGHT_QUAD;
    out->prim = out->texture = RT_NONE;
    memcpy(out->a, portal->corner, sizeof out->a);
    rt_light_set_edges(out, b, c);
    out->flags |= RT_LIGHT_RECTANGLE;
    out->area = out->width * out->height;
}

void rt_pack_portals(const rt_packing *p)
{
    const rt_scene *scene = p->scene;
    rt_light_data *out = rt_packing_table(p, p->header.portals);
    const uint32_t cells = p->header.portal_cells;
    for (size_t i = 0; i < scene->portal_count; i++) {
        set_geometry(out + i, scene->portals + i);
        if (!scene->environment.texels)
            continue;
        out[i].texture = p->header.portal_tables + (rt_u32)(i * rows_of(scene));
        float *table = rt_packing_table(p, out[i].texture);
        fill_table(table, scene, out + i, 1);
        fill_table(table + floats_of(cells), scene, out + i, -1);
    }
}

uint32_t rt_portal_cells(const rt_scene *scene)
{
    return scene->environment.texels ? cells_of(scene) : 0;
}
