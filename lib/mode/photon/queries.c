/* queries.c - closes the gatherers of all queries, and finds their common capacity. */
#include "mode/photon/queries.h"

#include <string.h>

void rt_queries_close(rt_queries *queries)
{
    for (int i = 0; i < RT_QUERIES; i++) {
        rt_gatherer_destroy(queries->gatherers[i]);
        rt_gatherer_destroy(queries->finer[i].gatherer);
    }
    memset(queries, 0, sizeof *queries);
}

size_t rt_queries_capacity(const rt_queries *queries, size_t capacity)
{
    for (int i = 0; i < RT_QUERIES; i++)
        if (queries->gatherers[i] && rt_gatherer_capacity(queries->gatherers[i]) < capacity)
            capacity = rt_gatherer_capacity(queries->gatherers[i]);
    return capacity;
}
