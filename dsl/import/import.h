/*
 * import.h - what the readers of other programs' scenes share: the scene that is written, the notes
 * of what it lacks, and the files beside it.
 *
 * A reader calls import_... for what it finds. The first rt_import_fail ends the import; after it
 * calls do nothing, so that readers may look at `failed` where that suits them.
 */
#ifndef RT_DSL_IMPORT_IMPORT_H
#define RT_DSL_IMPORT_IMPORT_H

#include <stddef.h>
#include <stdint.h>

#include "dsl/import/matrix.h"
#include "rt.h"

#if defined(__GNUC__)
#define IMPORT_PRINTF(text, first) __attribute__((format(printf, text, first)))
#else
#define IMPORT_PRINTF(text, first)
#endif

enum {
    IMPORT_FILE_MAX = 1 << 30,     /* bytes of a file that is read */
    IMPORT_DEPTH_MAX = 64,         /* of nodes, elements, groups and includes inside each other */
    IMPORT_ROWS_MAX = 256,         /* of textures in each other */
    IMPORT_SAMPLES_MAX = 16777216, /* of the language's spp */
    IMPORT_SEGMENTS_MAX = 4096,    /* and max_depth */
    IMPORT_SHAPES_MAX = 1000000,   /* that a scene may come to by its instances */
    IMPORT_SEARCH_MAX = 64,        /* folders in which files are searched */
    IMPORT_NAME = 64,              /* room for a name of the language */
    IMPORT_NONE = -1,              /* no material, texture or mesh */
    IMPORT_BLACK = -2              /* the material that reflects nothing */
};

/* A text that grows. */
typedef struct import_text {
    char *text;
    size_t size, capacity;
} import_text;

/* What a note is about: the first concern most of the picture, and are told first. */
typedef enum import_concern {
    IMPORT_PICTURE, /* lights, the camera, files, settings */
    IMPORT_SHAPE,
    IMPORT_MATERIAL,
    IMPORT_TEXTURE
} import_concern;

/* Where an import is, for its messages. All zero: in the file that was given. */
typedef struct import_place {
    const char *file; /* another file that is read, as the scene names it; NULL: none */
    const char *list; /* of a file without lines, the array of its item: "materials"; or NULL */
    size_t index;     /* of the item */
    const char *name; /* of the item, or NULL */
    import_concern concern;
} import_place;

/* A note: what was left out or changed, and where. */
typedef struct import_note {
    char *place, *text; /* place: of the first */
    int line;           /* that place ends with ":line", unless 0 */
    char also[96];      /* further places, as many as fit: "5, 7" */
    int has_more;       /* and others */
    import_concern concern;
    size_t count;    /* how often it was told */
    int is_addition; /* of what the file needs not have: no error when strict */
    int is_damage;   /* of an image that a renderer could not read */
} import_note;

/* Colours of a mesh that a material shows: those of the language multiply kd. */
typedef enum import_colours {
    IMPORT_COLOURS_NONE,
    IMPORT_COLOURS_OF_VERTICES,
    IMPORT_COLOURS_OF_FACES,
    IMPORT_COLOURS_KEPT /* those of the file, as the language takes them */
} import_colours;

/* Colours by a weight from 0 to 1 of the vertices or faces of a mesh. */
typedef struct import_ramp {
    const char *weight; /* its name; NULL: no ramp */
    double ends[2][3];  /* the colours at 0 and 1 */
} import_ramp;

/* What a handle stands for. */
typedef struct import_label_entry {
    char name[IMPORT_NAME];
    int is_textured, is_anisotropic; /* of a material */
    int is_solid;                    /* likewise: it has an inside */
    int hides_colours;               /* likewise: those of a mesh are not its base colour */
    import_colours colours;          /* likewise */
    import_ramp ramp;                /* by which it shows them */
    int levels, rows;                /* of a texture with others inside; 0: none */
    double most;                     /* of a texture: its largest value, of images 1; 0: 1 */
} import_label_entry;

