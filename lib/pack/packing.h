/* packing.h - the state of packing a scene, shared by the files that fill the tables. */
#ifndef RT_LIB_PACK_PACKING_H
#define RT_LIB_PACK_PACKING_H

#include "pack/hierarchy.h"
#include "scene/scene.h"

/*
 * Where the vertex data of a mesh begin in their tables; RT_NONE where the mesh has none or nothing
 * uses them.
 */
typedef struct rt_mesh_place {
    rt_u32 index, normal, uv, colour;
    rt_u32 attributes; /* among colours: of those that textures name, one behind the other */
} rt_mesh_place;

/* Where a shape's entries begin in the tables. */
typedef struct rt_shape_place {
    rt_u32 transform;
    rt_u32 normal; /* of triangles and instances; that of the mesh, or of a placed copy */
    float reach;   /* as rt_shape.reach */
} rt_shape_place;

typedef struct rt_packing {
    rt_memory *memory;
    const rt_scene *scene;
    rt_u32 *first_prim, *first_light; /* [shape_count] */
    rt_shape_place *shapes;           /* [shape_count] */
    rt_mesh_place *meshes;            /* [mesh_count] */
    size_t prim_count, light_count, plane_count, transform_count;
    size_t index_count, normal_count, uv_count, colour_count;
    rt_hierarchy hierarchy;
    rt_scene_header header;
    rt_u32 facet_losses;     /* row where the tables of losses of facets begin */
    int may_start_in_solids; /* as in rt_scene_image */
    void *data;              /* the buffer of rt_scene_image, once it is allocated */
    size_t bytes;
} rt_packing;

/* The table at this offset of the buffer. */
void *rt_packing_table(const rt_packing *packing, rt_u32 offset);

/* Counts and numbers what shapes put into tables (shapes.c). */
rt_status rt_pack_number(rt_packing *packing, rt_error *error);

/* Sets the reach of shapes that another one may touch (touch.c); after they are numbered. */
rt_status rt_pack_touch(rt_packing *packing, rt_error *error);

/*
 * Says whether paths may start inside of solids, and marks the lights that may lie partly in one
 * (enclosing.c); after the table of lights is filled.
 */
rt_status rt_pack_enclosing(rt_packing *packing, rt_error *error);

/*
 * Fill the tables of shapes, and of what they refer to: primitives, planes, transforms, vertices
 * (shapes.c).
 */
void rt_pack_shapes(const rt_packing *packing);
/* Marks the blocks that hold cutouts; after rt_pack_shapes. */
void rt_pack_cutouts(rt_packing *packing);

void rt_pack_vertices(const rt_packing *packing);

/*
 * Count and fill the bounding spheres of specular shapes; these are one sphere when they are too
 * many (targets.c).
 */
size_t rt_targets_count(const rt_scene *scene);
void rt_pack_targets(const rt_packing *packing);

/*
 * Widens the bounds of all finite shapes, which are points where there are none, by the box of the
 * grid that the medium outside of all solids has, if there is one: light paths from infinitely far
 * come to it, too.
 */
void rt_grids_widen(const rt_scene *scene, float lo[3], float hi[3]);

/*
 * Whether light that meets more than one facet of a material is scattered on; the bytes of the
 * tables that this takes; and filling them, after those of materials (facet_tables.c).
 */
int rt_material_scatters_often(const rt_material *material);
size_t rt_facet_tables_bytes(const rt_scene *scene);
void rt_pack_facet_tables(const rt_packing *packing);

/* The rows that grids take, a table and their values, and filling them (grids.c). */
size_t rt_grids_rows(const rt_scene *scene);
void rt_pack_grids(const rt_packing *packing);

/* The rows that tables of lights take, and filling them (light_tables.c). */
size_t rt_light_tables_rows(const rt_scene *scene);
void rt_pack_light_tables(const rt_packing *packing);

/* The rows of the table of materials: those of the scene, then the parts of each (materials.c). */
size_t rt_materials_rows(const rt_scene *scene);

/* Fill the tables of materials, textures, and of the environment (materials.c). */
void rt_pack_materials(const rt_packing *packing);

/* Whether those of all shapes are plain (materials.c). */
int rt_materials_are_plain(const rt_packing *packing);

/* Fills the rows of the parts of materials, after their tables of facets (materials.c). */
void rt_pack_parts(const rt_packing *packing);
void rt_pack_media(const rt_packing *packing);
void rt_pack_textures(const rt_packing *packing);
void rt_pack_environment(rt_packing *packing);

/*
 * Fills the tables of portals, of so many rows, and so many cells along an edge of each: 0 where
 * the sky is even (portals.c).
 */
void rt_pack_portals(const rt_packing *packing);
size_t rt_portal_table_rows(const rt_scene *scene);
uint32_t rt_portal_cells(const rt_scene *scene);

#endif
