/* file_lock.c - locks beside files, by POSIX record locks. */
#define _XOPEN_SOURCE 700 /* realpath */

#include "file_lock.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "message.h"
#include "status.h"

enum { TRIES = 100 };

/* FILE.rtlock, beside the file that a link leads to; the caller frees it. NULL without memory. */
static char *lock_path(const char *path)
{
    static const char suffix[] = ".rtlock";
    char *target = realpath(path, NULL);
    const char *file = target ? target : path;
    char *out = malloc(strlen(file) + sizeof suffix);
    if (out)
        sprintf(out, "%s%s", file, suffix);
    free(target);
    return out;
}

/* Whether the opened file is still the one of this name: a holder removes it at its end. */
static int is_current(int fd, const char *path)
{
    struct stat opened, named;
    return fstat(fd, &opened) == 0 && stat(path, &named) == 0 && opened.st_dev == named.st_dev &&
           opened.st_ino == named.st_ino;
}

/* Whether it may be ours: another program's holds something, and must not be removed. */
static int is_empty_file(int fd)
{
    struct stat info;
    return fstat(fd, &info) == 0 && S_ISREG(info.st_mode) && info.st_size == 0;
}

/* The process that holds the lock, or -1. */
static long holder_of(int fd)
{
    struct flock whole = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    return fcntl(fd, F_GETLK, &whole) == 0 && whole.l_type != F_UNLCK && whole.l_pid > 0
               ? (long)whole.l_pid
               : -1;
}

/* Opens and locks the file of this name; returns as file_lock_take. */
static long take(file_lock *out, const char *path)
{
    struct flock whole = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    for (int i = 0; i < TRIES; i++) {
        int fd = open(path, O_WRONLY | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
        if (fd < 0)
            return 0;
        if (!is_empty_file(fd)) {
            close(fd);
            return 0;
        }
        if (fcntl(fd, F_SETLK, &whole) != 0) {
            const int is_busy = errno == EAGAIN || errno == EACCES;
            const long holder = is_busy ? holder_of(fd) : 0;
            if (!is_busy)
                unlink(path);
            close(fd);
            return holder;
        }
        if (is_current(fd, path)) {
            out->fd = fd;
            out->is_held = 1;
            return 0;
        }
        close(fd);
    }
    return 0;
}

/* A process that was killed has ended only when the system has taken back its memory. */
static long take_in_time(file_lock *out, const char *path)
{
    const struct timespec rest = {0, 20000000};
    long holder = take(out, path);
    for (int i = 0; i < 50 && holder != 0; i++) {
        nanosleep(&rest, NULL);
        holder = take(out, path);
    }
    return holder;
}

long file_lock_take(file_lock *out, const char *path)
{
    *out = (file_lock){.path = lock_path(path)};
    const long holder = out->path ? take_in_time(out, out->path) : 0;
    if (!out->is_held)
        file_lock_release(out);
    return holder;
}

void file_lock_release(file_lock *lock)
{
    if (lock->is_held) {
        unlink(lock->path); /* before the lock is gone, as it could be another's then */
        close(lock->fd);
    }
    free(lock->path);
    *lock = (file_lock){0};
}

int file_lock_fail(const char *path, long process)
{
    if (process > 0)
        message_error("%s is the checkpoint of a run that goes on, process %ld", path, process);
    else
        message_error("%s is the checkpoint of a run that goes on", path);
    message_hint("wait until it has ended, or end it: each run needs a checkpoint of its own");
    return STATUS_OUTPUT;
}
