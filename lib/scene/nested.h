/* nested.h - textures with other textures inside, as rows that kernels evaluate (nested.c). */
#ifndef RT_LIB_SCENE_NESTED_H
#define RT_LIB_SCENE_NESTED_H

#include "scene/scene.h"

/* Whether a texture has others inside, or is made of two colours as such are. */
int rt_texture_is_nested(const rt_texture *texture);

/*
 * Makes such a texture of what is inside it; texture->data: its own map, wrap and axis. Writes its
 * rows to the end of scene->texture_rows, which count only once texture_row_count says so. Fails
 * with RT_ERROR_INPUT, error->field naming the member, and with RT_ERROR_MEMORY.
 */
rt_status rt_texture_nest(rt_scene *scene, rt_scene_texture *texture, const rt_texture *from,
                          rt_error *error);

#endif
