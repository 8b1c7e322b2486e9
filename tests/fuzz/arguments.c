/* arguments.c - writes arguments of rtc. */
#include "fuzz/arguments.h"

#include <stdio.h>
#include <string.h>

#include "tools/command_line.h"
#include "tools/settings.h"

const char *const fuzz_command_files[] = {
    "s.rts", "w.rts", "p.rts", "a.exr", "b.exr",    "c.png",    "m.rtp",     "n.rtp",
    "k.rtp", "z.rtp", "l.exr", "e.rts", "f.rtpart", "g.rtpart", "l.studies", NULL};

/* Names of outputs, forms and kinds, and values of options that take any text. */
static const char *const others[] = {"help",
                                     "render",
                                     "info",
                                     "merge",
                                     "diff",
                                     "export",
                                     "sphere",
                                     "torus",
                                     "knot",
                                     "o.ply",
                                     "o.rtp",
                                     "o.png",
                                     "o.exr",
                                     "terrain",
                                     "1/4",
                                     "2/2",
                                     "1,2",
                                     "0,1",
                                     "all",
                                     "none.x",
                                     "albedo",
                                     "--",
                                     "-h",
                                     "\303\244\033[1m",
                                     "\"\\",
                                     "size=1",
                                     "k=2,5",
                                     "kernel=all",
                                     "scene=s.rts,p.rts",
                                     "auto",
                                     "o.html",
                                     NULL};

static const char *const numbers[] = {"0",    "1",    "2",  "16",        "-1",  "0.5",
                                      "1e6",  "1e9",  "4G", "100k",      "nan", "inf",
                                      "1e99", "0x10", "",   "4294967296"};

static size_t count_words(const char *const *words)
{
    size_t count = 0;
    while (words[count])
        count++;
    return count;
}

static const char *choose(const char *const *words, size_t count, fuzz_random *random)
{
    return words[fuzz_random_below(random, (uint32_t)count)];
}

static const char *any_file(fuzz_random *random)
{
    return choose(fuzz_command_files, count_words(fuzz_command_files), random);
}

static const char *any_number(fuzz_random *random)
{
    return choose(numbers, sizeof numbers / sizeof *numbers, random);
}

/* A word of a list, or another one. */
static const char *any_word(const rt_word *words, fuzz_random *random)
{
    size_t count = 0;
    while (words[count].name)
        count++;
    size_t i = fuzz_random_below(random, (uint32_t)count + 1);
    return i < count ? words[i].name : "unknown";
}

static const char *any_text(fuzz_random *random)
{
    return fuzz_random_below(random, 2) ? any_file(random)
                                        : choose(others, count_words(others), random);
}

/* ---- Options ------------------------------------------------------------------------------- */

size_t fuzz_option_count(void)
{
    size_t settings;
    rt_settings(&settings);
    return OPTION_COUNT + settings;
}

static const char *value_of(const option *option, fuzz_random *random)
{
    switch (option->kind) {
    case KIND_FLAG:
        return fuzz_random_below(random, 8) ? NULL : "1";
    case KIND_CHOICE:
        return any_word(option->words, random);
    case KIND_WHOLE:
    case KIND_REAL:
    case KIND_SIZE:
        return any_number(random);
    case KIND_TEXT:
        break;
    }
    return any_text(random);
}

static void put(rt_bytes *out, const char *before, const char *name, const char *value,
                fuzz_random *random)
{
    fuzz_put_text(out, before);
    fuzz_put_text(out, name);
    if (value) {
        fuzz_put_text(out, fuzz_random_below(random, 4) ? "\n" : "=");
        fuzz_put_text(out, value);
    }
    fuzz_put_text(out, "\n");
}

void fuzz_option(rt_bytes *out, size_t number, fuzz_random *random)
{
    char name[SETTING_NAME_SIZE];
    if (number < OPTION_COUNT) {
        put(out, "--", option_table[number].name, value_of(&option_table[number], random), random);
        return;
    }
    const rt_setting *setting = rt_settings(NULL) + (number - OPTION_COUNT);
    const rt_word *words = rt_field_words(&setting->field);
    settings_name(name, setting);
    if (settings_is_switch(setting))
        put(out, fuzz_random_below(random, 2) ? "--no-" : "--", name, NULL, random);
    else
        put(out, "--", name, words ? any_word(words, random) : any_number(random), random);
}

void fuzz_any_argument(rt_bytes *out, fuzz_random *random)
{
    uint32_t command = COMMAND_RENDER + 1 + fuzz_random_below(random, COMMAND_COUNT - 1);
    switch (fuzz_random_below(random, 4)) {
    case 0:
        fuzz_put_text(out, any_text(random));
        break;
    case 1:
        fuzz_put_text(out, command_name((command_id)command));
        break;
    default:
        fuzz_option(out, fuzz_random_below(random, (uint32_t)fuzz_option_count()), random);
        return;
    }
    fuzz_put_text(out, "\n");
}

/* ---- Words --------------------------------------------------------------------------------- */

void fuzz_argument_words(fuzz_inputs *words)
{
    fuzz_random random = fuzz_random_begin(3);
    for (size_t i = 0; fuzz_command_files[i]; i++)
        fuzz_add_text(words, fuzz_command_files[i]);
    for (size_t i = 0; others[i]; i++)
        fuzz_add_text(words, others[i]);
    for (int i = COMMAND_RENDER + 1; i < COMMAND_COUNT; i++)
        fuzz_add_text(words, command_name((command_id)i));
    for (size_t i = 0; i < fuzz_option_count(); i++)
        for (int times = 0; times < 3; times++) {
            rt_bytes text = {0};
            fuzz_option(&text, i, &random);
            fuzz_add(words, text.data, text.size);
            rt_bytes_free(&text);
        }
}
