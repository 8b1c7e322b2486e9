/* import.c - the scene that an import makes, as text; and its notes. */
#include "dsl/import/import.h"

#include <ctype.h>
#include <float.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "dsl/dump.h"
#include "rt.h"

enum { NOTES_MAX = 200, NUMBER_LENGTH_MAX = 64, PLACE_LENGTH = sizeof((importer *)0)->error_place };

/* ---- Failures and notes ------------------------------------------------------ */

/* A text that a file gave may hold control characters, which end comments and lines. */
static void make_printable(char *text)
{
    for (; *text; text++)
        if ((unsigned char)*text < 0x20 || (unsigned char)*text >= 0x7f)
            *text = '?';
}

/* "scene.xml:7", "scene.gltf: materials[2]", "scene.obj" */
static void write_place(char *out, size_t size, const importer *import, int line)
{
    const import_place *place = &import->place;
    const char *file = place->file ? place->file : import->path;
    if (line > 0)
        snprintf(out, size, "%.200s:%d", file, line);
    else if (place->list)
        snprintf(out, size, place->name ? "%.200s: %s[%lu] '%.40s'" : "%.200s: %s[%lu]", file,
                 place->list, (unsigned long)place->index, place->name);
    else
        snprintf(out, size, "%.200s", file);
}

int rt_import_fail(importer *import, int line, const char *format, ...)
{
    if (import->failed)
        return 0;
    import->failed = 1;
    write_place(import->error_place, sizeof import->error_place, import, line);
    make_printable(import->error_place);
    import->error_line = line > 0 ? line : 0;
    va_list list;
    va_start(list, format);
    vsnprintf(import->error, sizeof import->error, format, list);
    va_end(list);
    make_printable(import->error);
    return 0;
}

int rt_import_fail_memory(importer *import)
{
    if (!import->failed)
        import->is_memory = 1;
    return rt_import_fail(import, 0, "out of memory");
}

void *rt_import_grow(importer *import, void *items, size_t count, size_t size)
{
    if ((count & (count - 1)) != 0)
        return items;
    void *moved = realloc(items, (count ? 2 * count : 1) * size);
    if (!moved)
        rt_import_fail_memory(import);
    return moved;
}

rt_status rt_import_set_error(rt_error *error, rt_status status, const char *format, ...)
{
    if (error) {
        memset(error, 0, sizeof *error);
        error->status = status;
        va_list list;
        va_start(list, format);
        vsnprintf(error->message, sizeof error->message, format, list);
        va_end(list);
    }
    return status;
}

const char *rt_import_cause(char out[IMPORT_CAUSE], int code)
{
    if (strerror_r(code, out, IMPORT_CAUSE) != 0)
        snprintf(out, IMPORT_CAUSE, "error %d", code);
    return out;
}

/* Whether a list, "5, 7", has this item. */
static int is_listed(const char *list, const char *item)
{
    const size_t length = strlen(item);
    for (const char *at = list; length > 0 && (at = strstr(at, item)) != NULL; at++)
        if ((at == list || (at - list >= 2 && strncmp(at - 2, ", ", 2) == 0)) &&
            (at[length] == '\0' || at[length] == ','))
            return 1;
    return 0;
}

/* Adds another place to a note: one in the file of the first by its line or item alone. */
static void add_place(import_note *note, const char *place)
{
    const char *at = note->place, *rest = place;
    if (strcmp(place, note->place) == 0)
        return;
    while (*at && *at == *rest)
        at++, rest++;
    while (rest > place && rest[-1] != ':')
        rest--;
    rest += strspn(rest, " ");
    /* A line behind a place in another file would be taken for one of that. */
    if (strchr(note->also, ':'))
        rest = place;
    const size_t used = strlen(note->also), room = sizeof note->also - used;
    if (is_listed(note->also, rest))
        return;
    if (strlen(rest) + 3 > room)
        note->has_more = 1;
    else
        snprintf(note->also + used, room, "%s%s", used ? ", " : "", rest);
}

void rt_import_note_places(char *out, size_t size, const import_note *note)
{
    out[0] = '\0';
    if (note->also[0] && note->has_more)
        snprintf(out, size, " (also at %s and other places)", note->also);
    else if (note->also[0])
        snprintf(out, size, " (also at %s)", note->also);
    else if (note->has_more)
        snprintf(out, size, " (also at other places)");
}

