/*
 * test_film_parts.c - a picture in parts, chunks and sittings: its sums have the bits of a render
 * at once, in every mode, in any order.
 */
#include "support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "film_renders.h"

static rt_renderer *renderer(void)
{
    static rt_renderer *made;
    if (!made)
        made = test_renderer(film_room);
    return made;
}

static rt_film *render(const rt_render_options *options)
{
    rt_film *film = NULL;
    rt_error error;
    expect_ok(rt_render(&film, renderer(), options, &error), &error);
    return film;
}

/* A film from the bytes of its file, so that each test goes through these. */
static rt_film *through_bytes(rt_film *film)
{
    size_t size, again;
    rt_film *back = NULL;
    rt_error error;
    expect_ok(rt_film_encode(film, NULL, 0, &size, &error), &error);
    uint8_t *bytes = malloc(size);
    assert_non_null(bytes);
    expect_ok(rt_film_encode(film, bytes, size, &again, &error), &error);
    assert_int_equal(size, again);
    expect_ok(rt_film_decode(&back, bytes, size, &error), &error);
    free(bytes);
    rt_film_destroy(film);
    return back;
}

/* In any order: part 2, 3, 1. */
static void parts_have_the_bits_of_a_render_at_once(void **state)
{
    enum { PARTS = 3 };
    (void)state;
    for (size_t i = 0; i < FILM_RENDERS; i++) {
        rt_render_options o = film_render_options(film_renders + i);
        rt_film *whole = render(&o), *joined = NULL;
        rt_error error;
        o.parts = PARTS;
        for (uint32_t p = 1; p <= PARTS; p++) {
            o.part = p % PARTS + 1;
            rt_film *part = through_bytes(render(&o));
            assert_true(rt_film_part_done(part, o.part, PARTS) == 1);
            if (!joined) {
                joined = part;
                continue;
            }
            expect_ok(rt_film_add(joined, part, &error), &error);
            rt_film_info info;
            rt_film_get_info(part, &info);
            if (info.units_done > 0) {
                assert_true(rt_film_part_done(part, o.part % PARTS + 1, PARTS) < 1);
                assert_true(rt_film_part_done(part, 0, 0) == rt_film_part_done(part, 1, 1));
                assert_true(rt_film_part_done(part, 0, 0) < 1);
                assert_true(rt_film_part_done(part, PARTS + 1, PARTS) == 0);
                assert_true(rt_film_part_done(part, 0, PARTS) == 0);
                assert_int_equal(rt_film_add(joined, part, &error), RT_ERROR_USAGE);
            }
            rt_film_destroy(part);
        }
        joined = through_bytes(joined);
        assert_null(rt_film_rgb(joined));
        assert_int_equal(rt_film_write(joined, "none.exr", NULL, &error), RT_ERROR_USAGE);
        expect_ok(rt_film_resolve(joined, NULL, &error), &error);
        expect_same_film(whole, joined, film_renders[i].name);
        rt_film_destroy(joined);
        rt_film_destroy(whole);
    }
}

/* Cancels at the report of this number. */
static int cancel(void *user, const rt_progress *progress)
{
    int *left = user;
    (void)progress;
    return --*left < 0;
}

/* A checkpoint kept in memory. */
static void keep(void *user, const rt_film *film)
{
    rt_film **kept = user;
    size_t size;
    rt_error error;
    rt_film_info info;
    rt_film_get_info(film, &info);
    if (info.units_done == 0)
        return;
    rt_film_destroy(*kept);
    *kept = NULL;
    expect_ok(rt_film_encode(film, NULL, 0, &size, &error), &error);
    uint8_t *bytes = malloc(size);
    assert_non_null(bytes);
    expect_ok(rt_film_encode(film, bytes, size, &size, &error), &error);
    expect_ok(rt_film_decode(kept, bytes, size, &error), &error);
    free(bytes);
}

