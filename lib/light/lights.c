#include "light/lights.h"

#include <math.h>
#include <string.h>

#include "scene/check.h"

static const double pi = 3.14159265358979323846;

/* Edges whose cosine is below this are at right angles, to the precision of float32. */
static const double right_angle = 1e-6;

static double mean(const float c[3])
{
    return ((double)c[0] + c[1] + c[2]) / 3;
}

size_t rt_lights_count(const rt_scene *scene)
{
    size_t count = scene->point_light_count;
    for (size_t i = 0; i < scene->shape_count; i++) {
        float radiance[3];
        rt_scene_shape_radiance(scene, scene->shapes + i, radiance);
        if (!rt_is_black(radiance))
            count += rt_scene_shape_primitives(scene->shapes + i);
    }
    return count;
}

static void fill_point(rt_light_data *light, const rt_point_light *from)
{
    memset(light, 0, sizeof *light);
    light->kind = RT_LIGHT_POINT;
    light->prim = RT_NONE;
    memcpy(light->a, from->position, sizeof light->a);
    memcpy(light->emission, from->intensity, sizeof light->emission);
    light->power = (float)(4 * pi * mean(from->intensity));
}

/* Splits the two edges into direction and length, and adds what follows from them. */
static void fill_edges(rt_light_data *light, const double b[3], const double c[3])
{
    double width = sqrt(b[0] * b[0] + b[1] * b[1] + b[2] * b[2]);
    double height = sqrt(c[0] * c[0] + c[1] * c[1] + c[2] * c[2]);
    double normal[3] = {b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0]};
    double length = sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
    double cosine = (b[0] * c[0] + b[1] * c[1] + b[2] * c[2]) / (width * height);

    for (int i = 0; i < 3; i++) {
        light->b[i] = (float)(b[i] / width);
        light->c[i] = (float)(c[i] / height);
        light->normal[i] = (float)(normal[i] / length);
    }
    light->width = (float)width;
    light->height = (float)height;
    if (light->kind == RT_LIGHT_QUAD && fabs(cosine) < right_angle)
        light->flags |= RT_LIGHT_RECTANGLE;
}

static void fill_geometry(rt_light_data *light, const rt_scene_shape *shape, size_t primitive)
{
    double b[3], c[3];
    if (shape->kind == RT_SHAPE_SPHERE) {
        light->kind = RT_LIGHT_SPHERE;
        memcpy(light->a, shape->p, sizeof light->a);
        light->width = shape->p[3];
        return;
    }
    if (shape->kind == RT_SHAPE_QUAD) {
        light->kind = RT_LIGHT_QUAD;
        memcpy(light->a, shape->p, sizeof light->a);
        for (int i = 0; i < 3; i++) {
            b[i] = shape->p[3 + i];
            c[i] = shape->p[6 + i];
        }
    } else {
        const uint32_t *corner = shape->indices + 3 * primitive;
        const float *v0 = shape->positions + 3 * (size_t)corner[0];
        light->kind = RT_LIGHT_TRIANGLE;
        memcpy(light->a, v0, sizeof light->a);
        for (int i = 0; i < 3; i++) {
            b[i] = (double)shape->positions[3 * (size_t)corner[1] + i] - v0[i];
            c[i] = (double)shape->positions[3 * (size_t)corner[2] + i] - v0[i];
        }
    }
    fill_edges(light, b, c);
}

/* One emitting primitive: power = pi radiance area, on one side or both. */
static void fill_area(rt_light_data *light, const rt_scene *scene, const rt_scene_shape *shape, size_t primitive,
                      const float radiance[3])
{
    int two_sided = scene->materials[shape->surface.material].two_sided;
    double area = rt_scene_primitive_area(shape, primitive);

    memset(light, 0, sizeof *light);
    light->flags = two_sided ? RT_LIGHT_TWO_SIDED : 0;
    fill_geometry(light, shape, primitive);
    light->area = (float)area;
    memcpy(light->emission, radiance, sizeof light->emission);
    light->power = (float)(pi * mean(radiance) * area * (two_sided ? 2 : 1));
}

/* Makes the probabilities of choice from the powers. */
static double normalise(rt_light_data *lights, size_t count)
{
    double total = 0, sum = 0;
    for (size_t i = 0; i < count; i++)
        total += lights[i].power;
    for (size_t i = 0; i < count && total > 0; i++) {
        sum += lights[i].power;
        lights[i].pmf = (float)(lights[i].power / total);
        lights[i].cdf = (float)(sum / total);
    }
    /* Rounding must not leave a gap above the last light that can be chosen. */
    for (size_t i = count; i > 0 && total > 0; i--) {
        lights[i - 1].cdf = 1;
        if (lights[i - 1].pmf > 0)
            break;
    }
    return total;
}

double rt_lights_fill(const rt_scene *scene, const rt_u32 *first_prim, rt_light_data *lights, rt_u32 *first_light)
{
    size_t count = 0;
    for (size_t i = 0; i < scene->point_light_count; i++)
        fill_point(lights + count++, scene->point_lights + i);
    for (size_t i = 0; i < scene->shape_count; i++) {
        const rt_scene_shape *shape = scene->shapes + i;
        float radiance[3];
        first_light[i] = RT_NONE;
        rt_scene_shape_radiance(scene, shape, radiance);
        if (rt_is_black(radiance))
            continue;
        first_light[i] = (rt_u32)count;
        for (size_t k = 0; k < rt_scene_shape_primitives(shape); k++) {
            fill_area(lights + count, scene, shape, k, radiance);
            lights[count++].prim = first_prim[i] + (rt_u32)k;
        }
    }
    return normalise(lights, count);
}
