/* emit.h - photon emission: fills a photon map by a device. */
#ifndef RT_LIB_PHOTON_EMIT_H
#define RT_LIB_PHOTON_EMIT_H

#include "base/progress.h"
#include "device/device.h"
#include "photon/photon_map.h"
#include "photon/importance.h"
#include "photon/light_sources.h"

/* A scene's lights, and memory for a batch of paths. Serves any number of emissions. */
typedef struct rt_emitter rt_emitter;

/* The kernel of a scene, and the program of the same name. */
const char *rt_emit_kernel_name(const rt_renderer *renderer);

/*
 * Makes the kernel of that name, compiled ahead of its first launch, as part of a stage. scene: any
 * buffer. The caller releases *out.
 */
rt_status rt_emit_kernel_prepare(cl_kernel *out, rt_device *device, cl_mem scene, const char *name,
                                 rt_stage_progress *progress, rt_error *error);

/*
 * Makes ready to emit from a scene on a device. kernel: by rt_emit_kernel_prepare;
 * shares: [share_count], as rt_light_sources_read takes them. Scene and kernel must outlive the
 * emitter. The caller owns *out.
 */
rt_status rt_emitter_create(rt_emitter **out, rt_device *device, cl_kernel kernel, cl_mem scene,
                            const float *shares, size_t share_count, rt_error *error);
void rt_emitter_destroy(rt_emitter *emitter);

/*
 * Has paths start by visual importance, from the next emission on; once. The importance is not
 * needed afterwards.
 */
rt_status rt_emitter_follow(rt_emitter *emitter, const rt_importance *importance, rt_error *error);

/* The lights that it emits from. */
const rt_light_sources *rt_emitter_lights(const rt_emitter *emitter);

/*
 * The starts [count] of paths of a seed from `first` on, in cells divided so often, by the kernel
 * photon_starts; settings: of the map.
 */
rt_status rt_emitter_starts(const rt_emitter *emitter, cl_kernel kernel, rt_path_start *starts,
                            const rt_photon_settings *settings, uint32_t seed, size_t first,
                            size_t count, uint32_t levels, rt_error *error);

/* The memory that the photons of a map must fit into, in bytes; at first this machine's. 0: any. */
void rt_emitter_limit_memory(rt_emitter *emitter, uint64_t bytes);

/* Has the device pack photons before they are read, as one with memory of its own does anyway. */
void rt_emitter_pack(rt_emitter *emitter);

/*
 * Leaves photons on the device: the lists of a map then hold a buffer, for those that gather from
 * it. A list for which the device has no room moves to the host, as the log then tells.
 */
void rt_emitter_keep(rt_emitter *emitter);

/*
 * Warns of light that photon paths leave out: that of the environment and of directional lights on
 * far parts of planes.
 */
void rt_emitter_warn_reach(const rt_emitter *emitter, const rt_hooks *hooks);

/* An empty ledger of the scene's lights; free with rt_ledger_free. */
rt_status rt_emitter_make_ledger(const rt_emitter *emitter, rt_ledger *out, rt_error *error);

/*
 * Called after each batch: the map then holds all paths so far, with their range as its last one.
 */
void rt_emitter_after_batch(rt_emitter *emitter, void (*after)(void *user), void *user);

/*
 * Emits paths first .. first + count - 1 of a seed into one list of the map, behind what it holds,
 * in batches of bounded memory. The map's settings say how (`scene` apart); its ledger is made for
 * the lights when it has none. Path i of a seed is always the same path, whatever the batches; the
 * paths of the caustic list are others than those of the global one, which fill the volume list as
 * well where the map is of a scene with media. Ranges must come in ascending
 * order, or be put in their place by rt_photon_map_settle. On RT_CANCELLED the map holds whole
 * batches. Fails with RT_ERROR_USAGE when an index is above 2^32 - 1, and with RT_ERROR_MEMORY as
 * soon as it is clear that the photons will not fit into memory.
 */
rt_status rt_emitter_emit(rt_emitter *emitter, rt_photon_map *map, rt_photon_kind kind,
                          uint32_t seed, uint64_t first, uint64_t count,
                          rt_stage_progress *progress, rt_error *error);

#endif
