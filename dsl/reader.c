#include "dsl/reader.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "dsl/build.h"
#include "dsl/check.h"
#include "dsl/parser.h"

rt_status rt_reader_begin(rt_reader *reader, rt_error *error)
{
    memset(reader, 0, sizeof *reader);
    return rt_scene_create(&reader->scene, error);
}

void rt_reader_free(rt_reader *reader)
{
    rt_scene_destroy(reader->scene);
    rt_names_free(&reader->constants);
    rt_names_free(&reader->materials);
    rt_reports_free(&reader->reports);
    rt_sources_free(&reader->sources);
}

static int must_stop(const rt_reader *reader)
{
    return rt_reports_full(&reader->reports) || reader->fatal.status != RT_OK;
}

#define UNUSED_MAX 100 /* names of one table that are warned of */

/* ---- Names --------------------------------------------------------------- */

/* Adds a name to a table; NULL when it is there already, which is reported, or without memory. */
static rt_name *define(rt_reader *reader, rt_names *names, rt_place place, const char *what)
{
    char quote[RT_QUOTE_SIZE];
    rt_text text = rt_place_text(&place);
    size_t found = rt_names_find(names, text);
    if (found != RT_NAME_NONE) {
        const rt_place *first = &names->items[found].place;
        rt_report_error(&reader->reports, place, "%s '%s' is defined twice", what, rt_text_quote(quote, text));
        rt_report_hint(&reader->reports, "first at %s:%d", first->source->path, first->line);
        return NULL;
    }
    rt_name *name = rt_names_add(names, place);
    if (!name)
        reader->reports.out_of_memory = 1;
    return name;
}

static void read_let(rt_reader *reader, const rt_statement *statement, const rt_operations *operations)
{
    rt_value value = {{0, 0, 0}, statement->value.is_vector};
    int is_good = !statement->is_broken && rt_expression_evaluate(&value, &statement->value, operations,
                                                                  &reader->constants, &reader->reports);
    rt_name *name = define(reader, &reader->constants, statement->name, "constant");
    if (name) {
        name->value = value;
        name->is_broken = !is_good;
    }
}

/* A name that the first text defines and nothing uses is perhaps misspelt; included files may be libraries. */
static void warn_of_unused(rt_reader *reader, const rt_names *names, const char *what)
{
    char quote[RT_QUOTE_SIZE];
    int warned = 0;
    for (size_t i = 0; i < names->count && warned < UNUSED_MAX; i++) {
        const rt_name *name = &names->items[i];
        if (name->is_used || name->place.source->includer)
            continue;
        rt_report_warning(&reader->reports, name->place, "%s '%s' is never used", what,
                          rt_text_quote(quote, name->text));
        warned++;
    }
}

/* ---- Blocks -------------------------------------------------------------- */

/* Reports a second block where one is allowed. */
static int check_once(rt_reader *reader, const rt_statement *statement)
{
    char title[RT_BLOCK_TITLE_SIZE];
    rt_place *first = &reader->once[statement->block->id];
    if (!(statement->block->flags & RT_BLOCK_ONCE))
        return 1;
    if (first->length == 0) {
        *first = statement->place;
        return 1;
    }
    rt_report_error(&reader->reports, statement->place, "a scene has only one %s",
                    rt_block_title(title, statement->block));
    rt_report_hint(&reader->reports, "the first is at %s:%d", first->source->path, first->line);
    return 0;
}

/* Points at the field that the scene refused, or else at the block. */
static void report_refusal(rt_reader *reader, const rt_statement *statement, const rt_error *error)
{
    rt_text name = {error->field, strlen(error->field)};
    const rt_field *field = rt_schema_field(statement->block, name);
    const rt_setting *setting = field ? rt_statement_setting(statement, field) : NULL;
    rt_place place = statement->place;
    if (setting && setting->value_count > 0)
        place = rt_place_join(setting->values[0].place, setting->values[setting->value_count - 1].place);
    else if (setting)
        place = setting->word;
    rt_report_error(&reader->reports, place, "%s", error->message);
}

