/*
 * test_map_checkpoint.c - photon maps emitted in sittings: the finished map is the one emitted at
 * once, to the byte of its file, and what does not fit is refused with what differs.
 */
#include "support.h"

#include <math.h>
#include <string.h>
#include <time.h>

#include "lib/photon/emitted.h"
#include "photon/map_continue.h"
#include "photon/map_file.h"

/* Enough paths for several batches of each kind. */
static const rt_render_options base = {
    .photons = 150001, .caustic_photons = 70003, .max_depth = 6, .seed = 5};

static rt_photon_map *merge(const rt_photon_map *a, const rt_photon_map *b)
{
    const rt_photon_map *both[] = {a, b};
    rt_photon_map *map = NULL;
    rt_error error;
    expect_ok(rt_photon_map_merge(&map, both, 2, &error), &error);
    return map;
}

/* The last checkpoint, through the bytes of its file; one after `left` others cancels. */
typedef struct sitting {
    rt_photon_map *kept;
    int left;
} sitting;

static void keep(void *user, const rt_photon_map *map)
{
    sitting *s = user;
    rt_bytes bytes = {0};
    rt_error error;
    rt_photon_map_destroy(s->kept);
    s->kept = NULL;
    expect_ok(rt_photon_map_encode_in(&bytes, map, &error), &error);
    expect_ok(rt_photon_map_decode(&s->kept, bytes.data, bytes.size, NULL, &error), &error);
    rt_bytes_free(&bytes);
    /* Progress is told ten times a second at most: the next report comes right behind. */
    if (--s->left < 0)
        nanosleep(&(struct timespec){0, 110000000}, NULL);
}

static int cancel(void *user, const rt_progress *progress)
{
    const sitting *s = user;
    (void)progress;
    return s->left < 0;
}

/* Emits until the checkpoint of this number, from a map or anew; the map kept then. */
static rt_photon_map *sit(rt_renderer *renderer, const rt_emit_options *how,
                          const rt_photon_map *from, int checkpoints, rt_status *status)
{
    sitting s = {NULL, checkpoints};
    const rt_hooks hooks = {.progress = cancel, .user = &s};
    rt_render_options render = *how->render;
    rt_emit_options options = *how;
    rt_photon_map *map = NULL;
    rt_error error;
    render.hooks = &hooks;
    options.render = &render;
    options.resume = from;
    options.checkpoint = keep;
    options.checkpoint_user = &s;
    *status = rt_photon_map_emit(&map, renderer, &options, &error);
    assert_int_equal(*status == RT_OK, map != NULL);
    if (map)
        expect_same_map(map, s.kept);
    else
        assert_int_equal(*status, RT_CANCELLED);
    assert_non_null(s.kept);
    rt_photon_map_destroy(map);
    return s.kept;
}

static void expect_sittings(rt_renderer *renderer, const rt_emit_options *how)
{
    rt_photon_map *whole = emit_map(renderer, how), *kept = NULL;
    rt_status status = RT_CANCELLED;
    int sittings = 0;
    for (; status == RT_CANCELLED; sittings++) {
        rt_photon_map *next = sit(renderer, how, kept, 0, &status);
        rt_photon_map_destroy(kept);
        kept = next;
    }
    assert_int_equal(status, RT_OK);
    /* A GPU takes all of these paths in a batch or two. */
    assert_true(sittings > (test_device()->info.is_cpu ? 2 : 0));
    expect_same_map(kept, whole);
    rt_photon_map_destroy(kept);
    rt_photon_map_destroy(whole);
}

static void sittings_make_the_map_of_an_emission_at_once(void **state)
{
    rt_renderer *renderer = test_renderer(ROOM);
    rt_render_options render = base;
    rt_emit_options options = {.render = &render};
    (void)state;
    expect_sittings(renderer, &options);
    options.part = 1;
    options.parts = 2;
    render.caustic_photons = 0;
    expect_sittings(renderer, &options);
    rt_renderer_destroy(renderer);
}

/* What a map lacks lies before, between and behind what it has. */
static void gaps_are_filled_in_their_place(void **state)
{
    rt_renderer *renderer = test_renderer(ROOM);
    rt_render_options render = base;
    rt_emit_options options = {.render = &render};
    rt_photon_map *whole = emit_map(renderer, &options), *parts[2];
    rt_status status;
    (void)state;
    options.parts = 7;
    for (uint32_t i = 0; i < 2; i++) {
        options.part = 2 + 3 * i;
        parts[i] = emit_map(renderer, &options);
    }
    options.part = options.parts = 0;
    rt_photon_map *holed = merge(parts[0], parts[1]),
                  *before = sit(renderer, &options, holed, 100, &status);
    assert_int_equal(status, RT_OK);
    expect_same_map(before, whole);
    rt_photon_map_destroy(before);
    options.resume = holed;
    rt_photon_map *map = emit_map(renderer, &options);
    expect_same_map(map, whole);
    rt_photon_map_destroy(map);
    for (int i = 0; i < 2; i++)
        rt_photon_map_destroy(parts[i]);
    rt_photon_map_destroy(holed);
    rt_photon_map_destroy(whole);
    rt_renderer_destroy(renderer);
}

static void more_photons_continue_a_finished_map(void **state)
{
    rt_renderer *renderer = test_renderer(ROOM);
    rt_render_options render = {.photons = 5000, .caustic_photons = 3000};
    rt_emit_options options = {.render = &render};
    rt_photon_map *less = emit_map(renderer, &options);
    (void)state;
    render.photons = 9000;
    rt_photon_map *whole = emit_map(renderer, &options);
    options.resume = less;
    rt_photon_map *map = emit_map(renderer, &options);
    expect_same_map(map, whole);
    options.resume = whole;
    rt_photon_map *again = emit_map(renderer, &options);
    expect_same_map(again, whole);
    rt_photon_map_destroy(again);
    rt_photon_map_destroy(map);
    rt_photon_map_destroy(whole);
    rt_photon_map_destroy(less);
    rt_renderer_destroy(renderer);
}

