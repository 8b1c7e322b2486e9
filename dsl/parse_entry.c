/*
 * parse_entry.c - what follows the name of a field.
 *
 * Fields are not delimited: a value list ends when the field has what it takes, or where
 * a word that is a field of the block begins the next one.
 */
#include "dsl/parse_entry.h"

#include "dsl/function.h"
#include "dsl/parse_expression.h"
#include "dsl/suggest.h"

/* A field and the block around it. */
typedef struct rt_context {
    const rt_block *block;
    rt_entry *entry;
} rt_context;

/* "three numbers": what a field takes, as messages say it. */
typedef struct phrase {
    char text[RT_PHRASE_SIZE];
} phrase;

static const char *phrase_of(phrase *out, const rt_context *context)
{
    return rt_field_phrase(out->text, sizeof out->text, context->entry->field);
}

static const char *count_word(int count)
{
    static const char *const words[RT_FIELD_VALUES_MAX + 1] = {
        "none",  "one",   "two",  "three", "four",   "five",  "six",
        "seven", "eight", "nine", "ten",   "eleven", "twelve"};
    return words[count];
}

static int is_field(const rt_block *block, const rt_token *token)
{
    return token->kind == RT_TOKEN_WORD && rt_schema_field(block, rt_place_text(&token->place));
}

static int is_operator(const rt_token *token)
{
    return token->kind == '+' || token->kind == '*' || token->kind == '/' || token->kind == '-' ||
           token->kind == '^' || token->kind == '%';
}

static int is_constant(const rt_parser *parser, const rt_token *token)
{
    return token->kind == RT_TOKEN_WORD &&
           rt_parser_is_constant(parser, rt_place_text(&token->place));
}

/* Whether the next token can only be the start of a value. */
static int is_value(rt_parser *parser, const rt_block *block)
{
    const rt_token *token = rt_parser_peek(parser, 0);
    if (token->kind != RT_TOKEN_WORD)
        return token->kind == RT_TOKEN_NUMBER || token->kind == '(' || token->kind == '[' ||
               token->kind == '-';
    if (rt_parser_call_follows(parser) && rt_function_find(rt_place_text(&token->place)) >= 0)
        return 1;
    return !is_field(block, token) && is_constant(parser, token);
}

static int is_near_field(const rt_block *block, const rt_token *token)
{
    rt_suggestion suggestion = rt_suggestion_begin(rt_place_text(&token->place));
    rt_suggestion_offer_fields(&suggestion, block);
    return suggestion.best.at != NULL;
}

/* The numbers that a field takes, at most. */
static int numbers_of(rt_field_type type)
{
    switch (type) {
    case RT_FIELD_NUMBER:
    case RT_FIELD_INTEGER:
    case RT_FIELD_COUNT:
        return 1;
    case RT_FIELD_PAIR:
        return 2;
    case RT_FIELD_ROTATE:
        return 4;
    case RT_FIELD_MATRIX:
        return 12;
    case RT_FIELD_VECTOR:
    case RT_FIELD_COLOUR:
    case RT_FIELD_TRANSLATE:
    case RT_FIELD_SCALE:
        return 3;
    case RT_FIELD_BOOLEAN:
    case RT_FIELD_CHOICE:
    case RT_FIELD_MATERIAL:
    case RT_FIELD_TEXTURE:
    case RT_FIELD_GRID:
    case RT_FIELD_PART:
    case RT_FIELD_FILE:
    case RT_FIELD_STRING:
        break;
    }
    return 0;
}

/* Whether one number alone will do where three are taken. */
static int takes_one(rt_field_type type)
{
    return type == RT_FIELD_COLOUR || type == RT_FIELD_SCALE;
}

/*
 * Whether the field has the values it takes, as far as is known: a colour of one number may go on.
 */
static int is_complete(const rt_entry *entry)
{
    int numbers = 0;
    for (int i = 0; i < entry->value_count; i++)
        numbers += entry->values[i].is_vector ? 3 : 1;
    return numbers >= numbers_of(entry->field->type);
}

