/* recorded.c - the command line as it is recorded in an image. */
#include "recorded.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "settings.h"

/* Each writes ` --NAME VALUE` at out, as far as size goes, and returns its length. */

static size_t write_setting(char *out, size_t size, const rt_setting *setting, const char *text)
{
    char name[SETTING_NAME_SIZE];
    settings_name(name, setting);
    if (settings_is_switch(setting))
        return (size_t)snprintf(out, size, " --%s%s", strcmp(text, "false") == 0 ? "no-" : "",
                                name);
    return (size_t)snprintf(out, size, " --%s %s", name, text);
}

static size_t write_option(char *out, size_t size, const option *option, const char *text)
{
    return (size_t)snprintf(out, size, option->value ? " --%s %s" : " --%s", option->name, text);
}

/* Writes the whole line. */
static size_t write_line(char *out, size_t size, const command_line *arguments, const char *scene)
{
    size_t count, used = (size_t)snprintf(out, size, "rtc %s", scene);
    const rt_setting *settings = rt_settings(&count);
    for (size_t i = 0; i < count; i++) {
        const char *text = settings_text(arguments, &settings[i]);
        if (text && !(settings[i].flags & RT_SETTING_ADDS))
            used +=
                write_setting(out ? out + used : NULL, out ? size - used : 0, &settings[i], text);
    }
    for (size_t i = 0; i < arguments->definition_count; i++)
        used += (size_t)snprintf(out ? out + used : NULL, out ? size - used : 0, " --set '%s=%s'",
                                 arguments->definitions[i].name, arguments->definitions[i].value);
    for (int i = 0; i < OPTION_COUNT; i++)
        if (option_table[i].decides_pixels && arguments->options[i].given)
            used += write_option(out ? out + used : NULL, out ? size - used : 0, &option_table[i],
                                 arguments->options[i].text);
    return used;
}

char *recorded_command(const command_line *arguments, const char *scene)
{
    size_t size = write_line(NULL, 0, arguments, scene) + 1;
    char *line = malloc(size);
    if (line)
        write_line(line, size, arguments, scene);
    return line;
}
