/* files.c - files that an import reads and writes. */
#define _XOPEN_SOURCE 700 /* mkdir */
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

#include "dsl/import/import.h"
#include "rt.h"

#define WRITTEN_MAX ((size_t)16 << 30)

static char *join(const char *folder, const char *name)
{
    char *path = malloc(strlen(folder) + strlen(name) + 1);
    if (path)
        sprintf(path, "%s%s", name[0] == '/' ? "" : folder, name);
    return path;
}

/*
 * The path of a file that the scene names, to be freed: in the folder that was added last of those
 * where it is there, or else in the folder of the scene. NULL without memory.
 */
static char *path_as_named(const importer *import, const char *name)
{
    struct stat entry;
    for (size_t i = name[0] == '/' ? 0 : import->search_count; i-- > 0;) {
        char *path = join(import->search[i], name);
        if (!path || stat(path, &entry) == 0)
            return path;
        free(path);
    }
    return join(import->folder, name);
}

/* The path of a file beside the one that names it; NULL where there is none, or without memory. */
static char *path_beside_place(const importer *import, const char *name)
{
    struct stat entry;
    const char *const from = import->place.file;
    const char *const slash = from && name[0] != '/' ? strrchr(from, '/') : NULL;
    char *const path = slash ? path_as_named(import, from) : NULL;
    char *const end = path ? strrchr(path, '/') + 1 : NULL;
    char *beside = NULL;
    if (end) {
        *end = '\0';
        beside = join(path, name);
    }
    free(path);
    if (beside && stat(beside, &entry) == 0)
        return beside;
    free(beside);
    return NULL;
}

/* As path_as_named; where nothing is there, beside the file that names it. */
static char *path_of_slashes(const importer *import, const char *name)
{
    struct stat entry;
    char *const path = path_as_named(import, name);
    char *const beside = path && stat(path, &entry) != 0 ? path_beside_place(import, name) : NULL;
    if (!beside)
        return path;
    free(path);
    return beside;
}

/* The same; the backslashes of a name by which there is no file are slashes, as on Windows. */
static char *path_of(const importer *import, const char *name)
{
    struct stat entry;
    char *path = path_of_slashes(import, name);
    char *slashes = path && strchr(name, '\\') && stat(path, &entry) != 0 ? strdup(name) : NULL;
    if (!slashes)
        return path;
    for (char *at = slashes; (at = strchr(at, '\\')) != NULL;)
        *at = '/';
    free(path);
    path = path_of_slashes(import, slashes);
    free(slashes);
    return path;
}

/* Whether it is a folder, and one in which files may be read. */
static int is_folder(const importer *import, const char *path)
{
    struct stat entry;
    return (!import->root || rt_path_is_within(import->root, path)) && stat(path, &entry) == 0 &&
           S_ISDIR(entry.st_mode);
}

/* A folder by its name, relative to that of a file; to be freed, NULL without memory. */
static char *folder_beside(const char *file, const char *name)
{
    const char *const slash = name[0] == '/' ? NULL : strrchr(file, '/');
    const int length = slash ? (int)(slash - file) + 1 : 0;
    char *path = malloc((size_t)length + strlen(name) + 2);
    if (path)
        sprintf(path, "%.*s%s/", length, file, name);
    return path;
}

int rt_import_search(importer *import, int line, const char *file, const char *folder)
{
    if (import->search_count == IMPORT_SEARCH_MAX)
        return rt_import_fail(import, line, "more than %d folders to search", IMPORT_SEARCH_MAX);
    char *const from = file ? path_of(import, file) : NULL, *const other = path_of(import, folder);
    char *const paths[] = {folder_beside(from ? from : import->path, folder),
                           other ? folder_beside("", other) : NULL};
    int is_known = 0;
    for (int i = 0; i < 2; i++)
        if (!paths[i]) {
            rt_import_fail_memory(import);
        } else if (!is_known && is_folder(import, paths[i])) {
            is_known = 1;
            import->search[import->search_count++] = paths[i];
        } else {
            free(paths[i]);
        }
    free(from);
    free(other);
    return is_known;
}

