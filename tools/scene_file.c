/* scene_file.c - loads a scene file and prints what is wrong with it. */
#include "scene_file.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "import/direct.h"
#include "message.h"
#include "recorded.h"
#include "status.h"

/* Longest scene that is read from stdin. */
#define STDIN_LIMIT ((size_t)64 << 20)
#define STDIN_CHUNK ((size_t)1 << 16)

/* Errors of a scene that are printed; further ones mostly follow from these. */
enum { ERRORS_SHOWN = 20 };

/* What memory is taken for. */
static const char text_of_scene[] = "the text of the scene";

typedef struct scene_reading {
    const char *foreign; /* the scene of another program that it was made of, or NULL */
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
    return purpose != SCENE_QUIETLY && purpose != SCENE_TO_CHECK_QUIETLY &&
           diagnostic->severity == RT_SEVERITY_WARNING &&
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
    rt_diagnostic told = *diagnostic;
    if (reading->foreign) {
        told.file = reading->foreign;
        told.line = told.column = 0;
    }
    message_diagnostic(&told);
}

static int on_progress(void *user, const rt_progress *report)
{
    scene_reading *reading = user;
    progress_show(reading->progress, report);
    return 0;
}

static void on_file(void *user, const char *path)
{
    scene_reading *reading = user;
    if (reading->inputs && !reading->foreign)
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

char *scene_file_folder(const char *path)
{
    const char *slash = strcmp(path, "-") == 0 ? NULL : strrchr(path, '/');
    size_t length = slash ? (size_t)(slash - path) + 1 : 0;
    char *folder = malloc(length + 2);
    if (!folder) {
        message_error("out of memory");
        return NULL;
    }
    memcpy(folder, path, length);
    strcpy(folder + length, ".");
    return folder;
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
        {NOBODY, " .png .exr .pfm .ppm .jpg .jpeg .hdr .tga .bmp ", "a picture", "`rtc compare ",
         " B` compares it with another; a scene has it as texture NAME { file \"...\" }"},
        {NOBODY, " .rtpart ", "a film", "`rtc --resume ", "` goes on with it"},
        {NOBODY, " .rtp ", "a photon map", "`rtc SCENE.rts --photon-map ", "` renders with it"},
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

/* Reads a scene of the language, or from text; what else is wanted stands in *reading. */
static int load(rt_scene **out, const char *path, const char *text, scene_reading *reading,
                const command_line *arguments)
{
    char *root = NULL;
    /* What comes from stdin has no folder. */
    if (arguments->options[OPTION_UNTRUSTED].given &&
        !(root = scene_file_folder(strcmp(path, "-") == 0 ? "/dev/null/" : path)))
        return STATUS_DEVICE;
    const rt_hooks hooks = {.progress = on_progress, .user = reading};
    rt_load_options options = {.diagnostic = on_diagnostic,
                               .user = reading,
                               .file = on_file,
                               .block = reading->text ? on_block : NULL,
                               .hooks = &hooks,
                               .root = root,
                               .memory = arguments->memory,
                               .profile = arguments->profile,
                               .definition_name = "--set"};
    if (!reading->foreign) { /* whose parameters the import has read */
        options.definitions = arguments->definitions;
        options.definition_count = arguments->definition_count;
    }
    options.check = reading->purpose == SCENE_TO_CHECK ||
                    reading->purpose == SCENE_TO_CHECK_QUIETLY ||
                    reading->purpose == SCENE_TO_RENDER;
    rt_error error;
    rt_status result = RT_OK;
    int status = STATUS_DONE;
    if (text)
        result = rt_scene_parse(out, text, path, &options, &error);
    else if (strcmp(path, "-") == 0)
        status = parse_stdin(out, &options, &result, &error);
    else
        result = rt_scene_load(out, path, &options, &error);
    free(root);
    progress_clear(reading->progress);
    if (status != STATUS_DONE || result == RT_OK)
        return status;
    /* What has a place was told by diagnostics. */
    if (reading->findings.errors == 0)
        return message_failure(&error);
    const char *const name = reading->foreign ? reading->foreign : scene_file_name(path);
    if (reading->findings.errors > ERRORS_SHOWN)
        message_note("%s: and %u more errors", name, reading->findings.errors - ERRORS_SHOWN);
    else if (reading->findings.errors > 1)
        message_note("%s: %u errors", name, reading->findings.errors);
    return STATUS_INPUT;
}

/* Reads a scene of another program. */
static int load_foreign(rt_scene **out, const char *path, scene_reading *reading,
                        const command_line *arguments)
{
    import_rehearsal made;
    char word[RECORDED_WORD_SIZE], name[RECORDED_WORD_SIZE], *text;
    if (arguments->options[OPTION_UNTRUSTED].given) {
        message_error("%s: with --untrusted, a scene of another program is imported first", path);
        message_hint("`rtc import %s --untrusted --out NAME.rts`", recorded_word(word, path));
        return STATUS_USAGE;
    }
    const int is_quiet =
        reading->purpose == SCENE_QUIETLY || reading->purpose == SCENE_TO_CHECK_QUIETLY;
    int status = direct_begin(&made, &text, path, reading->inputs, is_quiet, arguments);
    if (status != STATUS_DONE)
        return status;
    snprintf(name, sizeof name, "%s (imported)", path);
    reading->foreign = path;
    status = load(out, name, text, reading, arguments);
    import_rehearsal_end(&made);
    free(text);
    return status;
}

static int load_any(rt_scene **out, const char *path, scene_reading *reading,
                    const command_line *arguments)
{
    static const option_id of_foreign[] = {OPTION_CAMERA, OPTION_STRICT};
    if (direct_is_foreign(path))
        return load_foreign(out, path, reading, arguments);
    for (size_t i = 0; i < sizeof of_foreign / sizeof *of_foreign; i++)
        if (arguments->options[of_foreign[i]].given) {
            message_error("--%s is of scenes of other programs, which %s is not",
                          option_table[of_foreign[i]].name, scene_file_name(path));
            return STATUS_USAGE;
        }
    return scene_file_fail_foreign(path, 0) ? STATUS_INPUT
                                            : load(out, path, NULL, reading, arguments);
}

int scene_file_load(rt_scene **out, const char *path, scene_purpose purpose,
                    scene_findings *findings, input_list *inputs, progress_display *progress,
                    const command_line *arguments)
{
    scene_reading reading = {NULL, {0, 0}, purpose, inputs, progress, NULL};
    int status = load_any(out, path, &reading, arguments);
    if (findings)
        *findings = reading.findings;
    return status;
}

int scene_file_dump(const char *path, const command_line *arguments)
{
    scene_text text = {.memory = arguments->memory};
    progress_display progress = progress_begin_on_terminal(0);
    scene_reading reading = {NULL, {0, 0}, SCENE_TO_EMIT, NULL, &progress, &text};
    rt_scene *scene = NULL;
    rt_error error;
    char *made = NULL, word[RECORDED_WORD_SIZE];
    if (direct_is_foreign(path)) {
        message_error("%s is a scene of another program: --dump writes one of the language", path);
        message_hint("`rtc import %s --out NAME.rts`", recorded_word(word, path));
        return STATUS_INPUT;
    }
    int status = load_any(&scene, path, &reading, arguments);
    if (status == STATUS_DONE && text.error.status != RT_OK)
        status = message_failure(&text.error);
    if (status == STATUS_DONE && rt_scene_format(&made, text.text, path, NULL, &error) != RT_OK)
        status = message_failure(&error);
    if (status == STATUS_DONE)
        fputs(made, stdout);
    rt_memory_give(text.memory, 2 * text.capacity, text_of_scene);
    free(made);
    free(text.text);
    rt_scene_destroy(scene);
    return status;
}
