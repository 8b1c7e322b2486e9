/* suggest.h - the nearest known name to a mistyped one. */
#ifndef RT_DSL_SUGGEST_H
#define RT_DSL_SUGGEST_H

#include "dsl/names.h"

/* The search: offer every known name, then read `best` (at == NULL: none is near enough). */
typedef struct rt_suggestion {
    rt_text wanted;
    rt_text best;
    int distance; /* of best */
} rt_suggestion;

rt_suggestion rt_suggestion_begin(rt_text wanted);
void rt_suggestion_offer(rt_suggestion *suggestion, rt_text known);
void rt_suggestion_offer_word(rt_suggestion *suggestion, const char *known);
void rt_suggestion_offer_names(rt_suggestion *suggestion, const rt_names *names);

/*
 * Edits that turn a into b, ignoring case: a letter inserted, removed or replaced, or two
 * neighbours swapped (optimal string alignment). More than `limit` is returned as limit + 1.
 */
int rt_edit_distance(rt_text a, rt_text b, int limit);

/* Whether a word is the sign of a unit, such as cm, and what to say then. */
int rt_text_is_unit(rt_text text);
#define RT_UNIT_HINT "numbers are written without units: lengths are metres, angles degrees"

#endif
