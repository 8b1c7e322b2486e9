/* test_preview.c - pictures that are looked at while they are rendered. */
#include "support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "film_renders.h"

static rt_renderer *renderer(void)
{
    static rt_renderer *made;
    if (!made)
        made = test_renderer(film_room);
    return made;
}

/* What was seen of a render. */
typedef struct watcher {
    unsigned previews;
    double done; /* of the last one */
    int grows;
    int has_light;
} watcher;

static void watch(void *user, const rt_film *film)
{
    watcher *w = user;
    rt_film_info info;
    rt_error error;
    const size_t pixels = rt_film_pixels(film);
    float *rgb = malloc(3 * pixels * sizeof *rgb);
    assert_non_null(rgb);
    rt_film_get_info(film, &info);
    w->grows &= info.done > w->done || w->previews == 0;
    w->done = info.done;
    w->previews++;
    memset(rgb, 0xff, 3 * pixels * sizeof *rgb);
    expect_ok(rt_film_preview(rgb, film, NULL, NULL, &error), &error);
    for (size_t i = 0; i < 3 * pixels; i++) {
        assert_true(isfinite(rgb[i]));
        w->has_light |= rgb[i] > 0;
    }
    free(rgb);
}

/* Whether rt_film_preview makes the bytes of what is given. */
static void expect_previewed(const rt_film *film, const char *layer, const float *is, uint32_t has)
{
    const size_t pixels = rt_film_pixels(film);
    uint32_t channels = 0;
    rt_error error;
    expect_ok(rt_film_preview(NULL, film, layer, &channels, &error), &error);
    assert_int_equal(channels, has);
    float *out = malloc(channels * pixels * sizeof *out);
    assert_non_null(out);
    expect_ok(rt_film_preview(out, film, layer, NULL, &error), &error);
    assert_memory_equal(out, is, channels * pixels * sizeof *out);
    free(out);
}

static void previews_of_a_finished_film_are_its_means_and_layers(void **state)
{
    (void)state;
    for (size_t i = 0; i < FILM_RENDERS; i++) {
        const rt_render_options o = film_render_options(film_renders + i);
        rt_film *film = NULL;
        rt_error error;
        expect_ok(rt_render(&film, renderer(), &o, &error), &error);
        expect_previewed(film, NULL, rt_film_rgb(film), 3);
        const char *name;
        size_t previewed = 0;
        for (size_t at = 0; (name = rt_film_layer_name(film, at)); at++) {
            uint32_t channels;
            const float *layer = rt_film_layer(film, name, &channels);
            if (strcmp(name, "error_bound") == 0) { /* of whole pictures alone */
                assert_int_equal(rt_film_preview(NULL, film, name, NULL, &error), RT_ERROR_USAGE);
                continue;
            }
            assert_string_equal(rt_film_preview_name(film, previewed++), name);
            expect_previewed(film, name, layer, channels);
        }
        assert_null(rt_film_preview_name(film, previewed));
        assert_int_equal(rt_film_preview(NULL, film, "colour", NULL, &error), RT_ERROR_USAGE);
        rt_film_destroy(film);
    }
}

static void previews_leave_the_picture_as_it_is(void **state)
{
    (void)state;
    for (size_t i = 0; i < FILM_RENDERS; i++) {
        rt_render_options o = film_render_options(film_renders + i);
        watcher seen = {.grows = 1};
        rt_film *plain = NULL, *watched = NULL;
        rt_error error;
        expect_ok(rt_render(&plain, renderer(), &o, &error), &error);
        o.preview = watch;
        o.preview_user = &seen;
        expect_ok(rt_render(&watched, renderer(), &o, &error), &error);
        expect_same_film(plain, watched, film_renders[i].name);
        assert_true(seen.previews > 0 && seen.grows);
        assert_true(seen.has_light || o.photons == 2);
        rt_film_destroy(plain);
        rt_film_destroy(watched);
    }
}

/* Of three workers, whose films are shown as they are handed over. */
static void a_shared_picture_is_previewed_as_a_whole(void **state)
{
    rt_render_options o = film_render_options(film_renders);
    watcher seen = {.grows = 1};
    rt_share *share = NULL;
    rt_film *film = NULL;
    rt_error error;
    (void)state;
    o.parts = o.part = 0;
    o.preview = watch;
    o.preview_user = &seen;
    expect_ok(rt_share_create(&share, renderer(), &o, &error), &error);
    for (int worker = 0; worker < 3; worker++)
        expect_ok(rt_share_render(share, renderer(), NULL, &error), &error);
    expect_ok(rt_share_finish(&film, share, NULL, &error), &error);
    assert_true(seen.previews > 0 && seen.done == 1 && seen.has_light);
    rt_film_destroy(film);
    rt_share_destroy(share);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(previews_of_a_finished_film_are_its_means_and_layers),
        cmocka_unit_test(previews_leave_the_picture_as_it_is),
        cmocka_unit_test(a_shared_picture_is_previewed_as_a_whole),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
