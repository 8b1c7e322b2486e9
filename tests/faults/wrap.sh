#!/bin/sh
# wrap.sh - prints the options by which the linker wraps the calls of calls.inc.h and fault.c.
set -u
folder=$(dirname "$0")
{
    tr '\n' ' ' <"$folder/calls.inc.h" | grep -o 'FAULT([^,]*, *[A-Za-z_]*' | sed 's/.*[, ]//'
    grep -o '__wrap_[a-z_]*(' "$folder/fault.c" | sed 's/__wrap_//; s/(//'
} | grep -vx name |
    sort -u | sed 's/^/-Wl,--wrap=/'
