/* scenes.c - scenes that several tests share. */
#include "lib/scene/scenes.h"

#include <string.h>

#include "support.h"

rt_scene *new_scene(void)
{
    rt_material grey = {.kd = {0.5f, 0.5f, 0.5f}};
    rt_scene *scene = NULL;
    rt_error error;
    expect_ok(rt_scene_create(&scene, &error), &error);
    expect_ok(rt_scene_add_material(scene, NULL, "grey", &grey, &error), &error);
    return scene;
}

void expect_refused(rt_status status, const rt_error *error, const char *field)
{
    assert_int_equal(status, RT_ERROR_INPUT);
    assert_int_equal(error->status, RT_ERROR_INPUT);
    assert_string_equal(error->field, field);
    assert_true(error->message[0] != '\0' && !strchr(error->message, '\n'));
}
