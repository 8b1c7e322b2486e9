/* other_work.h - films and photon maps that would be overwritten, and that hold other work. */
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

/* Fails where an output is a film that is there and has what `film` has not. */
int other_work_check_film(const output_list *outputs, const rt_film *film,
                          const command_line *arguments);

/* The same of a photon map, before it is emitted and when it is made of others. */
int other_work_check_emission(const char *path, rt_renderer *renderer,
                              const rt_emit_options *options, const command_line *arguments);
int other_work_check_map(const char *path, const rt_photon_map *map, const command_line *arguments);

#endif
