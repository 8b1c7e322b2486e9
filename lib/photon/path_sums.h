/*
 * path_sums.h - sums of the accounts of photon paths, taken on the device: the host reads as much
 * as an energy ledger has, not an account a path.
 */
#ifndef RT_LIB_PHOTON_PATH_SUMS_H
#define RT_LIB_PHOTON_PATH_SUMS_H

#include "device/device.h"
#include "photon/ledger.h"

/* With more sources of light than this, the host books the accounts: a row of sums takes long. */
enum { RT_PATH_SUMS_SOURCES = 32 };

/* All zero is none. */
typedef struct rt_path_sums {
    rt_device *device;
    cl_kernel sums, join;
    size_t sources; /* of which sums are taken; 0: there are too many */
    cl_mem of_light, exponents;
    cl_mem rows;  /* rt_i64 [][1 + sources][RT_SUMS_A_ROW] */
    rt_i64 *host; /* [1 + sources][RT_SUMS_A_ROW] */
} rt_path_sums;

/* For batches of up to `paths` paths. rt_path_sums_release undoes it. */
rt_status rt_path_sums_create(rt_path_sums *out, rt_device *device, const rt_light_sources *lights,
                              size_t paths, rt_error *error);
void rt_path_sums_release(rt_path_sums *sums);

/*
 * Sums the accounts of a batch that lie on the device. *out: rows of RT_SUMS_A_ROW, the first of
 * totals and, with_sources, one for each source of light, as rt_ledger_book_sums takes them; they
 * stay until the next call.
 */
rt_status rt_path_sums_run(rt_path_sums *sums, const rt_i64 **out, cl_mem accounts, size_t paths,
                           int with_sources, rt_error *error);

#endif