/* Files beside the scene that are copies of others: their names for the scene, and those' paths. */
typedef struct import_copies {
    struct import_copy {
        char *name, *from;
    } * items;
    size_t count;
} import_copies;

/* A plane across the view, by its word in the file, and how far it is. */
typedef struct import_plane {
    const char *word;
    double depth;
} import_plane;

/* Between which planes the camera of a file sees; words are NULL where it has none. */
typedef struct import_clip {
    import_plane planes[2]; /* near and far */
    double eye[3], forward[3];
    import_place place;
    int line;
} import_clip;

typedef struct importer importer;
struct importer {
    const char *path;                /* of the scene that is read, as given */
    import_place place;              /* in it, where the line does not say so */
    const char *root;                /* a folder out of which no file is read, or NULL */
    const char *vdb_module;          /* of rt_load_options */
    char *folder;                    /* of path, ends with '/' or is empty */
    char *search[IMPORT_SEARCH_MAX]; /* folders before that one, the last first, likewise */
    size_t search_count;
    char *files_path;   /* the folder of meshes and textures */
    const char *files;  /* in files_path: the same as the new scene names it */
    int is_dry;         /* no file is written */
    int is_passing;     /* files are read and removed by this process: none need outlive it */
    int checks_images;  /* those that cannot be decoded are left out */
    size_t image_count; /* that were written */
    const char *camera; /* the name or number of the one that is taken; NULL: the first */
    size_t cameras_met;
    char camera_names[160];          /* of some of these */
    const rt_definition *parameters; /* set by the user, by this */
    const char *parameter_word;
    size_t parameter_count;
    uint64_t parameters_used;                      /* a bit of each of the first 64 */
    void (*on_file)(void *user, const char *path); /* is told each file that is read; or NULL */
    void *file_user;
    import_text settings, definitions, shapes, lights;
    import_text camera_block; /* but for its end */
    int hides_emitters;       /* from the camera */
    import_note *notes;
    size_t told;                           /* notes, those that were there before as well */
    size_t materials_read, materials_near; /* of the latter something was told */
    char near_names[160];                  /* of some of these */
    size_t note_count, notes_left_out;
    uint32_t width, height; /* of the film; 0: not known */
    int has_camera, has_environment, has_even_sky, has_files;
    int has_light;       /* or the file says that there is none */
    double lo[3], hi[3]; /* bounds of what is placed; lo > hi: nothing */
    import_clip clip;
    import_label_entry *labels; /* by handle: of textures, materials and meshes */
    size_t label_count, label_capacity;
    int is_empty;       /* no shape, camera or light was read */
    double even_sky[3]; /* the radiance of all even skies */
    size_t shape_count, solid_count;
    int is_relative;                  /* indices are over those outside, whatever is there */
    size_t bytes_read, bytes_written; /* of all files */
    char *read;                       /* the path of the file that was read last, or NULL */
    import_copies copies;
    char **made; /* the paths of files that were not there before */
    size_t made_count;
    int has_made_folder; /* files_path was not there before */
    int has_written;     /* a file there, by this import */
    int failed;
    int is_memory;         /* it failed for want of memory */
    int is_output;         /* it failed to write */
    char error_place[260]; /* as that of a note */
    int error_line;
    char error[512]; /* the message */
};

/* ---- Failures and notes ---------------------------------------------------------------------- */

/* Ends the import; line 0: where import->place says. Returns 0. */
int rt_import_fail(importer *import, int line, const char *format, ...) IMPORT_PRINTF(3, 4);
int rt_import_fail_memory(importer *import);

/*
 * Makes room for one more item of a list that has `count`; NULL after a failure, which leaves the
 * list as it is.
 */
void *rt_import_grow(importer *import, void *items, size_t count, size_t size);

/* Notes what the new scene lacks; the same text again adds a place. */
void rt_import_note_at(importer *import, int line, const char *format, ...) IMPORT_PRINTF(3, 4);

