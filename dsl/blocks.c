/* blocks.c - the tables of the language: every block and every field. */
#include "dsl/schema.h"

#define COUNT(array) (sizeof(array) / sizeof(array)[0])
#define AT(type, member) offsetof(type, member), sizeof(((type *)0)->member)

/* ---- Ranges, choices ----------------------------------------------------- */

#define ANY                                                                                        \
    {                                                                                              \
        RT_RANGE_ANY, 0, 0                                                                         \
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
#define HALF_TURN FROM_TO(1e-3, 180)
#define DIRECTION                                                                                  \
    {                                                                                              \
        RT_RANGE_DIRECTION, 0, 0                                                                   \
    }
#define NOT_ZERO                                                                                   \
    {                                                                                              \
        RT_RANGE_NOT_ZERO, 0, 0                                                                    \
    }

#define INTEGER_LAST 2147483647.0

static const rt_word projections[] = {RT_CAMERA_KINDS(RT_WORD) RT_WORD_END};
static const rt_word patterns[] = {RT_TEXTURE_KINDS(RT_WORD) RT_WORD_END};
static const rt_word wraps[] = {RT_WRAPS(RT_WORD) RT_WORD_END};
static const rt_word fresnels[] = {RT_FRESNELS(RT_WORD) RT_WORD_END};
static const rt_word shadings[] = {RT_SHADINGS(RT_WORD) RT_WORD_END};

/* ---- Fields -------------------------------------------------------------- */

/* Shorthands for the rows: type and need. */
#define NUMBER RT_FIELD_NUMBER
#define INTEGER RT_FIELD_INTEGER
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

/* A row inside a macro. */
#define ROW(...)                                                                                   \
    {                                                                                              \
        __VA_ARGS__                                                                                \
    }

/* What every shape has, and what every finite shape has besides. */
#define SURFACE_BUT_TEXTURE(type)                                                                  \
    ROW("material", RT_FIELD_MATERIAL, REQUIRED, ANY, "", "", NULL, AT(type, surface.material),    \
        "what it is made of"),                                                                     \
        ROW("translate", RT_FIELD_TRANSLATE, OPTIONAL, ANY, "m", "none", NULL,                     \
            AT(type, surface.transform), "moves it; see [Transforms](#transforms)"),               \
        ROW("rotate", RT_FIELD_ROTATE, OPTIONAL, DIRECTION, "degrees", "none", NULL,               \
            AT(type, surface.transform),                                                           \
            "turns it about an axis through the origin (three numbers) by an angle, "              \
            "counter-clockwise seen against the axis"),                                            \
        ROW("scale", RT_FIELD_SCALE, OPTIONAL, NOT_ZERO, "", "none", NULL,                         \
            AT(type, surface.transform), "scales it about the origin, alike or by x, y and z"),    \
        ROW("matrix", RT_FIELD_MATRIX, OPTIONAL, ANY, "", "none", NULL,                            \
            AT(type, surface.transform),                                                           \
            "any affine map: three rows of four, the last column the translation")
#define SURFACE_TEXTURE(type, help)                                                                \
    ROW("texture", TEXTURE, OPTIONAL, ANY, "", "none", NULL, AT(type, surface.texture), help)
#define SURFACE(type)                                                                              \
    SURFACE_TEXTURE(type, "multiplies kd of the material, or `radiance` or `power` where the "     \
                          "shape has one of its own"),                                             \
        SURFACE_BUT_TEXTURE(type)
#define EMISSION(type)                                                                             \
    ROW("radiance", COLOUR, AT_MOST_ONE, LIGHT, "W/(m^2 sr)", "that of the material", NULL,        \
        AT(type, surface.radiance),                                                                \
        "makes it an area light: emitted radiance, instead of the material's emission"),           \
        ROW("power", COLOUR, AT_MOST_ONE, LIGHT, "W", "none", NULL, AT(type, surface.power),       \
            "makes it an area light: emitted flux of the whole shape; not together with "          \
            "`radiance`")

static const rt_field camera_fields[] = {
    {"projection", CHOICE, OPTIONAL, ANY, "", "perspective", projections, AT(rt_camera, kind),
     "perspective: all rays pass the eye; orthographic: all are parallel, nothing gets smaller "
     "with distance; environment: all directions, longitude across and latitude down, look_at in "
     "the middle"},
    {"eye", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_camera, eye), "where the camera stands"},
    {"look_at", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_camera, look_at),
     "the point in the middle of the picture"},
    {"up", VECTOR, OPTIONAL, DIRECTION, "", "0 1 0", NULL, AT(rt_camera, up),
     "the direction that points up in the picture; not along the view"},
    {"fov", NUMBER, OPTIONAL, BETWEEN(0, 180), "degrees", "45", NULL, AT(rt_camera, fov),
     "of a perspective camera: full horizontal angle of view"},
    {"width", NUMBER, OPTIONAL, LENGTH, "m", "2", NULL, AT(rt_camera, width),
     "of what an orthographic camera sees, from left to right"},
    {"aperture", NUMBER, OPTIONAL, LENGTH_OR_ZERO, "m", "0", NULL, AT(rt_camera, aperture),
     "radius of the lens; 0 is a pinhole, where all is sharp"},
    {"focal_distance", NUMBER, OPTIONAL, LENGTH, "m", "that of look_at", NULL,
     AT(rt_camera, focal_distance), "distance along the view to the plane in focus"},
    {"blades", INTEGER, OPTIONAL, FROM_TO(3, 64), "", "round", NULL, AT(rt_camera, blades),
     "edges of the lens opening, seen in what is out of focus: 3 to 64; left out, it is round"},
    {"blade_rotation", NUMBER, OPTIONAL, ANY, "degrees", "0", NULL, AT(rt_camera, blade_rotation),
     "turns that opening, counter-clockwise in the picture; at 0 a corner points to the right"},
};

