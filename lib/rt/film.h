/* rt/film.h - rendering, and the film that it makes. Part of rt.h, the manual. */
#ifndef RT_RT_FILM_H
#define RT_RT_FILM_H

#include "photon.h"
#include "render.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Film ------------------------------------------------------------------------------------ */

/*
 * Fails with RT_ERROR_USAGE, error->field naming the member, when an option is out of its range or
 * does not go with another, as rt_render does.
 */
RT_API rt_status rt_render_options_check(const rt_render_options *options, rt_error *error);

/*
 * Renders; options NULL: the scene's own. The caller owns *out. When a progress callback cancels,
 * returns RT_CANCELLED and *out still receives the film of the samples so far (NULL when there are
 * none yet). Warns of a scene without light; in path mode of caustics that RT_MODE_PATH leaves out;
 * in photon mode as rt_photon_map_emit does, and when more than half of the queries at the ends of
 * eye paths found no photon. The film does not depend on the renderer, which may be destroyed
 * before it.
 */
RT_API rt_status rt_render(rt_film **out, rt_renderer *renderer, const rt_render_options *options,
                           rt_error *error);
RT_API void rt_film_destroy(rt_film *film);

/*
 * Linear radiance, [height][width][3], top row first; owned by the film. NULL for one that was
 * loaded or added to and not resolved since; see rt_film_resolve.
 */
RT_API const float *rt_film_rgb(const rt_film *film);
RT_API void rt_film_get_size(const rt_film *film, uint32_t *width, uint32_t *height);

/*
 * A layer of the film, [height][width][*channels], top row first; owned by the film. NULL when
 * there is none of that name. channels may be NULL. The layers, with the names of their channels in
 * an .exr after the number of channels:
 *
 *   with rt_render_options.aov, and in the modes that show one: the first hit, as means over the
 *   samples of the picture
 *
 *   albedo           3  .R .G .B  kd + ks + kt, ks of a metal by its reflectance; 0 on a miss
 *   normal           3  .X .Y .Z  shading normal in the world, as the shape has it, not turned to
 *                                 the camera; 0 on a miss
 *   depth            1  .Z        metres along the view axis (from the eye, for an environment
 *                                 camera); mean of the samples that hit, 0 without any
 *   position         3  .X .Y .Z  metres, in the world; mean of the samples that hit, 0 without any
 *   uv               2  .U .V     texture coordinates, as each shape defines them; mean of the
 *                                 samples that hit, 0 without any
 *   shape            1  .Id       index, as rt_scene_add_* returned it, of the first sample of the
 *                                 pixel that hits; -1 without any. Ids have no mean
 *   material         1  .Id       index, as rt_scene_add_material returned it, of the same sample.
 *                                 Both are whole numbers up to 2^24 and rounded to 24 bits above
 *
 *   with rt_render_options.variance or target_error
 *
 *   variance         3  .R .G .B  variance of the pixel's radiance, estimated from independent
 *                                 sequences (1)
 *   error_bound      3  .R .G .B  in progressive photon mapping: the light that is there is within
 *                                 this of the pixel, bias and noise together (4)
 *
 *   by rt_film_denoise
 *
 *   denoised         3  .R .G .B  radiance without most of its noise; see rt/denoise.h
 *
 *   with rt_render_options.photon_layers
 *
 *   photon.count     1  itself    mean number of photons summed at the end of an eye path
 *   photon.radius    1  itself    mean radius of the disc that they lie in, m
 *   photon.density   1  itself    mean of their number over the disc's area, 1/m^2
 *   photon.variance  1  itself    variance of the pixel, the mean of its three channels (2)
 *   photon.bias      1  itself    bias of the pixel, the mean of its three channels (3)
 *
 * (1) The expected value of the pixel is within rt_film_stats.interval_factor sqrt(variance) of the
 * pixel, with a confidence of 95 %. In photon mode variance is the noise alone, without the bias of
 * gathering.
 *
 * (2) Estimated from the samples of the pixel. Those of passes are independent. Those of one pass
 * share their photons, whose part of the variance is left out.
 *
 * (3) Estimated over all lists and passes, positive where gathering makes the pixel too bright: 2
 * (L - L'), where L' gathers once more within half the squared radius, or k/(k - k') (L - L') with
 * the k' = (k + 1)/2 nearest (Richardson's extrapolation). It is as noisy as L', so take means of
 * it over many pixels. At edges of light and of surfaces, where the bias grows as the radius and
 * not as its square, it is 2 - sqrt 2 = 0.59 of the bias. Sobol photons are too evenly distributed
 * for a small k; that bias is not proportional to k and enters with the wrong sign. It is 0, and
 * says nothing, for queries of k 2, and below k 9 with the hull. The layer takes about twice the
 * time of gathering.
 *
 * (4) With a confidence of 95 % over all pixels: fewer at edges, where bias gathers, and more
 * elsewhere. From the layer variance and relative_bias; infinite where the bias is unknown. Photons
 * in volumes, and what the photons have not met, are left out.
 */
