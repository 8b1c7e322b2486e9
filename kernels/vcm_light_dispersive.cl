/*
 * vcm_light_dispersive.cl - as vcm_light.cl, of scenes with dispersive materials.
 */
#define RT_DISPERSION
#include "vcm_light.cl"
