/* pbrt.h - what the parts of the reader of pbrt-v4 scenes share. */
#ifndef RT_DSL_IMPORT_PBRT_H
#define RT_DSL_IMPORT_PBRT_H

#include "dsl/import/import.h"
#include "dsl/import/names.h"

/* ---- Tokens: pbrt_token.c -------------------------------------------------------------------- */

typedef enum pbrt_kind {
    PBRT_END,
    PBRT_WORD,
    PBRT_STRING,
    PBRT_NUMBER,
    PBRT_OPEN,
    PBRT_CLOSE
} pbrt_kind;

enum { PBRT_TEXT = 256 }; /* room for a word or a string */

typedef struct pbrt_token {
    pbrt_kind kind;
    char text[PBRT_TEXT]; /* of a word or string, without quotes */
    double number;
    const char *file; /* that is included, or NULL: the scene itself */
    int line;
} pbrt_token;

/* A text that is read, and those that it is included from. */
typedef struct pbrt_source {
    const char *file; /* as in pbrt_token */
    char *text;       /* owned, but for the first */
    const char *at, *end;
    int line;
} pbrt_source;

typedef struct pbrt_tokens {
    importer *import;
    pbrt_source sources[IMPORT_DEPTH_MAX];
    int depth;
    char **files; /* the names of all that were included, to the end */
    size_t file_count;
    pbrt_token ahead;
    int has_ahead;
    int line; /* of the token that was taken last */
    int is_v3;
} pbrt_tokens;

/*
 * The next token, which stays; and takes it. Messages are of the file of the one that was taken
 * last.
 */
const pbrt_token *rt_pbrt_peek(pbrt_tokens *tokens);
pbrt_token rt_pbrt_take(pbrt_tokens *tokens);

/* The line for messages: that of the token that was taken last. */
int rt_pbrt_line(const pbrt_tokens *tokens);

/* Where something stands, for messages that come later; rt_pbrt_at: of which they are now. */
typedef struct pbrt_place {
    const char *file;
    int line;
} pbrt_place;
pbrt_place rt_pbrt_here(const pbrt_tokens *tokens);
int rt_pbrt_at(importer *import, pbrt_place place);

/* Goes on in another file, then here. */
void rt_pbrt_include(pbrt_tokens *tokens, const char *name);
void rt_pbrt_free_tokens(pbrt_tokens *tokens);

/* ---- Parameters: pbrt_param.c ---------------------------------------------------------------- */

enum { PBRT_PARAMS_MAX = 64, PBRT_ASKED_MAX = 48 };

typedef struct pbrt_param {
    char type[32], name[64];
    double *numbers;
    char (*strings)[PBRT_TEXT];
    size_t number_count, string_count;
    int line, is_used;
    int is_wrong;          /* told, and counts as not given */
    struct pbrt_param *of; /* of an Attribute, that whose values it shares; NULL: its own */
} pbrt_param;

typedef struct pbrt_params {
    importer *import;
    pbrt_param items[PBRT_PARAMS_MAX];
    int count, line;
    int is_v3; /* of a file of pbrt-v3, as far as is known */
    struct {
        const char *types; /* a constant */
        char name[48];
    } asked[PBRT_ASKED_MAX]; /* what was looked for in vain, as far as it has room */
    int asked_count;
} pbrt_params;

/* The parameters behind a directive; to be freed. */
void rt_pbrt_read_params(pbrt_params *params, pbrt_tokens *tokens);
void rt_pbrt_free_params(pbrt_params *params);

/* Whether a word is one of a list, in which spaces separate two. */
int rt_pbrt_is_among(const char *word, const char *list);

/* The parameter of that name and one of the types ("float", "point3 point"), or NULL. */
pbrt_param *rt_pbrt_find(pbrt_params *params, const char *types, const char *name);

double rt_pbrt_number(pbrt_params *params, const char *name, double fallback);
int rt_pbrt_flag(pbrt_params *params, const char *name, int fallback);
const char *rt_pbrt_string(pbrt_params *params, const char *name, const char *fallback);

/* A string that is one of the words, of which spaces separate two; others are told. */
const char *rt_pbrt_word(pbrt_params *params, const char *name, const char *words,
                         const char *fallback);
void rt_pbrt_point(pbrt_params *params, const char *name, double out[3]);

/* A colour by rgb, spectrum or blackbody; returns whether it is there. */
int rt_pbrt_colour(pbrt_params *params, const char *name, double out[3]);

/* Notes what no one has asked for. `what`: of which it is a parameter. */
void rt_pbrt_note_unused(pbrt_params *params, const char *what);

/* ---- The state ------------------------------------------------------------------------------- */

