/* load.h - scenes of other programs, where one of the language is expected. */
#ifndef RT_DSL_IMPORT_LOAD_H
#define RT_DSL_IMPORT_LOAD_H

#include "rt.h"

/* rt_scene_load for a file that rt_path_is_foreign. */
rt_status rt_import_load(rt_scene **out, const char *path, const rt_load_options *options,
                         rt_error *error);

#endif