/* Builds a block; returns whether the scene took it. */
static int build(rt_reader *reader, const rt_statement *statement, const rt_block_fields *fields, uint32_t *material)
{
    rt_text text = statement->name.source ? rt_place_text(&statement->name) : (rt_text){"", 0};
    char *name = malloc(text.length + 1);
    if (!name) {
        reader->reports.out_of_memory = 1;
        return 0;
    }
    memcpy(name, text.at, text.length);
    name[text.length] = '\0';

    rt_error error;
    rt_status status = rt_build_block(reader->scene, statement->block, fields, name, material, &error);
    free(name);
    if (status == RT_ERROR_INPUT || status == RT_ERROR_USAGE)
        report_refusal(reader, statement, &error);
    else if (status != RT_OK)
        reader->fatal = error;
    return status == RT_OK;
}

static void read_block(rt_reader *reader, const rt_statement *statement, const rt_operations *operations)
{
    rt_checker checker = {&reader->reports, operations, &reader->constants, &reader->materials};
    rt_block_fields fields;
    uint32_t material = 0;
    reader->blocks++;
    rt_build_begin(&fields, statement->block, reader->scene);
    int is_good = check_once(reader, statement);
    is_good &= rt_check_block(&checker, statement, &fields);
    if (is_good)
        is_good = build(reader, statement, &fields, &material);

    /* A material is known by its name even if it is wrong, so that its uses are no errors too. */
    if (statement->block->id == RT_BLOCK_MATERIAL && statement->name.length > 0) {
        rt_name *name = define(reader, &reader->materials, statement->name, "material");
        if (name) {
            name->index = material;
            name->is_broken = !is_good;
        }
    }
}

/* ---- Texts --------------------------------------------------------------- */

static void read_include(rt_reader *reader, const rt_statement *statement)
{
    char cause[128];
    rt_text name = rt_place_text(&statement->path);
    if (statement->is_broken)
        return;
    if (name.length == 0) {
        rt_report_error(&reader->reports, statement->path, "the name of the file to include is empty");
        return;
    }
    char *path = rt_source_resolve(statement->path.source, name);
    rt_source *source = path ? rt_sources_add(&reader->sources, path, statement->path.source) : NULL;
    free(path);
    rt_status status = source ? rt_source_read(&reader->sources, source, cause, sizeof cause) : RT_ERROR_MEMORY;
    if (status == RT_ERROR_MEMORY) {
        reader->reports.out_of_memory = 1;
    } else if (status != RT_OK) {
        char quote[RT_QUOTE_SIZE];
        rt_text shown = {source->path, strlen(source->path)};
        rt_report_error(&reader->reports, statement->path, "cannot include '%s': %s", rt_text_quote(quote, shown),
                        cause);
    } else {
        rt_reader_read(reader, source);
    }
}

void rt_reader_read(rt_reader *reader, const rt_source *source)
{
    if (!rt_lexer_check_text(source, &reader->reports, &reader->order))
        return;

    rt_operations operations = {NULL, 0, 0};
    rt_statement *statement = malloc(sizeof *statement);
    rt_parser parser;
    rt_parser_begin(&parser, source, &reader->reports, &reader->order, &operations, &reader->constants,
                    &reader->materials);
    if (!statement)
        reader->reports.out_of_memory = 1;
    while (!must_stop(reader) && rt_parser_next(&parser, statement)) {
        switch (statement->kind) {
        case RT_STATEMENT_LET:
            read_let(reader, statement, &operations);
            break;
        case RT_STATEMENT_INCLUDE:
            read_include(reader, statement);
            break;
        case RT_STATEMENT_BLOCK:
            read_block(reader, statement, &operations);
            break;
        }
    }
    free(statement);
    rt_operations_free(&operations);
}

rt_status rt_reader_finish(rt_reader *reader, rt_scene **out, const rt_load_options *options, rt_error *error)
{
    if (reader->fatal.status != RT_OK) {
        if (error)
            *error = reader->fatal;
        return reader->fatal.status;
    }
    if (reader->reports.errors == 0) {
        warn_of_unused(reader, &reader->constants, "constant");
        warn_of_unused(reader, &reader->materials, "material");
    }
    rt_status status = rt_reports_finish(&reader->reports, options, error);
    if (status == RT_OK) {
        *out = reader->scene;
        reader->scene = NULL;
    }
    return status;
}
