/* command.c - `rtc import`: scenes of other programs, written in the scene language. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "../commands.h"
#include "../message.h"
#include "../outputs.h"
#include "../scene_file.h"
#include "../status.h"
#include "../untrusted.h"
#include "../whole_file.h"
#include "import.h"
#include "rt.h"

static int print_failure(const importer *import)
{
    message_error("%s", import->error);
    return import->is_memory ? STATUS_DEVICE : import->is_output ? STATUS_OUTPUT : STATUS_INPUT;
}

/* Every note, as a warning with its place. */
static void print_notes(const importer *import)
{
    for (size_t i = 0; i < import->note_count; i++) {
        const import_note *note = &import->notes[i];
        char places[160];
        import_note_places(places, sizeof places, note);
        message_warning("%s: %s%s", note->place, note->text, places);
    }
    if (import->notes_left_out)
        message_warning("%s: and %lu more of other kinds", import->path,
                        (unsigned long)import->notes_left_out);
}

static void on_diagnostic(void *user, const rt_diagnostic *diagnostic)
{
    (void)user;
    if (diagnostic->severity == RT_SEVERITY_ERROR)
        message_diagnostic(diagnostic);
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
    printf("%s:", path);
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++)
        printf("%s %llu %s%s", i ? "," : "", (unsigned long long)counts[i].count, counts[i].noun,
               counts[i].count == 1 ? "" : "s");
    putchar('\n');
}

/* Reads the scene as a render would, and writes it where it has no errors. */
static int write_scene(const char *path, const char *text, int is_quiet)
{
    const rt_load_options options = {.diagnostic = on_diagnostic};
    rt_scene *scene = NULL;
    rt_scene_info info;
    rt_error error;
    if (rt_scene_parse(&scene, text, path, &options, &error) != RT_OK) {
        message_error("the scene that was made of it has errors");
        return message_status(error.status);
    }
    rt_scene_get_info(scene, &info);
    rt_scene_destroy(scene);
    if (rt_file_write(path, text, strlen(text), &error) != RT_OK)
        return message_failure(&error);
    if (!is_quiet)
        print_counts(path, &info);
    return STATUS_DONE;
}

/* Reads `bytes` into an import that has begun; returns the new scene, or NULL after a failure. */
static char *convert(importer *import, const char *root, const char *bytes, size_t size)
{
    import->root = root;
    import->bytes_read = size;
    import_run(import, bytes, size);
    return import->failed ? NULL : import_finish(import);
}

/*
 * Where an import before has left files, the source is read without writing first: an error in it
 * leaves that one as it was.
 */
static char *rehearse_and_convert(importer *import, const char *path, const char *out,
                                  const char *root, const char *bytes, size_t size)
{
    struct stat entry;
    if (!import_begin(import, path, out))
        return NULL;
    if (lstat(import->files_path, &entry) == 0) {
        import->is_dry = 1;
        free(convert(import, root, bytes, size));
        if (import->failed)
            return NULL;
        import_end(import);
        if (!import_begin(import, path, out))
            return NULL;
    }
    return convert(import, root, bytes, size);
}

static int import_scene(const char *path, const char *out, const char *root, int is_quiet)
{
    importer import;
    char cause[128];
    size_t size = 0;
    char *bytes = whole_file_read(path, IMPORT_FILE_MAX, &size, cause, sizeof cause);
    if (!bytes) {
        message_error("%s: %s", path, cause);
        return STATUS_INPUT;
    }
    char *made = rehearse_and_convert(&import, path, out, root, bytes, size);
    free(bytes);
    int status = STATUS_DONE;
    if (import.failed || !made) {
        status = print_failure(&import);
    } else {
        if (!is_quiet)
            print_notes(&import);
        status = write_scene(out, made, is_quiet);
    }
    if (status != STATUS_DONE)
        import_remove_files(&import);
    free(made);
    import_end(&import);
    return status;
}

static int check_arguments(const command_line *arguments)
{
    const option_value *out = &arguments->options[OPTION_IMPORT_OUT];
    if (arguments->operand_count != 1 || !out->given) {
        message_error("usage: rtc import FILE --out SCENE.rts");
        return STATUS_USAGE;
    }
    const int is_scene = strcmp(outputs_extension(out->text), ".rts") == 0;
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
        const untrusted_needs needs = {.scene = path, .outputs = &out, .output_count = 1};
        if (!(root = scene_file_folder(path)))
            return STATUS_DEVICE;
        status = untrusted_confine(&needs);
    }
    if (status == STATUS_DONE)
        status = import_scene(path, out, root, arguments->options[OPTION_QUIET].given);
    free(root);
    return status;
}
