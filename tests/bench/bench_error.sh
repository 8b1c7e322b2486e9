#!/bin/sh
# bench_error.sh - path tracing's time to equal error on two box scenes, beside Mitsuba 3, in turn,
# the median of RUNS (default 5). Run from the top directory after `make`.
#
# The mean squared error of a render is half the mean squared difference of two of other seeds.
# Error times seconds tells how long a renderer takes to a given error, where that falls as one over
# the samples; with Sobol points, the default of rtc, it falls faster.
set -eu

rtc=${RTC:-build/rtc}
runs=${RUNS:-5}
spp=64
work=$(mktemp -d "${TMPDIR:-/tmp}/librt-bench.XXXXXX")
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM

python3 -c 'import mitsuba' 2>/dev/null || {
    echo "time to equal error: Mitsuba is not installed (pip install mitsuba)"
    exit 0
}

median() {
    sort -n "$1" | awk '
        { v[NR] = $1 }
        END { print NR % 2 ? v[(NR + 1) / 2] : (v[NR / 2] + v[NR / 2 + 1]) / 2 }'
}

# Prints the seconds of one render of ours; leaves two.
ours() {
    for seed in 1 2; do
        "$rtc" "scenes/$scene.rts" --mode path --spp $spp --seed $seed --progress none --quiet \
            --stats --out "$work/ours$seed.pfm" | awk '/^render time:/ { print $3 }'
    done | sort -n | head -n 1
}

theirs() {
    python3 tests/bench/peers/mitsuba_boxes.py "$scene" $spp \
        "$work/theirs1.pfm" "$work/theirs2.pfm"
}

mse() { "$rtc" compare "$work/${1}1.pfm" "$work/${1}2.pfm" | awk '/^mse:/ { print $2 / 2 }'; }

echo "path tracing, 256 x 256, $spp samples: error and seconds"
for scene in box_area box_point; do
    rm -f "$work/ours" "$work/theirs"
    for _ in $(seq "$runs"); do
        ours >>"$work/ours"
        theirs >>"$work/theirs"
    done
    for who in ours theirs; do
        echo "$(mse $who) $(median "$work/$who")"
    done | awk -v scene="$scene" '
        { error[NR] = $1; seconds[NR] = $2 }
        END {
            for (i = 1; i <= 2; i++)
                printf "  %-9s %-8s mean squared error %.3g, %.3f s\n", scene,
                       i == 1 ? "librt" : "Mitsuba", error[i], seconds[i]
            printf "  time to equal error %.3f of Mitsuba'\''s\n",
                   error[1] * seconds[1] / (error[2] * seconds[2])
        }'
done
