/* find_turned.c - closed meshes of glass whose faces are turned inwards. */
#include <math.h>

#include "base/vec.h"
#include "scene/check.h"
#include "scene/face.h"
#include "scene/inside.h"
#include "scene/inspection.h"

/* Faces of a mesh that are looked at, and the solid angles that these take. */
enum { TURNED_FACES = 8, ANGLES_MAX = 4000000 };

/* Six times the volume that the faces of a mesh enclose, negative where they have it in front. */
static double signed_volume(const rt_scene *scene, const rt_scene_shape *mesh)
{
    const size_t count = rt_face_count(scene, mesh);
    const rt_face first = rt_face_of(scene, mesh, 0);
    double sum = 0;
    for (size_t i = 0; i < count; i++) {
        const rt_face face = rt_face_of(scene, mesh, i);
        double off[3];
        for (int k = 0; k < 3; k++)
            off[k] = face.centre[k] - first.centre[k];
        sum += face.area > 0 ? 2 * face.area * rt_vec_dot(off, face.normal) : 0;
    }
    return sum;
}

/* Whether a closed mesh has its inside in front of its faces: those that are looked at do. */
static int is_inside_out(const rt_scene *scene, const rt_scene_shape *mesh)
{
    const size_t count = rt_face_count(scene, mesh),
                 step = count > TURNED_FACES ? count / TURNED_FACES : 1;
    int turned = 0;
    if (count > ANGLES_MAX / TURNED_FACES || signed_volume(scene, mesh) >= 0)
        return 0;
    for (size_t i = 0; i < count; i += step) {
        const rt_face face = rt_face_of(scene, mesh, i);
        double p[3];
        if (!(face.area > 0))
            continue;
        for (int k = 0; k < 3; k++)
            p[k] = face.centre[k] + 1e-3 * sqrt(face.area) * face.normal[k];
        if (rt_shape_contains(scene, mesh, p) >= 0)
            return 0;
        turned++;
    }
    return turned > 0;
}

void rt_find_inside_out(rt_inspection *in)
{
    const rt_scene *scene = in->scene;
    size_t checked = 0;
    for (size_t i = 0; i < scene->shape_count && checked < RT_CHECKED_MAX; i++) {
        const rt_scene_shape *shape = scene->shapes + i;
        rt_finding turned = rt_finding_of(RT_FINDING_INSIDE_OUT);
        if (shape->kind != RT_SHAPE_TRIANGLES ||
            !rt_inspection_is_glass(scene->materials + shape->material))
            continue;
        checked++;
        if (!is_inside_out(scene, shape))
            continue;
        turned.shape = (uint32_t)i;
        rt_inspection_report(in, turned,
                             "this mesh of glass is inside out: its faces are turned inwards, so "
                             "that the glass is outside of it");
    }
}
