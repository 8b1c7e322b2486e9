/* film_write.c - the sums of a film as a file; film_file.h describes the bytes. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/crc32.h"
#include "base/error.h"
#include "base/file.h"
#include "base/wire.h"
#include "film/film_file.h"
#include "photon/ledger_file.h"

const uint8_t rt_film_magic[8] = {0x89, 'R', 'T', 'F', '\r', '\n', 0x1a, '\n'};

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

/* ---- Pixels ------------------------------------------------------------------- */

/* The pixels of a film, of all planes and then of all layers. */
typedef struct all_pixels {
    const rt_film *film;
    size_t planes, count;
} all_pixels;

static all_pixels pixels_of(const rt_film *film)
{
    const size_t pixels = rt_film_pixels(film), planes = pixels * film->units.replicates;
    return (all_pixels){film, planes, planes + (film->layer_sums ? RT_LAYER_COUNT * pixels : 0)};
}

static const rt_film_pixel *pixel_at(const all_pixels *all, size_t i)
{
    return i < all->planes ? all->film->pixels + i : all->film->layer_sums + (i - all->planes);
}

static int has_samples(const rt_film_pixel *p)
{
    return p->count > 0 || p->bins != 0;
}

/* The next run of pixels with samples from *first on; its length, 0: there is none. */
static size_t find_run(const all_pixels *all, size_t *first)
{
    size_t end;
    while (*first < all->count && !has_samples(pixel_at(all, *first)))
        ++*first;
    for (end = *first; end < all->count && has_samples(pixel_at(all, end));)
        end++;
    return end - *first;
}

static void put_pixel(rt_writer *w, const rt_film_pixel *p)
{
    for (int c = 0; c < 3; c++)
        rt_put64(w, (uint64_t)p->high[c]);
    for (int c = 0; c < 3; c++)
        rt_put64(w, (uint64_t)p->low[c]);
    rt_put32(w, p->bins);
    rt_put32(w, (uint32_t)p->weight);
    rt_put32(w, p->count);
    rt_put32(w, p->cut_off);
}

static void put_exact(rt_writer *w, const rt_exact_sum *sum)
{
    rt_put64(w, (uint64_t)sum->high);
    rt_put64(w, (uint64_t)sum->low);
    rt_put64(w, (uint64_t)sum->bin);
}

static void put_photon_sums(rt_writer *w, const rt_photon_sums *s)
{
    rt_put64(w, s->asked);
    rt_put64(w, s->photons);
    rt_put64(w, s->samples);
    put_exact(w, &s->radius);
    put_exact(w, &s->density);
    put_exact(w, &s->value);
    put_exact(w, &s->square);
    put_exact(w, &s->bias);
}

/* ---- The file ----------------------------------------------------------------- */

/* Counts of what the file holds. */
typedef struct counts {
    size_t text, runs, pixels, photon_sums, size;
} counts;

static counts count_all(const rt_film *film, size_t text)
{
    const all_pixels all = pixels_of(film);
    counts n = {.text = text};
    for (size_t first = 0, length; (length = find_run(&all, &first)) > 0; first += length) {
        n.runs++;
        n.pixels += length;
    }
    n.photon_sums = film->photon_sums ? rt_film_pixels(film) : 0;
    n.size = RT_FILM_HEADER + n.text + RT_LEDGER_ROW_BYTES * film->ledger.count +
             RT_FILM_RANGE * (film->done.count + n.runs) + RT_FILM_PIXEL * n.pixels +
             RT_FILM_PHOTON_SUMS * n.photon_sums + RT_FILM_CHECKSUM;
    return n;
}

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

