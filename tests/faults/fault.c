/* fault.c - wraps calls, by the linker's --wrap, and makes them fail. */
#define _GNU_SOURCE 1 /* __rlimit_resource_t */

#include "faults/fault.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <time.h>
#include <unistd.h>

#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>

/* Driver threads do not come here, but threads of the library do. */
static long count, target, live;
static int is_armed, lasts, kills, sync_code = EIO;
static const char *fired;
static FILE *failed_stream;

void fault_arm(long n, int for_good)
{
    target = n;
    lasts = for_good;
    kills = 0;
    fired = NULL;
    failed_stream = NULL;
    __atomic_store_n(&count, 0, __ATOMIC_SEQ_CST);
    __atomic_store_n(&is_armed, 1, __ATOMIC_SEQ_CST);
}

void fault_kill_at(long n)
{
    fault_arm(n, 0);
    kills = 1;
}

void fault_fail_sync_with(int code)
{
    sync_code = code;
}

long fault_disarm(void)
{
    __atomic_store_n(&is_armed, 0, __ATOMIC_SEQ_CST);
    return __atomic_load_n(&count, __ATOMIC_SEQ_CST);
}

const char *fault_fired(void)
{
    return fired;
}

long fault_live(void)
{
    return __atomic_load_n(&live, __ATOMIC_SEQ_CST);
}

static int fires(const char *name)
{
    if (!__atomic_load_n(&is_armed, __ATOMIC_SEQ_CST))
        return 0;
    long n = __atomic_add_fetch(&count, 1, __ATOMIC_SEQ_CST);
    if (target == 0 || (lasts ? n < target : n != target))
        return 0;
    if (kills)
        raise(SIGKILL);
    if (n == target)
        fired = name;
    return 1;
}

/* ---- What failures return -------------------------------------------------------------------- */

static int failed(int code)
{
    errno = code;
    return -1;
}

static void *no_memory(void)
{
    errno = ENOMEM;
    return NULL;
}

/* ---- The wrappers ---------------------------------------------------------------------------- */

#define FAULT(type, name, parameters, arguments, failure)                                          \
    type __real_##name parameters;                                                                 \
    type __wrap_##name parameters;                                                                 \
    type __wrap_##name parameters                                                                  \
    {                                                                                              \
        return fires(#name) ? (failure) : __real_##name arguments;                                 \
    }
#include "faults/calls.inc.h"
#undef FAULT

int __real_ferror(FILE *file);
int __wrap_ferror(FILE *file);
int __wrap_ferror(FILE *file)
{
    return file == failed_stream || __real_ferror(file);
}

int __real_open(const char *path, int how, ...);
int __wrap_open(const char *path, int how, ...);
int __wrap_open(const char *path, int how, ...)
{
    va_list more;
    va_start(more, how);
    mode_t mode = how & O_CREAT ? va_arg(more, mode_t) : 0;
    va_end(more);
    return fires("open") ? failed(EMFILE) : __real_open(path, how, mode);
}

/* With as many arguments as there may be. */
int __real_prctl(int what, ...);
int __wrap_prctl(int what, ...);
int __wrap_prctl(int what, ...)
{
    unsigned long given[4];
    va_list more;
    va_start(more, what);
    for (int i = 0; i < 4; i++)
        given[i] = va_arg(more, unsigned long);
    va_end(more);
    return fires("prctl") ? failed(EPERM)
                          : __real_prctl(what, given[0], given[1], given[2], given[3]);
}

long __real_syscall(long number, ...);
long __wrap_syscall(long number, ...);
long __wrap_syscall(long number, ...)
{
    long given[4];
    va_list more;
    va_start(more, number);
    for (int i = 0; i < 4; i++)
        given[i] = va_arg(more, long);
    va_end(more);
    return fires("syscall") ? failed(EPERM)
                            : __real_syscall(number, given[0], given[1], given[2], given[3]);
}

/* ---- Memory ---------------------------------------------------------------------------------- */

static void *counted(void *block)
{
    if (block)
        __atomic_add_fetch(&live, 1, __ATOMIC_SEQ_CST);
    return block;
}

void *__real_malloc(size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_malloc(size_t size)
{
    return fires("malloc") ? no_memory() : counted(__real_malloc(size));
}

void *__real_calloc(size_t n, size_t size);
void *__wrap_calloc(size_t n, size_t size);
void *__wrap_calloc(size_t n, size_t size)
{
    return fires("calloc") ? no_memory() : counted(__real_calloc(n, size));
}

void *__real_realloc(void *old, size_t size);
void *__wrap_realloc(void *old, size_t size);
void *__wrap_realloc(void *old, size_t size)
{
    if (fires("realloc"))
        return no_memory();
    return old ? __real_realloc(old, size) : counted(__real_realloc(old, size));
}

int __real_posix_memalign(void **out, size_t alignment, size_t size);
int __wrap_posix_memalign(void **out, size_t alignment, size_t size);
int __wrap_posix_memalign(void **out, size_t alignment, size_t size)
{
    if (fires("posix_memalign"))
        return ENOMEM;
    int code = __real_posix_memalign(out, alignment, size);
    if (code == 0)
        counted(*out);
    return code;
}

char *__real_realpath(const char *path, char *out);
char *__wrap_realpath(const char *path, char *out);
char *__wrap_realpath(const char *path, char *out)
{
    if (fires("realpath"))
        return no_memory();
    char *found = __real_realpath(path, out);
    return out ? found : counted(found);
}

void __real_free(void *block);
void __wrap_free(void *block);
void __wrap_free(void *block)
{
    if (block)
        __atomic_sub_fetch(&live, 1, __ATOMIC_SEQ_CST);
    __real_free(block);
}

/* ---- Time ------------------------------------------------------------------------------------ */

static long shift; /* seconds by which the clocks are ahead */

void fault_shift_clocks(long seconds)
{
    __atomic_store_n(&shift, seconds, __ATOMIC_SEQ_CST);
}

int __real_clock_gettime(clockid_t clock, struct timespec *out);
int __wrap_clock_gettime(clockid_t clock, struct timespec *out);
int __wrap_clock_gettime(clockid_t clock, struct timespec *out)
{
    int code = __real_clock_gettime(clock, out);
    out->tv_sec += __atomic_load_n(&shift, __ATOMIC_SEQ_CST);
    return code;
}

int __real_pthread_cond_timedwait(pthread_cond_t *condition, pthread_mutex_t *mutex,
                                  const struct timespec *until);
int __wrap_pthread_cond_timedwait(pthread_cond_t *condition, pthread_mutex_t *mutex,
                                  const struct timespec *until);
int __wrap_pthread_cond_timedwait(pthread_cond_t *condition, pthread_mutex_t *mutex,
                                  const struct timespec *until)
{
    struct timespec real = *until;
    real.tv_sec -= __atomic_load_n(&shift, __ATOMIC_SEQ_CST);
    return __real_pthread_cond_timedwait(condition, mutex, &real);
}
