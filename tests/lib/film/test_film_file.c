/*
 * test_film_file.c - files of films: they come back to the bit, what is damaged is refused with its
 * reason, and what lies behind a sound checksum does no harm to what is done with it.
 */
#include "support.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "film/film_file.h"
#include "lib/base/frame_damage.h"
#include "lib/image/scratch.h"

static const char room[] = "camera { eye 0 1 3.4  look_at 0 1 0  fov 50 }\n"
                           "material white { kd 0.7 0.6 0.5 }\n"
                           "quad { corner -1 0 -1  edge1 2 0 0  edge2 0 0 2  material white }\n"
                           "light point { position 0.1 1.8 0.3  intensity 3 2 1 }\n";

static const rt_render_options renders[] = {
    {.mode = RT_MODE_PATH, .spp = 5, .variance = 1},
    {.mode = RT_MODE_DIRECT, .spp = 4, .aov = 1, .filter = RT_FILTER_MITCHELL},
    {.mode = RT_MODE_PHOTON, .passes = 6, .photons = 300, .photon_layers = 1},
};
enum { RENDERS = sizeof renders / sizeof *renders, PARTS = 3 };

static rt_renderer *renderer(void)
{
    static rt_renderer *made;
    if (!made)
        made = test_renderer(room);
    return made;
}

/* Part `part` of a small picture. */
static rt_film *render(const rt_render_options *options, uint32_t part)
{
    rt_render_options o = *options;
    rt_film *film = NULL;
    rt_error error;
    o.width = 4;
    o.height = 3;
    o.part = part;
    o.parts = PARTS;
    o.note = "scene room.rts\n";
    expect_ok(rt_render(&film, renderer(), &o, &error), &error);
    return film;
}

static rt_bytes encode(const rt_film *film)
{
    rt_bytes bytes = {0};
    rt_error error;
    expect_ok(rt_film_encode(film, NULL, 0, &bytes.size, &error), &error);
    bytes.data = malloc(bytes.size);
    assert_non_null(bytes.data);
    expect_ok(rt_film_encode(film, bytes.data, bytes.size, &bytes.size, &error), &error);
    return bytes;
}

static void expect_same_bytes(const rt_bytes *a, const rt_bytes *b)
{
    assert_int_equal(a->size, b->size);
    assert_memory_equal(a->data, b->data, a->size);
}

static void films_come_back_to_the_bit(void **state)
{
    (void)state;
    for (size_t i = 0; i < RENDERS; i++) {
        rt_film *film = render(renders + i, 2), *back = NULL;
        rt_bytes bytes = encode(film), file = {0};
        rt_error error;
        expect_ok(rt_film_save(film, "film.rtpart", &error), &error);
        expect_ok(rt_file_read(&file, "film.rtpart", 1 << 20, &error), &error);
        expect_same_bytes(&bytes, &file);
        expect_ok(rt_film_load(&back, "film.rtpart", NULL, &error), &error);
        rt_bytes again = encode(back);
        expect_same_bytes(&bytes, &again);
        assert_string_equal(rt_film_note(back), "scene room.rts\n");
        rt_bytes_free(&again);
        rt_bytes_free(&file);
        rt_bytes_free(&bytes);
        rt_film_destroy(back);
        rt_film_destroy(film);
    }
    assert_int_equal(scratch_count(), 1);
}

/* What could not be read back from a film. */
static void a_note_that_is_no_lines_is_refused(void **state)
{
    static const char *const notes[] = {"a\nb", "a b", "\n", "name\n", " value\n", "a b\nspp 4\n"};
    rt_render_options o = {.note = "a b\nc \n"};
    rt_error error;
    (void)state;
    expect_ok(rt_render_options_check(&o, &error), &error);
    for (size_t i = 0; i < sizeof notes / sizeof *notes; i++) {
        o.note = notes[i];
        assert_int_equal(rt_render_options_check(&o, &error), RT_ERROR_USAGE);
        assert_string_equal(error.field, "note");
    }
}

