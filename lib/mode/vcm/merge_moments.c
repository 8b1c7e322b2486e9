/* merge_moments.c - the films of merging by parts of the discs, and their moments. */
#include "mode/vcm/merge_moments.h"

#include <string.h>

static const char what[] = "the moments of iterations";

rt_status rt_merge_moments_create(rt_merge_moments *m, rt_device *device, const rt_film *film,
                                  rt_error *error)
{
    *m = (rt_merge_moments){.device = device, .pixels = rt_film_pixels(film)};
    const size_t bytes = m->pixels * sizeof(rt_film_pixel);
    rt_status status =
        rt_device_kernel(device, &m->kernel, "photon_film", "add_merge_moments", NULL, error);
    if (status == RT_OK)
        status = rt_mirror_create(device, &m->sums, rt_film_moment_bytes(film), film->moments, what,
                                  error);
    if (status == RT_OK)
        status = rt_buffer_create(device, &m->half, CL_MEM_READ_WRITE, bytes, NULL, what, error);
    if (status == RT_OK)
        status = rt_buffer_create(device, &m->quarter, CL_MEM_READ_WRITE, bytes, NULL, what, error);
    return status;
}

void rt_merge_moments_release(rt_merge_moments *m)
{
    if (m->device) {
        rt_kernel_release(m->kernel);
        rt_buffer_release(m->device, m->half);
        rt_buffer_release(m->device, m->quarter);
        rt_buffer_release(m->device, m->sums);
    }
    memset(m, 0, sizeof *m);
}

rt_status rt_merge_moments_begin(rt_merge_moments *m, cl_mem pass, rt_error *error)
{
    const size_t bytes = m->pixels * sizeof(rt_film_pixel);
    rt_status status = rt_buffer_copy(m->device, pass, m->half, 0, bytes, error);
    return status == RT_OK ? rt_buffer_copy(m->device, pass, m->quarter, 0, bytes, error) : status;
}

rt_status rt_merge_moments_add(rt_merge_moments *m, cl_mem pass, rt_error *error)
{
    rt_u32 pixels = (rt_u32)m->pixels;
    rt_arg args[] = {RT_ARG(pixels), RT_ARG(pass), RT_ARG(m->half), RT_ARG(m->quarter),
                     RT_ARG(m->sums)};
    return rt_run(m->device, m->kernel, args, 5, m->pixels, error);
}
