/*
 * jpeg_read.c - decodes JPEG through libjpeg-turbo.
 *
 * Reference: "Digital compression and coding of continuous-tone still images", ITU-T T.81, 1992.
 */
#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <jerror.h>
#include <jpeglib.h>

#include "image/decode.h"
#include "rt/base.h"

/* Encoders write about ten; each of a hostile file passes over the whole picture. */
#define SCANS_MAX 100

static const char coefficients[] = "the coefficients of a JPEG";

/* A file being decoded. What must be freed is here, for libjpeg leaves by longjmp when it fails. */
typedef struct reader {
    struct jpeg_decompress_struct jpeg;
    struct jpeg_error_mgr errors;
    struct jpeg_progress_mgr progress;
    struct jpeg_source_mgr source;
    jmp_buf left;
    const rt_bytes *file;
    const char *name;
    rt_error error;
    rt_image *image;
    uint8_t *row;
    uint64_t taken; /* bytes that libjpeg allocates for coefficients */
} reader;

/* Leaves libjpeg by an error that is already in r. */
static void leave(reader *r)
{
    longjmp(r->left, 1);
}

/* Leaves libjpeg: the file is wrong, or of a kind that is not read. */
static void refuse(reader *r, const char *cause)
{
    rt_fail(&r->error, RT_ERROR_INPUT, "cannot read %.250s: %s", r->name, cause);
    leave(r);
}

static void refuse_depth(reader *r)
{
    char cause[128];
    snprintf(cause, sizeof cause,
             "it has %d bits a sample, not 8: convert it, as by `djpeg -outfile NEW.ppm FILE` of "
             "libjpeg-turbo 3",
             r->jpeg.data_precision);
    refuse(r, cause);
}

static void on_error(j_common_ptr common)
{
    reader *r = common->client_data;
    char message[JMSG_LENGTH_MAX];
    if (common->err->msg_code == JERR_BAD_PRECISION)
        refuse_depth(r);
    if (common->err->msg_code == JERR_OUT_OF_MEMORY) {
        rt_fail(&r->error, RT_ERROR_MEMORY, "out of memory: a JPEG decoder");
        leave(r);
    }
    common->err->format_message(common, message);
    refuse(r, message);
}

/* Warnings, which have a level below 0, tell of pixels that are lost, but for three. */
static void on_message(j_common_ptr common, int level)
{
    const int code = common->err->msg_code;
    if (level < 0 && code != JWRN_EXTRANEOUS_DATA && code != JWRN_JFIF_MAJOR &&
        code != JWRN_ADOBE_XFORM)
        on_error(common);
}

static void on_output(j_common_ptr common)
{
    (void)common;
}

static void on_progress(j_common_ptr common)
{
    reader *r = common->client_data;
    if (r->jpeg.input_scan_number > SCANS_MAX)
        refuse(r, "it has more than 100 scans");
}

static void on_start_or_end(j_decompress_ptr jpeg)
{
    (void)jpeg;
}

/* All of the file is in the buffer from the start. */
static boolean on_fill(j_decompress_ptr jpeg)
{
    refuse(jpeg->client_data, "it is cut short");
    return FALSE;
}

static void on_skip(j_decompress_ptr jpeg, long count)
{
    struct jpeg_source_mgr *source = jpeg->src;
    if (count <= 0)
        return;
    if ((size_t)count > source->bytes_in_buffer)
        on_fill(jpeg);
    source->next_input_byte += count;
    source->bytes_in_buffer -= (size_t)count;
}

/* Blocks of 8 x 8 samples of all components; padded: as many as libjpeg keeps of them. */
static uint64_t block_count(const struct jpeg_decompress_struct *jpeg, int is_padded)
{
    uint64_t count = 0;
    for (int i = 0; i < jpeg->num_components; i++) {
        const jpeg_component_info *part = &jpeg->comp_info[i];
        const unsigned h = is_padded ? (unsigned)part->h_samp_factor : 1;
        const unsigned v = is_padded ? (unsigned)part->v_samp_factor : 1;
        count += (uint64_t)((part->width_in_blocks + h - 1) / h * h) *
                 ((part->height_in_blocks + v - 1) / v * v);
    }
    return count;
}

/* Leaves at kinds that are not read, naming what reads them. */
static void check_kind(reader *r)
{
    if (r->jpeg.data_precision != 8)
        refuse_depth(r);
    if (r->jpeg.arith_code)
        refuse(r, "it has arithmetic coding: convert it, as by `jpegtran -outfile NEW.jpg FILE`");
    if (r->jpeg.num_components == 4)
        refuse(r, "it has CMYK colours: convert it, as by `oiiotool FILE -o NEW.png`");
    if (r->jpeg.num_components != 1 && r->jpeg.num_components != 3)
        refuse(r, "it has neither one component, grey, nor three of a colour");
}

