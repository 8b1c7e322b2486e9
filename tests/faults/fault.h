/*
 * fault.h - failure injection: the calls in calls.inc.h, made from the objects of this program, can
 * be told to fail. Those that libraries and drivers make among themselves go on as ever.
 */
#ifndef RT_TESTS_FAULT_H
#define RT_TESTS_FAULT_H

/*
 * Counts calls from now on. The n-th fails, from 1; 0: none does. Where `for_good`, so do all after
 * it.
 */
void fault_arm(long n, int for_good);

/* The errno of an fsync() that fails: EIO until this is called. */
void fault_fail_sync_with(int code);

/* Kills this process before the n-th call from now on. */
void fault_kill_at(long n);

/* Ends that. Returns how many calls there were. */
long fault_disarm(void);

/* The name of the first call that failed since fault_arm, or NULL. */
const char *fault_fired(void);

/* Blocks of memory that were allocated by such calls and not freed. */
long fault_live(void);

/* From now on the clocks that are read are so many seconds ahead, or behind. */
void fault_shift_clocks(long seconds);

#endif
