/* study.h - one study: a sweep, its pictures, and what was measured of them. */
#ifndef RTC_STUDY_STUDY_H
#define RTC_STUDY_STUDY_H

#include "cell.h"
#include "page.h"
#include "view.h"

/* It must stay where it is: its result points to its sweep. */
typedef struct study {
    const command_line *arguments;
    sweep sweep;
    const char *scene; /* NULL where it is swept */
    int is_listed;     /* one of a list; its id is that there */
    uint32_t repeats;  /* renders of each picture */
    study_renderer *renderer;
    study_result result;
    sweep views;
    study_view *references; /* [views], of result.views */
    size_t *view_of;        /* [cells] */
    char time[32];          /* of each picture, in equal time */
} study;

/* How far all studies of a page have come. */
typedef struct study_count {
    size_t done, all; /* pictures, references among them */
    /* of references [1] and of other pictures [0]: those to come, those rendered now and not
     * before, and how long these took */
    size_t left[2], rendered[2];
    double seconds[2];
    double at; /* session_seconds of the latest */
} study_count;

/*
 * Reads what a command line asks for, which must outlive it. Returns an exit status; free in either
 * case.
 */
int study_begin(study *out, const command_line *arguments);

/* Adds the pictures of a study to those to come. */
void study_announce(const study *study, study_count *count);

/* Makes sure of the reference of a combination, where there is one. Returns an exit status. */
int study_find_reference(study *study, size_t index, study_count *count);

/* Renders and measures all pictures. Returns an exit status. */
int study_run(study *study, study_renderer *renderer, study_count *count);

void study_free(study *study);

#endif