/* Reports of an emission that began with 5000 of 8000 paths. */
static int expect_rest(void *user, const rt_progress *p)
{
    int *count = user;
    const double begun = 5000.0 / 8000;
    if (p->stage != RT_STAGE_EMIT || p->fraction >= 1 || p->remaining < 0)
        return 0;
    const double right = p->elapsed * (1 - p->fraction) / (p->fraction - begun);
    assert_true(p->fraction > begun);
    assert_true(fabs(p->remaining - right) <= 1e-6 * right);
    ++*count;
    return 0;
}

static void take_long(void *user, const rt_photon_map *map)
{
    (void)user;
    (void)map;
    nanosleep(&(struct timespec){0, 110000000}, NULL);
}

static void the_time_that_remains_is_of_what_was_lacking(void **state)
{
    rt_renderer *renderer = test_renderer(ROOM);
    rt_render_options render = {.photons = 3000, .caustic_photons = 2000};
    rt_emit_options options = {.render = &render};
    rt_photon_map *less = emit_map(renderer, &options), *map = NULL;
    int count = 0;
    const rt_hooks hooks = {.progress = expect_rest, .user = &count};
    rt_error error;
    (void)state;
    render = (rt_render_options){.photons = 4000, .caustic_photons = 4000, .hooks = &hooks};
    options.resume = less;
    options.checkpoint = take_long;
    expect_ok(rt_photon_map_emit(&map, renderer, &options, &error), &error);
    assert_true(count > 0);
    rt_photon_map_destroy(map);
    rt_photon_map_destroy(less);
    rt_renderer_destroy(renderer);
}

static void expect_refused(rt_renderer *renderer, const rt_render_options *render,
                           const rt_photon_map *from, const char *field, const char *reason)
{
    const rt_emit_options options = {.render = render, .resume = from};
    rt_photon_map *map = NULL;
    rt_error error = {0};
    assert_int_equal(rt_photon_map_emit(&map, renderer, &options, &error), RT_ERROR_USAGE);
    assert_null(map);
    assert_string_equal(error.field, field);
    if (!strstr(error.message, reason))
        fail_msg("'%s' does not say '%s'", error.message, reason);
}

static void other_scenes_and_settings_are_refused_with_what_differs(void **state)
{
    static const float shares[] = {1, 1};
    rt_renderer *renderer = test_renderer(ROOM);
    rt_renderer *changed = test_renderer(ROOM "light point { position 0 0 0.5  power 1 }\n");
    const rt_render_options few = {.photons = 100, .max_depth = 6, .seed = 5};
    rt_render_options o = few;
    const rt_emit_options options = {.render = &few};
    rt_photon_map *map = emit_map(renderer, &options);
    (void)state;
    expect_refused(changed, &few, map, "", "another scene");
    o.max_depth = 7;
    expect_refused(renderer, &o, map, "max_depth", "max_depth is 7 here, and 6 in the photon map");
    o = few;
    o.sampler = RT_SAMPLER_INDEPENDENT;
    expect_refused(renderer, &o, map, "sampler", "sampler is independent here, and sobol");
    o = few;
    o.direct = RT_DIRECT_PHOTONS;
    expect_refused(renderer, &o, map, "direct", "direct is photons here");
    o = few;
    o.caustic_photons = 10;
    expect_refused(renderer, &o, map, "caustic_photons", "and not kept apart in the photon map");
    o = few;
    o.seed = 6;
    expect_refused(renderer, &o, map, "seed", "seed is 6 here, and 5");
    o = few;
    o.photons = 99;
    expect_refused(renderer, &o, map, "photons", "photons is 99 here");
    o = few;
    o.light_shares = shares;
    o.light_share_count = 2;
    expect_refused(renderer, &o, map, "", "other light shares");
    rt_photon_map_destroy(map);
    rt_renderer_destroy(changed);
    rt_renderer_destroy(renderer);
}

static void gaps_of_ranges_are_found(void **state)
{
    static rt_path_range list[] = {{.first = 3, .count = 2}, {.first = 9, .count = 1}};
    static const rt_path_ranges ranges = {list, 2, 2};
    static const uint64_t cases[][4] = {/* first, end; first, count of the gap */
                                        {0, 20, 0, 3},   {3, 20, 5, 4},   {4, 6, 5, 1},
                                        {5, 9, 5, 4},    {9, 20, 10, 10}, {3, 5, 5, 0},
                                        {12, 20, 12, 8}, {0, 2, 0, 2},    {7, 7, 7, 0}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const rt_path_range gap = rt_path_ranges_gap(&ranges, cases[i][0], cases[i][1]);
        assert_int_equal(gap.count, cases[i][3]);
        if (gap.count > 0)
            assert_int_equal(gap.first, cases[i][2]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sittings_make_the_map_of_an_emission_at_once),
        cmocka_unit_test(gaps_are_filled_in_their_place),
        cmocka_unit_test(more_photons_continue_a_finished_map),
        cmocka_unit_test(the_time_that_remains_is_of_what_was_lacking),
        cmocka_unit_test(other_scenes_and_settings_are_refused_with_what_differs),
        cmocka_unit_test(gaps_of_ranges_are_found),
    };
    return cmocka_run_group_tests_name("lib/photon/map_checkpoint", tests, NULL, NULL);
}
