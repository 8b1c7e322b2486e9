/*
 * paths_dispersive.cl - as paths.cl, of scenes with dispersive materials.
 */
#define RT_DISPERSION
#include "paths.cl"
