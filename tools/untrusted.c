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
#include <strings.h>

#include "folder.h"
#include "message.h"
#include "outputs.h"
#include "rt.h"
#include "status.h"

#if defined(__linux__)

#include <dirent.h>
#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/landlock.h>
#include <linux/seccomp.h>
#include <linux/sockios.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define HAS_SANITIZER
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define HAS_SANITIZER
#endif

/* What later versions of the header name. */
#define ACCESS_REFER (1ULL << 13)
#define ACCESS_TRUNCATE (1ULL << 14)
#define ACCESS_IOCTL_DEVICE (1ULL << 15)

#define ACCESS_READ (LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR)
#define ACCESS_RUN (ACCESS_READ | LANDLOCK_ACCESS_FS_EXECUTE)
/* What others wrote beside the outputs is not for a stranger's scene to show. */
#define ACCESS_WRITE                                                                               \
    (LANDLOCK_ACCESS_FS_READ_DIR | LANDLOCK_ACCESS_FS_WRITE_FILE |                                 \
     LANDLOCK_ACCESS_FS_REMOVE_FILE | LANDLOCK_ACCESS_FS_REMOVE_DIR |                              \
     LANDLOCK_ACCESS_FS_MAKE_REG | LANDLOCK_ACCESS_FS_MAKE_DIR | ACCESS_REFER | ACCESS_TRUNCATE)
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
    char *folder = folder_of(path);
    int code = folder ? allow(set->fd, folder, rights, set->handled) : -1;
    free(folder);
    return code;
}

/* A film or photon map that is there is looked at, before it is overwritten. */
static int allow_output(const rule_set *set, const char *path, __u64 rights)
{
    const char *extension = outputs_extension(path);
    int code = allow_folder_of(set, path, rights);
    if (code == 0 && (strcasecmp(extension, ".rtpart") == 0 || strcasecmp(extension, ".rtp") == 0))
        code = allow(set->fd, path, ACCESS_READ, set->handled);
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
    /* Compiled kernels are loaded from where they are written. */
    int code = allow(set->fd, work, ACCESS_WRITE | ACCESS_RUN, set->handled);
    /* Other runs will load what is kept, so it is not for this one to write. */
    return code == 0 && *kept ? allow(set->fd, kept, ACCESS_READ, set->handled) : code;
}

