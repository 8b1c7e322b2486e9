#!/bin/sh
# test_arguments.sh - the benchmarks refuse what they do not know before they measure anything.
set -u
command -v python3 >/dev/null || {
    echo 'ok skipped: there is no python3'
    exit 0
}
bad=0

# refuses NAME MESSAGE PROGRAM ARGUMENT...: the test passes when the program fails and says so.
refuses() {
    name=$1 message=$2 program=$3
    shift 3
    if said=$(python3 "tests/bench/$program" --build /nonexistent "$@" 2>&1) ||
        ! printf '%s\n' "$said" | grep -q "^$message" || printf '%s\n' "$said" | grep -q Traceback
    then
        printf 'not ok %s\n    %s\n' "$name" "$said"
        bad=1
    else
        printf 'ok %s\n' "$name"
    fi
}

refuses runs_are_counted_from_1 'RUNS: 0 runs measure nothing' bench.py --runs 0
refuses an_unknown_measurement "ONLY: there is no 'gahter'; there are cornell, mesh, trace" \
    bench.py --only gahter
refuses an_unknown_scene "SUITE: there is no 'door'; there are box_area" bench.py --suite door
refuses an_unknown_technique "--only: there is no 'mlt'; there are pt, lt, ppm" \
    smallvcm.py --only mlt /nonexistent
refuses an_unknown_study "ONLY: there is no 'light'; there are " scaling.py --only light
exit $bad
