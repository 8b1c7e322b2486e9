/*
 * test_share.c - a picture that several workers share has the bits of a render by one, in every
 * mode, also when workers are lost and when the error ends it.
 */
#include "support.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "../mode/film_renders.h"

enum { WORKERS = 3 };

/* Each with a device of its own, as in different processes. */
static rt_device *devices[WORKERS];
static rt_renderer *renderers[WORKERS];

static int open_workers(void **state)
{
    rt_scene *scene = NULL;
    rt_error error;
    (void)state;
    expect_ok(rt_scene_parse(&scene, film_room, "room", NULL, &error), &error);
    for (int i = 0; i < WORKERS; i++) {
        devices[i] = test_device_open(1, 0);
        expect_ok(rt_renderer_create(&renderers[i], scene, devices[i], NULL, &error), &error);
    }
    rt_scene_destroy(scene);
    return 0;
}

static int close_workers(void **state)
{
    (void)state;
    for (int i = 0; i < WORKERS; i++) {
        rt_renderer_destroy(renderers[i]);
        rt_device_close(devices[i]);
    }
    return 0;
}

static rt_film *render_alone(const rt_render_options *options)
{
    rt_render_options o = *options;
    rt_film *film = NULL;
    rt_error error;
    o.part = o.parts = 1;
    o.checkpoint = NULL;
    expect_ok(rt_render(&film, renderers[0], &o, &error), &error);
    return film;
}

/* A worker of this process. */
typedef struct local {
    rt_share *share;
    rt_renderer *renderer;
    rt_status status;
    rt_error error;
} local;

static void *work(void *data)
{
    local *l = data;
    l->status = rt_share_render(l->share, l->renderer, NULL, &l->error);
    return NULL;
}

/* Renders with so many workers at once. */
static void work_all(rt_share *share, int count)
{
    pthread_t threads[WORKERS];
    local locals[WORKERS];
    for (int i = 0; i < count; i++) {
        locals[i] = (local){.share = share, .renderer = renderers[i]};
        assert_int_equal(pthread_create(&threads[i], NULL, work, &locals[i]), 0);
    }
    for (int i = 0; i < count; i++) {
        pthread_join(threads[i], NULL);
        expect_ok(locals[i].status, &locals[i].error);
    }
}

static rt_film *render_together(const rt_render_options *options, int count)
{
    rt_share *share = NULL;
    rt_film *film = NULL;
    rt_error error;
    expect_ok(rt_share_create(&share, renderers[0], options, &error), &error);
    work_all(share, count);
    expect_ok(rt_share_finish(&film, share, NULL, &error), &error);
    rt_share_destroy(share);
    return film;
}

static rt_render_options options_of(int i)
{
    rt_render_options o = film_render_options(film_renders + i);
    o.part = o.parts = 0;
    return o;
}

/* In photon mode without passes, the map that all workers take, emitted in parts. */
static rt_photon_map *emit_parts(const rt_render_options *options)
{
    rt_photon_map *maps[WORKERS] = {NULL}, *map = NULL;
    rt_error error;
    if (options->mode != RT_MODE_PHOTON || options->passes > 1)
        return NULL;
    for (uint32_t i = 0; i < WORKERS; i++) {
        const rt_emit_options part = {.render = options, .part = i, .parts = WORKERS};
        size_t size, again;
        expect_ok(rt_photon_map_emit(&maps[i], renderers[i], &part, &error), &error);
        expect_ok(rt_photon_map_encode(maps[i], NULL, 0, &size, &error), &error);
        uint8_t *bytes = malloc(size);
        assert_non_null(bytes);
        assert_int_equal(rt_photon_map_encode(maps[i], bytes, size - 1, &again, &error),
                         RT_ERROR_USAGE);
        expect_ok(rt_photon_map_encode(maps[i], bytes, size, &again, &error), &error);
        rt_photon_map_destroy(maps[i]);
        expect_ok(rt_photon_map_decode(&maps[i], bytes, again, NULL, &error), &error);
        free(bytes);
    }
    expect_ok(rt_photon_map_merge(&map, (const rt_photon_map *const *)maps, WORKERS, &error),
              &error);
    for (int i = 0; i < WORKERS; i++)
        rt_photon_map_destroy(maps[i]);
    return map;
}

