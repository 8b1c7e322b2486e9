/* preview.h - --preview: a render that is looked at while it goes on. */
#ifndef RTC_PREVIEW_PREVIEW_H
#define RTC_PREVIEW_PREVIEW_H

#include "../options.h"
#include "board.h"
#include "rt.h"

typedef struct preview preview;

/*
 * Begins what --preview asks for, and says where it is: *out is NULL without the option. Returns an
 * exit status. scene: what the pictures are called. is_watched: renders follow each other. The
 * caller owns *out.
 */
int preview_open(preview **out, const command_line *arguments, const char *scene, int is_watched);

/* These take NULL, and do nothing then. */

/* A render with these options begins, whose pictures are shown enlarged; sets their callbacks. */
void preview_begin(preview *preview, rt_render_options *options, uint32_t scale, uint32_t width,
                   uint32_t height);
void preview_progress(preview *preview, const rt_progress *progress);
void preview_set_phase(preview *preview, board_phase phase);

/* Takes away what was said of the render before. */
void preview_clear_messages(preview *preview);

/* Shows a finished film, all its layers. */
void preview_show(preview *preview, const rt_film *film);

/*
 * Tells how the command ended, by its exit status, waits a little until the last picture has
 * arrived, and ends.
 */
void preview_end(preview *preview, int status);

#endif
