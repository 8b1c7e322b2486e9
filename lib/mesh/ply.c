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

/* Replaces the vertices of the file by the corners, with what faces bring. */
static rt_status split_vertices(rt_ply_faces *faces, const rt_mesh_source *source)
{
    const rt_status status = rt_canonical_split(faces->mesh, source, &faces->corners,
                                                faces->has_texcoord ? RT_PLY_CORNER_UV : 0,
                                                faces->has_colour ? RT_PLY_CORNER_COLOUR : 0);
    faces->mesh->has_bare_corners = faces->has_bare_corners;
    return status;
}

/* What faces bring, in a file without strips, whose corners could not have any. */
static void find_corners(rt_ply_faces *faces, const rt_ply_header *header,
                         const rt_mesh_source *source)
{
    const rt_ply_element *face = rt_ply_find_element(header, "face");
    const rt_ply_element *vertex = rt_ply_find_element(header, "vertex");
    const rt_ply_property *colour[3];
    if (!face || !face->count)
        return;
    const int may_be_split = !rt_ply_find_element(header, "tristrips");
    faces->has_texcoord = may_be_split && rt_ply_faces_texcoord(face) != NULL;
    faces->has_colour = may_be_split && rt_ply_find_colour(face, colour);
    if (faces->has_colour && vertex && rt_ply_find_colour(vertex, colour)) {
        faces->has_colour = 0;
        rt_mesh_warn(&faces->mesh->warnings, source, 0,
                     "vertices and faces have colours: those of the faces are left out");
    }
    if (header->texture_count > 1 && rt_ply_faces_texnumber(face))
        faces->texture_count = (uint32_t)header->texture_count;
    else if (header->texture_count > 1)
        rt_mesh_warn(&faces->mesh->warnings, source, 0,
                     "%zu textures, but no texnumber of faces: all have the first",
                     header->texture_count);
    faces->corners.words = RT_PLY_CORNER_WORDS;
}

static rt_status keep_textures(rt_ply_faces *faces, const rt_ply_header *header,
                               const rt_mesh_source *source)
{
    rt_canonical *mesh = faces->mesh;
    size_t size = 0;
    for (size_t i = 0; i < header->texture_count; i++)
        size += header->textures[i].length + 1;
    if (size == 0)
        return RT_OK;
    mesh->textures = calloc(size, 1);
    if (!mesh->textures)
        return rt_fail(source->error, RT_ERROR_MEMORY, "out of memory for the name of a texture");
    char *at = mesh->textures;
    for (size_t i = 0; i < header->texture_count; i++, at++) {
        memcpy(at, header->textures[i].at, header->textures[i].length);
        at += header->textures[i].length;
    }
    mesh->texture_count = (uint32_t)header->texture_count;
    /* Strips behind the faces have no number. */
    if (faces->texture_count && faces->textured == mesh->triangle_count) {
        mesh->texture_of = faces->texture_of;
        faces->texture_of = NULL;
    }
    if (faces->bad_textures)
        rt_mesh_warn(&mesh->warnings, source, 0,
                     "%llu faces have a texnumber beyond the %u textures that are named: they have "
                     "none",
                     (unsigned long long)faces->bad_textures, mesh->texture_count);
    return RT_OK;
}

static rt_status read_body(rt_canonical *mesh, const rt_mesh_source *source,
                           const rt_ply_header *header)
{
    static const rt_ply_element no_vertices = {.count = 0};
    const rt_ply_element *vertex = rt_ply_find_element(header, "vertex"),
                         *face = rt_ply_find_element(header, "face");
    rt_ply_faces faces = {.mesh = mesh};
    rt_ply_reader reader = rt_ply_reader_begin(source, header);
    find_corners(&faces, header, source);

    /*
     * The number of vertices bounds the indices, also of faces that come first; check it before
     * trusting it.
     */
    rt_status status = rt_ply_enter(&reader, vertex ? vertex : &no_vertices);
    if (status == RT_OK)
        status = rt_ply_vertices_prepare(mesh, &reader, vertex ? vertex : &no_vertices,
                                         faces.has_texcoord);
    faces.vertex_count = mesh->file_vertices;
    if (status == RT_OK && face && !rt_ply_find_element(header, "tristrips"))
        status = rt_ply_faces_attributes(&faces, face, source);
    if (status == RT_OK)
        status = read_elements(&faces, &reader, header);
    if (status == RT_OK && (faces.has_texcoord || faces.has_colour))
        status = split_vertices(&faces, source);
    if (status == RT_OK)
        status = rt_canonical_cut(mesh, source, NULL);
    if (status == RT_OK)
        status = keep_textures(&faces, header, source);
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
