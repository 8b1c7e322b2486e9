/* parse_block.c - a block: its words, its braces and the fields between. */
#include "dsl/parse_block.h"

#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "dsl/parse_entry.h"
#include "dsl/suggest.h"

static rt_text text_of(const rt_token *token)
{
    return rt_place_text(&token->place);
}

/* Lists the fields of a block as a hint, or says where they are where they are many. */
static void hint_fields(rt_parser *parser, const rt_block *block)
{
    char list[240] = "", title[RT_BLOCK_TITLE_SIZE];
    size_t used = 0, count = 0;
    const rt_field *field;
    for (; (field = rt_block_field(block, count)) != NULL; count++)
        if (used < sizeof list)
            used += (size_t)snprintf(list + used, sizeof list - used, " %s", field->name);
    rt_block_title(title, block);
    if (used < sizeof list)
        rt_report_hint(parser->reports, "the fields of %s are:%s", title, list);
    else
        rt_report_hint(parser->reports,
                       "%s has %zu fields: `man 5 rts` and dsl/reference.md list them", title,
                       count);
}

/* Words that mean a texture to those who come from elsewhere. */
static int hint_texture(rt_parser *parser, const rt_block *block, rt_text name)
{
    if (block->id == RT_BLOCK_MATERIAL && rt_text_equal(name, "texture")) {
        rt_report_hint(parser->reports,
                       "an input has a texture by its own field, as `kd_texture NAME`");
        return 1;
    }
    if (block->id == RT_BLOCK_MATERIAL &&
        (rt_text_equal(name, "ior_texture") || rt_text_equal(name, "eta_texture") ||
         rt_text_equal(name, "k_texture"))) {
        rt_report_hint(parser->reports, "an index of refraction is a number, without a texture");
        return 1;
    }
    return 0;
}

/* What principled materials call by another name than others do. */
static int hint_principled(rt_parser *parser, const rt_statement *statement, rt_text name)
{
    const rt_field *colour =
        rt_schema_field(statement->block, (rt_text){"base_color", strlen("base_color")});
    if (!colour || !rt_statement_entry(statement, colour))
        return 0;
    if (rt_text_equal(name, "transmission"))
        rt_report_hint(parser->reports, "did you mean 'spec_trans'?");
    else if (rt_text_equal(name, "clearcoat_roughness"))
        rt_report_hint(parser->reports, "'clearcoat_gloss' is its inverse: 1 is the smoothest");
    else
        return 0;
    return 1;
}

static int is_shape(const rt_block *block)
{
    return rt_schema_field(block, (rt_text){"material", strlen("material")}) != NULL;
}

static int is_of_picture(const rt_block *block)
{
    return block->id == RT_BLOCK_CAMERA || block->id == RT_BLOCK_FILM ||
           block->id == RT_BLOCK_RENDER;
}

/* Whether a field that one block lacks may be meant where another has it. */
static int may_be_meant(const rt_block *block, const rt_block *other)
{
    return is_shape(block) ? other->id == RT_BLOCK_MATERIAL
                           : is_of_picture(block) && is_of_picture(other);
}

/* Says which other block has a field of that name; returns whether one has. */
static int hint_elsewhere(rt_parser *parser, const rt_block *block, rt_text name)
{
    char title[RT_BLOCK_TITLE_SIZE], quote[RT_QUOTE_SIZE];
    const rt_block *other;
    for (size_t i = 0; (other = rt_block_at(i)) != NULL; i++) {
        if (!may_be_meant(block, other) || !rt_schema_field(other, name) ||
            (other->id == RT_BLOCK_CAMERA && rt_schema_field(&rt_blocks[RT_BLOCK_FILM], name)))
            continue;
        rt_text_quote(quote, name);
        if (is_shape(block))
            rt_report_hint(parser->reports,
                           "'%s' is a field of material: write it in that of the %s", quote,
                           rt_block_title(title, block));
        else
            rt_report_hint(parser->reports, "'%s' is a field of %s", quote,
                           rt_block_title(title, other));
        return 1;
    }
    return 0;
}

static void begin_entry(rt_entry *entry, const rt_field *field)
{
    memset(entry, 0, offsetof(rt_entry, values));
    entry->field = field;
}

