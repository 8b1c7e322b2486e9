/* watch.h - --watch: waits until one of the files that a scene is made of changes. */
#ifndef RTC_WATCH_H
#define RTC_WATCH_H

#include "options.h"

typedef struct watch watch;

/*
 * Whether a render of these options can be watched, whose outputs have so many films; says why not.
 * Returns an exit status.
 */
int watch_check(const command_line *arguments, const char *scene, size_t films);

/* Returns an exit status. The caller owns *out; watch_close takes NULL. */
int watch_open(watch **out);
void watch_close(watch *watch);

/* Forgets the files so far. */
void watch_begin(watch *watch);

/*
 * Notes a file, as it is now, before it is read; it need not be there yet. One that cannot be noted
 * is not watched.
 */
void watch_add(watch *watch, const char *path);

/* Whether one of them is another since it was noted; without waiting. */
int watch_has_changed(watch *watch);

/*
 * Waits for a change, and then until the files have been at rest for a moment: editors write in
 * steps. Ends at an interrupt too.
 */
void watch_wait(watch *watch);

#endif
