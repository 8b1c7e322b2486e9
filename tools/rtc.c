/* rtc.c - the command: reads its line and hands over to a subcommand. */
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <unistd.h>

#include "checkpoint.h"
#include "command_line.h"
#include "commands.h"
#include "help.h"
#include "interrupt.h"
#include "message.h"
#include "rt.h"
#include "status.h"
#include "timing.h"
#include "untrusted.h"

static int (*const commands[COMMAND_COUNT])(const command_line *) = {
    [COMMAND_RENDER] = command_render,   [COMMAND_CHECK] = command_check,
    [COMMAND_MESH] = command_mesh,       [COMMAND_DEVICES] = command_devices,
    [COMMAND_DOCTOR] = command_doctor,   [COMMAND_PHOTONS] = command_photons,
    [COMMAND_COMPARE] = command_compare, [COMMAND_MERGE] = command_merge,
    [COMMAND_INFO] = command_info,       [COMMAND_KERNELS] = command_kernels,
    [COMMAND_STUDY] = command_study,     [COMMAND_FMT] = command_fmt,
    [COMMAND_PATHS] = command_paths,     [COMMAND_IMPORT] = command_import,
};

static int run(const command_line *arguments)
{
    if (arguments->options[OPTION_HELP].given) {
        help_print(arguments);
        return STATUS_DONE;
    }
    if (arguments->options[OPTION_VERSION].given) {
        printf("rtc %s\n", rt_version());
        return STATUS_DONE;
    }
    return commands[arguments->command](arguments);
}

/*
 * A standard stream that is closed would be the next file that opens, and what is said would go
 * there. Nothing can be written to what takes its place, so that losing output is still an error.
 */
static void fill_standard_streams(void)
{
    for (int fd = STDIN_FILENO; fd <= STDERR_FILENO; fd++)
        if (fcntl(fd, F_GETFD) < 0 && errno == EBADF && open("/dev/null", O_RDONLY) < 0)
            _exit(STATUS_DEVICE);
}

int main(int argc, char **argv)
{
    fill_standard_streams();
    /* A closed pipe is an error of the write, not the end of a render. */
    signal(SIGPIPE, SIG_IGN);
    /* Nor is a file that reaches the limit of its size (ulimit -f). */
    signal(SIGXFSZ, SIG_IGN);

    command_line arguments;
    int status = arguments_parse(&arguments, argc, argv);
    if (status == STATUS_DONE && arguments.options[OPTION_UNTRUSTED].given)
        untrusted_close_inherited();
    if (status == STATUS_DONE && !arguments.options[OPTION_HELP].given)
        status = timing_begin(&arguments);
    if (status == STATUS_DONE)
        status = arguments_limit_memory(&arguments);
    if (status == STATUS_DONE && !arguments.options[OPTION_HELP].given)
        status = checkpoint_resume(&arguments);
    if (status == STATUS_DONE)
        status = run(&arguments);
    rt_memory *memory = arguments.memory;
    arguments_free(&arguments);
    rt_memory_destroy(memory);
    int written = message_finish_stdout();
    interrupt_let_end();
    /* That things differ, which is status 1 too, is no result while what differs is lost. */
    return status == STATUS_DONE || (status == STATUS_INPUT && written != STATUS_DONE) ? written
                                                                                       : status;
}
