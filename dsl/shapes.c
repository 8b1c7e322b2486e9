/*
 * shapes.c - the blocks of shapes: for each the struct, the fields that fill it, and the function
 * that adds it to the scene; at the end the table of all. A shape is added here and nowhere else in
 * dsl/.
 */
#include "dsl/rows.h"

/* ---- plane ------------------------------------------------------------------- */

typedef struct plane {
    float point[3], normal[3];
    rt_surface surface;
} plane;

static const rt_field plane_fields[] = {
    {"point", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(plane, point), "any point of the plane"},
    {"normal", VECTOR, REQUIRED, DIRECTION, "", "", NULL, AT(plane, normal),
     "perpendicular to the plane; of any length"},
    SURFACE(plane),
};

static rt_status build_plane(rt_scene *scene, const void *fields, rt_build_name *name,
                             rt_error *error)
{
    const plane *s = fields;
    (void)name;
    return rt_scene_add_plane(scene, NULL, s->point, s->normal, &s->surface, error);
}

/* ---- sphere ------------------------------------------------------------------ */

typedef struct sphere {
    float centre[3], radius;
    rt_surface surface;
} sphere;

static const rt_field sphere_fields[] = {
    {"centre", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(sphere, centre), "centre of the sphere"},
    {"radius", NUMBER, REQUIRED, LENGTH, "m", "", NULL, AT(sphere, radius), "radius of the sphere"},
    SURFACE(sphere),
    EMISSION(sphere),
};

static rt_status build_sphere(rt_scene *scene, const void *fields, rt_build_name *name,
                              rt_error *error)
{
    const sphere *s = fields;
    (void)name;
    return rt_scene_add_sphere(scene, NULL, s->centre, s->radius, &s->surface, error);
}

/* ---- triangle ---------------------------------------------------------------- */

typedef struct triangle {
    float corners[3][3], normals[3][3], uv[3][2];
    rt_surface surface;
} triangle;

static const rt_field triangle_fields[] = {
    {"a", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(triangle, corners[0]), "first corner"},
    {"b", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(triangle, corners[1]), "second corner"},
    {"c", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(triangle, corners[2]),
     "third corner; counter-clockwise seen from the side of the normal"},
    {"na", VECTOR, ALL_OR_NONE, DIRECTION, "", "flat", NULL, AT(triangle, normals[0]),
     "shading normal at a, of any length; give all three or none"},
    {"nb", VECTOR, ALL_OR_NONE, DIRECTION, "", "flat", NULL, AT(triangle, normals[1]),
     "shading normal at b"},
    {"nc", VECTOR, ALL_OR_NONE, DIRECTION, "", "flat", NULL, AT(triangle, normals[2]),
     "shading normal at c"},
    {"uva", PAIR, ALL_OR_NONE_TOO, ANY, "", "0 0", NULL, AT(triangle, uv[0]),
     "texture coordinates at a; give all three or none"},
    {"uvb", PAIR, ALL_OR_NONE_TOO, ANY, "", "1 0", NULL, AT(triangle, uv[1]),
     "texture coordinates at b"},
    {"uvc", PAIR, ALL_OR_NONE_TOO, ANY, "", "0 1", NULL, AT(triangle, uv[2]),
     "texture coordinates at c"},
    SURFACE(triangle),
    EMISSION(triangle),
};

static int is_zero(const float *v, int count)
{
    for (int i = 0; i < count; i++)
        if (v[i] != 0)
            return 0;
    return 1;
}

static rt_status build_triangle(rt_scene *scene, const void *fields, rt_build_name *name,
                                rt_error *error)
{
    static const uint32_t indices[3] = {0, 1, 2};
    const triangle *s = fields;
    uint32_t mesh;
    rt_mesh_data data = {
        .positions = s->corners[0], .indices = indices, .vertex_count = 3, .triangle_count = 1};
    (void)name;
    data.normals = is_zero(s->normals[0], 3) ? NULL : s->normals[0];
    data.uv = is_zero(s->uv[0], 6) ? NULL : s->uv[0];
    rt_status status = rt_scene_add_mesh(scene, &mesh, &data, error);
    return status == RT_OK ? rt_scene_add_instance(scene, NULL, mesh, &s->surface, error) : status;
}

/* ---- quad -------------------------------------------------------------------- */

typedef struct quad {
    float corner[3], edge1[3], edge2[3];
    rt_surface surface;
} quad;

static const rt_field quad_fields[] = {
    {"corner", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(quad, corner), "one corner"},
    {"edge1", VECTOR, REQUIRED, DIRECTION, "m", "", NULL, AT(quad, edge1),
     "from it to the next corner"},
    {"edge2", VECTOR, REQUIRED, DIRECTION, "m", "", NULL, AT(quad, edge2),
     "from it to the other neighbour; the normal is edge1 x edge2 (right hand: thumb edge1, "
     "forefinger edge2, middle finger the normal)"},
    SURFACE(quad),
    EMISSION(quad),
};

