/* scene_file.c - loads a scene file and prints what is wrong with it. */
#include "scene_file.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "folder.h"
#include "interrupt.h"
#include "message.h"
#include "recorded.h"
#include "status.h"
#include "untrusted.h"

/* Longest scene that is read from stdin. */
#define STDIN_LIMIT ((size_t)64 << 20)
#define STDIN_CHUNK ((size_t)1 << 16)

/* Errors of a scene that are printed; further ones mostly follow from these. */
enum { ERRORS_SHOWN = 20 };

/* What memory is taken for. */
static const char text_of_scene[] = "the text of the scene";

typedef struct scene_reading {
    scene_findings findings;
    scene_purpose purpose;
    input_list *inputs;
    progress_display *progress;
    scene_text *text; /* receives the scene as it was understood, or NULL */
} scene_reading;

static int is_wanted(const rt_diagnostic *diagnostic, scene_purpose purpose)
{
    if (diagnostic->severity == RT_SEVERITY_ERROR || purpose == SCENE_TO_CHECK)
        return 1;
    /* How near an import comes is a note; others are for those who check. */
    return purpose != SCENE_QUIETLY && purpose != SCENE_TO_CHECK_QUIETLY &&
           (diagnostic->severity == RT_SEVERITY_WARNING ||
            diagnostic->finding == RT_FINDING_NONE) &&
           diagnostic->finding != RT_FINDING_NO_LIGHT &&
           diagnostic->finding != RT_FINDING_NO_CAMERA; /* an error where one is needed */
}

static void on_diagnostic(void *user, const rt_diagnostic *diagnostic)
{
    scene_reading *reading = user;
    reading->findings.errors += diagnostic->severity == RT_SEVERITY_ERROR;
    reading->findings.warnings += diagnostic->severity == RT_SEVERITY_WARNING;
    if (reading->findings.errors > ERRORS_SHOWN && diagnostic->severity == RT_SEVERITY_ERROR)
        return;
    if (!is_wanted(diagnostic, reading->purpose))
        return;
    progress_clear(reading->progress);
    message_diagnostic(diagnostic);
}

static int on_progress(void *user, const rt_progress *report)
{
    scene_reading *reading = user;
    progress_show(reading->progress, report);
    return interrupt_is_ending();
}

/*
 * rt_scene_load, but that a signal ends the program once the folder is removed in which a scene of
 * another program was taken apart.
 */
static rt_status load_file(rt_scene **out, const char *path, const rt_load_options *options,
                           rt_error *error)
{
    if (!rt_path_is_foreign(path))
        return rt_scene_load(out, path, options, error);
    interrupt_hold();
    const rt_status status = rt_scene_load(out, path, options, error);
    interrupt_release();
    return status;
}

static void on_file(void *user, const char *path)
{
    scene_reading *reading = user;
    if (reading->inputs)
        inputs_add(reading->inputs, path);
}

static void on_block(void *user, const char *text)
{
    scene_text *out = ((scene_reading *)user)->text;
    const size_t length = strlen(text);
    if (out->size + length + 1 > out->capacity) {
        size_t grown = 2 * (out->size + length + 1);
        /* It is laid out anew at the end. */
        if (out->error.status == RT_OK)
            rt_memory_take(out->memory, 2 * (grown - out->capacity), text_of_scene, &out->error);
        char *moved = out->error.status == RT_OK ? realloc(out->text, grown) : NULL;
        if (!moved && out->error.status == RT_OK) {
            out->error.status = RT_ERROR_MEMORY;
            snprintf(out->error.message, sizeof out->error.message, "out of memory");
        }
        if (!moved)
            return;
        out->text = moved;
        out->capacity = grown;
    }
    memcpy(out->text + out->size, text, length + 1);
    out->size += length;
}

const char *scene_file_name(const char *path)
{
    return strcmp(path, "-") == 0 ? "stdin" : path;
}

/* All of stdin as a string that the caller frees, or NULL after saying why not. */
static char *read_stdin(int *status)
{
    char *text = NULL;
    size_t used = 0, got = 0;
    do {
        char *grown = used < STDIN_LIMIT ? realloc(text, used + STDIN_CHUNK + 1) : NULL;
        if (!grown) {
            message_error("stdin: %s",
                          used < STDIN_LIMIT ? "out of memory" : "a scene of more than 64 MiB");
            *status = used < STDIN_LIMIT ? STATUS_DEVICE : STATUS_INPUT;
            free(text);
            return NULL;
        }
        text = grown;
        got = fread(text + used, 1, STDIN_CHUNK, stdin);
        used += got;
    } while (got == STDIN_CHUNK);
    text[used] = '\0';
    if (!ferror(stdin) && strlen(text) == used)
        return text;
    message_error("stdin: %s",
                  ferror(stdin) ? strerror(errno) : "not a text: it holds a zero byte");
    *status = STATUS_INPUT;
    free(text);
    return NULL;
}

