#!/bin/sh
# kills.sh - renders that are killed at random times and gone on with, again and again, have the
# bytes of one that was left alone.
#
#   tests/tools/kills.sh [KILLS]    so many kills in all, 100 by default
#
# `make check-kills` calls it. Each render of a list is begun with --checkpoint and --every 0.1,
# killed by SIGKILL after a random part of its time, and gone on with until it ends or its kills are
# used up; its image is then compared with that of a whole render. Prints what it did; the status is
# 1 where an image differs.
set -u
cd "$(dirname "$0")/../.." || exit 1
rtc=$PWD/build/rtc
scene=$PWD/scenes/cornell.rts
kills=${1:-100}
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 2

random() { awk -v seed="$1" -v most="$2" 'BEGIN { srand(seed); printf "%.3f", rand() * most }'; }

# run NAME SECONDS OPTION...: kills it `each` times; SECONDS is what a part of it is given at most.
run() {
    name=$1
    most=$2
    shift 2
    "$rtc" "$scene" --width 160 --height 120 "$@" --quiet --out "$name.whole.exr" || exit 2
    done=0
    round=0
    while [ "$done" -lt "$each" ]; do
        round=$((round + 1))
        rm -f "$name.rtpart" "$name.exr"
        while [ "$done" -lt "$each" ]; do
            if [ -f "$name.rtpart" ]; then
                "$rtc" --resume "$name.rtpart" --quiet 2>err &
            else
                "$rtc" "$scene" --width 160 --height 120 "$@" --quiet --out "$name.exr" \
                    --checkpoint "$name.rtpart" --every 0.1 2>err &
            fi
            pid=$!
            sleep "$(random $((seed + done)) "$most")"
            kill -KILL "$pid" 2>/dev/null || break
            wait "$pid" 2>/dev/null
            [ $? -eq 137 ] || break
            done=$((done + 1))
        done
        wait "$pid" 2>/dev/null
        if [ -f "$name.rtpart" ]; then
            "$rtc" --resume "$name.rtpart" --quiet || exit 2
            if ! cmp -s "$name.whole.exr" "$name.exr"; then
                echo "not ok $name: after $done kills the image differs"
                bad=1
                return
            fi
        fi
    done
    echo "ok $name: $done kills, $round renders gone on with to the bytes of a whole one"
}

seed=$(date +%s)
bad=0
each=$((kills / 4))
echo "seed $seed"
run path 1.5 --mode path --spp 300
run error 1.5 --mode path --spp 200 --variance
run passes 2.5 --mode photon --photons 20000 --passes 60
run photons 2.5 --mode photon --photons 100000 --k 50 --spp 6
exit $bad
