/* lines.c - commands, options and values, for the scripts of all shells. */
#include "lines.h"

#include <stdio.h>
#include <string.h>

#include "../command_line.h"
#include "../help.h"

#define IMAGES "exr pfm png ppm"
/* With dots, which suffixes_of leaves out. */
#define IMAGES_READ RT_IMAGE_FORMATS(RT_IMAGE_EXTENSION)

static const rt_word mesh_kinds[] = {
    {"sphere", 0, ""}, {"torus", 0, ""}, {"knot", 0, ""}, {"terrain", 0, ""}, RT_WORD_END};

static const rt_word previews[] = {{"page", 0, ""}, {"open", 0, ""}, {"tev", 0, ""}, RT_WORD_END};

/* What the operands of a command are, where not any file. */
static const struct {
    int is_known;
    line_value value;
} operands[COMMAND_COUNT] = {
    [COMMAND_RENDER] = {1, {NULL, "rts"}},
    [COMMAND_CHECK] = {1, {NULL, "rts"}},
    [COMMAND_MESH] = {1, {mesh_kinds, NULL}},
    [COMMAND_DEVICES] = {1, {NULL, NULL}},
    [COMMAND_DOCTOR] = {1, {NULL, NULL}},
    [COMMAND_KERNELS] = {1, {NULL, NULL}},
    [COMMAND_IMPORT] = {1, {NULL, "glb gltf obj pbrt xml"}},
    [COMMAND_PATHS] = {1, {NULL, "rts"}},
    [COMMAND_FMT] = {1, {NULL, "rts"}},
    [COMMAND_STUDY] = {1, {NULL, "rts"}},
    [COMMAND_PHOTONS] = {1, {NULL, "rts"}},
    [COMMAND_COMPARE] = {1, {NULL, IMAGES_READ}},
    [COMMAND_MERGE] = {1, {NULL, "rtpart"}},
    [COMMAND_INFO] = {1, {NULL, "rtpart rtp"}},
};

/* The files that an option takes in a command, where not any will do. */
static const struct {
    option_id option;
    unsigned commands;
    const char *files;
} files[] = {
    {OPTION_OUT, 1u << COMMAND_RENDER | 1u << COMMAND_MERGE, IMAGES " rtpart"},
    {OPTION_OUT, 1u << COMMAND_COMPARE, IMAGES},
    {OPTION_OUT, 1u << COMMAND_PHOTONS, "rtp"},
    {OPTION_OUT, 1u << COMMAND_STUDY, "html"},
    {OPTION_IMPORT_OUT, 1u << COMMAND_IMPORT, "rts"},
    {OPTION_OUT, 1u << COMMAND_PATHS, "json ply html"},
    {OPTION_MESH_OUT, 1u << COMMAND_MESH, "ply"},
    {OPTION_PHOTON_MAP, ~0u, "rtp"},
    {OPTION_CHECKPOINT, 1u << COMMAND_RENDER, "rtpart"},
    {OPTION_CHECKPOINT, 1u << COMMAND_PHOTONS, "rtp"},
    {OPTION_RESUME, 1u << COMMAND_RENDER, "rtpart"},
    {OPTION_RESUME, 1u << COMMAND_PHOTONS, "rtp"},
    {OPTION_REFERENCE, ~0u, IMAGES_READ},
    {OPTION_LIST, ~0u, "studies"},
    {OPTION_PROFILE, ~0u, "json"},
};

/* The first clause of a text, cut between words where it is long. */
static void shorten(char *out, size_t size, const char *text)
{
    size_t length = strcspn(text, ";:"), cut = 0;
    const char *stop = strstr(text, ". ");
    if (stop && (size_t)(stop - text) < length)
        length = (size_t)(stop - text);
    if (length >= size)
        for (cut = length = size - 4; length > 0 && text[length] != ' ';)
            length--;
    while (length > 0 && (text[length - 1] == ' ' || text[length - 1] == ','))
        length--;
    snprintf(out, size, "%.*s%s", (int)length, text, cut ? "..." : "");
}

