/* failing_new.cc - replaces C++'s operator new by one that counts its calls and can fail. */
#include "failing_new.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace
{

std::atomic<unsigned> left(0);
std::atomic<bool> failed(false);
std::atomic<long> blocks(0);

} // namespace

void failing_new_at(unsigned call)
{
    left = call;
    failed = false;
}

int failing_new_failed(void)
{
    return failed;
}

long failing_new_blocks(void)
{
    return blocks;
}

void *operator new(std::size_t size)
{
    unsigned now = left;
    while (now > 0 && !left.compare_exchange_weak(now, now - 1))
        ;
    if (now == 1) {
        failed = true;
        throw std::bad_alloc();
    }
    void *block = std::malloc(size > 0 ? size : 1);
    if (!block)
        throw std::bad_alloc();
    blocks++;
    return block;
}

void operator delete(void *block) noexcept
{
    if (block)
        blocks--;
    std::free(block);
}

void operator delete(void *block, std::size_t) noexcept
{
    operator delete(block);
}
