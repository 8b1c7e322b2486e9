/* edges.c - the geometry of emissive triangles and quads. */
#include "shape/edges.h"

#include <math.h>

/* Edges whose cosine is below this are at right angles, to the precision of float32. */
static const double right_angle = 1e-6;

void rt_light_set_edges(rt_light_data *light, const double b[3], const double c[3])
{
    double width = sqrt(b[0] * b[0] + b[1] * b[1] + b[2] * b[2]);
    double height = sqrt(c[0] * c[0] + c[1] * c[1] + c[2] * c[2]);
    double normal[3] = {b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2],
                        b[0] * c[1] - b[1] * c[0]};
    double length = sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
    double cosine = (b[0] * c[0] + b[1] * c[1] + b[2] * c[2]) / (width * height);

    /* A triangle without area has no power and is never chosen. */
    for (int i = 0; i < 3 && length > 0; i++) {
        light->b[i] = (float)(b[i] / width);
        light->c[i] = (float)(c[i] / height);
        light->normal[i] = (float)(normal[i] / length);
    }
    light->width = (float)width;
    light->height = (float)height;
    if (light->kind == RT_LIGHT_QUAD && fabs(cosine) < right_angle)
        light->flags |= RT_LIGHT_RECTANGLE;
    if (light->texture == RT_NONE && !(light->flags & RT_LIGHT_CUTOUT))
        light->flags |= RT_LIGHT_PLAIN;
}