/* Whether the next token is taken as one more value. */
static int value_follows(rt_parser *parser, const rt_context *context)
{
    const rt_token *token = rt_parser_peek(parser, 0);
    if (is_value(parser, context->block))
        return 1;
    if (token->kind != RT_TOKEN_WORD || is_field(context->block, token) || token->first_on_line)
        return 0;
    /* An unknown word: a misspelt constant where a value must follow, else a misspelt field. */
    const rt_entry *entry = context->entry;
    if (entry->value_count == 0)
        return 1;
    return !(takes_one(entry->field->type) && entry->value_count == 1) &&
           !is_near_field(context->block, token);
}

/* Commas and the like between values: reported once a field, then ignored. */
static void skip_separators(rt_parser *parser, rt_context *context)
{
    for (;;) {
        const rt_token *token = rt_parser_peek(parser, 0);
        int kind = token->kind;
        if (kind != ',' && kind != ';' && kind != '=' && kind != ':')
            return;
        if (!context->entry->is_broken) {
            rt_report_error(parser->reports, token->place, "unexpected '%c' in '%s'", kind,
                            context->entry->field->name);
            if (kind == '=' || kind == ':')
                rt_report_hint(parser->reports,
                               "the value follows the name of its field, without a sign");
            else
                rt_report_hint(parser->reports, "numbers and fields are separated by spaces");
        }
        context->entry->is_broken = 1;
        rt_parser_take(parser);
    }
}

static void report_count(rt_parser *parser, const rt_context *context)
{
    phrase taken;
    const rt_entry *entry = context->entry;
    const rt_token *token = rt_parser_peek(parser, 0);
    char found[RT_FOUND_SIZE];
    if (token->kind == RT_TOKEN_END)
        return; /* the block is reported as not closed */
    if (entry->value_count > 0) {
        rt_place place = rt_place_join(entry->name, entry->values[entry->value_count - 1].place);
        rt_report_error(parser->reports, place, "'%s' takes %s, found %s", entry->field->name,
                        phrase_of(&taken, context), count_word(entry->value_count));
        return;
    }
    rt_report_error(parser->reports, entry->name, "'%s' takes %s, found %s", entry->field->name,
                    phrase_of(&taken, context), rt_parser_found(found, token));
    if (is_constant(parser, token)) {
        rt_report_hint(parser->reports,
                       "write the constant in parentheses to tell it from the field");
        rt_parser_take(parser);
    }
}

/* Checks the number and the kinds of the values of an entry without errors so far. */
static void check_values(rt_parser *parser, const rt_context *context)
{
    phrase taken;
    rt_entry *entry = context->entry;
    rt_field_type type = entry->field->type;
    int is_triple = numbers_of(type) == 3, is_grey = takes_one(type) && entry->value_count == 1;
    for (int i = 0; i < entry->value_count; i++)
        if (entry->values[i].is_vector && !(is_triple && entry->value_count == 1) &&
            !(type == RT_FIELD_ROTATE && i == 0)) {
            rt_report_error(parser->reports, entry->values[i].place,
                            "'%s' takes %s, found a vector", entry->field->name,
                            is_triple ? "three numbers or one vector" : phrase_of(&taken, context));
            entry->is_broken = 1;
            return;
        }
    if (!is_complete(entry) && !is_grey) {
        report_count(parser, context);
        entry->is_broken = 1;
    }
}

/*
 * What may not follow a value: one more than the field takes, or an operator outside parentheses.
 */
