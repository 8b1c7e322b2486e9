/* bsdf_draw.c - runs the kernels of bsdf.cl. */
#include "bsdf_draw.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "chance.h"
#include "shape/shapes.h"
#include "support.h"

#define PI 3.14159265358979323846

int is_diffuse(int event)
{
#define DIFFUSE_OF(NAME, name, is_delta, is_diffuse, is_large) is_diffuse,
    static const int of_lobe[] = {RT_LOBES(DIFFUSE_OF) 0};
    return of_lobe[event];
}

/* A scene of one shape and one material. */
typedef struct little_scene {
    rt_scene_header header;
    rt_shape shape;
    char to_row[RT_SCENE_ROW - sizeof(rt_shape) % RT_SCENE_ROW];
    rt_material_data material;
} little_scene;

static cl_mem scene_of(const rt_material_data *material)
{
    little_scene scene;
    memset(&scene, 0, sizeof scene);
    scene.header.shapes = offsetof(little_scene, shape) / RT_SCENE_ROW;
    scene.header.materials = offsetof(little_scene, material) / RT_SCENE_ROW;
    scene.shape.kind = RT_SHAPE_PLANE; /* u along x where its normal is z */
    scene.shape.transform = RT_NONE;
    scene.shape.p[6] = 1;
    scene.material = *material;
    return test_buffer(sizeof scene, &scene);
}

/* Runs a kernel of a program: count results of `size` bytes. */
static void scatter_by(const char *program, const char *name, const rt_material_data *material,
                       const situation *at, uint32_t transport, uint32_t seed, uint32_t count,
                       size_t size, void *out)
{
    seed = test_seed(seed);
    cl_kernel kernel = test_kernel(program, name);
    cl_mem scene = scene_of(material), s = test_buffer(sizeof *at, at);
    cl_mem made = test_buffer(count * size, NULL);
    rt_arg args[] = {RT_ARG(seed), RT_ARG(count),     RT_ARG(scene),
                     RT_ARG(s),    RT_ARG(transport), RT_ARG(made)};
    test_run(kernel, args, 6, count);
    test_read(made, count * size, out);
    rt_buffer_release(test_device(), scene);
    rt_buffer_release(test_device(), s);
    rt_buffer_release(test_device(), made);
    rt_kernel_release(kernel);
}

void draw_scatter(const rt_material_data *material, const situation *at, uint32_t transport,
                  uint32_t seed, uint32_t count, bsdf_draw *out)
{
    scatter_by("bsdf", "scatter", material, at, transport, seed, count, sizeof *out, out);
}

void draw_vertex_scatter(const rt_material_data *material, const situation *at, uint32_t transport,
                         uint32_t seed, uint32_t count, vertex_draw *out)
{
    scatter_by("vcm_vertex", "scatter", material, at, transport, seed, count, sizeof *out, out);
}

void draw_both_ways(const rt_material_data *material, const situation *at, uint32_t seed,
                    uint32_t count, both_ways *out)
{
    scatter_by("vcm_vertex", "both_ways", material, at, 0, seed, count, sizeof *out, out);
}

void draw_delta_ratios(const rt_material_data *material, const situation *at, uint32_t seed,
                       uint32_t count, delta_draw *out)
{
    scatter_by("vcm_vertex", "delta_ratios", material, at, 0, seed, count, sizeof *out, out);
}

void draw_exchange(const rt_material_data *material, const situation *at, uint32_t transport,
                   uint32_t seed, uint32_t count, exchange_draw *out)
{
    scatter_by("bsdf", "exchange", material, at, transport, seed, count, sizeof *out, out);
}

void draw_events(const rt_material_data *material, const situation *at, uint32_t seed,
                 uint32_t count, bsdf_event *out)
{
    const rt_u32 each = 16; /* events an item: what does not change is evaluated once */
    cl_kernel kernel = test_kernel("bsdf", "events");
    cl_mem scene = scene_of(material), s = test_buffer(sizeof *at, at);
    cl_mem made = test_output(count * sizeof *out, out);
    rt_arg args[] = {RT_ARG(seed),  RT_ARG(count), RT_ARG(each),
                     RT_ARG(scene), RT_ARG(s),     RT_ARG(made)};
    test_run(kernel, args, 6, (count + each - 1) / each);
    test_read(made, count * sizeof *out, out);
    rt_buffer_release(test_device(), scene);
    rt_buffer_release(test_device(), s);
    rt_buffer_release(test_device(), made);
    rt_kernel_release(kernel);
}

