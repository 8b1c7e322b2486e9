/* mitsuba.h - what the parts of the reader of Mitsuba 3 scenes share. */
#ifndef RTC_IMPORT_MITSUBA_H
#define RTC_IMPORT_MITSUBA_H

#include "xml.h"

/* A value of <default>. */
typedef struct mitsuba_default {
    const char *name, *value;
} mitsuba_default;

/* A material that was made, by the element that describes it. */
typedef struct mitsuba_made {
    const xml_node *node;
    int is_emitter, handle;
} mitsuba_made;

/* A file of meshes that was copied. */
typedef struct mitsuba_mesh {
    char *name;
    int index, is_smooth, handle;
    double lo[3], hi[3];
} mitsuba_mesh;

typedef struct mitsuba {
    importer *import;
    xml_node **files; /* the roots of all files read */
    size_t file_count;
    const xml_node **named; /* elements with an id */
    size_t named_count, named_capacity;
    mitsuba_default *defaults;
    size_t default_count;
    mitsuba_made *made;
    size_t made_count;
    mitsuba_mesh *meshes;
    size_t mesh_count;
    int depth; /* of includes, references and groups */
} mitsuba;

/* ---- Values: mitsuba_value.c ----------------------------------------------------------------- */

/* The text of an attribute, its $name replaced; "" where it is not there. */
const char *mitsuba_text(mitsuba *m, const xml_node *node, const char *attribute);

/* The child with this name="..." attribute, or NULL; camelCase counts as snake_case. */
const xml_node *mitsuba_child(mitsuba *m, const xml_node *node, const char *name);

double mitsuba_number(mitsuba *m, const xml_node *node, const char *name, double fallback);
int mitsuba_flag(mitsuba *m, const xml_node *node, const char *name, int fallback);
const char *mitsuba_string(mitsuba *m, const xml_node *node, const char *name);
int mitsuba_vector(mitsuba *m, const xml_node *node, const char *name, double out[3]);

/* A colour that is no texture; returns whether it is there. */
int mitsuba_colour(mitsuba *m, const xml_node *node, const char *name, double out[3]);

/* The transform of that name, or the identity. */
matrix mitsuba_transform(mitsuba *m, const xml_node *node, const char *name);

/* Whether two names are one, camelCase counting as snake_case. */
int mitsuba_is(const char *written, const char *name);

/* What a <ref> names, or the element itself; NULL after a failure. */
const xml_node *mitsuba_follow(mitsuba *m, const xml_node *node);

/* ---- Materials: mitsuba_bsdf.c --------------------------------------------------------------- */

/* The material of a shape: its <bsdf> or <ref>; without one, grey, or black of an emitter. */
int mitsuba_material(mitsuba *m, const xml_node *shape, int is_emitter);

/* A texture as an element, or IMPORT_NONE; a constant goes into *out. */
int mitsuba_texture(mitsuba *m, const xml_node *node, const char *name, double out[3]);

/* ---- Emitters: mitsuba_emitter.c, shapes: mitsuba_shape.c ------------------------------------ */

void mitsuba_emitter(mitsuba *m, const xml_node *node);
void mitsuba_sensor(mitsuba *m, const xml_node *node);

/* A shape in the frame of a group, within `depth` groups. */
void mitsuba_shape(mitsuba *m, const xml_node *node, const matrix *around);

#endif
