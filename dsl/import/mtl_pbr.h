/* mtl_pbr.h - the PBR fields of MTL: those of the metallic and roughness workflow. */
#ifndef RT_DSL_IMPORT_MTL_PBR_H
#define RT_DSL_IMPORT_MTL_PBR_H

#include "dsl/import/import.h"

/* What a material gives; textures IMPORT_NONE for none. */
typedef struct mtl_pbr {
    double roughness, metallic;              /* Pr and Pm */
    double sheen, clearcoat, coat_roughness; /* Ps, Pc and Pcr */
    double anisotropy, rotation;             /* aniso and anisor, in turns */
    double level;                            /* of the reflection of plastics, 0.5: by Ni alone */
    double transmission;                     /* the mean of Tf */
    int roughness_texture, metallic_texture; /* map_Pr and map_Pm */
    int has_roughness, has_glass;            /* whether Pr and Tf are given */
    int is_sheet;                            /* its glass is a thin sheet */
} mtl_pbr;

/* Nothing given. */
mtl_pbr rt_mtl_pbr_begin(void);

/* Whether any field says that the material is one of these. */
int rt_mtl_is_pbr(const mtl_pbr *pbr);

/*
 * Makes the surface of a material whose base colour is kd and its texture, by the rules of
 * Blender's reader of MTL. line: that of its newmtl; name: its name, for notes.
 */
void rt_mtl_make_pbr(importer *import, int line, const char *name, const mtl_pbr *pbr,
                     import_material *m);

/* Whether an image holds unit normals rather than heights, by its pixels. */
int rt_mtl_holds_normals(importer *import, int line, const char *file);

#endif