int rt_import_has_file(const importer *import, const char *name)
{
    struct stat entry;
    char *path = path_of(import, name);
    const int is_there = path && (!import->root || rt_path_is_within(import->root, path)) &&
                         stat(path, &entry) == 0 && S_ISREG(entry.st_mode);
    free(path);
    return is_there;
}

/* Whether there is a folder, a device or the like of that name. */
static int is_something(const importer *import, const char *name)
{
    struct stat entry;
    char *path = path_of(import, name);
    const int is_there =
        path && (!import->root || rt_path_is_within(import->root, path)) && stat(path, &entry) == 0;
    free(path);
    return is_there;
}

int rt_import_find(importer *import, int line, const char *name, const char *what)
{
    if (import->failed || rt_import_has_file(import, name))
        return !import->failed;
    rt_import_note_at(import, line, "'%.100s' is %s%s: %s is left out", name,
                      is_something(import, name) ? "no file" : "not there",
                      import->root ? ", or outside of the scene's folder" : "", what);
    return 0;
}

char *rt_import_resolve(importer *import, int line, const char *name)
{
    char *path = path_of(import, name);
    if (!path) {
        rt_import_fail_memory(import);
        return NULL;
    }
    if (import->root && !rt_path_is_within(import->root, path)) {
        rt_import_fail(import, line, "'%.100s' is not there, or outside of the scene's folder",
                       name);
        free(path);
        return NULL;
    }
    return path;
}

char *rt_import_read(importer *import, int line, const char *name, size_t *size)
{
    rt_error error;
    char *bytes = NULL, *path = import->failed ? NULL : rt_import_resolve(import, line, name);
    if (!path)
        return NULL;
    if (rt_file_load(&bytes, size, path, IMPORT_FILE_MAX - import->bytes_read, &error) == RT_OK) {
        import->bytes_read += *size;
        if (import->on_file)
            import->on_file(import->file_user, path);
    } else {
        rt_import_fail(import, line, "%s", error.message);
    }
    free(import->read);
    import->read = path;
    return bytes;
}

char *rt_import_read_text(importer *import, int line, const char *name, size_t *size)
{
    char *text = rt_import_read(import, line, name, size);
    const size_t mark = text ? rt_byte_order_mark(text, *size) : 0;
    if (mark) {
        *size -= mark;
        memmove(text, text + mark, *size + 1);
    }
    return text;
}

void rt_import_keep_copy(importer *import, const char out[512])
{
    import_copies *const copies = &import->copies;
    const char *const path = import->read ? import->read : import->path;
    if (import->is_dry)
        return;
    struct import_copy *const moved =
        rt_import_grow(import, copies->items, copies->count, sizeof *moved);
    copies->items = moved ? moved : copies->items;
    char *const name = malloc(strlen(out) + 1), *const from = malloc(strlen(path) + 1);
    if (!moved || !name || !from) {
        free(name);
        free(from);
        rt_import_fail_memory(import);
        return;
    }
    copies->items[copies->count++] = (struct import_copy){strcpy(name, out), strcpy(from, path)};
}

void rt_import_copies_free(import_copies *copies)
{
    for (size_t i = 0; i < copies->count; i++) {
        free(copies->items[i].name);
        free(copies->items[i].from);
    }
    free(copies->items);
    *copies = (import_copies){NULL, 0};
}

/* Keeps the path of a file that is about to be made; returns 0 after a failure. */
static int keep_path(importer *import, const char *path)
{
    struct stat entry;
    if (lstat(path, &entry) == 0) {
        if (S_ISREG(entry.st_mode))
            return 1;
        import->is_output = 1;
        return rt_import_fail(import, 0, "%.200s is there, and not a regular file", path);
    }
    if ((import->made_count & (import->made_count - 1)) == 0) {
        size_t grown = import->made_count ? 2 * import->made_count : 1;
        char **moved = realloc(import->made, grown * sizeof *moved);
        if (!moved)
            return rt_import_fail_memory(import);
        import->made = moved;
    }
    char *copy = malloc(strlen(path) + 1);
    if (!copy)
        return rt_import_fail_memory(import);
    import->made[import->made_count++] = strcpy(copy, path);
    return 1;
}

