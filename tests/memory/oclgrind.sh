#!/bin/sh
# oclgrind.sh - small renders in every mode on Oclgrind (https://github.com/jrprice/Oclgrind, in
# Debian: oclgrind), a simulated OpenCL device that watches each access of each work-item.
#
# None may read or write outside of a buffer, race with another work-item or call OpenCL wrongly.
# The device is made an awkward one: with more compute units than cores, which cannot be divided,
# and work-groups of 4 at most. Being no Clang to the kernels, it gets their plainest code.
# shellcheck disable=SC2086 # $photons is a list of options, $scene may have a command before it
set -u

rtc=${RTC:-build/rtc}
here=$(dirname "$0")
command -v oclgrind >/dev/null || {
    echo 'not ok oclgrind is there: install it, in Debian by apt-get install oclgrind'
    exit 1
}
work=$(mktemp -d "${TMPDIR:-/tmp}/librt-memory.XXXXXX") || exit 1
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM

# render NAME SCENE OPTIONS...
render() {
    run "$@" --out "$work/out.exr"
}

# run NAME SCENE OPTIONS...: SCENE may be a command and a scene.
run() {
    what=$1 scene=$2
    shift 2
    oclgrind --check-api --data-races --compute-units 64 --max-wgsize 4 --log "$work/log" \
        --build-options '-O0 -U__clang__' "$rtc" $scene --width 8 --height 8 --seed 1 \
        --max-depth 6 --quiet "$@" >"$work/said" 2>&1
    status=$?
    if [ "$status" -eq 0 ] && [ ! -s "$work/log" ]; then
        echo "ok $what"
    else
        echo "not ok $what: exit status $status"
        head -40 "$work/said" "$work/log"
    fi
    rm -f "$work/log" "$work/out.exr"
}

photons="--mode photon --spp 1 --photons 300 --k 8"
for scene in "$here"/lights.rts "$here"/media.rts "$here"/../../scenes/primitives.rts; do
    name=$(basename "$scene" .rts)
    render "path: $name" "$scene" --spp 2
    render "direct: $name" "$scene" --mode direct --spp 2
    render "photons by FLANN: $name" "$scene" $photons --gather flann
    render "photons by the device: $name" "$scene" $photons --gather device
done
lights=$here/lights.rts media=$here/media.rts
render 'no hierarchy' "$media" --spp 1 --accel none
render 'independent samples, light sampling' "$lights" --spp 2 --sampler independent \
    --estimator light
render 'scattering alone, a filter' "$lights" --spp 2 --estimator bsdf --filter mitchell
render 'the variance' "$media" --spp 32 --width 4 --height 4 --variance
run 'the paths of a pixel' "paths $media" --pixel 4,4 --spp 9
render 'guides of a denoiser' "$media" --spp 2 --denoise \
    --denoiser "$here/../../build/tests/lib/denoise/stub.so"
render 'layers' "$lights" --spp 2 --aov
render 'the layers of photons' "$media" $photons --aov --photon-layers
render 'passes' "$media" $photons --passes 3
render 'a caustic map and a final gather on the device' "$media" $photons --caustic-photons 300 \
    --final-gather 1 --gather device
render 'a final gather by FLANN' "$media" $photons --final-gather 2
render 'the hull' "$lights" $photons --area hull
render 'all photons within a radius' "$media" --mode photon --spp 1 --photons 300 \
    --k all --radius 0.3 --direct photons
render 'fewer photons than asked for' "$media" --mode photon --spp 1 --photons 3 --gather device
render 'a tree of several levels' "$media" --mode photon --spp 1 --photons 8000 \
    --width 4 --height 4 --gather device
render 'a density on a grid by paths' "$here/grids.rts" --spp 2
render 'a density on a grid by photons' "$here/grids.rts" $photons --final-gather 1 \
    --caustic-photons 300
render 'a density on a grid by photons around points' "$here/grids.rts" $photons \
    --volume-estimate point --direct photons
for scene in "$lights" "$media" "$here"/../../scenes/primitives.rts; do
    render "paths from both ends: $(basename "$scene" .rts)" "$scene" --mode vcm --spp 2
done
for techniques in pt bpt bpm; do
    render "paths from both ends by $techniques" "$lights" --mode vcm --spp 2 \
        --techniques $techniques
done
render 'paths from both ends, the share of one, a filter' "$media" --mode vcm --spp 2 \
    --contribution connection --filter mitchell
for rule in mse cppm ftest; do
    render "passes by the rule $rule" "$media" $photons --passes 3 --radius-rule $rule
done
render 'photons at rough metal, camera paths split' "$media" $photons --gather-roughness 0.15 \
    --split 4
render 'camera paths split' "$media" $photons --split 4
render 'photons by visual importance' "$lights" $photons --photon-importance
render 'irradiance at photons' "$lights" $photons --final-gather 2 --irradiance-step 4
for kernel in box cone gaussian silverman; do
    render "the kernel $kernel" "$media" $photons --kernel $kernel --gather device
done
