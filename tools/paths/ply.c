/* ply.c - the paths of a pixel as a PLY file of lines, in text. */
#include <math.h>

#include "../interrupt.h"
#include "../status.h"
#include "write.h"

/* What an edge is. */
enum edge { EDGE_PATH, EDGE_LIGHT, EDGE_OCCLUDED };

static double distance(const float a[3], const float b[3])
{
    const double x = (double)a[0] - b[0], y = (double)a[1] - b[1], z = (double)a[2] - b[2];
    return sqrt(x * x + y * y + z * z);
}

/* How far from the camera the farthest vertex is; 1 where there is none. */
static double reach_of(const pixel_paths *pixel)
{
    double reach = 0;
    const float *camera = NULL;
    for (size_t i = 0; i < pixel->vertex_count; i++) {
        const rt_path_vertex *v = pixel->vertices + i;
        if (v->event == RT_PATH_CAMERA)
            camera = v->position;
        else if (camera && v->event != RT_PATH_ESCAPED)
            reach = fmax(reach, distance(camera, v->position));
    }
    return reach > 0 ? reach : 1;
}

/* Whether a light was sampled from a vertex, so that it has a line of its own. */
static int has_light(const rt_path_vertex *v)
{
    return v->light != RT_NONE;
}

static void put_point(FILE *out, const double p[3], const float throughput[3], uint32_t sample,
                      unsigned event)
{
    fprintf(out, "%.9g %.9g %.9g %.9g %.9g %.9g %u %u\n", p[0], p[1], p[2], throughput[0],
            throughput[1], throughput[2], sample, event);
}

/* `at` from a point in a direction. */
static void along(double out[3], const float from[3], const float direction[3], double at)
{
    for (int c = 0; c < 3; c++)
        out[c] = from[c] + at * direction[c];
}

/* The vertices of all paths, in their order, and then the sampled points of lights. */
static void put_points(FILE *out, const pixel_paths *pixel, double reach)
{
    static const float none[3] = {0, 0, 0};
    for (int lights = 0; lights < 2; lights++)
        for (size_t i = 0; i < pixel->path_count && !interrupt_pending(); i++) {
            const rt_camera_path *path = pixel->paths + i;
            const rt_path_vertex *v = pixel->vertices + path->first_vertex;
            for (uint32_t j = 0; j < path->vertex_count; j++, v++) {
                double p[3];
                if (lights && !has_light(v))
                    continue;
                if (lights && v->flags & RT_PATH_LIGHT_DISTANT)
                    along(p, v->position, v->light_position, reach);
                else if (lights)
                    along(p, v->light_position, none, 0);
                else if (v->event == RT_PATH_ESCAPED)
                    along(p, v[-1].position, v->position, reach);
                else
                    along(p, v->position, none, 0);
                put_point(out, p, lights ? v->direct : v->throughput, path->sample,
                          lights ? RT_PATH_CAMERA : v->event);
            }
        }
}

static void put_edges(FILE *out, const pixel_paths *pixel)
{
    size_t light = pixel->vertex_count;
    for (size_t i = 0; i < pixel->path_count && !interrupt_pending(); i++) {
        const rt_camera_path *path = pixel->paths + i;
        for (uint32_t j = 0; j < path->vertex_count; j++) {
            const size_t at = (size_t)path->first_vertex + j;
            const rt_path_vertex *v = pixel->vertices + at;
            if (j > 0)
                fprintf(out, "%zu %zu %d\n", at - 1, at, EDGE_PATH);
            if (has_light(v))
                fprintf(out, "%zu %zu %d\n", at, light++,
                        v->flags & RT_PATH_LIGHT_OCCLUDED ? EDGE_OCCLUDED : EDGE_LIGHT);
        }
    }
}

int paths_write_ply(const pixel_paths *pixel, text_file *file)
{
    FILE *out = file->stream;
    size_t lights = 0;
    for (size_t i = 0; i < pixel->vertex_count; i++)
        lights += (size_t)has_light(pixel->vertices + i);
    fprintf(out,
            "ply\nformat ascii 1.0\n"
            "comment camera paths of pixel %u,%u; edges: 0 path, 1 light that arrives, 2 light "
            "that something hides\n"
            "element vertex %zu\n"
            "property float x\nproperty float y\nproperty float z\n"
            "property float throughput_red\nproperty float throughput_green\n"
            "property float throughput_blue\nproperty uint sample\nproperty uchar event\n"
            "element edge %zu\n"
            "property int vertex1\nproperty int vertex2\nproperty uchar kind\n"
            "end_header\n",
            pixel->x, pixel->y, pixel->vertex_count + lights,
            pixel->vertex_count - pixel->path_count + lights);
    put_points(out, pixel, reach_of(pixel));
    put_edges(out, pixel);
    return STATUS_DONE;
}
