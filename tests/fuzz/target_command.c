/*
 * target_command.c - the command line of rtc: an argument a line. What asks for a device, or names
 * a file outside of the current directory, is parsed and not run.
 */
#define _GNU_SOURCE 1 /* stdout and stderr can be set */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "fuzz/targets.h"
#include "tools/command_line.h"
#include "tools/commands.h"
#include "tools/help.h"
#include "tools/light_shares.h"
#include "tools/message.h"
#include "tools/photons.h"
#include "tools/settings.h"
#include "tools/status.h"

enum { arguments_max = 64, triangles_max = 1000 };

/* ---- The command --------------------------------------------------------------------------- */

static int is_given(const command_line *line, option_id id)
{
    return line->options[id].given;
}

/* What a render does with its options before it opens the device. */
static int set_options(const command_line *line)
{
    rt_render_options options = {0};
    rt_scene *scene = NULL;
    rt_error error;
    float *shares = NULL;
    size_t count = 0;
    int status = light_shares_read(&shares, &count, line);
    FUZZ_EXPECT(rt_scene_load(&scene, "s.rts", NULL, &error) == RT_OK);
    rt_scene_get_options(scene, &options);
    settings_apply(line, &options, NULL);
    options.light_shares = shares;
    options.light_share_count = count;
    if (status == STATUS_DONE && rt_scene_set_options(scene, &options, &error) != RT_OK)
        status = message_failure(&error);
    rt_scene_destroy(scene);
    free(shares);
    return status;
}

/* Whether a command keeps to small files of the current directory. */
static int is_harmless(const command_line *line)
{
    for (size_t i = 0; i < line->operand_count; i++)
        if (strchr(line->operands[i], '/') || strcmp(line->operands[i], "-") == 0)
            return 0;
    for (size_t i = 0; i < line->output_count; i++)
        if (strchr(line->outputs[i], '/'))
            return 0;
    return line->command != COMMAND_MESH ||
           (is_given(line, OPTION_TRIANGLES) &&
            line->options[OPTION_TRIANGLES].count <= triangles_max);
}

static int run_command(const command_line *line)
{
    if (is_given(line, OPTION_HELP)) {
        help_print(line);
        return STATUS_DONE;
    }
    if (line->command == COMMAND_RENDER ||
        (line->command == COMMAND_PHOTONS && !photons_find_form(line)))
        return set_options(line);
    if (!is_harmless(line))
        return STATUS_DONE;
    return line->command == COMMAND_CHECK     ? command_check(line)
           : line->command == COMMAND_MESH    ? command_mesh(line)
           : line->command == COMMAND_PHOTONS ? command_photons(line)
           : line->command == COMMAND_COMPARE ? command_compare(line)
                                              : STATUS_DONE;
}

/* ---- The files of the current directory ---------------------------------------------------- */

static void begin(void)
{
    static const char scene[] = "camera { eye 0 1 -4 look_at 0 1 0 }\nmaterial m { kd 0.7 }\n"
                                "sphere { centre 0 1 0 radius 1 material m }\n"
                                "light point { position 2 4 -3 intensity 20 }\n"
                                "light point { position 2 4 3 power 1 }\n",
                      wrong[] = "material m { kd 2 }\nsphere { radius }\n";
    fuzz_write("s.rts", scene, sizeof scene - 1);
    fuzz_write("w.rts", wrong, sizeof wrong - 1);
    fuzz_write_seed(&fuzz_target_exr, 0, "a.exr");
    fuzz_write_seed(&fuzz_target_exr, 2, "b.exr");
    fuzz_write_seed(&fuzz_target_png, 10, "c.png");
    fuzz_write_seed(&fuzz_target_map, 1, "m.rtp");
    fuzz_write_seed(&fuzz_target_map, 2, "n.rtp");
}

/* Takes away what the command has written, which may have been a file of begin. */
static void clean(const command_line *line)
{
    static const char *const made[] = {"s.rts", "w.rts", "a.exr", "b.exr",
                                       "c.png", "m.rtp", "n.rtp"};
    int is_lost = 0;
    for (size_t i = 0; i < line->output_count; i++) {
        if (!strchr(line->outputs[i], '/'))
            unlink(line->outputs[i]);
        for (size_t j = 0; j < sizeof made / sizeof *made; j++)
            is_lost |= strcmp(line->outputs[i], made[j]) == 0;
    }
    if (is_lost)
        begin();
    if (line->command == COMMAND_MESH && line->operand_count) {
        char name[512];
        snprintf(name, sizeof name, "%.500s.ply", line->operands[0]);
        if (!strchr(name, '/'))
            unlink(name);
    }
}

/* ---- What is said -------------------------------------------------------------------------- */

/* Neither control characters that drive a terminal, nor an error without words. */
static void check_messages(const char *said, size_t size, int status)
{
    for (size_t i = 0; i < size; i++)
        FUZZ_EXPECT(((unsigned char)said[i] >= 0x20 && said[i] != 0x7f) || said[i] == '\n' ||
                    said[i] == '\t');
    FUZZ_EXPECT(status == STATUS_DONE || status == STATUS_INPUT || status == STATUS_USAGE ||
                status == STATUS_OUTPUT);
    FUZZ_EXPECT(status == STATUS_DONE || status == STATUS_INPUT || strstr(said, "error"));
}

