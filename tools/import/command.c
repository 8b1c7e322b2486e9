/* command.c - `rtc import`: scenes of other programs, written in the scene language. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "../commands.h"
#include "../message.h"
#include "../outputs.h"
#include "../recorded.h"
#include "../scene_file.h"
#include "../status.h"
#include "../untrusted.h"
#include "../whole_file.h"
#include "import.h"
#include "direct.h"
#include "rt.h"

static int print_failure(const importer *import)
{
    message_error("%s", import->error);
    return import->is_memory ? STATUS_DEVICE : import->is_output ? STATUS_OUTPUT : STATUS_INPUT;
}

/* Every note, as a warning with its place, or an error. */
static void print_notes(const importer *import, int is_strict)
{
    for (size_t i = 0; i < import->note_count; i++) {
        const import_note *note = &import->notes[i];
        char places[160];
        import_note_places(places, sizeof places, note);
        (is_strict ? message_error : message_warning)("%s: %s%s", note->place, note->text, places);
    }
    if (import->notes_left_out)
        message_warning("%s: and %lu more of other kinds", import->path,
                        (unsigned long)import->notes_left_out);
    if (import->materials_near)
        message_note("%s: %lu of %lu materials exact, %lu approximated: %s", import->path,
                     (unsigned long)(import->materials_read - import->materials_near),
                     (unsigned long)import->materials_read, (unsigned long)import->materials_near,
                     import->near_names);
}

/* Errors of the scene that was made; user: its name. */
static void on_diagnostic(void *user, const rt_diagnostic *diagnostic)
{
    rt_diagnostic named = *diagnostic;
    named.file = user;
    if (diagnostic->severity == RT_SEVERITY_ERROR)
        message_diagnostic(&named);
}

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

/* What is imported, and where it goes in the end. */
typedef struct import_task {
    const char *path;
    char *bytes; /* what the file holds, which readers may take apart */
    size_t size;
    const char *out, *root; /* root: all that it names lies in there, or NULL */
    int is_quiet;
    char *
        *text; /* receives the scene, for the caller to load, which names its files by whole paths;
                    NULL: it is written */
    input_list *inputs;
    int is_strict;
    const char *camera;
    const rt_definition *definitions;
    size_t definition_count;
} import_task;

/* Writes the scene, and reads it as a render would. */
static int write_scene(const import_task *task, const char *path, const char *text)
{
    char *const folder = task->root ? scene_file_folder(path) : NULL;
    const rt_load_options options = {
        .diagnostic = on_diagnostic, .user = (void *)task->out, .root = folder};
    rt_scene *scene = NULL;
    rt_scene_info info;
    rt_error error;
    if (task->root && !folder)
        return STATUS_DEVICE;
    if (rt_file_write(path, text, strlen(text), &error) != RT_OK) {
        free(folder);
        return message_failure(&error);
    }
    const rt_status loaded = rt_scene_load(&scene, path, &options, &error);
    free(folder);
    if (loaded != RT_OK) {
        message_error("the scene that was made of it has errors");
        return message_status(error.status);
    }
    rt_scene_get_info(scene, &info);
    if (!task->is_quiet && path == task->out)
        print_counts(path, &info);
    rt_scene_destroy(scene);
    return STATUS_DONE;
}

static void on_file(void *user, const char *path)
{
    inputs_add(user, path);
}

