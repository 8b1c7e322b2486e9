/* faces.c - normals and error bounds of triangles and parallelograms. */
#include "scene/faces.h"

#include <math.h>

#include "scene/vec.h"

/* The bound on n roundings of float32, as in kernels/surface.h. */
static double gamma_bound(double n)
{
    const double e = 1.0 / (1 << 24);
    return n * e / (1 - n * e);
}

/*
 * The bound covers two errors, both along the normal: that of the position, which the device mixes from the
 * vertices; and that with which a ray that leaves at a grazing angle sees the face's own plane: a few roundings
 * of its size, magnified where it is a sliver.
 */
static rt_face make_face(const float v0[3], const float v1[3], const float v2[3])
{
    double e1[3], e2[3], across[3], reach = 0;
    rt_face face = {{0, 0, 0}, 0};

    rt_vec_sub(e1, v1, v0);
    rt_vec_sub(e2, v2, v0);
    rt_vec_cross(across, e1, e2);
    double twice_area = rt_vec_length(across);
    if (!(twice_area > 0))
        return face;
    for (int i = 0; i < 3; i++) {
        double component = across[i] / twice_area;
        face.normal[i] = (float)component;
        reach += (fabs(v0[i]) + fabs(e1[i]) + fabs(e2[i])) * fabs(component);
    }
    double size = rt_vec_length(e1) + rt_vec_length(e2);
    double sliver = fmin(size * size / twice_area, 64);
    face.error = (float)((1 + 0x1p-23) * (gamma_bound(4) * reach + gamma_bound(2) * size * sliver));
    return face;
}

void rt_faces_fill(rt_face *faces, const rt_tri_block *blocks, size_t block_count)
{
    for (size_t i = 0; i < block_count * RT_BVH_WIDTH; i++) {
        const rt_tri_block *block = blocks + i / RT_BVH_WIDTH;
        float v0[3], v1[3], v2[3];
        for (int axis = 0; axis < 3; axis++) {
            v0[axis] = block->v0[axis][i % RT_BVH_WIDTH];
            v1[axis] = block->v1[axis][i % RT_BVH_WIDTH];
            v2[axis] = block->v2[axis][i % RT_BVH_WIDTH];
        }
        faces[i] = make_face(v0, v1, v2);
    }
}
