#!/bin/sh
# kills.sh - renders and emissions that are killed at random times and gone on with, again and
# again, have the bytes of those that were left alone.
#
#   RTC=build/rtc tests/tools/kills.sh [KILLS [SEED]]    so many kills in all, 100 by default
#
# `make check-kills` calls it. Each work of a list is begun with --checkpoint --every 1, killed by
# SIGKILL after a random time of at most 4 s, gone on with by --resume, and killed again, until it
# ends; then it begins anew, until its kills are used up. What a finished one wrote is compared with
# what a whole one wrote. A kill counts when a checkpoint is there to go on from; before the first
# one, the work is begun anew. Prints the seed and the counts; the status is 1 where bytes differ.
set -u
cd "$(dirname "$0")/../.." || exit 1
rtc=$PWD/${RTC:-build/rtc}
scenes=$PWD/scenes
kills=${1:-100}
seed=${2:-$(date +%s)}
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 2

# Random times, one a line.
awk -v seed="$seed" 'BEGIN {
    srand(seed)
    for (i = 0; i < 20000; i++)
        printf "%.3f\n", 4 * rand()
}' >nap_times
exec 3<nap_times

fail() {
    echo "not ok $name: $*"
    [ ! -s err ] || sed 's/^/    /' err
    exit 1
}

# begin OUTPUT [OPTION...]: the work from its start.
begin() {
    out=$1
    shift
    if [ "$kind" = map ]; then
        # shellcheck disable=SC2086 # words
        exec "$rtc" photons "$scenes/textured_mesh.rts" $options --quiet --out "$out" "$@"
    fi
    # shellcheck disable=SC2086
    exec "$rtc" "$scenes/cornell.rts" --width 160 --height 120 $options --quiet --out "$out" "$@"
}

# Goes on from the checkpoint. A map's options are given again.
go_on() {
    if [ "$kind" = map ]; then
        begin "$name.$extension" --resume "$checkpoint" --every 1
    fi
    exec "$rtc" --resume "$checkpoint" --quiet
}

# Begins the work or goes on with it, and kills it; the status is 1 where it ended before.
run_and_kill() {
    read -r nap <&3
    if [ -f "$checkpoint" ]; then
        (go_on) 2>err &
    else
        (begin "$name.$extension" --checkpoint "$checkpoint" --every 1) 2>err &
    fi
    pid=$!
    sleep "$nap"
    kill -KILL "$pid" 2>/dev/null
    wait "$pid" 2>/dev/null
    status=$?
    [ $status -eq 137 ] && return 0
    [ $status -eq 0 ] || fail "it ends with status $status"
    return 1
}

# To the end, and compared.
finish() {
    [ ! -f "$checkpoint" ] || (go_on) 2>err || fail "it cannot be gone on with"
    cmp -s "$name.whole.$extension" "$name.$extension" ||
        fail "after $done kills the bytes differ (seed $seed)"
    works=$((works + 1))
}

# test_work NAME film|map OPTIONS
test_work() {
    name=$1
    kind=$2
    options=$3
    extension=exr
    checkpoint=$name.rtpart
    if [ "$kind" = map ]; then
        extension=rtp
        checkpoint=$name.kept.rtp
    fi
    (begin "$name.whole.$extension") || exit 2
    done=0
    early=0
    works=0
    while [ "$done" -lt "$each" ]; do
        rm -f "$checkpoint" "$name.$extension"
        while [ "$done" -lt "$each" ] && run_and_kill; do
            if [ -f "$checkpoint" ]; then
                done=$((done + 1))
            else
                early=$((early + 1))
            fi
        done
        finish
    done
    echo "ok $name: $done kills, each gone on from; $early before the first checkpoint;" \
        "$works finished, with the bytes of a whole one"
    all=$((all + done))
}

all=0
each=$(((kills + 4) / 5))
echo "seed $seed"
test_work path film '--mode path --spp 320'
test_work error film '--mode path --spp 100000 --target-error 0.06'
test_work passes film '--mode photon --photons 20000 --passes 100'
test_work gathering film '--mode photon --photons 100000 --k 50 --spp 40'
test_work emission map '--photons 1e7 --caustic-photons 1e6'
echo "$all kills in all"
