/* image_file.c - chooses the format of a file, by its content or by its name. */
#include "image/image_file.h"

#include <string.h>
#include <strings.h>

#include "base/file.h"
#include "image/bmp.h"
#include "image/exr.h"
#include "image/hdr.h"
#include "image/jpeg.h"
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

typedef rt_status decoder(rt_image **out, const rt_bytes *file, const char *name, rt_error *error);

/* The decoder of a file by its first bytes, or NULL. */
static decoder *decoder_of(const rt_bytes *file)
{
    static const struct {
        const char *magic;
        size_t size;
        decoder *decode;
    } known[] = {{"\x76\x2f\x31\x01", 4, rt_exr_decode},
                 {"\x89PNG\r\n\x1a\n", 8, rt_png_decode},
                 {"\xff\xd8", 2, rt_jpeg_decode},
                 {"#?", 2, rt_hdr_decode},
                 {"BM", 2, rt_bmp_decode},
                 {"PF", 2, rt_pfm_decode},
                 {"Pf", 2, rt_pfm_decode},
                 {"P2", 2, rt_ppm_decode},
                 {"P3", 2, rt_ppm_decode},
                 {"P5", 2, rt_ppm_decode},
                 {"P6", 2, rt_ppm_decode}};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
        if (file->size >= known[i].size && memcmp(file->data, known[i].magic, known[i].size) == 0)
            return known[i].decode;
    return rt_tga_is_plausible(file) ? rt_tga_decode : NULL;
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
    return rt_fail(
        error, RT_ERROR_INPUT,
        "cannot read %.350s: it is not an EXR, PNG, JPEG, HDR, BMP, TGA, PPM, PGM or PFM "
        "image",
        path);
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
    decoder *decode = status == RT_OK ? decoder_of(&content) : NULL;
    if (decode)
        status = decode(out, &content, path, error);
    else if (status == RT_OK)
        status = fail_format(&content, path, error);
    rt_bytes_free(&bytes);
    return rt_at_file(status, path, error);
}
