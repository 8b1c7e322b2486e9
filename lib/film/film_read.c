/*
 * film_read.c - the sums of a film from a file; film_file.h describes the bytes.
 *
 * Nothing in a file is trusted: the sizes of what it holds are checked against its length before
 * memory is allocated, and what passes the checksum is still checked number by number. The film
 * itself has the size that the header names, in which empty pixels take no byte.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/file.h"
#include "base/wire.h"
#include "film/areas.h"
#include "film/film_file.h"
#include "photon/ledger_file.h"
#include "setting/options.h"

/* A file being read; enough is known to be left for what is read next. */
typedef struct reader {
    rt_reader at;
    const uint8_t *end; /* of the content, before the checksum */
    const char *name;
    rt_memory *memory;
    rt_error *error;
} reader;

/* What the header says besides what goes into the film. */
typedef struct header {
    uint64_t scene, light, ranges, runs, lights, paths, rejected;
    uint32_t text, planes, base, flags, part, parts;
    rt_film_stats stats;
} header;

static rt_status fail_content(const reader *r, const char *what)
{
    return rt_fail(r->error, RT_ERROR_INPUT, "%.350s: the film file is damaged: %s", r->name, what);
}

/* Whether so many items of `bytes` each are left. */
static int has(const reader *r, uint64_t count, size_t bytes)
{
    return count <= (uint64_t)(r->end - r->at.at) / bytes;
}

/* ---- Frame and header ----------------------------------------------------------- */

static rt_status file_size(uint64_t *out, const uint8_t *start, size_t size, const char *name,
                           rt_error *error)
{
    return rt_frame_size(out, &rt_film_frame, start, size, name, error);
}

static header read_header(reader *r)
{
    header h = {0};
    rt_reader *at = &r->at;
    at->at += RT_FRAME_START;
    h.scene = rt_get64(at);
    h.light = rt_get64(at);
    h.text = rt_get32(at);
    h.planes = rt_get32(at);
    h.base = rt_get32(at);
    h.flags = rt_get32(at);
    h.part = rt_get32(at);
    h.parts = rt_get32(at);
    h.ranges = rt_get64(at);
    h.runs = rt_get64(at);
    h.lights = rt_get64(at);
    h.paths = rt_get64(at);
    h.rejected = rt_get64(at);
    h.stats.photons_emitted = rt_get64(at);
    h.stats.photons_stored = rt_get64(at);
    h.stats.photons_rejected = rt_get64(at);
    h.stats.gathers = rt_get64(at);
    h.stats.gathers_at_ends = rt_get64(at);
    h.stats.gathers_empty = rt_get64(at);
    h.stats.passes = (uint32_t)rt_get64(at);
    h.stats.build_seconds = rt_get_double(at);
    h.stats.compile_seconds = rt_get_double(at);
    h.stats.emit_seconds = rt_get_double(at);
    h.stats.gather_seconds = rt_get_double(at);
    h.stats.render_seconds = rt_get_double(at);
    return h;
}

static int has_sound_times(const rt_film_stats *stats)
{
    const double seconds[] = {stats->build_seconds, stats->compile_seconds, stats->emit_seconds,
                              stats->gather_seconds, stats->render_seconds};
    int sound = 1;
    for (size_t i = 0; i < sizeof seconds / sizeof *seconds; i++)
        sound = sound && seconds[i] >= 0 && seconds[i] < 1e12;
    return sound;
}

/* ---- The text ------------------------------------------------------------------- */

/* Sets the setting of a line "NAME VALUE"; *known: it is one. */
static rt_status read_setting(const reader *r, rt_render_options *options, char *line, int *known)
{
    rt_error error;
    char *value = strchr(line, ' ');
    if (!value)
        return fail_content(r, "a line of its text has no value");
    *value = '\0';
    const rt_setting *setting = rt_setting_find(line);
    *known = setting != NULL;
    rt_status status = setting ? rt_setting_set(options, setting, value + 1, &error) : RT_OK;
    *value = ' ';
    /* A setting of 0 is one that was completed to its default: none is meant. */
    if (status != RT_OK && strcmp(value + 1, "0") != 0)
        return rt_fail(r->error, RT_ERROR_INPUT, "%.200s: the film file is damaged: %.200s",
                       r->name, error.message);
    return RT_OK;
}

