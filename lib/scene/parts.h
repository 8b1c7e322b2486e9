/* parts.h - materials made of others: blends, and those with a back of another material. */
#ifndef RT_LIB_SCENE_PARTS_H
#define RT_LIB_SCENE_PARTS_H

#include "scene/scene.h"

#define RT_PARTS_MOST 64 /* materials that one is made of, those in several places counted there */

/* Of which sides of a material. */
#define RT_SIDE_FRONT 1u
#define RT_SIDE_BACK 2u
#define RT_SIDE_BOTH 3u

int rt_material_has_parts(const rt_material *material);

/* Whether it tilts shading normals by itself. */
int rt_material_has_bumps(const rt_material *material);

/* The materials, of no parts themselves, that light may meet on these sides; returns how many. */
size_t rt_material_leaves(const rt_scene *scene, const rt_material *material, unsigned sides,
                          const rt_material *leaves[RT_PARTS_MOST]);

/* Whether something holds of one of these. */
int rt_material_any(const rt_scene *scene, const rt_material *material, unsigned sides,
                    int (*holds)(const rt_material *leaf));

/* The material of a part, 1 + its index or RT_MATERIAL_BLACK, of which nothing is reflected. */
const rt_material *rt_material_part(const rt_scene *scene, uint32_t part);

/* Calls for each texture of a material and its parts, but for that of emission. */
void rt_material_textures(const rt_scene *scene, const rt_material *material,
                          void (*found)(void *user, uint32_t handle), void *user);

/* Whether which part is met depends on u and v. */
int rt_parts_vary(const rt_scene *scene, const rt_material *material);

/* The rows that the parts of a material take on the device, besides its own. */
size_t rt_material_part_rows(const rt_scene *scene, const rt_material *material);

/*
 * Checks the parts of a material that is to be added, and gives a blend the boundary of those that
 * let light in, so that what it bounds does not depend on chance.
 */
rt_status rt_parts_complete(const rt_scene *scene, rt_material *material, const char *who,
                            rt_error *error);

/* Refuses a back where light passes from one side to the other; of a completed material. */
rt_status rt_parts_check_back(const rt_scene *scene, const rt_material *material, const char *who,
                              rt_error *error);

#endif
