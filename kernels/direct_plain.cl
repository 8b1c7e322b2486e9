/* direct_plain.cl - as direct.cl, of plain scenes (types.h). */
#define RT_PLAIN
#include "direct.cl"
