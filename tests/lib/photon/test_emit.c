/*
 * test_emit.c - the flux that photons carry, against what energy conservation says of closed rooms,
 * and that a map does not depend on how the work was shared out.
 *
 * Bounds: sums that every path reaches exactly are held to rounding (1e-4); random ones to standard
 * errors, from the variance of a geometric series of bounces.
 */
#include "support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/statistics.h"
#include "photon/emit.h"
#include "photon/forecast.h"
#include "render/renderer.h"

enum { paths = 100000 };
enum { sides = 6, top_side = 3 }; /* shapes of the room, in the order of make_room */

static const double light_power[3] = {2, 3, 5};

typedef enum ceiling { CEILING_LIKE_WALLS, CEILING_MIRROR } ceiling;
typedef enum setting { LIGHT_BARE, LIGHT_IN_GLASS } setting;

static uint32_t add_material(rt_scene *scene, const rt_material *material)
{
    uint32_t index = 0;
    rt_error error;
    expect_ok(rt_scene_add_material(scene, &index, NULL, material, &error), &error);
    return index;
}

/* One side of the room, facing inwards: the axis that it is across, and which end. */
static void add_side(rt_scene *scene, int axis, int end, uint32_t material)
{
    float corner[3] = {-1, -1, -1}, edge1[3] = {0}, edge2[3] = {0};
    rt_surface surface = {.material = material};
    rt_error error;
    corner[axis] = end ? 1 : -1;
    edge1[(axis + 1) % 3] = 2;
    edge2[(axis + 2) % 3] = 2;
    expect_ok(rt_scene_add_quad(scene, NULL, corner, edge1, edge2, &surface, &error), &error);
}

/* A closed room [-1,1]^3 with walls of this albedo and a point light. */
static rt_renderer *make_room_on(rt_device *device, const float kd[3], ceiling above, setting how)
{
    rt_material wall = {.kd = {kd[0], kd[1], kd[2]}};
    rt_material mirror = {.ks = {1, 1, 1}};
    rt_material glass = {.kt = {1, 1, 1}, .ior = 1.5f, .fresnel = RT_FRESNEL_DIELECTRIC};
    rt_point_light light = {{0.1f, 0.2f, -0.1f}, {0}, {2, 3, 5}};
    rt_renderer *renderer = NULL;
    rt_scene *scene = NULL;
    rt_error error;

    expect_ok(rt_scene_create(&scene, &error), &error);
    uint32_t walls = add_material(scene, &wall);
    uint32_t top = above == CEILING_MIRROR ? add_material(scene, &mirror) : walls;
    for (int axis = 0; axis < 3; axis++)
        for (int end = 0; end < 2; end++)
            add_side(scene, axis, end, 2 * axis + end == top_side ? top : walls);
    if (how == LIGHT_IN_GLASS) {
        rt_surface surface = {.material = add_material(scene, &glass)};
        const float centre[3] = {0, 0.2f, 0};
        expect_ok(rt_scene_add_sphere(scene, NULL, centre, 0.4f, &surface, &error), &error);
    }
    expect_ok(rt_scene_add_point_light(scene, &light, &error), &error);
    expect_ok(rt_renderer_create(&renderer, scene, device, NULL, &error), &error);
    rt_scene_destroy(scene);
    return renderer;
}

static rt_renderer *make_room(const float kd[3], ceiling above, setting how)
{
    return make_room_on(test_device(), kd, above, how);
}

/* Whose work it is to bring photons together: that of the usual side, or the device's anyway. */
typedef enum packing { PACKING_USUAL, PACKING_ON_DEVICE } packing;

static rt_photon_map emit_map(rt_renderer *renderer, uint32_t max_depth, rt_direct direct,
                              uint64_t count, packing how)
{
    rt_photon_map map = {.settings = {.max_depth = max_depth, .direct = direct}};
    rt_emitter *emitter = NULL;
    rt_stage_progress progress;
    rt_error error;
    cl_kernel kernel = NULL;

    expect_ok(rt_stage_begin(&progress, NULL, RT_STAGE_EMIT), &error);
    expect_ok(
        rt_device_kernel(renderer->device, &kernel, "photon_emit", "photon_emit", NULL, &error),
        &error);
    expect_ok(
        rt_emitter_create(&emitter, renderer->device, kernel, renderer->scene, NULL, 0, &error),
        &error);
    if (how == PACKING_ON_DEVICE)
        rt_emitter_pack(emitter);
    expect_ok(rt_emitter_emit(emitter, &map, RT_PHOTONS_GLOBAL, test_seed(11), 0, count, &progress,
                              &error),
              &error);
    rt_emitter_destroy(emitter);
    rt_kernel_release(kernel);
    assert_int_equal(map.lists[RT_PHOTONS_GLOBAL].emitted, count);
    assert_int_equal(map.lists[RT_PHOTONS_GLOBAL].rejected, 0);
    assert_int_equal(map.ledger.paths, count);
    assert_int_equal(map.ledger.rejected, 0);
    return map;
}

