/*
 * profile_trace.c - rt_profile_write: a profile in the Trace Event Format of Chrome, as "complete"
 * events (ph X) of microseconds. Threads are tracks of process 1, devices of process 2.
 */
#include "base/profile_trace.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/file.h"

enum { HOST = 1, DEVICES = 2, ENTRY_SIZE = 512 };

/* "text" in JSON; what would need an escape is replaced. */
static const char *plain(char out[160], const char *text)
{
    snprintf(out, 160, "%s", text);
    for (char *c = out; *c; c++)
        if (*c == '"' || *c == '\\' || (unsigned char)*c < ' ' || (unsigned char)*c > '~')
            *c = '?';
    return out;
}

static rt_status put(rt_bytes *bytes, const char *text, rt_error *error)
{
    return rt_bytes_put(bytes, bytes->size, text, strlen(text), error);
}

/* Names a track, or for a kind of "process_name" all tracks of a process. */
static rt_status put_name(rt_bytes *bytes, const char *kind, int process, size_t track,
                          const char *name, rt_error *error)
{
    char entry[ENTRY_SIZE], text[160];
    snprintf(entry, sizeof entry,
             "{\"name\":\"%s\",\"ph\":\"M\",\"pid\":%d,\"tid\":%zu,\"args\":{\"name\":\"%s\"}},\n",
             kind, process, track, plain(text, name));
    return put(bytes, entry, error);
}

static rt_status put_names(rt_bytes *bytes, const rt_profile *p, rt_error *error)
{
    rt_status status = put_name(bytes, "process_name", HOST, 0, "host", error);
    if (status == RT_OK && p->devices.count > 0)
        status = put_name(bytes, "process_name", DEVICES, 0, "devices", error);
    for (size_t i = 0; i < p->threads.count && status == RT_OK; i++) {
        char name[32];
        snprintf(name, sizeof name,
                 pthread_equal(p->threads.items[i].id, p->maker) ? "main" : "thread %zu", i);
        status = put_name(bytes, "thread_name", HOST, i, name, error);
    }
    for (size_t i = 0; i < p->devices.count && status == RT_OK; i++)
        status = put_name(bytes, "thread_name", DEVICES, i, p->devices.items[i].name, error);
    return status;
}

static rt_status put_event(rt_bytes *bytes, const rt_profile *p, const rt_profile_event *e,
                           rt_error *error)
{
    char entry[ENTRY_SIZE], text[160], args[64] = "";
    const rt_profile_command *command = e->name ? NULL : p->commands.items + e->command;
    if (command)
        snprintf(args, sizeof args, ",\"args\":{\"%s\":%" PRIu64 "}",
                 command->is_transfer ? "bytes" : "work-items", e->amount);
    snprintf(entry, sizeof entry,
             ",{\"name\":\"%s\",\"cat\":\"%s\",\"ph\":\"X\",\"ts\":%.3f,\"dur\":%.3f,\"pid\":%d,"
             "\"tid\":%" PRIu32 "%s}\n",
             plain(text, command ? command->name : e->name),
             !command               ? "stage"
             : command->is_transfer ? "transfer"
                                    : "kernel",
             1e6 * (e->began - p->began), 1e6 * e->seconds, command ? DEVICES : HOST, e->track,
             args);
    return put(bytes, entry, error);
}

rt_status rt_profile_write(const rt_profile *profile, const char *path, rt_error *error)
{
    rt_bytes bytes = {0};
    if (rt_is_missing(profile, "profile", error) || rt_is_missing(path, "path", error))
        return RT_ERROR_USAGE;
    if (!profile->has_trace)
        return rt_fail(error, RT_ERROR_USAGE, "the profile keeps no trace");
    rt_status status = put(&bytes, "{\"displayTimeUnit\":\"ms\",\"traceEvents\":[\n", error);
    if (status == RT_OK)
        status = put_names(&bytes, profile, error);
    /* The host above the devices. Metadata end with commas, events begin with them. */
    if (status == RT_OK)
        status = put(&bytes,
                     "{\"name\":\"process_sort_index\",\"ph\":\"M\",\"pid\":1,\"tid\":0,"
                     "\"args\":{\"sort_index\":-1}}\n",
                     error);
    for (size_t i = 0; i < profile->events.count && status == RT_OK; i++)
        status = put_event(&bytes, profile, profile->events.items + i, error);
    if (status == RT_OK)
        status = put(&bytes, "]}\n", error);
    if (status == RT_OK)
        status = rt_file_replace(path, &bytes, error);
    rt_bytes_free(&bytes);
    return status;
}
