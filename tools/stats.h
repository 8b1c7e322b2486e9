/* stats.h - what a render did, for --stats. */
#ifndef RTC_STATS_H
#define RTC_STATS_H

#include "crew.h"
#include "options.h"

/* Prints it on stdout, one `name: value unit` a line. */
void stats_print(const rt_scene *scene, const rt_device *device, const rt_render_options *options,
                 const rt_film *film, const crew *crew, const command_line *arguments);

/* The same as one JSON object; null stands for what is not a finite number. */
void stats_print_json(const rt_scene *scene, const rt_device *device,
                      const rt_render_options *options, const rt_film *film, const crew *crew,
                      const command_line *arguments);

#endif
