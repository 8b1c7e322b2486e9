/* test_units.c - the units of work of a picture, and sets of them. */
#include "support.h"

#include <string.h>

#include "film/coverage.h"
#include "film/film.h"
#include "film/units.h"

static rt_units sampled(uint32_t width, uint32_t height, uint32_t spp, int variance, uint32_t base)
{
    const rt_render_options o = {
        .mode = RT_MODE_PATH, .width = width, .height = height, .spp = spp, .variance = variance};
    return rt_units_of(&o, base);
}

/* A picture of so many sequences. */
static rt_units replicated(uint32_t spp, uint32_t replicates, uint32_t base)
{
    const rt_render_options o = {.mode = RT_MODE_PATH,
                                 .width = 32,
                                 .height = RT_REPLICATES_FEW_PIXELS / 32,
                                 .spp = spp,
                                 .variance = replicates == RT_REPLICATES,
                                 .target_error = replicates > 1 ? 0.1 : 0};
    return rt_units_of(&o, base);
}

/*
 * Every replicate goes through its samples without a gap, and all samples are given out, as evenly
 * as can be; also those that a finished render lacks when it is raised.
 */
static void units_share_all_samples_evenly(void **state)
{
    static const uint32_t counts[] = {1, RT_REPLICATES_FEW, RT_REPLICATES};
    (void)state;
    for (uint32_t all = 1; all < 500; all += 1 + all / 50)
        for (int i = 0; i < 3; i++) {
            const uint32_t base = all / 3, count = counts[i];
            const rt_units units = replicated(all, count, base);
            uint32_t has[RT_REPLICATES] = {0}, given = 0;
            assert_int_equal(units.replicates, count);
            for (uint32_t r = 0; r < count; r++)
                has[r] = base / count + (r < base % count);
            for (uint64_t unit = 0; unit < units.count; unit += units.items) {
                const rt_sample_block block = rt_units_block(&units, unit);
                assert_true(block.replicate < count && block.count <= 32);
                assert_int_equal(block.first, block.count ? has[block.replicate] : block.first);
                has[block.replicate] += block.count;
                given += block.count;
            }
            assert_int_equal(given, all - base);
            for (uint32_t r = 0; r < count; r++)
                assert_true(has[r] == all / count || has[r] == all / count + 1);
        }
}

static void blocks_of_replicates_grow_together(void **state)
{
    const rt_units units = sampled(1, 1, 1u << 24, 1, 0);
    uint32_t length = 1, end = 0;
    (void)state;
    for (uint64_t unit = 0; end < 1u << 12; unit++) {
        const rt_sample_block block = rt_units_block(&units, unit);
        end = block.first + block.count;
        assert_int_equal(block.replicate, unit % RT_REPLICATES);
        assert_true(block.first < length && end <= length);
        if (block.replicate == RT_REPLICATES - 1 && end == length)
            length = rt_replicate_grow(length);
    }
    assert_int_equal(length, 1 << 12);
}

/* Photons and light paths are shared by all pixels, whose errors go together. */
static void pixels_that_share_paths_take_all_sequences(void **state)
{
    static const rt_mode modes[] = {RT_MODE_PATH, RT_MODE_DIRECT, RT_MODE_PHOTON, RT_MODE_VCM};
    (void)state;
    for (int i = 0; i < 4; i++) {
        const rt_render_options o = {.mode = modes[i],
                                     .width = RT_REPLICATES_FEW_PIXELS,
                                     .height = 1,
                                     .spp = 8,
                                     .passes = 8,
                                     .target_error = 0.1};
        assert_int_equal(rt_units_of(&o, 0).replicates, i < 2 ? RT_REPLICATES_FEW : RT_REPLICATES);
    }
}

/* Every test is where a block ends, and none is more than half as far again as the one before. */
static void tests_are_at_the_ends_of_blocks(void **state)
{
    const rt_units units = replicated(1u << 24, RT_REPLICATES_FEW, 0);
    uint32_t length = 1;
    (void)state;
    for (uint64_t unit = 0; length < 1u << 13; unit += units.items * units.replicates) {
        const rt_sample_block block = rt_units_block(&units, unit);
        const uint32_t end = block.first + block.count, next = rt_units_next_test(length);
        assert_true(end <= length);
        assert_true(next > length && (length < 2 || 2 * next <= 3 * length));
        assert_true(length < 256 || 8 * next <= 9 * length + 8);
        if (end == length)
            length = next;
    }
}

