#include "dsl/schema.h"

#include <stdio.h>
#include <string.h>

#define COUNT(array) (sizeof(array) / sizeof(array)[0])
#define AT(type, member) offsetof(type, member), sizeof(((type *)0)->member)

/* ---- Ranges, choices ----------------------------------------------------- */

#define ANY {RT_RANGE_ANY, 0, 0}
#define ABOVE_TO(low, high) {RT_RANGE_ABOVE, low, high}
#define FROM_TO(low, high) {RT_RANGE_CLOSED, low, high}
#define BETWEEN(low, high) {RT_RANGE_BETWEEN, low, high}
#define UNIT FROM_TO(0, 1)
#define LENGTH FROM_TO(1e-15, 1e15)
#define LIGHT FROM_TO(0, 1e28)
#define DIRECTION {RT_RANGE_DIRECTION, 0, 0}

#define UINT32_LAST 4294967295.0
#define INTEGER_LAST 2147483647.0

/* The order of each list is that of its enum in rt.h or common.h. */
static const char *const modes[] = {"path", "photon", NULL};
static const char *const samplers[] = {"sobol", "independent", NULL};
static const char *const gathers[] = {"auto", "flann", "device", NULL};
static const char *const areas[] = {"disc", "hull", NULL};
static const char *const directs[] = {"nee", "photons", NULL};
static const char *const kernels[] = {"epanechnikov", "box", "cone", "gaussian", "silverman", "gaussian_jensen", NULL};

/* ---- Fields -------------------------------------------------------------- */

/* Shorthands for the rows: type and need. */
#define NUMBER RT_FIELD_NUMBER
#define INTEGER RT_FIELD_INTEGER
#define VECTOR RT_FIELD_VECTOR
#define COLOUR RT_FIELD_COLOUR
#define BOOLEAN RT_FIELD_BOOLEAN
#define CHOICE RT_FIELD_CHOICE
#define OPTIONAL RT_NEED_OPTIONAL
#define REQUIRED RT_NEED_REQUIRED
#define ONE_OF RT_NEED_ONE_OF
#define AT_MOST_ONE RT_NEED_AT_MOST_ONE
#define ALL_OR_NONE RT_NEED_ALL_OR_NONE

/* What every shape has, and what every finite shape has besides. */
#define SURFACE(type) {"material", RT_FIELD_MATERIAL, REQUIRED, ANY, "", "", NULL, AT(type, surface.material)}
#define LAMP(type)                                                                                                     \
    {"radiance", COLOUR, AT_MOST_ONE, LIGHT, "W/(m^2 sr)", "that of the material", NULL,                        \
     AT(type, surface.radiance)},                                                                                      \
    {"power", COLOUR, AT_MOST_ONE, LIGHT, "W", "none", NULL, AT(type, surface.power)}

static const rt_field camera_fields[] = {
    {"eye", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_camera, eye)},
    {"look_at", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_camera, look_at)},
    {"up", VECTOR, OPTIONAL, DIRECTION, "", "0 1 0", NULL, AT(rt_camera, up)},
    {"fov", NUMBER, OPTIONAL, BETWEEN(0, 180), "degrees", "45", NULL, AT(rt_camera, fov)},
    {"aperture", NUMBER, OPTIONAL, FROM_TO(0, 1e15), "m", "0", NULL, AT(rt_camera, aperture)},
    {"focal_distance", NUMBER, OPTIONAL, LENGTH, "m", "that of look_at", NULL, AT(rt_camera, focal_distance)},
};

static const rt_field film_fields[] = {
    {"width", INTEGER, OPTIONAL, FROM_TO(1, 65536), "pixels", "512", NULL, AT(rt_render_options, width)},
    {"height", INTEGER, OPTIONAL, FROM_TO(1, 65536), "pixels", "512", NULL, AT(rt_render_options, height)},
};

