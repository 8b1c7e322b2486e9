/*
 * join.h - films of the same picture put together: one that continues another, and several that
 * each hold a part of the work. Sums are exact, so the result has the bits of a render at once.
 */
#ifndef RT_LIB_FILM_JOIN_H
#define RT_LIB_FILM_JOIN_H

#include "film/film.h"

/*
 * Copies what `from` holds to a film without samples. Fails with RT_ERROR_USAGE, saying what
 * differs, where they are not of the same scene and settings. The samples and passes of the film
 * may be more than those of `from`, and its time and target_error others.
 */
rt_status rt_film_continue(rt_film *film, const rt_film *from, rt_error *error);

#endif