/*
 * Notes what is no fault of the file, which `strict` passes: that the scene has, as the file has
 * none, what no picture is without, and by which rules it was read.
 */
void rt_import_note_addition(importer *import, const char *text);

/* Notes that paths stand in for an integrator, and the options of one that is like it. */
void rt_import_note_integrator(importer *import, int line, const char *type);

/* Notes that an image is left out, which a renderer could not read. */
void rt_import_note_damage(importer *import, int line, const char *text);

/* Writes an error of the library, NULL: nowhere; returns its status. */
rt_status rt_import_set_error(rt_error *error, rt_status status, const char *format, ...)
    IMPORT_PRINTF(3, 4);

/* What a value of errno means. */
enum { IMPORT_CAUSE = 128 };
const char *rt_import_cause(char out[IMPORT_CAUSE], int code);

/* Counts a material that was read since import->told was this. */
void rt_import_tally(importer *import, size_t told, const char *name);

/* Counts one that was counted as exact as approximated. */
void rt_import_tally_near(importer *import, const char *name);

/* " (also at 5, 7 and other places)", or nothing. */
void rt_import_note_places(char *out, size_t size, const import_note *note);

/* ---- Text ------------------------------------------------------------------------------------ */

void rt_import_put(importer *import, import_text *out, const char *format, ...) IMPORT_PRINTF(3, 4);

/* `count` numbers, each with a space before it, as short as single precision allows. */
void rt_import_put_numbers(importer *import, import_text *out, const double *values, int count);

/* The same, as the values of a field. */
void rt_import_put_field(importer *import, import_text *out, const char *field,
                         const double *values, int count);

/*
 * A field that is a colour, where it is not black; returns whether it is. Components below 0, light
 * that there is not, and beyond IMPORT_COLOUR_MAX are bounded, which is noted at this line.
 */
int rt_import_put_colour(importer *import, int line, import_text *out, const char *field,
                         const double colour[3]);

/* A field that is the label of a texture, unless the handle is IMPORT_NONE. */
void rt_import_put_texture(importer *import, import_text *out, const char *field, int handle);

int rt_import_is_black(const double colour[3]);

/*
 * A handle whose name is what of `base` may stand in one, and the handle's number; IMPORT_NONE
 * after a failure. rt_import_label: the name.
 */
int rt_import_name(importer *import, const char *base);
const char *rt_import_label(const importer *import, int handle);

/* A number from text, with what follows it; 0 where there is none or it is not finite. */
int rt_import_number(double *out, const char **text);

/* The linear value of an sRGB value of 0 to 1, and the inverse: IEC 61966-2-1:1999. */
double rt_import_decode_srgb(double encoded);
double rt_import_encode_srgb(double linear);

/* ---- Files ----------------------------------------------------------------------------------- */

/*
 * Reads a file that the scene names, relative to the folder of the scene; a NUL stands behind it.
 * To be freed; NULL after a failure.
 */
char *rt_import_read(importer *import, int line, const char *name, size_t *size);

/* The same of a text: without a byte order mark before it. */
char *rt_import_read_text(importer *import, int line, const char *name, size_t *size);

/*
 * Adds a folder in which files are looked for before the others; `file`, as in import_place, names
 * it, relative to its own folder or to one that was added before. Returns whether there is one.
 */
int rt_import_search(importer *import, int line, const char *file, const char *folder);

/* Whether there is such a file, and it may be read. */
int rt_import_has_file(const importer *import, const char *name);

/* The same; where it is not, tells that `what` is left out. */
int rt_import_find(importer *import, int line, const char *name, const char *what);

/* The path of such a file, to be freed; NULL after a failure. */
char *rt_import_resolve(importer *import, int line, const char *name);

/* Says that the file `out`, which was written, is in the scene what the one read last is there. */
void rt_import_keep_copy(importer *import, const char out[512]);
void rt_import_copies_free(import_copies *copies);

