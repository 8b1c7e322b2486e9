/* version.c - the version, as one string. */
#include "rt.h"

#define TEXT(x) #x
#define DOTTED(major, minor, patch) TEXT(major) "." TEXT(minor) "." TEXT(patch)

const char *rt_version(void)
{
    return DOTTED(RT_VERSION_MAJOR, RT_VERSION_MINOR, RT_VERSION_PATCH);
}