/* The lines that are no settings become the note. */
static rt_status read_text(reader *r, const header *h, rt_render_options *options, char **note)
{
    char *text = calloc(1, (size_t)h->text + 1), *kept = text;
    rt_status status = RT_OK;
    if (!text)
        return rt_fail(r->error, RT_ERROR_MEMORY, "out of memory for the text of a film file");
    memcpy(text, r->at.at, h->text);
    r->at.at += h->text;
    if (strlen(text) != h->text || (h->text > 0 && text[h->text - 1] != '\n'))
        status = fail_content(r, "its text does not end in a line");
    for (char *line = text, *end; status == RT_OK && (end = strchr(line, '\n')); line = end + 1) {
        int known = 0;
        *end = '\0';
        status = read_setting(r, options, line, &known);
        *end = '\n';
        if (status == RT_OK && !known) {
            memmove(kept, line, (size_t)(end + 1 - line));
            kept += end + 1 - line;
        }
    }
    *kept = '\0';
    *note = text;
    return status;
}

/* ---- The content ------------------------------------------------------------------ */

static rt_status read_ledger(reader *r, const header *h, rt_ledger *ledger)
{
    uint64_t paths = 0;
    if (!has(r, h->lights, RT_LEDGER_ROW_BYTES))
        return fail_content(r, "it is too short for its ledger");
    ledger->paths = h->paths;
    ledger->rejected = h->rejected;
    if (h->lights == 0)
        return RT_OK;
    ledger->rows = rt_memory_zeroed(r->memory, (size_t)h->lights, sizeof *ledger->rows,
                                    "the energy ledger", r->error);
    if (!ledger->rows)
        return RT_ERROR_MEMORY;
    ledger->count = (size_t)h->lights;
    for (size_t i = 0; i < ledger->count; i++) {
        if (!rt_ledger_get(&r->at, ledger->rows + i))
            return fail_content(r, "a light in its ledger is out of range");
        if (ledger->rows[i].paths > ledger->paths - paths)
            return fail_content(r, "its lights have more paths than it");
        paths += ledger->rows[i].paths;
    }
    return RT_OK;
}

static rt_status read_ranges(reader *r, const header *h, rt_film *film)
{
    uint64_t end = 0;
    if (!has(r, h->ranges, RT_FILM_RANGE))
        return fail_content(r, "it is too short for its list of units");
    for (uint64_t i = 0; i < h->ranges; i++) {
        const uint64_t first = rt_get64(&r->at), count = rt_get64(&r->at);
        if (count == 0 || first >= film->units.count || count > film->units.count - first ||
            (i > 0 && first <= end))
            return fail_content(r, "its list of units is out of order");
        rt_status status = rt_coverage_add(&film->done, (rt_unit_range){first, count}, r->error);
        if (status != RT_OK)
            return status;
        end = first + count;
    }
    return RT_OK;
}

/* The area that a row lies in; NULL: none. */
static const rt_film_area *find_area(const rt_film_area *areas, int count, uint64_t row)
{
    for (int i = 0; i < count; i++)
        if (row >= areas[i].first && row - areas[i].first < areas[i].count)
            return areas + i;
    return NULL;
}

/* Reads the rows of a run, counted in their area. */
static rt_status read_run(reader *r, const rt_film_area *area, size_t first, size_t count)
{
    uint8_t *rows = (uint8_t *)area->rows + first * area->table->size;
    if (!rt_columns_get(&r->at, r->end, area->table, rows, count))
        return fail_content(r, "its pixels are cut short or out of range");
    return rt_area_is_sound(area, first, count) ? RT_OK
                                                : fail_content(r, "a pixel is out of range");
}

static rt_status read_runs(reader *r, const header *h, const rt_film *film)
{
    rt_film_area areas[RT_FILM_AREAS];
    const int area_count = rt_film_areas(areas, film);
    uint64_t end = 0;
    rt_status status = RT_OK;
    for (uint64_t run = 0; run < h->runs && status == RT_OK; run++) {
        if (!has(r, 1, RT_FILM_RANGE))
            return fail_content(r, "it is too short for its pixels");
        const uint64_t first = rt_get64(&r->at), count = rt_get64(&r->at);
        const rt_film_area *area = find_area(areas, area_count, first);
        if (!area || first < end || count == 0 || count > RT_COLUMNS_ROWS ||
            count > area->count - (first - area->first))
            return fail_content(r, "its runs of pixels are out of order");
        end = first + count;
        status = read_run(r, area, (size_t)first - area->first, (size_t)count);
    }
    return status;
}

static rt_status read_content(reader *r, const header *h, rt_film *film)
{
    rt_status status = read_ledger(r, h, &film->ledger);
    if (status == RT_OK)
        status = read_ranges(r, h, film);
    if (status == RT_OK && h->flags & 1)
        status = rt_film_make_first_hits(film, r->error);
    if (status == RT_OK)
        status = read_runs(r, h, film);
    if (status == RT_OK && r->at.at != r->end)
        status = fail_content(r, "bytes are left over");
    return status;
}

