/* check.c - from the values of a block, as written, to its struct. */
#include "dsl/check.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "dsl/rivals.h"
#include "dsl/suggest.h"
#include "dsl/transform.h"

static rt_place place_of_values(const rt_entry *entry)
{
    return rt_place_join(entry->values[0].place, entry->values[entry->value_count - 1].place);
}

/* ---- Numbers ------------------------------------------------------------- */

/* Evaluates the values of an entry to single numbers; one number alone is repeated to three. */
static int evaluate(const rt_checker *checker, const rt_entry *entry,
                    double out[RT_FIELD_VALUES_MAX])
{
    rt_value value;
    int count = 0;
    for (int i = 0; i < entry->value_count; i++) {
        if (!rt_expression_evaluate(&value, &entry->values[i], checker->operations,
                                    &checker->scope->constants, checker->reports))
            return 0;
        int numbers = value.is_vector || entry->value_count == 1 ? 3 : 1;
        for (int c = 0; c < numbers && count < RT_FIELD_VALUES_MAX; c++)
            out[count++] = value.v[c];
    }
    return 1;
}

static int is_integer(const rt_field *field)
{
    return field->type == RT_FIELD_INTEGER || field->type == RT_FIELD_COUNT;
}

/* A number as it will be stored: single precision, unless the member is a double. */
static int check_number(const rt_checker *checker, const rt_entry *entry, rt_place place,
                        double *number)
{
    const rt_field *field = entry->field;
    const double written = *number;
    char phrase[RT_PHRASE_SIZE];
    if (is_integer(field)) {
        if (floor(*number) != *number) {
            rt_report_error(checker->reports, place, "'%s' is %g; it must be a whole number",
                            field->name, *number);
            return 0;
        }
    } else if (fabs(*number) > FLT_MAX) {
        rt_report_error(checker->reports, place, "'%s' is %g; numbers must not exceed %g",
                        field->name, *number, FLT_MAX);
        return 0;
    } else if (field->size != sizeof(double)) {
        *number = (float)*number;
    }
    if (!rt_range_holds(field->range, *number)) {
        /*
         * Quote the number as written, unless only its rounding to float32 took it out of the
         * range.
         */
        rt_report_error(checker->reports, place, "'%s' is %.10g; it must be %s", field->name,
                        rt_range_holds(field->range, written) ? *number : written,
                        rt_range_phrase(phrase, sizeof phrase, field->range));
        return 0;
    }
    return 1;
}

static void store_scalar(const rt_field *field, double number, unsigned char *member)
{
    if (is_integer(field) && field->size == sizeof(uint64_t)) {
        uint64_t integer = (uint64_t)number;
        memcpy(member, &integer, sizeof integer);
    } else if (is_integer(field)) {
        uint32_t integer = (uint32_t)number;
        memcpy(member, &integer, sizeof integer);
    } else if (field->size == sizeof(double)) {
        memcpy(member, &number, sizeof number);
    } else {
        float single = (float)number;
        memcpy(member, &single, sizeof single);
    }
}

static int check_numbers(const rt_checker *checker, const rt_entry *entry, unsigned char *member)
{
    const rt_field *field = entry->field;
    int is_scalar = field->type == RT_FIELD_NUMBER || is_integer(field);
    int count = is_scalar ? 1 : field->type == RT_FIELD_PAIR ? 2 : 3;
    double numbers[RT_FIELD_VALUES_MAX];
    float stored[3];
    if (!evaluate(checker, entry, numbers))
        return 0;
    for (int i = 0; i < count; i++) {
        rt_place place = entry->values[entry->value_count == count ? i : 0].place;
        if (!check_number(checker, entry, place, &numbers[i]))
            return 0;
        stored[i] = (float)numbers[i];
    }
    if (is_scalar) {
        store_scalar(field, numbers[0], member);
        return 1;
    }
    if (field->range.kind == RT_RANGE_DIRECTION && stored[0] == 0 && stored[1] == 0 &&
        stored[2] == 0) {
        rt_report_error(checker->reports, place_of_values(entry), "'%s' must not be zero",
                        field->name);
        return 0;
    }
    memcpy(member, stored, (size_t)count * sizeof *stored);
    return 1;
}

