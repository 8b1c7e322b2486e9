/*
 * direct_dispersive.cl - as direct.cl, of scenes with dispersive materials.
 */
#define RT_DISPERSION
#include "direct.cl"