static void a_buffer_that_is_too_small_is_refused_with_what_it_takes(void **state)
{
    rt_film *film = render(renders, 1);
    rt_bytes bytes = encode(film);
    char says[64];
    size_t size = 0;
    rt_error error;
    (void)state;
    snprintf(says, sizeof says, "takes %zu bytes", bytes.size);
    assert_int_equal(rt_film_encode(film, bytes.data, bytes.size - 1, &size, &error),
                     RT_ERROR_USAGE);
    assert_non_null(strstr(error.message, says));
    assert_int_equal(size, bytes.size);
    rt_bytes_free(&bytes);
    rt_film_destroy(film);
}

/* Decoding must fail, say so, and leave no film. */
static void expect_refused(const uint8_t *data, size_t size, const char *reason)
{
    rt_film *film = NULL;
    rt_error error = {0};
    /* A copy of the exact size, so that a sanitizer sees what is read beyond it. */
    uint8_t *copy = malloc(size ? size : 1);
    assert_non_null(copy);
    memcpy(copy, data, size);
    rt_status status = rt_film_decode(&film, copy, size, &error);
    free(copy);
    assert_int_equal(status, RT_ERROR_INPUT);
    assert_null(film);
    if (!strstr(error.message, reason))
        fail_msg("'%s' does not say '%s'", error.message, reason);
}

static void a_damage_to_any_byte_is_refused(void **state)
{
    rt_film *film = render(renders + 2, 1);
    rt_bytes file = encode(film);
    (void)state;
    frame_damage(&file, "film file", expect_refused);
    rt_bytes_free(&file);
    rt_film_destroy(film);
}

/* Changes of the header that a checksum made anew would hide. */
static const frame_lie lies[] = {
    {0, 0, 1, "no film file"},
    {8, 4, 4, "version 4 "},
    {12, 64, 4, "header of 64"},
    {40, UINT32_MAX, 4, "too short for its text"},
    {44, 8, 4, "layers do not go"},
    {48, 100000, 4, "layers do not go"},
    {48, 1, 4, "layers do not go"}, /* passes have no base */
    {52, 1, 4, "layers do not go"},
    {52, 3, 4, "layers do not go"}, /* layers that its settings do not ask for */
    {52, 4, 4, "layers do not go"},
    {56, 4, 4, "do not fit together"}, /* part 4 of 3 */
    {64, UINT64_MAX, 8, "too short for its list"},
    {64, 0, 8, ""},
    {72, UINT64_MAX, 8, ""},
    {80, UINT64_MAX, 8, "too short for its ledger"},
    {88, 1, 8, "more paths"},
    {160, 0x7ff8000000000000u, 8, "times"},
    {168, 0xbff0000000000000u, 8, "times"},
};

static void lies_with_a_sound_checksum_are_refused(void **state)
{
    rt_film *film = render(renders + 2, 1);
    rt_bytes file = encode(film);
    (void)state;
    frame_tell_lies(&file, lies, sizeof lies / sizeof *lies, expect_refused);
    rt_bytes_free(&file);
    rt_film_destroy(film);
}

/* One after the other, each longer than the one before, and of other settings in between. */
static void a_saver_writes_what_save_does(void **state)
{
    rt_film_saver *saver = NULL;
    rt_error error;
    (void)state;
    expect_ok(rt_film_saver_create(&saver, "film.rtpart", &error), &error);
    for (size_t i = 0; i < 3 * RENDERS; i++) {
        rt_film *film = render(renders + i % RENDERS, 1 + (uint32_t)(i / RENDERS) % PARTS);
        rt_bytes file = {0}, bytes = encode(film);
        expect_ok(rt_film_saver_put(saver, film, &error), &error);
        rt_film_destroy(film);
        expect_ok(rt_film_saver_wait(saver, &error), &error);
        expect_ok(rt_file_read(&file, "film.rtpart", 1 << 20, &error), &error);
        expect_same_bytes(&bytes, &file);
        rt_bytes_free(&file);
        rt_bytes_free(&bytes);
    }
    rt_film_saver_destroy(saver);
    rt_film_saver_destroy(NULL);
    assert_int_equal(scratch_count(), 1);
}

/* A render whose film is saved in the middle of its work, again and again. */
typedef struct sitting {
    rt_film_saver *saver;
    uint64_t at, units; /* handed out so far, and of how many */
    int saves, is_saved;
} sitting;