static void report_unknown_field(rt_parser *parser, rt_statement *statement, rt_place place)
{
    const rt_block *block = statement->block;
    char quote[RT_QUOTE_SIZE], title[RT_BLOCK_TITLE_SIZE];
    rt_text text = rt_place_text(&place);
    rt_suggestion suggestion = rt_suggestion_begin(text);
    rt_suggestion_offer_fields(&suggestion, block);
    rt_report_error(parser->reports, place, "unknown field '%s' in %s", rt_text_quote(quote, text),
                    rt_block_title(title, block));
    if (rt_text_is_unit(text)) {
        rt_report_hint(parser->reports, RT_UNIT_HINT);
        statement->is_incomplete = 1;
        return;
    }
    if (hint_principled(parser, statement, text))
        return;
    /* A name in full is less likely to be mistyped, but for a synonym. */
    const int is_sure = suggestion.best.at && suggestion.search.distance == 0;
    if (!is_sure && (hint_texture(parser, block, text) || hint_elsewhere(parser, block, text)))
        return;
    if (!suggestion.best.at) {
        hint_fields(parser, block);
        statement->is_incomplete = 1;
        return;
    }
    rt_report_hint(parser->reports, "did you mean '%s'?", suggestion.best.at);

    /* The field that was meant counts as given, so that it is not reported as missing too. */
    const rt_field *meant = rt_schema_field(block, suggestion.best);
    if (!rt_statement_entry(statement, meant) && statement->entry_count < RT_ENTRIES_MAX) {
        rt_entry *entry = &statement->entries[statement->entry_count++];
        begin_entry(entry, meant);
        entry->name = place;
        entry->is_broken = 1;
    }
}

/* A word with hyphens, which was reported, may be a field as an option of `rtc` has it. */
static void hint_joined_field(rt_parser *parser, rt_statement *statement, rt_place place)
{
    rt_suggestion suggestion = rt_suggestion_begin(rt_place_text(&place));
    rt_suggestion_offer_fields(&suggestion, statement->block);
    if (suggestion.best.at)
        rt_report_hint(parser->reports, "did you mean '%s'?", suggestion.best.at);
    statement->is_incomplete = 1;
}

static void parse_unknown_field(rt_parser *parser, rt_statement *statement)
{
    int is_broken = 0;
    rt_place place = rt_parser_take_word(parser, &is_broken);
    statement->is_broken = 1;
    if (!is_broken)
        report_unknown_field(parser, statement, place);
    else
        hint_joined_field(parser, statement, place);

    /* Skip its value: one word, or whatever no field begins with. */
    const rt_token *token = rt_parser_peek(parser, 0);
    if (token->kind == RT_TOKEN_WORD && !token->first_on_line &&
        !rt_schema_field(statement->block, text_of(token)))
        rt_parser_take(parser);
    parser->depth = 0;
    rt_parser_skip_value(parser, statement->block);
}

static void parse_field(rt_parser *parser, rt_statement *statement)
{
    const rt_field *field = rt_schema_field(statement->block, text_of(rt_parser_peek(parser, 0)));
    if (!field) {
        parse_unknown_field(parser, statement);
        return;
    }
    rt_entry *entry = &statement->entries[statement->entry_count];
    begin_entry(entry, field);
    entry->name = rt_parser_take(parser)->place;
    rt_parse_entry(parser, statement->block, entry);
    statement->is_broken |= entry->is_broken;
    /* it may have run over others */
    statement->is_incomplete |= entry->is_broken && field->type == RT_FIELD_FILE;

    const rt_entry *earlier =
        rt_field_is_transform(field) ? NULL : rt_statement_entry(statement, field);
    if (!earlier && statement->entry_count < RT_ENTRIES_MAX) {
        statement->entry_count++;
        return;
    }
    if (!earlier) {
        if (statement->entry_count == RT_ENTRIES_MAX && !statement->is_incomplete)
            rt_report_error(parser->reports, entry->name, "a block holds at most %d fields",
                            RT_ENTRIES_MAX);
        statement->is_broken = statement->is_incomplete = 1;
        return;
    }
    statement->is_broken = 1;
    if (rt_text_equal(rt_place_text(&earlier->name), field->name)) { /* not a misspelt one */
        rt_report_error(parser->reports, entry->name, "'%s' is given twice", field->name);
        rt_report_hint(parser->reports, "first at line %d", earlier->name.line);
    }
}

