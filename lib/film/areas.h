/* areas.h - the arrays of a film that go into its file: sums of pixels, one row each. */
#ifndef RT_LIB_FILM_AREAS_H
#define RT_LIB_FILM_AREAS_H

#include "film/columns.h"
#include "film/film.h"

/* Pixels of all planes; layers of the first hit; photon layers; moments of passes; rates. */
typedef enum rt_area_kind {
    RT_AREA_PIXELS,
    RT_AREA_FIRST_HITS,
    RT_AREA_PHOTON_SUMS,
    RT_AREA_MOMENTS,
    RT_AREA_RATES
} rt_area_kind;

typedef struct rt_film_area {
    rt_area_kind kind;
    const rt_table *table;
    void *rows;   /* the film's own */
    size_t first; /* the number of its first row: rows are counted through all areas */
    size_t count;
} rt_film_area;

enum { RT_FILM_AREAS = 5, RT_AREA_ROW_MOST = 192 /* bytes of the longest row */ };

/* The areas that a film has, in the order of their rows; returns how many. */
int rt_film_areas(rt_film_area out[RT_FILM_AREAS], const rt_film *film);

/* Whether a row, counted in its area, has samples: others are all zero. */
int rt_area_has_samples(const rt_film_area *area, size_t row);

/* Whether rows that came from a file are in range. */
int rt_area_is_sound(const rt_film_area *area, size_t row, size_t count);

#endif
