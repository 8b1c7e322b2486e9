/* options.h - the options of a render, checked and completed by the table of settings. */
#ifndef RT_LIB_SETTING_OPTIONS_H
#define RT_LIB_SETTING_OPTIONS_H

#include "rt.h"

/*
 * Whether each option is in its range and goes with the others. Fails with RT_ERROR_USAGE,
 * error->field naming the setting.
 */
rt_status rt_options_check(const rt_render_options *options, rt_error *error);

/* Puts the defaults where zero stands for them. */
void rt_options_complete(rt_render_options *options);

/* Whether a mode shows light, and not a property of surfaces. */
int rt_mode_shows_light(rt_mode mode);

#endif
