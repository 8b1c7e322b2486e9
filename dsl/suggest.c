#include "dsl/suggest.h"

#include <string.h>

#define LENGTH_MAX 48   /* longer words get no suggestion */
#define NAMES_MAX 10000 /* of a table that are looked at */

static char lower(char c)
{
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

static int least(int a, int b)
{
    return a < b ? a : b;
}

int rt_edit_distance(rt_text a, rt_text b, int limit)
{
    size_t gap = a.length > b.length ? a.length - b.length : b.length - a.length;
    if (a.length > LENGTH_MAX || b.length > LENGTH_MAX || gap > (size_t)limit)
        return limit + 1;

    /* rows[i % 3][j]: distance of the first i letters of a and the first j of b. */
    int rows[3][LENGTH_MAX + 1];
    for (size_t j = 0; j <= b.length; j++)
        rows[0][j] = (int)j;
    for (size_t i = 1; i <= a.length; i++) {
        int *row = rows[i % 3], *above = rows[(i + 2) % 3], *above2 = rows[(i + 1) % 3];
        row[0] = (int)i;
        for (size_t j = 1; j <= b.length; j++) {
            char x = lower(a.at[i - 1]), y = lower(b.at[j - 1]);
            row[j] = least(above[j - 1] + (x != y), 1 + least(above[j], row[j - 1]));
            if (i > 1 && j > 1 && x == lower(b.at[j - 2]) && y == lower(a.at[i - 2]))
                row[j] = least(row[j], above2[j - 2] + 1);
        }
    }
    return least(rows[a.length % 3][b.length], limit + 1);
}

/* How far a word of this length may be from the name it meant. */
static int tolerance(size_t length)
{
    return length < 3 ? 0 : length < 5 ? 1 : length < 9 ? 2 : 3;
}

rt_suggestion rt_suggestion_begin(rt_text wanted)
{
    rt_suggestion suggestion = {wanted, {NULL, 0}, tolerance(wanted.length) + 1};
    return suggestion;
}

void rt_suggestion_offer(rt_suggestion *suggestion, rt_text known)
{
    if (suggestion->distance == 0)
        return;
    int distance = rt_edit_distance(suggestion->wanted, known, suggestion->distance - 1);
    if (distance < suggestion->distance) {
        suggestion->distance = distance;
        suggestion->best = known;
    }
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

int rt_text_is_unit(rt_text text)
{
    static const char *const units[] = {"m",       "mm",  "cm", "km", "deg",
                                        "degrees", "rad", "px", "W",  "s"};
    for (size_t i = 0; i < sizeof units / sizeof *units; i++)
        if (rt_text_equal(text, units[i]))
            return 1;
    return 0;
}