/* One step of a transform. */
static int check_step(const rt_checker *checker, const rt_entry *entry, rt_steps *steps)
{
    const rt_field *field = entry->field;
    int count = field->type == RT_FIELD_MATRIX ? 12 : field->type == RT_FIELD_ROTATE ? 4 : 3;
    double numbers[RT_FIELD_VALUES_MAX], stored[RT_FIELD_VALUES_MAX];
    if (entry->is_broken || !evaluate(checker, entry, numbers))
        return 0;
    /* They must do in single precision, but a mesh far away takes them as they are. */
    memcpy(stored, numbers, sizeof stored);
    for (int i = 0; i < count; i++)
        if (!check_number(checker, entry, entry->values[entry->value_count == count ? i : 0].place,
                          &stored[i]))
            return 0;
    if (field->range.kind == RT_RANGE_DIRECTION && stored[0] == 0 && stored[1] == 0 &&
        stored[2] == 0) {
        rt_report_error(checker->reports, place_of_values(entry),
                        "the axis of '%s' must not be zero", field->name);
        return 0;
    }
    rt_steps_add(steps, field->type, numbers);
    return 1;
}

/* Reports sound steps that take all to the origin, for the last of them. Returns 0. */
static int report_zero(const rt_checker *checker, const rt_statement *statement)
{
    int last = statement->entry_count - 1;
    while (!rt_field_is_transform(statement->entries[last].field))
        last--;
    rt_report_error(checker->reports, place_of_values(&statement->entries[last]),
                    "the transform cannot be inverted: it is zero");
    return 0;
}

/* Stores the steps of a transform. Zero would stand for none, as where C gives none. */
static int store_transform(const rt_checker *checker, const rt_steps *steps,
                           const rt_statement *statement, rt_block_fields *fields)
{
    rt_transform transform;
    int is_zero = 1;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++) {
            transform.m[i][j] = steps->m[i][j];
            is_zero = is_zero && (float)transform.m[i][j] == 0;
        }
    if (is_zero)
        return report_zero(checker, statement);
    const rt_field *field;
    for (size_t i = 0; (field = rt_block_field(statement->block, i)) != NULL; i++)
        if (rt_field_is_transform(field))
            memcpy((unsigned char *)fields + field->offset, &transform, sizeof transform);
    return 1;
}

/* ---- Words --------------------------------------------------------------- */

static void report_choice(const rt_checker *checker, const rt_entry *entry)
{
    char quote[RT_QUOTE_SIZE], phrase[RT_PHRASE_SIZE], list[2 * RT_PHRASE_SIZE];
    rt_text word = rt_place_text(&entry->word);
    rt_suggestion suggestion = rt_suggestion_begin(word);
    for (const rt_word *known = rt_field_words(entry->field); known->name; known++)
        rt_suggestion_offer_word(&suggestion, known->name);
    rt_report_error(checker->reports, entry->word, "'%s' takes %s, found '%s'", entry->field->name,
                    rt_field_phrase(phrase, sizeof phrase, entry->field),
                    rt_text_quote(quote, word));
    if (suggestion.best.at)
        rt_report_hint(checker->reports, "did you mean '%s'?", suggestion.best.at);
    else if (strncmp(phrase, "one of ", 7) == 0)
        rt_report_hint(checker->reports, "%s",
                       rt_words_join(list, sizeof list, rt_field_words(entry->field)));
}

static int check_choice(const rt_checker *checker, const rt_entry *entry, unsigned char *member)
{
    rt_text text = rt_place_text(&entry->word);
    const rt_word *word = rt_word_find(rt_field_words(entry->field), text.at, text.length);
    if (!word) {
        report_choice(checker, entry);
        return 0;
    }
    memcpy(member, &word->value, sizeof word->value);
    return 1;
}

