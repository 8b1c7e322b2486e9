#!/bin/sh
# test_page.sh - tests/proof/page.sh keeps the sections that cannot be measured here, and fails
# where one is missing.
set -u
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/tests/proof"
page=$work/tests/proof/README.md
bad=0

# write_page TITLE...: a page of these sections.
write_page() {
    echo '# An old page' >"$page"
    for title in "$@"; do
        printf '\n## %s\n\nrows of %s\n' "$title" "$title" >>"$page"
    done
}

make_page() { (cd "$work" && RT_REFERENCE='' PYTHON=false sh "$here/page.sh" >"$work/out" 2>&1); }

# check NAME STATUS: what was just tested held where STATUS is 0.
check() {
    if [ "$2" -eq 0 ]; then
        printf 'ok %s\n' "$1"
    else
        printf 'not ok %s: %s\n' "$1" "$(tail -n 1 "$work/out")"
        bad=1
    fi
}

# refuses NAME MISSING TITLE...: a page of these sections stays as it is, and the missing one is
# named.
refuses() {
    name=$1 missing=$2
    shift 2
    write_page "$@"
    cp "$page" "$work/before"
    ! make_page && cmp -s "$page" "$work/before" && grep -qF "no section '$missing'" "$work/out"
    check "$name" $?
}

write_page 'Direct light' 'Against stored renders' 'Against Mitsuba 3' 'Modes against each other'
make_page && grep -qx 'rows of Against stored renders' "$page" &&
    grep -qx 'rows of Against Mitsuba 3' "$page" &&
    grep -qx 'rows of Modes against each other' "$page"
check sections_that_are_not_measured_are_kept $?
! grep -q 'rows of Direct light' "$page"
check sections_that_are_measured_are_not $?
refuses missing_renders_are_told 'Against stored renders' 'Against Mitsuba 3'
refuses missing_peer_is_told 'Against Mitsuba 3' \
    'Against stored renders' 'Against Mitsuba 3 or 4'
refuses missing_modes_are_told 'Modes against each other' \
    'Against stored renders' 'Against Mitsuba 3'
exit $bad
