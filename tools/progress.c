/* progress.c - shows progress on stderr. */
#include "progress.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Seconds between two lines, two redrawings and two JSON lines of one stage. */
static const double plain_interval = 1.0, redraw_interval = 0.1, json_interval = 0.1;

/* A kernel build that takes longer is worth a word. */
static const double notable_compile = 0.5;

static int stderr_is_terminal(void)
{
    const char *term = getenv("TERM");
    return isatty(STDERR_FILENO) && term && strcmp(term, "dumb") != 0;
}

progress_display progress_begin(progress_style style)
{
    progress_display progress = {0};
    progress.style = style == PROGRESS_AUTO ? PROGRESS_PLAIN : style;
    progress.redraw = style == PROGRESS_AUTO && stderr_is_terminal();
    return progress;
}

progress_display progress_begin_on_terminal(int is_wanted)
{
    return progress_begin(is_wanted && stderr_is_terminal() ? PROGRESS_AUTO : PROGRESS_NONE);
}

void progress_format_time(char *out, size_t size, double seconds)
{
    if (seconds < 9.95) {
        snprintf(out, size, "%.1f s", seconds > 0.0 ? seconds : 0.0);
        return;
    }
    /* Beyond a hundred years it is no estimate. */
    unsigned long whole = seconds < 3e9 ? (unsigned long)(seconds + 0.5) : 3000000000ul;
    if (whole < 3600)
        snprintf(out, size, "%lu:%02lu", whole / 60, whole % 60);
    else
        snprintf(out, size, "%lu:%02lu:%02lu", whole / 3600, whole / 60 % 60, whole % 60);
}

static void show_text(progress_display *progress, const rt_progress *report)
{
    char elapsed[32], remaining[32] = "?";
    int compiling = report->stage == RT_STAGE_COMPILE && report->fraction < 1.0;
    progress_format_time(elapsed, sizeof elapsed, report->elapsed);
    if (report->remaining >= 0.0)
        progress_format_time(remaining, sizeof remaining, report->remaining);
    fprintf(stderr, "%s%-7s %3d %%  elapsed %s", progress->redraw ? "\r" : "",
            rt_stage_name(report->stage), (int)(report->fraction * 100.0), elapsed);
    if (report->fraction < 1.0)
        fprintf(stderr, "  remaining %s", remaining);
    if (report->error >= 0.0)
        fprintf(stderr, "  error %.3g %%", 100.0 * report->error);
    /* A build that the driver has cached is over before this is reached. */
    if (compiling && report->elapsed >= notable_compile) {
        if (report->steps > 0)
            fprintf(stderr, "  %u of %u program%s compiled (first run)", (unsigned)report->step,
                    (unsigned)report->steps, report->steps == 1 ? "" : "s");
        else
            fputs("  compiling kernels (first run)", stderr);
    }
    fputs(progress->redraw ? "\033[K" : "\n", stderr);
    progress->drawn = progress->redraw;
    fflush(stderr);
}

static void show_json(const rt_progress *report)
{
    fprintf(stderr, "{\"stage\":\"%s\",\"fraction\":%.4f,\"elapsed\":%.3f,\"remaining\":",
            rt_stage_name(report->stage), report->fraction, report->elapsed);
    if (report->remaining >= 0.0)
        fprintf(stderr, "%.3f", report->remaining);
    else
        fputs("null", stderr);
    if (report->error >= 0.0)
        fprintf(stderr, ",\"error\":%.6g}\n", report->error);
    else
        fputs(",\"error\":null}\n", stderr);
}

/*
 * Whether a report is to be shown: the end of a stage, its start, or enough time since the last
 * one.
 */
static int is_due(const progress_display *progress, const rt_progress *report, int is_new)
{
    int is_json = progress->style == PROGRESS_JSON;
    double interval = is_json ? json_interval : progress->redraw ? redraw_interval : plain_interval;
    if (report->fraction >= 1.0)
        return !progress->ended;
    /* Plain lines leave the start of a stage out. */
    if (is_new)
        return is_json || progress->redraw;
    return report->elapsed - progress->shown_at >= interval;
}

void progress_show(progress_display *progress, const rt_progress *report)
{
    if (progress->style == PROGRESS_NONE)
        return;
    int is_new = !progress->started || report->stage != progress->stage ||
                 report->elapsed < progress->shown_at;
    if (is_new) {
        progress->started = 1;
        progress->stage = report->stage;
        progress->ended = 0;
        progress->shown_at = 0.0;
    }
    if (!is_due(progress, report, is_new))
        return;
    progress->shown_at = report->elapsed;
    progress->ended = report->fraction >= 1.0;
    if (progress->style == PROGRESS_JSON)
        show_json(report);
    else
        show_text(progress, report);
}

void progress_clear(progress_display *progress)
{
    if (progress->drawn)
        fputs("\r\033[K", stderr);
    progress->drawn = 0;
    fflush(stderr);
}
