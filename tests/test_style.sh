#!/bin/sh
# test_style.sh - what the sources promise of their form: length of lines and functions, no default
# over an enum, the field's words, files that say what they are, and that no test is left out of the
# Makefile. Reads the sources from the repository root and needs no build; -c prints the counts
# alone, file by file.
set -u
LC_ALL=C
export LC_ALL
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
bad=0

# Files whose switches have characters for cases, as tokens do, which no list can exhaust.
open_switches='dsl/parse_expression.c'

# Words of our own making, and phrases with them. Read on lines in lower case whose underscores are
# spaces, so that they are found in identifiers too. Idioms with "way" are taken out before.
idioms='under way|by way( of)?|(on|out of|lose) (the|its|their) way
(either|each|same|this|that|all the) ways?|ways? out|in a way'
banned='lamps?|squeez(e|es|ed|ing)|shines?|shining|shone|paints?|paint at|ways?
(light|lights|emitter|emitters) (of no|without) size|comes? to the truth|true at the edges
in even light|what is off|idle|hangs? on nothing|physical errors?
(a|the|first|last|next|single|each|noise|photon) looks?|look (max|limit|at share)|size t look
(rt|a|the|this|each|end) stretch(es)?|stretch (first|next)
(area|spot|target) spread|float8? spread
maps? (is|are|was|were) asked|asks? (the|one|all|photon) (photon )?maps?|points? asks?
round (shapes?|part|top|base|side|areas|angle|point|tangents)
(intersect|add|canonical|shape.) ?round'

# check NAME FILE: the test passes when FILE, which lists offences, is empty.
check() {
    if [ "$counts" ]; then
        printf '%s: %d\n' "$1" "$(wc -l <"$2")"
        sed 's/:.*//' "$2" | sort | uniq -c | sort -rn
    elif [ -s "$2" ]; then
        printf 'not ok %s\n' "$1"
        sed 's/^/    /' "$2"
        bad=1
    else
        printf 'ok %s\n' "$1"
    fi
}

# sources PATTERN...: the files of the tree whose names match one.
sources() {
    for pattern; do
        find . -name build -prune -o -name .git -prune -o -type f -name "$pattern" -print
    done | sed 's|^\./||' | sort
}

# over FILE...: lines of more than 100 columns; a tab at the start of a line is 8, a character one.
over() {
    awk '{
        line = $0
        gsub(/[\200-\277]/, "", line)
        while (sub(/^\t/, "        ", line))
            ;
        if (length(line) > 100)
            print FILENAME ":" FNR ": " length(line) " columns"
    }' "$@"
}

