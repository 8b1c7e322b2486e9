/* rt/device.h - OpenCL devices. Part of rt.h, the manual. */
#ifndef RT_RT_DEVICE_H
#define RT_RT_DEVICE_H

#include "base.h"
#include "profile.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Device ---------------------------------------------------------------------------------- */

typedef struct rt_device rt_device;

/* What an OpenCL device is, as its driver tells. */
typedef struct rt_device_info {
    char name[128], platform[128], version[128], driver[128];
    uint32_t compute_units;
    uint64_t memory, largest_buffer; /* bytes */
    int is_cpu;
    /*
     * Where the kernels are kept that the driver compiles, if it leaves that to the library, as
     * PoCL does; empty where there is no place for them.
     */
    char kernel_cache[256];
} rt_device_info;

/*
 * All OpenCL devices of this machine, in the order of their numbers. Free *out with
 * rt_devices_free.
 */
RT_API rt_status rt_devices_list(rt_device_info **out, size_t *count, rt_error *error);
RT_API void rt_devices_free(rt_device_info *devices);

/* Which device is opened, and how it is used. */
typedef struct rt_device_options {
    /* a device's number in rt_devices_list, or part of its name or platform; NULL: the first */
    const char *select;
    uint32_t threads;    /* host threads, and compute units used of a CPU device; 0: all */
    uint32_t work_group; /* work-items per work-group; 0: chosen for the device */
    uint32_t width;    /* paths that a work-item follows at a time: 1 or 8; 0: 8 on a CPU, else 1 */
    rt_memory *memory; /* what is made on the device counts in it; NULL: nowhere */
    /*
     * The path of a program that, called as `PATH kernels PROGRAM --device N --work-group N`, does
     * what rt_device_compile does and ends, as rtc is one. Where several programs have to be
     * compiled, it compiles some of them at the same time, in up to threads - 1 processes. NULL:
     * they are compiled one after the other.
     */
    const char *compiler;
    /*
     * 1: kernels are built that count rays, for rt_renderer_get_rays: slower ones, which give the
     * same pictures
     */
    int count_rays;
    rt_profile *profile; /* what is done on the device is timed in it; NULL: nowhere */
} rt_device_options;

/*
 * Opens an OpenCL device. Fails with RT_ERROR_DEVICE when there is none or none is so named.
 *
 * What PoCL compiles is kept in the folder POCL_CACHE_DIR, else $XDG_CACHE_HOME/librt, else
 * ~/.cache/librt, each program in a file with a checksum: a damaged one is dropped, compiled again
 * and told by the warning callback of the call that needed it. The driver itself works in a
 * temporary folder of this process, which is removed at its end; while the first call of
 * rt_devices_list or rt_device_open starts the drivers, POCL_CACHE_DIR names that folder, so no
 * other thread should change the environment meanwhile. A program that has used OpenCL before keeps
 * the cache that its driver has chosen.
 */
RT_API rt_status rt_device_open(rt_device **out, const rt_device_options *options, rt_error *error);
/*
 * Makes the folders that the first opening of a device would make, and tells where they are: that
 * in which drivers compile, and that in which kernels are kept (empty: nowhere). For programs that
 * give up the right to write elsewhere before they open a device. Strings of `size` bytes, 4096
 * suffice.
 */
RT_API rt_status rt_device_folders(char *work, char *kept, size_t size, rt_error *error);

/*
 * Compiles one of the library's programs for OpenCL, or all of them for NULL, so that what the
 * driver makes of it is in the cache. Fails with RT_ERROR_USAGE where there is no such program.
 */
RT_API rt_status rt_device_compile(rt_device *device, const char *program, const rt_hooks *hooks,
                                   rt_error *error);

/* Closes a device. Renderers that are left on it go on; it ends with the last of them. */
RT_API void rt_device_close(rt_device *device);

/* What the device is. */
RT_API void rt_device_get_info(const rt_device *device, rt_device_info *out);

#ifdef __cplusplus
}
#endif

#endif
