/* gltf.h - what the parts of the reader of glTF 2.0 share. */
#ifndef RT_DSL_IMPORT_GLTF_H
#define RT_DSL_IMPORT_GLTF_H

#include <cjson/cJSON.h>

#include "dsl/import/import.h"

/* An array of the file, so that any item is found at once. */
typedef struct gltf_list {
    cJSON **items;
    size_t count;
} gltf_list;

/* componentType of an accessor. */
enum { GLTF_DEPTH_MAX = 512 }; /* of nodes inside each other */
enum { GLTF_UNSIGNED_BYTE = 5121, GLTF_UNSIGNED_SHORT = 5123, GLTF_FLOAT = 5126 };

typedef enum gltf_array {
    GLTF_SCENES,
    GLTF_NODES,
    GLTF_MESHES,
    GLTF_MATERIALS,
    GLTF_TEXTURES,
    GLTF_IMAGES,
    GLTF_SAMPLERS,
    GLTF_ACCESSORS,
    GLTF_VIEWS,
    GLTF_BUFFERS,
    GLTF_CAMERAS,
    GLTF_SKINS,
    GLTF_LIGHTS,
    GLTF_ARRAY_COUNT
} gltf_array;

typedef struct gltf_bytes {
    char *owned; /* to be freed, or NULL */
    const unsigned char *at;
    size_t size;
} gltf_bytes;

typedef struct gltf_primitive {
    int mesh, material; /* handles */
    double lo[3], hi[3];
} gltf_primitive;

typedef struct gltf_mesh {
    gltf_primitive *primitives; /* those that have a mesh */
    size_t count;
    int is_read;
} gltf_mesh;

/* Vertices, in increasing order, of the `of` that an accessor has. */
typedef struct gltf_selection {
    uint32_t *vertices;
    size_t count, of;
} gltf_selection;

typedef struct gltf {
    importer *import;
    cJSON *root;
    int is_blender; /* the file is by Blender */
    gltf_list lists[GLTF_ARRAY_COUNT];
    const unsigned char *chunk; /* the binary chunk of a .glb, or NULL */
    size_t chunk_size;
    gltf_bytes *buffers; /* [lists[GLTF_BUFFERS].count], read when first asked for */
    /*
     * [materials + 1] handles, without colours of vertices and with, and likewise of sheets; the
     * last are those of none; IMPORT_NONE: not yet
     */
    int (*materials)[2][2];
    char (*images)[512];    /* [images] file names; "" not yet, "?" left out */
    char *has_alpha;        /* [images] of those: whether they hold opacities */
    gltf_mesh *meshes;      /* [meshes] */
    gltf_mesh posed;        /* that of the node which is placed, where its pose is its own */
    size_t *parents;        /* [nodes], SIZE_MAX: none; NULL: not yet known */
    unsigned char *on_path; /* [nodes] whether a node is around the one that is read */
    size_t visits, lights;
    const gltf_selection *wanted; /* what is read of the accessors of a primitive; NULL: all */
    unsigned own_set;             /* gltf_sets.own of the material that is read */
    size_t members;               /* that were read of long objects */
    uint64_t size, read; /* bytes of the file and its buffers; what was read of them, repeats too */
} gltf;

/* ---- Values of the file: gltf_json.c --------------------------------------------------------- */

static inline const cJSON *gltf_get(const cJSON *object, const char *name)
{
    return object ? cJSON_GetObjectItemCaseSensitive(object, name) : NULL;
}

/* An extension of an object, or NULL. */
const cJSON *rt_gltf_extension(const cJSON *object, const char *name);

/*
 * Counts the members of an object that may be read again, as each of them takes time whenever one
 * is looked for. The first few are free: they cost no more than what names the object. The import
 * fails where there are too many.
 */
void rt_gltf_count(gltf *g, const cJSON *object);

/*
 * An item of an array of the file, whose members are counted; NULL after a failure. `what` tells
 * who asks.
 */
const cJSON *rt_gltf_item(gltf *g, gltf_array array, size_t index, const char *what);

/* From here on messages are about an item of an array; returns where they were before. */
import_place rt_gltf_enter(gltf *g, gltf_array array, size_t index);

/*
 * A whole number of an object: 1 if it is there, 0 if not; the import fails where it is no whole
 * number from 0 to 2^53.
 */
int rt_gltf_whole(gltf *g, const cJSON *object, const char *name, uint64_t *out);

/* A list of an object, or NULL; the import fails where the member is anything else. */
const cJSON *rt_gltf_array_of(gltf *g, const cJSON *object, const char *name);

/* A number of an object, finite, or the fallback; it is told where it is anything else. */
double rt_gltf_number(gltf *g, const cJSON *object, const char *name, double fallback);

/*
 * `count` numbers, at most GLTF_NUMBERS_MAX; returns whether they are there: anything else is told,
 * and leaves *out as it is.
 */
