/* scope.c - counts, forgets and warns of names. */
#include "dsl/scope.h"

#define UNUSED_MAX 100 /* names of one table that are warned of */

rt_scope_counts rt_scope_count(const rt_scope *scope)
{
    rt_scope_counts counts = {scope->constants.count, scope->materials.count, scope->textures.count,
                              scope->grids.count, scope->meshes.count};
    return counts;
}

void rt_scope_forget(rt_scope *scope, const rt_scope_counts *counts)
{
    rt_names_truncate(&scope->constants, counts->constants);
    rt_names_truncate(&scope->materials, counts->materials);
    rt_names_truncate(&scope->textures, counts->textures);
    rt_names_truncate(&scope->grids, counts->grids);
    rt_names_truncate(&scope->meshes, counts->meshes);
}

static void warn_of_unused(rt_reports *reports, const rt_names *names, size_t first,
                           const char *what)
{
    char quote[RT_QUOTE_SIZE];
    int warned = 0;
    for (size_t i = first; i < names->count && warned < UNUSED_MAX; i++) {
        const rt_name *name = &names->items[i];
        if (name->is_used || name->place.source->includer)
            continue;
        rt_report_warning(reports, name->place, "%s '%s' " RT_NEVER_USED, what,
                          rt_text_quote(quote, name->text));
        warned++;
    }
}

void rt_scope_warn(const rt_scope *scope, const rt_scope_counts *counts, rt_reports *reports)
{
    warn_of_unused(reports, &scope->constants, counts->constants, "constant");
    warn_of_unused(reports, &scope->materials, counts->materials, "material");
    warn_of_unused(reports, &scope->textures, counts->textures, "texture");
    warn_of_unused(reports, &scope->grids, counts->grids, "grid");
    warn_of_unused(reports, &scope->meshes, counts->meshes, "mesh");
}

void rt_scope_free(rt_scope *scope)
{
    rt_names_free(&scope->constants);
    rt_names_free(&scope->materials);
    rt_names_free(&scope->textures);
    rt_names_free(&scope->grids);
    rt_names_free(&scope->meshes);
}

const rt_names *rt_scope_names(const rt_scope *scope, rt_field_type type)
{
    return type == RT_FIELD_MATERIAL  ? &scope->materials
           : type == RT_FIELD_PART    ? &scope->materials
           : type == RT_FIELD_TEXTURE ? &scope->textures
           : type == RT_FIELD_GRID    ? &scope->grids
                                      : NULL;
}

const char *rt_scope_kind(rt_field_type type)
{
    return type == RT_FIELD_MATERIAL || type == RT_FIELD_PART ? "material"
           : type == RT_FIELD_TEXTURE                         ? "texture"
                                                              : "grid";
}
