/*
 * no_interrupt.c - stands in for tools/interrupt.c, whose thread waits for signals until the
 * program ends: here one program runs many commands.
 */
#include "tools/interrupt.h"

void interrupt_catch(int in_json, int quiet)
{
    (void)in_json;
    (void)quiet;
}

void interrupt_defer(void)
{
}

int interrupt_pending(void)
{
    return 0;
}
