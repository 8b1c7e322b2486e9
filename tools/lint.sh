#!/bin/sh
# lint.sh - holds the sources to their form; run from the top directory.
#
#   tools/lint.sh [--quick]
#
# The form of C, OpenCL C and C++ by clang-format, shell scripts by shellcheck, C by cppcheck (what
# it is wrong about is listed in cppcheck.txt), tests/test_style.sh, and whether the mutations
# compile. Prints `ok NAME`, or `not ok NAME` with what is wrong, for each check. --quick leaves out
# cppcheck and the mutations, which take more than seconds. Other versions of clang-format break
# lines elsewhere, so CLANG_FORMAT has to name version 14.
set -u

clang_format=${CLANG_FORMAT:-clang-format-14}
work=$(mktemp -d "${TMPDIR:-/tmp}/librt-lint.XXXXXX") || exit 1
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM

# files REGEX: the files of the tree whose paths match; without git, all but build/.
files() {
    if git rev-parse --is-inside-work-tree >/dev/null 2>&1; then
        git ls-files --cached --others --exclude-standard
    else
        find . -type f ! -path './build/*' | sed 's|^\./||'
    fi | grep -E "$1" | while IFS= read -r file; do
        [ ! -f "$file" ] || printf '%s\n' "$file"
    done
}

# check NAME: the check holds where standard input, its complaints, is empty. At the end of a
# pipeline it is a process of its own, so that a file tells of failure.
check() {
    cat >"$work/complaints"
    if [ -s "$work/complaints" ]; then
        printf 'not ok %s\n' "$1"
        sed 's/^/    /' "$work/complaints"
        : >"$work/failed"
    else
        printf 'ok %s\n' "$1"
    fi
}

# on_files REGEX COMMAND...: runs the command on the files that match.
on_files() {
    regex=$1
    shift
    files "$regex" | xargs -d '\n' -r "$@"
}

on_files '\.(c|h|cc|cl)$' "$clang_format" --dry-run -Werror 2>&1 | grep -E 'error:|not found' |
    check clang_format
on_files '(\.sh|^\.ci/run)$' shellcheck --format=gcc 2>&1 | check shellcheck
if [ "${1:-}" != --quick ]; then
    on_files '^(lib|dsl|tools|tests)/.*\.c$' cppcheck --quiet --std=c99 --library=posix \
        --enable=warning,performance,portability --suppressions-list=tools/cppcheck.txt \
        --template=gcc -Ilib -Ikernels -I. -Itests -j "$(nproc)" 2>&1 |
        grep -E ': (error|warning|performance|portability):' | check cppcheck
    sh tests/mutation/compile.sh 2>&1 | grep -v '^ok ' | check mutations_compile
fi
sh tests/test_style.sh || : >"$work/failed"
[ ! -e "$work/failed" ]