static rt_status build_quad(rt_scene *scene, const void *fields, rt_build_name *name,
                            rt_error *error)
{
    const quad *s = fields;
    (void)name;
    return rt_scene_add_quad(scene, NULL, s->corner, s->edge1, s->edge2, &s->surface, error);
}

/* ---- disc -------------------------------------------------------------------- */

typedef struct disc {
    float centre[3], normal[3], radius, inner_radius;
    rt_surface surface;
} disc;

static const rt_field disc_fields[] = {
    {"centre", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(disc, centre), "centre of the disc"},
    {"normal", VECTOR, REQUIRED, DIRECTION, "", "", NULL, AT(disc, normal),
     "perpendicular to the disc, on the side that emits; of any length"},
    {"radius", NUMBER, REQUIRED, LENGTH, "m", "", NULL, AT(disc, radius),
     "radius of the outer rim"},
    {"inner_radius", NUMBER, OPTIONAL, LENGTH_OR_ZERO, "m", "0", NULL, AT(disc, inner_radius),
     "radius of the hole; less than radius"},
    SURFACE(disc),
    EMISSION(disc),
};

static rt_status build_disc(rt_scene *scene, const void *fields, rt_build_name *name,
                            rt_error *error)
{
    const disc *s = fields;
    (void)name;
    return rt_scene_add_disc(scene, NULL, s->centre, s->normal, s->radius, s->inner_radius,
                             &s->surface, error);
}

/* ---- cylinder ---------------------------------------------------------------- */

typedef struct cylinder {
    float a[3], b[3], radius;
    int caps;
    rt_surface surface;
} cylinder;

static const rt_field cylinder_fields[] = {
    {"a", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(cylinder, a), "centre of one end"},
    {"b", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(cylinder, b), "centre of the other end"},
    {"radius", NUMBER, REQUIRED, LENGTH, "m", "", NULL, AT(cylinder, radius),
     "radius of the cylinder"},
    {"caps", BOOLEAN, OPTIONAL, ANY, "", "true", NULL, AT(cylinder, caps),
     "true: closed by discs at both ends; false: an open tube"},
    SURFACE(cylinder),
    EMISSION(cylinder),
};

static rt_status build_cylinder(rt_scene *scene, const void *fields, rt_build_name *name,
                                rt_error *error)
{
    const cylinder *s = fields;
    (void)name;
    return rt_scene_add_cylinder(scene, NULL, s->a, s->b, s->radius, s->caps, &s->surface, error);
}

/* ---- cone -------------------------------------------------------------------- */

typedef struct cone {
    float base[3], apex[3], radius, apex_radius;
    int caps;
    rt_surface surface;
} cone;

static const rt_field cone_fields[] = {
    {"base", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(cone, base), "centre of the wide end"},
    {"apex", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(cone, apex),
     "the tip, or centre of the narrow end"},
    {"radius", NUMBER, REQUIRED, LENGTH, "m", "", NULL, AT(cone, radius), "at the base"},
    {"apex_radius", NUMBER, OPTIONAL, LENGTH_OR_ZERO, "m", "0", NULL, AT(cone, apex_radius),
     "at the apex: more than 0 makes a frustum; at most radius"},
    {"caps", BOOLEAN, OPTIONAL, ANY, "", "true", NULL, AT(cone, caps),
     "true: closed by discs; false: open"},
    SURFACE(cone),
    EMISSION(cone),
};

static rt_status build_cone(rt_scene *scene, const void *fields, rt_build_name *name,
                            rt_error *error)
{
    const cone *s = fields;
    (void)name;
    return rt_scene_add_cone(scene, NULL, s->base, s->apex, s->radius, s->apex_radius, s->caps,
                             &s->surface, error);
}

/* ---- ellipsoid --------------------------------------------------------------- */

typedef struct ellipsoid {
    float centre[3], radii[3];
    rt_surface surface;
} ellipsoid;

static const rt_field ellipsoid_fields[] = {
    {"centre", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(ellipsoid, centre),
     "centre of the ellipsoid"},
    {"radii", VECTOR, REQUIRED, LENGTH, "m", "", NULL, AT(ellipsoid, radii),
     "half-axes along x, y and z; rotate turns them"},
    SURFACE(ellipsoid),
    EMISSION(ellipsoid),
};

static rt_status build_ellipsoid(rt_scene *scene, const void *fields, rt_build_name *name,
                                 rt_error *error)
{
    const ellipsoid *s = fields;
    (void)name;
    return rt_scene_add_ellipsoid(scene, NULL, s->centre, s->radii, &s->surface, error);
}

/* ---- torus ------------------------------------------------------------------- */

typedef struct torus {
    float centre[3], axis[3], major_radius, minor_radius;
    rt_surface surface;
} torus;

static const rt_field torus_fields[] = {
    {"centre", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(torus, centre), "centre of the hole"},
    {"axis", VECTOR, REQUIRED, DIRECTION, "", "", NULL, AT(torus, axis),
     "perpendicular to the ring; of any length"},
    {"major_radius", NUMBER, REQUIRED, LENGTH, "m", "", NULL, AT(torus, major_radius),
     "from the centre of the hole to the centre of the tube"},
    {"minor_radius", NUMBER, REQUIRED, LENGTH, "m", "", NULL, AT(torus, minor_radius),
     "radius of the tube; less than major_radius"},
    SURFACE(torus),
    EMISSION(torus),
};

