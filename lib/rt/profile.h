/* rt/profile.h - where the time goes. Part of rt.h, the manual. */
#ifndef RT_RT_PROFILE_H
#define RT_RT_PROFILE_H

#include "base.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Profile --------------------------------------------------------------------------------- */

/*
 * The time that a program spends in its stages, and its devices in their kernels. It is given to
 * rt_load_options, for scenes, and to rt_device_options, for all that is done on the device, which
 * holds it, see CONVENTIONS. Threads may share it. It never changes a result. Without memory a
 * profile goes on, and lacks what it had no room for.
 *
 * The library's stages:
 *
 *     load          reading a scene and its files
 *     check         looking for probable mistakes in it
 *     build         the bounding volume hierarchy and the tables of the scene
 *     upload        the scene, to the device
 *     media         finding the media around the camera and the lights
 *     fingerprint   what identifies the scene in films and photon maps
 *     compile       kernels, by the driver or out of the cache
 *     trace         camera paths, in modes other than photon
 *     emit          photon emission
 *     structure     the search structure of a photon map, and irradiance at its photons
 *     gather        camera paths in photon mode, density estimation, and the sums of the film
 *     read film     sums from the device to the host
 *     error         the estimate of the error
 *     checkpoint    the callback of a checkpoint
 *     preview       the callback of a preview
 *     resolve       from the film's sums to radiance and layers
 */
typedef struct rt_profile rt_profile;

/*
 * has_trace: each stage, launch and transfer is kept by itself, 40 bytes each, for
 * rt_profile_write; 0: sums alone. The caller owns *out.
 */
RT_API rt_status rt_profile_create(rt_profile **out, int has_trace, rt_error *error);
RT_API void rt_profile_destroy(rt_profile *profile);

/*
 * Begins a stage of the calling thread, within those that it has begun and not ended; `name` must
 * last as long as the profile. rt_profile_end ends the last one begun. NULL does nothing.
 */
RT_API void rt_profile_begin(rt_profile *profile, const char *name);
RT_API void rt_profile_end(rt_profile *profile);

/* Seconds since the profile was made, by a clock that is never set. */
RT_API double rt_profile_seconds(const rt_profile *profile);

/*
 * What was spent in a stage that has ended, without the stages within it. The seconds of all stages
 * on the thread that made the profile add up to the time that it spent in any; what other threads
 * spent, side by side with it, is `beside`.
 */
typedef struct rt_profile_stage {
    const char *name;
    uint64_t count; /* of times that it was ended, on any thread */
    double seconds, beside;
} rt_profile_stage;

/*
 * Writes up to `room` of them to out, in the order in which they began first. Returns how many
 * there are.
 */
RT_API size_t rt_profile_get_stages(const rt_profile *profile, rt_profile_stage *out, size_t room);

/* What devices did, by their own clocks: a kernel, or a transfer. Of several devices, the sum. */
typedef struct rt_profile_command {
    char name[48]; /* of the kernel; "read", "write" or "copy" */
    int is_transfer;
    uint64_t count;  /* launches, or transfers */
    uint64_t amount; /* work-items, without those that round up; or bytes */
    double seconds;  /* from the start of each to its end */
    double waited;   /* from the call that asked for each to its start */
} rt_profile_command;

/*
 * The same for commands, in the order of their first end; rt_render and rt_photon_map_emit wait for
 * theirs.
 */
RT_API size_t rt_profile_get_commands(const rt_profile *profile, rt_profile_command *out,
                                      size_t room);

/*
 * Writes the trace as JSON in the Trace Event Format, which ui.perfetto.dev and chrome://tracing
 * open: a track for each thread, with its stages, and one for each device, with its commands. Fails
 * with RT_ERROR_USAGE where the profile has no trace, with RT_ERROR_OUTPUT where the file cannot be
 * written.
 */
RT_API rt_status rt_profile_write(const rt_profile *profile, const char *path, rt_error *error);

#ifdef __cplusplus
}
#endif

#endif
