/* gather_tree_plain.cl - as gather_tree.cl, of plain scenes (types.h). */
#define RT_PLAIN
#include "gather_tree.cl"
