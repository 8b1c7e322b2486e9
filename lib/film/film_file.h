/*
 * film_file.h - the sums of a film as a file, by convention NAME.rtpart: a checkpoint, a part of a
 * picture or a whole one, or a chunk that travels between machines.
 *
 * All numbers are little-endian, signed ones in two's complement; doubles are IEEE 754.
 *
 *   bytes  header
 *    0  8  89 52 54 46 0d 0a 1a 0a ("\x89RTF\r\n\x1a\n")
 *    8  4  version, 3
 *   12  4  size of the header, 200
 *   16  8  size of the whole file
 *   24  8  fingerprint of scene and camera
 *   32  8  fingerprint of a photon map and of light shares given by the caller, or 0
 *   40  4  bytes of the text
 *   44  4  planes: sequences of samples, 1 or 8
 *   48  4  samples of a pixel that were there when a finished render was raised, or 0
 *   52  4  the sum of 1: has layers of the first hit, 2: has sums of photon layers, 4: is without
 *          the samples that were there, 8: has moments of passes, 16: has rates of pixels
 *   56  4  part of the work that this film was to be, 4 and of how many, 0: all
 *   64  8  ranges of units done
 *   72  8  runs of pixels
 *   80  8  lights in the ledger, 8 paths in it, 8 paths left out of it
 *  104 56  u64: photon paths, photons stored, photons left out, queries, at ends of paths, empty
 *          ones, passes
 *  160 40  f64 seconds: building, compiling, emitting, gathering, rendering
 *
 *   the text: lines "NAME VALUE", each with its newline: `scene`, `command`, `device` and `version`
 *          as the program gave them, then every setting
 *   168 bytes a light, as in a photon map (photon/map_file.h)
 *   16 bytes a range of units: u64 first, u64 count; ascending, apart from each other
 *   each run: u64 first, u64 count, at most 128, then its rows in columns. Rows are counted through
 *          the pixels of all planes, then those of the layers of the first hit, of the photon
 *          layers, of three planes of moments and of the rates, if there are such; runs ascend, and
 *          rows without samples are left out
 *   8      checksum of all bytes before (base/checksum.h)
 *
 * A row of a pixel, or of a moment, has 10 columns: high[3], low[3], bins, weight, count, cut_off
 * of rt_film_pixel.
 * One of the first hit has 27, those of rt_first_hits from albedo[3] to material. One of the photon
 * layers has 18: asked, photons and samples of rt_photon_sums, then radius, density, value, square
 * and bias, each high, low and bin. One of the rates is 1, in 1/256.
 *
 * A column of a run is u8 width, 0 to 8, u8 shift, 0 to 63, its number of the first row as 64 bits,
 * and for each row, the first too, what its number is more than that, in 2^shift, in `width` bytes
 * with sign.
 *
 * Version 1 had all layers in pixels of their own, version 2 two planes of moments; they are not
 * read.
 */
#ifndef RT_LIB_FILM_FILM_FILE_H
#define RT_LIB_FILM_FILM_FILE_H

#include "base/bytes.h"
#include "base/checksum.h"
#include "base/frame.h"
#include "film/columns.h"
#include "film/film.h"

enum { RT_FILM_VERSION = 3 };

/* Sizes of the file's parts. */
enum { RT_FILM_HEADER = 200, RT_FILM_RANGE = 16 };

extern const rt_frame rt_film_frame;

/*
 * The bytes before the runs, which are so many and take so many bytes in all. Fails with
 * RT_ERROR_USAGE where the film cannot be kept. The caller frees *out.
 */
rt_status rt_film_put_head(rt_bytes *out, const rt_film *film, uint64_t runs, size_t bands,
                           rt_error *error);

/*
 * The runs come in bands of so many rows, the last of each area of the film shorter. One band's are
 * written by rt_film_put_band, which returns how many bytes they are, at most rt_film_band_most;
 * *runs: how many runs. Bands may be written at once by several threads.
 */
enum { RT_FILM_BAND_ROWS = 16 * RT_COLUMNS_ROWS };
size_t rt_film_bands(const rt_film *film);
size_t rt_film_band_of(const rt_film *film, size_t row); /* counted through all areas */
size_t rt_film_band_most(const rt_film *film);
size_t rt_film_put_band(uint8_t *out, uint64_t *runs, const rt_film *film, size_t band);

/*
 * The film that a file of these bytes holds, counted in `memory`; name stands for the file in
 * messages. Fails with RT_ERROR_INPUT when it is damaged. The caller owns *out.
 */
rt_status rt_film_decode_in(rt_film **out, const uint8_t *data, size_t size, const char *name,
                            rt_memory *memory, rt_error *error);

#endif
