/*
 * icd.c - a platform for OpenCL's loader, which is PoCL with a fault. RT_ICD_PLAY says which:
 *
 *     none       there is no platform
 *     broken     a platform whose devices cannot be had
 *     lost N     after N launches everything that is enqueued fails: the device is lost
 *     memory N   a buffer of more than N bytes is refused
 *     compiler   programs do not build, and the log tells why
 *     wrong      what is read from the device has a bit flipped
 *
 * The loader and PoCL's objects share one table of functions, and this puts its own in there.
 *
 * Reference:
 *   Khronos: "cl_khr_icd", in The OpenCL Extension Specification.
 */
#define _GNU_SOURCE /* RTLD_DEEPBIND */

#include <dlfcn.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#define CL_TARGET_OPENCL_VERSION 300
#include <CL/cl.h>
#include <CL/cl_icd.h>

/* What the loader asks of a platform; no header declares it. */
CL_API_ENTRY cl_int CL_API_CALL clIcdGetPlatformIDsKHR(cl_uint room, cl_platform_id *out,
                                                       cl_uint *count);

static cl_icd_dispatch pocl; /* PoCL's own functions */
static long limit, launches;

/* The play, and its number. */
static int plays(const char *name)
{
    const char *play = getenv("RT_ICD_PLAY");
    size_t length = strlen(name);
    if (!play || strncmp(play, name, length) != 0)
        return 0;
    limit = strtol(play + length, NULL, 10);
    return 1;
}

/* ---- The faults ------------------------------------------------------------------------------ */

static cl_int CL_API_CALL no_devices(cl_platform_id platform, cl_device_type type, cl_uint room,
                                     cl_device_id *out, cl_uint *count)
{
    (void)platform, (void)type, (void)room, (void)out, (void)count;
    return CL_OUT_OF_HOST_MEMORY;
}

static int is_lost(void)
{
    return launches > limit;
}

static cl_int CL_API_CALL launch(cl_command_queue queue, cl_kernel kernel, cl_uint dimensions,
                                 const size_t *offset, const size_t *global, const size_t *local,
                                 cl_uint count, const cl_event *wait, cl_event *event)
{
    launches++;
    return is_lost() ? CL_OUT_OF_RESOURCES
                     : pocl.clEnqueueNDRangeKernel(queue, kernel, dimensions, offset, global, local,
                                                   count, wait, event);
}

static cl_int CL_API_CALL read_lost(cl_command_queue queue, cl_mem buffer, cl_bool block,
                                    size_t offset, size_t size, void *out, cl_uint count,
                                    const cl_event *wait, cl_event *event)
{
    return is_lost() ? CL_OUT_OF_RESOURCES
                     : pocl.clEnqueueReadBuffer(queue, buffer, block, offset, size, out, count,
                                                wait, event);
}

static cl_int CL_API_CALL finish_lost(cl_command_queue queue)
{
    cl_int code = pocl.clFinish(queue);
    return is_lost() ? CL_OUT_OF_RESOURCES : code;
}

static cl_mem CL_API_CALL create_small(cl_context context, cl_mem_flags flags, size_t size,
                                       void *host, cl_int *code)
{
    if ((long)size <= limit)
        return pocl.clCreateBuffer(context, flags, size, host, code);
    *code = CL_MEM_OBJECT_ALLOCATION_FAILURE;
    return NULL;
}

static cl_int CL_API_CALL build_nothing(cl_program program, cl_uint count,
                                        const cl_device_id *devices, const char *options,
                                        void(CL_CALLBACK *tell)(cl_program, void *), void *user)
{
    (void)program, (void)count, (void)devices, (void)options, (void)tell, (void)user;
    return CL_BUILD_PROGRAM_FAILURE;
}

static cl_int CL_API_CALL tell_why(cl_program program, cl_device_id device,
                                   cl_program_build_info what, size_t size, void *out,
                                   size_t *needed)
{
    static const char log[] = "a note of the compiler\n"
                              "kernels/types.h:1:1: error: this compiler is out of order\n";
    (void)program, (void)device;
    if (what != CL_PROGRAM_BUILD_LOG)
        return CL_INVALID_VALUE;
    if (needed)
        *needed = sizeof log;
    if (out && size >= sizeof log)
        memcpy(out, log, sizeof log);
    return CL_SUCCESS;
}

static cl_int CL_API_CALL read_wrong(cl_command_queue queue, cl_mem buffer, cl_bool block,
                                     size_t offset, size_t size, void *out, cl_uint count,
                                     const cl_event *wait, cl_event *event)
{
    cl_int code =
        pocl.clEnqueueReadBuffer(queue, buffer, block, offset, size, out, count, wait, event);
    if (code == CL_SUCCESS && size >= 4)
        ((uint8_t *)out)[2] ^= 0x40; /* of a little-endian float, half of its value */
    return code;
}

