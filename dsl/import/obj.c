/* obj.c - OBJ files with their materials: one mesh for each material. */
#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "dsl/import/obj_data.h"
#include "dsl/import/sheet.h"
#include "rt.h"

enum { SUGGESTIONS_MAX = 32 }; /* notes before those without one */

static void bound(importer *import, const import_mesh *mesh)
{
    const matrix here = rt_matrix_identity();
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        const float *p = mesh->positions + 3 * i;
        double point[3] = {p[0], p[1], p[2]};
        rt_import_bound(import, &here, point, point);
    }
}

/* White where the vertices have colours, which it multiplies; else grey. */
static int add_default(importer *import, int line, const mtl_list *list, const char *name,
                       int has_colours)
{
    const char *const shade = has_colours ? "white" : "grey";
    import_material m = rt_import_material_begin();
    m.kd[0] = m.kd[1] = m.kd[2] = has_colours ? 1 : 0.7;
    rt_nearest nearest;
    rt_nearest_begin(&nearest, name, strlen(name));
    for (size_t i = 0; i < list->names.count && import->note_count < SUGGESTIONS_MAX; i++)
        rt_nearest_offer(&nearest, list->names.names[i], strlen(list->names.names[i]));
    if (name[0] && list->begun == 0)
        rt_import_note_at(import, line, "there are no materials: %s ones were added", shade);
    else if (name[0])
        rt_import_note_at(import, line, "there is no material '%.60s'%s%.60s%s: a %s one was added",
                          name, nearest.best ? " (did you mean '" : "",
                          nearest.best ? nearest.best : "", nearest.best ? "'?)" : "", shade);
    return rt_import_add_material(import, 0, shade, &m);
}

/* Whether vertices have another colour than white, which stands for none. */
static int has_colours(const import_mesh *mesh)
{
    for (size_t i = 0; mesh->colours && i < 3 * mesh->vertex_count; i++)
        if (mesh->colours[i] != 1)
            return 1;
    return 0;
}

/* Those of a scene are sRGB values, as Blender and MeshLab write them. */
static void decode_colours(import_mesh *mesh)
{
    for (size_t i = 0; mesh->colours && i < 3 * mesh->vertex_count; i++)
        mesh->colours[i] = (float)rt_import_decode_srgb(mesh->colours[i]);
}

/* The import_piece of each triangle of the file. To be freed. */
static unsigned char *find_sheets(importer *import, const obj_data *data)
{
    const size_t count = data->triangle_count;
    unsigned char *const out = malloc(count + 1);
    uint32_t *const indices = malloc((3 * count + 1) * sizeof *indices);
    for (size_t i = 0; indices && i < 3 * count; i++)
        indices[i] = data->corners[i].position;
    if (!out || !indices)
        rt_import_fail_memory(import);
    else
        rt_import_find_sheets(import, data->positions.values, indices, count, out);
    free(indices);
    return out;
}

/* Brings those of a group that are in sheets behind the others; returns how many these are. */
static size_t part_sheets(importer *import, const obj_data *data, int group,
                          const unsigned char *pieces, import_mesh *mesh)
{
    const uint32_t *const own = data->order + data->starts[group];
    unsigned char *const of_group = malloc(mesh->triangle_count + 1);
    size_t solids = mesh->triangle_count;
    for (size_t i = 0; of_group && i < mesh->triangle_count; i++)
        of_group[i] = pieces[own[i]];
    if (of_group)
        solids = rt_import_part_sheets(import, mesh, of_group);
    else
        rt_import_fail_memory(import);
    free(of_group);
    return solids;
}

/* Adds some triangles of a mesh, if there are any. */
static void add_part(importer *import, const import_mesh *mesh, size_t first, size_t count,
                     const char *name, int material)
{
    const import_surface surface = {
        .texture = IMPORT_NONE, .to_world = rt_matrix_identity(), .material = material};
    import_mesh part = *mesh;
    part.indices = mesh->indices + 3 * first;
    part.triangle_count = count;
    if (import->failed || count == 0 || !rt_import_mesh_has_area(&part))
        return;
    rt_import_note_colours(import, 0, material, mesh);
    rt_import_add_instance(import, 0, rt_import_add_mesh(import, 0, name[0] ? name : "mesh", &part),
                           &surface);
}

/* *sheets: as find_sheets has it, from when it is asked for. */
static void add_group(importer *import, const obj_data *data, mtl_list *list, int group,
                      unsigned char **sheets)
{
    import_mesh mesh;
    if (!rt_import_obj_mesh(import, &mesh, data, group))
        return;
    if (rt_import_mesh_has_area(&mesh)) {
        const char *const name = data->materials.names[group];
        const size_t count = mesh.triangle_count;
        size_t solids = count;
        int material = rt_mtl_find(import, list, name);
        if (material == IMPORT_NONE)
            material = add_default(import, data->lines[group], list, name, mesh.colours != NULL);
        else if (has_colours(&mesh))
            material = rt_mtl_coloured(import, list, material, name);
        bound(import, &mesh);
        decode_colours(&mesh);
        if (rt_mtl_may_be_sheet(list, material)) {
            *sheets = *sheets ? *sheets : find_sheets(import, data);
            if (*sheets && !import->failed)
                solids = part_sheets(import, data, group, *sheets, &mesh);
        }
        add_part(import, &mesh, 0, solids, name, material);
        if (solids < count)
            add_part(import, &mesh, solids, count - solids, name,
                     rt_mtl_sheet(import, list, material, name));
    }
    rt_import_mesh_free(&mesh);
}

void rt_import_obj(importer *import, const char *text, size_t size)
{
    obj_data data = {0};
    mtl_list list = {0};
    unsigned char *sheets = NULL;
    char *copy = malloc(size + 1);
    if (!copy) {
        rt_import_fail_memory(import);
        return;
    }
    memcpy(copy, text, size + 1);
    rt_import_obj_read(import, &data, &list, copy);
    for (size_t i = 0; i < data.materials.count && !import->failed; i++)
        add_group(import, &data, &list, (int)i, &sheets);
    if (!import->failed && data.triangle_count == 0)
        rt_import_note_at(import, 0, "there is no face in it that is read");
    else if (!import->failed && import->shape_count == 0)
        rt_import_note_at(import, 0, "no face in it has an area");
    rt_import_obj_free(&data);
    rt_mtl_free(&list);
    free(sheets);
    free(copy);
}