static void samples_before_a_unit_are_the_sum_of_its_blocks(void **state)
{
    (void)state;
    for (uint32_t base = 0; base < 77; base += 20) {
        const rt_units units = sampled(5, 3, 77, 1, base);
        double samples = 0;
        for (uint64_t unit = 0; unit < units.count; unit++) {
            assert_float_equal(rt_units_samples_before(&units, unit), samples, 1e-4);
            samples += (double)rt_units_block(&units, unit).count / units.items;
        }
        assert_float_equal(samples, 77 - base, 1e-4);
    }
}

/* The chunks hold every unit once, and chunk_of finds them. */
static void chunks_divide_the_units(void **state)
{
    const rt_render_options passes = {.mode = RT_MODE_PHOTON, .passes = 7, .width = 9, .height = 9};
    const rt_units all[] = {sampled(100, 90, 9, 0, 0), sampled(64, 64, 3, 1, 0),
                            rt_units_of(&passes, 0)};
    (void)state;
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        uint64_t next = 0;
        for (uint64_t chunk = 0; chunk < rt_units_chunks(all + i); chunk++) {
            const rt_unit_range range = rt_units_chunk(all + i, chunk);
            assert_true(range.first == next && range.count > 0 && range.count <= RT_CHUNK_ITEMS);
            assert_int_equal(range.first / all[i].items,
                             (range.first + range.count - 1) / all[i].items);
            assert_int_equal(rt_units_chunk_of(all + i, range.first), chunk);
            assert_int_equal(rt_units_chunk_of(all + i, range.first + range.count - 1), chunk);
            next += range.count;
        }
        assert_int_equal(next, all[i].count);
    }
}

static void samples_without_limit_take_no_time_to_count(void **state)
{
    const rt_units units = sampled(1, 1, UINT32_MAX, 0, 0);
    (void)state;
    const rt_sample_block last = rt_units_block(&units, units.count - 1);
    assert_int_equal((uint64_t)last.first + last.count, UINT32_MAX);
}

/* ---- Sets -------------------------------------------------------------------- */

/* Against a set of flags: ranges in random order, some of which overlap what is there. */
static void a_set_is_what_was_added(void **state)
{
    enum { UNITS = 300 };
    unsigned char has[UNITS + 1] = {0};
    rt_coverage set = {0};
    rt_error error;
    uint32_t random = 1;
    (void)state;
    for (int turn = 0; turn < 2000; turn++) {
        random = random * 1664525u + 1013904223u;
        const rt_unit_range range = {(random >> 8) % UNITS, 0};
        const uint64_t count = 1 + (random >> 24) % 5;
        const rt_unit_range add = {range.first,
                                   range.first + count > UNITS ? UNITS - range.first : count};
        int overlaps = 0;
        for (uint64_t u = add.first; u < add.first + add.count; u++)
            overlaps |= has[u];
        assert_int_equal(rt_coverage_add(&set, add, &error), overlaps ? RT_ERROR_USAGE : RT_OK);
        if (!overlaps)
            memset(has + add.first, 1, add.count);
        const rt_unit_range gap = rt_coverage_gap(&set, range.first, UNITS);
        uint64_t first = range.first, end;
        while (first < UNITS && has[first])
            first++;
        for (end = first; end < UNITS && !has[end];)
            end++;
        assert_int_equal(gap.count, end - first);
        assert_true(gap.count == 0 || gap.first == first);
    }
    uint64_t units = 0;
    for (int u = 0; u < UNITS; u++)
        units += has[u];
    assert_int_equal(rt_coverage_units(&set), units);
    for (size_t i = 1; i < set.count; i++)
        assert_true(set.ranges[i - 1].first + set.ranges[i - 1].count < set.ranges[i].first);
    rt_coverage_free(&set);
}

