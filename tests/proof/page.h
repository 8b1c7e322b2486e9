/*
 * page.h - tests/proof/README.md, the table of what was compared, with a section for each program.
 *
 * Where RT_PROOF_ROWS names a file, as `make proof` does, a program adds its section to that file.
 * Otherwise it fails unless the page's section holds the same rows, but for what was measured: the
 * page says what is tested, no more and no less.
 */
#ifndef RT_TESTS_PROOF_PAGE_H
#define RT_TESTS_PROOF_PAGE_H

/*
 * A row of the section: the cells that every machine must agree on, and those that were measured,
 * each with bars between and none at the ends.
 */
void page_row(const char *stated, const char *measured);

/* The section, of that title and these columns, has all rows. */
void page_section(const char *title, const char *columns);

#endif
