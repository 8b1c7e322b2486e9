/* large_pages.c - madvise, where there is one. */
#if defined(__linux__)
#define _DEFAULT_SOURCE
#include <sys/mman.h>
#include <unistd.h>
#endif

#include "base/large_pages.h"

#include <stdint.h>

#if defined(__linux__) && defined(MADV_HUGEPAGE)
/* Bytes from which on the waste, at most a large page at either end, is small. */
enum { LARGE = 16 << 20 };

void rt_prefer_large_pages(void *block, size_t bytes)
{
    const long page = sysconf(_SC_PAGESIZE);
    if (bytes < LARGE || page <= 0)
        return;
    const uintptr_t mask = (uintptr_t)page - 1, begin = ((uintptr_t)block + mask) & ~mask,
                    end = ((uintptr_t)block + bytes) & ~mask;
    /* A system without them says so, and nothing is lost. */
    (void)madvise((void *)begin, end - begin, MADV_HUGEPAGE);
}
#else
void rt_prefer_large_pages(void *block, size_t bytes)
{
    (void)block;
    (void)bytes;
}
#endif
