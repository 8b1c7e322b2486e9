/* rt/render.h - options of a render, and the renderer. Part of rt.h, the manual. */
#ifndef RT_RT_RENDER_H
#define RT_RT_RENDER_H

#include "device.h"
#include "scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Options of a render --------------------------------------------------------------------- */

typedef enum rt_mode {
    RT_MODE_PATH = 0,
    RT_MODE_PHOTON,
    RT_MODE_DIRECT,
    RT_MODE_NORMALS,
    RT_MODE_ALBEDO,
    RT_MODE_DEPTH,
    RT_MODE_VCM
} rt_mode;

/* The modes: X(constant, word, help), as in common.h. */
#define RT_MODES(X)                                                                                \
    X(RT_MODE_PATH, "path",                                                                        \
      "path tracing with next-event estimation and multiple importance sampling, without "         \
      "caustics of delta lights (through smooth mirrors or glass)")                                \
    X(RT_MODE_PHOTON, "photon", "photon mapping")                                                  \
    X(RT_MODE_DIRECT, "direct",                                                                    \
      "emission and direct light at the first hit; mirrors and clear glass are followed")          \
    X(RT_MODE_NORMALS, "normals",                                                                  \
      "shading normal n of the first hit as the colour (n + 1) / 2; black where nothing is hit")   \
    X(RT_MODE_ALBEDO, "albedo",                                                                    \
      "kd + ks + kt of the first hit as a colour, ks of a metal by its reflectance")               \
    X(RT_MODE_DEPTH, "depth",                                                                      \
      "distance along the view axis in metres, mean of the samples that hit; 0 where none does")   \
    X(RT_MODE_VCM, "vcm",                                                                          \
      "vertex connection and merging: paths from the camera and from the lights, joined as "       \
      "`techniques` says")

/* The word of a mode, such as "path"; static storage. */
RT_API const char *rt_mode_name(rt_mode mode);

/* How the photons near a gather point are found. */
typedef enum rt_gather { RT_GATHER_AUTO = 0, RT_GATHER_FLANN, RT_GATHER_DEVICE } rt_gather;

#define RT_GATHERS(X)                                                                              \
    X(RT_GATHER_AUTO, "auto", "device; flann with `area` hull")                                    \
    X(RT_GATHER_FLANN, "flann",                                                                    \
      "neighbour lists from FLANN's kd-tree on the host; k nearest only")                          \
    X(RT_GATHER_DEVICE, "device", "a kd-tree on the device: the same photons in less time")

/* How samples are shared out among the pixels. */
typedef enum rt_sampling { RT_SAMPLING_UNIFORM = 0, RT_SAMPLING_ADAPTIVE } rt_sampling;

#define RT_SAMPLINGS(X)                                                                            \
    X(RT_SAMPLING_UNIFORM, "uniform", "as many for each pixel")                                    \
    X(RT_SAMPLING_ADAPTIVE, "adaptive",                                                            \
      "more where the first 32 samples of the pixels around a pixel differ more; the same number " \
      "in all")

#define RT_K_ALL 0xffffffffu /* for k: all photons within `radius` */

/* A map of photons, and a film; see below. */
typedef struct rt_photon_map rt_photon_map;
typedef struct rt_film rt_film;

/* What rt_render_options.next_units answers. */
typedef enum rt_units_answer {
    RT_UNITS_NONE = 0, /* there are none left */
    RT_UNITS_GIVEN,
    RT_UNITS_SAVE /* checkpoint is to be called now, then next_units again */
} rt_units_answer;

/*
 * The settings of a render, and what belongs to one call. A scene carries such options as its
 * defaults. The ranges, defaults and effects of settings stand in one table, rt_settings of
 * rt/setting.h; zero always means the default.
 */
