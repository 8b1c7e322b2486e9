/* timing.c - prints a profile as tables or JSON, and writes its trace. */
#define _XOPEN_SOURCE 700 /* getrusage */

#include "timing.h"

#include <inttypes.h>
#include <stdio.h>
#include <strings.h>
#include <sys/resource.h>

#include "json.h"
#include "message.h"
#include "outputs.h"
#include "status.h"

enum { STAGES_MAX = 64, COMMANDS_MAX = 64, OWNERS_MAX = 64 };

/* What is printed, read from a profile at one moment. */
typedef struct timing {
    rt_profile_stage stages[STAGES_MAX]; /* the last: what no stage accounts for */
    rt_profile_command commands[COMMANDS_MAX];
    rt_memory_owner owners[OWNERS_MAX];
    size_t stage_count, command_count, owner_count;
    double seconds;
    uint64_t counted, process; /* bytes, at most */
} timing;

int timing_begin(command_line *arguments)
{
    const option_value *trace = &arguments->options[OPTION_PROFILE];
    rt_error error;
    if (trace->given && strcasecmp(outputs_extension(trace->text), ".json") != 0) {
        message_error("--profile %s: it goes to a file called NAME.json", trace->text);
        return STATUS_USAGE;
    }
    if (trace->given) {
        int status = outputs_check_writable(trace->text);
        if (status != STATUS_DONE)
            return status;
    }
    if (!trace->given && !arguments->options[OPTION_STATS].given)
        return STATUS_DONE;
    return rt_profile_create(&arguments->profile, trace->given, &error) == RT_OK
               ? STATUS_DONE
               : message_failure(&error);
}

/* The most memory that this process has had, bytes. */
static uint64_t process_memory(void)
{
    struct rusage usage;
    return getrusage(RUSAGE_SELF, &usage) == 0 ? (uint64_t)usage.ru_maxrss * 1024 : 0;
}

static size_t least(size_t a, size_t b)
{
    return a < b ? a : b;
}

static void read_timing(timing *out, const command_line *arguments)
{
    const rt_profile *profile = arguments->profile;
    rt_memory_info memory = {0};
    out->owner_count = 0;
    if (arguments->memory) {
        rt_memory_get_info(arguments->memory, &memory);
        out->owner_count =
            least(rt_memory_get_owners(arguments->memory, out->owners, OWNERS_MAX), OWNERS_MAX);
    }
    out->counted = memory.most;
    out->process = process_memory();
    out->stage_count =
        least(rt_profile_get_stages(profile, out->stages, STAGES_MAX - 1), STAGES_MAX - 1);
    out->command_count =
        least(rt_profile_get_commands(profile, out->commands, COMMANDS_MAX), COMMANDS_MAX);
    out->seconds = rt_profile_seconds(profile);
    rt_profile_stage *other = out->stages + out->stage_count++;
    *other = (rt_profile_stage){.name = "other", .count = 1, .seconds = out->seconds};
    for (size_t i = 0; i + 1 < out->stage_count; i++)
        other->seconds -= out->stages[i].seconds;
}

/* ---- For people --------------------------------------------------------------- */

static void print_stages(const timing *t)
{
    int is_shared = 0;
    for (size_t i = 0; i < t->stage_count; i++)
        is_shared |= t->stages[i].beside > 0;
    printf("time by stage          seconds       %%     times%s\n",
           is_shared ? "   on other threads" : "");
    for (size_t i = 0; i < t->stage_count; i++) {
        const rt_profile_stage *s = t->stages + i;
        printf("  %-18s %9.3f  %6.1f  %8" PRIu64, s->name, s->seconds,
               100 * s->seconds / t->seconds, s->count);
        if (s->beside > 0)
            printf("  %15.3f s", s->beside);
        putchar('\n');
    }
    printf("  %-18s %9.3f  %6.1f\n", "all", t->seconds, 100.0);
}

/* A number with a prefix of its unit, as "12.3 M". */
static void print_amount(double value)
{
    static const char *const units[] = {" ", "k", "M", "G", "T"};
    size_t unit = 0;
    for (; value >= 999.5 && unit + 1 < sizeof units / sizeof *units; unit++)
        value /= 1000;
    printf("  %9.4g %s", value, units[unit]);
}

