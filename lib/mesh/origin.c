/* origin.c - chooses the origin of a mesh, and measures what rounding does. */
#include "mesh/origin.h"

#include <math.h>

static const double far_away = 4;

int rt_mesh_origin(double origin[3], const double lo[3], const double hi[3])
{
    double size = 0, step = 1;
    int is_moved = 0, exponent;
    for (int i = 0; i < 3; i++)
        size = fmax(size, hi[i] - lo[i]);
    if (size > 0) {
        frexp(size, &exponent);
        step = ldexp(1, exponent);
    }
    for (int i = 0; i < 3; i++) {
        const double middle = 0.5 * (lo[i] + hi[i]);
        origin[i] = size > 0 && fabs(middle) > far_away * size ? step * round(middle / step) : 0;
        is_moved |= origin[i] != 0;
    }
    return is_moved;
}

static double distance(const double a[3], const double b[3])
{
    return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
                (a[2] - b[2]) * (a[2] - b[2]));
}

void rt_rounding_add(rt_rounding *rounding, const double exact[3][3], const double rounded[3][3])
{
    double edge = 0, moved = 0;
    for (int i = 0; i < 3; i++) {
        edge = fmax(edge, distance(exact[i], exact[(i + 1) % 3]));
        moved = fmax(moved, distance(exact[i], rounded[i]));
    }
    if (!(moved > RT_ROUNDING_MAX * edge) || !(edge > 0))
        return;
    rounding->triangles++;
    rounding->part = fmax(rounding->part, moved / edge);
    rounding->length = fmax(rounding->length, moved);
}
