/* pack.c - lays a scene out in one buffer: hierarchy, shapes, materials, lights, sample tables. */
#include "scene/pack.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "accel/bvh.h"
#include "error.h"
#include "light/lights.h"
#include "render/sobol.h"
#include "scene/check.h"
#include "scene/faces.h"
#include "scene/hierarchy.h"

enum { buffer_alignment = 4096, sobol_entries = 4 * 256 };

/* What packing works on; first_* have one entry a shape. */
typedef struct packing {
    const rt_scene *scene;
    rt_u32 *first_prim, *first_light, *first_normal;
    size_t prim_count, light_count, normal_count, plane_count;
    rt_hierarchy_shapes shapes; /* the hierarchy refers to them until it is written */
    rt_bvh *bvh;
    rt_bvh_counts counts;
    rt_scene_header header;
} packing;

/* Numbers primitives, planes and normals, shape by shape. */
static rt_status number_primitives(packing *p, rt_error *error)
{
    size_t shapes = p->scene->shape_count;
    p->first_prim = malloc((shapes + 1) * sizeof *p->first_prim);
    p->first_light = malloc((shapes + 1) * sizeof *p->first_light);
    p->first_normal = malloc((shapes + 1) * sizeof *p->first_normal);
    if (!p->first_prim || !p->first_light || !p->first_normal)
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory for %zu shapes", shapes);
    for (size_t i = 0; i < shapes; i++) {
        const rt_scene_shape *shape = p->scene->shapes + i;
        p->first_prim[i] = (rt_u32)p->prim_count;
        p->first_normal[i] = (rt_u32)p->normal_count;
        p->prim_count += rt_scene_shape_primitives(shape);
        p->plane_count += shape->kind == RT_SHAPE_PLANE;
        p->normal_count += shape->normals ? 3 * shape->triangle_count : 0;
        if (p->prim_count > RT_BLOCK_PRIM - 1)
            return rt_fail(error, RT_ERROR_INPUT, "the scene has more than %u primitives", RT_BLOCK_PRIM - 1);
    }
    p->light_count = rt_lights_count(p->scene);
    return RT_OK;
}

/* Gives a table its place after those before it. */
static void place(size_t *rows, rt_u32 *offset, rt_u32 *count, size_t elements, size_t element_size)
{
    *offset = (rt_u32)*rows;
    *count = (rt_u32)elements;
    *rows += (elements * element_size + RT_SCENE_ROW - 1) / RT_SCENE_ROW;
}

static size_t place_tables(packing *p)
{
    rt_scene_header *h = &p->header;
    size_t rows = sizeof *h / RT_SCENE_ROW;
    place(&rows, &h->nodes, &h->node_count, p->counts.nodes, sizeof(rt_bvh_node));
    place(&rows, &h->blocks, &h->block_count, p->counts.blocks, sizeof(rt_tri_block));
    place(&rows, &h->faces, &h->face_count, RT_BVH_WIDTH * (size_t)p->counts.blocks, sizeof(rt_face));
    place(&rows, &h->analytic, &h->analytic_count, p->counts.analytic, sizeof(rt_u32));
    place(&rows, &h->planes, &h->plane_count, p->plane_count, sizeof(rt_u32));
    place(&rows, &h->shapes, &h->shape_count, p->scene->shape_count, sizeof(rt_shape));
    place(&rows, &h->prim_shape, &h->prim_count, p->prim_count, sizeof(rt_u32));
    place(&rows, &h->materials, &h->material_count, p->scene->material_count, sizeof(rt_material_data));
    place(&rows, &h->lights, &h->light_count, p->light_count, sizeof(rt_light_data));
    place(&rows, &h->normals, &h->normal_count, p->normal_count, 4 * sizeof(float));
    place(&rows, &h->sobol, &h->sobol_count, sobol_entries, 4 * sizeof(rt_u32));
    return rows * RT_SCENE_ROW;
}

static void *table(const rt_scene_image *image, rt_u32 offset)
{
    return (char *)image->data + (size_t)offset * RT_SCENE_ROW;
}

static void pack_shapes(const packing *p, const rt_scene_image *image)
{
    rt_shape *out = table(image, p->header.shapes);
    rt_u32 *prim_shape = table(image, p->header.prim_shape), *plane = table(image, p->header.planes);

    for (size_t i = 0; i < p->scene->shape_count; i++) {
        const rt_scene_shape *shape = p->scene->shapes + i;
        size_t prims = rt_scene_shape_primitives(shape);
        out[i].kind = shape->kind;
        out[i].flags = shape->normals ? RT_SHAPE_SMOOTH : 0;
        out[i].material = shape->surface.material;
        out[i].first_prim = p->first_prim[i];
        out[i].prim_count = (rt_u32)prims;
        out[i].first_light = p->first_light[i];
        out[i].first_normal = p->first_normal[i];
        memcpy(out[i].p, shape->p, sizeof out[i].p);
        for (size_t k = 0; k < prims; k++)
            prim_shape[p->first_prim[i] + k] = (rt_u32)i;
        if (shape->kind == RT_SHAPE_PLANE)
            *plane++ = (rt_u32)i;
    }
}