/* Writes a file beside the scene; `out` receives its name for the scene. */
int rt_import_write(importer *import, char out[512], const char *base, const char *extension,
                    const void *bytes, size_t size);

/* ---- What a scene is made of ----------------------------------------------------------------- */

typedef enum import_pattern {
    IMPORT_CHECKER,
    IMPORT_MULTIPLY,
    IMPORT_MIX,
    IMPORT_ATTRIBUTE
} import_pattern;

/* A texture times a colour; handle IMPORT_NONE: the colour alone. */
typedef struct import_factor {
    int handle;
    double colour[3];
} import_factor;

/* A texture: its handle, which stands for a name, or IMPORT_NONE. */
typedef struct import_texture {
    const char *file; /* as the new scene names it; NULL: a pattern of a and b */
    import_pattern pattern;
    import_factor a, b, weight; /* weight: of a mixture, by its mean */
    int is_linear;
    int wrap;       /* 0 repeat, 1 mirror, 2 clamp */
    int is_nearest; /* without interpolation */
    char channel;   /* r, g, b or a; 0: all */
    double power;   /* 0 means 1 */
    double scale[2], offset[2];
    double rotate, shear;  /* degrees; as those of the language */
    const char *attribute; /* of meshes, in place of u and v, or that is shown; NULL: none */
} import_texture;

/* Gives a texture the scale, rotation, shear and offset that make (u, v) m (u, v, 1). */
void rt_import_texture_map(import_texture *texture, double m[2][3]);
int rt_import_add_texture(importer *import, const char *base, const import_texture *texture);

/* The largest value of a texture, of images 1; 1 without one. */
double rt_import_texture_most(const importer *import, int handle);

/*
 * The product of two, and their mixture, b by the mean of the weight: a colour where that will do.
 * What lies deeper in each other than the language has it is noted, and its colour taken.
 */
import_factor rt_import_colour(const double colour[3]);
import_factor rt_import_product(importer *import, int line, const char *base,
                                const import_factor *a, const import_factor *b);
import_factor rt_import_mixture(importer *import, int line, const char *base,
                                const import_factor *a, const import_factor *b,
                                const import_factor *weight);

/* A checker of the two, laid as `place` is. */
import_factor rt_import_checker(importer *import, int line, const char *base,
                                const import_texture *place, const import_factor *a,
                                const import_factor *b);

/* Whether an image holds opacities, a PNG or QOI: those of other formats are not looked for. */
int rt_import_image_has_alpha(const void *bytes, size_t size);
int rt_import_file_has_alpha(importer *import, const char *name);

/* Whether an image of any format, which is there, has an alpha other than 1 somewhere. */
int rt_import_alpha_counts(importer *import, int line, const char *name);

/*
 * Copies an image beside the scene, or writes bytes that it holds; `out` receives its name for the
 * scene. What the language does not read, such as a WebP, is noted. Returns whether it is there.
 */
int rt_import_image_file(importer *import, int line, char out[512], const char *name);
int rt_import_image_bytes(importer *import, int line, char out[512], const char *base,
                          const void *bytes, size_t size);

typedef enum import_fresnel {
    IMPORT_FRESNEL_OFF,
    IMPORT_FRESNEL_DIELECTRIC,
    IMPORT_FRESNEL_CONDUCTOR,
    IMPORT_FRESNEL_SCHLICK
} import_fresnel;

/*
 * Its inputs are those of rt_material: kd[3], kd_texture and so on. All zero is black; textures
 * IMPORT_NONE for none.
 */
