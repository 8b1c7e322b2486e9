/*
 * commands.h - the subcommands of rtc. Each carries out its work, says what goes wrong, and returns
 * the exit status.
 */
#ifndef RTC_COMMANDS_H
#define RTC_COMMANDS_H

#include "options.h"

int command_render(const command_line *arguments);
int command_check(const command_line *arguments);
int command_mesh(const command_line *arguments);
int command_devices(const command_line *arguments);
int command_doctor(const command_line *arguments);
int command_kernels(const command_line *arguments);
int command_import(const command_line *arguments);
int command_fmt(const command_line *arguments);
int command_study(const command_line *arguments);
int command_paths(const command_line *arguments);
int command_photons(const command_line *arguments);
int command_compare(const command_line *arguments);
int command_merge(const command_line *arguments);
int command_info(const command_line *arguments);

#endif
