#!/bin/sh
# test_mutations.sh - every mutation fits the sources as they are: its text is there once, and the
# Makefile has its tests.
set -u
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
table=$here/mutations.txt
. "$here/table.sh"
work=$(mktemp) || exit 1
trap 'rm -f "$work"' EXIT
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

listed=" $(tr -s '[:space:]' ' ' <"$root/Makefile") "

# faults: of every mutation a line: its name, and what is wrong with it. Files are read once, as
# there are many mutations.
faults() {
    mutation_lines | awk -v root="$root/" -v listed="$listed" '
        # A file without white space, which does not count; "" where there is none.
        function dense_of(file,   line, text) {
            if (!(file in dense)) {
                while ((getline line <(root file)) > 0)
                    text = text line
                close(root file)
                gsub(/[ \t]/, "", text)
                dense[file] = text
            }
            return dense[file]
        }
        function fault(   field, i, n, text, old, rest, at, why) {
            n = split("breaks file old new tests", field, " ")
            for (i = 1; i <= n; i++)
                if (seen[field[i]] != 1)
                    why = why "not one line \047" field[i] "\047; "
            text = dense_of(value["file"])
            old = value["old"]
            gsub(/[ \t]/, "", old)
            rest = text
            for (n = 0; (at = index(rest, old)) > 0; n++)
                rest = substr(rest, at + 1)
            if (text == "")
                why = why "no such file; "
            else if (n != 1)
                why = why "the old text is there " n " times, not once; "
            else if (value["old"] == value["new"])
                why = why "nothing changes; "
            n = split(value["tests"], field, " ")
            for (i = 1; i <= n; i++)
                if (!index(listed, " tests/" field[i] ".c "))
                    why = why "no test " field[i] "; "
            return why
        }
        $1 == "mutation" || $1 == "rest" {
            if (name != "")
                print name, fault()
            name = $1 == "mutation" ? $2 : ""
            split("", seen)
            split("", value)
        }
        name != "" && NF > 0 {
            seen[$1]++
            value[$1] = $0
            sub(/^[a-z]+ */, "", value[$1])
        }
        END {
            if (name != "")
                print name, fault()
        }'
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
faults >"$work"
while read -r name why; do
    verdict "$name" "$why"
done <"$work"
# shellcheck disable=SC2046 # a list of tests
verdict rest "$(missing_tests $(mutation_rest) | tr '\n' ' ')"
repeated=$(mutation_names | sort | uniq -d)
verdict names_are_different "$repeated"
exit $bad
