/* scope.h - all names that are known at a place of a scene text. */
#ifndef RT_DSL_SCOPE_H
#define RT_DSL_SCOPE_H

#include "dsl/names.h"
#include "dsl/report.h"
#include "dsl/schema.h"

/* Each kind of name by itself. All zero is none. */
typedef struct rt_scope {
    rt_names constants, materials, textures, grids, meshes;
} rt_scope;

/* How many names there are of each kind. */
typedef struct rt_scope_counts {
    size_t constants, materials, textures, grids, meshes;
} rt_scope_counts;

rt_scope_counts rt_scope_count(const rt_scope *scope);

/* Takes the names away that were defined since they were counted. */
void rt_scope_forget(rt_scope *scope, const rt_scope_counts *counts);

/*
 * Warns of names defined since that nothing uses: in the first text only, for included ones may be
 * libraries.
 */
#define RT_NEVER_USED "is never used" /* how these end */
void rt_scope_warn(const rt_scope *scope, const rt_scope_counts *counts, rt_reports *reports);

/* The table of the names that a field takes, or NULL. */
const rt_names *rt_scope_names(const rt_scope *scope, rt_field_type type);

/* What messages call such a name. */
const char *rt_scope_kind(rt_field_type type);

void rt_scope_free(rt_scope *scope);

#endif
