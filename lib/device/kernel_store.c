/* kernel_store.c - packs a program's folder into one file, and unpacks it. */
#define _XOPEN_SOURCE 700 /* nftw */

#include "device/kernel_store.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "base/bytes.h"
#include "base/crc32.h"
#include "base/error.h"
#include "base/file.h"
#include "device/work_folder.h"

enum { STORED_MAX = 256 << 20, DEPTH_MAX = 8, KEPT_DAYS = 60, LOCK_TRIES = 100 };

static const char magic[8] = "RTKERN1\n";

/* ---- The files of a program ------------------------------------------------------------------ */

/* Calls visit for each regular file below root/path, but those that a driver still writes. */
typedef rt_status visit_file(void *user, const char *path, rt_error *error);

static int is_unfinished(const char *name)
{
    size_t length = strlen(name);
    return name[0] == '.' || (length > 5 && strcmp(name + length - 5, ".temp") == 0);
}

static rt_status walk(const char *root, const char *path, int depth, visit_file *visit, void *user,
                      rt_error *error)
{
    char full[RT_PATH_MAX], inner[RT_PATH_MAX];
    struct dirent *entry;
    struct stat info;
    rt_status status = RT_OK;
    if (depth == DEPTH_MAX || snprintf(full, sizeof full, "%s/%s", root, path) >= RT_PATH_MAX)
        return RT_OK;
    DIR *folder = opendir(full);
    if (!folder)
        return RT_OK;
    while (status == RT_OK && (entry = readdir(folder))) {
        const char *name = entry->d_name;
        if (is_unfinished(name) ||
            snprintf(inner, sizeof inner, "%s%s%s", path, *path ? "/" : "", name) >= RT_PATH_MAX ||
            snprintf(full, sizeof full, "%s/%s", root, inner) >= RT_PATH_MAX ||
            lstat(full, &info) != 0)
            continue;
        if (S_ISDIR(info.st_mode))
            status = walk(root, inner, depth + 1, visit, user, error);
        else if (S_ISREG(info.st_mode))
            status = visit(user, inner, error);
    }
    closedir(folder);
    return status;
}

static rt_status count_file(void *user, const char *path, rt_error *error)
{
    size_t *count = user;
    (void)path;
    (void)error;
    ++*count;
    return RT_OK;
}

size_t rt_stored_count(const char *work, const char *folder)
{
    char root[RT_PATH_MAX];
    size_t count = 0;
    if (snprintf(root, sizeof root, "%s/%s", work, folder) < RT_PATH_MAX)
        walk(root, "", 0, count_file, &count, NULL);
    return count;
}

/* ---- A stored program ------------------------------------------------------------------------ */

/* What is left to be read of a stored program. */
typedef struct unpacking {
    const uint8_t *at;
    size_t left;
} unpacking;

static int take(unpacking *u, void *out, size_t size)
{
    if (size > u->left)
        return 0;
    memcpy(out, u->at, size);
    u->at += size;
    u->left -= size;
    return 1;
}

static int take_block(unpacking *u, const uint8_t **out, uint32_t *size)
{
    if (!take(u, size, sizeof *size) || *size > u->left)
        return 0;
    *out = u->at;
    u->at += *size;
    u->left -= *size;
    return 1;
}

/* A relative path that stays below where it starts. */
static int take_path(unpacking *u, char *out, size_t size)
{
    const uint8_t *text;
    uint32_t length;
    if (!take_block(u, &text, &length) || length == 0 || length >= size || text[0] == '/')
        return 0;
    memcpy(out, text, length);
    out[length] = '\0';
    return strlen(out) == length && !strstr(out, "..");
}

/* Takes what comes before the files: which folder it is, and how many files. */
static int take_header(unpacking *u, char folder[RT_STORED_FOLDER_MAX], uint32_t *count,
                       uint64_t key)
{
    char start[sizeof magic];
    uint64_t found;
    return take(u, start, sizeof start) && memcmp(start, magic, sizeof magic) == 0 &&
           take(u, &found, sizeof found) && found == key &&
           take_path(u, folder, RT_STORED_FOLDER_MAX) && take(u, count, sizeof *count);
}

static rt_status fail_damaged(const char *path, rt_error *error)
{
    return rt_fail(error, RT_ERROR_INPUT, "the compiled kernels in %.350s are damaged", path);
}

/* Checks the checksum of a stored program, and leaves it out. */
static rt_status check(rt_bytes *bytes, const char *path, rt_error *error)
{
    uint32_t sum;
    if (bytes->size < sizeof sum)
        return fail_damaged(path, error);
    bytes->size -= sizeof sum;
    memcpy(&sum, bytes->data + bytes->size, sizeof sum);
    return rt_crc32(bytes->data, bytes->size) == sum ? RT_OK : fail_damaged(path, error);
}

