/*
 * scene.h - opens the one-buffer scene into typed tables.
 *
 * The host lays the scene out as rt_scene_header describes: a header, then tables, each at
 * a whole number of 64-byte rows from the start. Kernels take the header's address and call
 * scene_open once per work-item; the compiler keeps only the tables that are used.
 *
 * The lights have two distributions. Where each point that light sampling may find is found by BSDF
 * sampling too, the part of the environment that BSDF sampling estimates well is left to it: light
 * sampling takes the radiance above the mean alone, which for a constant environment is none (MIS
 * compensation). Elsewhere every light has to be sampled in full.
 *
 * References:
 *   Karlik, Sik, Vevoda, Skrivan, Krivanek: "MIS Compensation: Optimizing Sampling Techniques in
 *     Multiple Importance Sampling", SIGGRAPH Asia 2019.
 */
#ifndef RT_SCENE_H
#define RT_SCENE_H

#include "types.h"

#if RT_WIDTH > 1
#define rt_node rt_bvh_node
#else
#define rt_node rt_pair_node
#endif

struct scene {
    global const rt_scene_header *header;
    global const rt_node *nodes;
    global const rt_tri_block *blocks;
    global const uint *analytic; /* shape of each analytic entry */
    global const uint *planes;   /* shape of each plane */
    global const rt_shape *shapes;
    global const uint *prim_shape; /* shape of each primitive */
    global const rt_material_data *materials;
    global const rt_medium_data *media; /* where media scatter alone */
    global const rt_grid_data *grids;   /* where densities lie on them alone */
    global const rt_light_data *lights;
    global const rt_light_table *light_tables;
    global const rt_light_node *light_nodes;
    global const rt_environment_data *environment;
    global const rt_target *targets;
    global const rt_transform_data *transforms;
    global const uint *indices;
    global const float4 *normals;
    global const float2 *uvs;
    global const float4 *colours;
    global const rt_texture_data *textures;
    global const uchar *texels;
    global const uint4 *sobol;
};

static inline struct scene scene_open(global const rt_scene_header *header)
{
    global const uchar *base = (global const uchar *)header;
    struct scene scene;
    scene.header = header;
    scene.nodes = (global const rt_node *)(base + (size_t)header->nodes * RT_SCENE_ROW);
    scene.blocks = (global const rt_tri_block *)(base + (size_t)header->blocks * RT_SCENE_ROW);
    scene.analytic = (global const uint *)(base + (size_t)header->analytic * RT_SCENE_ROW);
    scene.planes = (global const uint *)(base + (size_t)header->planes * RT_SCENE_ROW);
    scene.shapes = (global const rt_shape *)(base + (size_t)header->shapes * RT_SCENE_ROW);
    scene.prim_shape = (global const uint *)(base + (size_t)header->prim_shape * RT_SCENE_ROW);
    scene.materials =
        (global const rt_material_data *)(base + (size_t)header->materials * RT_SCENE_ROW);
    scene.media = (global const rt_medium_data *)(base + (size_t)header->media * RT_SCENE_ROW);
    scene.grids = (global const rt_grid_data *)(base + (size_t)header->grids * RT_SCENE_ROW);
    scene.lights = (global const rt_light_data *)(base + (size_t)header->lights * RT_SCENE_ROW);
    scene.light_tables =
        (global const rt_light_table *)(base + (size_t)header->light_tables * RT_SCENE_ROW);
    scene.light_nodes =
        (global const rt_light_node *)(base + (size_t)header->light_nodes * RT_SCENE_ROW);
    scene.environment = &header->environment;
    scene.targets = (global const rt_target *)(base + (size_t)header->targets * RT_SCENE_ROW);
    scene.transforms =
        (global const rt_transform_data *)(base + (size_t)header->transforms * RT_SCENE_ROW);
    scene.indices = (global const uint *)(base + (size_t)header->indices * RT_SCENE_ROW);
    scene.normals = (global const float4 *)(base + (size_t)header->normals * RT_SCENE_ROW);
    scene.uvs = (global const float2 *)(base + (size_t)header->uvs * RT_SCENE_ROW);
    scene.colours = (global const float4 *)(base + (size_t)header->colours * RT_SCENE_ROW);
    scene.textures =
        (global const rt_texture_data *)(base + (size_t)header->textures * RT_SCENE_ROW);
    scene.texels = base + (size_t)header->texels * RT_SCENE_ROW;
    scene.sobol = (global const uint4 *)(base + (size_t)header->sobol * RT_SCENE_ROW);
    return scene;
}

/*
 * As scene_open, for paths whose every vertex samples its BSDF as well, so that under MIS light
 * sampling may leave light to that: not for photon maps, whose paths end at gather points.
 */
static inline struct scene scene_open_compensated(global const rt_scene_header *header,
                                                  const rt_params *params)
{
    struct scene scene = scene_open(header);
    if (params->estimator == RT_ESTIMATOR_MIS) {
        global const uchar *base = (global const uchar *)header;
        scene.light_nodes =
            (global const rt_light_node *)(base + (size_t)header->compensated_nodes * RT_SCENE_ROW);
        scene.environment = &header->compensated;
    }
    return scene;
}

#endif