/* What this is the name of, where it is one of a material, a texture, a mesh or a grid. */
static const char *kind_of(const rt_scope *scope, rt_text word)
{
    return rt_names_find(&scope->materials, word) != RT_NAME_NONE  ? "material"
           : rt_names_find(&scope->textures, word) != RT_NAME_NONE ? "texture"
           : rt_names_find(&scope->meshes, word) != RT_NAME_NONE   ? "mesh"
           : rt_names_find(&scope->grids, word) != RT_NAME_NONE    ? "grid"
                                                                   : NULL;
}

const rt_name *rt_check_known(const rt_checker *checker, const rt_names *names, rt_place place,
                              const char *kind)
{
    char quote[RT_QUOTE_SIZE];
    rt_text word = rt_place_text(&place);
    size_t found = rt_names_find(names, word);
    if (found != RT_NAME_NONE) {
        names->items[found].is_used = 1;
        return &names->items[found];
    }
    rt_suggestion suggestion = rt_suggestion_begin(word);
    rt_suggestion_offer_names(&suggestion, names);
    rt_report_error(checker->reports, place, "unknown %s '%s'", kind, rt_text_quote(quote, word));
    const char *const other = kind_of(checker->scope, word);
    if (other)
        rt_report_hint(checker->reports, "'%s' is a %s", quote, other);
    else if (suggestion.best.at)
        rt_report_hint(checker->reports, "did you mean '%s'?",
                       rt_text_quote(quote, suggestion.best));
    else
        rt_report_hint(checker->reports, "%s%s are defined by '%s NAME { ... }' above their use",
                       kind, strcmp(kind, "mesh") == 0 ? "es" : "s", kind);
    rt_report_unknown(checker->reports, names);
    return NULL;
}

/* Reports a texture that is to lie inside of itself. Others cannot: names are used below them. */
static int is_itself(const rt_checker *checker, const rt_names *names, const rt_entry *entry)
{
    char quote[RT_QUOTE_SIZE];
    if (checker->texture.length == 0 || entry->field->type != RT_FIELD_TEXTURE)
        return 0;
    const rt_text own = rt_place_text(&checker->texture), word = rt_place_text(&entry->word);
    if (own.length != word.length || memcmp(own.at, word.at, own.length) != 0 ||
        rt_names_find(names, word) != RT_NAME_NONE)
        return 0;
    rt_report_error(checker->reports, entry->word, "texture '%s' cannot lie inside of itself",
                    rt_text_quote(quote, word));
    return 1;
}

static int check_name(const rt_checker *checker, const rt_entry *entry, unsigned char *member)
{
    const rt_names *names = rt_scope_names(checker->scope, entry->field->type);
    if (is_itself(checker, names, entry))
        return 0;
    const rt_name *name =
        rt_check_known(checker, names, entry->word, rt_scope_kind(entry->field->type));
    if (!name)
        return 0;
    memcpy(member, &name->index, sizeof name->index);
    return !name->is_broken;
}

/* A material as a part of another: `black` is one that every scene has, unless it has its own. */
static int check_part(const rt_checker *checker, const rt_entry *entry, unsigned char *member)
{
    const rt_text word = rt_place_text(&entry->word);
    uint32_t part = RT_MATERIAL_BLACK;
    if (word.length == strlen(RT_BLACK_WORD) && memcmp(word.at, RT_BLACK_WORD, word.length) == 0 &&
        rt_names_find(&checker->scope->materials, word) == RT_NAME_NONE) {
        memcpy(member, &part, sizeof part);
        return 1;
    }
    if (!check_name(checker, entry, member))
        return 0;
    memcpy(&part, member, sizeof part);
    part++;
    memcpy(member, &part, sizeof part);
    return 1;
}

