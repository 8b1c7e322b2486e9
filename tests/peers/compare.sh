#!/bin/sh
# compare.sh - one table: what path tracing by rtc shows beside Mitsuba 3, an independent renderer,
# and beside the other modes of rtc, for a scene of each material and texture.
#
#   tests/peers/compare.sh [SCENE]...
#
# Run from the top directory after `make`. Needs `pip install mitsuba` for $PYTHON (default
# python3). Each scene is NAME.rts, and once more in mitsuba_scenes.py, but for those whose
# materials Mitsuba lacks. A cell of the table has the mean of a picture by that of the other, the
# standard error of this ratio, and the worst block of 16x16 pixels as a part of what is allowed;
# where the two disagree, a star. Pictures and signed differences stay in build/peers. The status is
# 0 only when all agree: no mean is off by more than 0.5 % and three standard errors, and no block
# by more than 2 % and four standard errors; beside Mitsuba by more than 1 %, but for the caustic,
# rough coats, the rim of a bumpy ball, and media. Where RT_PROOF_ROWS names a file, the two
# sections of the page of the proof are added to that file.
#
# Beside Mitsuba are pictures of the size that the scene has, of SPP (default 1024) samples a pixel
# by both; of the caustic, of four times as many, and of previews, of half as many. Modes are
# compared in small pictures, by their means over blocks. Media have no such columns: mode vcm knows
# none, and the discs of volume photons are not cut at their boundaries, which is off by up to 3 %.
set -eu

rtc=${RTC:-build/rtc}
python=${PYTHON:-python3}
spp=${SPP:-1024}
out=build/peers
here=tests/peers

# Scenes are a few metres wide, of shapes from 0.3 m on, and pixels of the small pictures see some
# 5 cm. Photons are gathered, and merged by vcm, within 3 cm at first, whatever their density;
# passes shrink that to half. The bias is then below the tolerance: along the edge of a sheet a
# fifth of the radius is lost, 3 % of the indirect light of one half a metre wide, which is a tenth
# of all light there. (With k 50 and four photons a pixel, the defaults, discs are ten times as
# wide, and blocks up to 14 % off.) Small discs make pixels noisy, but hardly blocks, whose noise
# goes by the photons that fall on them in all passes. Pixels share the photons of a pass, so the
# noise is told by four renders of other seeds, of which compare takes the mean.
radius=0.03
photons="--mode photon --passes 64 --photons 100000 --k all --radius $radius"
modes='bpt vcm photon gather'

options() {
    case $1 in
    path) echo '--mode path --spp 2048 --seed 1' ;;
    bpt) echo '--mode vcm --techniques bpt --spp 512 --seed 2' ;;
    vcm) echo "--mode vcm --radius $radius --spp 512 --seed 3" ;;
    photon) echo "$photons --seed $2" ;;
    gather) echo "$photons --final-gather 1 --seed 1$2" ;;
    esac
}

"$python" -c 'import mitsuba' 2>/dev/null || {
    echo "compare.sh: $python has no module mitsuba: $python -m pip install mitsuba" >&2
    exit 2
}
mkdir -p $out/preview
for image in sky.exr normals.exr heights.exr cloth.png cloth.jpg cloth.hdr; do
    "$python" $here/mitsuba_render.py --image "${image%.*}" "$out/$image"
done

# field NAME: what `rtc compare` printed behind "NAME: ".
field() { sed -n "s/^$1: //p" "$pair.txt"; }

