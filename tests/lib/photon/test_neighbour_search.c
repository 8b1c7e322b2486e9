/* test_neighbour_search.c - which photons count at a point, and how large their disc is. */
#include "support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "faults/failing_new.h"
#include "bsdf/lobes.h"
#include "lib/photon/points.h"
#include "photon/neighbour_search.h"
#include "photon/photon_boxes.h"

static const float up[3] = {0, 1, 0}, down[3] = {0, -1, 0}, sideways[3] = {1, 0, 0};

static rt_photon photon_at(float x, float y, float z, const float normal[3])
{
    rt_photon photon;
    memset(&photon, 0, sizeof photon);
    photon.position[0] = x;
    photon.position[1] = y;
    photon.position[2] = z;
    memcpy(photon.normal, normal, sizeof photon.normal);
    memcpy(photon.wi, normal, sizeof photon.wi);
    return photon;
}

/* A point on the plane y = 0, lit from above. */
static rt_gather_point point_at(float x, float z)
{
    rt_gather_point point;
    memset(&point, 0, sizeof point);
    point.position[0] = x;
    point.position[2] = z;
    memcpy(point.normal, up, sizeof point.normal);
    point.weight[1] = 1;
    return point;
}

/* Asks once; list must have room for k entries. */
static rt_gather_disc ask(rt_photon *photons, size_t count, uint32_t k, float max_radius,
                          rt_gather_point point, rt_u32 *list)
{
    rt_photon_list map = {.photons = photons, .count = count, .capacity = count, .emitted = count};
    rt_neighbour_search *search = NULL;
    rt_gather_disc disc;
    rt_error error;
    expect_ok(rt_neighbour_search_create(&search, &map, k, max_radius, 0, 2, NULL, &error), &error);
    expect_ok(rt_neighbour_search_find(search, &point, 1, list, &disc, &error), &error);
    rt_neighbour_search_destroy(search);
    return disc;
}

/* Photons at x = 1, 2, ... , count, all facing up. */
static void fill_row(rt_photon *photons, size_t count)
{
    for (size_t i = 0; i < count; i++)
        photons[i] = photon_at((float)(i + 1), 0, 0, up);
}

static void the_kth_gives_the_radius_and_does_not_count(void **state)
{
    rt_photon photons[20];
    rt_u32 list[5];
    (void)state;
    fill_row(photons, 20);
    rt_gather_disc disc = ask(photons, 20, 5, INFINITY, point_at(0, 0), list);
    assert_int_equal(disc.count, 4);
    assert_true(disc.squared_radius == 25);
    for (rt_u32 i = 0; i < 4; i++)
        assert_int_equal(list[i], i);
}

static void all_inside_the_limit_count_when_they_are_fewer_than_k(void **state)
{
    rt_photon photons[20];
    rt_u32 list[10];
    (void)state;
    fill_row(photons, 20);
    rt_gather_disc disc = ask(photons, 20, 10, 6.5f, point_at(0, 0), list);
    assert_int_equal(disc.count, 6);
    assert_true(disc.squared_radius == 6.5f * 6.5f);
    /* Also when the whole map lies inside. */
    disc = ask(photons, 3, 10, 6.5f, point_at(0, 0), list);
    assert_int_equal(disc.count, 3);
    assert_true(disc.squared_radius == 6.5f * 6.5f);
    /* A limit that is not reached changes nothing. */
    disc = ask(photons, 20, 5, 6.5f, point_at(0, 0), list);
    assert_int_equal(disc.count, 4);
    assert_true(disc.squared_radius == 25);
}

static void the_farthest_stands_for_the_kth_in_a_small_map(void **state)
{
    rt_photon photons[4];
    rt_u32 list[4];
    (void)state;
    fill_row(photons, 4);
    rt_gather_disc disc = ask(photons, 4, 50, INFINITY, point_at(0, 0), list);
    assert_int_equal(disc.count, 3);
    assert_true(disc.squared_radius == 16);
    disc = ask(photons, 1, 50, INFINITY, point_at(0, 0), list);
    assert_int_equal(disc.count, 0);
    disc = ask(photons, 0, 50, INFINITY, point_at(0, 0), list);
    assert_int_equal(disc.count, 0);
}

