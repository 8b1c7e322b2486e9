/* film_write.c - the sums of a film as a file; film_file.h describes the bytes. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/file.h"
#include "base/sink.h"
#include "base/wire.h"
#include "film/areas.h"
#include "film/film_file.h"
#include "photon/ledger_file.h"

const rt_frame rt_film_frame = {{0x89, 'R', 'T', 'F', '\r', '\n', 0x1a, '\n'},
                                RT_FILM_VERSION,
                                RT_FILM_HEADER,
                                "film file",
                                "render it anew"};

/* ---- The text ----------------------------------------------------------------- */

/* The note and all settings, as lines. */
static rt_status put_text(rt_bytes *out, const rt_film *film, rt_error *error)
{
    size_t count;
    const rt_setting *settings = rt_settings(&count);
    const char *note = film->note ? film->note : "";
    rt_status status = rt_bytes_put(out, 0, note, strlen(note), error);
    for (size_t i = 0; i < count && status == RT_OK; i++) {
        char value[64], line[128];
        rt_setting_get(value, sizeof value, settings + i, &film->options);
        const int length = snprintf(line, sizeof line, "%s %s\n", settings[i].field.name, value);
        status = rt_bytes_put(out, out->size, line, (size_t)length, error);
    }
    return status;
}

/* ---- What stands before the pixels --------------------------------------------- */

static void put_stats(rt_writer *w, const rt_film *film)
{
    const rt_film_stats *s = &film->stats;
    const uint64_t numbers[] = {film->ledger.count, film->ledger.paths, film->ledger.rejected,
                                s->photons_emitted, s->photons_stored,  s->photons_rejected,
                                s->gathers,         s->gathers_at_ends, s->gathers_empty,
                                s->passes};
    const double seconds[] = {s->build_seconds, s->compile_seconds, s->emit_seconds,
                              s->gather_seconds, s->render_seconds};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        rt_put64(w, numbers[i]);
    for (size_t i = 0; i < sizeof seconds / sizeof *seconds; i++)
        rt_put_double(w, seconds[i]);
}

static void put_header(rt_writer *w, const rt_film *film, size_t text, uint64_t runs, size_t size)
{
    rt_frame_put(w, &rt_film_frame, size);
    rt_put64(w, film->scene);
    rt_put64(w, film->light);
    rt_put32(w, (uint32_t)text);
    rt_put32(w, film->units.replicates);
    rt_put32(w, film->units.base);
    rt_put32(w, (film->first_hits ? 1u : 0u) | (film->photon_sums ? 2u : 0u) |
                    (film->lacks_base ? 4u : 0u) | (film->moments ? 8u : 0u) |
                    (film->rates ? 16u : 0u));
    rt_put32(w, film->options.part);
    rt_put32(w, film->options.parts);
    rt_put64(w, film->done.count);
    rt_put64(w, runs);
    put_stats(w, film);
}

rt_status rt_film_put_head(rt_bytes *out, const rt_film *film, uint64_t runs, size_t bands,
                           rt_error *error)
{
    rt_bytes text = {0};
    rt_status status = rt_film_check_exact(film, "kept", error);
    if (status != RT_OK)
        return status;
    status = put_text(&text, film, error);
    const size_t size = RT_FILM_HEADER + text.size + RT_LEDGER_ROW_BYTES * film->ledger.count +
                        RT_FILM_RANGE * film->done.count;
    uint8_t *data = status == RT_OK ? malloc(size) : NULL;
    rt_writer w = {data};
    if (status == RT_OK && !data)
        status = rt_fail(error, RT_ERROR_MEMORY, "out of memory to write a film");
    if (status != RT_OK)
        goto out;
    put_header(&w, film, text.size, runs, size + bands + RT_FRAME_CHECKSUM);
    memcpy(w.at, text.data, text.size);
    w.at += text.size;
    for (size_t i = 0; i < film->ledger.count; i++)
        rt_ledger_put(&w, film->ledger.rows + i);
    for (size_t i = 0; i < film->done.count; i++) {
        rt_put64(&w, film->done.ranges[i].first);
        rt_put64(&w, film->done.ranges[i].count);
    }
    *out = (rt_bytes){data, size, size, NULL};
out:
    rt_bytes_free(&text);
    return status;
}

/* ---- Bands of pixels ------------------------------------------------------------ */

static size_t bands_of(const rt_film_area *area)
{
    return (area->count + RT_FILM_BAND_ROWS - 1) / RT_FILM_BAND_ROWS;
}

/* The area that a band lies in; *from: its first row there. */
static rt_film_area area_of(const rt_film *film, size_t band, size_t *from)
{
    rt_film_area areas[RT_FILM_AREAS];
    const int count = rt_film_areas(areas, film);
    for (int i = 0; i < count; i++) {
        const size_t bands = bands_of(areas + i);
        *from = band * RT_FILM_BAND_ROWS;
        if (band < bands || i == count - 1)
            return areas[i];
        band -= bands;
    }
    return areas[0];
}

size_t rt_film_bands(const rt_film *film)
{
    rt_film_area areas[RT_FILM_AREAS];
    const int count = rt_film_areas(areas, film);
    size_t bands = 0;
    for (int i = 0; i < count; i++)
        bands += bands_of(areas + i);
    return bands;
}

size_t rt_film_band_of(const rt_film *film, size_t row)
{
    rt_film_area areas[RT_FILM_AREAS];
    const int count = rt_film_areas(areas, film);
    size_t before = 0;
    int i = 0;
    for (; i + 1 < count && row >= areas[i + 1].first; i++)
        before += bands_of(areas + i);
    return before + (row - areas[i].first) / RT_FILM_BAND_ROWS;
}