static const rt_field render_fields[] = {
    {"mode", CHOICE, OPTIONAL, ANY, "", "path", modes, AT(rt_render_options, mode)},
    {"spp", INTEGER, OPTIONAL, FROM_TO(1, 16777216), "", "64, in mode photon 16, in passes 1", NULL,
     AT(rt_render_options, spp)},
    {"max_depth", INTEGER, OPTIONAL, FROM_TO(1, 4096), "segments", "16", NULL,
     AT(rt_render_options, max_depth)},
    {"seed", INTEGER, OPTIONAL, FROM_TO(0, UINT32_LAST), "", "0", NULL, AT(rt_render_options, seed)},
    {"sampler", CHOICE, OPTIONAL, ANY, "", "sobol", samplers, AT(rt_render_options, sampler)},
    {"time", NUMBER, OPTIONAL, ABOVE_TO(0, 1e9), "s", "no limit", NULL, AT(rt_render_options, time)},
    {"photons", INTEGER, OPTIONAL, FROM_TO(1, 4e9), "", "1000000, in passes one a pixel", NULL,
     AT(rt_render_options, photons)},
    {"k", INTEGER, OPTIONAL, FROM_TO(2, 65536), "", "50", NULL, AT(rt_render_options, k)},
    {"radius", NUMBER, OPTIONAL, LENGTH, "m", "no limit", NULL, AT(rt_render_options, radius)},
    {"gather", CHOICE, OPTIONAL, ANY, "", "auto", gathers, AT(rt_render_options, gather)},
    {"passes", INTEGER, OPTIONAL, FROM_TO(1, 16777216), "", "1", NULL, AT(rt_render_options, passes)},
    {"alpha", NUMBER, OPTIONAL, BETWEEN(0, 1), "", "2/3", NULL, AT(rt_render_options, alpha)},
    {"kernel", CHOICE, OPTIONAL, ANY, "", "epanechnikov", kernels, AT(rt_render_options, kernel)},
    {"cone_k", NUMBER, OPTIONAL, FROM_TO(1, 1e6), "", "1.1", NULL, AT(rt_render_options, cone_k)},
    {"area", CHOICE, OPTIONAL, ANY, "", "disc", areas, AT(rt_render_options, area)},
    {"direct", CHOICE, OPTIONAL, ANY, "", "nee", directs, AT(rt_render_options, direct)},
    {"final_gather", INTEGER, OPTIONAL, FROM_TO(0, 4096), "bounces", "0", NULL,
     AT(rt_render_options, final_gather)},
    {"caustic_photons", INTEGER, OPTIONAL, FROM_TO(0, 4e9), "", "0", NULL, AT(rt_render_options, caustic_photons)},
    {"caustic_k", INTEGER, OPTIONAL, FROM_TO(2, 65536), "", "that of k", NULL, AT(rt_render_options, caustic_k)},
    {"caustic_radius", NUMBER, OPTIONAL, LENGTH, "m", "that of radius", NULL, AT(rt_render_options, caustic_radius)},
    {"caustic_kernel", CHOICE, OPTIONAL, ANY, "", "epanechnikov", kernels, AT(rt_render_options, caustic_kernel)},
};

static const rt_field material_fields[] = {
    {"kd", COLOUR, OPTIONAL, UNIT, "", "0", NULL, AT(rt_material, kd)},
    {"ks", COLOUR, OPTIONAL, UNIT, "", "0", NULL, AT(rt_material, ks)},
    {"kt", COLOUR, OPTIONAL, UNIT, "", "0", NULL, AT(rt_material, kt)},
    {"emission", COLOUR, OPTIONAL, LIGHT, "W/(m^2 sr)", "0", NULL, AT(rt_material, emission)},
    {"ior", NUMBER, OPTIONAL, FROM_TO(0.1, 10), "", "1.5", NULL, AT(rt_material, ior)},
    {"fresnel", BOOLEAN, OPTIONAL, ANY, "", "false", NULL, AT(rt_material, fresnel)},
    {"two_sided", BOOLEAN, OPTIONAL, ANY, "", "false", NULL, AT(rt_material, two_sided)},
    {"priority", INTEGER, OPTIONAL, FROM_TO(0, INTEGER_LAST), "", "0", NULL, AT(rt_material, priority)},
};

static const rt_field point_light_fields[] = {
    {"position", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_point_light, position)},
    {"intensity", COLOUR, ONE_OF, LIGHT, "W/sr", "this or power is required", NULL,
     AT(rt_point_light, intensity)},
    {"power", COLOUR, ONE_OF, LIGHT, "W", "this or intensity is required", NULL,
     AT(rt_point_light, power)},
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

/* ---- Blocks -------------------------------------------------------------- */

#define FIELDS(table) table, COUNT(table)

const rt_block rt_blocks[RT_BLOCK_COUNT] = {
    {RT_BLOCK_CAMERA, "camera", NULL, RT_BLOCK_ONCE, FIELDS(camera_fields)},
    {RT_BLOCK_FILM, "film", NULL, RT_BLOCK_ONCE, FIELDS(film_fields)},
    {RT_BLOCK_RENDER, "render", NULL, RT_BLOCK_ONCE, FIELDS(render_fields)},
    {RT_BLOCK_MATERIAL, "material", NULL, RT_BLOCK_NAMED, FIELDS(material_fields)},
    {RT_BLOCK_POINT_LIGHT, "light", "point", 0, FIELDS(point_light_fields)},
    {RT_BLOCK_PLANE, "plane", NULL, 0, FIELDS(plane_fields)},
    {RT_BLOCK_SPHERE, "sphere", NULL, 0, FIELDS(sphere_fields)},
    {RT_BLOCK_TRIANGLE, "triangle", NULL, 0, FIELDS(triangle_fields)},
    {RT_BLOCK_QUAD, "quad", NULL, 0, FIELDS(quad_fields)},
};

