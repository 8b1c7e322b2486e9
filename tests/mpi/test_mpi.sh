#!/bin/sh
# test_mpi.sh - a picture on 1 to 4 processes has the bytes of rtc's, in every mode; errors, kills
# and interrupts end all of them, with a checkpoint that any number takes up. `make check-mpi` runs
# it with each MPI that is installed.
#
#   test_mpi.sh RUNNER PROGRAM [modes|raises|ends|kills|network]...
set -u
LC_ALL=C
export LC_ALL
run=$1
rtc_mpi=$(realpath "$2") || exit 1
shift 2
[ $# -gt 0 ] || set -- modes raises ends kills
rtc=$(realpath "${RTC:-build/rtc}") || exit 1
scene=$(realpath scenes/cornell.rts) || exit 1
tests=$(realpath tests/mpi) || exit 1
work=$(mktemp -d) || exit 1
is_network=
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

# The words before -np: how processes are started on the machines of `network`.
launch() {
    hosts=$(echo 10.99.0.2,10.99.0.3,10.99.0.4,10.99.0.5 | cut -d, -f "-$1")
    case $run in
    *mpich*)
        echo "-launcher ssh -launcher-exec $work/agent -localhost 10.99.0.1 -hosts $hosts" ;;
    *)
        echo "--mca plm_rsh_agent $work/agent --host $hosts --mca btl tcp,self" \
            "--mca btl_tcp_if_include 10.99.0.0/24 --mca oob_tcp_if_include 10.99.0.0/24" ;;
    esac
}

# together RANKS OPTION...: renders on so many processes.
together() {
    count=$1
    shift
    # shellcheck disable=SC2046 # words
    timeout 120 "$run" $([ ! "$is_network" ] || launch "$count") -np "$count" "$rtc_mpi" "$@" \
        >log 2>&1
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
        check "${name}_on_$ranks${is_network:+_machines}" cmp alone.exr together.exr
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
    mode vcm --mode vcm --spp 9 --radius 0.05 --aov
    mode vcm_with_error --mode vcm --techniques bpt --spp 13 --variance
}

# A finished render is raised by any number of processes.
raises() {
    for ranks in 1 3 4; do
        for what in --mode=path --variance '--mode photon --photons 5000'; do
            rm -f ./*.exr r.rtpart
            what=$(echo "$what" | tr '=' ' ')
            # shellcheck disable=SC2086
            set -- "$scene" --quiet $small $what
            "$rtc" "$@" --spp 29 --out alone.exr || bad=1
            together $((5 - ranks)) "$@" --spp 13 --out r.exr --checkpoint r.rtpart
            together "$ranks" --resume r.rtpart --quiet --spp 29
            check "raised_by_$ranks ($what)" cmp alone.exr r.exr
        done
    done
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

# One of three processes is killed after a random time, until KILLS have struck before the picture
# was finished; what is left is taken up by other numbers.
kills() {
    # shellcheck disable=SC2086
    set -- "$scene" $small --quiet
    "$rtc" "$@" --spp 900 --out alone.exr || bad=1
    "$rtc" "$@" --mode photon --passes 30 --photons 10000 --out passes.exr || bad=1
    kill=0
    struck=0
    while [ "$struck" -lt "${KILLS:-20}" ] && [ "$kill" -lt $((3 * ${KILLS:-20})) ]; do
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
            struck=$((struck + 1))
            # Killed in MPI_Finalize, MPICH's process manager fails with words of its own.
            check "kill_${kill}_is_told" grep -qE 'ignal 9|process manager error' log
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
    check "${KILLS:-20}_kills_struck" test "$struck" -eq "${KILLS:-20}"
}

# Machines that are network namespaces: each process is one, beside the runner's. Frames between any
# two take DELAY milliseconds, by delay_bridge, which needs nothing of the kernel but TAP devices.
machines='a b c d'
delay=${DELAY:-5}
bridge_pid=

unplug() {
    [ ! "$bridge_pid" ] || kill "$bridge_pid" 2>/dev/null
    for name in $machines; do
        ip netns del "rtc_$name" 2>/dev/null
    done
    bridge_pid=
}

plug() {
    : >bridge.log
    # shellcheck disable=SC2046,SC2086 # words
    "$bridge" "$delay" rtc_host $(printf 'rtc_%s ' $machines) >bridge.log 2>&1 &
    bridge_pid=$!
    for _ in 1 2 3 4 5 6 7 8 9 10; do
        ! grep -q ready bridge.log || break
        sleep 0.1
    done
    grep ready bridge.log || { cat bridge.log; return 1; }
    ip addr add 10.99.0.1/24 dev rtc_host && ip link set rtc_host up || return
    n=1
    for name in $machines; do
        n=$((n + 1))
        ip netns add "rtc_$name" && ip link set "rtc_$name" netns "rtc_$name" name eth0 &&
            ip -n "rtc_$name" addr add "10.99.0.$n/24" dev eth0 &&
            ip -n "rtc_$name" link set eth0 up && ip -n "rtc_$name" link set lo up || return
    done
}

# What the runner starts elsewhere it starts by this in place of ssh.
make_agent() {
    cat >agent <<'AGENT'
#!/bin/sh
while [ "${1#-}" != "$1" ]; do shift; done
name=$(echo "$1" | sed 's/.*\.//' | tr 2345 abcd)
shift
exec ip netns exec "rtc_$name" unshare --uts sh -c "hostname rtc-$name; $*"
AGENT
    chmod +x agent
}

is_delayed() {
    "$bridge" --round-trip 10.99.0.2 | tee round_trip
    awk -v delay="$delay" '{ exit !($1 >= 2 * delay && $1 < 2 * delay + 20) }' round_trip
}

# The modes again, each process in a namespace of its own.
network() {
    bridge=$work/delay_bridge
    trap 'unplug; rm -rf "$work"' EXIT
    trap 'exit 130' INT TERM
    # shellcheck disable=SC2086 # as in `ccache cc`
    ${CC:-cc} -std=c99 -D_POSIX_C_SOURCE=200809L -O1 -o "$bridge" "$tests/delay_bridge.c" || exit 1
    make_agent
    was=$bad
    bad=0
    check namespaces_can_be_made plug
    [ "$bad" -ne 0 ] || check "frames_take_${delay}_ms" is_delayed
    [ "$bad" -ne 0 ] || {
        is_network=1
        modes
        is_network=
    }
    unplug
    bad=$((bad | was))
}

for part; do
    $part
done
exit $bad
