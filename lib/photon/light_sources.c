/*
 * light_sources.c - groups the entries of the light table by light, and shares out the photon
 * paths.
 */
#include "photon/light_sources.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

static const void *table(const rt_scene_header *scene, rt_u32 offset)
{
    return (const char *)scene + (size_t)offset * RT_SCENE_ROW;
}

/* Groups the entries of the light table by the shape that they are part of. */
static void group_lights(rt_light_sources *s, const rt_scene_header *scene)
{
    const rt_light_data *lights = table(scene, scene->lights);
    const rt_u32 *prim_shape = table(scene, scene->prim_shape);
    for (size_t i = 0; i < s->light_count; i++) {
        rt_u32 shape = lights[i].prim == RT_NONE ? RT_NONE : prim_shape[lights[i].prim];
        if (s->count == 0 || shape == RT_NONE || s->sources[s->count - 1].shape != shape)
            s->sources[s->count++] = (rt_light_source){.shape = shape, .first = (rt_u32)i};
        rt_light_source *source = s->sources + s->count - 1;
        for (int c = 0; c < 3; c++)
            source->power[c] += (double)lights[i].power * lights[i].hue[c];
        source->share += lights[i].power;
        source->count++;
        s->of_light[i] = (rt_u32)(s->count - 1);
    }
}

static rt_status check_shares(const rt_light_sources *s, const float *shares, size_t share_count,
                              rt_error *error)
{
    if (share_count != s->count)
        return rt_fail_field(error, RT_ERROR_USAGE, "light_shares",
                             "%zu shares for a scene of %zu light%s", share_count, s->count,
                             s->count == 1 ? "" : "s");
    for (size_t i = 0; i < share_count; i++) {
        if (!(shares[i] >= 0 && shares[i] <= 1e15f))
            return rt_fail_field(error, RT_ERROR_USAGE, "light_shares",
                                 "the share of light %zu is %g; it must be a number from 0 on", i,
                                 shares[i]);
        if (shares[i] == 0 && s->sources[i].share > 0)
            return rt_fail_field(
                error, RT_ERROR_USAGE, "light_shares",
                "the share of light %zu is 0, but it has power: its light would be missing", i);
    }
    return RT_OK;
}

/* Rounding must not leave a gap above the last light that can be chosen. */
static void close_gap(rt_light_sources *s)
{
    for (size_t i = s->light_count; i > 0; i--) {
        s->shares[i - 1].cdf = 1;
        if (s->shares[i - 1].pmf > 0)
            break;
    }
}

/* Gives each source its share, and that to its entries in proportion to their power. */
static void share_out(rt_light_sources *s, const rt_light_data *lights, const float *shares)
{
    double total = 0, sum = 0;
    for (size_t i = 0; i < s->count; i++)
        total += s->sources[i].share > 0 ? shares[i] : 0;
    for (size_t i = 0; i < s->light_count && total > 0; i++) {
        const rt_light_source *source = s->sources + s->of_light[i];
        double part = source->share > 0
                          ? lights[i].power / source->share * shares[s->of_light[i]] / total
                          : 0;
        sum += part;
        s->shares[i] = (rt_light_share){.pmf = (float)part, .cdf = (float)sum};
    }
    for (size_t i = 0; i < s->count; i++)
        s->sources[i].share = s->sources[i].share > 0 && total > 0 ? shares[i] / total : 0;
    if (total > 0)
        close_gap(s);
}

/* The distribution of the table of lights. */
static void share_by_power(rt_light_sources *s, const rt_light_data *lights)
{
    double total = 0;
    for (size_t i = 0; i < s->count; i++)
        s->sources[i].share = 0;
    for (size_t i = 0; i < s->light_count; i++) {
        s->shares[i] = (rt_light_share){.pmf = lights[i].pmf, .cdf = lights[i].cdf};
        s->sources[s->of_light[i]].share += lights[i].pmf;
        total += lights[i].pmf;
    }
    for (size_t i = 0; i < s->count && total > 0; i++)
        s->sources[i].share /= total;
}

/*
 * The radius within which light from infinitely far is followed to planes; 0 where there is no such
 * light or no plane. See emit_distant.
 */
static double reach(const rt_scene_header *scene)
{
    const rt_light_data *lights = table(scene, scene->lights);
    for (size_t i = 0; i < scene->light_count && scene->plane_count > 0; i++)
        if ((lights[i].kind == RT_LIGHT_DIRECTIONAL || lights[i].kind == RT_LIGHT_ENVIRONMENT) &&
            lights[i].power > 0)
            return scene->radius > 0 ? scene->radius : 1;
    return 0;
}

static rt_status fill(rt_light_sources *s, const rt_scene_header *scene, const float *shares,
                      size_t share_count, rt_error *error)
{
    static const char what[] = "the list of lights";
    size_t count = scene->light_count ? scene->light_count : 1;
    const rt_light_data *lights = table(scene, scene->lights);

    s->light_count = scene->light_count;
    s->reach = reach(scene);
    s->reach_from =
        scene->radius > 0 ? "middle of the other shapes" : "origin, for want of other shapes";
    s->sources = rt_memory_zeroed(s->memory, count, sizeof *s->sources, what, error);
    if (s->sources)
        s->of_light = rt_memory_zeroed(s->memory, count, sizeof *s->of_light, what, error);
    if (s->of_light)
        s->shares = rt_memory_zeroed(s->memory, count, sizeof *s->shares, what, error);
    if (!s->shares)
        return RT_ERROR_MEMORY;
    group_lights(s, scene);
    rt_status status = shares ? check_shares(s, shares, share_count, error) : RT_OK;
    if (status == RT_OK && shares)
        share_out(s, lights, shares);
    else if (status == RT_OK)
        share_by_power(s, lights);
    return status;
}

rt_status rt_light_sources_read(rt_light_sources *out, rt_device *device, cl_mem scene,
                                const float *shares, size_t share_count, rt_error *error)
{
    rt_light_sources s = {.memory = device->memory};
    const void *mapped = NULL;

    rt_status status = rt_buffer_map(device, scene, 0, &mapped, "the scene", error);
    if (status != RT_OK)
        return status;
    status = fill(&s, mapped, shares, share_count, error);
    rt_status unmapped = rt_buffer_unmap(device, scene, mapped, status == RT_OK ? error : NULL);
    if (status == RT_OK)
        status = unmapped;
    if (status == RT_OK)
        *out = s;
    else
        rt_light_sources_free(&s);
    return status;
}

void rt_light_sources_weigh(rt_light_sources *s, const double *factors)
{
    double sum = 0;
    for (size_t i = 0; i < s->light_count; i++) {
        const double part = (double)s->shares[i].pmf * factors[s->of_light[i]];
        sum += part;
        s->shares[i].pmf = (float)part;
        s->shares[i].cdf = (float)sum;
    }
    close_gap(s);
    for (size_t i = 0; i < s->count; i++)
        s->sources[i].share *= factors[i];
}

void rt_light_sources_free(rt_light_sources *s)
{
    rt_memory_free(s->sources);
    rt_memory_free(s->of_light);
    rt_memory_free(s->shares);
    memset(s, 0, sizeof *s);
}
