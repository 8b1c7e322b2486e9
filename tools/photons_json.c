/* photons_json.c - `rtc photons info` and `diff` for programs: a JSON object on a line. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "json.h"
#include "ledger.h"
#include "message.h"
#include "photons.h"
#include "status.h"
#include "timing.h"

static void put_bool(const char *name, int value)
{
    printf(",\"%s\":%s", name, value ? "true" : "false");
}

/* The rows of a ledger, which the caller frees; NULL after saying that memory is out. */
static rt_light_ledger *read_ledger(const rt_photon_map *map, size_t count)
{
    rt_light_ledger *rows = calloc(count + 1, sizeof *rows);
    if (!rows) {
        message_error("out of memory");
        return NULL;
    }
    rt_photon_map_ledger(map, rows, count);
    return rows;
}

/* ---- What a map holds --------------------------------------------------------- */

static void put_ranges(const rt_photon_map *map, rt_photon_kind kind)
{
    size_t count;
    const rt_path_range *ranges = rt_photon_map_ranges(map, kind, &count);
    fputs(",\"ranges\":[", stdout);
    for (size_t i = 0; i < count; i++)
        printf("%s{\"first\":%" PRIu64 ",\"count\":%" PRIu64 ",\"photons\":%" PRIu64
               ",\"seed\":%" PRIu32 "}",
               i ? "," : "", ranges[i].first, ranges[i].count, ranges[i].photons, ranges[i].seed);
    putchar(']');
}

static void put_list(const char *name, const rt_photon_map *map, const rt_photon_map_info *info,
                     rt_photon_kind kind)
{
    photon_totals t = photons_add_up(map, kind);
    printf(",\"%s\":{\"paths\":%" PRIu64 ",\"photons\":%" PRIu64 ",\"caustic\":%" PRIu64
           ",\"segments\":%" PRIu64,
           name, info->paths[kind], info->photons[kind], t.caustic, t.segments);
    json_triple("flux", t.flux);
    json_triple("lo", t.lo);
    json_triple("hi", t.hi);
    put_ranges(map, kind);
    putchar('}');
}

int photons_print_info_json(const char *path, const rt_photon_map *map, const command_line *timed)
{
    rt_photon_map_info info;
    rt_photon_map_get_info(map, &info);
    rt_light_ledger *rows = read_ledger(map, info.lights);
    if (!rows)
        return STATUS_DEVICE;
    fputs("{\"map\":", stdout);
    json_string(path);
    printf(",\"scene\":\"%016" PRIx64 "\",\"direct\":\"%s\",\"sampler\":\"%s\",\"max_depth\":%u",
           info.scene, info.direct == RT_DIRECT_PHOTONS ? "photons" : "nee",
           info.sampler == RT_SAMPLER_SOBOL ? "sobol" : "independent", (unsigned)info.max_depth);
    if (info.gather_roughness > 0)
        printf(",\"gather_roughness\":%.9g", (double)info.gather_roughness);
    printf(",\"rejected\":%" PRIu64, info.rejected);
    put_list("global", map, &info, RT_PHOTONS_GLOBAL);
    if (info.split)
        put_list("caustic", map, &info, RT_PHOTONS_CAUSTIC);
    if (info.media)
        put_list("volume", map, &info, RT_PHOTONS_VOLUME);
    ledger_print_json(rows, info.lights);
    if (timed)
        timing_print_json(timed);
    puts("}");
    free(rows);
    return STATUS_DONE;
}

/* ---- How two differ ------------------------------------------------------------- */

/* Whether the lists differ. */
static int put_matches(const char *name, const rt_photon_map *a, const rt_photon_map *b,
                       rt_photon_kind kind)
{
    photon_matches m = photons_match(a, b, kind);
    int paths = photons_have_same_paths(a, b, kind);
    printf(",\"%s\":{\"equal\":%" PRIu64 ",\"changed\":%" PRIu64 ",\"only_first\":%" PRIu64
           ",\"only_second\":%" PRIu64,
           name, m.equal, m.changed, m.only_a, m.only_b);
    put_bool("same_paths", paths);
    putchar('}');
    return !paths || m.changed + m.only_a + m.only_b > 0;
}

/* Whether all settings are the same. */
static int are_settings_same(const rt_photon_map_info *a, const rt_photon_map_info *b)
{
    return a->direct == b->direct && a->sampler == b->sampler && a->max_depth == b->max_depth &&
           a->split == b->split && a->media == b->media;
}

int photons_print_difference_json(const char *const paths[2], const rt_photon_map *a,
                                  const rt_photon_map *b, int *differ)
{
    rt_photon_map_info x, y;
    rt_photon_map_get_info(a, &x);
    rt_photon_map_get_info(b, &y);
    rt_light_ledger *p = read_ledger(a, x.lights), *q = p ? read_ledger(b, y.lights) : NULL;
    int status = p && q ? STATUS_DONE : STATUS_DEVICE;
    if (status == STATUS_DONE) {
        int scene = x.scene == y.scene, settings = are_settings_same(&x, &y),
            rejected = x.rejected == y.rejected;
        int ledger = x.lights == y.lights && memcmp(p, q, x.lights * sizeof *p) == 0;
        fputs("{\"maps\":[", stdout);
        json_string(paths[0]);
        putchar(',');
        json_string(paths[1]);
        putchar(']');
        put_bool("same_scene", scene);
        put_bool("same_settings", settings);
        put_bool("same_rejected", rejected);
        put_bool("same_ledger", ledger);
        *differ = !scene || !settings || !rejected || !ledger;
        *differ |= put_matches("global", a, b, RT_PHOTONS_GLOBAL);
        *differ |= put_matches("caustic", a, b, RT_PHOTONS_CAUSTIC);
        if (x.media || y.media)
            *differ |= put_matches("volume", a, b, RT_PHOTONS_VOLUME);
        put_bool("equal", !*differ);
        puts("}");
    }
    free(p);
    free(q);
    return status;
}
