/*
 * types.cl - the device's view of the shared structs: sizes and offsets, in the order of
 * type_members.h.
 */
#include "entry.h"
#include "types.h"

kernel void layout(global uint *out)
{
    uint n = 0u;
    if (item_number() != 0)
        return;
#define TYPE(type) out[n++] = (uint)sizeof(type);
#define MEMBER(type, member) out[n++] = (uint)(size_t) & ((global type *)0)->member;
#include "type_members.h"
}
