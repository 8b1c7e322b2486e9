/*
 * scene.h - opens the one-buffer scene into typed tables.
 *
 * The host lays the scene out as rt_scene_header describes: a header, then tables, each at
 * a whole number of 64-byte rows from the start. Kernels take the header's address and
 * call scene_open once a work-item; the compiler keeps only the tables that are used.
 */
#ifndef RT_SCENE_H
#define RT_SCENE_H

#include "types.h"

struct scene {
    global const rt_scene_header *header;
    global const rt_bvh_node *nodes;
    global const rt_tri_block *blocks;
    global const rt_face *faces;   /* of each lane of each block */
    global const uint *analytic;   /* shape of each analytic entry */
    global const uint *planes;     /* shape of each plane */
    global const rt_shape *shapes;
    global const uint *prim_shape; /* shape of each primitive */
    global const rt_material_data *materials;
    global const rt_light_data *lights;
    global const float4 *normals;
    global const uint4 *sobol;
};

static inline struct scene scene_open(global const rt_scene_header *header)
{
    global const uchar *base = (global const uchar *)header;
    struct scene scene;
    scene.header = header;
    scene.nodes = (global const rt_bvh_node *)(base + (size_t)header->nodes * RT_SCENE_ROW);
    scene.blocks = (global const rt_tri_block *)(base + (size_t)header->blocks * RT_SCENE_ROW);
    scene.faces = (global const rt_face *)(base + (size_t)header->faces * RT_SCENE_ROW);
    scene.analytic = (global const uint *)(base + (size_t)header->analytic * RT_SCENE_ROW);
    scene.planes = (global const uint *)(base + (size_t)header->planes * RT_SCENE_ROW);
    scene.shapes = (global const rt_shape *)(base + (size_t)header->shapes * RT_SCENE_ROW);
    scene.prim_shape = (global const uint *)(base + (size_t)header->prim_shape * RT_SCENE_ROW);
    scene.materials = (global const rt_material_data *)(base + (size_t)header->materials * RT_SCENE_ROW);
    scene.lights = (global const rt_light_data *)(base + (size_t)header->lights * RT_SCENE_ROW);
    scene.normals = (global const float4 *)(base + (size_t)header->normals * RT_SCENE_ROW);
    scene.sobol = (global const uint4 *)(base + (size_t)header->sobol * RT_SCENE_ROW);
    return scene;
}

#endif
