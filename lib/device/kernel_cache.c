/* kernel_cache.c - the work folder and the store of this process. */
#define _XOPEN_SOURCE 700 /* realpath */

#include "device/kernel_cache.h"

#include <dirent.h>
#include <errno.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/checksum.h"
#include "base/error.h"
#include "base/file.h"
#include "base/progress.h"
#include "device/kernel_store.h"
#include "device/work_folder.h"

enum { SLOTS = 256, OLD = 4 * SLOTS, NOTES = 4, NOTE = 512, BITCODE_MAX = 64 << 20 };

static const char variable[] = "POCL_CACHE_DIR";

/* PoCL's name for what its front end made of a program. */
static const char bitcode_name[] = "program.bc";

/* A program that was built in this process. */
typedef struct slot {
    uint64_t key;
    char program[64];
    char folder[RT_STORED_FOLDER_MAX]; /* in the work folder; empty: the driver made none */
    size_t stored;                     /* files of it that are stored */
    int is_spoiled;                    /* what the driver has of its bitcode may be broken */
} slot;

static pthread_mutex_t driver = PTHREAD_MUTEX_INITIALIZER;
static int is_made, is_open, is_kept;
static char *given; /* POCL_CACHE_DIR as the user has it, or NULL */
static char work[RT_PATH_MAX], store[RT_PATH_MAX];
static slot slots[SLOTS];
static size_t slot_count;
/* Checksums of the names of the folders that were there before a build; is_watched: all of them. */
static uint64_t old[OLD];
static size_t old_count;
static int is_watched;
static char notes[NOTES][NOTE];
static size_t note_count;

void rt_driver_lock(void)
{
    pthread_mutex_lock(&driver);
}

void rt_driver_unlock(void)
{
    pthread_mutex_unlock(&driver);
}

/* What is said when nobody listens is kept; what finds no room repeats what was said. */
static char *note(void)
{
    static char lost[NOTE];
    return note_count < NOTES ? notes[note_count++] : lost;
}

void rt_kernel_cache_tell(const rt_hooks *hooks)
{
    char taken[NOTES][NOTE];
    if (!hooks || !hooks->warning)
        return;
    rt_driver_lock();
    size_t count = note_count;
    memcpy(taken, notes, sizeof taken);
    note_count = 0;
    rt_driver_unlock();
    /* Outside of the lock, as a callback may call the library. */
    for (size_t i = 0; i < count; i++)
        rt_warn(hooks, "%s", taken[i]);
}

const char *rt_kernel_cache_store(void)
{
    return is_kept ? store : "";
}

/* ---- Opening --------------------------------------------------------------------------------- */

/* As the process may change its current folder. */
static void make_absolute(char path[RT_PATH_MAX])
{
    char *absolute = realpath(path, NULL);
    if (absolute && strlen(absolute) < RT_PATH_MAX)
        strcpy(path, absolute);
    free(absolute);
}

/* The user's cache folder, by the habits of PoCL and of the XDG base directories. */
static void find_store(void)
{
    const char *cache = getenv("XDG_CACHE_HOME"), *home = getenv("HOME"), *own = getenv(variable);
    int length = 0;
    if (own && *own)
        length = snprintf(store, sizeof store, "%s", own);
    else if (cache && cache[0] == '/')
        length = snprintf(store, sizeof store, "%s/librt", cache);
    else if (home && home[0] == '/')
        length = snprintf(store, sizeof store, "%s/.cache/librt", home);
    is_kept = length > 0 && length < RT_PATH_MAX;
    char cause[RT_CAUSE_SIZE];
    int code = is_kept ? rt_folder_make(store) : 0;
    if (code) {
        is_kept = 0;
        snprintf(note(), NOTE, "compiled kernels are not kept: %.380s: %s", store,
                 rt_cause(cause, code));
    } else if (is_kept) {
        make_absolute(store);
    } else if (!is_kept) {
        snprintf(note(), NOTE,
                 "compiled kernels are not kept: neither HOME nor XDG_CACHE_HOME names a folder");
    }
}

