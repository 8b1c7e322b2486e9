/*
 * kernel_cache.h - where drivers compile and what is kept of it between runs.
 *
 * PoCL keeps what it compiles in the folder that POCL_CACHE_DIR names when it is first asked for
 * its devices, for the whole process. It is given a work folder of this process alone; what lies in
 * the user's cache folder is checked before it goes in there, and stored from there. Other drivers
 * leave the work folder empty, and keep their own caches.
 *
 * The state is the process's, as the drivers' is. The functions are called under rt_driver_lock.
 */
#ifndef RT_LIB_DEVICE_KERNEL_CACHE_H
#define RT_LIB_DEVICE_KERNEL_CACHE_H

#include "base/bytes.h"
#include "rt.h"

/* One thread at a time starts drivers, builds programs and changes the state below. */
void rt_driver_lock(void);
void rt_driver_unlock(void);

/*
 * Before and after the first call of OpenCL: makes the work folder and hands it to the driver by
 * POCL_CACHE_DIR, and restores that variable. Fails with RT_ERROR_DEVICE where there is no place
 * for a work folder. Later calls do nothing.
 */
rt_status rt_kernel_cache_open(rt_error *error);
void rt_kernel_cache_opened(void);

/*
 * Before a program is built: unpacks what is stored of it. The key is that of everything that the
 * compiled program depends on.
 */
void rt_kernel_cache_fetch(uint64_t key, const char *program);

/*
 * Before each build: notes the folders that are there, of other programs or of builds that failed.
 * Returns 0 where they cannot be read: what is made then is taken for nobody's.
 */
int rt_kernel_cache_watch(void);

/* After a program is built of its source: notes which folder the driver made for it. */
void rt_kernel_cache_built(uint64_t key);

/* The bitcode of a program that PoCL has in its folder; 0 where there is none. */
int rt_kernel_cache_bitcode(rt_bytes *out, uint64_t key);

/* What became of a program that was built of its bitcode. */
typedef enum rt_bitcode_state {
    RT_BITCODE_KNOWN,    /* PoCL had it in its folder and took it as it is */
    RT_BITCODE_REPLACED, /* it is what PoCL's new folder has now, and must be built of again */
    RT_BITCODE_BROKEN    /* that failed, or is not known; the program must not be used */
} rt_bitcode_state;

/*
 * After a program is built of its bitcode: where PoCL made a new folder for it, makes that the
 * program's in place of the one before, and puts the bitcode there in place of PoCL's.
 */
rt_bitcode_state rt_kernel_cache_replace(uint64_t key, const rt_bytes *bitcode);

/* From now on there is no bitcode of a program: a build of it failed halfway. */
void rt_kernel_cache_spoil(uint64_t key);

/* Whether something is stored of a program. */
int rt_kernel_cache_has(uint64_t key, const char *program);

/* Stores the programs of which something was compiled since. */
void rt_kernel_cache_keep(void);

/*
 * Hands what went wrong since to the hooks' warning callback, if they have one. Not under the lock.
 */
void rt_kernel_cache_tell(const rt_hooks *hooks);

/* The folder in which programs are stored; empty where they are not. */
const char *rt_kernel_cache_store(void);

#endif
