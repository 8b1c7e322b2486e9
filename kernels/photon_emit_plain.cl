/* photon_emit_plain.cl - as photon_emit.cl, of plain scenes (types.h). */
#define RT_PLAIN
#include "photon_emit.cl"
