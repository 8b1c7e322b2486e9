/* kernel_cache.c - the work folder and the store of this process. */
#define _XOPEN_SOURCE 700 /* realpath */

#include "device/kernel_cache.h"

#include <dirent.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/error.h"
#include "base/file.h"
#include "base/progress.h"
#include "device/kernel_store.h"
#include "device/work_folder.h"

enum { SLOTS = 256, NOTES = 4, NOTE = 512, BITCODE_MAX = 64 << 20 };

static const char variable[] = "POCL_CACHE_DIR";

/* PoCL's name for what its front end made of a program. */
static const char bitcode_name[] = "program.bc";

/* A program that was built in this process. */
typedef struct slot {
    uint64_t key;
    char program[64];
    char folder[RT_STORED_FOLDER_MAX]; /* in the work folder; empty: the driver made none */
    size_t stored;                     /* files of it that are stored */
} slot;

static pthread_mutex_t driver = PTHREAD_MUTEX_INITIALIZER;
static int is_made, is_open, is_kept;
static char *given; /* POCL_CACHE_DIR as the user has it, or NULL */
static char work[RT_PATH_MAX], store[RT_PATH_MAX];
static slot slots[SLOTS];
static size_t slot_count;
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
    remove(path);
    snprintf(note(), NOTE, "%.450s; they are compiled again", error.message);
}

static int is_taken(const char *folder)
{
    for (size_t i = 0; i < slot_count; i++)
        if (strcmp(slots[i].folder, folder) == 0)
            return 1;
    return 0;
}

/* Finds the folder WORK/XX/REST that no program has; 0 where there is none. */
static int find_new_folder(char found[RT_STORED_FOLDER_MAX])
{
    char path[RT_PATH_MAX], inner[RT_STORED_FOLDER_MAX];
    struct dirent *first, *second;
    int is_found = 0;
    DIR *outside = opendir(work), *inside;
    if (!outside)
        return 0;
    while (!is_found && (first = readdir(outside))) {
        if (first->d_name[0] == '.' ||
            snprintf(path, sizeof path, "%s/%s", work, first->d_name) >= RT_PATH_MAX ||
            !(inside = opendir(path)))
            continue;
        while (!is_found && (second = readdir(inside)))
            if (second->d_name[0] != '.' &&
                snprintf(inner, sizeof inner, "%s/%s", first->d_name, second->d_name) <
                    RT_STORED_FOLDER_MAX &&
                !is_taken(inner)) {
                strcpy(found, inner);
                is_found = 1;
            }
        closedir(inside);
    }
    closedir(outside);
    return is_found;
}

void rt_kernel_cache_built(uint64_t key)
{
    char folder[RT_STORED_FOLDER_MAX];
    slot *s = find_slot(key);
    if (s && find_new_folder(folder)) {
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
    return path_in_folder(path, find_slot(key), bitcode_name) && access(path, R_OK) == 0 &&
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

rt_bitcode_state rt_kernel_cache_replace(uint64_t key, const rt_bytes *bitcode)
{
    char folder[RT_STORED_FOLDER_MAX], path[RT_PATH_MAX];
    slot *s = find_slot(key);
    if (!s || !find_new_folder(folder))
        return RT_BITCODE_KNOWN;
    forget_folder(s);
    strcpy(s->folder, folder);
    if (path_in_folder(path, s, bitcode_name) && rt_file_replace(path, bitcode, NULL) == RT_OK)
        return RT_BITCODE_REPLACED;
    forget_folder(s);
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