enum { GLTF_NUMBERS_MAX = 16 };
int rt_gltf_numbers(gltf *g, const cJSON *object, const char *name, double *out, int count);

/* Whether a member is true, or the fallback; it is told where it is neither true nor false. */
int rt_gltf_flag(gltf *g, const cJSON *object, const char *name, int fallback);

/* Tells what stands twice in an object of the list that the item begins, and inside of these. */
void rt_gltf_note_twice(gltf *g, const cJSON *item);

/* The text of a member, or NULL. */
const char *rt_gltf_string(const cJSON *object, const char *name);

/* ---- Bytes: gltf_bytes.c --------------------------------------------------------------------- */

/* Counts numbers or bytes that are read or copied; returns 0 after a failure: they are too many. */
int rt_gltf_count_read(gltf *g, size_t count);

/* The bytes of a buffer view; 0 after a failure. stride: between elements, or 0. */
int rt_gltf_view(gltf *g, uint64_t index, const unsigned char **at, size_t *size, size_t *stride);

/*
 * The bytes of a `uri`, of a file or in itself, to be freed; NULL after a failure, or where a file
 * is not there and its use is `optional`, as "the image": it is told then.
 */
char *rt_gltf_uri(gltf *g, const char *uri, const char *optional, size_t *size);

/*
 * An accessor as floats [count][components], to be freed; NULL after a failure. components: how
 * many are wanted; the accessor may have one more, which is left out. count: given if not 0, else
 * written. Of vertices that are wanted these alone.
 */
float *rt_gltf_floats(gltf *g, uint64_t accessor, int components, size_t *count);

/* An accessor of indices, to be freed. */
uint32_t *rt_gltf_indices(gltf *g, uint64_t accessor, size_t *count);

/* ---- What no reader asks for: gltf_unread.c -------------------------------------------------- */

typedef enum gltf_kind {
    GLTF_IS_SCENE,
    GLTF_IS_NODE,
    GLTF_IS_MESH,
    GLTF_IS_PRIMITIVE,
    GLTF_IS_LIGHT,
    GLTF_IS_MATERIAL,
    GLTF_IS_METAL,
    GLTF_IS_TEXTURE_INFO,
    GLTF_IS_TEXTURE
} gltf_kind;

/* Tells of what an object has that is not read, as of names with a typing error. NULL: nothing. */
void rt_gltf_note_unread(gltf *g, gltf_kind kind, const cJSON *object);

/* ---- Materials: gltf_material.c, meshes: gltf_mesh.c ----------------------------------------- */

/*
 * The handle of a material; index -1: that of a primitive without one. has_colours: 1 for one of
 * meshes whose vertices have the attribute GLTF_COLOURS, which the base colour is multiplied by;
 * else 0. is_sheet: 1 for glass that bounds no solid, which rt_gltf_may_be_sheet allows; else 0.
 */
#define GLTF_COLOURS "color"
int rt_gltf_material(gltf *g, int64_t index, int has_colours, int is_sheet);
int rt_gltf_may_be_sheet(gltf *g, int64_t index);

/*
 * The sets of texture coordinates that the textures of a material name: `own`, that of its base
 * colour or else of its first, is u and v of its meshes; bit i of `others`: set i is an attribute
 * of theirs, which rt_gltf_set_name names.
 */
enum { GLTF_SETS = 8 };
typedef struct gltf_sets {
    unsigned own, named; /* named: a bit for each, own too where a texture names it */
} gltf_sets;
gltf_sets rt_gltf_texture_sets(gltf *g, int64_t material);
const char *rt_gltf_set_name(unsigned set);

/* The primitives of a node's mesh, in its pose, until the next one is asked for; NULL: failed. */
const gltf_mesh *rt_gltf_read_mesh(gltf *g, uint64_t index, const cJSON *node);

/* ---- Places and poses: gltf_pose.c ----------------------------------------------------------- */

/* A translation, by a rotation x, y, z, w, by a scale. */
matrix rt_gltf_placed(const double t[3], const double q[4], const double s[3]);

/* The transform of a node within that around it. */
matrix rt_gltf_node_matrix(gltf *g, const cJSON *node);

/* [nodes], the node that each is a child of, SIZE_MAX: none; NULL after a failure. */
const size_t *rt_gltf_parents(gltf *g);

/* What a mesh is changed by, beside its transform; either may be NULL. */
typedef struct gltf_pose {
    const cJSON *weights; /* of its morph targets */
    const cJSON *skin;
} gltf_pose;

/*
 * Adds the weighted attribute of a primitive's morph targets to values [count][components], that of
 * the primitive; NULL: it has none.
 */
void rt_gltf_morph(gltf *g, const gltf_pose *pose, const cJSON *primitive, const char *name,
                   int components, float *values, size_t count);

/* Brings the positions and normals of a primitive into a pose. */
void rt_gltf_pose(gltf *g, const gltf_pose *pose, const cJSON *primitive, import_mesh *mesh);

#endif
