/* file.c - reads whole files, and replaces them so that no reader sees half of one. */
#define _XOPEN_SOURCE 700 /* realpath */

#include "base/file.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/claim.h"

#define READ_CHUNK 65536u

/* Reports errno for path. The precision keeps the cause in the message, however long the path. */
static rt_status fail_errno(rt_error *error, rt_status status, const char *verb, const char *path,
                            int code)
{
    char cause[RT_CAUSE_SIZE];
    return rt_at_file(
        rt_fail(error, status, "cannot %s %.350s: %s", verb, path, rt_cause(cause, code)), path,
        error);
}

/* Reads on until there are `most` bytes, or to the end of the file. */
static rt_status read_up_to(rt_bytes *bytes, int fd, const char *path, size_t most, rt_error *error)
{
    uint8_t chunk[READ_CHUNK];
    while (bytes->size < most) {
        size_t left = most - bytes->size;
        ssize_t count = read(fd, chunk, left < sizeof chunk ? left : sizeof chunk);
        if (count < 0 && errno == EINTR)
            continue;
        if (count < 0)
            return fail_errno(error, RT_ERROR_INPUT, "read", path, errno);
        if (count == 0)
            return RT_OK;
        rt_status status = rt_bytes_put(bytes, bytes->size, chunk, (size_t)count, error);
        if (status != RT_OK)
            return status;
    }
    return RT_OK;
}

/* Reads to the end of the file, which is refused when it has more than limit bytes. */
static rt_status read_all(rt_bytes *bytes, int fd, const char *path, size_t limit, rt_error *error)
{
    rt_status status = read_up_to(bytes, fd, path, limit + 1, error);
    if (status == RT_OK && bytes->size > limit)
        return rt_fail(error, RT_ERROR_INPUT, "cannot read %.350s: it is larger than %zu bytes",
                       path, limit);
    return status;
}

rt_status rt_file_read(rt_bytes *out, const char *path, size_t limit, rt_error *error)
{
    if (rt_is_missing(path, "path", error))
        return RT_ERROR_USAGE;
    int fd = open(path, O_RDONLY | O_CLOEXEC);
    if (fd < 0)
        return fail_errno(error, RT_ERROR_INPUT, "read", path, errno);
    rt_bytes bytes = {.memory = out->memory};
    rt_status status = read_all(&bytes, fd, path, limit, error);
    if (status != RT_OK)
        goto out;
    *out = bytes;
    bytes = (rt_bytes){0};
out:
    close(fd);
    rt_bytes_free(&bytes);
    return rt_at_file(status, path, error);
}

rt_status rt_file_check_regular(const char *path, rt_error *error)
{
    struct stat info;
    if (stat(path, &info) == 0 && !S_ISREG(info.st_mode))
        return rt_at_file(
            rt_fail(error, RT_ERROR_INPUT, "cannot read %.350s: it is not a regular file", path),
            path, error);
    return RT_OK;
}

rt_status rt_file_load(char **out, size_t *size, const char *path, size_t limit, rt_error *error)
{
    static const char end = '\0';
    const int is_stdin = path && strcmp(path, "-") == 0;
    rt_bytes bytes = {0};
    rt_status status = rt_is_missing(path, "path", error) ? RT_ERROR_USAGE
                       : is_stdin ? read_all(&bytes, STDIN_FILENO, "stdin", limit, error)
                                  : rt_file_check_regular(path, error);
    if (status == RT_OK && !is_stdin)
        status = rt_file_read(&bytes, path, limit, error);
    if (status == RT_OK)
        status = rt_bytes_put(&bytes, bytes.size, &end, 1, error);
    if (status != RT_OK) {
        rt_bytes_free(&bytes);
        return status;
    }
    *size = bytes.size - 1;
    *out = (char *)bytes.data;
    return RT_OK;
}

/* By how much a file is longer than its header announces, where a regular file tells. */
static rt_status fail_longer(int fd, const char *path, uint64_t announced, rt_error *error)
{
    struct stat info;
    if (fstat(fd, &info) == 0 && S_ISREG(info.st_mode) && (uint64_t)info.st_size > announced)
        return rt_fail(
            error, RT_ERROR_INPUT,
            "cannot read %.350s: it has %llu byte%s more than the %llu that its header announces",
            path, (unsigned long long)((uint64_t)info.st_size - announced),
            (uint64_t)info.st_size - announced == 1 ? "" : "s", (unsigned long long)announced);
    return rt_fail(error, RT_ERROR_INPUT,
                   "cannot read %.350s: it has more bytes than the %llu that its header announces",
                   path, (unsigned long long)announced);
}

