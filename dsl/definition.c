/* definition.c - constants that the caller sets in place of what their `let` gives them. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "dsl/reader.h"
#include "dsl/suggest.h"

/* Reads "let NAME = VALUE" as a text of its own. */
static void read_definition(rt_reader *reader, const rt_definition *definition)
{
    const char *cause = "";
    const size_t size = strlen(definition->name) + strlen(definition->value) + sizeof "let  = ";
    char *text = malloc(size);
    const char *name = reader->options->definition_name;
    rt_source *source = rt_sources_add(&reader->sources, name ? name : "definition", NULL);
    if (text)
        snprintf(text, size, "let %s = %s", definition->name, definition->value);
    if (!text || !source ||
        rt_source_copy(&reader->sources, source, text, &cause) == RT_ERROR_MEMORY) {
        reader->reports.out_of_memory = 1;
    } else if (*cause || strpbrk(text, "\r\n")) {
        const rt_place whole = {source, 0, 0, 0, 0, 0};
        rt_report_error(&reader->reports, whole, "cannot read the definition: %s",
                        *cause ? cause : "it has more than one line");
    } else {
        reader->is_defining = 1;
        rt_reader_read(reader, source);
        reader->is_defining = 0;
    }
    free(text);
}

void rt_reader_read_definitions(rt_reader *reader)
{
    for (size_t i = 0; i < reader->options->definition_count; i++)
        read_definition(reader, &reader->options->definitions[i]);
}

void rt_reader_report_unmet(rt_reader *reader)
{
    const rt_names *constants = &reader->scope.constants;
    for (size_t i = 0; i < constants->count && i < reader->options->definition_count; i++) {
        char quote[RT_QUOTE_SIZE];
        const rt_name *name = &constants->items[i];
        if (!name->is_awaited || name->is_broken)
            continue;
        rt_suggestion suggestion = rt_suggestion_begin(name->text);
        for (size_t other = 0; other < constants->count; other++)
            if (!constants->items[other].is_awaited)
                rt_suggestion_offer(&suggestion, constants->items[other].text);
        rt_report_error(&reader->reports, name->place, "the scene has no constant '%s'",
                        rt_text_quote(quote, name->text));
        char field[64];
        snprintf(field, sizeof field, "%.*s", (int)name->text.length, name->text.at);
        const char *const block = rt_field_block(field);
        const rt_setting *const setting = rt_setting_find(field);
        if (setting)
            rt_report_hint(&reader->reports,
                           "'%s' is a setting, no constant: use the option of its name", field);
        else if (suggestion.best.at)
            rt_report_hint(&reader->reports, "did you mean '%s'?",
                           rt_text_quote(quote, suggestion.best));
        else if (block)
            rt_report_hint(&reader->reports,
                           "'%s' is a field of %s: 'let %s = VALUE' in the scene, and '%s { ... %s "
                           "(%s) }', make it a constant",
                           field, block, field, block, field, field);
        else
            rt_report_hint(&reader->reports, "a scene defines it by 'let NAME = VALUE'");
    }
}