typedef struct pbrt_material {
    char name[PBRT_TEXT];
    import_material material;
    pbrt_place place;
    size_t inside;  /* 1 + the index of the medium that fills it, or 0 */
    int handles[2]; /* with emission on one side, on both; IMPORT_NONE: not yet */
    /* 1 + the index of that which this is, with the alpha and the medium of a shape; 0: none */
    size_t of;
    int is_near; /* something was told of it: it is counted as approximated */
} pbrt_material;

/* A parameter of an Attribute: pbrt_attribute.c. */
typedef struct pbrt_attribute pbrt_attribute;

/* A participating medium. */
typedef struct pbrt_medium {
    double absorption[3], scattering[3], g;
    int density, albedo; /* handles of grids, or IMPORT_NONE */
    int is_left_out;     /* it is of a type that is not read */
    int is_inside;       /* it fills a shape */
} pbrt_medium;

/* The texture of an image, and that of the square roots of its values, IMPORT_NONE: not yet. */
typedef struct pbrt_image {
    int handle, root;
    import_texture texture;
    char file[512];
} pbrt_image;

typedef struct pbrt_state {
    matrix ctm;
    size_t material;        /* an index */
    size_t inside, outside; /* 1 + the index of a medium, or 0 */
    double radiance[3];
    double power; /* W, of each face of a shape that emits; 0: by the radiance */
    int is_two_sided, is_reversed;
    pbrt_attribute *attributes; /* the latest, or NULL */
    int attribute_count;
    pbrt_place opened; /* of one that was saved: what saved it */
} pbrt_state;

/* A shape of an object: a block or a mesh, with its surface in the frame of the object. */
typedef struct pbrt_item {
    char *block; /* NULL: a mesh */
    int mesh;
    int is_turned; /* a sphere, whose poles are those of pbrt */
    double area;   /* of what pbrt has one light for, a face of a mesh on average; 0: not known */
    double lo[3], hi[3];
    import_surface surface;
} pbrt_item;

typedef struct pbrt_object {
    pbrt_item *items;
    size_t count;
} pbrt_object;

/* Curves of one surface, which become one mesh; without vertices there are none. */
typedef struct pbrt_strands {
    import_mesh mesh;
    size_t vertex_room, triangle_room;
    pbrt_item item;
    pbrt_place place; /* of the first */
} pbrt_strands;

typedef struct pbrt {
    importer *import;
    pbrt_tokens tokens;
    pbrt_state state;
    pbrt_state saved[IMPORT_DEPTH_MAX];
    int saved_count;
    /* By the numbers of their names: what was defined last, but of objects the first. */
    name_table texture_names, material_names, object_names, frame_names, medium_names;
    import_factor *textures;
    pbrt_image *images;
    size_t image_count;
    size_t *latest; /* by the number of a material's name, its index */
    pbrt_object *objects;
    matrix *frames;
    pbrt_medium *media;
    size_t camera_medium;     /* 1 + the index of that which the camera is in, or 0 */
    pbrt_material *materials; /* all, in their order */
    size_t material_count;
    int in_object; /* shapes go into an object */
    int object;    /* its number; IMPORT_NONE: one whose name is taken, which nothing places */
    int instance_count;
    matrix mirror; /* of the world: pbrt's is left-handed where the camera is not mirrored */
    uint32_t width, height;
    int max_depth, samples;
    double seed, option_seed; /* of the sampler, and of an Option for one without */
    int has_seed;
    const char *filter;   /* NULL: the usual one */
    double filter_radius; /* pixels; 0: that of the language */
    int has_camera;
    unsigned settings_met;         /* a bit for each of those that stand once */
    int is_in_world, is_misplaced; /* behind WorldBegin; a directive is told that is not, or is */
    pbrt_place camera_place;
    double window[2];           /* halves of the screen window; 0: by the film */
    pbrt_attribute *attributes; /* all, the last first */
    pbrt_strands strands;
    size_t segment_count; /* of all curves */
    double crop[4];       /* the columns, from and to, and rows of the film that are rendered */
    import_camera view;
    double fov;
    double shutter, gain; /* for how long the film is lit, and how much it takes of the light */
} pbrt;

/* Makes room for one more item of a list, cleared; NULL after a failure. */
void *rt_pbrt_grow(importer *import, void *items, size_t *count, size_t size);

/* ---- The parts ------------------------------------------------------------------------------- */

/*
 * A list by the numbers of names, in which `at` receives that of a name: a new one gets an item,
 * cleared. NULL after a failure.
 */
void *rt_pbrt_define(importer *import, name_table *names, const char *name, void *items,
                     size_t size, size_t *at);

/* The string behind a directive; 0 after a failure. */
int rt_pbrt_take_string(pbrt *p, const char *directive, char out[PBRT_TEXT]);
void rt_pbrt_keep_frame(pbrt *p, const char *name, const matrix *frame);

