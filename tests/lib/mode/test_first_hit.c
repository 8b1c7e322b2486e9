/*
 * test_first_hit.c - the layers position, uv, shape and material on a scene whose first hits are
 * known, in every mode.
 */
#define _GNU_SOURCE /* RTLD_NEXT */
#include "support.h"

#include <dlfcn.h>
#include <math.h>
#include <string.h>

#include "image/image_file.h"
#include "lib/image/scratch.h"

enum { width = 16, height = 8, pixels = width * height };

static rt_error error;

/* Ids of what the camera sees from left to right; the material 0 is of neither. */
enum { quad_shape = 0, sphere_shape = 1, quad_material = 2, sphere_material = 1 };

/*
 * Seen along -z by parallel rays from z = 3, 4 m wide: on the left third a quad that rises from z =
 * 1 at the bottom to z = -1 at the top, on the right a sphere, and the sky between and around them.
 */
static rt_renderer *quad_and_sphere(void)
{
    static const float corner[3] = {-2, -1, 1}, x[3] = {1.25f, 0, 0}, y[3] = {0, 2, -2};
    static const float centre[3] = {1, 0, 0};
    static const rt_material m = {.kd = {0.5f, 0.3f, 0.1f}};
    rt_camera camera = {
        .kind = RT_CAMERA_ORTHOGRAPHIC, .eye = {0, 0, 3}, .look_at = {0, 0, 0}, .width = 4};
    rt_environment sky = {.radiance = {1, 1, 1}};
    rt_scene *scene = NULL;
    rt_renderer *renderer = NULL;
    rt_surface surface;
    uint32_t unused;
    memset(&surface, 0, sizeof surface);
    expect_ok(rt_scene_create(&scene, &error), &error);
    expect_ok(rt_scene_set_camera(scene, &camera, &error), &error);
    expect_ok(rt_scene_set_environment(scene, &sky, &error), &error);
    for (uint32_t i = 0; i < 3; i++)
        expect_ok(rt_scene_add_material(scene, &unused, NULL, &m, &error), &error);
    surface.material = quad_material;
    expect_ok(rt_scene_add_quad(scene, NULL, corner, x, y, &surface, &error), &error);
    surface.material = sphere_material;
    expect_ok(rt_scene_add_sphere(scene, NULL, centre, 0.75f, &surface, &error), &error);
    expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
    rt_scene_destroy(scene);
    return renderer;
}

/* The layers of a film. */
typedef struct first_hits {
    const float *position, *uv, *shape, *material, *depth;
} first_hits;

static first_hits layers_of(const rt_film *film)
{
    static const char *const names[] = {"position", "uv", "shape", "material", "depth"};
    static const uint32_t expected[] = {3, 2, 1, 1, 1};
    const float *layers[5];
    for (int i = 0; i < 5; i++) {
        uint32_t channels = 0;
        layers[i] = rt_film_layer(film, names[i], &channels);
        assert_non_null(layers[i]);
        assert_int_equal(channels, expected[i]);
    }
    return (first_hits){layers[0], layers[1], layers[2], layers[3], layers[4]};
}

static rt_film *render(rt_renderer *renderer, rt_mode mode, uint32_t spp)
{
    rt_render_options options = {
        .width = width, .height = height, .mode = mode, .spp = spp, .aov = 1, .photons = 1000};
    rt_film *film = NULL;
    expect_ok(rt_render(&film, renderer, &options, &error), &error);
    return film;
}

/* Of a pixel that sees the quad alone: the means are what its centre sees. */
static void expect_quad(const first_hits *f, int column, int row)
{
    int i = row * width + column;
    double x = -2 + 4 * (column + 0.5) / width, y = 1 - 2 * (row + 0.5) / height;
    assert_float_equal(f->position[3 * i], x, 0.01);
    assert_float_equal(f->position[3 * i + 1], y, 0.01);
    assert_float_equal(f->position[3 * i + 2], -y, 0.01);
    assert_float_equal(f->position[3 * i + 2], 3 - f->depth[i], 1e-4);
    assert_float_equal(f->uv[2 * i], (x + 2) / 1.25, 0.01);
    assert_float_equal(f->uv[2 * i + 1], (y + 1) / 2, 0.01);
    assert_true(f->shape[i] == quad_shape && f->material[i] == quad_material);
}

static void expect_miss(const first_hits *f, int column, int row)
{
    int i = row * width + column;
    for (int c = 0; c < 3; c++)
        assert_true(f->position[3 * i + c] == 0);
    assert_true(f->uv[2 * i] == 0 && f->uv[2 * i + 1] == 0);
    assert_true(f->shape[i] == -1 && f->material[i] == -1);
}