/* ---- Lookups and phrases ------------------------------------------------- */

const rt_block *rt_schema_find(rt_text word, const rt_text *kind)
{
    for (size_t i = 0; i < RT_BLOCK_COUNT; i++) {
        const rt_block *block = &rt_blocks[i];
        if (rt_text_equal(word, block->word) && !block->kind == !kind && (!kind || rt_text_equal(*kind, block->kind)))
            return block;
    }
    return NULL;
}

int rt_schema_is_block(rt_text word)
{
    for (size_t i = 0; i < RT_BLOCK_COUNT; i++)
        if (rt_text_equal(word, rt_blocks[i].word))
            return 1;
    return 0;
}

int rt_schema_has_kinds(rt_text word)
{
    for (size_t i = 0; i < RT_BLOCK_COUNT; i++)
        if (rt_blocks[i].kind && rt_text_equal(word, rt_blocks[i].word))
            return 1;
    return 0;
}

const rt_field *rt_schema_field(const rt_block *block, rt_text name)
{
    for (size_t i = 0; i < block->field_count; i++)
        if (rt_text_equal(name, block->fields[i].name))
            return &block->fields[i];
    return NULL;
}

const char *rt_block_title(char out[RT_BLOCK_TITLE_SIZE], const rt_block *block)
{
    snprintf(out, RT_BLOCK_TITLE_SIZE, "%s%s%s", block->word, block->kind ? " " : "", block->kind ? block->kind : "");
    return out;
}

/* "a, b or c" */
static void join_choices(char out[RT_PHRASE_SIZE], const char *const *choices)
{
    size_t used = 0;
    out[0] = '\0';
    for (size_t i = 0; choices[i] && used < RT_PHRASE_SIZE; i++) {
        const char *before = i == 0 ? "" : choices[i + 1] ? ", " : " or ";
        used += (size_t)snprintf(out + used, RT_PHRASE_SIZE - used, "%s%s", before, choices[i]);
    }
}

const char *rt_field_phrase(char out[RT_PHRASE_SIZE], const rt_field *field)
{
    static const char *const phrases[] = {
        [RT_FIELD_NUMBER] = "a number",
        [RT_FIELD_INTEGER] = "a whole number",
        [RT_FIELD_VECTOR] = "three numbers",
        [RT_FIELD_COLOUR] = "one or three numbers",
        [RT_FIELD_BOOLEAN] = "true or false",
        [RT_FIELD_CHOICE] = "",
        [RT_FIELD_MATERIAL] = "the name of a material",
    };
    if (field->type == RT_FIELD_CHOICE)
        join_choices(out, field->choices);
    else
        snprintf(out, RT_PHRASE_SIZE, "%s", phrases[field->type]);
    return out;
}

const char *rt_range_phrase(char out[RT_PHRASE_SIZE], rt_range range)
{
    switch (range.kind) {
    case RT_RANGE_ANY:
        out[0] = '\0';
        break;
    case RT_RANGE_ABOVE:
        snprintf(out, RT_PHRASE_SIZE, "greater than %.10g, at most %.10g", range.low, range.high);
        break;
    case RT_RANGE_CLOSED:
        snprintf(out, RT_PHRASE_SIZE, "from %.10g to %.10g", range.low, range.high);
        break;
    case RT_RANGE_BETWEEN:
        snprintf(out, RT_PHRASE_SIZE, "between %.10g and %.10g, both excluded", range.low, range.high);
        break;
    case RT_RANGE_DIRECTION:
        snprintf(out, RT_PHRASE_SIZE, "not zero");
        break;
    }
    return out;
}

int rt_range_holds(rt_range range, double value)
{
    switch (range.kind) {
    case RT_RANGE_ABOVE:
        return value > range.low && value <= range.high;
    case RT_RANGE_CLOSED:
        return value >= range.low && value <= range.high;
    case RT_RANGE_BETWEEN:
        return value > range.low && value < range.high;
    case RT_RANGE_ANY:
    case RT_RANGE_DIRECTION: /* concerns the vector as a whole */
        break;
    }
    return 1;
}
