/*
 * stub_oidn.c - stands in for Open Image Denoise: the environment variable STUB_OIDN says what it
 * does. "albedo" and "normal" make these the output, "no-device", "device-error", "filter-error"
 * fail; else the output is half the colour. Without STUB_WHOLE a function is missing.
 */
#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

/* The images of the filter: colour, albedo, normal, output. */
static struct {
    const char *data;
    size_t width, height, stride;
} images[4];
static const char *failure;
static int token;

static bool does(const char *what)
{
    const char *told = getenv("STUB_OIDN");
    return told && strcmp(told, what) == 0;
}

void *oidnNewDevice(int type)
{
    if (does("no-device") || type != 1)
        return NULL;
    return &token;
}

void oidnCommitDevice(void *device)
{
    (void)device;
    if (does("device-error"))
        failure = "the device is broken";
}

void oidnReleaseDevice(void *device)
{
    (void)device;
}

int oidnGetDeviceError(void *device, const char **message)
{
    const int code = failure ? 1 : 0;
    (void)device;
    *message = failure;
    failure = NULL;
    return code;
}

int oidnGetDeviceInt(void *device, const char *name)
{
    (void)device;
    return strcmp(name, "version") == 0 ? 20304 : 0;
}

void oidnSetDeviceBool(void *device, const char *name, bool value)
{
    (void)device;
    (void)name;
    (void)value;
}

void *oidnNewFilter(void *device, const char *type)
{
    (void)device;
    memset(images, 0, sizeof images);
    return strcmp(type, "RT") == 0 ? &token : NULL;
}

void oidnSetSharedFilterImage(void *filter, const char *name, void *data, int format, size_t width,
                              size_t height, size_t offset, size_t pixel_stride, size_t row_stride)
{
    static const char *const names[] = {"color", "albedo", "normal", "output"};
    (void)filter;
    if (format != 3 || offset != 0 || row_stride != width * pixel_stride)
        failure = "an image is wrong";
    for (int i = 0; i < 4; i++)
        if (strcmp(name, names[i]) == 0) {
            images[i].data = data;
            images[i].width = width;
            images[i].height = height;
            images[i].stride = pixel_stride;
        }
}

#ifdef STUB_WHOLE
void oidnSetFilterBool(void *filter, const char *name, bool value)
{
    (void)filter;
    if (strcmp(name, "hdr") != 0 || !value)
        failure = "a parameter is wrong";
}
#endif

void oidnCommitFilter(void *filter)
{
    (void)filter;
    for (int i = 0; i < 4; i++)
        if (!images[i].data)
            failure = "an image is missing";
}

void oidnExecuteFilter(void *filter)
{
    const int from = does("albedo") ? 1 : does("normal") ? 2 : 0;
    (void)filter;
    if (does("filter-error")) {
        failure = "the filter is broken";
        return;
    }
    for (size_t i = 0; i < images[3].width * images[3].height; i++)
        for (int c = 0; c < 3; c++) {
            const float value = ((const float *)(images[from].data + i * images[from].stride))[c];
            ((float *)(images[3].data + i * images[3].stride))[c] = from ? value : value / 2;
        }
}

void oidnReleaseFilter(void *filter)
{
    (void)filter;
}
