/* compile.h - compiles several programs that the cache lacks, at the same time where possible. */
#ifndef RT_LIB_RENDER_COMPILE_H
#define RT_LIB_RENDER_COMPILE_H

#include "base/progress.h"
#include "device/device.h"

enum { RT_PROGRAMS_OF_RENDER = 12 };

/* Names of programs of the library. */
typedef struct rt_program_list {
    const char *names[RT_PROGRAMS_OF_RENDER];
    uint32_t count;
} rt_program_list;

void rt_program_list_add(rt_program_list *list, const char *program);

/*
 * Compiles those that the device has not, some in this process and the others in processes of the
 * device's compiler, and reports how many are ready. A program that does not compile is left to
 * those who need it. Does nothing for a driver whose programs are not stored. Runs as part of a
 * stage.
 */
rt_status rt_programs_compile(rt_device *device, const rt_program_list *programs,
                              rt_stage_progress *progress);

#endif
