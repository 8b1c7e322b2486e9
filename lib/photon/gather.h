/*
 * gather.h - asks a photon list for the light that gather points reflect.
 *
 * The nearest photons are found on the host, by FLANN, or on the device; the sum over them, with
 * the material, is taken on the device either way: shading exists once.
 */
#ifndef RT_LIB_PHOTON_GATHER_H
#define RT_LIB_PHOTON_GATHER_H

#include "device/device.h"
#include "photon/photon_list.h"
#include "types.h"

typedef struct rt_gatherer rt_gatherer;

/* The most gather points that are taken at once. */
enum { RT_GATHER_POINTS_MAX = 1 << 16 };

/* How to gather. */
typedef struct rt_gather_options {
    /* nearest photons; the k-th gives the radius and does not count. 0: all within max_radius */
    uint32_t k;
    float max_radius; /* metres; 0: no limit, which k = 0 must have */
    rt_density density;
    float cone_k;  /* constant of the cone kernel, at least 1 */
    rt_area area;  /* the hull is for the host only */
    int on_device; /* find the photons on the device, in a tree, instead of on the host by FLANN */
} rt_gather_options;

/*
 * Makes a list ready: builds the search tree and uploads the photons. The list must outlive the
 * gatherer unchanged, as must the device and, on it, the kernel: that of the program gather_tree
 * for the gather on the device, else of gather_neighbours, both of the same name. k = 0 is for the
 * device only. The caller owns *out.
 */
rt_status rt_gatherer_create(rt_gatherer **out, rt_device *device, cl_kernel kernel,
                             const rt_photon_list *list, const rt_gather_options *options,
                             rt_error *error);
void rt_gatherer_destroy(rt_gatherer *gatherer);

/*
 * Gives each pixel a radius of its own in place of max_radius, for k = 0: its square, m^2, is
 * factor > 0 times the pixel's float in `squared`, which stays the caller's and must outlive the
 * gatherer.
 */
void rt_gatherer_limit_pixels(rt_gatherer *gatherer, cl_mem squared, float factor);

/* The most points that rt_gatherer_add takes at once, at most RT_GATHER_POINTS_MAX. */
size_t rt_gatherer_capacity(const rt_gatherer *gatherer);

/*
 * Adds to the radiance of points first .. first + count - 1 of a buffer of rt_gather_point their
 * weight times what the material makes of the photons around them. discs [count], if not NULL, is
 * what was found.
 */
rt_status rt_gatherer_add(rt_gatherer *gatherer, cl_mem points, size_t first, size_t count,
                          rt_gather_disc *discs, rt_error *error);

#endif
