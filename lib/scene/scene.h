/* scene.h - what a scene holds before it goes to a device. */
#ifndef RT_LIB_SCENE_SCENE_H
#define RT_LIB_SCENE_SCENE_H

#include "base/bytes.h"
#include "mesh/attributes.h"
#include "rt.h"
#include "scene/transform.h"
#include "shape/shapes.h"
#include "types.h"

#define RT_ATTRIBUTES_MOST 64     /* that the textures of a scene may name */
#define RT_ATTRIBUTE_MOST 1.0001f /* rounding may take what is shown so far above 1 */

/* A bit for each attribute that a texture has as its coordinates, or as its colour. */
typedef struct rt_attribute_use {
    uint64_t coordinates, shown;
} rt_attribute_use;

/* A texture, and the bounds of its colours that energy is checked with. */
typedef struct rt_scene_texture {
    rt_texture_data data;
    float mean[3], largest[3];
    float least; /* of all channels; 0 where none is negative */
    /* the part of an image's texels, without black ones, that may be normals; of others 1 */
    float normals;
    uint32_t least_at[2]; /* column and row of the image, from the top left, where one is */
    int is_srgb;          /* an image of codes that are decoded from sRGB, or has one inside */
    int is_turned;        /* its map has a rotation, or that of a texture inside */
    char *path;           /* of the image, for messages; NULL: a pattern */
    char *name;           /* for messages, or NULL */
    rt_u32 parts[3];      /* handles of the textures inside: of a, of b, of the weight; 0: none */
    rt_u32 least_of;      /* of an image inside that has a negative value; 0: none */
    int levels;           /* of textures in each other; 1: none inside */
    rt_attribute_use use; /* by it and all inside */
} rt_scene_texture;

/* A density or an albedo on a grid; owns its values. */
typedef struct rt_scene_grid {
    float *values;  /* [size[2]][size[1]][size[0]][size[3]], finite, none negative */
    rt_u32 size[4]; /* voxels, and channels: 1 or 3 */
    int repeats;
    float largest;
    float outside;       /* what continues beyond the box, where the file says so */
    double diagonal;     /* of the box, m */
    rt_affine to_voxels; /* from the world */
} rt_scene_grid;

/* A mesh in a space of its own; owns its arrays. */
typedef struct rt_scene_mesh {
    float *positions;     /* [vertex_count][3] */
    double origin[3];     /* of that space, where the file has it; 0 unless that is far away */
    float *normals;       /* [vertex_count][3], or NULL */
    float *uv;            /* [vertex_count][2], or NULL */
    int has_bare_corners; /* some of the file have none, and 0 0 for them; not told of parts */
    float *colours;       /* [vertex_count][3], or NULL */
    rt_attributes of_vertices, of_triangles;
    uint32_t *indices; /* [triangle_count][3] */
    size_t vertex_count, triangle_count;
    double area;
    double finest; /* the shortest of the longest edges of its triangles; INFINITY: none has any */
    float lo[3], hi[3];
    size_t placed;  /* shapes that place it and do not emit */
    rt_u32 texture; /* of a part of a file with several; see rt_scene_add_parts */
    rt_u32 next;    /* the next part of the same file; RT_NONE: no more */
} rt_scene_mesh;

/*
 * One shape as it was added. A scene may hold very many, so what most of them lack stands in tables
 * of its own.
 */
typedef struct rt_scene_shape {
    uint8_t kind; /* RT_SHAPE_*; a placed mesh is RT_SHAPE_TRIANGLES, instance or not */
    uint8_t caps, has_transform;
    rt_u32 mesh;              /* triangles: which */
    rt_u32 material, texture; /* as in rt_surface */
    rt_u32 emission;          /* which of the emissions; RT_NONE: it does not emit */
    rt_u32 placement;         /* which of the placements; RT_NONE: see rt_scene_to_world */
    float p[4];               /* the first parameters, see rt_scene_parameters */
    float lo[3], hi[3];       /* bounds, world space; not of a plane */
} rt_scene_shape;

/* What an emissive shape has besides. */
typedef struct rt_scene_emission {
    float radiance[3], power[3]; /* as in rt_surface */
    /*
     * of all, world space, m^2; infinite for a plane; of a placed mesh only where its power is
     * given
     */
    double area;
} rt_scene_emission;

