/* page.h - a study as a page for browsers, one file without need of any other, and as a table. */
#ifndef RTC_STUDY_PAGE_H
#define RTC_STUDY_PAGE_H

#include <math.h>
#include <stddef.h>

#include "rt.h"
#include "sweep.h"

/* What is added to the square of the reference in relMSE, as in rt_comparison_info. */
#define STUDY_RELMSE_FLOOR 0.01

/* One picture of a study, and what was measured of it; not a number: unknown. */
typedef struct study_cell {
    char *command;    /* that makes it; owned */
    uint32_t *pixels; /* [height][width], see page.c; owned; NULL: none */
    uint32_t width, height;
    double seconds;
    double rmse; /* over the mean of the reference; of a reference, as it was estimated */
    double relmse, flip, ratio;
    /* of the root of relmse, which the squares of both add up to; noise of a reference: its own */
    double noise, bias;
    const char *leaves_out; /* light that its mode does not find; static storage; NULL: none */
    /* of a reference: its own error is in errors, and in biases, that are measured by it */
    int is_coarse, hides_bias;
    double target;  /* the error that it was to have, if it has another; 0 */
    uint32_t limit; /* the samples a pixel at which it ended for that */
} study_cell;

#define STUDY_CELL_UNKNOWN                                                                         \
    ((study_cell){.seconds = NAN,                                                                  \
                  .rmse = NAN,                                                                     \
                  .relmse = NAN,                                                                   \
                  .flip = NAN,                                                                     \
                  .ratio = NAN,                                                                    \
                  .noise = NAN,                                                                    \
                  .bias = NAN})

typedef struct study_result {
    const char *id, *title, *text;
    const sweep *axes;
    study_cell *cells;      /* [sweep_cells(axes)] */
    study_cell *references; /* [views], one for each view; see view.h */
    size_t views;           /* 0: there is no reference */
    const size_t *view;     /* [sweep_cells(axes)], of each cell */
} study_result;

/* Makes the pixels of a cell from a picture [height][width][3]; 0 without memory. */
int study_cell_set_pixels(study_cell *cell, const float *rgb, uint32_t width, uint32_t height);
void study_cell_free(study_cell *cell);

/* Each writes a file whole or not at all, and returns an exit status. */
int page_write(const char *path, const char *title, const study_result *studies, size_t count);
int table_write(const char *path, const study_result *study);

#endif