/* Kernels by work-items, or transfers by bytes. */
static void print_commands(const timing *t, int is_transfer, const char *title)
{
    int is_first = 1;
    for (size_t i = 0; i < t->command_count; i++) {
        const rt_profile_command *c = t->commands + i;
        if (c->is_transfer != is_transfer)
            continue;
        if (is_first)
            puts(title);
        is_first = 0;
        printf("  %-18s %9.3f  %6.1f  %8" PRIu64, c->name, c->seconds,
               100 * c->seconds / t->seconds, c->count);
        print_amount((double)c->amount);
        if (c->seconds > 0)
            print_amount((double)c->amount / c->seconds);
        putchar('\n');
    }
}

static void print_owner(const timing *t, const rt_memory_owner *o)
{
    printf("  %-40s %9.1f  %6.1f  %13.1f\n", o->what, (double)o->at_most / (1 << 20),
           100 * (double)o->at_most / (double)t->counted, (double)o->most / (1 << 20));
}

/*
 * What was taken when all together took the most, and the most that each took at any time; those
 * that never took a thousandth of it as one.
 */
static void print_owners(const timing *t)
{
    if (t->counted == 0)
        return;
    rt_memory_owner rest = {.what = "the rest"};
    printf("%-42s %9s  %6s  %13s\n", "memory at its most", "MiB", "%", "own most, MiB");
    for (size_t i = 0; i < t->owner_count; i++) {
        if (t->owners[i].most >= t->counted / 1000) {
            print_owner(t, t->owners + i);
            continue;
        }
        rest.at_most += t->owners[i].at_most;
        rest.most += t->owners[i].most;
    }
    print_owner(t, &rest);
}

void timing_print(const command_line *arguments)
{
    timing t;
    if (!arguments->profile)
        return;
    read_timing(&t, arguments);
    print_stages(&t);
    print_commands(&t, 0,
                   "time in kernels        seconds       %  launches   work-items       per s");
    print_commands(&t, 1,
                   "time in transfers      seconds       %     times        bytes       per s");
    print_owners(&t);
    printf("memory counted: %.1f MiB at most\n", (double)t.counted / (1 << 20));
    printf("memory of the process: %.1f MiB at most\n", (double)t.process / (1 << 20));
}

/* ---- For programs ------------------------------------------------------------- */

static void put_stage(const rt_profile_stage *s, double all)
{
    fputs("{\"name\":", stdout);
    json_string(s->name);
    printf(",\"count\":%" PRIu64, s->count);
    json_member("seconds", s->seconds);
    json_member("percent", 100 * s->seconds / all);
    json_member("beside_seconds", s->beside);
    putchar('}');
}

static void put_command(const rt_profile_command *c)
{
    fputs("{\"name\":", stdout);
    json_string(c->name);
    printf(",\"count\":%" PRIu64 ",\"%s\":%" PRIu64, c->count,
           c->is_transfer ? "bytes" : "work_items", c->amount);
    json_member("seconds", c->seconds);
    json_member("waited_seconds", c->waited);
    putchar('}');
}

void timing_print_json(const command_line *arguments)
{
    timing t;
    if (!arguments->profile)
        return;
    read_timing(&t, arguments);
    json_member("wall_seconds", t.seconds);
    fputs(",\"stages\":[", stdout);
    for (size_t i = 0; i < t.stage_count; i++) {
        if (i > 0)
            putchar(',');
        put_stage(t.stages + i, t.seconds);
    }
    fputs("],\"commands\":[", stdout);
    for (size_t i = 0; i < t.command_count; i++) {
        if (i > 0)
            putchar(',');
        put_command(t.commands + i);
    }
    fputs("],\"memory\":[", stdout);
    for (size_t i = 0; i < t.owner_count; i++) {
        fputs(i > 0 ? ",{\"name\":" : "{\"name\":", stdout);
        json_string(t.owners[i].what);
        printf(",\"bytes\":%" PRIu64 ",\"most\":%" PRIu64 "}", t.owners[i].at_most,
               t.owners[i].most);
    }
    printf("],\"memory_counted\":%" PRIu64 ",\"memory_process\":%" PRIu64, t.counted, t.process);
}

int timing_write(const command_line *arguments)
{
    const option_value *trace = &arguments->options[OPTION_PROFILE];
    rt_error error;
    if (!trace->given || !arguments->profile)
        return STATUS_DONE;
    if (rt_profile_write(arguments->profile, trace->text, &error) != RT_OK)
        return message_failure(&error);
    if (!arguments->options[OPTION_QUIET].given)
        message_note("wrote %s: ui.perfetto.dev opens it", trace->text);
    return STATUS_DONE;
}
