/*
 * test_films.c - films and photon maps in parts, in which each call for memory, to files and to
 * OpenCL fails in turn: each ends with the right picture or with an error, and all is freed. And a
 * process that is killed before each of its calls while it writes a checkpoint: the file is then
 * whole, the older one or the newer.
 *
 * The whole takes minutes; `make check-faults` runs it, by RT_TEST_LONG=1. Without that every so
 * manyth call fails.
 */
#define _XOPEN_SOURCE 700

#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/file.h"
#include "faults/fault.h"
#include "faults/inject.h"
#include "film/film.h"
#include "lib/image/scratch.h"
#include "setting/options.h"
#include "support.h"

#define WORLD                                                                                      \
    "camera { eye 0 1.5 -5  look_at 0 0.8 0  fov 45 }\n"                                           \
    "material paper { kd 0.7 }\nmaterial glass { kt 1  ior 1.5  fresnel dielectric }\n"            \
    "quad { corner -4 0 -4  edge1 0 0 8  edge2 8 0 0  material paper }\n"                          \
    "sphere { centre 1 1 0  radius 0.9  material glass }\n"                                        \
    "light point { position -2 3 -2  intensity 5 }\n"

enum { width = 8, height = 6 };

/* A picture in two parts, as a film and as files. */
typedef struct picture {
    const char *name;
    rt_render_options options;
    rt_renderer *renderer;
} picture;

static const picture pictures[] = {
    {.name = "path", .options = {.mode = RT_MODE_PATH, .spp = 3, .aov = 1}},
    {.name = "path with error", .options = {.mode = RT_MODE_PATH, .spp = 9, .variance = 1}},
    {.name = "passes",
     .options = {.mode = RT_MODE_PHOTON, .passes = 3, .photons = 500, .photon_layers = 1}},
};
enum { PICTURES = sizeof pictures / sizeof *pictures };

/* A checkpoint with no times, so that its bytes are always the same. */
typedef struct keeper {
    const char *path;
    rt_status status;
    rt_error *error;
} keeper;

static void forget_times(rt_film *film)
{
    rt_film_stats *s = &film->stats;
    s->build_seconds = s->compile_seconds = s->emit_seconds = s->gather_seconds =
        s->render_seconds = 0;
}

static void keep(void *user, const rt_film *film)
{
    keeper *k = user;
    size_t size;
    rt_film *copy = NULL;
    void *bytes = NULL;
    k->status = rt_film_encode(film, NULL, 0, &size, k->error);
    if (k->status == RT_OK) {
        bytes = malloc(size);
        k->status = bytes ? rt_film_encode(film, bytes, size, &size, k->error)
                          : rt_fail(k->error, RT_ERROR_MEMORY, "no memory");
    }
    if (k->status == RT_OK)
        k->status = rt_film_decode(&copy, bytes, size, k->error);
    if (k->status == RT_OK) {
        forget_times(copy);
        k->status = rt_film_save(copy, k->path, k->error);
    }
    rt_film_destroy(copy);
    free(bytes);
}

/* ---- Each call fails ------------------------------------------------------------------------- */

static inject_end end_of(rt_status status, const rt_error *error)
{
    return status == RT_OK                                     ? INJECT_DONE
           : error->status == status && error->message[0] != 0 ? INJECT_ERROR
                                                               : INJECT_WRONG;
}

/* Loads the two parts, adds them, and writes the picture and the film. */
static inject_end join_parts(const void *data)
{
    rt_film *film = NULL, *other = NULL;
    rt_error error;
    (void)data;
    memset(&error, 0, sizeof error);
    rt_status status = rt_film_load(&film, "1.rtpart", NULL, &error);
    if (status == RT_OK)
        status = rt_film_load(&other, "2.rtpart", NULL, &error);
    if (status == RT_OK)
        status = rt_film_add(film, other, &error);
    if (status == RT_OK)
        status = rt_film_resolve(film, NULL, &error);
    if (status == RT_OK)
        status = rt_film_write(film, "out.pfm", NULL, &error);
    if (status == RT_OK)
        status = rt_film_save(film, "out.rtpart", &error);
    rt_film_destroy(other);
    rt_film_destroy(film);
    return end_of(status, &error);
}