# compare NAME TOLERANCE A... B: the cell of that pair, and its row of the page.
compare() {
    pair=$out/$scene-$1
    tolerance=$2
    title=$3
    shift 3
    "$rtc" compare "$@" --tolerance "$tolerance" --out "$pair-difference.png" \
        >"$pair.txt" 2>"$pair.err" || { cat "$pair.err" >&2; exit 1; }
    worst=$(sed -n 's/^worst block: .*, \(.*\) of what is allowed$/\1/p' "$pair.txt")
    star=$(field ratio | awk -v off="$(field 'blocks off')" '{
        d = $1 < 1 ? 1 - $1 : $1 - 1
        if (off > 0 || !(d <= 0.005 || d <= 3 * $3)) print "*"
    }')
    [ -z "$star" ] || failed=$((failed + 1))
    field ratio | awk -v worst="$worst" -v star="$star" '{
        printf " %.5f %.5f %5.2f%1s", $1, $3, worst, star
    }'
    field ratio | awk -v title="$title" -v blocks="$(field 'blocks off') of $(field blocks)" \
        -v worst="$worst" '{
            printf "- %s\n", title
            printf "  mean ratio %s, off by %+.2f standard errors of %.1e; ", $1, ($1 - 1) / $3, $3
            printf "%s blocks off, worst %s\n", blocks, worst
        }' >>"$rows"
}

render() { "$rtc" "$file" --progress none --quiet "$@"; }

beside_mitsuba() {
    samples=$spp
    tolerance=0.01
    case $scene in
    ours)
        printf ' %-22s' '-'
        return
        ;;
    box_caustic) samples=$((4 * spp)) ;;
    preview/*) samples=$((spp / 2)) ;;
    esac
    case $scene in
    box_caustic | coats | preview/roughplastic | preview/bumpmap) tolerance=0.02 ;;
    smoke | milk | haze | puff) tolerance=0.02 ;;
    esac
    render --mode path --spp "$samples" --seed 1 --out "$out/$scene.exr"
    "$python" $here/mitsuba_render.py "$scene" "$samples" "$out/$scene-mitsuba.exr"
    rows=$out/mitsuba.md
    compare mitsuba $tolerance "$scene, path: Mitsuba 3, $samples samples a pixel" \
        "$out/$scene.exr" "$out/$scene-mitsuba.exr"
}

beside_modes() {
    case $scene in smoke | milk | haze | puff)
        printf ' %-22s' - - - -
        return
        ;;
    esac
    rows=$out/modes.md
    for mode in path $modes; do
        seeds=1
        case $mode in photon | gather) seeds='1 2 3 4' ;; esac
        made=
        for seed in $seeds; do
            picture=$out/$scene-$mode-$seed.exr
            # shellcheck disable=SC2046 # options
            render --width 64 --height 64 $(options "$mode" "$seed") --out "$picture"
            made="$made $picture"
        done
        [ "$mode" != path ] || continue
        # shellcheck disable=SC2086 # names without spaces
        compare "$mode" 0.02 "$scene, $mode: path" $made "$out/$scene-path-1.exr"
    done
}

# A ball of each material of Mitsuba.
previews=$(for name in diffuse dielectric thindielectric roughdielectric conductor \
    roughconductor plastic roughplastic principled principledthin bumpmap normalmap mask \
    blendbsdf twosided; do echo "preview/$name"; done)

failed=0
# shellcheck disable=SC2086 # names without spaces
[ $# -gt 0 ] || set -- box_point box_area box_caustic metal_glass plastic panes relief \
    brushed coats metals paints dyes sheets cutouts blends prints ours stage tumbler \
    $previews smoke milk haze puff
printf '%-23s' scene
printf ' %-22s' 'Mitsuba 3' bpt vcm photon 'final gather'
printf ' %s\n' seconds
: >$out/mitsuba.md
: >$out/modes.md
for scene in "$@"; do
    file=$here/$scene.rts
    [ -e "$file" ] || file=scenes/$scene.rts
    started=$(date +%s)
    printf '%-23s' "$scene"
    beside_mitsuba
    beside_modes
    printf ' %7d\n' $(($(date +%s) - started))
done
if [ $failed -gt 0 ]; then
    echo "$failed disagree"
    exit 1
fi
echo "all agree"
if [ -n "${RT_PROOF_ROWS:-}" ]; then
    { printf '\n## Against Mitsuba 3\n\n'; cat $out/mitsuba.md
      printf '\n## Modes against each other\n\n'; cat $out/modes.md; } >>"$RT_PROOF_ROWS"
fi