static rt_status build_torus(rt_scene *scene, const void *fields, rt_build_name *name,
                             rt_error *error)
{
    const torus *s = fields;
    (void)name;
    return rt_scene_add_torus(scene, NULL, s->centre, s->axis, s->major_radius, s->minor_radius,
                              &s->surface, error);
}

/* ---- box --------------------------------------------------------------------- */

typedef struct box {
    float centre[3], size[3];
    rt_surface surface;
} box;

static const rt_field box_fields[] = {
    {"centre", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(box, centre), "centre of the box"},
    {"size", VECTOR, REQUIRED, LENGTH, "m", "", NULL, AT(box, size),
     "full lengths of the edges along x, y and z; rotate turns them"},
    SURFACE(box),
    EMISSION(box),
};

static rt_status build_box(rt_scene *scene, const void *fields, rt_build_name *name,
                           rt_error *error)
{
    const box *s = fields;
    (void)name;
    return rt_scene_add_box(scene, NULL, s->centre, s->size, &s->surface, error);
}

/* ---- mesh, instance, model -------------------------------------------------- */

/* Of a mesh, an instance and a model, which has all of it. */
typedef struct mesh {
    const char *path;
    int shading; /* rt_shading */
    rt_surface surface;
} mesh;

static const rt_word shadings[] = {RT_SHADINGS(RT_WORD) RT_WORD_END};

#define MESH_FILE(type)                                                                            \
    ROW("file", FILE_NAME, REQUIRED, ANY, "", "", NULL, AT(type, path),                            \
        "a .ply, .obj, .off or .stl; format detected from content"),                               \
        ROW("shading", CHOICE, OPTIONAL, ANY, "", "file", shadings, AT(type, shading),             \
            "where shading normals come from")
#define MESH_SURFACE(type)                                                                         \
    SURFACE_TEXTURE(type,                                                                          \
                    "multiplies kd; left out, the texture that the mesh file names, if any"),      \
        SURFACE_BUT_TEXTURE(type)

static const rt_field mesh_fields[] = {
    MESH_FILE(mesh),
};

static const rt_field instance_fields[] = {
    MESH_SURFACE(mesh),
    EMISSION(mesh),
};

static const rt_field model_fields[] = {
    MESH_FILE(mesh),
    MESH_SURFACE(mesh),
    EMISSION(mesh),
};

static rt_status build_mesh(rt_scene *scene, const void *fields, rt_build_name *name,
                            rt_error *error)
{
    const mesh *s = fields;
    rt_mesh_info info;
    rt_status status =
        rt_scene_load_mesh(scene, &name->index, s->path, (rt_shading)s->shading, &info, error);
    if (status != RT_OK)
        return status;
    name->texture = info.texture;
    name->parts = info.part_count;
    name->names_materials = info.names_materials;
    name->goes_on = info.goes_on;
    name->warnings = info.warnings;
    return RT_OK;
}

/* Places a mesh; it has the texture of its file unless the block gives one. */
static rt_status build_instance(rt_scene *scene, const void *fields, rt_build_name *name,
                                rt_error *error)
{
    rt_surface surface = ((const mesh *)fields)->surface;
    if (surface.texture == 0)
        surface.texture = name->texture;
    return rt_scene_add_instance(scene, NULL, name->index, &surface, error);
}

static rt_status build_model(rt_scene *scene, const void *fields, rt_build_name *name,
                             rt_error *error)
{
    rt_status status = build_mesh(scene, fields, name, error);
    return status == RT_OK ? build_instance(scene, fields, name, error) : status;
}

/* ---- The table ---------------------------------------------------------------------------- */

/* The row of a shape whose word, struct, fields and builder have one name. */
#define FITS(type) (sizeof(char[sizeof(type) <= RT_SHAPE_FIELDS_SIZE ? 1 : -1]) - 1)
#define SHAPE(name)                                                                                \
    {                                                                                              \
        RT_BLOCK_SHAPE, #name, NULL, 0, name##_fields, COUNT(name##_fields) + FITS(name),          \
            build_##name                                                                           \
    }

const rt_block rt_shape_blocks[] = {
    SHAPE(plane),
    SHAPE(sphere),
    SHAPE(triangle),
    SHAPE(quad),
    SHAPE(disc),
    SHAPE(cylinder),
    SHAPE(cone),
    SHAPE(ellipsoid),
    SHAPE(torus),
    SHAPE(box),
    {RT_BLOCK_MESH, "mesh", NULL, RT_BLOCK_NAMED, FIELDS(mesh_fields), build_mesh},
    {RT_BLOCK_INSTANCE, "instance", NULL, RT_BLOCK_REFERS, FIELDS(instance_fields), build_instance},
    {RT_BLOCK_SHAPE, "model", NULL, 0, FIELDS(model_fields), build_model},
};
const size_t rt_shape_block_count = COUNT(rt_shape_blocks);
