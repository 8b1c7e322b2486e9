/* work_folder.c - makes and removes work folders. */
#define _XOPEN_SOURCE 700 /* nftw */

#include "device/work_folder.h"

#include <errno.h>
#include <fcntl.h>
#include <ftw.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/claim.h"
#include "base/error.h"

/* Far more than a program takes while it is compiled, about 2 MiB. */
enum { ROOM = 16 << 20, OPEN_FOLDERS = 16 };

/* Drivers have shorter limits on paths than the system. */
enum { LONGEST = 800 };

static const char prefix[] = ".librt-kernels-", suffix[] = ".lock";

/*
 * The folder of this process, to be removed at its end, and the process: one that it forks ends
 * without removing anything.
 */
static char own[PATH_MAX];
static pid_t owner;

int rt_folder_make(const char *path)
{
    char part[RT_PATH_MAX];
    int length = snprintf(part, sizeof part, "%s", path);
    if (length < 0 || (size_t)length >= sizeof part)
        return ENAMETOOLONG;
    for (char *at = part + 1; *at; at++)
        if (*at == '/') {
            *at = '\0';
            if (mkdir(part, 0777) != 0 && errno != EEXIST)
                return errno;
            *at = '/';
        }
    if (mkdir(part, 0700) == 0)
        return 0;
    struct stat info;
    int code = errno;
    return code == EEXIST && stat(part, &info) == 0 && !S_ISDIR(info.st_mode) ? ENOTDIR
           : code == EEXIST                                                   ? 0
                                                                              : code;
}

static int remove_one(const char *path, const struct stat *info, int kind, struct FTW *at)
{
    (void)info;
    (void)at;
    if (kind == FTW_DP)
        rmdir(path);
    else
        unlink(path);
    return 0;
}

void rt_folder_remove(const char *path)
{
    nftw(path, remove_one, OPEN_FOLDERS, FTW_DEPTH | FTW_PHYS);
}

static void remove_own(void)
{
    char claim[PATH_MAX + sizeof suffix];
    if (getpid() != owner)
        return;
    rt_folder_remove(own);
    snprintf(claim, sizeof claim, "%s%s", own, suffix);
    unlink(claim);
}

/* Whether the file can grow to what a compiler writes. Returns 0, or the errno. */
static int has_room(int fd)
{
    struct rlimit limit;
    if (getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur < ROOM)
        return EFBIG; /* growing the file would raise SIGXFSZ */
    int code = posix_fallocate(fd, 0, ROOM);
    /* Some file systems cannot promise room. */
    return code == EOPNOTSUPP || code == EINVAL ? 0 : code;
}

/* Whether code can be loaded from there: not where it is mounted noexec. */
static int can_execute(int fd)
{
    void *code = mmap(NULL, 1, PROT_READ | PROT_EXEC, MAP_PRIVATE, fd, 0);
    if (code == MAP_FAILED)
        return errno;
    munmap(code, 1);
    return 0;
}

static int is_fit(const char *folder)
{
    char path[PATH_MAX];
    if (snprintf(path, sizeof path, "%s/room", folder) >= (int)sizeof path)
        return ENAMETOOLONG;
    int fd = open(path, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (fd < 0)
        return errno;
    int code = has_room(fd);
    if (!code)
        code = can_execute(fd);
    close(fd);
    unlink(path);
    return code;
}

/* Makes the work folder of this process in `folder`. Returns 0, or the errno. */
static int make_in(const char *folder)
{
    char claim[PATH_MAX], place[LONGEST];
    int fd;
    char *absolute = realpath(folder, NULL);
    if (!absolute)
        return errno;
    int length = snprintf(place, sizeof place, "%s/", absolute);
    free(absolute);
    if (length < 0 || (size_t)length >= sizeof place)
        return ENAMETOOLONG;
    rt_claim_clean(place, prefix, suffix, rt_folder_remove);
    int code = rt_claim_new(&fd, claim, sizeof claim, place, prefix, suffix, 0600);
    if (code)
        return code;
    snprintf(own, sizeof own, "%.*s", (int)(strlen(claim) - strlen(suffix)), claim);
    code = mkdir(own, 0700) == 0 ? is_fit(own) : errno;
    if (code) {
        rmdir(own);
        unlink(claim);
        close(fd);
    }
    /* Else the descriptor stays open, for the claim, until the process ends. */
    return code;
}

rt_status rt_work_folder_make(char path[RT_PATH_MAX], const char *first, rt_error *error)
{
    const char *temporary = getenv("TMPDIR");
    const char *places[] = {first, temporary ? temporary : "", "/tmp", "/var/tmp", "/dev/shm"};
    char tried[384] = "";

    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        size_t used = strlen(tried);
        if (!*places[i] || (i > 2 && strcmp(places[i], places[1]) == 0))
            continue;
        int code = make_in(places[i]);
        if (code == 0) {
            owner = getpid();
            snprintf(path, RT_PATH_MAX, "%s", own);
            if (atexit(remove_own) == 0)
                return RT_OK;
            remove_own();
            code = ENOMEM;
        }
        char cause[RT_CAUSE_SIZE];
        snprintf(tried + used, sizeof tried - used, "%s%.100s (%s)", used ? ", " : "", places[i],
                 code == EPERM || code == EACCES ? "no permission to write or to load code"
                                                 : rt_cause(cause, code));
    }
    return rt_fail_field(error, RT_ERROR_DEVICE, "cache",
                         "no folder to compile kernels in; tried %s; TMPDIR may name another",
                         tried);
}
