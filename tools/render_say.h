/* render_say.h - what is said of a render that is over. */
#ifndef RTC_RENDER_SAY_H
#define RTC_RENDER_SAY_H

#include "render_job.h"

/* Which files were written, and of how many samples. */
void render_say_written(const render_job *job, int interrupted);

/* What is known of the picture's error, and whether it is what was asked for. */
void render_say_error(const render_job *job);

/* That an interrupt came too early, and what would have helped. */
void render_say_nothing(const rt_render_options *options);

/* What of the picture is not there, and how to go on. */
void render_say_left(const render_job *job);

#endif
