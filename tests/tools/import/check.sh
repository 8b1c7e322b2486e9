#!/bin/sh
# check.sh - imports every scene of scenes/ and compares its picture with Mitsuba 3's of the .xml of
# the same name: no block of 16x16 pixels may be off by more than 2 %. RTC: the program, OUT: a
# folder for what it makes, PYTHON: one that has Mitsuba, SAMPLES: of each pixel.
set -u
here=$(dirname "$0")
rtc=${RTC:-build/rtc}
out=${OUT:-build/import}
samples=${SAMPLES:-1024}
mkdir -p "$out" || exit 1
failed=0 passed=0

set --
for scene in room metal picture delta tall; do
    picture=$out/$scene.mitsuba.exr
    [ -f "$picture" ] || set -- "$@" "$here/scenes/$scene.xml" "$picture"
done
[ $# -eq 0 ] || "${PYTHON:-python3}" "$here/mitsuba_render.py" "$samples" "$@" || exit 1

cd "$here/scenes" || exit 1
files="$(echo *.xml *.pbrt *.gl*) room.obj"
cd - >/dev/null || exit 1
for name in $files; do
    file=$here/scenes/$name
    scene=${name%.*} made=$out/$(echo "$name" | tr . _)
    size='--width 96 --height 72'
    [ "$scene" != tall ] || size='--width 60 --height 100'
    if ! "$rtc" import "$file" --out "$made.rts" --quiet; then
        echo "not ok $name: not imported"
        failed=$((failed + 1))
        continue
    fi
    # An OBJ file has no camera: that of the same scene for Mitsuba.
    if [ "$name" = room.obj ]; then
        sed '/^camera {/,/^}/d' "$made.rts" >"$made.tmp"
        sed -n '/^camera {/,/^}/p' "$out/room_xml.rts" >>"$made.tmp"
        mv "$made.tmp" "$made.rts"
    fi
    # shellcheck disable=SC2086 # two options
    "$rtc" "$made.rts" $size --filter box --max-depth 16 --spp "$samples" --quiet --out "$made.exr"
    if said=$("$rtc" compare "$made.exr" "$out/$scene.mitsuba.exr" --tolerance 0.02 --max-off 0)
    then
        echo "ok $name: $(echo "$said" | sed -n 's/^ratio: //p')"
        passed=$((passed + 1))
    else
        echo "not ok $name"
        echo "$said" | sed 's/^/    /'
        failed=$((failed + 1))
    fi
done
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
