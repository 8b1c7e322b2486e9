/* rivals.c - a metal, a glass or a dispersion sets the index: a material does not give both. */
#include "dsl/rivals.h"

#include <string.h>

static const struct {
    const char *name; /* of a material */
    const char *sets; /* another of its fields, which the first one sets or rules out */
} rivals[] = {
    {"metal", "fresnel"}, {"metal", "eta"},   {"metal", "k"},
    {"metal", "ior"},     {"metal", "glass"}, {"glass", "fresnel"},
    {"glass", "ior"},     {"cauchy", "ior"},  {"sellmeier_b", "ior"},
};

static const rt_entry *find(const rt_statement *statement, const char *name)
{
    const rt_field *field = rt_schema_field(statement->block, (rt_text){name, strlen(name)});
    return field ? rt_statement_entry(statement, field) : NULL;
}

/* What a field sets, for a hint. */
static const char *set_by(const char *name)
{
    return strcmp(name, "metal") == 0   ? "'fresnel conductor', 'eta' and 'k'"
           : strcmp(name, "glass") == 0 ? "'fresnel dielectric' and 'ior'"
                                        : "'ior'";
}

static int has(const rt_material *m, const char *name)
{
    if (strcmp(name, "metal") == 0)
        return m->metal != RT_METAL_NONE;
    if (strcmp(name, "glass") == 0)
        return m->glass != RT_GLASS_NONE;
    return strcmp(name, "cauchy") == 0 ? m->cauchy[0] != 0 : m->sellmeier_b[0] != 0;
}

int rt_rivals_check(const rt_statement *statement, rt_reports *reports)
{
    int is_good = 1;
    if (statement->block->id != RT_BLOCK_MATERIAL)
        return 1;
    for (size_t i = 0; i < sizeof rivals / sizeof *rivals; i++) {
        const rt_entry *name = find(statement, rivals[i].name);
        const rt_entry *other = find(statement, rivals[i].sets);
        if (!name || !other)
            continue;
        rt_report_error(reports, other->name, "material takes '%s' or '%s', not both",
                        rivals[i].name, rivals[i].sets);
        if (strcmp(rivals[i].sets, "glass") != 0)
            rt_report_hint(reports, "'%s' sets %s", rivals[i].name, set_by(rivals[i].name));
        is_good = 0;
    }
    return is_good;
}

int rt_rivals_set(const rt_block *block, const rt_field *field, const rt_block_fields *fields)
{
    const rt_material *m = &fields->material;
    for (size_t i = 0; i < sizeof rivals / sizeof *rivals && block->id == RT_BLOCK_MATERIAL; i++)
        if (strcmp(rivals[i].sets, field->name) == 0 && has(m, rivals[i].name))
            return 1;
    return 0;
}
