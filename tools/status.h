/* status.h - the exit statuses of rtc; `rtc --help` lists them. */
#ifndef RTC_STATUS_H
#define RTC_STATUS_H

enum {
    STATUS_DONE = 0,
    STATUS_INPUT = 1,  /* the scene or an input file is wrong */
    STATUS_USAGE = 2,  /* the command line is wrong */
    STATUS_DEVICE = 3, /* OpenCL or the device fails, or memory runs out */
    STATUS_OUTPUT = 4, /* an output could not be written */
    STATUS_INTERRUPTED = 130
};

#endif
