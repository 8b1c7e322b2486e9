#!/bin/sh
# commands.sh - runs the commands of the pages.
#
#     tests/docs/commands.sh RTC PAGE...
#
# A command is a line of an indented block that begins with `rtc` or `build/rtc`; what follows two
# spaces says what it does. They run in order, in a folder of their own that has the scenes, and
# small: films of 24 x 16 pixels, a 512th of the samples, 2 passes, 1000 photons. SCENE, KIND,
# COMMAND and FILE stand for a scene, a mesh, a command and a file. What shows a page that stays
# open, needs MPI or a library that is not there is left out, and said.
set -u
rtc=$(realpath "$1") || exit 1
shift
top=$PWD
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
bad=0 count=0

# What comes before the commands: pictures to compare, scenes, and the other parts of a film.
cd "$work" || exit 1
cp -r "$top/scenes" scenes
mkdir build
cp scenes/box_point.rts a.rts
cp scenes/box_area.rts b.rts
cp -r scenes/parts parts
cp scenes/tutorial/10.rts my.rts
small='--width 24 --height 16'
# shellcheck disable=SC2086 # lists of words
{
    for name in a b a1 a2 r reference; do
        "$rtc" scenes/box_area.rts $small --spp 2 --aov --quiet --out $name.exr
    done
    for part in 1 2 4 5; do
        "$rtc" scenes/cornell.rts $small --spp 8 --part $part/5 --quiet --out p$part.rtpart
    done
} || exit 1
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >in.obj
printf '0 0 0  0 1 0\n' >points.txt

# lines PAGE: its commands, without what is said of them.
lines() {
    sed -n 's/^    \(build\/\)\{0,1\}rtc /rtc /p' "$top/$1" | sed 's/   *.*//' |
        sed 's/SCENE\.rts/scenes\/cornell.rts/; s/SCENE\.xml/in.obj/
            s/SCENE/scenes\/cornell.rts/; s/KIND/torus/
            s/COMMAND/check/; s/ FILE / in.obj /
            s/--photons 1e9/--photons 2e3/; s/--photons 1e6/--photons 1e3/
            s/--spp 4096/--spp 8/; s/--spp 8192/--spp 16/; s/--spp 256/--spp 2/
            s/--passes [0-9]*/--passes 2/; s/--pixel [0-9,]*/--pixel 3,3/
            s/k=5,50,500/k=5,50/; s/kernel=all/kernel=box,cone/'
}

# small_of COMMAND...: what makes it small, where it renders.
small_of() {
    case "$*" in
    *--resume*) ;;
    *--photon-map*) echo "$small --spp 2" ;;
    check*|import*|fmt*|mesh*|devices*|kernels*|doctor*|help*|--help*|compare*|merge*|info*) ;;
    photons*|*--dump*) ;;
    study*) echo "$small --photons 500" ;;
    paths*) echo "$small" ;;
    *--spp*) echo "$small" ;;
    *--passes*) echo "$small --photons 1000 --spp 1" ;;
    *) echo "$small --photons 1000 --spp 2" ;;
    esac
}

for page in "$@"; do
    lines "$page" >list
    while IFS= read -r line; do
        case $line in
        *--preview*|*--watch*|*--denoise*|*'rtc doctor'*)
            echo "left out: $line"
            continue
            ;;
        esac
        words=${line#rtc }
        # shellcheck disable=SC2046,SC2086 # lists of words
        if ! "$rtc" $words $(small_of $words) </dev/null >out 2>&1; then
            printf 'not ok %s: %s\n' "$page" "$line"
            grep -E 'error' out | head -n 3 | sed 's/^/    /'
            bad=1
        fi
        count=$((count + 1))
    done <list
done
echo "$count commands run"
[ "$count" -ge 40 ] || bad=1
exit $bad
