/* obj_data.h - the vertices and faces of an OBJ file. */
#ifndef RT_DSL_IMPORT_OBJ_DATA_H
#define RT_DSL_IMPORT_OBJ_DATA_H

#include "dsl/import/mtl.h"
#include "dsl/import/mtl_line.h"

/* Positions in the arrays, from 0; texture coordinates and normals OBJ_NONE where not given. */
typedef struct obj_corner {
    uint32_t position, uv, normal;
} obj_corner;

#define OBJ_NONE ((uint32_t)0xffffffff)

typedef struct obj_array {
    float *values;
    size_t count, capacity; /* in numbers */
} obj_array;

/* A face while it is read. */
typedef struct obj_polygon {
    obj_corner *corners;
    double *points;      /* [count][3] */
    uint32_t *triangles; /* [count - 2][3], numbers of corners */
    size_t count, capacity;
} obj_polygon;

/* All zero is empty. */
typedef struct obj_data {
    obj_array positions, uv, normals;
    obj_array low;       /* as positions: what these lose by rounding */
    obj_array colours;   /* by position, linear; empty where no vertex has one */
    obj_corner *corners; /* three for each triangle */
    int *groups;         /* of each triangle: which use of a material it belongs to */
    uint32_t *smooth;    /* of each triangle: its group of smoothing, or 0 */
    size_t triangle_count, triangle_capacity;
    uint32_t *order;                /* the triangles, group by group */
    size_t *starts;                 /* of each group in there, and behind the last one */
    name_table materials;           /* by group */
    int *lines;                     /* [materials] where each is first used */
    int group;                      /* of the next triangle, */
    uint32_t smoothing;             /* its group of smoothing too */
    int is_uv_told, is_normal_told; /* that corners name some that are not there */
    int is_vt_told, is_vn_told;     /* that one is none */
    int is_colour_told;             /* that a colour is negative */
    int is_bytes;                   /* colours go to 255 */
    obj_polygon polygon;
} obj_data;

/* Makes room for one more corner, and what it may become. Returns 0 after a failure. */
int rt_obj_polygon_grow(importer *import, obj_polygon *polygon);

/* Cuts data->polygon as the library does, and tells where it is not simple. */
void rt_obj_polygon_cut(importer *import, obj_data *data, int line_number);
void rt_obj_polygon_free(obj_polygon *polygon);

/*
 * Gives normals to the corners that have none: of a group of smoothing the mean of its faces around
 * the position, weighted by their angles there; else the one of the face, if others of its mesh
 * have some.
 */
void rt_obj_fill_normals(importer *import, obj_data *data);

/* Adds one to data->normals. */
void rt_obj_push_normal(importer *import, obj_data *data, const double normal[3]);

/* Reads an OBJ text, which is taken apart; list NULL: materials and colours are passed over. */
void rt_import_obj_read(importer *import, obj_data *data, mtl_list *list, char *text);

/* The triangles of a group as a mesh. Returns 0 after a failure. */
int rt_import_obj_mesh(importer *import, import_mesh *out, const obj_data *data, int group);

void rt_import_obj_free(obj_data *data);

#endif
