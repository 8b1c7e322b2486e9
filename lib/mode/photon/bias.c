/* bias.c - the bias of photon estimates by a second, finer gather. */
#include "mode/photon/bias.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"

/* The smallest k: the hull needs four photons and the k-th to estimate any density. */
enum { k_min = 2, k_min_hull = 5 };

int rt_photon_bias_finer(rt_gather_options *out, double *factor, const rt_gather_options *options)
{
    uint32_t k = (options->k + 1) / 2, k_least = options->area == RT_AREA_HULL ? k_min_hull : k_min;
    double part = options->k == 0 ? 0.5 : (double)k / options->k;
    if (options->k > 0 && k < k_least)
        return 0;
    *out = *options;
    out->k = k;
    out->max_radius = (float)(options->max_radius * sqrt(part));
    *factor = 1 / (1 - part);
    return 1;
}

rt_status rt_photon_bias_create(rt_photon_bias *b, rt_device *device, size_t capacity, size_t rows,
                                rt_error *error)
{
    static const char what[] = "the estimate of the bias";
    b->device = device;
    b->capacity = capacity;
    b->rows = rows;
    b->host = rt_memory_alloc(device->memory, capacity, sizeof *b->host, what, error);
    if (b->host)
        b->sums = rt_memory_alloc(device->memory, capacity, sizeof *b->sums, what, error);
    if (!b->sums)
        return RT_ERROR_MEMORY;
    return rt_buffer_create(device, &b->copies, CL_MEM_READ_WRITE,
                            (1 + rows) * capacity * sizeof *b->host, NULL,
                            "the copy of the gather points", error);
}

void rt_photon_bias_release(rt_photon_bias *b)
{
    rt_buffer_release(b->device, b->copies);
    rt_memory_free(b->host);
    rt_memory_free(b->sums);
    memset(b, 0, sizeof *b);
}

rt_status rt_photon_bias_begin(rt_photon_bias *b, cl_mem points, cl_mem earlier, size_t count,
                               rt_error *error)
{
    size_t row = b->capacity * sizeof *b->host;
    memset(b->sums, 0, b->capacity * sizeof *b->sums);
    rt_status status =
        rt_buffer_copy(b->device, points, b->copies, 0, count * sizeof *b->host, error);
    return status == RT_OK
               ? rt_buffer_copy(b->device, earlier, b->copies, row, b->rows * row, error)
               : status;
}

/* Adds a factor times the mean of the channels of points. */
static rt_status add_means(const rt_photon_bias *b, cl_mem points, size_t first, size_t count,
                           double factor, rt_error *error)
{
    size_t size = sizeof *b->host;
    rt_status status =
        rt_buffer_read(b->device, points, first * size, count * size, b->host, error);
    for (size_t i = 0; i < count && status == RT_OK; i++) {
        const float *rgb = b->host[i].radiance;
        b->sums[i] += factor * ((double)rgb[0] + rgb[1] + rgb[2]) / 3;
    }
    return status;
}

rt_status rt_photon_bias_add(rt_photon_bias *b, rt_gatherer *gatherer, const rt_finer *finer,
                             cl_mem points, size_t first, size_t row, size_t count,
                             rt_gather_disc *discs, rt_error *error)
{
    size_t copy = row * b->capacity;
    if (!finer->gatherer)
        return rt_gatherer_add(gatherer, points, first, count, discs, error);
    /* What a query adds is the radiance after it less that before, at points and copies. */
    rt_status status = add_means(b, points, first, count, -finer->factor, error);
    if (status == RT_OK)
        status = add_means(b, b->copies, copy, count, finer->factor, error);
    if (status == RT_OK)
        status = rt_gatherer_add(gatherer, points, first, count, discs, error);
    if (status == RT_OK)
        status = rt_gatherer_add(finer->gatherer, b->copies, copy, count, NULL, error);
    if (status == RT_OK)
        status = add_means(b, points, first, count, finer->factor, error);
    return status == RT_OK ? add_means(b, b->copies, copy, count, -finer->factor, error) : status;
}
