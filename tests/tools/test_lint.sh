#!/bin/sh
# test_lint.sh - tools/lint.sh fails where one of its checks does. Tools that find fault, or none,
# stand in for the real ones.
set -u
cd "$(dirname "$0")/../.." || exit 1
top=$PWD
work=$(mktemp -d "${TMPDIR:-/tmp}/librt-lint-test.XXXXXX") || exit 1
trap 'rm -rf "$work"' EXIT

mkdir "$work/tests" "$work/bin" || exit 1
echo 'int x;' >"$work/a.c"
echo 'echo x' >"$work/a.sh"

# stand_in FILE TEXT: a tool that says the text; tests/test_style.sh alone fails when it does.
stand_in() {
    printf '#!/bin/sh\n%s\n' "$2" >"$work/$1"
    chmod +x "$work/$1"
}

# lint: the status of lint.sh in a tree of its own.
lint() {
    (cd "$work" && GIT_DIR="$work/none" PATH="$work/bin:$PATH" CLANG_FORMAT=form \
        sh "$top/tools/lint.sh" --quick >"$work/said" 2>&1)
}

# expect NAME STATUS: lint.sh ends so.
expect() {
    lint
    status=$?
    if [ $status -eq "$2" ]; then
        echo "ok $1"
    else
        echo "not ok $1: status $status"
        sed 's/^/    /' "$work/said"
    fi
}

stand_in bin/form ''
stand_in bin/shellcheck ''
stand_in tests/test_style.sh ''
expect a_tree_in_good_form_passes 0
stand_in bin/form 'echo "a.c:1:1: error: code should be clang-formatted"'
expect code_that_is_not_laid_out_fails 1
stand_in bin/form ''
stand_in bin/shellcheck 'echo "a.sh:1:1: warning: quote this"'
expect a_complaint_about_a_script_fails 1
stand_in bin/shellcheck ''
stand_in tests/test_style.sh 'exit 1'
expect a_fault_of_style_fails 1
