/* trace_plain.cl - as trace.cl, of plain scenes (types.h). */
#define RT_PLAIN
#include "trace.cl"
