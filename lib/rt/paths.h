/* rt/paths.h - the camera paths of a pixel, vertex by vertex. Part of rt.h, the manual. */
#ifndef RT_RT_PATHS_H
#define RT_RT_PATHS_H

#include "render.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Paths ----------------------------------------------------------------------------------- */

#define RT_PATHS_MAX 65536u /* samples of a call */

/* Camera paths with their vertices; see rt_camera_path and rt_path_vertex in common.h. */
typedef struct rt_paths rt_paths;

/*
 * Follows the paths of the pixel in column x and row y, counted from the top left, again: samples
 * first to first + count - 1 of those that rt_render takes with the same options, in mode path.
 * options NULL: the scene's own. count 0: to the last of the render, or the first RT_PATHS_MAX of
 * these. Samples beyond spp are those that a larger spp would add. The pixel is the sum of weight
 * times radiance over the samples, divided by the sum of the weights: with a device of width 1 to
 * the bit but for the order of additions, else up to rounding, as rt_render then shades eight paths
 * at once. Its stages for options->hooks are `compile` and `render`. The caller owns *out, which
 * does not depend on the renderer.
 *
 * Fails with RT_ERROR_USAGE for another mode, with variance or target_error, which draw samples
 * from independent sequences, for a pixel outside of the picture, without a sample, and with more
 * than RT_PATHS_MAX; error->field names the option or parameter.
 */
RT_API rt_status rt_paths_trace(rt_paths **out, rt_renderer *renderer,
                                const rt_render_options *options, uint32_t x, uint32_t y,
                                uint32_t first, uint32_t count, rt_error *error);
RT_API void rt_paths_destroy(rt_paths *paths);

/* The paths, by sample, and all their vertices; owned by `paths`. */
RT_API const rt_camera_path *rt_paths_list(const rt_paths *paths, size_t *count);
RT_API const rt_path_vertex *rt_paths_vertices(const rt_paths *paths, size_t *count);

/* The word of an event, such as "diffuse"; static storage. */
RT_API const char *rt_path_event_name(rt_path_event event);

#ifdef __cplusplus
}
#endif

#endif