# long FILE...: functions of more than 50 lines. clang-format puts their braces in the first column,
# and those of namespaces and classes, which count for nothing.
long() {
    awk '
        FNR == 1 { start = 0 }
        /^(namespace|class|struct)( |$)/ && !/\(/ { name = ""; next }
        /^[A-Za-z_].*\(/ { name = $0; sub(/\(.*/, "", name); sub(/.*[ *]/, "", name) }
        /^\{/ { start = name != "" ? FNR : 0 }
        /^\}/ && start {
            if (FNR - start + 1 > 50)
                print FILENAME ":" start ": " name " has " FNR - start + 1 " lines"
            start = 0
        }' "$@"
}

# defaults FILE...: every default: but those of the list.
defaults() {
    awk -v open="$open_switches" '
        /^[ \t]*default:/ && index(" " open " ", " " FILENAME " ") == 0 {
            print FILENAME ":" FNR ": default"
        }' "$@"
}

# words FILE...: lines with a banned word.
words() {
    awk -v idioms="$idioms" -v banned="$banned" '
        BEGIN {
            gsub(/\n/, "|", idioms)
            gsub(/\n/, "|", banned)
            idioms = " (" idioms ") "
            banned = " (" banned ") "
        }
        {
            line = " " tolower($0) " "
            gsub(/[^a-z0-9]+/, " ", line)
            while (sub(idioms, " ", line))
                ;
            if (match(line, banned))
                print FILENAME ":" FNR ":" substr(line, RSTART, RLENGTH) "| " $0
        }' "$@"
}

# nameless FILE...: files that do not open with a comment, or whose comment names another file.
nameless() {
    awk '
        function finish() {
            if (file != "" && !told)
                print file ": does not open by saying what it is"
        }
        FNR == 1 {
            finish()
            file = FILENAME
            told = 0
            base = file
            sub(/.*\//, "", base)
            is_script = file ~ /\.(sh|py)$/
        }
        FNR == 1 && /^#!/ { next }
        FNR <= 4 && !told {
            if (is_script ? /^# ?[A-Za-z`]/ || /^"""[A-Za-z`]/ : /^(\/\*| \*|\/\/) [A-Za-z`"]/)
                told = FNR
            if (told && match($0, /[A-Za-z0-9_.]+\.(c|h|cl|cc|sh|py) - /)) {
                named = substr($0, RSTART, RLENGTH - 3)
                if (named != base)
                    print file ": its first comment is of " named
            }
            if (!is_script && FNR == 1 && !/^\/[*\/]/)
                FNR = 5
        }
        END { finish() }' "$@"
}

# unlisted FILE...: tests that the Makefile does not name, so that nothing runs them.
unlisted() {
    for file; do
        grep -qF "$file" Makefile || printf '%s: not in the Makefile\n' "$file"
    done
}

# made NAME FUNCTION SEEN...: the function finds these lines in a made file, and only these.
made() {
    name=$1
    shift
    (cd "$work" && "$@" made.c) >"$work/seen"
    cmp -s "$work/seen" "$work/planted" || {
        echo "$name:"
        diff "$work/planted" "$work/seen"
    } >>"$work/offences"
}

# The checks see what they are for.
self_test() {
    : >"$work/offences"
    printf '%0101d\n\t%092d\n%0100d\n\303\244%099d\n' 1 1 1 1 >"$work/made.c"
    echo 'made.c:1: 101 columns' >"$work/planted"
    made over over
    {
        printf 'static int small(void)\n{\n}\n\nint *large(int a,\n'
        printf '           int b)\n{\n'
        yes '    ;' | head -n 49
        printf '}\n'
    } >"$work/made.c"
    echo 'made.c:7: large has 51 lines' >"$work/planted"
    made long long
    printf '    default:\n    /* default: */\n' >"$work/made.c"
    echo 'made.c:1: default' >"$work/planted"
    made defaults defaults
    printf 'clamp(x) is under way;\nint is_lamp;\nby the other way\non its way by way of\n' \
        >"$work/made.c"
    printf 'made.c:2: lamp | int is_lamp;\nmade.c:3: way | by the other way\n' >"$work/planted"
    made words words
    printf '/* other.c - of another. */\n' >"$work/made.c"
    echo 'made.c: its first comment is of other.c' >"$work/planted"
    made nameless nameless
    printf '#include <a.h>\n/* made.c - too late. */\n' >"$work/made.c"
    echo 'made.c: does not open by saying what it is' >"$work/planted"
    made nameless nameless
    echo 'TESTS := other.c' >"$work/Makefile"
    echo 'made.c: not in the Makefile' >"$work/planted"
    made unlisted unlisted
    check planted_offences_are_seen "$work/offences"
}

counts=
[ "${1-}" = -c ] && counts=yes
self_test
sources '*.[ch]' '*.cl' '*.cc' >"$work/code"
sources '*.sh' '*.py' >"$work/scripts"
grep -E '^(kernels|lib|dsl|tools)/' "$work/code" >"$work/shipped"
[ "$(wc -l <"$work/shipped")" -gt 100 ] || echo 'few sources: is this the repository?' >"$work/few"
: >>"$work/few"
check the_sources_are_found "$work/few"
# shellcheck disable=SC2046 # no name of ours has a space
{
    over $(cat "$work/code" "$work/scripts") $(sources '*.md' '*.rts' Makefile) >"$work/over"
    long $(cat "$work/code") >"$work/long"
    defaults $(cat "$work/shipped") >"$work/defaults"
    words $(cat "$work/shipped") README.md $(sources '*.md' | grep '^dsl/') >"$work/words"
    nameless $(cat "$work/code") >"$work/nameless"
    nameless $(cat "$work/scripts") >>"$work/nameless"
    unlisted $(sources 'test_*.c') >"$work/unlisted"
}
check lines_have_at_most_100_columns "$work/over"
check functions_have_at_most_50_lines "$work/long"
check no_default_over_an_enum "$work/defaults"
check only_the_words_of_the_field "$work/words"
check every_file_says_what_it_is "$work/nameless"
check every_test_is_in_the_makefile "$work/unlisted"
exit $bad
