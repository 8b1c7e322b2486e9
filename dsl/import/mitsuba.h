/* mitsuba.h - what the parts of the reader of Mitsuba 3 scenes share. */
#ifndef RT_DSL_IMPORT_MITSUBA_H
#define RT_DSL_IMPORT_MITSUBA_H

#include "dsl/import/names.h"
#include "dsl/import/xml.h"

/* What became of an element: xml_node.is_read. */
enum { UNREAD, READ, LEFT_OUT };

/* Shapes whose u and v are others here: what those become in Mitsuba. */
typedef enum mitsuba_uv {
    MITSUBA_UV_SAME,
    MITSUBA_UV_BACK,       /* (1 - u, v): a rectangle from behind */
    MITSUBA_UV_UPENDED,    /* (u, 1 - v) */
    MITSUBA_UV_DISK,       /* (v, 1 - u): radius and angle */
    MITSUBA_UV_DISK_TURNED /* (v, u): one that lies on its face */
} mitsuba_uv;

/* A file of meshes that was copied. */
typedef struct mitsuba_mesh {
    int handle;
    int is_smoothed; /* its file has no normals, so they were computed */
    int is_turned;   /* its front is its back */
    int has_normals; /* of vertices, its file's or computed */
    double lo[3], hi[3];
} mitsuba_mesh;

typedef struct mitsuba {
    importer *import;
    int is_old;       /* a scene of Mitsuba 0.x */
    xml_node **files; /* the roots of all files read */
    size_t file_count;
    name_table ids;
    xml_node **named; /* by the numbers of ids, their elements */
    name_table default_names;
    const char **defaults;     /* the values of <default>, by the numbers of their names */
    int made[XML_MADE];        /* as in xml_node, for shapes without a material */
    mitsuba_uv uv;             /* of the shape whose material is read */
    xml_node *shape;           /* whose material is read */
    int asks;                  /* a texture that was read asks for attributes of its mesh */
    name_table asked_keys;     /* materials that do, by the attributes that meshes have: ... */
    int *asked;                /* ... their handles, by the numbers of the keys */
    name_table ply_keys;       /* PLY files, ... */
    char **ply_attributes;     /* ... and what rt_import_ply_attributes says of them */
    const xml_node *filled[2]; /* the last medium that filled a shape, and its material */
    int filled_made[2];        /* what that became, as made */
    name_table mesh_keys;
    mitsuba_mesh *meshes; /* by the numbers of their keys */
    int has_integrator;
    int samples;       /* a pixel's; 0: not given */
    double seed;       /* the same */
    int max_depth;     /* 0: not given, or without end */
    int passes_sheets; /* whether the integrator does not count their faces in max_depth */
    xml_node *sheet;   /* one of the thin sheets, or NULL */
    xml_node *mask;    /* the last one, or NULL */
    xml_node *medium;  /* the first that fills a shape, or NULL */
    int skips_media;   /* whether the integrator takes them for empty space */
    int depth;         /* of includes, references and groups */
    int texture_depth; /* of textures in each other */
    int grouped;       /* shapes and instances of groups, as often as they are placed */
    int again;         /* elements that references had read, each time */
} mitsuba;

/* ---- Messages and what is left out: mitsuba.c ------------------------------------------------ */

/* The import, whose messages are of this element's file from now on; their line is node->line. */
importer *rt_mitsuba_at(mitsuba *m, const xml_node *node);

/*
 * Every element that has its effect is marked as read, by the functions below or by its reader; one
 * that stands unmarked inside of a marked one is told at the end. rt_mitsuba_leave: an element is
 * left out with all that stands in it, which its reader tells in other words.
 */
void rt_mitsuba_leave(xml_node *node);

/* Tells an element whose type is none of these, up to a NULL. */
void rt_mitsuba_note_type(mitsuba *m, xml_node *node, const char *const *types);

/* Reads how the camera's pixels are sampled. */
void rt_mitsuba_sampler(mitsuba *m, xml_node *node);

/* ---- Values: mitsuba_value.c ----------------------------------------------------------------- */

/* The text of an attribute, its $name replaced; "" where it is not there. */
const char *rt_mitsuba_text(mitsuba *m, xml_node *node, const char *attribute);

/*
 * The child with this name="..." attribute, or NULL; camelCase counts as snake_case. Not marked.
 * The name, which outlives the scene, is what a mistyped one is told to have meant.
 */
xml_node *rt_mitsuba_child(xml_node *node, const char *name);

double rt_mitsuba_number(mitsuba *m, xml_node *node, const char *name, double fallback);

/* Any other value than true and false is told, and counts as not given. */
int rt_mitsuba_flag(mitsuba *m, xml_node *node, const char *name, int fallback);
const char *rt_mitsuba_string(mitsuba *m, xml_node *node, const char *name);
int rt_mitsuba_vector(mitsuba *m, xml_node *node, const char *name, double out[3]);

/* A colour that is no texture; returns whether it is there. */
int rt_mitsuba_colour(mitsuba *m, xml_node *node, const char *name, double out[3]);

/* The colour of a spectrum that is described by elements, as <spectrum type="uniform">. */
void rt_mitsuba_spectrum(mitsuba *m, xml_node *node, double out[3]);

/* The transform of that name, or the identity. */
matrix rt_mitsuba_transform(mitsuba *m, xml_node *node, const char *name);

/* Whether two names are one, camelCase counting as snake_case. */
int rt_mitsuba_is(const char *written, const char *name);

/*
 * What a <ref> names, or the element itself, not marked; NULL where there is none, which is told
 * once: the <ref> is then marked as left out.
 */
xml_node *rt_mitsuba_follow(mitsuba *m, xml_node *node);