/* ---- Writing --------------------------------------------------------------------------------- */

typedef struct packing {
    const char *root;
    rt_bytes bytes;
    size_t start; /* of the files in it, behind their number */
    uint32_t files;
} packing;

static rt_status put(rt_bytes *bytes, const void *data, size_t size, rt_error *error)
{
    return rt_bytes_put(bytes, bytes->size, data, size, error);
}

static rt_status put_text(rt_bytes *bytes, const void *data, size_t size, rt_error *error)
{
    uint32_t length = (uint32_t)size;
    rt_status status = put(bytes, &length, sizeof length, error);
    return status == RT_OK ? put(bytes, data, size, error) : status;
}

static int is_packed(const packing *p, const char *path)
{
    unpacking u = {p->bytes.data + p->start, p->bytes.size - p->start};
    const size_t length = strlen(path);
    const uint8_t *name, *content;
    uint32_t name_size, size;
    while (take_block(&u, &name, &name_size) && take_block(&u, &content, &size))
        if (name_size == length && memcmp(name, path, length) == 0)
            return 1;
    return 0;
}

static rt_status pack_file(void *user, const char *path, rt_error *error)
{
    packing *p = user;
    rt_bytes content = {0};
    char full[RT_PATH_MAX];
    if (is_packed(p, path))
        return RT_OK;
    if (snprintf(full, sizeof full, "%s/%s", p->root, path) >= RT_PATH_MAX)
        return rt_fail(error, RT_ERROR_OUTPUT, "the path of a compiled kernel is too long");
    rt_status status = rt_file_read(&content, full, STORED_MAX, error);
    if (status == RT_OK)
        status = put_text(&p->bytes, path, strlen(path), error);
    if (status == RT_OK)
        status = put_text(&p->bytes, content.data, content.size, error);
    p->files++;
    rt_bytes_free(&content);
    return status;
}

/*
 * Begins with what is stored already: what other processes compiled of the program, for work-groups
 * of other sizes too. False where there is nothing, or it is damaged.
 */
static int begin_with_stored(packing *p, const char *path, uint64_t key)
{
    char folder[RT_STORED_FOLDER_MAX];
    if (access(path, F_OK) == 0 && rt_file_read(&p->bytes, path, STORED_MAX, NULL) == RT_OK &&
        check(&p->bytes, path, NULL) == RT_OK) {
        unpacking u = {p->bytes.data, p->bytes.size};
        if (take_header(&u, folder, &p->files, key)) {
            p->start = (size_t)(u.at - p->bytes.data);
            return 1;
        }
    }
    rt_bytes_free(&p->bytes);
    return 0;
}

static rt_status begin_anew(packing *p, uint64_t key, const char *folder, rt_error *error)
{
    rt_status status = put(&p->bytes, magic, sizeof magic, error);
    p->files = 0;
    if (status == RT_OK)
        status = put(&p->bytes, &key, sizeof key, error);
    if (status == RT_OK)
        status = put_text(&p->bytes, folder, strlen(folder), error);
    if (status == RT_OK)
        status = put(&p->bytes, &p->files, sizeof p->files, error);
    p->start = p->bytes.size;
    return status;
}

/*
 * Locks the folder that a path is in, from reading what is stored there until it is replaced; waits
 * half a second at most. Without the lock one of two processes compiles again, no more. Returns a
 * descriptor to be closed, or -1.
 */
static int lock_folder(const char *path)
{
    const struct timespec pause = {0, 5000000};
    char folder[RT_PATH_MAX];
    const char *slash = strrchr(path, '/');
    snprintf(folder, sizeof folder, "%.*s", slash ? (int)(slash - path) + 1 : 1,
             slash ? path : ".");
    int fd = open(folder, O_RDONLY | O_CLOEXEC);
    for (int i = 0; fd >= 0 && i < LOCK_TRIES && flock(fd, LOCK_EX | LOCK_NB) != 0; i++)
        nanosleep(&pause, NULL);
    return fd;
}

rt_status rt_stored_write(const char *path, uint64_t key, const char *work, const char *folder,
                          rt_error *error)
{
    char root[RT_PATH_MAX];
    packing p = {.root = root};
    rt_status status = RT_OK;
    if (snprintf(root, sizeof root, "%s/%s", work, folder) >= RT_PATH_MAX)
        return rt_fail(error, RT_ERROR_OUTPUT, "the path of a compiled kernel is too long");
    int lock = lock_folder(path);
    if (!begin_with_stored(&p, path, key))
        status = begin_anew(&p, key, folder, error);
    if (status == RT_OK)
        status = walk(root, "", 0, pack_file, &p, error);
    if (status != RT_OK)
        goto out;
    memcpy(p.bytes.data + p.start - sizeof p.files, &p.files, sizeof p.files);
    uint32_t sum = rt_crc32(p.bytes.data, p.bytes.size);
    status = put(&p.bytes, &sum, sizeof sum, error);
    if (status == RT_OK)
        status = rt_file_replace(path, &p.bytes, error);
out:
    if (lock >= 0)
        close(lock);
    rt_bytes_free(&p.bytes);
    return status;
}

