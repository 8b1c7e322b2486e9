/* mesh_shape.c - the meshes that `rtc mesh` makes from formulas. */
#include "mesh_shape.h"

#include <math.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

const char *const mesh_kind_names[MESH_KIND_COUNT] = {[MESH_SPHERE] = "sphere",
                                                      [MESH_TORUS] = "torus",
                                                      [MESH_KNOT] = "knot",
                                                      [MESH_TERRAIN] = "terrain"};

/* The angle of a turn from 0 to 1, at 1 exactly that at 0: the surface closes to the bit. */
static double turn_angle(double turn)
{
    return turn < 1 ? 2 * pi * turn : 0;
}

static mesh_point sphere(double u, double v)
{
    double longitude = turn_angle(u), height = -cos(pi * v);
    /* The poles are one point each. */
    double radius = v > 0 && v < 1 ? sin(pi * v) : 0;
    mesh_point p = {{radius * cos(longitude), height, radius * sin(longitude)}, {0, 0, 0}};
    memcpy(p.normal, p.position, sizeof p.normal);
    return p;
}

/*
 * A torus around the y axis, of radii major and minor, at the angles around the axis and around the
 * tube.
 */
static mesh_point torus_at(double major, double minor, double around, double tube)
{
    double radius = major + minor * cos(tube);
    mesh_point p = {{radius * cos(around), minor * sin(tube), radius * sin(around)},
                    {cos(tube) * cos(around), sin(tube), cos(tube) * sin(around)}};
    return p;
}

static mesh_point torus(double u, double v)
{
    return torus_at(0.7, 0.3, turn_angle(u), turn_angle(v));
}

/*
 * The curve lies on a torus, whose normal is thus at right angles to the curve's direction T. N,
 * that normal, and B = T x N are a frame that closes after one round; the tube is the curve + r
 * (cos N + sin B).
 */
static mesh_point knot(double u, double v)
{
    const double major = 0.58, minor = 0.28, tube = 0.13;
    const int turns = 2, windings = 3;
    double t = turn_angle(u), around = turns * t, winding = windings * t, angle = turn_angle(v);
    mesh_point c = torus_at(major, minor, around, winding);

    /* T = dc/dt. */
    double radius = major + minor * cos(winding), shrink = -windings * minor * sin(winding);
    double T[3] = {shrink * cos(around) - turns * radius * sin(around),
                   windings * minor * cos(winding),
                   shrink * sin(around) + turns * radius * cos(around)};
    double length = sqrt(T[0] * T[0] + T[1] * T[1] + T[2] * T[2]);
    const double *N = c.normal;
    double B[3] = {(T[1] * N[2] - T[2] * N[1]) / length, (T[2] * N[0] - T[0] * N[2]) / length,
                   (T[0] * N[1] - T[1] * N[0]) / length};

    mesh_point p;
    for (int i = 0; i < 3; i++) {
        p.normal[i] = cos(angle) * N[i] + sin(angle) * B[i];
        p.position[i] = c.position[i] + tube * p.normal[i];
    }
    return p;
}

/*
 * A sum of plane waves, each shorter and lower than the one before, in directions a golden angle
 * apart.
 */
static mesh_point terrain(double u, double v)
{
    double x = 2 * u - 1, z = 1 - 2 * v, height = 0, slope_x = 0, slope_z = 0;
    double amplitude = 0.16, frequency = 2.3;
    for (int i = 0; i < 6; i++) {
        double direction = 2.39996322972865332 * i, along_x = cos(direction),
               along_z = sin(direction);
        double phase = frequency * (x * along_x + z * along_z) + 1.7 * i;
        height += amplitude * sin(phase);
        slope_x += amplitude * frequency * along_x * cos(phase);
        slope_z += amplitude * frequency * along_z * cos(phase);
        amplitude *= 0.5;
        frequency *= 1.9;
    }
    double length = sqrt(slope_x * slope_x + 1 + slope_z * slope_z);
    mesh_point p = {{x, height, z}, {-slope_x / length, 1 / length, -slope_z / length}};
    return p;
}

mesh_point mesh_shape_point(mesh_kind kind, double u, double v)
{
    switch (kind) {
    case MESH_SPHERE:
        return sphere(u, v);
    case MESH_TORUS:
        return torus(u, v);
    case MESH_KNOT:
        return knot(u, v);
    case MESH_TERRAIN:
    case MESH_KIND_COUNT:
        break;
    }
    return terrain(u, v);
}

/* How much longer the surface is along u than along v. */
static double aspect(mesh_kind kind)
{
    static const double aspects[MESH_KIND_COUNT] = {
        [MESH_SPHERE] = 2, [MESH_TORUS] = 0.7 / 0.3, [MESH_KNOT] = 11, [MESH_TERRAIN] = 1};
    return aspects[kind];
}

mesh_grid mesh_grid_plan(mesh_kind kind, uint64_t triangles)
{
    mesh_grid grid = {.kind = kind};
    double cells = (double)triangles / 2;
    double rows = floor(sqrt(cells / aspect(kind)) + 0.5);
    grid.rows = rows < 3 ? 3 : (uint64_t)rows;
    /* The sphere has one row of triangles less: one of each cell at the poles. */
    uint64_t full = kind == MESH_SPHERE ? grid.rows - 1 : grid.rows;
    double columns = floor(cells / (double)full + 0.5);
    grid.columns = columns < 3 ? 3 : (uint64_t)columns;
    grid.vertices = (grid.columns + 1) * (grid.rows + 1);
    grid.triangles = 2 * grid.columns * full;
    return grid;
}

int mesh_grid_cell(const mesh_grid *grid, uint64_t column, uint64_t row, uint32_t triangles[2][3])
{
    uint32_t a = (uint32_t)(row * (grid->columns + 1) + column), b = a + 1;
    uint32_t c = a + (uint32_t)grid->columns + 1, d = c + 1;
    int south = grid->kind == MESH_SPHERE && row == 0,
        north = grid->kind == MESH_SPHERE && row + 1 == grid->rows;
    /* Of the sphere, torus and knot, u x v points inwards; of the terrain, up. */
    int turned = grid->kind != MESH_TERRAIN, count = 0;
    if (!south) {
        const uint32_t t[3] = {a, turned ? d : b, turned ? b : d};
        memcpy(triangles[count++], t, sizeof t);
    }
    if (!north) {
        const uint32_t t[3] = {a, turned ? c : d, turned ? d : c};
        memcpy(triangles[count++], t, sizeof t);
    }
    return count;
}
