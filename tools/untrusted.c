/*
 * untrusted.c - gives up the rights that a render does not need.
 *
 * References:
 *   Linux: Documentation/userspace-api/landlock.rst, seccomp_filter.rst.
 */
#define _GNU_SOURCE /* syscall, O_PATH */

#include "untrusted.h"

#include <errno.h>
#include <limits.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "message.h"
#include "rt.h"
#include "scene_file.h"
#include "status.h"

#if defined(__linux__)

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/landlock.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

/* What later versions of the header name. */
#define ACCESS_REFER (1ULL << 13)
#define ACCESS_TRUNCATE (1ULL << 14)
#define ACCESS_IOCTL_DEVICE (1ULL << 15)

#define ACCESS_READ (LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR)
#define ACCESS_RUN (ACCESS_READ | LANDLOCK_ACCESS_FS_EXECUTE)
/* Compiled kernels are loaded from where they are written. */
#define ACCESS_WRITE                                                                               \
    (ACCESS_RUN | LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_REMOVE_FILE |                 \
     LANDLOCK_ACCESS_FS_REMOVE_DIR | LANDLOCK_ACCESS_FS_MAKE_REG | LANDLOCK_ACCESS_FS_MAKE_DIR |   \
     ACCESS_REFER | ACCESS_TRUNCATE)
#define ACCESS_OF_FILES                                                                            \
    (LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_EXECUTE |   \
     ACCESS_TRUNCATE)

/* The version that has what is needed here: moving files between folders. */
enum { LEAST_VERSION = 2 };

/* All rights that version 1 handles, and what the later ones that are used here add. */
static __u64 handled_rights(long version)
{
    __u64 rights = (LANDLOCK_ACCESS_FS_MAKE_SYM << 1) - 1;
    if (version >= 2)
        rights |= ACCESS_REFER;
    if (version >= 3)
        rights |= ACCESS_TRUNCATE;
    if (version >= 5)
        rights |= ACCESS_IOCTL_DEVICE;
    return rights;
}

/* Allows something below a path. What is not there needs no rule. Returns 0, or -1. */
static int allow(int rules, const char *path, __u64 rights, __u64 handled)
{
    struct landlock_path_beneath_attr rule = {rights & handled, open(path, O_PATH | O_CLOEXEC)};
    struct stat info;
    if (rule.parent_fd < 0)
        return errno == ENOENT ? 0 : -1;
    if (fstat(rule.parent_fd, &info) == 0 && !S_ISDIR(info.st_mode))
        rule.allowed_access &= ACCESS_OF_FILES;
    long code = syscall(SYS_landlock_add_rule, rules, LANDLOCK_RULE_PATH_BENEATH, &rule, 0);
    close(rule.parent_fd);
    return code == 0 ? 0 : -1;
}

/* Rules under way: the set, and the rights that its version handles. */
typedef struct rule_set {
    int fd;
    __u64 handled;
} rule_set;

static int allow_folder_of(const rule_set *set, const char *path, __u64 rights)
{
    char *folder = scene_file_folder(path);
    int code = folder ? allow(set->fd, folder, rights, set->handled) : -1;
    free(folder);
    return code;
}

static int allow_system(const rule_set *set)
{
    /* What the driver, its compiler and the linker read and run. */
    static const char *const paths[] = {"/usr",          "/lib",          "/lib64",
                                        "/bin",          "/etc/OpenCL",   "/etc/ld.so.cache",
                                        "/proc/cpuinfo", "/proc/meminfo", "/sys/devices/system",
                                        "/dev/urandom"};
    int code =
        allow(set->fd, "/dev/null", ACCESS_READ | LANDLOCK_ACCESS_FS_WRITE_FILE, set->handled);
    for (size_t i = 0; i < sizeof paths / sizeof *paths && code == 0; i++)
        code = allow(set->fd, paths[i], ACCESS_RUN, set->handled);
    return code;
}

static int allow_driver(const rule_set *set)
{
    static char work[PATH_MAX], kept[PATH_MAX];
    rt_error error;
    /* Where that fails, opening the device will say so. */
    if (rt_device_folders(work, kept, sizeof work, &error) != RT_OK)
        return 0;
    int code = allow(set->fd, work, ACCESS_WRITE, set->handled);
    /* Other runs will load what is kept, so it is not for this one to write. */
    return code == 0 && *kept ? allow(set->fd, kept, ACCESS_READ, set->handled) : code;
}

