/* rt/photon.h - photon maps. Part of rt.h, the manual. */
#ifndef RT_RT_PHOTON_H
#define RT_RT_PHOTON_H

#include "render.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Photon maps ----------------------------------------------------------------------------- */

/*
 * An rt_photon_map is the photons of a scene: rt_photon records in the order of the paths that left
 * them, in one list, or in two when caustic photons are kept apart. Path i of a seed is always the
 * same path, so a map is the same to the bit whatever the number of threads and the work-group
 * size, and parts of it can be made apart and merged. Photons that come straight from a light are
 * stored only with RT_DIRECT_PHOTONS. The paths of caustic photons kept apart start towards
 * specular shapes only, each with proportionally less flux, so that the expected value is that of
 * all paths.
 */
typedef enum rt_photon_kind {
    RT_PHOTONS_GLOBAL = 0, /* all photons, or all but the caustic ones when these are kept apart */
    RT_PHOTONS_CAUSTIC,    /* photons of RT_PHOTON_CAUSTIC, when they are kept apart */
    RT_PHOTONS_VOLUME      /* photons in media that scatter, of the paths of the global ones */
} rt_photon_kind;

typedef struct rt_emit_options {
    /*
     * photons, caustic_photons, light_shares, max_depth, seed, sampler, area (the hull emits by
     * RT_SAMPLER_INDEPENDENT), direct and hooks have an effect; NULL: the scene's own
     */
    const rt_render_options *render;
    /* make part `part`, counted from 0, of a map in `parts` parts; parts 0 means 1 */
    uint32_t part, parts;
    /*
     * a map of the same scene, seed and settings, to be continued: rt_photon_map_emit copies it and
     * adds the paths that it lacks. More photons or caustic_photons than it has paths continue it
     * too. NULL: begin anew
     */
    const rt_photon_map *resume;
    /*
     * called about every checkpoint_seconds, and at the end or after a cancel, with the map so far:
     * a map like any other, of fewer paths. NULL: never
     */
    void (*checkpoint)(void *user, const rt_photon_map *map);
    void *checkpoint_user;
    double checkpoint_seconds; /* and at least 100 times what the last one took */
} rt_emit_options;

/*
 * Emits photons from the lights of a scene on the device and collects them; options NULL: the
 * scene's own. Warns of lights with power that fewer than 100 paths came from (their light is then
 * noisy by more than 10 %), of a list that is empty or has fewer photons than the k of an estimate,
 * of photons that were rejected, and of planes under light from infinitely far, which is followed
 * to them only within the sphere around all finite shapes. Fails with RT_ERROR_USAGE when an option
 * is out of its range, or `resume` is of another scene or other settings, with RT_ERROR_MEMORY as
 * soon as the first paths show that the photons will not fit into the machine's memory, as does
 * rt_render, and with RT_CANCELLED when a progress callback cancels. The caller owns *out.
 */
RT_API rt_status rt_photon_map_emit(rt_photon_map **out, rt_renderer *renderer,
                                    const rt_emit_options *options, rt_error *error);
RT_API void rt_photon_map_destroy(rt_photon_map *map);

/*
 * Fails with RT_ERROR_USAGE, saying what differs, where a map, or the one that an emission makes,
 * lacks some of the photon paths of another or is of another scene or other settings: to write it
 * over the other would lose work.
 */
RT_API rt_status rt_photon_map_covers(const rt_photon_map *map, const rt_photon_map *other,
                                      rt_error *error);
RT_API rt_status rt_photon_map_emit_covers(rt_renderer *renderer, const rt_emit_options *options,
                                           const rt_photon_map *other, rt_error *error);

/* What a photon map holds, and how it was made. */
typedef struct rt_photon_map_info {
    uint64_t paths[3];   /* photon paths emitted, by rt_photon_kind */
    uint64_t photons[3]; /* photons stored */
    uint64_t rejected;   /* photons left out because they were not finite or lay beyond 1e15 m */
    uint64_t scene;      /* a number that stands for the scene's geometry, materials and lights */
    int split;           /* caustic photons are kept apart */
    int media;           /* the scene has media that scatter, whose photons are kept apart */
    float gather_roughness; /* photons lie on rough surfaces, too: see rt_render_options */
    rt_direct direct;
    rt_sampler sampler; /* of the photon paths */
    uint32_t max_depth;
    size_t lights; /* in the ledger */
} rt_photon_map_info;

/* What the map holds. */
RT_API void rt_photon_map_get_info(const rt_photon_map *map, rt_photon_map_info *out);

/* Paths first .. first + count - 1 of a seed, which left so many photons. */
typedef struct rt_path_range {
    uint64_t first, count, photons;
    uint32_t seed;
} rt_path_range;

/*
 * The ranges of paths that a list is made of, ascending by seed and first, adjacent ones joined;
 * the photons are in the same order. Owned by the map.
 */
RT_API const rt_path_range *rt_photon_map_ranges(const rt_photon_map *map, rt_photon_kind kind,
                                                 size_t *count);

/* The photons of a kind and their number; owned by the map. */
RT_API size_t rt_photon_map_count(const rt_photon_map *map, rt_photon_kind kind);
RT_API const rt_photon *rt_photon_map_photons(const rt_photon_map *map, rt_photon_kind kind);

/*
 * The energy ledger of a light: emitted = absorbed + escaped + cut_off + roulette, in W, but for
 * rounding. A light is a light of the scene, or a whole emissive shape. All values are estimates by
 * photon paths, so `emitted` equals the light's power up to noise that falls with its number of
 * paths.
 */
