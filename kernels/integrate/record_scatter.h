/* record_scatter.h - how a path goes on from a vertex, where paths are recorded (record.h). */
#ifndef RT_KERNELS_INTEGRATE_RECORD_SCATTER_H
#define RT_KERNELS_INTEGRATE_RECORD_SCATTER_H

#include "record.h"
#include "surface/vertex.h"
#include "types.h"

#ifdef RT_RECORD_PATHS
/* The event by which the path goes on, and where to. */
static inline void record_scatter(rt_path_vertex *vertex, uint event, bool through, float pdf_w)
{
    vertex->event = event_word(event, through);
    vertex->pdf_w = pdf_w;
}
#endif

#endif
