#!/bin/sh
# bench_render.sh - path tracing the Cornell box of 32 triangles, beside Mitsuba 3 where python3 can
# import it, in turn, the median of RUNS (default 5); and how long rtc takes to its first sample,
# with the driver's kernel cache empty and filled. Run from the top directory after `make`.
#
# A sample is worth more or less by where Russian roulette may end it: Mitsuba's begins at the fifth
# segment, ours at the second, below a threshold of the light that is left (by default one half; 1
# gives the most samples a second). What counts is the time to equal error: bench_error.sh.
set -eu

rtc=${RTC:-build/rtc}
runs=${RUNS:-5}
work=$(mktemp -d "${TMPDIR:-/tmp}/librt-bench.XXXXXX")
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM

median() {
    sort -n "$1" | awk '
        { v[NR] = $1 }
        END { print NR % 2 ? v[(NR + 1) / 2] : (v[NR / 2] + v[NR / 2 + 1]) / 2 }'
}

# Million camera samples a second of one render of ours, with these options.
ours() {
    "$rtc" tests/bench/cornell32.rts "$@" --progress none --quiet --stats --out "$work/ours.pfm" |
        awk '/^render time:/ { print 512 * 512 * 64 / $3 / 1e6 }'
}

theirs() { python3 tests/bench/peers/mitsuba_cornell.py --runs 1 | awk 'END { print $(NF - 1) }'; }

peer=no
if python3 -c 'import mitsuba' 2>/dev/null; then peer=yes; fi

ours >/dev/null # fills the kernel cache
for _ in $(seq "$runs"); do
    ours >>"$work/ours"
    ours --roulette-threshold 1 >>"$work/most"
    [ $peer = no ] || theirs >>"$work/theirs"
done
echo "path tracing, Cornell box of 32 triangles, 512 x 512, 64 samples, depth 8:"
echo "  librt    $(median "$work/ours") Msamples/s;" \
    "$(median "$work/most") with --roulette-threshold 1"
if [ $peer = yes ]; then
    echo "  Mitsuba  $(median "$work/theirs") Msamples/s"
    for who in ours most; do
        echo "$(median "$work/$who") $(median "$work/theirs")"
    done | awk '{ printf NR == 1 ? "  ratio    %.2f; " : "%.2f\n", $1 / $2 }'
else
    echo "  Mitsuba  not installed (pip install mitsuba)"
fi

# Seconds from start to end of a render of one sample with a kernel cache of its own.
first_sample() {
    started=$(date +%s.%N)
    POCL_CACHE_DIR="$work/cache" "$rtc" scenes/cornell.rts --mode "$1" --width 8 --height 8 \
        --spp 1 --photons 100 --progress none --quiet --out "$work/first.pfm"
    echo "$started $(date +%s.%N)" | awk '{ printf "%.2f\n", $2 - $1 }'
}

echo "start to first sample, cornell.rts (kernel cache empty, then filled):"
for mode in path photon; do
    rm -rf "$work/cache"
    mkdir "$work/cache"
    cold=$(first_sample $mode)
    for _ in $(seq "$runs"); do first_sample $mode; done >"$work/warm"
    echo "  $mode    cold $cold s, warm $(median "$work/warm") s"
done