static void a_shared_picture_has_the_bits_of_one_renderer(void **state)
{
    (void)state;
    for (int i = 0; i < FILM_RENDERS; i++) {
        rt_render_options o = options_of(i);
        rt_film *alone = render_alone(&o);
        rt_photon_map *map = emit_parts(&o);
        o.photon_map = map;
        for (int count = 1; count <= WORKERS; count++) {
            rt_film *film = render_together(&o, count);
            expect_same_film(alone, film, film_renders[i].name);
            rt_film_destroy(film);
        }
        rt_photon_map_destroy(map);
        rt_film_destroy(alone);
    }
}

/* A film of the map that was handed to it continues one that emits, and the other way round. */
static void a_map_emitted_in_parts_counts_as_the_render_s_own(void **state)
{
    rt_render_options o = options_of(4);
    rt_film *film = render_alone(&o), *empty = NULL;
    rt_error error;
    (void)state;
    assert_int_equal(o.passes, 0);
    rt_photon_map *map = emit_parts(&o);
    o.photon_map = map;
    expect_ok(rt_film_begin(&empty, renderers[0], &o, &error), &error);
    expect_ok(rt_film_add(empty, film, &error), &error);
    rt_film_destroy(empty);
    o.seed++;
    rt_photon_map *other = NULL;
    const rt_emit_options emit = {.render = &o};
    expect_ok(rt_photon_map_emit(&other, renderers[0], &emit, &error), &error);
    o.seed--;
    o.photon_map = other;
    expect_ok(rt_film_begin(&empty, renderers[0], &o, &error), &error);
    assert_int_equal(rt_film_add(empty, film, &error), RT_ERROR_USAGE);
    assert_non_null(strstr(error.message, "another photon map"));
    rt_film_destroy(empty);
    rt_photon_map_destroy(other);
    rt_photon_map_destroy(map);
    rt_film_destroy(film);
}

/* Until the error is small enough, tested where one renderer tests it. */
static void the_error_ends_a_shared_picture_where_it_ends_one_render(void **state)
{
    static const struct {
        rt_render_options options;
        double targets[3];
    } cases[] = {{{.mode = RT_MODE_PATH}, {0.3, 0.1, 0.05}},
                 {{.mode = RT_MODE_PHOTON, .passes = 200, .photons = 500}, {0.5, 0.2, 0.1}}};
    (void)state;
    for (size_t i = 0; i < 6; i++) {
        rt_render_options o = cases[i / 3].options;
        rt_film_stats stats;
        o.width = 70;
        o.height = 41;
        o.target_error = cases[i / 3].targets[i % 3];
        rt_film *alone = render_alone(&o);
        rt_film_get_stats(alone, &stats);
        assert_true(stats.relative_error_bound <= o.target_error);
        for (int count = 1; count <= WORKERS; count++) {
            rt_film *film = render_together(&o, count);
            expect_same_film(alone, film, "target error");
            rt_film_destroy(film);
        }
        rt_film_destroy(alone);
    }
}

/* What the checkpoints of a share kept. */
typedef struct kept {
    rt_film *film;
    int count;
} kept;

static void keep(void *user, const rt_film *film)
{
    kept *k = user;
    size_t size;
    rt_error error;
    expect_ok(rt_film_encode(film, NULL, 0, &size, &error), &error);
    uint8_t *bytes = malloc(size);
    assert_non_null(bytes);
    expect_ok(rt_film_encode(film, bytes, size, &size, &error), &error);
    rt_film_destroy(k->film);
    k->film = NULL;
    expect_ok(rt_film_decode(&k->film, bytes, size, &error), &error);
    free(bytes);
    k->count++;
}

/* Stops after so many reports. */
static int stop(void *user, const rt_progress *progress)
{
    int *reports = user;
    (void)progress;
    return --*reports < 0;
}

/* A worker takes units and never returns them. */
static void what_a_lost_worker_held_is_rendered_by_others(void **state)
{
    rt_render_options o = options_of(0);
    rt_film *alone = render_alone(&o), *film = NULL;
    rt_share *share = NULL;
    uint64_t first, count;
    uint32_t lost;
    rt_error error;
    (void)state;
    expect_ok(rt_share_create(&share, renderers[0], &o, &error), &error);
    expect_ok(rt_share_join(&lost, share, &error), &error);
    assert_int_equal(rt_share_ask(share, lost, &first, &count), RT_SHARE_RENDER);
    rt_share_leave(share, lost);
    work_all(share, 2);
    expect_ok(rt_share_finish(&film, share, NULL, &error), &error);
    expect_same_film(alone, film, "with a lost worker");
    rt_share_destroy(share);
    rt_film_destroy(film);
    rt_film_destroy(alone);
}

