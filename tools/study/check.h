/* check.h - what is told of a study before its first picture, and of its references at the end. */
#ifndef RTC_STUDY_CHECK_H
#define RTC_STUDY_CHECK_H

#include "study.h"

/*
 * Reads every scene, and references that are files, before time is spent: settings that cannot be
 * and references of another size are errors, settings without effect in any picture are warnings.
 * Returns an exit status.
 */
int study_check(study *study, study_renderer *renderer, study_count *count);

/* Notes and warns where a reference is hardly more exact than the pictures that it measures. */
void study_warn_references(study *study);

#endif
