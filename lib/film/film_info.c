/* film_info.c - what a film holds of its picture. */
#include "film/film.h"
#include "film/unit_part.h"

void rt_film_get_options(const rt_film *film, rt_render_options *out)
{
    *out = film->options;
}

double rt_film_samples_done(const rt_film *film)
{
    double done = film->lacks_base ? 0 : film->units.base;
    for (size_t i = 0; i < film->done.count; i++)
        done += rt_units_amount(&film->units, film->done.ranges[i]);
    return done;
}

void rt_film_get_info(const rt_film *film, rt_film_info *out)
{
    const rt_film_stats *s = &film->stats;
    *out = (rt_film_info){
        .done = rt_film_samples_done(film) / film->units.samples,
        .units = film->units.count,
        .units_done = rt_coverage_units(&film->done),
        .samples = film->units.samples,
        .part = film->options.part,
        .parts = film->options.parts,
        .seconds = s->emit_seconds + s->gather_seconds + s->render_seconds,
        .scene = film->scene,
    };
}

double rt_film_part_done(const rt_film *film, uint32_t part, uint32_t parts)
{
    uint64_t done = 0;
    if (parts == 0)
        part = parts = 1;
    if (part < 1 || part > parts)
        return 0;
    const rt_unit_part all = rt_unit_part_of(&film->units, part, parts);
    const uint64_t units = rt_unit_part_before(&all, film->units.count);
    for (size_t i = 0; i < film->done.count; i++) {
        const rt_unit_range range = film->done.ranges[i];
        done += rt_unit_part_before(&all, range.first + range.count) -
                rt_unit_part_before(&all, range.first);
    }
    return units > 0 ? (double)done / (double)units : 1;
}

const char *rt_film_note(const rt_film *film)
{
    return film->note ? film->note : "";
}
