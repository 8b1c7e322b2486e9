/* compare.h - the parts of `rtc compare`: its limits, and its results on stdout. */
#ifndef RTC_COMPARE_H
#define RTC_COMPARE_H

#include "options.h"
#include "rt.h"

/* A limit that the command line may set on a measure. */
typedef struct compare_limit {
    option_id option;
    const char *measure; /* its name in the results */
    int is_least;        /* the measure must not be less; else not more */
} compare_limit;

enum { COMPARE_LIMITS = 7 };
extern const compare_limit compare_limits[COMPARE_LIMITS];

/* The value that a limit is set on. */
double compare_measured(const compare_limit *limit, const rt_comparison_info *info);

/* Whether a limit is given, and whether it is kept; what is not a number keeps none. */
int compare_given(const compare_limit *limit, const command_line *arguments);
double compare_allowed(const compare_limit *limit, const command_line *arguments);
int compare_kept(const compare_limit *limit, const command_line *arguments,
                 const rt_comparison_info *info);

/*
 * Prints what was measured: a line for each, or one JSON object; within is whether all limits are
 * kept.
 */
void compare_print_text(const rt_comparison *comparison, const command_line *arguments);
void compare_print_json(const rt_comparison *comparison, const command_line *arguments, int within);

#endif