/* Ranges of many lengths, some out of order, and a checkpoint after most of them. */
static rt_units_answer hand_out(void *user, uint64_t *first, uint64_t *count)
{
    sitting *s = user;
    if (s->at >= s->units)
        return RT_UNITS_NONE;
    if (!s->is_saved) {
        s->is_saved = 1;
        return RT_UNITS_SAVE;
    }
    const uint64_t each = s->units < 100 ? 1 : 1 + s->at * 7919 % 2500, left = s->units - s->at;
    s->is_saved = s->at % 3 == 0;
    *first = s->at;
    *count = each < left ? each : left;
    s->at += *count;
    return RT_UNITS_GIVEN;
}

/* The file has what the film has, whatever was packed before. */
static void save_and_compare(void *user, const rt_film *film)
{
    sitting *s = user;
    rt_bytes file = {0};
    rt_error error;
    expect_ok(rt_film_saver_put(s->saver, film, &error), &error);
    expect_ok(rt_film_saver_wait(s->saver, &error), &error);
    rt_bytes bytes = encode(film);
    expect_ok(rt_file_read(&file, "film.rtpart", 1 << 24, &error), &error);
    expect_same_bytes(&bytes, &file);
    rt_bytes_free(&file);
    rt_bytes_free(&bytes);
    s->saves++;
}

/* The picture has several bands of rows, whose ends are not those of tiles or planes. */
static void a_saver_packs_all_that_changed(void **state)
{
    (void)state;
    for (size_t i = 0; i < RENDERS; i++) {
        rt_render_options o = renders[i];
        sitting s = {0};
        rt_film *film = NULL;
        rt_error error;
        o.width = 107;
        o.height = 61;
        o.next_units = hand_out;
        o.checkpoint = save_and_compare;
        o.checkpoint_seconds = 1e6;
        o.units_user = o.checkpoint_user = &s;
        const uint32_t blocks = o.passes ? 0 : o.variance ? 8 : 4;
        s.units = o.passes ? o.passes : (uint64_t)blocks * o.width * o.height;
        expect_ok(rt_film_saver_create(&s.saver, "film.rtpart", &error), &error);
        expect_ok(rt_render(&film, renderer(), &o, &error), &error);
        assert_true(s.saves > 2);
        rt_film_saver_destroy(s.saver);
        rt_film_destroy(film);
    }
}

/* What it cannot write it tells at the next call, and once. */
static void expect_saved(rt_film_saver *saver, const rt_film *film)
{
    rt_bytes bytes = encode(film), file = {0};
    rt_error error;
    expect_ok(rt_film_saver_put(saver, film, &error), &error);
    expect_ok(rt_film_saver_wait(saver, &error), &error);
    expect_ok(rt_file_read(&file, "film.rtpart", 1 << 20, &error), &error);
    expect_same_bytes(&bytes, &file);
    rt_bytes_free(&file);
    rt_bytes_free(&bytes);
}

/* Of the same units, with another seed. */
static void a_saver_knows_a_film_at_the_address_of_another(void **state)
{
    rt_render_options o = renders[0];
    rt_film *film = render(&o, 1);
    o.seed = 7;
    rt_film *other = render(&o, 1);
    const rt_film first = *film, second = *other;
    rt_film_saver *saver = NULL;
    rt_error error;
    (void)state;
    expect_ok(rt_film_saver_create(&saver, "film.rtpart", &error), &error);
    expect_saved(saver, film);
    *film = second;
    *other = first;
    expect_saved(saver, film);
    rt_film_saver_destroy(saver);
    rt_film_destroy(film);
    rt_film_destroy(other);
}