static void every_mode_has_the_layers_of_the_first_hit(void **state)
{
    rt_renderer *renderer = quad_and_sphere();
    (void)state;
    for (int mode = RT_MODE_PATH; mode <= RT_MODE_DEPTH; mode++) {
        rt_film *film = render(renderer, (rt_mode)mode, 64);
        first_hits f = layers_of(film);
        for (int row = 0; row < height; row++) {
            for (int column = 0; column < 5; column++)
                expect_quad(&f, column, row);
            expect_miss(&f, 7, row);
        }
        rt_film_destroy(film);
    }
    rt_renderer_destroy(renderer);
}

/* At the sphere's edge some samples hit: means are of those, and ids are never mixed. */
static void edges_have_means_of_hits_and_whole_ids(void **state)
{
    rt_renderer *renderer = quad_and_sphere();
    rt_film *film = render(renderer, RT_MODE_PATH, 64);
    first_hits f = layers_of(film);
    int edges = 0;
    (void)state;
    for (int i = 0; i < pixels; i++) {
        int hits = f.depth[i] > 0;
        assert_true(hits == (f.shape[i] != -1));
        assert_true(f.shape[i] == -1 ? f.material[i] == -1
                    : f.shape[i] == quad_shape
                        ? f.material[i] == quad_material
                        : f.shape[i] == sphere_shape && f.material[i] == sphere_material);
        if (hits)
            assert_float_equal(f.position[3 * i + 2], 3 - f.depth[i], 1e-4);
        edges += hits && i % width >= 9 && (i / width == 1 || i / width == 6);
    }
    assert_true(edges > 0);
    rt_film_destroy(film);
    rt_renderer_destroy(renderer);
}

/* With one sample a pixel each layer is that of one ray, which rt_trace follows too. */
static void one_sample_is_what_its_ray_hits(void **state)
{
    rt_renderer *renderer = quad_and_sphere();
    rt_film *film = render(renderer, RT_MODE_DIRECT, 1);
    first_hits f = layers_of(film);
    int spheres = 0;
    (void)state;
    for (int i = 0; i < pixels; i++) {
        const float *p = f.position + 3 * i;
        rt_ray ray = {{p[0], p[1], 3}, 0, {0, 0, -1}, HUGE_VALF};
        rt_hit hit;
        if (f.shape[i] == -1)
            continue;
        expect_ok(rt_trace(renderer, RT_TRACE_CLOSEST, &ray, 1, &hit, &error), &error);
        assert_int_equal(hit.shape, (int)f.shape[i]);
        assert_float_equal(hit.t, f.depth[i], 1e-4);
        assert_float_equal(hit.u, f.uv[2 * i], 1e-4);
        assert_float_equal(hit.v, f.uv[2 * i + 1], 1e-4);
        spheres += hit.shape == sphere_shape;
    }
    assert_true(spheres > 5);
    rt_film_destroy(film);
    rt_renderer_destroy(renderer);
}

static int cancel_at_once(void *user, const rt_progress *progress)
{
    (void)user;
    return progress->stage == RT_STAGE_RENDER && progress->fraction > 0;
}

static void interrupted_renders_have_their_first_hits(void **state)
{
    rt_hooks hooks = {.progress = cancel_at_once};
    rt_render_options options = {.width = width,
                                 .height = height,
                                 .spp = 1 << 20,
                                 .max_depth = 2,
                                 .aov = 1,
                                 .hooks = &hooks};
    rt_renderer *renderer = quad_and_sphere();
    rt_film *film = NULL;
    rt_film_stats stats;
    (void)state;
    assert_int_equal(rt_render(&film, renderer, &options, &error), RT_CANCELLED);
    assert_non_null(film);
    rt_film_get_stats(film, &stats);
    assert_true(stats.spp > 0 && stats.spp < options.spp);
    first_hits f = layers_of(film);
    for (int row = 0; row < height; row++) {
        int i = row * width + 2;
        assert_true(f.shape[i] == quad_shape && f.material[i] == quad_material);
        assert_float_equal(f.position[3 * i + 1], -f.position[3 * i + 2], 1e-4);
        expect_miss(&f, 7, row);
    }
    rt_film_destroy(film);
    rt_renderer_destroy(renderer);
}

