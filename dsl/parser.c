#include "dsl/parser.h"

#include <assert.h>
#include <stdio.h>
#include <string.h>

#include "dsl/function.h"
#include "dsl/parse_block.h"
#include "dsl/parse_expression.h"
#include "dsl/suggest.h"

/* ---- Tokens -------------------------------------------------------------- */

void rt_parser_begin(rt_parser *parser, const rt_source *source, rt_reports *reports,
                     uint64_t *order, rt_operations *operations, const rt_scope *scope)
{
    memset(parser, 0, sizeof *parser);
    rt_lexer_begin(&parser->lexer, source, reports, order);
    parser->reports = reports;
    parser->operations = operations;
    parser->scope = scope;
}

const rt_token *rt_parser_peek(rt_parser *parser, int n)
{
    while (parser->ahead_count <= n)
        parser->ahead[parser->ahead_count++] = rt_lexer_next(&parser->lexer);
    return &parser->ahead[n];
}

rt_token rt_parser_take(rt_parser *parser)
{
    rt_token token = *rt_parser_peek(parser, 0);
    parser->ahead_count--;
    memmove(parser->ahead, parser->ahead + 1, (size_t)parser->ahead_count * sizeof *parser->ahead);
    parser->last_kind = token.kind;
    parser->last = token.place;
    return token;
}

const char *rt_parser_found(char out[RT_FOUND_SIZE], const rt_token *token)
{
    if (token->kind == RT_TOKEN_END)
        return strcpy(out, "the end of the file");
    if (token->kind == RT_TOKEN_STRING)
        return strcpy(out, "a string");
    char quote[RT_QUOTE_SIZE];
    rt_text_quote(quote, rt_place_text(&token->place));
    size_t length = strlen(quote);
    out[0] = '\'';
    memcpy(out + 1, quote, length);
    strcpy(out + 1 + length, "'");
    return out;
}

rt_place rt_parser_expected_place(rt_parser *parser)
{
    const rt_token *token = rt_parser_peek(parser, 0);
    rt_place place = parser->last;
    if (!token->first_on_line || !place.source)
        return token->place;
    place.offset += (size_t)place.length;
    place.column += place.length;
    place.length = 1;
    return place;
}

int rt_parser_hint_operator(rt_parser *parser, const rt_token *token)
{
    if (token->kind != '^' && token->kind != '%')
        return 0;
    rt_report_hint(parser->reports, token->kind == '^' ? "a power is written pow(x, y)"
                                                       : "a remainder is written mod(x, y)");
    return 1;
}

rt_place rt_parser_take_hyphenated(rt_parser *parser, int *is_joined)
{
    rt_place place = rt_parser_take(parser).place;
    *is_joined = 0;
    for (;;) {
        const rt_token *hyphen = rt_parser_peek(parser, 0);
        if (hyphen->kind != '-' || hyphen->space_before)
            break;
        const rt_token *next = rt_parser_peek(parser, 1);
        if ((next->kind != RT_TOKEN_WORD && next->kind != RT_TOKEN_NUMBER) || next->space_before)
            break;
        rt_parser_take(parser);
        place = rt_place_join(place, rt_parser_take(parser).place);
        *is_joined = 1;
    }
    return place;
}

rt_place rt_parser_take_word(rt_parser *parser, int *is_broken)
{
    int is_joined;
    rt_place place = rt_parser_take_hyphenated(parser, &is_joined);
    *is_broken |= is_joined;
    if (is_joined) {
        char quote[RT_QUOTE_SIZE];
        rt_report_error(parser->reports, place, "'%s' is not a name",
                        rt_text_quote(quote, rt_place_text(&place)));
        rt_report_hint(parser->reports, "names hold letters, digits and '_', no '-'");
    }
    return place;
}

static int is_word(const rt_token *token, const char *word)
{
    return token->kind == RT_TOKEN_WORD && rt_text_equal(rt_place_text(&token->place), word);
}

int rt_parser_call_follows(rt_parser *parser)
{
    if (rt_parser_peek(parser, 0)->kind != RT_TOKEN_WORD)
        return 0;
    const rt_token *next = rt_parser_peek(parser, 1);
    return next->kind == '(' && !next->space_before;
}

int rt_parser_is_constant(const rt_parser *parser, rt_text word)
{
    return rt_names_find(&parser->scope->constants, word) != RT_NAME_NONE ||
           rt_text_equal(word, "pi");
}

const rt_names *rt_scope_names(const rt_scope *scope, rt_field_type type)
{
    return type == RT_FIELD_MATERIAL  ? &scope->materials
           : type == RT_FIELD_TEXTURE ? &scope->textures
                                      : NULL;
}

/* ---- Recovery ------------------------------------------------------------ */

void rt_parser_skip_value(rt_parser *parser, const rt_block *block)
{
    int depth = parser->depth;
    for (;;) {
        const rt_token *token = rt_parser_peek(parser, 0);
        if (token->kind == RT_TOKEN_END || token->kind == '{' || token->kind == '}')
            return;
        if (token->kind == RT_TOKEN_WORD && token->first_on_line)
            return;
        if (token->kind == RT_TOKEN_WORD && depth <= 0 && block)
            if (rt_schema_field(block, rt_place_text(&token->place)) ||
                (!rt_parser_is_constant(parser, rt_place_text(&token->place)) &&
                 rt_function_find(rt_place_text(&token->place)) < 0))
                return;
        depth +=
            (token->kind == '(' || token->kind == '[') - (token->kind == ')' || token->kind == ']');
        rt_parser_take(parser);
    }
}