static const rt_field texture_fields[] = {
    {"pattern", CHOICE, OPTIONAL, ANY, "", "image", patterns, AT(rt_texture, kind),
     "where the colours come from: an image file, squares of a and b with sides of 1 in u and v, "
     "or a change from a at v = 0 to b at v = 1"},
    {"file", FILE_NAME, OPTIONAL, ANY, "", "required of an image", NULL, AT(rt_texture, path),
     "a .png, .ppm, .pgm, .exr or .pfm"},
    {"linear", BOOLEAN, OPTIONAL, ANY, "", "false", NULL, AT(rt_texture, linear),
     "of an image: true: the numbers of the file are light, or heights; false: 8 and 16 bit files "
     "hold sRGB, as pictures do"},
    {"a", COLOUR, OPTIONAL, LIGHT, "", "0", NULL, AT(rt_texture, a),
     "of a checker: the first square; of a gradient: below"},
    {"b", COLOUR, OPTIONAL, LIGHT, "", "0", NULL, AT(rt_texture, b),
     "of a checker: the other square; of a gradient: above"},
    {"wrap", CHOICE, OPTIONAL, ANY, "", "repeat", wraps, AT(rt_texture, wrap),
     "beyond 0 to 1, an image or gradient is repeated, mirrored, or goes on as at its edge"},
    {"scale", PAIR, OPTIONAL, NOT_ZERO, "", "1 1", NULL, AT(rt_texture, scale),
     "u and v are multiplied by this: 4 4 shows the texture four times each way"},
    {"offset", PAIR, OPTIONAL, ANY, "", "0 0", NULL, AT(rt_texture, offset),
     "and then moved by this"},
};