/* The photons alone. */
static rt_photon_list emit_by(rt_renderer *renderer, uint32_t max_depth, rt_direct direct,
                              uint64_t count, packing how)
{
    rt_photon_map map = emit_map(renderer, max_depth, direct, count, how);
    rt_photon_list list = map.lists[RT_PHOTONS_GLOBAL];
    map.lists[RT_PHOTONS_GLOBAL] = (rt_photon_list){0};
    rt_photon_map_free(&map);
    return list;
}

static rt_photon_list emit(rt_renderer *renderer, uint32_t max_depth, rt_direct direct,
                           uint64_t count)
{
    return emit_by(renderer, max_depth, direct, count, PACKING_USUAL);
}

static uint32_t segments(const rt_photon *photon)
{
    return photon->flags >> 8;
}

typedef int filter(const rt_photon *photon);

static int any(const rt_photon *photon)
{
    (void)photon;
    return 1;
}

static int after_one_segment(const rt_photon *photon)
{
    return segments(photon) == 1;
}

/* The first photon that a path leaves has met delta surfaces only. */
static int first_of_path(const rt_photon *photon)
{
    return segments(photon) == 1 || (photon->flags & RT_PHOTON_CAUSTIC);
}

static int caustic(const rt_photon *photon)
{
    return (photon->flags & RT_PHOTON_CAUSTIC) != 0;
}

static double sum_flux(const rt_photon_list *map, filter *which, int channel)
{
    double sum = 0;
    for (size_t i = 0; i < map->count; i++)
        if (which(map->photons + i))
            sum += map->photons[i].flux[channel];
    return sum / (double)map->emitted;
}

static void light_arrives_whole_at_the_walls(void **state)
{
    static const float kd[3] = {0.5f, 0.5f, 0.5f};
    (void)state;
    rt_renderer *renderer = make_room(kd, CEILING_LIKE_WALLS, LIGHT_BARE);
    rt_photon_list map = emit(renderer, 4, RT_DIRECT_PHOTONS, paths);
    for (int c = 0; c < 3; c++)
        assert_float_equal(sum_flux(&map, after_one_segment, c), light_power[c],
                           1e-4 * light_power[c]);
    rt_photon_list_clear(&map);
    rt_renderer_destroy(renderer);
}

/* Bounce i brings albedo^i of the power, up to the longest path. */
static void flux_of_all_bounces_is_the_geometric_series(void **state)
{
    static const float kd[3] = {0.2f, 0.5f, 0.8f};
    static const uint32_t depths[] = {2, 3, 6, 64};
    (void)state;
    rt_renderer *renderer = make_room(kd, CEILING_LIKE_WALLS, LIGHT_BARE);
    for (size_t d = 0; d < sizeof depths / sizeof *depths; d++) {
        rt_photon_list map = emit(renderer, depths[d], RT_DIRECT_PHOTONS, paths);
        for (int c = 0; c < 3; c++) {
            double expected = light_power[c] * (1 - pow(kd[c], depths[d] - 1)) / (1 - kd[c]);
            double sigma = light_power[c] * sqrt(kd[c] / paths) / (1 - kd[c]);
            double off = fmax(0, fabs(sum_flux(&map, any, c) - expected) - 1e-4 * expected);
            expect_deviate(off / sigma, "flux of all bounces");
        }
        rt_photon_list_clear(&map);
    }
    rt_renderer_destroy(renderer);
}

static void photons_straight_from_the_light_are_left_to_shadow_rays(void **state)
{
    static const float kd[3] = {0.5f, 0.5f, 0.5f};
    (void)state;
    rt_renderer *renderer = make_room(kd, CEILING_MIRROR, LIGHT_BARE);
    rt_photon_list nee = emit(renderer, 16, RT_DIRECT_NEE, paths);
    rt_photon_list all = emit(renderer, 16, RT_DIRECT_PHOTONS, paths);
    size_t j = 0;
    /* One map is the other without its photons of one segment. */
    for (size_t i = 0; i < all.count; i++)
        if (!after_one_segment(all.photons + i)) {
            assert_true(j < nee.count);
            assert_memory_equal(nee.photons + j++, all.photons + i, sizeof *all.photons);
        }
    assert_int_equal(j, nee.count);
    assert_true(all.count - nee.count > paths / 2);
    rt_photon_list_clear(&nee);
    rt_photon_list_clear(&all);
    rt_renderer_destroy(renderer);
}

