/*
 * test_memory_limit.c - a limit on memory in all that grows: with any limit a scene is read and
 * rendered to the same picture, or the call that would exceed it fails and leaves nothing.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lib/image/scratch.h"
#include "support.h"

/* ---- A scene with some of everything ------------------------------------------ */

/* A grid of n x n quads as a PLY or OBJ file, with normals and texture coordinates. */
static void write_mesh(const char *name, int n)
{
    FILE *file = fopen(name, "w");
    assert_non_null(file);
    fprintf(file,
            "ply\nformat ascii 1.0\nelement vertex %d\nproperty float x\nproperty float y\n"
            "property float z\nproperty float nx\nproperty float ny\nproperty float nz\n"
            "property float u\nproperty float v\nelement face %d\n"
            "property list uchar int vertex_indices\nend_header\n",
            (n + 1) * (n + 1), n * n);
    for (int i = 0; i <= n; i++)
        for (int j = 0; j <= n; j++)
            fprintf(file, "%g %g %g 0 1 0 %g %g\n", (double)i / n, 0.02 * ((i + j) % 2),
                    (double)j / n, (double)i / n, (double)j / n);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            fprintf(file, "4 %d %d %d %d\n", i * (n + 1) + j, i * (n + 1) + j + 1,
                    (i + 1) * (n + 1) + j + 1, (i + 1) * (n + 1) + j);
    fclose(file);
}

static void write_image(const char *name, int width, int height)
{
    FILE *file = fopen(name, "wb");
    assert_non_null(file);
    fprintf(file, "PF\n%d %d\n-1\n", width, height);
    for (int i = 0; i < 3 * width * height; i++) {
        const float value = 0.2f + 0.5f * (float)(i % 7) / 7;
        fwrite(&value, sizeof value, 1, file);
    }
    fclose(file);
}

/* Files, and many names; the names are added to the text once. */
static char files_text[1 << 17] =
    "camera { eye 0 1 -4  look_at 0 0.5 0  fov 40 }\n"
    "film { width 24  height 16 }\n"
    "texture wood { file \"wood.pfm\" }\n"
    "material white { kd 0.7 }\n"
    "material board { kd_texture wood }\n"
    "mesh grid { file \"grid.ply\"  shading smooth }\n"
    "instance grid { material board  rotate 1 0 0 20 }\n"
    "instance grid { material board  scale 0.5  translate -1 0.2 0 }\n"
    "model { file \"grid.ply\"  material white  translate 0 0.1 -1 }\n"
    "light environment { file \"sky.pfm\"  radiance 0.1 }\n";

/* Many shapes and lights. */
static const char shapes_text[] =
    "camera { eye 0 1 -4  look_at 0 0.5 0  fov 40 }\n"
    "film { width 24  height 16 }\n"
    "material white { kd 0.7 }\n"
    "material glass { kt 1  ior 1.5  fresnel dielectric }\n"
    "sphere { centre 0.5 0.5 -1  radius 0.3  material glass }\n"
    "repeat i from 1 to 2000 {\n"
    "    box { centre (0.02 * i - 7) 0.1 2  size 0.01 0.2 0.01  material white\n"
    "          rotate 0 1 0 i }\n"
    "    sphere { centre (0.02 * i - 7) 0.5 2  radius 0.01  material white }\n"
    "    light point { position (0.02 * i - 7) 2 0  power 0.1 }\n"
    "}\n";

/* A large film, and a floor for many photons. */
static const char floor_text[] =
    "camera { eye 0 1 -4  look_at 0 0.5 0  fov 40 }\n"
    "film { width 160  height 100 }\n"
    "material white { kd 0.7 }\n"
    "quad { corner -20 0 -20  edge1 0 0 40  edge2 40 0 0  material white }\n"
    "quad { corner -20 9 -20  edge1 40 0 0  edge2 0 0 40  material white }\n"
    "light point { position 0 2 0  power 100 }\n";

static void add_names(void)
{
    size_t used = strlen(files_text);
    for (int i = 0; i < 3000; i++)
        used += (size_t)snprintf(files_text + used, sizeof files_text - used,
                                 "material m%d { kd 0.5 }\n", i);
    assert_true(used < sizeof files_text - 1);
}

static int enter(void **state)
{
    if (scratch_enter(state) != 0)
        return -1;
    add_names();
    write_mesh("grid.ply", 40);
    write_image("wood.pfm", 64, 48);
    write_image("sky.pfm", 140, 70);
    return 0;
}

/* ---- One attempt --------------------------------------------------------------- */

/* What is made of the scene under a limit. */
typedef struct attempt {
    rt_memory *memory;
    rt_scene *scene;
    rt_renderer *renderer;
    rt_film *film;
    rt_error error;
} attempt;

static rt_status load(attempt *a, const char *text)
{
    const rt_load_options options = {.check = 1, .memory = a->memory};
    return rt_scene_parse(&a->scene, text, NULL, &options, &a->error);
}

