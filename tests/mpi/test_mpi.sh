#!/bin/sh
# test_mpi.sh - a picture on 1 to 4 processes has the bytes of rtc's, in every mode; errors, kills
# and interrupts end all of them, with a checkpoint that any number takes up. `make check-mpi` runs
# it with each MPI that is installed: test_mpi.sh RUNNER PROGRAM [modes|ends|kills|network]...
set -u
LC_ALL=C
export LC_ALL
run=$1
rtc_mpi=$(realpath "$2") || exit 1
shift 2
[ $# -gt 0 ] || set -- modes ends kills
rtc=$(realpath "${RTC:-build/rtc}") || exit 1
scene=$(realpath scenes/cornell.rts) || exit 1
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
bad=0
# Open MPI refuses root, and more processes than cores, unless told otherwise.
OMPI_ALLOW_RUN_AS_ROOT=1
OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
OMPI_MCA_rmaps_base_oversubscribe=1
OMPI_MCA_hwloc_base_binding_policy=none
export OMPI_ALLOW_RUN_AS_ROOT OMPI_ALLOW_RUN_AS_ROOT_CONFIRM OMPI_MCA_rmaps_base_oversubscribe \
    OMPI_MCA_hwloc_base_binding_policy

# check NAME COMMAND...: the test passes when the command does.
check() {
    checked=$1
    shift
    if "$@" >>log 2>&1; then
        echo "ok $checked"
    else
        echo "not ok $checked"
        sed 's/^/    /' log
        bad=1
    fi
}

# together RANKS OPTION...: renders on so many processes.
together() {
    count=$1
    shift
    timeout 120 "$run" -np "$count" "$rtc_mpi" "$@" >log 2>&1
}

small='--width 90 --height 70'

# mode NAME OPTION...: in a mode, 1 to 4 processes make the bytes that rtc makes.
mode() {
    name=$1
    shift
    rm -f ./*.exr
    # shellcheck disable=SC2086 # options are words
    "$rtc" "$scene" --quiet $small "$@" --out alone.exr || bad=1
    for ranks in 1 2 3 4; do
        # shellcheck disable=SC2086
        together $ranks "$scene" --quiet $small "$@" --out together.exr
        check "${name}_on_$ranks" cmp alone.exr together.exr
        rm -f together.exr
    done
}

modes() {
    mode path --spp 40
    mode path_with_layers_and_error --spp 21 --aov --variance
    mode direct --mode direct --spp 9
    mode normals --mode normals --spp 9
    mode photons --mode photon --spp 5 --photons 20000 --caustic-photons 5000 --final-gather 1
    mode photons_on_the_device --mode photon --spp 3 --photons 20000 --gather device --photon-layers
    mode passes --mode photon --passes 7 --photons 5000 --photon-layers
    mode passes_to_an_error --mode photon --passes 200 --photons 3000 --target-error 1
    mode target_error --target-error 0.7
}

# How runs end that do not render.
ends() {
    together 3 nowhere.rts
    check a_missing_scene_is_told_once test "$(grep -c 'nowhere.rts: error' log)" = 1
    together 2 --help
    check help_is_printed_once test "$(grep -c '^usage' log)" -le 1
    together 2 "$scene" --part 1/2
    check a_part_is_refused grep -q 'error: --part is for rtc' log
    # A process that fails alone: the others hear of it, and rank 0 tells why.
    # shellcheck disable=SC2086
    timeout 120 $run -np 1 "$rtc_mpi" "$scene" $small --spp 1e5 --out x.exr : \
        -np 1 "$rtc_mpi" "$scene" $small --spp 1e5 --device nosuchdevice >log 2>&1
    check a_failing_process_is_told grep -q 'rank 1: .*nosuchdevice' log
    # shellcheck disable=SC2086
    timeout 120 $run -np 1 "$rtc_mpi" "$scene" $small --spp 1e5 --seed 1 --out x.exr : \
        -np 1 "$rtc_mpi" "$scene" $small --spp 1e5 --seed 2 >log 2>&1
    check a_process_with_another_seed_is_refused grep -q 'rank 1: .*seed' log
    # In the foreground, because a shell lets what is in the background ignore interrupts.
    : >log
    (
        until grep -q '^render' log; do sleep 0.1; done
        pkill -INT -f "^[^ ]*$run -np 3 $rtc_mpi .*--out x.exr"
    ) &
    # shellcheck disable=SC2086
    timeout 120 "$run" -np 3 "$rtc_mpi" "$scene" $small --spp 1e7 --out x.exr \
        --checkpoint i.rtpart --every 1 >log 2>&1
    kill $! 2>/dev/null
    check an_interrupt_writes_the_picture grep -q 'interrupted; wrote x.exr' log
    check an_interrupt_keeps_the_work "$rtc" info i.rtpart
}

# The process ids of the program.
members() {
    pgrep -f "^$rtc_mpi $scene .*--out $1" || :
}

# One of three processes is killed after a random time; what is left is taken up by other numbers.
kills() {
    # shellcheck disable=SC2086
    set -- "$scene" $small --quiet
    "$rtc" "$@" --spp 900 --out alone.exr || bad=1
    "$rtc" "$@" --mode photon --passes 30 --photons 10000 --out passes.exr || bad=1
    kill=0
    while [ "$kill" -lt "${KILLS:-20}" ]; do
        kill=$((kill + 1))
        whole=alone.exr
        what='--spp 900'
        [ $((kill % 3)) -ne 0 ] || {
            whole=passes.exr
            what='--mode photon --passes 30 --photons 10000'
        }
        rm -f k.exr k.rtpart
        # shellcheck disable=SC2086
        timeout 120 $run -np 3 "$rtc_mpi" "$@" $what --out k.exr --checkpoint k.rtpart \
            --every 0.3 >log 2>&1 &
        job=$!
        sleep "$(awk -v s="$kill" 'BEGIN { srand(s); print 0.8 + 3 * rand() }')"
        # Any of them, rank 0 among them.
        victim=$(members k.exr | sed -n "$((kill % 3 + 1))p")
        [ ! "$victim" ] || kill -KILL "$victim"
        wait "$job"
        ended=$?
        left=$(members k.exr | wc -l)
        check "kill_${kill}_ends_all" test "$ended" -ne 124 -a "$left" -eq 0
        if [ "$ended" -ne 0 ]; then
            resume="--resume k.rtpart"
            [ -e k.rtpart ] || resume="$* $what --out k.exr"
            # shellcheck disable=SC2086
            if [ $((kill % 4)) -eq 0 ]; then
                "$rtc" $resume --quiet >log 2>&1
            else
                together $((kill % 4)) $resume --quiet
            fi
        fi
        check "kill_${kill}_is_taken_up ($([ -e k.rtpart ] && echo checkpoint))" cmp "$whole" k.exr
    done
}

# Machines that are network namespaces, 20 ms apart: each process is one, beside the runner's.
network() {
    for name in a b c; do
        ip netns add "rtc_$name" || return
    done
    ip link add rtc_bridge type bridge && ip addr add 10.99.0.1/24 dev rtc_bridge &&
        ip link set rtc_bridge up
    n=1
    for name in a b c; do
        n=$((n + 1))
        ip link add "rtc_v$name" type veth peer name eth0 netns "rtc_$name"
        ip link set "rtc_v$name" master rtc_bridge up
        ip -n "rtc_$name" addr add "10.99.0.$n/24" dev eth0
        ip -n "rtc_$name" link set eth0 up
        ip -n "rtc_$name" link set lo up
        ip netns exec "rtc_$name" tc qdisc add dev eth0 root netem delay 10ms 2>/dev/null ||
            echo '# this kernel has no netem: no delay'
    done
    # What the runner starts elsewhere it starts by this in place of ssh.
    cat >agent <<'AGENT'
#!/bin/sh
while [ "${1#-}" != "$1" ]; do shift; done
name=$(echo "$1" | sed 's/.*\.//' | tr 234 abc)
shift
exec ip netns exec "rtc_$name" unshare --uts sh -c "hostname rtc-$name; $*"
AGENT
    chmod +x agent
    mode_over_network
    for name in a b c; do
        ip link del "rtc_v$name"
        ip netns del "rtc_$name"
    done
    ip link del rtc_bridge
}

mode_over_network() {
    # shellcheck disable=SC2086
    set -- "$scene" $small --quiet
    "$rtc" "$@" --spp 200 --out alone.exr
    "$rtc" "$@" --mode photon --spp 8 --photons 1e5 --out photons.exr
    hosts=10.99.0.2,10.99.0.3,10.99.0.4
    case $run in
    *mpich*) over="$run -launcher ssh -launcher-exec $work/agent -localhost 10.99.0.1
        -hosts $hosts" ;;
    *) over="$run --mca plm_rsh_agent $work/agent --host $hosts --mca btl tcp,self
        --mca btl_tcp_if_include 10.99.0.0/24 --mca oob_tcp_if_include 10.99.0.0/24" ;;
    esac
    # shellcheck disable=SC2086
    timeout 60 $over -np 3 "$rtc_mpi" "$@" --spp 200 --out n.exr >log 2>&1
    check a_picture_over_a_slow_network cmp alone.exr n.exr
    # shellcheck disable=SC2086
    timeout 60 $over -np 3 "$rtc_mpi" "$@" --mode photon --spp 8 --photons 1e5 --out p.exr \
        >log 2>&1
    check a_photon_map_over_a_slow_network cmp photons.exr p.exr
}

for part; do
    $part
done
exit $bad
