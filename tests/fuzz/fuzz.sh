#!/bin/sh
# fuzz.sh - runs the targets of fuzzing under libFuzzer, one after another, and says how far they
# came.
#
#   tests/fuzz/fuzz.sh --seconds S [TARGET...]   S seconds of CPU time for each target
#   tests/fuzz/fuzz.sh --hours H [TARGET...]     until each has had H hours, in turns of ten minutes
#   tests/fuzz/fuzz.sh --unreached TARGET        the functions of its own files that its corpus does
#                                                not call, and the branches that it does not take
#   tests/fuzz/fuzz.sh --totals                  what each reader has had, by record and log
#   tests/fuzz/fuzz.sh --record                  moves that from the log to the record
#
# `make fuzz` and `make check-fuzz` build what it needs and call it. Inputs that reached something
# new are kept in FUZZ_CORPUS/TARGET and begin the next run. For each turn a line is printed and
# added to FUZZ_LOG (fuzz.log beside the corpus): date, target, code, CPU seconds, executions,
# edges reached of those in the target's own files, inputs in the corpus, findings. An input that
# breaks a promise is left in build/fuzz/findings; the status is then 1.
#
# Each target is a program of its own, with no more of the library than it needs. What it did counts
# for as long as the code compiled from its own files, those of `make_inputs list`, is the same,
# whatever else changes: that is known by its SHA-256 without debug information. The record,
# hours.txt, is kept with the sources.
set -u
cd "$(dirname "$0")/../.." || exit 1
top=$PWD
record=$top/tests/fuzz/hours.txt
edges=$top/build/fuzz/edges/fuzz # without sanitizers, whose branches are none of the program
inputs=$top/build/tests/fuzz/make_inputs
corpus=${FUZZ_CORPUS:-build/fuzz/corpus}
turn_seconds=600
memory=2048 # MiB of a process
largest=1100 # MiB of one allocation: 1 GiB of values is the most that a reader takes unasked

stop() {
    printf 'fuzz: %s\n' "$1" >&2
    exit 2
}

# Folders are named from the root: the targets leave the directory.
mkdir -p "$corpus" build/fuzz/findings || exit 2
corpus=$(cd "$corpus" && pwd)
log=${FUZZ_LOG:-$(dirname "$corpus")/fuzz.log}
symbolizer=$(command -v llvm-symbolizer-14 || command -v llvm-symbolizer)

# Scratch files in memory where there is such a folder: one is written for each input.
base=/tmp
[ -w /dev/shm ] && base=/dev/shm
work=$(mktemp -d "$base/rt-fuzz.XXXXXX") || exit 2
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM

# words TARGET: its dictionary: words of the program's tables, else all that its own files compare
# with, the short strings in them.
words() {
    "$inputs" words "$1"
    # shellcheck disable=SC2046 # patterns of files without spaces
    grep -oh '"[A-Za-z_][A-Za-z_0-9]\{1,15\}"' $(sources_of "$1") | sort -u
}

sources_of() { "$inputs" list | sed -n "s/^$1 [0-9]* //p"; }
size_of() { "$inputs" list | sed -n "s/^$1 \([0-9]*\) .*/\1/p"; }

is_built() { [ -x "$top/build/fuzz/fuzz-$1" ]; }

# reader_of TARGET: what the code of its own files is known by; "none" where that cannot be told.
reader_of() {
    is_built "$1" || {
        echo none
        return
    }
    for source in $(sources_of "$1"); do
        object=$top/build/fuzz/${source%.*}.o
        [ -f "$object" ] || continue # a header, or of a program besides the library
        strip -g -o "$work/stripped" "$object" && cat "$work/stripped" || echo none
    done >"$work/reader"
    if [ -s "$work/reader" ] && [ "$(tail -c 5 "$work/reader")" != none ]; then
        sha256sum <"$work/reader" | cut -c 1-16
    else
        echo none
    fi
}

# libfuzzer PROGRAM TARGET ARGUMENT...: one run of it in a scratch folder of its own.
libfuzzer() {
    program=$1
    name=$2
    shift 2
    env RT_FUZZ="$name" TMPDIR="$work" ASAN_SYMBOLIZER_PATH="$symbolizer" \
        ASAN_OPTIONS="allocator_may_return_null=1:detect_leaks=1" \
        LSAN_OPTIONS="suppressions=$top/tests/leaks.supp:print_suppressions=0" \
        "$program" -timeout=3600 -rss_limit_mb=$memory -malloc_limit_mb=$largest "$@" </dev/null
    status=$?
    rm -rf "$work"/rt-fuzz-*
    return $status
}

# make_seeds TARGET: into $work/seeds.
make_seeds() {
    mkdir -p "$corpus/$1"
    rm -rf "$work/seeds"
    mkdir "$work/seeds"
    "$inputs" seeds "$1" "$work/seeds"
}

