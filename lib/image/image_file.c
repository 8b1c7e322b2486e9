/* image_file.c - chooses the format of a file, by its content or by its name. */
#include "image/image_file.h"

#include <string.h>
#include <strings.h>

#include "base/file.h"
#include "image/decode.h"
#include "image/exr.h"
#include "image/netpbm.h"
#include "image/png.h"
#include "image/tga.h"
#include "rt/field.h"

#define FILE_SIZE_LIMIT ((size_t)8 << 28) /* 2 GiB */

rt_status rt_image_format_of(rt_image_format *out, const char *path, rt_error *error)
{
    if (rt_is_missing(path, "path", error))
        return RT_ERROR_USAGE;
    static const struct {
        const char *extension;
        rt_image_format format;
    } known[] = {{".exr", RT_IMAGE_EXR},
                 {".png", RT_IMAGE_PNG},
                 {".ppm", RT_IMAGE_PPM},
                 {".pfm", RT_IMAGE_PFM}};
    const char *slash = strrchr(path, '/');
    const char *dot = strrchr(slash ? slash : path, '.');
    for (size_t i = 0; dot && i < sizeof known / sizeof known[0]; i++)
        if (strcasecmp(dot, known[i].extension) == 0) {
            *out = known[i].format;
            return RT_OK;
        }
    return rt_fail(error, RT_ERROR_USAGE, "'%.350s' does not end in .exr, .png, .ppm or .pfm",
                   path);
}

static rt_status encode(rt_bytes *out, const rt_image *image, rt_image_format format,
                        const rt_image_options *options, rt_error *error)
{
    switch (format) {
    case RT_IMAGE_EXR:
        return rt_exr_encode(out, image, error);
    case RT_IMAGE_PNG:
        return rt_png_encode(out, image, options, error);
    case RT_IMAGE_PPM:
        return rt_ppm_encode(out, image, options, error);
    case RT_IMAGE_PFM:
        return rt_pfm_encode(out, image, error);
    }
    return rt_fail(error, RT_ERROR_USAGE, "%d is no image format", (int)format);
}

rt_status rt_image_write(const rt_image *image, const char *path, const rt_image_options *options,
                         rt_error *error)
{
    if (rt_is_missing(image, "image", error))
        return RT_ERROR_USAGE;
    static const rt_image_options defaults;
    rt_image_format format;
    rt_bytes bytes = {0};
    rt_status status = rt_image_format_of(&format, path, error);
    if (status == RT_OK)
        status = encode(&bytes, image, format, options ? options : &defaults, error);
    if (status == RT_OK)
        status = rt_file_replace(path, &bytes, error);
    rt_bytes_free(&bytes);
    return status;
}

/* Whether a file begins with one of these words. */
static int has_magic(const rt_bytes *file, const char *magic)
{
    while (*magic) {
        const size_t size = strcspn(magic, " ");
        if (file->size >= size && memcmp(file->data, magic, size) == 0)
            return 1;
        magic += size + (magic[size] == ' ');
    }
    return 0;
}

/* A format that is read. */
typedef struct image_format {
    const char *extensions, *magic;
    rt_image_decoder *decode;
} image_format;

#define FORMAT_ROW(format, NAME, extensions, magic) {extensions, magic, rt_##format##_decode},

/* That of a file by its first bytes, or NULL. */
static const image_format *format_of(const rt_bytes *file)
{
    static const image_format formats[] = {RT_IMAGE_FORMATS(FORMAT_ROW)};
    for (size_t i = 0; i < sizeof formats / sizeof *formats; i++)
        if (formats[i].magic[0] ? has_magic(file, formats[i].magic) : rt_tga_is_plausible(file))
            return formats + i;
    return NULL;
}

const char *rt_image_extensions(const void *data, size_t size)
{
    const size_t mark = data ? rt_byte_order_mark(data, size) : 0;
    const rt_bytes file = {.data = data ? (uint8_t *)data + mark : NULL, .size = size - mark};
    const image_format *const format = data ? format_of(&file) : NULL;
    return format ? format->extensions : NULL;
}

/* Fails for a file of no format that is read: by what its first bytes say that it is. */
static rt_status fail_format(const rt_bytes *file, const char *path, rt_error *error)
{
    static const struct {
        const char *magic, *name, *extension; /* extension: of what to convert it to */
    } others[] = {{"II*", "a TIFF", "exr"},
                  {"MM", "a TIFF", "exr"},
                  {"GIF8", "a GIF", "png"},
                  {"RIFF", "a WebP", "png"},
                  {"DDS ", "a DDS", "png"}};
    static const char names[] = RT_IMAGE_FORMATS(RT_IMAGE_NAME); /* ", EXR, PNG" */
    if (file->size == 0)
        return rt_fail(error, RT_ERROR_INPUT, "cannot read %.350s: it is empty", path);
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        const size_t length = strlen(others[i].magic);
        if (file->size >= length && memcmp(file->data, others[i].magic, length) == 0)
            return rt_fail(error, RT_ERROR_INPUT,
                           "cannot read %.300s: it is %s image: convert it, as by `oiiotool FILE "
                           "-o NEW.%s`",
                           path, others[i].name, others[i].extension);
    }
    return rt_fail(error, RT_ERROR_INPUT, "cannot read %.300s: it is no image of the formats %s",
                   path, names + 2);
}

rt_status rt_image_read(rt_image **out, const char *path, rt_error *error)
{
    return rt_image_read_in(out, path, NULL, error);
}

rt_status rt_image_read_in(rt_image **out, const char *path, rt_memory *memory, rt_error *error)
{
    rt_bytes bytes = {.memory = memory};
    rt_status status = rt_file_read(&bytes, path, FILE_SIZE_LIMIT, error);
    const size_t mark = status == RT_OK ? rt_byte_order_mark(bytes.data, bytes.size) : 0;
    const rt_bytes content = {
        .data = mark ? bytes.data + mark : bytes.data, .size = bytes.size - mark, .memory = memory};
    const image_format *const format = status == RT_OK ? format_of(&content) : NULL;
    if (format)
        status = format->decode(out, &content, path, error);
    else if (status == RT_OK)
        status = fail_format(&content, path, error);
    rt_bytes_free(&bytes);
    return rt_at_file(status, path, error);
}
