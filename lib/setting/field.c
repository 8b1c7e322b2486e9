/* field.c - ranges, and what a field takes, in words. */
#include "rt/field.h"

#include <math.h>
#include <stdio.h>

#define WORDS_MAX 12 /* of a choice that a phrase lists */

const char *rt_range_phrase(char *out, size_t size, rt_range range)
{
    switch (range.kind) {
    case RT_RANGE_ANY:
        out[0] = '\0';
        break;
    case RT_RANGE_ABOVE:
        snprintf(out, size, "greater than %.10g, at most %.10g", range.low, range.high);
        break;
    case RT_RANGE_CLOSED:
        snprintf(out, size, "from %.10g to %.10g", range.low, range.high);
        break;
    case RT_RANGE_ZERO_OR:
        snprintf(out, size, "from %.10g to %.10g, or 0", range.low, range.high);
        break;
    case RT_RANGE_BETWEEN:
        snprintf(out, size, "between %.10g and %.10g, both excluded", range.low, range.high);
        break;
    case RT_RANGE_DIRECTION:
    case RT_RANGE_NOT_ZERO:
        snprintf(out, size, "not zero");
        break;
    }
    return out;
}

/* The largest number of a range as it may be stored, if it is no whole number: a float. */
static double highest(rt_range range)
{
    return range.high == floor(range.high) ? range.high : fmax(range.high, (float)range.high);
}

/* Whether low <= value <= high, where value may be either rounded to single precision. */
static int is_closed_in(rt_range range, double value)
{
    return value >= fmin(range.low, (float)range.low) && value <= highest(range);
}

int rt_range_holds(rt_range range, double value)
{
    switch (range.kind) {
    case RT_RANGE_ABOVE:
        return value > range.low && value <= highest(range);
    case RT_RANGE_CLOSED:
        return is_closed_in(range, value);
    case RT_RANGE_ZERO_OR:
        return value == 0 || is_closed_in(range, value);
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

const rt_word *rt_field_words(const rt_field *field)
{
    static const rt_word booleans[] = {{"false", 0, ""}, {"true", 1, ""}, RT_WORD_END};
    static const rt_word all[] = {{"all", (int)RT_NONE, ""}, RT_WORD_END};
    return field->type == RT_FIELD_BOOLEAN ? booleans
           : field->type == RT_FIELD_COUNT ? all
                                           : field->words;
}

/* A choice of words, by their number where a message would be too long with all of them. */
static const char *choice_phrase(char *out, size_t size, const rt_word *words)
{
    int count = 0;
    while (words[count].name)
        count++;
    if (count <= WORDS_MAX)
        return rt_words_join(out, size, words);
    snprintf(out, size, "one of %d words", count);
    return out;
}

const char *rt_field_phrase(char *out, size_t size, const rt_field *field)
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
        [RT_FIELD_GRID] = "the name of a grid",
        [RT_FIELD_PART] = "the name of a material or black",
        [RT_FIELD_FILE] = "a file name in quotes",
        [RT_FIELD_STRING] = "a name in quotes",
        [RT_FIELD_TRANSLATE] = "three numbers",
        [RT_FIELD_ROTATE] = "four numbers",
        [RT_FIELD_SCALE] = "one or three numbers",
        [RT_FIELD_MATRIX] = "twelve numbers",
    };
    if (field->type == RT_FIELD_CHOICE)
        return choice_phrase(out, size, field->words);
    snprintf(out, size, "%s", phrases[field->type]);
    return out;
}
