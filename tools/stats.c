/* stats.c - prints what a render did, for --stats. */
#include "stats.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "json.h"
#include "ledger.h"
#include "message.h"
#include "rays.h"
#include "timing.h"

static void print_count(const char *name, uint64_t count)
{
    printf("%s: %" PRIu64 "\n", name, count);
}

static void print_seconds(const char *name, double seconds)
{
    printf("%s: %.3f s\n", name, seconds);
}

static void print_scene(const rt_scene *scene)
{
    rt_scene_info info;
    rt_scene_get_info(scene, &info);
    print_count("shapes", info.shapes);
    print_count("primitives", info.primitives);
    print_count("triangles", info.triangles);
    print_count("materials", info.materials);
    print_count("lights", info.lights);
}

static void print_photons(const rt_film_stats *stats)
{
    print_count("photon paths emitted", stats->photons_emitted);
    print_count("photons stored", stats->photons_stored);
    print_count("photons rejected", stats->photons_rejected);
    if (stats->paths_seen > 0)
        printf("photon paths that the camera gathers from: %.3g %%, by importance %.3g %%\n",
               100 * stats->paths_seen, 100 * stats->paths_seen_by_importance);
    print_count("gathers", stats->gathers);
    print_count("gathers at path ends", stats->gathers_at_ends);
    print_count("gathers at path ends without a photon", stats->gathers_empty);
    if (stats->passes > 0)
        print_count("passes", stats->passes);
    print_seconds("emit time", stats->emit_seconds);
    print_seconds("gather time", stats->gather_seconds);
}

/* Where the flux of the photons went, as one format prints it. */
static void print_ledger(const rt_film *film,
                         void (*print)(const rt_light_ledger *rows, size_t count))
{
    size_t count = rt_film_get_ledger(film, NULL, 0);
    rt_light_ledger *rows = calloc(count + 1, sizeof *rows);
    if (!rows) {
        message_error("out of memory for the energy ledger");
        return;
    }
    rt_film_get_ledger(film, rows, count);
    print(rows, count);
    free(rows);
}

/* What max_depth cut off, of all light. */
static void print_cut_off(const rt_film_stats *stats, rt_mode mode)
{
    printf("throughput cut off: %.3g %%, largest in a block %.3g %%\n",
           100.0 * stats->cut_off_throughput, 100.0 * stats->cut_off_in_block);
    if (mode == RT_MODE_PHOTON)
        printf("photon flux cut off: %.3g %%\n", 100.0 * stats->cut_off_flux);
}

static void print_error(const rt_film_stats *stats)
{
    if (stats->relative_bias_bound > 0) {
        printf("relative bias: %.6g\n", stats->relative_bias);
        printf("relative bias, 95 %% bound: %.6g\n", stats->relative_bias_bound);
        printf("relative noise of passes: %.6g\n", stats->relative_noise);
    }
    if (stats->replicates == 0)
        return;
    printf("relative error: %.6g\n", stats->relative_error);
    printf("relative error, 95 %% bound: %.6g\n", stats->relative_error_bound);
    printf("independent sequences: %u\n", (unsigned)stats->replicates);
    printf("95 %% interval of a pixel: +- %.4g sqrt(variance)\n", stats->interval_factor);
}

void stats_print(const rt_scene *scene, const rt_device *device, const rt_render_options *options,
                 const rt_film *film, const crew *crew, const command_line *arguments)
{
    rt_device_info info;
    rt_film_stats stats;
    uint32_t width, height;
    rt_device_get_info(device, &info);
    rt_film_get_stats(film, &stats);
    rt_film_get_size(film, &width, &height);

    printf("device: %s, %s\n", info.name, info.platform);
    print_scene(scene);
    printf("light power: %.6g W\n", stats.light_power);
    printf("mode: %s\n", rt_mode_name(options->mode));
    printf("size: %u x %u pixels\n", (unsigned)width, (unsigned)height);
    print_count("samples a pixel", stats.spp);
    print_count("samples rejected", stats.rejected);
    print_cut_off(&stats, options->mode);
    print_error(&stats);
    print_seconds("build time", stats.build_seconds);
    print_seconds("compile time", stats.compile_seconds);
    if (options->mode == RT_MODE_PHOTON) {
        print_photons(&stats);
        print_ledger(film, ledger_print);
    } else {
        print_seconds("render time", stats.render_seconds);
    }
    if (stats.render_seconds > 0.0)
        printf("speed: %.3f Msamples/s\n",
               1e-6 * stats.spp * width * height / stats.render_seconds);
    rays_print(arguments, crew->renderers, crew->count);
    timing_print(arguments);
}

