/* means.c - the means of small pictures, by which renders of materials are judged. */
#include "lib/render/means.h"

#include <string.h>

#include "kernels/statistics.h"
#include "support.h"

enum { side = 16, pixels = side * side, longest = 12 };

static void means_of(double means[3], rt_renderer *renderer, rt_render_options options)
{
    rt_film *film = NULL;
    rt_error error;
    options.width = options.height = side;
    options.seed = test_seed(options.seed);
    expect_ok(rt_render(&film, renderer, &options, &error), &error);
    memset(means, 0, 3 * sizeof *means);
    for (int i = 0; i < 3 * pixels; i++)
        means[i % 3] += (double)rt_film_rgb(film)[i] / pixels;
    rt_film_destroy(film);
}

void render_means(double means[3], const char *text, rt_render_options options)
{
    rt_renderer *renderer = test_renderer(text);
    means_of(means, renderer, options);
    rt_renderer_destroy(renderer);
}

/* One map serves photons without a final gather and with one. */
static void expect_photons_agree(rt_renderer *renderer, const double by_paths[3])
{
    rt_render_options photons = {.mode = RT_MODE_PHOTON,
                                 .spp = 64,
                                 .photons = 400000,
                                 .k = 100,
                                 .max_depth = longest,
                                 .seed = test_seed(0)};
    rt_photon_map *map = NULL;
    rt_error error;
    const rt_emit_options all = {.render = &photons};
    expect_ok(rt_photon_map_emit(&map, renderer, &all, &error), &error);
    photons.photon_map = map;
    photons.seed = 0;
    for (; photons.final_gather < 2; photons.final_gather++) {
        double means[3];
        means_of(means, renderer, photons);
        for (int c = 0; c < 3; c++)
            expect_close(means[c], by_paths[c], 0.03 * by_paths[c],
                         photons.final_gather ? "a final gather" : "the map alone");
    }
    rt_photon_map_destroy(map);
}

void expect_modes_agree(const char *text)
{
    double by_paths[3], means[3];
    rt_renderer *renderer = test_renderer(text);
    means_of(by_paths, renderer, (rt_render_options){.spp = 1024, .max_depth = longest});
    means_of(means, renderer,
             (rt_render_options){.mode = RT_MODE_VCM, .spp = 128, .max_depth = longest});
    for (int c = 0; c < 3; c++)
        expect_close(means[c], by_paths[c], 0.015 * by_paths[c], "vertex connection and merging");
    expect_photons_agree(renderer, by_paths);
    rt_renderer_destroy(renderer);
}

void expect_gathered_means(const char *text)
{
    double by_paths[3], means[3];
    render_means(by_paths, text, (rt_render_options){.spp = 256, .max_depth = 2});
    render_means(means, text,
                 (rt_render_options){.mode = RT_MODE_PHOTON,
                                     .spp = 32,
                                     .photons = 100000,
                                     .k = 50,
                                     .direct = RT_DIRECT_PHOTONS,
                                     .gather_roughness = 0.1f,
                                     .max_depth = 2});
    for (int c = 0; c < 3; c++)
        expect_close(means[c], by_paths[c], 0.03 * by_paths[c], "gathered facets");
}
