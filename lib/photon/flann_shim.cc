/*
 * flann_shim.cc - FLANN's exact kd-tree, with its exceptions caught.
 *
 * What is changed of FLANN here belongs to types of this file alone, so a program may use FLANN of
 * its own beside it.
 */
#include "photon/flann_shim.h"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <memory>
#include <new>
#include <stdexcept>
#include <vector>

/*
 * In place of flann/util/allocator.h, whose pool prints on stderr and returns null when memory runs
 * out, which is then written to.
 */
#define FLANN_ALLOCATOR_H_
namespace flann
{
namespace
{

class PooledAllocator
{
  public:
    void *take(std::size_t size)
    {
        size = (size + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
        if (size > left_) {
            const std::size_t block = std::max(size, BLOCK);
            blocks_.push_back(std::make_unique<unsigned char[]>(block));
            next_ = blocks_.back().get();
            left_ = block;
            usedMemory += block;
        }
        unsigned char *taken = next_;
        next_ += size;
        left_ -= size;
        return taken;
    }

    void free()
    {
        blocks_.clear();
        left_ = usedMemory = 0;
    }

    /* By names that FLANN uses. */
    std::size_t usedMemory = 0;
    static constexpr std::size_t wastedMemory = 0;

  private:
    static constexpr std::size_t ALIGNMENT = alignof(std::max_align_t), BLOCK = 1 << 15;

    std::vector<std::unique_ptr<unsigned char[]>> blocks_;
    unsigned char *next_ = nullptr;
    std::size_t left_ = 0;
};

} // namespace
} // namespace flann

void *operator new(std::size_t size, flann::PooledAllocator &pool)
{
    return pool.take(size);
}

void operator delete(void *, flann::PooledAllocator &)
{
}

#include <flann/algorithms/dist.h>
#include <flann/algorithms/kdtree_single_index.h>

namespace
{

constexpr int LEAF_SIZE = 16; /* the fastest for k = 50 to 500 of 10^5 to 10^6 points */

struct Squared : flann::L2_3D<float> {
};

using Index = flann::KDTreeSingleIndex<Squared>;

flann::IndexParams parameters()
{
    flann::IndexParams p;
    p["leaf_max_size"] = LEAF_SIZE;
    p["reorder"] = true;
    return p;
}

/*
 * The nearest so far. Where k of them are at the query itself, no other is nearer: FLANN, which
 * goes on as long as one could be as near, would look at all points that are one.
 */
template <typename Nearest> class Results : public Nearest
{
  public:
    using Nearest::Nearest;

    float worstDist() const override
    {
        const float worst = Nearest::worstDist();
        return worst > 0 ? worst : -1;
    }
};

template <typename Nearest>
void search(const Index &index, const float *queries, size_t count, size_t k, int *indices,
            float *squared)
{
    const flann::SearchParams p(flann::FLANN_CHECKS_UNLIMITED);
    Results<Nearest> results(k);
    std::vector<size_t> row(k);
    for (size_t i = 0; i < count; i++) {
        results.clear();
        index.findNeighbors(results, queries + 3 * i, p);
        const size_t found = std::min(results.size(), k);
        results.copy(row.data(), squared + i * k, found);
        std::transform(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(found),
                       indices + i * k, [](size_t one) { return static_cast<int>(one); });
    }
}

/* 0, or -1 after writing down why. */
template <typename Work> int guarded(char *why, size_t why_size, const Work &work)
{
    try {
        work();
        return 0;
    } catch (const std::bad_alloc &) {
        std::snprintf(why, why_size, "out of memory");
    } catch (const std::exception &exception) {
        std::snprintf(why, why_size, "%s", exception.what());
    } catch (...) {
        std::snprintf(why, why_size, "an unknown exception");
    }
    return -1;
}

} // namespace

/* In KiB: FLANN's own overflows. */
template <> int Index::usedMemory() const
{
    return static_cast<int>((pool_.usedMemory + size_ * sizeof vind_[0]) >> 10);
}

/* Indices are neither saved nor loaded, so the library by which FLANN packs files is not linked. */
template <> void Index::saveIndex(FILE *)
{
    throw std::logic_error("an index is not saved");
}

template <> void Index::loadIndex(FILE *)
{
    throw std::logic_error("an index is not loaded");
}

struct rt_flann_tree {
    explicit rt_flann_tree(const float *positions, size_t count)
        : index(parameters()), points(count)
    {
        /* FLANN's matrices are never const; nothing is written through this one. */
        index.buildIndex(flann::Matrix<float>(const_cast<float *>(positions), count, 3));
    }

    Index index;
    size_t points;
};

int rt_flann_build(rt_flann_tree **out, const float *positions, int count, char *why,
                   size_t why_size)
{
    return guarded(why, why_size,
                   [&] { *out = new rt_flann_tree(positions, static_cast<size_t>(count)); });
}

void rt_flann_free(rt_flann_tree *tree)
{
    delete tree;
}

uint64_t rt_flann_bytes(const rt_flann_tree *tree)
{
    return (static_cast<uint64_t>(tree->index.usedMemory()) + 1) * 1024 +
           tree->points * (3 * sizeof(float) + sizeof(float *)) + sizeof *tree;
}

int rt_flann_search(const rt_flann_tree *tree, const float *queries, size_t count, size_t k,
                    int *indices, float *squared, char *why, size_t why_size)
{
    return guarded(why, why_size, [&] {
        if (k > KNN_HEAP_THRESHOLD)
            search<flann::KNNResultSet2<float>>(tree->index, queries, count, k, indices, squared);
        else
            search<flann::KNNSimpleResultSet<float>>(tree->index, queries, count, k, indices,
                                                     squared);
    });
}
