/*
 * pack.c - lays a scene out in one buffer: hierarchy, shapes, materials, lights, textures, sample
 * tables.
 */
#include "pack/pack.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "light/lights.h"
#include "light/tree.h"
#include "pack/packing.h"
#include "pack/sobol.h"

enum { buffer_alignment = 4096, sobol_entries = 4 * 256 };

void *rt_packing_table(const rt_packing *packing, rt_u32 offset)
{
    return (char *)packing->data + (size_t)offset * RT_SCENE_ROW;
}

/* Gives a table its place after those before it. */
static void place(size_t *rows, rt_u32 *offset, rt_u32 *count, size_t elements, size_t element_size)
{
    *offset = (rt_u32)*rows;
    if (count)
        *count = (rt_u32)elements;
    *rows += (elements * element_size + RT_SCENE_ROW - 1) / RT_SCENE_ROW;
}

static void place_environment(rt_packing *p, size_t *rows)
{
    const rt_scene_environment *from = &p->scene->environment;
    rt_environment_data *e = &p->header.environment;
    size_t width = from->width, height = from->height;
    e->width = from->width;
    e->height = from->height;
    e->light = from->light;
    e->turn = from->turn;
    place(rows, &e->texels, NULL, width * height, 4 * sizeof(float));
    place(rows, &e->conditional, NULL, width ? height * (width + 1) : 0, sizeof(float));
    place(rows, &e->marginal, NULL, width ? height + 1 : 0, sizeof(float));
    p->header.compensated = *e;
    e = &p->header.compensated;
    place(rows, &e->conditional, NULL, width ? height * (width + 1) : 0, sizeof(float));
    place(rows, &e->marginal, NULL, width ? height + 1 : 0, sizeof(float));
}

/* The tree of lights; that of compensated weights is another where there is an environment. */
static void place_light_trees(rt_packing *p, size_t *rows)
{
    rt_scene_header *h = &p->header;
    h->light_leaves = (rt_u32)rt_light_tree_leaves(p->scene);
    const size_t nodes = 2 * (size_t)h->light_leaves;
    place(rows, &h->light_nodes, NULL, nodes, sizeof(rt_light_node));
    h->compensated_nodes = h->light_nodes;
    if (p->scene->environment.light != RT_NONE)
        place(rows, &h->compensated_nodes, NULL, nodes, sizeof(rt_light_node));
}

