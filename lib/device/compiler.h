/*
 * compiler.h - compiling programs in another process, which stores them in the cache. PoCL compiles
 * one kernel at a time in a process, however many threads ask for it.
 */
#ifndef RT_LIB_DEVICE_COMPILER_H
#define RT_LIB_DEVICE_COMPILER_H

#include <sys/types.h>

#include "device/device.h"

/*
 * How many processes may compile for a device at once, beside this one; 0 where there is no
 * compiler, or where other processes cannot store what they compile.
 */
uint32_t rt_compilers(const rt_device *device);

/* Starts the device's compiler on some programs. Returns its process, or -1. */
pid_t rt_compiler_begin(const rt_device *device, const char *const *programs, uint32_t count);

/* Waits for its end; until rt_compiler_end nobody else gets its number. */
void rt_compiler_wait(pid_t process);
void rt_compiler_end(pid_t process);

#endif
