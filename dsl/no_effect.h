/* no_effect.h - fields that are given but have no effect beside the others of their block. */
#ifndef RT_DSL_NO_EFFECT_H
#define RT_DSL_NO_EFFECT_H

#include "dsl/scope.h"
#include "dsl/statement.h"

/*
 * Makes zero mean zero where the library takes it for a field left out: textures that it multiplies
 * are dropped. Returns 0 for a light of an image or a table that it makes dark: it is not built.
 * Warns of both unless reports is NULL.
 */
int rt_no_effect_settle(const rt_statement *statement, rt_block_fields *fields,
                        rt_reports *reports);

/* Warns of each such field of a sound block, whose values are in fields. */
void rt_no_effect_warn(const rt_statement *statement, const rt_block_fields *fields,
                       const rt_scope *scope, rt_reports *reports);

/* Warns that the materials which the file of a mesh names are left out. */
void rt_no_effect_warn_materials(const rt_statement *statement, rt_reports *reports);

/* Warns that the file of a mesh goes on after what its header announces. */
void rt_no_effect_warn_rest(const rt_statement *statement, rt_reports *reports);

/* Passes on what else the file of a mesh says that cannot be done. */
void rt_no_effect_warn_mesh(const rt_statement *statement, const rt_mesh_warnings *warnings,
                            rt_reports *reports);

/* Whether a field of a block can have an effect beside the others, by what is known of them. */
int rt_field_has_effect(const rt_block *block, const rt_field *field,
                        const rt_block_fields *fields);

/* Whether the fields of a material make it reflect diffusely, and emit. */
int rt_block_has_kd(const rt_block_fields *fields);
int rt_block_emits(const rt_block_fields *fields);

#endif