#define IMPORT_COLOUR(name) double name[3];
#define IMPORT_NUMBER(name) double name;
#define IMPORT_INPUT(TYPE, name, RANGE, NEED, unit, help) IMPORT_##TYPE(name) int name##_texture;
typedef struct import_material {
    RT_MATERIAL_INPUTS(IMPORT_INPUT)
    int is_principled; /* base_color, metallic and so on count, and roughness as theirs */
    double eta[3], k[3], absorption[3];
    double ior, coat_ior; /* 0: the default */
    double scattering[3], g;
    int density;      /* a grid, or IMPORT_NONE */
    int albedo;       /* the same, of the part of scattering that scatters */
    int is_interface; /* no surface, but what it bounds */
    import_colours colours;
    import_ramp ramp; /* by which they are made */
    double abbe;      /* 0: no dispersion */
    rt_glass glass;   /* takes the place of ior, abbe and fresnel, with dispersion */
    int is_coat_linear;
    int is_coat_single; /* light thrown back below a rough one meets one facet */
    int scatters_often; /* light that meets a second facet of others is kept */
    int is_separable;   /* masking and shadowing by facets are */
    int is_thin;
    int bump_texture, normal_texture, opacity_texture;
    double bump_scale, normal_scale; /* 0: 1 */
    int has_bump_shadows;
    double opacity;        /* likewise; not of solids */
    double opacity_cutoff; /* 0: none */
    import_fresnel fresnel;
    int is_rough_diffuse; /* roughness is that of kd, without ks and kt */
    int is_two_sided;
    int is_beckmann;
    double anisotropy_rotation; /* degrees */
    /* handles of materials: the two of a blend, and the one behind, which may be IMPORT_BLACK */
    int blend, with, back;
    double weight;
    int weight_texture;
    int has_glass; /* of a blend: one of them lets light through */
} import_material;
import_material rt_import_material_begin(void);

/* Sets its roughness: alpha along u and along v. */
void rt_import_set_alphas(import_material *material, double u, double v);

/*
 * Makes kd rough as Oren and Nayar's surfaces are whose slopes deviate by this angle, in radians:
 * the lobe of the language, which keeps all light, of the same shape. It is told.
 */
void rt_import_make_rough(importer *import, int line, double deviation, import_material *m);

/*
 * Makes kd and its texture those of a metal, by Schlick's approximation, of roughness m->roughness;
 * or what lies below the coat of a plastic, of that roughness, which reflects f0 at normal
 * incidence and `strength` at grazing angles.
 */
void rt_import_make_metal(import_material *m);
void rt_import_make_plastic(import_material *m, double f0, double strength);

/*
 * Makes the facets of a metal below a coat of glTF or MTL, whose programs bend no light there, as
 * much less rough as the coat, which does, makes their highlight wider. It is told.
 */
void rt_import_settle_coated(importer *import, int line, import_material *m);

/* What is told of a plastic below one, with its reflectance. */
#define IMPORT_COATED_PLASTIC                                                                      \
    "a plastic below a clearcoat reflects %.3g at every angle: dark ones are up to 15 %% too dark"

/*
 * Makes glass of Blender, of roughness m->roughness, one of the principled material, as there from
 * version 4 on: each face has the root of the colour, which light that crosses both has then, and
 * reflects without it. factor: how much of it is glass.
 */
void rt_import_make_coloured_glass(import_material *m, double factor, const double base[3],
                                   int base_texture);

/* eta and k of a metal by its symbol, as Au, or its word in the language; whether it is known. */
int rt_import_metal(const char *name, double eta[3], double k[3]);
double rt_import_ior(rt_glass glass);

/* What a blend is made of: a material, which is added where it is a part, and its name. */
typedef struct import_part {
    const char *base;
    import_material material;
    int is_diffuse; /* that alone */
} import_part;

/*
 * Makes *out the blend of two materials: the second with this weight, times the texture, whose mean
 * is from 0 to 1, if there is one. What has no blend here is noted.
 */
void rt_import_blend(importer *import, int line, import_material *out, const import_part parts[2],
                     double weight, int weight_texture);

/*
 * Adds it; returns its handle. kd + ks + kt + diffuse_transmission above 1 are scaled down, with a
 * note.
 */
int rt_import_add_material(importer *import, int line, const char *base,
                           const import_material *material);

