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
    # An OBJ file has no camera: that of the same scene for Mitsuba.
    if [ "$name" = room.obj ]; then
        sed '/^camera {/,/^}/d' "$written.rts" >"$written.tmp"
        sed -n '/^camera {/,/^}/p' "$out/room_xml.rts" >>"$written.tmp"
        mv "$written.tmp" "$written.rts"
    fi
    # shellcheck disable=SC2086 # two options
    "$rtc" "$written.rts" $size --filter box --max-depth 16 --spp "$samples" --quiet \
        --out "$written.exr"
    if said=$("$rtc" compare "$written.exr" "$out/$scene.mitsuba.exr" --tolerance 0.02 --max-off 0)
    then
        echo "ok $name: $(echo "$said" | sed -n 's/^ratio: //p')"
        passed=$((passed + 1))
    else
        echo "not ok $name"
        echo "$said" | sed 's/^/    /'
        failed=$((failed + 1))
    fi
done
# An OBJ file has no camera: that of the glTF. Its picture is that of the lights that it has.
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
            sed '/^camera {/,/^}/d' "$written.rts" >"$written.tmp"
            sed -n '/^camera {/,/^}/p' "$cycles/rtc_glb.rts" >>"$written.tmp"
            mv "$written.tmp" "$written.rts"
            right=$cycles/materials_obj.exr
        fi
        "$rtc" "$written.rts" --width 192 --height 144 --filter box --max-depth 17 \
            --spp "$samples" --quiet --out "$written.exr"
        if said=$("$rtc" compare "$written.exr" "$right" --tolerance 0.05 --max-off 0); then
            echo "ok $name beside Cycles: $(echo "$said" | sed -n 's/^ratio: //p')"
            passed=$((passed + 1))
        else
            echo "not ok $name beside Cycles"
            echo "$said" | sed 's/^/    /'
            failed=$((failed + 1))
        fi
    done
fi
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
