/* part.c - reads --part. */
#include "part.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "message.h"
#include "number.h"
#include "status.h"

/*
 * Where engines say which part this process is: the variables of its number, of the first and the
 * last one, of the step between two, and of how many there are.
 */
static const struct {
    const char *index, *first, *last, *step, *count;
    uint64_t begins; /* the first number where there is no variable for it */
} engines[] = {
    {"SLURM_ARRAY_TASK_ID", "SLURM_ARRAY_TASK_MIN", "SLURM_ARRAY_TASK_MAX", "SLURM_ARRAY_TASK_STEP",
     "SLURM_ARRAY_TASK_COUNT", 1},
    {"OMPI_COMM_WORLD_RANK", NULL, NULL, NULL, "OMPI_COMM_WORLD_SIZE", 0},
    {"PMI_RANK", NULL, NULL, NULL, "PMI_SIZE", 0},
    {"SLURM_PROCID", NULL, NULL, NULL, "SLURM_NTASKS", 0},
    {"JOB_COMPLETION_INDEX", NULL, NULL, NULL, "JOB_COMPLETIONS", 0},
};

static int set(uint32_t *part, uint32_t *parts, uint64_t number, uint64_t count)
{
    if (count > UINT32_MAX) {
        message_error("--part %" PRIu64 "/%" PRIu64 ": there are %lu parts at most", number, count,
                      (unsigned long)UINT32_MAX);
        return STATUS_USAGE;
    }
    if (number < 1 || number > count) {
        message_error("--part %" PRIu64 "/%" PRIu64 ": there is no part %" PRIu64 " of %" PRIu64
                      "; they are counted from 1",
                      number, count, number, count);
        return STATUS_USAGE;
    }
    *part = (uint32_t)number;
    *parts = (uint32_t)count;
    return STATUS_DONE;
}

/* The whole number that a variable holds; 0 where there is none. */
static int read_variable(uint64_t *out, const char *name)
{
    const char *text = name ? getenv(name) : NULL;
    return text && (strcmp(text, "0") == 0 ? (*out = 0, 1) : !number_count(out, text));
}

/*
 * Whether an array can be that of all parts: from 0 or 1 on, and without gaps. That of tasks which
 * were submitted again has a count of its own.
 */
static int is_whole(const char *last, uint64_t first, uint64_t step, uint64_t count)
{
    uint64_t end;
    return first <= 1 &&
           (!read_variable(&end, last) || (end >= first && (end - first) / step + 1 == count));
}

static int fail_array(uint64_t index)
{
    message_error("--part auto: task %" PRIu64 " is of an array that does not begin at 0 or 1, or "
                  "has gaps, as where tasks were submitted again: the number of parts is not known",
                  index);
    message_hint("give --part I/N, with N of the whole array");
    return STATUS_USAGE;
}

static int read_auto(uint32_t *part, uint32_t *parts)
{
    for (size_t i = 0; i < sizeof engines / sizeof *engines; i++) {
        uint64_t index, count, step = 1, first = engines[i].begins;
        if (!read_variable(&index, engines[i].index))
            continue;
        if (!read_variable(&count, engines[i].count)) {
            message_error("--part auto: %s is set, and %s, the number of parts, is not",
                          engines[i].index, engines[i].count);
            return STATUS_USAGE;
        }
        read_variable(&first, engines[i].first);
        if (!read_variable(&step, engines[i].step) || step == 0)
            step = 1;
        if (engines[i].last && !is_whole(engines[i].last, first, step, count))
            return fail_array(index);
        return set(part, parts, index < first ? 0 : (index - first) / step + 1, count);
    }
    message_error("--part auto: this is no job of Slurm or MPI, and no indexed job");
    message_hint("set JOB_COMPLETION_INDEX, from 0, and JOB_COMPLETIONS, or give --part I/N");
    return STATUS_USAGE;
}

int part_read(uint32_t *part, uint32_t *parts, const char *text)
{
    char first[32];
    uint64_t number, count;
    if (strcmp(text, "auto") == 0)
        return read_auto(part, parts);
    const char *slash = strchr(text, '/');
    size_t length = slash ? (size_t)(slash - text) : sizeof first;
    if (length < sizeof first) {
        memcpy(first, text, length);
        first[length] = '\0';
        if (!number_count(&number, first) && !number_count(&count, slash + 1) && count >= 1)
            return set(part, parts, number, count);
    }
    message_error("--part takes the number of a part and of all parts, as in 1/4, or auto; not "
                  "'%s'",
                  text);
    return STATUS_USAGE;
}
