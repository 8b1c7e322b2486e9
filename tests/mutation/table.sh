# shellcheck shell=sh
# table.sh - reads mutations.txt and plants what it says. To be sourced; $table is the file.
: "${table:?}"

# All names, in order.
mutation_names() { sed -n 's/^mutation  *//p' "$table"; }

# The lines of the file, those that begin with white space joined to the one before.
mutation_lines() {
    awk '
        /^[ \t]/ { sub(/^[ \t]+/, ""); line = line " " $0; next }
        { if (NR > 1) print line; line = $0 }
        END { print line }' "$table"
}

# mutation_fields NAME: the lines of the mutation.
mutation_fields() {
    mutation_lines | awk -v name="$1" '
        $1 == "mutation" { here = $2 == name }
        here'
}

# mutation_field NAME FIELD: what the mutation has there.
mutation_field() { mutation_fields "$1" | sed -n "s/^$2  *//p"; }

# Tests that all survivors meet.
mutation_rest() { mutation_lines | sed -n 's/^rest  *//p'; }

# plant OLD NEW <FILE: the file with its only OLD replaced by NEW; white space does not count, so
# that OLD may run over several lines of the file. Fails where OLD is not there, or more than once.
plant() {
    OLD=$1 NEW=$2 awk '
        { text = text $0 "\n" }
        END {
            old = ENVIRON["OLD"]
            gsub(/[ \t]/, "", old)
            for (i = 1; i <= length(text); i++)
                if ((c = substr(text, i, 1)) !~ /[ \t\n]/) {
                    dense = dense c
                    place[++count] = i
                }
            for (rest = dense; at = index(rest, old); rest = substr(rest, at + 1)) {
                first = done += at
                found++
            }
            if (found != 1) {
                printf "the old text is there %d times, not once\n", found | "cat 1>&2"
                exit 1
            }
            printf "%s%s%s", substr(text, 1, place[first] - 1), ENVIRON["NEW"],
                substr(text, place[first + length(old) - 1] + 1)
        }'
}