/* The output beside which the scene of another program is taken apart; NULL: it is none. */
static const char *scratch_of(const untrusted_needs *needs)
{
    return needs->output_count > 0 && rt_path_is_foreign(needs->scene) ? needs->outputs[0] : NULL;
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
    const char *const also[] = {needs->also, needs->further};
    const __u64 outputs =
        ACCESS_WRITE | (needs->reads_outputs || scratch_of(needs) ? ACCESS_READ : 0);
    int code = 0;
    if (needs->scene && strcmp(needs->scene, "-") != 0)
        code = allow_folder_of(&set, needs->scene, ACCESS_READ);
    if (code == 0 && needs->reads_here)
        code = allow(set.fd, ".", ACCESS_READ, set.handled);
    for (size_t i = 0; i < sizeof also / sizeof *also && code == 0; i++)
        code = also[i] ? allow(set.fd, also[i], ACCESS_READ, set.handled) : 0;
    if (code == 0)
        code = allow_system(&set);
    if (code == 0 && needs->device)
        code = allow_driver(&set);
    for (size_t i = 0; i < needs->output_count && code == 0; i++)
        code = allow_output(&set, needs->outputs[i], outputs);
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

/* What a filter loads: the number of a call, or the low half of an argument. */
#define LOAD(offset) BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offset)
#define LOAD_ARGUMENT(n) LOAD(offsetof(struct seccomp_data, args) + 8 * (n))
#define IF_EQUAL(value, yes, no) BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, value, yes, no)
#define END_WITH(result) BPF_STMT(BPF_RET | BPF_K, result)
#define REFUSE END_WITH(SECCOMP_RET_ERRNO | EPERM)
#define ALLOW END_WITH(SECCOMP_RET_ALLOW)

/* The flags of clone for name spaces: mounts, time, cgroups, host, IPC, users, processes, net. */
#define NAME_SPACES 0x7e020080

#if defined(ARCHITECTURE)

/* Calls by which a process reaches beyond itself, or changes files by their paths past Landlock. */
static const int refused[] = {
#if defined(__x86_64__)
    SYS_chmod,
    SYS_chown,
    SYS_lchown,
    SYS_utime,
    SYS_utimes,
    SYS_futimesat,
#endif
    SYS_socket,
    SYS_socketpair,
    SYS_connect,
    SYS_bind,
    SYS_io_uring_setup,
    SYS_ptrace,
    SYS_process_vm_readv,
    SYS_process_vm_writev,
    SYS_pidfd_open,
    SYS_pidfd_getfd,
    SYS_pidfd_send_signal,
    SYS_tkill,
    SYS_rt_sigqueueinfo,
    SYS_rt_tgsigqueueinfo,
    SYS_perf_event_open,
    SYS_bpf,
    SYS_keyctl,
    SYS_add_key,
    SYS_request_key,
    SYS_userfaultfd,
    SYS_mount,
    SYS_umount2,
    SYS_pivot_root,
    SYS_chroot,
    SYS_fsopen,
    SYS_fspick,
    SYS_open_tree,
    SYS_move_mount,
    SYS_fsconfig,
    SYS_fsmount,
    SYS_mount_setattr,
    SYS_fanotify_init,
    SYS_open_by_handle_at,
    SYS_unshare,
    SYS_setns,
    SYS_setpriority,
    SYS_ioprio_set,
    SYS_shmget,
    SYS_shmat,
    SYS_msgget,
    SYS_semget,
    SYS_shmctl,
    SYS_msgctl,
    SYS_semctl,
    SYS_msgsnd,
    SYS_msgrcv,
    SYS_semop,
    SYS_semtimedop,
    SYS_mq_open,
    SYS_mq_unlink,
    SYS_truncate,
    SYS_fchmodat,
    SYS_fchownat,
    SYS_setxattr,
    SYS_lsetxattr,
    SYS_removexattr,
    SYS_lremovexattr,
    SYS_fsetxattr,
    SYS_fremovexattr,
    SYS_fchown,
};

/* Calls from this number on came after this list was made; C libraries do without them. */
enum { NEWER_CALLS = 451 };

enum { REFUSED = sizeof refused / sizeof *refused };

/* A program that is put together. */
typedef struct filter_text {
    struct sock_filter at[2 * REFUSED + 60];
    size_t size;
} filter_text;

static void put(filter_text *text, const struct sock_filter *part, size_t count)
{
    memcpy(text->at + text->size, part, count * sizeof *part);
    text->size += count;
}

#define PUT(text, ...)                                                                             \
    put(text, (const struct sock_filter[]){__VA_ARGS__},                                           \
        sizeof(const struct sock_filter[]){__VA_ARGS__} / sizeof(struct sock_filter))

/* Calls that are refused for some arguments. */
static void put_partly_refused(filter_text *text)
{
    const __u32 own = (__u32)getpid();
    /* Its flags are behind a pointer; without it the C library takes clone. */
    PUT(text, IF_EQUAL(SYS_clone3, 0, 1), END_WITH(SECCOMP_RET_ERRNO | ENOSYS));
    PUT(text, IF_EQUAL(SYS_clone, 0, 4), LOAD_ARGUMENT(0),
        BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, NAME_SPACES, 0, 1), REFUSE, ALLOW);
    /* Signals go to itself, and limits are its own. */
    PUT(text, IF_EQUAL(SYS_kill, 1, 0), IF_EQUAL(SYS_tgkill, 0, 4), LOAD_ARGUMENT(0),
        IF_EQUAL(own, 1, 0), REFUSE, ALLOW);
    PUT(text, IF_EQUAL(SYS_prlimit64, 0, 5), LOAD_ARGUMENT(0), IF_EQUAL(0, 2, 0),
        IF_EQUAL(own, 1, 0), REFUSE, ALLOW);
    PUT(text, IF_EQUAL(SYS_fcntl, 0, 5), LOAD_ARGUMENT(1), IF_EQUAL(F_SETOWN, 1, 0),
        IF_EQUAL(F_SETOWN_EX, 0, 1), REFUSE, ALLOW);
    /* Keys put into a terminal would be typed to whoever has it next. */
    PUT(text, IF_EQUAL(SYS_ioctl, 0, 7), LOAD_ARGUMENT(1), IF_EQUAL(TIOCSTI, 3, 0),
        IF_EQUAL(TIOCLINUX, 2, 0), IF_EQUAL(FIOSETOWN, 1, 0), IF_EQUAL(SIOCSPGRP, 0, 1), REFUSE,
        ALLOW);
    /* The times of an open file may become now: no path, no times. */
    PUT(text, IF_EQUAL(SYS_utimensat, 0, 10), LOAD_ARGUMENT(1), IF_EQUAL(0, 0, 6),
        LOAD(offsetof(struct seccomp_data, args) + 12), IF_EQUAL(0, 0, 4), LOAD_ARGUMENT(2),
        IF_EQUAL(0, 0, 2), LOAD(offsetof(struct seccomp_data, args) + 20), IF_EQUAL(0, 1, 0),
        REFUSE, ALLOW);
}

