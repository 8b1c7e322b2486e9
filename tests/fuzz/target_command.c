/*
 * target_command.c - the command line of rtc: an argument a line. What asks for a device, or names
 * a file outside of the current directory, is parsed and not run.
 */
#define _GNU_SOURCE 1 /* stdout and stderr can be set */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/error.h"
#include "fuzz/arguments.h"
#include "fuzz/json.h"
#include "fuzz/targets.h"
#include "tools/command_line.h"
#include "tools/commands.h"
#include "tools/help.h"
#include "tools/message.h"
#include "tools/status.h"

enum { arguments_max = 64, triangles_max = 1000 };

/* ---- The command --------------------------------------------------------------------------- */

static int is_given(const command_line *line, option_id id)
{
    return line->options[id].given;
}

/* Whether a command keeps to small files of the current directory, and asks for no device. */
static int is_harmless(const command_line *line)
{
    static const option_id files[] = {OPTION_PHOTON_MAP, OPTION_RESUME, OPTION_CHECKPOINT,
                                      OPTION_LIST, OPTION_REFERENCE};
    for (size_t i = 0; i < line->operand_count; i++)
        if (strchr(line->operands[i], '/') || strcmp(line->operands[i], "-") == 0)
            return 0;
    for (size_t i = 0; i < line->output_count; i++)
        if (strchr(line->outputs[i], '/'))
            return 0;
    for (size_t i = 0; i < sizeof files / sizeof *files; i++)
        if (is_given(line, files[i]) && strchr(line->options[files[i]].text, '/'))
            return 0;
    if (is_given(line, OPTION_PREVIEW) || is_given(line, OPTION_WATCH))
        return 0;
    if (line->command == COMMAND_MESH)
        return is_given(line, OPTION_TRIANGLES) &&
               line->options[OPTION_TRIANGLES].count <= triangles_max;
    return line->command != COMMAND_DEVICES && line->command != COMMAND_DOCTOR &&
           line->command != COMMAND_KERNELS;
}

/* Stands in for rt_device_open: a render ends where it would begin. */
rt_status __wrap_rt_device_open(rt_device **out, const rt_device_options *options, rt_error *error);
rt_status __wrap_rt_device_open(rt_device **out, const rt_device_options *options, rt_error *error)
{
    (void)out;
    (void)options;
    return rt_fail(error, RT_ERROR_DEVICE, "there is no device where commands are fuzzed");
}

static int run_command(const command_line *line)
{
    static int (*const commands[COMMAND_COUNT])(const command_line *) = {
        [COMMAND_RENDER] = command_render,   [COMMAND_CHECK] = command_check,
        [COMMAND_MESH] = command_mesh,       [COMMAND_PHOTONS] = command_photons,
        [COMMAND_COMPARE] = command_compare, [COMMAND_MERGE] = command_merge,
        [COMMAND_INFO] = command_info,       [COMMAND_KERNELS] = command_kernels,
        [COMMAND_STUDY] = command_study,     [COMMAND_PATHS] = command_paths,
    };
    message_as_json(0);
    if (is_given(line, OPTION_HELP)) {
        help_print(line);
        return STATUS_DONE;
    }
    return commands[line->command] && is_harmless(line) ? commands[line->command](line)
                                                        : STATUS_DONE;
}

/* ---- The files of the current directory ---------------------------------------------------- */

/* Many errors, and a long line of letters of two bytes. */
static void write_errors(void)
{
    rt_bytes text = {0};
    for (int i = 0; i < 40; i++)
        fuzz_put_text(&text, "sphere { radius 1 }\n");
    fuzz_put_text(&text, "camera { eye ");
    for (int i = 0; i < 80; i++)
        fuzz_put_text(&text, "\"\303\244\" ");
    fuzz_write("e.rts", text.data, text.size);
    rt_bytes_free(&text);
}

