/* blocks.c - the tables of the language: every block and every field. */
#include "dsl/schema.h"

#define COUNT(array) (sizeof(array) / sizeof(array)[0])
#define AT(type, member) offsetof(type, member), sizeof(((type *)0)->member)

/* ---- Ranges, choices ----------------------------------------------------- */

#define ANY                                                                                        \
    {                                                                                              \
        RT_RANGE_ANY, 0, 0                                                                         \
    }
#define ABOVE_TO(low, high)                                                                        \
    {                                                                                              \
        RT_RANGE_ABOVE, low, high                                                                  \
    }
#define FROM_TO(low, high)                                                                         \
    {                                                                                              \
        RT_RANGE_CLOSED, low, high                                                                 \
    }
#define BETWEEN(low, high)                                                                         \
    {                                                                                              \
        RT_RANGE_BETWEEN, low, high                                                                \
    }
#define UNIT FROM_TO(0, 1)
#define LENGTH FROM_TO(1e-15, 1e15)
#define LENGTH_OR_ZERO FROM_TO(0, 1e15)
#define LIGHT FROM_TO(0, 1e28)
#define HALF_TURN                                                                                  \
    {                                                                                              \
        RT_RANGE_CLOSED, 1e-3, 180                                                                 \
    }
#define DIRECTION                                                                                  \
    {                                                                                              \
        RT_RANGE_DIRECTION, 0, 0                                                                   \
    }
#define NOT_ZERO                                                                                   \
    {                                                                                              \
        RT_RANGE_NOT_ZERO, 0, 0                                                                    \
    }

#define UINT32_LAST 4294967295.0
#define INTEGER_LAST 2147483647.0

/* The order of each list is that of its enum in rt.h or common.h. */
static const char *const modes[] = {"path", "photon", "direct", "normals", "albedo", "depth", NULL};
static const char *const filters[] = {"box", "tent", "gaussian", "mitchell", NULL};
static const char *const projections[] = {"perspective", "orthographic", "environment", NULL};
static const char *const patterns[] = {"image", "checker", "gradient", NULL};
static const char *const wraps[] = {"repeat", "mirror", "clamp", NULL};
static const char *const fresnels[] = {"off", "dielectric", "conductor", NULL};
static const char *const shadings[] = {"file", "flat", "smooth", NULL};
static const char *const samplers[] = {"sobol", "independent", NULL};
static const char *const estimators[] = {"mis", "light", "bsdf", NULL};
static const char *const gathers[] = {"auto", "flann", "device", NULL};
static const char *const areas[] = {"disc", "hull", NULL};
static const char *const directs[] = {"nee", "photons", NULL};
static const char *const kernels[] = {"epanechnikov",    "box", "cone", "gaussian", "silverman",
                                      "gaussian_jensen", NULL};

/* ---- Fields -------------------------------------------------------------- */

/* Shorthands for the rows: type and need. */
#define NUMBER RT_FIELD_NUMBER
#define INTEGER RT_FIELD_INTEGER
#define COUNT_OR_ALL RT_FIELD_COUNT
#define PAIR RT_FIELD_PAIR
#define VECTOR RT_FIELD_VECTOR
#define COLOUR RT_FIELD_COLOUR
#define BOOLEAN RT_FIELD_BOOLEAN
#define CHOICE RT_FIELD_CHOICE
#define TEXTURE RT_FIELD_TEXTURE
#define FILE_NAME RT_FIELD_FILE
#define OPTIONAL RT_NEED_OPTIONAL
#define REQUIRED RT_NEED_REQUIRED
#define ONE_OF RT_NEED_ONE_OF
#define AT_MOST_ONE RT_NEED_AT_MOST_ONE
#define ALL_OR_NONE RT_NEED_ALL_OR_NONE
#define ALL_OR_NONE_TOO RT_NEED_ALL_OR_NONE_TOO