/* Whether any light comes to the inside, ... */
int rt_import_lets_light_through(const import_material *m);
int rt_import_is_solid(const import_material *m);   /* ... and is in another medium there */
int rt_import_is_nothing(const import_material *m); /* no surface, as if air were there */
int rt_import_is_pane(const import_material *m);    /* a sheet of clear glass without holes */

/* Fills all space with what is inside of a material. */
void rt_import_add_medium(importer *import, int line, const import_material *medium);

/*
 * Whether a material has an inside for a medium, which makes one that does nothing an interface;
 * that it has none is told.
 */
int rt_import_takes_medium(importer *import, int line, import_material *material);

/* A medium by name, per millimetre: preset.c. */
typedef struct import_preset {
    double absorption[3];
    double reduced[3];       /* scattering where it is taken as isotropic, ... */
    double scattering[3], g; /* ... and as it was measured, with the mean of the channels' g */
} import_preset;

/* Finds it, whatever the case of its name; returns 0 where there is none of this name. */
int rt_import_preset(const char *name, import_preset *out);

/* Writes into materials what shapes that may lie in others make of import->is_relative. */
void rt_import_settle_relative(importer *import);

/* Writes a grid of one channel or three, x first; `out` receives its name. */
int rt_import_write_grid(importer *import, char out[512], const uint32_t counts[3], size_t channels,
                         const float *voxels);

/*
 * A grid in a file, which `to_world` takes from the unit cube, and which is repeated outside of it;
 * layer: of a file of OpenVDB, which `to_world` takes from its own place, or NULL. Returns its
 * handle.
 */
int rt_import_add_grid(importer *import, const char *base, const char *file, const char *layer,
                       const matrix *to_world, int repeats);

/* The colours of meshes that a material shows, and the ramp that makes them, of its handle. */
import_colours rt_import_colours_of(const importer *import, int material);
import_ramp rt_import_ramp_of(const importer *import, int material);

/* Whether a material has a texture, or facets that are rougher in one direction. */
int rt_import_has_directions(const importer *import, int material);

/* Notes that u and v of such a shape are others, if its material has a texture or a direction. */
void rt_import_note_uv(importer *import, int line, int material, const char *shape);

/* Coordinates and entries of transforms of a scene lie within it. */
#define IMPORT_COORDINATE_MAX 1e15

/* And colours, and what moves the image of a texture. */
#define IMPORT_COLOUR_MAX 1e28
#define IMPORT_UV_MAX 1e9

enum { IMPORT_ATTRIBUTES_MAX = 8 }; /* of a mesh that is made here */

/* An attribute of vertices: the coordinates of textures, or a colour. */
typedef struct import_attribute {
    char name[IMPORT_NAME];
    int width;     /* 2 or 3 */
    float *values; /* [vertex_count][width] */
} import_attribute;

/* Arrays as those of rt_mesh_data; normals, uv and colours may be NULL. */
typedef struct import_mesh {
    float *positions, *normals, *uv, *colours;
    float *low; /* as positions: what these lose by rounding, for a mesh far away; or NULL */
    uint32_t *indices;
    size_t vertex_count, triangle_count;
    import_attribute more[IMPORT_ATTRIBUTES_MAX]; /* [more_count] */
    size_t more_count;
    int is_smooth; /* without normals: the scene smooths those of its faces */
} import_mesh;
void rt_import_mesh_free(import_mesh *mesh);

/* Turns all faces and normals over. */
void rt_import_mesh_turn(import_mesh *mesh);

/*
 * Has the scene smooth the normals of a mesh without any, where faces that differ meet at a vertex.
 * Returns whether they do; 0 after a failure.
 */
int rt_import_mesh_smooth(importer *import, import_mesh *mesh);

/* Notes that its colours, which multiply kd, are not seen on such a material, if they are not. */
void rt_import_note_colours(importer *import, int line, int material, const import_mesh *mesh);

/* Whether any triangle of it has an area; the scene takes no mesh without. */
int rt_import_mesh_has_area(const import_mesh *mesh);

