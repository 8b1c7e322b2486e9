/* prepare.c - builds and compiles a kernel on a thread of its own. */
#include "render/prepare.h"

#include <string.h>

#include "base/bytes.h"
#include "device/kernel_cache.h"
#include "types.h"

/*
 * A kernel being prepared on a thread of its own. What it logs is kept, for hooks are called by the
 * caller's thread.
 */
typedef struct preparation {
    rt_device *device;
    const char *program, *kernel;
    const rt_arg *args;
    cl_uint count;
    cl_kernel made;
    rt_bytes log; /* lines, each with its closing zero */
    rt_error *error;
} preparation;

static void keep_line(void *user, const char *line)
{
    preparation *p = user;
    /* Without memory a line of the log is lost, nothing else. */
    rt_bytes_put(&p->log, p->log.size, line, strlen(line) + 1, NULL);
}

static rt_status prepare(void *data)
{
    preparation *p = data;
    rt_params none;
    rt_arg first = {sizeof none, &none};
    rt_hooks hooks = {.log = keep_line, .user = p};

    memset(&none, 0, sizeof none);
    rt_status status =
        rt_device_kernel(p->device, &p->made, p->program, p->kernel, &hooks, p->error);
    if (status == RT_OK)
        status = rt_kernel_args(p->made, p->args, p->count, p->error);
    if (status == RT_OK)
        status = rt_kernel_args(p->made, &first, 1, p->error);
    if (status == RT_OK)
        status = rt_launch(p->device, p->made, 1, p->error);
    return status == RT_OK ? rt_device_finish(p->device, p->error) : status;
}

rt_status rt_kernel_prepare(rt_device *device, cl_kernel *out, const char *program,
                            const char *kernel, const rt_arg *args, cl_uint count,
                            rt_stage_progress *progress, rt_error *error)
{
    preparation p = {device, program, kernel, args, count, NULL, {0}, error};
    rt_status status = rt_stage_run(progress, prepare, &p);
    for (size_t at = 0; at < p.log.size; at += strlen((const char *)p.log.data + at) + 1)
        rt_log(progress->hooks, "%s", (const char *)p.log.data + at);
    rt_bytes_free(&p.log);
    rt_kernel_cache_tell(progress->hooks);
    if (status == RT_OK)
        *out = p.made;
    else
        rt_kernel_release(p.made);
    return status;
}