/* Checks what the header promises before anything is allocated for it, and makes the image. */
static void create_image(reader *r)
{
    static const char *const rgb[3] = {"R", "G", "B"}, *const grey[1] = {"Y"};
    const uint32_t width = r->jpeg.image_width, height = r->jpeg.image_height;
    const uint32_t channels = (uint32_t)r->jpeg.num_components;
    const uint64_t values = (uint64_t)width * height * channels;
    if (values > RT_IMAGE_VALUES_MAX)
        refuse(r, "it holds more than 2^30 values");
    /* A block has a DC coefficient, which takes at least one bit. */
    if (block_count(&r->jpeg, 0) / 8 > r->file->size)
        refuse(r, "it is too short for the size that it states");
    if (rt_image_is_bomb(values, r->file->size))
        refuse(r, "it is too large for its length: more than 64 values a byte");
    if (rt_image_create_in(&r->image, r->file->memory, width, height, channels == 3 ? rgb : grey,
                           channels, &r->error) != RT_OK)
        leave(r);
}

/* Begins decompression, which reads all scans where there are several, into coefficients. */
static void start(reader *r)
{
    if (jpeg_has_multiple_scans(&r->jpeg)) {
        const uint64_t bytes = block_count(&r->jpeg, 1) * sizeof(JBLOCK);
        if (rt_memory_take(r->file->memory, bytes, coefficients, &r->error) != RT_OK)
            leave(r);
        r->taken = bytes;
    }
    r->jpeg.out_color_space = r->jpeg.num_components == 3 ? JCS_RGB : JCS_GRAYSCALE;
    r->jpeg.do_block_smoothing = FALSE; /* which guesses coefficients that are not there */
    jpeg_start_decompress(&r->jpeg);
    for (int i = 0; i < r->jpeg.num_components; i++)
        if (!r->jpeg.comp_info[i].quant_table)
            refuse(r, "it has no scan of one of its components");
}

static void read_rows(reader *r)
{
    const size_t count = (size_t)r->image->width * r->image->channel_count;
    r->row = rt_memory_zeroed(r->file->memory, count, 1, "the rows of an image", &r->error);
    if (!r->row)
        leave(r);
    for (uint32_t y = 0; y < r->image->height; y++) {
        float *out = r->image->data + y * count;
        jpeg_read_scanlines(&r->jpeg, &r->row, 1);
        for (size_t i = 0; i < count; i++)
            out[i] = (float)r->row[i] / 255.0f;
    }
}

/* What libjpeg calls, and where it reads. */
static void connect(reader *r)
{
    r->jpeg.err = jpeg_std_error(&r->errors);
    r->jpeg.client_data = r;
    r->errors.error_exit = on_error;
    r->errors.emit_message = on_message;
    r->errors.output_message = on_output;
    r->progress.progress_monitor = on_progress;
    r->source.init_source = on_start_or_end;
    r->source.term_source = on_start_or_end;
    r->source.fill_input_buffer = on_fill;
    r->source.skip_input_data = on_skip;
    r->source.resync_to_restart = jpeg_resync_to_restart;
    r->source.next_input_byte = r->file->data;
    r->source.bytes_in_buffer = r->file->size;
}

/*
 * Runs libjpeg. No local variable changes after setjmp, so nothing is lost when it leaves by
 * longjmp.
 */
static int decode(reader *r)
{
    if (setjmp(r->left))
        return 0;
    jpeg_create_decompress(&r->jpeg);
    r->jpeg.src = &r->source;
    r->jpeg.progress = &r->progress;
    jpeg_read_header(&r->jpeg, TRUE);
    check_kind(r);
    create_image(r);
    start(r);
    read_rows(r);
    jpeg_finish_decompress(&r->jpeg);
    return 1;
}

/*
 * Decodes a JPEG of 8 bits a sample, baseline or progressive, to the channels R, G, B, or Y of a
 * grey one. Values are codes divided by 255, and are marked as sRGB; profiles and the orientation
 * of EXIF are not followed. Fails with RT_ERROR_INPUT when the file is damaged, cut short or too
 * large, holds more than 2^28 values in less than a byte for each 64, has more than 100 scans, or
 * is one of CMYK colours, arithmetic coding or another depth; `name` stands for it in messages.
 * The caller destroys *out.
 */
rt_status rt_jpeg_decode(rt_image **out, const rt_bytes *file, const char *name, rt_error *error)
{
    reader r;
    memset(&r, 0, sizeof r);
    r.file = file;
    r.name = name;
    connect(&r);
    const rt_status status =
        decode(&r) ? RT_OK : rt_fail(error, r.error.status, "%s", r.error.message);
    jpeg_destroy_decompress(&r.jpeg);
    rt_memory_give(file->memory, r.taken, coefficients);
    rt_memory_free(r.row);
    if (status == RT_OK) {
        r.image->is_srgb = 1;
        *out = r.image;
    } else {
        rt_image_destroy(r.image);
    }
    return status;
}
