/* reader.c - the statements of a text, one after another: includes, repeats, blocks. */
#include "dsl/reader.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "dsl/build.h"
#include "dsl/check.h"
#include "dsl/no_effect.h"
#include "dsl/parse_statement.h"

/* Stops reading, as a progress callback asked to. */
static void cancel(rt_reader *reader)
{
    memset(&reader->fatal, 0, sizeof reader->fatal);
    reader->fatal.status = RT_CANCELLED;
    snprintf(reader->fatal.message, sizeof reader->fatal.message, "cancelled");
}

rt_status rt_reader_begin(rt_reader *reader, const rt_load_options *options, rt_error *error)
{
    memset(reader, 0, sizeof *reader);
    reader->options = options;
    reader->budget.memory = options->memory;
    reader->sources.budget = reader->origins.budget = &reader->budget;
    reader->scope.constants.budget = reader->scope.materials.budget = &reader->budget;
    reader->scope.textures.budget = reader->scope.grids.budget = &reader->budget;
    reader->scope.meshes.budget = &reader->budget;
    rt_status status = rt_scene_create(&reader->scene, error);
    if (status == RT_OK) {
        rt_scene_set_memory(reader->scene, options->memory);
        rt_scene_set_root(reader->scene, options->root);
        rt_scene_set_vdb_module(reader->scene, options->vdb_module);
    }
    if (status == RT_OK && !rt_reading_begin(&reader->progress, options->hooks))
        cancel(reader);
    return status;
}

void rt_reader_free(rt_reader *reader)
{
    rt_scene_destroy(reader->scene);
    rt_origins_free(&reader->origins);
    rt_dump_free(&reader->dump);
    rt_scope_free(&reader->scope);
    rt_reports_free(&reader->reports);
    rt_sources_free(&reader->sources);
    rt_budget_free(&reader->budget);
}

void rt_reader_tell_file(const rt_reader *reader, const char *path)
{
    if (reader->options->file)
        reader->options->file(reader->options->user, path);
}

static int must_stop(const rt_reader *reader)
{
    return rt_reports_full(&reader->reports) || reader->fatal.status != RT_OK;
}

#define REPEATS_MAX 32            /* repeats inside each other */
#ifndef ITERATIONS_MAX            /* less where a fuzzer is to be quick */
#define ITERATIONS_MAX 10000000.0 /* of all repeats of a scene */
#endif
#define REPEATED_MAX 2147483648.0 /* bytes of text that these read in all */

/* ---- Names --------------------------------------------------------------- */

/* Adds a name to a table; NULL when it is there already, which is reported, or without memory. */
static rt_name *define(rt_reader *reader, rt_names *names, rt_place place, const char *what)
{
    char quote[RT_QUOTE_SIZE];
    rt_text text = rt_place_text(&place);
    size_t found = rt_names_find(names, text);
    if (names == &reader->scope.constants && rt_text_equal(text, "pi")) {
        rt_report_error(&reader->reports, place, "'pi' is already defined");
        rt_report_hint(&reader->reports, "it is a constant of the language");
        return NULL;
    }
    if (found != RT_NAME_NONE) {
        const rt_place *first = &names->items[found].place;
        rt_report_error(&reader->reports, place, "%s '%s' is defined twice", what,
                        rt_text_quote(quote, text));
        rt_report_hint(&reader->reports, "first at %s:%d", first->source->path, first->line);
        return NULL;
    }
    rt_name *name = rt_names_add(names, place);
    if (!name)
        reader->reports.out_of_memory = 1;
    return name;
}

/*
 * Whether the caller has set the constant of a `let`, which is then met; in a repeat it is met
 * again and again.
 */
static int is_set_by_caller(rt_reader *reader, rt_place place)
{
    const rt_names *constants = &reader->scope.constants;
    const size_t found = rt_names_find(constants, rt_place_text(&place));
    if (reader->is_defining || found == RT_NAME_NONE)
        return 0;
    rt_name *name = &constants->items[found];
    const int is_again = name->place.source == place.source && name->place.offset == place.offset;
    if (!name->is_awaited && !is_again)
        return 0;
    name->is_awaited = 0;
    name->place = place;
    return 1;
}