/* With a worker that is lost, and one that is interrupted. */
static void an_interrupted_picture_is_taken_up_by_others(void **state)
{
    (void)state;
    for (int i = 0; i < FILM_RENDERS; i++) {
        rt_render_options o = options_of(i);
        rt_film *alone = render_alone(&o), *film = NULL;
        rt_share *share = NULL;
        kept k = {NULL, 0};
        uint64_t first, count;
        uint32_t lost;
        int reports = 6;
        rt_error error;
        const rt_hooks hooks = {.progress = stop, .user = &reports};
        o.checkpoint = keep;
        o.checkpoint_user = &k;
        expect_ok(rt_share_create(&share, renderers[0], &o, &error), &error);
        expect_ok(rt_share_join(&lost, share, &error), &error);
        assert_int_equal(rt_share_ask(share, lost, &first, &count), RT_SHARE_RENDER);
        assert_int_equal(first, 0);
        assert_true(count > 0);
        assert_int_equal(rt_share_render(share, renderers[1], &hooks, &error), RT_CANCELLED);
        rt_share_leave(share, lost);
        assert_int_equal(rt_share_finish(&film, share, NULL, &error), RT_CANCELLED);
        assert_true(k.count > 0);
        rt_film_destroy(film);
        rt_share_destroy(share);
        /* Taken up by others. */
        rt_film *from = k.film;
        k.film = NULL;
        o.resume = from;
        film = render_together(&o, 2);
        expect_same_film(alone, film, film_renders[i].name);
        rt_film_destroy(film);
        rt_film_destroy(k.film);
        rt_film_destroy(from);
        rt_film_destroy(alone);
    }
}

/* Renders units on a worker elsewhere. */
static rt_units_answer next_units(void *user, uint64_t *first, uint64_t *count)
{
    rt_unit_range *range = user;
    const rt_units_answer answer = range->count > 0 ? RT_UNITS_GIVEN : RT_UNITS_NONE;
    *first = range->first;
    *count = range->count;
    range->count = 0;
    return answer;
}

/* The film of what a share gives a new worker. */
static rt_film *render_given(rt_share *share, uint32_t *worker, const rt_render_options *options)
{
    rt_render_options o = *options;
    rt_unit_range range;
    rt_film *film = NULL;
    rt_error error;
    expect_ok(rt_share_join(worker, share, &error), &error);
    assert_int_equal(rt_share_ask(share, *worker, &range.first, &range.count), RT_SHARE_RENDER);
    o.checkpoint = NULL;
    o.next_units = next_units;
    o.units_user = &range;
    expect_ok(rt_render(&film, renderers[0], &o, &error), &error);
    return film;
}

static void what_is_passed_to_one_that_has_left_is_rendered_again(void **state)
{
    rt_render_options o = options_of(1);
    rt_film *alone = render_alone(&o), *film = NULL;
    rt_share *share = NULL;
    rt_error error;
    uint32_t a, b;
    (void)state;
    expect_ok(rt_share_create(&share, renderers[0], &o, &error), &error);
    rt_film *one = render_given(share, &a, &o), *other = render_given(share, &b, &o);
    rt_share_leave(share, b);
    rt_share_pass(share, a, b);
    rt_share_leave(share, a);
    work_all(share, 1);
    expect_ok(rt_share_finish(&film, share, NULL, &error), &error);
    expect_same_film(alone, film, "a film that was rendered again");
    rt_film_destroy(one);
    rt_film_destroy(other);
    rt_film_destroy(film);
    rt_film_destroy(alone);
    rt_share_destroy(share);
}

/* A worker passes its film on to another and leaves; a third one does what is left. */
static void films_come_together_in_a_tree(void **state)
{
    rt_render_options o = options_of(1);
    rt_film *alone = render_alone(&o), *film = NULL;
    rt_share *share = NULL;
    rt_error error;
    uint32_t a, b, c;
    (void)state;
    expect_ok(rt_share_create(&share, renderers[0], &o, &error), &error);
    expect_ok(rt_share_join(&c, share, &error), &error);
    rt_film *sum = render_given(share, &a, &o), *from = render_given(share, &b, &o);
    expect_ok(rt_film_add(sum, from, &error), &error);
    assert_int_equal(rt_share_add(share, c, sum, 0, &error), RT_ERROR_USAGE);
    rt_share_pass(share, b, a);
    rt_share_leave(share, b);
    expect_ok(rt_share_add(share, a, sum, 0, &error), &error);
    work_all(share, 1);
    expect_ok(rt_share_finish(&film, share, NULL, &error), &error);
    expect_same_film(alone, film, "films of a tree");
    rt_film_destroy(sum);
    rt_film_destroy(from);
    rt_film_destroy(film);
    rt_film_destroy(alone);
    rt_share_destroy(share);
}

