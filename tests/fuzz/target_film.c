/* target_film.c - files of films. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "film/film_file.h"
#include "film/join.h"
#include "fuzz/targets.h"
#include "setting/options.h"

/* What a film may take: a picture that an input asks for is no larger than its text says. */
enum { MEMORY_MAX = 1 << 22 };

/* ---- Promises ------------------------------------------------------------------------------ */

static rt_memory *limit(void)
{
    rt_memory *memory = NULL;
    rt_error error;
    FUZZ_EXPECT(rt_memory_create(&memory, MEMORY_MAX, &error) == RT_OK);
    return memory;
}

/* A film, or NULL where it is refused; too large ones count as refused. */
static rt_film *decode(const uint8_t *data, size_t size, rt_memory *memory)
{
    rt_film *film = fuzz_untouched;
    rt_error error;
    rt_status status = rt_film_decode_in(&film, data, size, "fuzz", memory, &error);
    if (status == RT_ERROR_MEMORY) {
        fuzz_expect_line(error.message);
        FUZZ_EXPECT(film == fuzz_untouched);
        return NULL;
    }
    return fuzz_expect_answer(status, &error, film) ? film : NULL;
}

static rt_bytes encode(const rt_film *film)
{
    rt_bytes bytes = {0};
    rt_error error;
    FUZZ_EXPECT(rt_film_encode(film, NULL, 0, &bytes.size, &error) == RT_OK);
    bytes.data = malloc(bytes.size);
    FUZZ_EXPECT(bytes.data != NULL);
    FUZZ_EXPECT(rt_film_encode(film, bytes.data, bytes.size, &bytes.size, &error) == RT_OK);
    return bytes;
}

static int is_same(const rt_bytes *a, const rt_bytes *b)
{
    return a->size == b->size && memcmp(a->data, b->data, a->size) == 0;
}

/* A copy through the bytes that the film is written as, which is the same to the bit. */
static rt_film *copy(const rt_film *film)
{
    rt_bytes bytes = encode(film);
    rt_film *again = decode(bytes.data, bytes.size, NULL);
    FUZZ_EXPECT(again != NULL);
    rt_bytes second = encode(again);
    FUZZ_EXPECT(is_same(&bytes, &second));
    rt_bytes_free(&bytes);
    rt_bytes_free(&second);
    return again;
}

static void check_info(const rt_film *film)
{
    rt_render_options options;
    rt_film_info info;
    rt_error error;
    rt_film_get_info(film, &info);
    rt_film_get_options(film, &options);
    FUZZ_EXPECT(info.done >= 0 && info.done <= 1.0001 && info.units_done <= info.units);
    FUZZ_EXPECT(info.seconds >= 0 && rt_film_part_done(film, 2, 3) <= 1);
    FUZZ_EXPECT(rt_render_options_check(&options, &error) == RT_OK);
}

/* Added to a film, or that to it, it fits or not, and the sum is the same. */
static void check_add(const rt_film *film, const rt_film *other)
{
    rt_film *sums[2] = {copy(film), copy(other)};
    rt_bytes before[2] = {encode(film), encode(other)}, after[2];
    rt_status status[2];
    rt_error error;
    for (int i = 0; i < 2; i++) {
        status[i] = rt_film_add(sums[i], i ? film : other, &error);
        FUZZ_EXPECT(status[i] == RT_OK || status[i] == RT_ERROR_USAGE);
        after[i] = encode(sums[i]);
        if (status[i] != RT_OK) {
            fuzz_expect_line(error.message);
            FUZZ_EXPECT(is_same(&before[i], &after[i]));
        } else {
            FUZZ_EXPECT(rt_film_resolve(sums[i], NULL, &error) == RT_OK);
        }
    }
    FUZZ_EXPECT(status[0] == status[1]);
    for (int i = 0; i < 2; i++) {
        rt_bytes_free(&before[i]);
        rt_bytes_free(&after[i]);
        rt_film_destroy(sums[i]);
    }
}

