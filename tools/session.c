#include "session.h"

#include <stdio.h>
#include <string.h>

#include "interrupt.h"
#include "message.h"
#include "rtc.h"

static int on_progress(void *user, const rt_progress *report)
{
    session *s = user;
    int stop = interrupt_pending();
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
        message_as_json();
    interrupt_catch(s->progress.style == PROGRESS_JSON);
}

const option_value *session_value(const session *s, option_id id)
{
    return &s->arguments->options[id];
}

static void set_u32(uint32_t *out, const option_value *value)
{
    if (value->given)
        *out = (uint32_t)value->count;
}

static void set_u64(uint64_t *out, const option_value *value)
{
    if (value->given)
        *out = value->count;
}

static void set_float(float *out, const option_value *value)
{
    if (value->given)
        *out = (float)value->real;
}

static void set_double(double *out, const option_value *value)
{
    if (value->given)
        *out = value->real;
}

static void set_switch(int *out, const option_value *value)
{
    if (value->given)
        *out = value->choice;
}

/* The choice of an option, or what it is so far. */
static int choice_or(const session *s, option_id id, int so_far)
{
    return session_value(s, id)->given ? session_value(s, id)->choice : so_far;
}

/* What is rendered, and for how long. */
static void merge_picture(const session *s, rt_render_options *options)
{
    set_u32(&options->width, session_value(s, OPTION_WIDTH));
    set_u32(&options->height, session_value(s, OPTION_HEIGHT));
    set_u32(&options->spp, session_value(s, OPTION_SPP));
    set_u32(&options->max_depth, session_value(s, OPTION_MAX_DEPTH));
    set_u32(&options->roulette_depth, session_value(s, OPTION_ROULETTE_DEPTH));
    set_float(&options->roulette_threshold, session_value(s, OPTION_ROULETTE_THRESHOLD));
    set_u32(&options->seed, session_value(s, OPTION_SEED));
    set_double(&options->time, session_value(s, OPTION_TIME));
    set_double(&options->target_error, session_value(s, OPTION_TARGET_ERROR));
    set_switch(&options->variance, session_value(s, OPTION_VARIANCE));
    set_switch(&options->aov, session_value(s, OPTION_AOV));
    options->mode = (rt_mode)choice_or(s, OPTION_MODE, options->mode);
    options->sampler = (rt_sampler)choice_or(s, OPTION_SAMPLER, options->sampler);
    options->filter = (rt_filter)choice_or(s, OPTION_FILTER, options->filter);
    options->estimator = (rt_estimator)choice_or(s, OPTION_ESTIMATOR, options->estimator);
}

/* How photons are emitted and gathered. */
static void merge_photons(const session *s, rt_render_options *options)
{
    set_u64(&options->photons, session_value(s, OPTION_PHOTONS));
    set_u32(&options->k, session_value(s, OPTION_K));
    set_float(&options->radius, session_value(s, OPTION_RADIUS));
    set_u32(&options->passes, session_value(s, OPTION_PASSES));
    set_float(&options->alpha, session_value(s, OPTION_ALPHA));
    set_u32(&options->final_gather, session_value(s, OPTION_FINAL_GATHER));
    set_switch(&options->photon_layers, session_value(s, OPTION_PHOTON_LAYERS));
    set_float(&options->cone_k, session_value(s, OPTION_CONE_K));
    options->gather = (rt_gather)choice_or(s, OPTION_GATHER, options->gather);
    options->area = (rt_area)choice_or(s, OPTION_AREA, options->area);
    options->kernel = (rt_density)choice_or(s, OPTION_KERNEL, options->kernel);
    options->direct = (rt_direct)choice_or(s, OPTION_DIRECT, options->direct);
    set_u64(&options->caustic_photons, session_value(s, OPTION_CAUSTIC_PHOTONS));
    set_u32(&options->caustic_k, session_value(s, OPTION_CAUSTIC_K));
    set_float(&options->caustic_radius, session_value(s, OPTION_CAUSTIC_RADIUS));
    options->caustic_kernel =
        (rt_density)choice_or(s, OPTION_CAUSTIC_KERNEL, options->caustic_kernel);
}

void session_merge_options(const session *s, rt_render_options *options)
{
    options->hooks = &s->hooks;
    merge_picture(s, options);
    merge_photons(s, options);
}

/* The name of a field as an option has it. */
static void option_name(char *out, size_t size, const char *field)
{
    snprintf(out, size, "%s", field);
    for (char *c = out; *c; c++)
        if (*c == '_')
            *c = '-';
}

static int is_typed(const session *s, const char *name)
{
    for (int i = 0; i < OPTION_COUNT; i++)
        if (session_value(s, (option_id)i)->given && strcmp(option_table[i].name, name) == 0)
            return 1;
    return 0;
}

/* The option without which the others would go with the scene's own, or NULL. */
static const char *option_at_fault(const session *s, const rt_render_options *own)
{
    for (int i = 0; i < OPTION_COUNT; i++) {
        command_line others = *s->arguments;
        session trial = *s;
        rt_render_options options = *own;
        trial.arguments = &others;
        others.options[i].given = 0;
        session_merge_options(&trial, &options);
        if (session_value(s, (option_id)i)->given &&
            rt_render_options_check(&options, NULL) == RT_OK)
            return option_table[i].name;
    }
    return NULL;
}

int session_check_options(const session *s, const rt_render_options *own,
                          const rt_render_options *options)
{
    char name[sizeof((rt_error *)0)->field];
    rt_error error;
    if (rt_render_options_check(options, &error) == RT_OK)
        return STATUS_DONE;
    option_name(name, sizeof name, error.field);
    const char *typed = is_typed(s, name) ? NULL : option_at_fault(s, own);
    if (!typed)
        return session_fail(&error);
    message_error("--%s does not go with the scene's %s: %s", typed, error.field, error.message);
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
    return STATUS_USAGE;
}

int session_was_interrupted(rt_status result)
{
    return result == RT_CANCELLED || (result == RT_ERROR_DEVICE && interrupt_pending());
}

int session_open_device(const session *s, rt_device **out)
{
    rt_device_options options = {0};
    rt_error error;
    options.select = session_value(s, OPTION_DEVICE)->text;
    set_u32(&options.threads, session_value(s, OPTION_THREADS));
    set_u32(&options.work_group, session_value(s, OPTION_WORK_GROUP));
    interrupt_defer();
    if (rt_device_open(out, &options, &error) != RT_OK)
        return session_fail(&error);
    if (session_value(s, OPTION_VERBOSE)->given) {
        rt_device_info info;
        rt_device_get_info(*out, &info);
        message_note("device %s, %s, %u compute unit%s", info.name, info.platform,
                     (unsigned)info.compute_units, info.compute_units == 1 ? "" : "s");
    }
    return STATUS_DONE;
}
