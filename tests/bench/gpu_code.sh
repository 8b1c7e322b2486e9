#!/bin/sh
# gpu_code.sh - what GPU compilers make of each kernel at width 1: registers, memory of a work-item
# and spills, for an NVIDIA A100 (sm_80) and an AMD MI200 (gfx90a). No GPU is needed; fails where a
# kernel does not compile.
#
#     gpu_code.sh [PROGRAM]...        all of kernels/*.cl by default
#
# CLANG (clang-19) and LIBCLC (/usr/lib/clc) are Debian's clang-19 and libclc-19. PTXAS, of NVIDIA's
# toolkit or of the package nvidia-cuda-nvcc of PyPI, tells registers and spills; without it the
# column of NVIDIA's local memory is that of PTX: the frames of the kernel's functions, added up.
set -eu

CLANG=${CLANG:-clang-19}
LIBCLC=${LIBCLC:-/usr/lib/clc}
PTXAS=${PTXAS:-ptxas}
command -v "$CLANG" >/dev/null || {
    echo "gpu_code.sh: no $CLANG (Debian: clang-19 libclc-19)"
    exit 1
}
cd "$(dirname "$0")/../.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# compile PROGRAM OUT BITCODE TARGET...
compile() {
    program=$1 out=$2 bitcode=$3
    shift 3
    "$CLANG" -x cl -cl-std=CL1.2 -D __OPENCL_VERSION__=120 -D RT_WIDTH=1 "$@" \
        -Xclang -finclude-default-header -Xclang -mlink-builtin-bitcode \
        -Xclang "$LIBCLC/$bitcode" -cl-fp32-correctly-rounded-divide-sqrt -O3 -w \
        -I kernels -S -o "$out" "kernels/$program.cl"
}

# The sum of the frames in PTX: entries of a file share what they call.
local_memory() {
    awk '/\.local \.align/ { sub(/.*\[/, ""); sub(/\].*/, ""); sum += $0 }
        END { print sum + 0 }' "$1"
}

# ENTRY REGISTERS STACK SPILLED for each entry of a file, from PTX.
nvidia_rows() {
    if ! command -v "$PTXAS" >/dev/null; then
        sed -n 's/^\.entry \([a-z_]*\)(.*/\1/p; s/^\.visible \.entry \([a-z_]*\)(.*/\1/p' "$1" |
            while read -r entry; do echo "$entry - $(local_memory "$1") -"; done
        return
    fi
    "$PTXAS" -v -arch=sm_80 "$1" -o /dev/null 2>&1 | awk '
        /Compiling entry function/ { split($0, part, "\047"); entry = part[2]; is_entry = 1 }
        /bytes spill stores/ && is_entry { spilled = $5 }
        /Used [0-9]+ registers/ {
            registers = stack = 0
            for (i = 1; i < NF; i++) {
                if ($(i + 1) ~ /^registers/) registers = $i
                if ($(i + 1) == "bytes" && $(i + 2) == "cumulative") stack = $i
            }
            print entry, registers, stack, spilled
            is_entry = 0
        }'
}

# ENTRY VGPRS SGPRS SCRATCH SPILLED for each entry of a file, from the metadata of AMD's code.
amd_rows() {
    awk '
        /^amdhsa.kernels:/ { inside = 1 }
        inside && $1 == ".name:" { name = $2 }
        inside && $1 == ".private_segment_fixed_size:" { scratch = $2 }
        inside && $1 == ".sgpr_count:" { sgprs = $2 }
        inside && $1 == ".symbol:" { entry = $2; sub(/\.kd$/, "", entry) }
        inside && $1 == ".vgpr_count:" { vgprs = $2 }
        inside && $1 == ".vgpr_spill_count:" { print entry, vgprs, sgprs, scratch, $2 }' "$1"
}

echo "NVIDIA sm_80: registers, memory and spills in bytes; AMD gfx90a: VGPRs, SGPRs, scratch in"
echo "bytes, spilled VGPRs."
echo
echo "| kernel | registers | memory | spills | VGPRs | SGPRs | scratch | spilled |"
echo "|---|---|---|---|---|---|---|---|"
[ $# -gt 0 ] || set -- kernels/*.cl
for file; do
    program=$(basename "$file" .cl)
    # libclc's part for NVIDIA lacks this, which their driver has.
    compile "$program" "$work/nvidia.s" nvptx64--nvidiacl.bc -target nvptx64-nvidia-nvcl \
        -Xclang -target-cpu -Xclang sm_80 -D 'get_global_offset(dimension)=0'
    compile "$program" "$work/amd.s" amdgcn--amdhsa.bc -target amdgcn-amd-amdhsa -mcpu=gfx90a \
        -nogpulib
    nvidia_rows "$work/nvidia.s" | sort >"$work/nvidia"
    amd_rows "$work/amd.s" | sort >"$work/amd"
    if [ ! -s "$work/nvidia" ] || [ "$(wc -l <"$work/nvidia")" != "$(wc -l <"$work/amd")" ]; then
        echo "gpu_code.sh: $program: not all kernels came out"
        exit 1
    fi
    join "$work/nvidia" "$work/amd" | sed 's/ / | /g; s/^/| /; s/$/ |/'
done