/* A sum that failed for want of memory has nothing of the other film, and can be made again. */
static inject_end add_twice(const void *data)
{
    rt_film *film = NULL, *other = NULL;
    rt_error error, first;
    (void)data;
    memset(&error, 0, sizeof error);
    memset(&first, 0, sizeof first);
    rt_status status = rt_film_load(&film, "1.rtpart", NULL, &error);
    if (status == RT_OK)
        status = rt_film_load(&other, "2.rtpart", NULL, &error);
    if (status == RT_OK && rt_film_add(film, other, &first) != RT_OK)
        status = rt_film_add(film, other, &error);
    if (status == RT_OK)
        status = rt_film_resolve(film, NULL, &error);
    if (status == RT_OK)
        status = rt_film_write(film, "out.pfm", NULL, &error);
    rt_film_destroy(other);
    rt_film_destroy(film);
    return end_of(status, &error);
}

/* Goes on from the first part to the whole, with a checkpoint at the end. */
static inject_end go_on(const void *data)
{
    const picture *p = data;
    rt_render_options o = p->options;
    rt_film *from = NULL, *film = NULL;
    rt_error error, kept;
    memset(&error, 0, sizeof error);
    memset(&kept, 0, sizeof kept);
    keeper k = {"out.rtpart", RT_OK, &kept};
    o.checkpoint = keep;
    o.checkpoint_user = &k;
    o.checkpoint_seconds = 1e9;
    rt_status status = rt_film_load(&from, "1.rtpart", NULL, &error);
    o.resume = from;
    if (status == RT_OK)
        status = rt_render(&film, p->renderer, &o, &error);
    if (status == RT_OK)
        status = rt_film_write(film, "out.pfm", NULL, &error);
    if (status == RT_OK && k.status != RT_OK) {
        status = k.status;
        error = kept;
    }
    rt_film_destroy(film);
    rt_film_destroy(from);
    return end_of(status, &error);
}

/* Chunk by chunk, each through its bytes. */
static inject_end chunks(const void *data)
{
    const picture *p = data;
    rt_film *film = NULL;
    uint64_t count = 0;
    rt_error error;
    memset(&error, 0, sizeof error);
    rt_status status = rt_chunk_count(&count, &p->options, &error);
    for (uint64_t i = 0; i < count && status == RT_OK; i++) {
        rt_film *chunk = NULL;
        status = rt_chunk_render(&chunk, p->renderer, &p->options, i, 1, &error);
        if (status == RT_OK && film)
            status = rt_film_add(film, chunk, &error);
        if (status == RT_OK && !film) {
            film = chunk;
            chunk = NULL;
        }
        rt_film_destroy(chunk);
    }
    if (status == RT_OK)
        status = rt_film_resolve(film, NULL, &error);
    if (status == RT_OK)
        status = rt_film_write(film, "out.pfm", NULL, &error);
    rt_film_destroy(film);
    return end_of(status, &error);
}

static void save_part(const picture *p, uint32_t part, const char *path)
{
    rt_render_options o = p->options;
    rt_film *film = NULL;
    rt_error error;
    o.part = part;
    o.parts = 2;
    expect_ok(rt_render(&film, p->renderer, &o, &error), &error);
    forget_times(film);
    expect_ok(rt_film_save(film, path, &error), &error);
    rt_film_destroy(film);
}

static void inject_task_of(const picture *p, const char *name, inject_end (*work)(const void *),
                           const char *const *outputs, long step)
{
    const inject_task task = {name, work, p, outputs};
    inject_tally sum = {0, 0, 0};
    inject_all(&task, inject_step(step), &sum);
    print_message("%s, %s: %ld calls failed: %ld errors, %ld right\n", p->name, name, sum.calls,
                  sum.errors, sum.survived);
    assert_true(sum.errors > 0 || work == add_twice);
}

static void each_call_of_films_put_together(void **state)
{
    static const char *const picture_alone[] = {"out.pfm", NULL};
    static const char *const both[] = {"out.pfm", "out.rtpart", NULL};
    (void)state;
    for (size_t i = 0; i < PICTURES; i++) {
        picture p = pictures[i];
        p.options.width = width;
        p.options.height = height;
        p.renderer = test_renderer(WORLD);
        save_part(&p, 1, "1.rtpart");
        save_part(&p, 2, "2.rtpart");
        inject_task_of(&p, "join", join_parts, both, 1);
        inject_task_of(&p, "add twice", add_twice, picture_alone, 1);
        inject_task_of(&p, "go on", go_on, both, 7);
        inject_task_of(&p, "chunks", chunks, picture_alone, 41);
        rt_renderer_destroy(p.renderer);
    }
}

/* ---- Photon maps ----------------------------------------------------------------------------- */

static void keep_map(void *user, const rt_photon_map *map)
{
    keeper *k = user;
    k->status = rt_photon_map_save(map, k->path, k->error);
}

