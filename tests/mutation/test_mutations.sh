#!/bin/sh
# test_mutations.sh - every mutation fits the sources as they are: its text is there once, and the
# Makefile has its tests.
set -u
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
table=$here/mutations.txt
. "$here/table.sh"
bad=0

# verdict NAME WHY: ok, or not ok for that reason.
verdict() {
    if [ -z "$2" ]; then
        printf 'ok %s\n' "$1"
    else
        printf 'not ok %s: %s\n' "$1" "$2"
        bad=1
    fi
}

# Read once, as there are many mutations.
listed=" $(tr -s '[:space:]' ' ' <"$root/Makefile") "

# fault NAME: what is wrong with a mutation.
fault() {
    file='' old='' new='' tests='' seen=' '
    while read -r field text; do
        case $field in file | old | new | tests) eval "$field=\$text" ;; esac
        [ -z "$text" ] || seen="$seen$field "
    done <<END
$(mutation_fields "$1")
END
    for field in breaks file old new tests; do
        case $seen in
            *" $field "*" $field "*) echo "not one line '$field';" ;;
            *" $field "*) ;;
            *) echo "not one line '$field';" ;;
        esac
    done
    [ -f "$root/$file" ] || { echo 'no such file;' && return; }
    if planted=$(plant "$old" "$new" <"$root/$file" 2>&1); then
        [ "$planted" != "$(cat "$root/$file")" ] || echo 'nothing changes;'
    else
        echo "$planted"
    fi
    # shellcheck disable=SC2086 # a list of tests
    missing_tests $tests
}

# missing_tests TEST...: those that the Makefile does not list.
missing_tests() {
    for test in "$@"; do
        case $listed in *" tests/$test.c "*) ;; *) echo "no test $test;" ;; esac
    done
}

# plants NAME WANTED OLD NEW TEXT: what plant makes of a text; `refused` when it does not.
plants() {
    got=$(printf '%s\n' "$5" | plant "$3" "$4" 2>/dev/null) || got=refused
    [ "$got" = "$2" ] && why='' || why="'$got', not '$2'"
    verdict "$1" "$why"
}

plants text_is_replaced 'a/b & "c\n"' 'x*[' '& "c\n"' 'a/b x*['
plants text_over_two_lines_is_replaced 'a (bc)' 'b+ 1' 'b' 'a (b
    + 1c)'
plants text_that_is_missing_is_refused refused 'x' 'y' 'abc'
plants text_that_is_there_twice_is_refused refused 'x' 'y' 'x + x'
for name in $(mutation_names); do
    verdict "$name" "$(fault "$name" | tr '\n' ' ')"
done
# shellcheck disable=SC2046 # a list of tests
verdict rest "$(missing_tests $(mutation_rest) | tr '\n' ' ')"
repeated=$(mutation_names | sort | uniq -d)
verdict names_are_different "$repeated"
exit $bad
