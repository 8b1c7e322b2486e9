/*
 * watch.c - files are told apart by device, inode, size and time of their last change. inotify on
 * their folders, in which editors rename new files over old ones, says when to look; where it says
 * nothing, as on file systems of a network, looking from time to time does.
 */
#define _XOPEN_SOURCE 700 /* realpath */

#include "watch.h"

#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "interrupt.h"
#include "message.h"
#include "status.h"

/* Milliseconds between two looks without a word of inotify, and of rest after a change. */
enum { LOOK = 250, REST = 20, RESTS_MAX = 50 };

/* What a file was like; all zero: not there. */
typedef struct file_state {
    dev_t device;
    ino_t inode;
    off_t size;
    struct timespec changed;
} file_state;

typedef struct watched_file {
    char *path;
    file_state state;
} watched_file;

struct watch {
    int notifier; /* of inotify, or -1 */
    watched_file *files;
    size_t count, room;
    double looked; /* by clock_now */
};

static double clock_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static file_state state_of(const char *path)
{
    struct stat info;
    file_state state;
    memset(&state, 0, sizeof state);
    if (stat(path, &info) == 0) {
        state.device = info.st_dev;
        state.inode = info.st_ino;
        state.size = info.st_size;
        state.changed = info.st_mtim;
    }
    return state;
}

static int is_same(const file_state *a, const file_state *b)
{
    return a->device == b->device && a->inode == b->inode && a->size == b->size &&
           a->changed.tv_sec == b->changed.tv_sec && a->changed.tv_nsec == b->changed.tv_nsec;
}

int watch_check(const command_line *arguments, const char *scene, size_t films)
{
    static const option_id others[] = {OPTION_CHECKPOINT, OPTION_RESUME, OPTION_PART,
                                       OPTION_UNTRUSTED, OPTION_PROFILE};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (arguments->options[others[i]].given) {
            message_error("--watch does not go with --%s", option_table[others[i]].name);
            return STATUS_USAGE;
        }
    if (strcmp(scene, "-") == 0)
        message_error("--watch: stdin is read once; give the scene as a file");
    else if (films > 0)
        message_error("--watch: a film (.rtpart) is of one scene; give an image as --out");
    else if (arguments->team)
        message_error("--watch is for rtc on one machine");
    else
        return STATUS_DONE;
    return STATUS_USAGE;
}

int watch_open(watch **out)
{
    watch *w = calloc(1, sizeof *w);
    if (!w) {
        message_error("out of memory");
        return STATUS_DEVICE;
    }
    w->notifier = inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
    *out = w;
    return STATUS_DONE;
}

void watch_begin(watch *w)
{
    for (size_t i = 0; i < w->count; i++)
        free(w->files[i].path);
    w->count = 0;
}

void watch_close(watch *w)
{
    if (!w)
        return;
    watch_begin(w);
    free(w->files);
    if (w->notifier >= 0)
        close(w->notifier);
    free(w);
}

/* Asks to be told of what happens in the folder of a path; again is no harm. */
static void notify_folder(const watch *w, const char *path)
{
    const char *slash = strrchr(path, '/');
    char *folder = strdup(path);
    if (w->notifier >= 0 && folder) {
        folder[slash ? slash - path + (slash == path) : 0] = '\0';
        inotify_add_watch(w->notifier, slash ? folder : ".",
                          IN_CLOSE_WRITE | IN_MOVED_TO | IN_MOVED_FROM | IN_CREATE | IN_DELETE);
    }
    free(folder);
}

void watch_add(watch *w, const char *path)
{
    for (size_t i = 0; i < w->count; i++)
        if (strcmp(w->files[i].path, path) == 0)
            return;
    if (w->count == w->room) {
        const size_t room = w->room ? 2 * w->room : 16;
        watched_file *more = realloc(w->files, room * sizeof *more);
        if (!more)
            return;
        w->files = more;
        w->room = room;
    }
    char *copy = strdup(path), *target = realpath(path, NULL);
    notify_folder(w, path);
    if (target)
        notify_folder(w, target);
    free(target);
    if (copy)
        w->files[w->count++] = (watched_file){copy, state_of(path)};
}

/* Reads away what inotify says; returns whether it said anything. */
static int drain(const watch *w)
{
    char events[4096];
    int said = 0;
    while (w->notifier >= 0 && read(w->notifier, events, sizeof events) > 0)
        said = 1;
    return said;
}

/* Whether a file is another than it was noted. */
static int look(watch *w)
{
    w->looked = clock_now();
    for (size_t i = 0; i < w->count; i++) {
        const file_state now = state_of(w->files[i].path);
        if (!is_same(&now, &w->files[i].state))
            return 1;
    }
    return 0;
}

int watch_has_changed(watch *w)
{
    return (drain(w) || clock_now() - w->looked > 1e-3 * LOOK) && look(w);
}

/* Waits for so many milliseconds, or less where inotify says something. */
static void wait_for_word(const watch *w, int milliseconds)
{
    struct pollfd word = {.fd = w->notifier, .events = POLLIN};
    poll(&word, w->notifier >= 0 ? 1 : 0, milliseconds);
    drain(w);
}

/* Notes all files as they are; returns whether one was another. */
static int note_all(watch *w)
{
    int changed = 0;
    for (size_t i = 0; i < w->count; i++) {
        const file_state now = state_of(w->files[i].path);
        changed |= !is_same(&now, &w->files[i].state);
        w->files[i].state = now;
    }
    return changed;
}

void watch_wait(watch *w)
{
    while (!interrupt_pending() && !look(w))
        wait_for_word(w, LOOK);
    for (int i = 0; i < RESTS_MAX && note_all(w) && !interrupt_pending(); i++)
        nanosleep(&(struct timespec){.tv_nsec = 1000000 * REST}, NULL);
}
