/* forecast.c - compares the photons still to come with the memory of this machine. */
#include "photon/forecast.h"

#include <unistd.h>

#include "base/error.h"

uint64_t rt_physical_memory(void)
{
#ifdef _SC_PHYS_PAGES
    long pages = sysconf(_SC_PHYS_PAGES), size = sysconf(_SC_PAGESIZE);
    return pages > 0 && size > 0 ? (uint64_t)pages * (uint64_t)size : 0;
#else
    return 0;
#endif
}

rt_status rt_photon_forecast(uint64_t others, uint64_t photons, uint64_t done, uint64_t paths,
                             uint64_t memory, rt_error *error)
{
    if (memory == 0 || done < RT_FORECAST_PATHS)
        return RT_OK;
    double expected = (double)others + (double)photons / (double)done * (double)paths;
    double bytes = expected * sizeof(rt_photon);
    if (bytes <= (double)memory)
        return RT_OK;
    return rt_fail(error, RT_ERROR_MEMORY,
                   "%llu photon paths would leave about %.3g photons, which take %.3g GB; this "
                   "machine has %.3g GB of memory: emit fewer at once",
                   (unsigned long long)paths, expected, 1e-9 * bytes, 1e-9 * (double)memory);
}
