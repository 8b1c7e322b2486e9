/*
 * photon_camera_dispersive.cl - as photon_camera.cl, of scenes with dispersive materials.
 */
#define RT_DISPERSION
#include "photon_camera.cl"
