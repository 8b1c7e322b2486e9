/*
 * targets.c - the targets, and one by its name. A program of one target alone has FUZZ_ONLY defined
 * as its name.
 */
#include "fuzz/targets.h"

#include <string.h>

#define FUZZ_ROW(name) &fuzz_target_##name,
#ifdef FUZZ_ONLY
#define FUZZ_ONE(X, name) X(name) /* expands the name first */
const fuzz_target *const fuzz_targets[] = {FUZZ_ONE(FUZZ_ROW, FUZZ_ONLY) NULL};
#else
const fuzz_target *const fuzz_targets[] = {FUZZ_TARGETS(FUZZ_ROW) NULL};
#endif

const fuzz_target *fuzz_find(const char *name)
{
    const fuzz_target *const *target = fuzz_targets;
    while (*target && strcmp((*target)->name, name) != 0)
        target++;
    return *target;
}
