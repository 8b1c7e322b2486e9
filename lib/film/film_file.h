/*
 * film_file.h - the sums of a film as a file, by convention NAME.rtpart: a checkpoint, a part of a
 * picture or a whole one, or a chunk that travels between machines.
 *
 * All numbers are little-endian, signed ones in two's complement; doubles are IEEE 754.
 *
 *   bytes  header
 *    0  8  89 52 54 46 0d 0a 1a 0a ("\x89RTF\r\n\x1a\n")
 *    8  4  version, 1
 *   12  4  size of the header, 200
 *   16  8  size of the whole file
 *   24  8  fingerprint of scene and camera
 *   32  8  fingerprint of a photon map and of light shares given by the caller, or 0
 *   40  4  bytes of the text
 *   44  4  planes: sequences of samples, 1 or 8
 *   48  4  samples of a pixel that were there when a finished render was raised, or 0
 *   52  4  the sum of 1: has layers of the first hit, 2: has sums of photon layers, 4: is without
 *          the samples that were there
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
 *   each run: u64 first, u64 count, then its pixels, of 10 columns: i64 high[3], low[3], u32 bins,
 *          count - weight, count, u32 cut off, as rt_film_pixel says. Pixels are counted through
 *          the planes, then through the RT_LAYER_COUNT layers; those without samples are left out
 *   with sums of photon layers, all pixels, of 18 columns: u64 asked, u64 photons, u64 samples,
 *          then radius, density, value, square and bias, each i64 high, i64 low, i64 bin
 *   4      CRC-32 (that of zlib) of all bytes before
 *
 * Pixels come in blocks of 256, of which the last of a run may be shorter. A block is its columns,
 * one after the other, each: i64 the least number, u8 width, 0 to 8, and of each pixel how much
 * more its number is, in `width` bytes.
 */
#ifndef RT_LIB_FILM_FILM_FILE_H
#define RT_LIB_FILM_FILM_FILE_H

#include "base/bytes.h"
#include "base/frame.h"
#include "film/columns.h"
#include "film/film.h"

enum { RT_FILM_VERSION = 1 };

/* Sizes of the file's parts. */
enum {
    RT_FILM_HEADER = 200,
    RT_FILM_RANGE = 16,
    RT_FILM_PIXEL_COLUMNS = 10,
    RT_FILM_SUMS_COLUMNS = 18
};

extern const rt_frame rt_film_frame;

/*
 * The film that a file of these bytes holds, counted in `memory`; name stands for the file in
 * messages. Fails with RT_ERROR_INPUT when it is damaged. The caller owns *out.
 */
rt_status rt_film_decode_in(rt_film **out, const uint8_t *data, size_t size, const char *name,
                            rt_memory *memory, rt_error *error);

#endif
