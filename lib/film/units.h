/*
 * units.h - the units of work that a picture is made of. A unit is one block of samples of one
 * pixel or, in progressive passes, one pass of the whole picture, as an iteration of mode vcm is.
 * Its samples depend on the scene, the settings and its number alone, and sums of the film are
 * exact (camera/film_sum.h), so units may be taken in any order, in any number of sittings and on
 * any number of machines.
 *
 * Where the error is estimated, samples are taken in a few sequences (replicates), each scrambled
 * on its own, which grow together: few and long sequences keep most of the advantage that a Sobol
 * sequence has over independent samples, and the variance among them estimates the error (noise.h).
 * Two are enough for the error of a picture of many pixels, each of which has samples of its own;
 * the variance of a pixel, and pixels that share photons, take eight.
 *
 * Unit number = block * pixels + item, items in the order of the kernels' tiles. Blocks end at 1,
 * 2, 3, 4, 6, 8, 12, 16 samples of a sequence and so on, as far as they are no longer than
 * `longest`; a block of each sequence, then the next of each.
 */
#ifndef RT_LIB_FILM_UNITS_H
#define RT_LIB_FILM_UNITS_H

#include <stdint.h>

#include "rt.h"
#include "types.h"

/* Sequences for the error of the picture alone, where it has as many pixels as this or more. */
enum { RT_REPLICATES_FEW = 2, RT_REPLICATES_FEW_PIXELS = 1024 };

/* Samples of a pixel in the pilot of adaptive sampling, of all sequences together. */
enum { RT_PILOT_SAMPLES = 32 };

/* How the work on a picture is divided; rt_units_of makes it. */
typedef struct rt_units {
    int in_passes;       /* a unit is a pass */
    uint32_t items;      /* units of a block: pixels, or 1 */
    uint32_t replicates; /* 1, RT_REPLICATES_FEW or RT_REPLICATES */
    uint32_t base;       /* samples that every pixel had when a finished render was raised, or 0 */
    uint32_t samples;    /* of a pixel, of all replicates together; passes */
    uint32_t longest;    /* block, in samples */
    uint32_t pilot;      /* samples of a replicate before rates count (rates.h); 0: they never do */
    uint64_t count;      /* of units */
} rt_units;

/* The samples of a block: first .. first + count - 1 of a replicate; count may be 0. */
typedef struct rt_sample_block {
    uint32_t replicate, first, count;
} rt_sample_block;

/* A range of units. */
typedef struct rt_unit_range {
    uint64_t first, count;
} rt_unit_range;

/* Whether the options ask for an estimate of the error, and so for replicates. */
int rt_noise_wanted(const rt_render_options *options);

/* Whether samples are shared out among the pixels by rates (rates.h). */
int rt_rates_wanted(const rt_render_options *options);

/* Whether the bias of photon passes is to be told of each pixel, too (error_bound.h). */
int rt_error_bound_wanted(const rt_render_options *options);

/* The units of a render by complete options; base: see rt_units. */
rt_units rt_units_of(const rt_render_options *options, uint32_t base);

/*
 * How many units from the first on stand for the same samples where a pixel is to have so many, and
 * not units->samples; not for passes. Blocks are the same but for the last, which is cut short.
 */
uint64_t rt_units_shared(const rt_units *units, uint32_t samples);

/* The block that a unit belongs to. */
rt_sample_block rt_units_block(const rt_units *units, uint64_t unit);

/* Samples of a pixel in the units before this one, of all replicates, without those of `base`. */
double rt_units_samples_before(const rt_units *units, uint64_t unit);

/* Samples, of all replicates, or passes in some units, as a mean over the pixels. */
double rt_units_amount(const rt_units *units, rt_unit_range range);

/* The samples, or passes, that each replicate has with the units before this one. */
uint32_t rt_units_length(const rt_units *units, uint64_t unit);

/*
 * A chunk is the part of the work that is handed out: a 64th of a block, but at least 64 and at
 * most RT_CHUNK_ITEMS units; or a pass.
 */
enum { RT_CHUNK_ITEMS = 4096 };
uint64_t rt_units_chunks(const rt_units *units);
rt_unit_range rt_units_chunk(const rt_units *units, uint64_t chunk);
uint64_t rt_units_chunk_of(const rt_units *units, uint64_t unit);

/* Where the block of a replicate ends that begins at `length`, if blocks may be as long. */
uint32_t rt_replicate_grow(uint32_t length);

/*
 * The length of the replicates when the error is tested next after the test at `length`: at the
 * ends of all blocks up to 64 samples, then of those that are about an eighth of the length apart.
 */
uint32_t rt_units_next_test(uint32_t length);

#endif
