/* moments.c - gathers once more from twice the area, and sums the squares of passes. */
#include "mode/photon/moments.h"

#include <string.h>

/* One in so many passes is measured. */
enum { STEP = 4 };

static const char what[] = "the moments of passes";

rt_status rt_pass_moments_create(rt_pass_moments *m, rt_device *device, cl_kernel kernel,
                                 const rt_film *film, size_t capacity, size_t rows, rt_error *error)
{
    const size_t points = capacity * sizeof(rt_gather_point);
    *m = (rt_pass_moments){.device = device,
                           .kernel = kernel,
                           .capacity = capacity,
                           .rows = rows,
                           .pixels = rt_film_pixels(film)};
    const size_t bytes = m->pixels * sizeof(rt_film_pixel);
    rt_status status =
        rt_mirror_create(device, &m->sums, rt_film_moment_bytes(film), film->moments, what, error);
    if (status == RT_OK)
        status = rt_buffer_create(device, &m->points, CL_MEM_READ_WRITE, points, NULL, what, error);
    if (status == RT_OK)
        status = rt_buffer_create(device, &m->earlier, CL_MEM_READ_WRITE, rows * points, NULL, what,
                                  error);
    if (status == RT_OK)
        status = rt_buffer_create(device, &m->wider, CL_MEM_READ_WRITE, bytes, NULL, what, error);
    return status == RT_OK ? rt_buffer_clear(device, m->wider, bytes, error) : status;
}

void rt_pass_moments_release(rt_pass_moments *m)
{
    if (m->device) {
        rt_buffer_release(m->device, m->points);
        rt_buffer_release(m->device, m->earlier);
        rt_buffer_release(m->device, m->wider);
        rt_buffer_release(m->device, m->sums);
    }
    memset(m, 0, sizeof *m);
}

int rt_pass_is_measured(uint32_t pass)
{
    return pass % STEP == 0;
}

rt_status rt_pass_moments_copy(rt_pass_moments *m, cl_mem points, cl_mem earlier, size_t count,
                               rt_error *error)
{
    const size_t size = sizeof(rt_gather_point);
    rt_status status = rt_buffer_copy(m->device, points, m->points, 0, count * size, error);
    return status == RT_OK && m->rows > 0 ? rt_buffer_copy(m->device, earlier, m->earlier, 0,
                                                           m->rows * m->capacity * size, error)
                                          : status;
}

/* Makes a query at the copies of a row. */
static rt_status gather(rt_pass_moments *m, rt_gatherer *gatherer, size_t row, size_t count,
                        rt_error *error)
{
    const float twice = 2;
    rt_gatherer_scale(gatherer, twice);
    rt_status status = rt_gatherer_add(gatherer, row == 0 ? m->points : m->earlier,
                                       row == 0 ? 0 : (row - 1) * m->capacity, count, NULL, error);
    rt_gatherer_scale(gatherer, 1 / twice);
    return status;
}

rt_status rt_pass_moments_gather(rt_pass_moments *m, const rt_queries *queries, size_t count,
                                 rt_error *error)
{
    rt_status status = RT_OK;
    for (rt_query query = 0; query < RT_QUERIES; query++) {
        const size_t first = query == RT_QUERY_EARLIER, end = first ? 1 + m->rows : 1;
        for (size_t row = first; row < end && queries->gatherers[query] && status == RT_OK; row++)
            status = gather(m, queries->gatherers[query], row, count, error);
    }
    return status;
}

rt_status rt_pass_moments_add(rt_pass_moments *m, cl_mem pass, rt_error *error)
{
    rt_u32 pixels = (rt_u32)m->pixels, is_measured = m->is_measured != 0;
    rt_arg args[] = {RT_ARG(pixels), RT_ARG(is_measured), RT_ARG(pass), RT_ARG(m->wider),
                     RT_ARG(m->sums)};
    return rt_run(m->device, m->kernel, args, 5, m->pixels, error);
}