/* What every shape has, and what every finite shape has besides. */
#define SURFACE(type)                                                                              \
    {"material", RT_FIELD_MATERIAL, REQUIRED, ANY, "", "", NULL, AT(type, surface.material)},      \
        {"texture", TEXTURE, OPTIONAL, ANY, "", "none", NULL, AT(type, surface.texture)},          \
        {"translate", RT_FIELD_TRANSLATE,         OPTIONAL, ANY, "m", "none",                      \
         NULL,        AT(type, surface.transform)},                                                \
        {"rotate",  RT_FIELD_ROTATE, OPTIONAL, DIRECTION,                                          \
         "degrees", "none",          NULL,     AT(type, surface.transform)},                       \
        {"scale", RT_FIELD_SCALE, OPTIONAL, NOT_ZERO,                                              \
         "",      "none",         NULL,     AT(type, surface.transform)},                          \
    {                                                                                              \
        "matrix", RT_FIELD_MATRIX, OPTIONAL, ANY, "", "none", NULL, AT(type, surface.transform)    \
    }
#define LAMP(type)                                                                                 \
    {"radiance",   COLOUR,                                                                         \
     AT_MOST_ONE,  LIGHT,                                                                          \
     "W/(m^2 sr)", "that of the material",                                                         \
     NULL,         AT(type, surface.radiance)},                                                    \
    {                                                                                              \
        "power", COLOUR, AT_MOST_ONE, LIGHT, "W", "none", NULL, AT(type, surface.power)            \
    }

static const rt_field camera_fields[] = {
    {"projection", CHOICE, OPTIONAL, ANY, "", "perspective", projections, AT(rt_camera, kind)},
    {"eye", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_camera, eye)},
    {"look_at", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_camera, look_at)},
    {"up", VECTOR, OPTIONAL, DIRECTION, "", "0 1 0", NULL, AT(rt_camera, up)},
    {"fov", NUMBER, OPTIONAL, BETWEEN(0, 180), "degrees", "45", NULL, AT(rt_camera, fov)},
    {"width", NUMBER, OPTIONAL, LENGTH, "m", "2", NULL, AT(rt_camera, width)},
    {"aperture", NUMBER, OPTIONAL, LENGTH_OR_ZERO, "m", "0", NULL, AT(rt_camera, aperture)},
    {"focal_distance", NUMBER, OPTIONAL, LENGTH, "m", "that of look_at", NULL,
     AT(rt_camera, focal_distance)},
    {"blades", INTEGER, OPTIONAL, FROM_TO(3, 64), "", "round", NULL, AT(rt_camera, blades)},
    {"blade_rotation", NUMBER, OPTIONAL, ANY, "degrees", "0", NULL, AT(rt_camera, blade_rotation)},
};

static const rt_field film_fields[] = {
    {"width", INTEGER, OPTIONAL, FROM_TO(1, 65536), "pixels", "512", NULL,
     AT(rt_render_options, width)},
    {"height", INTEGER, OPTIONAL, FROM_TO(1, 65536), "pixels", "512", NULL,
     AT(rt_render_options, height)},
    {"filter", CHOICE, OPTIONAL, ANY, "", "box", filters, AT(rt_render_options, filter)},
};

