/*
 * roulette.h - Russian roulette: the survival probability of a path. A surviving path is divided by
 * it, so the estimator stays unbiased.
 *
 * Photon paths take as reference the flux that arrived, so that all photons keep about the same.
 * Eye paths take a threshold, from a given length on: those that go on from below it all carry as
 * much as it.
 *
 * References:
 *   Arvo, Kirk: "Particle Transport and Image Synthesis", SIGGRAPH 1990.
 */
#ifndef RT_KERNELS_SAMPLE_ROULETTE_H
#define RT_KERNELS_SAMPLE_ROULETTE_H

#include "math/frame.h"
#include "types.h"
#include "math/width1.inc.h"
#include "sample/roulette.inc.h"

#endif
