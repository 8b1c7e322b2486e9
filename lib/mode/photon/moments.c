/* moments.c - gathers once more from larger discs, and sums the squares of passes. */
#include "mode/photon/moments.h"

#include <string.h>

/* One in so many passes is measured, of each sequence of samples in turn. */
enum { STEP = 8 };

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
    for (int size = 0; size < RT_LARGER && status == RT_OK; size++) {
        status =
            rt_buffer_create(device, m->larger + size, CL_MEM_READ_WRITE, bytes, NULL, what, error);
        if (status == RT_OK)
            status = rt_buffer_clear(device, m->larger[size], bytes, error);
    }
    return status;
}

void rt_pass_moments_release(rt_pass_moments *m)
{
    if (m->device) {
        rt_buffer_release(m->device, m->points);
        rt_buffer_release(m->device, m->earlier);
        for (int size = 0; size < RT_LARGER; size++)
            rt_buffer_release(m->device, m->larger[size]);
        rt_buffer_release(m->device, m->sums);
    }
    memset(m, 0, sizeof *m);
}

int rt_pass_is_measured(uint32_t pass)
{
    return pass % STEP == pass / STEP % STEP;
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

/* By how much larger discs have more area. */
static const float areas[RT_LARGER] = {2, 4};

/* Makes a query at the copies of a row. */
static rt_status gather(rt_pass_moments *m, rt_gatherer *gatherer, size_t row, int size,
                        size_t count, rt_error *error)
{
    rt_gatherer_scale(gatherer, areas[size]);
    rt_status status = rt_gatherer_add(gatherer, row == 0 ? m->points : m->earlier,
                                       row == 0 ? 0 : (row - 1) * m->capacity, count, NULL, error);
    rt_gatherer_scale(gatherer, 1 / areas[size]);
    return status;
}

rt_status rt_pass_moments_gather(rt_pass_moments *m, const rt_queries *queries, int size,
                                 size_t count, rt_error *error)
{
    rt_status status = RT_OK;
    for (rt_query query = 0; query < RT_QUERIES; query++) {
        const size_t first = query == RT_QUERY_EARLIER, end = first ? 1 + m->rows : 1;
        for (size_t row = first; row < end && queries->gatherers[query] && status == RT_OK; row++)
            status = gather(m, queries->gatherers[query], row, size, count, error);
    }
    return status;
}

rt_status rt_pass_moments_add(rt_pass_moments *m, cl_mem pass, rt_error *error)
{
    rt_u32 pixels = (rt_u32)m->pixels;
    rt_arg args[] = {RT_ARG(pixels), RT_ARG(pass), RT_ARG(m->larger[0]), RT_ARG(m->larger[1]),
                     RT_ARG(m->sums)};
    return rt_run(m->device, m->kernel, args, 5, m->pixels, error);
}