static const rt_field render_fields[] = {
    {"mode", CHOICE, OPTIONAL, ANY, "", "path", modes, AT(rt_render_options, mode)},
    {"spp", INTEGER, OPTIONAL, FROM_TO(1, 16777216), "", "64, in mode photon 16, in passes 1", NULL,
     AT(rt_render_options, spp)},
    {"max_depth", INTEGER, OPTIONAL, FROM_TO(1, 4096), "segments", "16", NULL,
     AT(rt_render_options, max_depth)},
    {"roulette_depth", INTEGER, OPTIONAL, FROM_TO(1, 4096), "segments", "2", NULL,
     AT(rt_render_options, roulette_depth)},
    {"roulette_threshold", NUMBER, OPTIONAL, FROM_TO(1e-6, 1), "", "0.5", NULL,
     AT(rt_render_options, roulette_threshold)},
    {"seed", INTEGER, OPTIONAL, FROM_TO(0, UINT32_LAST), "", "0", NULL,
     AT(rt_render_options, seed)},
    {"sampler", CHOICE, OPTIONAL, ANY, "", "sobol", samplers, AT(rt_render_options, sampler)},
    {"estimator", CHOICE, OPTIONAL, ANY, "", "mis", estimators, AT(rt_render_options, estimator)},
    {"time", NUMBER, OPTIONAL, ABOVE_TO(0, 1e9), "s", "no limit", NULL,
     AT(rt_render_options, time)},
    {"target_error", NUMBER, OPTIONAL, ABOVE_TO(0, 1), "", "none", NULL,
     AT(rt_render_options, target_error)},
    {"photons", INTEGER, OPTIONAL, FROM_TO(1, 4e9), "", "1000000, in passes one a pixel", NULL,
     AT(rt_render_options, photons)},
    {"k", COUNT_OR_ALL, OPTIONAL, FROM_TO(2, 65536), "", "50", NULL, AT(rt_render_options, k)},
    {"radius", NUMBER, OPTIONAL, LENGTH, "m", "no limit", NULL, AT(rt_render_options, radius)},
    {"gather", CHOICE, OPTIONAL, ANY, "", "auto", gathers, AT(rt_render_options, gather)},
    {"passes", INTEGER, OPTIONAL, FROM_TO(1, 16777216), "", "1", NULL,
     AT(rt_render_options, passes)},
    {"alpha", NUMBER, OPTIONAL, BETWEEN(0, 1), "", "2/3", NULL, AT(rt_render_options, alpha)},
    {"kernel", CHOICE, OPTIONAL, ANY, "", "epanechnikov", kernels, AT(rt_render_options, kernel)},
    {"cone_k", NUMBER, OPTIONAL, FROM_TO(1, 1e6), "", "1.1", NULL, AT(rt_render_options, cone_k)},
    {"area", CHOICE, OPTIONAL, ANY, "", "disc", areas, AT(rt_render_options, area)},
    {"direct", CHOICE, OPTIONAL, ANY, "", "nee", directs, AT(rt_render_options, direct)},
    {"final_gather", INTEGER, OPTIONAL, FROM_TO(0, 4096), "bounces", "0", NULL,
     AT(rt_render_options, final_gather)},
    {"caustic_photons", INTEGER, OPTIONAL, FROM_TO(0, 4e9), "", "0", NULL,
     AT(rt_render_options, caustic_photons)},
    {"caustic_k", COUNT_OR_ALL, OPTIONAL, FROM_TO(2, 65536), "", "that of k", NULL,
     AT(rt_render_options, caustic_k)},
    {"caustic_radius", NUMBER, OPTIONAL, LENGTH, "m", "that of radius", NULL,
     AT(rt_render_options, caustic_radius)},
    {"caustic_kernel", CHOICE, OPTIONAL, ANY, "", "epanechnikov", kernels,
     AT(rt_render_options, caustic_kernel)},
    {"aov", BOOLEAN, OPTIONAL, ANY, "", "false", NULL, AT(rt_render_options, aov)},
    {"photon_layers", BOOLEAN, OPTIONAL, ANY, "", "false", NULL,
     AT(rt_render_options, photon_layers)},
    {"variance", BOOLEAN, OPTIONAL, ANY, "", "false", NULL, AT(rt_render_options, variance)},
};

static const rt_field texture_fields[] = {
    {"pattern", CHOICE, OPTIONAL, ANY, "", "image", patterns, AT(rt_texture, kind)},
    {"file", FILE_NAME, OPTIONAL, ANY, "", "required of an image", NULL, AT(rt_texture, path)},
    {"linear", BOOLEAN, OPTIONAL, ANY, "", "false", NULL, AT(rt_texture, linear)},
    {"a", COLOUR, OPTIONAL, LIGHT, "", "0", NULL, AT(rt_texture, a)},
    {"b", COLOUR, OPTIONAL, LIGHT, "", "0", NULL, AT(rt_texture, b)},
    {"wrap", CHOICE, OPTIONAL, ANY, "", "repeat", wraps, AT(rt_texture, wrap)},
    {"scale", PAIR, OPTIONAL, NOT_ZERO, "", "1 1", NULL, AT(rt_texture, scale)},
    {"offset", PAIR, OPTIONAL, ANY, "", "0 0", NULL, AT(rt_texture, offset)},
};