RT_API const float *rt_film_layer(const rt_film *film, const char *name, uint32_t *channels);

/* The names of the layers that a film has, counted from 0; NULL after the last. */
RT_API const char *rt_film_layer_name(const rt_film *film, size_t index);

/*
 * What a film shows so far, also while it is rendered, see rt_render_options.preview: its radiance,
 * or where `layer` is not NULL that layer, as rt_film_rgb and rt_film_layer would have it if the
 * render ended now. out [height][width][*channels], NULL to ask for the channels alone; channels
 * may be NULL. Takes some milliseconds for a million pixels, on all cores. Fails with
 * RT_ERROR_USAGE where the film has no such layer.
 */
RT_API rt_status rt_film_preview(float *out, const rt_film *film, const char *layer,
                                 uint32_t *channels, rt_error *error);

/* The names of the layers that rt_film_preview shows, counted from 0; NULL after the last. */
RT_API const char *rt_film_preview_name(const rt_film *film, size_t index);

/* Statistics of a render. */
typedef struct rt_film_stats {
    /* samples that every pixel has; with sampling adaptive, that pixels have on average */
    uint32_t spp;
    uint64_t rejected; /* samples left out because they were not finite */
    /*
     * of the throughput of camera paths, the part from 0 to 1 that max_depth cut off: what the
     * longest paths would have scattered at their last surface. The second is that of the block of
     * 16 x 16 pixels where it is largest. rt_render warns when that is surely more than 2 %
     */
    double cut_off_throughput, cut_off_in_block;
    /* the same of the flux of photon paths; it warns above 2 %. 0 without photons */
    double cut_off_flux;
    uint64_t photons_emitted; /* photon paths */
    uint64_t photons_stored;
    /* photons left out because they were not finite or lay beyond 1e15 m */
    uint64_t photons_rejected;
    /*
     * the part of photon paths of which the camera gathers photons, without and by importance, as a
     * pilot found: that of photon_importance, and without it a short trial where a render emits a
     * million paths or more and is not one of parts. Where the first round of a trial found more
     * than a twentieth, the second is a rough guess. Else 0. A film that was read from a file has
     * none
     */
    double paths_seen, paths_seen_by_importance;
    /* queries of the photon maps */
    uint64_t gathers;
    /* of these, at the ends of eye paths; the others, of caustic photons alone, are at the earlier
     * vertices of a final gather */
    uint64_t gathers_at_ends;
    /* of those at the ends, without any photon. rt_render warns when they are more than half */
    uint64_t gathers_empty;
    /* of progressive photon mapping, done; 0: not in passes */
    uint32_t passes;
    /* independent sequences, from which the error is estimated; 0: it is not */
    uint32_t replicates;
    /*
     * of the picture: root of the mean squared error over all pixels and channels, over the mean
     * radiance. Estimated from the layer variance, so in photon mode it is the noise alone, and in
     * mode path it leaves out what RT_MODE_PATH does. Infinite where the picture is black
     */
    double relative_error;
    /*
     * the relative error is below this with a confidence of 95 %, provided that the samples have
     * met all light: no estimate can include light that no path has found. Infinite as long as a
     * sequence has no sample, or pass
     */
    double relative_error_bound;
    /*
     * of progressive photon mapping: the bias of gathering within a radius, estimated from the
     * passes, a bound of it with 95 % confidence, and the noise, overestimated where passes share
     * well distributed samples; each as relative_error is. Likewise of mode vcm with merging.
     * Infinite below 28 passes, or 16 iterations of vcm, the bias also where discs are larger than
     * what is lit; 0: neither of the two. Rendering to a target_error counts the bound of the bias,
     * too
     */
    double relative_bias, relative_bias_bound, relative_noise;
    /*
     * half of a pixel's 95 % interval over its standard deviation, the root of the layer variance:
     * Student's t, two-sided, replicates - 1 degrees of freedom
     */
    double interval_factor;
    /* emitted power of all lights, W, mean of the three channels; 0 in a film that was loaded */
    double light_power;
    double build_seconds, compile_seconds, emit_seconds, gather_seconds, render_seconds;
} rt_film_stats;
RT_API void rt_film_get_stats(const rt_film *film, rt_film_stats *out);