int rt_parser_statement_follows(rt_parser *parser)
{
    const rt_token *word = rt_parser_peek(parser, 0);
    if (word->kind != RT_TOKEN_WORD)
        return 0;
    if (is_word(word, "let"))
        return rt_parser_peek(parser, 1)->kind == RT_TOKEN_WORD &&
               rt_parser_peek(parser, 2)->kind == '=';
    if (is_word(word, "include"))
        return rt_parser_peek(parser, 1)->kind == RT_TOKEN_STRING;
    if (is_word(word, "repeat"))
        return rt_parser_peek(parser, 1)->kind == RT_TOKEN_WORD &&
               is_word(rt_parser_peek(parser, 2), "from");
    if (!rt_schema_is_block(rt_place_text(&word->place)))
        return 0;
    const rt_token *next = rt_parser_peek(parser, 1);
    return next->kind == '{' ||
           (next->kind == RT_TOKEN_WORD && rt_parser_peek(parser, 2)->kind == '{');
}

void rt_parser_skip_braces(rt_parser *parser)
{
    size_t depth = 0;
    do {
        const rt_token *token = rt_parser_peek(parser, 0);
        int kind = token->kind;
        if (kind == RT_TOKEN_END ||
            (depth == 1 && token->first_on_line && rt_parser_statement_follows(parser)))
            return;
        depth += kind == '{';
        depth -= kind == '}';
        rt_parser_take(parser);
    } while (depth > 0);
}

void rt_parser_skip_statement(rt_parser *parser)
{
    for (;;) {
        const rt_token *token = rt_parser_peek(parser, 0);
        if (token->kind == RT_TOKEN_END || (token->kind == RT_TOKEN_WORD && token->first_on_line))
            return;
        if (token->kind == '{') {
            rt_parser_skip_braces(parser);
            return;
        }
        if (rt_parser_take(parser).kind == '}')
            return;
    }
}

/* ---- Statements ---------------------------------------------------------- */

/* "let" NAME "=" expression. Returns 0 when not even the name is there. */
static int parse_let(rt_parser *parser, rt_statement *statement)
{
    char found[RT_FOUND_SIZE], quote[RT_QUOTE_SIZE];
    statement->kind = RT_STATEMENT_LET;
    statement->place = rt_parser_take(parser).place;
    const rt_token *token = rt_parser_peek(parser, 0);
    if (token->kind != RT_TOKEN_WORD || token->first_on_line) {
        rt_report_error(parser->reports, statement->place, "expected a name after 'let', found %s",
                        rt_parser_found(found, token));
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
    statement->place = rt_parser_take(parser).place;
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
    rt_token path = rt_parser_take(parser);
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
    if (is_word(token, word)) {
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
    statement->place = rt_parser_take(parser).place;
    const rt_token *token = rt_parser_peek(parser, 0);
    if (token->kind != RT_TOKEN_WORD || token->first_on_line) {
        rt_report_error(parser->reports, statement->place,
                        "expected a name after 'repeat', found %s", rt_parser_found(found, token));
        rt_report_hint(parser->reports, "as in: repeat i from 1 to 10 { ... }");
        rt_parser_skip_statement(parser);
        return 0;
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

rt_parser_mark rt_parser_remember(const rt_parser *parser)
{
    assert(parser->ahead_count == 0);
    return parser->lexer;
}

void rt_parser_return(rt_parser *parser, const rt_parser_mark *mark)
{
    parser->lexer = *mark;
    parser->ahead_count = 0;
    parser->repeats++;
}

void rt_parser_skip_repeat(rt_parser *parser)
{
    int depth = 1;
    while (depth > 0 && rt_parser_peek(parser, 0)->kind != RT_TOKEN_END) {
        int kind = rt_parser_take(parser).kind;
        depth += (kind == '{') - (kind == '}');
    }
    parser->repeats--;
}

/* Offers every word that begins a statement, and lists them: " let include repeat camera ...". */
static void offer_statements(rt_suggestion *suggestion, char *list, size_t size)
{
    size_t used = (size_t)snprintf(list, size, " let include repeat");
    rt_suggestion_offer_word(suggestion, "let");
    rt_suggestion_offer_word(suggestion, "include");
    rt_suggestion_offer_word(suggestion, "repeat");
    for (size_t i = 0; i < RT_BLOCK_COUNT; i++) {
        const char *word = rt_blocks[i].word;
        rt_suggestion_offer_word(suggestion, word);
        if ((i == 0 || strcmp(word, rt_blocks[i - 1].word) != 0) && used < size)
            used += (size_t)snprintf(list + used, size - used, " %s", word);
    }
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
        if (token->kind == '/')
            rt_report_hint(parser->reports, "a comment begins with '#'");
        return;
    }
    rt_suggestion suggestion = rt_suggestion_begin(rt_place_text(&token->place));
    offer_statements(&suggestion, list, sizeof list);
    rt_report_error(parser->reports, token->place, "unknown block %s", found);
    if (suggestion.best.at)
        rt_report_hint(parser->reports, "did you mean '%s'?", suggestion.best.at);
    else
        rt_report_hint(parser->reports, "a statement begins with one of:%s", list);
}

int rt_parser_next(rt_parser *parser, rt_statement *statement)
{
    while (!rt_reports_full(parser->reports)) {
        parser->operations->count = 0;
        parser->depth = 0;
        memset(statement, 0, offsetof(rt_statement, entries));

        const rt_token *token = rt_parser_peek(parser, 0);
        int understood = 0;
        if (token->kind == RT_TOKEN_END) {
            return 0;
        } else if (is_word(token, "let")) {
            understood = parse_let(parser, statement);
        } else if (is_word(token, "include")) {
            understood = parse_include(parser, statement);
        } else if (is_word(token, "repeat")) {
            understood = parse_repeat(parser, statement);
        } else if (token->kind == '}' && parser->repeats > 0) {
            statement->kind = RT_STATEMENT_END;
            statement->place = rt_parser_take(parser).place;
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
