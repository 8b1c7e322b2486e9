/* page.h - the rows of tests/proof/README.md; see proof_page. */
#ifndef RT_TESTS_PROOF_PAGE_H
#define RT_TESTS_PROOF_PAGE_H

/* One check. The texts may be gone later. */
typedef struct page_row {
    const char *scene, *by, *truth;
    double expected, ours, error, off; /* off: in standard errors */
    int is_measured;                   /* `expected` was rendered too, and pixels were compared: */
    double worst_off;                  /* the farthest of so many numbers of the film */
    int count;
} page_row;

void page_add(page_row row);

#endif
