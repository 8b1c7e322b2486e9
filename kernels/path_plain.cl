/* path_plain.cl - as path.cl, of plain scenes (types.h). */
#define RT_PLAIN
#include "path.cl"
