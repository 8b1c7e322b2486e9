/*
 * test_kept_photons.c - renders whose photons stay on the device are those whose photons the host
 * collects: the same films, ledgers and counts, to the bit, also where the device has no room.
 */
#include "support.h"

#include <stdio.h>
#include <string.h>

#include "device/device.h"
#include "lib/mode/film_renders.h"

static rt_film *render(rt_renderer *renderer, const rt_render_options *options, int keeps)
{
    rt_film *film = NULL;
    rt_error error;
    test_device()->keeps_photons = keeps;
    expect_ok(rt_render(&film, renderer, options, &error), &error);
    return film;
}

static rt_render_options options_of(const film_render *of)
{
    rt_render_options o = film_render_options(of);
    o.gather = RT_GATHER_DEVICE;
    return o;
}

static void films_are_those_of_photons_on_the_host(void **state)
{
    rt_renderer *renderer = test_renderer(film_room);
    (void)state;
    for (int i = 0; i < FILM_RENDERS; i++) {
        if (film_renders[i].options.mode != RT_MODE_PHOTON)
            continue;
        rt_render_options o = options_of(film_renders + i);
        rt_film *host = render(renderer, &o, 0), *device = render(renderer, &o, 1);
        expect_same_film(host, device, film_renders[i].name);
        rt_film_destroy(host);
        rt_film_destroy(device);
    }
    rt_renderer_destroy(renderer);
}

/* More lights than sums are taken of. */
static void many_lights_are_booked_alike(void **state)
{
    char text[16384];
    size_t used = (size_t)snprintf(text, sizeof text, "%s", film_room);
    (void)state;
    for (int i = 0; i < 40; i++)
        used += (size_t)snprintf(text + used, sizeof text - used,
                                 "light point { position %g 1.5 0.2  intensity %g 1 1 }\n",
                                 0.02 * i - 0.4, 0.1 * i);
    assert_true(used < sizeof text);
    rt_renderer *renderer = test_renderer(text);
    rt_render_options o = {
        .mode = RT_MODE_PHOTON, .width = 24, .height = 16, .passes = 3, .photons = 2000};
    rt_film *host = render(renderer, &o, 0), *device = render(renderer, &o, 1);
    expect_same_film(host, device, "many lights");
    rt_film_destroy(host);
    rt_film_destroy(device);
    rt_renderer_destroy(renderer);
}

/* ---- Little memory --------------------------------------------------------------------- */

static void note_move(void *user, const char *line)
{
    *(int *)user += strstr(line, "no room for them") != NULL;
}

/* Photons take more than a buffer may have, from some pass or batch on. */
static void photons_without_room_are_taken_to_the_host(void **state)
{
    rt_renderer *renderer = test_renderer(film_room);
    rt_device *device = test_device();
    const uint64_t largest = device->info.largest_buffer;
    int moves = 0;
    const rt_hooks hooks = {.log = note_move, .user = &moves};
    rt_render_options o = {.mode = RT_MODE_PHOTON,
                           .width = 24,
                           .height = 16,
                           .passes = 3,
                           .photons = 20000,
                           .direct = RT_DIRECT_PHOTONS,
                           .hooks = &hooks};
    (void)state;
    rt_film *host = render(renderer, &o, 0);
    assert_int_equal(moves, 0);
    device->info.largest_buffer = 220000;
    rt_film *moved = render(renderer, &o, 1);
    device->info.largest_buffer = largest;
    assert_true(moves > 0);
    expect_same_film(host, moved, "photons on the host");
    rt_film_destroy(host);
    rt_film_destroy(moved);
    rt_renderer_destroy(renderer);
}

static int leave(void **state)
{
    (void)state;
    test_device()->keeps_photons = 0;
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(films_are_those_of_photons_on_the_host),
        cmocka_unit_test(many_lights_are_booked_alike),
        cmocka_unit_test(photons_without_room_are_taken_to_the_host),
    };
    return cmocka_run_group_tests(tests, NULL, leave);
}
