/* scene.h - what a scene holds before it goes to a device. */
#ifndef RT_LIB_SCENE_SCENE_H
#define RT_LIB_SCENE_SCENE_H

#include "rt.h"
#include "types.h"

/* One shape as it was added; all in world space. */
typedef struct rt_scene_shape {
    rt_u32 kind; /* RT_SHAPE_* */
    rt_surface surface;
    float p[9]; /* sphere: centre, radius; plane: point, unit normal; quad: corner, edge1, edge2 */
    /* Triangles; owned by the scene. */
    float *positions;   /* [vertex_count][3] */
    float *normals;     /* [vertex_count][3], or NULL */
    uint32_t *indices;  /* [triangle_count][3] */
    size_t vertex_count, triangle_count;
} rt_scene_shape;

struct rt_scene {
    rt_material *materials;
    size_t material_count, material_room;
    rt_scene_shape *shapes;
    size_t shape_count, shape_room;
    rt_point_light *point_lights; /* intensity set, power converted */
    size_t point_light_count, point_light_room;
    rt_camera camera; /* defaults filled in */
    int has_camera;
    rt_render_options options; /* hooks NULL */
};

/* Primitives of a shape: triangles count one by one, every other shape is one. */
size_t rt_scene_shape_primitives(const rt_scene_shape *shape);

/* Radiance that a shape emits, W/(m^2 sr), from its own radiance or power or its material's emission. */
void rt_scene_shape_radiance(const rt_scene *scene, const rt_scene_shape *shape, float radiance[3]);

/* Area of one primitive of a finite shape, m^2. */
double rt_scene_primitive_area(const rt_scene_shape *shape, size_t primitive);

/* Most samples that a pixel can have. */
enum { RT_SPP_MAX = 1 << 24 };

/* Checks options for values out of their range; used for the scene's own and for rt_render's. */
rt_status rt_options_check(const rt_render_options *options, rt_error *error);

#endif