/*
 * Whether its indices are within the vertices, and its numbers finite: what comes from a binary
 * file. Anything else ends the import.
 */
int rt_import_mesh_check(importer *import, int line, const import_mesh *mesh);

/* Writes a mesh to a file, and names it; returns its handle, IMPORT_NONE if it is not seen. */
int rt_import_add_mesh(importer *import, int line, const char *base, const import_mesh *mesh);

/*
 * Names a file that is a mesh already, as the new scene names it; returns its handle. shading: a
 * word of the language, or NULL for its default.
 */
int rt_import_add_mesh_file(importer *import, const char *base, const char *file,
                            const char *shading);

/* What a placed shape has. */
typedef struct import_surface {
    int material;
    double radiance[3]; /* all zero: that of the material */
    int texture;        /* of the radiance, or IMPORT_NONE */
    matrix to_world;
} import_surface;

/* Whether it has a radiance of its own. */
int rt_import_is_light(const import_surface *surface);

/*
 * Places a mesh, and returns whether it could; or a shape given by its block up to the surface, as
 * "sphere { centre 0 0 0".
 */
int rt_import_add_instance(importer *import, int line, int mesh, const import_surface *surface);
void rt_import_add_shape(importer *import, int line, const char *block, const double lo[3],
                         const double hi[3], const import_surface *surface);

/* Grows the bounds by the box of a placed shape. */
void rt_import_bound(importer *import, const matrix *to_world, const double lo[3],
                     const double hi[3]);

/* The camera; of what is not used 0. */
typedef struct import_camera {
    int is_orthographic;
    double eye[3], direction[3], up[3];
    double fov;   /* horizontal, degrees */
    double width; /* orthographic, metres */
    double aperture, focal_distance;
    double shift[2]; /* as that of the language */
    int is_mirrored;
} import_camera;

/*
 * Keeps the planes of the camera that is taken. The second, when all is placed and the places are
 * still there, tells those that cut the scene: no camera of the language has any.
 */
void rt_import_keep_clip(importer *import, int line, const import_plane planes[2],
                         const import_camera *camera);
void rt_import_note_clip(importer *import);
void rt_import_set_camera(importer *import, int line, const import_camera *camera);

/* Makes it see this part of its picture: from the left, from the top, width and height. */
void rt_import_crop_camera(import_camera *camera, const double part[4]);
/* radius: of the filter, pixels; 0: its own. */
void rt_import_set_film(importer *import, uint32_t width, uint32_t height, const char *filter,
                        double radius);

void rt_import_add_point_light(importer *import, int line, const double position[3],
                               const double intensity[3]);
/* The image of a light, or its IES file, by its name in the scene; NULL: none. */
typedef struct import_light_image {
    const char *file;
    double up[3];
    int is_nearest, repeats;
} import_light_image;

/* A spot light: half-angles in degrees, falloff: a word of the language. */
typedef struct import_spot {
    double position[3], direction[3], intensity[3];
    double inner, outer;
    const char *falloff;
    import_light_image image;
} import_spot;
void rt_import_add_spot_light(importer *import, int line, const import_spot *spot);

/* fov: horizontal, degrees; colour: irradiance at 1 m, or intensity. */
typedef struct import_projector {
    double position[3], direction[3], colour[3];
    double fov;
    int is_intensity;
    import_light_image image;
} import_projector;
void rt_import_add_projector(importer *import, int line, const import_projector *projector);

typedef struct import_goniometric {
    double position[3], direction[3], intensity[3];
    import_light_image image;
} import_goniometric;
void rt_import_add_goniometric(importer *import, int line, const import_goniometric *light);

/* width and height: of the cross section, an ellipse where it is round; up: along the height. */
typedef struct import_beam {
    double position[3], direction[3], up[3], width, height, irradiance[3];
    int is_round;
} import_beam;
void rt_import_add_beam(importer *import, int line, const import_beam *beam);

void rt_import_add_directional_light(importer *import, int line, const double direction[3],
                                     const double irradiance[3]);