static inject_end emit_on(const void *data)
{
    const picture *p = data;
    rt_error error, kept;
    memset(&error, 0, sizeof error);
    memset(&kept, 0, sizeof kept);
    keeper k = {"out.rtp", RT_OK, &kept};
    rt_emit_options o = {.render = &p->options, .checkpoint = keep_map, .checkpoint_user = &k};
    rt_photon_map *from = NULL, *map = NULL;
    o.checkpoint_seconds = 1e9;
    rt_status status = rt_photon_map_load(&from, "1.rtp", &error);
    o.resume = from;
    if (status == RT_OK)
        status = rt_photon_map_emit(&map, p->renderer, &o, &error);
    if (status == RT_OK && k.status != RT_OK) {
        status = k.status;
        error = kept;
    }
    rt_photon_map_destroy(map);
    rt_photon_map_destroy(from);
    return end_of(status, &error);
}

static void each_call_of_an_emission_that_goes_on(void **state)
{
    static const char *const outputs[] = {"out.rtp", NULL};
    picture p = {.name = "photons", .options = {.photons = 900, .caustic_photons = 300}};
    rt_emit_options o = {.render = &p.options, .part = 1, .parts = 3};
    rt_photon_map *map = NULL;
    rt_error error;
    (void)state;
    p.renderer = test_renderer(WORLD);
    expect_ok(rt_photon_map_emit(&map, p.renderer, &o, &error), &error);
    expect_ok(rt_photon_map_save(map, "1.rtp", &error), &error);
    rt_photon_map_destroy(map);
    inject_task_of(&p, "go on", emit_on, outputs, 3);
    rt_renderer_destroy(p.renderer);
}

/* ---- Killed before each call ----------------------------------------------------------------- */

/* A film of so many samples, whose file is written in several pieces. */
static rt_film *make_film(uint32_t samples)
{
    rt_render_options o = {.width = 400, .height = 200, .spp = 4, .mode = RT_MODE_PATH};
    rt_film *film = NULL;
    rt_error error;
    rt_options_complete(&o);
    expect_ok(rt_film_create(&film, &o, NULL, &error), &error);
    film->scene = 1;
    for (size_t i = 0; i < rt_film_pixels(film); i++) {
        rt_film_pixel *pixel = film->pixels + i;
        for (int c = 0; c < 3; c++) {
            pixel->high[c] = (int64_t)(i * 0x9e3779b97f4a7c15u >> 20) * samples;
            pixel->low[c] = (int64_t)(i * 0xbf58476d1ce4e5b9u >> 24);
        }
        pixel->count = samples;
        pixel->weight = (int32_t)samples;
    }
    const rt_unit_range done = {0, (uint64_t)samples * rt_film_pixels(film)};
    expect_ok(rt_coverage_add(&film->done, done, &error), &error);
    return film;
}

