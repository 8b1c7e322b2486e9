/*
 * device.h - one OpenCL device: its context, queue, programs, buffers and launches.
 *
 * OpenCL is called from here and from the files that set kernel arguments; failures are reported by
 * rt_cl_check, which names the call and the error.
 */
#ifndef RT_LIB_DEVICE_DEVICE_H
#define RT_LIB_DEVICE_DEVICE_H

#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>

#include "device/kernel_source.h"
#include "rt.h"

enum { RT_PROGRAMS_MAX = 64, RT_KERNELS_MAX = 16, RT_PENDING_MAX = 64 };

/* A command that was enqueued, and is to be booked in the profile. */
typedef struct rt_pending {
    cl_event event;
    char name[48];
    int is_transfer;
    uint64_t amount; /* work-items, or bytes */
    double asked;    /* rt_clock() */
} rt_pending;

/* A buffer that counts, and for what. */
typedef struct rt_counted_buffer {
    cl_mem buffer;
    size_t bytes;
    char what[48];
} rt_counted_buffer;

struct rt_device {
    uint32_t holders;           /* the caller until rt_device_close, and renderers */
    rt_memory *memory;          /* that what is made on it counts in; NULL: none */
    rt_counted_buffer *counted; /* [counted_count] */
    size_t counted_count, counted_room;
    cl_platform_id platform;
    cl_device_id id;
    cl_context context;
    cl_command_queue queue; /* in order */
    rt_device_info info;
    uint32_t number;      /* in the list of rt_devices_list */
    char *compiler;       /* as in rt_device_options; owned */
    uint32_t threads;     /* host threads to use, at least 1 */
    uint32_t work_group;  /* work-items per work-group, at least 1 */
    uint32_t width;       /* paths that a work-item follows at a time, 1 or 8 */
    uint32_t path_pixels; /* pixels that a work-item of path tracing takes, at least 1 */
    /*
     * photons of a render stay in its memory, where their tree is built: on one that is no CPU and
     * has double precision. A test may set it for any that has.
     */
    int keeps_photons;
    struct {
        const rt_kernel_source *source;
        cl_program program;
        uint64_t kernels[RT_KERNELS_MAX]; /* hashes of the names made so far; 0 ends them */
    } programs[RT_PROGRAMS_MAX];          /* built so far */
    int program_count;
    /* made for the first time since rt_device_finish: the driver may have compiled them */
    int has_new_kernels;
    int count_rays;      /* as in rt_device_options */
    rt_profile *profile; /* of what the device does; NULL: none. The rest serves it alone */
    uint32_t track;      /* the device's number in there */
    double asked;        /* when the next command is enqueued, rt_clock() */
    double last_end;     /* of its commands, likewise */
    rt_pending pending[RT_PENDING_MAX];
    uint32_t pending_count;
};

/* Has the device last until rt_device_close is called once more; returns it. */
rt_device *rt_device_hold(rt_device *device);

/* The name of an OpenCL error code; static storage. */
const char *rt_cl_error_name(cl_int code);

/*
 * RT_OK for CL_SUCCESS; else fails with RT_ERROR_DEVICE, or RT_ERROR_MEMORY when that is the cause.
 */
rt_status rt_cl_check(cl_int code, const char *what, rt_error *error);

/*
 * Makes a kernel of one of the library's programs, building the program when it is the first. The
 * caller releases *out. When a program does not build, the message holds the first error of the
 * compiler's log and the hooks' log callback gets all of it.
 */
rt_status rt_device_kernel(rt_device *device, cl_kernel *out, const char *program,
                           const char *kernel, const rt_hooks *hooks, rt_error *error);

/* The program itself, which stays the device's. */
rt_status rt_device_program(rt_device *device, cl_program *out, const char *program,
                            const rt_hooks *hooks, rt_error *error);

/* Whether one of the library's programs is built on the device, or something of it is stored. */
int rt_device_has_program(const rt_device *device, const char *program);

/* Whether what the device's driver compiles is stored for other processes. */
int rt_device_stores(const rt_device *device);

/*
 * rt_device_kernel from any table of sources that ends with a NULL name, such as the tests' own.
 */
rt_status rt_device_kernel_from(rt_device *device, cl_kernel *out, const rt_kernel_source *sources,
                                const char *program, const char *kernel, const rt_hooks *hooks,
                                rt_error *error);

/*
 * A buffer of `bytes` (at least one is allocated). host, if not NULL, is copied in, or used in
 * place when flags has CL_MEM_USE_HOST_PTR, else it counts in the device's memory. `what` names the
 * buffer in messages, as in "the film". The caller releases *out.
 */
