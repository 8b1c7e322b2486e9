#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "dsl/suggest.h"

static rt_text text(const char *word)
{
    rt_text slice = {word, strlen(word)};
    return slice;
}

static void edit_distances_are_those_of_optimal_alignment(void **state)
{
    static const struct {
        const char *a, *b;
        int distance;
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
        assert_int_equal(rt_edit_distance(text(cases[i].a), text(cases[i].b), 9),
                         cases[i].distance);
        assert_int_equal(rt_edit_distance(text(cases[i].b), text(cases[i].a), 9),
                         cases[i].distance);
    }
    assert_int_equal(rt_edit_distance(text("abcdef"), text("uvwxyz"), 2), 3);
}

static const char *nearest(const char *wanted)
{
    static const char *const known[] = {"camera", "film", "sphere", "plane", "kd", "ks"};
    rt_suggestion suggestion = rt_suggestion_begin(text(wanted));
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        rt_suggestion_offer_word(&suggestion, known[i]);
    return suggestion.best.at;
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(edit_distances_are_those_of_optimal_alignment),
        cmocka_unit_test(only_near_names_are_suggested),
    };
    return cmocka_run_group_tests_name("suggest", tests, NULL, NULL);
}
