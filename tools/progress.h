/* progress.h - how far a long call has come, on stderr. */
#ifndef RTC_PROGRESS_H
#define RTC_PROGRESS_H

#include "options.h"
#include "rt.h"

/* What was shown last. Begin with progress_begin; it needs no destruction. */
typedef struct progress_display {
    progress_style style; /* never PROGRESS_AUTO */
    int redraw;           /* one line, redrawn */
    int drawn;            /* a line without its newline stands on the terminal */
    int started;          /* the members below are set */
    rt_stage stage;
    int ended;       /* the end of the stage was shown */
    double shown_at; /* seconds of the stage */
} progress_display;

progress_display progress_begin(progress_style style);

/* Shows it on a terminal alone, if at all. */
progress_display progress_begin_on_terminal(int is_wanted);

/* Shows a report when it is time to. */
void progress_show(progress_display *progress, const rt_progress *report);

/* Takes the redrawn line away, before anything else is printed. */
void progress_clear(progress_display *progress);

/* "1:23", "2:03:04" or, under ten seconds, "3.2 s". */
void progress_format_time(char *out, size_t size, double seconds);

#endif