void rt_import_note_at(importer *import, int line, const char *format, ...)
{
    char text[320], place[PLACE_LENGTH];
    if (import->failed)
        return;
    import->told++;
    va_list list;
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    make_printable(text);
    write_place(place, sizeof place, import, line);
    make_printable(place);
    for (size_t i = 0; i < import->note_count; i++)
        if (strcmp(import->notes[i].text, text) == 0) {
            import->notes[i].count++;
            add_place(&import->notes[i], place);
            return;
        }
    if (import->note_count == NOTES_MAX) {
        import->notes_left_out++;
        return;
    }
    import_note *moved = realloc(import->notes, (import->note_count + 1) * sizeof *import->notes);
    if (moved)
        import->notes = moved;
    char *where = malloc(strlen(place) + 1), *copy = malloc(strlen(text) + 1);
    if (!moved || !where || !copy) {
        free(where);
        free(copy);
        rt_import_fail_memory(import);
        return;
    }
    strcpy(where, place);
    strcpy(copy, text);
    import->notes[import->note_count++] = (import_note){.place = where,
                                                        .text = copy,
                                                        .line = line > 0 ? line : 0,
                                                        .concern = import->place.concern,
                                                        .count = 1};
}

/* By what they are about, then by how often; else as they came. */
static void sort_notes(importer *import)
{
    for (size_t i = 1; i < import->note_count; i++) {
        const import_note moved = import->notes[i];
        size_t at = i;
        for (; at > 0; at--) {
            const import_note *const before = &import->notes[at - 1];
            if (before->concern < moved.concern ||
                (before->concern == moved.concern && before->count >= moved.count))
                break;
            import->notes[at] = *before;
        }
        import->notes[at] = moved;
    }
}

void rt_import_note_addition(importer *import, const char *text)
{
    const size_t before = import->note_count;
    if (import->is_empty)
        return; /* nothing is rendered */
    rt_import_note_at(import, 0, "%s", text);
    if (import->note_count > before)
        import->notes[before].is_addition = 1;
}