/* The path of a file, relative to the text that names it. */
static int check_file(const rt_checker *checker, const rt_entry *entry, unsigned char *member)
{
    rt_text name = rt_place_text(&entry->word);
    if (name.length == 0) {
        rt_report_error(checker->reports, entry->word, "the name of the file is empty");
        return 0;
    }
    *checker->path = rt_source_resolve(entry->word.source, name);
    if (!*checker->path) {
        checker->reports->out_of_memory = 1;
        return 0;
    }
    if (!rt_path_is_within(checker->root, *checker->path)) {
        char quote[RT_QUOTE_SIZE];
        rt_report_error(checker->reports, entry->word, "'%s' lies outside of the scene's folder",
                        rt_text_quote(quote, name));
        free(*checker->path);
        *checker->path = NULL;
        return 0;
    }
    memcpy(member, checker->path, sizeof *checker->path);
    return 1;
}

static int check_string(const rt_checker *checker, const rt_entry *entry, unsigned char *member)
{
    const rt_text text = rt_place_text(&entry->word);
    if (text.length == 0) {
        rt_report_error(checker->reports, entry->word, "'%s' is empty", entry->field->name);
        return 0;
    }
    *checker->string = malloc(text.length + 1);
    if (!*checker->string) {
        checker->reports->out_of_memory = 1;
        return 0;
    }
    memcpy(*checker->string, text.at, text.length);
    (*checker->string)[text.length] = '\0';
    memcpy(member, checker->string, sizeof *checker->string);
    return 1;
}

/* A number, or the word `all` in its place. */
static int check_count(const rt_checker *checker, const rt_entry *entry, unsigned char *member)
{
    return entry->value_count > 0 ? check_numbers(checker, entry, member)
                                  : check_choice(checker, entry, member);
}

static int check_entry(const rt_checker *checker, const rt_entry *entry, rt_block_fields *fields)
{
    unsigned char *member = (unsigned char *)fields + entry->field->offset;
    if (entry->is_broken)
        return 0;
    switch (entry->field->type) {
    case RT_FIELD_BOOLEAN:
    case RT_FIELD_CHOICE:
        return check_choice(checker, entry, member);
    case RT_FIELD_MATERIAL:
    case RT_FIELD_TEXTURE:
    case RT_FIELD_GRID:
        return check_name(checker, entry, member);
    case RT_FIELD_PART:
        return check_part(checker, entry, member);
    case RT_FIELD_COUNT:
        return check_count(checker, entry, member);
    case RT_FIELD_FILE:
        return check_file(checker, entry, member);
    case RT_FIELD_STRING:
        return check_string(checker, entry, member);
    case RT_FIELD_NUMBER:
    case RT_FIELD_INTEGER:
    case RT_FIELD_PAIR:
    case RT_FIELD_VECTOR:
    case RT_FIELD_COLOUR:
    case RT_FIELD_TRANSLATE:
    case RT_FIELD_ROTATE:
    case RT_FIELD_SCALE:
    case RT_FIELD_MATRIX:
        break;
    }
    return check_numbers(checker, entry, member);
}

/* ---- Completeness -------------------------------------------------------- */

/* "'na', 'nb' and 'nc'": the fields of a block with this need. */
static void join_group(char out[RT_PHRASE_SIZE], const rt_block *block, rt_field_need need,
                       const char *conjunction)
{
    size_t used = 0, left = 0;
    const rt_field *field;
    for (size_t i = 0; (field = rt_block_field(block, i)) != NULL; i++)
        left += field->need == need;
    for (size_t i = 0; (field = rt_block_field(block, i)) && used < RT_PHRASE_SIZE; i++) {
        if (field->need != need)
            continue;
        const char *after = --left == 0 ? "" : left == 1 ? conjunction : ", ";
        used += (size_t)snprintf(out + used, RT_PHRASE_SIZE - used, "'%s'%s", field->name, after);
    }
}

/* The fields of a block that need each other. */
typedef struct rt_group {
    int size, given;
    const rt_entry *last; /* the latest given */
} rt_group;