static void delta_surfaces_store_nothing_and_pass_all_flux(void **state)
{
    static const float kd[3] = {0.5f, 0.5f, 0.5f};
    (void)state;
    for (setting how = LIGHT_BARE; how <= LIGHT_IN_GLASS; how++) {
        rt_renderer *renderer = make_room(kd, CEILING_MIRROR, how);
        rt_photon_list map = emit(renderer, 64, RT_DIRECT_PHOTONS, paths);
        for (int c = 0; c < 3; c++) {
            double first = sum_flux(&map, first_of_path, c);
            if (fabs(first - light_power[c]) > 1e-4 * light_power[c])
                fail_msg("setting %d channel %d: %g W arrive of %g", (int)how, c, first,
                         light_power[c]);
            assert_true(sum_flux(&map, caustic, c) >
                        (how == LIGHT_IN_GLASS ? 0.999 : 0.1) * light_power[c]);
        }
        for (size_t i = 0; i < map.count; i++)
            assert_true(map.photons[i].shape < sides && map.photons[i].shape != top_side);
        rt_photon_list_clear(&map);
        rt_renderer_destroy(renderer);
    }
}

static void photons_are_whole(void **state)
{
    static const float kd[3] = {0.2f, 0.5f, 0.8f};
    (void)state;
    rt_renderer *renderer = make_room(kd, CEILING_LIKE_WALLS, LIGHT_BARE);
    rt_photon_list map = emit(renderer, 16, RT_DIRECT_PHOTONS, 5000);
    for (size_t i = 0; i < map.count; i++) {
        const rt_photon *p = map.photons + i;
        float facing = 0, wi2 = 0, outermost = 0;
        for (int c = 0; c < 3; c++) {
            facing += p->wi[c] * p->normal[c];
            wi2 += p->wi[c] * p->wi[c];
            outermost = fmaxf(outermost, fabsf(p->position[c]));
            assert_true(p->flux[c] >= 0);
        }
        assert_true(facing > 0); /* the normal is on the lit side */
        assert_true(p->shading == 1);
        assert_float_equal(wi2, 1, 1e-5);
        assert_float_equal(outermost, 1, 1e-5);
        assert_true(segments(p) >= 1 && segments(p) <= 15);
        assert_true(p->shape < sides);
        /* In the order of paths, and along each path from the light on. */
        assert_true(i == 0 || p->path > p[-1].path ||
                    (p->path == p[-1].path && segments(p) == segments(p - 1) + 1));
    }
    rt_photon_list_clear(&map);
    rt_renderer_destroy(renderer);
}

static void maps_do_not_depend_on_batches(void **state)
{
    static const float kd[3] = {0.8f, 0.8f, 0.8f};
    /* deep paths need more slots: smaller batches */
    enum { count = 20000, shallow = 16, deep = 128 };
    (void)state;
    rt_renderer *renderer = make_room(kd, CEILING_LIKE_WALLS, LIGHT_BARE);
    rt_photon_list one = emit(renderer, shallow, RT_DIRECT_PHOTONS, count);
    rt_photon_list many = emit(renderer, deep, RT_DIRECT_PHOTONS, count);
    size_t j = 0;
    for (size_t i = 0; i < many.count; i++)
        if (segments(many.photons + i) < shallow) {
            assert_true(j < one.count);
            assert_memory_equal(one.photons + j++, many.photons + i, sizeof *one.photons);
        }
    assert_int_equal(j, one.count);
    rt_photon_list_clear(&one);
    rt_photon_list_clear(&many);
    rt_renderer_destroy(renderer);
}

/* Where nearly all slots are full, what is packed of a batch takes more than one reading. */
static void maps_do_not_depend_on_who_packs_them(void **state)
{
    static const float albedos[] = {0.3f, 0.999f};
    (void)state;
    for (size_t i = 0; i < sizeof albedos / sizeof *albedos; i++) {
        const float kd[3] = {albedos[i], albedos[i], albedos[i]};
        rt_renderer *renderer = make_room(kd, CEILING_MIRROR, LIGHT_IN_GLASS);
        rt_photon_list expected = emit_by(renderer, 128, RT_DIRECT_PHOTONS, 9000, PACKING_USUAL);
        rt_photon_list packed = emit_by(renderer, 128, RT_DIRECT_PHOTONS, 9000, PACKING_ON_DEVICE);
        assert_int_equal(packed.count, expected.count);
        assert_int_equal(packed.emitted, expected.emitted);
        assert_memory_equal(packed.photons, expected.photons,
                            expected.count * sizeof *expected.photons);
        rt_photon_list_clear(&expected);
        rt_photon_list_clear(&packed);
        rt_renderer_destroy(renderer);
    }
}

