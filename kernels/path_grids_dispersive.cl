/*
 * path_grids_dispersive.cl - as path_grids.cl, of scenes with dispersive materials, whether or not
 * a density lies on a grid.
 */
#define RT_DISPERSION
#include "path_grids.cl"