typedef struct rt_light_ledger {
    uint32_t shape; /* the emissive shape, or RT_NONE */
    uint64_t paths; /* photon paths that came from it */
    double share;   /* of all paths, as given by the options, or by photon_importance */
    double power[3];
    double emitted[3];
    double absorbed[3]; /* by surfaces and media */
    double escaped[3];  /* out of the scene */
    double cut_off[3];  /* still carried at the end of the longest paths */
    /* what Russian roulette took, less what it gave to the paths that went on: mean zero */
    double roulette[3];
} rt_light_ledger;

/*
 * Writes the first `capacity` rows of the ledger of the paths that filled the global list; returns
 * how many it has.
 */
RT_API size_t rt_photon_map_ledger(const rt_photon_map *map, rt_light_ledger *out, size_t capacity);

/*
 * Irradiance, W/m^2, at count points on surfaces: positions [count][3] in metres, normals
 * [count][3] of unit length (to half a percent; RT_ERROR_USAGE names the first point where one is
 * not), on the side from which light is to count; rgb [count][3], undefined on failure. Of the
 * options, k, radius, kernel, cone_k, area, gather and those of the caustic map have an effect;
 * NULL: their defaults. Light that is left to shadow rays is not in the map.
 *
 * Boundary bias: within the radius of the k nearest photons of an edge of the surface, part of the
 * disc that their flux is divided by lies beyond it, and the estimate is too low: by one half at a
 * straight edge, by three quarters at a corner. RT_AREA_HULL is free of it, and takes the disc
 * where the photons do not reach up to the point, as in the dark behind a wall.
 */
RT_API rt_status rt_photon_map_irradiance(float *rgb, const rt_photon_map *map, rt_device *device,
                                          const float *positions, const float *normals,
                                          size_t count, const rt_render_options *options,
                                          rt_error *error);

/* Illuminance of 1 W/m^2 of light of luminance 1: the white efficacy of Radiance. */
#define RT_LUMENS_PER_WATT 179.0

/* What the photons of a map bring to a point, with standard errors. */
typedef struct rt_photon_reading {
    double irradiance[3], irradiance_error[3]; /* W/m^2, on the side of the normal */
    double illuminance, illuminance_error;     /* lx: that, by the luminance of sRGB */
    double fluence[3], fluence_error[3];       /* fluence rate in a medium that scatters, W/m^2 */
    size_t photons, volume_photons;            /* that count */
    double radius, volume_radius; /* m, that they lie within, the largest of all lists */
    /* m, distance of the nearest that counts on a surface, and in a medium; 0: none */
    double nearest, volume_nearest;
} rt_photon_reading;

/*
 * Irradiance and fluence rate at count points, on so many threads: positions [count][3] in metres,
 * normals [count][3] of unit length, or 0 where there is no surface and no irradiance. Of the
 * options, k, radius and those of the caustic map and of volume photons have an effect; NULL: their
 * defaults. All photons weigh the same; the k-th nearest gives the radius and does not count. Each
 * point looks at all photons. Errors are by the scatter of 16 batches of paths; photons of the
 * sampler sobol scatter less from map to map than they say. Light that is left to shadow rays is
 * not in the map; the fluence rate is of all media alike, and needs scattering, and on a grid a
 * density above 0: close to that it is noisy. Boundary bias: as in rt_photon_map_irradiance, and
 * likewise for spheres that reach beyond a medium.
 */
RT_API rt_status rt_photon_map_illuminance(rt_photon_reading *out, const rt_photon_map *map,
                                           const float *positions, const float *normals,
                                           size_t count, uint32_t threads,
                                           const rt_render_options *options, rt_error *error);

/*
 * Joins maps of the same scene and options made with different seeds or parts; the result does not
 * depend on their order, and is the map that would have been made at once, to the bit. Fails with
 * RT_ERROR_INPUT when they do not fit together or hold the same paths. The caller owns *out.
 */
RT_API rt_status rt_photon_map_merge(rt_photon_map **out, const rt_photon_map *const *maps,
                                     size_t count, rt_error *error);

/*
 * Writes a map to a file and reads it, to the bit. The file appears whole or not at all. Saving
 * fails with RT_ERROR_OUTPUT; loading with RT_ERROR_INPUT when the file cannot be read or is
 * damaged, with the reason.
 */
RT_API rt_status rt_photon_map_save(const rt_photon_map *map, const char *path, rt_error *error);
RT_API rt_status rt_photon_map_load(rt_photon_map **out, const char *path, rt_error *error);

/* The same with a map that counts in `memory`, as does its file while it is read. */
RT_API rt_status rt_photon_map_load_in(rt_photon_map **out, const char *path, rt_memory *memory,
                                       rt_error *error);

/*
 * The same bytes in memory of the caller: *size receives their number, and buffer [capacity] the
 * bytes. Fails with RT_ERROR_USAGE when they do not fit; buffer NULL asks for the size alone. A map
 * that is decoded counts in `memory`, which may be NULL.
 */
RT_API rt_status rt_photon_map_encode(const rt_photon_map *map, void *buffer, size_t capacity,
                                      size_t *size, rt_error *error);
RT_API rt_status rt_photon_map_decode(rt_photon_map **out, const void *data, size_t size,
                                      rt_memory *memory, rt_error *error);

/*
 * Writes the photons as the points of a binary PLY file: position, normal, flux, direction of
 * travel, segments of the path, whether caustic, whether in a medium, and an 8-bit colour (the flux
 * by the brightest of its kind, sRGB) for viewers; and the shape or the medium that it lies on or
 * in, as rt_photon has it, and the seed and index of its path, which identify a path in a merged
 * map.
 */
RT_API rt_status rt_photon_map_export(const rt_photon_map *map, const char *path, rt_error *error);

#ifdef __cplusplus
}
#endif

#endif
