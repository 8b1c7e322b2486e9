/* attributes.h - which attributes of meshes the textures of a scene ask for. */
#ifndef RT_LIB_SCENE_ATTRIBUTES_H
#define RT_LIB_SCENE_ATTRIBUTES_H

#include "scene/scene.h"

/* The number of an attribute among those that textures name; a new one for a new name. */
rt_status rt_scene_name_attribute(rt_scene *scene, uint32_t *number, const char *name,
                                  rt_error *error);

/* What the textures of a material and of all its parts ask for. */
rt_attribute_use rt_material_attributes(const rt_scene *scene, const rt_material *material);

/* An attribute of a mesh by that number; *of: those that it is one of. NULL: the mesh has none. */
const rt_attribute *rt_mesh_attribute_of(const rt_attributes **of, const rt_scene *scene,
                                         const rt_scene_mesh *mesh, uint32_t number);

/*
 * Refuses a shape whose mesh, NULL for none, lacks what its textures ask for: coordinates are
 * two finite numbers, and what is shown is one or three from 0 to 1.
 */
rt_status rt_attributes_check(const rt_scene *scene, const rt_scene_mesh *mesh,
                              const rt_surface *surface, const char *who, rt_error *error);

#endif
