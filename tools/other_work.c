/* other_work.c - keeps the films of other renders. */
#include "other_work.h"

#include <stdio.h>

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

/* Looks at one output. */
static int check(const char *path, rt_renderer *renderer, const rt_render_options *options,
                 const command_line *arguments)
{
    const option_value *resume = &arguments->options[OPTION_RESUME];
    char why[sizeof(rt_error)];
    rt_film *film = NULL;
    if (!outputs_is_film(path) || (resume->given && inputs_are_same(path, resume->text)) ||
        rt_film_load(&film, path, arguments->memory, NULL) != RT_OK)
        return STATUS_DONE;
    compare(why, sizeof why, film, renderer, options);
    rt_film_destroy(film);
    if (!why[0])
        return STATUS_DONE;
    message_error("--out %s: the film that is there is of other work: %s", path, why);
    message_hint("remove it, or give another name");
    return STATUS_USAGE;
}

int other_work_check(const output_list *outputs, rt_renderer *renderer,
                     const rt_render_options *options, const command_line *arguments)
{
    int status = STATUS_DONE;
    for (size_t i = 0; i < outputs->count && status == STATUS_DONE; i++)
        status = check(outputs->paths[i], renderer, options, arguments);
    return status;
}