static rt_status make_folders(rt_error *error)
{
    if (is_made)
        return RT_OK;
    find_store();
    rt_status status = rt_work_folder_make(work, is_kept ? store : "", error);
    is_made = status == RT_OK;
    if (is_made && is_kept)
        rt_stored_clean(store);
    if (!is_made)
        note_count = 0;
    return status;
}

rt_status rt_device_folders(char *work_folder, char *kept, size_t size, rt_error *error)
{
    rt_driver_lock();
    rt_status status = make_folders(error);
    if (status == RT_OK && (strlen(work) >= size || strlen(store) >= size))
        status = rt_fail(error, RT_ERROR_DEVICE, "the folder of compiled kernels has a long path");
    if (status == RT_OK) {
        strcpy(work_folder, work);
        strcpy(kept, is_kept ? store : "");
    }
    rt_driver_unlock();
    return status;
}

rt_status rt_kernel_cache_open(rt_error *error)
{
    if (is_open)
        return RT_OK;
    rt_status status = make_folders(error);
    if (status != RT_OK)
        return status;
    const char *own = getenv(variable);
    given = own ? malloc(strlen(own) + 1) : NULL;
    if (given)
        strcpy(given, own);
    if (own && !given)
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory for the folder of compiled kernels");
    setenv(variable, work, 1);
    return RT_OK;
}

void rt_kernel_cache_opened(void)
{
    if (is_open)
        return;
    is_open = 1;
    if (given)
        setenv(variable, given, 1);
    else
        unsetenv(variable);
    free(given);
    given = NULL;
}

/* ---- Programs -------------------------------------------------------------------------------- */

static slot *find_slot(uint64_t key)
{
    for (size_t i = 0; i < slot_count; i++)
        if (slots[i].key == key)
            return &slots[i];
    return NULL;
}

static int stored_path(char path[RT_PATH_MAX], const slot *s)
{
    return snprintf(path, RT_PATH_MAX, "%s/%s-%016llx%s", store, s->program,
                    (unsigned long long)s->key, RT_STORED_SUFFIX) < RT_PATH_MAX;
}

int rt_kernel_cache_has(uint64_t key, const char *program)
{
    char path[RT_PATH_MAX];
    slot s = {.key = key};
    snprintf(s.program, sizeof s.program, "%s", program);
    return is_kept && stored_path(path, &s) && access(path, R_OK) == 0;
}

void rt_kernel_cache_fetch(uint64_t key, const char *program)
{
    char path[RT_PATH_MAX];
    rt_error error;
    if (find_slot(key) || slot_count == SLOTS)
        return;
    slot *s = &slots[slot_count++];
    memset(s, 0, sizeof *s);
    s->key = key;
    snprintf(s->program, sizeof s->program, "%s", program);
    if (!is_kept || !stored_path(path, s) ||
        rt_stored_read(s->folder, &s->stored, path, key, work, &error) == RT_OK)
        return;
    s->folder[0] = '\0';
    s->stored = 0;
    snprintf(note(), NOTE, "%.450s; they are compiled again", error.message);
}

typedef int folder_visitor(const char *folder, void *user);

/*
 * Calls visit for WORK/outer/X as "outer/X", for each X, until it returns other than 0: that, or 0;
 * -1 where they cannot be read.
 */
static int each_folder_in(const char *outer, folder_visitor *visit, void *user)
{
    char path[RT_PATH_MAX], folder[RT_STORED_FOLDER_MAX];
    struct dirent *entry;
    int end = 0;
    if (snprintf(path, sizeof path, "%s/%s", work, outer) >= RT_PATH_MAX)
        return -1;
    DIR *inside = opendir(path);
    if (!inside)
        return errno == ENOTDIR ? 0 : -1;
    while (end == 0 && (entry = readdir(inside)))
        if (entry->d_name[0] != '.')
            end = snprintf(folder, sizeof folder, "%s/%s", outer, entry->d_name) <
                          RT_STORED_FOLDER_MAX
                      ? visit(folder, user)
                      : -1;
    closedir(inside);
    return end;
}

