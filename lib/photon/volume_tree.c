/* volume_tree.c - finds the radii of volume photons, and bounds their spheres. */
#include "photon/volume_tree.h"

#include <math.h>

#include "base/error.h"
#include "base/memory.h"
#include "base/parallel.h"
#include "photon/flann_index.h"

enum { BLOCKS_A_JOB = 64 };

/* Radii being found by several jobs. */
typedef struct finding {
    rt_photon_tree_data *tree;
    const rt_flann_index *index;
    size_t k;
    const rt_volume_radii *radii;
    rt_memory *memory;
    rt_status *failed; /* [jobs] */
} finding;

static const char what[] = "the radii of volume photons";

static size_t photons_of_block(const rt_photon_tree_data *tree, size_t block)
{
    const size_t left = tree->shape.photon_count - 8 * block;
    return left < 8 ? left : 8;
}

/* Gives the photons of a block the radius that lies so far from them. */
static void set_radius(rt_photon_block *block, size_t count, const rt_volume_radii *radii,
                       float radius)
{
    if (radii->max_radius > 0 && !(radius <= radii->max_radius))
        radius = radii->max_radius;
    for (size_t i = 0; i < count; i++)
        block->normal[RT_VOLUME_RADIUS][i] = (float)(radius * radii->factor);
}

/* The middle of a block's photons. */
static void find_middle(float out[3], const rt_photon_block *block, size_t count)
{
    for (int axis = 0; axis < 3; axis++) {
        double sum = 0;
        for (size_t i = 0; i < count; i++)
            sum += block->position[axis][i];
        out[axis] = (float)(sum / (double)count);
    }
}

static void find_share(void *user, uint32_t job)
{
    const finding *f = user;
    float middles[BLOCKS_A_JOB][3];
    const size_t first = (size_t)job * BLOCKS_A_JOB, left = f->tree->shape.block_count - first,
                 count = left < BLOCKS_A_JOB ? left : BLOCKS_A_JOB;
    float *squared =
        rt_memory_alloc(f->memory, count * f->k, sizeof(float) + sizeof(int), what, NULL);
    int *indices = squared ? (int *)(squared + count * f->k) : NULL;
    f->failed[job] = squared ? RT_OK : RT_ERROR_MEMORY;
    if (!squared)
        return;
    for (size_t i = 0; i < count; i++)
        find_middle(middles[i], f->tree->blocks + first + i, photons_of_block(f->tree, first + i));
    f->failed[job] =
        rt_flann_index_nearest(f->index, middles[0], count, f->k, indices, squared, NULL);
    for (size_t i = 0; i < count && f->failed[job] == RT_OK; i++)
        set_radius(f->tree->blocks + first + i, photons_of_block(f->tree, first + i), f->radii,
                   sqrtf(squared[i * f->k + f->k - 1]));
    rt_memory_free(squared);
}

/* Finds the radii of all blocks by their k-th nearest photon. */
static rt_status find_radii(finding *f, uint32_t threads, rt_error *error)
{
    const uint32_t jobs = (f->tree->shape.block_count + BLOCKS_A_JOB - 1) / BLOCKS_A_JOB;
    rt_status status = RT_OK;
    f->failed = rt_memory_zeroed(f->memory, jobs, sizeof *f->failed, what, error);
    if (!f->failed)
        return RT_ERROR_MEMORY;
    rt_parallel(threads, jobs, find_share, f);
    for (uint32_t job = 0; job < jobs && status == RT_OK; job++)
        status = f->failed[job];
    rt_memory_free(f->failed);
    return status == RT_OK ? RT_OK : rt_fail(error, status, "no memory for %s", what);
}

/* Makes the index of all positions, and finds the radii by it. */
static rt_status find_by_index(rt_photon_tree_data *tree, const rt_photon_list *list,
                               const rt_volume_radii *radii, uint32_t threads, rt_memory *memory,
                               rt_error *error)
{
    rt_flann_index *index = NULL;
    float(*positions)[3] = rt_memory_alloc(memory, list->count, sizeof *positions, what, error);
    if (!positions)
        return RT_ERROR_MEMORY;
    for (size_t i = 0; i < list->count; i++)
        for (int c = 0; c < 3; c++)
            positions[i][c] = list->photons[i].position[c];
    rt_status status = rt_flann_index_create(&index, positions[0], list->count, memory, error);
    rt_memory_free(positions);
    finding f = {.tree = tree,
                 .index = index,
                 .k = radii->k < list->count ? radii->k : list->count,
                 .radii = radii,
                 .memory = memory};
    if (status == RT_OK)
        status = find_radii(&f, threads, error);
    rt_flann_index_destroy(index);
    return status;
}

rt_status rt_volume_tree_build(rt_photon_tree_data *out, const rt_photon_list *list,
                               const rt_volume_radii *radii, uint32_t threads, rt_memory *memory,
                               rt_error *error)
{
    rt_photon_tree_data tree = {0};
    rt_status status = rt_photon_tree_build_in_media(&tree, list, threads, memory, error);
    if (status == RT_OK && radii->k > 0 && list->count > 0)
        status = find_by_index(&tree, list, radii, threads, memory, error);
    for (size_t i = 0; i < tree.shape.block_count && radii->k == 0 && status == RT_OK; i++)
        set_radius(tree.blocks + i, photons_of_block(&tree, i), radii, radii->max_radius);
    if (status != RT_OK) {
        rt_photon_tree_free(&tree);
        return status;
    }
    rt_photon_tree_bound_spheres(&tree);
    *out = tree;
    return RT_OK;
}