/* A render goes on from it, with as many samples or with more. */
static void check_continue(const rt_film *film, uint32_t more)
{
    rt_render_options options;
    rt_film *next = NULL;
    rt_error error;
    rt_film_get_options(film, &options);
    options.spp += film->units.in_passes ? 0 : more;
    options.passes += film->units.in_passes ? more : 0;
    if (rt_render_options_check(&options, &error) != RT_OK)
        return;
    FUZZ_EXPECT(rt_film_create(&next, &options, NULL, &error) == RT_OK);
    next->scene = film->scene;
    next->light = film->light;
    rt_status status = rt_film_continue(next, film, &error);
    FUZZ_EXPECT(status == RT_OK || (more && status == RT_ERROR_USAGE));
    if (status == RT_OK) {
        FUZZ_EXPECT(rt_film_resolve(next, NULL, &error) == RT_OK);
        check_info(next);
    }
    rt_film_destroy(next);
}

/* Its picture can be made and written; loaded, the film is the same. */
static void check_files(const rt_film *film)
{
    rt_film *shown = copy(film), *again = NULL;
    rt_image_options options = {.scene = "fuzz"};
    rt_error error;
    FUZZ_EXPECT(rt_film_resolve(shown, NULL, &error) == RT_OK);
    FUZZ_EXPECT(rt_film_resolve(shown, NULL, &error) == RT_OK);
    for (size_t i = 0; i < 3 * rt_film_pixels(shown); i++)
        FUZZ_EXPECT(!isnan(rt_film_rgb(shown)[i]));
    FUZZ_EXPECT(rt_film_write(shown, "film.exr", &options, &error) == RT_OK);
    FUZZ_EXPECT(rt_film_write(shown, "film.png", &options, &error) == RT_OK);
    FUZZ_EXPECT(rt_film_save(film, "film.rtpart", &error) == RT_OK);
    FUZZ_EXPECT(rt_film_load(&again, "film.rtpart", NULL, &error) == RT_OK);
    rt_bytes first = encode(film), second = encode(again);
    FUZZ_EXPECT(is_same(&first, &second));
    rt_bytes_free(&first);
    rt_bytes_free(&second);
    rt_film_destroy(again);
    rt_film_destroy(shown);
}

static rt_film *make_seed(size_t number);

static int run(const uint8_t *data, size_t size)
{
    rt_memory *memory = limit();
    rt_film *film = decode(data, size, memory);
    if (film && film->scene) {
        rt_film *other = make_seed(size % 2), *same = copy(film);
        check_info(film);
        check_add(film, other);
        check_add(film, same);
        check_continue(film, 0);
        check_continue(film, 3);
        check_files(film);
        rt_film_destroy(same);
        rt_film_destroy(other);
    }
    const int is_good = film != NULL;
    rt_film_destroy(film);
    rt_memory_destroy(memory);
    return is_good;
}

/* ---- Seeds --------------------------------------------------------------------------------- */

/* Sums of a pixel that could be: two samples of weight 1. */
static void fill(rt_film_pixel *p, size_t i)
{
    for (int c = 0; c < 3; c++) {
        p->high[c] = (int64_t)(1000 * i) + c;
        p->low[c] = (int64_t)i << 24;
    }
    p->bins = 0x333;
    p->weight = 2;
    p->count = 2;
    p->cut_off = (uint32_t)i;
}

/* The same of its layers: one of the samples hit. */
static void fill_hits(rt_first_hits *hits, size_t i)
{
    for (int c = 0; c < 3; c++)
        hits->albedo[c] = hits->normal[c] = (int64_t)(i + 1) << 30;
    for (int c = 0; c < RT_HIT_CHANNELS; c++) {
        hits->high[c] = (int64_t)(1000 * i) - c;
        hits->low[c] = (int64_t)i << 24;
    }
    hits->bins = 0x333333;
    hits->count = 2;
    hits->weight = 2;
    hits->hits = 1;
    hits->hit_weight = 1;
    hits->first = 1;
    hits->shape = (uint32_t)i;
}