/* They come from another film, and no unit tells of them: a block ends after 6 samples. */
static void a_saver_packs_samples_that_a_raised_film_lacked(void **state)
{
    rt_render_options o = {
        .mode = RT_MODE_PATH, .width = 4, .height = 3, .spp = 5, .part = 1, .parts = 1};
    rt_film *base = NULL, *with_base = NULL, *film = NULL;
    rt_film_saver *saver = NULL;
    rt_error error;
    (void)state;
    expect_ok(rt_render(&base, renderer(), &o, &error), &error);
    o.spp = 8;
    o.resume = base;
    expect_ok(rt_film_begin(&with_base, renderer(), &o, &error), &error);
    o.resume = NULL;
    o.raised_from = 5;
    expect_ok(rt_film_begin(&film, renderer(), &o, &error), &error);
    expect_ok(rt_film_saver_create(&saver, "film.rtpart", &error), &error);
    expect_saved(saver, film);
    expect_ok(rt_film_add(film, with_base, &error), &error);
    expect_saved(saver, film);
    rt_film_saver_destroy(saver);
    rt_film_destroy(film);
    rt_film_destroy(with_base);
    rt_film_destroy(base);
}

static void a_saver_tells_what_failed(void **state)
{
    rt_film_saver *saver = NULL;
    rt_film *film = render(renders, 1);
    rt_error error;
    (void)state;
    expect_ok(rt_film_saver_create(&saver, "missing/film.rtpart", &error), &error);
    expect_ok(rt_film_saver_put(saver, film, &error), &error);
    assert_int_equal(rt_film_saver_put(saver, film, &error), RT_ERROR_OUTPUT);
    assert_non_null(strstr(error.message, "missing/film.rtpart"));
    assert_int_equal(rt_film_saver_wait(saver, &error), RT_ERROR_OUTPUT);
    expect_ok(rt_film_saver_wait(saver, &error), &error);
    film->scene = 0;
    assert_int_equal(rt_film_saver_put(saver, film, &error), RT_ERROR_USAGE);
    rt_film_saver_destroy(saver);
    rt_film_destroy(film);
}

/* A film that just fits into memory is written all the same. */
static void a_saver_needs_no_memory_of_its_own(void **state)
{
    rt_film *film = render(renders, 1), *back = NULL;
    rt_bytes bytes = encode(film), file = {0};
    rt_film_saver *saver = NULL;
    rt_memory *memory = NULL;
    rt_error error;
    (void)state;
    expect_ok(rt_memory_create(&memory, 1 << 20, &error), &error);
    expect_ok(rt_film_decode_in(&back, bytes.data, bytes.size, "film", memory, &error), &error);
    rt_memory_info info;
    rt_memory_get_info(memory, &info);
    expect_ok(rt_memory_take(memory, info.limit - info.used, "the rest", &error), &error);
    expect_ok(rt_film_saver_create(&saver, "film.rtpart", &error), &error);
    expect_ok(rt_film_saver_put(saver, back, &error), &error);
    expect_ok(rt_file_read(&file, "film.rtpart", 1 << 20, &error), &error);
    expect_same_bytes(&bytes, &file);
    rt_film_saver_destroy(saver);
    rt_memory_give(memory, info.limit - info.used, "the rest");
    rt_film_destroy(back);
    rt_memory_destroy(memory);
    rt_bytes_free(&file);
    rt_bytes_free(&bytes);
    rt_film_destroy(film);
}

/* What a program does with a film that it was given: it all ends, with a result or a reason. */
static void use(rt_film *film, const rt_film *other, int is_rendered)
{
    rt_film *sum = NULL, *next = NULL;
    rt_render_options o;
    rt_error error;
    rt_bytes bytes = encode(other);
    rt_film_get_options(film, &o);
    expect_ok(rt_film_decode(&sum, bytes.data, bytes.size, &error), &error);
    rt_bytes_free(&bytes);
    rt_status status = rt_film_add(sum, film, &error);
    assert_true(status == RT_OK || status == RT_ERROR_USAGE);
    if (is_rendered && o.width <= 64 && o.height <= 64 && o.spp <= 64 && o.passes <= 64) {
        o.resume = film;
        status = rt_render(&next, renderer(), &o, &error);
        assert_true(status == RT_OK || status == RT_ERROR_USAGE);
    }
    expect_ok(rt_film_resolve(film, NULL, &error), &error);
    expect_ok(rt_film_resolve(sum, NULL, &error), &error);
    if (is_rendered)
        expect_ok(rt_film_write(film, "film.exr", NULL, &error), &error);
    rt_film_destroy(next);
    rt_film_destroy(sum);
}

