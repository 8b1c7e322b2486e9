/* pass_film.h - the film of one pass, cleared and added to the render's on several threads. */
#ifndef RT_LIB_MODE_PHOTON_PASS_FILM_H
#define RT_LIB_MODE_PHOTON_PASS_FILM_H

#include "film/film.h"

/* Clears the pixels of a pass, and what its layers sum, which may be NULL. */
void rt_pass_film_clear(rt_film_pixel *pass, rt_photon_sums *pass_sums, size_t pixels,
                        uint32_t threads);

/* Adds both to a plane of the film and to the sums of its layers. */
void rt_pass_film_join(rt_film_pixel *plane, rt_photon_sums *sums, const rt_film_pixel *pass,
                       const rt_photon_sums *pass_sums, size_t pixels, uint32_t threads);

#endif
