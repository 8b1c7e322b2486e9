/* rt/base.h - version, errors, progress and log. Part of rt.h, the manual. */
#ifndef RT_RT_BASE_H
#define RT_RT_BASE_H

#include <stddef.h>
#include <stdint.h>
#include "common.h"

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__)
#define RT_API __attribute__((visibility("default")))
#else
#define RT_API
#endif

#define RT_VERSION_MAJOR 0
#define RT_VERSION_MINOR 1
#define RT_VERSION_PATCH 0

/* The version of the library at run time, as "0.1.0". */
RT_API const char *rt_version(void);

/* ---- Errors ---------------------------------------------------------------------------------- */

typedef enum rt_status {
    RT_OK = 0,
    RT_ERROR_INPUT,  /* the scene or a file it names is wrong */
    RT_ERROR_USAGE,  /* an argument or an option is out of its range */
    RT_ERROR_DEVICE, /* no OpenCL platform or device, a kernel does not build, a launch fails */
    RT_ERROR_OUTPUT, /* a file could not be written */
    RT_ERROR_MEMORY, /* host or device memory is exhausted */
    RT_CANCELLED     /* a progress callback asked to stop */
} rt_status;

/* What went wrong. Owned by the caller; filled by the call that fails. */
typedef struct rt_error {
    rt_status status;
    int line, column;  /* in `file`, from 1; 0 when the error has no place */
    char field[32];    /* the option or field at fault, or empty */
    char file[512];    /* the file that is wrong, or could not be read or written; or empty */
    char message[512]; /* one line, without newline, naming the offending value */
} rt_error;

/* ---- Progress and log ------------------------------------------------------------------------ */

typedef enum rt_stage {
    RT_STAGE_LOAD,    /* reading the scene and its files */
    RT_STAGE_BUILD,   /* building the bounding volume hierarchy */
    RT_STAGE_COMPILE, /* building OpenCL kernels; quick once the driver has them cached */
    RT_STAGE_EMIT,    /* photon emission */
    RT_STAGE_GATHER,  /* photon mode: building the search tree, then camera paths and gathering */
    /*
     * the other modes: camera paths; photon mode with passes: emission and gathering of all passes
     */
    RT_STAGE_RENDER
} rt_stage;

typedef struct rt_progress {
    rt_stage stage;
    double fraction;  /* of this stage, 0 to 1 */
    double elapsed;   /* seconds since this stage began */
    double remaining; /* estimated seconds to the end of this stage, negative while unknown */
    /* relative RMSE of the picture so far, see rt_film_stats; negative while unknown */
    double error;
} rt_progress;

/*
 * Hooks of long calls, called from the thread that made the call. A progress callback
 * is called at the start and the end of each stage and at least every second between;
 * one that returns non-zero cancels the call, which then returns RT_CANCELLED.
 */
typedef struct rt_hooks {
    int (*progress)(void *user, const rt_progress *progress);
    void (*log)(void *user, const char *line); /* details; one line, without newline */
    void *user;
    void (*warning)(void *user, const char *line); /* a probable mistake, likewise */
} rt_hooks;

/* The name of a stage in lower case, such as "build"; static storage. */
RT_API const char *rt_stage_name(rt_stage stage);

#ifdef __cplusplus
}
#endif

#endif