static void pack_materials(const packing *p, const rt_scene_image *image)
{
    rt_material_data *out = table(image, p->header.materials);
    for (size_t i = 0; i < p->scene->material_count; i++) {
        const rt_material *m = p->scene->materials + i;
        memcpy(out[i].kd, m->kd, sizeof out[i].kd);
        memcpy(out[i].ks, m->ks, sizeof out[i].ks);
        memcpy(out[i].kt, m->kt, sizeof out[i].kt);
        out[i].ior = m->ior;
        out[i].priority = (rt_u32)m->priority;
        out[i].flags = (m->fresnel ? RT_MATERIAL_FRESNEL : 0) | (m->two_sided ? RT_MATERIAL_TWO_SIDED : 0);
    }
}

/* One normal a corner, of unit length; a zero one becomes the face's. */
static void pack_corner_normal(float out[4], const rt_scene_shape *shape, const uint32_t corner[3], int c)
{
    static const float zero[3];
    double n[3], a[3], b[3];
    const float *v0 = shape->positions + 3 * (size_t)corner[0];
    rt_vec_sub(n, shape->normals + 3 * (size_t)corner[c], zero);
    double length = rt_vec_length(n);
    if (!(length > 0)) {
        rt_vec_sub(a, shape->positions + 3 * (size_t)corner[1], v0);
        rt_vec_sub(b, shape->positions + 3 * (size_t)corner[2], v0);
        rt_vec_cross(n, a, b);
        length = rt_vec_length(n);
    }
    for (int i = 0; i < 3; i++)
        out[i] = length > 0 ? (float)(n[i] / length) : 0;
}

static void pack_normals(const packing *p, const rt_scene_image *image)
{
    float(*out)[4] = table(image, p->header.normals);
    for (size_t i = 0; i < p->scene->shape_count; i++) {
        const rt_scene_shape *shape = p->scene->shapes + i;
        for (size_t k = 0; shape->normals && k < 3 * shape->triangle_count; k++)
            pack_corner_normal(out[p->first_normal[i] + k], shape, shape->indices + 3 * (k / 3), (int)(k % 3));
    }
}

/* Builds the hierarchy and notes its extent. */
static rt_status build(packing *p, uint32_t threads, rt_stage_progress *progress, rt_error *error)
{
    double diagonal = 0;
    rt_status status = rt_hierarchy_list(&p->shapes, p->scene, p->first_prim, error);
    if (status == RT_OK)
        status = rt_bvh_build(&p->bvh, &p->shapes.input, threads, progress, error);
    if (status != RT_OK)
        return status;
    rt_bvh_get_counts(p->bvh, &p->counts);
    rt_bvh_get_bounds(p->bvh, p->header.bounds_lo, p->header.bounds_hi);
    for (int i = 0; i < 3; i++)
        diagonal = hypot(diagonal, (double)p->header.bounds_hi[i] - p->header.bounds_lo[i]);
    p->header.radius = (float)(0.5 * diagonal);
    return RT_OK;
}

/* Allocates the buffer and fills its tables. */
static rt_status fill(packing *p, rt_scene_image *image, rt_error *error)
{
    image->bytes = place_tables(p);
    if (posix_memalign(&image->data, buffer_alignment, image->bytes)) {
        image->data = NULL;
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory for a scene of %zu bytes", image->bytes);
    }
    memset(image->data, 0, image->bytes);
    rt_bvh_write(p->bvh, table(image, p->header.nodes), table(image, p->header.blocks),
                 table(image, p->header.analytic));
    rt_faces_fill(table(image, p->header.faces), table(image, p->header.blocks), p->header.block_count);
    image->light_power = rt_lights_fill(p->scene, p->first_prim, table(image, p->header.lights), p->first_light);
    pack_shapes(p, image);
    pack_materials(p, image);
    pack_normals(p, image);
    rt_sobol_table(table(image, p->header.sobol));
    memcpy(image->data, &p->header, sizeof p->header);
    return RT_OK;
}

rt_status rt_scene_pack(rt_scene_image *out, const rt_scene *scene, rt_accel accel, uint32_t threads,
                        rt_stage_progress *progress, rt_error *error)
{
    packing p;
    rt_scene_image image = {NULL, 0, 0};

    memset(&p, 0, sizeof p);
    p.scene = scene;
    p.header.accel = accel;
    rt_status status = number_primitives(&p, error);
    if (status == RT_OK)
        status = build(&p, threads, progress, error);
    if (status == RT_OK)
        status = fill(&p, &image, error);
    if (status == RT_OK)
        *out = image;
    rt_bvh_destroy(p.bvh);
    rt_hierarchy_free(&p.shapes);
    free(p.first_prim);
    free(p.first_light);
    free(p.first_normal);
    return status;
}

void rt_scene_image_free(rt_scene_image *image)
{
    free(image->data);
    memset(image, 0, sizeof *image);
}