void evaluate_scatter(const rt_material_data *material, const situation *at, const float (*wi)[4],
                      uint32_t count, bsdf_value *out)
{
    cl_kernel kernel = test_kernel("bsdf", "evaluate");
    cl_mem scene = scene_of(material), s = test_buffer(count * sizeof *at, at);
    cl_mem w = test_buffer(count * sizeof *wi, wi), made = test_buffer(count * sizeof *out, NULL);
    rt_arg args[] = {RT_ARG(count), RT_ARG(scene), RT_ARG(s), RT_ARG(w), RT_ARG(made)};
    test_run(kernel, args, 5, count);
    test_read(made, count * sizeof *out, out);
    rt_buffer_release(test_device(), scene);
    rt_buffer_release(test_device(), s);
    rt_buffer_release(test_device(), w);
    rt_buffer_release(test_device(), made);
    rt_kernel_release(kernel);
}

void measure_albedo(const rt_material_data *material, const situation *at, uint32_t samples,
                    uint32_t count, bsdf_albedo *out)
{
    cl_kernel kernel = test_kernel("bsdf", "albedo");
    cl_mem scene = scene_of(material), s = test_buffer(count * sizeof *at, at);
    cl_mem made = test_buffer(count * sizeof *out, NULL);
    uint32_t seed = test_seed(0);
    rt_arg args[] = {RT_ARG(seed), RT_ARG(count),   RT_ARG(scene),
                     RT_ARG(s),    RT_ARG(samples), RT_ARG(made)};
    test_run(kernel, args, 6, count);
    test_read(made, count * sizeof *out, out);
    rt_buffer_release(test_device(), scene);
    rt_buffer_release(test_device(), s);
    rt_buffer_release(test_device(), made);
    rt_kernel_release(kernel);
}

void direction_at(float w[4], double z, double turn)
{
    const double r = sqrt(fmax(0, 1 - z * z));
    w[0] = (float)(r * cos(2 * PI * turn));
    w[1] = (float)(r * sin(2 * PI * turn));
    w[2] = (float)z;
    w[3] = 0;
}

situation situation_along(const float wo[4], float eta)
{
    situation s = {{0, 0, 1, 0}, {0, 0, 1, 0}, {0, 0, 0}, eta, {1, 1, 1}, 1};
    memcpy(s.wo, wo, sizeof s.wo);
    return s;
}

void spread_pair(float wo[4], float wi[4], int i)
{
    direction_at(wo, 0.02 + 0.98 * fmod(i * 0.7548776662466927, 1),
                 fmod(i * 0.5698402909980532, 1));
    direction_at(wi, 0.02 + 0.98 * fmod(i * 0.6180339887498949, 1),
                 fmod(i * 0.3819660112501051 * 7, 1));
}

void draw_lobe(const rt_material_data *material, const situation *at, uint32_t lobe, uint32_t seed,
               uint32_t count, lobe_draw *out)
{
    seed = test_seed(seed);
    cl_kernel kernel = test_kernel("bsdf", "sample_lobe");
    cl_mem scene = scene_of(material), s = test_buffer(sizeof *at, at);
    cl_mem made = test_buffer(count * sizeof *out, NULL);
    rt_arg args[] = {RT_ARG(seed), RT_ARG(count), RT_ARG(scene),
                     RT_ARG(s),    RT_ARG(lobe),  RT_ARG(made)};
    test_run(kernel, args, 6, count);
    test_read(made, count * sizeof *out, out);
    rt_buffer_release(test_device(), scene);
    rt_buffer_release(test_device(), s);
    rt_buffer_release(test_device(), made);
    rt_kernel_release(kernel);
}

void evaluate_lobe(const rt_material_data *material, const situation *at, const float (*wi)[4],
                   uint32_t lobe, uint32_t count, float (*out)[4])
{
    cl_kernel kernel = test_kernel("bsdf", "evaluate_lobe");
    cl_mem scene = scene_of(material), s = test_buffer(count * sizeof *at, at);
    cl_mem w = test_buffer(count * sizeof *wi, wi), made = test_buffer(count * sizeof *out, NULL);
    rt_arg args[] = {RT_ARG(count), RT_ARG(scene), RT_ARG(s),
                     RT_ARG(w),     RT_ARG(lobe),  RT_ARG(made)};
    test_run(kernel, args, 6, count);
    test_read(made, count * sizeof *out, out);
    rt_buffer_release(test_device(), scene);
    rt_buffer_release(test_device(), s);
    rt_buffer_release(test_device(), w);
    rt_buffer_release(test_device(), made);
    rt_kernel_release(kernel);
}
