/* mesh.c - frees a mesh. */
#include "mesh/mesh.h"

#include <stdlib.h>

#include "base/memory.h"

void rt_mesh_destroy(rt_mesh *mesh)
{
    if (!mesh)
        return;
    rt_memory_free(mesh->positions);
    rt_memory_free(mesh->normals);
    rt_memory_free(mesh->uv);
    rt_memory_free(mesh->colours);
    rt_attributes_free(&mesh->of_vertices);
    rt_attributes_free(&mesh->of_triangles);
    rt_memory_free(mesh->shared);
    rt_memory_free(mesh->indices);
    rt_memory_free(mesh->texture_of);
    free(mesh->textures);
    free(mesh);
}
