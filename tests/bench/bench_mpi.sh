#!/bin/sh
# bench_mpi.sh - two processes of one thread beside one of two: what it costs to share a picture.
#
#   tests/bench/bench_mpi.sh RUNNER PROGRAM
#
# `make bench-mpi` calls it with each MPI that is installed. Renders a picture of SPP (144) samples
# a pixel in turn, RUNS (default 5) times each, and prints the medians of the seconds from start to
# end and their ratio: 1 where sharing costs nothing. A second process costs a few tenths of a
# second to start, however long the picture takes. Run from the top directory, on two cores that
# nobody else uses.
set -eu

run=$1 program=$2
runs=${RUNS:-5}
samples=${SPP:-144}
work=$(mktemp -d "${TMPDIR:-/tmp}/librt-bench.XXXXXX")
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM
# Open MPI refuses root, and binds each process to a core.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 \
    OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_hwloc_base_binding_policy=none

# The seconds of a render by so many processes of so many threads.
seconds() {
    began=$(date +%s.%N)
    "$run" -np "$1" "$program" scenes/cornell.rts --threads "$2" --width 640 --height 360 \
        --spp "$samples" --quiet --out "$work/$1.pfm" >"$work/log" 2>&1 || {
        cat "$work/log" >&2
        return 1
    }
    echo "$began $(date +%s.%N)" | awk '{ print $2 - $1 }'
}

median() {
    sort -n "$1" | awk '
        { v[NR] = $1 }
        END { print NR % 2 ? v[(NR + 1) / 2] : (v[NR / 2] + v[NR / 2 + 1]) / 2 }'
}

seconds 1 2 >/dev/null # fills the kernel cache
for _ in $(seq "$runs"); do
    seconds 1 2 >>"$work/threads"
    seconds 2 1 >>"$work/processes"
done
cmp "$work/1.pfm" "$work/2.pfm"
echo "$(median "$work/threads") $(median "$work/processes")" | awk -v who="$run" '
    { printf "%s: a process of 2 threads %.2f s, 2 processes of one %.2f s, ratio %.3f\n",
             who, $1, $2, $1 / $2 }'