/* Cancelled again and again, and continued from the last checkpoint. */
static void sittings_have_the_bits_of_a_render_at_once(void **state)
{
    (void)state;
    for (size_t i = 0; i < FILM_RENDERS; i++) {
        rt_render_options o = film_render_options(film_renders + i);
        rt_film *whole = render(&o), *film = NULL, *kept = NULL;
        rt_hooks hooks = {.progress = cancel};
        rt_error error;
        rt_status status = RT_CANCELLED;
        int sittings = 0;
        o.parts = o.part = 0;
        o.checkpoint = keep;
        o.checkpoint_user = &kept;
        o.hooks = &hooks;
        for (int reports = 3; status == RT_CANCELLED; reports += 2, sittings++) {
            int left = reports;
            hooks.user = &left;
            o.resume = kept;
            rt_film *from = kept;
            kept = NULL;
            rt_film_destroy(film);
            film = NULL;
            o.resume = from;
            status = rt_render(&film, renderer(), &o, &error);
            if (!kept) {
                kept = from;
                from = NULL;
            }
            rt_film_destroy(from);
        }
        expect_ok(status, &error);
        assert_true(sittings > 1);
        expect_same_film(whole, film, film_renders[i].name);
        rt_film_destroy(kept);
        rt_film_destroy(film);
        rt_film_destroy(whole);
    }
}

/* Reports of a render that began with half of it, and how many told the time that remains. */
static int expect_half(void *user, const rt_progress *p)
{
    int *count = user;
    assert_false(isnan(p->remaining));
    if (p->stage != RT_STAGE_RENDER && p->stage != RT_STAGE_GATHER)
        return 0;
    if (p->fraction >= 1 || p->remaining < 0)
        return 0;
    const double right = p->elapsed * (1 - p->fraction) / (p->fraction - 0.5);
    assert_true(p->fraction > 0.5);
    assert_true(fabs(p->remaining - right) <= 1e-6 * right);
    ++*count;
    return 0;
}

/* A first checkpoint that takes so long that progress is reported right behind it. */
static void take_long(void *user, const rt_film *film)
{
    (void)user;
    (void)film;
    nanosleep(&(struct timespec){0, 110000000}, NULL);
}

static void the_time_that_remains_is_of_what_was_left(void **state)
{
    const rt_render_options modes[] = {
        {.mode = RT_MODE_PATH, .spp = 16},
        {.mode = RT_MODE_PHOTON, .spp = 16, .photons = 2000},
        {.mode = RT_MODE_PHOTON, .spp = 1, .passes = 16, .photons = 500},
        {.mode = RT_MODE_VCM, .spp = 16}};
    (void)state;
    for (size_t i = 0; i < sizeof modes / sizeof *modes; i++) {
        const film_render r = {"half", modes[i]};
        rt_render_options o = film_render_options(&r);
        int count = 0;
        const rt_hooks hooks = {.progress = expect_half, .user = &count};
        const uint32_t spp = o.spp, passes = o.passes;
        o.parts = o.part = 1;
        o.spp = passes > 0 ? spp : spp / 2;
        o.passes = passes / 2;
        rt_film *half = through_bytes(render(&o));
        o.parts = o.part = 0;
        o.resume = half;
        o.spp = spp;
        o.passes = passes;
        o.hooks = &hooks;
        o.checkpoint = take_long;
        rt_film *whole = render(&o);
        assert_true(count > 0);
        o.resume = whole; /* of which nothing is left */
        rt_film *same = render(&o);
        rt_film_destroy(same);
        rt_film_destroy(whole);
        rt_film_destroy(half);
    }
}

/* A film whose error was small enough is not gone on with, unless a smaller one is asked for. */
static void a_film_that_reached_its_error_stays_as_it_is(void **state)
{
    const rt_render_options modes[] = {
        {.mode = RT_MODE_PATH, .target_error = 0.3},
        {.mode = RT_MODE_PHOTON, .passes = 1000, .photons = 500, .target_error = 0.3}};
    (void)state;
    for (size_t i = 0; i < sizeof modes / sizeof *modes; i++) {
        const film_render r = {"to an error", modes[i]};
        rt_render_options o = film_render_options(&r);
        rt_film *film = render(&o);
        rt_film_stats stats;
        rt_film_get_stats(film, &stats);
        assert_true(stats.relative_error_bound <= o.target_error);
        rt_film *kept = through_bytes(render(&o));
        o.resume = kept;
        rt_film *same = render(&o);
        expect_same_film(film, same, "resumed at its end");
        o.target_error = 0.1;
        rt_film *more = render(&o);
        o.resume = NULL;
        rt_film *whole = render(&o);
        expect_same_film(whole, more, "resumed to a smaller error");
        rt_film *films[] = {film, kept, same, more, whole};
        for (size_t k = 0; k < sizeof films / sizeof *films; k++)
            rt_film_destroy(films[k]);
    }
}

/* Of a small picture, still of four chunks a block, the last of them shorter. */
static rt_render_options small_options(const film_render *r)
{
    rt_render_options o = film_render_options(r);
    o.width = 19;
    o.height = 11;
    return o;
}