/* ---- For programs ------------------------------------------------------------- */

static void put_count(const char *name, uint64_t count)
{
    printf(",\"%s\":%" PRIu64, name, count);
}

static void put_scene(const rt_scene *scene)
{
    rt_scene_info info;
    rt_scene_get_info(scene, &info);
    put_count("shapes", info.shapes);
    put_count("primitives", info.primitives);
    put_count("triangles", info.triangles);
    put_count("materials", info.materials);
    put_count("lights", info.lights);
}

static void put_film(const rt_film_stats *stats)
{
    put_count("spp", stats->spp);
    put_count("rejected", stats->rejected);
    put_count("replicates", stats->replicates);
    if (stats->replicates > 0) {
        json_member("relative_error", stats->relative_error);
        json_member("relative_error_bound", stats->relative_error_bound);
        json_member("interval_factor", stats->interval_factor);
    }
    json_member("light_power", stats->light_power);
    json_member("cut_off_throughput", stats->cut_off_throughput);
    json_member("cut_off_in_block", stats->cut_off_in_block);
    json_member("cut_off_flux", stats->cut_off_flux);
    json_member("build_seconds", stats->build_seconds);
    json_member("compile_seconds", stats->compile_seconds);
}

static void put_photons(const rt_film_stats *stats)
{
    put_count("photons_emitted", stats->photons_emitted);
    put_count("photons_stored", stats->photons_stored);
    put_count("photons_rejected", stats->photons_rejected);
    if (stats->paths_seen > 0) {
        json_member("paths_seen", stats->paths_seen);
        json_member("paths_seen_by_importance", stats->paths_seen_by_importance);
    }
    put_count("gathers", stats->gathers);
    put_count("gathers_at_ends", stats->gathers_at_ends);
    put_count("gathers_empty", stats->gathers_empty);
    put_count("passes", stats->passes);
    if (stats->passes > 0) {
        json_member("relative_bias", stats->relative_bias);
        json_member("relative_bias_bound", stats->relative_bias_bound);
        json_member("relative_noise", stats->relative_noise);
    }
    json_member("emit_seconds", stats->emit_seconds);
    json_member("gather_seconds", stats->gather_seconds);
}

void stats_print_json(const rt_scene *scene, const rt_device *device,
                      const rt_render_options *options, const rt_film *film, const crew *crew,
                      const command_line *arguments)
{
    rt_device_info info;
    rt_film_stats stats;
    uint32_t width, height;
    rt_device_get_info(device, &info);
    rt_film_get_stats(film, &stats);
    rt_film_get_size(film, &width, &height);

    fputs("{\"device\":", stdout);
    json_string(info.name);
    fputs(",\"platform\":", stdout);
    json_string(info.platform);
    put_scene(scene);
    fputs(",\"mode\":", stdout);
    json_string(rt_mode_name(options->mode));
    put_count("width", width);
    put_count("height", height);
    put_film(&stats);
    if (options->mode == RT_MODE_PHOTON) {
        put_photons(&stats);
        print_ledger(film, ledger_print_json);
    } else {
        json_member("render_seconds", stats.render_seconds);
    }
    rays_print_json(arguments, crew->renderers, crew->count);
    timing_print_json(arguments);
    puts("}");
}
