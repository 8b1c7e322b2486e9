/* suggest.h - the nearest known name to a mistyped one. */
#ifndef RT_DSL_SUGGEST_H
#define RT_DSL_SUGGEST_H

#include "dsl/names.h"
#include "dsl/schema.h"

/* The search: offer every known name, then read `best` (at == NULL: none is near enough). */
typedef struct rt_suggestion {
    rt_nearest search;
    rt_text best;
} rt_suggestion;

rt_suggestion rt_suggestion_begin(rt_text wanted);
void rt_suggestion_offer(rt_suggestion *suggestion, rt_text known);
void rt_suggestion_offer_word(rt_suggestion *suggestion, const char *known);
void rt_suggestion_offer_names(rt_suggestion *suggestion, const rt_names *names);
void rt_suggestion_offer_fields(rt_suggestion *suggestion, const rt_block *block);

/* Whether a word is the sign of a unit, such as cm, and what to say then. */
int rt_text_is_unit(rt_text text);
#define RT_UNIT_HINT "numbers are written without units: lengths are metres, angles degrees"

#endif
