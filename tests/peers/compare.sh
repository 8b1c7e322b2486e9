#!/bin/sh
# compare.sh - eighteen scenes as rtc renders them beside Mitsuba 3, an independent renderer.
#
#   tests/peers/compare.sh [SCENE]...
#
# Run from the top directory after `make`. Needs `pip install mitsuba` for $PYTHON (default
# python3). Each scene is written twice, as NAME.rts and in mitsuba_scenes.py. Pictures and signed
# differences stay in build/peers. SPP (default 1024) are the samples a pixel of both; the caustic
# gets four times as many. The status is 0 only when every scene agrees: no 16x16 block has a mean
# off by more than 1 % (2 % for the caustic and the
# media) and four standard errors. Where RT_PROOF_ROWS names a file, the section on Mitsuba of the
# page of the proof is added to that file.
set -eu

rtc=${RTC:-build/rtc}
python=${PYTHON:-python3}
spp=${SPP:-1024}
out=build/peers
here=tests/peers

"$python" -c 'import mitsuba' 2>/dev/null || {
    echo "compare.sh: $python has no module mitsuba: $python -m pip install mitsuba" >&2
    exit 2
}
mkdir -p $out
for image in sky normals heights; do
    "$python" $here/mitsuba_render.py --image $image $out/$image.exr
done

# field NAME: what `rtc compare` printed behind "NAME: ".
field() { sed -n "s/^$1: //p" "$out/$scene.txt"; }

page_row() {
    field ratio | awk -v scene="$scene" -v samples="$samples" -v blocks="$blocks" \
        -v worst="$worst" '{
            printf "- %s, path: Mitsuba 3, %d samples a pixel\n", scene, samples
            printf "  mean ratio %s, off by %+.2f standard errors of %.1e; ", $1, ($1 - 1) / $3, $3
            printf "%s blocks off, worst %s\n", blocks, worst
        }'
}

failed=0
[ $# -gt 0 ] || set -- box_point box_area box_caustic metal_glass plastic panes relief \
    brushed paints dyes sheets cutouts blends stage tumbler smoke milk haze puff
printf '%-12s %8s %8s  %-20s %-11s %-10s %s\n' scene samples seconds 'mean ratio' \
    'blocks off' RMSE 'worst block, of what is allowed'
: >$out/rows.md
for scene in "$@"; do
    samples=$spp
    tolerance=0.01
    case $scene in
    box_caustic)
        samples=$((4 * spp))
        tolerance=0.02
        ;;
    smoke | milk | haze | puff) tolerance=0.02 ;;
    esac
    file=scenes/$scene.rts
    [ -e "$file" ] || file=$here/$scene.rts
    started=$(date +%s)
    "$rtc" "$file" --mode path --spp "$samples" --seed 1 --out "$out/$scene.exr" \
        --progress none --quiet
    "$python" $here/mitsuba_render.py "$scene" "$samples" "$out/$scene-mitsuba.exr"
    "$rtc" compare "$out/$scene.exr" "$out/$scene-mitsuba.exr" --tolerance $tolerance --max-off 0 \
        --out "$out/$scene-difference.png" >"$out/$scene.txt" 2>"$out/$scene.err" ||
        failed=$((failed + 1))
    [ -s "$out/$scene.txt" ] || { cat "$out/$scene.err" >&2; exit 1; }
    blocks="$(field 'blocks off') of $(field blocks)"
    worst=$(sed -n 's/^worst block: .*, \(.*\) of what is allowed$/\1/p' "$out/$scene.txt")
    printf '%-12s %8d %8d  %-20s %-11s %-10s %s\n' "$scene" "$samples" \
        $(($(date +%s) - started)) "$(field ratio)" "$blocks" "$(field rmse)" "$worst"
    page_row >>$out/rows.md
done
if [ $failed -gt 0 ]; then
    echo "$failed disagree"
    exit 1
fi
echo "all agree"
if [ -n "${RT_PROOF_ROWS:-}" ]; then
    { printf '\n## Against Mitsuba 3\n\n'; cat $out/rows.md; } >>"$RT_PROOF_ROWS"
fi
