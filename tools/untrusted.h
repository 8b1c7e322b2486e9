/*
 * untrusted.h - --untrusted: what a process may still do while it reads a scene that a stranger
 * wrote. By Landlock and seccomp, so on Linux alone.
 */
#ifndef RTC_UNTRUSTED_H
#define RTC_UNTRUSTED_H

#include <stddef.h>

#include "rt.h"

/* Limits of an untrusted run. */
enum {
    UNTRUSTED_CPU_SECONDS = 600,  /* of each core; then it stops as by SIGTERM */
    UNTRUSTED_WRITE_SECONDS = 30, /* of each core, after which it is killed */
    UNTRUSTED_FILE_MIB = 4096,    /* the longest file that it writes */
    UNTRUSTED_MEMORY_MIB = 4096,  /* for the scene and its render, where --memory says no other */
    UNTRUSTED_SLACK_MIB = 2048    /* addresses beyond that, where no device is opened */
};

/* What a run is going to touch. */
typedef struct untrusted_needs {
    const char *scene; /* a file, whose folder is read; "-": stdin, which has none; NULL: none */
    const char *also, *further; /* other files that are read, or NULL */
    const char *const *outputs; /* files in whose folders it writes */
    size_t output_count;
    int reads_outputs;       /* whether it reads there too, as it does to take apart a scene of
                                another program */
    int reads_here;          /* whether it reads in the current folder */
    int device;              /* whether a device will be opened, so that its driver compiles */
    const rt_memory *memory; /* whose limit is that of the scene, or NULL */
} untrusted_needs;

/*
 * From here on this process, and threads that it begins, can read what it needs and what programs
 * need of the system, write into the folders of the outputs, make no connection, signal or trace no
 * other process and gain no rights; CPU time and the length of files are limited, and memory where
 * no device is opened. It cannot be undone; called once more, it takes away what is not needed any
 * more. Files that are needed have to be regular ones, and scene and outputs to lie in their
 * folders when links are followed. Call it while the process has one thread. Returns an exit
 * status, with a message where the system cannot do that.
 */
int untrusted_confine(const untrusted_needs *needs);

/*
 * The folder, that of an output, in which a confined run may take apart a scene of another program;
 * NULL: there is none, or the run is not confined.
 */
const char *untrusted_scratch(void);

/* Closes what the program that started this one left open, but for stdin, stdout and stderr. */
void untrusted_close_inherited(void);

#endif