/* Where a shape is, unless its parameters say all. */
typedef struct rt_scene_placement {
    rt_affine to_world; /* of the shape's own space, or of the mesh's */
    float p[9];         /* planes and quads: see rt_scene_parameters */
} rt_scene_placement;

/* A shape that is being added. */
typedef struct rt_new_shape {
    rt_scene_shape shape; /* but for material, texture, emission and placement */
    const rt_surface *surface;
    rt_scene_placement placement;
    double area;
} rt_new_shape;

/* The intensity of a light by direction; owns its arrays. See rt_light_table. */
typedef struct rt_scene_light_table {
    rt_u32 flags, columns, rows;
    float *lines;   /* [columns + 1 + rows + 1] */
    float *values;  /* [][4], w = 0 */
    float cosine;   /* of the angle from the axis beyond which there is nothing */
    double flux[3]; /* the integral of what multiplies the light's emission, sr */
    double peak;    /* at most that, mean of the channels */
} rt_scene_light_table;

void rt_light_table_free(rt_scene_light_table *table);

/* A delta light, or the environment. */
typedef struct rt_scene_light {
    rt_u32 kind;                     /* RT_LIGHT_* */
    float position[3], direction[3]; /* as rt_light_data.a and b */
    float inner, outer;              /* spot: cosines; with a table, of its cone; beam: outer 1 */
    float half[2];                   /* beam: halves of its width and height */
    rt_falloff falloff;              /* of a spot */
    int is_round;                    /* beam: its cross section is an ellipse */
    float across[3];                 /* beam, and with a table: as rt_light_data.normal */
    rt_u32 table;                    /* 1 + index in light_tables; 0: none */
    float emission[3];
} rt_scene_light;

/* The environment's image. */
typedef struct rt_scene_environment {
    rt_u32 width, height; /* 0: constant */
    float *texels;        /* [height][width][4], top row first, w = 0 */
    float turn;           /* rotation about y, turns; then ... */
    int is_turned;        /* ... whether it has axes of its own, ... */
    float axes[3][3];     /* ... orthonormal ones: where x, y and z of the image are in the world */
    float mean[3];        /* radiance over the sphere; constant: 1 */
    rt_u32 light;         /* index in lights; RT_NONE: there is no environment */
} rt_scene_environment;

struct rt_scene {
    const char *vdb_module; /* see rt_scene_set_vdb_module; not owned */
    rt_memory *memory;      /* that what is added counts in; NULL: none */
    const char *root;       /* of rt_scene_set_root */
    rt_scene_texture *textures;
    size_t texture_count, texture_room;
    rt_texture_data *texture_rows; /* of nested textures: their `texels` is the first of theirs */
    size_t texture_row_count, texture_row_room;
    rt_bytes texels;                                        /* of all image textures */
    char attributes[RT_ATTRIBUTES_MOST][RT_ATTRIBUTE_NAME]; /* that textures name */
    uint32_t attribute_count;
    rt_scene_grid *grids;
    size_t grid_count, grid_room;
    rt_material *materials; /* complete: defaults filled in, texture handles checked */
    size_t material_count, material_room;
    rt_scene_mesh *meshes;
    size_t mesh_count, mesh_room;
    rt_scene_shape *shapes;
    size_t shape_count, shape_room;
    rt_scene_emission *emissions;
    size_t emission_count, emission_room;
    rt_scene_placement *placements;
    size_t placement_count, placement_room;
    rt_scene_light *lights;
    size_t light_count, light_room;
    rt_scene_light_table *light_tables;
    size_t light_table_count, light_table_room;
    rt_scene_environment environment;
    rt_portal *portals;
    size_t portal_count, portal_room;
    rt_medium medium; /* outside of all solids */
    rt_camera camera; /* defaults filled in */
    int has_camera;
    rt_render_options options; /* hooks NULL */
};

/*
 * Whether a placed mesh has a tree of its own: when it is placed more than once, and does not emit.
 */
int rt_scene_is_instance(const rt_scene *scene, const rt_scene_shape *shape);

/*
 * Primitives of a shape on the device: triangles count one by one, every other shape is one, an
 * instance too.
 */
size_t rt_scene_shape_primitives(const rt_scene *scene, const rt_scene_shape *shape);

/*
 * Radiance that a shape emits, W/(m^2 sr), from its own radiance or power or its material's
 * emission; before texture.
 */
void rt_scene_shape_radiance(const rt_scene *scene, const rt_scene_shape *shape, float radiance[3]);