static const rt_field material_fields[] = {
    {"kd", COLOUR, OPTIONAL, UNIT, "", "0", NULL, AT(rt_material, kd)},
    {"ks", COLOUR, OPTIONAL, UNIT, "", "0", NULL, AT(rt_material, ks)},
    {"kt", COLOUR, OPTIONAL, UNIT, "", "0", NULL, AT(rt_material, kt)},
    {"emission", COLOUR, OPTIONAL, LIGHT, "W/(m^2 sr)", "0", NULL, AT(rt_material, emission)},
    {"ior", NUMBER, OPTIONAL, FROM_TO(0.1, 10), "", "1.5", NULL, AT(rt_material, ior)},
    {"fresnel", CHOICE, OPTIONAL, ANY, "", "off", fresnels, AT(rt_material, fresnel)},
    {"eta", COLOUR, OPTIONAL, FROM_TO(0, 100), "", "required of a conductor", NULL,
     AT(rt_material, eta)},
    {"k", COLOUR, OPTIONAL, FROM_TO(0, 100), "", "0", NULL, AT(rt_material, k)},
    {"roughness", NUMBER, OPTIONAL, UNIT, "", "0", NULL, AT(rt_material, roughness)},
    {"absorption", COLOUR, OPTIONAL, LIGHT, "1/m", "0", NULL, AT(rt_material, absorption)},
    {"two_sided", BOOLEAN, OPTIONAL, ANY, "", "false", NULL, AT(rt_material, two_sided)},
    {"priority", INTEGER, OPTIONAL, FROM_TO(0, INTEGER_LAST), "", "0", NULL,
     AT(rt_material, priority)},
    {"kd_texture", TEXTURE, OPTIONAL, ANY, "", "none", NULL, AT(rt_material, kd_texture)},
    {"ks_texture", TEXTURE, OPTIONAL, ANY, "", "none", NULL, AT(rt_material, ks_texture)},
    {"kt_texture", TEXTURE, OPTIONAL, ANY, "", "none", NULL, AT(rt_material, kt_texture)},
    {"emission_texture", TEXTURE, OPTIONAL, ANY, "", "none", NULL,
     AT(rt_material, emission_texture)},
    {"bump_texture", TEXTURE, OPTIONAL, ANY, "", "none", NULL, AT(rt_material, bump_texture)},
    {"bump_scale", NUMBER, OPTIONAL, NOT_ZERO, "m", "1", NULL, AT(rt_material, bump_scale)},
};

static const rt_field point_light_fields[] = {
    {"position", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_point_light, position)},
    {"intensity", COLOUR, ONE_OF, LIGHT, "W/sr", "this or power is required", NULL,
     AT(rt_point_light, intensity)},
    {"power", COLOUR, ONE_OF, LIGHT, "W", "this or intensity is required", NULL,
     AT(rt_point_light, power)},
};

static const rt_field spot_light_fields[] = {
    {"position", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_spot_light, position)},
    {"target", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_spot_light, target)},
    {"intensity", COLOUR, REQUIRED, LIGHT, "W/sr", "", NULL, AT(rt_spot_light, intensity)},
    {"outer", NUMBER, OPTIONAL, HALF_TURN, "degrees", "30", NULL, AT(rt_spot_light, outer)},
    {"inner", NUMBER, OPTIONAL, FROM_TO(0, 180), "degrees", "0", NULL, AT(rt_spot_light, inner)},
};

static const rt_field directional_light_fields[] = {
    {"direction", VECTOR, REQUIRED, DIRECTION, "", "", NULL, AT(rt_directional_light, direction)},
    {"irradiance", COLOUR, REQUIRED, LIGHT, "W/m^2", "", NULL,
     AT(rt_directional_light, irradiance)},
};

static const rt_field environment_light_fields[] = {
    {"radiance", COLOUR, OPTIONAL, LIGHT, "W/(m^2 sr)", "1 with an image, else 0", NULL,
     AT(rt_environment, radiance)},
    {"file", FILE_NAME, OPTIONAL, ANY, "", "none", NULL, AT(rt_environment, path)},
    {"rotation", NUMBER, OPTIONAL, ANY, "degrees", "0", NULL, AT(rt_environment, rotation)},
};

