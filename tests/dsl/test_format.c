/* Formatting keeps the tokens and comments of a text, and changes nothing a second time. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "dsl/textmate.h"
#include "rt.h"
#include "tests/dsl/collect.h"

static char *format(const char *text)
{
    char *made = NULL;
    rt_error error;
    if (rt_scene_format(&made, text, NULL, NULL, &error) != RT_OK)
        fail_msg("%s\nin\n%s", error.message, text);
    return made;
}

/* Texts and what becomes of them. */
static const struct {
    const char *text, *made;
} layouts[] = {
    {"", ""},
    {"\n\n# a\n\n\n\n# b  \n\n", "# a\n\n# b\n"},
    {"film{width 4 height 5}", "film { width 4  height 5 }\n"},
    {"film {\nwidth 4\n  height 5 # tall\n}\n", "film {\n    width  4\n    height 5  # tall\n}\n"},
    {"let a=1\nlet long=2*( a+1 )\n", "let a    = 1\nlet long = 2 * (a + 1)\n"},
    {"let a = 2 -3\nlet b = - 3\nlet v = [-1 -a 2]\n",
     "let a = 2 - 3\nlet b = -3\nlet v = [-1 -a 2]\n"},
    {"let a = 2--1*-b\nlet v = [1 2 3]*-(2--1)\nlet s = - - 1\n",
     "let a = 2 - -1 * -b\nlet v = [1 2 3] * -(2 - -1)\nlet s = --1\n"},
    {"camera { eye 0 1 -4 look_at 0 (1-a) -2 }\n", "camera { eye 0 1 -4  look_at 0 (1 - a) -2 }\n"},
    {"render { mode direct direct photons kernel gaussian-jensen }\n",
     "render { mode direct  direct photons  kernel gaussian-jensen }\n"},
    {"repeat i from 0 to (n-1) { sphere {\ncentre cos( 60*i ) 0 -1\nradius 1 } }\n",
     "repeat i from 0 to (n - 1) { sphere {\n        centre cos(60 * i) 0 -1\n"
     "        radius 1 } }\n"},
    {"film { width 4 } camera { fov 3 }\n", "film   { width 4 }\ncamera { fov 3 }\n"},
    {"include \"a  b.rts\"\r\nfilm { width 4 }\r\n", "include \"a  b.rts\"\nfilm { width 4 }\n"},
    {"sphere {\n    matrix 1 0 0 0\n    0 1 0 0\n    0 0 1 0\n}\n",
     "sphere {\n    matrix 1 0 0 0\n        0 1 0 0\n        0 0 1 0\n}\n"},
    {"model {\nfile\"a b.ply\"\nmaterial m\n}\n",
     "model {\n    file\"a b.ply\"\n    material m\n}\n"},
    {"sphere {\nradius(1 + 2)\ncentre 1 2 3\n}\n",
     "sphere {\n    radius(1 + 2)\n    centre 1 2 3\n}\n"},
    {"let x = 1 +\n2\nfilm { width 4 }\n", "let x = 1 +\n    2\nfilm { width 4 }\n"},
};

static void layouts_are_as_described(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof layouts / sizeof *layouts; i++) {
        char *made = format(layouts[i].text), *again = format(made);
        assert_string_equal(made, layouts[i].made);
        assert_string_equal(again, made);
        free(made);
        free(again);
    }
}

static void a_long_block_is_broken_between_fields(void **state)
{
    const char *text = "model { file \"a-mesh-with-a-rather-long-name.ply\" material white scale 2 "
                       "translate 1 2 3 rotate 0 1 0 45 } # far\n";
    (void)state;
    char *made = format(text), *again = format(made);
    assert_string_equal(made, "model {  # far\n"
                              "    file      \"a-mesh-with-a-rather-long-name.ply\"\n"
                              "    material  white\n"
                              "    scale     2\n"
                              "    translate 1 2 3\n"
                              "    rotate    0 1 0 45\n"
                              "}\n");
    assert_string_equal(again, made);
    free(made);
    free(again);
}

static void what_is_no_scene_is_refused_with_its_place(void **state)
{
    static const struct {
        const char *text;
        int line;
        const char *says;
    } wrong[] = {
        {"film { width 4\n", 1, "is not closed: expected '}'"},
        {"film { width 4 }\n}\n", 2, "closes nothing"},
        {"film { width (4 }\n", 1, "'(' is not closed: expected ')' before '}'"},
        {"film @\n", 1, "unexpected '@'"},
        {"film {\n width [4 render { spp 1 }\n}\n", 2,
         "'[' is not closed: expected ']' before '{'"},
        {"film { width (4] }", 1, "'(' is not closed: expected ')' before ']'"},
        {"let a = (1 + 2\nfilm { }\nrender { }\n}", 1,
         "'(' is not closed: expected ')' before '{'"},
        {"include \"a.rts\n", 1, "not closed"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        char *made = NULL;
        rt_error error;
        assert_int_equal(rt_scene_format(&made, wrong[i].text, "x.rts", NULL, &error),
                         RT_ERROR_INPUT);
        assert_null(made);
        assert_int_equal(error.line, wrong[i].line);
        assert_non_null(strstr(error.message, wrong[i].says));
    }
    assert_int_equal(rt_scene_format(NULL, NULL, NULL, NULL, NULL), RT_ERROR_USAGE);
}

/* One error, and not one for each parenthesis beyond. */
static void what_nests_too_deep_is_told_once(void **state)
{
    char text[2048] = "let a = ", *made = NULL;
    rt_error error;
    (void)state;
    memset(text + strlen(text), '(', 600);
    strcat(text, "1\n");
    assert_int_equal(rt_scene_format(&made, text, "x.rts", NULL, &error), RT_ERROR_INPUT);
    assert_null(made);
    assert_string_equal(error.message, "braces and parentheses nest deeper than 256");
    assert_int_equal(error.column, 265);
}

static void the_grammar_of_editors_is_that_of_the_source(void **state)
{
    char *file = read_text("tools/editor/rts.tmLanguage.json"), *made = rt_textmate_grammar();
    (void)state;
    if (strcmp(file, made) != 0)
        fail_msg("run `make docs`: tools/editor/rts.tmLanguage.json differs from the source");
    free(file);
    free(made);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(layouts_are_as_described),
        cmocka_unit_test(what_nests_too_deep_is_told_once),
        cmocka_unit_test(a_long_block_is_broken_between_fields),
        cmocka_unit_test(what_is_no_scene_is_refused_with_its_place),
        cmocka_unit_test(the_grammar_of_editors_is_that_of_the_source),
    };
    return cmocka_run_group_tests_name("format", tests, NULL, NULL);
}
