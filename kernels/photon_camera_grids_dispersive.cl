/*
 * photon_camera_grids_dispersive.cl - as photon_camera_grids.cl, of scenes with dispersive
 * materials, whether or not a density lies on a grid.
 */
#define RT_DISPERSION
#include "photon_camera_grids.cl"