typedef struct rt_render_options {
    uint32_t width, height; /* of the picture, pixels */
    rt_mode mode;
    /* samples per pixel, and in each pass; no limit with time or target_error */
    uint32_t spp;
    uint32_t max_depth; /* longest path in segments, from the camera or from a light */
    /* segments from the camera after which Russian roulette may end a path; the mean is the same */
    uint32_t roulette_depth;
    /* throughput below which it may; a path survives with probability throughput / threshold */
    float roulette_threshold;
    uint32_t seed; /* the same seed gives the same bits */
    rt_sampler sampler;
    /*
     * adaptive: pixels have from 0.5 to 8 times the samples of the mean after 32 of them, in modes
     * path and direct. The error is estimated as by target_error
     */
    rt_sampling sampling;
    rt_filter filter;
    float filter_radius; /* where the filter ends, pixels; 0: its own */
    /* of direct light; at gather points, always by light sampling */
    rt_estimator estimator;
    rt_techniques techniques; /* of mode vcm */
    /* those of them whose light is added; the pictures of each of the five sum to that of all */
    rt_techniques contribution;
    int aov; /* 1: also the layers of the first hit, see rt_film_layer */
    /*
     * stop after so many seconds of rendering, but not before every pixel has a sample, and in
     * passes only between two; otherwise some pixels may have more samples than others
     */
    double time;
    /*
     * 1: also the layer variance, and the error in rt_film_stats. Samples, or passes, are then
     * drawn from 8 independent sequences, which give the error but are noisier than a single one
     * with as many samples. Not for photon mode without passes, where all samples share the photons
     * of one map, nor for modes that show no light
     */
    int variance;
    /*
     * stop when the relative RMSE of the picture, see rt_film_stats, is below this with a
     * confidence of 95 %, as tested when each sequence has 4 samples, or passes, 6, 8, 12, 16 and
     * so on; spp, passes and time are then limits. Without variance, pictures of 1024 pixels or
     * more have 2 sequences in modes path and direct, others 8
     */
    double target_error;
    uint64_t photons; /* photon paths emitted; in passes, those of each pass */
    /*
     * nearest photons of an estimate; the k-th gives the radius and is not summed. RT_K_ALL: all
     * photons within `radius`, which must be given
     */
    uint32_t k;
    float radius; /* largest gather radius, metres; 0: no limit */
    rt_gather gather;
    /*
     * progressive photon mapping in so many passes, each with fresh photons and camera paths, that
     * gather all photons within a radius shrinking from pass to pass: r_{i+1}^2 = r_i^2 (i + alpha)
     * / (i + 1) (Knaus and Zwicker 2011). The film is the mean of the passes. r_1 is `radius`, or
     * if that is 0 each pixel's own: the distance of its k-th photon in the first pass, the median
     * of 3 x 3 pixels and at most the mean of all; behind the final gather that mean. 1: no passes
     */
    uint32_t passes;
    float alpha; /* the larger, the more slowly the radius shrinks */
    /*
     * whether pilot passes test first which pixels have to begin with a smaller radius, because the
     * photons within theirs are uneven
     */
    rt_radius_rule radius_rule;
    /* 1: also the layers photon.count and the like, see rt_film_layer; gathers twice */
    int photon_layers;
    rt_density kernel;
    /*
     * the area that the flux is divided by. RT_AREA_HULL leaves the density kernel out, and is for
     * the k nearest by FLANN. It assumes independent photons, so they are emitted by
     * RT_SAMPLER_INDEPENDENT, whatever the sampler of the camera paths
     */
    rt_area area;
    float cone_k; /* constant of the cone kernel */
    rt_direct direct;
    /* diffuse bounces before photons are gathered; 0: gather at the first diffuse surface */
    uint32_t final_gather;
    /*
     * photons are stored, and gathered, also where a surface reflects by microfacets with at least
     * this roughness, in both directions, or by Phong's lobe with an exponent n and
     * sqrt(2 / (n + 2)) at least this, and refracts nothing; 0: nowhere
     */
    float gather_roughness;
    /*
     * camera paths of photon mapping are split into so many where a rough lobe, at which no photons
     * are gathered, may scatter them for the first time: at rough metal or frosted glass. The mean
     * is the same. 1: they are not
     */
    uint32_t split;
    /*
     * the final gather takes the irradiance of the nearest of every so many-th photon, at which it
     * is estimated once (Christensen 1999), instead of gathering photons at every point; 0: it
     * gathers. For Lambert's lobe, without passes and photon_layers
     */
    uint32_t irradiance_step;
    /*
     * keep caustic photons in a map of their own, filled by this many additional paths, aimed at
     * specular shapes; 0: one map for all
     */
    uint64_t caustic_photons;
    /*
     * start photon paths by visual importance: a pilot finds which starts lead to where the camera
     * gathers, and these become more frequent and their photons weaker. Every mean stays as it is.
     * Not those of a caustic map, nor with a photon_map
     */
    int photon_importance;
    uint32_t caustic_k;   /* as k, in the caustic map */
    float caustic_radius; /* as radius, in the caustic map */
    rt_density caustic_kernel;
    /*
     * in media: the radius of a volume photon's disc is the distance of the volume_k-th nearest, at
     * most volume_radius, and with volume_k RT_K_ALL that radius. In passes it shrinks by alpha
     */
    uint32_t volume_k;
    float volume_radius; /* m; 0: no limit */
    rt_volume_estimate volume_estimate;

    /* The members below are not settings: they belong to one call and are not stored in a scene. */

    /*
     * [light_share_count]: the share of photon paths that each light gets, in proportion and in the
     * order of rt_photon_map_ledger, each from 0 to 1e15; flux is weighted so that the mean stays
     * the same. NULL: in proportion to power, that of light from infinitely far being what goes
     * through portals where there are some
     */
    const float *light_shares;
    size_t light_share_count;
    const rt_photon_map *photon_map; /* use these photons and emit none; NULL: emit */
    const rt_hooks *hooks;           /* NULL: none */
    /*
     * a film of the same scene and settings, to be continued: rt_render copies it and adds what it
     * lacks. spp, passes, time and target_error may be others: more samples or passes than a film
     * has continue it, and so do fewer than it was to have, where none of them is done. A film
     * whose last samples are begun has to be finished before it is raised. NULL: begin anew
     */
    const rt_film *resume;
    /*
     * the samples of a pixel that a finished render had, where its film is continued to `spp` of
     * them elsewhere: the film of this one leaves them out, to be added to that. 0: leave out none
     */
    uint32_t raised_from;
    /*
     * render part 1 .. parts of the work alone; rt_film_add joins the parts. target_error is not
     * for parts. parts 0: all
     */
    uint32_t part, parts;
    /*
     * called about every checkpoint_seconds, and at the end or after a cancel, with the film so
     * far, which can be saved or encoded, but has no means yet; NULL: never
     */
    void (*checkpoint)(void *user, const rt_film *film);
    void *checkpoint_user;
    double checkpoint_seconds; /* and at least 100 times what the last one took */
    /*
     * called about every preview_seconds while samples are taken, with the film so far, which
     * rt_film_preview shows; it is to be left as it is. NULL: never
     */
    void (*preview)(void *user, const rt_film *film);
    void *preview_user;
    double preview_seconds; /* and at least 100 times what the last one took */
    /*
     * the caller's own text, which is saved with the film: lines "NAME VALUE", each with its
     * newline, of names that are no settings; NULL: none
     */
    const char *note;
    /*
     * 1: checkpoint takes all samples away, and the film begins anew after each call, so that the
     * films that it was called with add up to the picture. The film of rt_render is then empty
     */
    int hand_over;
    /*
     * hands out work: sets first and count to a range of units, as rt_chunk_units has them, that no
     * other film of the picture has, and returns RT_UNITS_GIVEN. NULL: all units that the film
     * lacks, or its part. target_error makes independent sequences, and time lets spp be without
     * limit, but whoever hands out the units tests the error and looks at the clock
     */
    rt_units_answer (*next_units)(void *user, uint64_t *first, uint64_t *count);
    void *units_user;
} rt_render_options;

