#!/bin/sh
# crowd.sh - many processes of rtc at once on one cache of compiled kernels: a cold one, a damaged
# one, one that is read-only and one that is full.
#
#   tests/faults/crowd.sh [ROUNDS [KIND...]]
#
# In each of ROUNDS (20) rounds PROCESSES (8) of them render a small scene by --mode normals, and in
# one round more by --mode direct. All must end well, with the bytes of the picture that a process
# alone makes. Temporary files are gone afterwards, and what can be written is in order: another run
# has nothing to say. The counts are printed.
#
# Read-only and full file systems are mounted in a namespace of this script, by root or where users
# may have one; else those two are skipped.
set -u

if [ -z "${RT_CROWD_MOUNTS:-}" ]; then
    RT_CROWD_MOUNTS=no
    namespace=''
    for form in 'unshare --mount' 'unshare --mount --map-root-user'; do
        [ -n "$namespace" ] || ! $form true 2>/dev/null || namespace=$form
    done
    if [ -n "$namespace" ]; then
        export RT_CROWD_MOUNTS=yes
        exec $namespace sh "$0" "$@"
    fi
fi

rtc=$(realpath "${RTC:-build/rtc}")
processes=${PROCESSES:-8}
rounds=${1:-20}
[ $# -eq 0 ] || shift
[ $# -gt 0 ] || set -- cold damaged read-only full
bad=0
work=$(mktemp -d "${TMPDIR:-/tmp}/librt-crowd.XXXXXX") || exit 1
cd "$work" || exit 1
# Lazily, as a process that was killed may still be there.
trap 'umount -l cache 2>/dev/null; cd / && rm -rf "$work"' EXIT
trap 'exit 130' INT TERM

cat >scene.rts <<'SCENE'
camera { eye 0 1 -5  look_at 0 0 0  fov 45 }
material matt { kd 0.5 }
sphere { centre 0 0 0  radius 1  material matt }
quad { corner -4 -1 -4  edge1 0 0 8  edge2 8 0 0  material matt }
light point { position 2 4 -3  intensity 20 }
film { width 16  height 16 }
render { spp 1 }
SCENE

# render FOLDER MODE NAME: NAME.pfm, and what was said in NAME.err.
render() {
    POCL_CACHE_DIR=$1 timeout 600 "$rtc" scene.rts --mode "$2" --progress none --out "$3.pfm" \
        >"$3.out" 2>"$3.err"
}

# What is right, and what a cache that is in order holds.
for mode in normals direct; do
    render filled $mode right-$mode || {
        cat right-$mode.err
        exit 1
    }
done

# ---- The state of the cache before a round ------------------------------------------------------

prepare_cold() {
    rm -rf cache
    mkdir cache
}

# Emptied, cut off, overwritten in the middle, or with a byte too much.
prepare_damaged() {
    rm -rf cache
    cp -r filled cache
    for stored in cache/*.kernels; do
        half=$(($(wc -c <"$stored") / 2))
        case $(($1 % 4)) in
        0) : >"$stored" ;;
        1) truncate -s $half "$stored" ;;
        2) printf 'ZZZZZZZZZZZZZZZZ' |
            dd of="$stored" bs=1 seek=$half conv=notrunc 2>/dev/null ;;
        3) printf 'Z' >>"$stored" ;;
        esac
    done
}

# Without anything in it, or with all that a run needs.
prepare_read_only() {
    rm -rf cache source
    if [ $(($1 % 2)) -eq 0 ]; then mkdir source; else cp -r filled source; fi
    mkdir cache
    mount --bind source cache && mount -o remount,bind,ro cache
}

# With room for some programs, for half of one, or for nothing.
prepare_full() {
    rm -rf cache
    mkdir cache
    mount -t tmpfs -o size=1m tmpfs cache || return
    case $(($1 % 3)) in
    1) head -c 900000 /dev/zero >cache/ballast ;;
    2) cat /dev/zero >cache/ballast 2>/dev/null || : ;;
    esac
}

# ---- Rounds --------------------------------------------------------------------------------------

# one MODE NUMBER: a process of the crowd. It leaves the status in NUMBER.status.
one() {
    rm -f "$2.pfm"
    render cache "$1" "$2"
    echo $? >"$2.status"
}

# round KIND MODE NUMBER
round() {
    case $1 in
    cold) prepare_cold ;;
    damaged) prepare_damaged "$3" ;;
    read-only) prepare_read_only "$3" ;;
    full) prepare_full "$3" ;;
    esac || return 1
    i=0
    while [ $i -lt "$processes" ]; do
        one "$2" $i &
        i=$((i + 1))
    done
    wait
    i=0
    while [ $i -lt "$processes" ]; do
        if [ "$(cat $i.status)" -ne 0 ]; then
            failed=$((failed + 1))
            cat $i.err
        elif cmp -s $i.pfm "right-$2.pfm"; then
            right=$((right + 1))
        else
            wrong=$((wrong + 1))
        fi
        ! grep -qE 'compiled again|not kept' $i.err || warned=$((warned + 1))
        i=$((i + 1))
    done
    left=$((left + $(find cache -mindepth 1 ! -name '*.kernels' ! -name ballast | wc -l)))
    case $1 in
    cold | damaged)
        if ! render cache "$2" after || ! cmp -s after.pfm "right-$2.pfm" ||
            grep -qE 'compiled again|not kept' after.err; then
            unsound=$((unsound + 1))
        fi
        ;;
    *) umount cache ;;
    esac
}

for kind in "$@"; do
    case $kind in
    cold | damaged) ;;
    read-only | full)
        if [ "$RT_CROWD_MOUNTS" = no ]; then
            echo "skip $kind: neither root nor a user namespace to mount it in"
            continue
        fi
        ;;
    *)
        echo "crowd.sh: there is no kind '$kind': cold, damaged, read-only, full" >&2
        exit 2
        ;;
    esac
    right=0 wrong=0 failed=0 warned=0 left=0 unsound=0 number=0 trouble=''
    while [ $number -lt "$rounds" ]; do
        round "$kind" normals $number || trouble=', the cache cannot be prepared'
        number=$((number + 1))
    done
    round "$kind" direct "$rounds" || trouble=', the cache cannot be prepared'
    sum="$kind: $right pictures right, $wrong wrong, $failed processes failed, $warned warned"
    sum="$sum; $left files left behind, $unsound caches unsound after it$trouble"
    if [ $right -eq $((processes * (rounds + 1))) ] && [ $((left + unsound)) -eq 0 ]; then
        echo "ok $sum"
    else
        echo "not ok $sum"
        bad=1
    fi
done
exit $bad