static void maps_do_not_depend_on_threads_and_work_groups(void **state)
{
    static const float kd[3] = {0.2f, 0.5f, 0.8f};
    static const uint32_t devices[][2] = {{1, 1}, {2, 16}, {2, 64}}; /* threads, work-group */
    (void)state;
    rt_renderer *renderer = make_room(kd, CEILING_MIRROR, LIGHT_IN_GLASS);
    rt_photon_list expected = emit(renderer, 16, RT_DIRECT_NEE, 10000);
    rt_renderer_destroy(renderer);
    for (size_t i = 0; i < sizeof devices / sizeof *devices; i++) {
        rt_device *device = test_device_open(devices[i][0], devices[i][1]);
        renderer = make_room_on(device, kd, CEILING_MIRROR, LIGHT_IN_GLASS);
        rt_photon_list map = emit(renderer, 16, RT_DIRECT_NEE, 10000);
        assert_int_equal(map.count, expected.count);
        assert_memory_equal(map.photons, expected.photons, map.count * sizeof *map.photons);
        rt_photon_list_clear(&map);
        rt_renderer_destroy(renderer);
        rt_device_close(device);
    }
    rt_photon_list_clear(&expected);
}

static void more_photons_than_fit_are_foreseen(void **state)
{
    rt_error error;
    (void)state;
    /* 1.5 photons a path of 64 bytes: 96 GB for 10^9 paths, and 64 bytes a photon that is there. */
    expect_ok(rt_photon_forecast(0, 60000, 40000, 1000000000, 97000000000u, &error), &error);
    assert_int_equal(rt_photon_forecast(0, 60000, 40000, 1000000000, 95000000000u, &error),
                     RT_ERROR_MEMORY);
    assert_non_null(strstr(error.message, "1000000000 photon paths"));
    assert_non_null(strstr(error.message, "1.5e+09 photons"));
    assert_non_null(strstr(error.message, "take 96 GB"));
    assert_non_null(strstr(error.message, "has 95 GB"));
    assert_int_equal(rt_photon_forecast(50000000, 60000, 40000, 1000000000, 97000000000u, &error),
                     RT_ERROR_MEMORY);
    /* Not from a few paths, nor where the memory is not known. */
    expect_ok(rt_photon_forecast(0, 1000, 100, 1000000000, 1, &error), &error);
    expect_ok(rt_photon_forecast(0, 60000, 40000, 1000000000, 0, &error), &error);
}

static void emission_stops_when_photons_will_not_fit(void **state)
{
    const float kd[3] = {0.5f, 0.5f, 0.5f};
    /* Several batches of a CPU, or of another device. */
    const uint64_t many = test_device()->info.is_cpu ? 200000 : 2000000;
    const uint64_t photon_bytes = sizeof(rt_photon);
    (void)state;
    rt_renderer *renderer = make_room(kd, CEILING_LIKE_WALLS, LIGHT_BARE);
    for (int fits = 0; fits < 2; fits++) {
        /* Two photons a path but for roulette. */
        rt_photon_map map = {.settings = {.max_depth = 8, .direct = RT_DIRECT_PHOTONS}};
        rt_emitter *emitter = NULL;
        rt_stage_progress progress;
        cl_kernel kernel = NULL;
        rt_error error;
        expect_ok(rt_stage_begin(&progress, NULL, RT_STAGE_EMIT), &error);
        expect_ok(
            rt_device_kernel(renderer->device, &kernel, "photon_emit", "photon_emit", NULL, &error),
            &error);
        expect_ok(
            rt_emitter_create(&emitter, renderer->device, kernel, renderer->scene, NULL, 0, &error),
            &error);
        rt_emitter_limit_memory(emitter, photon_bytes * (fits ? 3 * many : many));
        rt_status status =
            rt_emitter_emit(emitter, &map, RT_PHOTONS_GLOBAL, 11, 0, many, &progress, &error);
        assert_int_equal(status, fits ? RT_OK : RT_ERROR_MEMORY);
        assert_true(fits ? map.lists[0].count > many : map.lists[0].count < many / 2);
        rt_emitter_destroy(emitter);
        rt_kernel_release(kernel);
        rt_photon_map_free(&map);
    }
    rt_renderer_destroy(renderer);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(light_arrives_whole_at_the_walls),
        statistical_test(flux_of_all_bounces_is_the_geometric_series),
        cmocka_unit_test(photons_straight_from_the_light_are_left_to_shadow_rays),
        cmocka_unit_test(delta_surfaces_store_nothing_and_pass_all_flux),
        cmocka_unit_test(photons_are_whole),
        cmocka_unit_test(maps_do_not_depend_on_batches),
        cmocka_unit_test(maps_do_not_depend_on_who_packs_them),
        cmocka_unit_test(more_photons_than_fit_are_foreseen),
        cmocka_unit_test(emission_stops_when_photons_will_not_fit),
        cmocka_unit_test(maps_do_not_depend_on_threads_and_work_groups),
    };
    return cmocka_run_group_tests_name("lib/photon/emit", tests, NULL, NULL);
}
