/*
 * The reference page: it has every block and field as the tables of the language say, and its
 * examples are right.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "dsl/function.h"
#include "dsl/schema.h"
#include "tests/dsl/collect.h"

#define REFERENCE "dsl/reference.md"
#define FENCE "```rts\n"

/* "| `fov` | a number | between ... | degrees | 45 |": how the page begins a field's row. */
static void field_row(char row[1024], const rt_field *field)
{
    char phrase[RT_PHRASE_SIZE], range[RT_PHRASE_SIZE], cell[3][RT_PHRASE_SIZE + 2];
    const char *contents[3];
    contents[0] = rt_range_phrase(range, field->range);
    contents[1] = field->unit;
    contents[2] = field->need == RT_NEED_REQUIRED ? "required" : field->fallback;
    for (int i = 0; i < 3; i++)
        snprintf(cell[i], sizeof cell[i], "%s%s", contents[i], contents[i][0] ? " " : "");
    snprintf(row, 1024, "| `%s` | %s | %s| %s| %s| ", field->name, rt_field_phrase(phrase, field),
             cell[0], cell[1], cell[2]);
}

static void every_block_and_field_is_described(void **state)
{
    char *page = read_text(REFERENCE);
    int missing = 0;
    (void)state;
    for (size_t i = 0; i < RT_BLOCK_COUNT; i++) {
        const rt_block *block = &rt_blocks[i];
        char heading[128], title[RT_BLOCK_TITLE_SIZE], row[1024];
        snprintf(heading, sizeof heading, "\n## `%s`\n", rt_block_title(title, block));
        const char *section = strstr(page, heading);
        if (!section)
            fail_msg("no section %s", title);
        const char *end = strstr(section + 1, "\n## ");
        for (size_t j = 0; j < block->field_count; j++) {
            field_row(row, &block->fields[j]);
            const char *found = strstr(section, row);
            if (found && (!end || found < end))
                continue;
            print_error("the section %s has no row %s\n", title, row);
            missing++;
        }
    }
    assert_int_equal(missing, 0);
    free(page);
}

static void every_kernel_is_described(void **state)
{
    char *page = read_text(REFERENCE);
    const rt_field *kernel = rt_schema_field(&rt_blocks[RT_BLOCK_RENDER], (rt_text){"kernel", 6});
    (void)state;
    for (size_t i = 0; kernel->choices[i]; i++) {
        char row[128];
        snprintf(row, sizeof row, "| `%s` | ", kernel->choices[i]);
        assert_non_null(strstr(page, row));
    }
    free(page);
}

/* Every function stands in the page's table, with its arguments. */
static void every_function_is_described(void **state)
{
    char *page = read_text(REFERENCE);
    (void)state;
    for (int i = 0; i < RT_FUNCTION_COUNT; i++) {
        char call[32];
        snprintf(call, sizeof call, "`%s(", rt_functions[i].name);
        const char *found = strstr(page, call);
        assert_non_null(found);
        assert_int_equal(strcspn(found, ",") < strcspn(found, ")"), rt_functions[i].arguments == 2);
    }
    free(page);
}

static void every_example_is_a_good_scene(void **state)
{
    static collected c;
    char *page = read_text(REFERENCE), *at = page;
    int examples = 0;
    (void)state;
    while ((at = strstr(at, FENCE)) != NULL) {
        char *text = at + strlen(FENCE), *end = strstr(text, "\n```");
        assert_non_null(end);
        end[1] = '\0';
        collect_text(&c, text);
        for (int i = 0; i < c.count; i++)
            if (c.items[i].severity == RT_SEVERITY_ERROR)
                fail_msg("line %d of an example: %s\n%s", c.items[i].line, c.items[i].message,
                         text);
        assert_int_equal(c.status, RT_OK);
        collected_free(&c);
        examples++;
        at = end + 2;
    }
    assert_true(examples > RT_BLOCK_COUNT);
    free(page);
}

static int has_its_size(const rt_field *field)
{
    switch (field->type) {
    case RT_FIELD_PAIR:
        return field->size == 2 * sizeof(float);
    case RT_FIELD_VECTOR:
    case RT_FIELD_COLOUR:
        return field->size == 3 * sizeof(float);
    case RT_FIELD_FILE:
        return field->size == sizeof(char *);
    case RT_FIELD_TRANSLATE:
    case RT_FIELD_ROTATE:
    case RT_FIELD_SCALE:
    case RT_FIELD_MATRIX:
        return field->size == sizeof(rt_transform);
    case RT_FIELD_NUMBER:
    case RT_FIELD_INTEGER:
        return field->size == 4 || field->size == 8;
    default:
        return field->size == 4;
    }
}

static void the_tables_are_sound(void **state)
{
    (void)state;
    for (size_t i = 0; i < RT_BLOCK_COUNT; i++) {
        const rt_block *block = &rt_blocks[i];
        assert_int_equal(block->id, i);
        assert_true(block->field_count <= RT_BLOCK_FIELDS_MAX);
        for (size_t j = 0; j < block->field_count; j++) {
            const rt_field *field = &block->fields[j];
            assert_true(field->offset + field->size <= sizeof(rt_block_fields));
            assert_true(has_its_size(field));
            assert_true((field->type == RT_FIELD_CHOICE) == (field->choices != NULL));
            assert_true((field->need == RT_NEED_REQUIRED) == (field->fallback[0] == '\0'));
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_block_and_field_is_described),
        cmocka_unit_test(every_kernel_is_described),
        cmocka_unit_test(every_function_is_described),
        cmocka_unit_test(every_example_is_a_good_scene),
        cmocka_unit_test(the_tables_are_sound),
    };
    return cmocka_run_group_tests_name("reference", tests, NULL, NULL);
}