void rt_import_note_integrator(importer *import, int line, const char *type)
{
    static const struct {
        const char *type, *options;
    } known[] = {{"photonmapper", "--mode photon"},
                 {"ppm", "--mode photon --passes 64"},
                 {"sppm", "--mode photon --passes 64"},
                 {"bdpt", "--mode vcm --techniques bpt"},
                 {"mlt", "--mode vcm --techniques bpt"},
                 {"pssmlt", "--mode vcm --techniques bpt"},
                 {"vcm", "--mode vcm"}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (strcmp(known[i].type, type) == 0) {
            rt_import_note_at(import, line, "the integrator '%s' became path: %s is like it", type,
                              known[i].options);
            return;
        }
    rt_import_note_at(import, line, "the integrator '%.40s' became path", type);
}

void rt_import_note_damage(importer *import, int line, const char *text)
{
    const size_t before = import->note_count;
    rt_import_note_at(import, line, "%s", text);
    if (import->note_count > before)
        import->notes[before].is_damage = 1;
}

void rt_import_tally(importer *import, size_t told, const char *name)
{
    import->materials_read++;
    if (import->told != told)
        rt_import_tally_near(import, name);
}

void rt_import_tally_near(importer *import, const char *name)
{
    const size_t used = strlen(import->near_names), room = sizeof import->near_names - used;
    import->materials_near++;
    if (strlen(name) + sizeof ", ..." > room)
        return;
    snprintf(import->near_names + used, room, "%s%s", used ? ", " : "", name);
    make_printable(import->near_names);
}

/* ---- Text -------------------------------------------------------------------- */

static int reserve(importer *import, import_text *out, size_t more)
{
    if (out->size + more + 1 <= out->capacity)
        return 1;
    size_t grown = 2 * (out->size + more + 1);
    char *moved = import->failed ? NULL : realloc(out->text, grown);
    if (!moved)
        return rt_import_fail_memory(import);
    out->text = moved;
    out->capacity = grown;
    return 1;
}

void rt_import_put(importer *import, import_text *out, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    int length = vsnprintf(NULL, 0, format, list);
    va_end(list);
    if (length < 0 || !reserve(import, out, (size_t)length))
        return;
    va_start(list, format);
    vsnprintf(out->text + out->size, (size_t)length + 1, format, list);
    va_end(list);
    out->size += (size_t)length;
}

void rt_import_put_numbers(importer *import, import_text *out, const double *values, int count)
{
    for (int i = 0; i < count; i++) {
        char text[RT_DUMP_NUMBER];
        if (!(fabs(values[i]) <= FLT_MAX)) {
            rt_import_fail(import, 0, "a number of the scene is beyond single precision");
            return;
        }
        rt_dump_number(text, (float)values[i]);
        rt_import_put(import, out, " %s", text);
    }
}

int rt_import_name(importer *import, const char *base)
{
    if (import->failed)
        return IMPORT_NONE;
    if (import->label_count == import->label_capacity) {
        size_t grown = 2 * import->label_capacity + 16;
        void *moved = realloc(import->labels, grown * sizeof *import->labels);
        if (!moved) {
            rt_import_fail_memory(import);
            return IMPORT_NONE;
        }
        import->labels = moved;
        import->label_capacity = grown;
    }
    import_label_entry *const label = &import->labels[import->label_count];
    char *const out = label->name;
    size_t used = 0;
    memset(label, 0, sizeof *label);
    if (!isalpha((unsigned char)base[0]))
        out[used++] = 'n';
    for (; *base && used < IMPORT_NAME - 16; base++)
        out[used++] = isalnum((unsigned char)*base) && (unsigned char)*base < 128 ? *base : '_';
    snprintf(out + used, IMPORT_NAME - used, "_%lu", (unsigned long)import->label_count);
    return (int)import->label_count++;
}

const char *rt_import_label(const importer *import, int handle)
{
    return handle >= 0 && (size_t)handle < import->label_count ? import->labels[handle].name
                                                               : "none";
}

int rt_import_number(double *out, const char **text)
{
    const char *at = *text;
    size_t length = 0;
    while (length < NUMBER_LENGTH_MAX && at[length] && strchr("+-.0123456789eE", at[length]))
        length++;
    if (length == 0 || rt_number_read(out, at, length) == RT_NUMBER_MALFORMED ||
        rt_number_read(out, at, length) == RT_NUMBER_TOO_LARGE || !(fabs(*out) <= FLT_MAX))
        return 0;
    *text = at + length;
    return 1;
}

/* ---- Parameters -------------------------------------------------------------- */

const char *rt_import_parameter(importer *import, const char *name)
{
    for (size_t i = 0; i < import->parameter_count; i++)
        if (strcmp(import->parameters[i].name, name) == 0) {
            import->parameters_used |= (uint64_t)1 << (i % 64);
            return import->parameters[i].value;
        }
    return NULL;
}

void rt_import_check_parameters(importer *import)
{
    for (size_t i = 0; i < import->parameter_count && i < 64; i++)
        if (!(import->parameters_used >> i & 1))
            rt_import_fail(import, 0, "%s %.60s: the scene has no parameter of that name",
                           import->parameter_word, import->parameters[i].name);
}

/* ---- Cameras ----------------------------------------------------------------- */

int rt_import_takes_camera(importer *import, int line, const char *name, const char *other)
{
    const size_t number = ++import->cameras_met, length = strlen(import->camera_names);
    char decimal[32], label[64] = "";
    snprintf(decimal, sizeof decimal, "%lu", (unsigned long)number);
    if (name)
        snprintf(label, sizeof label, " '%.50s'", name);
    snprintf(import->camera_names + length, sizeof import->camera_names - length, "%s%s%s",
             length ? ", " : "", decimal, label);
    const char *const wanted = import->camera;
    const int is_number = wanted && wanted[strspn(wanted, "0123456789")] == '\0',
              is_named = wanted && (is_number ? strcmp(wanted, decimal) == 0
                                              : (name && strcmp(wanted, name) == 0) ||
                                                    (other && strcmp(wanted, other) == 0));
    if (!import->has_camera && (is_named || !import->camera))
        return 1;
    if (!import->camera)
        rt_import_note_at(import, line, "camera %s%s is left out: --camera %s takes it", decimal,
                          label, decimal);
    return 0;
}

void rt_import_check_camera(importer *import)
{
    if (import->camera && !import->has_camera && !import->failed)
        rt_import_fail(import, 0, "--camera %.60s: the file has %s%s", import->camera,
                       import->cameras_met > 1 ? "the cameras "
                       : import->cameras_met   ? "one camera, "
                                               : "no camera",
                       import->camera_names);
}

/* ---- The whole --------------------------------------------------------------- */

static char *copy_part(const char *text, size_t length)
{
    char *copy = malloc(length + 1);
    if (copy) {
        memcpy(copy, text, length);
        copy[length] = '\0';
    }
    return copy;
}

/* The folder of a path with its '/', or "". */
static char *folder_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    return copy_part(path, slash ? (size_t)(slash - path) + 1 : 0);
}

char *rt_import_files_path(const char *scene_path)
{
    const size_t stem = strlen(scene_path) - strlen(".rts"), size = stem + sizeof "_files";
    char *path = malloc(size);
    if (path)
        snprintf(path, size, "%.*s_files", (int)stem, scene_path);
    return path;
}

