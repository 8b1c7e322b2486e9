/* changed.c - what of a film has changed since it was packed. */
#include "film/changed.h"

#include <string.h>

#include "film/areas.h"
#include "film/film_file.h"

/* Rows of tiles, in whose order the items of a film are: kernels/camera/film.h. */
enum { TILE = 8 };

static int is_same_film(const rt_film *film, const rt_film_state *s)
{
    const rt_units *a = &film->units, *b = &s->units;
    return s->film == film && s->made == film->made && s->scene == film->scene &&
           s->light == film->light && s->lacks_base == film->lacks_base &&
           a->replicates == b->replicates && a->items == b->items && a->base == b->base &&
           a->samples == b->samples && a->longest == b->longest && a->count == b->count;
}

/* Whether all units that were done still are. */
static int has_all(const rt_coverage *done, const rt_coverage *before)
{
    for (size_t i = 0; i < before->count; i++) {
        const rt_unit_range r = before->ranges[i];
        if (rt_coverage_gap(done, r.first, r.first + r.count).count > 0)
            return 0;
    }
    return 1;
}

/* Marks the bands of some rows, counted through all areas. */
static void mark_rows(uint8_t *changed, const rt_film *film, size_t first, size_t count)
{
    const size_t from = rt_film_band_of(film, first), to = rt_film_band_of(film, first + count - 1);
    memset(changed + from, 1, to - from + 1);
}

/* Marks what the units of one block change: rows of whole tiles, in their plane and all layers. */
static void mark_items(uint8_t *changed, const rt_film *film, uint32_t plane, uint64_t item,
                       uint64_t count)
{
    rt_film_area areas[RT_FILM_AREAS];
    const int area_count = rt_film_areas(areas, film);
    const size_t width = film->options.width, pixels = rt_film_pixels(film);
    const size_t tiles = TILE * width, first = (size_t)item / tiles * tiles;
    size_t end = ((size_t)(item + count) + tiles - 1) / tiles * tiles;
    end = end < pixels ? end : pixels;
    mark_rows(changed, film, plane * pixels + first, end - first);
    for (int i = 1; i < area_count; i++)
        mark_rows(changed, film, areas[i].first + first, end - first);
}

/* Marks what some units change, block by block. */
static void mark_units(uint8_t *changed, const rt_film *film, rt_unit_range units)
{
    const uint64_t items = film->units.items;
    while (units.count > 0) {
        const uint64_t item = units.first % items, left = items - item,
                       count = units.count < left ? units.count : left;
        mark_items(changed, film, rt_units_block(&film->units, units.first).replicate, item, count);
        units.first += count;
        units.count -= count;
    }
}

void rt_film_changed(uint8_t *changed, const rt_film *film, const rt_film_state *before)
{
    const size_t bands = rt_film_bands(film);
    const int is_other = film->units.in_passes || !is_same_film(film, before) ||
                         !has_all(&film->done, &before->done);
    memset(changed, is_other, bands);
    for (size_t i = 0; i < film->done.count && !is_other; i++) {
        const rt_unit_range r = film->done.ranges[i];
        const uint64_t end = r.first + r.count;
        rt_unit_range more = rt_coverage_gap(&before->done, r.first, end);
        for (; more.count > 0; more = rt_coverage_gap(&before->done, more.first + more.count, end))
            mark_units(changed, film, more);
    }
}

void rt_film_state_take(rt_film_state *state, const rt_film *film)
{
    rt_film_state_free(state);
    if (rt_coverage_join(&state->done, &film->done, NULL) != RT_OK)
        return;
    state->film = film;
    state->made = film->made;
    state->scene = film->scene;
    state->light = film->light;
    state->lacks_base = film->lacks_base;
    state->units = film->units;
}

void rt_film_state_free(rt_film_state *state)
{
    rt_coverage_free(&state->done);
    *state = (rt_film_state){0};
}