/* Writes of a stream: its text, which has a closing zero. */
static ssize_t on_write(void *said, const char *data, size_t size)
{
    rt_bytes *text = said;
    fuzz_put(text, data, size);
    fuzz_put(text, "", 1);
    text->size--;
    return (ssize_t)size;
}

/* A stream into a text; open_memstream would not bear setvbuf. */
static FILE *open_text(rt_bytes *said)
{
    const cookie_io_functions_t functions = {.write = on_write};
    fuzz_put(said, "", 1);
    said->size = 0;
    FILE *file = fopencookie(said, "w", functions);
    FUZZ_EXPECT(file != NULL);
    return file;
}

static int run_line(int argc, char **argv)
{
    FILE *const real[2] = {stdout, stderr};
    rt_bytes said[2] = {{0}, {0}};
    command_line line;
    stdout = open_text(&said[0]);
    stderr = open_text(&said[1]);
    int status = arguments_parse(&line, argc, argv), is_good = status == STATUS_DONE;
    if (is_good) {
        status = run_command(&line);
        clean(&line);
    }
    arguments_free(&line);
    fclose(stdout);
    fclose(stderr);
    stdout = real[0];
    stderr = real[1];
    check_messages((const char *)said[1].data, said[1].size, status);
    rt_bytes_free(&said[0]);
    rt_bytes_free(&said[1]);
    return is_good;
}

static int run(const uint8_t *data, size_t size)
{
    static char name[] = "rtc";
    char *argv[arguments_max + 1] = {name}, *text = malloc(size + 1);
    int argc = 1;
    FUZZ_EXPECT(text != NULL);
    memcpy(text, data, size);
    text[size] = '\0';
    for (char *at = text; at && argc < arguments_max;) {
        char *end = strchr(at, '\n');
        if (end)
            *end = '\0';
        argv[argc++] = at;
        at = end && end[1] ? end + 1 : NULL;
    }
    int is_good = run_line(argc, argv);
    free(text);
    return is_good;
}

/* ---- Seeds --------------------------------------------------------------------------------- */

static void seed(fuzz_inputs *seeds)
{
    fuzz_add_text(seeds, "s.rts\n--spp\n16\n--mode=photon\n--k\n50\n--no-roulette");
    fuzz_add_text(seeds, "s.rts\n--light-shares\n1,2\n--photons\n1e6\n--out\na.png\n--aov");
    fuzz_add_text(seeds, "check\ns.rts\nw.rts\n--json");
    fuzz_add_text(seeds, "compare\na.exr\nb.exr\n--max-rmse\n0.1\n--blocks\n--out\nd.png");
    fuzz_add_text(seeds, "compare\nc.png\nc.png\n--json\n--block\n2\n--tolerance\n.1");
    fuzz_add_text(seeds, "photons\ninfo\nm.rtp\nn.rtp");
    fuzz_add_text(seeds, "photons\ndiff\nm.rtp\nn.rtp\n--json");
    fuzz_add_text(seeds, "photons\nmerge\nm.rtp\n--out\no.rtp");
    fuzz_add_text(seeds, "photons\nexport\nn.rtp\n--out\no.ply");
    fuzz_add_text(seeds, "mesh\nsphere\n--triangles\n100\n--out\no.ply");
    fuzz_add_text(seeds, "help\nphotons\ninfo");
}

static void add_option(fuzz_inputs *words, const char *before, const char *name)
{
    char text[SETTING_NAME_SIZE + 8];
    snprintf(text, sizeof text, "%s%s", before, name);
    fuzz_add_text(words, text);
}

static void words(fuzz_inputs *out)
{
    static const char *const others[] = {
        "help",   "render", "info",  "merge", "diff",  "export", "s.rts", "w.rts", "a.exr",
        "b.exr",  "c.png",  "m.rtp", "n.rtp", "o.ply", "o.rtp",  "o.png", "1e6",   "-1",
        "sphere", "torus",  "knot",  "--",    "\n",    "all",    "0.5",   NULL};
    char name[SETTING_NAME_SIZE];
    size_t count;
    const rt_setting *settings = rt_settings(&count);
    for (size_t i = 0; others[i]; i++)
        fuzz_add_text(out, others[i]);
    for (int i = COMMAND_RENDER + 1; i < COMMAND_COUNT; i++)
        fuzz_add_text(out, command_name((command_id)i));
    for (int i = 0; i < OPTION_COUNT; i++) {
        add_option(out, "\n--", option_table[i].name);
        for (const rt_word *word = option_table[i].words; word && word->name; word++)
            fuzz_add_text(out, word->name);
    }
    for (size_t i = 0; i < count; i++) {
        const rt_word *word = rt_field_words(&settings[i].field);
        add_option(out, settings_is_switch(&settings[i]) ? "\n--no-" : "\n--",
                   settings_name(name, &settings[i]));
        for (; word && word->name; word++)
            fuzz_add_text(out, word->name);
    }
}

const fuzz_target fuzz_target_command = {
    .name = "command",
    .sources = "tools/command_line.c tools/options.c tools/settings.c tools/number.c "
               "tools/message.c tools/help.c tools/check.c tools/compare* tools/photons.c "
               "tools/photons_info.c tools/photons_json.c tools/mesh* tools/light_shares.c "
               "tools/inputs.c tools/json.c tools/scene_file.c",
    .run = run,
    .seed = seed,
    .words = words,
    .begin = begin,
    .size_max = 512,
    .tries = 3000,
};
