/* load.c - rt_scene_load of scenes of other programs, and rt_scene_import. */
#define _XOPEN_SOURCE 700 /* lstat */
#include "dsl/import/load.h"

#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "dsl/import/import.h"
#include "dsl/import/rehearsal.h"
#include "dsl/scope.h"

/* What is imported, and into what. */
typedef struct import_task {
    const char *path;
    char *bytes; /* what the file holds, which readers may take apart */
    size_t size;
    const rt_load_options *options;
    int is_loaded; /* the text names its files by whole paths, since it is no file */
    int is_silent; /* what differs is told by another run, */
    int is_again;  /* or was, but for damaged images */
    int checks_images;
    int has_images;  /* what was made has some, which need not be sound */
    char tally[400]; /* how many materials are exact; "": all are */
    import_copies copies;
    rt_scene **scene; /* receives what was written */
} import_task;

/* ---- What is told ------------------------------------------------------------ */

/* The file of a place "FILE:LINE", or of one without a line, 0. */
static void file_of(char *out, size_t size, const char *place, int line)
{
    const char *const colon = line > 0 ? strrchr(place, ':') : NULL;
    snprintf(out, size, "%.*s", colon ? (int)(colon - place) : (int)size - 1, place);
}

static void tell(const rt_load_options *options, rt_severity severity, const char *place, int line,
                 const char *message)
{
    char file[300];
    file_of(file, sizeof file, place, line);
    const rt_diagnostic diagnostic = {
        .severity = severity, .file = file, .line = line, .message = message};
    if (options->diagnostic)
        options->diagnostic(options->user, &diagnostic);
}

/* Tells of an error, which *error receives. */
static rt_status fail_at(const rt_load_options *options, rt_status status, const char *place,
                         int line, const char *message, rt_error *error)
{
    tell(options, RT_SEVERITY_ERROR, place, line, message);
    rt_import_set_error(error, status, "%s", message);
    if (error) {
        error->line = line;
        file_of(error->file, sizeof error->file, place, line);
    }
    return status;
}

