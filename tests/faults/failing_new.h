/* failing_new.h - C++'s operator new fails at one call, for programs that link failing_new.o. */
#ifndef RT_TESTS_FAULTS_FAILING_NEW_H
#define RT_TESTS_FAULTS_FAILING_NEW_H

#ifdef __cplusplus
extern "C" {
#endif

/*
 * From now on the call of that number fails, counted from 1 and over all threads; 0: none does.
 * Others do not.
 */
void failing_new_at(unsigned call);

/* Whether it has failed. */
int failing_new_failed(void);

/* Blocks that were allocated and not freed, in the whole program. */
long failing_new_blocks(void);

#ifdef __cplusplus
}
#endif

#endif