/* The same for the folders of all programs. */
static int each_folder(folder_visitor *visit, void *user)
{
    struct dirent *entry;
    int end = 0;
    DIR *outside = opendir(work);
    if (!outside)
        return -1;
    while (end == 0 && (entry = readdir(outside)))
        if (entry->d_name[0] != '.')
            end = each_folder_in(entry->d_name, visit, user);
    closedir(outside);
    return end;
}

static int note_old(const char *folder, void *user)
{
    (void)user;
    if (old_count == OLD)
        return -1;
    old[old_count++] = rt_checksum_of(folder, strlen(folder));
    return 0;
}

int rt_kernel_cache_watch(void)
{
    old_count = 0;
    is_watched = each_folder(note_old, NULL) == 0;
    return is_watched;
}

static int take_new(const char *folder, void *found)
{
    const uint64_t sum = rt_checksum_of(folder, strlen(folder));
    for (size_t i = 0; i < old_count; i++)
        if (old[i] == sum)
            return 0;
    strcpy(found, folder);
    return 1;
}

/* Finds the folder that the driver made since rt_kernel_cache_watch: 1; 0: none; -1: unknown. */
static int find_new_folder(char found[RT_STORED_FOLDER_MAX])
{
    return is_watched ? each_folder(take_new, found) : -1;
}

void rt_kernel_cache_built(uint64_t key)
{
    char folder[RT_STORED_FOLDER_MAX];
    slot *s = find_slot(key);
    if (s && find_new_folder(folder) == 1) {
        strcpy(s->folder, folder);
        s->stored = 0;
    }
}

/* A path in the program's folder; 0 where it has none. */
static int path_in_folder(char path[RT_PATH_MAX], const slot *s, const char *name)
{
    return s && s->folder[0] &&
           snprintf(path, RT_PATH_MAX, "%s/%s/%s", work, s->folder, name) < RT_PATH_MAX;
}

int rt_kernel_cache_bitcode(rt_bytes *out, uint64_t key)
{
    char path[RT_PATH_MAX];
    const slot *s = find_slot(key);
    return path_in_folder(path, s, bitcode_name) && !s->is_spoiled && access(path, R_OK) == 0 &&
           rt_file_read(out, path, BITCODE_MAX, NULL) == RT_OK && out->size > 0;
}

static void forget_folder(slot *s)
{
    char path[RT_PATH_MAX];
    if (path_in_folder(path, s, ""))
        rt_folder_remove(path);
    s->folder[0] = '\0';
    s->stored = 0;
}

void rt_kernel_cache_spoil(uint64_t key)
{
    slot *s = find_slot(key);
    if (s)
        s->is_spoiled = 1;
}

rt_bitcode_state rt_kernel_cache_replace(uint64_t key, const rt_bytes *bitcode)
{
    char folder[RT_STORED_FOLDER_MAX], path[RT_PATH_MAX];
    slot *s = find_slot(key);
    const int found = s ? find_new_folder(folder) : 0;
    if (found == 0)
        return RT_BITCODE_KNOWN;
    if (found == 1) {
        forget_folder(s);
        strcpy(s->folder, folder);
        if (path_in_folder(path, s, bitcode_name) && rt_file_replace(path, bitcode, NULL) == RT_OK)
            return RT_BITCODE_REPLACED;
        forget_folder(s);
    }
    return RT_BITCODE_BROKEN;
}

void rt_kernel_cache_keep(void)
{
    char path[RT_PATH_MAX];
    rt_error error;
    for (size_t i = 0; i < slot_count && is_kept; i++) {
        slot *s = &slots[i];
        size_t files = s->folder[0] ? rt_stored_count(work, s->folder) : 0;
        if (files == s->stored || !stored_path(path, s))
            continue;
        s->stored = files;
        if (rt_stored_write(path, s->key, work, s->folder, &error) == RT_OK)
            continue;
        is_kept = 0;
        snprintf(note(), NOTE, "compiled kernels are not kept: %.450s", error.message);
    }
}
