#include "nearest.h"

#include <string.h>

#define LONGEST_NAME 31

static size_t least(size_t a, size_t b)
{
    return a < b ? a : b;
}

/*
 * Edits (insert, delete, replace, swap neighbours) that turn a into b: the optimal string alignment
 * distance, by dynamic programming over three rows. Both are at most LONGEST_NAME long.
 */
static size_t edit_distance(const char *a, const char *b)
{
    size_t rows[3][LONGEST_NAME + 1];
    size_t b_length = strlen(b);
    for (size_t j = 0; j <= b_length; j++)
        rows[0][j] = j;
    size_t i = 1;
    for (; a[i - 1] != '\0'; i++) {
        size_t *row = rows[i % 3];
        const size_t *above = rows[(i + 2) % 3], *above2 = rows[(i + 1) % 3];
        row[0] = i;
        for (size_t j = 1; j <= b_length; j++) {
            row[j] = least(least(above[j], row[j - 1]) + 1, above[j - 1] + (a[i - 1] != b[j - 1]));
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = least(row[j], above2[j - 2] + 1);
        }
    }
    return rows[(i - 1) % 3][b_length];
}

nearest nearest_begin(const char *wanted)
{
    /* A third of the letters may be wrong, rounded to the nearest, and at least one. */
    size_t length = strlen(wanted);
    nearest search = {wanted, NULL, (length + 1) / 3 + 1 + (length < 2)};
    return search;
}

void nearest_offer(nearest *search, const char *name)
{
    if (strlen(search->wanted) > LONGEST_NAME || strlen(name) > LONGEST_NAME)
        return;
    size_t distance = edit_distance(search->wanted, name);
    if (distance < search->distance) {
        search->best = name;
        search->distance = distance;
    }
}
