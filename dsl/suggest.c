/* suggest.c - the nearest known name to a mistyped one. */
#include "dsl/suggest.h"

#include <string.h>

#define NAMES_MAX 10000 /* of a table that are looked at */

rt_suggestion rt_suggestion_begin(rt_text wanted)
{
    rt_suggestion suggestion;
    memset(&suggestion, 0, sizeof suggestion);
    rt_nearest_begin(&suggestion.search, wanted.at, wanted.length);
    return suggestion;
}

void rt_suggestion_offer(rt_suggestion *suggestion, rt_text known)
{
    rt_nearest_offer(&suggestion->search, known.at, known.length);
    suggestion->best = (rt_text){suggestion->search.best, suggestion->search.best_length};
}

void rt_suggestion_offer_word(rt_suggestion *suggestion, const char *known)
{
    rt_text text = {known, strlen(known)};
    rt_suggestion_offer(suggestion, text);
}

void rt_suggestion_offer_names(rt_suggestion *suggestion, const rt_names *names)
{
    for (size_t i = 0; i < names->count && i < NAMES_MAX; i++)
        rt_suggestion_offer(suggestion, names->items[i].text);
}

void rt_suggestion_offer_fields(rt_suggestion *suggestion, const rt_block *block)
{
    const rt_field *field;
    for (size_t i = 0; (field = rt_block_field(block, i)) != NULL; i++)
        rt_suggestion_offer_word(suggestion, field->name);
}

int rt_text_is_unit(rt_text text)
{
    static const char *const units[] = {"m",       "mm",  "cm", "km", "deg",
                                        "degrees", "rad", "px", "W",  "s"};
    for (size_t i = 0; i < sizeof units / sizeof *units; i++)
        if (rt_text_equal(text, units[i]))
            return 1;
    return 0;
}