static int parse_stdin(rt_scene **out, const rt_load_options *options, rt_status *result,
                       rt_error *error)
{
    int status = STATUS_DONE;
    char *text = read_stdin(&status);
    if (!text)
        return status;
    const size_t size = strlen(text);
    *result = rt_memory_take(options->memory, size, text_of_scene, error);
    if (*result == RT_OK) {
        *result = rt_scene_parse(out, text, scene_file_name("-"), options, error);
        rt_memory_give(options->memory, size, text_of_scene);
    }
    free(text);
    return STATUS_DONE;
}

int scene_file_fail_foreign(const char *path, int is_import)
{
    enum { NOBODY, RENDER };
    static const struct {
        int taken_by;
        const char *extensions, *is, *before, *after;
    } kinds[] = {
        {NOBODY, " .blend .fbx .dae .usd .usda .usdc .usdz .3ds .max .c4d .skp ",
         "a scene of another program", "export it as glTF (",
         " as NAME.glb): `rtc NAME.glb` renders that"},
        {NOBODY, RT_IMAGE_FORMATS(RT_IMAGE_EXTENSION) " ", "a picture", "`rtc compare ",
         " B` compares it with another; a scene has it as texture NAME { file \"...\" }"},
        {NOBODY, " .rtpart ", "a film", "`rtc --resume ", "` goes on with it"},
        {NOBODY, " .rtp ", "a photon map", "`rtc SCENE --photon-map ", "` renders with it"},
        {RENDER, " .rts ", "a scene of rtc", "`rtc ", "` renders it"}};
    const char *dot = strrchr(path, '.');
    char extension[16], word[RECORDED_WORD_SIZE];
    snprintf(extension, sizeof extension, " %s ", dot ? dot : "/");
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        if ((is_import || kinds[i].taken_by != RENDER) && strstr(kinds[i].extensions, extension)) {
            message_error("%s is %s, not a scene (%s.xml .pbrt .gltf .glb .obj .ply .stl .off)",
                          path, kinds[i].is, is_import ? "that is imported: " : ".rts ");
            message_hint("%s%s%s", kinds[i].before,
                         kinds[i].before[0] == '`' ? recorded_word(word, path) : path,
                         kinds[i].after);
            return 1;
        }
    return 0;
}

/* Says what went wrong that no diagnostic has told. */
static int finish(const char *path, const scene_reading *reading, rt_status result,
                  const rt_error *error)
{
    progress_clear(reading->progress);
    if (result == RT_OK)
        return STATUS_DONE;
    if (reading->findings.errors == 0)
        return message_failure(error);
    if (reading->findings.errors > ERRORS_SHOWN)
        message_note("%s: and %u more errors", scene_file_name(path),
                     reading->findings.errors - ERRORS_SHOWN);
    else if (reading->findings.errors > 1)
        message_note("%s: %u errors", scene_file_name(path), reading->findings.errors);
    return message_status(result);
}

/* What is asked of the library; user: the reading. */
static rt_load_options options_of(scene_reading *reading, const rt_hooks *hooks, const char *root,
                                  const command_line *arguments)
{
    return (rt_load_options){.diagnostic = on_diagnostic,
                             .user = reading,
                             .file = on_file,
                             .block = reading->text ? on_block : NULL,
                             .hooks = hooks,
                             .root = root,
                             /* OpenVDB trusts what it reads. */
                             .vdb_module = arguments->options[OPTION_UNTRUSTED].given ? "" : NULL,
                             .memory = arguments->memory,
                             .profile = arguments->profile,
                             .definition_name = "--set",
                             .definitions = arguments->definitions,
                             .definition_count = arguments->definition_count,
                             .camera = arguments->options[OPTION_CAMERA].text,
                             .is_strict = arguments->options[OPTION_STRICT].given,
                             .check = reading->purpose == SCENE_TO_CHECK ||
                                      reading->purpose == SCENE_TO_CHECK_QUIETLY ||
                                      reading->purpose == SCENE_TO_RENDER};
}