/* Reads a setting: camera, film, filter, sampler, integrator. Returns whether the word is one. */
int rt_pbrt_setting(pbrt *p, const char *word);

/* The camera with its film, whose shorter side fov and the screen window are of. */
void rt_pbrt_finish_camera(pbrt *p);

void rt_pbrt_make_texture(pbrt *p, pbrt_params *params, const char *name, const char *type,
                          const char *kind);

/* The heights of a material by the texture that a parameter names. */
void rt_pbrt_bump(pbrt *p, pbrt_params *params, const char *name, import_material *m);

/* A colour or a texture, whose handle is returned, with its factor in *out. */
int rt_pbrt_input(pbrt *p, pbrt_params *params, const char *name, double out[3]);

/* A material of pbrt-v3; returns 0 where that has none of this type. */
int rt_pbrt_v3_material(pbrt *p, pbrt_params *params, const char *type, import_material *m);

/* Adds a material; returns its index. */
size_t rt_pbrt_make_material(pbrt *p, pbrt_params *params, const char *name, const char *type);

/* The handle of the material of the state, with the alpha of a shape of these parameters. */
int rt_pbrt_use_material(pbrt *p, pbrt_params *params);

/* ---- Media: pbrt_medium.c -------------------------------------------------------------------- */

void rt_pbrt_make_medium(pbrt *p, pbrt_params *params, const char *name);

/* The coefficients of a medium that the parameter of this name names; of whole milk without it. */
void rt_pbrt_preset(pbrt *p, pbrt_params *params, const char *name, double absorption[3],
                    double scattering[3]);

/* Reads which media the next shapes have inside and outside. */
void rt_pbrt_read_interface(pbrt *p);

/* Fills the inside of a material with a medium, 1 + its index. */
void rt_pbrt_fill(pbrt *p, int line, size_t medium, import_material *out);

/* Fills all space with the medium of the camera, unless that is in a shape. */
void rt_pbrt_fill_space(pbrt *p);

/* ---- Parts of shapes: pbrt_part.c ------------------------------------------------------------ */

typedef enum pbrt_part_kind { PBRT_PART_SPHERE, PBRT_PART_CYLINDER, PBRT_PART_DISK } pbrt_part_kind;

/* About the z axis. */
typedef struct pbrt_part {
    pbrt_part_kind kind;
    double radius, inner; /* inner: of a disk, else 0 */
    double z[2];          /* from and to; of a disk twice its height */
    double phi;           /* radians from x towards y */
} pbrt_part;

/* Turns over the faces whose normals are on their other side: pbrt goes by the normals. */
void rt_pbrt_face_normals(import_mesh *mesh);

/* Makes a mesh of a part, whose normals the state may turn inwards. */
void rt_pbrt_make_part(pbrt *p, int line, const pbrt_part *part, pbrt_item *item);

/* ---- Lights and shapes ----------------------------------------------------------------------- */

void rt_pbrt_light(pbrt *p, pbrt_params *params, const char *type);
void rt_pbrt_area_light(pbrt *p, pbrt_params *params, const char *type);
void rt_pbrt_shape(pbrt *p, pbrt_params *params, const char *type);
void rt_pbrt_instance(pbrt *p, const char *name);

/* Gives an item the radiance and the place of the state. */
void rt_pbrt_settle(pbrt *p, int line, pbrt_item *item);

/* Places an item, or keeps it for the object that is read. Takes its block. */
void rt_pbrt_deliver(pbrt *p, int line, pbrt_item *item);

/* Adds a mesh, whose bounds the item gets; returns its handle, or IMPORT_NONE. */
int rt_pbrt_add_mesh(pbrt *p, int line, const import_mesh *mesh, pbrt_item *item);

/* ---- Curves: pbrt_curve.c -------------------------------------------------------------------- */

/* Reads a curve, which waits for those behind it that share its mesh. */
void rt_pbrt_curve(pbrt *p, pbrt_params *params);

/* Places the curves that wait: before the object begins or ends that has them, and at the end. */
void rt_pbrt_flush_curves(pbrt *p);

/* ---- Attributes: pbrt_attribute.c ------------------------------------------------------------ */

/* Reads what stands behind the word Attribute. */
void rt_pbrt_read_attribute(pbrt *p);

/* Adds those parameters of attributes that a directive takes and has not itself. */
void rt_pbrt_add_attributes(pbrt *p, pbrt_params *params, const char *directive);

/* Notes those that no directive has asked for, though it could have. */
void rt_pbrt_note_attributes(pbrt *p);
void rt_pbrt_free_attributes(pbrt *p);

#endif