/* The energy ledger of all photon paths of a render, as rt_photon_map_ledger; no rows without. */
RT_API size_t rt_film_get_ledger(const rt_film *film, rt_light_ledger *out, size_t capacity);

typedef enum rt_tonemap { RT_TONEMAP_NONE = 0, RT_TONEMAP_REINHARD, RT_TONEMAP_ACES } rt_tonemap;

typedef struct rt_image_options {
    float exposure;     /* stops: radiance is multiplied by 2^exposure; for 8-bit formats only */
    rt_tonemap tonemap; /* for 8-bit formats only */
    const char *scene, *command; /* recorded in the attributes of an .exr; NULL: left out */
} rt_image_options;

/*
 * Writes the film in the format of the file's extension: .exr (linear float, with the layers of
 * rt_film_layer, and the seed, samples and version as attributes), .png and .ppm (sRGB), .pfm
 * (linear float). The file appears whole or not at all. Fails with RT_ERROR_USAGE for another
 * extension and RT_ERROR_OUTPUT when it cannot be written.
 */
RT_API rt_status rt_film_write(const rt_film *film, const char *path,
                               const rt_image_options *options, rt_error *error);

/* ---- Films put together ---------------------------------------------------------------------- */

/*
 * A film keeps its sums exactly, as whole numbers, so that it can be saved and continued, and made
 * in parts by any number of programs and machines: the result has the same bits as a render at
 * once, on devices of the same kind. That is for films that rt_render made with a checkpoint, a
 * part (1 of 1 is the whole picture), resume or next_units in its options; others fail with
 * RT_ERROR_USAGE here.
 */

/*
 * Writes the sums to a file, by convention NAME.rtpart, and reads them. The file appears whole or
 * not at all. Saving fails with RT_ERROR_OUTPUT; loading with RT_ERROR_INPUT when the file cannot
 * be read or is damaged, with the reason. A loaded film has no means or layers: rt_film_resolve
 * makes them. It counts in `memory`, which may be NULL. The caller owns *out.
 */
RT_API rt_status rt_film_save(const rt_film *film, const char *path, rt_error *error);
RT_API rt_status rt_film_load(rt_film **out, const char *path, rt_memory *memory, rt_error *error);

/*
 * Writes a film to the same file again and again while it is rendered: rt_film_saver_put takes what
 * it holds now, on all cores, and a thread of the saver writes that as rt_film_save does, while the
 * caller goes on. Where the file before is still being written, it waits for that first. A failure
 * to write is told by the next call, which does its own work all the same. Without memory for a
 * second, packed film, the file is written before the call returns. rt_film_saver_destroy takes
 * NULL and waits too. The caller owns *out.
 */
typedef struct rt_film_saver rt_film_saver;
RT_API rt_status rt_film_saver_create(rt_film_saver **out, const char *path, rt_error *error);
RT_API rt_status rt_film_saver_put(rt_film_saver *saver, const rt_film *film, rt_error *error);
RT_API rt_status rt_film_saver_wait(rt_film_saver *saver, rt_error *error);
RT_API void rt_film_saver_destroy(rt_film_saver *saver);

/*
 * The same bytes in memory of the caller: *size receives their number, and buffer [capacity] the
 * bytes. Fails with RT_ERROR_USAGE when they do not fit; buffer NULL asks for the size alone.
 */
RT_API rt_status rt_film_encode(const rt_film *film, void *buffer, size_t capacity, size_t *size,
                                rt_error *error);
RT_API rt_status rt_film_decode(rt_film **out, const void *data, size_t size, rt_error *error);

/*
 * The same bytes through a descriptor, such as a pipe or a socket, one film after another. Sending
 * fails with RT_ERROR_OUTPUT, and raises SIGPIPE as write() does. Receiving adds what comes to
 * *film, which becomes it where it is NULL; it fails as rt_film_load and rt_film_add do, and leaves
 * *film as it was.
 */
