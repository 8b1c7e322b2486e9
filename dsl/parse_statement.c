/* parse_statement.c - `let`, `include` and `repeat`, and the choice among all statements. */
#include "dsl/parse_statement.h"

#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "dsl/function.h"
#include "dsl/parse_block.h"
#include "dsl/parse_expression.h"
#include "dsl/suggest.h"

/* Where a name is expected, when it stands on the next line. */
static const char *on_line(const rt_token *found)
{
    return found->first_on_line ? " on the same line" : "";
}

/* "let" NAME "=" expression. Returns 0 when not even the name is there. */
static int parse_let(rt_parser *parser, rt_statement *statement)
{
    char found[RT_FOUND_SIZE], quote[RT_QUOTE_SIZE];
    statement->kind = RT_STATEMENT_LET;
    statement->place = rt_parser_take(parser)->place;
    const rt_token *token = rt_parser_peek(parser, 0);
    if (token->kind != RT_TOKEN_WORD || token->first_on_line) {
        rt_report_error(parser->reports, statement->place,
                        "expected a name after 'let'%s, found %s", on_line(token),
                        rt_parser_found(found, token));
        if (token->kind == RT_TOKEN_WORD && rt_parser_peek(parser, 1)->kind == '=')
            rt_parser_take(parser);
        rt_parser_skip_statement(parser);
        return 0;
    }
    statement->name = rt_parser_take_word(parser, &statement->is_broken);
    rt_text_quote(quote, rt_place_text(&statement->name));

    token = rt_parser_peek(parser, 0);
    if (token->kind != '=') {
        rt_report_error(parser->reports, rt_parser_expected_place(parser),
                        "expected '=' after 'let %s', found %s", quote,
                        rt_parser_found(found, token));
        statement->is_broken = 1;
        parser->depth = 0;
        rt_parser_skip_value(parser, NULL);
        return 1;
    }
    rt_parser_take(parser);
    int parsed = rt_parse_expression(parser, &statement->value);
    statement->is_broken |= statement->value.is_broken;
    token = rt_parser_peek(parser, 0);
    if (parsed && token->kind != RT_TOKEN_END && !token->first_on_line) {
        rt_report_error(parser->reports, token->place, "unexpected %s after the value of '%s'",
                        rt_parser_found(found, token), quote);
        if (token->kind == RT_TOKEN_NUMBER)
            rt_report_hint(parser->reports, "a vector stands in brackets: [0.65 0.05 0.05]");
        else if (!rt_parser_hint_operator(parser, token))
            rt_report_hint(parser->reports, "the next statement begins on a new line");
        statement->is_broken = 1;
        parsed = 0;
    }
    if (!parsed)
        rt_parser_skip_value(parser, NULL);
    return 1;
}

/* "include" STRING. */
static int parse_include(rt_parser *parser, rt_statement *statement)
{
    char found[RT_FOUND_SIZE];
    statement->kind = RT_STATEMENT_INCLUDE;
    statement->place = rt_parser_take(parser)->place;
    const rt_token *token = rt_parser_peek(parser, 0);
    if (token->kind != RT_TOKEN_STRING) {
        rt_report_error(parser->reports, statement->place,
                        "expected a file name in quotes after 'include', found %s",
                        rt_parser_found(found, token));
        rt_report_hint(parser->reports, "as in: include \"materials.rts\"");
        if (!token->first_on_line)
            rt_parser_skip_statement(parser);
        return 0;
    }
    rt_token path = *rt_parser_take(parser);
    statement->is_broken = path.is_broken;
    statement->path = path.place;
    statement->path.offset++;
    statement->path.column++;
    statement->path.length = path.is_broken ? 0 : path.place.length - 2;
    return 1;
}

/* One of the two words of a repeat's range, and the value behind it. */
static int parse_bound(rt_parser *parser, const char *word, rt_expression *value)
{
    char found[RT_FOUND_SIZE];
    const rt_token *token = rt_parser_peek(parser, 0);
    if (rt_token_is_word(token, word)) {
        rt_parser_take(parser);
        return rt_parse_value(parser, value);
    }
    rt_report_error(parser->reports, rt_parser_expected_place(parser), "expected '%s', found %s",
                    word, rt_parser_found(found, token));
    rt_report_hint(parser->reports, "as in: repeat i from 1 to 10 { ... }");
    return 0;
}

/* What is left of a line before its '{'. */
static void skip_to_brace(rt_parser *parser)
{
    while (rt_parser_peek(parser, 0)->kind != '{' && !rt_parser_peek(parser, 0)->first_on_line &&
           rt_parser_peek(parser, 0)->kind != RT_TOKEN_END)
        rt_parser_take(parser);
}

