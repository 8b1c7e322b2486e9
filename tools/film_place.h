/*
 * film_place.h - the folder in which a render was begun, which its film names: from there the
 * scene, the outputs and what else stands in its note are found.
 */
#ifndef RTC_FILM_PLACE_H
#define RTC_FILM_PLACE_H

#include "options.h"

/*
 * Goes to the folder that a film's note names, where the command line leaves the scene to the film,
 * and makes the paths of the command line absolute, which are those of the folder left. Stays where
 * the note names no folder, or none that is there: the film came from another machine, or its
 * folder was moved. Returns an exit status.
 */
int film_place_enter(command_line *arguments, const char *note);

/*
 * Whether an untrusted film may name a file to be read: below the current folder, and no other.
 */
int film_place_may_name(const char *path);

#endif
