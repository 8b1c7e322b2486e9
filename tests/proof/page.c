/* page.c - collects rows, and writes or checks a section of the page. */
#include "proof/page.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "support.h"

#define PAGE "tests/proof/README.md"

enum { rows_max = 128, cells_size = 512 };

/* Of each entry, what every machine must agree on, and what was measured. */
static struct {
    char stated[cells_size], measured[cells_size];
} rows[rows_max];
static int row_count;

void page_row(const char *stated, const char *measured)
{
    assert_true(row_count < rows_max);
    assert_in_range(snprintf(rows[row_count].stated, cells_size, "- %s", stated), 0,
                    cells_size - 1);
    assert_in_range(snprintf(rows[row_count].measured, cells_size, "%s", measured), 0,
                    cells_size - 1);
    row_count++;
}

static void write_section(const char *path, const char *title)
{
    FILE *file = fopen(path, "a");
    assert_non_null(file);
    fprintf(file, "\n## %s\n\n", title);
    for (int i = 0; i < row_count; i++)
        fprintf(file, "%s %s\n", rows[i].stated, rows[i].measured);
    assert_int_equal(fclose(file), 0);
}

/* The page's section of that title, up to the next one; free it. */
static char *read_section(const char *title)
{
    static const size_t size_max = 1 << 20;
    char heading[128], *page = calloc(size_max, 1);
    FILE *file = fopen(PAGE, "r");
    if (!file)
        fail_msg("there is no " PAGE "; make proof writes it");
    assert_non_null(page);
    assert_true(fread(page, 1, size_max - 1, file) > 0);
    fclose(file);
    snprintf(heading, sizeof heading, "\n## %s\n", title);
    char *section = strstr(page, heading);
    if (!section)
        fail_msg(PAGE " has no section '%s'; make proof writes it", title);
    section += strlen(heading);
    char *end = strstr(section, "\n## ");
    if (end)
        end[1] = '\0';
    memmove(page, section, strlen(section) + 1);
    return page;
}

static void expect_section(const char *title)
{
    char *section = read_section(title);
    int lines = 0, missing = 0;
    for (const char *line = section; (line = strstr(line, "\n- ")) != NULL; line++)
        lines++;
    for (int i = 0; i < row_count; i++) {
        if (!strstr(section, rows[i].stated)) {
            print_error(PAGE " lacks: %s\n", rows[i].stated);
            missing++;
        }
    }
    free(section);
    if (missing || lines != row_count)
        fail_msg(PAGE ", '%s': %d entries for %d checks, %d missing; make proof writes it anew",
                 title, lines, row_count, missing);
}

int page_is_written(void)
{
    return getenv("RT_PROOF_ROWS") != NULL;
}

void page_section(const char *title)
{
    const char *path = getenv("RT_PROOF_ROWS");
    assert_true(row_count > 0);
    if (path)
        write_section(path, title);
    else
        expect_section(title);
}