static void ignore(void *user, const rt_film *film)
{
    (void)user;
    (void)film;
}

static void sleep_for(double seconds)
{
    const struct timespec time = {(time_t)seconds, (long)(1e9 * (seconds - floor(seconds)))};
    nanosleep(&time, NULL);
}

/* Those who take films would do nothing else. */
static void films_are_asked_for_no_faster_than_they_can_be_taken(void **state)
{
    rt_render_options o = options_of(0);
    rt_share *share = NULL;
    rt_error error;
    uint32_t a, b;
    uint64_t first, count;
    (void)state;
    o.spp = 100000;
    o.checkpoint = ignore;
    o.checkpoint_seconds = 0.3;
    expect_ok(rt_share_create(&share, renderers[0], &o, &error), &error);
    rt_film *film = render_given(share, &a, &o), *other = render_given(share, &b, &o);
    sleep_for(0.4);
    /* It takes 100 s, so that the next one may come after 1000 s. */
    assert_int_equal(rt_share_ask(share, a, &first, &count), RT_SHARE_HAND_OVER);
    expect_ok(rt_share_add(share, a, film, 200, &error), &error);
    assert_int_equal(rt_share_ask(share, a, &first, &count), RT_SHARE_RENDER);
    sleep_for(0.4);
    assert_int_equal(rt_share_ask(share, b, &first, &count), RT_SHARE_HAND_OVER);
    expect_ok(rt_share_add(share, b, other, 200, &error), &error);
    assert_int_equal(rt_share_ask(share, b, &first, &count), RT_SHARE_RENDER);
    sleep_for(0.4);
    assert_int_equal(rt_share_ask(share, a, &first, &count), RT_SHARE_RENDER);
    assert_int_equal(rt_share_ask(share, b, &first, &count), RT_SHARE_RENDER);
    /* More than ten times the interval is not to be lost. */
    sleep_for(3);
    assert_int_equal(rt_share_ask(share, a, &first, &count), RT_SHARE_HAND_OVER);
    assert_int_equal(rt_share_ask(share, a, &first, &count), RT_SHARE_HAND_OVER);
    rt_film_destroy(film);
    rt_film_destroy(other);
    rt_share_destroy(share);
}

/* Finished films are continued to more samples, by one renderer and by several. */
static void a_finished_picture_is_raised_by_several(void **state)
{
    (void)state;
    for (int i = 0; i < FILM_RENDERS; i++) {
        rt_render_options o = options_of(i);
        kept k = {NULL, 0};
        rt_photon_map *map = emit_parts(&o);
        o.photon_map = map;
        o.checkpoint = keep;
        o.checkpoint_user = &k;
        rt_film_destroy(render_together(&o, 1));
        rt_film *finished = k.film;
        k.film = NULL;
        if (o.passes > 1)
            o.passes += 7;
        else
            o.spp = 2 * o.spp + 3;
        rt_film *alone = render_alone(&o);
        o.resume = finished;
        for (int count = 1; count <= WORKERS; count++) {
            rt_film *film = render_together(&o, count);
            expect_same_film(alone, film, film_renders[i].name);
            rt_film_destroy(film);
        }
        rt_film_destroy(alone);
        rt_film_destroy(k.film);
        rt_film_destroy(finished);
        rt_photon_map_destroy(map);
    }
}

/* The samples of the finished film are in one of the films, once. */
static void what_was_raised_counts_once(void **state)
{
    rt_render_options o = options_of(0);
    rt_film *whole = NULL, *rest = NULL, *copy = NULL, *raised = NULL;
    rt_error error;
    size_t size;
    uint8_t bytes[4096];
    (void)state;
    expect_ok(rt_film_begin(&rest, renderers[0], &o, &error), &error);
    o.parts = o.part = 1;
    expect_ok(rt_render(&whole, renderers[0], &o, &error), &error);
    o.resume = whole;
    o.spp += 9;
    expect_ok(rt_film_begin(&raised, renderers[0], &o, &error), &error);
    assert_int_equal(rt_film_add(raised, raised, &error), RT_ERROR_USAGE);
    assert_non_null(strstr(error.message, "both films have"));
    rt_film_destroy(rest);
    o.resume = NULL;
    expect_ok(rt_film_begin(&rest, renderers[0], &o, &error), &error);
    assert_int_equal(rt_film_add(raised, rest, &error), RT_ERROR_USAGE);
    rt_film_destroy(rest);
    o.raised_from = o.spp - 9;
    expect_ok(rt_film_begin(&rest, renderers[0], &o, &error), &error);
    expect_ok(rt_film_encode(rest, bytes, sizeof bytes, &size, &error), &error);
    expect_ok(rt_film_decode(&copy, bytes, size, &error), &error);
    assert_true(copy->lacks_base);
    expect_ok(rt_film_add(rest, raised, &error), &error);
    assert_false(rest->lacks_base);
    expect_ok(rt_film_add(rest, copy, &error), &error);
    o.raised_from = o.spp + 1;
    assert_int_equal(rt_render_options_check(&o, &error), RT_ERROR_USAGE);
    assert_string_equal(error.field, "raised_from");
    rt_film_destroy(copy);
    rt_film_destroy(rest);
    rt_film_destroy(raised);
    rt_film_destroy(whole);
}