static void photons_that_face_elsewhere_are_rejected_before_ranking(void **state)
{
    enum { each = 400, k = 25 };
    static rt_photon photons[3 * each];
    rt_u32 list[k];
    (void)state;
    /*
     * Nearer than each photon that fits lie one of the other side of a thin floor and one of a
     * wall.
     */
    for (size_t i = 0; i < each; i++) {
        float x = (float)(i + 1);
        photons[3 * i] = photon_at(x - 0.5f, -1e-3f, 0, down);
        photons[3 * i + 1] = photon_at(x - 0.25f, 1e-3f, 0, sideways);
        photons[3 * i + 2] = photon_at(x, 0, 0, up);
    }
    rt_gather_disc disc = ask(photons, 3 * each, k, INFINITY, point_at(0, 0), list);
    assert_int_equal(disc.count, k - 1);
    assert_true(disc.squared_radius == k * k);
    for (rt_u32 i = 0; i < k - 1; i++)
        assert_int_equal(list[i], 3 * i + 2);
    /* And those that do not fit do not count inside a limit either. */
    disc = ask(photons, 3 * each, k, 10.1f, point_at(0, 0), list);
    assert_int_equal(disc.count, 10);
}

static void a_surface_that_no_photon_fits_has_none(void **state)
{
    enum { count = 5000 };
    static rt_photon photons[count];
    rt_u32 list[20];
    (void)state;
    for (size_t i = 0; i < count; i++)
        photons[i] = photon_at((float)i, 0, 0, down);
    rt_gather_disc disc = ask(photons, count, 20, INFINITY, point_at(0, 0), list);
    assert_int_equal(disc.count, 0);
}

static void points_without_weight_or_place_are_not_asked(void **state)
{
    rt_photon photons[20];
    rt_gather_point points[3] = {point_at(0, 0), point_at(0, 0), point_at(NAN, 0)};
    rt_gather_disc discs[3];
    rt_photon_list map = {.photons = photons, .count = 20, .capacity = 20, .emitted = 20};
    rt_neighbour_search *search = NULL;
    rt_u32 lists[3 * 5];
    rt_error error;
    (void)state;
    fill_row(photons, 20);
    points[0].weight[1] = 0;
    expect_ok(rt_neighbour_search_create(&search, &map, 5, INFINITY, 0, 1, NULL, &error), &error);
    expect_ok(rt_neighbour_search_find(search, points, 3, lists, discs, &error), &error);
    rt_neighbour_search_destroy(search);
    assert_int_equal(discs[0].is_query, 0);
    assert_int_equal(discs[1].is_query, 1);
    assert_int_equal(discs[2].is_query, 0);
    assert_int_equal(discs[0].count, 0);
    assert_int_equal(discs[1].count, 4);
    assert_int_equal(discs[2].count, 0);
}

static void many_points_at_once_find_what_one_finds(void **state)
{
    enum { count = 3000, asked = 2000, k = 30 };
    static rt_photon photons[count];
    static rt_gather_point points[asked];
    static rt_gather_disc discs[asked];
    static rt_u32 lists[asked * k], list[k];
    points_stream stream = {3};
    rt_photon_list map = {.photons = photons, .count = count, .capacity = count, .emitted = count};
    rt_neighbour_search *search = NULL;
    rt_error error;
    (void)state;
    for (size_t i = 0; i < count; i++) {
        float x = points_uniform(&stream), z = points_uniform(&stream);
        photons[i] = photon_at(x, 0, z, i % 3 ? up : x < 0.5f ? down : up);
    }
    for (size_t i = 0; i < asked; i++)
        points[i] = point_at(points_uniform(&stream), points_uniform(&stream));
    expect_ok(rt_neighbour_search_create(&search, &map, k, 0.06f, 0, 2, NULL, &error), &error);
    expect_ok(rt_neighbour_search_find(search, points, asked, lists, discs, &error), &error);
    rt_neighbour_search_destroy(search);
    for (size_t i = 0; i < asked; i += 97) {
        rt_gather_disc disc = ask(photons, count, k, 0.06f, points[i], list);
        assert_int_equal(disc.count, discs[i].count);
        assert_true(disc.squared_radius == discs[i].squared_radius);
        assert_memory_equal(list, lists + i * k, disc.count * sizeof *list);
    }
}

