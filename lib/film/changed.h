/* changed.h - what of a film has changed since it was packed: pixels of the units done since. */
#ifndef RT_LIB_FILM_CHANGED_H
#define RT_LIB_FILM_CHANGED_H

#include "film/film.h"

/* A film as it was. All zero: none; rt_film_state_free. */
typedef struct rt_film_state {
    const rt_film *film; /* not read: it may be gone */
    double made;         /* the film's */
    uint64_t scene, light;
    int lacks_base;
    rt_units units;
    rt_coverage done;
} rt_film_state;

/*
 * Sets changed [rt_film_bands] for each band (film_file.h) in which the film may differ from the
 * state: all of them where it is of another film, has lost units, or has got the samples of
 * units.base since. All others are those of units, so that a row of which no unit was done since is
 * the same.
 */
void rt_film_changed(uint8_t *changed, const rt_film *film, const rt_film_state *before);

/* Notes how a film is; the state is that of no film where memory is short. */
void rt_film_state_take(rt_film_state *state, const rt_film *film);
void rt_film_state_free(rt_film_state *state);

#endif