static void more_samples_or_passes_continue_a_finished_film(void **state)
{
    (void)state;
    for (size_t i = 0; i < FILM_RENDERS; i++) {
        rt_render_options o = small_options(film_renders + i);
        const int in_passes = o.passes > 1;
        rt_film *less = through_bytes(render(&o));
        rt_error error;
        o.spp = in_passes ? o.spp : 2 * o.spp + 3;
        o.passes = in_passes ? 2 * o.passes + 1 : 0;
        rt_film *whole = render(&o);
        o.resume = less;
        rt_film *film = render(&o);
        expect_same_film(whole, film, film_renders[i].name);
        rt_film_info info;
        rt_film_get_info(film, &info);
        assert_true(info.done == 1 && info.units_done == info.units);
        rt_film *none = NULL;
        o.resume = film;
        o.spp = in_passes ? o.spp : film_renders[i].options.spp - 1;
        o.passes = in_passes ? 2 : 0;
        assert_int_equal(rt_render(&none, renderer(), &o, &error), RT_ERROR_USAGE);
        assert_string_equal(error.field, in_passes ? "passes" : "spp");
        rt_film_destroy(less);
        rt_film_destroy(film);
        rt_film_destroy(whole);
    }
}

static void a_film_that_was_not_kept_is_not_continued(void **state)
{
    rt_render_options o = film_renders[0].options;
    rt_film *more = NULL;
    rt_error error;
    (void)state;
    o.checkpoint = NULL;
    o.part = o.parts = 0;
    rt_film *film = render(&o);
    o.resume = film;
    assert_int_equal(rt_render(&more, renderer(), &o, &error), RT_ERROR_USAGE);
    assert_non_null(strstr(error.message, "without a part (1 of 1 for the whole picture) or"));
    assert_int_equal(rt_film_save(film, "/nonesuch", &error), RT_ERROR_USAGE);
    assert_non_null(strstr(error.message, "cannot be kept"));
    rt_film_destroy(film);
}

/* Continues a film to so many samples; it is the film of a render at once, or refused. */
static void expect_continued(const rt_render_options *options, const rt_film *from, uint32_t spp,
                             int is_refused, const char *name)
{
    rt_render_options o = *options;
    rt_film *film = NULL;
    rt_error error;
    o.spp = spp;
    o.resume = from;
    const rt_status status = rt_render(&film, renderer(), &o, &error);
    if (is_refused) {
        assert_int_equal(status, RT_ERROR_USAGE);
        assert_string_equal(error.field, "spp");
        assert_null(film);
        return;
    }
    expect_ok(status, &error);
    o.resume = NULL;
    rt_film *whole = render(&o);
    expect_same_film(whole, film, name);
    rt_film_info info;
    rt_film_get_info(film, &info);
    assert_true(info.done == 1 && info.units_done == info.units);
    rt_film_destroy(whole);
    rt_film_destroy(film);
}

/* Chunk `chunk`, counted from the end where it is negative, of so many samples. */
static rt_film *render_chunk(const rt_render_options *options, uint32_t spp, int64_t chunk)
{
    rt_render_options o = *options;
    rt_film *film = NULL;
    rt_error error;
    uint64_t chunks;
    o.spp = spp;
    expect_ok(rt_chunk_count(&chunks, &o, &error), &error);
    expect_ok(rt_chunk_render(&film, renderer(), &o,
                              chunk < 0 ? chunks - (uint64_t)-chunk : (uint64_t)chunk, 1, &error),
              &error);
    return through_bytes(film);
}

/* Of 19 samples the last three are of a block that goes on to 24, in one sequence. */
static void an_unfinished_film_takes_other_samples_where_its_own_stay(void **state)
{
    (void)state;
    for (size_t i = 0; i < FILM_RENDERS; i++) {
        rt_render_options o = small_options(film_renders + i);
        /* An iteration is whole. */
        const int is_cut = o.mode != RT_MODE_PHOTON && o.mode != RT_MODE_VCM;
        if (o.passes > 1)
            continue;
        rt_film *first = render_chunk(&o, 19, 0), *last = render_chunk(&o, 19, -1);
        expect_continued(&o, first, 40, 0, film_renders[i].name);
        expect_continued(&o, first, 10, 0, film_renders[i].name);
        expect_continued(&o, last, 40, is_cut, film_renders[i].name);
        expect_continued(&o, last, 10, 1, film_renders[i].name);
        rt_film_destroy(last);
        rt_film_destroy(first);
    }
}

