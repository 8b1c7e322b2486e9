/* test_word.c - lists of words, and the nearest of several names. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "rt.h"

static size_t distance(const char *a, const char *b, size_t limit)
{
    return rt_edit_distance(a, strlen(a), b, strlen(b), limit);
}

static void edit_distances_are_those_of_optimal_alignment(void **state)
{
    static const struct {
        const char *a, *b;
        size_t distance;
    } cases[] = {{"", "", 0},
                 {"a", "", 1},
                 {"radius", "radius", 0},
                 {"raduis", "radius", 1},
                 {"centre", "center", 1},
                 {"spere", "sphere", 1},
                 {"kitten", "sitting", 3},
                 {"CA", "ABC", 3},
                 {"Radius", "radius", 0},
                 {"ab", "ba", 1}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        assert_int_equal(distance(cases[i].a, cases[i].b, 9), cases[i].distance);
        assert_int_equal(distance(cases[i].b, cases[i].a, 9), cases[i].distance);
    }
    assert_int_equal(distance("abcdef", "uvwxyz", 2), 3);
}

static const char *nearest(const char *wanted)
{
    static const char *const known[] = {"camera", "film", "sphere", "plane", "kd", "ks"};
    rt_nearest search;
    rt_nearest_begin(&search, wanted, strlen(wanted));
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        rt_nearest_offer(&search, known[i], strlen(known[i]));
    return search.best;
}

static void words_are_found_and_joined(void **state)
{
    static const rt_word words[] = {RT_DENSITIES(RT_WORD) RT_WORD_END};
    static const rt_word two[] = {RT_SAMPLERS(RT_WORD) RT_WORD_END};
    char list[128], few[16];
    (void)state;
    assert_int_equal(rt_word_find(words, "cone", 4)->value, RT_DENSITY_CONE);
    assert_int_equal(rt_word_find(words, "gaussian", 8)->value, RT_DENSITY_GAUSSIAN);
    assert_int_equal(rt_word_find(words, "gaussian-jensen", 15)->value, RT_DENSITY_GAUSSIAN_JENSEN);
    assert_int_equal(rt_word_find(words, "gaussian_jensen", 15)->value, RT_DENSITY_GAUSSIAN_JENSEN);
    assert_null(rt_word_find(words, "gauss", 5));
    assert_null(rt_word_find(words, "cones", 5));
    assert_null(rt_word_find(NULL, "cone", 4));
    assert_string_equal(rt_words_join(list, sizeof list, two), "sobol or independent");
    assert_string_equal(rt_words_join(list, sizeof list, words),
                        "epanechnikov, box, cone, gaussian, silverman or gaussian-jensen");
    assert_string_equal(rt_words_join(few, sizeof few, words), "epanechnikov, b");
}

static void only_near_names_are_suggested(void **state)
{
    (void)state;
    assert_string_equal(nearest("shpere"), "sphere");
    assert_string_equal(nearest("plan"), "plane");
    assert_string_equal(nearest("CAMERA"), "camera");
    assert_null(nearest("kx"));
    assert_null(nearest("torus"));
    assert_null(nearest("a_very_long_word_that_is_longer_than_any_name_in_the_language"));
}

static void beginnings_and_synonyms_are_near(void **state)
{
    (void)state;
    assert_string_equal(nearest("spher"), "sphere");
    assert_string_equal(nearest("ball"), "sphere");
    assert_string_equal(nearest("Color"), "kd");
    assert_null(nearest("sph"));
    assert_null(nearest("balls"));
    rt_nearest search;
    rt_nearest_begin(&search, "ortho", 5);
    rt_nearest_offer(&search, "environment", 11);
    rt_nearest_offer(&search, "orthographic", 12);
    assert_string_equal(search.best, "orthographic");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(edit_distances_are_those_of_optimal_alignment),
        cmocka_unit_test(words_are_found_and_joined),
        cmocka_unit_test(only_near_names_are_suggested),
        cmocka_unit_test(beginnings_and_synonyms_are_near),
    };
    return cmocka_run_group_tests_name("word", tests, NULL, NULL);
}