/*
 * A floor with a dense spot, and walls around it where few photons or none lie: what a search that
 * skips empty discs finds is what the other one does, but for the radius of those. One point in
 * five gathers the photons of both sides.
 */
static void skipping_empty_discs_changes_no_other(void **state)
{
    enum { count = 20000, asked = 6000, k = 20 };
    static rt_photon photons[count];
    static rt_gather_point points[asked];
    static rt_gather_disc discs[2][asked];
    static rt_u32 lists[2][asked * k];
    const float *const normals[] = {up, down, sideways};
    points_stream stream = {5};
    rt_photon_list map = {.photons = photons, .count = count, .capacity = count, .emitted = count};
    rt_error error;
    size_t empty = 0;
    (void)state;
    for (size_t i = 0; i < count; i++) {
        float x = points_uniform(&stream), z = points_uniform(&stream);
        photons[i] = i % 100 ? photon_at(0.1f * x, 0, 0.1f * z, up)
                             : photon_at(1, x, z, i % 200 ? sideways : up);
    }
    for (size_t i = 0; i < asked; i++) {
        points[i] = point_at(points_uniform(&stream), points_uniform(&stream));
        points[i].position[1] = i % 2 ? points_uniform(&stream) : 0;
        memcpy(points[i].normal, normals[i % 3], sizeof points[i].normal);
        points[i].lobe = i % 5 == 1 ? RT_LOBE_TRANSLUCENT : RT_LOBE_LAMBERT;
    }
    for (float limit = 0.2f; limit < 3; limit = limit < 1 ? 1.5f : HUGE_VALF) {
        for (int skip = 0; skip < 2; skip++) {
            rt_neighbour_search *search = NULL;
            expect_ok(rt_neighbour_search_create(&search, &map, k, limit, skip, 2, NULL, &error),
                      &error);
            expect_ok(
                rt_neighbour_search_find(search, points, asked, lists[skip], discs[skip], &error),
                &error);
            rt_neighbour_search_destroy(search);
        }
        for (size_t i = 0; i < asked; i++) {
            rt_gather_disc expected = discs[0][i];
            expected.squared_radius = expected.count > 0 ? expected.squared_radius : 0;
            assert_memory_equal(&discs[1][i], &expected, sizeof expected);
            assert_memory_equal(lists[1] + i * k, lists[0] + i * k,
                                expected.count * sizeof **lists);
            empty += expected.count == 0;
        }
    }
    assert_true(empty > asked);
}

/* Where a spot on the floor has enough photons and those of a wall are farther, none fits. */
static void an_empty_disc_is_known_without_a_search(void **state)
{
    enum { spot = 1024, wall = 1024, reach = 320 };
    static rt_photon photons[spot + wall];
    points_stream stream = {7};
    rt_photon_list map = {
        .photons = photons, .count = spot + wall, .capacity = spot + wall, .emitted = spot + wall};
    const float near_spot[3] = {0.2f, 0.1f, 0}, at_wall[3] = {8.9f, 9, 9};
    rt_photon_boxes *boxes = NULL;
    rt_error error;
    (void)state;
    for (size_t i = 0; i < spot + wall; i++) {
        float x = points_uniform(&stream), z = points_uniform(&stream);
        photons[i] = i < spot ? photon_at(0.1f * x, 0, 0.1f * z, up)
                              : photon_at(9, 9 - 0.1f * x, 9 - 0.1f * z, sideways);
    }
    expect_ok(rt_photon_boxes_create(&boxes, &map, reach, 2, NULL, &error), &error);
    assert_true(rt_photon_boxes_none(boxes, near_spot, sideways, HUGE_VALF));
    assert_true(rt_photon_boxes_none(boxes, near_spot, down, HUGE_VALF));
    assert_false(rt_photon_boxes_none(boxes, near_spot, up, HUGE_VALF));
    assert_false(rt_photon_boxes_none(boxes, at_wall, sideways, HUGE_VALF));
    /* Nothing at all lies within a limit that is small enough. */
    assert_true(rt_photon_boxes_none(boxes, near_spot, up, 1e-4f));
    rt_photon_boxes_destroy(boxes);
}