/* Imports into the scene `out` and the folder beside it; what a failure leaves is removed. */
static int import_to(const import_task *task, const char *out)
{
    importer import;
    struct stat entry;
    char *made = NULL;
    const int was_there = lstat(out, &entry) == 0;
    int status;
    if (import_begin(&import, task->path, out)) {
        import.root = task->root;
        import.bytes_read = task->size;
        import.files = task->text ? import.files_path : import.files;
        import.camera = task->camera;
        import.parameters = task->definitions;
        import.parameter_count = task->definition_count;
        import.on_file = task->inputs ? on_file : NULL;
        import.file_user = task->inputs;
        import_run(&import, task->bytes, task->size);
        made = import.failed ? NULL : import_finish(&import);
    }
    if (made) {
        const int is_refused = task->is_strict && import.note_count > 0;
        if ((!task->is_quiet && out == task->out) || is_refused)
            print_notes(&import, is_refused);
        status = is_refused   ? STATUS_INPUT
                 : task->text ? STATUS_DONE
                              : write_scene(task, out, made);
    } else {
        status = print_failure(&import);
    }
    if (status != STATUS_DONE) {
        import_remove_files(&import);
        if (made && !was_there)
            remove(out);
    } else if (task->text) {
        *task->text = made;
        made = NULL;
    }
    free(made);
    import_end(&import);
    return status;
}

/*
 * Where there is a scene or a folder of an earlier import, this one is first made whole, and read,
 * in a folder of its own beside them: what is wrong with it leaves the earlier one as it was.
 */
static int import_over(const import_task *task)
{
    import_rehearsal rehearsal;
    int status = import_rehearsal_begin(&rehearsal, task->out);
    if (status == STATUS_DONE)
        status = import_to(task, rehearsal.scene);
    import_rehearsal_end(&rehearsal);
    return status == STATUS_DONE ? import_to(task, task->out) : status;
}

static char *read_whole(const char *path, size_t *size)
{
    char cause[128];
    char *const bytes = whole_file_read(path, IMPORT_FILE_MAX, size, cause, sizeof cause);
    if (!bytes)
        message_error("%s: %s", path, cause);
    return bytes;
}

static int import_scene(const char *path, const char *out, const char *root,
                        const command_line *arguments)
{
    import_task task = {.path = path,
                        .out = out,
                        .root = root,
                        .is_quiet = arguments->options[OPTION_QUIET].given,
                        .is_strict = arguments->options[OPTION_STRICT].given,
                        .camera = arguments->options[OPTION_CAMERA].text,
                        .definitions = arguments->definitions,
                        .definition_count = arguments->definition_count};
    if (!(task.bytes = read_whole(path, &task.size)))
        return STATUS_INPUT;
    const int status = import_is_there(out) ? import_over(&task) : import_to(&task, out);
    free(task.bytes);
    return status;
}

int direct_begin(import_rehearsal *out, char **text, const char *path, input_list *inputs,
                 int is_quiet, const command_line *arguments)
{
    import_task task = {.path = path,
                        .is_quiet = is_quiet,
                        .text = text,
                        .inputs = inputs,
                        .is_strict = arguments->options[OPTION_STRICT].given,
                        .camera = arguments->options[OPTION_CAMERA].text,
                        .definitions = arguments->definitions,
                        .definition_count = arguments->definition_count};
    if (!(task.bytes = read_whole(path, &task.size)))
        return STATUS_INPUT;
    if (inputs)
        inputs_add(inputs, path);
    int status = import_rehearsal_elsewhere(out);
    if (status == STATUS_DONE) {
        task.out = out->scene;
        status = import_to(&task, out->scene);
        if (status != STATUS_DONE)
            import_rehearsal_end(out);
    }
    free(task.bytes);
    return status;
}

int direct_is_foreign(const char *path)
{
    static const char *const extensions[] = {".xml", ".pbrt", ".gltf", ".glb",
                                             ".obj", ".ply",  ".stl",  ".off"};
    const char *const own = outputs_extension(path);
    for (size_t i = 0; i < sizeof extensions / sizeof *extensions; i++)
        if (strcasecmp(own, extensions[i]) == 0)
            return 1;
    return 0;
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
        if (!(root = scene_file_folder(path)))
            return STATUS_DEVICE;
        status = untrusted_confine(&needs);
    }
    if (status == STATUS_DONE)
        status = import_scene(path, out, root, arguments);
    free(root);
    return status;
}