/*
 * Fails at once where a file that is as long as it announces does not fit into memory with its
 * copies; a shorter one fails otherwise.
 */
static rt_status foresee(const rt_bytes *bytes, int fd, double announced, uint32_t copies,
                         rt_error *error)
{
    struct stat info;
    if (fstat(fd, &info) != 0 || !S_ISREG(info.st_mode) || (double)info.st_size < announced)
        return RT_OK;
    return rt_memory_foresee(bytes->memory, announced * (1.0 + copies) - (double)bytes->capacity,
                             copies ? "reading a file" : rt_bytes_owner, error);
}

rt_status rt_file_read_sized(rt_bytes *out, const char *path, size_t header, rt_file_size *size_of,
                             uint32_t copies, rt_error *error)
{
    if (rt_is_missing(path, "path", error))
        return RT_ERROR_USAGE;
    uint64_t announced = 0;
    int fd = open(path, O_RDONLY | O_CLOEXEC);
    if (fd < 0)
        return fail_errno(error, RT_ERROR_INPUT, "read", path, errno);
    rt_bytes bytes = {.memory = out->memory};
    rt_status status = read_up_to(&bytes, fd, path, header, error);
    if (status != RT_OK)
        goto out;
    status = size_of(&announced, bytes.data, bytes.size, path, error);
    if (status == RT_OK)
        status = foresee(&bytes, fd, (double)announced, copies, error);
    if (status != RT_OK)
        goto out;
    status = read_up_to(&bytes, fd, path,
                        announced < SIZE_MAX / 2 ? (size_t)announced + 1 : SIZE_MAX / 2, error);
    if (status != RT_OK)
        goto out;
    if (bytes.size > announced) {
        status = fail_longer(fd, path, announced, error);
        goto out;
    }
    *out = bytes;
    bytes = (rt_bytes){0};
out:
    close(fd);
    rt_bytes_free(&bytes);
    return rt_at_file(status, path, error);
}

rt_status rt_file_read_stream(rt_bytes *out, int fd, const char *name, size_t header,
                              rt_file_size *size_of, rt_error *error)
{
    uint64_t announced = 0;
    rt_bytes bytes = {.memory = out->memory};
    rt_status status = read_up_to(&bytes, fd, name, header, error);
    if (status == RT_OK && bytes.size == 0)
        status = rt_fail(error, RT_ERROR_INPUT, "%.350s ended before anything came", name);
    if (status == RT_OK)
        status = size_of(&announced, bytes.data, bytes.size, name, error);
    if (status == RT_OK)
        status = read_up_to(&bytes, fd, name,
                            announced < SIZE_MAX / 2 ? (size_t)announced : SIZE_MAX / 2, error);
    if (status == RT_OK)
        *out = bytes;
    else
        rt_bytes_free(&bytes);
    return status;
}

/* The functions below return 0, or the errno of what failed. */

int rt_file_put(int fd, const void *data, size_t size)
{
    const uint8_t *at = data;
    while (size > 0) {
        ssize_t count = write(fd, at, size);
        if (count < 0 && errno == EINTR)
            continue;
        if (count < 0)
            return errno;
        at += count;
        size -= (size_t)count;
    }
    return 0;
}

/* What is to be in a file. */
typedef struct content {
    rt_file_content *put;
    const void *user;
    int is_another; /* the folder was cleaned before */
} content;

static int close_file(int fd)
{
    /* After EINTR the descriptor is gone on Linux. */
    return close(fd) != 0 && errno != EINTR ? errno : 0;
}

static int write_in_place(const char *path, const content *content)
{
    int fd = open(path, O_WRONLY | O_CLOEXEC);
    if (fd < 0)
        return errno;
    int code = content->put(content->user, fd);
    int close_code = close_file(fd);
    return code ? code : close_code;
}

/* Writes the folder that target is in, with its slash, or "" for the current one. */
static int folder_of(char *out, size_t size, const char *target)
{
    const char *slash = strrchr(target, '/');
    int length = snprintf(out, size, "%.*s", slash ? (int)(slash - target) + 1 : 0, target);
    return length < 0 || (size_t)length >= size ? ENAMETOOLONG : 0;
}

