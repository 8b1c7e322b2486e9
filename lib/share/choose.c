/*
 * choose.c - how much work a worker is given: large amounts first, smaller ones towards the end, so
 * that workers of different speeds end together.
 *
 * References:
 *   Polychronopoulos, Kuck: "Guided Self-Scheduling: A Practical Scheduling Scheme for Parallel
 *     Supercomputers", IEEE Transactions on Computers 36(12), 1987.
 */
#include <math.h>

#include "base/progress.h"
#include "share/share.h"

/* The time that a worker is given work for, and how much more at most than the last time. */
static const double most_seconds = 1.5, least_seconds = 0.05, growth = 8;

/* Chunks for a worker whose speed is unknown. */
enum { first_chunks = 4 };

double rt_share_rendered(const rt_share *share)
{
    double rendered = rt_film_samples_done(share->film);
    for (uint32_t i = 0; i < share->count; i++)
        rendered += share->workers[i].rendered;
    return rendered;
}

double rt_share_all(const rt_share *share)
{
    return share->film->units.samples;
}

int rt_share_is_out_of_time(const rt_share *share, double now)
{
    return share->options.time > 0 && share->began > 0 &&
           now - share->began >= share->options.time &&
           (share->film->units.base > 0 ||
            rt_coverage_prefix(&share->given) >= share->film->units.items);
}

/* Samples or passes a second of all workers; one whose speed is unknown counts as a mean one. */
static double all_rates(const rt_share *share)
{
    double sum = 0, known = 0, workers = 0;
    for (uint32_t i = 0; i < share->count; i++) {
        workers += !share->workers[i].is_gone;
        known += !share->workers[i].is_gone && share->workers[i].rate > 0;
        sum += share->workers[i].is_gone ? 0 : share->workers[i].rate;
    }
    return known > 0 ? sum * workers / known : 0;
}

/* Where the units that may be handed out end. */
static uint64_t end_of(const rt_share *share)
{
    const rt_units *units = &share->film->units;
    return share->horizon < units->count ? share->horizon : units->count;
}

/* Samples or passes from the first unit that nobody has, up to the horizon. */
static double left(const rt_share *share, uint64_t first)
{
    const rt_units *units = &share->film->units;
    return rt_units_samples_before(units, end_of(share)) - rt_units_samples_before(units, first);
}

/* What a worker of known speed is to get. */
static double amount_for(const rt_share *share, const rt_share_worker *worker, uint64_t first,
                         double now)
{
    const double rates = all_rates(share);
    double seconds = fmin(left(share, first) / rates / 2, most_seconds);
    if (share->options.time > 0)
        seconds = fmin(seconds, share->began + share->options.time - now);
    return fmin(worker->rate * fmax(seconds, least_seconds), growth * worker->given);
}

rt_unit_range rt_share_choose(const rt_share *share, const rt_share_worker *worker, double now)
{
    const rt_units *units = &share->film->units;
    const rt_unit_range gap = rt_coverage_gap(&share->given, 0, end_of(share));
    if (gap.count == 0)
        return gap;
    const double wanted = worker->rate > 0 ? amount_for(share, worker, gap.first, now) : 0;
    rt_unit_range out = {gap.first, 0};
    double amount = 0;
    for (int chunks = 0; out.count < gap.count; chunks++) {
        const uint64_t at = out.first + out.count;
        const rt_unit_range chunk = rt_units_chunk(units, rt_units_chunk_of(units, at));
        rt_unit_range more = {at, chunk.first + chunk.count - at};
        if (more.count > gap.count - out.count)
            more.count = gap.count - out.count;
        amount += rt_units_amount(units, more);
        if (chunks > 0 && (worker->rate > 0 ? amount > wanted : chunks >= first_chunks))
            break;
        out.count += more.count;
    }
    return out;
}