static const rt_field plane_fields[] = {
    {"point", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_plane_fields, point)},
    {"normal", VECTOR, REQUIRED, DIRECTION, "", "", NULL, AT(rt_plane_fields, normal)},
    SURFACE(rt_plane_fields),
};

static const rt_field sphere_fields[] = {
    {"centre", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_sphere_fields, centre)},
    {"radius", NUMBER, REQUIRED, LENGTH, "m", "", NULL, AT(rt_sphere_fields, radius)},
    SURFACE(rt_sphere_fields),
    LAMP(rt_sphere_fields),
};

static const rt_field triangle_fields[] = {
    {"a", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_triangle_fields, corners[0])},
    {"b", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_triangle_fields, corners[1])},
    {"c", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_triangle_fields, corners[2])},
    {"na", VECTOR, ALL_OR_NONE, DIRECTION, "", "flat", NULL, AT(rt_triangle_fields, normals[0])},
    {"nb", VECTOR, ALL_OR_NONE, DIRECTION, "", "flat", NULL, AT(rt_triangle_fields, normals[1])},
    {"nc", VECTOR, ALL_OR_NONE, DIRECTION, "", "flat", NULL, AT(rt_triangle_fields, normals[2])},
    {"uva", PAIR, ALL_OR_NONE_TOO, ANY, "", "0 0", NULL, AT(rt_triangle_fields, uv[0])},
    {"uvb", PAIR, ALL_OR_NONE_TOO, ANY, "", "1 0", NULL, AT(rt_triangle_fields, uv[1])},
    {"uvc", PAIR, ALL_OR_NONE_TOO, ANY, "", "0 1", NULL, AT(rt_triangle_fields, uv[2])},
    SURFACE(rt_triangle_fields),
    LAMP(rt_triangle_fields),
};

static const rt_field quad_fields[] = {
    {"corner", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_quad_fields, corner)},
    {"edge1", VECTOR, REQUIRED, DIRECTION, "m", "", NULL, AT(rt_quad_fields, edge1)},
    {"edge2", VECTOR, REQUIRED, DIRECTION, "m", "", NULL, AT(rt_quad_fields, edge2)},
    SURFACE(rt_quad_fields),
    LAMP(rt_quad_fields),
};

static const rt_field disc_fields[] = {
    {"centre", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_disc_fields, centre)},
    {"normal", VECTOR, REQUIRED, DIRECTION, "", "", NULL, AT(rt_disc_fields, normal)},
    {"radius", NUMBER, REQUIRED, LENGTH, "m", "", NULL, AT(rt_disc_fields, radius)},
    {"inner_radius", NUMBER, OPTIONAL, LENGTH_OR_ZERO, "m", "0", NULL,
     AT(rt_disc_fields, inner_radius)},
    SURFACE(rt_disc_fields),
    LAMP(rt_disc_fields),
};

static const rt_field cylinder_fields[] = {
    {"a", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_cylinder_fields, a)},
    {"b", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_cylinder_fields, b)},
    {"radius", NUMBER, REQUIRED, LENGTH, "m", "", NULL, AT(rt_cylinder_fields, radius)},
    {"caps", BOOLEAN, OPTIONAL, ANY, "", "true", NULL, AT(rt_cylinder_fields, caps)},
    SURFACE(rt_cylinder_fields),
    LAMP(rt_cylinder_fields),
};

static const rt_field cone_fields[] = {
    {"base", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_cone_fields, base)},
    {"apex", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_cone_fields, apex)},
    {"radius", NUMBER, REQUIRED, LENGTH, "m", "", NULL, AT(rt_cone_fields, radius)},
    {"apex_radius", NUMBER, OPTIONAL, LENGTH_OR_ZERO, "m", "0", NULL,
     AT(rt_cone_fields, apex_radius)},
    {"caps", BOOLEAN, OPTIONAL, ANY, "", "true", NULL, AT(rt_cone_fields, caps)},
    SURFACE(rt_cone_fields),
    LAMP(rt_cone_fields),
};

static const rt_field ellipsoid_fields[] = {
    {"centre", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_ellipsoid_fields, centre)},
    {"radii", VECTOR, REQUIRED, LENGTH, "m", "", NULL, AT(rt_ellipsoid_fields, radii)},
    SURFACE(rt_ellipsoid_fields),
    LAMP(rt_ellipsoid_fields),
};

