#include "scene/hierarchy.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "error.h"

static void list_mesh(rt_hierarchy_shapes *lists, const rt_scene_shape *shape, rt_u32 first_prim)
{
    rt_bvh_mesh *mesh = lists->meshes + lists->input.mesh_count++;
    mesh->positions = shape->positions;
    mesh->indices = shape->indices;
    mesh->triangle_count = (uint32_t)shape->triangle_count;
    mesh->first_prim = first_prim;
}

static void list_quad(rt_hierarchy_shapes *lists, const rt_scene_shape *shape, rt_u32 prim)
{
    rt_bvh_quad *quad = lists->quads + lists->input.quad_count++;
    memcpy(quad->corner, shape->p, sizeof quad->corner);
    memcpy(quad->edge1, shape->p + 3, sizeof quad->edge1);
    memcpy(quad->edge2, shape->p + 6, sizeof quad->edge2);
    quad->prim = prim;
}

/* A sphere's box, rounded outwards. */
static void list_sphere(rt_hierarchy_shapes *lists, const rt_scene_shape *shape, rt_u32 index)
{
    rt_bvh_analytic *entry = lists->analytic + lists->input.analytic_count++;
    for (int i = 0; i < 3; i++) {
        entry->lo[i] = nextafterf(shape->p[i] - shape->p[3], -INFINITY);
        entry->hi[i] = nextafterf(shape->p[i] + shape->p[3], INFINITY);
    }
    entry->shape = index;
}

rt_status rt_hierarchy_list(rt_hierarchy_shapes *lists, const rt_scene *scene, const rt_u32 *first_prim,
                            rt_error *error)
{
    size_t shapes = scene->shape_count;
    lists->meshes = malloc((shapes + 1) * sizeof *lists->meshes);
    lists->quads = malloc((shapes + 1) * sizeof *lists->quads);
    lists->analytic = malloc((shapes + 1) * sizeof *lists->analytic);
    if (!lists->meshes || !lists->quads || !lists->analytic)
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory for %zu shapes", shapes);
    for (size_t i = 0; i < shapes; i++) {
        const rt_scene_shape *shape = scene->shapes + i;
        if (shape->kind == RT_SHAPE_TRIANGLES)
            list_mesh(lists, shape, first_prim[i]);
        else if (shape->kind == RT_SHAPE_QUAD)
            list_quad(lists, shape, first_prim[i]);
        else if (shape->kind == RT_SHAPE_SPHERE)
            list_sphere(lists, shape, (rt_u32)i);
    }
    lists->input.meshes = lists->meshes;
    lists->input.quads = lists->quads;
    lists->input.analytic = lists->analytic;
    return RT_OK;
}

void rt_hierarchy_free(rt_hierarchy_shapes *lists)
{
    free(lists->meshes);
    free(lists->quads);
    free(lists->analytic);
    memset(lists, 0, sizeof *lists);
}