static void without_photons_every_disc_is_empty(void **state)
{
    rt_gather_point point = point_at(0, 0);
    rt_photon_list map = {0};
    rt_error error;
    (void)state;
    for (int skip_empty = 0; skip_empty < 2; skip_empty++) {
        rt_neighbour_search *search = NULL;
        rt_gather_disc disc;
        expect_ok(
            rt_neighbour_search_create(&search, &map, 5, HUGE_VALF, skip_empty, 2, NULL, &error),
            &error);
        expect_ok(rt_neighbour_search_find(search, &point, 1, NULL, &disc, &error), &error);
        assert_int_equal(disc.is_query, 1);
        assert_int_equal(disc.count, 0);
        assert_true(disc.squared_radius == 0);
        rt_neighbour_search_destroy(search);
    }
}

enum { in_row = 2048, asked = 96, in_disc = 2000, several = 4 };

/* Builds a search and asks it on several threads, with that call of operator new failing. */
static rt_status search_row(const rt_photon_list *map, const rt_gather_point *points, rt_u32 *lists,
                            rt_gather_disc *discs, unsigned failing, rt_error *error)
{
    rt_neighbour_search *search = NULL;
    failing_new_at(failing);
    rt_status status =
        rt_neighbour_search_create(&search, map, in_disc, INFINITY, 0, several, NULL, error);
    if (status == RT_OK)
        status = rt_neighbour_search_find(search, points, asked, lists, discs, error);
    rt_neighbour_search_destroy(search);
    return status;
}

/* FLANN throws in whichever thread that is; the program does not end of it, nothing is lost. */
static void each_failure_of_memory_in_any_thread_is_an_error(void **state)
{
    static rt_photon photons[in_row];
    static rt_gather_point points[asked];
    static rt_u32 lists[asked * in_disc];
    static rt_gather_disc discs[asked];
    const rt_photon_list map = {
        .photons = photons, .count = in_row, .capacity = in_row, .emitted = in_row};
    const long before = failing_new_blocks();
    unsigned failing = 0, is_over = 0;
    rt_error error;
    (void)state;
    fill_row(photons, in_row);
    for (size_t i = 0; i < asked; i++)
        points[i] = point_at((float)i, 0);
    while (!is_over) {
        const rt_status status = search_row(&map, points, lists, discs, ++failing, &error);
        is_over = !failing_new_failed();
        assert_int_equal(status, is_over ? RT_OK : RT_ERROR_MEMORY);
        assert_int_equal(error.status, is_over ? error.status : RT_ERROR_MEMORY);
        assert_int_equal(failing_new_blocks(), before);
    }
    failing_new_at(0);
    assert_true(failing > asked); /* FLANN makes a call for each */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(without_photons_every_disc_is_empty),
        cmocka_unit_test(the_kth_gives_the_radius_and_does_not_count),
        cmocka_unit_test(all_inside_the_limit_count_when_they_are_fewer_than_k),
        cmocka_unit_test(the_farthest_stands_for_the_kth_in_a_small_map),
        cmocka_unit_test(photons_that_face_elsewhere_are_rejected_before_ranking),
        cmocka_unit_test(a_surface_that_no_photon_fits_has_none),
        cmocka_unit_test(points_without_weight_or_place_are_not_asked),
        cmocka_unit_test(many_points_at_once_find_what_one_finds),
        cmocka_unit_test(skipping_empty_discs_changes_no_other),
        cmocka_unit_test(an_empty_disc_is_known_without_a_search),
        cmocka_unit_test(each_failure_of_memory_in_any_thread_is_an_error),
    };
    return cmocka_run_group_tests_name("lib/photon/neighbour_search", tests, NULL, NULL);
}
