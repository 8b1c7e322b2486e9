/*
 * The scenes that ship are good; cut short or damaged anywhere they are accepted or refused, never
 * worse.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>

#include "tests/dsl/collect.h"

static const char *const scenes[] = {"scenes/cornell.rts", "scenes/box_point.rts",
                                     "scenes/box_area.rts", "scenes/box_caustic.rts"};
#define SCENE_COUNT (sizeof scenes / sizeof *scenes)

static void the_scenes_that_ship_are_good(void **state)
{
    static collected c;
    (void)state;
    for (size_t i = 0; i < SCENE_COUNT; i++) {
        collect_file(&c, scenes[i]);
        expect_clean(&c, scenes[i]);
        rt_scene_info info;
        rt_scene_get_info(c.scene, &info);
        assert_true(info.has_camera && info.shapes >= 7 && info.lights == 1);
        collected_free(&c);
    }
}

/* Either a scene and no error, or errors, all with a place inside the text, and no scene. */
static void expect_an_answer(const char *text)
{
    static collected c;
    size_t length = strlen(text);
    collect_text(&c, text);
    assert_true(c.status == RT_OK || c.status == RT_ERROR_INPUT);
    assert_true((c.status == RT_OK) == (c.scene != NULL));
    assert_true((c.status == RT_OK) == (c.errors == 0));
    int line = 0, column = 0;
    for (int i = 0; i < c.count && i < COLLECTED_MAX; i++) {
        const collected_diagnostic *d = &c.items[i];
        assert_true(d->line >= 1 && d->column >= 1 && d->length >= 1 &&
                    (size_t)d->line <= length + 1);
        assert_true(d->message[0] != '\0' && strpbrk(d->message, "\r\n") == NULL);
        if (strcmp(d->file, "text") != 0)
            continue;
        if (d->line < line || (d->line == line && d->column < column))
            fail_msg("%d:%d: %s: out of order in:\n%s", d->line, d->column, d->message, text);
        line = d->line;
        column = d->column;
    }
    collected_free(&c);
}

static void cut_anywhere_a_scene_gives_an_answer(void **state)
{
    (void)state;
    for (size_t i = 0; i < SCENE_COUNT; i++) {
        char *text = read_text(scenes[i]);
        for (size_t length = strlen(text); length-- > 0;) {
            text[length] = '\0';
            expect_an_answer(text);
        }
        free(text);
    }
}

static void damaged_anywhere_a_scene_gives_an_answer(void **state)
{
    static const char bytes[] = "{}()[]+-*/=,;:\"#\n \t.0e\x01\x7f\x80\xc3\xff_azA$";
    char *text = read_text(scenes[0]);
    size_t length = strlen(text);
    uint32_t random = 1;
    (void)state;
    for (size_t at = 0; at < length; at++)
        for (int try = 0; try < 3; try++) {
            char kept = text[at];
            random = random * 1664525u + 1013904223u;
            text[at] = bytes[(random >> 8) % (sizeof bytes - 1)];
            expect_an_answer(text);
            text[at] = kept;
        }
    free(text);
}

/* Words of the language in any order. */
static void shuffled_words_give_an_answer(void **state)
{
    static const char *const words[] = {
        "sphere ", "{ ",      "} ",    "material ", "m ",     "centre ",  "0 ",
        "-1 ",     "- ",      "( ",    ") ",        "[ ",     "] ",       "let ",
        "= ",      "radius ", "\n",    "light ",    "point ", "include ", "\"x\" ",
        "kd ",     "render ", "mode ", "* ",        "a ",     ", ",       "1e999 "};
    char text[1024];
    uint32_t random = 7;
    (void)state;
    for (int i = 0; i < 30000; i++) {
        text[0] = '\0';
        for (int j = 0; j < 40; j++) {
            random = random * 1664525u + 1013904223u;
            strcat(text, words[(random >> 8) % (sizeof words / sizeof *words)]);
        }
        expect_an_answer(text);
    }
}

/* ---- Names that were chosen to share a slot ------------------------------------- */

enum { STEPS = 14, BLOCK = 4, NAME = STEPS * BLOCK, STATE_BITS = 18 };

/* A block of letters by its number. */
static void write_block(char out[BLOCK], uint32_t number)
{
    for (int i = 0; i < BLOCK; i++, number /= 26)
        out[i] = (char)('a' + number % 26);
}

/* The low bits of FNV-1a depend on low bits alone. */
static uint32_t hash_on(uint32_t state, const char block[BLOCK])
{
    for (int i = 0; i < BLOCK; i++)
        state = (state ^ (uint32_t)block[i]) * 0x1b3u & ((1u << STATE_BITS) - 1);
    return state;
}

/*
 * Two blocks for each step after which FNV-1a, from its usual start, has the same low bits: either
 * at each step makes 2^STEPS names (A. Joux: "Multicollisions in Iterated Hash Functions", 2004).
 */
static void find_blocks(char out[STEPS][2][BLOCK])
{
    static uint32_t seen[1 << STATE_BITS];
    uint32_t state = 0x84222325u & ((1u << STATE_BITS) - 1);
    for (int step = 0; step < STEPS; step++) {
        memset(seen, 0, sizeof seen);
        for (uint32_t number = 1;; number++) {
            write_block(out[step][1], number);
            const uint32_t next = hash_on(state, out[step][1]);
            if (seen[next]) {
                write_block(out[step][0], seen[next]);
                state = next;
                break;
            }
            seen[next] = number;
        }
    }
}

/* The seconds to read a scene of 2^STEPS constants: by those blocks, or by others. */
static double time_to_read(char blocks[STEPS][2][BLOCK], int has_others)
{
    static collected c;
    const size_t line = strlen("let ") + NAME + strlen(" = 1\n");
    char *text = malloc((line << STEPS) + 1), *at = text;
    assert_non_null(text);
    for (uint32_t number = 0; number < 1u << STEPS; number++) {
        memcpy(at, "let ", 4);
        for (int step = 0; step < STEPS; step++)
            memcpy(at + 4 + BLOCK * step, blocks[step][number >> step & 1], BLOCK);
        if (has_others)
            write_block(at + 4, number);
        memcpy(at + 4 + NAME, " = 1\n", 5);
        at += line;
    }
    *at = '\0';
    const clock_t start = clock();
    collect_text(&c, text);
    const double seconds = (double)(clock() - start) / CLOCKS_PER_SEC;
    assert_int_equal(c.errors, 1); /* there is no camera */
    collected_free(&c);
    free(text);
    return seconds;
}

static void names_cannot_be_chosen_to_take_long(void **state)
{
    static char blocks[STEPS][2][BLOCK];
    (void)state;
    find_blocks(blocks);
    const double others = time_to_read(blocks, 1), chosen = time_to_read(blocks, 0);
    if (chosen > 8 * others + 0.05)
        fail_msg("%g s for chosen names, %g s for others", chosen, others);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_scenes_that_ship_are_good),
        cmocka_unit_test(cut_anywhere_a_scene_gives_an_answer),
        cmocka_unit_test(damaged_anywhere_a_scene_gives_an_answer),
        cmocka_unit_test(shuffled_words_give_an_answer),
        cmocka_unit_test(names_cannot_be_chosen_to_take_long),
    };
    return cmocka_run_group_tests_name("robustness", tests, NULL, NULL);
}
