/* pack.h - a scene as the one buffer that the device reads. */
#ifndef RT_LIB_PACK_PACK_H
#define RT_LIB_PACK_PACK_H

#include "base/progress.h"
#include "scene/scene.h"

/*
 * The buffer, as kernels/types.h lays it out: rt_scene_header, then its tables. All zero is none.
 */
typedef struct rt_scene_image {
    void *data; /* aligned to 4096 bytes */
    size_t bytes;
    double light_power; /* of all lights, W */
    /*
     * Whether a solid may be around the camera or a light: the kernel enclosing_media has to find
     * it. Else the image is right as it is.
     */
    int may_start_in_solids;
    int is_plain;      /* it is a scene for programs that define RT_PLAIN (kernels/types.h) */
    rt_memory *memory; /* that the buffer counts in, and what its packing takes; NULL: none */
} rt_scene_image;

/*
 * Builds the bounding volume hierarchy with so many threads and packs the scene for devices of this
 * width: with two-wide nodes for 1. The camera is left zero: it depends on the film. *out is empty
 * before. Free with rt_scene_image_free.
 */
rt_status rt_scene_pack(rt_scene_image *out, const rt_scene *scene, rt_accel accel, uint32_t width,
                        uint32_t threads, rt_stage_progress *progress, rt_error *error);

/* Frees the buffer; what is known of the lights stays. */
void rt_scene_image_free(rt_scene_image *image);

#endif