/*
 * Any single byte of a file with a sound checksum may lie: the film is refused or harmless, to add,
 * to show, to write and to continue. The text of settings apart, whose pictures may be of any size.
 */
static void any_lie_is_refused_or_harmless(void **state)
{
    (void)state;
    for (size_t i = 0; i < RENDERS; i++) {
        rt_film *film = render(renders + i, 1), *other = render(renders + i, 2);
        rt_bytes file = encode(film);
        const size_t text = file.data[40] + 256u * file.data[41];
        for (size_t at = 8; at < file.size - 8; at++) {
            static const uint8_t turns[] = {0xff, 0x01, 0x80};
            if (at == RT_FILM_HEADER)
                at += text;
            for (size_t k = 0; k < sizeof turns; k++) {
                rt_film *back = NULL;
                rt_error error;
                file.data[at] ^= turns[k];
                frame_seal(&file);
                rt_status status = rt_film_decode(&back, file.data, file.size, &error);
                assert_true(status == RT_OK || status == RT_ERROR_INPUT);
                assert_int_equal(status == RT_OK, back != NULL);
                if (back && back->scene)
                    use(back, other, (at + k) % 23 == 0);
                rt_film_destroy(back);
                file.data[at] ^= turns[k];
            }
        }
        rt_bytes_free(&file);
        rt_film_destroy(other);
        rt_film_destroy(film);
    }
}

/* A film whose ledger has more lights than the scene is not continued. */
static void a_ledger_of_other_lights_is_not_continued(void **state)
{
    rt_film *film = render(renders + 2, 1), *next = NULL;
    rt_render_options o;
    rt_error error;
    (void)state;
    rt_film_get_options(film, &o);
    o.part = 2;
    o.resume = film;
    rt_ledger *ledger = &film->ledger;
    rt_ledger_row *rows = rt_memory_zeroed(NULL, 2, sizeof *rows, "a ledger", &error);
    assert_non_null(rows);
    rows[0] = ledger->rows[0];
    rt_memory_free(ledger->rows);
    ledger->rows = rows;
    ledger->count = 2;
    assert_int_equal(rt_render(&next, renderer(), &o, &error), RT_ERROR_USAGE);
    assert_non_null(strstr(error.message, "other lights"));
    rt_film_destroy(film);
}

/* In a text of the same length: a letter of the note goes to the value. */
static void say_without_variance(rt_bytes *file)
{
    static const char on[] = "variance true\n", off[] = "variance false\n";
    uint8_t *letter = memchr(file->data, '.', file->size), *at = letter;
    while (memcmp(at, on, strlen(on)) != 0)
        at++;
    memmove(letter, letter + 1, (size_t)(at - letter) - 1);
    memcpy(at - 1, off, strlen(off));
    frame_seal(file);
}

/* Earlier versions had eight sequences for target_error alone: such films are those of variance. */
static void films_of_earlier_sequences_are_read(void **state)
{
    rt_render_options o = {.width = 32,
                           .height = 32,
                           .spp = 64,
                           .variance = 1,
                           .target_error = 1e-6,
                           .part = 1,
                           .parts = 1,
                           .note = "scene room.rts\n"};
    rt_film *film = NULL, *back = NULL, *more = NULL;
    rt_error error = {0};
    rt_film_stats stats;
    (void)state;
    expect_ok(rt_render(&film, renderer(), &o, &error), &error);
    rt_bytes bytes = encode(film);
    say_without_variance(&bytes);
    expect_ok(rt_film_decode(&back, bytes.data, bytes.size, &error), &error);
    assert_string_equal(rt_film_note(back), "scene roomrts\n");
    assert_int_equal(back->units.replicates, 8);
    /* It goes on with variance alone. */
    o.resume = back;
    o.variance = 0;
    o.spp = 128;
    assert_int_equal(rt_render(&more, renderer(), &o, &error), RT_ERROR_USAGE);
    assert_non_null(strstr(error.message, "variance is false, and true in the film"));
    o.variance = 1;
    expect_ok(rt_render(&more, renderer(), &o, &error), &error);
    rt_film_get_stats(more, &stats);
    assert_int_equal(stats.spp, 128);
    rt_bytes_free(&bytes);
    rt_film_destroy(more);
    rt_film_destroy(back);
    rt_film_destroy(film);
}

