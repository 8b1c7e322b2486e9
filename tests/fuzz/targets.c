/* targets.c - finds a target by its name. */
#include "fuzz/targets.h"

#include <string.h>

#define FUZZ_ROW(name) &fuzz_target_##name,
const fuzz_target *const fuzz_targets[] = {FUZZ_TARGETS(FUZZ_ROW) NULL};

const fuzz_target *fuzz_find(const char *name)
{
    const fuzz_target *const *target = fuzz_targets;
    while (*target && strcmp((*target)->name, name) != 0)
        target++;
    return *target;
}
