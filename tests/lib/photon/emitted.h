/* emitted.h - photon maps by the public interface, of a room that several tests share. */
#ifndef RT_TESTS_LIB_PHOTON_EMITTED_H
#define RT_TESTS_LIB_PHOTON_EMITTED_H

#include "rt.h"

/* A closed room with a glass ball, two lights of different kind and power. */
#define ROOM                                                                                       \
    "material wall { kd 0.4 0.5 0.6 }\n"                                                           \
    "material glass { kt 1  ior 1.5  fresnel dielectric }\n"                                       \
    "sphere { centre 0 0 0  radius 1  material wall }\n"                                           \
    "sphere { centre 0.3 0 0  radius 0.3  material glass }\n"                                      \
    "quad { corner -0.6 0.5 -0.1  edge1 0.2 0 0  edge2 0 0 0.2  material wall  power 2 2 2 }\n"    \
    "light point { position 0 0.6 0  power 2 3 5 }\n"

/* A renderer of the scene that a text describes. */
rt_renderer *renderer_on(rt_device *device, const char *text, rt_accel accel);

/* Emits a map, which must not fail. */
rt_photon_map *emit_map(rt_renderer *renderer, const rt_emit_options *options);

/* The same files mean the same maps, to the bit. */
void expect_same_map(const rt_photon_map *a, const rt_photon_map *b);

#endif
