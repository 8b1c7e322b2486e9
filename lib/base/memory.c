/* memory.c - counts memory against a limit; blocks know what they count in. */
#include "base/memory.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/large_pages.h"

/* NAMED: no place, but a name says which owner it is */
enum { OWNERS_MAX = 64, NAMED = OWNERS_MAX };

struct rt_memory {
    pthread_mutex_t lock; /* of the following */
    rt_memory_info info;
    rt_memory_owner owners[OWNERS_MAX];
    uint32_t owner_count;
    uint32_t holders; /* objects that may still count in it */
    int is_abandoned; /* destroyed by its owner, and still in use */
};

/* Stands before each block, so that the block is aligned as malloc aligns. */
typedef union header {
    struct {
        rt_memory *memory; /* NULL: it counts nowhere */
        size_t bytes;
        uint32_t owner; /* its place among those of the memory */
    } of;
    long double alignment;
} header;

/* ---- The count --------------------------------------------------------------- */

rt_status rt_memory_create(rt_memory **out, uint64_t limit, rt_error *error)
{
    rt_memory *memory = calloc(1, sizeof *memory);
    if (!memory || pthread_mutex_init(&memory->lock, NULL) != 0) {
        free(memory);
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory for a count of memory");
    }
    memory->info.limit = limit;
    *out = memory;
    return RT_OK;
}

/* Unlocks it, and frees one that its owner has destroyed when nothing needs it any more. */
static void unlock(rt_memory *memory)
{
    const int is_over = memory->is_abandoned && memory->info.used == 0 && memory->holders == 0;
    pthread_mutex_unlock(&memory->lock);
    if (!is_over)
        return;
    pthread_mutex_destroy(&memory->lock);
    free(memory);
}

void rt_memory_destroy(rt_memory *memory)
{
    if (!memory)
        return;
    pthread_mutex_lock(&memory->lock);
    memory->is_abandoned = 1;
    unlock(memory);
}

rt_memory *rt_memory_hold(rt_memory *memory)
{
    if (!memory)
        return NULL;
    pthread_mutex_lock(&memory->lock);
    memory->holders++;
    pthread_mutex_unlock(&memory->lock);
    return memory;
}

void rt_memory_drop(rt_memory *memory)
{
    if (!memory)
        return;
    pthread_mutex_lock(&memory->lock);
    memory->holders--;
    unlock(memory);
}

void rt_memory_get_info(const rt_memory *memory, rt_memory_info *out)
{
    pthread_mutex_t *lock = (pthread_mutex_t *)&memory->lock;
    pthread_mutex_lock(lock);
    *out = memory->info;
    pthread_mutex_unlock(lock);
}

size_t rt_memory_get_owners(const rt_memory *memory, rt_memory_owner *out, size_t room)
{
    pthread_mutex_t *lock = (pthread_mutex_t *)&memory->lock;
    pthread_mutex_lock(lock);
    const size_t count = memory->owner_count;
    for (size_t i = 0; i < count && i < room; i++)
        out[i] = memory->owners[i];
    pthread_mutex_unlock(lock);
    return count;
}

/* The place of an owner; owner_count where none has that name and one has room, see add_owner. */
static uint32_t find_owner(const rt_memory *memory, const char *what)
{
    uint32_t i = 0;
    for (; i < memory->owner_count; i++)
        if (strncmp(memory->owners[i].what, what, sizeof memory->owners[i].what - 1) == 0)
            return i;
    return i == OWNERS_MAX ? i - 1 : i;
}

/* The same, of an owner that may be new; those that find no room are one. */
static uint32_t add_owner(rt_memory *memory, const char *what)
{
    const uint32_t i = find_owner(memory, what);
    if (i < memory->owner_count)
        return i;
    snprintf(memory->owners[i].what, sizeof memory->owners[i].what, "%s",
             i + 1 < OWNERS_MAX ? what : "others");
    return memory->owner_count++;
}

static uint64_t larger(uint64_t a, uint64_t b)
{
    return a > b ? a : b;
}

/* Counts what was found to have room. */
static void count_more(rt_memory *memory, uint32_t owner, uint64_t more)
{
    rt_memory_owner *o = memory->owners + owner;
    memory->info.used += more;
    o->used += more;
    o->most = larger(o->most, o->used);
    if (memory->info.used <= memory->info.most)
        return;
    memory->info.most = memory->info.used;
    for (uint32_t i = 0; i < memory->owner_count; i++)
        memory->owners[i].at_most = memory->owners[i].used;
}

