/* points.c - reproducible random points. */
#include "lib/photon/points.h"

/* PCG-XSH-RR (O'Neill, "PCG: A Family of Simple Fast Space-Efficient ... Generators", 2014). */
float points_uniform(points_stream *stream)
{
    uint64_t old = stream->state;
    stream->state = old * 6364136223846793005u + 1442695040888963407u;
    uint32_t mixed = (uint32_t)(((old >> 18) ^ old) >> 27), turn = (uint32_t)(old >> 59);
    uint32_t bits = (mixed >> turn) | (mixed << ((32 - turn) & 31));
    return (float)(bits >> 8) * 0x1p-24f;
}