/*
 * The scene's own defaults, which the language's `film` and `render` blocks set. Checked like
 * rt_render's.
 */
RT_API rt_status rt_scene_set_options(rt_scene *scene, const rt_render_options *options,
                                      rt_error *error);
RT_API void rt_scene_get_options(const rt_scene *scene, rt_render_options *out);

/* The rule that RT_RADIUS_AUTO stands for in a render in passes, or the one that is set. */
RT_API rt_radius_rule rt_radius_rule_of(const rt_render_options *options);

/* How much a scene holds. */
typedef struct rt_scene_info {
    uint64_t shapes, primitives, triangles, materials, lights, grids;
    int has_camera;
    int scatters; /* whether a medium of it scatters */
} rt_scene_info;
RT_API void rt_scene_get_info(const rt_scene *scene, rt_scene_info *out);

/* ---- Renderer -------------------------------------------------------------------------------- */

typedef struct rt_renderer rt_renderer;

typedef struct rt_renderer_options {
    rt_accel accel;
    const rt_hooks *hooks;
} rt_renderer_options;

/*
 * Makes a scene ready on a device: builds the bounding volume hierarchy and uploads. The scene may
 * be changed or destroyed afterwards, and the device closed. A scene without shapes or without
 * lights is no error here (its picture is black); one that does not fit the device's memory is.
 */