static const rt_field material_fields[] = {
    {"kd", COLOUR, OPTIONAL, UNIT, "", "0", NULL, AT(rt_material, kd), "diffuse albedo"},
    {"ks", COLOUR, OPTIONAL, UNIT, "", "0", NULL, AT(rt_material, ks),
     "specular reflectance: a mirror, or, with roughness, a glossy lobe"},
    {"kt", COLOUR, OPTIONAL, UNIT, "", "0", NULL, AT(rt_material, kt),
     "specular transmittance: refraction"},
    {"emission", COLOUR, OPTIONAL, LIGHT, "W/(m^2 sr)", "0", NULL, AT(rt_material, emission),
     "emitted radiance; leaves the side of the normal"},
    {"ior", NUMBER, OPTIONAL, FROM_TO(0.1, 10), "", "1.5", NULL, AT(rt_material, ior),
     "index of refraction of the inside"},
    {"fresnel", CHOICE, OPTIONAL, ANY, "", "off", fresnels, AT(rt_material, fresnel),
     "off: ks and kt are used as given; dielectric: ks + kt is split between reflection and "
     "refraction by the Fresnel equations for ior; conductor: ks is multiplied by the reflectance "
     "of a metal of index eta + i k"},
    {"eta", COLOUR, OPTIONAL, FROM_TO(0, 100), "", "required of a conductor", NULL,
     AT(rt_material, eta), "of a conductor: index of refraction, by channel"},
    {"k", COLOUR, OPTIONAL, FROM_TO(0, 100), "", "0", NULL, AT(rt_material, k),
     "of a conductor: extinction, by channel"},
    {"roughness", NUMBER, OPTIONAL, UNIT, "", "0", NULL, AT(rt_material, roughness),
     "of ks and kt: alpha of the GGX distribution of microfacets; below 0.001 is smooth. Light "
     "that meets two facets is lost: of a white metal 3 % at 0.1, 8 % at 0.2, 30 % at 0.5"},
    {"absorption", COLOUR, OPTIONAL, LIGHT, "1/m", "0", NULL, AT(rt_material, absorption),
     "of the inside, by channel: light is weakened to exp(-absorption) a metre; colours thick "
     "glass"},
    {"two_sided", BOOLEAN, OPTIONAL, ANY, "", "false", NULL, AT(rt_material, two_sided),
     "true: emission leaves both sides"},
    {"priority", INTEGER, OPTIONAL, FROM_TO(0, INTEGER_LAST), "", "0", NULL,
     AT(rt_material, priority),
     "where solids overlap, the material of higher priority fills the overlap"},
    {"kd_texture", TEXTURE, OPTIONAL, ANY, "", "none", NULL, AT(rt_material, kd_texture),
     "multiplies kd; where kd is left out, stands for it"},
    {"ks_texture", TEXTURE, OPTIONAL, ANY, "", "none", NULL, AT(rt_material, ks_texture),
     "the same for ks"},
    {"kt_texture", TEXTURE, OPTIONAL, ANY, "", "none", NULL, AT(rt_material, kt_texture),
     "the same for kt"},
    {"emission_texture", TEXTURE, OPTIONAL, ANY, "", "none", NULL,
     AT(rt_material, emission_texture), "the same for emission"},
    {"bump_texture", TEXTURE, OPTIONAL, ANY, "", "none", NULL, AT(rt_material, bump_texture),
     "its brightness is a height that bends the shading normal"},
    {"bump_scale", NUMBER, OPTIONAL, NOT_ZERO, "m", "1", NULL, AT(rt_material, bump_scale),
     "height of a brightness of 1"},
};

static const rt_field point_light_fields[] = {
    {"position", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_point_light, position), "where it is"},
    {"intensity", COLOUR, ONE_OF, LIGHT, "W/sr", "this or power is required", NULL,
     AT(rt_point_light, intensity), "radiant intensity, the same in every direction"},
    {"power", COLOUR, ONE_OF, LIGHT, "W", "this or intensity is required", NULL,
     AT(rt_point_light, power), "emitted flux; 4 pi times the intensity"},
};

static const rt_field spot_light_fields[] = {
    {"position", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_spot_light, position), "where it is"},
    {"target", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_spot_light, target),
     "a point on its axis"},
    {"intensity", COLOUR, REQUIRED, LIGHT, "W/sr", "", NULL, AT(rt_spot_light, intensity),
     "radiant intensity on the axis"},
    {"outer", NUMBER, OPTIONAL, HALF_TURN, "degrees", "30", NULL, AT(rt_spot_light, outer),
     "angle from the axis at which the light ends"},
    {"inner", NUMBER, OPTIONAL, FROM_TO(0, 180), "degrees", "0", NULL, AT(rt_spot_light, inner),
     "angle up to which it is at its full; at most outer; between the two it falls smoothly"},
};

static const rt_field directional_light_fields[] = {
    {"direction", VECTOR, REQUIRED, DIRECTION, "", "", NULL, AT(rt_directional_light, direction),
     "in which the light travels; of any length"},
    {"irradiance", COLOUR, REQUIRED, LIGHT, "W/m^2", "", NULL, AT(rt_directional_light, irradiance),
     "on a surface that faces the light"},
};