static void begin(void)
{
    static const char scene[] = "camera { eye 0 1 -4 look_at 0 1 0 }\nmaterial m { kd 0.7 }\n"
                                "sphere { centre 0 1 0 radius 1 material m }\n"
                                "light point { position 2 4 -3 intensity 20 }\n"
                                "light point { position 2 4 3 power 1 }\n",
                      wrong[] = "material m { kd 2 }\n\tsphere { radius }\nlet \303\244 = \033\n",
                      photons[] = "render { mode photon  passes 3 }\nmaterial m { kd 0.7 }\n"
                                  "plane { point 0 0 0  normal 0 1 0  material m }\n";
    static const char studies[] = "= A page\n== k The nearest\ntext\n$ s.rts --sweep k=5,50\n";
    fuzz_write("l.studies", studies, sizeof studies - 1);
    fuzz_write("s.rts", scene, sizeof scene - 1);
    fuzz_write("w.rts", wrong, sizeof wrong - 1);
    fuzz_write("p.rts", photons, sizeof photons - 1);
    fuzz_write_seed(&fuzz_target_exr, 1, "a.exr");
    fuzz_write_seed(&fuzz_target_exr, 3, "b.exr");
    fuzz_write_seed(&fuzz_target_png, 10, "c.png");
    fuzz_write_seed(&fuzz_target_map, 1, "m.rtp");
    fuzz_write_seed(&fuzz_target_map, 2, "n.rtp");
    fuzz_write_seed(&fuzz_target_map, 3, "k.rtp");
    fuzz_write_seed(&fuzz_target_map, 0, "z.rtp");
    fuzz_write_seed(&fuzz_target_exr, FUZZ_EXR_LAYERS, "l.exr");
    fuzz_write_seed(&fuzz_target_film, 0, "f.rtpart");
    fuzz_write_seed(&fuzz_target_film, 1, "g.rtpart");
    write_errors();
}

/* Takes away what the command has written, which may have been a file of begin. */
static void clean(const command_line *line)
{
    int is_lost = 0;
    for (size_t i = 0; i < line->output_count; i++) {
        if (!strchr(line->outputs[i], '/'))
            unlink(line->outputs[i]);
        for (size_t j = 0; fuzz_command_files[j]; j++)
            is_lost |= strcmp(line->outputs[i], fuzz_command_files[j]) == 0;
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
                status == STATUS_OUTPUT || status == STATUS_DEVICE);
    FUZZ_EXPECT(status == STATUS_DONE || status == STATUS_INPUT || strstr(said, "error"));
}