RT_API rt_status rt_renderer_create(rt_renderer **out, const rt_scene *scene, rt_device *device,
                                    const rt_renderer_options *options, rt_error *error);
RT_API void rt_renderer_destroy(rt_renderer *renderer);

/*
 * What light of the renderer's scene a render with these options leaves out, however many samples
 * it takes, as "caustics of point, spot and directional lights and beams (through smooth mirrors or
 * glass)"; NULL: nothing that is known. rt_render warns of it. options NULL: those of the scene.
 * Static storage.
 */
RT_API const char *rt_renderer_leaves_out(const rt_renderer *renderer,
                                          const rt_render_options *options);

/* Rays that were followed from a renderer's scene, each from its origin to its nearest hit. */
typedef struct rt_ray_counts {
    /*
     * the first rays of camera paths, and their others; those of the layers of the first hit are
     * camera rays too
     */
    uint64_t camera, bounce;
    uint64_t shadow;        /* to sampled lights; those that carry no light are not followed */
    uint64_t photon;        /* of light paths */
    uint64_t nodes, leaves; /* of the hierarchy that camera, bounce and photon rays visited */
    uint64_t shadow_nodes, shadow_leaves; /* that shadow rays did, and tests for what touches */
} rt_ray_counts;

/*
 * All renders and emissions so far, whatever became of them. Fails with RT_ERROR_USAGE where the
 * device counts no rays, see rt_device_options.
 */
RT_API rt_status rt_renderer_get_rays(const rt_renderer *renderer, rt_ray_counts *out,
                                      rt_error *error);

typedef enum rt_trace_kind {
    RT_TRACE_CLOSEST, /* the nearest hit */
    RT_TRACE_ANY      /* whether anything is hit: of rt_hit, only shape != RT_NONE is meaningful */
} rt_trace_kind;

/*
 * Follows count rays on the device and writes count hits. Rays must be finite, with coordinates of
 * the origin within 1e15, a direction of length 1e-15 to 1e15, and t_min <= t_max; t_max may be
 * infinite. Fails with RT_ERROR_USAGE, naming the first ray that is not so.
 */
RT_API rt_status rt_trace(rt_renderer *renderer, rt_trace_kind kind, const rt_ray *rays,
                          size_t count, rt_hit *hits, rt_error *error);

#ifdef __cplusplus
}
#endif

#endif
