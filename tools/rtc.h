/* rtc.h - what the parts of the command share: its subcommands and its exit statuses. */
#ifndef RTC_RTC_H
#define RTC_RTC_H

#include "options.h"

/* Exit statuses; `rtc --help` lists them. */
enum {
    STATUS_DONE = 0,
    STATUS_INPUT = 1,  /* the scene or an input file is wrong */
    STATUS_USAGE = 2,  /* the command line is wrong */
    STATUS_DEVICE = 3, /* OpenCL or the device fails, or memory runs out */
    STATUS_OUTPUT = 4, /* an output could not be written */
    STATUS_INTERRUPTED = 130
};

/* Each carries out one subcommand, says what goes wrong, and returns the exit status. */
int command_render(const command_line *arguments);
int command_check(const command_line *arguments);
int command_mesh(const command_line *arguments);
int command_devices(const command_line *arguments);
int command_doctor(const command_line *arguments);
int command_photons(const command_line *arguments);
int command_compare(const command_line *arguments);

#endif
