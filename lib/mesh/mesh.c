/* mesh.c - frees a mesh. */
#include "mesh/mesh.h"

#include <stdlib.h>

void rt_mesh_destroy(rt_mesh *mesh)
{
    if (!mesh)
        return;
    free(mesh->positions);
    free(mesh->normals);
    free(mesh->uv);
    free(mesh->colours);
    free(mesh->indices);
    free(mesh->texture);
    free(mesh);
}
