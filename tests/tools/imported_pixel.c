/* imported_pixel.c - what an imported scene of one pixel shows, and images to show. */
#include "tools/imported_pixel.h"

#include <stdio.h>

#include "lib/image/scratch.h"
#include "support.h"

void write_one_pixel(const char *name, int width, int height, int column, int row)
{
    char text[4096];
    int size = sprintf(text, "P3 %d %d 255\n", width, height);
    for (int i = 0; i < width * height; i++)
        size += sprintf(text + size, i == row * width + column ? "255 255 255\n" : "0 0 0\n");
    scratch_write(name, text);
}

void imported_colour(const char *file, double rgb[3])
{
    rt_scene *scene = NULL;
    rt_renderer *renderer = NULL;
    rt_film *film = NULL;
    rt_render_options options;
    rt_error error;
    expect_ok(rt_scene_import(&scene, "t.rts", file, NULL, &error), &error);
    rt_scene_get_options(scene, &options);
    assert_true(options.width == 1 && options.height == 1);
    options.spp = 1;
    expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
    expect_ok(rt_render(&film, renderer, &options, &error), &error);
    for (int c = 0; c < 3; c++)
        rgb[c] = rt_film_rgb(film)[c];
    rt_film_destroy(film);
    rt_renderer_destroy(renderer);
    rt_scene_destroy(scene);
}

double imported_pixel(const char *file)
{
    double rgb[3];
    imported_colour(file, rgb);
    return rgb[0];
}
