/*
 * rates.h - adaptive sampling: how many samples pixels have.
 *
 * All pixels have the same first samples, the pilot. From then on a pixel has as many as its rate
 * says for each that pixels have on average. With a fixed number of samples in all, the mean of
 * the pixels' variances is least where they are in proportion to the standard deviation of a sample
 * (Neyman 1934). That of pixel i is taken from the variances v_j (noise.h) that the pilot tells of
 * the other pixels in the 9 x 9 around it,
 *
 *   q_i = sqrt(mean of v_j, j /= i),    rate_i ~ 0.5 + 0.5 q_i / mean of q,
 *
 * at most 8, and 1 on average. So what a pixel's own samples are does not decide on how many more
 * there will be, and its mean has no bias; a feature that the pilot missed in a pixel is found by
 * its neighbours. Noise that one pixel has alone, such as that of a distant light that is smaller
 * than it, is what this cannot see: such a pixel has half of the samples, no pixel has much less.
 *
 * A rate depends on the scene, the settings and the pilot alone, so a film is the same however its
 * units are shared out: where those of the pilot are another's, they are rendered for the rates.
 *
 * The mean variance of uniform sampling over that of adaptive, 192 samples at 96 x 96 pixels: 4.5
 * (box_area), 1.6 (depth_of_field, soft_shadow), 1.4 (interior), 1.3 (cornell, glass_metal), 1.0
 * (box_point, doorway, many_lights, textures); 1.4 in the geometric mean. With 0.3 in place of 0.5
 * it is 1.46, and a noisy pixel alone has three tenths of the samples. The third root in place of
 * the square root, as for samples whose error falls faster, is as good. Samples of noisy pixels
 * take longer, so there is less to gain by the clock: 1.9, 1.2 (cornell), 1.1 (glass_metal,
 * interior), 1.0.
 *
 * References:
 *   Neyman: "On the Two Different Aspects of the Representative Method", Journal of the Royal
 *     Statistical Society 97(4), 1934 (optimum allocation).
 */
#ifndef RT_LIB_FILM_RATES_H
#define RT_LIB_FILM_RATES_H

#include "film/film.h"

/* Whether the film has its rates, or needs none. */
int rt_rates_are_known(const rt_film *film);

/* Whether a unit of the film takes samples by its rates. */
int rt_rates_are_needed(const rt_film *film, uint64_t unit);

/* Whether the film has the units of the pilot, which are the first, and no others. */
int rt_rates_can_be_found(const rt_film *film);

/* Sets the film's rates by the sums of a film that has the pilot alone, which may be the same. */
rt_status rt_rates_find(rt_film *film, const rt_film *pilot, rt_error *error);

/* Takes those of another film of the same picture; RT_ERROR_USAGE where it has others. */
rt_status rt_rates_join(rt_film *film, const rt_film *from, rt_error *error);

#endif
