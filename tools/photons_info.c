/* photons_info.c - `rtc photons info` and `diff`: what maps hold, and how two differ. */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ledger.h"
#include "message.h"
#include "photons.h"
#include "status.h"

static const char *const kind_names[] = {
    [RT_PHOTONS_GLOBAL] = "global",
    [RT_PHOTONS_CAUSTIC] = "caustic",
    [RT_PHOTONS_VOLUME] = "volume",
};

/* Of flux: see rt_photon. */
static const char *const units[] = {
    [RT_PHOTONS_GLOBAL] = "W", [RT_PHOTONS_CAUSTIC] = "W", [RT_PHOTONS_VOLUME] = "W m"};

enum { RANGES_MAX = 16 }; /* ranges that are printed by themselves */

photon_totals photons_add_up(const rt_photon_map *map, rt_photon_kind kind)
{
    rt_photon_map_info info;
    rt_photon_map_get_info(map, &info);
    const rt_photon *photons = rt_photon_map_photons(map, kind);
    photon_totals t = {.lo = {INFINITY, INFINITY, INFINITY},
                       .hi = {-INFINITY, -INFINITY, -INFINITY}};
    for (size_t i = 0; i < rt_photon_map_count(map, kind); i++) {
        for (int c = 0; c < 3; c++) {
            t.flux[c] += photons[i].flux[c];
            t.lo[c] = fmin(t.lo[c], photons[i].position[c]);
            t.hi[c] = fmax(t.hi[c], photons[i].position[c]);
        }
        t.caustic += photons[i].flags & RT_PHOTON_CAUSTIC;
        t.segments += photons[i].flags >> 8;
    }
    for (int c = 0; c < 3 && info.paths[kind] > 0; c++)
        t.flux[c] /= (double)info.paths[kind];
    return t;
}

static void print_ranges(const rt_photon_map *map, rt_photon_kind kind)
{
    size_t count;
    const rt_path_range *ranges = rt_photon_map_ranges(map, kind, &count);
    for (size_t i = 0; i < count && i < RANGES_MAX; i++)
        printf("%s range: paths %" PRIu64 " to %" PRIu64 " of seed %" PRIu32 ", %" PRIu64
               " photons\n",
               kind_names[kind], ranges[i].first, ranges[i].first + ranges[i].count - 1,
               ranges[i].seed, ranges[i].photons);
    if (count > RANGES_MAX)
        printf("%s ranges: %zu more\n", kind_names[kind], count - RANGES_MAX);
}

static void print_list(const rt_photon_map *map, const rt_photon_map_info *info,
                       rt_photon_kind kind)
{
    const char *name = kind_names[kind];
    size_t count = rt_photon_map_count(map, kind);
    photon_totals t = photons_add_up(map, kind);
    printf("%s photon paths: %" PRIu64 "\n%s photons: %" PRIu64 "\n", name, info->paths[kind], name,
           info->photons[kind]);
    print_ranges(map, kind);
    if (count == 0)
        return;
    printf("%s flux: %.6g %.6g %.6g %s\n", name, t.flux[0], t.flux[1], t.flux[2], units[kind]);
    printf("%s segments: %.4g on average\n", name, (double)t.segments / (double)count);
    printf("%s bounds: %.6g %.6g %.6g to %.6g %.6g %.6g m\n", name, t.lo[0], t.lo[1], t.lo[2],
           t.hi[0], t.hi[1], t.hi[2]);
    if (kind == RT_PHOTONS_GLOBAL && !info->split)
        printf("caustic among them: %" PRIu64 "\n", t.caustic);
}

static int print_ledger(const rt_photon_map *map, size_t count)
{
    rt_light_ledger *rows = calloc(count ? count : 1, sizeof *rows);
    if (!rows) {
        message_error("out of memory");
        return STATUS_DEVICE;
    }
    rt_photon_map_ledger(map, rows, count);
    ledger_print(rows, count);
    free(rows);
    return STATUS_DONE;
}

