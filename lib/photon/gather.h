/*
 * gather.h - asks a photon map for the light that gather points reflect, and adds it to a film.
 *
 * The nearest photons are found on the host, the sum over them, with the material, is taken on the
 * device: shading exists once.
 */
#ifndef RT_LIB_PHOTON_GATHER_H
#define RT_LIB_PHOTON_GATHER_H

#include "device/device.h"
#include "photon/photon_map.h"
#include "types.h"

typedef struct rt_gatherer rt_gatherer;

/* How to gather. */
typedef struct rt_gather_options {
    uint32_t k;       /* nearest photons, at least 1; the k-th gives the radius and does not count */
    float max_radius; /* metres; 0: no limit */
    rt_density density;
    float cone_k; /* constant of the cone kernel, at least 1 */
} rt_gather_options;

/*
 * Makes a map ready: builds the search tree and uploads the photons. The map must outlive the gatherer
 * unchanged, as must the device and, on it, the scene; `kernel` is photon_gather of the program of that
 * name. The caller owns *out.
 */
rt_status rt_gatherer_create(rt_gatherer **out, rt_device *device, cl_kernel kernel, cl_mem scene,
                             const rt_photon_map *map, const rt_gather_options *options, rt_error *error);
void rt_gatherer_destroy(rt_gatherer *gatherer);

/* The most points that rt_gatherer_add takes at once, and its buffer of rt_gather_point for them. */
size_t rt_gatherer_capacity(const rt_gatherer *gatherer);
cl_mem rt_gatherer_points(const rt_gatherer *gatherer);

/*
 * Adds the samples of the first `count` points of the gatherer's buffer to film, a buffer of
 * rt_film_pixel: their radiance, and their weight times what the material makes of the photons. No two
 * of the points may be of the same pixel. *asked, if not NULL, grows by the points that asked the map.
 */
rt_status rt_gatherer_add(rt_gatherer *gatherer, size_t count, cl_mem film, uint64_t *asked, rt_error *error);

#endif
