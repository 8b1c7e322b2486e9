/*
 * no_effect.h - warnings of options that have no effect beside the others, which are probably
 * mistakes.
 */
#ifndef RTC_NO_EFFECT_H
#define RTC_NO_EFFECT_H

#include "options.h"
#include "outputs.h"
#include "rt.h"

/* options: those of the command line and of the scene; photon_map in them, if there is one. */
void no_effect_warn(const command_line *arguments, const rt_render_options *options,
                    const rt_scene *scene, const output_list *outputs);

#endif
