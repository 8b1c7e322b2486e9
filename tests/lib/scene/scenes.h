/* scenes.h - what the tests of scenes share. */
#ifndef RT_TESTS_LIB_SCENE_SCENES_H
#define RT_TESTS_LIB_SCENE_SCENES_H

#include "rt.h"

/* A fresh scene with one grey material, index 0. */
rt_scene *new_scene(void);

/* A call must have failed with RT_ERROR_INPUT, naming the field, in one line. */
void expect_refused(rt_status status, const rt_error *error, const char *field);

#endif