static const rt_field torus_fields[] = {
    {"centre", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_torus_fields, centre)},
    {"axis", VECTOR, REQUIRED, DIRECTION, "", "", NULL, AT(rt_torus_fields, axis)},
    {"major_radius", NUMBER, REQUIRED, LENGTH, "m", "", NULL, AT(rt_torus_fields, major_radius)},
    {"minor_radius", NUMBER, REQUIRED, LENGTH, "m", "", NULL, AT(rt_torus_fields, minor_radius)},
    SURFACE(rt_torus_fields),
    LAMP(rt_torus_fields),
};

#define MESH_FILE(type)                                                                            \
    {"file", FILE_NAME, REQUIRED, ANY, "", "", NULL, AT(type, path)},                              \
    {                                                                                              \
        "shading", CHOICE, OPTIONAL, ANY, "", "file", shadings, AT(type, shading)                  \
    }

static const rt_field mesh_fields[] = {
    MESH_FILE(rt_mesh_fields),
};

static const rt_field instance_fields[] = {
    SURFACE(rt_mesh_fields),
    LAMP(rt_mesh_fields),
};

static const rt_field model_fields[] = {
    MESH_FILE(rt_mesh_fields),
    SURFACE(rt_mesh_fields),
    LAMP(rt_mesh_fields),
};

/* ---- Blocks -------------------------------------------------------------- */

#define FIELDS(table) table, COUNT(table)

const rt_block rt_blocks[RT_BLOCK_COUNT] = {
    {RT_BLOCK_CAMERA, "camera", NULL, RT_BLOCK_ONCE, FIELDS(camera_fields)},
    {RT_BLOCK_FILM, "film", NULL, RT_BLOCK_ONCE, FIELDS(film_fields)},
    {RT_BLOCK_RENDER, "render", NULL, RT_BLOCK_ONCE, FIELDS(render_fields)},
    {RT_BLOCK_TEXTURE, "texture", NULL, RT_BLOCK_NAMED, FIELDS(texture_fields)},
    {RT_BLOCK_MATERIAL, "material", NULL, RT_BLOCK_NAMED, FIELDS(material_fields)},
    {RT_BLOCK_POINT_LIGHT, "light", "point", 0, FIELDS(point_light_fields)},
    {RT_BLOCK_SPOT_LIGHT, "light", "spot", 0, FIELDS(spot_light_fields)},
    {RT_BLOCK_DIRECTIONAL_LIGHT, "light", "directional", 0, FIELDS(directional_light_fields)},
    {RT_BLOCK_ENVIRONMENT_LIGHT, "light", "environment", RT_BLOCK_ONCE,
     FIELDS(environment_light_fields)},
    {RT_BLOCK_PLANE, "plane", NULL, 0, FIELDS(plane_fields)},
    {RT_BLOCK_SPHERE, "sphere", NULL, 0, FIELDS(sphere_fields)},
    {RT_BLOCK_TRIANGLE, "triangle", NULL, 0, FIELDS(triangle_fields)},
    {RT_BLOCK_QUAD, "quad", NULL, 0, FIELDS(quad_fields)},
    {RT_BLOCK_DISC, "disc", NULL, 0, FIELDS(disc_fields)},
    {RT_BLOCK_CYLINDER, "cylinder", NULL, 0, FIELDS(cylinder_fields)},
    {RT_BLOCK_CONE, "cone", NULL, 0, FIELDS(cone_fields)},
    {RT_BLOCK_ELLIPSOID, "ellipsoid", NULL, 0, FIELDS(ellipsoid_fields)},
    {RT_BLOCK_TORUS, "torus", NULL, 0, FIELDS(torus_fields)},
    {RT_BLOCK_MESH, "mesh", NULL, RT_BLOCK_NAMED, FIELDS(mesh_fields)},
    {RT_BLOCK_INSTANCE, "instance", NULL, RT_BLOCK_REFERS, FIELDS(instance_fields)},
    {RT_BLOCK_MODEL, "model", NULL, 0, FIELDS(model_fields)},
};
