/* launch.cl - which work-group has which item of a launch, for its test. */
#include "entry.h"

/* seen: how often each item occurs; groups: its work-group, and at last how many there are. */
kernel void places(uint count, global uint *seen, global uint *groups)
{
    const uint i = item_number();
    if (i >= count)
        return;
    const size_t row = get_group_id(2) * get_num_groups(1) + get_group_id(1);
    atomic_inc(&seen[i]);
    groups[i] = (uint)(row * get_num_groups(0) + get_group_id(0));
    if (i == 0)
        groups[count] = (uint)(get_num_groups(0) * get_num_groups(1) * get_num_groups(2));
}
