/*
 * settings.h - the options that are settings of a render: their names, ranges and help stand in
 * rt/setting.h. The option of the setting max_depth is --max-depth; one that is true or false takes
 * no value, and --no-aov stands for false.
 */
#ifndef RTC_SETTINGS_H
#define RTC_SETTINGS_H

#include "options.h"
#include "rt.h"

/* The setting of an option's name, without its dashes, or NULL. */
const rt_setting *settings_find(const char *name, size_t length);

/* Whether it is true or false, so that no value follows. */
int settings_is_switch(const rt_setting *setting);

/* Whether a command takes it. */
int settings_is_taken(const rt_setting *setting, command_id command);

/* Room for a help text, that of a setting or of one of its words. */
#define SETTING_HELP_SIZE 768

/* The option's name without its dashes, "max-depth". Returns out. */
#define SETTING_NAME_SIZE 64
const char *settings_name(char out[SETTING_NAME_SIZE], const rt_setting *setting);

/* Whether it says how photons are found around points. */
int settings_finds_photons(const rt_setting *setting);

/* The name of the value in messages and in the help; NULL of a switch. */
const char *settings_value_name(const rt_setting *setting);

/* The heading of the help that it stands under. */
option_group settings_group(const rt_setting *setting);

/*
 * Notes the value of a setting, which must be one that it takes; of a switch "true" or "false".
 * Returns the exit status.
 */
int settings_read(command_line *out, const rt_setting *setting, const char *text);

/* What is given of a setting, as typed; NULL when it is not given. */
const char *settings_text(const command_line *arguments, const rt_setting *setting);

/* Whether it is given, and not as a switch that is off. */
int settings_is_requested(const command_line *arguments, const rt_setting *setting);

/* Sets what the command line gives, but `except`, which may be NULL. */
void settings_apply(const command_line *arguments, rt_render_options *options,
                    const rt_setting *except);

#endif
