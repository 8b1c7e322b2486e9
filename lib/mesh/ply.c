/* ply.c - reads the elements of a PLY file in the order in which they stand. */
#include "mesh/formats.h"

#include <stdlib.h>
#include <string.h>

#include "mesh/ply_faces.h"
#include "mesh/ply_vertices.h"

static rt_status skip_rows(rt_ply_reader *reader)
{
    const rt_ply_element *element = reader->element;
    rt_status status = RT_OK;
    /* Rows without properties take no place in the file, however many there are said to be. */
    while (element->property_count && reader->row < element->count && status == RT_OK) {
        for (size_t i = 0; i < element->property_count && status == RT_OK; i++)
            status = rt_ply_skip(reader, &element->properties[i]);
        if (status == RT_OK)
            status = rt_ply_end_row(reader);
    }
    return status;
}

static rt_status read_elements(rt_ply_faces *faces, rt_ply_reader *reader,
                               const rt_ply_header *header)
{
    rt_status status = RT_OK;
    for (size_t i = 0; i < header->element_count && status == RT_OK; i++) {
        const rt_ply_element *element = &header->elements[i];
        status = rt_ply_enter(reader, element);
        if (status != RT_OK)
            return status;
        if (rt_token_is(element->name, "vertex"))
            status = rt_ply_vertices_read(faces->mesh, reader);
        else if (rt_token_is(element->name, "face"))
            status = rt_ply_faces_read(faces, reader, 0);
        else if (rt_token_is(element->name, "tristrips"))
            status = rt_ply_faces_read(faces, reader, 1);
        else
            status = skip_rows(reader);
    }
    return status;
}

/*
 * Replaces the vertices of the file by the corners, each a copy with texture coordinates of its
 * own.
 */
static rt_status split_vertices(rt_ply_faces *faces, const rt_mesh_source *source)
{
    rt_canonical *mesh = faces->mesh;
    rt_canonical split = {0};
    const rt_unique *corners = &faces->corners;
    rt_status status = rt_canonical_vertices(&split, source, corners->count, mesh->has_normals, 1,
                                             mesh->colours != NULL);
    for (uint32_t i = 0; i < corners->count && status == RT_OK; i++) {
        uint32_t vertex = corners->keys[i][0];
        memcpy(rt_canonical_position(&split, i), rt_canonical_position(mesh, vertex),
               mesh->row * sizeof(float));
        memcpy(rt_canonical_uv(&split, i), corners->keys[i] + 1, 2 * sizeof(float));
        if (mesh->colours)
            memcpy(split.colours + 3 * (size_t)i, mesh->colours + 3 * (size_t)vertex,
                   3 * sizeof(float));
    }
    if (status != RT_OK) {
        rt_canonical_free(&split);
        return status;
    }
    rt_memory_free(mesh->vertices);
    rt_memory_free(mesh->colours);
    mesh->vertices = split.vertices;
    mesh->colours = split.colours;
    mesh->vertex_count = split.vertex_count;
    if (faces->bare_faces)
        rt_mesh_log(source, "%llu faces have no texture coordinates; they get 0 0",
                    (unsigned long long)faces->bare_faces);
    return RT_OK;
}

/* Texture coordinates by face, in a file without strips, whose corners could not have any. */
static int has_corners(const rt_ply_header *header)
{
    const rt_ply_element *face = rt_ply_find_element(header, "face");
    return face && face->count && rt_ply_faces_texcoord(face) &&
           !rt_ply_find_element(header, "tristrips");
}

static rt_status keep_texture(rt_canonical *mesh, const rt_ply_header *header,
                              const rt_mesh_source *source)
{
    if (header->texture.length == 0)
        return RT_OK;
    mesh->texture = malloc(header->texture.length + 1);
    if (!mesh->texture)
        return rt_fail(source->error, RT_ERROR_MEMORY, "out of memory for the name of a texture");
    memcpy(mesh->texture, header->texture.at, header->texture.length);
    mesh->texture[header->texture.length] = '\0';
    return RT_OK;
}

static rt_status read_body(rt_canonical *mesh, const rt_mesh_source *source,
                           const rt_ply_header *header)
{
    static const rt_ply_element no_vertices = {.count = 0};
    const rt_ply_element *vertex = rt_ply_find_element(header, "vertex");
    rt_ply_faces faces = {.mesh = mesh, .by_corner = has_corners(header)};
    rt_ply_reader reader = rt_ply_reader_begin(source, header);

    /*
     * The number of vertices bounds the indices, also of faces that come first; check it before
     * trusting it.
     */
    rt_status status = rt_ply_enter(&reader, vertex ? vertex : &no_vertices);
    if (status == RT_OK)
        status =
            rt_ply_vertices_prepare(mesh, &reader, vertex ? vertex : &no_vertices, faces.by_corner);
    faces.vertex_count = mesh->file_vertices;
    if (status == RT_OK)
        status = read_elements(&faces, &reader, header);
    if (status == RT_OK && faces.by_corner)
        status = split_vertices(&faces, source);
    if (status == RT_OK)
        status = rt_canonical_cut(mesh, source, NULL);
    if (status == RT_OK)
        status = keep_texture(mesh, header, source);
    if (status == RT_OK)
        mesh->goes_on = rt_ply_end(&reader);
    rt_ply_faces_free(&faces);
    return status;
}

rt_status rt_ply_read(rt_canonical *mesh, const rt_mesh_source *source)
{
    rt_ply_header header;
    rt_status status = rt_ply_header_read(&header, source);
    if (status == RT_OK)
        status = read_body(mesh, source, &header);
    rt_ply_header_free(&header);
    return status;
}