/* Asks how far the picture is, and ends it. */
static void ask_and_stop(void *user, const rt_film *film)
{
    rt_share *const *share = user;
    rt_progress progress;
    uint64_t first, count;
    (void)film;
    rt_share_get_progress(*share, &progress);
    assert_true(progress.fraction > 0);
    rt_share_stop(*share);
    assert_int_not_equal(rt_share_ask(*share, 0, &first, &count), RT_SHARE_RENDER);
}

static void callbacks_may_ask_and_stop(void **state)
{
    (void)state;
    for (int shows = 0; shows < 2; shows++) {
        rt_render_options o = options_of(0);
        rt_share *share = NULL;
        rt_film *film = NULL;
        rt_error error;
        *(shows ? &o.preview : &o.checkpoint) = ask_and_stop;
        *(shows ? &o.preview_user : &o.checkpoint_user) = &share;
        expect_ok(rt_share_create(&share, renderers[0], &o, &error), &error);
        expect_ok(rt_share_render(share, renderers[0], NULL, &error), &error);
        rt_share_finish(&film, share, NULL, &error);
        rt_share_destroy(share);
        rt_film_destroy(film);
    }
}

static void only_what_was_given_is_taken(void **state)
{
    rt_render_options o = options_of(0);
    rt_share *share = NULL;
    rt_error error;
    uint32_t worker;
    uint64_t first, count;
    (void)state;
    rt_film *whole = render_alone(&o);
    expect_ok(rt_share_create(&share, renderers[0], &o, &error), &error);
    expect_ok(rt_share_join(&worker, share, &error), &error);
    assert_int_equal(rt_share_ask(share, worker, &first, &count), RT_SHARE_RENDER);
    assert_int_equal(rt_share_add(share, worker, whole, 0, &error), RT_ERROR_USAGE);
    /* Nor from a worker that there is not. */
    assert_int_equal(rt_share_add(share, worker + 1, whole, 0, &error), RT_ERROR_USAGE);
    assert_string_equal(error.field, "worker");
    assert_int_equal(rt_share_ask(share, worker + 1, &first, &count), RT_SHARE_END);
    assert_true(first == 0 && count == 0);
    rt_share_note(share, worker + 1, 0, 1, 1);
    rt_share_pass(share, worker, worker + 1);
    rt_share_leave(share, worker + 1);
    /* Nothing of it is waited for. */
    rt_share_stop(share);
    assert_int_equal(rt_share_ask(share, worker, &first, &count), RT_SHARE_END);
    rt_share_destroy(share);
    rt_film_destroy(whole);
    o.parts = 2;
    o.part = 1;
    assert_int_equal(rt_share_create(&share, renderers[0], &o, &error), RT_ERROR_USAGE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_shared_picture_has_the_bits_of_one_renderer),
        cmocka_unit_test(a_map_emitted_in_parts_counts_as_the_render_s_own),
        cmocka_unit_test(the_error_ends_a_shared_picture_where_it_ends_one_render),
        cmocka_unit_test(what_a_lost_worker_held_is_rendered_by_others),
        cmocka_unit_test(an_interrupted_picture_is_taken_up_by_others),
        cmocka_unit_test(callbacks_may_ask_and_stop),
        cmocka_unit_test(only_what_was_given_is_taken),
        cmocka_unit_test(what_is_passed_to_one_that_has_left_is_rendered_again),
        cmocka_unit_test(films_come_together_in_a_tree),
        cmocka_unit_test(films_are_asked_for_no_faster_than_they_can_be_taken),
        cmocka_unit_test(a_finished_picture_is_raised_by_several),
        cmocka_unit_test(what_was_raised_counts_once),
    };
    return cmocka_run_group_tests(tests, open_workers, close_workers);
}
