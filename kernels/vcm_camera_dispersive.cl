/*
 * vcm_camera_dispersive.cl - as vcm_camera.cl, of scenes with dispersive materials.
 */
#define RT_DISPERSION
#include "vcm_camera.cl"
