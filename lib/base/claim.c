/* claim.c - claims by POSIX record locks. */
#define _XOPEN_SOURCE 700 /* O_NOFOLLOW */

#include "base/claim.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { NAME_TRIES = 1000 };

/* Locks the whole file, where its file system has locks. Returns 0, or the errno. */
static int lock(int fd)
{
    struct flock whole = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    return fcntl(fd, F_SETLK, &whole) == 0 ? 0 : errno;
}

/*
 * Claims a file just made. Another process may have taken it for abandoned before the lock was
 * there, and removed it: then it has no name any more.
 */
static int was_claimed(int fd)
{
    struct stat info;
    int code = lock(fd);
    if (code == EAGAIN || code == EACCES)
        return 0;
    return fstat(fd, &info) != 0 || info.st_nlink > 0;
}

int rt_claim_new(int *fd, char *path, size_t size, const char *folder, const char *prefix,
                 const char *suffix, unsigned permissions)
{
    for (int i = 0; i < NAME_TRIES; i++) {
        int length =
            snprintf(path, size, "%s%s%ld-%d%s", folder, prefix, (long)getpid(), i, suffix);
        if (length < 0 || (size_t)length >= size)
            return ENAMETOOLONG;
        *fd = open(path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, (mode_t)permissions);
        if (*fd >= 0 && was_claimed(*fd))
            return 0;
        if (*fd < 0 && errno != EEXIST)
            return errno;
        if (*fd >= 0)
            close(*fd);
    }
    return EEXIST;
}

/* Whether a name is one of rt_claim_new by another process. */
static int is_anothers(const char *name, const char *prefix, const char *suffix)
{
    char *end;
    if (strncmp(name, prefix, strlen(prefix)) != 0)
        return 0;
    name += strlen(prefix);
    long process = strtol(name, &end, 10);
    if (end == name || *end != '-' || process <= 0 || process == (long)getpid())
        return 0;
    name = end + 1;
    strtol(name, &end, 10);
    return end > name && strcmp(end, suffix) == 0;
}

/*
 * Whether the path still names the open file. Its process may have renamed it before it gave up the
 * claim, and may by now have a new file of that name.
 */
static int is_named(const char *path, const struct stat *file)
{
    struct stat info;
    return lstat(path, &info) == 0 && info.st_dev == file->st_dev && info.st_ino == file->st_ino;
}

/* Removes the file, and what belongs to it, when this user owns it and no process claims it. */
static void remove_abandoned(const char *path, const char *suffix, void (*beside)(const char *path))
{
    struct stat info;
    int fd = open(path, O_WRONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (fd < 0)
        return;
    if (fstat(fd, &info) == 0 && S_ISREG(info.st_mode) && info.st_uid == geteuid() &&
        lock(fd) == 0 && is_named(path, &info)) {
        char stem[PATH_MAX];
        snprintf(stem, sizeof stem, "%.*s", (int)(strlen(path) - strlen(suffix)), path);
        if (beside)
            beside(stem);
        unlink(path);
    }
    close(fd);
}

void rt_claim_clean(const char *folder, const char *prefix, const char *suffix,
                    void (*beside)(const char *path))
{
    DIR *open_folder = opendir(*folder ? folder : ".");
    struct dirent *entry;
    char path[PATH_MAX];
    if (!open_folder)
        return;
    while ((entry = readdir(open_folder)))
        if (is_anothers(entry->d_name, prefix, suffix) &&
            snprintf(path, sizeof path, "%s%s", folder, entry->d_name) < (int)sizeof path)
            remove_abandoned(path, suffix, beside);
    closedir(open_folder);
}
