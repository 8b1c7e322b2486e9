/*
 * oidn.c - opens Open Image Denoise by its C interface, looks its functions up, and runs its filter
 * for path-traced pictures. Versions 1 and 2 differ in the names of the functions that set numbers.
 *
 * References:
 *   Open Image Denoise 2.3 documentation, "Open Image Denoise API".
 */
#include "denoise/oidn.h"

#include <dlfcn.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"

/* Values of the library's enums. */
enum { OIDN_CPU = 1, OIDN_FLOAT3 = 3 };

/* What is called, by its name there; where version 2 has another, by both. */
struct rt_oidn {
    void *library, *device;
    void *(*new_device)(int type);
    void (*commit_device)(void *device);
    void (*release_device)(void *device);
    int (*device_error)(void *device, const char **message);
    int (*device_int)(void *device, const char *name);
    void (*set_device_bool)(void *device, const char *name, bool value);
    void *(*new_filter)(void *device, const char *type);
    void (*set_image)(void *filter, const char *name, void *data, int format, size_t width,
                      size_t height, size_t offset, size_t pixel_stride, size_t row_stride);
    void (*set_filter_bool)(void *filter, const char *name, bool value);
    void (*commit_filter)(void *filter);
    void (*execute_filter)(void *filter);
    void (*release_filter)(void *filter);
};

static const struct {
    size_t place; /* of the member */
    const char *name, *older;
} symbols[] = {
#define PLACE(member) offsetof(struct rt_oidn, member)
    {PLACE(new_device), "oidnNewDevice", NULL},
    {PLACE(commit_device), "oidnCommitDevice", NULL},
    {PLACE(release_device), "oidnReleaseDevice", NULL},
    {PLACE(device_error), "oidnGetDeviceError", NULL},
    {PLACE(device_int), "oidnGetDeviceInt", "oidnGetDevice1i"},
    {PLACE(set_device_bool), "oidnSetDeviceBool", "oidnSetDevice1b"},
    {PLACE(new_filter), "oidnNewFilter", NULL},
    {PLACE(set_image), "oidnSetSharedFilterImage", NULL},
    {PLACE(set_filter_bool), "oidnSetFilterBool", "oidnSetFilter1b"},
    {PLACE(commit_filter), "oidnCommitFilter", NULL},
    {PLACE(execute_filter), "oidnExecuteFilter", NULL},
    {PLACE(release_filter), "oidnReleaseFilter", NULL},
#undef PLACE
};

static const char *const sonames[] = {"libOpenImageDenoise.so.2", "libOpenImageDenoise.so.1",
                                      "libOpenImageDenoise.so", NULL};

static rt_status fail(rt_error *error, const char *what, const char *why)
{
    return rt_fail_field(error, RT_ERROR_DEVICE, "denoiser", "%s: %s", what, why);
}

/*
 * Opens a library. Some packages put Intel's TBB beside it where it does not look: open that first,
 * as a library of its name is then not looked for.
 */
static void *open_library(const char *path)
{
    static const char *const needed[] = {"libtbb.so.12", "libtbb.so.12.5", "libtbb.so.2"};
    char beside[4096];
    const char *slash = strrchr(path, '/');
    void *library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    for (size_t i = 0; i < sizeof needed / sizeof *needed && !library && slash; i++) {
        snprintf(beside, sizeof beside, "%.*s/%s", (int)(slash - path), path, needed[i]);
        if (dlopen(beside, RTLD_NOW | RTLD_LOCAL))
            library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    }
    /* Once more, for the reason that dlerror tells. */
    if (!library)
        library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    return library;
}

/* Opens the library that is named, or the first of its own names. */
static rt_status load(rt_oidn *oidn, const char *path, rt_error *error)
{
    for (size_t i = 0; !path && sonames[i] && !oidn->library; i++)
        oidn->library = dlopen(sonames[i], RTLD_NOW | RTLD_LOCAL);
    if (path)
        oidn->library = open_library(path);
    if (oidn->library)
        return RT_OK;
    const char *why = dlerror();
    if (!path)
        return fail(error, "Open Image Denoise", "there is no libOpenImageDenoise.so");
    return fail(error, "cannot open Open Image Denoise", why ? why : path);
}

static rt_status find_functions(rt_oidn *oidn, rt_error *error)
{
    for (size_t i = 0; i < sizeof symbols / sizeof *symbols; i++) {
        void *found = dlsym(oidn->library, symbols[i].name);
        if (!found && symbols[i].older)
            found = dlsym(oidn->library, symbols[i].older);
        if (!found)
            return fail(error, "this is no library of Open Image Denoise, 1.3 or later; it lacks",
                        symbols[i].name);
        memcpy((char *)oidn + symbols[i].place, &found, sizeof found);
    }
    return RT_OK;
}

/* What the library says went wrong since it was last asked. */
static rt_status check(const rt_oidn *oidn, rt_error *error)
{
    const char *message = NULL;
    if (oidn->device_error(oidn->device, &message) == 0)
        return RT_OK;
    return fail(error, "Open Image Denoise", message ? message : "it failed without a reason");
}

rt_status rt_oidn_open(rt_oidn **out, const char *library, rt_error *error)
{
    rt_oidn *oidn = calloc(1, sizeof *oidn);
    if (!oidn)
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory for a denoiser");
    rt_status status = load(oidn, library, error);
    if (status == RT_OK)
        status = find_functions(oidn, error);
    if (status == RT_OK) {
        oidn->device = oidn->new_device(OIDN_CPU);
        if (!oidn->device)
            status = check(oidn, error) == RT_OK
                         ? fail(error, "Open Image Denoise", "it has no device for this CPU")
                         : RT_ERROR_DEVICE;
    }
    if (status == RT_OK) {
        /* Its threads are not to be bound to cores, which others use too. */
        oidn->set_device_bool(oidn->device, "setAffinity", false);
        oidn->commit_device(oidn->device);
        status = check(oidn, error);
    }
    if (status == RT_OK)
        *out = oidn;
    else
        rt_oidn_close(oidn);
    return status;
}

/* The library itself stays: threads that it began may not have ended. */
void rt_oidn_close(rt_oidn *oidn)
{
    if (!oidn)
        return;
    if (oidn->device)
        oidn->release_device(oidn->device);
    free(oidn);
}

void rt_oidn_version(char version[16], const rt_oidn *oidn)
{
    const unsigned number = (unsigned)oidn->device_int(oidn->device, "version");
    snprintf(version, 16, "%u.%u.%u", number / 10000 % 1000, number / 100 % 100, number % 100);
}

rt_status rt_oidn_run(rt_oidn *oidn, const rt_oidn_image *images, size_t count, uint32_t width,
                      uint32_t height, rt_error *error)
{
    void *filter = oidn->new_filter(oidn->device, "RT");
    rt_status status = check(oidn, error);
    if (status == RT_OK && !filter)
        status = fail(error, "Open Image Denoise", "it has no filter RT");
    if (status != RT_OK)
        return status;
    for (size_t i = 0; i < count; i++)
        oidn->set_image(filter, images[i].name, images[i].data, OIDN_FLOAT3, width, height, 0,
                        images[i].stride, images[i].stride * width);
    oidn->set_filter_bool(filter, "hdr", true);
    oidn->commit_filter(filter);
    oidn->execute_filter(filter);
    status = check(oidn, error);
    oidn->release_filter(filter);
    return status;
}