static void a_target_cannot_be_dropped_from_two_sequences(void **state)
{
    rt_render_options o = {
        .width = 32, .height = 32, .spp = 16, .target_error = 1e-6, .part = 1, .parts = 1};
    rt_film *film = NULL, *more = NULL;
    rt_error error = {0};
    (void)state;
    expect_ok(rt_render(&film, renderer(), &o, &error), &error);
    o.resume = film;
    o.target_error = 0;
    assert_int_equal(rt_render(&more, renderer(), &o, &error), RT_ERROR_USAGE);
    assert_string_equal(error.field, "target_error");
    assert_non_null(strstr(error.message, "2 sequences of samples, for which target_error must"));
    rt_film_destroy(film);
}

static void what_is_no_film_is_refused_by_its_path(void **state)
{
    static const struct {
        const char *path, *reason;
    } cases[] = {{"missing.rtpart", "No such file"},
                 {".", "directory"},
                 {"empty.rtpart", "no film file"},
                 {"text.rtpart", "no film file"},
                 {"/dev/zero", "no film file"}};
    rt_film *film = NULL;
    rt_error error;
    (void)state;
    scratch_write("empty.rtpart", "");
    scratch_write("text.rtpart", "light point { position 0 0 0  power 1 }\n");
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        assert_int_equal(rt_film_load(&film, cases[i].path, NULL, &error), RT_ERROR_INPUT);
        assert_null(film);
        assert_non_null(strstr(error.message, cases[i].path));
        assert_non_null(strstr(error.message, cases[i].reason));
    }
}

/* Most numbers of a film are small, or near each other. */
static void films_take_few_bytes(void **state)
{
    rt_render_options o = {.mode = RT_MODE_PATH, .width = 64, .height = 64, .spp = 8, .aov = 1};
    rt_film *film = NULL;
    rt_error error;
    (void)state;
    o.part = o.parts = 1;
    expect_ok(rt_render(&film, renderer(), &o, &error), &error);
    rt_bytes bytes = encode(film);
    assert_true(bytes.size < 64 * 64 * (sizeof(rt_film_pixel) + sizeof(rt_first_hits)) / 2);
    rt_bytes_free(&bytes);
    rt_film_destroy(film);
}

static int release(void **state)
{
    (void)state;
    rt_renderer_destroy(renderer());
    return 0;
}

int main(void)
{
#define IN_SCRATCH(test) cmocka_unit_test_setup_teardown(test, scratch_enter, scratch_leave)
    const struct CMUnitTest tests[] = {
        IN_SCRATCH(films_come_back_to_the_bit),
        IN_SCRATCH(a_saver_writes_what_save_does),
        IN_SCRATCH(a_saver_packs_all_that_changed),
        IN_SCRATCH(a_saver_knows_a_film_at_the_address_of_another),
        IN_SCRATCH(a_saver_packs_samples_that_a_raised_film_lacked),
        IN_SCRATCH(a_saver_tells_what_failed),
        IN_SCRATCH(a_saver_needs_no_memory_of_its_own),
        cmocka_unit_test(a_note_that_is_no_lines_is_refused),
        cmocka_unit_test(a_buffer_that_is_too_small_is_refused_with_what_it_takes),
        cmocka_unit_test(a_damage_to_any_byte_is_refused),
        cmocka_unit_test(lies_with_a_sound_checksum_are_refused),
        IN_SCRATCH(any_lie_is_refused_or_harmless),
        cmocka_unit_test(a_ledger_of_other_lights_is_not_continued),
        IN_SCRATCH(films_of_earlier_sequences_are_read),
        cmocka_unit_test(a_target_cannot_be_dropped_from_two_sequences),
        IN_SCRATCH(what_is_no_film_is_refused_by_its_path),
        cmocka_unit_test(films_take_few_bytes),
    };
    return cmocka_run_group_tests_name("lib/film/film_file", tests, NULL, release);
}
