/*
 * photon_map.h - a photon map as an object: the photons, what they were made by, and where their
 * flux went.
 *
 * A map is made of ranges of photon paths, in the order of seed and index. It may hold any of them,
 * which is what lets parts of a map be made apart and joined: the photons of the whole are those of
 * the parts, one after the other.
 */
#ifndef RT_LIB_PHOTON_PHOTON_MAP_H
#define RT_LIB_PHOTON_PHOTON_MAP_H

#include "photon/ledger.h"
#include "photon/photon_list.h"
#include "rt.h"

enum { RT_PHOTON_KINDS = 3 }; /* of rt_photon_kind */

/* What must be the same for two maps to be parts of one. */
typedef struct rt_photon_settings {
    uint64_t scene; /* fingerprint; 0: not taken */
    rt_u32 max_depth;
    rt_u32 sampler;         /* rt_sampler */
    rt_u32 direct;          /* rt_direct */
    rt_u32 split;           /* 1: caustic photons are kept apart */
    float gather_roughness; /* as that of rt_render_options */
    rt_u32 media; /* 1: of a scene with media that scatter, whose photons are kept apart */
} rt_photon_settings;

/*
 * The settings of an emission by complete options, the scene's fingerprint apart; has_media: as
 * rt_renderer has it. The hull needs photons that are independent of each other.
 */
rt_photon_settings rt_photon_settings_of(const rt_render_options *options, int has_media);

/*
 * Ranges in ascending order of seed and first; none overlaps or touches another. Only while photons
 * are emitted may the last one be out of order: rt_photon_map_settle.
 */
typedef struct rt_path_ranges {
    rt_path_range *ranges; /* [count] */
    size_t count, capacity;
} rt_path_ranges;

/* All zero is empty. */
struct rt_photon_map {
    rt_photon_settings settings;
    rt_photon_list lists[RT_PHOTON_KINDS]; /* [rt_photon_kind] */
    rt_path_ranges ranges[RT_PHOTON_KINDS];
    rt_ledger ledger; /* of the paths that filled the global and the volume list */
    char name[256];   /* the file that it was read from, for messages; else empty */
};

/* Adds a range behind the last one, joining the two where they touch. */
rt_status rt_path_ranges_add(rt_path_ranges *ranges, const rt_path_range *range, rt_error *error);

/*
 * Moves the last range of a kind, with its photons, to its place in ascending order, and joins
 * ranges that touch. The others are in order; none overlaps another.
 */
void rt_photon_map_settle(rt_photon_map *map, rt_photon_kind kind);

/* Takes out all photons, paths and accounts but keeps the memory and the settings. */
void rt_photon_map_reset(rt_photon_map *map);

/* What the photons of an empty map count in. */
void rt_photon_map_set_memory(rt_photon_map *map, rt_memory *memory);

/* Frees what a map holds; it is all zero afterwards. */
void rt_photon_map_free(rt_photon_map *map);

#endif
