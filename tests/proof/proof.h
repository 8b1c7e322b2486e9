/*
 * proof.h - checks of rendered light against closed forms and against other techniques, and their
 * table.
 *
 * A scene is rendered `proof_renders` times, each time with another seed. A measure of each render,
 * such as the mean of its film, gives that many independent values, whose spread is the standard
 * error of their mean: nothing is assumed of pixels or samples. The deviation from what is
 * expected, in standard errors, has Student's t distribution, and a check fails beyond 7.0 standard
 * errors, which happens by chance in fewer than one of 10^7 runs.
 *
 * Every check is a row of tests/proof/README.md, which `make proof` writes; see page.h.
 */
#ifndef RT_TESTS_PROOF_H
#define RT_TESTS_PROOF_H

#include "support.h"

enum { proof_renders = 32 };

/*
 * Of one check, or of all pixels of one comparison. There are some 350: 3 false alarms in 10^5 runs
 * of them all.
 */
#define PROOF_FALSE_ALARM 7e-8

/* What single precision may do to a value, as a part of it; counted as a standard error. */
#define PROOF_ROUNDING 1e-6

/* One scene, rendered with every seed. */
typedef struct proof_films {
    uint32_t width, height;
    float *rgb[proof_renders]; /* [height][width][3], linear radiance */
} proof_films;

/* A number that each render gave. */
typedef struct proof_values {
    double of[proof_renders];
} proof_values;

/*
 * What a row of the table says beside the numbers: the scene, how it was rendered, the closed form
 * or the peer.
 */
typedef struct proof_row {
    const char *scene, *by, *formula;
} proof_row;

/* The text of a scene, or of a cell, from a format; lives until eight more were made. */
const char *proof_text(const char *format, ...) __attribute__((format(printf, 1, 2)));

/*
 * Renders a scene text with the seeds options->seed and on. Free with proof_free. Errors fail the
 * test.
 */
void proof_render(proof_films *out, const char *text, const rt_render_options *options);
void proof_free(proof_films *films);

/* The mean of a channel over the film, and over its columns x0 <= x < x1 and rows y0 <= y < y1. */
proof_values proof_mean(const proof_films *films, int channel);
proof_values proof_mean_of(const proof_films *films, int channel, uint32_t x0, uint32_t y0,
                           uint32_t x1, uint32_t y1);

/* Fails unless the mean of the values is as expected. */
void proof_check(proof_row row, double expected, const proof_values *values);

/* Renders a scene and checks the mean of its film, in green. */
void proof_radiance(proof_row row, double expected, const char *text,
                    const rt_render_options *options);

/*
 * Fails unless two techniques have the same mean in every pixel and channel, and over the film.
 */
void proof_same(proof_row row, const proof_films *a, const proof_films *peer);

/* The last test of each program, which ends its section of the page. */
void proof_page(const char *title);

#endif
