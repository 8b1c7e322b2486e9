#!/bin/sh
# check.sh - imports every scene of scenes/ and compares its picture with Mitsuba 3's of the .xml of
# the same name: no block of 16x16 pixels may be off by more than 2 %; and, with BPY, a scene of
# Blender's materials with Cycles, by 5 %. RTC: the program, OUT: a folder for what it makes,
# PYTHON: one that has Mitsuba, SAMPLES: of each pixel, BPY: a Python that has the module bpy.
set -u
here=$(dirname "$0")
rtc=${RTC:-build/rtc}
out=${OUT:-build/import}
samples=${SAMPLES:-1024}
mkdir -p "$out" || exit 1
failed=0 passed=0

# compare NAME PICTURE RIGHT TOLERANCE: counts whether no block is off by more.
compare() {
    if said=$("$rtc" compare "$2" "$3" --tolerance "$4" --max-off 0); then
        echo "ok $1: $(echo "$said" | sed -n 's/^ratio: //p')"
        passed=$((passed + 1))
    else
        echo "not ok $1"
        echo "$said" | sed 's/^/    /'
        failed=$((failed + 1))
    fi
}

# borrow_camera SCENE OTHER: an OBJ file has no camera, and its scene gets that of another.
borrow_camera() {
    sed '/^camera {/,/^}/d' "$1" >"$1.tmp"
    sed -n '/^camera {/,/^}/p' "$2" >>"$1.tmp"
    mv "$1.tmp" "$1"
}

set --
for scene in room metal picture delta tall smooth shapes curves pplastic; do
    picture=$out/$scene.mitsuba.exr
    [ -f "$picture" ] || set -- "$@" "$here/scenes/$scene.xml" "$picture"
done
[ $# -eq 0 ] || "${PYTHON:-python3}" "$here/mitsuba_render.py" "$samples" "$@" || exit 1

cd "$here/scenes" || exit 1
files="$(echo *.xml *.pbrt *.gl*) room.obj"
cd - >/dev/null || exit 1
for name in $files; do
    file=$here/scenes/$name
    scene=${name%.*} written=$out/$(echo "$name" | tr . _)
    size='--width 96 --height 72'
    [ "$scene" != tall ] || size='--width 60 --height 100'
    if ! "$rtc" import "$file" --out "$written.rts" --quiet; then
        echo "not ok $name: not imported"
        failed=$((failed + 1))
        continue
    fi
    [ "$name" != room.obj ] || borrow_camera "$written.rts" "$out/room_xml.rts"
    # shellcheck disable=SC2086 # two options
    "$rtc" "$written.rts" $size --filter box --max-depth 16 --spp "$samples" --quiet \
        --out "$written.exr"
    compare "$name" "$written.exr" "$out/$scene.mitsuba.exr" 0.02
done
# The picture of the OBJ file is that of the lights that it has.
cycles=$out/cycles
if [ -z "${BPY:-}" ]; then
    echo 'skip: no BPY, a Python with bpy (from PyPI), for the materials of Blender'
elif ! "$BPY" "$here/blender_materials.py" "$cycles" "$samples" >"$out/cycles.log" 2>&1; then
    cat "$out/cycles.log"
    exit 1
else
    for name in materials.glb gltf/materials.gltf materials.obj; do
        written=$cycles/rtc_${name##*.} right=$cycles/materials.exr
        "$rtc" import "$cycles/$name" --out "$written.rts" --quiet || exit 1
        if [ "$name" = materials.obj ]; then
            borrow_camera "$written.rts" "$cycles/rtc_glb.rts"
            right=$cycles/materials_obj.exr
        fi
        "$rtc" "$written.rts" --width 192 --height 144 --filter box --max-depth 17 \
            --spp "$samples" --quiet --out "$written.exr"
        compare "$name beside Cycles" "$written.exr" "$right" 0.05
    done
fi
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