/* ---- The platform ---------------------------------------------------------------------------- */

static void spoil(cl_icd_dispatch *table)
{
    if (plays("lost")) {
        table->clEnqueueNDRangeKernel = launch;
        table->clEnqueueReadBuffer = read_lost;
        table->clFinish = finish_lost;
    }
    if (plays("memory"))
        table->clCreateBuffer = create_small;
    if (plays("compiler")) {
        table->clBuildProgram = build_nothing;
        table->clGetProgramBuildInfo = tell_why;
    }
    if (plays("wrong"))
        table->clEnqueueReadBuffer = read_wrong;
}

/* Another copy of PoCL than one that the loader may have beside this. */
static void *open_pocl(void)
{
    static void *library;
    if (!library)
        library = dlopen("libpocl.so.2", RTLD_NOW | RTLD_LOCAL | RTLD_DEEPBIND);
    if (!library)
        fprintf(stderr, "icd: %s\n", dlerror());
    return library;
}

static cl_int CL_API_CALL tell_of_broken(cl_platform_id platform, cl_platform_info what,
                                         size_t size, void *out, size_t *needed)
{
    const char *text = what == CL_PLATFORM_EXTENSIONS       ? "cl_khr_icd"
                       : what == CL_PLATFORM_ICD_SUFFIX_KHR ? "BROKEN"
                       : what == CL_PLATFORM_VERSION        ? "OpenCL 1.2 broken"
                                                            : "broken";
    (void)platform;
    if (needed)
        *needed = strlen(text) + 1;
    if (out && size > strlen(text))
        strcpy(out, text);
    return CL_SUCCESS;
}

/* A platform of its own, which can stand beside PoCL's. */
static cl_int give_broken(cl_uint room, cl_platform_id *out, cl_uint *count)
{
    static cl_icd_dispatch table;
    static struct {
        cl_icd_dispatch *table;
    } platform = {&table};
    table.clGetPlatformInfo = tell_of_broken;
    table.clGetDeviceIDs = no_devices;
    if (count)
        *count = 1;
    if (out && room > 0)
        out[0] = (cl_platform_id)(void *)&platform;
    return CL_SUCCESS;
}

/* A function of PoCL: its own, or as it tells the loader. */
static void *find_in(void *library, const char *name)
{
    union {
        void *object;
        void *(CL_API_CALL *function)(const char *);
    } ask = {.object = dlsym(library, "clGetExtensionFunctionAddress")};
    void *found = ask.object ? ask.function(name) : NULL;
    return found ? found : dlsym(library, name);
}

cl_int CL_API_CALL clIcdGetPlatformIDsKHR(cl_uint room, cl_platform_id *out, cl_uint *count)
{
    union {
        void *object;
        cl_int(CL_API_CALL *function)(cl_uint, cl_platform_id *, cl_uint *);
    } find;
    void *library = open_pocl();
    if (plays("broken"))
        return give_broken(room, out, count);
    if (plays("none") || !library)
        return -1001; /* CL_PLATFORM_NOT_FOUND_KHR */
    find.object = find_in(library, "clIcdGetPlatformIDsKHR");
    if (!find.object)
        return -1001;
    cl_int code = find.function(room, out, count);
    if (code != CL_SUCCESS || !out || pocl.clGetPlatformIDs)
        return code;
    /* Every object of an ICD begins with the address of its table. */
    cl_icd_dispatch *table = *(cl_icd_dispatch **)(void *)out[0];
    size_t page = (size_t)sysconf(_SC_PAGESIZE);
    uintptr_t from = (uintptr_t)table / page * page, to = (uintptr_t)(table + 1);
    if (mprotect((void *)from, to - from, PROT_READ | PROT_WRITE) != 0)
        return CL_OUT_OF_HOST_MEMORY;
    pocl = *table;
    spoil(table);
    return code;
}

void *CL_API_CALL clGetExtensionFunctionAddress(const char *name)
{
    void *library = open_pocl();
    union {
        void *object;
        cl_int(CL_API_CALL *platforms)(cl_uint, cl_platform_id *, cl_uint *);
        cl_int(CL_API_CALL *info)(cl_platform_id, cl_platform_info, size_t, void *, size_t *);
    } own = {.platforms = clIcdGetPlatformIDsKHR}, broken = {.info = tell_of_broken};
    if (strcmp(name, "clIcdGetPlatformIDsKHR") == 0)
        return own.object;
    if (plays("broken") && strcmp(name, "clGetPlatformInfo") == 0)
        return broken.object;
    return library ? find_in(library, name) : NULL;
}