/* Opens a folder to be synchronised; -1 where this user may write into it but not read it. */
static int open_folder(int *fd, const char *folder)
{
    *fd = open(*folder ? folder : ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    return *fd >= 0 || errno == EACCES ? 0 : errno;
}

/*
 * A new name outlives a loss of power once its folder is on the disk. Some file systems cannot
 * synchronise folders, and need not or cannot be told to.
 */
static int sync_folder(int fd)
{
    if (fd < 0 || fsync(fd) == 0 || errno == EINVAL || errno == ENOTSUP || errno == ENOSYS)
        return 0;
    return errno;
}

/* Writes and synchronises a file; `old` is as in replace. */
static int fill(int fd, const struct stat *old, const content *content)
{
    int code = content->put(content->user, fd);
    if (!code && old && fchmod(fd, old->st_mode & 0777) != 0)
        code = errno;
    if (!code && fsync(fd) != 0)
        code = errno;
    return code;
}

/*
 * Writes a file beside target and renames it; `old` is target's status or NULL when it is new. The
 * file's own name does not grow with target's, so that one of the greatest allowed length works
 * too; those that killed processes left in the folder are removed.
 */
static int replace_in(const char *folder, const char *target, const struct stat *old,
                      const content *content)
{
    char name[PATH_MAX];
    int fd;
    if (!content->is_another)
        rt_claim_clean(folder, ".rt-", ".tmp", NULL);
    int code = rt_claim_new(&fd, name, sizeof name, folder, ".rt-", ".tmp", 0666);
    if (code)
        return code;
    code = fill(fd, old, content);
    if (!code && rename(name, target) != 0)
        code = errno;
    if (code)
        unlink(name);
    /*
     * Not before: closing gives up the claim, and another process could remove a file that still
     * has its temporary name. What it tells is not new: fsync told whether the data is safe.
     */
    close(fd);
    return code;
}

/* The same, and synchronises the folder. */
static int replace(const char *target, const struct stat *old, const content *content)
{
    char folder[PATH_MAX];
    int fd;
    if (old && access(target, W_OK) != 0)
        return errno;
    int code = folder_of(folder, sizeof folder, target);
    if (!code)
        code = open_folder(&fd, folder);
    if (code)
        return code;
    code = replace_in(folder, target, old, content);
    if (!code)
        code = sync_folder(fd);
    if (fd >= 0)
        close(fd);
    return code;
}

/* Makes the file that path, a link to nothing, points to. */
static int make_target(const char *path, const content *content)
{
    /* Its name is known once it is there. */
    int fd = open(path, O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
    if (fd < 0)
        return errno;
    close_file(fd);
    char *target = realpath(path, NULL);
    if (!target)
        return errno;
    int code = replace(target, NULL, content);
    if (code)
        unlink(target);
    free(target);
    return code;
}

static rt_status replace_whole(const char *path, const content now, rt_error *error)
{
    if (rt_is_missing(path, "path", error))
        return RT_ERROR_USAGE;
    struct stat old, link;
    int code;
    if (stat(path, &old) != 0) {
        code = errno;
        if (code == ENOENT)
            code = lstat(path, &link) == 0 ? make_target(path, &now) : replace(path, NULL, &now);
    } else if (S_ISDIR(old.st_mode)) {
        code = EISDIR;
    } else if (!S_ISREG(old.st_mode)) {
        code = write_in_place(path, &now);
    } else {
        /* Replace what a symbolic link points to, not the link. */
        char *target = realpath(path, NULL);
        code = target ? replace(target, &old, &now) : errno;
        free(target);
    }
    return code ? fail_errno(error, RT_ERROR_OUTPUT, "write", path, code) : RT_OK;
}

rt_status rt_file_replace_by(const char *path, rt_file_content *put, const void *user,
                             rt_error *error)
{
    return replace_whole(path, (content){.put = put, .user = user}, error);
}

static int put_bytes(const void *user, int fd)
{
    const rt_bytes *bytes = user;
    return rt_file_put(fd, bytes->data, bytes->size);
}

rt_status rt_file_replace(const char *path, const rt_bytes *bytes, rt_error *error)
{
    return rt_file_replace_by(path, put_bytes, bytes, error);
}

rt_status rt_file_write(const char *path, const void *data, size_t size, rt_error *error)
{
    rt_bytes bytes = {(uint8_t *)data, size, size, NULL}; /* only read */
    return rt_file_replace(path, &bytes, error);
}

rt_status rt_file_write_another(const char *path, const void *data, size_t size, rt_error *error)
{
    const rt_bytes bytes = {(uint8_t *)data, size, size, NULL}; /* only read */
    return replace_whole(path, (content){put_bytes, &bytes, 1}, error);
}
