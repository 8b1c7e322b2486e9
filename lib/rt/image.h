/* rt/image.h - files, images, and how images differ. Part of rt.h, the manual. */
#ifndef RT_RT_IMAGE_H
#define RT_RT_IMAGE_H

#include "film.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Files ----------------------------------------------------------------------------------- */

/*
 * Makes path hold exactly these bytes, or leaves it as it was, as rt_film_write does: by a
 * temporary file in the same directory. A replaced file keeps its permissions; a symbolic link
 * stays and its target is written; what is no regular file (a device, a pipe) is written in place.
 * Fails with RT_ERROR_OUTPUT.
 */
RT_API rt_status rt_file_write(const char *path, const void *data, size_t size, rt_error *error);

/*
 * The same for the second and each further one of many files in a folder: rt_file_write removes the
 * temporary files that killed processes left there, and goes through the folder to find them.
 */
RT_API rt_status rt_file_write_another(const char *path, const void *data, size_t size,
                                       rt_error *error);

/*
 * Reads a whole regular file, or stdin for "-"; a NUL stands behind it, which *size does not count.
 * Fails with RT_ERROR_INPUT, naming path and cause, also where it holds more than `limit` bytes.
 * The caller frees *out with free.
 */
RT_API rt_status rt_file_load(char **out, size_t *size, const char *path, size_t limit,
                              rt_error *error);

/* ---- Images ---------------------------------------------------------------------------------- */

/*
 * An image of any number of named channels: a picture, and layers beside it such as albedo.R .G .B.
 */
typedef struct rt_image rt_image;

/*
 * The formats that are read: a word, NAME, extensions and the first bytes by which files are told
 * apart, whatever they are called. Of several a space stands between them; a TGA is known by its
 * plausible header.
 */
#define RT_IMAGE_FORMATS(X)                                                                        \
    X(exr, "EXR", ".exr", "\x76\x2f\x31\x01")                                                      \
    X(png, "PNG", ".png", "\x89PNG\r\n\x1a\n")                                                     \
    X(jpeg, "JPEG", ".jpg .jpeg", "\xff\xd8")                                                      \
    X(hdr, "Radiance HDR", ".hdr", "#?")                                                           \
    X(bmp, "BMP", ".bmp", "BM")                                                                    \
    X(qoi, "QOI", ".qoi", "qoif")                                                                  \
    X(pfm, "PFM", ".pfm", "PF Pf")                                                                 \
    X(ppm, "PPM, PGM", ".ppm .pgm", "P2 P3 P5 P6")                                                 \
    X(tga, "TGA", ".tga", "")

/* To be expanded by that: ", EXR, PNG" and " .exr .png" of all. */
#define RT_IMAGE_NAME(format, NAME, extensions, magic) ", " NAME
#define RT_IMAGE_EXTENSION(format, NAME, extensions, magic) " " extensions

/*
 * The extensions, as above, of the format of a file by its bytes; NULL: it is none that is read.
 * Static storage.
 */
RT_API const char *rt_image_extensions(const void *data, size_t size);

/*
 * Reads an image of one of these formats. An EXR has the size of its display window, zero where it
 * holds no pixels, or of its data window where that lies outside of it; channels of further parts
 * are in the layers that the parts are named by, but for deep ones. A PNG, BMP, QOI or TGA has
 * alpha, A, beside its colours where something may be transparent. Fails with RT_ERROR_INPUT,
 * naming path and cause. The caller owns *out.
 */
RT_API rt_status rt_image_read(rt_image **out, const char *path, rt_error *error);

/*
 * The picture rgb [height][width][3], linear, top row first, as an image; the values are copied.
 * The caller owns *out.
 */
RT_API rt_status rt_image_from_rgb(rt_image **out, const float *rgb, uint32_t width,
                                   uint32_t height, rt_error *error);
RT_API void rt_image_destroy(rt_image *image);
RT_API void rt_image_get_size(const rt_image *image, uint32_t *width, uint32_t *height);

/*
 * Copies a layer to rgb [height][width][3], linear, top row first; NULL stands for the picture
 * itself. The layer's channels are R, G, B, or X, Y, Z, whatever their order in the file; or U, V,
 * or X, Y, with 0 as the third; or a single one, copied to all three: that whose whole name it is
 * (photon.count), grey Y, or the only one. 1, 8 and 16 bit samples are decoded from sRGB, but for
 * alpha and a QOI whose header says that it is linear. Fails with RT_ERROR_INPUT when there is no
 * such layer.
 */
RT_API rt_status rt_image_get_rgb(float *rgb, const rt_image *image, const char *layer,
                                  rt_error *error);

/*
 * Writes an image as .exr (all channels), .png, .ppm or .pfm (its R, G and B); options NULL: their
 * defaults. The file appears whole or not at all. Fails with RT_ERROR_USAGE for another extension,
 * an option out of its range or a missing channel, and with RT_ERROR_OUTPUT when the file cannot be
 * written.
 */
RT_API rt_status rt_image_write(const rt_image *image, const char *path,
                                const rt_image_options *options, rt_error *error);

