/*
 * light_sources.h - the lights of a scene, each emissive shape as one light, and their shares of
 * the photon paths.
 *
 * The kernels' table of lights has an entry for each emissive primitive; here an emissive shape is
 * one light, however many triangles it has.
 */
#ifndef RT_LIB_PHOTON_LIGHT_SOURCES_H
#define RT_LIB_PHOTON_LIGHT_SOURCES_H

#include "device/device.h"
#include "types.h"

typedef struct rt_light_source {
    rt_u32 shape;        /* index of the emissive shape, or RT_NONE */
    rt_u32 first, count; /* its entries in the scene's table of lights */
    double power[3];     /* W */
    double share;        /* of the photon paths; all add up to 1 */
} rt_light_source;

typedef struct rt_light_sources {
    rt_memory *memory;        /* that they count in, and the ledgers of their paths; NULL: none */
    rt_light_source *sources; /* [count], in the order of the table of lights */
    size_t count;
    rt_u32 *of_light;       /* [light_count], the source of each entry */
    rt_light_share *shares; /* [light_count], for the device */
    size_t light_count;
    /*
     * metres around the middle of all finite shapes, or the origin where there are none, beyond
     * which light from infinitely far is not followed to planes; 0: no such light or no plane
     */
    double reach;
    const char *reach_from; /* that point, in words after "the" */
} rt_light_sources;

/*
 * Reads the lights of a scene on the device. shares: [share_count], the part of the paths that
 * each source gets, in proportion; none: in proportion to power. Fails with RT_ERROR_USAGE when
 * there are not as many shares as sources, one is not a number from 0 on, or a light with power
 * gets none. Free with rt_light_sources_free.
 */
rt_status rt_light_sources_read(rt_light_sources *out, rt_device *device, cl_mem scene,
                                const float *shares, size_t share_count, rt_error *error);
/*
 * Multiplies the shares of the sources with factors [count] whose mean by share is 1. Starts keep
 * their mean, as their flux is divided by the share.
 */
void rt_light_sources_weigh(rt_light_sources *sources, const double *factors);

void rt_light_sources_free(rt_light_sources *sources);

#endif