/* The line from `line` on of a comment that holds a '}', before the token at `end`; or 0. */
static int find_hidden_brace(const rt_source *source, size_t at, size_t end, int line)
{
    int is_comment = 0, is_string = 0;
    for (; at < end; at++) {
        const char c = source->text[at];
        if (c == '\n') {
            line++;
            is_comment = is_string = 0;
        }
        is_string ^= c == '"' && !is_comment;
        is_comment |= c == '#' && !is_string;
        if (c == '}' && is_comment)
            return line;
    }
    return 0;
}

/* Says what may have become of the '}' that a block lacks. */
static void hint_unclosed(rt_parser *parser, const rt_statement *statement, const rt_token *token)
{
    const rt_place *start = &statement->place;
    const int hidden =
        start->source == token->place.source
            ? find_hidden_brace(start->source, start->offset, token->place.offset, start->line)
            : 0;
    if (hidden)
        rt_report_hint(parser->reports, "'#' begins a comment, in which a '}' stands at line %d",
                       hidden);
    else if (token->kind != RT_TOKEN_END)
        rt_report_hint(parser->reports, "the next statement begins at line %d", token->place.line);
}

static void parse_body(rt_parser *parser, rt_statement *statement)
{
    char title[RT_BLOCK_TITLE_SIZE], found[RT_FOUND_SIZE];
    while (!rt_reports_full(parser->reports)) {
        const rt_token *token = rt_parser_peek(parser, 0);
        if (token->kind == '}') {
            rt_parser_take(parser);
            return;
        }
        if (token->kind == RT_TOKEN_END || rt_parser_statement_follows(parser)) {
            token = rt_parser_peek(parser, 0);
            rt_report_error(parser->reports, statement->place,
                            "%s is not closed: expected '}' before %s",
                            rt_block_title(title, statement->block), rt_parser_found(found, token));
            hint_unclosed(parser, statement, token);
            statement->is_broken = statement->is_incomplete = 1;
            return;
        }
        if (token->kind == RT_TOKEN_WORD) {
            parse_field(parser, statement);
            continue;
        }
        rt_report_error(parser->reports, token->place, "expected a field of %s or '}', found %s",
                        rt_block_title(title, statement->block), rt_parser_found(found, token));
        statement->is_broken = statement->is_incomplete = 1;
        if (token->kind == '{')
            rt_parser_skip_braces(parser);
        else
            rt_parser_take(parser);
        parser->depth = 0;
        rt_parser_skip_value(parser, statement->block);
    }
}

/* Whether a kind of light is a shape, or what other programs call those that emit. */
static int is_area_light(rt_text word, rt_text kind)
{
    const rt_block *block = rt_schema_find(kind, NULL);
    return rt_text_equal(word, "light") &&
           (rt_text_equal(kind, "area") || rt_text_equal(kind, "mesh") ||
            rt_text_equal(kind, "rect") || (block && is_shape(block)));
}

/*
 * The words before a block's '{'. Returns 0 when the block cannot be told; that is then reported.
 */