static const rt_field environment_light_fields[] = {
    {"radiance", COLOUR, OPTIONAL, LIGHT, "W/(m^2 sr)", "1 with an image, else 0", NULL,
     AT(rt_environment, radiance), "seen in every direction; multiplies the image"},
    {"file", FILE_NAME, OPTIONAL, ANY, "", "none", NULL, AT(rt_environment, path),
     "an image of latitude and longitude: .exr, .pfm, .png or .ppm; its middle column is seen "
     "towards -z, its top row is +y"},
    {"rotation", NUMBER, OPTIONAL, ANY, "degrees", "0", NULL, AT(rt_environment, rotation),
     "turns the image about y, to the left as seen from inside"},
};

static const rt_field plane_fields[] = {
    {"point", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_plane_fields, point),
     "any point of the plane"},
    {"normal", VECTOR, REQUIRED, DIRECTION, "", "", NULL, AT(rt_plane_fields, normal),
     "perpendicular to the plane; of any length"},
    SURFACE(rt_plane_fields),
};

static const rt_field sphere_fields[] = {
    {"centre", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_sphere_fields, centre), "the middle"},
    {"radius", NUMBER, REQUIRED, LENGTH, "m", "", NULL, AT(rt_sphere_fields, radius),
     "of the sphere"},
    SURFACE(rt_sphere_fields),
    EMISSION(rt_sphere_fields),
};

static const rt_field triangle_fields[] = {
    {"a", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_triangle_fields, corners[0]), "first corner"},
    {"b", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_triangle_fields, corners[1]),
     "second corner"},
    {"c", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_triangle_fields, corners[2]),
     "third corner; counter-clockwise seen from the side of the normal"},
    {"na", VECTOR, ALL_OR_NONE, DIRECTION, "", "flat", NULL, AT(rt_triangle_fields, normals[0]),
     "shading normal at a, of any length; give all three or none"},
    {"nb", VECTOR, ALL_OR_NONE, DIRECTION, "", "flat", NULL, AT(rt_triangle_fields, normals[1]),
     "shading normal at b"},
    {"nc", VECTOR, ALL_OR_NONE, DIRECTION, "", "flat", NULL, AT(rt_triangle_fields, normals[2]),
     "shading normal at c"},
    {"uva", PAIR, ALL_OR_NONE_TOO, ANY, "", "0 0", NULL, AT(rt_triangle_fields, uv[0]),
     "texture coordinates at a; give all three or none"},
    {"uvb", PAIR, ALL_OR_NONE_TOO, ANY, "", "1 0", NULL, AT(rt_triangle_fields, uv[1]),
     "texture coordinates at b"},
    {"uvc", PAIR, ALL_OR_NONE_TOO, ANY, "", "0 1", NULL, AT(rt_triangle_fields, uv[2]),
     "texture coordinates at c"},
    SURFACE(rt_triangle_fields),
    EMISSION(rt_triangle_fields),
};

static const rt_field quad_fields[] = {
    {"corner", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_quad_fields, corner), "one corner"},
    {"edge1", VECTOR, REQUIRED, DIRECTION, "m", "", NULL, AT(rt_quad_fields, edge1),
     "from it to the next corner"},
    {"edge2", VECTOR, REQUIRED, DIRECTION, "m", "", NULL, AT(rt_quad_fields, edge2),
     "from it to the other neighbour; the normal is edge1 x edge2 (right hand: thumb edge1, "
     "forefinger edge2, middle finger the normal)"},
    SURFACE(rt_quad_fields),
    EMISSION(rt_quad_fields),
};

static const rt_field disc_fields[] = {
    {"centre", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_disc_fields, centre), "the middle"},
    {"normal", VECTOR, REQUIRED, DIRECTION, "", "", NULL, AT(rt_disc_fields, normal),
     "perpendicular to the disc, on the side that shines; of any length"},
    {"radius", NUMBER, REQUIRED, LENGTH, "m", "", NULL, AT(rt_disc_fields, radius),
     "of the outer rim"},
    {"inner_radius", NUMBER, OPTIONAL, LENGTH_OR_ZERO, "m", "0", NULL,
     AT(rt_disc_fields, inner_radius), "of the hole; less than radius"},
    SURFACE(rt_disc_fields),
    EMISSION(rt_disc_fields),
};

