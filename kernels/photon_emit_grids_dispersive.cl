/*
 * photon_emit_grids_dispersive.cl - as photon_emit_grids.cl, of scenes with dispersive materials,
 * whether or not a density lies on a grid.
 */
#define RT_DISPERSION
#include "photon_emit_grids.cl"
