/* mtl.h - the materials of OBJ files. */
#ifndef RT_DSL_IMPORT_MTL_H
#define RT_DSL_IMPORT_MTL_H

#include "dsl/import/import.h"
#include "dsl/import/mtl_pbr.h"
#include "dsl/import/names.h"

/* Of the files of a scene. */
enum {
    MTL_MATERIALS_MAX = 10000,
    MTL_MAPS_MAX = 30000,
    MTL_LIBRARIES_MAX = 1000,
    MTL_SPLIT_MAX = 10000
};

/* Glass of Blender, which is a sheet where its mesh does not close. */
typedef struct mtl_glass {
    int solid, sheet;         /* handles; sheet IMPORT_NONE: not yet */
    int library;              /* of `libraries`, where it is, */
    int line;                 /* and its line there */
    import_material material; /* what pbr makes glass of */
    mtl_pbr pbr;
} mtl_glass;

/* A material of Blender whose Kd is its default, 0.8, as it is beside colours of vertices. */
typedef struct mtl_default {
    int plain, coloured; /* handles; coloured, of Kd 1: IMPORT_NONE: not yet */
    int library, line;   /* as of mtl_glass */
    import_material material;
} mtl_default;

/* All zero is empty. */
typedef struct mtl_list {
    name_table names, bare;          /* bare: those with a comment, without it */
    int *materials, *bare_materials; /* their handles */
    int begun; /* how many newmtl there were, those of a name that is there among them */
    int maps;
    name_table libraries; /* the files that were read */
    int split;            /* how many were named several on a line */
    mtl_glass *glass;     /* [glass_count] */
    size_t glass_count;
    mtl_default *defaults; /* [default_count] */
    size_t default_count;
} mtl_list;

/* Adds the materials of the MTL text of a file, which is taken apart. */
void rt_mtl_read(importer *import, mtl_list *list, const char *file, char *text);

/*
 * The material of that name, or IMPORT_NONE. Where no material has the whole name, a # after a
 * blank begins a comment, in this name and in those of the materials.
 */
int rt_mtl_find(importer *import, const mtl_list *list, const char *name);

/* The sheet of a material of this name by its handle, or IMPORT_NONE where that can be none. */
int rt_mtl_sheet(importer *import, mtl_list *list, int solid, const char *name);
int rt_mtl_may_be_sheet(const mtl_list *list, int solid);

/*
 * What a material of this name becomes on a mesh whose vertices have colours: itself, but white in
 * place of the default of Blender, which writes that where the colour is that of the vertices.
 */
int rt_mtl_coloured(importer *import, mtl_list *list, int handle, const char *name);

void rt_mtl_free(mtl_list *list);

#endif
