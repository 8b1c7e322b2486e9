/*
 * build.c - the options of a program, what it is known by in the cache, and how it is built.
 *
 * PoCL looks for a program in its cache by its source after the preprocessor, which it runs over
 * OpenCL's own headers: 40 to 90 ms, however warm the cache. It looks for bitcode by its bytes, in
 * 2 to 15 ms. So with the version that this was tried with, kernels are compiled from the bitcode
 * that its front end made of the source, and it is stored beside them.
 */
#include "device/build.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/bytes.h"
#include "base/error.h"
#include "base/progress.h"
#include "device/kernel_cache.h"

enum { OPTIONS_SIZE = 256 };

/* Copies the first line of a build log that speaks of an error. */
static void first_error(char *line, size_t size, const char *log)
{
    const char *at = strstr(log, "error:");
    if (!at)
        at = log;
    while (at > log && at[-1] != '\n')
        at--;
    size_t length = strcspn(at, "\n");
    if (length >= size)
        length = size - 1;
    memcpy(line, at, length);
    line[length] = '\0';
}

/* Reports why a program did not build: the whole log to the hooks, the first error to *error. */
static rt_status report_build(rt_device *device, cl_program program, const char *name, cl_int code,
                              const rt_hooks *hooks, rt_error *error)
{
    char line[384] = "";
    size_t size = 0;
    clGetProgramBuildInfo(program, device->id, CL_PROGRAM_BUILD_LOG, 0, NULL, &size);
    char *log = calloc(size + 1, 1);
    if (log) {
        clGetProgramBuildInfo(program, device->id, CL_PROGRAM_BUILD_LOG, size, log, NULL);
        first_error(line, sizeof line, log);
        char *rest;
        for (char *at = strtok_r(log, "\n", &rest); at; at = strtok_r(NULL, "\n", &rest))
            rt_log(hooks, "%s", at);
        free(log);
    }
    return rt_fail(error, RT_ERROR_DEVICE, "kernel program '%s' does not build on %s (%s): %s",
                   name, device->info.name, rt_cl_error_name(code), line);
}

/* Whether the device has an extension; where it does not answer, it has none. */
static int has_extension(const rt_device *device, const char *name)
{
    size_t size = 0;
    if (clGetDeviceInfo(device->id, CL_DEVICE_EXTENSIONS, 0, NULL, &size) != CL_SUCCESS)
        return 0;
    char *all = calloc(size + 1, 1);
    int found = all &&
                clGetDeviceInfo(device->id, CL_DEVICE_EXTENSIONS, size, all, NULL) == CL_SUCCESS &&
                strstr(all, name) != NULL;
    free(all);
    return found;
}

/*
 * The paths that a work-item follows at a time, and exact division: bounds on rounding in the
 * kernels take quotients and roots to be correctly rounded, which OpenCL 1.2 promises on demand
 * alone, where a device can do it.
 *
 * NVIDIA's compiler would give a work-item up to 255 registers, so that few run at once. With 128
 * paths are followed a tenth faster; with fewer it depends on the scene (measured on an H100).
 */
static rt_status build_options(char *options, size_t size, const rt_device *device, rt_error *error)
{
    cl_device_fp_config can = 0;
    rt_status status =
        rt_cl_check(clGetDeviceInfo(device->id, CL_DEVICE_SINGLE_FP_CONFIG, sizeof can, &can, NULL),
                    "asking the device how it rounds", error);
    if (status != RT_OK)
        return status;
    snprintf(options, size, "-cl-std=CL1.2 -cl-kernel-arg-info -D RT_WIDTH=%u%s%s%s", device->width,
             device->count_rays ? " -D RT_COUNT_RAYS" : "",
             can & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT ? " -cl-fp32-correctly-rounded-divide-sqrt"
                                                       : "",
             has_extension(device, "cl_nv_compiler_options") ? " -cl-nv-maxrregcount=128" : "");
    return RT_OK;
}

static int is_pocl(const rt_device *device)
{
    return strcmp(device->info.platform, "Portable Computing Language") == 0;
}

int rt_device_stores(const rt_device *device)
{
    rt_driver_lock();
    const int is_kept = rt_kernel_cache_store()[0] != 0;
    rt_driver_unlock();
    return is_kept && is_pocl(device);
}

static uint64_t hash(uint64_t h, const void *data, size_t size)
{
    const unsigned char *at = data;
    for (size_t i = 0; i < size; i++)
        h = (h ^ at[i]) * 0x100000001b3u;
    return h;
}

static uint64_t hash_text(uint64_t h, const char *text)
{
    return hash(h, text, strlen(text) + 1);
}

static const rt_kernel_piece *piece_of(const rt_kernel_source *source, size_t i)
{
    return source->pieces + source->order[i];
}

static int takes_bitcode(const rt_device *device)
{
    return is_pocl(device) && strncmp(device->info.driver, "3.1", 3) == 0;
}

/*
 * What identifies a compiled program: its source, the options, the device, the driver, and what it
 * is built of, as the driver knows what is stored of it by that. By FNV-1a (Fowler, Noll, Vo,
 * Eastlake: "The FNV Non-Cryptographic Hash Algorithm", IETF draft).
 */