static void sets_join_unless_they_overlap(void **state)
{
    rt_coverage a = {0}, b = {0}, c = {0};
    rt_error error;
    (void)state;
    assert_int_equal(rt_coverage_add(&a, (rt_unit_range){0, 5}, &error), RT_OK);
    assert_int_equal(rt_coverage_add(&a, (rt_unit_range){10, 5}, &error), RT_OK);
    assert_int_equal(rt_coverage_add(&b, (rt_unit_range){5, 5}, &error), RT_OK);
    assert_int_equal(rt_coverage_add(&c, (rt_unit_range){14, 2}, &error), RT_OK);
    assert_int_equal(rt_coverage_join(&a, &c, &error), RT_ERROR_USAGE);
    assert_int_equal(rt_coverage_units(&a), 10);
    assert_int_equal(rt_coverage_join(&a, &b, &error), RT_OK);
    assert_true(a.count == 1 && a.ranges[0].first == 0 && a.ranges[0].count == 15);
    rt_coverage_free(&a);
    rt_coverage_free(&b);
    rt_coverage_free(&c);
}

/* ---- Parts ------------------------------------------------------------------- */

/* What of a part is done, chunk by chunk. */
static double part_done(const rt_film *film, uint32_t part, uint32_t parts)
{
    double all = 0, done = 0;
    for (uint64_t c = part - 1; c < rt_units_chunks(&film->units); c += parts) {
        const rt_unit_range range = rt_units_chunk(&film->units, c);
        const uint64_t end = range.first + range.count;
        rt_unit_range gap = rt_coverage_gap(&film->done, range.first, end);
        all += (double)range.count;
        done += (double)range.count;
        for (; gap.count > 0; gap = rt_coverage_gap(&film->done, gap.first + gap.count, end))
            done -= (double)gap.count;
    }
    return all > 0 ? done / all : 1;
}

/* Also where the last chunk of a block is shorter, and where there are more parts than chunks. */
static void what_is_done_of_a_part_is_the_sum_of_its_chunks(void **state)
{
    const rt_render_options passes = {.mode = RT_MODE_PHOTON, .passes = 7, .width = 9, .height = 9};
    const rt_units all[] = {sampled(100, 90, 9, 0, 0),  sampled(64, 64, 3, 1, 0),
                            sampled(70, 61, 5, 0, 2),   sampled(5, 3, 40, 0, 0),
                            sampled(640, 413, 2, 0, 0), rt_units_of(&passes, 0)};
    uint32_t random = 1;
    (void)state;
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        rt_film film = {.units = all[i]};
        for (int range = 0; range < 40; range++) {
            random = random * 1664525u + 1013904223u;
            const uint64_t first = (random >> 8) % all[i].count, left = all[i].count - first,
                           count = 1 + (random >> 4) % (all[i].count / 20 + 1);
            rt_coverage_add(&film.done, (rt_unit_range){first, count < left ? count : left}, NULL);
        }
        for (uint32_t parts = 1; parts < 300; parts += 1 + parts / 9)
            for (uint32_t part = 1; part <= parts; part++)
                assert_true(rt_film_part_done(&film, part, parts) == part_done(&film, part, parts));
        rt_coverage_free(&film.done);
    }
}

/* A render with --time alone has that many samples to take, and takes a few. */
static void parts_of_a_picture_without_end_take_no_time_to_count(void **state)
{
    rt_film film = {.units = sampled(1920, 1080, 1u << 24, 1, 0)};
    (void)state;
    assert_int_equal(rt_coverage_add(&film.done, (rt_unit_range){5, 1000}, NULL), RT_OK);
    for (uint32_t part = 1; part <= 1000; part++) {
        const double done = rt_film_part_done(&film, part, 1000);
        assert_true(part == 1 ? done > 0 && done < 1e-6 : done == 0);
    }
    rt_coverage_free(&film.done);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(units_share_all_samples_evenly),
        cmocka_unit_test(blocks_of_replicates_grow_together),
        cmocka_unit_test(pixels_that_share_paths_take_all_sequences),
        cmocka_unit_test(tests_are_at_the_ends_of_blocks),
        cmocka_unit_test(samples_before_a_unit_are_the_sum_of_its_blocks),
        cmocka_unit_test(chunks_divide_the_units),
        cmocka_unit_test(samples_without_limit_take_no_time_to_count),
        cmocka_unit_test(a_set_is_what_was_added),
        cmocka_unit_test(sets_join_unless_they_overlap),
        cmocka_unit_test(what_is_done_of_a_part_is_the_sum_of_its_chunks),
        cmocka_unit_test(parts_of_a_picture_without_end_take_no_time_to_count),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
