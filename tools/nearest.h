/* nearest.h - the known name that a mistyped one probably meant. */
#ifndef RTC_NEAREST_H
#define RTC_NEAREST_H

#include <stddef.h>

/* A search for the nearest of several names: begin, offer each name, take `best`. */
typedef struct nearest {
    const char *wanted;
    const char *best; /* NULL while none is near enough */
    size_t distance;  /* edits from wanted to best; a name must be nearer than this */
} nearest;

nearest nearest_begin(const char *wanted);
void nearest_offer(nearest *search, const char *name);

#endif