static void fill_ledger(rt_film *film)
{
    rt_error error;
    film->ledger.rows =
        rt_memory_zeroed(NULL, 2, sizeof *film->ledger.rows, "the energy ledger", &error);
    FUZZ_EXPECT(film->ledger.rows != NULL);
    film->ledger.count = 2;
    film->ledger.paths = 90;
    for (uint32_t i = 0; i < 2; i++)
        film->ledger.rows[i] = (rt_ledger_row){
            .shape = i, .exponent = -20, .paths = 40, .power = {1, 2, 3}, .share = 0.5};
}

/* What a film has done of its work. */
typedef struct sample_film {
    rt_render_options options;
    rt_unit_range done[2];
    size_t empty; /* pixels without samples at its start */
} sample_film;

static const sample_film samples[] = {
    {{.mode = RT_MODE_PATH, .spp = 2, .parts = 2, .part = 1}, {{0, 3}, {5, 1}}, 0},
    {{.mode = RT_MODE_PATH, .spp = 2, .parts = 2, .part = 2}, {{3, 2}, {6, 6}}, 2},
    {{.mode = RT_MODE_PATH, .spp = 16, .variance = 1}, {{0, 48}}, 0},
    {{.mode = RT_MODE_DIRECT, .spp = 4, .aov = 1, .filter = RT_FILTER_MITCHELL}, {{0, 12}}, 0},
    {{.mode = RT_MODE_NORMALS, .spp = 1}, {{0, 6}}, 1},
    {{.mode = RT_MODE_PHOTON, .passes = 4, .photon_layers = 1}, {{0, 1}, {2, 2}}, 0},
    {{.mode = RT_MODE_PHOTON, .spp = 3, .photon_layers = 1, .variance = 0}, {{0, 18}}, 0},
};

enum { SAMPLES = sizeof samples / sizeof *samples };

static rt_film *make_seed(size_t number)
{
    const sample_film *sample = samples + number;
    rt_render_options o = sample->options;
    rt_film *film = NULL;
    rt_error error;
    o.width = 3;
    o.height = 2;
    o.note = "scene a.rts\ncommand rtc a.rts\n";
    rt_options_complete(&o);
    FUZZ_EXPECT(rt_film_create(&film, &o, NULL, &error) == RT_OK);
    film->scene = 7;
    if (o.aov || !rt_mode_shows_light(o.mode))
        FUZZ_EXPECT(rt_film_make_first_hits(film, &error) == RT_OK);
    for (size_t i = sample->empty; i < rt_film_pixels(film) * film->units.replicates; i++)
        fill(film->pixels + i, i);
    for (size_t i = 0; film->first_hits && i < rt_film_pixels(film); i++)
        fill_hits(film->first_hits + i, i);
    for (size_t i = 0; film->photon_sums && i < rt_film_pixels(film); i++) {
        film->photon_sums[i].asked = film->photon_sums[i].samples = 2;
        rt_exact_sum_add(&film->photon_sums[i].value, (double)i);
    }
    if (o.mode == RT_MODE_PHOTON)
        fill_ledger(film);
    for (int i = 0; i < 2; i++)
        FUZZ_EXPECT(rt_coverage_add(&film->done, sample->done[i], &error) == RT_OK);
    return film;
}

static void seed(fuzz_inputs *seeds)
{
    for (size_t i = 0; i < SAMPLES; i++) {
        rt_film *film = make_seed(i);
        rt_bytes bytes = encode(film);
        fuzz_add(seeds, bytes.data, bytes.size);
        rt_bytes_free(&bytes);
        rt_film_destroy(film);
    }
}

/* The names of all settings, as they begin a line. */
static void words(fuzz_inputs *out)
{
    size_t count;
    const rt_setting *settings = rt_settings(&count);
    for (size_t i = 0; i < count; i++)
        fuzz_add_text(out, settings[i].field.name);
    fuzz_add_text(out, "photon");
    fuzz_add_text(out, "true");
}

/* ---- Mutation ------------------------------------------------------------------------------ */