static void put_header(rt_writer *w, const rt_film *film, const counts *n)
{
    memcpy(w->at, rt_film_magic, sizeof rt_film_magic);
    w->at += sizeof rt_film_magic;
    rt_put32(w, RT_FILM_VERSION);
    rt_put32(w, RT_FILM_HEADER);
    rt_put64(w, n->size);
    rt_put64(w, film->scene);
    rt_put64(w, film->light);
    rt_put32(w, (uint32_t)n->text);
    rt_put32(w, film->units.replicates);
    rt_put32(w, film->units.base);
    rt_put32(w, (film->layer_sums ? 1u : 0u) | (film->photon_sums ? 2u : 0u));
    rt_put32(w, film->options.part);
    rt_put32(w, film->options.parts);
    rt_put64(w, film->done.count);
    rt_put64(w, n->runs);
    put_stats(w, film);
}

static void put_content(rt_writer *w, const rt_film *film)
{
    const all_pixels all = pixels_of(film);
    for (size_t i = 0; i < film->ledger.count; i++)
        rt_ledger_put(w, film->ledger.rows + i);
    for (size_t i = 0; i < film->done.count; i++) {
        rt_put64(w, film->done.ranges[i].first);
        rt_put64(w, film->done.ranges[i].count);
    }
    for (size_t first = 0, length; (length = find_run(&all, &first)) > 0; first += length) {
        rt_put64(w, first);
        rt_put64(w, length);
        for (size_t i = first; i < first + length; i++)
            put_pixel(w, pixel_at(&all, i));
    }
    for (size_t i = 0; i < rt_film_pixels(film) && film->photon_sums; i++)
        put_photon_sums(w, film->photon_sums + i);
}

rt_status rt_film_encode_in(rt_bytes *out, const rt_film *film, rt_error *error)
{
    rt_bytes text = {0};
    rt_status status = put_text(&text, film, error);
    const counts n = count_all(film, text.size);
    if (status == RT_OK)
        status = rt_memory_take(film->memory, n.size, "the file of the film", error);
    if (status != RT_OK)
        goto out;
    uint8_t *data = malloc(n.size);
    if (!data) {
        rt_memory_give(film->memory, n.size);
        status = rt_fail(error, RT_ERROR_MEMORY, "out of memory: %zu bytes for a file", n.size);
        goto out;
    }
    rt_writer w = {data};
    put_header(&w, film, &n);
    memcpy(w.at, text.data, text.size);
    w.at += text.size;
    put_content(&w, film);
    rt_put32(&w, rt_crc32(data, n.size - RT_FILM_CHECKSUM));
    *out = (rt_bytes){data, n.size, n.size, film->memory};
out:
    rt_bytes_free(&text);
    return status;
}

/* Fails for a film that could not be told from those of other pictures. */
static rt_status check_identity(const rt_film *film, rt_error *error)
{
    if (rt_is_missing(film, "film", error))
        return RT_ERROR_USAGE;
    return film->scene ? RT_OK
                       : rt_fail(error, RT_ERROR_USAGE,
                                 "the film was rendered without a part (1 of 1 for the whole "
                                 "picture) or checkpoint, and cannot be kept");
}

rt_status rt_film_save(const rt_film *film, const char *path, rt_error *error)
{
    rt_bytes bytes = {0};
    rt_status status = check_identity(film, error);
    if (status == RT_OK)
        status = rt_film_encode_in(&bytes, film, error);
    if (status == RT_OK)
        status = rt_file_replace(path, &bytes, error);
    rt_bytes_free(&bytes);
    return status;
}

rt_status rt_film_encode(const rt_film *film, void *buffer, size_t capacity, size_t *size,
                         rt_error *error)
{
    rt_bytes bytes = {0};
    rt_status status = check_identity(film, error);
    if (status == RT_OK)
        status = rt_film_encode_in(&bytes, film, error);
    if (status == RT_OK) {
        *size = bytes.size;
        if (bytes.size <= capacity)
            memcpy(buffer, bytes.data, bytes.size);
        else if (buffer)
            status =
                rt_fail(error, RT_ERROR_USAGE, "the film takes %zu bytes, and the buffer has %zu",
                        bytes.size, capacity);
    }
    rt_bytes_free(&bytes);
    return status;
}