/* Returns the number of rows of the buffer. */
static size_t place_tables(rt_packing *p)
{
    const rt_scene *scene = p->scene;
    const rt_bvh_counts *trees = &p->hierarchy.counts;
    rt_scene_header *h = &p->header;
    rt_u32 blocks;
    size_t rows = sizeof *h / RT_SCENE_ROW;
    if (p->hierarchy.has_pairs)
        place(&rows, &h->nodes, &h->node_count, rt_hierarchy_pairs(&p->hierarchy),
              sizeof(rt_pair_node));
    else
        place(&rows, &h->nodes, &h->node_count, trees->nodes, sizeof(rt_bvh_node));
    place(&rows, &h->blocks, &blocks, trees->blocks, sizeof(rt_tri_block));
    h->block_count = p->hierarchy.top_counts.blocks;
    place(&rows, &h->analytic, &h->analytic_count, trees->analytic, sizeof(rt_u32));
    place(&rows, &h->planes, &h->plane_count, p->plane_count, sizeof(rt_u32));
    place(&rows, &h->shapes, &h->shape_count, scene->shape_count, sizeof(rt_shape));
    place(&rows, &h->prim_shape, &h->prim_count, p->prim_count, sizeof(rt_u32));
    place(&rows, &h->materials, NULL, rt_materials_rows(scene), sizeof(rt_material_data));
    h->material_count = (rt_u32)scene->material_count;
    place(&rows, &p->facet_losses, NULL, rt_facet_tables_bytes(scene), 1);
    place(&rows, &h->lights, &h->light_count, p->light_count, sizeof(rt_light_data));
    place_light_trees(p, &rows);
    place(&rows, &h->targets, &h->target_count, rt_targets_count(scene), sizeof(rt_target));
    place(&rows, &h->transforms, &h->transform_count, p->transform_count,
          sizeof(rt_transform_data));
    place(&rows, &h->indices, &h->index_count, p->index_count, sizeof(rt_u32));
    place(&rows, &h->normals, &h->normal_count, p->normal_count, 4 * sizeof(float));
    place(&rows, &h->uvs, &h->uv_count, p->uv_count, 2 * sizeof(float));
    place(&rows, &h->colours, &h->colour_count, p->colour_count, 4 * sizeof(float));
    place(&rows, &h->textures, &h->texture_count, scene->texture_count + scene->texture_row_count,
          sizeof(rt_texture_data));
    place(&rows, &h->texels, NULL, scene->texels.size, 1);
    h->texel_rows = (rt_u32)rows - h->texels;
    place_environment(p, &rows);
    place(&rows, &h->portals, &h->portal_count, scene->portal_count, sizeof(rt_light_data));
    place(&rows, &h->portal_tables, NULL, rt_portal_table_rows(scene), RT_SCENE_ROW);
    h->portal_cells = rt_portal_cells(scene);
    if (scene->light_table_count)
        place(&rows, &h->light_tables, NULL, rt_light_tables_rows(scene), RT_SCENE_ROW);
    h->light_table_count = (rt_u32)scene->light_table_count;
    if (rt_scene_has_grids(scene))
        place(&rows, &h->grids, NULL, rt_grids_rows(scene), RT_SCENE_ROW);
    if (rt_scene_has_media(scene))
        place(&rows, &h->media, NULL, scene->material_count + 1, sizeof(rt_medium_data));
    place(&rows, &h->sobol, NULL, sobol_entries, 4 * sizeof(rt_u32));
    place(&rows, &h->counters, NULL, RT_COUNTER_SLOTS, RT_SCENE_ROW);
    return rows;
}

/* Builds the hierarchies and notes their extent. */
static rt_status build(rt_packing *p, uint32_t threads, rt_stage_progress *progress,
                       rt_error *error)
{
    double diagonal = 0;
    rt_status status =
        rt_hierarchy_build(&p->hierarchy, p->scene, p->first_prim, threads, progress, error);
    if (status != RT_OK)
        return status;
    memcpy(p->header.bounds_lo, p->hierarchy.lo, sizeof p->header.bounds_lo);
    memcpy(p->header.bounds_hi, p->hierarchy.hi, sizeof p->header.bounds_hi);
    rt_grids_widen(p->scene, p->header.bounds_lo, p->header.bounds_hi);
    for (int i = 0; i < 3; i++)
        diagonal = hypot(diagonal, (double)p->header.bounds_hi[i] - p->header.bounds_lo[i]);
    p->header.radius = (float)(0.5 * diagonal);
    return RT_OK;
}

/* Fills the trees of lights, from the tables of lights and shapes. */
static rt_status fill_light_trees(rt_packing *p, rt_error *error)
{
    const rt_scene_header *h = &p->header;
    const rt_light_data *lights = rt_packing_table(p, h->lights);
    const rt_u32 *prim_shape = rt_packing_table(p, h->prim_shape);
    const rt_environment_data *all = &h->environment, *above = &h->compensated;
    const double left = h->portal_count               ? 1
                        : all->width && all->mean > 0 ? (double)above->mean / all->mean
                                                      : 0;
    rt_status status = rt_light_tree_fill(rt_packing_table(p, h->light_nodes), p->scene, h, lights,
                                          prim_shape, 1, p->memory, error);
    if (status == RT_OK && h->compensated_nodes != h->light_nodes)
        status = rt_light_tree_fill(rt_packing_table(p, h->compensated_nodes), p->scene, h, lights,
                                    prim_shape, left, p->memory, error);
    return status;
}

static const char what[] = "the scene";