/* Places in the header: the first that counts, the bytes of the text, and numbers of parts. */
enum { at_scene = 24, at_text = 40, at_ranges = 64, at_runs = 72, at_lights = 80 };

/* Bytes of the text, as far as there are so many. */
static size_t text_size(const uint8_t *data, size_t size)
{
    const size_t most = size - RT_FILM_HEADER - RT_FRAME_CHECKSUM;
    const uint64_t told = fuzz_get(data + at_text, 4);
    return told < most ? (size_t)told : most;
}

/* Changes some bytes of a part of the file, which may become longer or shorter. */
static size_t change(uint8_t *data, size_t size, size_t room, size_t at, size_t length)
{
    static uint8_t part[1 << 13];
    if (length > sizeof part / 2)
        length = sizeof part / 2;
    memcpy(part, data + at, length);
    const size_t changed = fuzz_mutate_bytes(part, length, sizeof part);
    return fuzz_splice(data, size, room, at, length, part, changed);
}

/* The text stays one of lines, and its length right. */
static size_t change_text(uint8_t *data, size_t size, size_t room)
{
    const size_t length = text_size(data, size);
    if (length == 0)
        return size;
    const size_t changed = change(data, size, room, RT_FILM_HEADER, length - 1);
    fuzz_set(data + at_text, length + changed - size, 4);
    return changed;
}

/* Doubles a line of the text, or takes one away. */
static size_t change_line(uint8_t *data, size_t size, size_t room, fuzz_random *random)
{
    const size_t length = text_size(data, size);
    uint8_t line[256];
    if (length == 0)
        return size;
    size_t first = RT_FILM_HEADER + fuzz_random_below(random, (uint32_t)length), end = first;
    while (first > RT_FILM_HEADER && data[first - 1] != '\n')
        first--;
    while (end < RT_FILM_HEADER + length && data[end - 1] != '\n')
        end++;
    if (end <= first || end - first > sizeof line)
        return size;
    memcpy(line, data + first, end - first);
    const int adds = fuzz_random_below(random, 2) != 0;
    const size_t changed =
        fuzz_splice(data, size, room, first, adds ? 0 : end - first, line, adds ? end - first : 0);
    fuzz_set(data + at_text, length + changed - size, 4);
    return changed;
}

static size_t mutate(uint8_t *data, size_t size, size_t room, uint32_t number)
{
    fuzz_random random = fuzz_random_begin(number);
    if (size < RT_FILM_HEADER + RT_FRAME_CHECKSUM)
        return fuzz_mutate_bytes(data, size, room);
    const size_t content = RT_FILM_HEADER + text_size(data, size),
                 rest = size - RT_FRAME_CHECKSUM - content;
    switch (fuzz_random_below(&random, 8)) {
    case 0:
        size = fuzz_mutate_bytes(data, size, room);
        break;
    case 1: {
        const size_t at = at_scene + fuzz_random_below(&random, RT_FILM_HEADER - at_scene);
        data[at] = (uint8_t)fuzz_random_below(&random, 256);
        break;
    }
    case 2:
        data[at_text + 4 * fuzz_random_below(&random, 16)] ^=
            (uint8_t)(1u << fuzz_random_below(&random, 4));
        break;
    case 3:
        size = change_text(data, size, room);
        break;
    case 4:
        size = change_line(data, size, room, &random);
        break;
    case 5:
        size = change(data, size, room, content, rest);
        break;
    default:
        if (rest > 0)
            data[content + fuzz_random_below(&random, (uint32_t)rest)] ^=
                (uint8_t)(1u << fuzz_random_below(&random, 8));
        break;
    }
    if (fuzz_random_below(&random, 16))
        fuzz_seal(data, size, &rt_film_frame);
    return size;
}

const fuzz_target fuzz_target_film = {
    .name = "film",
    .sources = "lib/film/film_read* lib/film/film_write* lib/film/film_info* lib/film/columns* "
               "lib/film/join* lib/film/coverage*",
    .run = run,
    .seed = seed,
    .words = words,
    .mutate = mutate,
    .size_max = 4096,
    .tries = 4000,
};
