/* sky.c - makes a sky, and computes its radiance and density. */
#include "statistics/sky.h"

#include <string.h>

#include "image/image_file.h"
#include "kernels/light_draw.h"
#include "statistics/space.h"

enum { width = sky_width, height = sky_height };

static const double rotation = 100; /* degrees */

double sky_texel(int x, int y)
{
    if (y == 5)
        return 0;
    if ((x == 6 && y == 2) || (x == 15 && y == 6))
        return 40;
    return 0.2 + (x * 7 + y * 13) % 11 / 10.0;
}

const char *sky_write_picture(void)
{
    static const char file[] = "sky.pfm";
    static const char *const names[] = {"R", "G", "B"};
    rt_image *image = NULL;
    rt_error error;
    expect_ok(rt_image_create(&image, width, height, names, 3, &error), &error);
    for (int i = 0; i < 3 * width * height; i++)
        image->data[i] = (float)sky_texel(i / 3 % width, i / 3 / width);
    expect_ok(rt_image_write(image, file, NULL, &error), &error);
    rt_image_destroy(image);
    return file;
}

rt_scene *sky_scene(int has_picture)
{
    static const float centre[3] = SKY_SPHERE_CENTRE;
    rt_scene *scene = light_scene();
    rt_environment environment = {.radiance = {1, 1, 1}, .rotation = (float)rotation};
    rt_surface surface;
    rt_error error;
    memset(&surface, 0, sizeof surface);
    if (has_picture)
        environment.path = sky_write_picture();
    expect_ok(rt_scene_add_sphere(scene, NULL, centre, (float)SKY_SPHERE_RADIUS, &surface, &error),
              &error);
    expect_ok(rt_scene_set_environment(scene, &environment, &error), &error);
    return scene;
}

void sky_place(const float w[3], double *u, double *v)
{
    *u = 0.5 + turns_of(-w[2], w[0]) + rotation / 360;
    *u -= floor(*u);
    *v = acos(fmax(-1, fmin(1, w[1]))) / PI;
}

double sky_element(double v)
{
    return 2 * PI * PI * sin(PI * v);
}

/*
 * Between the centres of pixels of which row y counts by[y], bilinear; over the seam, but not over
 * the poles.
 */
static double between(const double by[height], double u, double v)
{
    const double px = u * width - 0.5, py = v * height - 0.5;
    const int i = (int)floor(px), j = (int)floor(py);
    double sum = 0;
    for (int dy = 0; dy < 2; dy++)
        for (int dx = 0; dx < 2; dx++) {
            const int x = (i + dx + width) % width, y = (int)fmax(0, fmin(height - 1, j + dy));
            sum += sky_texel(x, y) * by[y] * (1 - fabs(px - i - dx)) * (1 - fabs(py - j - dy));
        }
    return sum;
}

double sky_density(int has_picture, double u, double v)
{
    double sines[height];
    if (!has_picture)
        return 0.5 * PI * sin(PI * v);
    for (int y = 0; y < height; y++)
        sines[y] = sin(PI * (y + 0.5) / height);
    return between(sines, u, v);
}

double sky_radiance(int has_picture, double u, double v)
{
    static const double ones[height] = {1, 1, 1, 1, 1, 1, 1, 1};
    return has_picture ? between(ones, u, v) : 1;
}
