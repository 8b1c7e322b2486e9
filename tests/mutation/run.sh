#!/bin/sh
# run.sh - applies the mutations to a copy of the sources, one at a time, and reports which of
# them the tests detect.
#
#   tests/mutation/run.sh [NAME...]
#
# NAME: a mutation of mutations.txt; all of them by default. The copy is built and tested as it is
# first: a test that fails there proves nothing. Then each mutation is planted, and its tests run
# until one fails. What passes them all meets the other tests of light, and only what passes those
# has survived. What does not build is broken, and counts as no mutation; compile.sh finds these in
# less than a minute.
#
# The last line is `N of N caught`. Status: 0; 1 when more than one in thirty survive; 2 when a
# mutation does not fit the sources or is broken, or the tests fail without it.
#
# RT_MUTATION_DIR is the directory of the copy, build/mutation by default; two runs at once need
# two.
# shellcheck disable=SC2046,SC2086 # names of tests and mutations are lists of words
set -u

here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
work=${RT_MUTATION_DIR:-$root/build/mutation}
mkdir -p "$work" && work=$(cd "$work" && pwd) || exit 2
tree=$work/tree
log=$work/log
table=$here/mutations.txt
. "$here/table.sh"

# The copy's make is one of its own; variables given to the outer one are in the environment.
unset MAKEFLAGS MFLAGS MAKELEVEL MAKEOVERRIDES
jobs=$(getconf _NPROCESSORS_ONLN)
RT_TEST_TIMEOUT=${RT_TEST_TIMEOUT:-300}
POCL_CACHE_DIR=$work/kernels
export RT_TEST_TIMEOUT POCL_CACHE_DIR

die() {
    printf 'run.sh: %s\n' "$1" >&2
    exit 2
}

# Brings the copy to the state of the sources; what is the same there keeps its date, and need not
# be built again.
refresh() {
    (cd "$root" && find Makefile lib kernels dsl tools tests scenes -type f) |
        while IFS= read -r source; do
            cmp -s "$root/$source" "$tree/$source" && continue
            mkdir -p "$tree/$(dirname "$source")"
            cp "$root/$source" "$tree/$source" || exit 1
        done || die "cannot copy the sources to $tree"
}

# passes TEST: builds a test of the copy, and the program that tests of tools start, and runs it.
# What does not build, for the host or the device, fails and sets `broken`.
passes() {
    case $1 in tools/*) program=build/rtc ;; *) program= ;; esac
    if ! make -s -C "$tree" -j "$jobs" "build/tests/$1" $program >"$log" 2>&1; then
        broken="$1 does not build"
        return 1
    fi
    (cd "$tree" && sh tests/run.sh "build/tests/$1") >"$log" 2>&1 && return 0
    ! grep -q 'does not build on' "$log" || broken="a kernel of $1 does not build"
    return 1
}

fail_with_log() {
    tail -n 40 "$log" >&2
    die "$name: $1"
}

# What failed in the log: the first of the tests, or what ended them.
first_failure() {
    failure=$(sed -n '/listed below:$/d; s/^\[  FAILED  \] //p' "$log" | head -n 1)
    printf '%s' "${failure:-$(sed -n 's/^FAIL .* failed, \(.*\) ([0-9]* s)$/\1/p' "$log")}"
}

# find_catch TEST...: sets `caught` to the test that fails, and in it what does; empty when all
# pass, or what is planted is broken.
find_catch() {
    caught=
    broken=
    for test in "$@"; do
        passes "$test" && continue
        [ -z "$broken" ] || return
        caught="$test: $(first_failure)"
        return
    done
}

# The tests of light that the mutation does not name.
other_tests() {
    for test in $(mutation_rest); do
        case " $tests " in *" $test "*) ;; *) printf '%s ' "$test" ;; esac
    done
}

# All tests must pass on the sources as they are.
expect_passes() {
    for test in "$@"; do
        passes "$test" || fail_with_log "${broken:-$test fails without a mutation}"
    done
}

plant_mutation() {
    plant "$(mutation_field "$name" old)" "$(mutation_field "$name" new)" \
        <"$root/$file" >"$tree/$file" || die "$name does not fit $file"
}

take_back() { cp "$root/$file" "$tree/$file"; }

# Plants a mutation, tests, and takes it back.
try_mutation() {
    file=$(mutation_field "$name" file)
    tests=$(mutation_field "$name" tests)
    plant_mutation
    find_catch $tests
    if [ -z "$caught$broken" ]; then
        take_back
        expect_passes $(other_tests)
        plant_mutation
        find_catch $(other_tests)
    fi
    take_back
}

command -v flock >/dev/null || die 'flock is missing (Debian: util-linux)'
mkdir -p "$tree" "$POCL_CACHE_DIR" || exit 2
exec 9>"$work/lock"
flock -n 9 || die "another run uses $work; set RT_MUTATION_DIR"

[ $# -gt 0 ] || set -- $(mutation_names)
for name in "$@"; do
    [ -n "$(mutation_field "$name" file)" ] || die "no mutation '$name' in $table"
done
began=$(date +%s)
refresh

name=none
expect_passes $(for name in "$@"; do mutation_field "$name" tests; done | tr ' ' '\n' | sort -u)
printf 'the tests pass without a mutation (%d s)\n' $(($(date +%s) - began))

total=0
survivors=
all_broken=
for name in "$@"; do
    started=$(date +%s)
    try_mutation
    if [ -n "$broken" ]; then
        verdict=broken
        all_broken="$all_broken $name"
    else
        total=$((total + 1))
        verdict=caught
        [ -n "$caught" ] || verdict=survived survivors="$survivors $name"
    fi
    printf '%-9s %-27s %s (%d s)\n' "$verdict" "$name" "${broken:-$caught}" \
        $(($(date +%s) - started))
done

set -- $survivors
[ $# -eq 0 ] || printf 'survived: %s\n' "$*"
printf '%d of %d caught (%d s)\n' $((total - $#)) "$total" $(($(date +%s) - began))
[ -z "$all_broken" ] || die "broken:$all_broken"
[ $(($# * 30)) -le "$total" ]