void rt_import_remove_files(importer *import)
{
    for (size_t i = 0; i < import->made_count; i++)
        unlink(import->made[i]);
    if (import->has_made_folder)
        rmdir(import->files_path);
}

/* Makes the folder of the files; returns 0 after a failure. */
static int make_folder(importer *import)
{
    struct stat entry;
    char cause[IMPORT_CAUSE];
    if (mkdir(import->files_path, 0777) == 0) {
        import->has_made_folder = 1;
        return 1;
    }
    if (errno != EEXIST) {
        import->is_output = 1;
        return rt_import_fail(import, 0, "cannot make the folder %.200s: %s", import->files_path,
                              rt_import_cause(cause, errno));
    }
    if (lstat(import->files_path, &entry) == 0 && S_ISDIR(entry.st_mode))
        return 1;
    import->is_output = 1;
    return rt_import_fail(import, 0, "%.200s is there, and not a folder", import->files_path);
}

/* Without the wait for the disk that what stays is worth; returns errno, or 0. */
static int write_passing(const char *path, const void *bytes, size_t size)
{
    const int fd = open(path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    FILE *const file = fd >= 0 ? fdopen(fd, "wb") : NULL;
    int code = file && fwrite(bytes, 1, size, file) == size ? 0 : errno;
    if (file && fclose(file) != 0 && !code)
        code = errno;
    if (fd >= 0 && !file)
        close(fd);
    return code;
}

/* Writes a file into the folder of this import. */
static int write_file(importer *import, const char *path, const void *bytes, size_t size)
{
    char cause[IMPORT_CAUSE];
    rt_error error;
    const int is_first = !import->has_written;
    import->is_output = 1; /* which a failure is of */
    if (import->is_passing) {
        const int code = write_passing(path, bytes, size);
        if (code)
            rt_import_fail(import, 0, "cannot write %.300s: %s", path,
                           rt_import_cause(cause, code));
    } else if ((is_first ? rt_file_write : rt_file_write_another)(path, bytes, size, &error) !=
               RT_OK) {
        rt_import_fail(import, 0, "%s", error.message);
    }
    import->is_output = import->failed;
    import->has_written = 1;
    return !import->failed;
}

int rt_import_write(importer *import, char out[512], const char *base, const char *extension,
                    const void *bytes, size_t size)
{
    int handle = rt_import_name(import, base);
    if (import->failed)
        return 0;
    snprintf(out, 512, "%.300s/%s%s", import->files, rt_import_label(import, handle), extension);
    import->bytes_written += size;
    if (import->bytes_written > WRITTEN_MAX)
        return rt_import_fail(import, 0, "its meshes and images are larger than 16 GiB together");
    if (import->is_dry)
        return 1;
    if (!make_folder(import))
        return 0;
    size_t length = strlen(import->files_path) + strlen(out) + 8;
    char *path = malloc(length);
    if (!path)
        return rt_import_fail_memory(import);
    snprintf(path, length, "%s/%s%s", import->files_path, rt_import_label(import, handle),
             extension);
    if (keep_path(import, path))
        write_file(import, path, bytes, size);
    free(path);
    return !import->failed;
}

/* Whether an image that was written as `out` can be decoded; it is told where not. */
static int is_sound(importer *import, int line, const char *out, const char *base)
{
    const char *const slash = strrchr(out, '/');
    const size_t length = strlen(import->files_path) + strlen(slash) + 1;
    char text[300], *path = malloc(length);
    rt_image *image = NULL;
    rt_error error;
    if (!path)
        return rt_import_fail_memory(import);
    snprintf(path, length, "%s%s", import->files_path, slash);
    const rt_status status = rt_image_read(&image, path, &error);
    const char *const named = strstr(error.message, path);
    rt_image_destroy(image);
    if (status != RT_OK)
        snprintf(text, sizeof text, "the image %.100s is left out%.150s", base,
                 named ? named + strlen(path) : ": it cannot be read");
    free(path);
    if (status == RT_ERROR_INPUT)
        rt_import_note_damage(import, line, text);
    else if (status != RT_OK)
        rt_import_fail(import, line, "%s", error.message);
    return status == RT_OK;
}

int rt_import_image_bytes(importer *import, int line, char out[512], const char *base,
                          const void *bytes, size_t size)
{
    static const char names[] = RT_IMAGE_FORMATS(RT_IMAGE_NAME); /* ", EXR, PNG" */
    const char *const known = rt_image_extensions(bytes, size);
    char extension[16];
    if (known) {
        snprintf(extension, sizeof extension, "%.*s", (int)strcspn(known, " "), known);
        import->image_count++;
        return rt_import_write(import, out, base, extension, bytes, size) &&
               (!import->checks_images || import->is_dry || is_sound(import, line, out, base));
    }
    rt_import_note_at(import, line, "the image %.100s is left out: none of the formats %s", base,
                      names + 2);
    return 0;
}

int rt_import_image_has_alpha(const void *bytes, size_t size)
{
    const unsigned char *at = bytes, *const end = at + size;
    if (size > 12 && memcmp(at, "qoif", 4) == 0)
        return at[12] == 4; /* its channels */
    if (size < 33 || memcmp(at, "\x89PNG", 4) != 0)
        return 0;
    if (at[25] & 4) /* its colour type */
        return 1;
    for (at += 8; end - at >= 12 && memcmp(at + 4, "IDAT", 4) != 0;) {
        const size_t length =
            (size_t)at[0] << 24 | (size_t)at[1] << 16 | (size_t)at[2] << 8 | at[3];
        if (memcmp(at + 4, "tRNS", 4) == 0)
            return 1;
        if (length > (size_t)(end - at) - 12)
            return 0;
        at += length + 12;
    }
    return 0;
}

int rt_import_file_has_alpha(importer *import, const char *name)
{
    size_t size;
    char *bytes = rt_import_read(import, 0, name, &size);
    const int has_alpha = bytes && rt_import_image_has_alpha(bytes, size);
    free(bytes);
    return has_alpha;
}

static int has_openings(importer *import, const rt_image *image)
{
    uint32_t width, height;
    rt_error error;
    rt_image_get_size(image, &width, &height);
    const size_t values = 3 * (size_t)width * height;
    float *const alpha = malloc(values * sizeof *alpha);
    if (!alpha)
        rt_import_fail_memory(import);
    size_t i = 0;
    if (alpha && rt_image_get_rgb(alpha, image, "A", &error) == RT_OK)
        while (i < values && alpha[i] == 1)
            i++;
    else
        i = values;
    free(alpha);
    return i < values;
}

int rt_import_alpha_counts(importer *import, int line, const char *name)
{
    rt_image *image = NULL;
    rt_error error;
    char *const path = rt_import_resolve(import, line, name);
    const int is_open =
        path && rt_image_read(&image, path, &error) == RT_OK && has_openings(import, image);
    rt_image_destroy(image);
    free(path);
    return is_open;
}

int rt_import_image_file(importer *import, int line, char out[512], const char *name)
{
    size_t size;
    if (!rt_import_find(import, line, name, "the image"))
        return 0;
    char *bytes = rt_import_read(import, line, name, &size);
    const char *slash = strrchr(name, '/');
    int is_there =
        bytes && rt_import_image_bytes(import, line, out, slash ? slash + 1 : name, bytes, size);
    if (is_there)
        rt_import_keep_copy(import, out);
    free(bytes);
    return is_there;
}
