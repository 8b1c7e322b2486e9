/* list.h - a list of studies in a file, which together make one page. */
#ifndef RTC_STUDY_LIST_H
#define RTC_STUDY_LIST_H

#include "../options.h"

/* A study of the list. */
typedef struct listed_study {
    char *id, *title, *text;
    char **words; /* argv of its command line, `rtc study ...` */
    size_t word_count;
    command_line arguments;
} listed_study;

typedef struct study_list {
    char *title; /* of the page */
    listed_study *studies;
    size_t count;
} study_list;

/*
 * Reads a list, UTF-8 text: `= TITLE` is that of the page, `== ID TITLE` begins a study, `$ SCENE
 * --sweep ...` is what `rtc study` is given, `$full` and `$quick` what it is given besides as the
 * list is read in full or quickly, `#` begins a comment, and other lines are the text of the study.
 * What comes later goes before what came earlier. Returns an exit status; free in either case.
 */
int study_list_read(study_list *out, const char *path, int is_quick);
void study_list_free(study_list *list);

/* Takes away all studies but the one of this name. Returns an exit status. */
int study_list_keep(study_list *list, const char *id);

#endif