static int load(rt_scene **out, const char *path, scene_reading *reading,
                const command_line *arguments)
{
    static const option_id of_foreign[] = {OPTION_CAMERA, OPTION_STRICT};
    const int is_foreign = rt_path_is_foreign(path);
    char *root = NULL;
    for (size_t i = 0; !is_foreign && i < sizeof of_foreign / sizeof *of_foreign; i++)
        if (arguments->options[of_foreign[i]].given) {
            message_error("--%s is of scenes of other programs, which %s is not",
                          option_table[of_foreign[i]].name, scene_file_name(path));
            return STATUS_USAGE;
        }
    if (scene_file_fail_foreign(path, 0))
        return STATUS_INPUT;
    if (is_foreign && arguments->options[OPTION_UNTRUSTED].given && !untrusted_scratch()) {
        char word[RECORDED_WORD_SIZE];
        message_error("%s: with --untrusted, a scene of another program takes a folder to write in",
                      path);
        message_hint("`rtc import %s --untrusted --out NAME.rts`", recorded_word(word, path));
        return STATUS_USAGE;
    }
    /* What comes from stdin has no folder. */
    if (arguments->options[OPTION_UNTRUSTED].given &&
        !(root = folder_of(strcmp(path, "-") == 0 ? "/dev/null/" : path)))
        return STATUS_DEVICE;
    const rt_hooks hooks = {.progress = on_progress, .user = reading};
    rt_load_options options = options_of(reading, &hooks, root, arguments);
    const char *const set = getenv("TMPDIR");
    options.scratch = untrusted_scratch() ? untrusted_scratch() : set && *set ? set : NULL;
    rt_error error;
    rt_status result = RT_OK;
    int status = STATUS_DONE;
    if (strcmp(path, "-") == 0)
        status = parse_stdin(out, &options, &result, &error);
    else
        result = load_file(out, path, &options, &error);
    free(root);
    return status == STATUS_DONE ? finish(path, reading, result, &error) : status;
}

int scene_file_import(rt_scene **out, const char *path, const char *to, const char *root,
                      const command_line *arguments)
{
    progress_display progress = progress_begin_on_terminal(0);
    scene_reading reading = {.purpose = arguments->options[OPTION_QUIET].given ? SCENE_QUIETLY
                                                                               : SCENE_TO_RENDER,
                             .progress = &progress};
    rt_error error;
    const rt_load_options options = options_of(&reading, NULL, root, arguments);
    return finish(path, &reading, rt_scene_import(out, to, path, &options, &error), &error);
}

int scene_file_load(rt_scene **out, const char *path, scene_purpose purpose,
                    scene_findings *findings, input_list *inputs, progress_display *progress,
                    const command_line *arguments)
{
    scene_reading reading = {{0, 0}, purpose, inputs, progress, NULL};
    int status = load(out, path, &reading, arguments);
    if (findings)
        *findings = reading.findings;
    return status;
}

/* Of a scene of another program, who writes the files that it was taken apart into. */
static void say_files(const char *path, const char *text)
{
    char folder[300], to[300], words[2][RECORDED_WORD_SIZE];
    const char *const slash = strrchr(path, '/'), *const name = slash ? slash + 1 : path;
    const int stem = (int)(strrchr(name, '.') - name);
    snprintf(folder, sizeof folder, "\"%.*s_files/", stem, name);
    snprintf(to, sizeof to, "%.*s.rts", stem, name);
    if (strstr(text, folder))
        printf("# The files in %.*s_files are written by `rtc import %s --out %s`.\n\n", stem, name,
               recorded_word(words[0], path), recorded_word(words[1], to));
}

int scene_file_dump(const char *path, const command_line *arguments)
{
    scene_text text = {.memory = arguments->memory};
    progress_display progress = progress_begin_on_terminal(0);
    scene_reading reading = {{0, 0}, SCENE_TO_EMIT, NULL, &progress, &text};
    rt_scene *scene = NULL;
    rt_error error;
    char *made = NULL;
    int status = load(&scene, path, &reading, arguments);
    if (status == STATUS_DONE && text.error.status != RT_OK)
        status = message_failure(&text.error);
    if (status == STATUS_DONE && rt_scene_format(&made, text.text, path, NULL, &error) != RT_OK)
        status = message_failure(&error);
    if (status == STATUS_DONE && rt_path_is_foreign(path))
        say_files(path, made);
    if (status == STATUS_DONE)
        fputs(made, stdout);
    rt_memory_give(text.memory, 2 * text.capacity, text_of_scene);
    free(made);
    free(text.text);
    rt_scene_destroy(scene);
    return status;
}
