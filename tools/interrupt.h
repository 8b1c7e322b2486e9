/*
 * interrupt.h - what Ctrl-C, SIGTERM and SIGHUP (a lost connection) do: at once while nothing is
 * lost by it; later the first asks. The same again kills, and so does Ctrl-C with another. SIGQUIT
 * kills always. SIGXCPU, when CPU time is up, asks alone: it comes each second, until the system
 * kills.
 */
#ifndef RTC_INTERRUPT_H
#define RTC_INTERRUPT_H

/* Puts the signals off until interrupt_catch; for programs that start threads before. */
void interrupt_block(void);

/*
 * From now on these signals end the program at once with STATUS_INTERRUPTED, also where it waits
 * for a file or for stdin. One that was ignored when the program began stays ignored. What is said
 * of it is JSON if asked for, and nothing where quiet. Call it once, before any thread begins.
 */
void interrupt_catch(int in_json, int quiet);

/*
 * Between the two, what must not stay half done, such as a folder that is removed in the end: the
 * first of them ends the program at interrupt_release, and the next one at once. is_ending: whether
 * one came, so that there is no use in going on. For the thread that may call interrupt_catch.
 */
void interrupt_hold(void);
int interrupt_is_ending(void);
void interrupt_release(void);

/*
 * From now on the first of them only sets a flag, and the next one ends the program by its default
 * action.
 */
void interrupt_defer(void);

/*
 * Where one of them is ending the program, waits for that: what the end of the work says, whose
 * input may have ended with whoever sent the signal, is not the status then.
 */
void interrupt_let_end(void);

/* As the first of them does once they only set a flag. */
void interrupt_request(void);

/* Whether one came. */
int interrupt_pending(void);

#endif
