#!/bin/sh
# test_deps.sh - tools/deps.sh calls the package manager only when something is missing.
# The package manager is a stand-in that writes down how it was called.
set -u
here=$(cd "$(dirname "$0")" && pwd)
deps=$here/../../tools/deps.sh
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
bad=0

# check NAME CONDITION...: one test.
check() {
    name=$1
    shift
    if "$@"; then
        printf 'ok %s\n' "$name"
    else
        printf 'not ok %s\n' "$name"
        sed 's/^/    /' "$work/log"
        bad=1
    fi
}

says() { grep -q -- "$1" "$work/log"; }
is_silent() { [ ! -s "$work/log" ] && [ ! -e "$work/calls" ]; }
called() { [ -e "$work/calls" ] && grep -q -- "$1" "$work/calls"; }
not_called() { [ ! -e "$work/calls" ]; }
status_is() { [ "$status" -eq "$1" ]; }

# run PATH [NAME=VALUE...] [ARGUMENT]: runs deps.sh with this PATH.
run() {
    path=$1
    shift
    rm -f "$work/calls"
    env PATH="$path" CALLS="$work/calls" "$@" >"$work/log" 2>&1
    status=$?
}

mkdir "$work/fake" "$work/plain"
for tool in apt-get dpkg sudo; do
    printf '#!/bin/sh\necho "%s $*" >>"$CALLS"\n' "$tool" >"$work/fake/$tool"
done
printf '#!/bin/sh\necho "${FAKE_ID:-0}"\n' >"$work/fake/id"
chmod +x "$work/fake"/*
for tool in sh env mktemp rm cat cc c++ pkg-config; do
    ln -s "$(command -v "$tool")" "$work/plain/$tool"
done

run "$work/fake:$PATH" sh "$deps"
check nothing_missing_is_silent is_silent
check nothing_missing_succeeds status_is 0

# C++ compiles for seconds; what follows needs no more of it than that it is there.
export CXX=true
run "$work/fake:$PATH" PKG_CONFIG=false sh "$deps"
check missing_updates_the_package_lists called '^apt-get update'
check missing_installs_only_what_is_missing \
    called '^apt-get install .*--no-install-recommends .*libpng-dev'
check compiler_there_is_not_installed eval '! called " gcc"'
check still_missing_after_install_fails status_is 1
check still_missing_after_install_is_said says 'not usable'

run "$work/fake:$PATH" FUZZ_CC=false sh "$deps" --fuzz
check fuzz_installs_what_it_needs called '^apt-get install .*libclang-rt-14-dev'

run "$work/fake:$PATH" PKG_CONFIG=false FAKE_ID=1000 sh "$deps"
check not_root_goes_through_sudo called '^sudo .*apt-get install'

run "$work/fake:$PATH" PKG_CONFIG=false sh "$deps" --check
check check_installs_nothing not_called
check check_names_what_is_missing says 'libpng-dev'
check check_fails_when_something_is_missing status_is 1

run "$work/plain" PKG_CONFIG=false CXX=c++ sh "$deps"
check other_system_is_told_what_is_needed says 'not a Debian system'
check other_system_fails status_is 1

# The Debian packages are built with what the build needs; tests alone need cmocka.
awk -F '|' '/^dependencies\(\)/ { on = 1 } /^}/ { on = 0 } on && NF == 3 { print $3 }' "$deps" |
    tr ' ' '\n' | while read -r package; do
    case $package in gcc | g++ | libc6-dev | libcmocka-dev) continue ;; esac
    grep -q "^ $package\( <!nocheck>\)\?,\?$" tools/debian/control || echo "$package"
done >"$work/out"
nothing_is_said() { [ ! -s "$work/out" ] || { cat "$work/out"; return 1; }; }
check debian_packages_are_built_with_the_same nothing_is_said

run "$work/fake:$PATH" sh "$deps" --bogus
check unknown_argument_fails status_is 1
exit $bad
