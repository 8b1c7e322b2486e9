/* photon_camera_plain.cl - as photon_camera.cl, of plain scenes (types.h). */
#define RT_PLAIN
#include "photon_camera.cl"
