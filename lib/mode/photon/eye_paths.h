/*
 * eye_paths.h - the camera's half of photon mapping: paths from the camera to gather points, the
 * queries there, and the film that they are added to.
 */
#ifndef RT_LIB_MODE_PHOTON_EYE_PATHS_H
#define RT_LIB_MODE_PHOTON_EYE_PATHS_H

#include "mode/photon/eye_kernels.h"
#include "mode/photon/layers.h"
#include "mode/photon/moments.h"
#include "mode/photon/queries.h"
#include "photon/volume_gather.h"

/* Eye paths under way, a batch at a time. */
typedef struct rt_eye_paths {
    const rt_render_job *job;
    rt_device *device;
    rt_eye_kernels kernels;
    uint32_t replicate; /* of the samples to come */
    rt_u32 rows;        /* earlier gather points of a path: diffuse bounces of the final gather */
    rt_u32 split;       /* gather points of a sample, at the ends of what it is split into */
    size_t capacity;    /* gather points a batch, a multiple of that */
    cl_mem points;      /* rt_gather_point [capacity], the ends of paths */
    cl_mem earlier;     /* rt_gather_point [rows][capacity] */
    cl_mem film;        /* rt_film_pixel, the film on the device */
    cl_mem pixels;      /* what samples are added to: the film, or in passes that of one pass */
    cl_mem counts;      /* of queries, two rt_u32 a run of them */
    rt_u32 *host_counts;
    rt_gather_disc *discs;        /* [capacity], what the global query found */
    rt_gather_disc *more_discs;   /* [capacity], what the caustic or an earlier query found */
    rt_photon_sums *sums;         /* the film's, or in passes those of one; NULL: no layers */
    rt_photon_sums *pass_sums;    /* in passes: what sums is */
    rt_gather_point *host_points; /* for the layers: [1 + rows][capacity] points */
    rt_photon_bias bias;          /* likewise */
    /* of a scene with media: its volume photons, or NULL, which stands for none */
    const rt_volume_gather *volume;
    rt_pass_moments moments; /* in passes */
} rt_eye_paths;

/*
 * Makes memory for batches, and the film on the device (eye_memory.c). rt_eye_paths_release undoes
 * it.
 */
rt_status rt_eye_paths_create(rt_eye_paths *out, const rt_render_job *job,
                              const rt_eye_kernels *kernels, rt_error *error);
void rt_eye_paths_release(rt_eye_paths *paths);

/* The runs by which the queries of so many points are counted. */
size_t rt_eye_paths_runs(size_t points);

/* The samples that a batch takes with these queries, at least 1. */
size_t rt_eye_paths_batch(const rt_eye_paths *paths, const rt_queries *queries);

/*
 * Gives each pixel of the items the sample of this number. The gathers of the film's stats grow by
 * the points that queried a map. Reports fractions of the part of the stage that progress is set
 * to.
 */
rt_status rt_eye_paths_sample(rt_eye_paths *paths, const rt_queries *queries, rt_unit_range items,
                              uint32_t sample, rt_stage_progress *progress, rt_error *error);

/*
 * The squared radius of each pixel, [height][width], m^2, that one sample finds by the gatherer of
 * this query at the end of its path or, for RT_QUERY_EARLIER, at its first diffuse bounce; 0 where
 * there are no photons or no gather point. The film is left alone.
 */
rt_status rt_eye_paths_radii(rt_eye_paths *paths, const rt_queries *queries, rt_query query,
                             uint32_t sample, float *squared, rt_stage_progress *progress,
                             rt_error *error);

/*
 * The places of the gather points of one sample of each of a range of pixels, at the ends of paths
 * and, at the earlier vertices of a final gather, those of caustic photons; *count: how many there
 * are, at most the pixels times 1 + rows.
 */
rt_status rt_eye_paths_points(rt_eye_paths *paths, rt_unit_range pixels, uint32_t sample,
                              float (*points)[3], size_t *count, rt_stage_progress *progress,
                              rt_error *error);

/*
 * Counts, for each query that has tests, the photons around the gather point of one sample of every
 * pixel; tests[query]: rt_radius_test of each pixel. The gatherers have radii of pixels.
 */
rt_status rt_eye_paths_count_sectors(rt_eye_paths *paths, const rt_queries *queries, cl_mem *tests,
                                     uint32_t sample, rt_stage_progress *progress, rt_error *error);

/* Reads the film from the device, and the layers of the first hit; writes them. */
rt_status rt_eye_paths_read(const rt_eye_paths *paths, rt_error *error);
rt_status rt_eye_paths_write(const rt_eye_paths *paths, rt_error *error);

/*
 * In passes: empty layers for the next one, of this number; and the samples of one, from `first`
 * on, added to this plane of the film, so that it never holds a part of a pass. The film of a pass
 * is empty then.
 */
void rt_eye_paths_begin_pass(rt_eye_paths *paths, uint32_t pass);
rt_status rt_eye_paths_end_pass(rt_eye_paths *paths, uint32_t plane, uint32_t first,
                                rt_error *error);

#endif
