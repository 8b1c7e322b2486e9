/* settings.c - the options that are settings of a render. */
#include "settings.h"

#include <stdio.h>
#include <string.h>

#include "message.h"
#include "status.h"

/* ---- Names ------------------------------------------------------------------ */

const rt_setting *settings_find(const char *name, size_t length)
{
    char text[SETTING_NAME_SIZE];
    if (length >= sizeof text || memchr(name, '_', length))
        return NULL;
    memcpy(text, name, length);
    text[length] = '\0';
    return rt_setting_find(text);
}

int settings_is_switch(const rt_setting *setting)
{
    return setting->field.type == RT_FIELD_BOOLEAN;
}

int settings_finds_photons(const rt_setting *setting)
{
    static const char *const names[] = {"k",        "radius",        "caustic_k", "caustic_radius",
                                        "volume_k", "volume_radius", NULL};
    for (const char *const *name = names; *name; name++)
        if (strcmp(*name, setting->field.name) == 0)
            return 1;
    return 0;
}

/* Whether the camera paths of a pixel, which are those of mode path, depend on a setting. */
static int decides_paths(const rt_setting *setting)
{
    static const char *const others[] = {"techniques", "contribution", "time", "target_error"};
    if (setting->topic == RT_TOPIC_PHOTON || setting->topic == RT_TOPIC_LAYER)
        return 0;
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (strcmp(setting->field.name, others[i]) == 0)
            return 0;
    return 1;
}

int settings_is_taken(const rt_setting *setting, command_id command)
{
    return command == COMMAND_RENDER || command == COMMAND_STUDY ||
           (command == COMMAND_PATHS && decides_paths(setting)) ||
           (command == COMMAND_PHOTONS &&
            ((setting->flags & RT_SETTING_EMITS) || settings_finds_photons(setting)));
}

const char *settings_name(char out[SETTING_NAME_SIZE], const rt_setting *setting)
{
    snprintf(out, SETTING_NAME_SIZE, "%s", setting->field.name);
    for (char *c = out; *c; c++)
        *c = *c == '_' ? '-' : *c;
    return out;
}

const char *settings_value_name(const rt_setting *setting)
{
    if (settings_is_switch(setting))
        return NULL;
    return setting->field.type == RT_FIELD_CHOICE   ? "NAME"
           : setting->field.type == RT_FIELD_NUMBER ? "X"
                                                    : "N";
}

option_group settings_group(const rt_setting *setting)
{
    switch (setting->topic) {
    case RT_TOPIC_RENDER:
    case RT_TOPIC_FILM:
        break;
    case RT_TOPIC_PHOTON:
        return GROUP_PHOTON;
    case RT_TOPIC_LAYER:
        return GROUP_OUTPUT;
    }
    return GROUP_RENDER;
}

/* ---- Values ----------------------------------------------------------------- */

/* What is noted of a setting. */
static const char **place_of(const command_line *arguments, const rt_setting *setting)
{
    return &arguments->settings[setting - rt_settings(NULL)];
}

int settings_read(command_line *out, const rt_setting *setting, const char *text)
{
    rt_render_options unused = {0};
    rt_nearest search;
    char name[SETTING_NAME_SIZE], phrase[256];
    *place_of(out, setting) = text;
    if (rt_setting_set(&unused, setting, text, NULL) == RT_OK)
        return STATUS_DONE;
    message_error("--%s takes %s; not '%s'", settings_name(name, setting),
                  rt_setting_phrase(phrase, sizeof phrase, setting), text);
    rt_nearest_begin(&search, text, strlen(text));
    rt_nearest_offer_words(&search, rt_field_words(&setting->field));
    if (search.best)
        message_hint("did you mean %s?", search.best);
    return STATUS_USAGE;
}

const char *settings_text(const command_line *arguments, const rt_setting *setting)
{
    return *place_of(arguments, setting);
}

int settings_is_requested(const command_line *arguments, const rt_setting *setting)
{
    const char *text = settings_text(arguments, setting);
    return text && !(settings_is_switch(setting) && strcmp(text, "false") == 0);
}

void settings_apply(const command_line *arguments, rt_render_options *options,
                    const rt_setting *except)
{
    size_t count;
    const rt_setting *settings = rt_settings(&count);
    for (size_t i = 0; i < count; i++)
        if (arguments->settings[i] && &settings[i] != except)
            rt_setting_set(options, &settings[i], arguments->settings[i], NULL);
}