/* What a film from a file or from another machine does not know, it does not take away. */
static void the_light_power_stays(void **state)
{
    rt_render_options o = {.width = 8, .height = 8, .spp = 2, .mode = RT_MODE_PATH};
    rt_film *film = NULL, *part = render_chunk(&o, 2, 0);
    rt_film_stats before, after;
    rt_error error;
    (void)state;
    expect_ok(rt_film_begin(&film, renderer(), &o, &error), &error);
    rt_film_get_stats(film, &before);
    assert_true(before.light_power > 0);
    expect_ok(rt_film_add(film, part, &error), &error);
    rt_film_get_stats(film, &after);
    assert_true(after.light_power == before.light_power);
    rt_film_destroy(part);
    rt_film_destroy(film);
}

/* In the order of a stranger: from both ends. */
static void chunks_have_the_bits_of_a_render_at_once(void **state)
{
    (void)state;
    for (size_t i = 0; i < FILM_RENDERS; i++) {
        rt_render_options o = small_options(film_renders + i);
        rt_film *whole = render(&o), *joined = NULL;
        rt_error error;
        uint64_t chunks;
        expect_ok(rt_chunk_count(&chunks, &o, &error), &error);
        for (uint64_t c = 0; c < chunks; c++) {
            const uint64_t chunk = c % 2 ? chunks - 1 - c / 2 : c / 2;
            rt_film *film = NULL;
            expect_ok(rt_chunk_render(&film, renderer(), &o, chunk, 1, &error), &error);
            if (joined) {
                expect_ok(rt_film_add(joined, film, &error), &error);
                rt_film_destroy(film);
            } else {
                joined = film;
            }
        }
        expect_ok(rt_film_resolve(joined, NULL, &error), &error);
        expect_same_film(whole, joined, film_renders[i].name);
        rt_film_destroy(joined);
        rt_film_destroy(whole);
    }
}

/* Tasks divide the chunks, whatever their number; the films of some pass through a pipe. */
static void tasks_through_a_pipe_have_the_bits_of_a_render_at_once(void **state)
{
    static const uint64_t divisions[] = {1, 3, 1000};
    rt_render_options o = film_render_options(film_renders);
    rt_film *sum = NULL;
    rt_error error;
    uint64_t chunks;
    (void)state;
    o.width = 19;
    o.height = 11;
    rt_film *whole = render(&o);
    expect_ok(rt_chunk_count(&chunks, &o, &error), &error);
    for (size_t d = 0; d < 3; d++) {
        uint64_t end = whole->units.count;
        for (uint64_t i = 0; i < divisions[d]; i++) {
            uint64_t first, units;
            expect_ok(rt_chunk_task(&first, &units, &o, i, divisions[d], &error), &error);
            assert_int_equal(units > 0, i < chunks);
            assert_true(units == 0 || first + units == end);
            end -= units;
        }
        assert_int_equal(end, 0);
    }
    assert_int_equal(rt_chunk_task(&chunks, &chunks, &o, 3, 3, &error), RT_ERROR_USAGE);

    /* Two small films in one pipe, which holds both: on Linux it has room for 64 KiB. */
    int ends[2];
    assert_int_equal(pipe(ends), 0);
    for (uint64_t chunk = 0; chunk < 2; chunk++) {
        rt_film *film = NULL;
        const uint64_t split = chunks / 2;
        expect_ok(rt_chunk_render(&film, renderer(), &o, chunk * split,
                                  chunk ? chunks - split : split, &error),
                  &error);
        expect_ok(rt_film_send(film, ends[1], &error), &error);
        rt_film_destroy(film);
    }
    close(ends[1]);
    expect_ok(rt_film_receive(&sum, ends[0], &error), &error);
    expect_ok(rt_film_receive(&sum, ends[0], &error), &error);
    assert_int_equal(rt_film_receive(&sum, ends[0], &error), RT_ERROR_INPUT);
    assert_non_null(strstr(error.message, "ended before anything came"));
    close(ends[0]);
    assert_int_equal(rt_film_receive(&sum, ends[0], &error), RT_ERROR_INPUT);
    assert_int_equal(rt_film_send(sum, ends[0], &error), RT_ERROR_OUTPUT);
    expect_ok(rt_film_resolve(sum, NULL, &error), &error);
    expect_same_film(whole, sum, "pipe");
    rt_film_destroy(sum);
    rt_film_destroy(whole);
}

