/* compiler.c - starts the compiler that rt_device_options names. */
#define _XOPEN_SOURCE 700 /* posix_spawn */

#include "device/compiler.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

uint32_t rt_compilers(const rt_device *device)
{
    return device->compiler && rt_device_stores(device) ? device->threads - 1 : 0;
}

/* Starts it as `how` says, with nothing to read or to say. */
static int begin_silent(pid_t *out, char *const argv[], const posix_spawnattr_t *how)
{
    posix_spawn_file_actions_t files;
    int code = posix_spawn_file_actions_init(&files);
    if (code)
        return code;
    for (int fd = STDIN_FILENO; fd <= STDERR_FILENO && !code; fd++)
        code = posix_spawn_file_actions_addopen(&files, fd, "/dev/null", O_RDWR, 0);
    if (!code)
        code = posix_spawn(out, argv[0], &files, how, argv, environ);
    posix_spawn_file_actions_destroy(&files);
    return code;
}

/* The same with no signal blocked: a program that waits for signals in one thread blocks them. */
static int begin_unblocked(pid_t *out, char *const argv[])
{
    posix_spawnattr_t how;
    sigset_t none;
    int code = posix_spawnattr_init(&how);
    if (code)
        return code;
    sigemptyset(&none);
    code = posix_spawnattr_setsigmask(&how, &none);
    if (!code)
        code = posix_spawnattr_setflags(&how, POSIX_SPAWN_SETSIGMASK);
    if (!code)
        code = begin_silent(out, argv, &how);
    posix_spawnattr_destroy(&how);
    return code;
}

pid_t rt_compiler_begin(const rt_device *device, const char *const *programs, uint32_t count)
{
    enum { OTHERS = 7, PROGRAMS = RT_PROGRAMS_MAX, NAME = 64 };
    char names[PROGRAMS][NAME], number[16], group[16];
    char *argv[OTHERS + PROGRAMS] = {device->compiler, "kernels"};
    pid_t process;
    uint32_t at = 2;
    for (uint32_t i = 0; i < count && i < PROGRAMS; i++) {
        snprintf(names[i], NAME, "%s", programs[i]);
        argv[at++] = names[i];
    }
    snprintf(number, sizeof number, "%" PRIu32, device->number);
    snprintf(group, sizeof group, "%" PRIu32, device->work_group);
    argv[at++] = "--device";
    argv[at++] = number;
    argv[at++] = "--work-group";
    argv[at++] = group;
    if (device->count_rays)
        argv[at++] = "--count-rays";
    argv[at] = NULL;
    return begin_unblocked(&process, argv) == 0 ? process : -1;
}

/* Both fail where the program that uses the library has waited for all of its children. */
void rt_compiler_wait(pid_t process)
{
    siginfo_t info;
    while (waitid(P_PID, (id_t)process, &info, WEXITED | WNOWAIT) < 0 && errno == EINTR)
        continue;
}

void rt_compiler_end(pid_t process)
{
    while (waitpid(process, NULL, 0) < 0 && errno == EINTR)
        continue;
}