size_t rt_film_band_most(const rt_film *film)
{
    rt_film_area areas[RT_FILM_AREAS];
    const int count = rt_film_areas(areas, film);
    size_t most = 0;
    for (int i = 0; i < count; i++) {
        /* Runs are shortest where each has one row and is followed by an empty one. */
        const size_t alone = RT_FILM_RANGE + rt_columns_most(areas[i].table, 1),
                     whole = RT_FILM_RANGE + rt_columns_most(areas[i].table, RT_COLUMNS_ROWS);
        const size_t rows = (alone + 1) / 2 * RT_FILM_BAND_ROWS,
                     runs = RT_FILM_BAND_ROWS / RT_COLUMNS_ROWS * whole;
        most = rows > most ? rows : most;
        most = runs > most ? runs : most;
    }
    return most + RT_COLUMNS_BEYOND;
}

/* Writes the runs among some rows, which are numbered from `number` on. */
static uint64_t put_runs(rt_writer *w, const rt_film_area *area, size_t rows, uint64_t number)
{
    uint64_t runs = 0;
    for (size_t first = 0, end; first < rows; first = end + 1) {
        for (end = first; end < rows && rt_area_has_samples(area, end);)
            end++;
        if (end == first)
            continue;
        rt_put64(w, number + first);
        rt_put64(w, end - first);
        rt_columns_put(w, area->table, (uint8_t *)area->rows + first * area->table->size,
                       end - first);
        runs++;
    }
    return runs;
}

size_t rt_film_put_band(uint8_t *out, uint64_t *runs, const rt_film *film, size_t band)
{
    /* Packing goes through a few rows many times: memory is read once, in order. */
    uint64_t rows[RT_COLUMNS_ROWS * RT_AREA_ROW_MOST / sizeof(uint64_t)];
    size_t from = 0;
    const rt_film_area area = area_of(film, band, &from);
    rt_film_area some = area;
    const size_t size = area.table->size, left = area.count - from,
                 end = from + (left < RT_FILM_BAND_ROWS ? left : RT_FILM_BAND_ROWS);
    rt_writer w = {out};
    some.rows = rows;
    *runs = 0;
    for (size_t at = from, count; at < end; at += count) {
        count = end - at < RT_COLUMNS_ROWS ? end - at : RT_COLUMNS_ROWS;
        memcpy(rows, (const uint8_t *)area.rows + at * size, count * size);
        *runs += put_runs(&w, &some, count, area.first + at);
    }
    return (size_t)(w.at - out);
}

/* ---- The file ----------------------------------------------------------------- */

/* A film and what its file holds. */
typedef struct film_file {
    const rt_film *film;
    rt_bytes head;
    size_t bands, size;
    uint8_t *band; /* room for the longest */
} film_file;

/* Finds out what a film's file holds, and makes memory for writing it; file_free. */
static rt_status file_open(film_file *file, const rt_film *film, rt_error *error)
{
    *file = (film_file){.film = film};
    if (rt_is_missing(film, "film", error))
        return RT_ERROR_USAGE;
    size_t content = 0;
    uint64_t runs = 0, more;
    file->bands = rt_film_bands(film);
    file->band = malloc(rt_film_band_most(film));
    if (!file->band)
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory to write a film");
    for (size_t band = 0; band < file->bands && film->scene; band++, runs += more)
        content += rt_film_put_band(file->band, &more, film, band);
    rt_status status = rt_film_put_head(&file->head, film, runs, content, error);
    file->size = file->head.size + content + RT_FRAME_CHECKSUM;
    return status;
}

static void file_free(film_file *file)
{
    rt_bytes_free(&file->head);
    free(file->band);
}

/* Writes all to memory or, without, to a file; returns the errno of what failed, or 0. */
static int file_put(const film_file *file, uint8_t *to, int fd)
{
    rt_sink sink = rt_sink_begin(to, fd);
    uint64_t runs;
    int code = rt_sink_put(&sink, file->head.data, file->head.size);
    for (size_t band = 0; band < file->bands && !code; band++) {
        const size_t size = rt_film_put_band(file->band, &runs, file->film, band);
        code = rt_sink_put(&sink, file->band, size);
    }
    return code ? code : rt_sink_end(&sink);
}

static int file_content(const void *user, int fd)
{
    return file_put(user, NULL, fd);
}

rt_status rt_film_save(const rt_film *film, const char *path, rt_error *error)
{
    film_file file;
    rt_status status = file_open(&file, film, error);
    if (status == RT_OK)
        status = rt_file_replace_by(path, file_content, &file, error);
    file_free(&file);
    return status;
}

rt_status rt_film_encode(const rt_film *film, void *buffer, size_t capacity, size_t *size,
                         rt_error *error)
{
    film_file file;
    rt_status status = file_open(&file, film, error);
    if (status == RT_OK) {
        *size = file.size;
        if (buffer && file.size <= capacity)
            file_put(&file, buffer, -1);
        else if (buffer)
            status =
                rt_fail(error, RT_ERROR_USAGE, "the film takes %zu bytes, and the buffer has %zu",
                        file.size, capacity);
    }
    file_free(&file);
    return status;
}

rt_status rt_film_send(const rt_film *film, int to, rt_error *error)
{
    film_file file;
    char cause[RT_CAUSE_SIZE];
    rt_status status = file_open(&file, film, error);
    const int code = status == RT_OK ? file_put(&file, NULL, to) : 0;
    if (code)
        status = rt_fail(error, RT_ERROR_OUTPUT, "cannot send a film: %s", rt_cause(cause, code));
    file_free(&file);
    return status;
}
