/* devices.c - `rtc devices`: the OpenCL devices of this machine. */
#include <stdio.h>

#include "commands.h"
#include "message.h"
#include "rt.h"
#include "status.h"

int command_devices(const command_line *arguments)
{
    if (arguments->operand_count != 0) {
        message_error("`rtc devices` takes no argument; not '%s'", arguments->operands[0]);
        return STATUS_USAGE;
    }
    rt_device_info *devices = NULL;
    size_t count = 0;
    rt_error error;
    if (rt_devices_list(&devices, &count, &error) != RT_OK)
        return message_failure(&error);
    for (size_t i = 0; i < count; i++) {
        const rt_device_info *device = &devices[i];
        printf("%zu  %s\n   %s, %s, driver %s\n   %s, %u compute unit%s, %.1f GiB memory, largest "
               "buffer %.1f GiB\n",
               i, device->name, device->platform, device->version, device->driver,
               device->is_cpu ? "CPU" : "not a CPU", (unsigned)device->compute_units,
               device->compute_units == 1 ? "" : "s", (double)device->memory / (1u << 30),
               (double)device->largest_buffer / (1u << 30));
    }
    rt_devices_free(devices);
    return STATUS_DONE;
}
