/* test_shapes_many.c - a million rays against each kind of shape that a transform places. */
#include "kernels/shape_check.h"
#include "shape_kinds.h"
#include "support.h"

static void a_million_rays_match_extended_precision(void **state)
{
    (void)state;
    shape_expect_all_kinds();
    rays_stream stream = {11};
    size_t variants[SHAPE_KINDS_MAX] = {0};
    for (size_t kind = 0; kind < shape_kind_count; kind++)
        variants[shape_kinds[kind].kind]++;
    for (size_t kind = 0; kind < shape_kind_count; kind++)
        for (size_t place = 0; place < shape_place_count; place++) {
            const reference_shape shape = shape_placed(&stream, kind, place);
            shape_expect_reference(&shape, 1000000 / shape_place_count / variants[shape.kind] + 1,
                                   1000 * kind + place);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_million_rays_match_extended_precision),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