static const rt_field cylinder_fields[] = {
    {"a", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_cylinder_fields, a), "middle of one end"},
    {"b", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_cylinder_fields, b),
     "middle of the other end"},
    {"radius", NUMBER, REQUIRED, LENGTH, "m", "", NULL, AT(rt_cylinder_fields, radius),
     "of the cylinder"},
    {"caps", BOOLEAN, OPTIONAL, ANY, "", "true", NULL, AT(rt_cylinder_fields, caps),
     "true: closed by discs at both ends; false: an open tube"},
    SURFACE(rt_cylinder_fields),
    EMISSION(rt_cylinder_fields),
};

static const rt_field cone_fields[] = {
    {"base", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_cone_fields, base),
     "middle of the wide end"},
    {"apex", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_cone_fields, apex),
     "the tip, or middle of the narrow end"},
    {"radius", NUMBER, REQUIRED, LENGTH, "m", "", NULL, AT(rt_cone_fields, radius), "at the base"},
    {"apex_radius", NUMBER, OPTIONAL, LENGTH_OR_ZERO, "m", "0", NULL,
     AT(rt_cone_fields, apex_radius), "at the apex: more than 0 makes a frustum; at most radius"},
    {"caps", BOOLEAN, OPTIONAL, ANY, "", "true", NULL, AT(rt_cone_fields, caps),
     "true: closed by discs; false: open"},
    SURFACE(rt_cone_fields),
    EMISSION(rt_cone_fields),
};

static const rt_field ellipsoid_fields[] = {
    {"centre", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_ellipsoid_fields, centre), "the middle"},
    {"radii", VECTOR, REQUIRED, LENGTH, "m", "", NULL, AT(rt_ellipsoid_fields, radii),
     "half-axes along x, y and z; rotate turns them"},
    SURFACE(rt_ellipsoid_fields),
    EMISSION(rt_ellipsoid_fields),
};

static const rt_field torus_fields[] = {
    {"centre", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_torus_fields, centre),
     "the middle of the hole"},
    {"axis", VECTOR, REQUIRED, DIRECTION, "", "", NULL, AT(rt_torus_fields, axis),
     "perpendicular to the ring; of any length"},
    {"major_radius", NUMBER, REQUIRED, LENGTH, "m", "", NULL, AT(rt_torus_fields, major_radius),
     "from the centre to the middle of the tube"},
    {"minor_radius", NUMBER, REQUIRED, LENGTH, "m", "", NULL, AT(rt_torus_fields, minor_radius),
     "of the tube; less than major_radius"},
    SURFACE(rt_torus_fields),
    EMISSION(rt_torus_fields),
};

#define MESH_FILE(type)                                                                            \
    ROW("file", FILE_NAME, REQUIRED, ANY, "", "", NULL, AT(type, path),                            \
        "a .ply, .obj, .off or .stl; told apart by content"),                                      \
        ROW("shading", CHOICE, OPTIONAL, ANY, "", "file", shadings, AT(type, shading),             \
            "where shading normals come from")
#define MESH_SURFACE(type)                                                                         \
    SURFACE_TEXTURE(type,                                                                          \
                    "multiplies kd; left out, the texture that the mesh file names, if any"),      \
        SURFACE_BUT_TEXTURE(type)

static const rt_field mesh_fields[] = {
    MESH_FILE(rt_mesh_fields),
};

static const rt_field instance_fields[] = {
    MESH_SURFACE(rt_mesh_fields),
    EMISSION(rt_mesh_fields),
};

static const rt_field model_fields[] = {
    MESH_FILE(rt_mesh_fields),
    MESH_SURFACE(rt_mesh_fields),
    EMISSION(rt_mesh_fields),
};

/* ---- Blocks -------------------------------------------------------------- */

#define FIELDS(table) table, COUNT(table)

const rt_block rt_blocks[RT_BLOCK_COUNT] = {
    {RT_BLOCK_CAMERA, "camera", NULL, RT_BLOCK_ONCE, FIELDS(camera_fields)},
    {RT_BLOCK_FILM, "film", NULL, RT_BLOCK_ONCE, NULL, 0},
    {RT_BLOCK_RENDER, "render", NULL, RT_BLOCK_ONCE, NULL, 0},
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
