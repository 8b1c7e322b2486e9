/* record_scatter.h - how a path goes on from a vertex, where paths are recorded (record.h). */
#ifndef RT_KERNELS_INTEGRATE_RECORD_SCATTER_H
#define RT_KERNELS_INTEGRATE_RECORD_SCATTER_H

#include "bsdf/lobes.h"
#include "record.h"
#include "types.h"

#ifdef RT_RECORD_PATHS
/* The lobe by which the path goes on, and where to. */
static inline void record_scatter(rt_path_vertex *vertex, uint lobe, bool through, float pdf_w)
{
    if (lobe == RT_LOBE_SPECULAR_REFLECTION)
        vertex->event = RT_PATH_REFLECTION;
    else if (lobe == RT_LOBE_SPECULAR_TRANSMISSION)
        vertex->event = RT_PATH_REFRACTION;
    else if (lobe_is_rough(lobe))
        vertex->event = through ? RT_PATH_ROUGH_REFRACTION : RT_PATH_ROUGH_REFLECTION;
    else
        vertex->event = RT_PATH_DIFFUSE;
    vertex->pdf_w = pdf_w;
}
#endif

#endif
