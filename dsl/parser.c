/* parser.c - takes tokens, and skips what cannot be understood. */
#include "dsl/parser.h"

#include <assert.h>
#include <string.h>

#include "dsl/function.h"
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
    rt_place place = rt_parser_last(parser)->place;
    if (!token->first_on_line || !place.source)
        return token->place;
    place.offset += (size_t)place.length;
    place.column += place.length;
    place.length = 1;
    return place;
}

/* Whether a '%' stands for a percentage: it touches a number, and nothing follows to divide by. */
static int is_percentage(rt_parser *parser, const rt_token *token)
{
    const rt_token *next = rt_parser_peek(parser, 1);
    return token->kind == '%' && !token->space_before &&
           rt_parser_last(parser)->kind == RT_TOKEN_NUMBER && next->kind != RT_TOKEN_NUMBER &&
           next->kind != '(' &&
           !(next->kind == RT_TOKEN_WORD &&
             rt_parser_is_constant(parser, rt_place_text(&next->place)));
}

int rt_parser_hint_operator(rt_parser *parser, const rt_token *token)
{
    if (token->kind != '^' && token->kind != '%')
        return 0;
    if (is_percentage(parser, token)) {
        rt_report_hint(parser->reports, "there are no percentages: write %g",
                       rt_parser_last(parser)->number / 100);
        return 1;
    }
    rt_report_hint(parser->reports, token->kind == '^' ? "a power is written pow(x, y)"
                                                       : "a remainder is written mod(x, y)");
    return 1;
}

rt_place rt_parser_take_hyphenated(rt_parser *parser, int *is_joined)
{
    rt_place place = rt_parser_take(parser)->place;
    *is_joined = 0;
    for (;;) {
        const rt_token *hyphen = rt_parser_peek(parser, 0);
        if (hyphen->kind != '-' || hyphen->space_before)
            break;
        const rt_token *next = rt_parser_peek(parser, 1);
        if ((next->kind != RT_TOKEN_WORD && next->kind != RT_TOKEN_NUMBER) || next->space_before)
            break;
        rt_parser_take(parser);
        place = rt_place_join(place, rt_parser_take(parser)->place);
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
    if (rt_token_is_word(word, "let"))
        return rt_parser_peek(parser, 1)->kind == RT_TOKEN_WORD &&
               rt_parser_peek(parser, 2)->kind == '=';
    if (rt_token_is_word(word, "include"))
        return rt_parser_peek(parser, 1)->kind == RT_TOKEN_STRING;
    if (rt_token_is_word(word, "repeat"))
        return rt_parser_peek(parser, 1)->kind == RT_TOKEN_WORD &&
               rt_token_is_word(rt_parser_peek(parser, 2), "from");
    const rt_token *next = rt_parser_peek(parser, 1);
    return (next->kind == '{' ||
            (next->kind == RT_TOKEN_WORD && rt_parser_peek(parser, 2)->kind == '{')) &&
           rt_schema_is_block(rt_place_text(&word->place));
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
        if (rt_parser_take(parser)->kind == '}')
            return;
    }
}

/* ---- Repeats ----------------------------------------------------------------- */

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
        int kind = rt_parser_take(parser)->kind;
        depth += (kind == '{') - (kind == '}');
    }
    parser->repeats--;
}