static int parse_kind(rt_parser *parser, rt_statement *statement, rt_text word)
{
    char found[RT_FOUND_SIZE], quote[RT_QUOTE_SIZE];
    statement->block = rt_schema_find(word, NULL);
    if (statement->block)
        return 1;
    const rt_token *token = rt_parser_peek(parser, 0);
    rt_text kind = text_of(token);
    statement->block = token->kind == RT_TOKEN_WORD ? rt_schema_find(word, &kind) : NULL;
    if (statement->block) {
        statement->place = rt_place_join(statement->place, rt_parser_take(parser)->place);
        return 1;
    }

    rt_suggestion suggestion = rt_suggestion_begin(kind);
    char kinds[RT_PHRASE_SIZE] = "";
    const rt_block *block;
    for (size_t i = 0; (block = rt_block_at(i)) != NULL; i++)
        if (block->kind && rt_text_equal(word, block->word)) {
            rt_suggestion_offer_word(&suggestion, block->kind);
            strcat(strcat(kinds, " "), block->kind);
        }
    rt_text_quote(quote, word);
    rt_report_error(parser->reports, token->kind == RT_TOKEN_WORD ? token->place : statement->place,
                    "expected a kind of %s, found %s", quote, rt_parser_found(found, token));
    if (is_area_light(word, kind))
        rt_report_hint(parser->reports, "a light with an area is a shape that emits, as in: quad { "
                                        "...  power 60 }");
    else if (suggestion.best.at)
        rt_report_hint(parser->reports, "did you mean '%s'?", suggestion.best.at);
    else
        rt_report_hint(parser->reports, "the kinds are:%s; as in: %s%.*s { ... }", kinds, quote,
                       1 + (int)strcspn(kinds + 1, " "), kinds);
    return 0;
}

static void parse_block_name(rt_parser *parser, rt_statement *statement)
{
    char found[RT_FOUND_SIZE], title[RT_BLOCK_TITLE_SIZE];
    const rt_token *token = rt_parser_peek(parser, 0);
    if (statement->block->flags & (RT_BLOCK_NAMED | RT_BLOCK_REFERS)) {
        if (token->kind == RT_TOKEN_WORD) {
            statement->name = rt_parser_take_word(parser, &statement->is_broken);
            return;
        }
        rt_report_error(parser->reports, statement->place, "%s needs a name, found %s",
                        rt_block_title(title, statement->block), rt_parser_found(found, token));
        rt_report_hint(parser->reports, "as in: %s %s { ... }", title,
                       statement->block->id == RT_BLOCK_MATERIAL  ? "white"
                       : statement->block->id == RT_BLOCK_TEXTURE ? "wood"
                       : statement->block->id == RT_BLOCK_GRID    ? "puff"
                                                                  : "bunny");
        statement->is_broken = 1;
        if (token->kind != '{' && rt_parser_peek(parser, 1)->kind == '{')
            rt_parser_take(parser);
    } else if (token->kind == RT_TOKEN_WORD && rt_parser_peek(parser, 1)->kind == '{') {
        rt_report_error(parser->reports, token->place, "%s takes no name, found %s",
                        rt_block_title(title, statement->block), rt_parser_found(found, token));
        rt_parser_take(parser);
        statement->is_broken = 1;
    }
}

/*
 * Whether what stands in place of the '{' is one sign before the first field, as in `sphere (
 * centre`.
 */
static int is_stray_opening(rt_parser *parser, const rt_block *block)
{
    const rt_token *token = rt_parser_peek(parser, 0), *next = rt_parser_peek(parser, 1);
    return token->kind != RT_TOKEN_WORD && token->kind != RT_TOKEN_END && token->kind != '}' &&
           next->kind == RT_TOKEN_WORD && rt_schema_field(block, text_of(next));
}

int rt_parse_block(rt_parser *parser, rt_statement *statement)
{
    char found[RT_FOUND_SIZE], title[RT_BLOCK_TITLE_SIZE];
    rt_token word = *rt_parser_take(parser);
    statement->kind = RT_STATEMENT_BLOCK;
    statement->place = word.place;
    if (!parse_kind(parser, statement, rt_place_text(&word.place))) {
        rt_parser_skip_statement(parser);
        return 0;
    }
    parse_block_name(parser, statement);

    const rt_token *token = rt_parser_peek(parser, 0);
    if (token->kind == '{') {
        rt_parser_take(parser);
    } else {
        rt_report_error(parser->reports, rt_parser_expected_place(parser),
                        "expected '{' after %s, found %s", rt_block_title(title, statement->block),
                        rt_parser_found(found, token));
        statement->is_broken = statement->is_incomplete = 1;
        if (is_stray_opening(parser, statement->block))
            rt_parser_take(parser);
        token = rt_parser_peek(parser, 0);
        if (token->kind != RT_TOKEN_WORD || !rt_schema_field(statement->block, text_of(token))) {
            rt_parser_skip_statement(parser);
            return 1;
        }
    }
    parse_body(parser, statement);
    return 1;
}