/* "repeat" NAME "from" value "to" value "{". Returns 0 when its body cannot be read as one. */
static int parse_repeat(rt_parser *parser, rt_statement *statement)
{
    char found[RT_FOUND_SIZE];
    statement->kind = RT_STATEMENT_REPEAT;
    statement->place = rt_parser_take(parser)->place;
    const rt_token *token = rt_parser_peek(parser, 0);
    if (token->kind != RT_TOKEN_WORD || token->first_on_line) {
        rt_report_error(parser->reports, statement->place,
                        "expected a name after 'repeat'%s, found %s", on_line(token),
                        rt_parser_found(found, token));
        rt_report_hint(parser->reports, "as in: repeat i from 1 to 10 { ... }");
        /* With the name on the next line, the rest is read as it is meant. */
        if (token->kind != RT_TOKEN_WORD || rt_parser_statement_follows(parser) ||
            !rt_token_is_word(rt_parser_peek(parser, 1), "from")) {
            rt_parser_skip_statement(parser);
            return 0;
        }
    }
    statement->name = rt_parser_take_word(parser, &statement->is_broken);
    if (!parse_bound(parser, "from", &statement->value) ||
        !parse_bound(parser, "to", &statement->last)) {
        statement->is_broken = 1;
        skip_to_brace(parser);
    }
    token = rt_parser_peek(parser, 0);
    if (token->kind != '{') {
        rt_report_error(parser->reports, rt_parser_expected_place(parser),
                        "expected '{' after repeat, found %s", rt_parser_found(found, token));
        if (token->kind == '+' || token->kind == '-' || token->kind == '*' || token->kind == '/')
            rt_report_hint(parser->reports, "write arithmetic in parentheses, as in (n - 1)");
        statement->is_broken = 1;
        skip_to_brace(parser);
    }
    if (rt_parser_peek(parser, 0)->kind != '{') {
        rt_parser_skip_statement(parser);
        return 0;
    }
    rt_parser_take(parser);
    statement->is_broken |= statement->value.is_broken | statement->last.is_broken;
    parser->repeats++;
    return 1;
}

/* Offers every word that begins a statement, and lists them: " let include repeat camera ...". */
static void offer_statements(rt_suggestion *suggestion, char *list, size_t size)
{
    size_t used = (size_t)snprintf(list, size, " let include repeat");
    rt_suggestion_offer_word(suggestion, "let");
    rt_suggestion_offer_word(suggestion, "include");
    rt_suggestion_offer_word(suggestion, "repeat");
    const rt_block *block;
    for (size_t i = 0; (block = rt_block_at(i)) != NULL; i++) {
        rt_suggestion_offer_word(suggestion, block->word);
        if ((i == 0 || strcmp(block->word, rt_block_at(i - 1)->word) != 0) && used < size)
            used += (size_t)snprintf(list + used, size - used, " %s", block->word);
    }
}

/* The first word of blocks whose second is this, as `light` of `point`; or NULL. */
static const char *first_word(rt_text second)
{
    const rt_block *block;
    for (size_t i = 0; (block = rt_block_at(i)) != NULL; i++)
        if (block->kind && rt_text_equal(second, block->kind))
            return block->word;
    return NULL;
}

static void report_unknown_statement(rt_parser *parser, const rt_token *token)
{
    char found[RT_FOUND_SIZE], list[2 * RT_PHRASE_SIZE];
    rt_parser_found(found, token);
    if (token->kind == '}') {
        rt_report_error(parser->reports, token->place, "'}' closes nothing");
        return;
    }
    if (token->kind != RT_TOKEN_WORD) {
        rt_report_error(parser->reports, token->place,
                        "expected a block, 'let', 'include' or 'repeat', found %s", found);
        return;
    }
    const char *const first = first_word(rt_place_text(&token->place));
    rt_suggestion suggestion = rt_suggestion_begin(rt_place_text(&token->place));
    offer_statements(&suggestion, list, sizeof list);
    rt_report_error(parser->reports, token->place, "unknown block %s", found);
    if (first)
        rt_report_hint(parser->reports, "did you mean '%s %.*s'?", first, (int)token->place.length,
                       rt_place_text(&token->place).at);
    else if (suggestion.best.at)
        rt_report_hint(parser->reports, "did you mean '%s'?", suggestion.best.at);
    else
        rt_report_hint(parser->reports, "a statement begins with one of:%s", list);
}

int rt_parse_statement(rt_parser *parser, rt_statement *statement)
{
    while (!rt_reports_full(parser->reports)) {
        parser->operations->count = 0;
        parser->depth = 0;
        memset(statement, 0, offsetof(rt_statement, entries));

        const rt_token *token = rt_parser_peek(parser, 0);
        int understood = 0;
        if (token->kind == RT_TOKEN_END) {
            return 0;
        } else if (rt_token_is_word(token, "let")) {
            understood = parse_let(parser, statement);
        } else if (rt_token_is_word(token, "include")) {
            understood = parse_include(parser, statement);
        } else if (rt_token_is_word(token, "repeat")) {
            understood = parse_repeat(parser, statement);
        } else if (token->kind == '}' && parser->repeats > 0) {
            statement->kind = RT_STATEMENT_END;
            statement->place = rt_parser_take(parser)->place;
            parser->repeats--;
            understood = 1;
        } else if (token->kind == RT_TOKEN_WORD &&
                   rt_schema_is_block(rt_place_text(&token->place))) {
            understood = rt_parse_block(parser, statement);
        } else {
            int kind = token->kind;
            report_unknown_statement(parser, token);
            if (kind != '{')
                rt_parser_take(parser);
            if (kind != '}')
                rt_parser_skip_statement(parser);
        }
        if (understood)
            return 1;
    }
    return 0;
}