static rt_status render(attempt *a, const rt_render_options *options)
{
    rt_render_options own, o = *options;
    rt_scene_get_options(a->scene, &own);
    o.width = own.width;
    o.height = own.height;
    rt_status status = rt_renderer_create(&a->renderer, a->scene, test_device(), NULL, &a->error);
    return status == RT_OK ? rt_render(&a->film, a->renderer, &o, &a->error) : status;
}

static void begin(attempt *a, uint64_t limit)
{
    memset(a, 0, sizeof *a);
    expect_ok(rt_memory_create(&a->memory, limit, &a->error), &a->error);
    test_device()->memory = a->memory;
}

/* Each owner gave back what it took, no more; at the peak they had all of it. */
static void expect_all_given_back(const rt_memory *memory, uint64_t most)
{
    rt_memory_owner owners[64];
    const size_t count = rt_memory_get_owners(memory, owners, 64);
    for (size_t i = 0; i < count; i++) {
        if (owners[i].used != 0 || owners[i].at_most > owners[i].most)
            fail_msg("%s has %llu bytes left, and had %llu of its %llu at most", owners[i].what,
                     (unsigned long long)owners[i].used, (unsigned long long)owners[i].at_most,
                     (unsigned long long)owners[i].most);
        most -= owners[i].at_most;
    }
    assert_true(most == 0);
}

/* Frees all, of which nothing may be counted any more; returns the most that was. */
static uint64_t end(attempt *a)
{
    rt_memory_info info;
    rt_film_destroy(a->film);
    rt_renderer_destroy(a->renderer);
    rt_scene_destroy(a->scene);
    expect_ok(rt_device_finish(test_device(), &a->error), &a->error);
    test_device()->memory = NULL;
    rt_memory_get_info(a->memory, &info);
    assert_int_equal(info.used, 0);
    expect_all_given_back(a->memory, info.most);
    assert_true(info.limit == 0 || info.most <= info.limit);
    rt_memory_destroy(a->memory);
    return info.most;
}

/* ---- Owners ---------------------------------------------------------------------- */

enum { OWNERS_MAX = 64 };

/* What was refused, by the words before "needs". */
typedef struct owners {
    char names[OWNERS_MAX][64];
    int count;
} owners;

static void note(owners *o, const attempt *a)
{
    const char *needs = strstr(a->error.message, " needs ");
    if (a->error.status != RT_ERROR_MEMORY || !needs ||
        !strstr(a->error.message, "more than the limit of"))
        fail_msg("status %d: %s", (int)a->error.status, a->error.message);
    int length = (int)(needs - a->error.message);
    for (int i = 0; i < o->count; i++)
        if ((int)strlen(o->names[i]) == length &&
            memcmp(o->names[i], a->error.message, (size_t)length) == 0)
            return;
    assert_true(o->count < OWNERS_MAX && length < 64);
    snprintf(o->names[o->count++], 64, "%.*s", length, a->error.message);
}

static void expect_owners(const owners *o, const char *const *expected, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        int found = 0;
        for (int k = 0; k < o->count; k++)
            found |= strncmp(o->names[k], expected[i], strlen(expected[i])) == 0;
        if (!found) {
            for (int k = 0; k < o->count; k++)
                print_message("refused: %s\n", o->names[k]);
            fail_msg("%s was never refused", expected[i]);
        }
    }
}

/* What loading takes at most. */
static uint64_t most_of_loading(const char *text)
{
    attempt a;
    begin(&a, 0);
    expect_ok(load(&a, text), &a.error);
    return end(&a);
}

static void expect_reading(const char *text, const char *const *expected, size_t count)
{
    owners refused = {.count = 0};
    attempt a;
    const uint64_t most = most_of_loading(text);
    for (uint64_t limit = 1; limit < most; limit += limit / 64 + 1) {
        begin(&a, limit);
        if (load(&a, text) != RT_OK)
            note(&refused, &a);
        end(&a);
    }
    begin(&a, most);
    expect_ok(load(&a, text), &a.error);
    end(&a);
    expect_owners(&refused, expected, count);
}

static void reading_a_scene_keeps_every_limit(void **state)
{
    static const char *const files[] = {"the text of the scene", "the table of names",
                                        "the list of materials", "a mesh",
                                        "an image of 64x48",     "an image of 140x70",
                                        "the image of a light",  "a file"},
                             *const shapes[] = {"the list of shapes", "the list of placements",
                                                "the list of lights",
                                                "the list of places in the text"};
    (void)state;
    expect_reading(files_text, files, sizeof files / sizeof *files);
    expect_reading(shapes_text, shapes, sizeof shapes / sizeof *shapes);
}

/*
 * Renders under ever greater limits, each `step` times the last, until one is enough. Then finds
 * the least that is: the picture stays as it is without a limit.
 */
