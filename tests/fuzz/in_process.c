/*
 * in_process.c - stands in for tools/interrupt.c and tools/untrusted.c: here one program runs many
 * commands, so that none may begin a thread which waits for signals, or give up rights for good.
 */
#include "tools/interrupt.h"
#include "tools/status.h"
#include "tools/untrusted.h"

void interrupt_block(void)
{
}

void interrupt_catch(int in_json, int quiet)
{
    (void)in_json;
    (void)quiet;
}

void interrupt_defer(void)
{
}

void interrupt_request(void)
{
}

void interrupt_hold(void)
{
}

int interrupt_is_ending(void)
{
    return 0;
}

void interrupt_release(void)
{
}

int interrupt_pending(void)
{
    return 0;
}

int untrusted_confine(const untrusted_needs *needs)
{
    (void)needs;
    return STATUS_DONE;
}

const char *untrusted_scratch(void)
{
    return NULL;
}

void untrusted_close_inherited(void)
{
}
