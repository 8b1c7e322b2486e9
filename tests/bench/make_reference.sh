#!/bin/sh
# make_reference.sh - makes the references of time to equal error, tests/bench/reference.
#
#   tests/bench/make_reference.sh [SCENE]...
#
# Run from the top directory after `make`. Each is rendered until its relative RMSE is below 0.2 %,
# or for LONGEST (1200) seconds, compared with Mitsuba's picture of SPP (1024) samples a pixel, and
# kept with 16 bits a value; its own error, which the suite takes off, stands in a .txt beside it.
# The status is 0 only when no block of 16 x 16 pixels has a mean off by more than 1 % and four
# standard errors.
set -eu

rtc=${RTC:-build/rtc}
python=${PYTHON:-python3}
spp=${SPP:-1024}
work=build/bench/reference
kept=tests/bench/reference
mkdir -p $work $kept

[ -e build/bench/mesh.ply ] || "$rtc" mesh knot --triangles 1.5e6 --out build/bench/mesh.ply
[ -e build/bench/sky.exr ] || "$python" tests/bench/peers/mitsuba_bench.py --sky build/bench/sky.exr

[ $# -gt 0 ] || set -- box_area box_point box_caustic mesh glass_metal many_lights doorway image_sky
failed=0
for scene in "$@"; do
    file=tests/bench/scenes/$scene.rts
    mkdir -p "$work/$scene"
    width=128
    height=96
    if [ ! -e "$file" ]; then
        file=scenes/$scene.rts
        height=128
    fi
    "$rtc" "$file" --width $width --height $height --mode path --seed 1000 --spp 65536 \
        --target-error 0.002 --time "${LONGEST:-1200}" --progress none --quiet --stats \
        --out "$work/$scene.pfm" >"$work/$scene.stats"
    sed -n "s/^relative error: //p" "$work/$scene.stats" >"$kept/$scene.txt"
    "$python" tests/bench/peers/mitsuba_bench.py "$scene" "$spp" --seed 7 \
        --out "$work/$scene" >/dev/null
    echo "$scene"
    "$rtc" compare "$work/$scene/$spp.pfm" "$work/$scene.pfm" --max-off 0 \
        >"$work/$scene.txt" || failed=$((failed + 1))
    grep -E '^(rmse|ratio|blocks off|worst block):' "$work/$scene.txt"
    "$python" tests/bench/peers/mitsuba_bench.py --half "$work/$scene.pfm" "$kept/$scene.exr"
done
if [ $failed -gt 0 ]; then
    echo "$failed disagree"
    exit 1
fi