RT_API rt_status rt_film_send(const rt_film *film, int to, rt_error *error);
RT_API rt_status rt_film_receive(rt_film **film, int from, rt_error *error);

/*
 * Adds the samples of another film of the same scene and settings; only `time` may differ. The
 * order of additions does not matter. Fails with RT_ERROR_USAGE, saying what differs, and leaves
 * `film` as it was, when they do not fit together or both hold the same part of the work.
 */
RT_API rt_status rt_film_add(rt_film *film, const rt_film *other, rt_error *error);

/*
 * Fails with RT_ERROR_USAGE, saying what differs, where a film lacks some of the samples of another
 * or is of another scene or other settings: to write it over the other would lose work.
 */
RT_API rt_status rt_film_covers(const rt_film *film, const rt_film *other, rt_error *error);

/*
 * The film of a render without its samples, or with those of options->resume: what other films of
 * the picture are added to. options NULL: the scene's own. The caller owns *out.
 */
RT_API rt_status rt_film_begin(rt_film **out, rt_renderer *renderer,
                               const rt_render_options *options, rt_error *error);

/*
 * Makes means, layers and statistics from the sums of a film that was loaded, decoded or added to.
 * hooks: for warnings; may be NULL.
 */
RT_API rt_status rt_film_resolve(rt_film *film, const rt_hooks *hooks, rt_error *error);

/* What a film holds of its picture. */
typedef struct rt_film_info {
    double done;          /* the fraction of all samples or passes, 0 to 1 */
    uint64_t units;       /* of the whole picture; see rt_chunk_units */
    uint64_t units_done;  /* of these */
    uint32_t samples;     /* samples of a pixel, or passes, that the picture is to have */
    uint32_t part, parts; /* of the work that it was to be; 0: all */
    double seconds;       /* spent on it, on all machines together */
    uint64_t scene;       /* fingerprint of the scene and its camera */
} rt_film_info;
RT_API void rt_film_get_info(const rt_film *film, rt_film_info *out);

/* The options that a film was rendered with, complete; its pointers are NULL. */
RT_API void rt_film_get_options(const rt_film *film, rt_render_options *out);

/*
 * How much of part 1 .. parts of the work a film has: 0 to 1; of the whole where parts is 0, as in
 * rt_film_info, and 0 of a part that there is not.
 */
RT_API double rt_film_part_done(const rt_film *film, uint32_t part, uint32_t parts);

/* The note of rt_render_options; "" without. */
RT_API const char *rt_film_note(const rt_film *film);

/* ---- Chunks ---------------------------------------------------------------------------------- */

/*
 * For other schedulers: a picture is a fixed list of chunks, which options alone decide, and the
 * sum of their films in any order. A chunk is a few samples of a few thousand pixels or, in
 * progressive photon mapping, a pass; in photon mode without passes each program emits the whole
 * map anew, or takes it from rt_render_options.photon_map.
 */

/* How many chunks there are; fails as rt_render_options_check does. */
RT_API rt_status rt_chunk_count(uint64_t *out, const rt_render_options *options, rt_error *error);

/* The units of `count` chunks from `chunk` on, as rt_render_options.next_units takes them. */
RT_API rt_status rt_chunk_units(uint64_t *first, uint64_t *units, const rt_render_options *options,
                                uint64_t chunk, uint64_t count, rt_error *error);

/*
 * The units of task `task`, counted from 0, of so many that a picture is divided into: chunks that
 * follow each other, the last ones in the first task, as they have the most samples. *units is 0
 * where there are fewer chunks than tasks.
 */
RT_API rt_status rt_chunk_task(uint64_t *first, uint64_t *units, const rt_render_options *options,
                               uint64_t task, uint64_t tasks, rt_error *error);

/*
 * Renders `count` chunks from `chunk` on into a film of their own; rt_film_encode puts it into
 * memory, and rt_film_add to the picture. Many chunks at a time cost less than one by one. The
 * caller owns *out.
 */
RT_API rt_status rt_chunk_render(rt_film **out, rt_renderer *renderer,
                                 const rt_render_options *options, uint64_t chunk, uint64_t count,
                                 rt_error *error);

#ifdef __cplusplus
}
#endif

#endif
