/* guides_plain.cl - as guides.cl, of plain scenes (types.h). */
#define RT_PLAIN
#include "guides.cl"
