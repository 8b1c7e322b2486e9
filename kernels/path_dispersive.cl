/*
 * path_dispersive.cl - as path.cl, of scenes with dispersive materials.
 */
#define RT_DISPERSION
#include "path.cl"
