/*
 * kernels.c - `rtc kernels`: compiles the kernels ahead of the first render. A signal ends it at
 * once, for there is nothing to save.
 */
#include "commands.h"
#include "message.h"
#include "rt.h"
#include "status.h"

int command_kernels(const command_line *arguments)
{
    const option_value *values = arguments->options;
    const rt_hooks hooks = {.log = values[OPTION_VERBOSE].given ? message_of_log : NULL,
                            .warning = message_of_warning};
    const rt_device_options options = {.select = values[OPTION_DEVICE].text,
                                       .work_group = (uint32_t)values[OPTION_WORK_GROUP].count,
                                       .count_rays = values[OPTION_COUNT_RAYS].given};
    rt_device *device = NULL;
    rt_error error;
    rt_status status = rt_device_open(&device, &options, &error);
    if (status == RT_OK && arguments->operand_count == 0)
        status = rt_device_compile(device, NULL, &hooks, &error);
    for (size_t i = 0; i < arguments->operand_count && status == RT_OK; i++)
        status = rt_device_compile(device, arguments->operands[i], &hooks, &error);
    rt_device_close(device);
    return status == RT_OK ? STATUS_DONE : message_failure(&error);
}