/* Counts the fields of a block by their need. */
static void count_groups(rt_group groups[RT_NEED_ALL_OR_NONE_TOO + 1],
                         const rt_statement *statement)
{
    const rt_field *field;
    memset(groups, 0, (RT_NEED_ALL_OR_NONE_TOO + 1) * sizeof *groups);
    for (size_t i = 0; (field = rt_block_field(statement->block, i)) != NULL; i++) {
        if (field->need == RT_NEED_OPTIONAL)
            continue;
        rt_group *group = &groups[field->need];
        const rt_entry *entry = rt_statement_entry(statement, field);
        group->size++;
        group->given += entry != NULL;
        if (entry && (!group->last || entry->name.order > group->last->name.order))
            group->last = entry;
    }
}

static int check_all_or_none(const rt_checker *checker, const rt_statement *statement,
                             rt_field_need need, const rt_group *group)
{
    char names[RT_PHRASE_SIZE], title[RT_BLOCK_TITLE_SIZE];
    if (group->given == 0 || group->given == group->size || statement->is_incomplete)
        return 1;
    join_group(names, statement->block, need, " and ");
    rt_report_error(checker->reports, statement->place, "%s needs all of %s, or none",
                    rt_block_title(title, statement->block), names);
    return 0;
}

static int check_one(const rt_checker *checker, const rt_statement *statement, rt_field_need need,
                     const rt_group *group)
{
    char names[RT_PHRASE_SIZE], title[RT_BLOCK_TITLE_SIZE];
    const int is_missing =
        need == RT_NEED_ONE_OF && group->size > 0 && group->given == 0 && !statement->is_incomplete;
    if (group->given <= 1 && !is_missing)
        return 1;
    join_group(names, statement->block, need, " or ");
    rt_block_title(title, statement->block);
    if (is_missing)
        rt_report_error(checker->reports, statement->place, "%s needs %s", title, names);
    else
        rt_report_error(checker->reports, group->last->name, "%s takes %s, not both", title, names);
    return 0;
}

static int check_required(const rt_checker *checker, const rt_statement *statement,
                          const rt_group *group)
{
    const rt_block *block = statement->block;
    char list[RT_PHRASE_SIZE] = "", title[RT_BLOCK_TITLE_SIZE];
    size_t used = 0;
    if (group->given == group->size || statement->is_incomplete)
        return 1;
    const rt_field *field;
    for (size_t i = 0; (field = rt_block_field(block, i)) && used < sizeof list; i++)
        if (field->need == RT_NEED_REQUIRED && !rt_statement_entry(statement, field))
            used += (size_t)snprintf(list + used, sizeof list - used, "%s'%s'", used ? ", " : "",
                                     field->name);
    rt_report_error(checker->reports, statement->place, "%s needs %s", rt_block_title(title, block),
                    list);
    return 0;
}

int rt_check_block(const rt_checker *checker, const rt_statement *statement,
                   rt_block_fields *fields)
{
    int is_good = !statement->is_broken;
    rt_group groups[RT_NEED_ALL_OR_NONE_TOO + 1];
    rt_steps steps;
    rt_steps_begin(&steps);
    for (int i = 0; i < statement->entry_count; i++) {
        const rt_entry *entry = &statement->entries[i];
        is_good &= rt_field_is_transform(entry->field) ? check_step(checker, entry, &steps)
                                                       : check_entry(checker, entry, fields);
    }
    if (is_good && steps.count > 0)
        is_good = store_transform(checker, &steps, statement, fields);
    is_good &= rt_rivals_check(statement, checker->reports);
    count_groups(groups, statement);
    is_good &= check_required(checker, statement, &groups[RT_NEED_REQUIRED]);
    for (rt_field_need need = RT_NEED_ONE_OF; need <= RT_NEED_AT_MOST_ONE; need++)
        is_good &= check_one(checker, statement, need, &groups[need]);
    for (rt_field_need need = RT_NEED_ALL_OR_NONE; need <= RT_NEED_ALL_OR_NONE_TOO; need++)
        is_good &= check_all_or_none(checker, statement, need, &groups[need]);
    return is_good;
}
