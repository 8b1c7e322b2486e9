/*
 * ledger.h - where the flux of all photon paths went, light by light.
 *
 * Sums are kept as whole numbers of a small unit, so that they are exact in whatever order and in
 * how many parts the paths are taken: the ledger of two joined maps is that of the whole, to the
 * bit. Each light has a unit of its own, so that a weak light keeps its precision beside strong
 * ones.
 *
 * Paths of the caustic list are not in the ledger: they are aimed, and carry only part of the
 * lights' flux. Those of the global list carry all of it, caustics included.
 */
#ifndef RT_LIB_PHOTON_LEDGER_H
#define RT_LIB_PHOTON_LEDGER_H

#include "photon/light_sources.h"
#include "rt.h"
#include "types.h"

/* The columns of a ledger. */
enum {
    RT_LEDGER_EMITTED,
    RT_LEDGER_ABSORBED,
    RT_LEDGER_ESCAPED,
    RT_LEDGER_CUT_OFF,
    RT_LEDGER_ROULETTE,
    RT_LEDGER_COLUMNS
};

/* One light. */
typedef struct rt_ledger_row {
    rt_u32 shape;     /* as rt_light_source */
    int32_t exponent; /* the unit is 2^exponent W */
    uint64_t paths;
    double power[3]; /* W */
    double share;
    int64_t sums[RT_LEDGER_COLUMNS][3]; /* in units */
} rt_ledger_row;

/* All zero is a ledger without lights. */
typedef struct rt_ledger {
    rt_ledger_row *rows; /* [count], one a light */
    size_t count;
    uint64_t paths;    /* emitted, those without a light included */
    uint64_t rejected; /* paths left out because their accounts were not finite */
} rt_ledger;

/* An empty ledger of these lights; free with rt_ledger_free. */
rt_status rt_ledger_create(rt_ledger *out, const rt_light_sources *lights, rt_error *error);
void rt_ledger_free(rt_ledger *ledger);

/* Forgets all paths. */
void rt_ledger_reset(rt_ledger *ledger);

/* Books the accounts of paths, on so many threads; lights: those that the ledger was made for. */
rt_status rt_ledger_book(rt_ledger *ledger, const rt_light_sources *lights,
                         const rt_path_account *accounts, size_t count, uint32_t threads,
                         rt_error *error);

/* The exponent of a light's unit, as rt_ledger_row has it. */
int32_t rt_ledger_exponent(const rt_light_source *source);

/*
 * Books sums that the device has taken over the accounts of so many paths: rows [1 + count] of
 * RT_SUMS_A_ROW, as path_sums.cl makes them.
 */
void rt_ledger_book_sums(rt_ledger *ledger, const rt_i64 *rows, uint64_t paths);

/* Whether both are of the same lights with the same shares, so that they can be added. */
int rt_ledger_matches(const rt_ledger *a, const rt_ledger *b);

/*
 * Adds b to a. One without lights becomes a copy of b. Fails with RT_ERROR_USAGE when they are of
 * other lights, or the sums become too large.
 */
rt_status rt_ledger_add(rt_ledger *a, const rt_ledger *b, rt_error *error);

/* Row i in watts. */
void rt_ledger_read(const rt_ledger *ledger, size_t i, rt_light_ledger *out);

#endif