/* A value of the language's setting `name`, from 1 to `most`; that it was brought there is told. */
int rt_import_bounded(importer *import, int line, const char *name, double value, int most);

/*
 * file NULL: constant. to_world: of the image as the language has it; NULL: none. Only its rotation
 * and mirroring count, and what else it does is told.
 */
void rt_import_set_environment(importer *import, int line, const double radiance[3],
                               const char *file, const matrix *to_world);

/* Of a rectangle: a corner, and the edges from it. */
void rt_import_add_portal(importer *import, const double corner[3], const double edge1[3],
                          const double edge2[3]);

/* Puts the sum of the even ones. */
void rt_import_put_even_sky(importer *import);

/*
 * As rt_import_image_file, for the image of an envmap of Mitsuba and for an octahedral one of
 * pbrt-v4, which become images of longitude and latitude; pbrt's z is up then, and its x in the
 * middle of the left edge. is_mirrored: left and right changed over.
 */
int rt_import_mitsuba_sky(importer *import, int line, char out[512], const char *name);
int rt_import_octahedral_sky(importer *import, int line, char out[512], const char *name,
                             int is_mirrored);

/* As rt_import_image_file, for an image that is turned over, and one that is mirrored. */
int rt_import_upended_image(importer *import, int line, char out[512], const char *name);
int rt_import_mirrored_image(importer *import, int line, char out[512], const char *name);

/* Writes a picture [height][width][3], its top row first, beside the scene; `out`: its name. */
int rt_import_write_picture(importer *import, char out[512], const char *name, const float *rgb,
                            uint32_t width, uint32_t height);

/*
 * The pixels of an image, linear, [height][width][3] from its top row, to be freed; size: width and
 * height. NULL: it cannot be read, which is told, with what it is the image of.
 */
float *rt_import_image_rgb(importer *import, int line, const char *name, const char *what,
                           uint32_t size[2]);

/* Width and height of an image in pixels; 0: it cannot be read, which is told. */
int rt_import_image_size(importer *import, int line, const char *name, uint32_t size[2]);

/* ---- The readers ----------------------------------------------------------------------------- */

/* Each reads the whole scene that import->path names, whose bytes end with a NUL. */
void rt_import_obj(importer *import, const char *text, size_t size);
void rt_import_gltf(importer *import, const char *bytes, size_t size);
void rt_import_mitsuba(importer *import, const char *text, size_t size);
void rt_import_pbrt(importer *import, const char *text, size_t size);

/* A mesh alone, of this extension. */
void rt_import_bare_mesh(importer *import, const char *extension, char *bytes, size_t size);

/* The value of a parameter that the user has set, which is marked as used; or NULL. */
const char *rt_import_parameter(importer *import, const char *name);

/* Fails where the scene has no such parameter. */
void rt_import_check_parameters(importer *import);

/*
 * Whether the next camera of the file is the one that is taken; of others that is noted. Its names
 * may be NULL. A number on the command line is that of a camera, whatever cameras are called.
 */
int rt_import_takes_camera(importer *import, int line, const char *name, const char *other);
/* Fails where the one that the user named was not among them. */
void rt_import_check_camera(importer *import);

/* ---- The whole ------------------------------------------------------------------------------- */

/* Reads by the format that the name and the bytes say, and completes what every scene needs. */
void rt_import_run(importer *import, char *bytes, size_t size);

/* The new scene, laid out, to be freed; NULL after a failure. */
char *rt_import_finish(importer *import);

/* The folder of a scene's meshes and textures: a/room_files for a/room.rts. To be freed. */
char *rt_import_files_path(const char *scene_path);

/* Begins; out_path: where the scene X.rts will be. The folder beside it is made where needed. */
int rt_import_begin(importer *import, const char *path, const char *out_path);

/* Removes the files that it wrote, and their folder, but for what was there before. */
void rt_import_remove_files(importer *import);
void rt_import_end(importer *import);

#endif
