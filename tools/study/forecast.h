/* forecast.h - how long a reference will take, told before it is made. */
#ifndef RTC_STUDY_FORECAST_H
#define RTC_STUDY_FORECAST_H

#include "cell.h"

/*
 * Tells how long the reference of these options takes, in the scene that is ready, and where it
 * ends, by trial renders of more and more samples that take a fraction of that.
 */
void forecast_tell(const study_renderer *renderer, const char *label,
                   const rt_render_options *reference);

#endif
