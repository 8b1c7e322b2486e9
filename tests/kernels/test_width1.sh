#!/bin/sh
# test_width1.sh - the programs at width 1, as a GPU compiles them: one path a work-item. Reads what
# is left of private memory from the compiler's intermediate code, with all inlined that is not
# meant to be called. The programs compile without a warning at both widths,
# so a case that a switch over an enum leaves out is seen here.
#
# CLANG names the compiler; without one that has a target for GPUs the tests are skipped.
set -u

find_clang() {
    for each in ${CLANG:-} clang clang-19 clang-18 clang-17 clang-16 clang-15 clang-14; do
        if "$each" --print-targets 2>/dev/null | grep -q amdgcn; then
            echo "$each"
            return
        fi
    done
}

clang=$(find_clang)
if [ -z "$clang" ]; then
    echo 'skip width1: no clang with a target for GPUs'
    exit 0
fi
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
bad=0

# compile WIDTH PROGRAM OPTION...: the program for a GPU.
compile() {
    width=$1 program=$2
    shift 2
    "$clang" -x cl -cl-std=CL1.2 -target amdgcn-- -Xclang -finclude-default-header \
        -Xclang -fdeclare-opencl-builtins \
        -D__OPENCL_VERSION__=120 -D RT_WIDTH="$width" -Wall -Wno-unused-function -Werror -O1 \
        -I kernels "$@" "kernels/$program.cl"
}

# check NAME FILE: the test passes when FILE, which lists offences, is empty.
check() {
    if [ -s "$2" ]; then
        printf 'not ok %s\n' "$1"
        sed 's/^/    /' "$2"
        bad=1
    else
        printf 'ok %s\n' "$1"
    fi
}

# widths FILE: those at which a program differs, but for what all others have, too.
widths() {
    if [ "$1" = kernels/trace.cl ] ||
        compile 8 "$(basename "$1" .cl)" -MM | grep -q '/batch\.h'; then
        echo 1 8
    else
        echo 1
    fi
}

for file in kernels/*.cl; do
    for width in $(widths "$file"); do
        compile "$width" "$(basename "$file" .cl)" -fsyntax-only >>"$work/warnings" 2>&1
    done
done
for program in path photon_camera photon_emit gather_tree; do
    compile 1 "$program" -emit-llvm -S -mllvm -inline-threshold=1000000 -o "$work/code" 2>/dev/null
    sed -n 's/.*= alloca \(.*\), align.*/\1/p' "$work/code" | sort | uniq -c |
        sed "s/^/$program: /" >>"$work/private"
    sed -n '/^define.* amdgpu_kernel /,/^}/s/.*= alloca \(.*\), align.*/\1/p' "$work/code" | sort |
        uniq -c | sed "s/^/$program: /" >>"$work/own"
done
check programs_compile_without_a_warning_at_both_widths "$work/warnings"

# But for the colours of textures in each other, which a call of its own holds, once in a program.
levels=$(sed -n 's/^#define RT_TEXTURE_LEVELS //p' kernels/common.h)
colours="1 \\[$((2 * levels + 1)) x <3 x float>\\]"
grep -E '\[[0-9]+ x (%|<|float)' "$work/private" |
    grep -vE "^[a-z_]+: +$colours\$" >"$work/arrays"
check no_array_of_paths_hits_or_lanes_is_in_private_memory "$work/arrays"

# One of each, but of rays the path's own and the shadow ray; and the sums of a pixel of the film.
# A principled surface is evaluated, and sampled, by a call that is handed a copy, with its padding.
handed='contact|hit|light_sample|rt_params|scene|surface'
handed="1 %struct\\.($handed)|2 %struct\\.(ray|bsdf)|6 i64|1 \\[7 x i8\\]"
grep -E '^(path|photon_camera):' "$work/own" |
    grep -vE "^[a-z_]+: +($handed)\$" >"$work/rest"
check a_path_has_in_private_memory_what_it_hands_to_calls "$work/rest"
exit $bad