static int confine_calls(void)
{
    static filter_text text;
    text.size = 0;
    PUT(&text, LOAD(offsetof(struct seccomp_data, arch)), IF_EQUAL(ARCHITECTURE, 1, 0),
        END_WITH(SECCOMP_RET_KILL_PROCESS), LOAD(offsetof(struct seccomp_data, nr)));
#if defined(__x86_64__)
    /* The numbers of x32 stand for the same calls. */
    PUT(&text, BPF_JUMP(BPF_JMP | BPF_JGE | BPF_K, 0x40000000, 0, 1),
        END_WITH(SECCOMP_RET_KILL_PROCESS));
#endif
    PUT(&text, BPF_JUMP(BPF_JMP | BPF_JGE | BPF_K, NEWER_CALLS, 0, 1),
        END_WITH(SECCOMP_RET_ERRNO | ENOSYS));
    for (size_t i = 0; i < REFUSED; i++)
        PUT(&text, IF_EQUAL((__u32)refused[i], 0, 1), REFUSE);
    put_partly_refused(&text);
    PUT(&text, ALLOW);
    const struct sock_fprog program = {(unsigned short)text.size, text.at};
    return prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program, 0, 0);
}

#else

static int confine_calls(void)
{
    errno = ENOSYS;
    return -1;
}

#endif

static rlim_t smaller(rlim_t a, rlim_t b)
{
    return a < b ? a : b;
}

/* Lowers a limit; one that is lower already stays. */
static int limit(int resource, rlim_t soft, rlim_t hard)
{
    struct rlimit now;
    if (getrlimit(resource, &now) != 0)
        return -1;
    const struct rlimit wanted = {smaller(now.rlim_cur, smaller(now.rlim_max, soft)),
                                  smaller(now.rlim_max, hard)};
    return setrlimit(resource, &wanted);
}

/* The cores that this process may use. */
static rlim_t core_count(void)
{
    cpu_set_t set;
    const long count = sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set)
                                                                   : sysconf(_SC_NPROCESSORS_ONLN);
    return count > 0 ? (rlim_t)count : 1;
}

/* The system kills where the hard limit is reached: before, there has to be time to write. */
static int limit_cpu(void)
{
    struct rlimit now;
    if (getrlimit(RLIMIT_CPU, &now) != 0)
        return -1;
    const rlim_t seconds = (rlim_t)UNTRUSTED_CPU_SECONDS * core_count();
    const rlim_t writing = (rlim_t)UNTRUSTED_WRITE_SECONDS * core_count();
    const rlim_t hard = smaller(now.rlim_max, seconds + writing);
    return limit(RLIMIT_CPU, hard > 2 * writing ? hard - writing : hard / 2, hard);
}