# replay TARGET: runs its seeds and the inputs of its corpus, and leaves what they reach in
# $work/reached, a line for each function, and $work/profile.
replay() {
    LLVM_PROFILE_FILE=$work/profile libfuzzer "$edges" "$1" -runs=0 -print_coverage=1 \
        "$corpus/$1" "$work/seeds" >"$work/reached" 2>&1
}

# count_edges TARGET: "REACHED ALL" of the edges in its own files, after replay.
count_edges() {
    # shellcheck disable=SC2046 # patterns of files without spaces
    awk -v files="$(printf '%s ' $(sources_of "$1"))" -v top="$top/" '
        BEGIN { count = split(files, list, " "); for (i = 1; i <= count; i++) own[list[i]] }
        $1 ~ /COVERED_FUNC:$/ {
            file = index($NF, top) == 1 ? substr($NF, length(top) + 1) : $NF
            sub(/^\.\//, "", file)
            sub(/:[0-9]*$/, "", file)
            for (i = 2; file in own && i < NF; i++)
                if ($i == "edges:") {
                    split($(i + 1), part, "/")
                    reached += part[1]
                    all += part[2]
                }
        }
        END { print reached + 0, all + 0 }' "$work/reached"
}

# unreached TARGET: functions that are not called, and branches that are not taken, after replay.
unreached() {
    llvm=$(dirname "$(readlink -f "$symbolizer")")
    "$llvm/llvm-profdata" merge -o "$work/merged" "$work/profile" || exit 2
    "$llvm/llvm-cov" export -format=lcov -instr-profile="$work/merged" "$edges" >"$work/lcov" ||
        exit 2
    # shellcheck disable=SC2046 # patterns of files without spaces
    awk -F '[:,]' -v files="$(printf '%s ' $(sources_of "$1"))" -v top="$top/" '
        BEGIN { count = split(files, list, " "); for (i = 1; i <= count; i++) own[list[i]] }
        $1 == "SF" { file = $2; sub(top, "", file); sub(/^\.\//, "", file); is_own = file in own }
        !is_own { next }
        # A function of a header is there once for each file that includes it.
        $1 == "FNDA" { calls[file ": " $NF] += $2 }
        $1 == "BRDA" { taken[file ":" $2, int($4 / 2) + 1, $4 % 2 ? "false" : "true"] += $5 }
        END {
            for (f in calls) if (!calls[f]) print f " is not called"
            for (b in taken) {
                split(b, at, SUBSEP)
                other = at[3] == "true" ? "false" : "true"
                if (!taken[b] && taken[at[1], at[2], other])
                    print at[1] ": condition " at[2] " is never " at[3]
            }
        }' "$work/lcov" | sort -t : -k 1,1 -k 2,2n -k 3
}

# stat_of NAME: a number of libFuzzer's summary; 0 where it has none.
stat_of() {
    stat=$(sed -n "s/^stat::$1: *//p" "$work/log" | tail -n 1)
    echo "${stat:-0}"
}

# cpu_seconds FILE: CPU seconds of all programs that have ended so far, however they ended.
cpu_seconds() {
    times >"$work/times" # not in a subshell, which has no children
    awk -F '[ms ]+' 'NR == 2 { printf "%.1f\n", 60 * $1 + $2 + 60 * $3 + $4 }' "$work/times" >"$1"
}

# turn TARGET SECONDS: one run, until it has used so much CPU time.
turn() {
    make_seeds "$1"
    words "$1" >"$work/words"
    printf '"\\x%s"\n' 00 ff >>"$work/words" # libFuzzer refuses an empty dictionary
    cpu_seconds "$work/before"
    RT_FUZZ_SECONDS=$2 libfuzzer "$top/build/fuzz/fuzz-$1" "$1" -dict="$work/words" \
        -max_len="$(size_of "$1")" -print_final_stats=1 -verbosity=1 \
        -artifact_prefix="$top/build/fuzz/findings/$1-" "$corpus/$1" "$work/seeds" \
        >"$work/log" 2>&1
    ended=$?
    cpu_seconds "$work/after"
    found=0
    if [ $ended -ne 0 ]; then
        found=1
        grep -v '^#' "$work/log" | tail -n 60 >&2
    fi
    replay "$1"
    # shellcheck disable=SC2046 # two numbers
    set -- "$1" $(count_edges "$1")
    used=$(paste "$work/before" "$work/after" | awk '{ print $2 - $1 }')
    done=$(stat_of number_of_executed_units)
    line=$(printf '%s %s %s %s %s %s %s %s' "$1" "$(reader_of "$1")" "$used" "$done" "$2" "$3" \
        "$(find "$corpus/$1" -type f | wc -l)" "$found")
    printf '%s %s\n' "$(date -u +%Y-%m-%dT%H:%M:%SZ)" "$line" >>"$log"
    report "$line"
    return $found
}

# report "TARGET PROGRAM CPU EXECUTIONS REACHED ALL INPUTS FINDINGS"
report() {
    echo "$1" | awk '{
        printf "%-10s %8.0f CPU s %12.0f executions %7.0f/s  edges %5d of %5d  corpus %5d  " \
            "findings %d\n", $1, $3, $4, ($3 > 0 ? $4 / $3 : 0), $5, $6, $7, $8
    }'
}

# sums TARGET: what its reader as it is built now has done, in the form of `report`, by record and
# log; edges and inputs are the most that a turn had.
sums() {
    cat "$record" "$log" 2>/dev/null | awk -v target="$1" -v reader="$(reader_of "$1")" '
        $2 == target && $3 == reader {
            cpu += $4
            runs += $5
            bad += $9
            for (i = 6; i <= 8; i++) if ($i > most[i]) most[i] = $i
        }
        END { printf "%s %s %.1f %.0f %d %d %d %d\n", target, reader, cpu, runs, most[6], most[7],
                     most[8], bad }'
}

# What the programs that are built have done.
totals() {
    for target in $("$inputs" list | sed 's/ .*//'); do
        if is_built "$target"; then
            report "$(sums "$target")"
        fi
    done
}

# Gives the record a line for each reader that is built, in place of the target's lines before, and
# takes these turns from the log.
keep() {
    targets=$("$inputs" list | sed 's/ .*//')
    [ -n "$targets" ] || stop "there is no $inputs"
    [ -f "$log" ] || stop "there is no $log yet"
    sed -n '/^#/p' "$record" >"$work/record"
    cp "$log" "$work/kept"
    for target in $targets; do
        if is_built "$target"; then
            sums "$target" | awk -v day="$(date -u +%Y-%m-%d)" '$3 > 0 { print day, $0 }'
            awk -v target="$target" '$2 != target' "$work/kept" >"$work/left"
            mv "$work/left" "$work/kept"
        else
            awk -v target="$target" '$2 == target' "$record"
        fi
    done >>"$work/record"
    cp "$work/record" "$record" && cp "$work/kept" "$log"
}

# run_all SECONDS TARGET...: so much for each, in turns, so that all come as far when it is stopped.
run_all() {
    left=$1
    shift
    bad=0
    while [ "$left" -gt 0 ]; do
        now=$((left < turn_seconds ? left : turn_seconds))
        for target; do
            turn "$target" "$now" || bad=1
        done
        left=$((left - now))
    done
    return $bad
}

# run_until SECONDS TARGET...: turns until the program of each has had so many, or a finding.
run_until() {
    enough=$1
    shift
    bad=0
    ran=1
    over=' '
    while [ $ran -gt 0 ]; do
        ran=0
        for target; do
            case $over in *" $target "*) continue ;; esac
            left=$(sums "$target" | awk -v enough="$enough" '{
                left = enough - $3
                print left <= 0 ? 0 : left < 10 ? 10 : int(left) + 1 }')
            [ "$left" -gt 0 ] || continue
            ran=1
            turn "$target" $((left < turn_seconds ? left : turn_seconds)) || {
                bad=1
                over="$over$target "
            }
        done
    done
    return $bad
}

case ${1:-} in
--seconds) [ $# -ge 2 ] || stop 'which number of seconds?' ;;
--hours) [ $# -ge 2 ] || stop 'which number of hours?' ;;
--unreached) [ $# -eq 2 ] || stop 'which target?' ;;
--totals | --record) [ $# -eq 1 ] || stop "$1 takes no word" ;;
*) stop 'usage: fuzz.sh --seconds S | --hours H [TARGET...], --unreached T, --totals, --record' ;;
esac
what=$1
amount=${2:-}
case $what in
--totals)
    totals
    exit
    ;;
--record)
    keep
    exit
    ;;
--unreached)
    make_seeds "$amount"
    replay "$amount"
    count_edges "$amount" | awk '{ printf "%d of %d edges are reached\n", $1, $2 }'
    unreached "$amount"
    exit
    ;;
esac
shift 2
# shellcheck disable=SC2046 # words without spaces
[ $# -gt 0 ] || set -- $("$inputs" list | sed 's/ .*//')
for target; do
    [ "$(reader_of "$target")" != none ] || stop "there is no build/fuzz/fuzz-$target"
done
case $what in
--seconds) run_all "$amount" "$@" ;;
--hours) run_until "$(awk -v h="$amount" 'BEGIN { printf "%d", 3600 * h }')" "$@" ;;
esac
