/* interrupt.h - Ctrl-C and SIGTERM: the first asks, the second kills. */
#ifndef RTC_INTERRUPT_H
#define RTC_INTERRUPT_H

/*
 * From now on the first SIGINT or SIGTERM only sets a flag, and the next one ends the program by
 * its default action. A signal that was ignored when the program began stays ignored.
 */
void interrupt_catch(void);

/* Whether one came. */
int interrupt_pending(void);

#endif