/* With --json results are JSON, and so are the messages of a check and with --progress json. */
static void check_json(const command_line *line, int is_good, const char *out, const char *messages)
{
    int has_json = is_good && is_given(line, OPTION_JSON) && !is_given(line, OPTION_HELP);
    int is_run = line->command != COMMAND_DEVICES && line->command != COMMAND_DOCTOR;
    if (has_json && is_run)
        FUZZ_EXPECT(fuzz_is_json_lines(out));
    if (has_json && line->command == COMMAND_CHECK && line->operand_count)
        FUZZ_EXPECT(fuzz_is_json_lines(messages));
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
    fclose(stdout);
    fclose(stderr);
    stdout = real[0];
    stderr = real[1];
    check_messages((const char *)said[1].data, said[1].size, status);
    check_json(&line, is_good, (const char *)said[0].data, (const char *)said[1].data);
    arguments_free(&line);
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

static const char *const lines[] = {
    "s.rts\n--spp\n16\n--mode=photon\n--k\n50\n--no-roulette",
    "p.rts\n--light-shares\n1,2\n--photons\n1e6\n--out\na.png\n--aov",
    "p.rts\n--photon-map\nm.rtp\n--verbose",
    "photons\np.rts\n--part\n1/4\n--out\no.rtp\n--seed\n3",
    "check\ns.rts\nw.rts\np.rts\n--json",
    "check\nw.rts",
    "check\np.rts\n--quiet",
    "compare\na.exr\nb.exr\n--max-rmse\n0.1\n--min-ssim\n1\n--blocks\n--out\no.png",
    "compare\nc.png\nc.png\n--json\n--blocks\n--block\n2\n--max-bias\n0\n--max-off\n0",
    "compare\na.exr\na.exr\nb.exr\n--layer\nalbedo\n--tolerance\n.1",
    "compare\nl.exr\nl.exr\n--json\n--max-mse\n0.1",
    "compare\nl.exr\nl.exr\n--max-rmse\n0.1\n--max-flip\n0\n--layer\nalbedo",
    "photons\ndiff\nz.rtp\nm.rtp\n--json",
    "photons\ninfo\nz.rtp\n--json",
    "check\ne.rts",
    "s.rts\n--progress\njson\n--variance\n--out\no.png\n--exposure\n1\n--max_depth\n3",
    "photons\ninfo\nm.rtp\nn.rtp",
    "photons\ninfo\nn.rtp\nm.rtp\n--json",
    "photons\ndiff\nk.rtp\nn.rtp",
    "photons\ndiff\nm.rtp\nn.rtp\n--json",
    "photons\ndiff\nn.rtp\nn.rtp\n--json",
    "photons\nmerge\nk.rtp\nn.rtp\n--out\no.rtp",
    "photons\nexport\nn.rtp\n--out\no.ply",
    "merge\nf.rtpart\ng.rtpart\n--out\no.png\n--incomplete",
    "merge\nf.rtpart\nf.rtpart\n--out\no.rtpart",
    "info\nf.rtpart\ng.rtpart\n--json",
    "info\ng.rtpart\nm.rtp",
    "study\ns.rts\n--sweep\nk=5,50\n--sweep\nkernel=all\n--reference\nauto\n--repeat\n2",
    "study\n--sweep\nscene=s.rts,p.rts\n--sweep\nlight=[1 2,3],4\n--equal\ntime",
    "study\n--list\nl.studies\n--out\no.html\n--width\n8",
    "mesh\nsphere\n--triangles\n100\n--out\no.ply",
    "mesh\ntorus\n--triangles\n30",
    "mesh\nknot\n--triangles\n1",
    "mesh\nterrain\n--triangles\n200",
    "help\nphotons\ninfo",
    "help\ncompare",
    "chekc\ns.rts\n--spp",
};

static void seed(fuzz_inputs *seeds)
{
    fuzz_random random = fuzz_random_begin(5);
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++)
        fuzz_add_text(seeds, lines[i]);
    for (size_t i = 0; i < fuzz_option_count(); i++)
        for (int command = COMMAND_RENDER; command < COMMAND_COUNT; command++) {
            rt_bytes line = {0};
            fuzz_put_text(&line, command_name((command_id)command));
            fuzz_put_text(&line, command == COMMAND_RENDER ? "s.rts\n" : "\ns.rts\n");
            fuzz_option(&line, i, &random);
            fuzz_add(seeds, line.data, line.size);
            rt_bytes_free(&line);
        }
}

/* ---- Mutation ------------------------------------------------------------------------------ */

/* Adds an argument, puts one in the place of another, or takes one away. */
static size_t mutate(uint8_t *data, size_t size, size_t room, uint32_t seed)
{
    fuzz_random random = fuzz_random_begin(seed);
    uint32_t choice = fuzz_random_below(&random, 8);
    rt_bytes argument = {0};
    if (choice < 3)
        return fuzz_mutate_bytes(data, size, room);
    size_t at = fuzz_random_below(&random, (uint32_t)size + 1);
    while (at > 0 && data[at - 1] != '\n')
        at--;
    const uint8_t *end = memchr(data + at, '\n', size - at);
    size_t length = end ? (size_t)(end - data) + 1 - at : size - at;
    if (choice < 7)
        fuzz_any_argument(&argument, &random);
    size = fuzz_splice(data, size, room, at, choice < 5 ? 0 : length, argument.data, argument.size);
    rt_bytes_free(&argument);
    return size;
}

const fuzz_target fuzz_target_command = {
    .name = "command",
    .sources = "tools/check.c tools/command_line.c tools/compare* tools/help.c tools/inputs.c "
               "tools/json.c tools/light_shares.c tools/mesh* tools/message.c tools/no_effect.c "
               "tools/number.c tools/options.c tools/outputs.c tools/photons* tools/render.c "
               "tools/scene_file.c tools/session.c tools/settings.c tools/study/command.c "
               "tools/study/study.c tools/study/sweep.c",
    .run = run,
    .seed = seed,
    .words = fuzz_argument_words,
    .begin = begin,
    .mutate = mutate,
    .size_max = 512,
    .tries = 15000,
};