static uint64_t cache_key(const rt_device *device, const rt_kernel_source *source,
                          const char *options)
{
    uint64_t h = 0xcbf29ce484222325u;
    for (size_t i = 0; i < source->count; i++)
        h = hash(h, piece_of(source, i)->text, piece_of(source, i)->length);
    h = hash_text(hash_text(h, source->name), options);
    h = hash_text(hash_text(h, device->info.platform), device->info.name);
    h = hash_text(hash_text(h, device->info.version), device->info.driver);
    return takes_bitcode(device) ? hash_text(h, "bitcode") : h;
}

/* A program of bitcode, built; NULL where the driver does not take it. */
static cl_program build_bitcode(rt_device *device, const rt_bytes *bitcode, const char *options)
{
    cl_int code;
    const unsigned char *data = bitcode->data;
    cl_program program = clCreateProgramWithBinary(device->context, 1, &device->id, &bitcode->size,
                                                   &data, NULL, &code);
    if (code != CL_SUCCESS)
        return NULL;
    if (clBuildProgram(program, 1, &device->id, options, NULL, NULL) == CL_SUCCESS)
        return program;
    clReleaseProgram(program);
    return NULL;
}

/*
 * Builds a program of the bitcode that the work folder has of it; NULL where there is none. Where
 * PoCL does not know bitcode by its bytes yet, it links its built-in functions to it a second time,
 * which breaks it, and keeps the result: that is replaced by the bitcode itself, once and for all.
 * Where that fails, programs are built of their source until the process ends.
 */
static cl_program build_again(rt_device *device, uint64_t key, const char *options)
{
    rt_bytes bitcode = {0};
    cl_program program = NULL;
    if (takes_bitcode(device) && rt_kernel_cache_watch() &&
        rt_kernel_cache_bitcode(&bitcode, key)) {
        program = build_bitcode(device, &bitcode, options);
        const rt_bitcode_state state =
            program ? rt_kernel_cache_replace(key, &bitcode) : RT_BITCODE_KNOWN;
        if (state != RT_BITCODE_KNOWN) {
            clReleaseProgram(program);
            program =
                state == RT_BITCODE_REPLACED ? build_bitcode(device, &bitcode, options) : NULL;
        }
        if (!program)
            rt_kernel_cache_spoil(key);
    }
    rt_bytes_free(&bitcode);
    return program;
}

/* A program of the pieces of its source. */
static cl_program create(rt_device *device, const rt_kernel_source *source, cl_int *code)
{
    char *text = malloc(source->length + 1);
    const char *whole = text;
    size_t at = 0;
    *code = CL_OUT_OF_HOST_MEMORY;
    if (!text)
        return NULL;
    for (size_t i = 0; i < source->count; i++) {
        const rt_kernel_piece *piece = piece_of(source, i);
        memcpy(text + at, piece->text, piece->length);
        at += piece->length;
    }
    cl_program program = clCreateProgramWithSource(device->context, 1, &whole, &at, code);
    free(text);
    return program;
}

/* Under rt_driver_lock. *out is to be released, unless NULL, also where it does not build. */
static cl_int build(rt_device *device, cl_program *out, const rt_kernel_source *source,
                    const char *options)
{
    cl_int code;
    const uint64_t key = cache_key(device, source, options);
    rt_kernel_cache_fetch(key, source->name);
    if ((*out = build_again(device, key, options)))
        return CL_SUCCESS;
    rt_kernel_cache_watch();
    *out = create(device, source, &code);
    if (code == CL_SUCCESS)
        code = clBuildProgram(*out, 1, &device->id, options, NULL, NULL);
    if (code != CL_SUCCESS)
        return code;
    rt_kernel_cache_built(key);
    cl_program again = build_again(device, key, options);
    if (again) {
        clReleaseProgram(*out);
        *out = again;
    }
    return CL_SUCCESS;
}

rt_status rt_program_build(rt_device *device, cl_program *out, const rt_kernel_source *source,
                           const rt_hooks *hooks, rt_error *error)
{
    char options[OPTIONS_SIZE];
    cl_program program = NULL;
    rt_status status = build_options(options, sizeof options, device, error);
    if (status != RT_OK)
        return status;
    rt_driver_lock();
    const cl_int code = build(device, &program, source, options);
    rt_driver_unlock();
    if (code == CL_SUCCESS) {
        *out = program;
        return RT_OK;
    }
    if (!program)
        return rt_cl_check(code, "creating an OpenCL program", error);
    status = report_build(device, program, source->name, code, hooks, error);
    clReleaseProgram(program);
    return status;
}

int rt_program_is_stored(const rt_device *device, const rt_kernel_source *source)
{
    char options[OPTIONS_SIZE];
    if (build_options(options, sizeof options, device, NULL) != RT_OK)
        return 0;
    rt_driver_lock();
    const int is_stored = rt_kernel_cache_has(cache_key(device, source, options), source->name);
    rt_driver_unlock();
    return is_stored;
}
