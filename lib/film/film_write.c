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

/* ---- Rows of blocks --------------------------------------------------------------- */

static void set_pixel(rt_block *b, size_t row, const rt_film_pixel *p)
{
    for (int c = 0; c < 3; c++) {
        b->values[c][row] = p->high[c];
        b->values[3 + c][row] = p->low[c];
    }
    b->values[6][row] = p->bins;
    b->values[7][row] = (int64_t)p->count - p->weight;
    b->values[8][row] = p->count;
    b->values[9][row] = p->cut_off;
}

static void set_exact(rt_block *b, size_t row, int column, const rt_exact_sum *sum)
{
    b->values[column][row] = sum->high;
    b->values[column + 1][row] = sum->low;
    b->values[column + 2][row] = sum->bin;
}

static void set_photon_sums(rt_block *b, size_t row, const rt_photon_sums *s)
{
    b->values[0][row] = (int64_t)s->asked;
    b->values[1][row] = (int64_t)s->photons;
    b->values[2][row] = (int64_t)s->samples;
    set_exact(b, row, 3, &s->radius);
    set_exact(b, row, 6, &s->density);
    set_exact(b, row, 9, &s->value);
    set_exact(b, row, 12, &s->square);
    set_exact(b, row, 15, &s->bias);
}

/* ---- Where the bytes go --------------------------------------------------------- */

/* The bytes that are put together before they go to the file. */
enum { STREAM_BYTES = 1 << 20 };

/* All zero: bytes are counted and go nowhere. */
typedef struct stream {
    rt_writer w;
    uint8_t *bytes; /* [STREAM_BYTES + RT_BLOCK_BEYOND], those that have not gone yet */
    uint8_t *to;    /* memory for all of them, or NULL */
    int fd;         /* of the file, without memory */
    int code;       /* the errno of what failed, or 0 */
    uint32_t sum;   /* checksum of those that have gone */
    size_t counted; /* bytes */
    uint64_t runs;  /* of pixels */
} stream;

static void flush(stream *s)
{
    const size_t size = (size_t)(s->w.at - s->bytes);
    s->sum = rt_crc32_add(s->sum, s->bytes, size);
    if (s->to) {
        memcpy(s->to, s->bytes, size);
        s->to += size;
    } else if (s->code == 0) {
        s->code = rt_file_put(s->fd, s->bytes, size);
    }
    s->w.at = s->bytes;
}

/* Where to write so many bytes. */
static rt_writer *room(stream *s, size_t size)
{
    if (size > STREAM_BYTES - (size_t)(s->w.at - s->bytes))
        flush(s);
    return &s->w;
}

static void put_text_bytes(stream *s, const rt_bytes *text)
{
    for (size_t at = 0, size; at < text->size; at += size) {
        size = text->size - at < STREAM_BYTES ? text->size - at : STREAM_BYTES;
        rt_writer *w = room(s, size);
        memcpy(w->at, text->data + at, size);
        w->at += size;
    }
}

static void put_range(stream *s, uint64_t first, uint64_t count)
{
    s->counted += RT_FILM_RANGE;
    if (!s->bytes)
        return;
    rt_writer *w = room(s, RT_FILM_RANGE);
    rt_put64(w, first);
    rt_put64(w, count);
}