static void check_end(rt_parser *parser, const rt_context *context)
{
    phrase taken;
    rt_entry *entry = context->entry;
    const rt_token *token = rt_parser_peek(parser, 0);
    char found[RT_FOUND_SIZE];
    if (is_operator(token)) {
        rt_report_error(parser->reports, token->place, "unexpected '%c' after the value of '%s'",
                        token->kind, entry->field->name);
        if (!rt_parser_hint_operator(parser, token))
            rt_report_hint(parser->reports, "write arithmetic in parentheses, as in (2 * 3)");
    } else if (is_value(parser, context->block) || token->kind == RT_TOKEN_STRING) {
        rt_report_error(parser->reports, token->place, "'%s' takes %s, found one more: %s",
                        entry->field->name, phrase_of(&taken, context),
                        rt_parser_found(found, token));
    } else {
        return;
    }
    entry->is_broken = 1;
    rt_parser_skip_value(parser, context->block);
}

static void parse_numbers(rt_parser *parser, rt_context *context)
{
    rt_entry *entry = context->entry;
    for (;;) {
        skip_separators(parser, context);
        if (is_complete(entry) || !value_follows(parser, context))
            break;
        rt_expression *value = &entry->values[entry->value_count++];
        parser->depth = 0;
        int parsed = rt_parse_value(parser, value);
        entry->is_broken |= value->is_broken;
        if (!parsed) {
            rt_parser_skip_value(parser, context->block);
            return;
        }
    }
    /* `1 h/2 0` is no missing value, but arithmetic without parentheses. */
    int is_cut_short = entry->value_count > 0 && is_operator(rt_parser_peek(parser, 0));
    if (!entry->is_broken && !is_cut_short)
        check_values(parser, context);
    if (!entry->is_broken)
        check_end(parser, context);
    else
        rt_parser_skip_value(parser, context->block);
}

/* Whether a word is a value of the field, rather than a word that belongs elsewhere. */
static int is_known_word(const rt_parser *parser, const rt_field *field, rt_text word)
{
    const rt_names *names = rt_scope_names(parser->scope, field->type);
    if (names)
        return rt_names_find(names, word) != RT_NAME_NONE;
    return rt_word_find(rt_field_words(field), word.at, word.length) != NULL;
}

/* Whether the next token is a word like one that the field takes, and no constant. */
static int is_near_word(rt_parser *parser, const rt_field *field)
{
    const rt_token *token = rt_parser_peek(parser, 0);
    rt_text word = rt_place_text(&token->place);
    rt_nearest search;
    if (token->kind != RT_TOKEN_WORD || is_constant(parser, token))
        return 0;
    rt_nearest_begin(&search, word.at, word.length);
    rt_nearest_offer_words(&search, rt_field_words(field));
    return search.best != NULL;
}

/*
 * Whether the next token is the value, and no field: a word, or a field that is given no value and
 * is called like a name that is not known yet.
 */
static int is_word_meant(rt_parser *parser, const rt_context *context)
{
    const rt_token *token = rt_parser_peek(parser, 0), *next = rt_parser_peek(parser, 1);
    if (token->kind != RT_TOKEN_WORD)
        return 0;
    if (is_known_word(parser, context->entry->field, rt_place_text(&token->place)))
        return 1;
    return !token->first_on_line && (!is_field(context->block, token) ||
                                     ((next->kind == '}' || is_field(context->block, next)) &&
                                      (rt_scope_names(parser->scope, context->entry->field->type) ||
                                       is_near_word(parser, context->entry->field))));
}

static void parse_word(rt_parser *parser, rt_context *context)
{
    phrase taken;
    rt_entry *entry = context->entry;
    char found[RT_FOUND_SIZE];
    skip_separators(parser, context);
    if (is_word_meant(parser, context)) {
        int is_joined = 0, is_broken = 0;
        if (entry->field->type == RT_FIELD_CHOICE)
            entry->word = rt_parser_take_hyphenated(parser, &is_joined);
        else
            entry->word = rt_parser_take_word(parser, &is_broken);
        entry->is_broken |= is_broken;
        skip_separators(parser, context);
        if (!entry->is_broken)
            check_end(parser, context);
        return;
    }
    /* The mistake is where the value is missing, or the wrong value itself. */
    const rt_token *token = rt_parser_peek(parser, 0);
    int is_missing = token->kind == RT_TOKEN_WORD || token->kind == '}';
    if (!entry->is_broken &&
        token->kind != RT_TOKEN_END) /* else the block is reported as not closed */
        rt_report_error(parser->reports, is_missing ? entry->name : token->place,
                        "'%s' takes %s, found %s", entry->field->name, phrase_of(&taken, context),
                        rt_parser_found(found, token));
    if (!entry->is_broken && token->kind == RT_TOKEN_STRING)
        rt_report_hint(parser->reports, "only names of files and layers stand in double quotes");
    entry->is_broken = 1;
    rt_parser_skip_value(parser, context->block);
}