/* A film without samples for the settings of the file. */
static rt_status make_film(reader *r, const header *h, const rt_render_options *options,
                           rt_film **out)
{
    const uint64_t pixels = (uint64_t)options->width * options->height;
    rt_status status = rt_render_options_check(options, r->error);
    if (status != RT_OK)
        return rt_fail(r->error, RT_ERROR_INPUT, "%.350s: its settings do not fit together",
                       r->name);
    if (pixels > UINT32_MAX)
        return fail_content(r, "it has too many pixels");
    status = rt_film_create(out, options, r->memory, r->error);
    if (status != RT_OK)
        return status;
    rt_film *film = *out;
    if (pixels == 0 || film->units.samples == 0)
        return fail_content(r, "it has no pixels or no samples");
    if (film->units.replicates != h->planes || h->flags > 31 ||
        (h->flags & 2) != (film->photon_sums ? 2u : 0u) ||
        (h->flags & 8) != (film->moments ? 8u : 0u) ||
        (h->flags & 16) != (film->rates ? 16u : 0u) ||
        (h->flags & 1 && !film->options.aov && rt_mode_shows_light(film->options.mode)) ||
        h->base > film->units.samples || (h->base > 0 && film->units.in_passes) ||
        (h->base == 0 && h->flags & 4))
        return fail_content(r, "its layers do not go with its settings");
    film->units = rt_units_of(&film->options, h->base);
    film->lacks_base = (h->flags & 4) != 0;
    film->stats = h->stats;
    film->scene = h->scene;
    film->light = h->light;
    return RT_OK;
}

rt_status rt_film_decode_in(rt_film **out, const uint8_t *data, size_t size, const char *name,
                            rt_memory *memory, rt_error *error)
{
    reader r = {{data}, data, name, memory, error};
    rt_render_options options = {0};
    rt_film *film = NULL;
    char *note = NULL;
    rt_status status = rt_frame_check(&rt_film_frame, data, size, name, error);
    if (status != RT_OK)
        return status;
    r.end = data + size - RT_FRAME_CHECKSUM;
    const header h = read_header(&r);
    if (!has_sound_times(&h.stats))
        return fail_content(&r, "its times are out of range");
    options.part = h.part;
    options.parts = h.parts;
    status = has(&r, h.text, 1) ? read_text(&r, &h, &options, &note)
                                : fail_content(&r, "it is too short for its text");
    /* Earlier films had as many sequences for target_error alone as for variance. */
    if (status == RT_OK && rt_units_of(&options, 0).replicates == RT_REPLICATES_FEW)
        options.variance = h.planes == RT_REPLICATES;
    if (status == RT_OK)
        status = make_film(&r, &h, &options, &film);
    if (status == RT_OK)
        status = read_content(&r, &h, film);
    if (status == RT_OK) {
        film->note = note;
        *out = film;
    } else {
        free(note);
        rt_film_destroy(film);
    }
    return status;
}

rt_status rt_film_decode(rt_film **out, const void *data, size_t size, rt_error *error)
{
    if (rt_is_missing(data, "data", error))
        return RT_ERROR_USAGE;
    return rt_film_decode_in(out, data, size, "the buffer", NULL, error);
}

rt_status rt_film_load(rt_film **out, const char *path, rt_memory *memory, rt_error *error)
{
    rt_bytes bytes = {.memory = memory};
    rt_status status = rt_file_read_sized(&bytes, path, RT_FILM_HEADER, file_size, 0, error);
    if (status == RT_OK)
        status = rt_film_decode_in(out, bytes.data, bytes.size, path, memory, error);
    rt_bytes_free(&bytes);
    return status;
}

rt_status rt_film_receive(rt_film **film, int from, rt_error *error)
{
    rt_bytes bytes = {0};
    rt_film *part = NULL;
    if (rt_is_missing(film, "film", error))
        return RT_ERROR_USAGE;
    rt_status status =
        rt_file_read_stream(&bytes, from, "the stream", RT_FILM_HEADER, file_size, error);
    if (status == RT_OK)
        status = rt_film_decode_in(&part, bytes.data, bytes.size, "the stream", NULL, error);
    rt_bytes_free(&bytes);
    if (status == RT_OK && *film) {
        status = rt_film_add(*film, part, error);
        rt_film_destroy(part);
    } else if (status == RT_OK) {
        *film = part;
    }
    return status;
}