static void first_hits_go_to_exr_by_their_names(void **state)
{
    static const struct {
        const char *channel, *layer;
        size_t of, at;
    } expected[] = {{"position.X", "position", 3, 0},
                    {"position.Y", "position", 3, 1},
                    {"position.Z", "position", 3, 2},
                    {"uv.U", "uv", 2, 0},
                    {"uv.V", "uv", 2, 1},
                    {"shape.Id", "shape", 1, 0},
                    {"material.Id", "material", 1, 0}};
    rt_renderer *renderer = quad_and_sphere();
    rt_film *film = render(renderer, RT_MODE_ALBEDO, 4);
    rt_image *image = NULL;
    (void)state;
    expect_ok(rt_film_write(film, "first_hit.exr", NULL, &error), &error);
    expect_ok(rt_image_read(&image, "first_hit.exr", &error), &error);
    for (size_t k = 0; k < sizeof expected / sizeof *expected; k++) {
        uint32_t channel = rt_image_channel(image, expected[k].channel);
        const float *layer = rt_film_layer(film, expected[k].layer, NULL);
        assert_true(channel != RT_IMAGE_NO_CHANNEL);
        for (size_t i = 0; i < pixels; i++)
            assert_true(image->data[i * image->channel_count + channel] ==
                        layer[i * expected[k].of + expected[k].at]);
    }
    rt_image_destroy(image);
    rt_film_destroy(film);
    rt_renderer_destroy(renderer);
}

/* ---- A launch that fails --------------------------------------------------------------------- */

/*
 * Where the launches for the layers fail, but for that which compiles their kernel, the others
 * begin when somebody waits for them: they are under way until then.
 */
static int layers_fail, layer_launches, freed_too_early;
static cl_event begin;

/* A function of OpenCL that this program has one of its own for. */
static void *next(const char *name)
{
    void *found = dlsym(RTLD_NEXT, name);
    assert_non_null(found);
    return found;
}

cl_int CL_API_CALL clEnqueueNDRangeKernel(cl_command_queue queue, cl_kernel kernel,
                                          cl_uint dimensions, const size_t *offset,
                                          const size_t *global, const size_t *local, cl_uint count,
                                          const cl_event *wait, cl_event *event)
{
    const union {
        void *object;
        cl_int(CL_API_CALL *function)(cl_command_queue, cl_kernel, cl_uint, const size_t *,
                                      const size_t *, const size_t *, cl_uint, const cl_event *,
                                      cl_event *);
    } enqueue = {next("clEnqueueNDRangeKernel")};
    char name[64] = "";
    clGetKernelInfo(kernel, CL_KERNEL_FUNCTION_NAME, sizeof name - 1, name, NULL);
    if (layers_fail && strncmp(name, "first_hit", 9) == 0 && layer_launches++ > 0)
        return CL_OUT_OF_RESOURCES;
    if (layers_fail && !begin) {
        begin = clCreateUserEvent(test_device()->context, NULL);
        assert_non_null(begin);
        wait = &begin;
        count = 1;
    }
    return enqueue.function(queue, kernel, dimensions, offset, global, local, count, wait, event);
}

cl_int CL_API_CALL clFinish(cl_command_queue queue)
{
    const union {
        void *object;
        cl_int(CL_API_CALL *function)(cl_command_queue);
    } finish = {next("clFinish")};
    if (begin) {
        clSetUserEventStatus(begin, CL_COMPLETE);
        clReleaseEvent(begin);
        begin = NULL;
    }
    return finish.function(queue);
}

cl_int CL_API_CALL clReleaseMemObject(cl_mem buffer)
{
    const union {
        void *object;
        cl_int(CL_API_CALL *function)(cl_mem);
    } release = {next("clReleaseMemObject")};
    if (begin) {
        freed_too_early = 1;
        clFinish(test_device()->queue);
    }
    return release.function(buffer);
}

/* On a CPU the device works on the film in place, and the film is freed next. */
static void nothing_is_freed_under_a_launch_that_is_under_way(void **state)
{
    rt_renderer *renderer = quad_and_sphere();
    const rt_render_options o = {
        .mode = RT_MODE_PATH, .width = width, .height = height, .spp = 4, .aov = 1};
    rt_film *film = NULL;
    (void)state;
    layers_fail = 1;
    assert_int_equal(rt_render(&film, renderer, &o, &error), RT_ERROR_DEVICE);
    layers_fail = 0;
    assert_false(freed_too_early);
    rt_renderer_destroy(renderer);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_mode_has_the_layers_of_the_first_hit),
        cmocka_unit_test(edges_have_means_of_hits_and_whole_ids),
        cmocka_unit_test(one_sample_is_what_its_ray_hits),
        cmocka_unit_test(interrupted_renders_have_their_first_hits),
        cmocka_unit_test(first_hits_go_to_exr_by_their_names),
        cmocka_unit_test(nothing_is_freed_under_a_launch_that_is_under_way),
    };
    return cmocka_run_group_tests_name("lib/mode/first_hit", tests, scratch_enter, scratch_leave);
}
