/* rtc_mpi.c - `mpirun rtc-mpi SCENE`: rtc on many processes, which share a picture. */
#include <mpi.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "../checkpoint.h"
#include "../command_line.h"
#include "../commands.h"
#include "../film_note.h"
#include "../film_place.h"
#include "../help.h"
#include "../interrupt.h"
#include "../message.h"
#include "lead.h"
#include "worker.h"
#include "../status.h"
#include "../team.h"
#include "../timing.h"

/* How many of this machine's processes come before this one. */
static uint32_t number_here(void)
{
    MPI_Comm here;
    int number = 0;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &here);
    MPI_Comm_rank(here, &number);
    MPI_Comm_free(&here);
    return (uint32_t)number;
}

/* Refuses what is for one process. */
static int check(const command_line *arguments)
{
    static const option_id alone[] = {OPTION_PART, OPTION_UNTRUSTED};
    if (arguments->command != COMMAND_RENDER) {
        message_error("rtc-mpi renders a scene; `rtc %s` is for one process",
                      command_name(arguments->command));
        return STATUS_USAGE;
    }
    for (size_t i = 0; i < sizeof alone / sizeof *alone; i++)
        if (arguments->options[alone[i]].given) {
            message_error("--%s is for rtc, not for rtc-mpi", option_table[alone[i]].name);
            return STATUS_USAGE;
        }
    if (arguments->operand_count > 0 && strcmp(arguments->operands[0], "-") == 0) {
        message_error("rtc-mpi reads its scene from a file, which all processes can");
        return STATUS_USAGE;
    }
    return STATUS_DONE;
}

/* ---- Rank 0 ----------------------------------------------------------------------- */

static int run_lead(lead *l, command_line *arguments)
{
    const option_value *given = arguments->options;
    int status = check(arguments);
    if (given[OPTION_HELP].given && status == STATUS_DONE) {
        help_print(arguments);
        return STATUS_DONE;
    }
    if (given[OPTION_VERSION].given && status == STATUS_DONE) {
        printf("rtc %s\n", rt_version());
        return STATUS_DONE;
    }
    if (status == STATUS_DONE)
        status = timing_begin(arguments);
    if (status == STATUS_DONE)
        status = arguments_limit_memory(arguments);
    if (status == STATUS_DONE)
        status = checkpoint_resume(arguments);
    l->memory = arguments->memory;
    l->note = arguments->film ? rt_film_note(arguments->film) : "";
    return status == STATUS_DONE ? command_render(arguments) : status;
}

static int main_of_lead(int argc, char **argv, int ranks, int *is_left)
{
    command_line arguments;
    lead l;
    int status = STATUS_DEVICE;
    if (!lead_begin(&l, ranks)) {
        message_error("out of memory");
        wire_abort(STATUS_DEVICE);
    }
    team team = {.number = number_here(), .render = lead_render, .user = &l};
    status = arguments_parse(&arguments, argc, argv);
    arguments.team = &team;
    if (status == STATUS_DONE)
        status = run_lead(&l, &arguments);
    lead_end(&l);
    rt_memory *memory = arguments.memory;
    arguments_free(&arguments);
    *is_left = l.left > 0;
    lead_free(&l);
    rt_memory_destroy(memory);
    const int written = message_finish_stdout();
    return status == STATUS_DONE ? written : status;
}

/* ---- Workers ---------------------------------------------------------------------- */

/* What a worker says on stderr goes to a file, for rank 0 to print where it matters. */
static FILE *hush(void)
{
    FILE *said = tmpfile();
    if (said)
        dup2(fileno(said), STDERR_FILENO);
    if (!freopen("/dev/null", "w", stdout))
        fclose(stdout);
    return said;
}

static int run_worker(worker *w, command_line *arguments)
{
    option_value *given = arguments->options;
    int status = check(arguments);
    if (status != STATUS_DONE || given[OPTION_HELP].given || given[OPTION_VERSION].given)
        return status;
    given[OPTION_QUIET].given = 1;
    given[OPTION_VERBOSE].given = given[OPTION_STATS].given = given[OPTION_PROFILE].given = 0;
    given[OPTION_PROGRESS].given = 1;
    given[OPTION_PROGRESS].choice = PROGRESS_NONE;
    char *note = worker_hello();
    if (!note)
        return STATUS_DONE;
    status = film_place_enter(arguments, note);
    if (status == STATUS_DONE)
        status = film_note_give_text(arguments, note);
    if (status == STATUS_DONE)
        status = arguments_limit_memory(arguments);
    w->memory = arguments->memory;
    if (status == STATUS_DONE)
        status = command_render(arguments);
    arguments->note = note;
    return status;
}

static void main_of_worker(int argc, char **argv, int rank, int ranks)
{
    char text[512] = "";
    FILE *said = hush();
    worker w = {.rank = rank, .ranks = ranks};
    team team = {.is_worker = 1, .number = number_here(), .render = worker_render, .user = &w};
    command_line arguments;
    int status = arguments_parse(&arguments, argc, argv);
    arguments.team = &team;
    if (status == STATUS_DONE)
        status = run_worker(&w, &arguments);
    fflush(stderr);
    if (said) {
        rewind(said);
        text[fread(text, 1, sizeof text - 1, said)] = '\0';
    }
    worker_bye(&w, status, text);
    rt_memory *memory = arguments.memory;
    arguments_free(&arguments);
    rt_memory_destroy(memory);
}

int main(int argc, char **argv)
{
    int level, rank, ranks, status = STATUS_DONE, is_left = 0;
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN);
    /* Before MPI starts threads, which must not be ended by a signal. */
    interrupt_block();
    MPI_Init_thread(&argc, &argv, MPI_THREAD_SERIALIZED, &level);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    if (level < MPI_THREAD_SERIALIZED) {
        message_error("this MPI does not serve a program of several threads");
        MPI_Abort(MPI_COMM_WORLD, STATUS_DEVICE);
    }
    if (rank == 0)
        status = main_of_lead(argc, argv, ranks, &is_left);
    else
        main_of_worker(argc, argv, rank, ranks);
    /* Those that do not answer any more would be waited for for ever. */
    if (is_left)
        MPI_Abort(MPI_COMM_WORLD, status);
    MPI_Finalize();
    return status;
}
