/* own_radii.c - searches for the radii of pixels, on finer and finer grids. */
#include "mode/vcm/own_radii.h"

#include <math.h>

#include "base/memory.h"

/* Grids that the search takes at most, each of half the radius of the one before. */
enum { MOST_GRIDS = 16 };

static const char what[] = "the radii of merging";

/* Sets the radii that are found within this one; *left: how many are not. */
static rt_status search(size_t *left, const rt_radii_search *of, float radius, float limit,
                        rt_error *error)
{
    rt_vertex_grid *grid = of->grid;
    rt_vcm_params vcm = {.radius = radius};
    rt_u32 count = of->pixels;
    rt_status status = rt_vertex_grid_sort(grid, of->scene, &vcm, error);
    rt_arg args[] = {RT_ARG(count),       RT_ARG(of->scene),    RT_ARG(vcm),
                     RT_ARG(grid->order), RT_ARG(grid->lights), RT_ARG(grid->begins),
                     RT_ARG(limit),       RT_ARG(of->queries)};
    if (status == RT_OK)
        status = rt_run(grid->device, of->radii, args, 8, count, error);
    if (status == RT_OK)
        status =
            rt_mirror_read(grid->device, of->queries, count * sizeof *of->found, of->found, error);
    *left = 0;
    for (size_t i = 0; i < count && status == RT_OK; i++)
        *left += of->found[i].is_query && of->found[i].squared_radius < 0;
    return status;
}

/* Sets all radii, up to this one; *least is that of a disc that still holds too many. */
static rt_status search_all(float *least, const rt_radii_search *of, double most, rt_error *error)
{
    rt_status status = RT_OK;
    float r = (float)most;
    size_t left = 1;
    *least = r * r;
    for (int i = 0; i < MOST_GRIDS && left > 0 && status == RT_OK; i++, r *= 0.5f) {
        status = search(&left, of, r, *least, error);
        *least = r * r;
    }
    return status;
}

/* The element of rank k; others change places. Hoare: "Algorithm 65: Find", CACM 4(7), 1961. */
static float select(float *values, size_t count, size_t k)
{
    size_t first = 0, last = count - 1;
    while (first < last) {
        const float pivot = values[k];
        size_t i = first, j = last;
        while (i <= j) {
            while (values[i] < pivot)
                i++;
            while (pivot < values[j])
                j--;
            if (i <= j) {
                const float swapped = values[i];
                values[i++] = values[j];
                values[j--] = swapped;
            }
        }
        if (j < k)
            first = i;
        if (k < i)
            last = j;
    }
    return values[k];
}

/* The squared radii into `squared`, 0 without a query; returns their median, found in `room`. */
static double median_of(float *squared, float *room, const rt_merge_query *found, size_t pixels,
                        float least, float most)
{
    size_t count = 0;
    for (size_t i = 0; i < pixels; i++) {
        const float r2 = found[i].squared_radius < 0 ? least : found[i].squared_radius;
        squared[i] = found[i].is_query ? r2 : 0;
        if (found[i].is_query)
            room[count++] = r2;
    }
    return (double)(count ? select(room, count, count / 2) : most);
}

/*
 * The least of a pixel and its eight neighbours: beside a bright spot discs that reach into it
 * would spread its light, and the spot would not lose it.
 */
static float least_of(const float *squared, uint32_t width, uint32_t height, uint32_t x, uint32_t y,
                      float most)
{
    float least = most;
    for (uint32_t v = y - (y > 0); v <= y + (y + 1 < height); v++)
        for (uint32_t u = x - (x > 0); u <= x + (x + 1 < width); u++) {
            const float near = squared[(size_t)v * width + u];
            least = near > 0 && near < least ? near : least;
        }
    return least;
}

static rt_status make_limits(cl_mem *own, double *radius, rt_device *device,
                             const rt_merge_query *found, uint32_t width, uint32_t height,
                             float least, float *room, rt_error *error)
{
    const size_t pixels = (size_t)width * height;
    float *squared = room, *limits = room + pixels;
    const float largest = (float)(*radius * *radius);
    const float most = (float)median_of(squared, limits, found, pixels, least, largest);
    int is_any = 0;
    if (most < largest)
        *radius = sqrt((double)most);
    for (uint32_t y = 0; y < height; y++)
        for (uint32_t x = 0; x < width; x++) {
            const float least_around = least_of(squared, width, height, x, y, most);
            limits[(size_t)y * width + x] = least_around;
            is_any |= least_around < most;
        }
    return is_any ? rt_buffer_create(device, own, CL_MEM_READ_ONLY, pixels * sizeof *limits, limits,
                                     what, error)
                  : RT_OK;
}

rt_status rt_own_radii_limit(double *radius, const rt_radii_search *of, rt_error *error)
{
    rt_vertex_grid *grid = of->grid;
    rt_vcm_params vcm = {.radius = (float)*radius};
    rt_u32 count = of->pixels, vertices = (rt_u32)grid->filled;
    float least,
        *room = rt_memory_alloc(grid->device->memory, count, 2 * sizeof *room, what, error);
    rt_status status = room ? rt_vertex_grid_sort(grid, of->scene, &vcm, error) : RT_ERROR_MEMORY;
    rt_arg args[] = {RT_ARG(count), RT_ARG(vertices), RT_ARG(grid->order), RT_ARG(grid->lights),
                     RT_ARG(of->queries)};
    if (status == RT_OK)
        status = rt_run(grid->device, of->ask_lights, args, 5, count, error);
    if (status == RT_OK)
        status = search_all(&least, of, *radius, error);
    if (status == RT_OK)
        *radius = fmin(*radius, sqrt(median_of(room, room + count, of->found, count, least,
                                               (float)(*radius * *radius))));
    rt_memory_free(room);
    return status;
}

rt_status rt_own_radii_find(cl_mem *own, double *radius, const rt_radii_search *of, uint32_t width,
                            rt_error *error)
{
    float least;
    float *room =
        rt_memory_alloc(of->grid->device->memory, of->pixels, 2 * sizeof *room, what, error);
    rt_status status = room ? search_all(&least, of, *radius, error) : RT_ERROR_MEMORY;
    if (status == RT_OK)
        status = make_limits(own, radius, of->grid->device, of->found, width, of->pixels / width,
                             least, room, error);
    rt_memory_free(room);
    return status;
}