/* The last part of a path. */
static const char *last_of(const char *path)
{
    const char *const slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

/*
 * A message about a file that was made, which begins with its path or its name, as one about the
 * file that it is a copy of. Returns the message, or `out`, which receives the other.
 */
static const char *of_source(char *out, size_t size, const import_task *task, const char *message)
{
    const char *const colon = strchr(message, ':');
    if (!colon)
        return message;
    for (size_t i = 0; i < task->copies.count; i++) {
        const struct import_copy *const copy = &task->copies.items[i];
        const char *const name = last_of(copy->name);
        const size_t length = strlen(name);
        if ((size_t)(colon - message) < length)
            continue;
        const char *const at = colon - length;
        if (strncmp(at, name, length) != 0 || (at > message && at[-1] != '/'))
            continue;
        snprintf(out, size, "%s%s", at > message ? copy->from : last_of(copy->from), colon);
        return out;
    }
    return message;
}

/* How many notes are errors when strict: all but additions. */
static size_t missing_count(const importer *import)
{
    size_t count = import->notes_left_out;
    for (size_t i = 0; i < import->note_count; i++)
        count += !import->notes[i].is_addition;
    return count;
}

/*
 * Every note, as a warning, or when strict as an error, of which *error receives the first; and
 * that nothing was read, which the notes explain.
 */
static rt_status tell_notes(import_task *task, const importer *import, rt_error *error)
{
    const rt_load_options *const options = task->options;
    const size_t missing = options->is_strict ? missing_count(import) : 0;
    const int is_silent = task->is_silent && !import->is_empty;
    size_t errors = 0;
    char message[560];
    if (is_silent && missing == 0)
        return RT_OK;
    for (size_t i = 0; i < import->note_count; i++) {
        const import_note *const note = &import->notes[i];
        char places[160];
        rt_import_note_places(places, sizeof places, note);
        snprintf(message, sizeof message, "%s%s", note->text, places);
        if (options->is_strict && !note->is_addition)
            fail_at(options, RT_ERROR_INPUT, note->place, note->line, message,
                    errors++ ? NULL : error);
        else if (!is_silent && (!task->is_again || note->is_damage))
            tell(options, RT_SEVERITY_WARNING, note->place, note->line, message);
    }
    if (import->notes_left_out && !task->is_again) {
        snprintf(message, sizeof message, "and %lu more of other kinds",
                 (unsigned long)import->notes_left_out);
        tell(options, RT_SEVERITY_WARNING, import->path, 0, message);
    }
    if (import->materials_near)
        snprintf(task->tally, sizeof task->tally,
                 "%lu of %lu materials exact, %lu approximated: %s",
                 (unsigned long)(import->materials_read - import->materials_near),
                 (unsigned long)import->materials_read, (unsigned long)import->materials_near,
                 import->near_names);
    const size_t used = error && missing ? strlen(error->message) : 0;
    if (used && missing > 1)
        snprintf(error->message + used, sizeof error->message - used, " (and %lu more)",
                 (unsigned long)(missing - 1));
    if (missing == 0 && import->is_empty)
        return fail_at(options, RT_ERROR_INPUT, task->path, 0,
                       "nothing to render: no shape, camera or light was read", error);
    return missing ? RT_ERROR_INPUT : RT_OK;
}

/* Last of all, and once. */
static void tell_tally(const import_task *task)
{
    if (task->tally[0] && !task->is_silent)
        tell(task->options, RT_SEVERITY_NOTE, task->path, 0, task->tally);
}

static rt_status fail_of(const import_task *task, const importer *import, rt_error *error)
{
    const rt_status status = import->is_memory   ? RT_ERROR_MEMORY
                             : import->is_output ? RT_ERROR_OUTPUT
                                                 : RT_ERROR_INPUT;
    return fail_at(task->options, status, import->error_place, import->error_line, import->error,
                   error);
}

/* ---- The import -------------------------------------------------------------- */

static void on_file(void *user, const char *path)
{
    const rt_load_options *const options = user;
    options->file(options->user, path);
}

/*
 * Whether errors of a scene that was made wait: an image of it may be damaged, and then it is made
 * again without that.
 */
static int errors_wait(const import_task *task)
{
    return task->has_images && !task->checks_images;
}

/* Errors of the scene that was made, which are ours; user: the task. */
static void on_own_error(void *user, const rt_diagnostic *diagnostic)
{
    const import_task *const task = user;
    const rt_load_options *const options = task->options;
    if (errors_wait(task))
        return;
    if (diagnostic->severity == RT_SEVERITY_ERROR && options->diagnostic) {
        char message[600];
        rt_diagnostic told = *diagnostic;
        told.message = of_source(message, sizeof message, task, told.message);
        options->diagnostic(options->user, &told);
    }
}

/* Writes the scene, and reads it as a render would. */
static rt_status write_scene(const import_task *task, const char *path, const char *text,
                             rt_error *error)
{
    const char *const slash = strrchr(path, '/');
    char *folder = malloc(strlen(path) + sizeof ".");
    rt_scene *scene = NULL;
    if (!folder)
        return rt_import_set_error(error, RT_ERROR_MEMORY, "out of memory");
    sprintf(folder, "%.*s.", slash ? (int)(slash - path) + 1 : 0, path);
    const rt_load_options options = {.diagnostic = on_own_error,
                                     .user = (void *)task,
                                     .root = task->options->root ? folder : NULL,
                                     .vdb_module = task->options->vdb_module};
    rt_status status = rt_file_write(path, text, strlen(text), error);
    if (status == RT_OK)
        status = rt_scene_load(&scene, path, &options, error);
    if (status == RT_OK) {
        rt_scene *const earlier = *task->scene; /* of the folder where it was tried */
        *task->scene = scene;
        scene = earlier;
    }
    rt_scene_destroy(scene);
    free(folder);
    return status;
}

/*
 * Imports into the folder beside the scene `out`, and into that, or into *text, to be freed. What a
 * failure leaves is removed.
 */
static rt_status import_to(import_task *task, const char *out, char **text, rt_error *error)
{
    const rt_load_options *const options = task->options;
    struct stat entry;
    const int was_there = lstat(out, &entry) == 0;
    importer import;
    char *made = NULL;
    if (rt_import_begin(&import, task->path, out)) {
        import.root = options->root;
        import.vdb_module = options->vdb_module;
        import.bytes_read = task->size;
        import.files = task->is_loaded ? import.files_path : import.files;
        import.is_passing = task->is_loaded;
        import.camera = options->camera;
        import.parameters = options->definitions;
        import.parameter_count = options->definition_count;
        import.checks_images = task->checks_images;
        import.parameter_word = options->definition_name ? options->definition_name : "definition";
        import.on_file = options->file ? on_file : NULL;
        import.file_user = (void *)options;
        rt_import_run(&import, task->bytes, task->size);
        made = import.failed ? NULL : rt_import_finish(&import);
    }
    rt_status status = made ? tell_notes(task, &import, error) : fail_of(task, &import, error);
    rt_import_copies_free(&task->copies);
    task->copies = import.copies;
    import.copies = (import_copies){NULL, 0};
    task->has_images = status == RT_OK && import.image_count > 0;
    if (status == RT_OK && task->is_loaded) {
        *text = made;
        made = NULL;
    } else if (status == RT_OK) {
        status = write_scene(task, out, made, error);
    }
    if (status != RT_OK) {
        rt_import_remove_files(&import);
        if (made && !task->is_loaded && !was_there)
            remove(out);
    }
    free(made);
    rt_import_end(&import);
    return status;
}

/* Whether to import once more, decoding the images this time: one may be damaged. */
static int begin_again(import_task *task, rt_status status)
{
    const int is_again = status != RT_OK && status != RT_CANCELLED && errors_wait(task);
    task->checks_images |= is_again;
    task->is_again = is_again;
    return is_again;
}

static rt_status begin(import_task *out, const char *path, const rt_load_options *options,
                       rt_error *error)
{
    static const rt_load_options none = {0};
    *out = (import_task){.path = path, .options = options ? options : &none};
    if (out->options->file)
        out->options->file(out->options->user, path);
    return rt_file_load(&out->bytes, &out->size, path, IMPORT_FILE_MAX, error);
}

/* ---- Loaded ------------------------------------------------------------------ */

/* What is found in the scene that was made is told of the file that it was made of. */
typedef struct teller {
    const rt_load_options *options;
    const import_task *task;
    const char *folder; /* where its files were written, and soon are no more, from the root */
    const char *files;  /* their folder as rt_scene_import names it */
    int is_memory;      /* out of memory */
} teller;

/* Names are the import's, and what no shape has changes nothing. */
static int is_of_unused(const char *message)
{
    const size_t length = strlen(message), end = strlen(RT_NEVER_USED);
    return length > end && strcmp(message + length - end, RT_NEVER_USED) == 0;
}

/* Whether a hint names a line of the text that was made, which nobody sees. */
static int names_line(const char *hint, const char *file)
{
    const char *at = hint ? strstr(hint, file) : NULL;
    for (; at; at = strstr(at + 1, file))
        if (at[strlen(file)] == ':' && at[strlen(file) + 1] >= '0' && at[strlen(file) + 1] <= '9')
            return 1;
    return 0;
}

/*
 * The file and, where it is about an instance, the mesh by the name that it had: in the text that
 * was made a number follows it.
 */
static const char *place_of(char *out, size_t room, const import_task *task, const char *line)
{
    static const char word[] = "instance ";
    const char *const name = line ? line + strspn(line, " \t") : "";
    if (strncmp(name, word, strlen(word)) != 0)
        return task->path;
    const char *const first = name + strlen(word), *end = first + strcspn(first, " {");
    const char *number = end;
    while (number > first && number[-1] >= '0' && number[-1] <= '9')
        number--;
    if (number < end && number > first + 1 && number[-1] == '_')
        end = number - 1;
    snprintf(out, room, "%s: mesh '%.*s'", task->path, (int)(end - first), first);
    return out;
}

static void on_diagnostic(void *user, const rt_diagnostic *diagnostic)
{
    const teller *const t = user;
    const int is_error = diagnostic->severity == RT_SEVERITY_ERROR;
    if (is_of_unused(diagnostic->message) || (is_error ? errors_wait(t->task) : t->task->is_again))
        return;
    char message[600], place[600];
    rt_diagnostic told = *diagnostic;
    told.message = of_source(message, sizeof message, t->task, told.message);
    told.file = place_of(place, sizeof place, t->task, told.source_line);
    told.line = told.column = told.length = 0;
    if (names_line(told.hint, t->task->path))
        told.hint = NULL;
    told.source_line = NULL;
    if (t->options->diagnostic)
        t->options->diagnostic(t->options->user, &told);
}

/* Whether a file is named here that was written; *name receives what follows its folder. */
static int is_written(const teller *t, const char *at, const char **name)
{
    static const char files[] = "/scene_files/";
    const size_t length = strlen(t->folder);
    if (at[0] != '"' || strncmp(at + 1, t->folder, length) != 0 ||
        strncmp(at + 1 + length, files, strlen(files)) != 0)
        return 0;
    *name = at + 1 + length + strlen(files);
    return 1;
}

/* The files that were written are named as rt_scene_import names them beside a scene. */
static void on_block(void *user, const char *text)
{
    teller *const t = user;
    size_t count = 0;
    for (const char *at = text; *at; at++)
        count += *at == '"';
    char *const named = malloc(strlen(text) + count * (strlen(t->files) + 2) + 1), *end = named;
    if (!named) {
        t->is_memory = 1;
        return;
    }
    for (const char *at = text; *at;)
        if (is_written(t, at, &at))
            end += sprintf(end, "\"%s/", t->files);
        else
            *end++ = *at++;
    *end = '\0';
    t->options->block(t->options->user, named);
    free(named);
}

/* NAME_files of FOLDER/NAME.xml. To be freed; NULL: out of memory. */
static char *files_of(const char *path)
{
    const char *const slash = strrchr(path, '/'), *const name = slash ? slash + 1 : path,
                      *const dot = strrchr(name, '.');
    const size_t size = strlen(name) + sizeof "_files";
    char *const out = malloc(size);
    if (out)
        snprintf(out, size, "%.*s_files", (int)(dot ? dot - name : (ptrdiff_t)strlen(name)), name);
    return out;
}

static rt_status load_text(rt_scene **out, const import_task *task, const char *text,
                           const char *folder, rt_error *error)
{
    const rt_load_options *const given = task->options;
    char *const whole = realpath(folder, NULL), *const files = files_of(task->path);
    if (!files) {
        free(whole);
        return rt_import_set_error(error, RT_ERROR_MEMORY, "out of memory");
    }
    teller told = {given, task, whole ? whole : folder, files, 0};
    const rt_load_options options = {.diagnostic = on_diagnostic,
                                     .user = &told,
                                     .check = given->check,
                                     .block = given->block ? on_block : NULL,
                                     .hooks = given->hooks,
                                     .root = given->root ? folder : NULL,
                                     .vdb_module = given->vdb_module,
                                     .memory = given->memory,
                                     .profile = given->profile};
    rt_status status = rt_scene_parse(out, text, task->path, &options, error);
    free(whole);
    free(files);
    if (status == RT_ERROR_INPUT && error) {
        char message[sizeof error->message];
        if (of_source(message, sizeof message, task, error->message) == message)
            memcpy(error->message, message, sizeof message);
        error->line = error->column = 0;
    }
    if (status == RT_OK && told.is_memory) {
        rt_scene_destroy(*out);
        *out = NULL;
        status = rt_import_set_error(error, RT_ERROR_MEMORY, "out of memory");
    }
    return status;
}

/* Imports into the folder of `scene`, and loads what was made. */
static rt_status import_and_load(rt_scene **out, import_task *task, const import_rehearsal *made,
                                 rt_error *error)
{
    char *text;
    rt_status status = import_to(task, made->scene, &text, error);
    if (status != RT_OK)
        return status;
    status = load_text(out, task, text, made->folder, error);
    free(text);
    if (status == RT_OK)
        tell_tally(task);
    return status;
}

rt_status rt_import_load(rt_scene **out, const char *path, const rt_load_options *options,
                         rt_error *error)
{
    import_task task;
    import_rehearsal made;
    rt_status status = begin(&task, path, options, error);
    task.is_loaded = 1;
    if (status == RT_OK) {
        status = rt_import_rehearsal_elsewhere(&made, task.options->scratch, error);
        if (status == RT_OK) {
            status = import_and_load(out, &task, &made, error);
            if (begin_again(&task, status))
                status = import_and_load(out, &task, &made, error);
            rt_import_rehearsal_end(&made);
        }
        free(task.bytes);
    }
    rt_import_copies_free(&task.copies);
    return status;
}

/* ---- Written ----------------------------------------------------------------- */

/*
 * Where there is a scene or a folder of an earlier import, this one is first made whole, and read,
 * in a folder of its own beside them: what is wrong with it leaves the earlier one as it was.
 */
static rt_status import_over(import_task *task, const char *out, rt_error *error)
{
    import_rehearsal rehearsal;
    rt_status status = rt_import_rehearsal_begin(&rehearsal, out, error);
    if (status != RT_OK)
        return status;
    task->is_silent = 1;
    status = import_to(task, rehearsal.scene, NULL, error);
    if (begin_again(task, status))
        status = import_to(task, rehearsal.scene, NULL, error);
    rt_import_rehearsal_end(&rehearsal);
    task->is_silent = task->is_again = 0;
    return status == RT_OK ? import_to(task, out, NULL, error) : status;
}

rt_status rt_scene_import(rt_scene **scene, const char *out, const char *path,
                          const rt_load_options *options, rt_error *error)
{
    import_task task;
    rt_scene *made = NULL;
    const char *const dot = out ? strrchr(out, '.') : NULL;
    const char *const lost = !path ? "path" : !out ? "out" : NULL;
    if (lost) {
        rt_import_set_error(error, RT_ERROR_USAGE, "%s is NULL", lost);
        if (error)
            snprintf(error->field, sizeof error->field, "%s", lost);
        return RT_ERROR_USAGE;
    }
    if (!dot || strcmp(dot, ".rts") != 0 || strpbrk(out, "\"\n\r"))
        return rt_import_set_error(error, RT_ERROR_USAGE, "%.200s: %s", out,
                                   dot && strcmp(dot, ".rts") == 0
                                       ? "a scene cannot name files by a path with quotes or line "
                                         "ends"
                                       : "a scene is written as .rts");
    rt_status status = begin(&task, path, options, error);
    if (status != RT_OK)
        return status;
    task.scene = &made;
    status = rt_import_is_there(out) ? import_over(&task, out, error)
                                     : import_to(&task, out, NULL, error);
    if (begin_again(&task, status))
        status = import_to(&task, out, NULL, error);
    free(task.bytes);
    rt_import_copies_free(&task.copies);
    if (status == RT_OK)
        tell_tally(&task);
    if (status == RT_OK && scene) {
        *scene = made;
        made = NULL;
    }
    rt_scene_destroy(made);
    return status;
}