/* Drivers map more than they use, and sanitizers too; what a render takes is counted. */
static int limit_addresses(const untrusted_needs *needs)
{
#if defined(HAS_SANITIZER)
    (void)needs;
    return 0;
#else
    rt_memory_info counted = {.limit = 0};
    if (needs->memory)
        rt_memory_get_info(needs->memory, &counted);
    const rlim_t most = (counted.limit ? counted.limit : (rlim_t)UNTRUSTED_MEMORY_MIB << 20) +
                        ((rlim_t)UNTRUSTED_SLACK_MIB << 20);
    return needs->device ? 0 : limit(RLIMIT_AS, most, most);
#endif
}

static int confine_resources(const untrusted_needs *needs)
{
    const rlim_t longest = (rlim_t)UNTRUSTED_FILE_MIB << 20;
    return limit_cpu() != 0 || limit_addresses(needs) != 0 || limit(RLIMIT_CORE, 0, 0) != 0 ||
                   limit(RLIMIT_FSIZE, longest, longest) != 0
               ? -1
               : 0;
}

/* Whether there is one thread, as the rights of others would stay; where not, errno says why. */
static int is_alone(void)
{
    DIR *threads = opendir("/proc/self/task");
    int count = 0;
    if (!threads)
        return 0;
    for (const struct dirent *entry; (entry = readdir(threads)) != NULL;)
        count += entry->d_name[0] != '.';
    closedir(threads);
    errno = EBUSY;
    return count == 1;
}

/* A pipe may be waited for without end; what is not there yet will be a file. */
static int check_regular(const char *path, int status)
{
    struct stat info;
    if (!path || strcmp(path, "-") == 0 || stat(path, &info) != 0 || S_ISREG(info.st_mode))
        return STATUS_DONE;
    message_error("--untrusted: %s is not a regular file", path);
    return status;
}

/* A link would lead to where rights end, or where the stranger who made it wants. */
static int check_place(const char *path, int status)
{
    struct stat link;
    if (!path || strcmp(path, "-") == 0 || lstat(path, &link) != 0)
        return STATUS_DONE;
    char *folder = folder_of(path);
    const int is_within = folder && rt_path_is_within(folder, path) &&
                          (!S_ISLNK(link.st_mode) || access(path, F_OK) == 0);
    free(folder);
    if (is_within)
        return STATUS_DONE;
    message_error("--untrusted: %s leads to no file in its folder", path);
    return status;
}

static int check_files(const untrusted_needs *needs)
{
    const char *const read[] = {needs->scene, needs->also, needs->further};
    int status = check_place(needs->scene, STATUS_INPUT);
    for (size_t i = 0; i < sizeof read / sizeof *read && status == STATUS_DONE; i++)
        status = check_regular(read[i], STATUS_INPUT);
    for (size_t i = 0; i < needs->output_count && status == STATUS_DONE; i++) {
        status = check_regular(needs->outputs[i], STATUS_OUTPUT);
        if (status == STATUS_DONE)
            status = check_place(needs->outputs[i], STATUS_OUTPUT);
    }
    return status;
}

static char *scratch;

const char *untrusted_scratch(void)
{
    return scratch;
}

int untrusted_confine(const untrusted_needs *needs)
{
    static int is_confined;
    const int status = check_files(needs);
    if (status != STATUS_DONE)
        return status;
    if ((is_confined || is_alone()) && prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
        confine_resources(needs) == 0 && confine_files(needs) == 0 &&
        (is_confined || confine_calls() == 0)) {
        if (!is_confined && scratch_of(needs))
            scratch = folder_of(scratch_of(needs));
        is_confined = 1;
        return STATUS_DONE;
    }
    message_error("--untrusted cannot give up rights: %s",
                  errno == EBUSY ? "another thread runs" : strerror(errno));
    message_hint("it needs Linux 5.19 or newer with Landlock and seccomp, and /proc");
    return STATUS_DEVICE;
}

void untrusted_close_inherited(void)
{
    /* Older systems than Linux 5.9 have no Landlock either. */
    syscall(SYS_close_range, STDERR_FILENO + 1, ~0U, 0);
}

#else

const char *untrusted_scratch(void)
{
    return NULL;
}

int untrusted_confine(const untrusted_needs *needs)
{
    (void)needs;
    message_error("--untrusted is for Linux");
    return STATUS_DEVICE;
}

void untrusted_close_inherited(void)
{
}

#endif
