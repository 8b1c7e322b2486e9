/* other_work.h - films that a render would overwrite, and that hold other work. */
#ifndef RTC_OTHER_WORK_H
#define RTC_OTHER_WORK_H

#include "options.h"
#include "outputs.h"
#include "rt.h"

/*
 * Fails where an output of a render is a film that is there and is of another scene, other settings
 * or another part. The film of --resume may be overwritten, and one that cannot be read. The
 * renderer is that of the render. Returns an exit status.
 */
int other_work_check(const output_list *outputs, rt_renderer *renderer,
                     const rt_render_options *options, const command_line *arguments);

#endif
