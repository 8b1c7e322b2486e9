#include "dsl/schema.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

const rt_block *rt_schema_find(rt_text word, const rt_text *kind)
{
    for (size_t i = 0; i < RT_BLOCK_COUNT; i++) {
        const rt_block *block = &rt_blocks[i];
        if (rt_text_equal(word, block->word) && !block->kind == !kind &&
            (!kind || rt_text_equal(*kind, block->kind)))
            return block;
    }
    return NULL;
}

int rt_schema_is_block(rt_text word)
{
    for (size_t i = 0; i < RT_BLOCK_COUNT; i++)
        if (rt_text_equal(word, rt_blocks[i].word))
            return 1;
    return 0;
}

int rt_schema_has_kinds(rt_text word)
{
    for (size_t i = 0; i < RT_BLOCK_COUNT; i++)
        if (rt_blocks[i].kind && rt_text_equal(word, rt_blocks[i].word))
            return 1;
    return 0;
}

const rt_field *rt_schema_field(const rt_block *block, rt_text name)
{
    for (size_t i = 0; i < block->field_count; i++)
        if (rt_text_equal(name, block->fields[i].name))
            return &block->fields[i];
    return NULL;
}

int rt_field_is_transform(const rt_field *field)
{
    return field->type >= RT_FIELD_TRANSLATE && field->type <= RT_FIELD_MATRIX;
}

const char *rt_block_title(char out[RT_BLOCK_TITLE_SIZE], const rt_block *block)
{
    snprintf(out, RT_BLOCK_TITLE_SIZE, "%s%s%s", block->word, block->kind ? " " : "",
             block->kind ? block->kind : "");
    return out;
}

/* "a, b or c" */
static void join_choices(char out[RT_PHRASE_SIZE], const char *const *choices)
{
    size_t used = 0;
    out[0] = '\0';
    for (size_t i = 0; choices[i] && used < RT_PHRASE_SIZE; i++) {
        const char *before = i == 0 ? "" : choices[i + 1] ? ", " : " or ";
        used += (size_t)snprintf(out + used, RT_PHRASE_SIZE - used, "%s%s", before, choices[i]);
    }
}

const char *rt_field_phrase(char out[RT_PHRASE_SIZE], const rt_field *field)
{
    static const char *const phrases[] = {
        [RT_FIELD_NUMBER] = "a number",
        [RT_FIELD_INTEGER] = "a whole number",
        [RT_FIELD_COUNT] = "a whole number or all",
        [RT_FIELD_PAIR] = "two numbers",
        [RT_FIELD_VECTOR] = "three numbers",
        [RT_FIELD_COLOUR] = "one or three numbers",
        [RT_FIELD_BOOLEAN] = "true or false",
        [RT_FIELD_CHOICE] = "",
        [RT_FIELD_MATERIAL] = "the name of a material",
        [RT_FIELD_TEXTURE] = "the name of a texture",
        [RT_FIELD_FILE] = "a file name in quotes",
        [RT_FIELD_TRANSLATE] = "three numbers",
        [RT_FIELD_ROTATE] = "four numbers",
        [RT_FIELD_SCALE] = "one or three numbers",
        [RT_FIELD_MATRIX] = "twelve numbers",
    };
    if (field->type == RT_FIELD_CHOICE)
        join_choices(out, field->choices);
    else
        snprintf(out, RT_PHRASE_SIZE, "%s", phrases[field->type]);
    return out;
}

const char *rt_range_phrase(char out[RT_PHRASE_SIZE], rt_range range)
{
    switch (range.kind) {
    case RT_RANGE_ANY:
        out[0] = '\0';
        break;
    case RT_RANGE_ABOVE:
        snprintf(out, RT_PHRASE_SIZE, "greater than %.10g, at most %.10g", range.low, range.high);
        break;
    case RT_RANGE_CLOSED:
        snprintf(out, RT_PHRASE_SIZE, "from %.10g to %.10g", range.low, range.high);
        break;
    case RT_RANGE_BETWEEN:
        snprintf(out, RT_PHRASE_SIZE, "between %.10g and %.10g, both excluded", range.low,
                 range.high);
        break;
    case RT_RANGE_DIRECTION:
    case RT_RANGE_NOT_ZERO:
        snprintf(out, RT_PHRASE_SIZE, "not zero");
        break;
    }
    return out;
}

int rt_range_holds(rt_range range, double value)
{
    switch (range.kind) {
    case RT_RANGE_ABOVE:
        return value > range.low && value <= range.high;
    case RT_RANGE_CLOSED:
        /* it may be rounded to float */
        return value >= fmin(range.low, (float)range.low) && value <= range.high;
    case RT_RANGE_BETWEEN:
        return value > range.low && value < range.high;
    case RT_RANGE_NOT_ZERO:
        return value != 0;
    case RT_RANGE_ANY:
    case RT_RANGE_DIRECTION: /* concerns the vector as a whole */
        break;
    }
    return 1;
}
