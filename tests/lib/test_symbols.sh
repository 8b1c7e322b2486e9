#!/bin/sh
# test_symbols.sh - what the library promises about itself, read from its objects: it never prints,
# exits or touches signals, locale or environment, and it has no writable data outside the files
# that own FLANN, OpenMesh and OpenCL's drivers, which have global state of their own. The drivers'
# files alone read and set the environment, and remove a folder when the process ends. Programs are
# started and ended by those two files alone that compile with the compiler of rt_device_options.
set -u
library=build/librt.a
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
bad=0

# check NAME FILE: the test passes when FILE, which lists offences, is empty.
check() {
    if [ -s "$2" ]; then
        printf 'not ok %s\n' "$1"
        sed 's/^/    /' "$2"
        bad=1
    else
        printf 'ok %s\n' "$1"
    fi
}

drivers='(kernel_cache|work_folder)\.o'
compilers='(compile|compiler)\.o'

# uses NAME REGEX...: no object of the library calls a function of these names; for uses_outside,
# no object but those named.
uses() {
    name=$1
    shift
    nm -A -u "$library" | grep -E "[: ]U ($(echo "$*" | tr ' ' '|'))(@.*)?\$" >"$work/offences"
    check "$name" "$work/offences"
}
uses_outside() {
    name=$1 files=$2
    shift 2
    nm -A -u "$library" | grep -E "[: ]U ($(echo "$*" | tr ' ' '|'))(@.*)?\$" |
        grep -v -E ":$files:" >"$work/offences"
    check "$name" "$work/offences"
}

nm -A "$library" >"$work/all" 2>&1 || echo "nm $library failed" >>"$work/unreadable"
grep -q ' T rt_render$' "$work/all" || echo "no rt_render in $library" >>"$work/unreadable"
: >>"$work/unreadable"
check library_is_readable "$work/unreadable"

uses never_prints '(v|f|vf|w|fw)?printf' '__(f|vf)?printf_chk' 'puts|fputs|fputc|putc|putchar' \
    'perror|psignal|vsyslog|syslog' 'stdout|stderr'
uses never_exits '_?exit|_Exit|abort|quick_exit|on_exit|err|errx|verr'
uses_outside never_acts_at_exit "$drivers" 'atexit'
uses never_touches_signals 'signal|sigaction|sigprocmask|pthread_sigmask|raise|alarm' \
    'setitimer|sigsetjmp|__sigsetjmp'
uses never_touches_locale_or_folder 'setlocale|uselocale|newlocale' 'chdir|fchdir|umask'
uses_outside never_touches_environment "$drivers" \
    'setenv|unsetenv|putenv|getenv|secure_getenv|clearenv'
uses never_runs_programs 'system|popen|fork|vfork|exec[a-z]*'
uses_outside never_runs_programs_but_the_compiler "$compilers" 'posix_spawnp?' 'kill'
uses never_draws_from_hidden_state 'rand|srand|random|srandom|drand48' \
    'strtok|localtime|gmtime|asctime|ctime|strerror'

# Constant tables of pointers stand in .data.rel.ro, which is read-only once the program runs.
objdump -t "$library" | awk '
    /^[^ ]+: +file format/ { sub(/:.*/, "", $1); object = $1; next }
    object == "flann_shim.o" || object == "openmesh_shim.o" { next }
    object == "kernel_cache.o" || object == "work_folder.o" { next }
    /\.data\.rel\.ro/ { next }
    / O / && /[ \t](\.data|\.bss|\.tdata|\.tbss|\*COM\*)/ { print object ": " $0 }
    ' >"$work/offences"
check no_writable_data_outside_what_owns_a_library "$work/offences"

objdump -t "$library" | grep -E '[ \t]O[ \t]+\.(data|bss)' |
    grep -v '\.data\.rel\.ro' >"$work/flann"
: >"$work/offences"
[ -s "$work/flann" ] || echo 'not even the file that owns FLANN has any' >"$work/offences"
check writable_data_is_seen_where_it_is "$work/offences"

# What other programs can link against: names of the library alone.
nm -D --defined-only build/librt-render.so.0 | awk '$3 !~ /^rt_/ { print }' >"$work/offences"
check exports_only_rt_names "$work/offences"
exit $bad
