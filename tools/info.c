/* info.c - `rtc info`: what a film file holds, and how far it is. */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "commands.h"
#include "film_note.h"
#include "json.h"
#include "message.h"
#include "outputs.h"
#include "photons.h"
#include "progress.h"
#include "scene_file.h"
#include "status.h"

/* Whether a render was to go on until --time or --target-error ended it. */
static int is_without_end(const rt_film *film)
{
    rt_render_options options;
    rt_film_get_options(film, &options);
    return options.spp >= rt_setting_find("spp")->field.range.high;
}

/* Seconds that the rest will take on machines like those so far; negative: not known. */
static double rest_of(const rt_film *film, const rt_film_info *info)
{
    return info->done >= 1        ? 0
           : is_without_end(film) ? -1
           : info->done > 0       ? info->seconds * (1 - info->done) / info->done
                                  : -1;
}

/* "... of parts 1 to 7: 3 (37.5 % done), 5": the parts that are not complete. */
static void print_parts(const rt_film *film, uint32_t parts)
{
    int is_first = 1;
    printf("missing, whole or in part, of parts 1 to %" PRIu32 ": ", parts);
    for (uint32_t part = 1; part <= parts; part++) {
        const double done = rt_film_part_done(film, part, parts);
        if (done >= 1)
            continue;
        printf("%s%" PRIu32, is_first ? "" : ", ", part);
        if (done > 0)
            printf(" (%.3g %% done)", 100 * done);
        is_first = 0;
    }
    puts(is_first ? "none" : "");
}

static void print_settings(const rt_film *film)
{
    size_t count;
    rt_render_options options;
    const rt_setting *settings = rt_settings(&count);
    rt_film_get_options(film, &options);
    for (size_t i = 0; i < count; i++) {
        char value[64];
        printf("%s: %s\n", settings[i].field.name,
               rt_setting_get(value, sizeof value, &settings[i], &options));
    }
}

/* The scene that a film was begun with, as messages name it. Returns out. */
static const char *scene_name(char *out, size_t size, const rt_film *film, const char *unknown)
{
    const char *scene = unknown;
    const size_t length = film_note_find(&scene, film, "scene");
    snprintf(out, size, "%.*s", length > 0 ? (int)length : (int)strlen(scene), scene);
    return strcmp(out, "-") == 0 ? strcpy(out, scene_file_name("-")) : out;
}

static void print_info(const char *path, const rt_film *film)
{
    char seconds[32];
    rt_film_info info;
    rt_film_get_info(film, &info);
    char name[4096];
    message_put_name("film: ", path, "\n");
    message_put_name("scene: ", scene_name(name, sizeof name, film, "unknown"), "\n");
    if (is_without_end(film))
        printf("done: %.4g samples a pixel, of as many as --time or --target-error let it have\n",
               info.done * info.samples);
    else
        printf("done: %.4g %%\n", 100 * info.done);
    progress_format_time(seconds, sizeof seconds, info.seconds);
    printf("time spent: %s\n", seconds);
    if (info.done < 1 && rest_of(film, &info) >= 0) {
        progress_format_time(seconds, sizeof seconds, rest_of(film, &info));
        printf("time to come: about %s\n", seconds);
    }
    if (info.parts > 1) {
        printf("part: %" PRIu32 " of %" PRIu32 "\n", info.part, info.parts);
        print_parts(film, info.parts);
    }
    printf("fingerprint of scene and camera: %016" PRIx64 "\n", info.scene);
    print_settings(film);
}

static void print_json(const char *path, const rt_film *film)
{
    char name[4096];
    size_t count;
    rt_film_info info;
    rt_render_options options;
    const rt_setting *settings = rt_settings(&count);
    rt_film_get_info(film, &info);
    rt_film_get_options(film, &options);
    printf("{\"film\":");
    json_string(path);
    printf(",\"scene\":");
    json_string(scene_name(name, sizeof name, film, ""));
    json_member("done", is_without_end(film) ? NAN : info.done);
    json_member("samples_done", info.done * info.samples);
    json_member("seconds", info.seconds);
    json_member("rest_seconds", rest_of(film, &info));
    printf(",\"part\":%" PRIu32 ",\"parts\":%" PRIu32 ",\"units\":%" PRIu64
           ",\"units_done\":%" PRIu64 ",\"fingerprint\":\"%016" PRIx64 "\",\"settings\":{",
           info.part, info.parts, info.units, info.units_done, info.scene);
    for (size_t i = 0; i < count; i++) {
        char value[64];
        printf("%s\"%s\":", i > 0 ? "," : "", settings[i].field.name);
        json_string(rt_setting_get(value, sizeof value, &settings[i], &options));
    }
    printf("}}\n");
}

/* Of a film, or of a photon map. */
static int show(const char *path, const command_line *arguments)
{
    const int json = arguments->options[OPTION_JSON].given;
    rt_film *film = NULL;
    rt_photon_map *map = NULL;
    rt_error error;
    if (strcmp(outputs_extension(path), ".rtp") == 0) {
        int status = photons_load(&map, path, arguments);
        if (status == STATUS_DONE)
            status =
                json ? photons_print_info_json(path, map, NULL) : photons_print_info(path, map);
        rt_photon_map_destroy(map);
        return status;
    }
    if (rt_film_load(&film, path, arguments->memory, &error) != RT_OK) {
        const int status = message_failure(&error);
        if (!outputs_is_film(path))
            message_hint("`rtc info` reads films (.rtpart) and photon maps (.rtp)");
        return status;
    }
    if (json)
        print_json(path, film);
    else
        print_info(path, film);
    rt_film_destroy(film);
    return STATUS_DONE;
}

int command_info(const command_line *arguments)
{
    int status = STATUS_DONE;
    if (arguments->operand_count == 0) {
        message_error("usage: rtc info FILE...");
        return STATUS_USAGE;
    }
    for (size_t i = 0; i < arguments->operand_count; i++) {
        if (i > 0 && !arguments->options[OPTION_JSON].given)
            printf("\n");
        int now = show(arguments->operands[i], arguments);
        status = status == STATUS_DONE ? now : status;
    }
    return status;
}
