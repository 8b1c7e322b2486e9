/* film_renders.h - renders of each mode, for tests of films that are made in parts. */
#ifndef RT_TESTS_LIB_MODE_FILM_RENDERS_H
#define RT_TESTS_LIB_MODE_FILM_RENDERS_H

#include "film/film.h"

/* The scene. */
extern const char film_room[];

/* The renders: of each mode, with all that accumulates beside the picture. */
typedef struct film_render {
    const char *name;
    rt_render_options options;
} film_render;
enum { FILM_RENDERS = 16 };
extern const film_render film_renders[FILM_RENDERS];

/* The options of one, of the whole picture. */
rt_render_options film_render_options(const film_render *render);

/* Fails unless both films have the same sums, means, layers and photon counts. */
void expect_same_film(const rt_film *a, const rt_film *b, const char *name);

#endif
