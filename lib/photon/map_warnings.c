/* map_warnings.c - warnings about lights and maps with too few photon paths. */
#include "photon/map_warnings.h"

#include <stdio.h>
#include <string.h>

#include "base/progress.h"

/*
 * Paths below which the noise of a light exceeds 1 / sqrt(100); of what part of a map, 1 over it,
 * estimates are told to be too wide; and how many lights a warning names.
 */
enum { PATHS_ENOUGH = 100, PART_MOST = 4, LIGHTS_NAMED = 4 };

static int is_starved(const rt_ledger_row *row)
{
    return row->power[0] + row->power[1] + row->power[2] > 0 && row->paths < PATHS_ENOUGH;
}

/* Where there is none, no list can be anything but empty. */
static int has_light(const rt_ledger *ledger)
{
    for (size_t i = 0; i < ledger->count; i++)
        if (ledger->rows[i].power[0] + ledger->rows[i].power[1] + ledger->rows[i].power[2] > 0)
            return 1;
    return 0;
}

/* Appends "light 2 (shape 5), 1e-09 W, 12 paths". */
static void name_light(char *out, size_t size, const rt_ledger *ledger, size_t i)
{
    const rt_ledger_row *row = ledger->rows + i;
    double power = (row->power[0] + row->power[1] + row->power[2]) / 3;
    char shape[32] = "";
    if (row->shape != RT_NONE)
        snprintf(shape, sizeof shape, " (shape %u)", row->shape);
    size_t used = strlen(out);
    snprintf(out + used, size - used, "%slight %zu%s, %.4g W, %llu path%s", used ? "; " : "", i,
             shape, power, (unsigned long long)row->paths, row->paths == 1 ? "" : "s");
}

/* One line for all. */
void rt_photon_map_warn_lights(const rt_ledger *ledger, const rt_hooks *hooks)
{
    char names[100 * LIGHTS_NAMED] = "", more[40] = "";
    size_t starved = 0;
    for (size_t i = 0; i < ledger->count; i++)
        if (is_starved(ledger->rows + i) && starved++ < LIGHTS_NAMED)
            name_light(names, sizeof names, ledger, i);
    if (starved > LIGHTS_NAMED)
        snprintf(more, sizeof more, "; and %zu more", starved - LIGHTS_NAMED);
    if (starved > 0)
        rt_warn(hooks,
                "fewer than %d of %llu photon paths came from %s, whose light is noisy, or missing "
                "where there are none: %s%s; more photons help, or a larger share of the paths for "
                "them",
                PATHS_ENOUGH, (unsigned long long)ledger->paths,
                starved == 1 ? "a light with power" : "each of some lights with power", names,
                more);
}

/* Why no path may leave a photon, or "". */
static const char *why_empty(const rt_photon_settings *settings)
{
    if (settings->max_depth == 1 && settings->direct != RT_DIRECT_PHOTONS)
        return "; with max_depth 1 all light is direct, which shadow rays bring";
    if (settings->direct != RT_DIRECT_PHOTONS)
        return "; it holds indirect light alone, of which a scene may have none, for shadow rays "
               "bring what is direct";
    return "";
}

static void warn_list(const rt_photon_map *map, rt_photon_kind kind, const char *name, uint32_t k,
                      const rt_hooks *hooks)
{
    const rt_photon_list *list = map->lists + kind;
    if (list->count == 0)
        rt_warn(hooks, "the %s is empty: none of %llu photon paths left a photon in it%s", name,
                (unsigned long long)list->emitted, why_empty(&map->settings));
    else if (k != RT_K_ALL && list->count < k)
        rt_warn(hooks,
                "the %s has only %zu photon%s, fewer than the %u nearest that an estimate wants",
                name, list->count, list->count == 1 ? "" : "s", (unsigned)k);
    else if (k != RT_K_ALL && list->count / PART_MOST < k)
        rt_warn(hooks,
                "an estimate takes %u of the %zu photons of the %s, which spreads light over a "
                "large part of the scene: use a smaller k or more photons",
                (unsigned)k, list->count, name);
    if (list->rejected > 0)
        rt_warn(hooks,
                "%llu photons were left out of the %s because they were not finite or lay beyond "
                "1e15 m",
                (unsigned long long)list->rejected, name);
}

void rt_photon_map_warn_starved(const rt_photon_map *map, const rt_ledger *ledger, uint32_t pass,
                                uint32_t k, uint32_t caustic_k, const rt_hooks *hooks)
{
    char of_pass[32] = "", name[64];
    if (pass > 0)
        snprintf(of_pass, sizeof of_pass, " of pass %u", (unsigned)pass);
    rt_photon_map_warn_lights(ledger, hooks);
    if (!has_light(ledger))
        return;
    snprintf(name, sizeof name, "%sphoton map%s", map->settings.split ? "global " : "", of_pass);
    /* In a medium without surfaces there need not be any. */
    if (map->lists[RT_PHOTONS_VOLUME].count == 0 || map->lists[RT_PHOTONS_GLOBAL].count > 0)
        warn_list(map, RT_PHOTONS_GLOBAL, name, k, hooks);
    snprintf(name, sizeof name, "caustic photon map%s", of_pass);
    if (map->settings.split)
        warn_list(map, RT_PHOTONS_CAUSTIC, name, caustic_k, hooks);
}

void rt_photon_map_warn_even(const rt_photon_map *map, rt_area area, const rt_hooks *hooks)
{
    if (area == RT_AREA_HULL && map->settings.sampler != RT_SAMPLER_INDEPENDENT)
        rt_warn(hooks,
                "the photons of the map, by the sampler sobol, are spread more evenly than area "
                "hull supposes, "
                "and the light comes out too dark: emit the map with the sampler independent");
}

void rt_photon_map_warn_gathers(const rt_film_stats *stats, const rt_hooks *hooks)
{
    /* Of a map without any photon enough is said. */
    if (stats->photons_stored > 0 && stats->gathers_empty > stats->gathers_at_ends / 2)
        rt_warn(hooks,
                "%llu of the %llu queries of the photon map found no photon: the light of photons "
                "there is missing or very noisy; use a larger radius or more photons",
                (unsigned long long)stats->gathers_empty,
                (unsigned long long)stats->gathers_at_ends);
}