/*
 * Whether a shape has radiance or power of its own; its texture then multiplies that, and not kd.
 */
int rt_scene_has_own_light(const rt_scene *scene, const rt_scene_shape *shape);

/* The handle of the texture that multiplies that radiance, or 0. */
uint32_t rt_scene_emission_texture(const rt_scene *scene, const rt_scene_shape *shape);

/* Whether its material has an opacity below 1. */
int rt_scene_is_cutout(const rt_scene *scene, const rt_scene_shape *shape);

/* A vertex of a placed mesh in world space, rounded as the hierarchy has it. */
void rt_scene_vertex(const rt_scene *scene, const rt_scene_shape *shape, size_t vertex,
                     float out[3]);

/*
 * Area of a triangle of a mesh as a map places it, m^2, by its vertices as the hierarchy has them;
 * to_world NULL: the identity.
 */
double rt_triangle_area(const rt_scene_mesh *mesh, size_t triangle, const rt_affine *to_world);

/* Area of one primitive of a finite shape that emits, m^2. */
double rt_scene_primitive_area(const rt_scene *scene, const rt_scene_shape *shape,
                               size_t primitive);

/* Whether placing the shape turns its inside out, so that a product of its edges points inwards. */
int rt_scene_is_mirrored(const rt_scene *scene, const rt_scene_shape *shape);

/* From the shape's own space, or the mesh's, to the world. */
rt_affine rt_scene_to_world(const rt_scene *scene, const rt_scene_shape *shape);

/*
 * The parameters of a shape, as rt_shape.p, of which the first four alone may be set; of a quad,
 * corner, edge1 and edge2 in world space.
 */
const float *rt_scene_parameters(const rt_scene *scene, const rt_scene_shape *shape);

/* Checks what all shapes share and appends. */
rt_status rt_scene_add_shape(rt_scene *scene, uint32_t *out, const rt_new_shape *added,
                             const char *who, rt_error *error);

/* Checks the scattering of a medium. */
rt_status rt_medium_check(const float scattering[3], float g, const char *who, rt_error *error);

/* How many numbers it has: its voxels times its channels. */
size_t rt_scene_grid_numbers(const rt_scene_grid *grid);

/* Checks the grid of the albedo of a medium; its handle may be 0. */
rt_status rt_grid_check_albedo(const rt_scene *scene, uint32_t handle, const char *who,
                               rt_error *error);

/*
 * Checks the grid that gives a medium of these coefficients its density; its handle may be 0.
 */
rt_status rt_grid_check_medium(const rt_scene *scene, uint32_t handle, const float absorption[3],
                               const float scattering[3], const char *who, rt_error *error);

/* Whether it has a diffuse lobe, which reflects or transmits. */
int rt_material_is_diffuse(const rt_material *material);

/* Whether it has a specular part: that of ks and kt, or a coat. */
int rt_material_is_specular(const rt_material *material);

/* Whether that is a rough lobe. */
int rt_material_is_rough(const rt_material *material);

/* Whether it is a metal, by eta and k or by Schlick's approximation. */
int rt_material_is_conductor(const rt_material *material);

/* Whether it has a coat over ks. */
int rt_material_is_lacquer(const rt_material *material);

/* Whether it reflects or refracts like something smooth, as a lacquer may beside a rough lobe. */
int rt_material_is_mirror(const rt_material *material);

/* Whether it is principled: whether a member of such a material is given. */
int rt_material_is_principled(const rt_material *material);

/* A member that makes it principled, or NULL. */
const char *rt_principled_member(const rt_material *material);

/*
 * Checks a principled material, and completes it: kd, ks and kt get its inputs, as kernels have
 * them (RT_PRINCIPLED_INPUTS). Leaves others as they are.
 */
rt_status rt_principled_complete(rt_material *material, const char *who, rt_error *error);

/* The first member by which a material says its dispersion, or NULL. */
const char *rt_dispersion_member(const rt_material *material);

/*
 * Checks what a material says of its dispersion, and gives it the terms of Cauchy or of Sellmeier
 * that come of it.
 */
rt_status rt_dispersion_complete(rt_material *material, const char *who, rt_error *error);

/* Whether a completed material is a solid whose index depends on the wavelength. */
int rt_material_is_dispersive(const rt_material *material);

