/* faces.h - normals and error bounds of triangles and parallelograms. */
#ifndef RT_LIB_SCENE_FACES_H
#define RT_LIB_SCENE_FACES_H

#include <stddef.h>

#include "types.h"

/* Fills faces[block_count][RT_BVH_WIDTH] from the blocks. */
void rt_faces_fill(rt_face *faces, const rt_tri_block *blocks, size_t block_count);

#endif
