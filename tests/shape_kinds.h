/* shape_kinds.h - for tests of every kind of shape: one that is left out fails the test. */
#ifndef RT_TESTS_SHAPE_KINDS_H
#define RT_TESTS_SHAPE_KINDS_H

#include "shape/shapes.h"
#include "support.h"

enum { SHAPE_KINDS_MAX = 64 }; /* above all numbers of kinds */

/* For RT_SHAPES and its parts: fails where `seen`, by kind, is 0. */
#define EXPECT_SEEN(KIND, name, number)                                                            \
    if (!seen[RT_SHAPE_##KIND])                                                                    \
        fail_msg("no row of this test is a shape of kind %s", #name);

#endif