/* The index of a completed material at a wavelength in micrometres. */
double rt_material_ior_at(const rt_material *material, double wavelength);

/* The RT_LOBE_* that scatters a material's kd. */
rt_u32 rt_material_diffuse_lobe(const rt_material *material);

/*
 * Whether kd + ks + kt <= 1 wherever textures are brightest, a shape's own included; its handle may
 * be 0. The error names `field`, or, when that is NULL, the coefficient.
 */
rt_status rt_material_check_albedo(const rt_scene *scene, const rt_material *material,
                                   uint32_t shape_texture, const char *who, const char *field,
                                   rt_error *error);

/*
 * Whether a handle is one of a texture, or 0 for none; whether the texture is of colours, none
 * negative; and whether a number times the mean of its channels never exceeds 1.
 */
rt_status rt_texture_check(const rt_scene *scene, uint32_t handle, const char *who,
                           const char *field, rt_error *error);
rt_status rt_texture_check_colours(const rt_scene *scene, uint32_t handle, const char *who,
                                   const char *field, rt_error *error);
rt_status rt_texture_check_number(const rt_scene *scene, float number, uint32_t handle, float limit,
                                  const char *who, const char *field, rt_error *error);

/* The transform of a surface; fails with field "transform" when it cannot be inverted. */
rt_status rt_surface_transform(rt_affine *out, const rt_surface *surface, const char *who,
                               rt_error *error);

/*
 * Whether more than surfaces scatter light, or some let it pass unchanged: a medium scatters, the
 * space outside of all solids is not vacuum, or a shape is an interface.
 */
int rt_scene_has_media(const rt_scene *scene);

/* Whether one of those media has its density or its albedo on a grid. */
int rt_scene_has_grids(const rt_scene *scene);

/* Whether the index of a solid depends on the wavelength. */
int rt_scene_has_dispersion(const rt_scene *scene);

/* Whether some surface may have a shading normal other than the geometric one. */
int rt_scene_has_shading_normals(const rt_scene *scene);

/* The exponent of a spot that falls by a power of the cosine's fraction, or 0. */
double rt_spot_power(const rt_scene_light *spot);

/*
 * The solid angle that a spot would fill with its full intensity; the angles of the cosines inner
 * and outer, rounded to float, are those of a linear one.
 */
double rt_spot_solid_angle(const rt_scene_light *spot);

/* The area of a beam's cross section, m^2. */
double rt_beam_area(const rt_scene_light *beam);

/* Whether anything in the scene emits light. */
int rt_scene_has_light(const rt_scene *scene);

/* The largest radiance, in any channel, where all lights are area lights; 0: there are others. */
double rt_scene_brightest(const rt_scene *scene);

/* Whether it has lights, and rt_scene_check reports each of them as one that lights nothing. */
int rt_scene_is_dark(const rt_scene *scene);

/*
 * On which surfaces delta lights (point, spot, directional, beam) and smooth mirrors or glass may
 * cast caustics. Path tracing misses this light: no path from the eye that passes a specular
 * surface meets a delta light; and photon mapping misses it where a surface scatters by a rough
 * specular lobe.
 */
enum { RT_CAUSTICS_DIFFUSE = 1, RT_CAUSTICS_ROUGH = 2 };
/* Segments of the shortest path of one: from the eye to where it falls, to a mirror, to a light. */
enum { RT_CAUSTIC_DEPTH = 3 };
int rt_scene_hidden_caustics(const rt_scene *scene);

/* Appends a light; checked already. */
rt_status rt_scene_take_light(rt_scene *scene, const rt_scene_light *light, rt_error *error);

/* Appends a mesh, taking its arrays over; checked already. */
rt_status rt_scene_take_mesh(rt_scene *scene, uint32_t *out, const rt_scene_mesh *mesh,
                             rt_error *error);
void rt_scene_mesh_free(rt_scene_mesh *mesh);

/*
 * Adds the triangles of each texture as a mesh of its own, which instances place together; the
 * first is *out. textures [texture_count] are the handles. Leaves the arrays as they are.
 */
rt_status rt_scene_add_parts(rt_scene *scene, uint32_t *out, const rt_scene_mesh *whole,
                             const uint32_t *texture_of, const uint32_t *textures,
                             uint32_t texture_count, rt_error *error);

/* Sets a mesh's area and bounds from its arrays. */
void rt_scene_mesh_measure(rt_scene_mesh *mesh);

#endif