/* "3.2 GiB", "512 bytes": a size in the unit that suits it. Returns out. */
static const char *write_size(char out[32], double bytes, int digits)
{
    static const char *const units[] = {"bytes", "KiB", "MiB", "GiB", "TiB", "PiB", "EiB"};
    size_t unit = 0;
    while (bytes >= 1023.5 && unit + 1 < sizeof units / sizeof *units) {
        bytes /= 1024;
        unit++;
    }
    if (unit == 0)
        snprintf(out, 32, "%.0f byte%s", bytes, bytes == 1 ? "" : "s");
    else
        snprintf(out, 32, "%.*g %s", digits, bytes, units[unit]);
    return out;
}

static rt_status fail_limit(const rt_memory_info *info, double bytes, const char *what,
                            rt_error *error)
{
    char needed[32], limit[32], used[32];
    write_size(needed, bytes, 3);
    write_size(limit, (double)info->limit, 3);
    if (strcmp(needed, limit) == 0) { /* rounded */
        write_size(needed, bytes, 6);
        write_size(limit, (double)info->limit, 6);
    }
    if (strcmp(needed, limit) == 0)
        snprintf(needed, sizeof needed, "%.0f bytes", bytes);
    if (info->limit == 0)
        return rt_fail(error, RT_ERROR_MEMORY, "%s needs %s, more than can be counted", what,
                       needed);
    if (info->used == 0)
        return rt_fail(error, RT_ERROR_MEMORY, "%s needs %s, more than the limit of %s", what,
                       needed, limit);
    return rt_fail(error, RT_ERROR_MEMORY, "%s needs %s, more than the limit of %s with %s in use",
                   what, needed, limit, write_size(used, (double)info->used, 3));
}

static rt_status fail_exhausted(double bytes, const char *what, rt_error *error)
{
    char needed[32];
    return rt_fail(error, RT_ERROR_MEMORY, "out of memory: %s needs %s", what,
                   write_size(needed, bytes, 3));
}

/* Whether so much more is within the limit; *info is how things stand. */
static int has_room(rt_memory *memory, double bytes, rt_memory_info *info)
{
    *info = memory->info;
    return info->limit == 0 || (double)info->used + bytes <= (double)info->limit;
}

rt_status rt_memory_take(rt_memory *memory, uint64_t bytes, const char *what, rt_error *error)
{
    if (rt_is_missing(what, "what", error))
        return RT_ERROR_USAGE;
    return rt_memory_retake(memory, 0, bytes, what, error);
}

/* For the owner at `place`, or that of the name `what` for NAMED; what stands in the message. */
static rt_status retake(rt_memory *memory, uint64_t before, uint64_t after, uint32_t place,
                        const char *what, rt_error *error)
{
    rt_memory_info info;
    const uint64_t more = after - before;
    if (!memory)
        return RT_OK;
    pthread_mutex_lock(&memory->lock);
    const int has = has_room(memory, (double)more, &info) && more <= UINT64_MAX - info.used;
    if (has && more > 0)
        count_more(memory, place == NAMED ? add_owner(memory, what) : place, more);
    pthread_mutex_unlock(&memory->lock);
    info.used -= before < info.used ? before : info.used;
    return has ? RT_OK : fail_limit(&info, (double)after, what, error);
}

rt_status rt_memory_retake(rt_memory *memory, uint64_t before, uint64_t after, const char *what,
                           rt_error *error)
{
    if (after >= before)
        return retake(memory, before, after, NAMED, what, error);
    rt_memory_give(memory, before - after, what);
    return RT_OK;
}

rt_status rt_memory_foresee(rt_memory *memory, double bytes, const char *what, rt_error *error)
{
    rt_memory_info info;
    if (!memory)
        return RT_OK;
    pthread_mutex_lock(&memory->lock);
    const int has = has_room(memory, bytes, &info);
    pthread_mutex_unlock(&memory->lock);
    return has ? RT_OK : fail_limit(&info, bytes, what, error);
}

/* Gives back what an owner took: that at `place`, or that of the name `what` for NAMED. */
static void give(rt_memory *memory, uint64_t bytes, uint32_t place, const char *what)
{
    if (!memory || bytes == 0 || (place == NAMED && !what))
        return;
    pthread_mutex_lock(&memory->lock);
    const uint32_t owner = place == NAMED ? find_owner(memory, what) : place;
    if (owner < memory->owner_count) {
        /* No more than that owner holds, so that what others hold stays counted. */
        uint64_t *const held = &memory->owners[owner].used;
        const uint64_t given = bytes < *held ? bytes : *held;
        memory->info.used -= given;
        *held -= given;
    }
    unlock(memory);
}