static void read_let(rt_reader *reader, const rt_statement *statement,
                     const rt_operations *operations)
{
    rt_value value = {{0, 0, 0}, statement->value.is_vector};
    int is_good =
        !statement->is_broken && rt_expression_evaluate(&value, &statement->value, operations,
                                                        &reader->scope.constants, &reader->reports);
    if (is_set_by_caller(reader, statement->name))
        return;
    rt_name *name = define(reader, &reader->scope.constants, statement->name, "constant");
    if (name) {
        name->value = value;
        name->is_broken = !is_good;
        name->is_awaited = reader->is_defining;
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

/*
 * The entry that a refusal is about: by its name, a step of the transform, or the file that was
 * read.
 */
static const rt_entry *entry_at_fault(const rt_statement *statement, const rt_error *error)
{
    const rt_entry *found = NULL;
    for (int i = 0; i < statement->entry_count; i++) {
        const rt_field *field = statement->entries[i].field;
        int is_it = strcmp(error->field, field->name) == 0 ||
                    (strcmp(error->field, "transform") == 0 && rt_field_is_transform(field)) ||
                    (strcmp(error->field, "path") == 0 && field->type == RT_FIELD_FILE);
        if (is_it)
            found = &statement->entries[i];
    }
    return found;
}

/* Points at the field that the scene refused, or else at the block. */
static void report_refusal(rt_reader *reader, const rt_statement *statement, const rt_error *error)
{
    const rt_entry *entry = entry_at_fault(statement, error);
    rt_place place = statement->place;
    if (entry && entry->value_count > 0)
        place = rt_place_join(entry->values[0].place, entry->values[entry->value_count - 1].place);
    else if (entry)
        place = entry->word;
    if (error->file[0] && error->line > 0)
        rt_report_error(&reader->reports, place, "%s:%d: %s", error->file, error->line,
                        error->message);
    else if (error->file[0] && !strstr(error->message, error->file))
        rt_report_error(&reader->reports, place, "%s: %s", error->file, error->message);
    else
        rt_report_error(&reader->reports, place, "%s", error->message);
}

/* Builds a block; returns whether the scene took it. */
static int build(rt_reader *reader, const rt_statement *statement, const rt_block_fields *fields,
                 rt_build_name *as)
{
    char *name = NULL;
    if (statement->name.length > 0) {
        rt_text text = rt_place_text(&statement->name);
        name = rt_text_copy(text);
        if (!name) {
            reader->reports.out_of_memory = 1;
            return 0;
        }
    }
    rt_error error;
    error.file[0] = error.field[0] = error.message[0] = '\0';
    as->text = name ? name : "";
    rt_status status = rt_build_block(reader->scene, statement->block, fields, as, &error);
    if (status == RT_OK && reader->options->block)
        rt_dump_block(&reader->dump, reader->options, statement->block, fields, as,
                      reader->repeats > 0);
    as->text = NULL;
    free(name);
    if (status == RT_ERROR_INPUT || status == RT_ERROR_USAGE)
        report_refusal(reader, statement, &error);
    else if (status != RT_OK)
        reader->fatal = error;
    return status == RT_OK;
}

/* The table that holds the names of a kind of block, or NULL. */
static rt_names *table_of(rt_scope *scope, const rt_block *block)
{
    return block->id == RT_BLOCK_MATERIAL                                 ? &scope->materials
           : block->id == RT_BLOCK_TEXTURE                                ? &scope->textures
           : block->id == RT_BLOCK_GRID                                   ? &scope->grids
           : block->id == RT_BLOCK_MESH || block->id == RT_BLOCK_INSTANCE ? &scope->meshes
                                                                          : NULL;
}

/* Looks up the mesh that an instance names. */
static int find_mesh(const rt_checker *checker, const rt_statement *statement, rt_build_name *mesh)
{
    if (statement->name.length == 0)
        return 0;
    const rt_name *name = rt_check_known(checker, &checker->scope->meshes, statement->name, "mesh");
    if (!name)
        return 0;
    mesh->index = name->index;
    mesh->texture = name->texture;
    mesh->parts = name->parts;
    return !name->is_broken;
}

/* Warns of what is given but has no effect, in the block or in the file that it names. */
static void warn(rt_reader *reader, const rt_statement *statement, const rt_block_fields *fields,
                 const rt_build_name *as)
{
    rt_no_effect_warn(statement, fields, &reader->scope, &reader->reports);
    if (as->names_materials)
        rt_no_effect_warn_materials(statement, &reader->reports);
    if (as->goes_on)
        rt_no_effect_warn_rest(statement, &reader->reports);
    rt_no_effect_warn_mesh(statement, &as->warnings, &reader->reports);
}

/* Notes the textures that a texture names: names further down may close a circle. */
static void note_inside(rt_name *name, const rt_statement *statement)
{
    int count = 0;
    for (int i = 0; statement->block->id == RT_BLOCK_TEXTURE && i < statement->entry_count; i++)
        if (statement->entries[i].field->type == RT_FIELD_TEXTURE &&
            !statement->entries[i].is_broken && count < RT_NAME_INSIDE)
            name->inside[count++] = rt_place_text(&statement->entries[i].word);
}

static void read_block(rt_reader *reader, const rt_statement *statement,
                       const rt_operations *operations)
{
    const rt_block *block = statement->block;
    char *path = NULL, *string = NULL;
    rt_checker checker = {&reader->reports,      operations,   &reader->scope, &path, &string,
                          reader->options->root, {.length = 0}};
    rt_block_fields fields;
    rt_build_name as = {.text = NULL};
    reader->blocks++;
    if (block->id == RT_BLOCK_TEXTURE)
        checker.texture = statement->name;
    rt_build_begin(&fields, block, reader->scene);
    int is_good = check_once(reader, statement);
    if (block->flags & RT_BLOCK_REFERS)
        is_good &= find_mesh(&checker, statement, &as);
    is_good &= rt_check_block(&checker, statement, &fields);
    if (path)
        rt_reader_tell_file(reader, path);
    const int is_built =
        is_good && rt_no_effect_settle(statement, &fields,
                                       reader->is_further_iteration ? NULL : &reader->reports);
    if (is_built)
        is_good = build(reader, statement, &fields, &as);
    if (is_good && !reader->is_further_iteration)
        warn(reader, statement, &fields, &as);
    for (uint32_t i = 0;
         is_good && is_built && reader->options->check && i < (as.parts ? as.parts : 1); i++)
        if (!rt_origins_add(&reader->origins, block, statement->place))
            reader->reports.out_of_memory = 1;
    free(path);
    free(string);

    /*
     * A material is known by its name even if it is wrong, so that its uses are no errors too; so
     * are the others.
     */
    if ((block->flags & RT_BLOCK_NAMED) && statement->name.length > 0) {
        rt_name *name =
            define(reader, table_of(&reader->scope, block), statement->name, block->word);
        if (name) {
            name->index = as.index;
            name->texture = as.texture;
            name->parts = as.parts;
            name->is_broken = !is_good;
            note_inside(name, statement);
            name->has_kd = block->id == RT_BLOCK_MATERIAL && rt_block_has_kd(&fields);
            name->emits = block->id == RT_BLOCK_MATERIAL && rt_block_emits(&fields);
        }
    }
}

/* ---- Texts --------------------------------------------------------------- */

/* "a.rts includes b.rts, which includes it": how a text that includes itself does so. */
static void hint_loop(rt_reports *reports, const rt_source *source)
{
    const rt_source *around = rt_source_around(source);
    char path[256] = "";
    for (const rt_source *s = source->includer; around && s != around; s = s->includer) {
        char rest[sizeof path];
        snprintf(rest, sizeof rest, "%s", path);
        snprintf(path, sizeof path, "%.60s, which includes %.160s", s->path, rest);
    }
    if (around && path[0])
        rt_report_hint(reports, "%s includes %sit", around->path, path);
}

static void read_include(rt_reader *reader, const rt_statement *statement)
{
    char cause[128];
    rt_text name = rt_place_text(&statement->path);
    if (statement->is_broken)
        return;
    if (name.length == 0) {
        rt_report_error(&reader->reports, statement->path,
                        "the name of the file to include is empty");
        return;
    }
    char *path = rt_source_resolve(statement->path.source, name);
    if (path && !rt_path_is_within(reader->options->root, path)) {
        char quote[RT_QUOTE_SIZE];
        rt_report_error(&reader->reports, statement->path,
                        "'%s' lies outside of the scene's folder", rt_text_quote(quote, name));
        free(path);
        return;
    }
    rt_source *source =
        path ? rt_sources_add(&reader->sources, path, statement->path.source) : NULL;
    free(path);
    if (source)
        rt_reader_tell_file(reader, source->path);
    rt_status status =
        source ? rt_source_read(&reader->sources, source, cause, sizeof cause) : RT_ERROR_MEMORY;
    if (status == RT_ERROR_MEMORY) {
        reader->reports.out_of_memory = 1;
    } else if (status != RT_OK) {
        char quote[RT_QUOTE_SIZE];
        rt_text shown = {source->path, strlen(source->path)};
        rt_report_error(&reader->reports, statement->path, "cannot include '%s': %s",
                        rt_text_quote(quote, shown), cause);
        hint_loop(&reader->reports, source);
    } else {
        const rt_place *place = &statement->path;
        double left = reader->progress.left;
        reader->progress.left += (double)(place->source->size - place->offset);
        rt_reader_read(reader, source);
        reader->progress.left = left;
    }
}

/* ---- Repeats --------------------------------------------------------------- */

static void read_statements(rt_reader *reader, rt_parser *parser, rt_statement *statement,
                            rt_operations *operations, int *is_closed);

/*
 * What a repeat counts from and to. Where that is wrong, its body is read once for its own errors.
 */
static int evaluate_range(rt_reader *reader, const rt_statement *statement,
                          const rt_operations *operations, double *first, double *last)
{
    rt_value from = {{0, 0, 0}, 0}, to = {{0, 0, 0}, 0};
    const rt_expression *bounds[] = {&statement->value, &statement->last};
    *first = *last = 0;
    if (statement->is_broken ||
        !rt_expression_evaluate(&from, bounds[0], operations, &reader->scope.constants,
                                &reader->reports) ||
        !rt_expression_evaluate(&to, bounds[1], operations, &reader->scope.constants,
                                &reader->reports))
        return 0;
    for (int i = 0; i < 2; i++)
        if (bounds[i]->is_vector) {
            rt_report_error(&reader->reports, bounds[i]->place,
                            "expected a number, found a vector");
            return 0;
        }
    if (to.v[0] - from.v[0] >= ITERATIONS_MAX) {
        rt_report_error(&reader->reports, statement->place,
                        "the repeats of a scene have more than %.0f iterations", ITERATIONS_MAX);
        return 0;
    }
    *first = from.v[0];
    *last = to.v[0];
    return 1;
}

/* Reads the body once; returns whether there may be another iteration. */
static int read_iteration(rt_reader *reader, rt_parser *parser, rt_statement *statement,
                          rt_operations *operations, rt_place variable, double number, int is_good,
                          int is_first)
{
    size_t errors = reader->reports.errors;
    rt_scope_counts before = rt_scope_count(&reader->scope);
    int is_closed = 0;
    rt_name *name = define(reader, &reader->scope.constants, variable, "constant");
    if (name) {
        name->value = (rt_value){{number, number, number}, 0};
        name->is_used = 1;
        name->is_broken = !is_good;
    }
    int was_further = reader->is_further_iteration;
    reader->is_further_iteration |= !is_first;
    read_statements(reader, parser, statement, operations, &is_closed);
    reader->is_further_iteration = was_further;
    if (!is_closed && !must_stop(reader))
        rt_report_error(&reader->reports, variable,
                        "this repeat is not closed: expected '}' before the end of the file");
    if (is_first && reader->reports.errors == 0)
        rt_scope_warn(&reader->scope, &before, &reader->reports);
    rt_scope_forget(&reader->scope, &before);
    return is_closed && reader->reports.errors == errors;
}

/*
 * A repeat without iterations; one inside another may be meant to have none in some of the other's.
 */
static void skip_empty(rt_reader *reader, rt_parser *parser, rt_place place, double first,
                       double last)
{
    if (reader->repeats == 0) {
        rt_report_warning(&reader->reports, place,
                          "this repeat makes no iterations: it counts up from %.10g to %.10g",
                          first, last);
        rt_report_hint(&reader->reports, "what its braces hold is not read");
    }
    rt_parser_skip_repeat(parser);
}

static void read_repeat(rt_reader *reader, rt_parser *parser, rt_statement *statement,
                        rt_operations *operations)
{
    double first, last;
    rt_place variable = statement->name, place = statement->place;
    rt_parser_mark body = rt_parser_remember(parser);
    int is_good = evaluate_range(reader, statement, operations, &first, &last);
    if (reader->repeats == REPEATS_MAX) {
        rt_report_error(&reader->reports, place, "repeats are nested deeper than %d", REPEATS_MAX);
        rt_parser_skip_repeat(parser);
        return;
    }
    if (first > last)
        skip_empty(reader, parser, place, first, last);
    reader->repeats++;
    double left = reader->progress.left, begun = reader->progress.done;
    for (size_t iteration = 0; first + (double)iteration <= last; iteration++) {
        if (iteration > 0)
            reader->progress.left = left + (last - first - (double)iteration) / (double)iteration *
                                               (reader->progress.done - begun);
        if (iteration > 0)
            rt_parser_return(parser, &body);
        if ((double)++reader->iterations > ITERATIONS_MAX) {
            rt_report_error(&reader->reports, place,
                            "the repeats of a scene have more than %.0f iterations",
                            ITERATIONS_MAX);
            rt_parser_skip_repeat(parser);
            break;
        }
        const size_t begin = parser->lexer.at;
        /* An error would be the same at every iteration: report it once. */
        if (!read_iteration(reader, parser, statement, operations, variable,
                            first + (double)iteration, is_good, iteration == 0))
            break;
        reader->repeated += (double)(parser->lexer.at - begin);
        if (reader->repeated > REPEATED_MAX) {
            rt_report_error(&reader->reports, place,
                            "the repeats of a scene read more than %.0f GiB of text",
                            REPEATED_MAX / 1073741824.0);
            break;
        }
    }
    reader->progress.left = left;
    reader->repeats--;
}

/* ---- Statements ------------------------------------------------------------ */

/* Reads to the end of the text, or of the repeat that the parser is in. */
static void read_statements(rt_reader *reader, rt_parser *parser, rt_statement *statement,
                            rt_operations *operations, int *is_closed)
{
    size_t from = parser->lexer.at;
    while (!must_stop(reader) && rt_parse_statement(parser, statement)) {
        if (!rt_reading_step(&reader->progress, parser->lexer.at - from,
                             parser->lexer.source->size - parser->lexer.at))
            cancel(reader);
        switch (statement->kind) {
        case RT_STATEMENT_LET:
            read_let(reader, statement, operations);
            break;
        case RT_STATEMENT_INCLUDE:
            read_include(reader, statement);
            break;
        case RT_STATEMENT_BLOCK:
            read_block(reader, statement, operations);
            break;
        case RT_STATEMENT_REPEAT:
            read_repeat(reader, parser, statement, operations);
            break;
        case RT_STATEMENT_END:
            *is_closed = 1;
            return;
        }
        from = parser->lexer.at;
    }
}

void rt_reader_read(rt_reader *reader, const rt_source *source)
{
    if (!rt_lexer_check_text(source, &reader->reports, &reader->order))
        return;

    rt_operations operations = {NULL, 0, 0};
    rt_statement *statement = malloc(sizeof *statement);
    rt_parser parser;
    int is_closed = 0;
    rt_parser_begin(&parser, source, &reader->reports, &reader->order, &operations, &reader->scope);
    if (statement)
        read_statements(reader, &parser, statement, &operations, &is_closed);
    else
        reader->reports.out_of_memory = 1;
    free(statement);
    rt_operations_free(&operations);
}

rt_status rt_reader_finish(rt_reader *reader, rt_scene **out, rt_error *error)
{
    static const rt_scope_counts all = {0, 0, 0, 0, 0};
    const int is_good = reader->fatal.status == RT_OK && reader->reports.errors == 0 &&
                        !reader->reports.out_of_memory;
    if (is_good)
        rt_scope_warn(&reader->scope, &all, &reader->reports);
    if (is_good && reader->options->block)
        rt_dump_settings(&reader->dump, reader->options, reader->scene);
    reader->reports.out_of_memory |= reader->dump.out_of_memory;
    rt_profile_begin(reader->options->profile, "check");
    if (is_good && reader->options->check)
        rt_origins_report(&reader->origins, &reader->sources, reader->scene, &reader->reports);
    rt_profile_end(reader->options->profile);
    if (reader->fatal.status == RT_OK && !rt_reading_end(&reader->progress))
        cancel(reader);
    if (reader->fatal.status == RT_OK)
        reader->fatal = reader->budget.error;
    if (reader->fatal.status != RT_OK) {
        if (error)
            *error = reader->fatal;
        return reader->fatal.status;
    }
    rt_status status = rt_reports_finish(&reader->reports, reader->options, error);
    if (status == RT_OK) {
        *out = reader->scene;
        rt_scene_set_root(*out, NULL);
        reader->scene = NULL;
    }
    return status;
}
