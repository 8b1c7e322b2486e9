#!/bin/sh
# test_pool.sh - the example of a pool of processes makes the picture that rtc makes, byte for byte,
# and says what fails. Needs build/rtc and build/tools/cluster/pool.
set -u
bin=$PWD/build
. "${0%/*}/check.sh"
cd "$work" || exit 1

cat >scene.rts <<'END_OF_SCENE'
camera { eye 0 1 -4  look_at 0 1 0  fov 40 }
film { width 150  height 70 }
render { mode path  spp 7 }
material white { kd 0.7 }
plane { point 0 0 0  normal 0 1 0  material white }
sphere { centre 0 1 0  radius 1  material white }
light point { position 2 4 -3  intensity 20 }
END_OF_SCENE
sed 's/mode path  spp 7/mode photon  photons 2000  passes 3/' scene.rts >passes.rts

pool() { "$bin/tools/cluster/pool" "$@"; }
same_as_rtc() {
    "$bin/rtc" "$1.rts" --quiet --out "$1.pfm" && pool "$1.rts" "$1.pool.pfm" "$2" &&
        cmp "$1.pfm" "$1.pool.pfm"
}
# fails_with TEXT COMMAND...: the command fails and says so.
fails_with() {
    text=$1
    shift
    "$@" 2>said && return 1
    cat said
    grep -q "$text" said
}

check one_process_makes_the_same_picture same_as_rtc scene 1
check three_processes_make_the_same_picture same_as_rtc scene 3
# Three passes: some of the processes have none.
check more_processes_than_tasks_make_the_same_picture same_as_rtc passes 5
check missing_scene_is_told fails_with 'cannot read the scene' pool missing.rts out.pfm 2
check usage_is_told fails_with PROCESSES pool scene.rts out.pfm 0
check missing_devices_are_told fails_with 'no OpenCL platform' \
    env OCL_ICD_VENDORS="$work/none" "$bin/tools/cluster/pool" scene.rts out.pfm 2
# Kills the process that the first one starts. All that it starts hold the pipe open.
kill_one() {
    "$bin/tools/cluster/pool" long.rts out.pfm 2 2>said &
    until kill -KILL "$(cut -d' ' -f1 "/proc/$!/task/$!/children")" 2>/dev/null; do sleep 0.1; done
    wait $! || echo failed
}
sed 's/spp 7/spp 500/' scene.rts >long.rts
check failed_processes_are_told_and_leave_none eval \
    'kill_one | timeout 60 cat >ended && grep failed ended && grep "before anything came" said'
exit $bad