static int confine_files(const untrusted_needs *needs)
{
    long version = syscall(SYS_landlock_create_ruleset, NULL, 0, LANDLOCK_CREATE_RULESET_VERSION);
    if (version < LEAST_VERSION) {
        errno = ENOSYS;
        return -1;
    }
    const struct landlock_ruleset_attr all = {.handled_access_fs = handled_rights(version)};
    const rule_set set = {(int)syscall(SYS_landlock_create_ruleset, &all, sizeof all, 0),
                          all.handled_access_fs};
    if (set.fd < 0)
        return -1;
    int code = allow_folder_of(&set, needs->scene, ACCESS_READ);
    if (code == 0 && strcmp(needs->scene, "-") != 0)
        code = allow(set.fd, needs->scene, ACCESS_READ, set.handled);
    if (code == 0 && needs->also)
        code = allow(set.fd, needs->also, ACCESS_READ, set.handled);
    if (code == 0)
        code = allow_system(&set);
    if (code == 0 && needs->device)
        code = allow_driver(&set);
    for (size_t i = 0; i < needs->output_count && code == 0; i++)
        code = allow_folder_of(&set, needs->outputs[i], ACCESS_WRITE & ~LANDLOCK_ACCESS_FS_EXECUTE);
    if (code == 0)
        code = (int)syscall(SYS_landlock_restrict_self, set.fd, 0);
    close(set.fd);
    return code;
}

#if defined(__x86_64__)
#define ARCHITECTURE AUDIT_ARCH_X86_64
#elif defined(__aarch64__)
#define ARCHITECTURE AUDIT_ARCH_AARCH64
#endif

/* Refuses system calls with EPERM: those by which a process reaches beyond itself. */
static int confine_calls(void)
{
#if defined(ARCHITECTURE)
#define REFUSE(call)                                                                               \
    BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, call, 0, 1),                                               \
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM)
    static struct sock_filter filter[] = {
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, arch)),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, ARCHITECTURE, 1, 0),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS),
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, nr)),
#if defined(__x86_64__)
        /* The numbers of x32 stand for the same calls. */
        BPF_JUMP(BPF_JMP | BPF_JGE | BPF_K, 0x40000000, 0, 1),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS),
#endif
        REFUSE(SYS_socket),
        REFUSE(SYS_socketpair),
        REFUSE(SYS_connect),
        REFUSE(SYS_bind),
        REFUSE(SYS_io_uring_setup),
        REFUSE(SYS_ptrace),
        REFUSE(SYS_process_vm_readv),
        REFUSE(SYS_process_vm_writev),
        REFUSE(SYS_pidfd_getfd),
        REFUSE(SYS_perf_event_open),
        REFUSE(SYS_bpf),
        REFUSE(SYS_keyctl),
        REFUSE(SYS_add_key),
        REFUSE(SYS_request_key),
        REFUSE(SYS_userfaultfd),
        REFUSE(SYS_mount),
        REFUSE(SYS_unshare),
        REFUSE(SYS_setns),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
    };
    const struct sock_fprog program = {sizeof filter / sizeof *filter, filter};
    return prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program, 0, 0);
#else
    errno = ENOSYS;
    return -1;
#endif
}

static int limit(int resource, rlim_t soft, rlim_t hard)
{
    struct rlimit now;
    if (getrlimit(resource, &now) != 0)
        return -1;
    const struct rlimit wanted = {now.rlim_max < soft ? now.rlim_max : soft,
                                  now.rlim_max < hard ? now.rlim_max : hard};
    return setrlimit(resource, &wanted);
}

static int confine_resources(void)
{
    long cores = sysconf(_SC_NPROCESSORS_ONLN);
    rlim_t seconds = (rlim_t)UNTRUSTED_CPU_SECONDS * (rlim_t)(cores > 0 ? cores : 1);
    rlim_t longest = (rlim_t)UNTRUSTED_FILE_MIB << 20;
    return limit(RLIMIT_CPU, seconds, seconds + 30) != 0 || limit(RLIMIT_CORE, 0, 0) != 0 ||
                   limit(RLIMIT_FSIZE, longest, longest) != 0
               ? -1
               : 0;
}

int untrusted_confine(const untrusted_needs *needs)
{
    if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && confine_resources() == 0 &&
        confine_files(needs) == 0 && confine_calls() == 0)
        return STATUS_DONE;
    message_error("--untrusted cannot give up rights: %s", strerror(errno));
    message_hint("it needs Linux 5.19 or newer with Landlock and seccomp");
    return STATUS_DEVICE;
}

#else

int untrusted_confine(const untrusted_needs *needs)
{
    (void)needs;
    message_error("--untrusted is for Linux");
    return STATUS_DEVICE;
}

#endif
