/* ledger.c - flux booked in whole numbers of a small unit, light by light. */
#include "photon/ledger.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/parallel.h"

/*
 * Bits of a unit below the flux of one path: rounding is 4e-9 of it, and 10^11 paths fit into a
 * sum.
 */
enum { UNIT_BITS = 26 };

/* A path carries the power of its light over the light's share. */
int32_t rt_ledger_exponent(const rt_light_source *source)
{
    double largest = fmax(source->power[0], fmax(source->power[1], source->power[2]));
    int exponent;
    frexp(source->share > 0 ? largest / source->share : 0, &exponent);
    return exponent - UNIT_BITS;
}

static const char what[] = "the energy ledger";

rt_status rt_ledger_create(rt_ledger *out, const rt_light_sources *lights, rt_error *error)
{
    rt_ledger l = {.count = lights->count};

    l.rows = rt_memory_zeroed(lights->memory, l.count, sizeof *l.rows, what, error);
    if (!l.rows)
        return RT_ERROR_MEMORY;
    for (size_t i = 0; i < l.count; i++) {
        const rt_light_source *source = lights->sources + i;
        l.rows[i].shape = source->shape;
        l.rows[i].exponent = rt_ledger_exponent(source);
        l.rows[i].share = source->share;
        memcpy(l.rows[i].power, source->power, sizeof l.rows[i].power);
    }
    *out = l;
    return RT_OK;
}

void rt_ledger_free(rt_ledger *ledger)
{
    rt_memory_free(ledger->rows);
    memset(ledger, 0, sizeof *ledger);
}

void rt_ledger_reset(rt_ledger *ledger)
{
    for (size_t i = 0; i < ledger->count; i++) {
        ledger->rows[i].paths = 0;
        memset(ledger->rows[i].sums, 0, sizeof ledger->rows[i].sums);
    }
    ledger->paths = ledger->rejected = 0;
}

/* Accounts being booked by several jobs, each into rows of its own, which are then added. */
typedef struct booking {
    const rt_light_sources *lights;
    const rt_path_account *accounts;
    size_t count, paths_a_job;
    double *per_unit;    /* [row_count] */
    rt_ledger_row *rows; /* [jobs][row_count] */
    size_t row_count;
    uint64_t *rejected; /* [jobs] */
} booking;

static int is_sound(const rt_path_account *a)
{
    float sum = 0;
    for (int c = 0; c < 3; c++)
        sum += 0 * a->emitted[c] + 0 * a->absorbed[c] + 0 * a->left[c] + 0 * a->roulette[c];
    return sum == 0;
}

/* Adds flux to a column, clamped so that the sums cannot overflow. */
static void book(int64_t sums[3], const float flux[3], double per_unit)
{
    static const double most = 1099511627776.0; /* 2^40 units */
    for (int c = 0; c < 3; c++) {
        double units = flux[c] * per_unit;
        units = units > most ? most : units < -most ? -most : units;
        sums[c] += (int64_t)(units + (units < 0 ? -0.5 : 0.5));
    }
}

static void book_share(void *user, uint32_t index)
{
    const booking *b = user;
    rt_ledger_row *rows = b->rows + index * b->row_count;
    size_t first = index * b->paths_a_job, end = first + b->paths_a_job;
    for (size_t i = first; i < end && i < b->count; i++) {
        const rt_path_account *a = b->accounts + i;
        if (a->light == RT_NONE)
            continue;
        if (!is_sound(a)) {
            b->rejected[index]++;
            continue;
        }
        rt_ledger_row *row = rows + b->lights->of_light[a->light];
        double per_unit = b->per_unit[b->lights->of_light[a->light]];
        row->paths++;
        book(row->sums[RT_LEDGER_EMITTED], a->emitted, per_unit);
        book(row->sums[RT_LEDGER_ABSORBED], a->absorbed, per_unit);
        book(row->sums[RT_LEDGER_ROULETTE], a->roulette, per_unit);
        if (a->end != RT_END_ABSORBED)
            book(row->sums[a->end == RT_END_ESCAPED ? RT_LEDGER_ESCAPED : RT_LEDGER_CUT_OFF],
                 a->left, per_unit);
    }
}

/* Sums that came from a damaged file may wrap around. */
static void add_row(rt_ledger_row *to, const rt_ledger_row *from)
{
    to->paths += from->paths;
    for (int column = 0; column < RT_LEDGER_COLUMNS; column++)
        for (int c = 0; c < 3; c++)
            to->sums[column][c] =
                (int64_t)((uint64_t)to->sums[column][c] + (uint64_t)from->sums[column][c]);
}

