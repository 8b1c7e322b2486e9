/* vcm_camera_plain.cl - as vcm_camera_faceted.cl, of plain scenes (types.h). */
#define RT_PLAIN
#include "vcm_camera_faceted.cl"
