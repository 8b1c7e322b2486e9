#!/bin/sh
# compile.sh - every mutation compiles: a unit that it is part of, kernel or C, is checked with it
# planted, by the compilers alone. Prints `ok NAME`, or `not ok NAME` with what they say.
#
#   tests/mutation/compile.sh [NAME...]
#
# CLANG (clang-14) checks kernels, CC and CXX (cc, c++) the rest.
set -u
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
table=$here/mutations.txt
. "$here/table.sh"
CLANG=${CLANG:-clang-14} CC=${CC:-cc} CXX=${CXX:-c++}
command -v "$CLANG" >/dev/null || {
    echo "compile.sh: no $CLANG (Debian: clang-14)" >&2
    exit 2
}
tree=$(mktemp -d "${TMPDIR:-/tmp}/librt-mutants.XXXXXX") || exit 2
trap 'rm -rf "$tree"' EXIT
trap 'exit 130' INT TERM
(cd "$root" && find lib kernels dsl tools tests/kernels -name '*.[ch]*' -type f |
    tar -cf - -T -) | tar -xf - -C "$tree" || exit 2
cd "$tree" || exit 2

# As the host does it on a CPU, where some kernels take eight rays at a time.
opencl() {
    "$CLANG" -x cl -cl-std=CL1.2 -D __OPENCL_VERSION__=120 -D RT_WIDTH=8 -w \
        -Xclang -finclude-default-header -I kernels "$@"
}

# Of the Makefile's libraries those whose headers are not in the folders of the system.
libraries=$(pkg-config --cflags OpenCL OpenEXR libpng libjpeg 2>/dev/null)

# Which kernels each header is part of: lines of HEADER KERNEL.
for unit in kernels/*.cl tests/kernels/*.cl; do
    opencl -MM "$unit" | awk -v unit="$unit" '{ for (i = 1; i <= NF; i++) print $i, unit }'
done >parts

# compiled FILE: what compilers say of a unit that the file is part of; nothing where it is right.
compiled() {
    case $1 in
    *.cl) opencl -fsyntax-only "$1" ;;
    *.c)
        # shellcheck disable=SC2086 # a list of options
        "$CC" -std=c99 -D_POSIX_C_SOURCE=200809L -w -Ilib -Ikernels -I. $libraries \
            -fsyntax-only "$1"
        ;;
    *.cc) "$CXX" -std=c++17 -w -Ilib -fsyntax-only "$1" ;;
    *)
        unit=$(awk -v header="$1" '$1 == header { print $2; exit }' parts)
        if [ -n "$unit" ]; then
            opencl -fsyntax-only "$unit"
        else
            echo "no unit has $1"
        fi
        ;;
    esac 2>&1
}

bad=0
# shellcheck disable=SC2046 # a list of names
[ $# -gt 0 ] || set -- $(mutation_names)
for name; do
    file=$(mutation_field "$name" file)
    old=$(mutation_field "$name" old) new=$(mutation_field "$name" new)
    if [ -n "$file" ] && plant "$old" "$new" <"$root/$file" >"$file"; then
        said=$(compiled "$file")
    else
        said="it does not fit '$file'"
    fi
    [ -z "$file" ] || cp "$root/$file" "$file"
    if [ -z "$said" ]; then
        echo "ok $name"
    else
        printf 'not ok %s\n%s\n' "$name" "$said"
        bad=1
    fi
done
exit $bad
