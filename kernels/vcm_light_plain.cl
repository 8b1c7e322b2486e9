/* vcm_light_plain.cl - as vcm_light_faceted.cl, of plain scenes (types.h). */
#define RT_PLAIN
#include "vcm_light_faceted.cl"
