#include "photon/photon_list.h"

#include <math.h>
#include <stdlib.h>

#include "accel/parallel.h"
#include "error.h"

rt_status rt_photon_list_reserve(rt_photon_list *list, size_t more, rt_error *error)
{
    static const size_t most = SIZE_MAX / 2 / sizeof(rt_photon);
    if (more > most - list->count)
        return rt_fail(error, RT_ERROR_MEMORY, "no memory for a map of so many photons");
    size_t needed = list->count + more, capacity = list->capacity + list->capacity / 2;
    if (needed <= list->capacity)
        return RT_OK;
    if (capacity < needed)
        capacity = needed;
    rt_photon *photons = realloc(list->photons, capacity * sizeof *photons);
    if (!photons)
        return rt_fail(error, RT_ERROR_MEMORY, "no memory for a map of %zu photons", needed);
    list->photons = photons;
    list->capacity = capacity;
    return RT_OK;
}

static int finite3(const float v[3])
{
    return isfinite(v[0]) && isfinite(v[1]) && isfinite(v[2]);
}

int rt_photon_is_finite(const rt_photon *p)
{
    return finite3(p->position) && finite3(p->wi) && finite3(p->flux) && isfinite(p->shading) &&
           finite3(p->normal);
}

/* Paths whose photons are appended in shares: first each is counted, then each is copied to its place. */
typedef struct appending {
    const rt_photon *slots;
    const rt_path_account *accounts;
    size_t path_count, slots_per_path;
    size_t *places;     /* [jobs + 1]: photons of a share, then where they begin */
    uint64_t *rejected; /* [jobs] */
    rt_photon *photons; /* of the list */
} appending;

enum { PATHS_A_JOB = 4096 };

static size_t share_end(const appending *a, uint32_t index)
{
    size_t end = ((size_t)index + 1) * PATHS_A_JOB;
    return end < a->path_count ? end : a->path_count;
}

static void count_share(void *user, uint32_t index)
{
    appending *a = user;
    size_t count = 0, all = 0;
    for (size_t i = (size_t)index * PATHS_A_JOB; i < share_end(a, index); i++) {
        all += a->accounts[i].photons;
        for (size_t j = 0; j < a->accounts[i].photons; j++)
            count += (size_t)rt_photon_is_finite(a->slots + i * a->slots_per_path + j);
    }
    a->places[index + 1] = count;
    a->rejected[index] = all - count;
}

static void copy_share(void *user, uint32_t index)
{
    const appending *a = user;
    rt_photon *out = a->photons + a->places[index];
    for (size_t i = (size_t)index * PATHS_A_JOB; i < share_end(a, index); i++)
        for (size_t j = 0; j < a->accounts[i].photons; j++) {
            const rt_photon *photon = a->slots + i * a->slots_per_path + j;
            if (rt_photon_is_finite(photon))
                *out++ = *photon;
        }
}

rt_status rt_photon_list_append(rt_photon_list *list, const rt_photon *slots, const rt_path_account *accounts,
                                size_t path_count, size_t slots_per_path, uint32_t threads, rt_error *error)
{
    size_t jobs = (path_count + PATHS_A_JOB - 1) / PATHS_A_JOB;
    appending a = {slots, accounts, path_count, slots_per_path, NULL, NULL, NULL};

    a.places = calloc(jobs + 1, sizeof *a.places);
    a.rejected = calloc(jobs + 1, sizeof *a.rejected);
    rt_status status = a.places && a.rejected ? RT_OK : rt_fail(error, RT_ERROR_MEMORY, "no memory to collect photons");
    if (status == RT_OK) {
        rt_parallel(threads, (uint32_t)jobs, count_share, &a);
        for (size_t i = 0; i < jobs; i++)
            a.places[i + 1] += a.places[i];
        status = rt_photon_list_reserve(list, a.places[jobs], error);
    }
    if (status == RT_OK && a.places[jobs] > 0) {
        a.photons = list->photons + list->count;
        rt_parallel(threads, (uint32_t)jobs, copy_share, &a);
    }
    if (status == RT_OK) {
        list->count += a.places[jobs];
        list->emitted += path_count;
        for (size_t i = 0; i < jobs; i++)
            list->rejected += a.rejected[i];
    }
    free(a.places);
    free(a.rejected);
    return status;
}

void rt_photon_list_reset(rt_photon_list *list)
{
    list->count = 0;
    list->emitted = list->rejected = 0;
}

void rt_photon_list_clear(rt_photon_list *list)
{
    free(list->photons);
    *list = (rt_photon_list){0};
}
