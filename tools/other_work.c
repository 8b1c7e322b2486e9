/* other_work.c - keeps the films and photon maps of other work. */
#include "other_work.h"

#include <stdio.h>
#include <sys/stat.h>

#include "inputs.h"
#include "message.h"
#include "status.h"

/* Whether a film has work of another part than that of a render. */
static int has_other_parts(const rt_film *film, const rt_render_options *options)
{
    uint64_t chunks = 0;
    if (options->parts < 2 || rt_chunk_count(&chunks, options, NULL) != RT_OK)
        return 0;
    for (uint32_t part = 1; part <= options->parts && part <= chunks; part++)
        if (part != options->part && rt_film_part_done(film, part, options->parts) > 0)
            return 1;
    return 0;
}

/* Why a film is of other work than a render, or "". */
static void compare(char *why, size_t size, const rt_film *there, rt_renderer *renderer,
                    const rt_render_options *of_render)
{
    rt_render_options options = *of_render;
    rt_film *film = NULL;
    rt_film_info info;
    rt_error error = {0};
    options.resume = NULL;
    rt_film_get_info(there, &info);
    rt_status status = rt_film_begin(&film, renderer, &options, &error);
    if (status == RT_OK)
        status = rt_film_add(film, there, &error);
    why[0] = '\0';
    if (status == RT_ERROR_USAGE)
        snprintf(why, size, "%s", error.message);
    else if (info.part != options.part || info.parts != options.parts)
        snprintf(why, size, "it is part %u of %u", (unsigned)info.part, (unsigned)info.parts);
    else if (has_other_parts(there, &options))
        snprintf(why, size, "it has other parts too");
    rt_film_destroy(film);
}

/* Tells why what is there is kept; nothing where why is "". */
static int keep(const char *path, const char *what, const char *why)
{
    if (!why[0])
        return STATUS_DONE;
    message_error("--out %s: the %s that is there is of other work: %s", path, what, why);
    message_hint("remove it, or give another name");
    return STATUS_USAGE;
}

/* Tells why a comparison failed. That it was cancelled is told by the work which follows. */
static int judge(const char *path, const char *what, rt_status compared, const rt_error *error)
{
    if (compared == RT_CANCELLED)
        return STATUS_DONE;
    if (compared != RT_OK && compared != RT_ERROR_USAGE)
        return message_failure(error);
    return keep(path, what, compared == RT_OK ? "" : error->message);
}

/* What cannot be read holds no work; but what does not fit into memory may. */
static int judge_loading(rt_status loaded, const rt_error *error)
{
    return loaded == RT_ERROR_MEMORY ? message_failure(error) : STATUS_DONE;
}

/* Whether there is a file to look at; that of --resume has been read. */
static int is_there(const char *path, const command_line *arguments)
{
    const option_value *resume = &arguments->options[OPTION_RESUME];
    struct stat info;
    return stat(path, &info) == 0 && S_ISREG(info.st_mode) &&
           !(resume->given && inputs_are_same(path, resume->text));
}

/* Looks at one output of a render, or, with a film, of what made that. */
static int check(const char *path, rt_renderer *renderer, const rt_render_options *options,
                 const rt_film *film, const command_line *arguments)
{
    char why[sizeof(rt_error)] = "";
    rt_film *there = NULL;
    rt_error error;
    if (!outputs_is_film(path) || !is_there(path, arguments))
        return STATUS_DONE;
    rt_status loaded = rt_film_load(&there, path, arguments->memory, &error);
    if (loaded != RT_OK)
        return judge_loading(loaded, &error);
    int status = STATUS_DONE;
    if (film) {
        rt_status compared = rt_film_covers(film, there, &error);
        status = judge(path, "film", compared, &error);
    } else {
        compare(why, sizeof why, there, renderer, options);
        status = keep(path, "film", why);
    }
    rt_film_destroy(there);
    return status;
}

int other_work_check(const output_list *outputs, rt_renderer *renderer,
                     const rt_render_options *options, const command_line *arguments)
{
    int status = STATUS_DONE;
    for (size_t i = 0; i < outputs->count && status == STATUS_DONE; i++)
        status = check(outputs->paths[i], renderer, options, NULL, arguments);
    return status;
}

int other_work_check_film(const output_list *outputs, const rt_film *film,
                          const command_line *arguments)
{
    int status = STATUS_DONE;
    for (size_t i = 0; i < outputs->count && status == STATUS_DONE; i++)
        status = check(outputs->paths[i], NULL, NULL, film, arguments);
    return status;
}

/* Looks at the output of an emission, or, with a map, of what made that. */
static int check_map(const char *path, rt_renderer *renderer, const rt_emit_options *options,
                     const rt_photon_map *map, const command_line *arguments)
{
    rt_photon_map *there = NULL;
    rt_error error;
    if (!is_there(path, arguments))
        return STATUS_DONE;
    rt_status status = rt_photon_map_load_in(&there, path, arguments->memory, &error);
    if (status != RT_OK)
        return judge_loading(status, &error);
    status = map ? rt_photon_map_covers(map, there, &error)
                 : rt_photon_map_emit_covers(renderer, options, there, &error);
    rt_photon_map_destroy(there);
    return judge(path, "photon map", status, &error);
}

int other_work_check_emission(const char *path, rt_renderer *renderer,
                              const rt_emit_options *options, const command_line *arguments)
{
    return check_map(path, renderer, options, NULL, arguments);
}

int other_work_check_map(const char *path, const rt_photon_map *map, const command_line *arguments)
{
    return check_map(path, NULL, NULL, map, arguments);
}
