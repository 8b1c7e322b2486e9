/* report.h - the errors and warnings of a scene text, collected, ordered and handed on. */
#ifndef RT_DSL_REPORT_H
#define RT_DSL_REPORT_H

#include "dsl/names.h"

#define RT_REPORTS_MAX 1000 /* errors, reading stops there; and warnings, others are left out */

#if defined(__GNUC__)
#define RT_REPORT_PRINTF(string, first) __attribute__((format(printf, string, first)))
#else
#define RT_REPORT_PRINTF(string, first)
#endif

/* One thing to say. */
typedef struct rt_report {
    rt_severity severity;
    rt_finding_kind finding;
    rt_place place;
    size_t sequence; /* orders reports of one place */
    char message[320];
    char hint[320];
    const rt_names *table; /* the error is a name unknown here, unless NULL */
} rt_report;

/* All of a scene. All zero is none. */
typedef struct rt_reports {
    rt_report *items;
    size_t count, capacity;
    size_t errors, warnings;
    size_t left_out;   /* warnings beyond RT_REPORTS_MAX */
    int is_left_out;   /* the latest was */
    int out_of_memory; /* reading stops */
} rt_reports;

/* Adds an error, or a warning, at a place. */
void rt_report_error(rt_reports *reports, rt_place place, const char *format, ...)
    RT_REPORT_PRINTF(3, 4);
void rt_report_warning(rt_reports *reports, rt_place place, const char *format, ...)
    RT_REPORT_PRINTF(3, 4);

/* Adds what rt_scene_check found. */
void rt_report_finding(rt_reports *reports, rt_place place, const rt_finding *finding);

/* Gives the latest report a hint: the nearest known name, or a way out. */
void rt_report_hint(rt_reports *reports, const char *format, ...) RT_REPORT_PRINTF(2, 3);

/*
 * Says that the latest error is a name missing in this table, in case it is defined further down.
 */
void rt_report_unknown(rt_reports *reports, const rt_names *table);

/* Whether reading must stop: too many errors, or no memory. */
int rt_reports_full(const rt_reports *reports);

/*
 * Orders the reports by place and passes each to the callback of options (may be NULL). Returns
 * RT_OK when there is no error; otherwise fills *error (may be NULL) with the first and the number
 * of others.
 */
rt_status rt_reports_finish(rt_reports *reports, const rt_load_options *options, rt_error *error);

void rt_reports_free(rt_reports *reports);

#endif
