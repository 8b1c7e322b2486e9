/*
 * test_shapes.c - the shapes that a transform places: what rays meet, and where rays go that leave
 * them.
 */
#include <math.h>
#include <stdlib.h>

#include "kernels/shape_check.h"
#include "support.h"

enum { rays_each = 4000, leaving_each = 10000 };

static void placed_shapes_match_extended_precision(void **state)
{
    (void)state;
    shape_expect_all_kinds();
    rays_stream stream = {1};
    for (size_t kind = 0; kind < shape_kind_count; kind++)
        for (size_t place = 0; place < shape_place_count; place++) {
            const reference_shape shape = shape_placed(&stream, kind, place);
            shape_expect_reference(&shape, rays_each, 100 * kind + place);
        }
}

/*
 * How far the rays get, in their own t, that leave what these rays met in the direction `sign`
 * times theirs.
 */
static float *leave(const reference_shape *shape, const rt_ray *rays, float sign)
{
    static float away[leaving_each][4];
    for (int i = 0; i < leaving_each; i++)
        for (int a = 0; a < 3; a++)
            away[i][a] = sign * rays[i].direction[a];
    return rays_leave(shape_scene(shape), rays, away, leaving_each);
}

/*
 * The t from the ray's first hit to the next. Returns whether it is well conditioned: the ray
 * neither grazes the shape nor cuts off a corner.
 */
static int reference_chord(const reference_shape *shape, const rt_ray *ray,
                           const reference_hit *first, double *chord)
{
    double o[3], d[3], cosine = 0;
    const double speed = reference_ray(shape, ray, o, d), step = 1e-3 / speed;
    rt_ray on = *ray;
    for (int a = 0; a < 3; a++) {
        on.origin[a] += (float)(first->t + step) * on.direction[a];
        cosine += first->normal[a] * d[a] / speed;
    }
    *chord = reference_nearest(shape, 0, 0, &on).t + step;
    return fabs(cosine) > 0.1 && *chord * speed > 0.01;
}

/*
 * Nothing lies between a ray and where it came from; onwards it ends at the next side of the shape.
 * A few rays in a thousand meet it where it turns away or at a corner; and where coordinates are a
 * thousand times the size, the room that their rounding asks for shortens chords.
 */
static void rays_leave_placed_shapes(void **state)
{
    (void)state;
    static rt_ray rays[leaving_each];
    rays_stream stream = {2};
    for (size_t kind = 0; kind < shape_kind_count; kind++)
        for (size_t place = 0; place < shape_place_count; place++) {
            const reference_shape shape = shape_placed(&stream, kind, place);
            const size_t share = shape_places[place].offset > 500.0f ? 10 : 500;
            size_t met = 0, returned = 0, chords = 0, strayed = 0;
            for (int i = 0; i < leaving_each; i++)
                rays[i] = shape_ray(&stream, &shape);
            float *back = leave(&shape, rays, -1), *on = leave(&shape, rays, 1);
            for (int i = 0; i < leaving_each; i++) {
                const reference_hit first = reference_nearest(&shape, 0, 0, rays + i);
                double chord;
                if (back[i] < 0 || isinf(first.t))
                    continue;
                met++;
                returned += back[i] < 0.99 * first.t;
                if (reference_chord(&shape, rays + i, &first, &chord)) {
                    chords++;
                    strayed += isinf(chord) ? !isinf(on[i]) : !(fabs(on[i] - chord) < 0.1 * chord);
                }
            }
            assert_true(met > leaving_each / 10 && chords > met / 10);
            assert_true(returned * share <= met);
            assert_true(strayed * share <= chords);
            free(back);
            free(on);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(placed_shapes_match_extended_precision),
        cmocka_unit_test(rays_leave_placed_shapes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
