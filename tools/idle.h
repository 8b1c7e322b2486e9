/* idle.h - warnings of options that change nothing in a render, which are probably mistakes. */
#ifndef RTC_IDLE_H
#define RTC_IDLE_H

#include "options.h"
#include "outputs.h"
#include "rt.h"

/* options: those of the command line and of the scene; photon_map in them, if there is one. */
void idle_warn(const command_line *arguments, const rt_render_options *options,
               const output_list *outputs);

#endif
