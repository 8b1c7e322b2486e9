/* denoise.c - finds Open Image Denoise, and writes what it makes of a film. */
#include "denoise.h"

#include <glob.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "message.h"
#include "status.h"

const char denoiser_remedy[] =
    "`pip install pyoidn` brings it, and so does a download from www.openimagedenoise.org; where "
    "it "
    "is not found, --denoiser FILE or RTC_DENOISER=FILE names its libOpenImageDenoise.so";

/* ---- Where the library is -------------------------------------------------------------------- */

/* The first file that a pattern below a folder has. */
static int find_in(char path[DENOISER_PATH], const char *folder, const char *pattern)
{
    char whole[DENOISER_PATH];
    glob_t found;
    int is_found = 0;
    snprintf(whole, sizeof whole, "%s/%s", folder, pattern);
    if (glob(whole, 0, NULL, &found) != 0)
        return 0;
    for (size_t i = 0; i < found.gl_pathc && !is_found; i++)
        if (strlen(found.gl_pathv[i]) < DENOISER_PATH) {
            strcpy(path, found.gl_pathv[i]);
            is_found = 1;
        }
    globfree(&found);
    return is_found;
}

/* The library of a Python package, below a prefix. */
static int find_package(char path[DENOISER_PATH], const char *prefix)
{
    static const char *const patterns[] = {
        "lib/python3*/*-packages/pyoidn/oidn/lib/libOpenImageDenoise.so.[0-9]",
        "lib/python3*/*-packages/oidn/lib.linux.x64/libOpenImageDenoise.so.*",
    };
    for (size_t i = 0; i < sizeof patterns / sizeof *patterns; i++)
        if (prefix && prefix[0] && find_in(path, prefix, patterns[i]))
            return 1;
    return 0;
}

const char *denoiser_find(char path[DENOISER_PATH], const command_line *arguments)
{
    const option_value *given = &arguments->options[OPTION_DENOISER];
    const char *named = given->given ? given->text : getenv("RTC_DENOISER");
    const char *home = getenv("HOME");
    char version[16], local[DENOISER_PATH];
    /* The loader looks for a name without a slash in the system's folders alone. */
    if (named && named[0] && !strchr(named, '/') && access(named, F_OK) == 0 &&
        snprintf(path, DENOISER_PATH, "./%s", named) < DENOISER_PATH)
        return path;
    if (named && named[0])
        return named;
    if (rt_denoiser_check(version, NULL, NULL) == RT_OK)
        return NULL;
    snprintf(local, sizeof local, "%s/.local", home ? home : "");
    if (find_package(path, getenv("VIRTUAL_ENV")) || find_package(path, home ? local : NULL) ||
        find_package(path, "/usr/local") || find_package(path, "/usr"))
        return path;
    return NULL;
}

/* ---- A film ---------------------------------------------------------------------------------- */

static int is_wanted(const session *session)
{
    return session_value(session, OPTION_DENOISE)->given;
}

int denoise_check(const session *session, const rt_render_options *options)
{
    char path[DENOISER_PATH], version[16];
    rt_denoise_options library = {0};
    rt_error error;
    if (!is_wanted(session))
        return STATUS_DONE;
    if (session_value(session, OPTION_UNTRUSTED)->given) {
        message_error("--denoise does not go with --untrusted, which loads no other library");
        return STATUS_USAGE;
    }
    if (options->parts > 1) {
        message_error("--denoise does not go with --part: noise is told from light in a whole "
                      "picture");
        return STATUS_USAGE;
    }
    if (rt_denoise_options_check(options, &error) != RT_OK)
        return session_fail(&error);
    library.library = denoiser_find(path, session->arguments);
    if (rt_denoiser_check(version, &library, &error) == RT_OK)
        return STATUS_DONE;
    message_error("%s", error.message);
    message_hint("%s", denoiser_remedy);
    return message_status(error.status);
}

int denoise_film(const session *session, rt_film *film, rt_renderer *renderer)
{
    char path[DENOISER_PATH];
    rt_denoise_options options = {.hooks = &session->hooks};
    rt_error error;
    if (!is_wanted(session))
        return STATUS_DONE;
    options.library = denoiser_find(path, session->arguments);
    return rt_film_denoise(film, renderer, &options, &error) == RT_OK ? STATUS_DONE
                                                                      : message_failure(&error);
}

/* "a.png" -> "a.denoised.png". */
static void path_beside(char out[OUTPUT_PATH], const char *path)
{
    const char *extension = outputs_extension(path);
    const int stem = (int)(strlen(path) - strlen(extension));
    snprintf(out, OUTPUT_PATH, "%.*s.denoised%s", stem, path, extension);
}

int denoise_write(const session *session, const rt_film *film, const output_list *outputs,
                  const rt_image_options *options)
{
    char path[OUTPUT_PATH];
    uint32_t width, height;
    rt_image *image = NULL;
    rt_error error;
    const float *rgb = rt_film_layer(film, "denoised", NULL);
    int status = STATUS_DONE;
    if (!is_wanted(session) || !rgb)
        return STATUS_DONE;
    rt_film_get_size(film, &width, &height);
    if (rt_image_from_rgb(&image, rgb, width, height, &error) != RT_OK)
        return message_failure(&error);
    for (size_t i = 0; i < outputs->count; i++) {
        const char *beside = outputs->paths[i];
        if (outputs_is_film(beside) || strcmp(outputs_extension(beside), ".exr") == 0)
            continue;
        path_beside(path, beside);
        if (rt_image_write(image, path, options, &error) != RT_OK)
            status = message_failure(&error);
        else if (!session->quiet)
            message_note("wrote %s", path);
    }
    rt_image_destroy(image);
    return status;
}
