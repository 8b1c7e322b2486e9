/* test_lexer.c - tokens, their places, and texts that are none. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "dsl/lexer.h"

/* A lexer over a string. */
typedef struct fixture {
    rt_sources sources;
    rt_reports reports;
    rt_lexer lexer;
    uint64_t order;
} fixture;

static void begin(fixture *f, const char *text)
{
    const char *cause = NULL;
    memset(f, 0, sizeof *f);
    rt_source *source = rt_sources_add(&f->sources, "text", NULL);
    assert_non_null(source);
    assert_int_equal(rt_source_copy(&f->sources, source, text, &cause), RT_OK);
    rt_lexer_begin(&f->lexer, source, &f->reports, &f->order);
}

static rt_token next_token(fixture *f)
{
    rt_token token;
    rt_lexer_next(&f->lexer, &token);
    return token;
}

static void end(fixture *f)
{
    rt_reports_free(&f->reports);
    rt_sources_free(&f->sources);
}

static void tokens_carry_their_place(void **state)
{
    static const struct {
        int kind, line, column, length, first_on_line, space_before;
    } expected[] = {
        {RT_TOKEN_WORD, 1, 1, 4, 1, 1},
        {'{', 1, 5, 1, 0, 0},
        {RT_TOKEN_WORD, 2, 2, 5, 1, 1},
        {'-', 2, 8, 1, 0, 1},
        {RT_TOKEN_NUMBER, 2, 9, 4, 0, 0},
        {RT_TOKEN_STRING, 3, 3, 5, 1, 1},
        {'}', 3, 10, 1, 0, 1},
        {RT_TOKEN_END, 4, 1, 0, 1, 1},
    };
    fixture f;
    uint64_t order = 0;
    (void)state;
    begin(&f, "film{ # comment\r\n\twidth -1e+2\n  \"a b\"  }\n");
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
        rt_token token = next_token(&f);
        assert_int_equal(token.kind, expected[i].kind);
        assert_int_equal(token.place.line, expected[i].line);
        assert_int_equal(token.place.column, expected[i].column);
        assert_int_equal(token.place.length, expected[i].length);
        assert_int_equal(token.first_on_line, expected[i].first_on_line);
        assert_int_equal(token.space_before, expected[i].space_before);
        assert_true(token.place.order > order);
        order = token.place.order;
    }
    assert_int_equal(f.reports.count, 0);
    end(&f);
}

static void the_end_repeats(void **state)
{
    fixture f;
    (void)state;
    begin(&f, " ");
    assert_int_equal(next_token(&f).kind, RT_TOKEN_END);
    assert_int_equal(next_token(&f).kind, RT_TOKEN_END);
    end(&f);
}

static void only_well_formed_utf8_is_text(void **state)
{
    static const struct {
        const char *comment;
        size_t errors;
    } cases[] = {
        {"# \xc3\xa9 \xe2\x82\xac \xf0\x9f\x98\x80", 0},
        {"# \x80", 1},             /* continuation alone */
        {"# \xc0\x80", 1},         /* overlong */
        {"# \xe0\x80\x80", 1},     /* overlong */
        {"# \xed\xa0\x80", 1},     /* surrogate */
        {"# \xf4\x90\x80\x80", 1}, /* beyond U+10FFFF */
        {"# \xf0\x9f\x98", 1},     /* cut short */
        {"# \xff ok \xfe", 2},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        fixture f;
        begin(&f, cases[i].comment);
        assert_int_equal(next_token(&f).kind, RT_TOKEN_END);
        assert_int_equal(f.reports.errors, cases[i].errors);
        end(&f);
    }
}

static void a_broken_number_is_one_token(void **state)
{
    static const char *const texts[] = {"1.2.3", "12abc", "1e",    "1e+",
                                        "0x1f",  "1_000", "1e999", "1e2.5"};
    (void)state;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        fixture f;
        begin(&f, texts[i]);
        rt_token token = next_token(&f);
        assert_int_equal(token.kind, RT_TOKEN_NUMBER);
        assert_true(token.is_broken);
        assert_int_equal(token.place.length, strlen(texts[i]));
        assert_int_equal(next_token(&f).kind, RT_TOKEN_END);
        assert_int_equal(f.reports.errors, 1);
        end(&f);
    }
}

static void an_open_string_ends_before_the_end_of_its_line(void **state)
{
    static const char *const texts[] = {"\"a b", "\"a b\nc", "\"a b\r\nc"};
    (void)state;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        fixture f;
        begin(&f, texts[i]);
        rt_token token = next_token(&f);
        assert_int_equal(token.kind, RT_TOKEN_STRING);
        assert_true(token.is_broken);
        assert_int_equal(token.place.length, strlen("\"a b"));
        assert_int_equal(f.reports.errors, 1);
        end(&f);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tokens_carry_their_place),
        cmocka_unit_test(the_end_repeats),
        cmocka_unit_test(only_well_formed_utf8_is_text),
        cmocka_unit_test(a_broken_number_is_one_token),
        cmocka_unit_test(an_open_string_ends_before_the_end_of_its_line),
    };
    return cmocka_run_group_tests_name("lexer", tests, NULL, NULL);
}