int rt_import_begin(importer *import, const char *path, const char *out_path)
{
    memset(import, 0, sizeof *import);
    import->path = path;
    import->folder = folder_of(path);
    import->files_path = rt_import_files_path(out_path);
    for (int c = 0; c < 3; c++) {
        import->lo[c] = DBL_MAX;
        import->hi[c] = -DBL_MAX;
    }
    if (!import->folder || !import->files_path)
        return rt_import_fail_memory(import);
    const char *slash = strrchr(import->files_path, '/');
    import->files = slash ? slash + 1 : import->files_path;
    return 1;
}

void rt_import_end(importer *import)
{
    for (size_t i = 0; i < import->note_count; i++) {
        free(import->notes[i].place);
        free(import->notes[i].text);
    }
    for (size_t i = 0; i < import->made_count; i++)
        free(import->made[i]);
    free(import->made);
    free(import->read);
    rt_import_copies_free(&import->copies);
    free(import->notes);
    free(import->labels);
    for (size_t i = 0; i < import->search_count; i++)
        free(import->search[i]);
    free(import->folder);
    free(import->files_path);
    free(import->settings.text);
    free(import->camera_block.text);
    free(import->definitions.text);
    free(import->shapes.text);
    free(import->lights.text);
}

/* What is smaller could not be looked at: a camera needs a distance. */
static const double size_least = 1e-12;

/* A camera that sees all that was placed, for a file that has none. */
static void add_camera(importer *import)
{
    import_camera camera = {.up = {0, 1, 0}, .direction = {-0.4, -0.35, -1}, .fov = 40};
    double size = 0, centre[3] = {0, 0, 0};
    for (int c = 0; c < 3 && import->lo[0] <= import->hi[0]; c++) {
        centre[c] = (import->lo[c] + import->hi[c]) / 2;
        size += pow(import->hi[c] - import->lo[c], 2);
    }
    size = sqrt(size) > size_least ? sqrt(size) : 2;
    rt_vector_normalize(camera.direction);
    for (int c = 0; c < 3; c++)
        camera.eye[c] = centre[c] - 1.6 * size * camera.direction[c];
    camera.focal_distance = 1.6 * size;
    rt_import_note_addition(import, "the file has no camera: one that sees all shapes was added");
    rt_import_set_camera(import, 0, &camera);
}

static void put_notes(importer *import, import_text *out)
{
    const char *slash = strrchr(import->path, '/');
    char name[200];
    snprintf(name, sizeof name, "%s", slash ? slash + 1 : import->path);
    make_printable(name);
    rt_import_put(import, out, "# Made by rtc import from %s.\n", name);
    if (import->note_count)
        rt_import_put(import, out, "#\n# What differs from it:\n");
    for (size_t i = 0; i < import->note_count; i++) {
        const import_note *note = &import->notes[i];
        slash = strrchr(note->place, '/');
        char places[160];
        rt_import_note_places(places, sizeof places, note);
        rt_import_put(import, out, "# - %s: %s%s\n", slash ? slash + 1 : note->place, note->text,
                      places);
    }
    if (import->notes_left_out)
        rt_import_put(import, out, "# - and %lu more of other kinds\n",
                      (unsigned long)import->notes_left_out);
    rt_import_put(import, out, "\n");
}

char *rt_import_finish(importer *import)
{
    static const double white[3] = {1, 1, 1};
    import_text whole = {NULL, 0, 0};
    char *made = NULL;
    rt_error error;
    import->is_empty = import->shape_count == 0 && !import->has_camera && !import->has_light;
    if (import->shape_count == 0 && !import->is_empty)
        rt_import_note_at(import, 0, "the file has no shape that is read");
    if (!import->has_camera)
        add_camera(import);
    if (!import->has_light) {
        rt_import_note_addition(import, "the file has no light: an even white sky was added");
        rt_import_set_environment(import, 0, white, NULL, NULL);
    }
    rt_import_put_even_sky(import);
    if (import->width == 0)
        rt_import_set_film(import, 640, 480, NULL, 0);
    rt_import_put(import, &import->camera_block, "%s}",
                  import->hides_emitters ? "hide_emitters true\n" : "");
    sort_notes(import);
    put_notes(import, &whole);
    rt_import_settle_relative(import);
    const import_text *parts[] = {&import->camera_block, &import->settings, &import->definitions,
                                  &import->shapes, &import->lights};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        if (parts[i]->size)
            rt_import_put(import, &whole, "%s\n", parts[i]->text);
    if (!import->failed && rt_scene_format(&made, whole.text, NULL, NULL, &error) != RT_OK)
        rt_import_fail(import, 0, "%s", error.message);
    free(whole.text);
    return made;
}
