/* photon_list.c - appends the photons of many paths, in the order of the paths. */
#include "photon/photon_list.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "base/parallel.h"

static const char what[] = "the photon map";

/* Bytes from the capacity of a list to another. */
static double bytes_between(const rt_photon_list *list, size_t capacity)
{
    return (double)(capacity - list->capacity) * sizeof *list->photons;
}

rt_status rt_photon_list_reserve(rt_photon_list *list, size_t more, rt_error *error)
{
    static const size_t most = SIZE_MAX / 2 / sizeof(rt_photon);
    if (more > most - list->count)
        return rt_fail(error, RT_ERROR_MEMORY, "no memory for a map of so many photons");
    size_t needed = list->count + more, capacity = list->capacity + list->capacity / 2;
    if (needed <= list->capacity)
        return RT_OK;
    if (capacity < needed ||
        rt_memory_foresee(list->memory, bytes_between(list, capacity), what, NULL) != RT_OK)
        capacity = needed;
    const uint64_t bytes = (uint64_t)(capacity - list->capacity) * sizeof *list->photons;
    const uint64_t before = list->capacity * sizeof *list->photons;
    rt_status status = rt_memory_retake(list->memory, before, before + bytes, what, error);
    if (status != RT_OK)
        return status;
    rt_photon *photons = realloc(list->photons, capacity * sizeof *photons);
    if (!photons) {
        rt_memory_give(list->memory, bytes, what);
        return rt_fail(error, RT_ERROR_MEMORY, "no memory for a map of %zu photons", needed);
    }
    list->photons = photons;
    list->capacity = capacity;
    return RT_OK;
}

/* Makes a buffer for so many photons and copies those of the list into it. */
static rt_status move_to_buffer(rt_photon_list *list, rt_device *device, size_t capacity,
                                rt_error *error)
{
    cl_mem buffer = NULL;
    rt_status status = rt_buffer_create(device, &buffer, CL_MEM_READ_WRITE,
                                        capacity * sizeof(rt_photon), NULL, what, error);
    if (status == RT_OK)
        status =
            rt_buffer_copy(device, list->buffer, buffer, 0, list->count * sizeof(rt_photon), error);
    if (status != RT_OK) {
        rt_buffer_release(device, buffer);
        return status;
    }
    rt_buffer_release(device, list->buffer);
    list->buffer = buffer;
    list->device = device;
    list->capacity = capacity;
    return RT_OK;
}

rt_status rt_photon_list_reserve_on(rt_photon_list *list, rt_device *device, size_t more,
                                    rt_error *error)
{
    /* Kernels take the place of a photon as 32 bits. */
    if (more > UINT32_MAX - list->count)
        return rt_fail(error, RT_ERROR_MEMORY, "no memory for a map of so many photons");
    const size_t needed = list->count + more;
    if (list->buffer && needed <= list->capacity)
        return RT_OK;
    rt_status status = move_to_buffer(list, device, needed + needed / 4, error);
    return status == RT_ERROR_MEMORY ? move_to_buffer(list, device, needed, error) : status;
}

rt_status rt_photon_list_read(rt_photon_list *out, const rt_photon_list *list, rt_error *error)
{
    rt_status status = rt_photon_list_reserve(out, list->count, error);
    if (status == RT_OK)
        status = rt_buffer_read(list->device, list->buffer, 0, list->count * sizeof(rt_photon),
                                out->photons, error);
    if (status == RT_OK) {
        out->count = list->count;
        out->emitted = list->emitted;
        out->rejected = list->rejected;
    }
    return status;
}

rt_status rt_photon_list_fetch(rt_photon_list *list, rt_error *error)
{
    rt_photon_list host = {.memory = list->memory};
    rt_status status = rt_photon_list_read(&host, list, error);
    rt_photon_list_clear(status == RT_OK ? list : &host);
    if (status == RT_OK)
        *list = host;
    return status;
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

int rt_is_unit(const float v[3])
{
    float square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    return square > 0.99f && square < 1.01f;
}

/* Paths whose photons are copied in shares, each to its place. */
typedef struct appending {
    const rt_photon *slots;
    size_t row; /* of slots */
    const rt_path_account *accounts;
    size_t path_count;
    size_t *places; /* [jobs + 1]: where the photons of a share begin */
    rt_photon *photons;
} appending;

enum { PATHS_A_JOB = 4096 };

static size_t share_end(const appending *a, size_t index)
{
    size_t end = (index + 1) * PATHS_A_JOB;
    return end < a->path_count ? end : a->path_count;
}

/* Finds the places; returns how many photons were left out. */
static uint64_t find_places(appending *a, size_t jobs)
{
    uint64_t rejected = 0;
    for (size_t job = 0; job < jobs; job++) {
        a->places[job + 1] = a->places[job];
        for (size_t i = job * PATHS_A_JOB; i < share_end(a, job); i++) {
            a->places[job + 1] += a->accounts[i].photons;
            rejected += a->accounts[i].rejected;
        }
    }
    return rejected;
}

static void copy_share(void *user, uint32_t index)
{
    const appending *a = user;
    rt_photon *out = a->photons + a->places[index];
    for (size_t i = (size_t)index * PATHS_A_JOB; i < share_end(a, index); i++)
        for (size_t j = 0; j < a->accounts[i].photons; j++)
            *out++ = a->slots[j * a->row + i];
}

rt_status rt_photon_list_append(rt_photon_list *list, const rt_photon *slots, size_t row,
                                const rt_path_account *accounts, size_t path_count,
                                uint32_t threads, rt_error *error)
{
    size_t jobs = (path_count + PATHS_A_JOB - 1) / PATHS_A_JOB;
    appending a = {slots, row, accounts, path_count, calloc(jobs + 1, sizeof *a.places), NULL};

    if (!a.places)
        return rt_fail(error, RT_ERROR_MEMORY, "no memory to collect photons");
    uint64_t rejected = find_places(&a, jobs);
    rt_status status = rt_photon_list_reserve(list, a.places[jobs], error);
    if (status == RT_OK && a.places[jobs] > 0) {
        a.photons = list->photons + list->count;
        rt_parallel(threads, (uint32_t)jobs, copy_share, &a);
    }
    if (status == RT_OK) {
        list->count += a.places[jobs];
        list->emitted += path_count;
        list->rejected += rejected;
    }
    free(a.places);
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
    if (list->buffer)
        rt_buffer_release(list->device, list->buffer);
    else
        rt_memory_give(list->memory, list->capacity * sizeof *list->photons, what);
    *list = (rt_photon_list){.memory = list->memory};
}
