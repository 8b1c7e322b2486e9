/* forecast.h - how long a reference will take, told before it is made. */
#ifndef RTC_STUDY_FORECAST_H
#define RTC_STUDY_FORECAST_H

#include "../progress.h"
#include "rt.h"

/*
 * Tells how long the reference of these options takes, and where it ends, by trial renders of more
 * and more samples that take a fraction of that.
 */
void forecast_tell(rt_renderer *renderer, progress_display *progress, const char *label,
                   const rt_render_options *reference);

#endif
