/*
 * photon_emit_dispersive.cl - as photon_emit.cl, of scenes with dispersive materials.
 */
#define RT_DISPERSION
#include "photon_emit.cl"
