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
    RT_ERROR_MEMORY, /* host or device memory is exhausted, or a limit on it reached */
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

/* ---- Memory ---------------------------------------------------------------------------------- */

/*
 * A limit on the memory that scenes, renderers, photon maps and films take together, buffers of the
 * device among them. It is given to rt_load_options, rt_scene_set_memory and rt_photon_map_load_in,
 * and to rt_device_options, with which all that is made on the device counts. A call that would
 * exceed it fails with RT_ERROR_MEMORY before it allocates, and the message says what needed how
 * much. All that grows with a scene, a map or a picture counts; programs, drivers, compiled kernels
 * and what takes a few kilobytes do not. A film counts with the memory that writing it to files
 * takes. Threads may share it; what was given it holds it, see CONVENTIONS.
 */
typedef struct rt_memory rt_memory;

typedef struct rt_memory_info {
    uint64_t limit;      /* bytes; 0: none */
    uint64_t used, most; /* bytes now, and the most at any time */
} rt_memory_info;

/* What takes memory, by the word under which it counts. */
typedef struct rt_memory_owner {
    char what[48];       /* as in rt_memory_take, cut off at the end; "others" is the last */
    uint64_t used, most; /* bytes now, and the most of this owner at any time */
    uint64_t at_most;    /* bytes when all took the most: over all owners, rt_memory_info.most */
} rt_memory_owner;

/* limit: bytes, 0 for none. The caller owns *out. */
RT_API rt_status rt_memory_create(rt_memory **out, uint64_t limit, rt_error *error);
RT_API void rt_memory_destroy(rt_memory *memory);
RT_API void rt_memory_get_info(const rt_memory *memory, rt_memory_info *out);

/*
 * Writes up to `room` owners to out, in the order in which they first took memory. Returns how many
 * there are, at most 64.
 */
RT_API size_t rt_memory_get_owners(const rt_memory *memory, rt_memory_owner *out, size_t room);

/*
 * Counts memory of the caller's own, and gives it back; `what` needs it, as in "the window", in the
 * message of a failure with RT_ERROR_MEMORY. More than was taken for `what` leaves 0 of it. NULL
 * counts nowhere.
 */
RT_API rt_status rt_memory_take(rt_memory *memory, uint64_t bytes, const char *what,
                                rt_error *error);
RT_API void rt_memory_give(rt_memory *memory, uint64_t bytes, const char *what);

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
    /* of the stage `compile`: programs that are compiled, and that had to be; else 0 of 0 */
    uint32_t step, steps;
} rt_progress;

/*
 * Hooks of long calls, called from the thread that made the call. A progress callback
 * is called at the start and the end of each stage and at least every second between;
 * one that returns non-zero cancels the call, which then returns RT_CANCELLED. A stage that is
 * cancelled does not report its end, a fraction of 1.
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
