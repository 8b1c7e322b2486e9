/* inside.h - whether points lie in solids, decided on the host in double precision. */
#ifndef RT_LIB_SCENE_INSIDE_H
#define RT_LIB_SCENE_INSIDE_H

#include "scene/scene.h"

/*
 * Whether light can enter a solid of this material; the same as is_transparent in
 * kernels/material/medium.h.
 */
int rt_material_is_transparent(const rt_material *material);

/* Whether it is a thin sheet around a medium. */
int rt_material_is_filled(const rt_material *material);

/* The index of refraction inside a shape of it, one that light can enter. */
float rt_material_inner_ior(const rt_material *material);

/* Whether no light passes a surface of it, where there is any: an opacity may leave some out. */
int rt_material_is_opaque(const rt_material *material);

/* Whether surely nothing is seen through a shape of it. */
int rt_material_hides(const rt_material *material);

/*
 * Whether a point lies inside a shape, which must be closed: 1 inside, -1 inside a mesh whose
 * normals point inwards, else 0. A mesh is closed around the point when its faces, all turned the
 * same way, fill the sphere of directions.
 */
int rt_shape_contains(const rt_scene *scene, const rt_scene_shape *shape, const double p[3]);

/*
 * Whether it contains all corners of another shape's bounds; then, when it is convex, it contains
 * all of that.
 */
int rt_shape_contains_bounds(const rt_scene *scene, const rt_scene_shape *shape,
                             const rt_scene_shape *other);

/* Whether it surely contains all of another shape; up to 0.5 % of its size may be missed. */
int rt_shape_contains_shape(const rt_scene *scene, const rt_scene_shape *shape,
                            const rt_scene_shape *other);

#endif
