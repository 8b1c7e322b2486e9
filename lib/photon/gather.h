/*
 * gather.h - the light that gather points reflect, estimated from a list of photons.
 *
 * There are two searches for the photons near a point: neighbour lists, made on the host by FLANN
 * and sent to the device, and a tree that the device traverses itself; a third finds the nearest
 * point at which the irradiance is known. The sum over the photons,
 * with the material, is taken on the device either way, so shading exists once.
 */
#ifndef RT_LIB_PHOTON_GATHER_H
#define RT_LIB_PHOTON_GATHER_H

#include "base/progress.h"
#include "device/device.h"
#include "photon/photon_list.h"
#include "photon/tree_builder.h"
#include "types.h"

typedef struct rt_gatherer rt_gatherer;

typedef enum rt_photon_search {
    RT_SEARCH_NEIGHBOURS, /* neighbour lists from the host, by FLANN: k nearest only */
    RT_SEARCH_TREE,       /* a tree on the device */
    /*
     * a tree of points of known irradiance: photons with the irradiance in place of flux, emitted
     * by 1 path. The nearest within max_radius alone, and Lambert's lobe
     */
    RT_SEARCH_IRRADIANCE
} rt_photon_search;

/*
 * The search that the settings of a render in one pass mean. Where they leave the choice, it is the
 * tree, which finds the same photons faster; the hull is for the neighbour lists alone.
 */
rt_photon_search rt_photon_search_of(const rt_render_options *options);

/* The maximum number of gather points per call: a GPU takes more, to have all of it at work. */
size_t rt_gather_points_max(const rt_device *device);

/* How to gather. */
typedef struct rt_gather_options {
    /* nearest photons; the k-th gives the radius and does not count. 0: all within max_radius */
    uint32_t k;
    float max_radius; /* metres; 0: no limit, which k = 0 must have */
    rt_density density;
    float cone_k; /* constant of the cone kernel, at least 1 */
    rt_area area; /* the hull is for neighbour lists only */
    rt_photon_search search;
    int skip_empty; /* the radius of a disc without photons does not matter: lists may make it 0 */
    const rt_hooks *hooks; /* their log is told where the device has no room; NULL: nobody */
} rt_gather_options;

/*
 * The name of the program, and of the kernel in it, that sums the photons of a search; of a scene
 * that is plain (kernels/types.h), or of any.
 */
const char *rt_gather_kernel_name(rt_photon_search search, int is_plain);

/*
 * Makes that kernel, compiled ahead of its first launch, as part of a stage. any: a buffer that
 * stands for all of its arguments; it is left alone. The caller releases *out.
 */
rt_status rt_gather_kernel_prepare(cl_kernel *out, rt_device *device, rt_photon_search search,
                                   int is_plain, cl_mem any, rt_stage_progress *progress,
                                   rt_error *error);

/*
 * Makes a list ready: builds the search tree and uploads the photons. The list must outlive the
 * gatherer unchanged, as must the device and, on it, the kernel, which is that of the search. The
 * caller owns *out. place: the caller's memory for the tree of a list on the device, which serves
 * one gatherer at a time; NULL where the list lies on the host.
 */
rt_status rt_gatherer_create(rt_gatherer **out, rt_device *device, cl_kernel kernel,
                             const rt_photon_list *list, const rt_gather_options *options,
                             rt_tree_place *place, rt_error *error);
void rt_gatherer_destroy(rt_gatherer *gatherer);

/*
 * The scene that the points lie in, for points whose lobe is rough: without it, none may be. The
 * buffer stays the caller's.
 */
void rt_gatherer_set_scene(rt_gatherer *gatherer, cl_mem scene);

/*
 * Gives each pixel a radius of its own in place of max_radius, for k = 0: its square, m^2, is
 * factor > 0 times the pixel's float in `squared`, which stays the caller's and must outlive the
 * gatherer.
 */
void rt_gatherer_limit_pixels(rt_gatherer *gatherer, cl_mem squared, float factor);

/*
 * Multiplies the squared radii of a gatherer of all photons within them by this factor, above 0,
 * from here on.
 */
void rt_gatherer_scale(rt_gatherer *gatherer, float factor);

/* Gathers with another density kernel from here on; the photons found stay the same. */
void rt_gatherer_set_density(rt_gatherer *gatherer, rt_density density, float cone_k);

/* The maximum number of points per call of rt_gatherer_add, at most rt_gather_points_max. */
size_t rt_gatherer_capacity(const rt_gatherer *gatherer);

/*
 * What the last call of rt_gatherer_add found, rt_gather_disc [count] on the device; NULL where it
 * is the host that finds photons.
 */
cl_mem rt_gatherer_discs(const rt_gatherer *gatherer);

/*
 * Adds to the radiance of points first .. first + count - 1 of a buffer of rt_gather_point their
 * weight times the radiance that the material reflects of the photons around them. discs [count],
 * if not NULL, is what was found.
 */
rt_status rt_gatherer_add(rt_gatherer *gatherer, cl_mem points, size_t first, size_t count,
                          rt_gather_disc *discs, rt_error *error);

/*
 * The same for copies of the points of the last call, around which the same photons are found:
 * neighbour lists are not made again.
 */
rt_status rt_gatherer_add_again(rt_gatherer *gatherer, cl_mem points, size_t first, size_t count,
                                rt_error *error);

/*
 * Adds the photons around points 0 .. count - 1, of which no two have the same pixel, to the tests
 * of their pixels by the kernel count_sectors. For a gatherer with radii of pixels.
 */
rt_status rt_gatherer_count_sectors(rt_gatherer *gatherer, cl_kernel kernel, cl_mem points,
                                    size_t count, cl_mem tests, rt_error *error);

#endif
