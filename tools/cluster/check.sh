#!/bin/sh
# check.sh - the model against this machine: pictures by 1, 2 and 4 processes of one thread, as a
# pool with a queue, as parts that are merged and, where `make mpi` has built it, by rtc-mpi, beside
# what simulate says.
#
#   tools/cluster/check.sh [ROUNDS]
#
# `make check-cluster` calls it. Each round measures the figures anew, then renders; the medians of
# ROUNDS (3) are compared. It takes two minutes a round, and nothing else should run meanwhile.
# Prints the figures and the table of README.md. The status is 1 where the model is off by more than
# 10 %.
set -u
cd "$(dirname "$0")/../.." || exit 2
bin=$PWD/build
rounds=${1:-3}
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT
sed -e 's/^film .*/film { width 640  height 360 }/' -e 's/mode      path .*/mode path  spp 128/' \
    scenes/cornell.rts >"$work/scene.rts"
cd "$work" || exit 2

now() { date +%s.%N; }
median() { sort -n | awk '{ v[NR] = $1 } END { print v[int((NR + 1) / 2)] }'; }
# timed NAME COMMAND...: its seconds, to NAME.
timed() {
    name=$1
    began=$(now)
    shift
    "$@" >log 2>&1 || { cat log; exit 2; }
    echo "$began $(now)" | awk '{ print $2 - $1 }' >>"$name"
}

pool() { "$bin/tools/cluster/pool" scene.rts pool.pfm "$1"; }
parts() {
    for i in $(seq "$1"); do
        "$bin/rtc" scene.rts --quiet --threads 1 --part "$i/$1" --out "p$i-$1.rtpart" &
    done
    wait
    "$bin/rtc" merge p*-"$1".rtpart --quiet --out parts.pfm && rm p*.rtpart
}

kinds='pool parts'
mpi() {
    OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 \
        OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_hwloc_base_binding_policy=none \
        mpirun -np "$1" "$bin/mpi/rtc-mpi" "${2:-scene.rts}" --threads 1 --quiet --out mpi.pfm
}
[ ! -x "$bin/mpi/rtc-mpi" ] || kinds="$kinds mpi"
# Of a picture of one pixel: what mpirun takes to start, beside the start of a process.
sed 's/^film .*/film { width 1  height 1 }/' scene.rts >pixel.rts

# crowd ROUND: how much longer a sample takes where all cores work, to the figures of a round.
crowd() {
    for i in $(seq "$(nproc)"); do
        "$bin/tools/cluster/measure" scene.rts chunks >"crowd.$i" &
    done
    wait
    sed -n 's/^sample=\([^ ]*\).*/\1/p' "figures.$1" crowd.* | awk '
        NR == 1 { alone = $1; next }
        { sum += $1 }
        END { printf "crowding=%.4g  # by how much a thread is slower where all cores work\n",
                     sum / (NR - 1) / alone }' >crowding
    cat crowding >>"figures.$1"
    rm crowd.*
}

for round in $(seq "$rounds"); do
    "$bin/tools/cluster/measure" scene.rts >"figures.$round" || exit 2
    crowd "$round"
    for ranks in 1 2 4; do
        for kind in $kinds; do
            timed "$kind.$ranks" "$kind" "$ranks"
            cmp pool.pfm "$kind.pfm" || exit 2
        done
    done
    [ "$kinds" = 'pool parts' ] || timed mpi.start mpi 1 pixel.rts
done
# The median of each figure.
sed 's/=.*//' figures.1 | while read -r name; do
    value=$(cat figures.* | sed -n "s/^$name=\([^ ]*\).*/\1/p" | median)
    sed -n "s/^$name=[^ ]*/$name=$value/p" figures.1
done >figures
cat figures

# predicted KIND RANKS: by the model, for processes on the cores of this machine.
predicted() {
    case $1 in
    pool) set -- "$2" schedule=demand tasks=16 guided=0 largest_first=1 ;;
    parts) set -- "$2" schedule=parts pieces=1 ;;
    mpi) set -- "$2" schedule=demand films=tree start="$(median <mpi.start)" ;;
    esac
    ranks=$1
    shift
    "$bin/tools/cluster/simulate" figures width=640 height=360 spp=128 ranks="$ranks" \
        cores="$(nproc)" speeds=0 stragglers=0 life=0 latency=1e-5 "$@" | cut -d' ' -f1
}
echo
echo "| ranks on $(nproc) cores | | measured, s | model, s | off by |"
echo '|--:|--|--:|--:|--:|'
for kind in $kinds; do
    for ranks in 1 2 4; do
        echo "$ranks $kind $(median <"$kind.$ranks") $(predicted "$kind" "$ranks")"
    done
done | awk '{
        off = 100 * ($4 / $3 - 1)
        printf "| %d | %s | %.2f | %.2f | %+.1f %% |\n", $1, $2, $3, $4, off
        bad += off > 10 || off < -10
    }
    END { exit bad > 0 }'
