/*
 * roulette.h - Russian roulette: the survival probability of a path. The throughput of a survivor
 * is divided by it, so the estimator stays unbiased.
 *
 * For photon paths the reference is the incident flux, so that all photons carry about the same
 * flux. For eye paths, from a given length on, it is a threshold, to which roulette raises the
 * throughput of survivors.
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
