/* trace.c - rt_trace: rays in, hits out. */
#include <math.h>

#include "base/error.h"
#include "render/renderer.h"

enum { rays_per_batch = 1 << 22 };

/*
 * Within these limits the squares of lengths, and distances along the ray, do not overflow float32.
 */
static const double length_min = 1e-15, length_max = 1e15, coordinate_max = 1e15;

static rt_status check_ray(const rt_ray *ray, size_t index, rt_error *error)
{
    const float *o = ray->origin, *d = ray->direction;
    int finite = isfinite(o[0]) && isfinite(o[1]) && isfinite(o[2]) && isfinite(d[0]) &&
                 isfinite(d[1]) && isfinite(d[2]) && isfinite(ray->t_min);
    if (!finite)
        return rt_fail_field(error, RT_ERROR_USAGE, "rays", "ray %zu is not finite", index);
    if (d[0] == 0 && d[1] == 0 && d[2] == 0)
        return rt_fail_field(error, RT_ERROR_USAGE, "rays", "ray %zu has no direction", index);
    double length = sqrt((double)d[0] * d[0] + (double)d[1] * d[1] + (double)d[2] * d[2]);
    if (!(length >= length_min && length <= length_max))
        return rt_fail_field(error, RT_ERROR_USAGE, "rays",
                             "ray %zu has a direction of length %g; it must lie between %g and %g",
                             index, length, length_min, length_max);
    for (int i = 0; i < 3; i++)
        if (!(fabs(o[i]) <= coordinate_max))
            return rt_fail_field(
                error, RT_ERROR_USAGE, "rays",
                "ray %zu has the coordinate %g in its origin; it must lie within %g", index, o[i],
                coordinate_max);
    if (!(ray->t_min <= ray->t_max))
        return rt_fail_field(error, RT_ERROR_USAGE, "rays", "ray %zu has t_min %g above t_max %g",
                             index, ray->t_min, ray->t_max);
    return RT_OK;
}

size_t rt_trace_items(const rt_device *device, rt_trace_kind kind, size_t count)
{
    const size_t each = kind == RT_TRACE_CLOSEST && device->width > 1 ? RT_TRACE_RAYS : 1;
    return (count + each - 1) / each;
}

/* One batch through buffers of its own size. */
static rt_status trace_batch(rt_renderer *renderer, cl_kernel kernel, rt_trace_kind kind,
                             const rt_ray *rays, size_t count, rt_hit *hits, rt_error *error)
{
    rt_device *device = renderer->device;
    cl_mem in = NULL, out = NULL;
    rt_u32 number = (rt_u32)count;

    rt_status status = rt_buffer_create(device, &in, CL_MEM_READ_ONLY, count * sizeof *rays,
                                        (void *)rays, "the buffer of rays", error);
    if (status == RT_OK)
        status = rt_buffer_create(device, &out, CL_MEM_WRITE_ONLY, count * sizeof *hits, NULL,
                                  "the buffer of hits", error);
    if (status == RT_OK) {
        rt_arg args[] = {RT_ARG(renderer->scene), RT_ARG(in), RT_ARG(number), RT_ARG(out)};
        status = rt_kernel_args(kernel, args, 4, error);
    }
    if (status == RT_OK)
        status = rt_launch(device, kernel, rt_trace_items(device, kind, count), error);
    if (status == RT_OK)
        status = rt_buffer_read(device, out, 0, count * sizeof *hits, hits, error);
    rt_buffer_release(device, in);
    rt_buffer_release(device, out);
    return status;
}

rt_status rt_trace(rt_renderer *renderer, rt_trace_kind kind, const rt_ray *rays, size_t count,
                   rt_hit *hits, rt_error *error)
{
    if (rt_is_missing(renderer, "renderer", error))
        return RT_ERROR_USAGE;
    cl_kernel kernel = NULL;
    rt_status status = RT_OK;

    if ((unsigned)kind > RT_TRACE_ANY)
        return rt_fail_field(error, RT_ERROR_USAGE, "kind", "there is no kind of trace %d",
                             (int)kind);
    for (size_t i = 0; i < count && status == RT_OK; i++)
        status = check_ray(rays + i, i, error);
    if (status == RT_OK)
        status =
            rt_device_kernel(renderer->device, &kernel, RT_PROGRAM_OF(renderer, "trace"),
                             kind == RT_TRACE_ANY ? "trace_any" : "trace_closest", NULL, error);
    for (size_t first = 0; first < count && status == RT_OK; first += rays_per_batch) {
        size_t part = count - first < rays_per_batch ? count - first : rays_per_batch;
        status = trace_batch(renderer, kernel, kind, rays + first, part, hits + first, error);
    }
    rt_kernel_release(kernel);
    return status;
}
