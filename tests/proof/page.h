/*
 * page.h - tests/proof/README.md, the list of what was compared, with a section for each program.
 *
 * Where RT_PROOF_ROWS names a file, as `make proof` does, a program adds its section to that file.
 * Otherwise it fails unless the page's section holds the same entries, but for what was measured:
 * the page says what is tested, no more and no less.
 */
#ifndef RT_TESTS_PROOF_PAGE_H
#define RT_TESTS_PROOF_PAGE_H

/*
 * An entry of the section: what every machine must agree on, and behind it what was measured. A
 * line of the page has at most 100 columns; a new one begins with two spaces.
 */
void page_row(const char *stated, const char *measured);

/* Whether RT_PROOF_ROWS is set: a test may take more samples then. */
int page_is_written(void);

/* The section of that title has all entries. */
void page_section(const char *title);

#endif
