/* coverage.h - a set of units of work, as ranges: those whose samples a film holds. */
#ifndef RT_LIB_FILM_COVERAGE_H
#define RT_LIB_FILM_COVERAGE_H

#include <stddef.h>

#include "film/units.h"

/* Disjoint ranges in ascending order that do not touch each other. All zero is the empty set. */
typedef struct rt_coverage {
    rt_unit_range *ranges; /* [count] */
    size_t count, capacity;
} rt_coverage;

void rt_coverage_free(rt_coverage *coverage);

/* Adds a range; RT_ERROR_USAGE when a unit of it is in the set already. */
rt_status rt_coverage_add(rt_coverage *coverage, rt_unit_range range, rt_error *error);

/* Adds all of another set; RT_ERROR_USAGE, with nothing added, when they have a unit in common. */
rt_status rt_coverage_join(rt_coverage *coverage, const rt_coverage *other, rt_error *error);

/* Fails where rt_coverage_join would, and makes room for it: that cannot fail then. */
rt_status rt_coverage_prepare(rt_coverage *coverage, const rt_coverage *other, rt_error *error);

/* Whether two sets have a unit in common. */
int rt_coverage_overlaps(const rt_coverage *a, const rt_coverage *b);

/* Whether a set has all units of another. */
int rt_coverage_includes(const rt_coverage *coverage, const rt_coverage *other);

/* The units of a set. */
uint64_t rt_coverage_units(const rt_coverage *coverage);

/* The units from the first one of the picture on that are in the set. */
uint64_t rt_coverage_prefix(const rt_coverage *coverage);

/* Takes the units of a range out of the set, as far as they are in it. */
rt_status rt_coverage_remove(rt_coverage *coverage, rt_unit_range range, rt_error *error);

/*
 * The first run of units from `first` on and before `end` that are not in the set; its count is 0
 * when there is none.
 */
rt_unit_range rt_coverage_gap(const rt_coverage *coverage, uint64_t first, uint64_t end);

#endif
