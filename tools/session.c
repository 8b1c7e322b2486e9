/* session.c - what the commands that render or emit share. */
#define _XOPEN_SOURCE 700 /* readlink */

#include "session.h"

#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "interrupt.h"
#include "message.h"
#include "preview/preview.h"
#include "settings.h"
#include "status.h"
#include "watch.h"

static double clock_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

double session_seconds(const session *s)
{
    return s->began > 0 ? clock_now() - s->began : 0;
}

static int follows_light(rt_stage stage)
{
    return stage == RT_STAGE_EMIT || stage == RT_STAGE_GATHER || stage == RT_STAGE_RENDER;
}

static int on_progress(void *user, const rt_progress *report)
{
    session *s = user;
    int stop = interrupt_pending() || (s->watch && watch_has_changed(s->watch));
    if (s->began == 0 && follows_light(report->stage))
        s->began = clock_now() - report->elapsed;
    preview_progress(s->preview, report);
    if (!stop)
        progress_show(&s->progress, report);
    return stop;
}

static void on_log(void *user, const char *line)
{
    session *s = user;
    progress_clear(&s->progress);
    message_note("%s", line);
}

static void on_warning(void *user, const char *line)
{
    session *s = user;
    progress_clear(&s->progress);
    message_warning("%s", line);
}

void session_begin(session *s, const command_line *arguments)
{
    const option_value *style = &arguments->options[OPTION_PROGRESS];
    s->arguments = arguments;
    s->quiet = arguments->options[OPTION_QUIET].given;
    s->progress = progress_begin(style->given ? (progress_style)style->choice
                                 : s->quiet   ? PROGRESS_NONE
                                              : PROGRESS_AUTO);
    s->hooks.progress = on_progress;
    s->hooks.log = arguments->options[OPTION_VERBOSE].given ? on_log : NULL;
    s->hooks.warning = s->quiet ? NULL : on_warning;
    s->hooks.user = s;
    if (s->progress.style == PROGRESS_JSON)
        message_as_json(1);
    if (arguments->options[OPTION_UNTRUSTED].given)
        interrupt_block();
    else
        session_catch(s);
}

void session_catch(const session *s)
{
    interrupt_catch(s->progress.style == PROGRESS_JSON, s->quiet);
}

const option_value *session_value(const session *s, option_id id)
{
    return &s->arguments->options[id];
}

void session_merge_options(const session *s, rt_render_options *options)
{
    options->hooks = &s->hooks;
    settings_apply(s->arguments, options, NULL);
}

/* The name of a field as an option has it. */
static void option_name(char *out, size_t size, const char *field)
{
    snprintf(out, size, "%s", field);
    for (char *c = out; *c; c++)
        if (*c == '_')
            *c = '-';
}

/* Whether the setting of this name is given. */
static int is_typed(const session *s, const char *name)
{
    const rt_setting *setting = rt_setting_find(name);
    return setting && settings_text(s->arguments, setting);
}

/* The setting without which the others would go with the scene's own, or NULL. */
static const rt_setting *setting_at_fault(const session *s, const rt_render_options *own)
{
    size_t count;
    const rt_setting *settings = rt_settings(&count);
    for (size_t i = 0; i < count; i++) {
        rt_render_options options = *own;
        settings_apply(s->arguments, &options, &settings[i]);
        if (settings_text(s->arguments, &settings[i]) &&
            rt_render_options_check(&options, NULL) == RT_OK)
            return &settings[i];
    }
    return NULL;
}

int session_check_options(const session *s, const rt_render_options *own,
                          const rt_render_options *options)
{
    char name[SETTING_NAME_SIZE];
    rt_error error;
    if (rt_render_options_check(options, &error) == RT_OK)
        return STATUS_DONE;
    const rt_setting *typed =
        rt_setting_find(error.field) && !is_typed(s, error.field) ? setting_at_fault(s, own) : NULL;
    if (!typed)
        return session_fail(&error);
    message_error("--%s does not go with the scene's %s: %s", settings_name(name, typed),
                  error.field, error.message);
    if (strcmp(error.field, "variance") == 0)
        message_hint("--no-variance leaves it out");
    return STATUS_USAGE;
}

int session_fail(const rt_error *error)
{
    if (error->status != RT_ERROR_USAGE || !error->field[0] || error->line)
        return message_failure(error);
    char name[sizeof error->field];
    option_name(name, sizeof name, error->field);
    message_error("--%s: %s", name, error->message);
    if (strcmp(name, "k") == 0 && strstr(error->message, "give the radius"))
        message_hint("--radius R gives it, in metres");
    return STATUS_USAGE;
}

int session_was_interrupted(rt_status result)
{
    return result == RT_CANCELLED || (result == RT_ERROR_DEVICE && interrupt_pending());
}

/* rtc itself, which has the command `kernels`; NULL where it may start no process. */
static const char *own_program(const session *s)
{
    static const char path[] = "/proc/self/exe";
    char link[4096];
    const ssize_t length = readlink(path, link, sizeof link - 1);
    if (length < 0 || session_value(s, OPTION_UNTRUSTED)->given)
        return NULL;
    link[length] = '\0';
    const char *slash = strrchr(link, '/');
    return slash && strcmp(slash + 1, "rtc") == 0 ? path : NULL;
}

int session_open_device(const session *s, rt_device **out, const char *select)
{
    rt_device_options options = {0};
    rt_error error;
    options.select = select;
    options.threads = (uint32_t)session_value(s, OPTION_THREADS)->count;
    options.work_group = (uint32_t)session_value(s, OPTION_WORK_GROUP)->count;
    options.memory = s->arguments->memory;
    options.compiler = own_program(s);
    options.profile = s->arguments->profile;
    options.count_rays = session_value(s, OPTION_COUNT_RAYS)->given;
    interrupt_defer();
    rt_profile_begin(options.profile, "open device");
    const rt_status opened = rt_device_open(out, &options, &error);
    rt_profile_end(options.profile);
    if (opened != RT_OK)
        return session_fail(&error);
    if (session_value(s, OPTION_VERBOSE)->given) {
        rt_device_info info;
        rt_device_get_info(*out, &info);
        message_note("device %s, %s, %u compute unit%s", info.name, info.platform,
                     (unsigned)info.compute_units, info.compute_units == 1 ? "" : "s");
    }
    return STATUS_DONE;
}