rt_status rt_buffer_create(rt_device *device, cl_mem *out, cl_mem_flags flags, size_t bytes,
                           void *host, const char *what, rt_error *error);

/*
 * Makes a buffer that is written and read by the device hold at least `bytes`, with some to spare
 * where it has to be made again: its content is lost then. It may be NULL.
 */
rt_status rt_buffer_reserve(rt_device *device, cl_mem *buffer, size_t bytes, const char *what,
                            rt_error *error);

/* Blocking copies between host memory and a buffer. */
rt_status rt_buffer_read(rt_device *device, cl_mem buffer, size_t offset, size_t bytes, void *host,
                         rt_error *error);
rt_status rt_buffer_write(rt_device *device, cl_mem buffer, size_t offset, size_t bytes,
                          const void *host, rt_error *error);

/*
 * A buffer whose content is that of host memory, where there is room for it all: a CPU device works
 * on that memory itself, others have a copy. rt_mirror_read brings the host's content up to date,
 * rt_mirror_write the buffer's. The memory must last longer than the buffer.
 */
rt_status rt_mirror_create(rt_device *device, cl_mem *out, size_t bytes, void *host,
                           const char *what, rt_error *error);
rt_status rt_mirror_read(rt_device *device, cl_mem buffer, size_t bytes, void *host,
                         rt_error *error);
rt_status rt_mirror_write(rt_device *device, cl_mem buffer, size_t bytes, const void *host,
                          rt_error *error);

/* Enqueues zeros for the first bytes of a buffer, a multiple of 4. */
rt_status rt_buffer_clear(rt_device *device, cl_mem buffer, size_t bytes, rt_error *error);

/* Copies the first bytes of a buffer to `offset` in another. */
rt_status rt_buffer_copy(rt_device *device, cl_mem from, cl_mem to, size_t offset, size_t bytes,
                         rt_error *error);

/*
 * The first `bytes` of a buffer, 0 for all, in host memory, to be read until rt_buffer_unmap: no
 * copy where the device works on the host's memory. `what` names the content in messages.
 */
rt_status rt_buffer_map(rt_device *device, cl_mem buffer, size_t bytes, const void **out,
                        const char *what, rt_error *error);
/*
 * The same in two steps: what is enqueued between them runs while the host waits, and then reads;
 * bytes > 0. Nothing may be read from *out before rt_buffer_map_wait, which releases the event.
 */
rt_status rt_buffer_map_begin(rt_device *device, cl_mem buffer, size_t bytes, const void **out,
                              cl_event *ready, const char *what, rt_error *error);
rt_status rt_buffer_map_wait(cl_event ready, const char *what, rt_error *error);
/* Ends a mapping; NULL is allowed. */
rt_status rt_buffer_unmap(rt_device *device, cl_mem buffer, const void *mapped, rt_error *error);

/* Releases a buffer of the device, or a kernel; NULL is allowed. */
void rt_buffer_release(rt_device *device, cl_mem buffer);
void rt_kernel_release(cl_kernel kernel);

/* One argument of a kernel. */
typedef struct rt_arg {
    size_t size;
    const void *value;
} rt_arg;
#define RT_ARG(variable)                                                                           \
    {                                                                                              \
        sizeof(variable), &(variable)                                                              \
    }

/* Sets the arguments 0 .. count - 1. */
rt_status rt_kernel_args(cl_kernel kernel, const rt_arg *args, cl_uint count, rt_error *error);

/*
 * Enqueues `items` work-items in work-groups of the device's size, rounded up: the kernel is told
 * the true number and ignores the rest. Does not wait; rt_device_finish does.
 */
rt_status rt_launch(rt_device *device, cl_kernel kernel, size_t items, rt_error *error);
/* rt_kernel_args and rt_launch. */
rt_status rt_run(rt_device *device, cl_kernel kernel, const rt_arg *args, cl_uint count,
                 size_t items, rt_error *error);
/* Waits for what was enqueued; stores the kernels that it made the driver compile. */
rt_status rt_device_finish(rt_device *device, rt_error *error);

/*
 * Waits for what was enqueued, also after a failure: before host memory is freed on which the
 * device works in place.
 */
void rt_device_settle(rt_device *device);

/* ---- Commands in the profile (events.c) --------------------------------------------------- */

/* Where the next command is to leave its event; NULL: nowhere, the device has no profile. */
cl_event *rt_event_of(rt_device *device, cl_event *event);

/* Notes a kernel or a transfer by that event; NULL: none was left. */
void rt_event_launched(rt_device *device, cl_event event, cl_kernel kernel, size_t items);
void rt_event_transferred(rt_device *device, cl_event event, const char *name, size_t bytes);

/* Waits for the commands so far, and books them. */
void rt_events_book(rt_device *device);

#endif
