/*
 * map_file.h - a photon map as a file, by convention NAME.rtp.
 *
 * All numbers are little-endian; floats are IEEE 754. The file is a header, four tables and a
 * checksum:
 *
 *   bytes  header
 *    0  8  89 52 54 50 0d 0a 1a 0a ("\x89RTP\r\n\x1a\n")
 *    8  4  version, 4
 *   12  4  size of the header, 200
 *   16  8  size of the whole file
 *   24  8  fingerprint of the scene, 0: not taken
 *   32  4  longest path in segments
 *   36  4  sampler: 0 sobol, 1 independent
 *   40  4  direct light: 0 not in the map, 1 in the map
 *   44  4  1: caustic photons are kept apart, else 0
 *   48  4  1: the scene has media, whose photons are kept apart, else 0
 *   52  4  f32 least roughness of the reflection that is gathered, 0: none is
 *   56  8  lights in the ledger
 *   64  8  paths in the ledger
 *   72  8  paths left out of it because they were not finite
 *   80 40  of the global photons: u64 paths, u64 photons left out as not finite or too far out, u64
 *          photons, u64 ranges, u64 0
 *  120 40  of the caustic photons: the same
 *  160 40  of the volume photons: the same
 *
 *   168 bytes a light: u32 shape or ffffffff, i32 exponent of its unit: 2^exponent W, u64 paths,
 *          f64 power[3] in W, f64 share of the paths, then emitted, absorbed, escaped, cut off and
 *          roulette, each i64[3] in units, summed over the paths
 *   32 bytes a range of paths, global, caustic, then volume: u64 first, u64 count, u64 photons, u32
 *          seed, u32 0; ascending by seed and first
 *   64 bytes a photon, global, caustic, then volume, in the order of ranges and paths: f32
 *          position[3], u32 path, f32 wi[3], u32 flags, f32 flux[3], f32 shading, f32 normal[3],
 *          u32 shape, as rt_photon says
 *     8    checksum of all bytes before (base/checksum.h)
 *
 * A reader refuses what does not add up, what is not finite, positions beyond 1e15 m, directions
 * that are not of unit length, and bytes left over. Shapes are those of the scene; they are checked
 * where the map is used with one. Version 1 had one unit for all lights, which lost the flux of
 * weak ones, version 2 had a CRC-32, and version 3 no volume photons; they are not read.
 */
#ifndef RT_LIB_PHOTON_MAP_FILE_H
#define RT_LIB_PHOTON_MAP_FILE_H

#include "base/bytes.h"
#include "base/frame.h"
#include "photon/photon_map.h"

enum { RT_MAP_VERSION = 4 };

/* Sizes of the file's parts. */
enum { RT_MAP_HEADER = 200, RT_MAP_LIGHT = 168, RT_MAP_RANGE = 32, RT_MAP_PHOTON = 64 };

extern const rt_frame rt_map_frame;

/* A map as the bytes of its file. The caller frees *out. */
rt_status rt_photon_map_encode_in(rt_bytes *out, const rt_photon_map *map, rt_error *error);

/*
 * The map that a file of these bytes holds, counted in `memory`; name stands for the file in
 * messages. Fails with RT_ERROR_INPUT when it is damaged. The caller owns *out.
 */
rt_status rt_photon_map_decode_in(rt_photon_map **out, const uint8_t *data, size_t size,
                                  const char *name, rt_memory *memory, rt_error *error);

#endif