void rt_memory_give(rt_memory *memory, uint64_t bytes, const char *what)
{
    give(memory, bytes, NAMED, what);
}

/* ---- Blocks ------------------------------------------------------------------ */

/* The bytes of a block with its header; 0 when there cannot be so many. */
static size_t bytes_of(size_t count, size_t size)
{
    static const size_t most = SIZE_MAX / 2 - sizeof(header);
    if (size > 0 && count > most / size)
        return 0;
    const size_t bytes = count * size;
    return sizeof(header) + (bytes > 0 ? bytes : 1);
}

static uint32_t owner_of(rt_memory *memory, const char *what)
{
    if (!memory)
        return 0;
    pthread_mutex_lock(&memory->lock);
    const uint32_t owner = add_owner(memory, what);
    pthread_mutex_unlock(&memory->lock);
    return owner;
}

static void *allocate(rt_memory *memory, size_t count, size_t size, int is_zero, const char *what,
                      rt_error *error)
{
    const size_t bytes = bytes_of(count, size);
    const double wanted = (double)count * (double)size;
    if (rt_memory_foresee(memory, wanted, what, error) != RT_OK)
        return NULL;
    if (bytes == 0) {
        fail_exhausted(wanted, what, error);
        return NULL;
    }
    if (rt_memory_take(memory, bytes, what, error) != RT_OK)
        return NULL;
    header *block = is_zero ? calloc(1, bytes) : malloc(bytes);
    if (!block) {
        rt_memory_give(memory, bytes, what);
        fail_exhausted(wanted, what, error);
        return NULL;
    }
    rt_prefer_large_pages(block, bytes);
    block->of.memory = memory;
    block->of.bytes = bytes;
    block->of.owner = owner_of(memory, what);
    return block + 1;
}

void *rt_memory_alloc(rt_memory *memory, size_t count, size_t size, const char *what,
                      rt_error *error)
{
    return allocate(memory, count, size, 0, what, error);
}

void *rt_memory_zeroed(rt_memory *memory, size_t count, size_t size, const char *what,
                       rt_error *error)
{
    return allocate(memory, count, size, 1, what, error);
}

void rt_memory_free(void *block)
{
    if (!block)
        return;
    header *head = (header *)block - 1;
    rt_memory *memory = head->of.memory;
    const size_t bytes = head->of.bytes;
    const uint32_t owner = head->of.owner;
    free(head);
    give(memory, bytes, owner, NULL);
}

void *rt_memory_resize(rt_memory *memory, void *block, size_t count, size_t size, const char *what,
                       rt_error *error)
{
    if (!block)
        return allocate(memory, count, size, 0, what, error);
    header *head = (header *)block - 1;
    const size_t bytes = bytes_of(count, size), before = head->of.bytes;
    const double wanted = (double)count * (double)size;
    memory = head->of.memory;
    if (bytes == 0) {
        fail_exhausted(wanted, what, error);
        return NULL;
    }
    const uint32_t owner = head->of.owner;
    if (bytes > before && retake(memory, before, bytes, owner, what, error) != RT_OK)
        return NULL;
    head = realloc(head, bytes);
    if (!head) {
        if (bytes > before)
            give(memory, bytes - before, owner, NULL);
        fail_exhausted(wanted, what, error);
        return NULL;
    }
    if (bytes < before)
        give(memory, before - bytes, owner, NULL);
    else
        rt_prefer_large_pages(head, bytes);
    head->of.bytes = bytes;
    return head + 1;
}

rt_status rt_memory_grow(rt_memory *memory, void **array, size_t *room, size_t needed, size_t size,
                         const char *what, rt_error *error)
{
    if (needed <= *room)
        return RT_OK;
    size_t more = *room / 2 > 16 ? *room / 2 : 16;
    for (;; more /= 8) {
        const size_t roomy = *room + more > needed ? *room + more : needed;
        void *grown = rt_memory_resize(memory, *array, roomy, size, what, error);
        if (grown) {
            *array = grown;
            *room = roomy;
            return RT_OK;
        }
        if (roomy == needed)
            return RT_ERROR_MEMORY;
    }
}
