/* facet_material.h - materials as a device reads them, with the losses of their facets. */
#ifndef RT_TESTS_KERNELS_FACET_MATERIAL_H
#define RT_TESTS_KERNELS_FACET_MATERIAL_H

#include "support.h"

#include "types.h"

/* A material of a packed scene, and behind it what its facet_losses leads to. */
typedef struct facet_material {
    rt_material_data *data; /* the first member of `bytes` bytes */
    size_t bytes;
} facet_material;

/*
 * The first of these materials of a scene, as it is packed; free(data). The others are solids
 * beside it, of other indices. Texture 1 is one from black to white.
 */
facet_material facet_material_of(const rt_material *materials, size_t count);

#endif