/* A number, or the word `all` in its place, which may be mistyped. */
static void parse_count(rt_parser *parser, rt_context *context)
{
    skip_separators(parser, context);
    const rt_token *token = rt_parser_peek(parser, 0);
    if (token->kind == RT_TOKEN_WORD &&
        (is_known_word(parser, context->entry->field, rt_place_text(&token->place)) ||
         (is_near_word(parser, context->entry->field) && !is_field(context->block, token))))
        parse_word(parser, context);
    else
        parse_numbers(parser, context);
}

static void parse_string(rt_parser *parser, rt_context *context)
{
    phrase taken;
    rt_entry *entry = context->entry;
    char found[RT_FOUND_SIZE];
    skip_separators(parser, context);
    const rt_token *token = rt_parser_peek(parser, 0);
    if (token->kind == RT_TOKEN_STRING) {
        rt_token string = *rt_parser_take(parser);
        entry->is_broken |= string.is_broken;
        entry->word = string.place;
        entry->word.offset++;
        entry->word.column++;
        entry->word.length = string.is_broken ? 0 : string.place.length - 2;
        if (!entry->is_broken)
            check_end(parser, context);
        return;
    }
    int is_missing = token->kind == '}' || is_field(context->block, token);
    if (!entry->is_broken && token->kind != RT_TOKEN_END)
        rt_report_error(parser->reports, is_missing ? entry->name : token->place,
                        "'%s' takes %s, found %s", entry->field->name, phrase_of(&taken, context),
                        rt_parser_found(found, token));
    if (!entry->is_broken && !is_missing && token->kind == RT_TOKEN_WORD)
        rt_report_hint(parser->reports, "%s stand in double quotes",
                       entry->field->type == RT_FIELD_FILE ? "file names" : "names of layers");
    entry->is_broken = 1;
    /* A name without quotes, as in images/wood.png, goes on to the next space. */
    if (token->kind == RT_TOKEN_WORD && !is_missing && !token->first_on_line)
        do
            rt_parser_take(parser);
        while (!rt_parser_peek(parser, 0)->space_before &&
               rt_parser_peek(parser, 0)->kind != RT_TOKEN_END &&
               rt_parser_peek(parser, 0)->kind != '}');
    rt_parser_skip_value(parser, context->block);
}

void rt_parse_entry(rt_parser *parser, const rt_block *block, rt_entry *entry)
{
    rt_context context = {block, entry};
    switch (entry->field->type) {
    case RT_FIELD_BOOLEAN:
    case RT_FIELD_CHOICE:
    case RT_FIELD_MATERIAL:
    case RT_FIELD_TEXTURE:
    case RT_FIELD_GRID:
    case RT_FIELD_PART:
        parse_word(parser, &context);
        break;
    case RT_FIELD_COUNT:
        parse_count(parser, &context);
        break;
    case RT_FIELD_FILE:
    case RT_FIELD_STRING:
        parse_string(parser, &context);
        break;
    case RT_FIELD_NUMBER:
    case RT_FIELD_INTEGER:
    case RT_FIELD_PAIR:
    case RT_FIELD_VECTOR:
    case RT_FIELD_COLOUR:
    case RT_FIELD_TRANSLATE:
    case RT_FIELD_ROTATE:
    case RT_FIELD_SCALE:
    case RT_FIELD_MATRIX:
        parse_numbers(parser, &context);
    }
}