static void expect_render(const char *text, const rt_render_options *options, double step,
                          const char *const *expected, size_t count)
{
    owners refused = {.count = 0};
    attempt a, free_of_limit;
    uint64_t low = most_of_loading(text), high = low;
    begin(&free_of_limit, 0);
    expect_ok(load(&free_of_limit, text), &free_of_limit.error);
    expect_ok(render(&free_of_limit, options), &free_of_limit.error);
    uint32_t width, height;
    rt_film_get_size(free_of_limit.film, &width, &height);
    const size_t bytes = 3 * sizeof(float) * width * height;
    for (int is_found = 0; high - low > high / 256 || !is_found;) {
        const uint64_t limit = is_found ? low + (high - low) / 2 : high;
        begin(&a, limit);
        expect_ok(load(&a, text), &a.error);
        const int is_enough = render(&a, options) == RT_OK;
        if (is_enough)
            assert_memory_equal(rt_film_rgb(a.film), rt_film_rgb(free_of_limit.film), bytes);
        else
            note(&refused, &a);
        end(&a);
        is_found |= is_enough;
        *(is_enough ? &high : &low) = limit;
        if (!is_found)
            high = (uint64_t)((double)limit * step);
    }
    test_device()->memory = free_of_limit.memory;
    end(&free_of_limit);
    expect_owners(&refused, expected, count);
}

static void a_render_keeps_every_limit(void **state)
{
    static const rt_render_options plain = {.mode = RT_MODE_PATH, .spp = 1},
                                   layers = {
                                       .mode = RT_MODE_PATH, .spp = 8, .variance = 1, .aov = 1};
    static const char *const shapes[] = {"the packing of the scene",
                                         "the bounding volume hierarchy", "the scene"},
                             *const films[] = {"the film", "the buffer of the film's layers"};
    (void)state;
    expect_render(shapes_text, &plain, 1.05, shapes, sizeof shapes / sizeof *shapes);
    /* A CPU device sums the layers in the film's own memory. */
    expect_render(floor_text, &layers, 1.3, films, test_device()->info.is_cpu ? 1 : 2);
}

static void photons_keep_every_limit(void **state)
{
    static const rt_render_options flann = {.mode = RT_MODE_PHOTON,
                                            .spp = 1,
                                            .max_depth = 3,
                                            .photons = 150000,
                                            .gather = RT_GATHER_FLANN},
                                   passes = {.mode = RT_MODE_PHOTON,
                                             .spp = 1,
                                             .max_depth = 3,
                                             .photons = 150000,
                                             .passes = 2,
                                             .k = 8};
    static const char *const lists[] = {"the photon map", "the search tree of the photon map",
                                        "the search of the photon map"},
                             *const trees[] = {"the photon map", "the tree of the photon map"};
    (void)state;
    expect_render(floor_text, &flann, 1.05, lists, sizeof lists / sizeof *lists);
    expect_render(floor_text, &passes, 1.05, trees, sizeof trees / sizeof *trees);
}

/* A map in a file is read within a limit, or not at all; to write it takes nothing. */
static void maps_keep_every_limit(void **state)
{
    static const rt_render_options options = {.photons = 20000};
    static const char *const expected[] = {"a file", "the photon map"};
    const rt_emit_options how = {.render = &options};
    owners refused = {.count = 0};
    rt_photon_map *map = NULL;
    attempt a;
    (void)state;
    begin(&a, 0);
    expect_ok(load(&a, floor_text), &a.error);
    expect_ok(rt_renderer_create(&a.renderer, a.scene, test_device(), NULL, &a.error), &a.error);
    expect_ok(rt_photon_map_emit(&map, a.renderer, &how, &a.error), &a.error);
    expect_ok(rt_photon_map_save(map, "map.rtp", &a.error), &a.error);
    rt_photon_map_destroy(map);
    map = NULL;
    end(&a);
    for (uint64_t limit = 100; !map; limit += limit / 20) {
        begin(&a, limit);
        if (rt_photon_map_load_in(&map, "map.rtp", a.memory, &a.error) != RT_OK) {
            note(&refused, &a);
            end(&a);
        }
    }
    rt_memory_info info;
    rt_memory_get_info(a.memory, &info);
    const uint64_t rest = info.limit - info.used - 1;
    expect_ok(rt_memory_take(a.memory, rest, "the test", &a.error), &a.error);
    expect_ok(rt_photon_map_save(map, "map2.rtp", &a.error), &a.error);
    rt_memory_give(a.memory, rest, "the test");
    rt_photon_map_destroy(map);
    end(&a);
    expect_owners(&refused, expected, sizeof expected / sizeof *expected);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reading_a_scene_keeps_every_limit),
        cmocka_unit_test(a_render_keeps_every_limit),
        cmocka_unit_test(photons_keep_every_limit),
        cmocka_unit_test(maps_keep_every_limit),
    };
    return cmocka_run_group_tests_name("lib/render/memory_limit", tests, enter, scratch_leave);
}
