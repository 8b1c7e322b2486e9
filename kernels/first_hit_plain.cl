/* first_hit_plain.cl - as first_hit.cl, of plain scenes (types.h). */
#define RT_PLAIN
#include "first_hit.cl"
