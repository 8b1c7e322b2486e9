/* targets.h - all targets; each stands in target_NAME.c. */
#ifndef RT_TESTS_FUZZ_TARGETS_H
#define RT_TESTS_FUZZ_TARGETS_H

#include "fuzz/fuzz.h"

#define FUZZ_TARGETS(X)                                                                            \
    X(scene)                                                                                       \
    X(ply)                                                                                         \
    X(obj)                                                                                         \
    X(off)                                                                                         \
    X(stl)                                                                                         \
    X(png)                                                                                         \
    X(jpeg)                                                                                        \
    X(hdr)                                                                                         \
    X(bmp)                                                                                         \
    X(qoi)                                                                                         \
    X(tga)                                                                                         \
    X(ppm)                                                                                         \
    X(pfm)                                                                                         \
    X(exr)                                                                                         \
    X(ies)                                                                                         \
    X(grid)                                                                                        \
    X(map)                                                                                         \
    X(film)                                                                                        \
    X(fmt)                                                                                         \
    X(gltf)                                                                                        \
    X(glb)                                                                                         \
    X(mitsuba)                                                                                     \
    X(pbrt)                                                                                        \
    X(mtl)                                                                                         \
    X(serialized)                                                                                  \
    X(studies)                                                                                     \
    X(request)                                                                                     \
    X(command)

#define FUZZ_DECLARE(name) extern const fuzz_target fuzz_target_##name;
FUZZ_TARGETS(FUZZ_DECLARE)

/* The seed of an EXR file with layers, of a render in photon mode. */
#define FUZZ_EXR_LAYERS 0

/* All of them, NULL behind the last; that of a name, or NULL. */
extern const fuzz_target *const fuzz_targets[];
const fuzz_target *fuzz_find(const char *name);

#endif