/* A film covers its parts, and not what only another part has. */
static void a_film_covers_what_it_was_made_of(void **state)
{
    rt_render_options o = {.width = 9, .height = 8, .spp = 3, .parts = 3};
    rt_film *parts[3], *sum;
    rt_error error;
    (void)state;
    for (o.part = 1; o.part <= 3; o.part++)
        parts[o.part - 1] = render(&o);
    o.part = 1;
    sum = render(&o);
    expect_ok(rt_film_covers(sum, parts[0], &error), &error);
    assert_int_equal(rt_film_covers(sum, parts[2], &error), RT_ERROR_USAGE);
    expect_ok(rt_film_add(sum, parts[2], &error), &error);
    expect_ok(rt_film_covers(sum, parts[0], &error), &error);
    expect_ok(rt_film_covers(sum, parts[2], &error), &error);
    assert_int_equal(rt_film_covers(sum, parts[1], &error), RT_ERROR_USAGE);
    assert_int_equal(rt_film_covers(parts[0], sum, &error), RT_ERROR_USAGE);
    assert_int_equal(rt_film_covers(sum, NULL, &error), RT_ERROR_USAGE);
    rt_film_destroy(sum);
    o.seed = 4;
    sum = render(&o);
    assert_int_equal(rt_film_covers(sum, parts[0], &error), RT_ERROR_USAGE);
    assert_string_equal(error.field, "seed");
    rt_film_destroy(sum);
    for (int i = 0; i < 3; i++)
        rt_film_destroy(parts[i]);
}

static void what_does_not_fit_is_refused_by_name(void **state)
{
    static const char other_camera[] = "camera { eye 0 1 3  look_at 0 1 0 }\n";
    static rt_render_options base = {.width = 8, .height = 8, .spp = 2, .part = 1, .parts = 2};
    rt_renderer *other = test_renderer(other_camera);
    rt_film *film = render(&base), *second = NULL;
    rt_error error;
    (void)state;

    rt_render_options o = base;
    o.part = 2;
    o.max_depth = 7;
    second = render(&o);
    assert_int_equal(rt_film_add(film, second, &error), RT_ERROR_USAGE);
    assert_string_equal(error.field, "max_depth");
    rt_film_destroy(second);

    o = base;
    o.part = 2;
    expect_ok(rt_render(&second, other, &o, &error), &error);
    assert_int_equal(rt_film_add(film, second, &error), RT_ERROR_USAGE);
    assert_non_null(strstr(error.message, "another scene"));
    rt_film_destroy(second);

    o.parts = o.part = 0;
    second = render(&o);
    assert_int_equal(rt_film_add(film, second, &error), RT_ERROR_USAGE);
    size_t size;
    assert_int_equal(rt_film_encode(second, NULL, 0, &size, &error), RT_ERROR_USAGE);
    rt_film_destroy(second);

    o = base;
    o.part = 3;
    assert_int_equal(rt_render(&second, renderer(), &o, &error), RT_ERROR_USAGE);
    assert_string_equal(error.field, "part");
    o.part = 1;
    o.target_error = 0.1;
    assert_int_equal(rt_render(&second, renderer(), &o, &error), RT_ERROR_USAGE);
    rt_film_destroy(film);
    rt_renderer_destroy(other);
}

static int release(void **state)
{
    (void)state;
    rt_renderer_destroy(renderer());
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parts_have_the_bits_of_a_render_at_once),
        cmocka_unit_test(sittings_have_the_bits_of_a_render_at_once),
        cmocka_unit_test(the_time_that_remains_is_of_what_was_left),
        cmocka_unit_test(a_film_that_reached_its_error_stays_as_it_is),
        cmocka_unit_test(a_film_that_was_not_kept_is_not_continued),
        cmocka_unit_test(more_samples_or_passes_continue_a_finished_film),
        cmocka_unit_test(an_unfinished_film_takes_other_samples_where_its_own_stay),
        cmocka_unit_test(the_light_power_stays),
        cmocka_unit_test(chunks_have_the_bits_of_a_render_at_once),
        cmocka_unit_test(tasks_through_a_pipe_have_the_bits_of_a_render_at_once),
        cmocka_unit_test(a_film_covers_what_it_was_made_of),
        cmocka_unit_test(what_does_not_fit_is_refused_by_name),
    };
    return cmocka_run_group_tests(tests, NULL, release);
}
