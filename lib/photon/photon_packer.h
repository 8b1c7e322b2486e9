/*
 * photon_packer.h - appends the photons of a batch to a list from a device with memory of its own,
 * which packs them first: most slots of a path stay empty, and to copy them all would take longer
 * than to follow the paths.
 */
#ifndef RT_LIB_PHOTON_PHOTON_PACKER_H
#define RT_LIB_PHOTON_PHOTON_PACKER_H

#include "device/device.h"
#include "photon/photon_list.h"
#include "photon/prefix_sum.h"
#include "types.h"

typedef struct rt_photon_packer {
    rt_device *device;
    cl_kernel kernel; /* NULL: there is none */
    cl_kernel counts;
    rt_prefix_sum prefix;
    cl_mem places; /* rt_u32 [paths + 1], with room for their sums */
    cl_mem packed; /* rt_photon [room] */
    rt_u32 *host;  /* of the places */
    size_t room;
} rt_photon_packer;

/* For batches of up to `paths` paths of up to `slots` photons. The caller releases *out. */
rt_status rt_photon_packer_create(rt_photon_packer *out, rt_device *device, size_t paths,
                                  size_t slots, rt_error *error);
void rt_photon_packer_release(rt_photon_packer *packer);

/*
 * As rt_photon_list_append, with the slots on the device, `row` paths a row; accounts:
 * [path_count].
 */
rt_status rt_photon_packer_append(rt_photon_packer *packer, rt_photon_list *list, cl_mem slots,
                                  size_t row, const rt_path_account *accounts, size_t path_count,
                                  rt_error *error);

/*
 * Packs the photons of such paths to the end of a list on the device, which has
 * room for them; the accounts lie there too. The list's counts stay as they are.
 */
rt_status rt_photon_packer_keep(rt_photon_packer *packer, const rt_photon_list *list, cl_mem slots,
                                size_t row, cl_mem accounts, size_t path_count, rt_error *error);

#endif