/* ---- Reading --------------------------------------------------------------------------------- */

/* Writes one file below root. Returns 0, or the errno. */
static int unpack_file(const char *root, const char *path, const uint8_t *data, size_t size)
{
    char full[RT_PATH_MAX];
    if (snprintf(full, sizeof full, "%s/%s", root, path) >= RT_PATH_MAX)
        return ENAMETOOLONG;
    char *slash = strrchr(full, '/');
    *slash = '\0';
    int code = rt_folder_make(full);
    *slash = '/';
    if (code)
        return code;
    int fd = open(full, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    if (fd < 0)
        return errno;
    while (!code && size > 0) {
        ssize_t done = write(fd, data, size);
        if (done < 0 && errno != EINTR)
            code = errno;
        else if (done > 0) {
            data += done;
            size -= (size_t)done;
        }
    }
    if (close(fd) != 0 && !code)
        code = errno;
    return code;
}

static rt_status unpack(char folder[RT_STORED_FOLDER_MAX], size_t *files, unpacking u,
                        const char *path, uint64_t key, const char *work, rt_error *error)
{
    char root[RT_PATH_MAX], inner[RT_PATH_MAX];
    const uint8_t *content;
    uint32_t size, count;
    if (!take_header(&u, folder, &count, key) ||
        snprintf(root, sizeof root, "%s/%s", work, folder) >= RT_PATH_MAX)
        return fail_damaged(path, error);
    for (uint32_t i = 0; i < count; i++) {
        if (!take_path(&u, inner, sizeof inner) || !take_block(&u, &content, &size))
            return fail_damaged(path, error);
        char cause[RT_CAUSE_SIZE];
        int code = unpack_file(root, inner, content, size);
        if (code)
            return rt_fail(error, RT_ERROR_OUTPUT,
                           "compiled kernels cannot be unpacked into %.300s: %s", work,
                           rt_cause(cause, code));
    }
    *files = count;
    return u.left == 0 ? RT_OK : fail_damaged(path, error);
}

static void remove_unpacked(const char *work, const char *folder)
{
    char root[RT_PATH_MAX];
    if (*folder && snprintf(root, sizeof root, "%s/%s", work, folder) < RT_PATH_MAX)
        rt_folder_remove(root);
}

/* Says that a stored program is in use, once a day; by descriptor, as untrusted runs must. */
static void touch(const char *path)
{
    struct stat info;
    const int fd = open(path, O_RDONLY | O_CLOEXEC);
    if (fd < 0)
        return;
    if (fstat(fd, &info) == 0 && difftime(time(NULL), info.st_mtime) > 86400)
        futimens(fd, NULL);
    close(fd);
}

rt_status rt_stored_read(char folder[RT_STORED_FOLDER_MAX], size_t *files, const char *path,
                         uint64_t key, const char *work, rt_error *error)
{
    rt_bytes bytes = {0};
    struct stat info;
    folder[0] = '\0';
    *files = 0;
    if (stat(path, &info) != 0 && (errno == ENOENT || errno == ENOTDIR))
        return RT_OK;
    rt_status status = rt_file_read(&bytes, path, STORED_MAX, error);
    const int is_read = status == RT_OK;
    if (status == RT_OK)
        status = check(&bytes, path, error);
    if (status == RT_OK)
        status = unpack(folder, files, (unpacking){bytes.data, bytes.size}, path, key, work, error);
    if (status == RT_OK)
        touch(path);
    else
        remove_unpacked(work, folder);
    /* What fails otherwise, as where memory or descriptors are short, says nothing against it. */
    if (is_read && status == RT_ERROR_INPUT)
        unlink(path);
    rt_bytes_free(&bytes);
    return status;
}

void rt_stored_clean(const char *store)
{
    struct dirent *entry;
    struct stat info;
    char path[RT_PATH_MAX];
    DIR *folder = opendir(store);
    if (!folder)
        return;
    while ((entry = readdir(folder))) {
        const char *end = strrchr(entry->d_name, '.');
        if (end && strcmp(end, RT_STORED_SUFFIX) == 0 &&
            snprintf(path, sizeof path, "%s/%s", store, entry->d_name) < RT_PATH_MAX &&
            lstat(path, &info) == 0 && S_ISREG(info.st_mode) &&
            difftime(time(NULL), info.st_mtime) > KEPT_DAYS * 86400.0)
            unlink(path);
    }
    closedir(folder);
}