static void put_block(stream *s, const rt_block *block)
{
    if (s->bytes)
        rt_block_put(room(s, RT_BLOCK_BYTES), block);
    else
        s->counted += rt_block_size(block);
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

/*
 * The next run of pixels with samples from *first on, of planes or of layers alone; its length, 0:
 * there is none.
 */
static size_t find_run(const all_pixels *all, size_t *first)
{
    size_t end;
    while (*first < all->count && !has_samples(pixel_at(all, *first)))
        ++*first;
    const size_t limit = *first < all->planes ? all->planes : all->count;
    for (end = *first; end < limit && has_samples(pixel_at(all, end));)
        end++;
    return end - *first;
}

static void put_pixels(stream *s, const rt_film *film)
{
    const all_pixels all = pixels_of(film);
    rt_block block = {.columns = RT_FILM_PIXEL_COLUMNS};
    for (size_t first = 0, length; (length = find_run(&all, &first)) > 0; first += length) {
        s->runs++;
        put_range(s, first, length);
        for (size_t at = 0; at < length; at += block.rows) {
            block.rows = length - at < RT_BLOCK_ROWS ? length - at : RT_BLOCK_ROWS;
            for (size_t i = 0; i < block.rows; i++)
                set_pixel(&block, i, pixel_at(&all, first + at + i));
            put_block(s, &block);
        }
    }
}

static void put_photon_sums(stream *s, const rt_film *film)
{
    const size_t pixels = film->photon_sums ? rt_film_pixels(film) : 0;
    rt_block block = {.columns = RT_FILM_SUMS_COLUMNS};
    for (size_t at = 0; at < pixels; at += block.rows) {
        block.rows = pixels - at < RT_BLOCK_ROWS ? pixels - at : RT_BLOCK_ROWS;
        for (size_t i = 0; i < block.rows; i++)
            set_photon_sums(&block, i, film->photon_sums + at + i);
        put_block(s, &block);
    }
}

/* ---- The file ----------------------------------------------------------------- */

/* A film and what its file holds. */
typedef struct film_file {
    const rt_film *film;
    rt_bytes text;
    uint64_t runs;
    size_t size;
    uint8_t *bytes; /* for the stream */
} film_file;

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

static void put_header(rt_writer *w, const film_file *file)
{
    const rt_film *film = file->film;
    rt_frame_put(w, &rt_film_frame, file->size);
    rt_put64(w, film->scene);
    rt_put64(w, film->light);
    rt_put32(w, (uint32_t)file->text.size);
    rt_put32(w, film->units.replicates);
    rt_put32(w, film->units.base);
    rt_put32(w, (film->layer_sums ? 1u : 0u) | (film->photon_sums ? 2u : 0u) |
                    (film->lacks_base ? 4u : 0u));
    rt_put32(w, film->options.part);
    rt_put32(w, film->options.parts);
    rt_put64(w, film->done.count);
    rt_put64(w, file->runs);
    put_stats(w, film);
}

/* Finds out what a film's file holds, and makes memory for writing it; file_free. */
static rt_status file_open(film_file *file, const rt_film *film, rt_error *error)
{
    stream count = {0};
    *file = (film_file){.film = film};
    if (rt_is_missing(film, "film", error))
        return RT_ERROR_USAGE;
    if (!film->scene)
        return rt_fail(error, RT_ERROR_USAGE,
                       "the film was rendered without a part (1 of 1 for the whole picture) or "
                       "checkpoint, and cannot be kept");
    rt_status status = put_text(&file->text, film, error);
    if (status != RT_OK)
        return status;
    put_pixels(&count, film);
    put_photon_sums(&count, film);
    file->runs = count.runs;
    file->size = RT_FILM_HEADER + file->text.size + RT_LEDGER_ROW_BYTES * film->ledger.count +
                 RT_FILM_RANGE * film->done.count + count.counted + RT_FRAME_CHECKSUM;
    file->bytes = malloc(STREAM_BYTES + RT_BLOCK_BEYOND);
    return file->bytes ? RT_OK : rt_fail(error, RT_ERROR_MEMORY, "out of memory to write a film");
}

static void file_free(film_file *file)
{
    rt_bytes_free(&file->text);
    free(file->bytes);
}

/* Writes all to memory or, without, to a file; returns the errno of what failed, or 0. */
static int file_put(const film_file *file, uint8_t *to, int fd)
{
    const rt_film *film = file->film;
    stream s = {.w = {file->bytes}, .bytes = file->bytes, .to = to, .fd = fd};
    put_header(room(&s, RT_FILM_HEADER), file);
    put_text_bytes(&s, &file->text);
    for (size_t i = 0; i < film->ledger.count; i++)
        rt_ledger_put(room(&s, RT_LEDGER_ROW_BYTES), film->ledger.rows + i);
    for (size_t i = 0; i < film->done.count; i++)
        put_range(&s, film->done.ranges[i].first, film->done.ranges[i].count);
    put_pixels(&s, film);
    put_photon_sums(&s, film);
    flush(&s);
    rt_put32(&s.w, s.sum);
    flush(&s);
    return s.code;
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