/* Fills the tables of nodes, blocks and analytic shapes. */
static rt_status fill_hierarchy(rt_packing *p, rt_error *error)
{
    void *nodes = rt_packing_table(p, p->header.nodes);
    rt_tri_block *blocks = rt_packing_table(p, p->header.blocks);
    rt_u32 *analytic = rt_packing_table(p, p->header.analytic);
    if (p->hierarchy.has_pairs)
        return rt_hierarchy_write_pairs(&p->hierarchy, nodes, blocks, analytic, error);
    rt_hierarchy_write(&p->hierarchy, nodes, blocks, analytic);
    return RT_OK;
}

/* Allocates the buffer and fills its tables; *light_power is that of all lights, W. */
static rt_status fill(rt_packing *p, double *light_power, rt_error *error)
{
    size_t rows = place_tables(p);
    if (rows > UINT32_MAX)
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory for a scene of %zu rows of %u bytes",
                       rows, RT_SCENE_ROW);
    p->bytes = rows * RT_SCENE_ROW;
    rt_status status = rt_memory_take(p->memory, p->bytes, what, error);
    if (status != RT_OK)
        return status;
    if (posix_memalign(&p->data, buffer_alignment, p->bytes)) {
        p->data = NULL;
        rt_memory_give(p->memory, p->bytes, what);
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory for a scene of %zu bytes", p->bytes);
    }
    memset(p->data, 0, p->bytes);
    status = fill_hierarchy(p, error);
    if (status != RT_OK)
        return status;
    *light_power = rt_lights_fill(p->scene, p->first_prim, p->header.radius,
                                  rt_packing_table(p, p->header.lights), p->first_light);
    status = rt_pack_enclosing(p, error);
    if (status != RT_OK)
        return status;
    rt_pack_shapes(p);
    rt_pack_cutouts(p);
    rt_pack_targets(p);
    rt_pack_vertices(p);
    rt_pack_materials(p);
    rt_pack_facet_tables(p);
    rt_pack_parts(p);
    rt_pack_media(p);
    rt_pack_grids(p);
    rt_pack_light_tables(p);
    rt_pack_textures(p);
    rt_pack_environment(p);
    rt_pack_portals(p);
    rt_sobol_table(rt_packing_table(p, p->header.sobol));
    memcpy(p->data, &p->header, sizeof p->header);
    return fill_light_trees(p, error);
}

rt_status rt_scene_pack(rt_scene_image *out, const rt_scene *scene, rt_accel accel, uint32_t width,
                        uint32_t threads, rt_stage_progress *progress, rt_error *error)
{
    double light_power = 0;
    rt_packing p;
    memset(&p, 0, sizeof p);
    p.memory = p.hierarchy.memory = out->memory;
    p.scene = scene;
    p.header.accel = accel;
    p.hierarchy.has_pairs = width == 1;
    rt_status status = rt_pack_number(&p, error);
    if (status != RT_OK)
        goto out;
    status = rt_pack_touch(&p, error);
    if (status != RT_OK)
        goto out;
    status = build(&p, threads, progress, error);
    if (status != RT_OK)
        goto out;
    status = fill(&p, &light_power, error);
    if (status != RT_OK)
        goto out;
    *out = (rt_scene_image){.data = p.data,
                            .bytes = p.bytes,
                            .light_power = light_power,
                            .may_start_in_solids = p.may_start_in_solids,
                            .is_plain = rt_materials_are_plain(&p) && !p.header.has_cutouts,
                            .memory = p.memory};
    p.data = NULL;
out:
    if (p.data)
        rt_memory_give(p.memory, p.bytes, what);
    free(p.data);
    rt_hierarchy_free(&p.hierarchy);
    rt_memory_free(p.first_prim);
    rt_memory_free(p.first_light);
    rt_memory_free(p.shapes);
    rt_memory_free(p.meshes);
    return status;
}

void rt_scene_image_free(rt_scene_image *image)
{
    free(image->data);
    rt_memory_give(image->memory, image->bytes, what);
    image->data = NULL;
    image->bytes = 0;
}
