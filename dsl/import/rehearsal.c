/* rehearsal.c - the folder in which an import is tried. */
#define _XOPEN_SOURCE 700 /* lstat, mkdir, mkdtemp, openat */
#include "dsl/import/rehearsal.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "dsl/import/import.h"

/* Bytes of a scene's name in that of the folder, which has to be a name as well. */
enum { LONGEST = 200 };

int rt_import_is_there(const char *out)
{
    struct stat entry;
    char *files = rt_import_files_path(out);
    const int is_there =
        lstat(out, &entry) == 0 || !files || lstat(files, &entry) == 0; /* or it fails later */
    free(files);
    return is_there;
}

/* Opens a folder, and no link to one; -1: it is none. */
static int open_folder(int in, const char *name)
{
    return openat(in, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
}

/* Removes a folder of files, or what else has its name. */
static void remove_files(int in, const char *name)
{
    const int fd = open_folder(in, name);
    DIR *files = fd >= 0 ? fdopendir(fd) : NULL;
    for (const struct dirent *entry; files && (entry = readdir(files)) != NULL;)
        unlinkat(fd, entry->d_name, 0); /* fails for "." and "..", which is harmless */
    if (files)
        closedir(files);
    else if (fd >= 0)
        close(fd);
    if (unlinkat(in, name, AT_REMOVEDIR) != 0)
        unlinkat(in, name, 0);
}

static const char *base_name(const char *path)
{
    return strrchr(path, '/') + 1; /* within the folder, so that there is one */
}

/* Removes what an import makes in the folder, and the folder itself; links are not followed. */
static void clean(const import_rehearsal *rehearsal)
{
    const int folder = open_folder(AT_FDCWD, rehearsal->folder);
    struct stat entry;
    if (folder < 0) {
        if (lstat(rehearsal->folder, &entry) == 0 && S_ISLNK(entry.st_mode))
            unlink(rehearsal->folder);
        return;
    }
    remove_files(folder, base_name(rehearsal->files));
    unlinkat(folder, base_name(rehearsal->scene), 0);
    close(folder);
    rmdir(rehearsal->folder);
}

rt_status rt_import_rehearsal_begin(import_rehearsal *out, const char *scene, rt_error *error)
{
    const char *slash = strrchr(scene, '/'), *name = slash ? slash + 1 : scene;
    const int above = (int)(name - scene);
    const size_t size = 2 * strlen(scene) + sizeof "..import/";
    char cause[IMPORT_CAUSE];
    *out = (import_rehearsal){.folder = malloc(size), .scene = malloc(size)};
    if (out->folder && out->scene) {
        snprintf(out->folder, size, "%.*s.%.*s.import", above, scene, LONGEST, name);
        snprintf(out->scene, size, "%s/%s", out->folder, name);
        out->files = rt_import_files_path(out->scene);
    }
    if (!out->files) {
        rt_import_rehearsal_end(out);
        return rt_import_set_error(error, RT_ERROR_MEMORY, "out of memory");
    }
    clean(out);
    if (mkdir(out->folder, 0777) == 0)
        return RT_OK;
    rt_import_set_error(error, RT_ERROR_OUTPUT, "cannot make the folder %.300s: %s", out->folder,
                        rt_import_cause(cause, errno));
    rt_import_rehearsal_end(out);
    return RT_ERROR_OUTPUT;
}

rt_status rt_import_rehearsal_elsewhere(import_rehearsal *out, const char *folder, rt_error *error)
{
    static const char name[] = "/rt-XXXXXX";
    const char *const above = folder ? folder : "/tmp";
    const size_t size = strlen(above) + sizeof name + sizeof "/scene.rts";
    char cause[IMPORT_CAUSE];
    if (strpbrk(above, "\"\n\r"))
        return rt_import_set_error(error, RT_ERROR_OUTPUT,
                                   "%.300s: a scene cannot name files by a path with quotes or "
                                   "line ends",
                                   above);
    *out = (import_rehearsal){.folder = malloc(size), .scene = malloc(size)};
    if (out->folder && out->scene) {
        snprintf(out->folder, size, "%s%s", above, name);
        if (!mkdtemp(out->folder)) {
            rt_import_set_error(error, RT_ERROR_OUTPUT, "cannot make a folder in %.300s: %s", above,
                                rt_import_cause(cause, errno));
            rt_import_rehearsal_end(out);
            return RT_ERROR_OUTPUT;
        }
        snprintf(out->scene, size, "%s/scene.rts", out->folder);
        out->files = rt_import_files_path(out->scene);
        if (!out->files)
            rmdir(out->folder);
    }
    if (out->files)
        return RT_OK;
    rt_import_rehearsal_end(out);
    return rt_import_set_error(error, RT_ERROR_MEMORY, "out of memory");
}

void rt_import_rehearsal_end(import_rehearsal *rehearsal)
{
    if (rehearsal->files)
        clean(rehearsal);
    free(rehearsal->folder);
    free(rehearsal->scene);
    free(rehearsal->files);
}