/* ---- Comparison of images -------------------------------------------------------------------- */

typedef struct rt_compare_options {
    const char *layer; /* what is compared, such as "albedo"; NULL: the picture itself */
    uint32_t block;    /* side of a block in pixels; 0 means 16 */
    double tolerance;  /* how far the mean of a block may be off, relative; 0 means 0.01 */
    double exposure;   /* stops by which SSIM and FLIP see the pictures brightened */
    /* [count + 1], what errors call the renders and, last, the reference; NULL: by number */
    const char *const *names;
} rt_compare_options;

/*
 * A block of the pictures. In each channel its means agree when they differ by no more than the
 * larger of the tolerance times the reference's mean, and four standard errors of that difference.
 * The squared standard error of a block of n pixels is V / n + S:
 *   V  where every image has a layer "variance" (the variance of each pixel's value): the mean of
 *      the sum of these. Else the variance of the n pixel differences about the plane that fits
 *      them best (n - 3 degrees of freedom): a pixel's true value cancels in the difference, edges
 *      and texture included, and the plane takes a smooth error away, so that it holds the noise of
 *      both images, as far as the pixels are independent of each other. Of n <= 3 pixels it is not
 *      known.
 *   S  is for renders whose pixels are not, such as those of a photon map, where neighbours share
 *      photons: with several independent renders the squared standard error of their mean, from the
 *      scatter of the renders' block means, averaged over the block and its neighbours. With one
 *      render it is zero.
 * Where V is not known, S stands alone; with one render the standard error is then unknown too, not
 * a number, and the tolerance alone decides.
 */
typedef struct rt_image_block {
    uint32_t x, y, width, height; /* pixels; at the right and lower border blocks may be smaller */
    double mean[3], reference[3]; /* of the renders and of the reference, by channel */
    double error[3];              /* standard error of their difference; not a number: unknown */
    /* their difference by what it may be: off above 1; infinite where a value is not finite */
    double excess[3];
} rt_image_block;

/* Measures over all pixels and channels; a is the mean of the renders, b the reference. */
typedef struct rt_comparison_info {
    uint32_t width, height;
    /*
     * pixels of a and of b with a channel that is infinite or not a number: left out of the means
     * that follow, black or white to SSIM and FLIP, and off in their blocks
     */
    uint64_t not_finite[2];
    double mse, rmse; /* mean of (a - b)^2, and its square root */
    double relmse;    /* mean of (a - b)^2 / (b^2 + 0.01) */
    double ratio;     /* mean of a by mean of b; not a number where that of b is 0 */
    /*
     * its standard error, from those of the blocks that are finite; noise is taken as common to the
     * channels; not a number where no block's is known
     */
    double ratio_error;
    /*
     * whether the noise of the renders, and that of the reference, is understated: one .exr that
     * says it was made in photon mode, of which the picture itself is compared. Pixels share
     * photons, which only the scatter of several renders shows
     */
    int shares_photons[2];
    double ratio_rgb[3]; /* by channel */
    /*
     * mean structural similarity of the luminance as an sRGB display shows it, Gaussian window of
     * 11x11 pixels (Wang et al. 2004); not a number when a picture is smaller
     */
    double ssim;
    /*
     * mean LDR-FLIP (Andersson et al. 2020), 0 to 1: what a person sees alternate on a display of
     * 67 pixels a degree
     */
    double flip;
    /*
     * difference that 95 % of the pixels do not exceed in the channel that differs most, to 1 %;
     * where that is 0, the largest
     */
    double typical;
    size_t blocks, off; /* blocks, and how many of them are off in at least one channel */
    size_t worst;       /* the block, and in it the channel, of the largest excess */
    uint32_t worst_channel;
} rt_comparison_info;

typedef struct rt_comparison rt_comparison;

/*
 * Compares the mean of count >= 1 independent renders with a reference; options NULL: their
 * defaults. Fails with RT_ERROR_INPUT when the sizes differ or a layer is missing, and with
 * RT_ERROR_USAGE when an option is out of its range. The caller owns *out; the images may be
 * destroyed afterwards.
 */
RT_API rt_status rt_image_compare(rt_comparison **out, const rt_image *const *renders, size_t count,
                                  const rt_image *reference, const rt_compare_options *options,
                                  rt_error *error);
RT_API void rt_comparison_destroy(rt_comparison *comparison);
RT_API void rt_comparison_get_info(const rt_comparison *comparison, rt_comparison_info *out);

/* The blocks, row by row; owned by the comparison. */
RT_API const rt_image_block *rt_comparison_blocks(const rt_comparison *comparison, size_t *count);

/*
 * Writes the signed difference a - b. To .exr and .pfm: as it is, by channel. To .png and .ppm: for
 * the eye, white where the pictures are equal, red where a and blue where b is brighter, in the
 * channel that differs most, full at a difference of `scale`; 0 means `typical`. What is not finite
 * is black. Fails as rt_image_write.
 */
RT_API rt_status rt_comparison_write_difference(const rt_comparison *comparison, const char *path,
                                                double scale, rt_error *error);

#ifdef __cplusplus
}
#endif

#endif
