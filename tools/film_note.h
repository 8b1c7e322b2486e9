/*
 * film_note.h - what rtc keeps in a film besides its settings: the scene and the options of the
 * command line that made it, so that a film can be continued without them.
 */
#ifndef RTC_FILM_NOTE_H
#define RTC_FILM_NOTE_H

#include "options.h"

/* The note of a render: rt_render_options.note. The caller frees it; NULL without memory. */
char *film_note_make(const command_line *arguments, const char *scene);

/*
 * Gives the options that a film was rendered with, where the command line gives no others, and the
 * scene where there is no operand. *text receives what they point to, which the caller frees after
 * *arguments. Returns an exit status.
 */
int film_note_give(command_line *arguments, char **text, const rt_film *film);

/* The same with the note as a text of the caller's, which outlives *arguments and is changed. */
int film_note_give_text(command_line *arguments, char *note);

/* The value of a line of a film's note, such as "scene", up to its newline; its length, or 0. */
size_t film_note_find(const char **value, const rt_film *film, const char *name);

#endif
