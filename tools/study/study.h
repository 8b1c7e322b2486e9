/* study.h - one study: a sweep, its pictures, and what was measured of them. */
#ifndef RTC_STUDY_STUDY_H
#define RTC_STUDY_STUDY_H

#include "cell.h"
#include "page.h"

/* It must stay where it is: its result points to its sweep. */
typedef struct study {
    const command_line *arguments;
    sweep sweep;
    const char *scene; /* NULL where it is swept */
    study_renderer *renderer;
    study_result result;
    rt_image *reference;
    double mean;   /* of it */
    char time[32]; /* of each picture, in equal time */
} study;

/*
 * Reads what a command line asks for, which must outlive it. Returns an exit status; free in either
 * case.
 */
int study_begin(study *out, const command_line *arguments);

/* Renders and measures all pictures. Returns an exit status. */
int study_run(study *study, study_renderer *renderer);

void study_free(study *study);

#endif
