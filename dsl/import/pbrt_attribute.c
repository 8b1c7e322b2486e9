/*
 * pbrt_attribute.c - Attribute of pbrt-v4: parameters that later directives have where they do not
 * give them themselves, up to the end of the block. The latest of a name counts.
 */
#include <stdlib.h>
#include <string.h>

#include "dsl/import/pbrt.h"

enum { ATTRIBUTES_MAX = 256 }; /* at any place of a scene */

struct pbrt_attribute {
    pbrt_param param;
    const char *target; /* a word of `uses` */
    pbrt_place place;
    int is_given;          /* some directive could have had it */
    pbrt_attribute *older; /* the next one at this place of the scene */
    pbrt_attribute *next;  /* of all that there are, to be freed */
};

/* Which directives take those of which target. */
static const struct {
    const char *directive, *target;
} uses[] = {{"Shape", "shape"},           {"LightSource", "light"},
            {"AreaLightSource", "light"}, {"Material", "material"},
            {"Texture", "texture"},       {"MakeNamedMaterial", "material"},
            {"MakeNamedMedium", "medium"}};

enum { USE_COUNT = sizeof uses / sizeof *uses };

/* Takes the values of a parameter. */
static void keep(pbrt *p, pbrt_param *param, const char *target)
{
    pbrt_attribute *const made = calloc(1, sizeof *made);
    if (!made) {
        rt_import_fail_memory(p->import);
        return;
    }
    made->param = *param;
    param->numbers = NULL;
    param->strings = NULL;
    made->target = target;
    made->place = rt_pbrt_here(&p->tokens);
    made->older = p->state.attributes;
    made->next = p->attributes;
    p->attributes = p->state.attributes = made;
    if (++p->state.attribute_count > ATTRIBUTES_MAX)
        rt_import_fail(p->import, param->line, "more than %d parameters of Attribute",
                       ATTRIBUTES_MAX);
}

void rt_pbrt_read_attribute(pbrt *p)
{
    char target[PBRT_TEXT];
    pbrt_params params;
    int i = 0;
    if (!rt_pbrt_take_string(p, "Attribute", target))
        return;
    while (i < USE_COUNT && strcmp(uses[i].target, target) != 0)
        i++;
    if (i == USE_COUNT)
        rt_import_note_at(p->import, rt_pbrt_line(&p->tokens),
                          "an Attribute of '%.40s' is left out", target);
    rt_pbrt_read_params(&params, &p->tokens);
    for (int k = 0; k < params.count && i < USE_COUNT && !p->import->failed; k++)
        keep(p, &params.items[k], uses[i].target);
    rt_pbrt_free_params(&params);
}

static int has_name(const pbrt_params *params, const char *name)
{
    for (int i = 0; i < params->count; i++)
        if (strcmp(params->items[i].name, name) == 0)
            return 1;
    return 0;
}

void rt_pbrt_add_attributes(pbrt *p, pbrt_params *params, const char *directive)
{
    int i = 0;
    while (i < USE_COUNT && strcmp(uses[i].directive, directive) != 0)
        i++;
    for (pbrt_attribute *at = p->state.attributes; at && i < USE_COUNT; at = at->older) {
        if (strcmp(at->target, uses[i].target) != 0 || has_name(params, at->param.name))
            continue;
        if (params->count == PBRT_PARAMS_MAX) {
            rt_import_fail(p->import, params->line, "more than %d parameters", PBRT_PARAMS_MAX);
            return;
        }
        at->is_given = 1;
        pbrt_param *const lent = &params->items[params->count++];
        *lent = at->param;
        lent->line = params->line;
        lent->of = &at->param;
    }
}

void rt_pbrt_note_attributes(pbrt *p)
{
    const pbrt_place here = rt_pbrt_here(&p->tokens);
    for (const pbrt_attribute *at = p->attributes; at; at = at->next)
        if (at->is_given && !at->param.is_used)
            rt_import_note_at(p->import, rt_pbrt_at(p->import, at->place),
                              "\"%s %s\" of an Attribute is left out", at->param.type,
                              at->param.name);
    rt_pbrt_at(p->import, here);
}

void rt_pbrt_free_attributes(pbrt *p)
{
    while (p->attributes) {
        pbrt_attribute *const at = p->attributes;
        p->attributes = at->next;
        free(at->param.numbers);
        free(at->param.strings);
        free(at);
    }
}