/* Marks both as read. What a <ref> names is read once more, of which there is a bound. */
void rt_mitsuba_read(mitsuba *m, xml_node *node, xml_node *named);

/* ---- Materials: mitsuba_bsdf.c --------------------------------------------------------------- */

/* The material of a shape: its <bsdf> or <ref>; without one, grey, or black of an emitter. */
int rt_mitsuba_material(mitsuba *m, xml_node *shape, int is_emitter, mitsuba_uv uv);

/* Counts the material that a node is, or is part of, as approximated: something of it was told. */
void rt_mitsuba_note_material(mitsuba *m, xml_node *node);

/*
 * That of a shape, called `what`, whose front is its back: its sides are exchanged. Returns that of
 * the surface, with a note, where they cannot be.
 */
int rt_mitsuba_turned_material(mitsuba *m, xml_node *shape, const import_surface *surface,
                               mitsuba_uv uv, const char *what);

/* The medium inside of a shape, or NULL; and a material with it: mitsuba_medium.c. */
xml_node *rt_mitsuba_find_medium(mitsuba *m, xml_node *shape);
void rt_mitsuba_fill(mitsuba *m, xml_node *medium, import_material *out);

/* An index of refraction: a number, or a name, with the number that Mitsuba gives it. */
double rt_mitsuba_ior(mitsuba *m, xml_node *node, const char *name, double fallback);

/* kd and its texture, by the parameter of this name; 0.5 without it. */
void rt_mitsuba_diffuse(mitsuba *m, xml_node *node, const char *name, import_material *out);

/* The materials inside of another, one to `most`; returns how many there are. */
int rt_mitsuba_parts(mitsuba *m, xml_node *node, import_part *parts, int most, int depth);

/* The one material inside of another, as in mask. */
void rt_mitsuba_inner(mitsuba *m, xml_node *node, import_material *out, int depth);

/* Those of Mitsuba 0.x: mitsuba_bsdf_old.c. */
void rt_mitsuba_rough_diffuse(mitsuba *m, xml_node *node, import_material *out);
void rt_mitsuba_glossy(mitsuba *m, xml_node *node, import_material *out);
void rt_mitsuba_coating(mitsuba *m, xml_node *node, import_material *out, int depth);
void rt_mitsuba_mixture(mitsuba *m, xml_node *node, import_material *out, int depth);

/* eta and k of a conductor of Mitsuba's by its name; whether there is such. */
int rt_mitsuba_metal(const char *name, double eta[3], double k[3]);

/* ---- Textures: mitsuba_texture.c ------------------------------------------------------------- */

/* A texture as an element, or IMPORT_NONE; *out: what multiplies it, or the constant that it is. */
int rt_mitsuba_texture(mitsuba *m, xml_node *node, const char *name, double out[3]);

/* The same of a number: the mean of the texture's channels. */
int rt_mitsuba_number_texture(mitsuba *m, xml_node *node, const char *name, double out[3]);

/*
 * Whether a number is one of the vertices or faces of meshes: *attribute is its name then, without
 * what it is of.
 */
import_colours rt_mitsuba_weight(mitsuba *m, xml_node *node, const char *name,
                                 const char **attribute);

/* Whether the image of a node is taken as it is; what is no image is. */
int rt_mitsuba_is_raw(mitsuba *m, xml_node *node);

/*
 * The texture inside of a bump or normal map, or IMPORT_NONE, without what scales it, by which
 * *scale is multiplied.
 */
int rt_mitsuba_map(mitsuba *m, xml_node *node, int is_linear, double *scale);

/* ---- Emitters: mitsuba_emitter.c, shapes: mitsuba_shape.c, mitsuba_mesh.c -------------------- */

void rt_mitsuba_emitter(mitsuba *m, xml_node *node);

/* An emitter of this type, sun, sky or sunsky: mitsuba_daylight.c. */
void rt_mitsuba_daylight(mitsuba *m, xml_node *node, const char *type, const matrix *to_world);

void rt_mitsuba_sensor(mitsuba *m, xml_node *node);

/* The horizontal angle of view, from that along fov_axis. */
double rt_mitsuba_fov(mitsuba *m, xml_node *node, double aspect);

/* The image of a light, by its name in the scene: mitsuba_projector.c. */
typedef struct mitsuba_image {
    char file[512];
    uint32_t size[2];
    int is_nearest, repeats;
} mitsuba_image;
void rt_mitsuba_projector(mitsuba *m, xml_node *node, const matrix *to_world);

/* Sets the image of a spot that has one; *image has to live as long as *spot. */
void rt_mitsuba_spot_image(mitsuba *m, xml_node *node, const matrix *to_world, import_spot *spot,
                           mitsuba_image *image);

/* Places a mesh; returns 0 where shapes of that type are none. */
int rt_mitsuba_place_mesh(mitsuba *m, xml_node *node, const char *type,
                          const import_surface *surface);

/* The curves of a file as a mesh in the world, to be freed in any case; 0 after a failure. */
int rt_mitsuba_read_curves(mitsuba *m, xml_node *node, const char *name, int is_spline,
                           const matrix *to_world, import_mesh *out);

/* A height field as a mesh, likewise; is_flat: without normals. */
int rt_mitsuba_read_heights(mitsuba *m, xml_node *node, int is_flat, import_mesh *out);

/* What the mesh of m->shape has, as rt_import_ply_attributes; NULL after a failure. */
const char *rt_mitsuba_attributes(mitsuba *m);

/* Places the cube from -1 to 1 as a mesh. */
void rt_mitsuba_place_cube(mitsuba *m, xml_node *node, int is_turned,
                           const import_surface *surface);

/* A shape in the frame of a group. */
void rt_mitsuba_shape(mitsuba *m, xml_node *node, const matrix *around);

#endif