/* Saves a film in a process that is killed before its n-th call; whether it came that far. */
static int save_and_die(const rt_film *film, const char *path, long n)
{
    int status;
    fflush(NULL);
    const pid_t child = fork();
    assert_int_not_equal(child, -1);
    if (child == 0) {
        rt_error error;
        fault_kill_at(n);
        const rt_status saved = rt_film_save(film, path, &error);
        fault_disarm();
        _exit(saved == RT_OK ? 0 : 1);
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    if (WIFSIGNALED(status))
        assert_int_equal(WTERMSIG(status), SIGKILL);
    else
        assert_int_equal(WEXITSTATUS(status), 0);
    return WIFSIGNALED(status);
}

static rt_bytes read_file(const char *path)
{
    rt_bytes bytes = {0};
    rt_error error;
    expect_ok(rt_file_read(&bytes, path, 1 << 26, &error), &error);
    return bytes;
}

/* Kills of one kind, and what they left. */
typedef struct kill_tally {
    int kills, older, none, newer;
} kill_tally;

/* The older film at path, or none, and beside it what one killed process left, as ever. */
static void set_scene(const char *path, const rt_film *older, const rt_film *any)
{
    rt_error error;
    expect_ok(rt_film_save(older ? older : any, path, &error), &error);
    if (!older)
        unlink(path);
    scratch_write(".rt-999999999-0.tmp", "half a film");
}

/* The file is there, the one or the other to the byte, and can be read; counts which. */
static void look_at(const char *path, const rt_bytes right[2], kill_tally *tally)
{
    rt_film *film = NULL;
    rt_error error;
    tally->kills++;
    if (access(path, F_OK) != 0) {
        assert_int_equal(right[0].size, 0);
        tally->none++;
        return;
    }
    rt_bytes now = read_file(path);
    const int is_new = now.size == right[1].size && memcmp(now.data, right[1].data, now.size) == 0;
    assert_int_equal(now.size, right[is_new].size);
    assert_memory_equal(now.data, right[is_new].data, now.size);
    expect_ok(rt_film_load(&film, path, NULL, &error), &error);
    tally->newer += is_new;
    tally->older += !is_new;
    rt_film_destroy(film);
    rt_bytes_free(&now);
}

/* Kills at each call while the newer film takes the place of the older one, if there is one. */
static void kill_all(const char *path, const rt_film *older, const rt_film *newer, kill_tally *sum)
{
    rt_bytes right[2] = {{0}, {0}};
    kill_tally now = {0, 0, 0, 0};
    rt_error error;
    set_scene(path, older, newer);
    if (older)
        right[0] = read_file(path);
    expect_ok(rt_film_save(newer, "right.rtpart", &error), &error);
    right[1] = read_file("right.rtpart");
    assert_true(right[1].size > 2 << 20); /* three pieces */
    for (long n = 1; set_scene(path, older, newer), save_and_die(newer, path, n); n++)
        look_at(path, right, &now);
    rt_bytes_free(&right[0]);
    rt_bytes_free(&right[1]);
    print_message("%s: %d kills left the older film %d times, none %d times, the newer %d times\n",
                  path, now.kills, now.older, now.none, now.newer);
    assert_true(now.newer > 0 && now.older + now.none > 0);
    sum->kills += now.kills;
    sum->older += now.older;
    sum->none += now.none;
    sum->newer += now.newer;
}

static void a_kill_at_any_call_leaves_a_whole_file(void **state)
{
    rt_film *older = make_film(2), *newer = make_film(3);
    kill_tally sum = {0, 0, 0, 0};
    (void)state;
    kill_all("film.rtpart", older, newer, &sum);
    kill_all("first.rtpart", NULL, newer, &sum);
    assert_int_equal(symlink("film.rtpart", "link.rtpart"), 0);
    kill_all("link.rtpart", older, newer, &sum);
    print_message("%d kills: the older film %d times, none %d times, the newer %d times\n",
                  sum.kills, sum.older, sum.none, sum.newer);
    assert_true(sum.kills >= 50);
    /* film, first, link and right: what killed processes left is gone. */
    assert_int_equal(scratch_count(), 4);
    rt_film_destroy(newer);
    rt_film_destroy(older);
}

/* Writes "new" over "old" while call n fails. */
static rt_status save_without(long n, rt_error *error)
{
    scratch_write("file", "old");
    fault_arm(n, 0);
    const rt_status status = rt_file_write("file", "new", 3, error);
    fault_disarm();
    return status;
}

/* The numbers of the calls of fsync() while a file is replaced. */
static int find_syncs(long out[2])
{
    int count = 0;
    rt_error error;
    for (long n = 1; save_without(n, &error), fault_fired(); n++)
        if (strcmp(fault_fired(), "fsync") == 0 && count++ < 2)
            out[count - 1] = n;
    return count;
}

/* The file first, then its folder; file systems that cannot synchronise a folder are none worse. */
static void the_folder_is_synchronised_where_it_can_be(void **state)
{
    static const int cannot[] = {EINVAL, ENOTSUP, ENOSYS};
    long at[2];
    rt_error error;
    (void)state;
    assert_int_equal(find_syncs(at), 2);
    assert_int_equal(save_without(at[0], &error), RT_ERROR_OUTPUT);
    scratch_expect("file", "old");
    assert_int_equal(save_without(at[1], &error), RT_ERROR_OUTPUT);
    assert_non_null(strstr(error.message, strerror(EIO)));
    scratch_expect("file", "new");
    for (size_t i = 0; i < sizeof cannot / sizeof *cannot; i++) {
        fault_fail_sync_with(cannot[i]);
        assert_int_equal(save_without(at[0], &error), RT_ERROR_OUTPUT);
        assert_int_equal(save_without(at[1], &error), RT_OK);
        scratch_expect("file", "new");
    }
    fault_fail_sync_with(EIO);
    assert_int_equal(scratch_count(), 1);
}

int main(void)
{
#define IN_SCRATCH(test) cmocka_unit_test_setup_teardown(test, scratch_enter, scratch_leave)
    /* The kills come before a device is opened: a child has the threads of none. */
    const struct CMUnitTest tests[] = {
        IN_SCRATCH(a_kill_at_any_call_leaves_a_whole_file),
        IN_SCRATCH(the_folder_is_synchronised_where_it_can_be),
        IN_SCRATCH(each_call_of_films_put_together),
        IN_SCRATCH(each_call_of_an_emission_that_goes_on),
    };
    return cmocka_run_group_tests_name("faults/films", tests, NULL, NULL);
}
