#!/bin/sh
# run.sh - runs test programs one after another and sums up.
#
#   tests/run.sh PROGRAM...
#
# A program is a cmocka binary, or a shell script (*.sh) that prints a line `ok NAME` or
# `not ok NAME` for each of its tests. A program that fails is shown whole. One that
# crashes, runs past its time or runs no test counts as one failure more. The last line is
# `N passed, N failed`; the status is 0 only when something ran and nothing failed.
#
# A program of statistical tests says in a line `[  CHANCE  ] P` how often it fails where nothing is wrong, were seeds
# drawn afresh; see chance.h. More than one run of 10^4 for all programs together is a failure.
# RT_TEST_TIMEOUT is the limit of one program in seconds (default 600).
set -u

limit=${RT_TEST_TIMEOUT:-600}
log=$(mktemp "${TMPDIR:-/tmp}/librt-tests.XXXXXX") || exit 1
trap 'rm -f "$log"' EXIT
trap 'exit 130' INT TERM

# count PATTERN: the sum of the numbers that sed's PATTERN picks out of the log.
count() { sed -n "$1" "$log" | awk '{ n += $1 } END { print n + 0 }'; }

passed=0
failed=0
skipped=0
chance=0
for program in "$@"; do
    started=$(date +%s)
    case $program in
    *.sh)
        timeout -k 10 "$limit" sh "$program" >"$log" 2>&1
        status=$?
        good=$(grep -c '^ok ' "$log")
        bad=$(grep -c '^not ok ' "$log")
        skip=0
        ;;
    *)
        timeout -k 10 "$limit" "$program" >"$log" 2>&1
        status=$?
        good=$(count 's/^\[  PASSED  \] \([0-9]*\) test.*/\1/p')
        bad=$(count 's/^\[  FAILED  \] \([0-9]*\) test.*/\1/p')
        skip=$(count 's/^\[  SKIPPED \] \([0-9]*\) test.*/\1/p')
        ;;
    esac
    seconds=$(($(date +%s) - started))

    trouble=
    if [ "$status" -eq 124 ] || [ "$status" -eq 137 ]; then
        trouble="ran past $limit s"
    elif [ "$status" -gt 128 ]; then
        trouble="killed by signal $((status - 128))"
    elif [ "$status" -ne 0 ] && [ "$bad" -eq 0 ]; then
        trouble="exit status $status"
    elif [ $((good + bad + skip)) -eq 0 ]; then
        trouble='ran no test'
    fi
    [ -z "$trouble" ] || bad=$((bad + 1))

    if [ "$bad" -ne 0 ]; then
        cat "$log"
        printf 'FAIL  %s: %d passed, %d failed%s (%d s)\n' "$program" "$good" "$bad" "${trouble:+, $trouble}" "$seconds"
    else
        printf 'ok    %s: %d passed (%d s)\n' "$program" "$good" "$seconds"
        [ "$skip" -eq 0 ] || grep -B2 '^\[  SKIPPED \]' "$log"
    fi
    passed=$((passed + good))
    failed=$((failed + bad))
    skipped=$((skipped + skip))
    chance=$(awk -v sum="$chance" '$2 == "CHANCE" { sum += $4 } END { printf "%.3g", sum }' "$log")
done

[ "$skipped" -eq 0 ] || printf '%d skipped\n' "$skipped"
if awk -v sum="$chance" 'BEGIN { exit !(sum > 1e-4) }'; then
    printf 'FAIL  with fresh seeds %s of all runs would fail by chance, more than 1e-4; see tests/chance.h\n' "$chance"
    failed=$((failed + 1))
elif [ "$chance" != 0 ]; then
    printf 'with fresh seeds less than %s of all runs would fail by chance\n' "$chance"
fi
printf '%d passed, %d failed\n' "$passed" "$failed"
[ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
