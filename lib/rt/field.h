/*
 * rt/field.h - values that a text can give: their type, range, unit, default and words, and how
 * they are read. Part of rt.h, the manual.
 */
#ifndef RT_RT_FIELD_H
#define RT_RT_FIELD_H

#include "base.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Words ----------------------------------------------------------------------------------- */

/* A word of an enum. A list of words ends with one whose name is NULL. */
typedef struct rt_word {
    const char *name;
    int value;
    const char *help; /* one line */
} rt_word;

/* A row of such a list, from an X list: rt_word modes[] = {RT_MODES(RT_WORD) RT_WORD_END}. */
#define RT_WORD(constant, name, help) {name, constant, help},
#define RT_WORD_END                                                                                \
    {                                                                                              \
        NULL, 0, NULL                                                                              \
    }

/* The word of a list that text[0] to text[length - 1] names, `_` and `-` being one; or NULL. */
RT_API const rt_word *rt_word_find(const rt_word *words, const char *text, size_t length);

/* "a, b or c": the words of a list. Returns out. */
RT_API const char *rt_words_join(char *out, size_t size, const rt_word *words);

/*
 * A search for the name that a mistyped one probably meant: begin, offer each name, read `best`.
 * The beginning of a name and what other programs call it, as `cube` for box, are near to it too.
 */
typedef struct rt_nearest {
    const char *wanted;
    size_t wanted_length;
    const char *best; /* as offered; NULL while no name is near enough */
    size_t best_length;
    size_t distance; /* edits from wanted to best; a better name has fewer */
} rt_nearest;

/* Names are not copied, and need no closing zero. */
RT_API void rt_nearest_begin(rt_nearest *search, const char *wanted, size_t length);
RT_API void rt_nearest_offer(rt_nearest *search, const char *name, size_t length);
RT_API void rt_nearest_offer_words(rt_nearest *search, const rt_word *words);

/*
 * Edits that turn a into b, whatever the case: a letter inserted, removed or replaced, or two
 * neighbours swapped (optimal string alignment). More than limit is returned as limit + 1.
 */
RT_API size_t rt_edit_distance(const char *a, size_t a_length, const char *b, size_t b_length,
                               size_t limit);

/* ---- Texts ----------------------------------------------------------------------------------- */

/*
 * How many bytes the UTF-8 byte order mark takes that a text of so many bytes begins with: 3, or 0
 * where there is none. Some editors write it; every reader of texts passes over it by this.
 */
RT_API size_t rt_byte_order_mark(const void *text, size_t size);

/* ---- Numbers --------------------------------------------------------------------------------- */

typedef enum rt_number_result {
    RT_NUMBER_OK,
    RT_NUMBER_MALFORMED, /* the text is no decimal number */
    RT_NUMBER_TOO_LARGE, /* its size is beyond double precision */
    RT_NUMBER_TOO_SMALL  /* *out has its value, not zero, which single precision takes for zero */
} rt_number_result;

/*
 * Reads [+-] digits [. digits] [e [+-] digits], at least one digit before the exponent, and nothing
 * else, whatever the locale.
 */
RT_API rt_number_result rt_number_read(double *out, const char *text, size_t length);

/* ---- Ranges ---------------------------------------------------------------------------------- */

typedef enum rt_range_kind {
    RT_RANGE_ANY,
    RT_RANGE_ABOVE,     /* greater than low, at most high */
    RT_RANGE_CLOSED,    /* low to high, both included */
    RT_RANGE_ZERO_OR,   /* low to high, both included; or 0 */
    RT_RANGE_BETWEEN,   /* low to high, both excluded */
    RT_RANGE_DIRECTION, /* any vector but zero; of a rotation, the axis */
    RT_RANGE_NOT_ZERO   /* each number */
} rt_range_kind;

/* Which numbers a field takes; of a vector or colour, each component. */
typedef struct rt_range {
    rt_range_kind kind;
    double low, high;
} rt_range;

/* "from 0 to 1", ...; "" for any. Whether a number lies in a range. */
RT_API const char *rt_range_phrase(char *out, size_t size, rt_range range);
RT_API int rt_range_holds(rt_range range, double value);

/* ---- Fields ---------------------------------------------------------------------------------- */

/* What a value is, and what the struct member is that holds it. */
typedef enum rt_field_type {
    RT_FIELD_NUMBER,   /* float, or double by the member's size */
    RT_FIELD_INTEGER,  /* uint32_t, or uint64_t by the member's size */
    RT_FIELD_COUNT,    /* uint32_t, or RT_K_ALL for the word `all` */
    RT_FIELD_PAIR,     /* float[2] */
    RT_FIELD_VECTOR,   /* float[3] */
    RT_FIELD_COLOUR,   /* float[3]; one number is a grey */
    RT_FIELD_BOOLEAN,  /* int: the words false and true */
    RT_FIELD_CHOICE,   /* int: the value of one of the field's words */
    RT_FIELD_MATERIAL, /* uint32_t: index of the material of that name */
    RT_FIELD_TEXTURE,  /* uint32_t: handle of the texture of that name */
    RT_FIELD_GRID,     /* uint32_t: handle of the grid of that name */
    RT_FIELD_PART,     /* uint32_t: 1 + index of that material, or RT_MATERIAL_BLACK for `black` */
    RT_FIELD_FILE,     /* const char *: path; at most one a block */
    RT_FIELD_STRING,   /* const char *: other text; at most one a block */
    /*
     * Steps of a transform, all into one rt_transform, in the order in which they stand; each may
     * stand often.
     */
    RT_FIELD_TRANSLATE, /* three numbers */
    RT_FIELD_ROTATE,    /* axis and degrees */
    RT_FIELD_SCALE,     /* one or three numbers */
    RT_FIELD_MATRIX     /* twelve numbers, row by row */
} rt_field_type;

/* Which fields a block must give. Those of one block marked with a group need form that group. */
typedef enum rt_field_need {
    RT_NEED_OPTIONAL,
    RT_NEED_REQUIRED,
    RT_NEED_ONE_OF,         /* group: exactly one */
    RT_NEED_AT_MOST_ONE,    /* group: one or none */
    RT_NEED_ALL_OR_NONE,    /* group: all or none */
    RT_NEED_ALL_OR_NONE_TOO /* a second such group */
} rt_field_need;

/* A value that a text can give to a member of a struct. */
typedef struct rt_field {
    const char *name;
    rt_field_type type;
    rt_field_need need;
    rt_range range;
    const char *unit;     /* "" for none */
    const char *fallback; /* the default, in words; "" when the field is required */
    const rt_word *words; /* of RT_FIELD_CHOICE */
    size_t offset, size;  /* of the member */
    const char *help;     /* what it means, in one sentence; other fields stand in backquotes */
} rt_field;

/* "one or three numbers", "true or false", "box, tent or gaussian": what a field takes. */
RT_API const char *rt_field_phrase(char *out, size_t size, const rt_field *field);

/* The words that a field takes instead of numbers, or NULL. */
RT_API const rt_word *rt_field_words(const rt_field *field);

#ifdef __cplusplus
}
#endif

#endif
