/*
 * test_shapes_many.c - 300 000 rays, and by RT_TEST_LONG=1 a million, against each kind of shape
 * that a transform places.
 */
#include <stdlib.h>

#include "kernels/shape_check.h"
#include "shape_kinds.h"
#include "support.h"

static void many_rays_match_extended_precision(void **state)
{
    const size_t rays = getenv("RT_TEST_LONG") ? 1000000 : 300000;
    (void)state;
    shape_expect_all_kinds();
    rays_stream stream = {11};
    size_t variants[SHAPE_KINDS_MAX] = {0};
    for (size_t kind = 0; kind < shape_kind_count; kind++)
        variants[shape_kinds[kind].kind]++;
    for (size_t kind = 0; kind < shape_kind_count; kind++)
        for (size_t place = 0; place < shape_place_count; place++) {
            const reference_shape shape = shape_placed(&stream, kind, place);
            shape_expect_reference(&shape, rays / shape_place_count / variants[shape.kind] + 1,
                                   1000 * kind + place);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(many_rays_match_extended_precision),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
