/* classes.c - the table of the classes by kind, made from the list of shapes. */
#include "shape/classes.h"

const rt_shape_class *rt_shape_class_of(rt_u32 kind)
{
#define ENTRY(KIND, name, number) [RT_SHAPE_##KIND] = &rt_shape_##name,
    static const rt_shape_class *const classes[] = {RT_SHAPES(ENTRY)};
#undef ENTRY
    return classes[kind];
}

rt_shape_boundary rt_boundary_solid(const rt_scene *scene, const rt_scene_shape *shape)
{
    (void)scene, (void)shape;
    return RT_BOUNDARY_SOLID;
}

rt_shape_boundary rt_boundary_flat(const rt_scene *scene, const rt_scene_shape *shape)
{
    (void)scene, (void)shape;
    return RT_BOUNDARY_FLAT;
}
