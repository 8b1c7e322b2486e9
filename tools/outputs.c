/* outputs.c - the image files of a command: planned, checked and written. */
#include "outputs.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

#include "message.h"
#include "status.h"

static const struct {
    const char *name;
    int is_8bit, has_layers;
} formats[] = {{".exr", 0, 1}, {".png", 1, 0}, {".ppm", 1, 0}, {".pfm", 0, 0}, {".rtpart", 0, 1}};

enum { FORMAT_COUNT = sizeof formats / sizeof formats[0] };

static const char *file_part(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

const char *outputs_extension(const char *path)
{
    const char *name = file_part(path), *dot = strrchr(name, '.');
    return dot && dot != name ? dot : "";
}

/* The index in formats, or -1. */
static int find_format(const char *path)
{
    for (int i = 0; i < FORMAT_COUNT; i++)
        if (strcasecmp(outputs_extension(path), formats[i].name) == 0)
            return i;
    return -1;
}

static int check_format(const char *path)
{
    if (find_format(path) >= 0)
        return STATUS_DONE;
    message_error("--out %s: the extension tells the format: .exr, .png, .ppm, .pfm or "
                  ".rtpart",
                  path);
    rt_nearest search;
    rt_nearest_begin(&search, outputs_extension(path), strlen(outputs_extension(path)));
    for (int i = 0; i < FORMAT_COUNT; i++)
        rt_nearest_offer(&search, formats[i].name, strlen(formats[i].name));
    if (search.best)
        message_hint("did you mean %s?", search.best);
    return STATUS_USAGE;
}

static int fail_output(const char *path, const char *cause)
{
    message_error("cannot write %s: %s", path, cause);
    return STATUS_OUTPUT;
}

static int has_directory(const char *path)
{
    char name[OUTPUT_PATH + 16];
    struct stat status;
    snprintf(name, sizeof name, "%.*s.", (int)(file_part(path) - path), path);
    return stat(name, &status) == 0;
}

/* Whether a new file can be made beside path: the image is written there first, then renamed. */
static int check_directory(const char *path)
{
    char name[OUTPUT_PATH + 48];
    int fd = -1;
    errno = EEXIST;
    /* To be written alone: an untrusted run may read nothing there. */
    for (int i = 0; i < 100 && fd < 0 && errno == EEXIST; i++) {
        snprintf(name, sizeof name, "%.*s.rtc-%ld-%d", (int)(file_part(path) - path), path,
                 (long)getpid(), i);
        fd = open(name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    }
    if (fd < 0)
        return fail_output(path, errno != ENOENT       ? strerror(errno)
                                 : has_directory(path) ? "no file can be made in its directory"
                                                       : "there is no such directory");
    close(fd);
    unlink(name);
    return STATUS_DONE;
}

int outputs_check_writable(const char *path)
{
    struct stat status;
    if (stat(path, &status) != 0)
        return errno == ENOENT ? check_directory(path) : fail_output(path, strerror(errno));
    if (S_ISDIR(status.st_mode))
        return fail_output(path, strerror(EISDIR));
    if (access(path, W_OK) != 0)
        return fail_output(path, strerror(errno));
    return S_ISREG(status.st_mode) ? check_directory(path) : STATUS_DONE;
}

/* ---- The plan ------------------------------------------------------------- */

static int add(output_list *out, const char *path, size_t stem, const char *suffix)
{
    if (stem + strlen(suffix) >= OUTPUT_PATH)
        return fail_output(path, strerror(ENAMETOOLONG));
    snprintf(out->paths[out->count++], OUTPUT_PATH, "%.*s%s", (int)stem, path, suffix);
    return STATUS_DONE;
}

static int add_defaults(output_list *out, const char *scene, uint32_t part, uint32_t parts)
{
    const char *name = strcmp(scene, "-") == 0 ? "stdin" : file_part(scene);
    char suffix[64];
    const char *const extension = outputs_extension(name);
    size_t stem = strlen(name);
    if ((strcmp(extension, ".rts") == 0 || rt_path_is_foreign(name)) && stem > strlen(extension))
        stem -= strlen(extension);
    if (parts > 1) {
        snprintf(suffix, sizeof suffix, ".%" PRIu32 "of%" PRIu32 ".rtpart", part, parts);
        return add(out, name, stem, suffix);
    }
    int status = add(out, name, stem, ".png");
    return status == STATUS_DONE ? add(out, name, stem, ".exr") : status;
}

/* Whether two paths are one file, which need not be there: of one name in one directory. */
static int is_same_output(const char *a, const char *b)
{
    char folders[2][OUTPUT_PATH];
    struct stat of_a, of_b;
    if (strcmp(file_part(a), file_part(b)) != 0)
        return 0;
    snprintf(folders[0], OUTPUT_PATH, "%.*s.", (int)(file_part(a) - a), a);
    snprintf(folders[1], OUTPUT_PATH, "%.*s.", (int)(file_part(b) - b), b);
    return strcmp(a, b) == 0 || (stat(folders[0], &of_a) == 0 && stat(folders[1], &of_b) == 0 &&
                                 of_a.st_dev == of_b.st_dev && of_a.st_ino == of_b.st_ino);
}

static int add_given(output_list *out, const command_line *arguments)
{
    for (size_t i = 0; i < arguments->output_count; i++) {
        const char *path = arguments->outputs[i];
        for (size_t j = 0; j < i; j++)
            if (is_same_output(path, arguments->outputs[j])) {
                message_error("--out %s is given twice", path);
                return STATUS_USAGE;
            }
        int status = check_format(path);
        if (status == STATUS_DONE)
            status = add(out, path, strlen(path), "");
        if (status != STATUS_DONE)
            return status;
    }
    return STATUS_DONE;
}

int outputs_plan(output_list *out, const command_line *arguments, const char *scene, uint32_t part,
                 uint32_t parts)
{
    out->count = 0;
    out->paths = malloc((arguments->output_count + 2) * sizeof *out->paths);
    if (!out->paths) {
        message_error("out of memory");
        return STATUS_DEVICE;
    }
    int status = arguments->output_count || !scene ? add_given(out, arguments)
                                                   : add_defaults(out, scene, part, parts);
    for (size_t i = 0; i < out->count && status == STATUS_DONE && parts > 1; i++)
        if (!outputs_is_film(out->paths[i])) {
            message_error("--out %s: a part of a picture goes to a film called NAME.rtpart",
                          out->paths[i]);
            message_hint("`rtc merge` makes images of all parts; --part 1/1 renders all of the "
                         "picture");
            status = STATUS_USAGE;
        }
    for (size_t i = 0; i < out->count && status == STATUS_DONE; i++)
        status = outputs_check_writable(out->paths[i]);
    return status;
}

void outputs_free(output_list *outputs)
{
    free(outputs->paths);
}

int outputs_is_film(const char *path)
{
    return strcasecmp(outputs_extension(path), ".rtpart") == 0;
}

size_t outputs_films(const output_list *outputs)
{
    size_t films = 0;
    for (size_t i = 0; i < outputs->count; i++)
        films += (size_t)outputs_is_film(outputs->paths[i]);
    return films;
}

int outputs_have_8bit(const output_list *outputs)
{
    for (size_t i = 0; i < outputs->count; i++)
        if (formats[find_format(outputs->paths[i])].is_8bit)
            return 1;
    return 0;
}

int outputs_have_layers(const output_list *outputs)
{
    for (size_t i = 0; i < outputs->count; i++)
        if (formats[find_format(outputs->paths[i])].has_layers)
            return 1;
    return 0;
}

int outputs_write(const output_list *outputs, const rt_film *film, const rt_image_options *options)
{
    int status = STATUS_DONE;
    for (size_t i = 0; i < outputs->count; i++) {
        rt_error error;
        rt_status written = outputs_is_film(outputs->paths[i])
                                ? rt_film_save(film, outputs->paths[i], &error)
                                : rt_film_write(film, outputs->paths[i], options, &error);
        if (written == RT_OK)
            continue;
        int now = message_failure(&error);
        status = status == STATUS_DONE ? now : status;
    }
    return status;
}
