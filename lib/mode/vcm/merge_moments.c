/* merge_moments.c - what merging over parts of the discs finds, and its moments. */
#include "mode/vcm/merge_moments.h"

#include <string.h>

/* One in so many iterations is measured, of each sequence of samples in turn. */
enum { STEP = 4 };

static const char what[] = "the moments of iterations";

rt_status rt_merge_moments_create(rt_merge_moments *m, rt_device *device, const rt_film *film,
                                  rt_error *error)
{
    *m = (rt_merge_moments){.device = device, .pixels = rt_film_pixels(film)};
    rt_status status =
        rt_device_kernel(device, &m->kernel, "photon_film", "add_merge_moments", NULL, error);
    if (status == RT_OK)
        status = rt_mirror_create(device, &m->sums, rt_film_moment_bytes(film), film->moments, what,
                                  error);
    return status == RT_OK ? rt_buffer_create(device, &m->parts, CL_MEM_READ_WRITE,
                                              m->pixels * 6 * sizeof(float), NULL, what, error)
                           : status;
}

void rt_merge_moments_release(rt_merge_moments *m)
{
    if (m->device) {
        rt_kernel_release(m->kernel);
        rt_buffer_release(m->device, m->parts);
        rt_buffer_release(m->device, m->sums);
    }
    memset(m, 0, sizeof *m);
}

int rt_merge_is_measured(uint32_t number)
{
    return number % STEP == number / RT_REPLICATES % STEP;
}

rt_status rt_merge_moments_add(rt_merge_moments *m, cl_mem pass, rt_error *error)
{
    rt_u32 pixels = (rt_u32)m->pixels;
    rt_arg args[] = {RT_ARG(pixels), RT_ARG(pass), RT_ARG(m->parts), RT_ARG(m->sums)};
    return rt_run(m->device, m->kernel, args, 4, m->pixels, error);
}
