/*
 * memory.h - memory that counts in an rt_memory. What grows with a scene, a map or a picture is
 * allocated here; what is small is not.
 */
#ifndef RT_LIB_BASE_MEMORY_H
#define RT_LIB_BASE_MEMORY_H

#include <stddef.h>
#include <stdint.h>

#include "base/error.h"

/*
 * An object that keeps a memory for later calls holds it until its own end, so that it does not
 * matter in which order their owner destroys them. Returns what it is given; both take NULL.
 */
rt_memory *rt_memory_hold(rt_memory *memory);
void rt_memory_drop(rt_memory *memory);

/*
 * Memory for `count` elements of `size` bytes, at least one byte, undefined or zero; memory NULL:
 * it counts nowhere. Each returns NULL after failing with RT_ERROR_MEMORY in the words of
 * rt_memory_take. Freed by rt_memory_free, which takes NULL.
 */
void *rt_memory_alloc(rt_memory *memory, size_t count, size_t size, const char *what,
                      rt_error *error);
void *rt_memory_zeroed(rt_memory *memory, size_t count, size_t size, const char *what,
                       rt_error *error);
void rt_memory_free(void *block);

/*
 * Changes the size of a block, which may be NULL, keeping its content; on failure it returns NULL
 * and the block stays as it was.
 */
void *rt_memory_resize(rt_memory *memory, void *block, size_t count, size_t size, const char *what,
                       rt_error *error);

/*
 * Room for an array that grows: of *room elements to at least `needed`, by half as much again
 * where that is to be had, else by less. *array and *room change on success alone.
 */
rt_status rt_memory_grow(rt_memory *memory, void **array, size_t *room, size_t needed, size_t size,
                         const char *what, rt_error *error);

/*
 * Takes the difference where something grows from so many bytes to more; on failure the message
 * tells all that it needs. Gives the difference back where it shrinks.
 */
rt_status rt_memory_retake(rt_memory *memory, uint64_t before, uint64_t after, const char *what,
                           rt_error *error);

/*
 * Fails as rt_memory_take would, but takes nothing: before work whose memory is taken bit by bit.
 */
rt_status rt_memory_foresee(rt_memory *memory, double bytes, const char *what, rt_error *error);

#endif