int photons_print_info(const char *path, const rt_photon_map *map)
{
    rt_photon_map_info info;
    rt_photon_map_get_info(map, &info);
    message_put_name("map: ", path, "\n");
    printf("scene: %016" PRIx64 "\n", info.scene);
    printf("direct light: %s\n",
           info.direct == RT_DIRECT_PHOTONS ? "in the map" : "left to shadow rays");
    if (info.gather_roughness > 0)
        printf("rough surfaces: from roughness %g on\n", (double)info.gather_roughness);
    printf("sampler: %s\n", info.sampler == RT_SAMPLER_SOBOL ? "sobol" : "independent");
    printf("longest path: %u segments\n", (unsigned)info.max_depth);
    print_list(map, &info, RT_PHOTONS_GLOBAL);
    if (info.split)
        print_list(map, &info, RT_PHOTONS_CAUSTIC);
    if (info.media)
        print_list(map, &info, RT_PHOTONS_VOLUME);
    printf("photons rejected: %" PRIu64 "\n", info.rejected);
    return print_ledger(map, info.lights);
}

/* ---- Differences ------------------------------------------------------------------- */

/* A place in a list, and the range of paths that it is in. */
typedef struct cursor {
    const rt_photon *photons;
    size_t count, at;
    const rt_path_range *range;
    uint64_t left; /* photons of the range from here on */
} cursor;

/* Goes on to the range of the photon under the cursor. */
static void settle(cursor *c)
{
    while (c->at < c->count && c->left == 0)
        c->left = (++c->range)->photons;
}

static cursor begin(const rt_photon_map *map, rt_photon_kind kind)
{
    size_t ranges;
    cursor c = {rt_photon_map_photons(map, kind), rt_photon_map_count(map, kind), 0,
                rt_photon_map_ranges(map, kind, &ranges), 0};
    c.left = ranges ? c.range->photons : 0;
    settle(&c);
    return c;
}

static void step(cursor *c)
{
    c->at++;
    c->left--;
    settle(c);
}

/* Which of two photons comes first; neither cursor is at its end. */
static int compare_places(const cursor *a, const cursor *b)
{
    const rt_photon *p = a->photons + a->at, *q = b->photons + b->at;
    const uint64_t keys[3][2] = {
        {a->range->seed, b->range->seed}, {p->path, q->path}, {p->flags >> 8, q->flags >> 8}};
    for (int i = 0; i < 3; i++)
        if (keys[i][0] != keys[i][1])
            return keys[i][0] < keys[i][1] ? -1 : 1;
    return 0;
}

/* Traverses two lists in step; both are in the order of seed, path and segment. */
photon_matches photons_match(const rt_photon_map *map_a, const rt_photon_map *map_b,
                             rt_photon_kind kind)
{
    cursor a = begin(map_a, kind), b = begin(map_b, kind);
    photon_matches m = {0};
    while (a.at < a.count && b.at < b.count) {
        int order = compare_places(&a, &b);
        int same = order == 0 && memcmp(a.photons + a.at, b.photons + b.at, sizeof *a.photons) == 0;
        m.equal += (uint64_t)same;
        m.changed += order == 0 && !same;
        m.only_a += order < 0;
        m.only_b += order > 0;
        if (order <= 0)
            step(&a);
        if (order >= 0)
            step(&b);
    }
    m.only_a += a.count - a.at;
    m.only_b += b.count - b.at;
    return m;
}

int photons_have_same_paths(const rt_photon_map *a, const rt_photon_map *b, rt_photon_kind kind)
{
    size_t x, y;
    const rt_path_range *p = rt_photon_map_ranges(a, kind, &x),
                        *q = rt_photon_map_ranges(b, kind, &y);
    for (size_t i = 0; i < x && x == y; i++)
        if (p[i].seed != q[i].seed || p[i].first != q[i].first || p[i].count != q[i].count)
            return 0;
    return x == y;
}

