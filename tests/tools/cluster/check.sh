# shellcheck shell=sh disable=SC2034
# check.sh - what the tests of this folder begin with: a folder $work that is removed at the end,
# and `bad`, 1 where one of them failed.
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
bad=0

# check NAME COMMAND...: one test; shows what the command said when it fails.
check() {
    name=$1
    shift
    if "$@" >"$work/log" 2>&1; then
        printf 'ok %s\n' "$name"
    else
        printf 'not ok %s\n' "$name"
        sed 's/^/    /' "$work/log"
        bad=1
    fi
}