/* The first sentence of a help, which stands after its usage. */
static void summarise(char *out, size_t size, const char *usage)
{
    char text[256] = "";
    const char *start = strstr(usage, "\n\n");
    snprintf(text, sizeof text, "%s", start ? start + 2 : "");
    for (char *c = text; *c; c++)
        *c = *c == '\n' ? ' ' : *c;
    shorten(out, size, text);
}

size_t line_command_count(void)
{
    size_t forms;
    photons_forms(&forms);
    return COMMAND_COUNT + forms;
}

/* Suffixes without dots; those of images stay until the program ends. */
static const char *suffixes_of(const char *files)
{
    static char images[128];
    size_t used = 0;
    if (!files || !strchr(files, '.'))
        return files;
    for (const char *c = files + strspn(files, " "); *c && used + 1 < sizeof images; c++)
        if (*c != '.')
            images[used++] = *c;
    images[used] = '\0';
    return images;
}

line_command line_command_at(size_t i)
{
    const int is_form = i >= COMMAND_COUNT;
    const command_id id = is_form ? COMMAND_PHOTONS : (command_id)i;
    const photons_form *form = is_form ? photons_forms(NULL) + (i - COMMAND_COUNT) : NULL;
    line_command command = {.first = command_name(id),
                            .second = form ? form->word : "",
                            .command = id,
                            .form = form,
                            .operands = {NULL, form ? "rtp" : ""}};
    if (!form && operands[i].is_known) {
        command.operands = operands[i].value;
        command.operands.files = suffixes_of(command.operands.files);
    }
    summarise(command.help, sizeof command.help, form ? form->usage : help_usage(id));
    return command;
}

static line_value value_of(const option *option, const line_command *of)
{
    const line_value words = {option->words, NULL}, any = {NULL, ""}, points = {NULL, "ply"};
    if (option == &option_table[OPTION_OUT] && of->form && strcmp(of->form->word, "export") == 0)
        return points;
    if (option == &option_table[OPTION_PREVIEW])
        return (line_value){previews, NULL};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++)
        if (option == &option_table[files[i].option] && files[i].commands & (1u << of->command))
            return (line_value){NULL, suffixes_of(files[i].files)};
    return option->value && strcmp(option->value, "FILE") == 0 ? any : words;
}

static line_option describe_option(option_id id, const line_command *of)
{
    const option *option = &option_table[id];
    line_option described = {.value_name = option->value, .value = value_of(option, of)};
    snprintf(described.name, sizeof described.name, "%s", option->name);
    shorten(described.help, sizeof described.help, help_of(option, of->command, of->form));
    described.is_repeated = id == OPTION_OUT || id == OPTION_SET || id == OPTION_SWEEP;
    return described;
}

static line_option describe_setting(const rt_setting *setting, int is_off)
{
    char name[SETTING_NAME_SIZE], help[SETTING_HELP_SIZE];
    line_option described = {
        .value_name = settings_value_name(setting),
        .value = {settings_is_switch(setting) ? NULL : setting->field.words, NULL}};
    snprintf(described.name, sizeof described.name, "%s%s", is_off ? "no-" : "",
             settings_name(name, setting));
    shorten(described.help, sizeof described.help,
            is_off ? "do not"
                   : rt_setting_text(help, sizeof help, setting->field.help, RT_NAME_OPTION));
    return described;
}

static void add(line_option *out, size_t capacity, size_t *count, line_option described)
{
    if (*count < capacity)
        out[*count] = described;
    ++*count;
}

size_t line_options(line_option *out, size_t capacity, const line_command *command)
{
    size_t count = 0, setting_count;
    const rt_setting *settings = rt_settings(&setting_count);
    for (size_t i = 0; i < setting_count; i++) {
        if (command->command == COMMAND_PHOTONS
                ? !photons_form_takes_setting(command->form, &settings[i])
                : !settings_is_taken(&settings[i], command->command))
            continue;
        add(out, capacity, &count, describe_setting(&settings[i], 0));
        if (settings_is_switch(&settings[i]))
            add(out, capacity, &count, describe_setting(&settings[i], 1));
    }
    for (int i = 0; i < OPTION_COUNT; i++)
        if (option_table[i].commands & (1u << command->command) &&
            (!command->form || photons_form_takes(command->form, (option_id)i)))
            add(out, capacity, &count, describe_option((option_id)i, command));
    return count;
}