/*
 * Prints where the ledgers differ; they may where the photons do not. Returns whether they do, or
 * -1: out of memory.
 */
static int print_ledger_difference(const rt_photon_map *a, const rt_photon_map *b, size_t count)
{
    rt_light_ledger *rows = calloc(2 * count + 1, sizeof *rows);
    if (!rows)
        return -1;
    rt_photon_map_ledger(a, rows, count);
    rt_photon_map_ledger(b, rows + count, count);
    int differ = memcmp(rows, rows + count, count * sizeof *rows) != 0;
    if (differ)
        ledger_print_difference(rows, rows + count, count);
    free(rows);
    return differ;
}

static int print_list_difference(const rt_photon_map *a, const rt_photon_map *b,
                                 const rt_photon_map_info info[2], rt_photon_kind kind)
{
    const char *name = kind_names[kind];
    photon_matches m = photons_match(a, b, kind);
    if (photons_have_same_paths(a, b, kind) && m.changed + m.only_a + m.only_b == 0)
        return 0;
    photon_totals x = photons_add_up(a, kind), y = photons_add_up(b, kind);
    printf("%s photon paths: %" PRIu64 " and %" PRIu64 "\n", name, info[0].paths[kind],
           info[1].paths[kind]);
    printf("%s photons: %" PRIu64 " equal, %" PRIu64 " changed, %" PRIu64
           " only in the first, %" PRIu64 " only in the second\n",
           name, m.equal, m.changed, m.only_a, m.only_b);
    printf("%s flux: %.6g %.6g %.6g and %.6g %.6g %.6g %s\n", name, x.flux[0], x.flux[1], x.flux[2],
           y.flux[0], y.flux[1], y.flux[2], units[kind]);
    return 1;
}

/* Prints one setting where it differs. */
static int print_setting(const char *name, uint64_t a, uint64_t b)
{
    if (a == b)
        return 0;
    printf("%s: %" PRIu64 " and %" PRIu64 "\n", name, a, b);
    return 1;
}

int photons_print_difference(const rt_photon_map *a, const rt_photon_map *b, int *differ)
{
    rt_photon_map_info info[2];
    rt_photon_map_get_info(a, info);
    rt_photon_map_get_info(b, info + 1);
    *differ = info[0].scene != info[1].scene;
    if (*differ)
        printf("scene: %016" PRIx64 " and %016" PRIx64 "\n", info[0].scene, info[1].scene);
    *differ |= print_setting("direct light in the map", info[0].direct, info[1].direct);
    if (info[0].gather_roughness != info[1].gather_roughness) {
        printf("gather_roughness: %g and %g\n", (double)info[0].gather_roughness,
               (double)info[1].gather_roughness);
        *differ = 1;
    }
    *differ |= print_setting("sampler", info[0].sampler, info[1].sampler);
    *differ |= print_setting("longest path", info[0].max_depth, info[1].max_depth);
    *differ |=
        print_setting("caustic photons apart", (uint64_t)info[0].split, (uint64_t)info[1].split);
    *differ |= print_setting("photons rejected", info[0].rejected, info[1].rejected);
    *differ |= print_setting("lights", info[0].lights, info[1].lights);
    *differ |= print_list_difference(a, b, info, RT_PHOTONS_GLOBAL);
    *differ |= print_list_difference(a, b, info, RT_PHOTONS_CAUSTIC);
    *differ |= print_list_difference(a, b, info, RT_PHOTONS_VOLUME);
    int ledgers =
        info[0].lights == info[1].lights ? print_ledger_difference(a, b, info[0].lights) : 1;
    if (ledgers < 0) {
        message_error("out of memory");
        return STATUS_DEVICE;
    }
    *differ |= ledgers;
    if (!*differ)
        printf("the maps are equal\n");
    return STATUS_DONE;
}
