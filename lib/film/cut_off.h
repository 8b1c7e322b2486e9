/*
 * cut_off.h - how much light is missing because paths have at most max_depth segments.
 *
 * What the longest paths would have scattered at their last surface is lost. Over the throughput
 * that all paths begin with, 1 each, that is the part of the light that is missing where the
 * surfaces along a path are lit alike. Glass fills a small part of most pictures, and takes most
 * segments, so blocks of pixels count by themselves.
 */
#ifndef RT_LIB_FILM_CUT_OFF_H
#define RT_LIB_FILM_CUT_OFF_H

#include "film/film.h"

/*
 * Sets the figures in the film's stats, by its sums and its ledger, and warns where they are large.
 */
void rt_film_check_cut_off(rt_film *film, const rt_hooks *hooks);

#endif
