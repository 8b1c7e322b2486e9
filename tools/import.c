/* import.c - `rtc import`: scenes of other programs, written in the scene language. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "commands.h"
#include "folder.h"
#include "message.h"
#include "outputs.h"
#include "recorded.h"
#include "scene_file.h"
#include "status.h"
#include "untrusted.h"
#include "rt.h"

/* "room.rts: 3 shapes, 1 triangle, 2 materials, 1 light" */
static void print_counts(const char *path, const rt_scene_info *info)
{
    const struct {
        const char *noun;
        uint64_t count;
    } counts[] = {{"shape", info->shapes},
                  {"triangle", info->triangles},
                  {"material", info->materials},
                  {"light", info->lights}};
    message_put_name("", path, ":");
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++)
        printf("%s %llu %s%s", i ? "," : "", (unsigned long long)counts[i].count, counts[i].noun,
               counts[i].count == 1 ? "" : "s");
    putchar('\n');
}

static int import_scene(const char *path, const char *out, const char *root,
                        const command_line *arguments)
{
    rt_scene *scene;
    const int status = scene_file_import(&scene, path, out, root, arguments);
    if (status == STATUS_DONE) {
        rt_scene_info info;
        rt_scene_get_info(scene, &info);
        if (!arguments->options[OPTION_QUIET].given)
            print_counts(out, &info);
        rt_scene_destroy(scene);
    }
    return status;
}

static int is_scene_name(const char *path)
{
    return strcmp(outputs_extension(path), ".rts") == 0;
}

/* Names the scene after the file, in this folder. */
static void hint_out(const char *path)
{
    const char *const slash = strrchr(path, '/'), *const name = slash ? slash + 1 : path;
    const int length = (int)(strlen(name) - strlen(outputs_extension(name)));
    char word[RECORDED_WORD_SIZE], out[RECORDED_WORD_SIZE], out_word[RECORDED_WORD_SIZE];
    snprintf(out, sizeof out, "%.*s.rts", length, name);
    message_hint("`rtc import %s --out %s`, with its meshes and images in %.*s_files",
                 recorded_word(word, path), recorded_word(out_word, out), length, name);
}

static int check_arguments(const command_line *arguments)
{
    const option_value *out = &arguments->options[OPTION_IMPORT_OUT];
    const size_t count = arguments->operand_count;
    char words[2][RECORDED_WORD_SIZE];
    if (count > 0 && scene_file_fail_foreign(arguments->operands[0], 1))
        return STATUS_INPUT;
    if (count != 1 || !out->given) {
        message_error("usage: rtc import FILE --out SCENE.rts");
        if (count == 2 && !out->given && is_scene_name(arguments->operands[1]))
            message_hint("`rtc import %s --out %s`",
                         recorded_word(words[0], arguments->operands[0]),
                         recorded_word(words[1], arguments->operands[1]));
        else if (count == 1)
            hint_out(arguments->operands[0]);
        return STATUS_USAGE;
    }
    const int is_scene = is_scene_name(out->text);
    if (!is_scene || strpbrk(out->text, "\"\n\r")) {
        message_error("--out %s: %s", out->text,
                      is_scene ? "a scene cannot name files by a path with quotes or line ends"
                               : "a scene is written as .rts");
        return STATUS_USAGE;
    }
    return outputs_check_writable(out->text);
}

int command_import(const command_line *arguments)
{
    const char *out = arguments->options[OPTION_IMPORT_OUT].text;
    char *root = NULL;
    int status = check_arguments(arguments);
    if (status != STATUS_DONE)
        return status;
    const char *path = arguments->operands[0];
    if (arguments->options[OPTION_UNTRUSTED].given) {
        const untrusted_needs needs = {
            .scene = path, .outputs = &out, .output_count = 1, .reads_outputs = 1};
        if (!(root = folder_of(path)))
            return STATUS_DEVICE;
        status = untrusted_confine(&needs);
    }
    if (status == STATUS_DONE)
        status = import_scene(path, out, root, arguments);
    free(root);
    return status;
}
