#!/bin/sh
# run.sh - runs test programs, some at a time, and sums up.
#
#   tests/run.sh [-j JOBS] PROGRAM...
#
# A program is a cmocka binary, or a shell script (*.sh) that prints a line `ok NAME`,
# `not ok NAME` or `skip NAME: WHY` for each of its tests. They start in the order given, JOBS of
# them at a time: by default two more than there are cores, as a test often waits for its device.
# Name the longest first, or the last one runs alone. Each reports when it ends, in one block. A
# program that fails is shown whole. One that crashes, runs past its time or runs no test counts as
# one failure more. The last line is `N passed, N failed`; the status is 0 only when something ran
# and nothing failed.
#
# A program of statistical tests says in a line `[  CHANCE  ] P` how often it fails where nothing is
# wrong, were seeds drawn afresh; see chance.h. More than one run of 10^4 for all programs together
# is a failure.
#
# RT_TEST_TIMEOUT is the limit of one program in seconds; by default 600 for each job, as they share
# the cores.
set -u

# ---- One program: run.sh --one DIRECTORY NUMBER PROGRAM ------------------------------------------
# Writes DIRECTORY/NUMBER.log, what the program said, and DIRECTORY/NUMBER.sum, the words
# PASSED FAILED SKIPPED CHANCE SECONDS and any trouble; then prints NUMBER.

# count LOG PATTERN: the sum of the numbers that sed's PATTERN picks out of the log.
count() { sed -n "$2" "$1" | awk '{ n += $1 } END { print n + 0 }'; }

# trouble STATUS TESTS FAILED: what went wrong beside failed tests, in words.
trouble() {
    if [ "$1" -eq 124 ] || [ "$1" -eq 137 ]; then
        echo "ran past $RT_TEST_TIMEOUT s"
    elif [ "$1" -gt 128 ]; then
        echo "killed by signal $(($1 - 128))"
    elif [ "$1" -ne 0 ] && [ "$3" -eq 0 ]; then
        echo "exit status $1"
    elif [ "$2" -eq 0 ]; then
        echo 'ran no test'
    fi
}

run_one() {
    log=$1/$2.log
    started=$(date +%s)
    case $3 in *.sh) shell='sh' ;; *) shell='' ;; esac
    # In the background, as a trap waits for a command in the foreground.
    timeout -k 10 "$RT_TEST_TIMEOUT" $shell "$3" >"$log" 2>&1 </dev/null &
    child=$!
    trap 'kill "$child"; exit 130' INT TERM
    wait "$child"
    status=$?
    if [ "$shell" ]; then
        passed=$(grep -c '^ok ' "$log")
        failed=$(grep -c '^not ok ' "$log")
        skipped=$(grep -c '^skip ' "$log")
    else
        passed=$(count "$log" 's/^\[  PASSED  \] \([0-9]*\) test.*/\1/p')
        failed=$(count "$log" 's/^\[  FAILED  \] \([0-9]*\) test.*/\1/p')
        skipped=$(count "$log" 's/^\[  SKIPPED \] \([0-9]*\) test.*/\1/p')
    fi
    trouble=$(trouble "$status" $((passed + failed + skipped)) "$failed")
    [ -z "$trouble" ] || failed=$((failed + 1))
    chance=$(awk '$2 == "CHANCE" { sum += $4 } END { print sum + 0 }' "$log")
    seconds=$(($(date +%s) - started))
    echo "$passed $failed $skipped $chance $seconds $trouble" >"$1/$2.sum"
    echo "$2 $3"
}

if [ "${1:-}" = --one ]; then
    run_one "$2" "$3" "$4"
    exit 0
fi

# ---- All of them -----------------------------------------------------------------------------

jobs=$(($(nproc 2>/dev/null || echo 1) + 2))
if [ "${1:-}" = -j ]; then
    jobs=$2
    shift 2
fi
RT_TEST_TIMEOUT=${RT_TEST_TIMEOUT:-$((600 * jobs))}
export RT_TEST_TIMEOUT
# Tests render many small pictures. What one frees glibc would return to the system, for the next to
# ask for it again page by page.
export MALLOC_MMAP_MAX_=0 MALLOC_TRIM_THRESHOLD_=1000000000
work=$(mktemp -d "${TMPDIR:-/tmp}/librt-tests.XXXXXX") || exit 1
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM

number=0
for program in "$@"; do
    number=$((number + 1))
    printf '%d\n%s\n' "$number" "$program"
done >"$work/list"

# report NUMBER PROGRAM: prints how a program ended and adds to the sums.
report() {
    read -r good bad skip risk seconds trouble <"$work/$1.sum"
    if [ "$bad" -ne 0 ]; then
        cat "$work/$1.log"
        printf 'FAIL  %s: %d passed, %d failed%s (%d s)\n' "$2" "$good" "$bad" \
            "${trouble:+, $trouble}" "$seconds"
    else
        printf 'ok    %s: %d passed (%d s)\n' "$2" "$good" "$seconds"
        [ "$skip" -eq 0 ] || grep -B2 '^\[  SKIPPED \]' "$work/$1.log"
    fi
    passed=$((passed + good))
    failed=$((failed + bad))
    skipped=$((skipped + skip))
    chance=$(awk -v a="$chance" -v b="$risk" 'BEGIN { printf "%.3g", a + b }')
}

sum_up() {
    [ "$skipped" -eq 0 ] || printf '%d skipped\n' "$skipped"
    if awk -v sum="$chance" 'BEGIN { exit !(sum > 1e-4) }'; then
        printf 'FAIL  with fresh seeds %s of all runs would fail by chance, more than 1e-4; ' \
            "$chance"
        printf 'see tests/chance.h\n'
        failed=$((failed + 1))
    elif [ "$chance" != 0 ]; then
        printf 'with fresh seeds less than %s of all runs would fail by chance\n' "$chance"
    fi
    printf '%d passed, %d failed\n' "$passed" "$failed"
    [ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
}

passed=0
failed=0
skipped=0
chance=0
xargs -d '\n' -r -n 2 -P "$jobs" sh "$0" --one "$work" <"$work/list" | {
    while read -r number program; do
        report "$number" "$program"
    done
    sum_up
}