rt_status rt_ledger_book(rt_ledger *ledger, const rt_light_sources *lights,
                         const rt_path_account *accounts, size_t count, uint32_t threads,
                         rt_error *error)
{
    size_t jobs = threads ? threads : 1;
    booking b = {lights, accounts, count,         (count + jobs - 1) / jobs,
                 NULL,   NULL,     ledger->count, NULL};
    rt_memory *memory = lights->memory;
    b.per_unit = rt_memory_alloc(memory, ledger->count, sizeof *b.per_unit, what, error);
    if (b.per_unit)
        b.rows = rt_memory_zeroed(memory, jobs * ledger->count, sizeof *b.rows, what, error);
    if (b.rows)
        b.rejected = rt_memory_zeroed(memory, jobs, sizeof *b.rejected, what, error);
    int failed = !b.rejected;
    if (!failed) {
        for (size_t i = 0; i < ledger->count; i++)
            b.per_unit[i] = ldexp(1, -ledger->rows[i].exponent);
        rt_parallel(threads, (uint32_t)jobs, book_share, &b);
        for (size_t job = 0; job < jobs; job++) {
            ledger->rejected += b.rejected[job];
            for (size_t i = 0; i < ledger->count; i++)
                add_row(ledger->rows + i, b.rows + job * ledger->count + i);
        }
        ledger->paths += count;
    }
    rt_memory_free(b.per_unit);
    rt_memory_free(b.rows);
    rt_memory_free(b.rejected);
    return failed ? RT_ERROR_MEMORY : RT_OK;
}

void rt_ledger_book_sums(rt_ledger *ledger, const rt_i64 *rows, uint64_t paths)
{
    ledger->rejected += (uint64_t)rows[RT_TOTAL_UNSOUND];
    ledger->paths += paths;
    for (size_t i = 0; i < ledger->count; i++) {
        const rt_i64 *row = rows + (1 + i) * RT_SUMS_A_ROW;
        rt_ledger_row sums = {.paths = (uint64_t)row[RT_SUMS_A_ROW - 1]};
        for (int column = 0; column < RT_LEDGER_COLUMNS; column++)
            for (int c = 0; c < 3; c++)
                sums.sums[column][c] = row[3 * column + c];
        add_row(ledger->rows + i, &sums);
    }
}

int rt_ledger_matches(const rt_ledger *a, const rt_ledger *b)
{
    if (a->count != b->count)
        return 0;
    for (size_t i = 0; i < a->count; i++)
        if (a->rows[i].shape != b->rows[i].shape || a->rows[i].exponent != b->rows[i].exponent ||
            a->rows[i].share != b->rows[i].share ||
            memcmp(a->rows[i].power, b->rows[i].power, sizeof a->rows[i].power) != 0)
            return 0;
    return 1;
}

static rt_status copy(rt_ledger *out, const rt_ledger *from, rt_error *error)
{
    rt_ledger_row *rows = rt_memory_alloc(NULL, from->count, sizeof *rows, what, error);
    if (!rows)
        return RT_ERROR_MEMORY;
    memcpy(rows, from->rows, from->count * sizeof *rows);
    *out = *from;
    out->rows = rows;
    return RT_OK;
}

static int row_fits(const rt_ledger_row *a, const rt_ledger_row *b)
{
    for (int column = 0; column < RT_LEDGER_COLUMNS; column++)
        for (int c = 0; c < 3; c++) {
            int64_t x = a->sums[column][c], y = b->sums[column][c];
            if (y > 0 ? x > INT64_MAX - y : x < INT64_MIN - y)
                return 0;
        }
    return 1;
}

rt_status rt_ledger_add(rt_ledger *a, const rt_ledger *b, rt_error *error)
{
    if (!a->rows)
        return copy(a, b, error);
    if (!rt_ledger_matches(a, b))
        return rt_fail(error, RT_ERROR_USAGE, "the energy ledgers are of other lights");
    for (size_t i = 0; i < a->count; i++)
        if (!row_fits(a->rows + i, b->rows + i))
            return rt_fail(error, RT_ERROR_USAGE,
                           "the energy ledger of %llu and %llu photon paths does not fit",
                           (unsigned long long)a->paths, (unsigned long long)b->paths);
    for (size_t i = 0; i < a->count; i++)
        add_row(a->rows + i, b->rows + i);
    a->paths += b->paths;
    a->rejected += b->rejected;
    return RT_OK;
}

void rt_ledger_read(const rt_ledger *ledger, size_t i, rt_light_ledger *out)
{
    const rt_ledger_row *row = ledger->rows + i;
    double watts = ledger->paths ? ldexp(1, row->exponent) / (double)ledger->paths : 0;
    memset(out, 0, sizeof *out);
    out->shape = row->shape;
    out->paths = row->paths;
    out->share = row->share;
    for (int c = 0; c < 3; c++) {
        out->power[c] = row->power[c];
        out->emitted[c] = watts * (double)row->sums[RT_LEDGER_EMITTED][c];
        out->absorbed[c] = watts * (double)row->sums[RT_LEDGER_ABSORBED][c];
        out->escaped[c] = watts * (double)row->sums[RT_LEDGER_ESCAPED][c];
        out->cut_off[c] = watts * (double)row->sums[RT_LEDGER_CUT_OFF][c];
        out->roulette[c] = watts * (double)row->sums[RT_LEDGER_ROULETTE][c];
    }
}
